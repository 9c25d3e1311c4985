/*
 * ptlib: an engine for procedural textures. The C interface.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * Generated from ptlib/src/ffi by `cargo xtask header`: do not edit.
 *
 * The rules that hold for every function:
 *
 * Statuses. Every call that can fail returns a ptl_status, 0 (PTL_OK) for success. It usually takes
 * a `ptl_error **` last, which may be NULL. If it is not, the call always writes it: NULL, or a new
 * error that tells more and that you release with ptl_error_release(). Other outputs are written as
 * the function says: handles become NULL on error, everything else stays untouched.
 *
 * Handles are opaque. Engines, graphs, images, values and cancel requests are reference counted:
 * ptl_..._retain() adds a reference, ptl_..._release() gives one up. Errors, bytes and jobs have
 * one owner, who releases them. Every release takes NULL, on any thread and in any order: what is
 * still needed inside is kept alive. A handle must not be used after its last reference was
 * released. Handles of the wrong type are refused with PTL_E_INVALID_ARGUMENT.
 *
 * Threads. A `const` handle may be used by several threads at once. A handle that is not const is
 * used by one thread at a time; that is checked where it matters (PTL_E_BUSY).
 *
 * Texts that go in are UTF-8 and end with NUL. Texts that come out are UTF-8 and borrowed: they
 * live as long as the object that the function's documentation names.
 *
 * Structs start with `struct_size`, the size that your program was built with: set it, or let the
 * PTL_..._INIT macros do it. They only grow at their ends. The library takes smaller structs (the
 * missing fields are 0), and larger ones if what it does not know is 0, else PTL_E_UNSUPPORTED.
 * Fields that are 0 always mean "as usual". In structs that a function fills in, what the library
 * does not know becomes 0.
 *
 * The library never ends the program, installs no signal handlers, and prints nothing; only a
 * defect inside, which is returned as PTL_E_INTERNAL, also leaves a message on stderr.
 *
 * Define PTL_STATIC before including this file if you link the static library on Windows. Link at
 * most one static Rust library into a program; otherwise use the shared one.
 */
#ifndef PTLIB_H
#define PTLIB_H

#include <stddef.h>
#include <stdint.h>

#include "ptlib_values.h"

#define PTL_VERSION_MAJOR 0
#define PTL_VERSION_MINOR 1
#define PTL_VERSION_PATCH 0
/* The version of this header; ptl_version_number() is that of the library. */
#define PTL_VERSION_NUMBER \
    (PTL_VERSION_MAJOR * 1000000 + PTL_VERSION_MINOR * 1000 + PTL_VERSION_PATCH)

#if defined(_WIN32) && !defined(_WIN64)
#  define PTL_CALL __cdecl
#else
#  define PTL_CALL
#endif
#if defined(_WIN32) && !defined(PTL_STATIC)
#  define PTL_API __declspec(dllimport)
#else
#  define PTL_API
#endif
#if defined(__GNUC__)
#  define PTL_MUST_USE __attribute__((warn_unused_result))
#else
#  define PTL_MUST_USE
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* A plug-in that is linked into the program: see ptlib_plugin.h. */
struct ptlp_entry;


/** The graph's precision: in compute options. */
#define PTL_PRECISION_DEFAULT 0

/** Values are multiples of 1/255, as PT Designer computes. */
#define PTL_PRECISION_8BIT 1

/** Values are 32-bit floating-point numbers. */
#define PTL_PRECISION_FLOAT 2

/** Values are sRGB-encoded, as the user sees them. */
#define PTL_COLOR_SPACE_SRGB 1

/** The first row is the top one. */
#define PTL_ORIGIN_TOP_LEFT 1

/** A whole number. */
#define PTL_PARAM_INT 1

/** A number. */
#define PTL_PARAM_FLOAT 2

/** Yes (1) or no (0). */
#define PTL_PARAM_FLAG 3

/** One of several alternatives: by number, or by id as a text. */
#define PTL_PARAM_CHOICE 4

/** A text. */
#define PTL_PARAM_TEXT 5

/** The path of a file. */
#define PTL_PARAM_PATH 6

/** In ptl_param_info: the block reads the file of this path. */
#define PTL_PARAM_READS_FILE 1

/** In ptl_param_info: the block writes the file of this path. */
#define PTL_PARAM_WRITES_FILE 2

/** In ptl_port_info: the block works without this input. */
#define PTL_PORT_OPTIONAL 1

/** In ptl_port_info: this output gives any finite numbers (heights, distances), not only 0 to 1. */
#define PTL_PORT_FREE_RANGE 2

/** Of a block type: its output is a result of the graph. */
#define PTL_BLOCK_IS_RESULT 1

/** Of a block type: it writes a file. */
#define PTL_BLOCK_WRITES_FILE 2

/** Of a block type: another seed gives another picture. */
#define PTL_BLOCK_USES_SEED 4

/** Of a block type: its output always tiles when its inputs do. */
#define PTL_BLOCK_TILES 8

/** Of a block type: its value is set by ptl_graph_set_input(). */
#define PTL_BLOCK_IS_INPUT 16

/** In engine options: results are not kept for later computations. */
#define PTL_ENGINE_NO_CACHE 1

/** For ptl_value_from_mesh() and its kin: the data stays the caller's. */
#define PTL_VALUE_BORROW 1

/** In compute options: `seed` counts, also if it is 0. */
#define PTL_COMPUTE_SEED 1

/** In compute options: where a block fails, go on with a white image in its place. */
#define PTL_COMPUTE_KEEP_GOING 2

/** Details for whoever looks for a fault. */
#define PTL_LOG_DEBUG 1

/** What goes on. */
#define PTL_LOG_INFO 2

/** What works, but probably not as meant. */
#define PTL_LOG_WARNING 3

/** What failed. */
#define PTL_LOG_ERROR 4

/** For ptl_abi_sizeof(): ptl_progress. */
#define PTL_STRUCT_PROGRESS 1

/** For ptl_abi_sizeof(): ptl_engine_options. */
#define PTL_STRUCT_ENGINE_OPTIONS 2

/** For ptl_abi_sizeof(): ptl_compute_options. */
#define PTL_STRUCT_COMPUTE_OPTIONS 3

/** For ptl_abi_sizeof(): ptl_image_info. */
#define PTL_STRUCT_IMAGE_INFO 4

/** For ptl_abi_sizeof(): ptl_graph_info. */
#define PTL_STRUCT_GRAPH_INFO 5

/** For ptl_abi_sizeof(): ptl_param_info. */
#define PTL_STRUCT_PARAM_INFO 6

/** For ptl_abi_sizeof(): ptl_port_info. */
#define PTL_STRUCT_PORT_INFO 7

/** For ptl_abi_sizeof(): ptl_fault. */
#define PTL_STRUCT_FAULT 8

/** For ptl_abi_sizeof(): ptl_stream. */
#define PTL_STRUCT_STREAM 9

/** For ptl_abi_sizeof(): ptl_mesh_data. */
#define PTL_STRUCT_MESH_DATA 10

/** For ptl_abi_sizeof(): ptl_points_data. */
#define PTL_STRUCT_POINTS_DATA 11

/** For ptl_abi_sizeof(): ptl_strands_data. */
#define PTL_STRUCT_STRANDS_DATA 12

/** For ptl_abi_sizeof(): ptl_gradient_data. */
#define PTL_STRUCT_GRADIENT_DATA 13

/** For ptl_abi_sizeof(): ptl_text_data. */
#define PTL_STRUCT_TEXT_DATA 14

/** For ptl_abi_sizeof(): ptl_image_data. */
#define PTL_STRUCT_IMAGE_DATA 15

/** For ptl_abi_sizeof(): ptl_scan_report. */
#define PTL_STRUCT_SCAN_REPORT 16

/** For ptl_abi_sizeof(): ptl_band. */
#define PTL_STRUCT_BAND 17

/**
 * The version of the header's functions and structs. A library serves every program that was
 * built for the same number; within it, functions and fields are only added. It is also the
 * number at the end of the shared library's name.
 */
#define PTL_ABI_VERSION 0

/** A block type. It belongs to its engine and lives as long; any thread may read it. */
typedef struct ptl_block_type ptl_block_type;

/** Bytes that the library made. They have one owner and any thread may read them. */
typedef struct ptl_bytes ptl_bytes;

/** A request to stop computations, which any thread can make. It is reference counted. */
typedef struct ptl_cancel ptl_cancel;

/**
 * What computations share: the block types, the threads, the cache, the limits. It is reference
 * counted, and any thread may use it; graphs keep theirs alive.
 */
typedef struct ptl_engine ptl_engine;

/**
 * What went wrong, where, and what is allowed instead. It has one owner and any thread may read
 * it.
 */
typedef struct ptl_error ptl_error;

/**
 * A texture: blocks and their connections. It is reference counted. Functions that take it as
 * const may run on several threads at once; of those that change it, one at a time: a second one
 * gets PTL_E_BUSY. Changing a graph while it is being computed is fine, the computation has its
 * own copy.
 */
typedef struct ptl_graph ptl_graph;

/** A finished picture. It is reference counted, never changes, and any thread may read it. */
typedef struct ptl_image ptl_image;

/**
 * A computation on a thread of its own. It has one owner. ptl_job_poll() may run on several
 * threads at once; one thread at a time waits.
 */
typedef struct ptl_job ptl_job;

/**
 * What flows on a wire: a mesh, points, strands, a text, a colour transition or an image. It is
 * reference counted, never changes, and any thread may read it.
 */
typedef struct ptl_value ptl_value;

/**
 * What a call came to: PTL_OK, PTL_PENDING, or an error (PTL_E_...). The numbers never change;
 * later versions may add some, so treat every unknown number as an error.
 */
typedef int32_t ptl_status;

/**
 * A block of a graph; 0 is none. The handle of a removed block stays invalid, also when another
 * block takes its place. It means nothing in other graphs, except in clones of its own.
 */
typedef uint64_t ptl_block;

/**
 * One fault: of an error, or a warning of a graph file that was read. All texts are UTF-8 and live
 * as long as the error or the graph.
 */
typedef struct ptl_fault {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** What went wrong. */
    ptl_status status;
    /** Line in the file, from 1; 0 if it concerns no place of a file. */
    uint32_t line;
    /** Column in characters, from 1; 0 if it concerns no place of a file. */
    uint32_t column;
    /** The block that it concerns, or 0. */
    ptl_block block;
    /** The parameter that it concerns, or NULL. */
    const char *param;
    /** The whole message: place, fact, what is allowed, and a hint. */
    const char *message;
} ptl_fault;

/** How an engine is made. Every field that is 0 or NULL means: as usual. */
typedef struct ptl_engine_options {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** PTL_ENGINE_... flags. */
    uint32_t flags;
    /** The most threads of one computation, the caller's included; usually one per processor. */
    uint32_t threads;
    /** Must be 0. */
    uint32_t reserved0;
    /** Bytes that results kept for later computations may take; usually 256 MiB. */
    uint64_t cache_bytes;
    /** Limit: bytes that one computation may take at its peak. */
    uint64_t max_memory_bytes;
    /** Limit: bytes of a graph file. */
    uint64_t max_file_bytes;
    /** Limit: bytes of a file that a block reads. */
    uint64_t max_read_bytes;
    /** Limit: blocks of a graph file. */
    uint32_t max_blocks;
    /** Limit: connections of a graph file. */
    uint32_t max_connections;
    /** Limit: bytes of one text parameter in a graph file. */
    uint32_t max_text_bytes;
    /** Limit: symbols of the string of an L-system. */
    uint32_t max_text_symbols;
    /** Limit: width and height of an image, supersampling included. */
    uint32_t max_image_side;
    /** Limit: faults that are collected from one graph file. */
    uint32_t max_faults;
    /** Number of `read_folders`. */
    uint32_t read_folder_count;
    /** Number of `write_folders`. */
    uint32_t write_folder_count;
    /** Folders (UTF-8) below which every graph may read files, besides its own folder. */
    const char *const *read_folders;
    /** Folders (UTF-8) below which graphs may write files; usually they may not. */
    const char *const *write_folders;
} ptl_engine_options;

/**
 * Called with messages for the log: see ptl_engine_set_log(). `level` is one of PTL_LOG_...,
 * `message` is UTF-8 and valid during the call. No C++ or other exception may leave it.
 */
typedef void (PTL_CALL *ptl_log_fn)(int32_t level, const char *message, void *user_data);

/** Called when the library needs `user_data` no longer. */
typedef void (PTL_CALL *ptl_free_fn)(void *user_data);

/** What became of a file in which ptl_engine_scan_plugins() looked for a plug-in. */
typedef struct ptl_scan_report {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** PTL_OK if its block types can be used now; else why not. */
    ptl_status status;
    /** The file, or a folder that cannot be read. */
    const char *path;
    /** The id of the plug-in; empty after an error. */
    const char *plugin_id;
    /** Its version; empty after an error. */
    const char *plugin_version;
    /** The compiler that built it; empty if it does not say so, and after an error. */
    const char *built_with;
    /** What is wrong, and what to do; empty if nothing is. */
    const char *message;
    /** How many block types it has; 0 after an error. */
    uint32_t block_count;
    /** 0. */
    uint32_t reserved0;
} ptl_scan_report;

/**
 * Called for each file in which ptl_engine_scan_plugins() looked for a plug-in, on the thread that
 * called that. A nonzero result ends the search. `report` is valid during the call. No C++ or other
 * exception may leave it.
 */
typedef int32_t (PTL_CALL *ptl_scan_fn)(const ptl_scan_report *report, void *user_data);

/** A parameter of a block type. All texts are UTF-8 and live as long as the engine. */
typedef struct ptl_param_info {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** One of PTL_PARAM_... */
    uint32_t type;
    /** PTL_PARAM_READS_FILE or PTL_PARAM_WRITES_FILE of a path. */
    uint32_t flags;
    /** How many numbers it holds: 1, or 0 for texts and paths. */
    uint32_t components;
    /** Its id in files and in this interface. */
    const char *id;
    /** Its name for a user interface. */
    const char *name;
    /** What it does, in sentences. */
    const char *doc;
    /** What its number counts, such as "px"; empty for a plain number. */
    const char *unit;
    /** The smallest value allowed. */
    double min;
    /** The largest value allowed. */
    double max;
    /** The smallest usual value: where a slider starts. */
    double soft_min;
    /** The largest usual value: where a slider ends. */
    double soft_max;
    /** Distance of neighbouring values: 1 for whole numbers, 0 for any. */
    double step;
    /** What it holds unless somebody says otherwise, if that is a number. */
    double default_value[4];
    /** The same as a text, for every type. */
    const char *default_text;
    /** Alternatives of a choice: their ids, in the order of their numbers. */
    const char *const *enum_ids;
    /** Alternatives of a choice: what they mean. */
    const char *const *enum_docs;
    /** Number of alternatives. */
    uint32_t enum_count;
    /** Always 0. */
    uint32_t reserved0;
} ptl_param_info;

/** An input or an output of a block type. All texts are UTF-8 and live as long as the engine. */
typedef struct ptl_port_info {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** One of PTL_KIND_... */
    uint32_t kind;
    /** PTL_PORT_... flags. */
    uint32_t flags;
    /** Channels of an output image: 1 or 3; 0 if that depends on inputs or parameters. */
    uint32_t channels;
    /** Its id. */
    const char *id;
    /** Its name for a user interface. */
    const char *name;
} ptl_port_info;

/** What holds for a graph as a whole. */
typedef struct ptl_graph_info {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** Width of its results in pixels. */
    uint32_t width;
    /** Height of its results in pixels. */
    uint32_t height;
    /** Each pixel is the mean of this many times this many. */
    uint32_t supersampling;
    /** PTL_PRECISION_8BIT or PTL_PRECISION_FLOAT. */
    uint32_t precision;
    /** Number of its blocks. */
    uint32_t block_count;
    /** The seed of all blocks that have none of their own. */
    uint64_t seed;
} ptl_graph_info;

/**
 * How pixels are laid out: interleaved channels, rows from the top. Channels in the low byte,
 * bytes per channel in the next, then 1 if channels are floating-point numbers.
 */
typedef uint32_t ptl_format;

/** How far a computation is. */
typedef struct ptl_progress {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** The stage that runs, from 0. */
    uint32_t stage;
    /** Units of work that are done. */
    uint64_t units_done;
    /** All units of work. */
    uint64_t units_total;
    /** What is done, 0 to 1. */
    double fraction;
    /** The block whose output the stage makes. */
    ptl_block block;
} ptl_progress;

/**
 * Called with how far a computation is; a nonzero result cancels it.
 *
 * It is called only on the thread that is inside ptl_graph_compute(), ptl_graph_compute_into(),
 * ptl_graph_compute_bands(), ptl_graph_write_files() or ptl_job_wait(), at most every
 * progress_interval_ms and once at the end. It may call any function of this library. `progress`
 * is valid during the call. No C++ or other exception may leave it.
 */
typedef int32_t (PTL_CALL *ptl_progress_fn)(const ptl_progress *progress, void *user_data);

/**
 * How a computation differs from what the graph and the engine say. Every field that is 0 or NULL
 * means: as they say.
 */
typedef struct ptl_compute_options {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** PTL_COMPUTE_... flags. */
    uint32_t flags;
    /** Width of the result in pixels; give both or neither. */
    uint32_t width;
    /** Height of the result in pixels. */
    uint32_t height;
    /** One of PTL_FORMAT_... */
    ptl_format format;
    /** The most threads, the caller's included. */
    uint32_t threads;
    /** The seed of blocks without their own, with the flag PTL_COMPUTE_SEED. */
    uint64_t seed;
    /** The most bytes to take at the peak. */
    uint64_t memory_limit;
    /** Must be 0. */
    double region[4];
    /** The least time between two calls of `progress`; 0 for 50 ms. */
    uint32_t progress_interval_ms;
    /** Each pixel is the mean of this many times this many, 1 to 6. */
    uint32_t supersampling;
    /** One of PTL_PRECISION_... */
    uint32_t precision;
    /** Must be 0. */
    uint32_t reserved0;
    /** A request to stop; kept as long as the computation runs. */
    ptl_cancel *cancel;
    /** Called with how far the computation is. */
    ptl_progress_fn progress;
    /** Given to `progress`. It must stay valid until the call returns, or the job is released. */
    void *user_data;
    /** Must be NULL. */
    void *reserved1;
} ptl_compute_options;

/** Rows of a result that are done: see ptl_graph_compute_bands(). */
typedef struct ptl_band {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** The number of the first row in the result, from the top. */
    uint32_t first_row;
    /** How many rows there are. */
    uint32_t rows;
    /** Pixels of a row. */
    uint32_t width;
    /** One of PTL_FORMAT_..., never PTL_FORMAT_AUTO. */
    ptl_format format;
    /** 0. */
    uint32_t reserved0;
    /** Bytes from one row to the next. */
    size_t row_stride;
    /** The pixels: rows * row_stride bytes, rows without gaps. */
    const void *pixels;
} ptl_band;

/**
 * Called with one band of a result after the other, from the top to the bottom; a nonzero result
 * cancels the computation.
 *
 * It is called only on the thread that is inside ptl_graph_compute_bands(). It may call any
 * function of this library. `band` and its pixels are valid during the call. No C++ or other
 * exception may leave it.
 */
typedef int32_t (PTL_CALL *ptl_band_fn)(const ptl_band *band, void *user_data);

/** What an image is. */
typedef struct ptl_image_info {
    /** Size of this struct in bytes. */
    uint32_t struct_size;
    /** One of PTL_FORMAT_..., never PTL_FORMAT_AUTO. */
    ptl_format format;
    /** Width in pixels. */
    uint32_t width;
    /** Height in pixels. */
    uint32_t height;
    /** 1 (grey), 3 (red, green, blue) or 4 (and alpha). */
    uint32_t channels;
    /** 1, 2 or 4. */
    uint32_t bytes_per_channel;
    /** PTL_COLOR_SPACE_SRGB. */
    uint32_t color_space;
    /** PTL_ORIGIN_TOP_LEFT. */
    uint32_t origin;
    /** Bytes from one row to the next; rows have no gaps. */
    size_t row_stride;
    /** Bytes of all pixels. */
    size_t size_bytes;
} ptl_image_info;

/** Done. */
#define PTL_OK 0

/** Not done yet: only from ptl_job_poll() and ptl_job_wait(). */
#define PTL_PENDING 1

/** The caller asked to stop. */
#define PTL_E_CANCELLED 2

/** An argument makes no sense; the message names it. */
#define PTL_E_INVALID_ARGUMENT 3

/** This version or build cannot do that. */
#define PTL_E_UNSUPPORTED 4

/** The system has no memory left. */
#define PTL_E_NO_MEMORY 5

/** Another thread is changing the object. */
#define PTL_E_BUSY 6

/** No block, parameter, port or type of that name. */
#define PTL_E_NOT_FOUND 7

/** The block was removed from its graph, or never was in it. */
#define PTL_E_STALE_HANDLE 8

/** A value or a connection of the wrong kind. */
#define PTL_E_TYPE_MISMATCH 9

/** The connection would make a block depend on itself. */
#define PTL_E_CYCLE 10

/** A required input is not connected. */
#define PTL_E_UNCONNECTED 11

/** A number outside its range. */
#define PTL_E_OUT_OF_RANGE 12

/** A text or file that does not follow its grammar. */
#define PTL_E_PARSE 13

/** A file could not be read or written. */
#define PTL_E_IO 14

/** More than the limits of the engine allow. */
#define PTL_E_LIMIT 15

/** The caller's buffer is too small; the message says what is needed. */
#define PTL_E_BUFFER_TOO_SMALL 16

/** The file policy forbids it; the message says how to allow it. */
#define PTL_E_DENIED 17

/** The system cannot load the file of a plug-in: it is no library, or misses another one. */
#define PTL_E_PLUGIN_LOAD 20

/** The plug-in was built for another version of the plug-in contract. */
#define PTL_E_PLUGIN_ABI 21

/** Another plug-in has block types of that id. */
#define PTL_E_PLUGIN_DUPLICATE 22

/** A block of a plug-in panicked or threw an exception. */
#define PTL_E_PLUGIN_PANIC 23

/** The tables of a Rust plug-in are laid out in another way than here. */
#define PTL_E_PLUGIN_LAYOUT 24

/** The file is a library, but no plug-in. */
#define PTL_E_PLUGIN_SYMBOL 25

/** The plug-in could not be initialised. */
#define PTL_E_PLUGIN_INIT 26

/** The plug-in describes itself wrongly; the message names the field. */
#define PTL_E_PLUGIN_DESCRIPTOR 27

/** A block of a plug-in says that it failed. */
#define PTL_E_PLUGIN_FAILED 28

/** A defect of this library or of a block. The program may go on. */
#define PTL_E_INTERNAL 99

/**
 * As many channels as the output has; 8 bits each if values are computed in 8 bits, 32-bit
 * floating-point numbers otherwise. It loses nothing.
 */
#define PTL_FORMAT_AUTO 0

/** One byte a pixel. */
#define PTL_FORMAT_GREY8 257

/** Red, green, blue: a byte each. */
#define PTL_FORMAT_RGB8 259

/** Red, green, blue, alpha: a byte each. */
#define PTL_FORMAT_RGBA8 260

/** One 16-bit number in the machine's byte order. */
#define PTL_FORMAT_GREY16 513

/** Three 16-bit numbers. */
#define PTL_FORMAT_RGB16 515

/** Four 16-bit numbers. */
#define PTL_FORMAT_RGBA16 516

/** One float. */
#define PTL_FORMAT_GREY_F32 66561

/** Three floats. */
#define PTL_FORMAT_RGB_F32 66563

/** Four floats. */
#define PTL_FORMAT_RGBA_F32 66564

/**
 * The name of a status, such as "PTL_E_NOT_FOUND"; "unknown status" for other numbers.
 *
 * Ownership: the text is static.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_status_name(ptl_status status);

/**
 * The version of the library as one number: major * 1000000 + minor * 1000 + patch.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_version_number(void);

/**
 * The version of the library as a text, such as "0.1.0".
 *
 * Ownership: the text is static.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_version_string(void);

/**
 * The library's PTL_ABI_VERSION. Programs that load the library at run time compare it with the
 * one that they were built with.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_abi_version(void);

/**
 * Whether this build has a feature, 1 or 0: "formats" (ptl_image_save() writes other files than
 * PNG: all that there are), or one of them: "png", "exr", "tiff", "jpeg", "webp", "bmp", "tga",
 * "qoi", "pnm". Unknown names are 0.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API int32_t PTL_CALL ptl_has_feature(const char *name);

/**
 * The size in bytes that the library has for a struct (PTL_STRUCT_...); 0 for unknown ones. For
 * the tests of bindings.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API size_t PTL_CALL ptl_abi_sizeof(uint32_t struct_id);

/**
 * The status that came with the error; PTL_OK for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_status PTL_CALL ptl_error_status(const ptl_error *error);

/**
 * What went wrong, in English, one line a fault: place, fact, what is allowed. NULL for NULL.
 *
 * Ownership: the text lives as long as the error.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_error_message(const ptl_error *error);

/**
 * The block that the error concerns; 0 if it concerns none.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_block PTL_CALL ptl_error_block(const ptl_error *error);

/**
 * The id of the parameter that the error concerns; NULL if it concerns none.
 *
 * Ownership: the text lives as long as the error.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_error_param(const ptl_error *error);

/**
 * The number of faults: a graph file may have many, other errors have one. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_error_fault_count(const ptl_error *error);

/**
 * Fills in fault number `index`.
 *
 * Ownership: the texts live as long as the error.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_error_fault_at(
    const ptl_error *error,
    uint32_t index,
    ptl_fault *inout);

/**
 * Frees an error; NULL is fine.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_error_release(ptl_error *error);

/**
 * Makes all fields 0, which means "as usual", and sets `struct_size`. Call it as
 * PTL_ENGINE_OPTIONS_INIT(&options), which gives the size that your program was built with.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_engine_options_init(ptl_engine_options *options, size_t struct_size);

/**
 * Makes an engine with the built-in block types. `options` may be NULL.
 *
 * Ownership: `out` receives one reference; release it with ptl_engine_release(). Nothing of
 *            `options` is kept.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_engine_create(
    const ptl_engine_options *options,
    ptl_engine **out,
    ptl_error **error);

/**
 * One more reference to the same engine; NULL for NULL.
 *
 * Ownership: release each reference with ptl_engine_release().
 * Threads:   any.
 * Since:     0.1
 */
PTL_API ptl_engine *PTL_CALL ptl_engine_retain(ptl_engine *engine);

/**
 * Gives up one reference; NULL is fine. The engine lives on as long as one of its graphs.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_engine_release(ptl_engine *engine);

/**
 * Sets the function that gets the engine's messages of `min_level` (PTL_LOG_...) and above, such
 * as the warnings of graph files that are read; NULL for none. It replaces the one before.
 *
 * Ownership: `free_user_data` (may be NULL) is called once, when `user_data` is needed no longer:
 *            after the function was replaced, with the last reference to the engine, or at once
 *            if `log` is NULL. After an error it is not called.
 * Threads:   any. The function is called on threads that are inside a call that concerns this
 *            engine and on those of its jobs, possibly on several at once.
 * Errors:    PTL_E_INVALID_ARGUMENT.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_engine_set_log(
    ptl_engine *engine,
    int32_t min_level,
    ptl_log_fn log,
    void *user_data,
    ptl_free_fn free_user_data,
    ptl_error **error);

/**
 * Loads a plug-in from a file, and adds its block types to the engine. `path` is UTF-8 and ends
 * with ".ptplugin.so" (".dll", ".dylib"). This runs code of the file with all rights of your
 * program: only load what you trust. Loading one again changes nothing. Plug-ins are never
 * unloaded.
 *
 * Threads: any; graphs of the engine may be computed meanwhile.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_PLUGIN_LOAD if the system cannot load the file (the
 *          message has all causes), PTL_E_PLUGIN_SYMBOL if it is no plug-in, PTL_E_PLUGIN_LAYOUT,
 *          PTL_E_PLUGIN_ABI, PTL_E_PLUGIN_DESCRIPTOR, PTL_E_PLUGIN_INIT, PTL_E_PLUGIN_DUPLICATE
 *          if another one has a block type of the same id (the message names both).
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_engine_load_plugin(
    ptl_engine *engine,
    const char *path,
    ptl_error **error);

/**
 * Loads every plug-in in some folders, and adds their block types to the engine: see
 * ptl_engine_load_plugin(). `folders` are separated as in PATH; NULL for the usual ones: those of
 * the variable PTLIB_PLUGIN_PATH, that of the user, that of the system. Only files whose names end
 * with ".ptplugin.so" (".dll", ".dylib") are opened. A file that is refused does not end the
 * search, nor is it an error of this function: `report` (may be NULL) hears of each file. Of two
 * plug-ins with a block type of one id, the first wins.
 *
 * Threads: any; graphs of the engine may be computed meanwhile.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_CANCELLED if `report` ended the search.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_engine_scan_plugins(
    ptl_engine *engine,
    const char *folders,
    ptl_scan_fn report,
    void *user_data,
    ptl_error **error);

/**
 * Adds the block types of a plug-in that is linked into your program: `entry` is its ptlp_entry of
 * ptlib_plugin.h. Adding one again changes nothing.
 *
 * Ownership: the tables are borrowed for as long as the process lives.
 * Threads:   any; graphs of the engine may be computed meanwhile.
 * Errors:    PTL_E_PLUGIN_ABI, PTL_E_PLUGIN_DESCRIPTOR, PTL_E_PLUGIN_INIT, PTL_E_PLUGIN_DUPLICATE.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_engine_register_plugin(
    ptl_engine *engine,
    const struct ptlp_entry *entry,
    ptl_error **error);

/**
 * The number of block types; plug-ins add some. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_engine_block_type_count(const ptl_engine *engine);

/**
 * Block type number `index`: the built-in ones by family, then those of plug-ins in the order in
 * which they came. NULL if there is none.
 *
 * Ownership: it lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const ptl_block_type *PTL_CALL ptl_engine_block_type_at(
    const ptl_engine *engine,
    uint32_t index);

/**
 * The block type of that id, such as "perlin noise"; NULL if there is none.
 *
 * Ownership: it lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const ptl_block_type *PTL_CALL ptl_engine_find_block_type(
    const ptl_engine *engine,
    const char *id);

/**
 * The id of a block type in files and in this interface. NULL for NULL.
 *
 * Ownership: the text lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_block_type_id(const ptl_block_type *block_type);

/**
 * The name of a block type for a user interface. NULL for NULL.
 *
 * Ownership: the text lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_block_type_name(const ptl_block_type *block_type);

/**
 * The family of a block type, such as "noise". NULL for NULL.
 *
 * Ownership: the text lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_block_type_category(const ptl_block_type *block_type);

/**
 * What a block type makes, in a sentence. NULL for NULL.
 *
 * Ownership: the text lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_block_type_doc(const ptl_block_type *block_type);

/**
 * The id of the plug-in that a block type comes from; empty for built-in ones. NULL for NULL.
 *
 * Ownership: the text lives as long as the engine.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const char *PTL_CALL ptl_block_type_plugin(const ptl_block_type *block_type);

/**
 * PTL_BLOCK_... flags of a block type. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_block_type_flags(const ptl_block_type *block_type);

/**
 * The number of parameters of a block type. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_block_type_param_count(const ptl_block_type *block_type);

/**
 * The number of inputs of a block type. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_block_type_input_count(const ptl_block_type *block_type);

/**
 * The number of outputs of a block type. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_block_type_output_count(const ptl_block_type *block_type);

/**
 * Fills in parameter number `index`.
 *
 * Ownership: the texts live as long as the engine.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_block_type_param_info(
    const ptl_block_type *block_type,
    uint32_t index,
    ptl_param_info *inout);

/**
 * Fills in input number `index`.
 *
 * Ownership: the texts live as long as the engine.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_block_type_input_info(
    const ptl_block_type *block_type,
    uint32_t index,
    ptl_port_info *inout);

/**
 * Fills in output number `index`.
 *
 * Ownership: the texts live as long as the engine.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_block_type_output_info(
    const ptl_block_type *block_type,
    uint32_t index,
    ptl_port_info *inout);

/**
 * Makes an empty graph.
 *
 * Ownership: `out` receives one reference; release it with ptl_graph_release(). The graph keeps
 *            the engine alive.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_create(
    ptl_engine *engine,
    ptl_graph **out,
    ptl_error **error);

/**
 * Copies a graph; blocks keep their handles in the copy. It costs nothing until one of the two is
 * changed.
 *
 * Ownership: `out` receives one reference; release it with ptl_graph_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_clone(
    const ptl_graph *graph,
    ptl_graph **out,
    ptl_error **error);

/**
 * Reads the contents of a graph file. Its blocks may read files only after
 * ptl_graph_set_folder(), or below the engine's `read_folders`.
 *
 * Ownership: `out` receives one reference; release it with ptl_graph_release(). `data` is not
 *            kept.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_PARSE with all faults of the file (see
 *            ptl_error_fault_at()), PTL_E_LIMIT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_load(
    ptl_engine *engine,
    const void *data,
    size_t size,
    ptl_graph **out,
    ptl_error **error);

/**
 * Reads a graph file. Its blocks may read files below its folder. `path` is UTF-8.
 *
 * Ownership: `out` receives one reference; release it with ptl_graph_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_IO, PTL_E_PARSE with all faults of the file (see
 *            ptl_error_fault_at()), PTL_E_LIMIT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_load_file(
    ptl_engine *engine,
    const char *path,
    ptl_graph **out,
    ptl_error **error);

/**
 * The graph as the contents of a file. Nothing that its file said is lost.
 *
 * Ownership: `out` receives the bytes; release them with ptl_bytes_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_save(
    const ptl_graph *graph,
    ptl_bytes **out,
    ptl_error **error);

/**
 * One more reference to the same graph; NULL for NULL.
 *
 * Ownership: release each reference with ptl_graph_release().
 * Threads:   any.
 * Since:     0.1
 */
PTL_API ptl_graph *PTL_CALL ptl_graph_retain(ptl_graph *graph);

/**
 * Gives up one reference; NULL is fine. Computations of the graph go on.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_graph_release(ptl_graph *graph);

/**
 * The number of warnings of the file that the graph was read from: what the file says and the
 * graph does not follow. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_graph_warning_count(const ptl_graph *graph);

/**
 * Fills in warning number `index`.
 *
 * Ownership: the texts live as long as the graph.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_warning_at(
    const ptl_graph *graph,
    uint32_t index,
    ptl_fault *inout);

/**
 * Fills in what holds for the graph as a whole.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_get_info(
    const ptl_graph *graph,
    ptl_graph_info *inout,
    ptl_error **error);

/**
 * Sets the size of the graph's results in pixels.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_size(
    ptl_graph *graph,
    uint32_t width,
    uint32_t height,
    ptl_error **error);

/**
 * Sets the seed of all blocks that have none of their own.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_seed(
    ptl_graph *graph,
    uint64_t seed,
    ptl_error **error);

/**
 * Makes each pixel of the results the mean of `level` times `level`, 1 to 6.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_supersampling(
    ptl_graph *graph,
    uint32_t level,
    ptl_error **error);

/**
 * Sets what values are computed in: PTL_PRECISION_8BIT or PTL_PRECISION_FLOAT.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_precision(
    ptl_graph *graph,
    uint32_t precision,
    ptl_error **error);

/**
 * Sets the folder (UTF-8) that paths in parameters are relative to and that blocks may read files
 * below; NULL for a graph that reads no files.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_folder(
    ptl_graph *graph,
    const char *folder,
    ptl_error **error);

/**
 * Adds a block of type `type_id`, such as "perlin noise", with default parameters.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_NOT_FOUND, PTL_E_BUSY. On error `out` is untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_add_block(
    ptl_graph *graph,
    const char *type_id,
    ptl_block *out,
    ptl_error **error);

/**
 * Removes a block and all its connections.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_remove_block(
    ptl_graph *graph,
    ptl_block block,
    ptl_error **error);

/**
 * The number of blocks. 0 for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_graph_block_count(const ptl_graph *graph);

/**
 * Block number `index`, in file order; 0 if there is none.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_block PTL_CALL ptl_graph_block_at(const ptl_graph *graph, uint32_t index);

/**
 * The first block, in file order, whose id in the graph's file is `file_id`; 0 if there is none.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_block PTL_CALL ptl_graph_find_block(const ptl_graph *graph, const char *file_id);

/**
 * The result to take when one is wanted: the last block of type "end" in file order; 0 if there
 * is none.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_block PTL_CALL ptl_graph_main_result(const ptl_graph *graph);

/**
 * The type of a block.
 *
 * Ownership: `*out` lives as long as the graph and its engine.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if its type is unknown
 *            (its plug-in is missing). On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_block_type(
    const ptl_graph *graph,
    ptl_block block,
    const ptl_block_type **out,
    ptl_error **error);

/**
 * The id of a block in the graph's file.
 *
 * Ownership: `out` receives the text; release it with ptl_bytes_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_block_id(
    const ptl_graph *graph,
    ptl_block block,
    ptl_bytes **out,
    ptl_error **error);

/**
 * The id of a block's type, also of an unknown type.
 *
 * Ownership: `out` receives the text; release it with ptl_bytes_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_block_type_id(
    const ptl_graph *graph,
    ptl_block block,
    ptl_bytes **out,
    ptl_error **error);

/**
 * Connects output `out_port` of `src` with input `in_port` of `dst`; ports count from 0. What was
 * connected there before is replaced.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port,
 *          PTL_E_TYPE_MISMATCH if the ports are of different kinds, PTL_E_CYCLE if `dst` would
 *          depend on itself, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_connect(
    ptl_graph *graph,
    ptl_block src,
    uint32_t out_port,
    ptl_block dst,
    uint32_t in_port,
    ptl_error **error);

/**
 * Removes what is connected to an input; fine if nothing is.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port,
 *          PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_disconnect(
    ptl_graph *graph,
    ptl_block dst,
    uint32_t in_port,
    ptl_error **error);

/**
 * What is connected to an input: `*src` is the block and `*out_port` its output; `*src` is 0 if
 * nothing is.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND if there is no such port.
 *          On error both are untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_input_source(
    const ptl_graph *graph,
    ptl_block dst,
    uint32_t in_port,
    ptl_block *src,
    uint32_t *out_port,
    ptl_error **error);

/**
 * Checks whether `output` can be computed, as far as the graph alone tells: every type that it
 * needs is known, every required input is connected, every connection is of the right kind.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_UNCONNECTED, PTL_E_TYPE_MISMATCH,
 *          PTL_E_NOT_FOUND: the first fault's; ptl_error_fault_at() tells all.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_validate(
    const ptl_graph *graph,
    ptl_block output,
    ptl_error **error);

/**
 * Sets a number. `count` is 1: every parameter holds one number so far.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
 *          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_float(
    ptl_graph *graph,
    ptl_block block,
    const char *param,
    const double *values,
    uint32_t count,
    ptl_error **error);

/**
 * Sets a whole number, a flag (0 or not) or a choice (by number).
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
 *          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_int(
    ptl_graph *graph,
    ptl_block block,
    const char *param,
    int64_t value,
    ptl_error **error);

/**
 * Sets a parameter of any type from a text: a number, "true" or "false", the id or the number of
 * an alternative, or the text itself.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_PARSE,
 *          PTL_E_OUT_OF_RANGE, PTL_E_BUSY. On error the parameter keeps its value.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_text(
    ptl_graph *graph,
    ptl_block block,
    const char *param,
    const char *utf8,
    ptl_error **error);

/**
 * Sets a parameter to its default.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_reset_param(
    ptl_graph *graph,
    ptl_block block,
    const char *param,
    ptl_error **error);

/**
 * The value of a parameter that is a number, a flag or a choice. `capacity` is the number of
 * `values` that there is room for; `*count` (may be NULL) becomes the number that it holds.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH,
 *          PTL_E_BUFFER_TOO_SMALL. On error `values` and `count` are untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_get_float(
    const ptl_graph *graph,
    ptl_block block,
    const char *param,
    double *values,
    uint32_t capacity,
    uint32_t *count,
    ptl_error **error);

/**
 * The value of a parameter that is a whole number, a flag (0 or 1) or a choice (its number).
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_TYPE_MISMATCH. On
 *          error `out` is untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_get_int(
    const ptl_graph *graph,
    ptl_block block,
    const char *param,
    int64_t *out,
    ptl_error **error);

/**
 * The value of a parameter of any type as a text: a choice as the id of its alternative. The text
 * is what ptl_graph_set_text() takes.
 *
 * Ownership: `out` receives the text; release it with ptl_bytes_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND. On error `*out` is
 *            NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_get_text(
    const ptl_graph *graph,
    ptl_block block,
    const char *param,
    ptl_bytes **out,
    ptl_error **error);

/**
 * Gives a block its own seed.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_block_seed(
    ptl_graph *graph,
    ptl_block block,
    uint64_t seed,
    ptl_error **error);

/**
 * Lets a block follow the seed of the graph again.
 *
 * Threads: one at a time changes a graph.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_BUSY.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_reset_block_seed(
    ptl_graph *graph,
    ptl_block block,
    ptl_error **error);

/**
 * The seed of a block: `*seed` is its own, or the graph's; `*is_own` (may be NULL) is 1 if it has
 * its own, else 0.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE. On error both are untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_get_block_seed(
    const ptl_graph *graph,
    ptl_block block,
    uint64_t *seed,
    int32_t *is_own,
    ptl_error **error);

/**
 * Makes all fields 0, which means "as the graph and the engine say", and sets `struct_size`. Call
 * it as PTL_COMPUTE_OPTIONS_INIT(&options), which gives the size that your program was built
 * with.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_compute_options_init(ptl_compute_options *options, size_t struct_size);

/**
 * Computes one output of a block and returns a new image. The graph is copied first (that costs
 * nothing): later changes do not affect this call. `options` may be NULL.
 *
 * Ownership: `out` receives one reference; release it with ptl_image_release(). Nothing of
 *            `options` is kept.
 * Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
 *            thread only.
 * Cancel:    ptl_cancel_request() or a nonzero result of the callback; returns PTL_E_CANCELLED,
 *            normally within milliseconds.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_NOT_FOUND, PTL_E_UNCONNECTED,
 *            PTL_E_TYPE_MISMATCH, PTL_E_OUT_OF_RANGE, PTL_E_LIMIT, PTL_E_NO_MEMORY, PTL_E_DENIED,
 *            PTL_E_IO, PTL_E_UNSUPPORTED, PTL_E_CANCELLED, PTL_E_INTERNAL. On error `*out` is
 *            NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_compute(
    const ptl_graph *graph,
    ptl_block block,
    uint32_t out_port,
    const ptl_compute_options *options,
    ptl_image **out,
    ptl_error **error);

/**
 * Computes one output of a block into pixels of the caller: `size` bytes, rows of `row_stride`
 * bytes (0: rows without gaps). Of ptl_graph_compute() it differs in that and in needing less
 * memory.
 *
 * Ownership: the pixels stay the caller's. Nothing of `options` is kept.
 * Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
 *            thread only.
 * Cancel:    as ptl_graph_compute().
 * Errors:    as ptl_graph_compute(), and PTL_E_BUFFER_TOO_SMALL. After an error that comes before
 *            anything is computed the pixels are untouched, after others partly written; bytes
 *            between rows are never written.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_compute_into(
    const ptl_graph *graph,
    ptl_block block,
    uint32_t out_port,
    const ptl_compute_options *options,
    void *pixels,
    size_t size,
    size_t row_stride,
    ptl_error **error);

/**
 * Computes one output of a block and hands it to `on_band` in bands of `band_rows` rows (0: as
 * many as serve well; the last band may have fewer), from the top to the bottom. The result is
 * never in memory as a whole, so it may be larger than that: an image of 16384 x 16384 passes
 * through some 10 MiB, unless its blocks have to keep whole images. `options` may be NULL.
 *
 * Ownership: pixels are valid during the call of `on_band`. Nothing of `options` is kept.
 * Threads:   any; several computations of one graph may run at once. Callbacks run on the calling
 *            thread only.
 * Cancel:    as ptl_graph_compute(), and a nonzero result of `on_band`.
 * Errors:    as ptl_graph_compute(). Bands may have been handed over before; with
 *            PTL_COMPUTE_KEEP_GOING, a white image stands for a block from the band on in which it
 *            fails.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_compute_bands(
    const ptl_graph *graph,
    ptl_block block,
    uint32_t out_port,
    const ptl_compute_options *options,
    uint32_t band_rows,
    ptl_band_fn on_band,
    void *user_data,
    ptl_error **error);

/**
 * Computes the graph and lets its blocks of type "save file" write their pictures, below the
 * `write_folders` of the engine's options. Nothing happens in a graph without such blocks.
 * `options` may be NULL; its format does not count.
 *
 * Ownership: nothing of `options` is kept.
 * Threads:   any. Callbacks run on the calling thread only.
 * Cancel:    as ptl_graph_compute(). Nothing is written before everything is computed.
 * Errors:    as ptl_graph_compute(), PTL_E_DENIED before anything is computed if a file may not
 *            be written.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_write_files(
    const ptl_graph *graph,
    const ptl_compute_options *options,
    ptl_error **error);

/**
 * Starts computing one output of a block on a thread of its own. The graph is copied first: later
 * changes do not affect the job. `options` may be NULL; its callback is called inside
 * ptl_job_wait() only.
 *
 * Ownership: `out` receives the job; release it with ptl_job_release(). Of `options`, the cancel
 *            request is kept (its reference stays the caller's), and `user_data` must stay valid
 *            until the job is released.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED, PTL_E_NO_MEMORY; what is wrong with the
 *            graph is told by ptl_job_wait(). On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_compute_start(
    const ptl_graph *graph,
    ptl_block block,
    uint32_t out_port,
    const ptl_compute_options *options,
    ptl_job **out,
    ptl_error **error);

/**
 * How far a job is, without waiting: PTL_OK if it has ended (well or not: ptl_job_wait() tells),
 * PTL_PENDING if not. `inout` may be NULL.
 *
 * Threads: any, several at once.
 * Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_job_poll(const ptl_job *job, ptl_progress *inout);

/**
 * Waits for a job at most `timeout_ms` milliseconds (negative: as long as it takes) and gives its
 * image. PTL_PENDING if it has not ended; call again. After the end every call gives the same.
 *
 * Ownership: `out` receives one reference with each PTL_OK; release it with ptl_image_release().
 * Threads:   one at a time. The callback of the job runs on this thread.
 * Cancel:    as ptl_graph_compute().
 * Errors:    as ptl_graph_compute(), and PTL_E_BUSY if another thread waits. On error, and with
 *            PTL_PENDING, `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_job_wait(
    ptl_job *job,
    int64_t timeout_ms,
    ptl_image **out,
    ptl_error **error);

/**
 * Cancels a job that has not ended, waits for its thread, and frees it; NULL is fine. Images that
 * ptl_job_wait() gave stay valid.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_job_release(ptl_job *job);

/**
 * Makes a request to stop that nobody has made yet. Give it to computations in their options.
 *
 * Ownership: `out` receives one reference; release it with ptl_cancel_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_cancel_create(ptl_cancel **out, ptl_error **error);

/**
 * Asks every computation that was given this request to stop. It stays asked. NULL is fine.
 *
 * Threads: any; it takes no lock and does not wait.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_cancel_request(ptl_cancel *cancel);

/**
 * Whether somebody asked, 1 or 0. 0 for NULL.
 *
 * Threads: any; it takes no lock.
 * Since:   0.1
 */
PTL_API int32_t PTL_CALL ptl_cancel_is_requested(const ptl_cancel *cancel);

/**
 * One more reference to the same request; NULL for NULL.
 *
 * Ownership: release each reference with ptl_cancel_release().
 * Threads:   any.
 * Since:     0.1
 */
PTL_API ptl_cancel *PTL_CALL ptl_cancel_retain(ptl_cancel *cancel);

/**
 * Gives up one reference; NULL is fine. Computations that were given the request go on.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_cancel_release(ptl_cancel *cancel);

/**
 * Fills in what the image is.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT. On error `inout` is untouched.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_image_get_info(
    const ptl_image *image,
    ptl_image_info *inout);

/**
 * The pixels in the format of the image, 64-byte aligned, rows without gaps. They are made by the
 * first call. `size` may be NULL. NULL and size 0 for NULL, or if there is no memory for them.
 *
 * Ownership: they live as long as the image, and nobody may change them.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const void *PTL_CALL ptl_image_pixels(const ptl_image *image, size_t *size);

/**
 * Copies the pixels in any format (PTL_FORMAT_AUTO: the image's own) to `dst`, which has `size`
 * bytes, rows of `row_stride` bytes (0: rows without gaps). A colour becomes grey by its mean, a
 * missing alpha is 1.
 *
 * Ownership: `dst` stays the caller's; bytes between rows are not written.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_BUFFER_TOO_SMALL. On error `dst` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_image_copy(
    const ptl_image *image,
    ptl_format format,
    void *dst,
    size_t size,
    size_t row_stride,
    ptl_error **error);

/**
 * Saves the image as a picture; `path` is UTF-8 and its ending tells the format: ".png" always,
 * others if ptl_has_feature("formats"). Images of 8 bits a channel are saved so, others with 16
 * bits or as floating-point numbers, where the format has them. An existing file is overwritten.
 *
 * Threads: any.
 * Errors:  PTL_E_INVALID_ARGUMENT, PTL_E_UNSUPPORTED, PTL_E_IO.
 * Since:   0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_image_save(
    const ptl_image *image,
    const char *path,
    ptl_error **error);

/**
 * One more reference to the same image; NULL for NULL.
 *
 * Ownership: release each reference with ptl_image_release().
 * Threads:   any.
 * Since:     0.1
 */
PTL_API ptl_image *PTL_CALL ptl_image_retain(ptl_image *image);

/**
 * Gives up one reference; NULL is fine.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_image_release(ptl_image *image);

/**
 * Makes a mesh of the caller's triangles, checked: every number is finite, every index is the
 * number of a vertex, and so on; ptlib_values.h says what streams there are. Normals of another
 * length than 1 are made so. Bounds are computed, whatever those given are.
 *
 * Ownership: without PTL_VALUE_BORROW the data is copied during the call. With it the indices and
 *            the data of the streams stay the caller's and must not change until `free` is
 *            called; the structs are needed during the call only. `free`, which may be NULL, is
 *            called exactly once with `user_data`, from any thread: when the data is needed no
 *            longer, also if it was copied, and also when the call fails. `out` receives one
 *            reference; release it with ptl_value_release().
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE with the first wrong element and how many
 *            there are, PTL_E_LIMIT, PTL_E_NO_MEMORY, PTL_E_UNSUPPORTED. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_mesh(
    const ptl_mesh_data *mesh,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * Makes points of the caller's, checked.
 *
 * Ownership: as ptl_value_from_mesh().
 * Threads:   any.
 * Errors:    as ptl_value_from_mesh(); a normal or a direction without length is one.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_points(
    const ptl_points_data *points,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * Makes strands of the caller's polylines, checked.
 *
 * Ownership: as ptl_value_from_mesh().
 * Threads:   any.
 * Errors:    as ptl_value_from_mesh(); a normal or a direction without length is one.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_strands(
    const ptl_strands_data *strands,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * Makes a text.
 *
 * Ownership: as ptl_value_from_mesh(), but the text is always copied during the call.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_LIMIT, PTL_E_UNSUPPORTED. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_text(
    const ptl_text_data *text,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * Makes a colour transition. Its stops may be in any order; of those at one position the first
 * counts. Without stops it is a middle grey.
 *
 * Ownership: as ptl_value_from_mesh(), but the stops are always copied during the call.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE, PTL_E_LIMIT, PTL_E_UNSUPPORTED. On error
 *            `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_gradient(
    const ptl_gradient_data *gradient,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * Makes an image of the caller's pixels, which need no alignment.
 *
 * Ownership: as ptl_value_from_mesh(), but the pixels are always converted during the call.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_OUT_OF_RANGE if a number is not finite, PTL_E_LIMIT,
 *            PTL_E_NO_MEMORY, PTL_E_UNSUPPORTED. On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_from_image(
    const ptl_image_data *image,
    uint32_t flags,
    ptl_free_fn free,
    void *user_data,
    ptl_value **out,
    ptl_error **error);

/**
 * What the value is: one of PTL_KIND_...; PTL_KIND_NONE for NULL.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API uint32_t PTL_CALL ptl_value_kind(const ptl_value *value);

/**
 * One more reference to the same value; NULL for NULL.
 *
 * Ownership: release each reference with ptl_value_release().
 * Threads:   any.
 * Since:     0.1
 */
PTL_API ptl_value *PTL_CALL ptl_value_retain(ptl_value *value);

/**
 * Gives up one reference; NULL is fine.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_value_release(ptl_value *value);

/**
 * Fills in where the data of a mesh is: nothing is copied.
 *
 * Ownership: everything that it points to lives as long as the value, and nobody may change it.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH if it is no mesh. On error `inout` is
 *            untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_mesh(
    const ptl_value *value,
    ptl_mesh_data *inout,
    ptl_error **error);

/**
 * Fills in where the data of points is: nothing is copied.
 *
 * Ownership: everything that it points to lives as long as the value, and nobody may change it.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_points(
    const ptl_value *value,
    ptl_points_data *inout,
    ptl_error **error);

/**
 * Fills in where the data of strands is: nothing is copied.
 *
 * Ownership: everything that it points to lives as long as the value, and nobody may change it.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_strands(
    const ptl_value *value,
    ptl_strands_data *inout,
    ptl_error **error);

/**
 * Fills in where a text is; it has a NUL behind it that does not count.
 *
 * Ownership: it lives as long as the value.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_text(
    const ptl_value *value,
    ptl_text_data *inout,
    ptl_error **error);

/**
 * Fills in where the stops of a colour transition are, by rising position.
 *
 * Ownership: they live as long as the value.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH. On error `inout` is untouched.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_gradient(
    const ptl_value *value,
    ptl_gradient_data *inout,
    ptl_error **error);

/**
 * The image of a value, in any format (PTL_FORMAT_AUTO: floats, as many channels as it has).
 *
 * Ownership: `out` receives one reference; release it with ptl_image_release(). It does not need
 *            the value any more.
 * Threads:   any.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_TYPE_MISMATCH, PTL_E_NO_MEMORY. On error `*out` is
 *            NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_value_image(
    const ptl_value *value,
    ptl_format format,
    ptl_image **out,
    ptl_error **error);

/**
 * Sets the value of an input of the graph (a block type with PTL_BLOCK_IS_INPUT), or takes it back
 * with NULL: then its default counts. Computations that run already keep what they have. Values
 * are not saved with the graph.
 *
 * Ownership: the graph keeps a reference of its own.
 * Threads:   one at a time changes a graph.
 * Errors:    PTL_E_INVALID_ARGUMENT, PTL_E_STALE_HANDLE, PTL_E_TYPE_MISMATCH if the block is no
 *            input or takes values of another kind, PTL_E_BUSY.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_set_input(
    ptl_graph *graph,
    ptl_block block,
    const ptl_value *value,
    ptl_error **error);

/**
 * The first input of the graph, in file order, whose parameter "name" is `name`; 0 if there is
 * none.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API ptl_block PTL_CALL ptl_graph_find_input(const ptl_graph *graph, const char *name);

/**
 * Computes one output of a block, of any kind, and returns a new value. Otherwise as
 * ptl_graph_compute(); `format` of the options does not matter.
 *
 * Ownership: `out` receives one reference; release it with ptl_value_release(). Nothing of
 *            `options` is kept. What an input gave may come back as it was given, uncopied: then
 *            memory that was lent for it is needed as long as this value.
 * Threads:   any; callbacks run on the calling thread only.
 * Cancel:    as ptl_graph_compute().
 * Errors:    as ptl_graph_compute(). On error `*out` is NULL.
 * Since:     0.1
 */
PTL_API PTL_MUST_USE ptl_status PTL_CALL ptl_graph_compute_value(
    const ptl_graph *graph,
    ptl_block block,
    uint32_t out_port,
    const ptl_compute_options *options,
    ptl_value **out,
    ptl_error **error);

/**
 * The bytes. They are followed by a NUL that does not count. `size` may be NULL. NULL and
 * size 0 for NULL.
 *
 * Ownership: they live as long as `bytes`.
 * Threads:   any.
 * Since:     0.1
 */
PTL_API const void *PTL_CALL ptl_bytes_data(const ptl_bytes *bytes, size_t *size);

/**
 * Frees bytes; NULL is fine.
 *
 * Threads: any.
 * Since:   0.1
 */
PTL_API void PTL_CALL ptl_bytes_release(ptl_bytes *bytes);

/* Initialise a struct with the size that this program was built with. */
#define PTL_ENGINE_OPTIONS_INIT(p) ptl_engine_options_init((p), sizeof *(p))
#define PTL_COMPUTE_OPTIONS_INIT(p) ptl_compute_options_init((p), sizeof *(p))

#ifdef __cplusplus
}
#endif

#endif /* PTLIB_H */
