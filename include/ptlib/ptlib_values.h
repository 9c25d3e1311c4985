/*
 * ptlib_values.h: what flows on the wires of a graph besides images.
 *
 * Included by ptlib.h and ptlib_plugin.h. The twin of the Rust crate ptlib-plugin-abi.
 *
 * Meshes, points and strands are counts and streams. A stream is found by its id, so that new data
 * needs no new struct: "position" (3 floats, mandatory), "normal", "direction" (3), "texcoord",
 * "texcoord1" (2), "tangent" (4, the last +1 or -1), "color" (3 or 4, each 0 to 1), "radius",
 * "random", "loss age" (1, the last two 0 to 1), "id" (2 whole numbers). Streams of other ids pass
 * through untouched.
 *
 * Every struct starts with its size in bytes. Arrays are arrays of pointers, so that elements may
 * grow. Fields called reserved, and flags without a meaning, are 0.
 */
#ifndef PTLIB_VALUES_H
#define PTLIB_VALUES_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** No value: an input that is not connected. */
#define PTL_KIND_NONE 0
/** An image. */
#define PTL_KIND_IMAGE 1
/** A colour transition. */
#define PTL_KIND_GRADIENT 2
/** A text of any meaning, such as the string of an L-system. */
#define PTL_KIND_TEXT 3
/** Points, each perhaps with more data. */
#define PTL_KIND_POINTS 4
/** Triangles. */
#define PTL_KIND_MESH 5
/** Polylines, such as hairs. */
#define PTL_KIND_STRANDS 6
/** Reserved. */
#define PTL_KIND_VOLUME 7

/** The stream holds 32-bit floating-point numbers. */
#define PTL_STREAM_F32 1
/** The stream holds unsigned 32-bit whole numbers. */
#define PTL_STREAM_U32 2

/** Flag of a stream: one element serves all. */
#define PTL_STREAM_CONSTANT 1

/** One kind of data of each element. */
typedef struct ptl_stream {
    uint32_t struct_size;
    /** PTL_STREAM_F32 or PTL_STREAM_U32. */
    uint32_t type;
    /** Numbers of an element, 1 to 4. */
    uint32_t components;
    /** PTL_STREAM_CONSTANT or 0. */
    uint32_t flags;
    /** What it means: ASCII. */
    const char *id;
    /** Element i lies at (const char *)data + i * stride, 4-byte aligned. */
    const void *data;
    /** Bytes from one element to the next: a multiple of 4. Interleaved data is fine. */
    size_t stride;
} ptl_stream;

/** Triangles. */
typedef struct ptl_mesh_data {
    uint32_t struct_size;
    uint32_t flags;
    /** Elements of each stream. */
    uint32_t vertex_count;
    /** Three for each triangle. */
    uint32_t index_count;
    /** Numbers of vertices, three for each triangle. */
    const uint32_t *indices;
    const ptl_stream *const *streams;
    uint32_t stream_count;
    uint32_t reserved0;
    /** The smallest and the largest coordinates; computed by the library. */
    float bounds_min[3];
    float bounds_max[3];
} ptl_mesh_data;

/** Points. */
typedef struct ptl_points_data {
    uint32_t struct_size;
    uint32_t flags;
    /** Elements of each stream. */
    uint32_t point_count;
    uint32_t stream_count;
    const ptl_stream *const *streams;
    /** The smallest and the largest coordinates; computed by the library. */
    float bounds_min[3];
    float bounds_max[3];
} ptl_points_data;

/** Polylines. */
typedef struct ptl_strands_data {
    uint32_t struct_size;
    uint32_t flags;
    uint32_t strand_count;
    /** Points of all strands together. */
    uint32_t point_count;
    /** Strand i has the points from first_point[i] to before first_point[i + 1]: one entry more
     *  than strands. Each strand has at least two points. */
    const uint32_t *first_point;
    const ptl_stream *const *point_streams;
    const ptl_stream *const *strand_streams;
    uint32_t point_stream_count;
    uint32_t strand_stream_count;
    /** The smallest and the largest coordinates; computed by the library. */
    float bounds_min[3];
    float bounds_max[3];
} ptl_strands_data;

/** A colour at a position of a colour transition. */
typedef struct ptl_gradient_stop {
    /** Where, 0 to 1. */
    float position;
    /** Red, green, blue, each 0 to 1. */
    float color[3];
} ptl_gradient_stop;

/** A colour transition: constant before the first stop and after the last, linear between. */
typedef struct ptl_gradient_data {
    uint32_t struct_size;
    uint32_t stop_count;
    const ptl_gradient_stop *stops;
} ptl_gradient_data;

/** A text. */
typedef struct ptl_text_data {
    uint32_t struct_size;
    uint32_t flags;
    /** UTF-8. Texts that the library gives have a NUL behind them. */
    const char *text;
    /** Bytes, without a NUL. */
    size_t size;
} ptl_text_data;

/** Pixels of a caller. */
typedef struct ptl_image_data {
    uint32_t struct_size;
    /** One of PTL_FORMAT_..., not AUTO. */
    uint32_t format;
    uint32_t width;
    uint32_t height;
    /** Rows from the top. */
    const void *pixels;
    /** Bytes from one row to the next; 0 for rows without gaps. */
    size_t row_stride;
} ptl_image_data;

#ifdef __cplusplus
}
#endif

#endif /* PTLIB_VALUES_H */
