/*
 * ptlib_plugin.h: blocks for ptlib from plug-ins in C. (C++: ptlib_plugin.hpp on top of it.)
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * A plug-in is a shared library whose name ends with .ptplugin.so (.dll, .dylib) and that exports
 * one symbol, a ptlp_entry:
 *
 *     const ptlp_entry ptl_plugin_entry_v1 = { sizeof(ptlp_entry), PTLP_ABI_MAJOR, ... };
 *
 * It links nothing of ptlib: what it needs, it asks the host for (the services at the end).
 *
 * The life of a block in one computation: create, prepare once, compute as often as the host likes,
 * destroy. The shape says what one call of compute writes:
 *
 *   Point   any rectangle; each input is given as the same rectangle.
 *   Gather  any rectangle; inputs with PTLP_PORT_ANYWHERE are given as whole images.
 *   Whole   everything; all inputs are whole.
 *
 * Results may depend on parameters, seed, size, precision and inputs only: neither on the
 * rectangles, nor on threads, nor on time. Transcendental functions come from ptl.math/1.
 *
 * What the host does: it checks parameters against their ranges, clamps images to 0..1 (unless the
 * output has PTLP_PORT_FREE_RANGE), truncates them to levels in 8-bit precision, and turns numbers
 * that are not finite into 0, which it reports.
 *
 * Rules. Texts are UTF-8 and end with NUL. Everything that a plug-in gets is borrowed until the
 * call returns, except the host, which lives as long as the process. Tables live as long as the
 * process, and plug-ins are never unloaded. No exception may leave a function. Plug-ins write
 * neither to the standard output nor to an input, and leave the locale and the floating-point mode
 * as they are. Functions return PTLP_OK or another status, after a word with set_error.
 *
 * The ABI is a draft until ptlib 1.0. Tables never change while PTLP_ABI_MAJOR stays: news come as
 * services of a new id.
 */
#ifndef PTLIB_PLUGIN_H
#define PTLIB_PLUGIN_H

#include "ptlib_values.h"

#if defined(_WIN32) && !defined(_WIN64)
#  define PTLP_CALL __cdecl
#else
#  define PTLP_CALL
#endif
#if defined(_WIN32)
#  define PTLP_EXPORT_ATTRIBUTE __declspec(dllexport)
#elif defined(__GNUC__)
#  define PTLP_EXPORT_ATTRIBUTE __attribute__((visibility("default")))
#else
#  define PTLP_EXPORT_ATTRIBUTE
#endif
#ifdef __cplusplus
#  define PTLP_EXPORT extern "C" PTLP_EXPORT_ATTRIBUTE
#else
#  define PTLP_EXPORT extern PTLP_EXPORT_ATTRIBUTE
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The version of these tables. Plug-ins of another major version are refused. */
#define PTLP_ABI_MAJOR 1
/** Counts services and meanings that came since; plug-ins of any minor version are loaded. */
#define PTLP_ABI_MINOR 0

/** What functions return. The numbers are those of ptl_status. */
typedef int32_t ptlp_status;

/** Done. */
#define PTLP_OK 0
/** The host asked to stop, and the function did. */
#define PTLP_E_CANCELLED 2
/** An argument makes no sense. */
#define PTLP_E_INVALID_ARGUMENT 3
/** This host or plug-in cannot do that. */
#define PTLP_E_UNSUPPORTED 4
/** The system has no memory left. */
#define PTLP_E_NO_MEMORY 5
/** No file, input or stream of that name. */
#define PTLP_E_NOT_FOUND 7
/** A required input is not connected. */
#define PTLP_E_UNCONNECTED 11
/** A number outside its range. */
#define PTLP_E_OUT_OF_RANGE 12
/** A text or a file that does not follow its grammar. */
#define PTLP_E_PARSE 13
/** A file could not be read or written. */
#define PTLP_E_IO 14
/** More than the limits of the engine allow. */
#define PTLP_E_LIMIT 15
/** The file policy forbids it. */
#define PTLP_E_DENIED 17
/** A panic or an exception was caught before it left the plug-in. */
#define PTLP_E_PANIC 23
/** It failed; the text given to set_error says why. */
#define PTLP_E_FAILED 28

typedef struct ptlp_host ptlp_host;
typedef struct ptlp_job ptlp_job;
typedef struct ptlp_block ptlp_block;

/* ---------------------------------------------------------------------------------------------- */
/* The host                                                                                       */

/** The host. It lives as long as the process. */
struct ptlp_host {
    uint32_t struct_size;
    uint32_t abi_major;
    uint32_t abi_minor;
    uint32_t flags;
    /** "ptlib" and its version. */
    const char *name;
    const char *version;
    void *data;
    /** The table of a service, such as PTLP_MATH, by its id; NULL for an unknown one. */
    const void *(PTLP_CALL *get_extension)(const ptlp_host *host, const char *id);
};

/** One call of prepare or compute. Its functions may be called from any thread, until the call
 *  returns. */
struct ptlp_job {
    uint32_t struct_size;
    uint32_t flags;
    void *data;
    /** Whether to stop (1): nobody looks at the result any more. Ask every millisecond of work, and
     *  return PTLP_E_CANCELLED. */
    int32_t (PTLP_CALL *is_cancelled)(const ptlp_job *job);
    /** Tells which part of the work is done, 0 to 1. Only of use in blocks of shape Whole. */
    void (PTLP_CALL *report)(const ptlp_job *job, double fraction);
    /** Says what went wrong, before a function returns an error. The first one counts. */
    void (PTLP_CALL *set_error)(const ptlp_job *job, const char *utf8);
    /** Tells the user that something is not as its author meant it, though the block goes on. */
    void (PTLP_CALL *warn)(const ptlp_job *job, const char *utf8);
};

/* ---------------------------------------------------------------------------------------------- */
/* Ports and parameters                                                                           */

/** Flag of an input: the block works without it. */
#define PTLP_PORT_OPTIONAL 1
/** Flag of an image input: it is read anywhere, not only at the place that is written. */
#define PTLP_PORT_ANYWHERE 2
/** Flag of an image output: its numbers are any finite ones, not 0 to 1. */
#define PTLP_PORT_FREE_RANGE 4

/** Planes of an image output: one. */
#define PTLP_PLANES_GREY 1
/** Planes of an image output: red, green, blue. */
#define PTLP_PLANES_COLOUR 3
/** Planes of an image output: red, green, blue, alpha. */
#define PTLP_PLANES_COLOUR_ALPHA 4
/** Planes of an image output: those of the input that planes_input numbers. */
#define PTLP_PLANES_AS_INPUT 16
/** Planes of an image output: those of the image input that has the most. */
#define PTLP_PLANES_MOST 17

/** An input or an output. */
typedef struct ptlp_port {
    uint32_t struct_size;
    /** One of PTL_KIND_... */
    uint32_t kind;
    /** PTLP_PORT_... */
    uint32_t flags;
    /** Of an image output: one of PTLP_PLANES_... Otherwise 0. */
    uint32_t planes;
    /** For PTLP_PLANES_AS_INPUT: which input. Otherwise 0. */
    uint32_t planes_input;
    uint32_t reserved0;
    /** Its id: lower-case words separated by single blanks, for ever. */
    const char *id;
    /** What it is, in one sentence; may be NULL. */
    const char *doc;
} ptlp_port;

/** A whole number. */
#define PTLP_PARAM_INT 1
/** A finite number. */
#define PTLP_PARAM_FLOAT 2
/** Yes (1) or no (0). */
#define PTLP_PARAM_FLAG 3
/** One of several alternatives, by number from 0. */
#define PTLP_PARAM_CHOICE 4
/** A text. */
#define PTLP_PARAM_TEXT 5
/** The path of a file. */
#define PTLP_PARAM_PATH 6

/** Flag of a path: the block reads that file (through ptl.file/1). */
#define PTLP_PARAM_READS_FILE 1

/** A parameter. */
typedef struct ptlp_param {
    uint32_t struct_size;
    /** One of PTLP_PARAM_... */
    uint32_t type;
    /** PTLP_PARAM_READS_FILE or 0. */
    uint32_t flags;
    /** How many alternatives a choice has. */
    uint32_t choice_count;
    /** The smallest and the largest number that the block computes with. */
    double min;
    double max;
    /** Where an editor's slider starts and ends. */
    double soft_min;
    double soft_max;
    /** The number, flag (0 or 1) or alternative that it has unless somebody says otherwise. */
    double default_value;
    /** Its id: lower-case words separated by single blanks, for ever. */
    const char *id;
    /** What it does, in sentences. */
    const char *doc;
    /** What its number counts, such as "px"; NULL or empty for a plain number. */
    const char *unit;
    /** The default of a text or a path; NULL is the empty text. */
    const char *default_text;
    /** The ids of a choice's alternatives, for ever; the list only grows at its end. */
    const char *const *choice_ids;
    /** What each alternative means, one line; NULL if nothing is said. */
    const char *const *choice_docs;
} ptlp_param;

/** The value of a parameter, in its range. */
typedef struct ptlp_value {
    /** One of PTLP_PARAM_... */
    uint32_t type;
    uint32_t reserved0;
    /** A whole number, a flag or an alternative. */
    int64_t integer;
    /** A number; of the types above, the same as integer. */
    double number;
    /** A text or a path; otherwise NULL. */
    const char *text;
    const void *reserved1;
} ptlp_value;

/* ---------------------------------------------------------------------------------------------- */
/* What is computed                                                                               */

/** A rectangle of an image: planes of floats.
 *
 *  Sample (x, y) of the rectangle in channel c is planes[c][y * row_stride + x]. A grey image has
 *  its one plane as red, green and blue; planes[3] is NULL if there is no alpha. */
typedef struct ptlp_tile {
    uint32_t struct_size;
    /** Planes: 1, 3 or 4. */
    uint32_t channels;
    /** Column and row of its left upper corner in the image. */
    uint32_t x;
    uint32_t y;
    uint32_t width;
    uint32_t height;
    /** The size of the whole image. */
    uint32_t image_width;
    uint32_t image_height;
    /** Floats from one row to the next. */
    size_t row_stride;
    /** Red, green, blue, alpha. Those of inputs are only to be read. */
    float *planes[4];
} ptlp_tile;

/** What is at an input or an output. */
typedef struct ptlp_wire {
    uint32_t struct_size;
    /** One of PTL_KIND_...; PTL_KIND_NONE if the input is not connected. */
    uint32_t kind;
    /** A ptlp_tile, ptl_gradient_data, ptl_text_data, ptl_points_data, ptl_mesh_data or
     *  ptl_strands_data, by the kind. NULL at an output that is no image: its value is made with
     *  ptl.values/1. */
    const void *value;
} ptlp_wire;

/** In 8-bit precision the host truncates what is stored to multiples of 1/255. */
#define PTLP_PRECISION_8BIT 1
/** Real numbers. */
#define PTLP_PRECISION_FLOAT 2

/** What an instance prepares itself from. */
typedef struct ptlp_setup {
    uint32_t struct_size;
    uint32_t flags;
    /** Size of the images to make in pixels, supersampling included. */
    uint32_t width;
    uint32_t height;
    /** PTLP_PRECISION_8BIT or PTLP_PRECISION_FLOAT. */
    uint32_t precision;
    uint32_t value_count;
    uint32_t input_count;
    uint32_t reserved0;
    /** The seed of the block in its graph. */
    uint64_t seed;
    /** The values of the parameters, in the order of their declarations. */
    const ptlp_value *const *values;
    /** The inputs. An image that only comes row by row has its channels here, but no planes. */
    const ptlp_wire *const *inputs;
} ptlp_setup;

/* ---------------------------------------------------------------------------------------------- */
/* Blocks and plug-ins                                                                            */

/** Shape: any rectangle from the same rectangle of each input and the position. */
#define PTLP_SHAPE_POINT 1
/** Shape: any rectangle from whole inputs. */
#define PTLP_SHAPE_GATHER 2
/** Shape: everything in one call. */
#define PTLP_SHAPE_WHOLE 3

/** Threads: compute of one instance runs on several threads at a time. */
#define PTLP_THREADS_TILES 1
/** Threads: each instance is used by one thread at a time; the host makes several. */
#define PTLP_THREADS_INSTANCE 2
/** Threads: one function of this block type runs at a time, in the whole process. */
#define PTLP_THREADS_GLOBAL 3

/** Flag of a block: another seed gives another result. */
#define PTLP_BLOCK_USES_SEED 1
/** Flag of a block: the caller of a graph sets its one output; it has no functions. */
#define PTLP_BLOCK_GRAPH_INPUT 2
/** Flag of a block: with the same inputs and parameters it may give something else; its results are
 *  not kept. */
#define PTLP_BLOCK_NOT_DETERMINISTIC 4

/** A block type. */
struct ptlp_block {
    uint32_t struct_size;
    /** The version of the block type: counts up whenever its results change. */
    uint32_t version;
    /** One of PTLP_SHAPE_... */
    uint32_t shape;
    /** One of PTLP_THREADS_... */
    uint32_t thread_mode;
    /** PTLP_BLOCK_... */
    uint32_t flags;
    uint32_t input_count;
    /** At least 1. */
    uint32_t output_count;
    uint32_t param_count;
    /** "vendor.name", lower-case words separated by single blanks, for ever. "ptl." is reserved. */
    const char *id;
    /** What people call it; NULL: what stands behind the point of its id. */
    const char *name;
    /** The family that it is listed with, such as "noise". */
    const char *category;
    /** What it makes, in one sentence. */
    const char *doc;
    /** Why its output need not tile although its inputs do; NULL if it always tiles. */
    const char *tiling_exception;
    /** Which of its lengths count pixels, so that the picture depends on the resolution; NULL if
     *  none does. */
    const char *in_pixels;
    const ptlp_port *const *inputs;
    const ptlp_port *const *outputs;
    const ptlp_param *const *params;
    /** For the plug-in. */
    void *user_data;
    /** Makes an instance. NULL: the block has no state, and its instance is NULL. */
    ptlp_status (PTLP_CALL *create)(
        const ptlp_block *block, const ptlp_host *host, void **instance);
    /** Ends an instance; also after prepare or compute failed. NULL if there is nothing to do. */
    void (PTLP_CALL *destroy)(void *instance);
    /** Prepares an instance, once, for one computation. NULL if there is nothing to do. */
    ptlp_status (PTLP_CALL *prepare)(void *instance, const ptlp_job *job, const ptlp_setup *setup);
    /** Writes all of each output. */
    ptlp_status (PTLP_CALL *compute)(
        void *instance,
        const ptlp_job *job,
        const ptlp_wire *const *inputs,
        const ptlp_wire *const *outputs);
    /** The most memory in bytes that an instance takes, besides its outputs and what it takes from
     *  ptl.scratch/1. Its setup has no inputs. NULL: little. */
    uint64_t (PTLP_CALL *memory)(const ptlp_block *block, const ptlp_setup *setup);
};

/** A plug-in. */
typedef struct ptlp_entry {
    uint32_t struct_size;
    /** PTLP_ABI_MAJOR and PTLP_ABI_MINOR. */
    uint32_t abi_major;
    uint32_t abi_minor;
    uint32_t flags;
    /** Its id: the vendor of its blocks, or the vendor, a point and a word. */
    const char *id;
    /** What people call it. */
    const char *name;
    /** Who made it. */
    const char *vendor;
    /** Its version, such as "1.2.0". */
    const char *version;
    /** The SPDX expression of its licence. */
    const char *license;
    /** The compiler that built it; may be NULL. */
    const char *built_with;
    /** Called once in a process, before anything else. May be NULL. */
    ptlp_status (PTLP_CALL *init)(const ptlp_host *host, const char *plugin_path);
    /** Only called by tools that check plug-ins. May be NULL. */
    void (PTLP_CALL *deinit)(void);
    /** What it offers besides, by id; NULL for unknown ids. May be NULL itself. */
    const void *(PTLP_CALL *get_extension)(const char *id);
    const ptlp_block *const *blocks;
    uint32_t block_count;
    uint32_t reserved0;
} ptlp_entry;

/* The entry that a plug-in defines. (A program that links several plug-ins into itself gives each a
 * name of its own, and hands it to ptl_engine_register_plugin().) */
PTLP_EXPORT const ptlp_entry ptl_plugin_entry_v1;

/* ---------------------------------------------------------------------------------------------- */
/* Services of the host, by id at ptlp_host.get_extension                                         */

#define PTLP_LOG "ptl.log/1"
#define PTLP_PARALLEL "ptl.parallel/1"
#define PTLP_SCRATCH "ptl.scratch/1"
#define PTLP_NOISE "ptl.noise/1"
#define PTLP_MATH "ptl.math/1"
#define PTLP_VALUES "ptl.values/1"
#define PTLP_FILE "ptl.file/1"

/** Details for whoever looks for a fault. */
#define PTLP_LOG_DEBUG 1
/** What goes on. */
#define PTLP_LOG_INFO 2
/** What works, but probably not as meant. */
#define PTLP_LOG_WARNING 3
/** What failed. */
#define PTLP_LOG_ERROR 4

/** PTLP_LOG: messages for the log. */
typedef struct ptlp_log {
    uint32_t struct_size;
    uint32_t reserved0;
    /** Writes a line; level is one of PTLP_LOG_... job may be NULL outside of a call. */
    void (PTLP_CALL *write)(
        const ptlp_host *host, const ptlp_job *job, int32_t level, const char *utf8);
} ptlp_log;

/** One part of parallel work. */
typedef ptlp_status (PTLP_CALL *ptlp_task_fn)(void *user_data, uint32_t index);

/** PTLP_PARALLEL: work on all threads of the computation. */
typedef struct ptlp_parallel {
    uint32_t struct_size;
    uint32_t reserved0;
    /** Runs task for 0 to before count, in any order, and waits for all. After an error, or when the
     *  computation is cancelled, no further task starts. Returns the error of the task of the lowest
     *  number. */
    ptlp_status (PTLP_CALL *run)(
        const ptlp_job *job, uint32_t count, ptlp_task_fn task, void *user_data);
} ptlp_parallel;

/** PTLP_SCRATCH: memory for the time of a call. */
typedef struct ptlp_scratch {
    uint32_t struct_size;
    uint32_t reserved0;
    /** Memory of size bytes, zeroed, 64-byte aligned; NULL if there is none or the limit is reached.
     *  It is freed when the call of prepare or compute returns. */
    void *(PTLP_CALL *allocate)(const ptlp_job *job, size_t size);
    /** Frees it before that. NULL is fine. */
    void (PTLP_CALL *release)(const ptlp_job *job, void *memory);
} ptlp_scratch;

/** PTLP_NOISE: the engine's random numbers, so that plug-ins agree with it bit for bit. */
typedef struct ptlp_noise {
    uint32_t struct_size;
    uint32_t reserved0;
    /** 32 random bits of a seed and three numbers, such as an item, a part of it and a channel. */
    uint32_t (PTLP_CALL *hash)(uint64_t seed, uint32_t item, uint32_t part, uint32_t channel);
    /** A number of [0, 1): the upper 24 bits of hash. */
    float (PTLP_CALL *uniform)(uint64_t seed, uint32_t item, uint32_t part, uint32_t channel);
    /** The noise that the blocks of PT Designer draw from, uniform on (-1, 1]. */
    double (PTLP_CALL *elias)(int32_t index);
} ptlp_noise;

/** A function of one number, and of two. */
typedef double (PTLP_CALL *ptlp_function)(double x);
typedef double (PTLP_CALL *ptlp_function2)(double x, double y);

/** PTLP_MATH: the engine's transcendental functions, with the same bits on every platform. Angles
 *  are radians. */
typedef struct ptlp_math {
    uint32_t struct_size;
    uint32_t reserved0;
    ptlp_function sin;
    ptlp_function cos;
    ptlp_function tan;
    ptlp_function asin;
    ptlp_function acos;
    ptlp_function atan;
    /** atan2(y, x): the angle of the point (x, y). */
    ptlp_function2 atan2;
    ptlp_function exp;
    ptlp_function exp2;
    ptlp_function log;
    ptlp_function log2;
    ptlp_function2 pow;
    ptlp_function tanh;
    ptlp_function cbrt;
} ptlp_math;

/** PTLP_VALUES: values for outputs that are no images. Only for blocks of shape Whole, in compute.
 *
 *  ..._begin takes counts and streams (type, components, flags, id; stride 0) in its struct, and
 *  gives the same struct with memory of the host in it: zeroed, 64-byte aligned, to be written until
 *  finish.
 *  A stream whose data is not NULL must be one of an input of this call: its first elements, as many
 *  as are needed, are shared, not copied. So are indices and first_point, which must be whole. */
typedef struct ptlp_values {
    uint32_t struct_size;
    uint32_t reserved0;
    ptlp_status (PTLP_CALL *mesh_begin)(
        const ptlp_job *job, uint32_t output, ptl_mesh_data *mesh);
    ptlp_status (PTLP_CALL *points_begin)(
        const ptlp_job *job, uint32_t output, ptl_points_data *points);
    ptlp_status (PTLP_CALL *strands_begin)(
        const ptlp_job *job, uint32_t output, ptl_strands_data *strands);
    /** Checks what was begun for an output, and freezes it. After an error, which says what is
     *  wrong, the value is gone. */
    ptlp_status (PTLP_CALL *finish)(const ptlp_job *job, uint32_t output);
    /** Gives an output a text of size bytes in UTF-8, which is copied. */
    ptlp_status (PTLP_CALL *text)(
        const ptlp_job *job, uint32_t output, const char *utf8, size_t size);
    /** Gives an output a colour transition of count stops, which are copied. */
    ptlp_status (PTLP_CALL *gradient)(
        const ptlp_job *job, uint32_t output, const ptl_gradient_stop *stops, uint32_t count);
    /** Gives an output the value of an input of the same kind, without a copy. */
    ptlp_status (PTLP_CALL *pass)(const ptlp_job *job, uint32_t output, uint32_t input);
} ptlp_values;

/** PTLP_FILE: files that parameters name, as the caller's policy lets them be read and written. */
typedef struct ptlp_file {
    uint32_t struct_size;
    uint32_t reserved0;
    /** The bytes of the file at a path that a parameter has; they live until the call returns. */
    ptlp_status (PTLP_CALL *read)(
        const ptlp_job *job, const char *path, const void **data, size_t *size);
    /** Writes a whole file below a folder that the caller opened for writing. An existing file is
     *  replaced. */
    ptlp_status (PTLP_CALL *write)(
        const ptlp_job *job, const char *path, const void *data, size_t size);
} ptlp_file;

#ifdef __cplusplus
}
#endif

#endif /* PTLIB_PLUGIN_H */
