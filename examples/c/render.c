/* Renders a graph file into a picture:  render [GRAPH [PICTURE [SIZE]]]
 *
 * Build it with:  cc render.c -o render $(pkg-config --cflags --libs ptlib)
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stdio.h>
#include <stdlib.h>

#include <ptlib/ptlib.h>

/* The graph to render if none is named. */
static const char *usual_graph(char *path, size_t size)
{
    const char *examples = getenv("PTLIB_EXAMPLES");
    snprintf(path, size, "%s/graphs/stained-glass.xml", examples != NULL ? examples : "examples");
    return path;
}

/* Tells what the file says and the graph does not follow. */
static void print_warnings(const ptl_graph *graph)
{
    uint32_t i;
    for (i = 0; i < ptl_graph_warning_count(graph); i++) {
        ptl_fault warning;
        warning.struct_size = sizeof warning;
        if (ptl_graph_warning_at(graph, i, &warning) == PTL_OK) {
            fprintf(stderr, "warning: %s\n", warning.message);
        }
    }
}

int main(int argc, char **argv)
{
    char path[4096];
    const char *file = argc > 1 ? argv[1] : usual_graph(path, sizeof path);
    const char *picture = argc > 2 ? argv[2] : "render.png";
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_error *error = NULL;
    ptl_compute_options options;
    int result = EXIT_FAILURE;

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.format = PTL_FORMAT_RGB8;
    if (argc > 3) {
        options.width = options.height = (uint32_t)strtoul(argv[3], NULL, 10);
    }

    if (ptl_engine_create(NULL, &engine, &error) != PTL_OK ||
        ptl_graph_load_file(engine, file, &graph, &error) != PTL_OK) {
        goto cleanup;
    }
    print_warnings(graph);
    if (ptl_graph_compute(graph, ptl_graph_main_result(graph), 0, &options, &image, &error) !=
            PTL_OK ||
        ptl_image_save(image, picture, &error) != PTL_OK) {
        goto cleanup;
    }
    printf("%s\n", picture);
    result = EXIT_SUCCESS;

cleanup: /* every release takes NULL */
    if (error != NULL) {
        fprintf(stderr, "%s\n", ptl_error_message(error));
    }
    ptl_error_release(error);
    ptl_image_release(image);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return result;
}
