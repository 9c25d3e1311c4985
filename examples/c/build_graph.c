/* Builds a graph by hand, computes it, and saves the graph and its picture.
 *
 * Bump noise becomes the red channel of the picture, a Voronoi diagram the green one, and that
 * diagram sent through a circle transform the blue one.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stdio.h>
#include <stdlib.h>

#include <ptlib/ptlib.h>

/* Every step returns a status; the first failure ends it. */
static ptl_status build(ptl_graph *graph, ptl_block *result, ptl_error **error)
{
    ptl_block bumps = 0, cells = 0, circles = 0, colours = 0;
    const double size = 0.3;

    ptl_status status = ptl_graph_set_size(graph, 256, 256, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "bump noise", &bumps, error);
    if (status == PTL_OK)
        status = ptl_graph_set_float(graph, bumps, "bump size from", &size, 1, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "voronoi diagram", &cells, error);
    if (status == PTL_OK)
        status = ptl_graph_set_int(graph, cells, "number of points", 30, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "circle transform", &circles, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, cells, 0, circles, 0, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "mix channels", &colours, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, bumps, 0, colours, 0, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, cells, 0, colours, 1, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, circles, 0, colours, 2, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "end", result, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, colours, 0, *result, 0, error);
    return status;
}

/* Writes the graph as a file. */
static int save(const ptl_graph *graph, const char *path, ptl_error **error)
{
    ptl_bytes *bytes = NULL;
    const void *data;
    size_t size;
    FILE *file;
    int is_written = 0;

    if (ptl_graph_save(graph, &bytes, error) != PTL_OK) return 0;
    data = ptl_bytes_data(bytes, &size);
    file = fopen(path, "wb");
    if (file != NULL) {
        is_written = fwrite(data, 1, size, file) == size;
        is_written = fclose(file) == 0 && is_written;
    }
    if (!is_written) perror(path);
    ptl_bytes_release(bytes);
    return is_written;
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_error *error = NULL;
    ptl_block end = 0;
    int is_done = 0;

    if (ptl_engine_create(NULL, &engine, &error) == PTL_OK &&
        ptl_graph_create(engine, &graph, &error) == PTL_OK &&
        build(graph, &end, &error) == PTL_OK &&
        save(graph, "build_graph.xml", &error) &&
        ptl_graph_compute(graph, end, 0, NULL, &image, &error) == PTL_OK &&
        ptl_image_save(image, "build_graph.png", &error) == PTL_OK) {
        printf("build_graph.xml and build_graph.png\n");
        is_done = 1;
    }
    if (error != NULL) {
        fprintf(stderr, "%s\n", ptl_error_message(error));
    }
    /* every release takes NULL */
    ptl_error_release(error);
    ptl_image_release(image);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return is_done ? EXIT_SUCCESS : EXIT_FAILURE;
}
