/* Ages a head in steps:  aging [PLUGIN]
 *
 * The head is an array of vertices and one of indices, as a modelling program has them. Each step
 * changes nothing but the age: wrinkles, regions and roots of hair come from the engine's cache.
 * PLUGIN is the file of the plug-in "aging"; without it the variable PTLIB_AGING_PLUGIN names it.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ptlib/ptlib.h>

#define COLUMNS 64 /* around the head */
#define ROWS 32    /* from the chin to the crown: as large a part of a turn each */
#define STEPS 5

/* A vertex as it lies in memory: no copy, no conversion. */
typedef struct vertex {
    float position[3];
    float texcoord[2];
    float normal[3];
} vertex;

static vertex vertices[ROWS + 1][COLUMNS + 1];
static uint32_t indices[ROWS][COLUMNS][6];

/* An egg, the face towards z, in the middle of the texture; v points up. */
static void make_head(void)
{
    const double cosine = 0.99518472667219688624, sine = 0.09801714032956060199; /* 1/64 turn */
    double up[2] = {0.0, -1.0}; /* cosine and sine of the height: from the south pole */
    int row, column;
    for (row = 0; row <= ROWS; row++) {
        double around[2] = {-1.0, 0.0}; /* from the back */
        const double width = up[1] < 0 ? 1 - 0.3 * up[1] * up[1] : 1.0, rotated = up[0];
        for (column = 0; column <= COLUMNS; column++) {
            vertex *here = &vertices[row][column];
            const double turned = around[0], x = up[0] * around[1], z = up[0] * around[0];
            here->position[0] = (float)(0.8 * width * x);
            here->position[1] = (float)(1.1 * up[1]);
            here->position[2] = (float)(0.95 * width * z);
            here->texcoord[0] = (float)column / COLUMNS;
            here->texcoord[1] = (float)row / ROWS;
            here->normal[0] = (float)(x / 0.8);
            here->normal[1] = (float)(up[1] / 1.1);
            here->normal[2] = (float)(z / 0.95);
            around[0] = turned * cosine + around[1] * sine;
            around[1] = around[1] * cosine - turned * sine;
        }
        up[0] = rotated * cosine - up[1] * sine;
        up[1] = up[1] * cosine + rotated * sine;
    }
    for (row = 0; row < ROWS; row++) {
        for (column = 0; column < COLUMNS; column++) {
            const uint32_t lower = (uint32_t)(row * (COLUMNS + 1) + column);
            const uint32_t upper = lower + COLUMNS + 1;
            uint32_t *corners = indices[row][column];
            corners[0] = corners[3] = lower;
            corners[1] = lower + 1;
            corners[2] = corners[4] = upper + 1;
            corners[5] = upper;
        }
    }
}

static ptl_stream stream(const char *id, uint32_t components, size_t offset)
{
    ptl_stream made;
    memset(&made, 0, sizeof made);
    made.struct_size = sizeof made;
    made.type = PTL_STREAM_F32;
    made.components = components;
    made.id = id;
    made.data = (const char *)vertices + offset;
    made.stride = sizeof(vertex);
    return made;
}

/* The head as a value. The arrays are static: they are lent, not copied. */
static ptl_status head_value(ptl_value **out, ptl_error **error)
{
    const ptl_stream position = stream("position", 3, offsetof(vertex, position));
    const ptl_stream texcoord = stream("texcoord", 2, offsetof(vertex, texcoord));
    const ptl_stream normal = stream("normal", 3, offsetof(vertex, normal));
    const ptl_stream *streams[3];
    ptl_mesh_data mesh;
    streams[0] = &position;
    streams[1] = &texcoord;
    streams[2] = &normal;
    memset(&mesh, 0, sizeof mesh);
    mesh.struct_size = sizeof mesh;
    mesh.vertex_count = (ROWS + 1) * (COLUMNS + 1);
    mesh.index_count = ROWS * COLUMNS * 6;
    mesh.indices = &indices[0][0][0];
    mesh.streams = streams;
    mesh.stream_count = 3;
    return ptl_value_from_mesh(&mesh, PTL_VALUE_BORROW, NULL, NULL, out, error);
}

/* A mask of hair in the texture: 1 above a line, which falls from the forehead to the nape; the
 * inner one is what old age leaves, around the back. */
static ptl_status mask_value(int is_inner, ptl_value **out, ptl_error **error)
{
    enum { SIDE = 128 };
    static unsigned char pixels[SIDE][SIDE];
    ptl_image_data image;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double v = 1 - (y + 0.5) / SIDE, u = (x + 0.5) / SIDE * 2 - 1;
            const double back = u < 0 ? -u : u; /* 0 in front, 1 behind */
            const double line = back < 0.25 ? 0.7 : back > 0.55 ? 0.4 : 0.95 - back;
            const int is_hair = is_inner ? back > 0.42 && v < 0.64 : 1;
            pixels[y][x] = is_hair && v > line ? 255 : 0;
        }
    }
    memset(&image, 0, sizeof image);
    image.struct_size = sizeof image;
    image.format = PTL_FORMAT_GREY8;
    image.width = image.height = SIDE;
    image.pixels = pixels;
    return ptl_value_from_image(&image, 0, NULL, NULL, out, error);
}

enum {
    HEAD, FRAMES, WRINKLES, HEIGHT, NORMALS, OUTER, INNER, LOSS_AGE, ROOTS, LIVING, GREY, HAIR,
    VIEW, BLOCKS
};

static const char *const TYPES[BLOCKS] = {
    "aging.mesh input", "aging.mesh frames", "aging.wrinkle map", "aging.age height",
    "aging.height to normal", "image input", "image input", "aging.hair transition",
    "aging.scatter hair", "aging.hair at age", "aging.grey hair", "aging.grow strands",
    "aging.head view"
};

/* From which block to which input of which. */
static const struct { int from, to; uint32_t input; } WIRES[] = {
    {HEAD, FRAMES, 0}, {WRINKLES, HEIGHT, 0}, {HEIGHT, NORMALS, 0}, {OUTER, LOSS_AGE, 0},
    {INNER, LOSS_AGE, 1}, {FRAMES, ROOTS, 0}, {LOSS_AGE, ROOTS, 1}, {ROOTS, LIVING, 0},
    {LIVING, GREY, 0}, {GREY, HAIR, 0}, {FRAMES, VIEW, 0}, {NORMALS, VIEW, 2}, {HAIR, VIEW, 5}
};

static ptl_status build(ptl_graph *graph, ptl_block blocks[BLOCKS], ptl_error **error)
{
    ptl_status status = ptl_graph_set_size(graph, 256, 256, error);
    size_t i;
    if (status == PTL_OK) status = ptl_graph_set_precision(graph, PTL_PRECISION_FLOAT, error);
    for (i = 0; i < BLOCKS && status == PTL_OK; i++) {
        status = ptl_graph_add_block(graph, TYPES[i], &blocks[i], error);
    }
    for (i = 0; i < sizeof WIRES / sizeof *WIRES && status == PTL_OK; i++) {
        status = ptl_graph_connect(
            graph, blocks[WIRES[i].from], 0, blocks[WIRES[i].to], WIRES[i].input, error);
    }
    if (status == PTL_OK) status = ptl_graph_set_int(graph, blocks[ROOTS], "hairs", 8000, error);
    return status;
}

/* Gives the graph its head and its masks. It keeps what it needs of the values. */
static ptl_status set_inputs(ptl_graph *graph, const ptl_block blocks[BLOCKS], ptl_error **error)
{
    static const int inputs[3] = {HEAD, OUTER, INNER};
    ptl_status status = PTL_OK;
    int i;
    for (i = 0; i < 3 && status == PTL_OK; i++) {
        ptl_value *value = NULL;
        status = inputs[i] == HEAD ? head_value(&value, error)
                                   : mask_value(inputs[i] == INNER, &value, error);
        if (status == PTL_OK) {
            status = ptl_graph_set_input(graph, blocks[inputs[i]], value, error);
        }
        ptl_value_release(value);
    }
    return status;
}

/* Called on this thread while it computes. A nonzero result would cancel. */
static int32_t PTL_CALL show(const ptl_progress *progress, void *user_data)
{
    (void)user_data;
    printf("\r%3.0f %%", progress->fraction * 100);
    fflush(stdout);
    return 0;
}

/* Counts the hairs that are left: strands, which nobody copies. */
static ptl_status count_hairs(
    const ptl_graph *graph, ptl_block hair, const ptl_compute_options *options, uint32_t *count,
    ptl_error **error)
{
    ptl_value *value = NULL;
    ptl_strands_data strands;
    ptl_status status = ptl_graph_compute_value(graph, hair, 0, options, &value, error);
    memset(&strands, 0, sizeof strands);
    strands.struct_size = sizeof strands;
    if (status == PTL_OK) status = ptl_value_strands(value, &strands, error);
    *count = strands.strand_count;
    ptl_value_release(value);
    return status;
}

/* Computes and saves the head at an age. */
static ptl_status age_head(
    ptl_graph *graph, const ptl_block blocks[BLOCKS], int step, ptl_error **error)
{
    static const int aged[3] = {HEIGHT, LIVING, GREY};
    const double age = (double)step / STEPS;
    ptl_image *image = NULL;
    ptl_compute_options options;
    ptl_status status = PTL_OK;
    uint32_t hairs = 0;
    char path[32];
    int i;
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.format = PTL_FORMAT_RGBA8;
    options.progress = show;
    for (i = 0; i < 3 && status == PTL_OK; i++) {
        status = ptl_graph_set_float(graph, blocks[aged[i]], "age", &age, 1, error);
    }
    snprintf(path, sizeof path, "aging-%d.png", step);
    if (status == PTL_OK) {
        status = ptl_graph_compute(graph, blocks[VIEW], 0, &options, &image, error);
    }
    if (status == PTL_OK) status = ptl_image_save(image, path, error);
    if (status == PTL_OK) {
        status = count_hairs(graph, blocks[HAIR], &options, &hairs, error);
    }
    if (status == PTL_OK) printf("\rage %.1f: %u hairs, %s\n", age, (unsigned)hairs, path);
    ptl_image_release(image);
    return status;
}

int main(int argc, char **argv)
{
    const char *plugin = argc > 1 ? argv[1] : getenv("PTLIB_AGING_PLUGIN");
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_error *error = NULL;
    ptl_block blocks[BLOCKS];
    ptl_status status;
    int step;

    if (plugin == NULL) {
        fprintf(stderr, "usage: aging PLUGIN   (.../aging.ptplugin.so)\n");
        return EXIT_FAILURE;
    }
    make_head();
    status = ptl_engine_create(NULL, &engine, &error);
    if (status == PTL_OK) status = ptl_engine_load_plugin(engine, plugin, &error);
    if (status == PTL_OK) status = ptl_graph_create(engine, &graph, &error);
    if (status == PTL_OK) status = build(graph, blocks, &error);
    if (status == PTL_OK) status = set_inputs(graph, blocks, &error);
    for (step = 0; step <= STEPS && status == PTL_OK; step++) {
        status = age_head(graph, blocks, step, &error);
    }
    if (status != PTL_OK) {
        fprintf(
            stderr, "%s: %s\n", ptl_status_name(status),
            error != NULL ? ptl_error_message(error) : "unknown error");
    }
    ptl_error_release(error);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return status == PTL_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
