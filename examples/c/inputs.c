/* Sends pixels from memory through a graph: a checkerboard, blurred.
 *
 * The graph has an input called "photo". Whoever loads the graph finds it by that name, and gives
 * it another picture each time.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ptlib/ptlib.h>

#define SIDE 128

static ptl_status build(ptl_graph *graph, ptl_block *result, ptl_error **error)
{
    ptl_block input = 0, blur = 0;
    ptl_status status = ptl_graph_set_size(graph, SIDE, SIDE, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "image input", &input, error);
    if (status == PTL_OK) status = ptl_graph_set_text(graph, input, "name", "photo", error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "blur", &blur, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, input, 0, blur, 0, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "end", result, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, blur, 0, *result, 0, error);
    return status;
}

/* A value of the pixels of a checkerboard: copied, so they need not be kept. */
static ptl_status checkerboard(ptl_value **out, ptl_error **error)
{
    static unsigned char pixels[SIDE][SIDE];
    ptl_image_data image;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            pixels[y][x] = ((x / 16 + y / 16) & 1) != 0 ? 255 : 0;
        }
    }
    memset(&image, 0, sizeof image);
    image.struct_size = sizeof image;
    image.format = PTL_FORMAT_GREY8;
    image.width = image.height = SIDE;
    image.pixels = pixels;
    return ptl_value_from_image(&image, 0, NULL, NULL, out, error);
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_value *photo = NULL;
    ptl_image *image = NULL;
    ptl_error *error = NULL;
    ptl_block end = 0;
    ptl_compute_options options;
    int result = EXIT_FAILURE;

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.format = PTL_FORMAT_GREY8;
    if (ptl_engine_create(NULL, &engine, &error) == PTL_OK &&
        ptl_graph_create(engine, &graph, &error) == PTL_OK &&
        build(graph, &end, &error) == PTL_OK && checkerboard(&photo, &error) == PTL_OK &&
        ptl_graph_set_input(graph, ptl_graph_find_input(graph, "photo"), photo, &error) ==
            PTL_OK &&
        ptl_graph_compute(graph, end, 0, &options, &image, &error) == PTL_OK &&
        ptl_image_save(image, "inputs.png", &error) == PTL_OK) {
        printf("inputs.png is written\n");
        result = EXIT_SUCCESS;
    } else {
        fprintf(stderr, "%s\n", error != NULL ? ptl_error_message(error) : "unknown error");
    }

    ptl_error_release(error);
    ptl_image_release(image);
    ptl_value_release(photo);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return result;
}
