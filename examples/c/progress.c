/* Shows how far a computation is, and cancels another one.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stdio.h>
#include <stdlib.h>

#include <ptlib/ptlib.h>

/* What the callback needs: `user_data` leads to it. */
typedef struct watch {
    const char *what;
    double stop_at; /* cancel at this fraction; above 1 never */
} watch;

/* Called on the thread that computes, so it needs no locks. Nonzero cancels. */
static int32_t PTL_CALL show(const ptl_progress *progress, void *user_data)
{
    const watch *watched = (const watch *)user_data;
    printf("%s: %3.0f %%\n", watched->what, progress->fraction * 100);
    return progress->fraction >= watched->stop_at;
}

static ptl_status build(ptl_graph *graph, ptl_block *result, ptl_error **error)
{
    ptl_block noise = 0;
    ptl_status status = ptl_graph_add_block(graph, "perlin noise", &noise, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "end", result, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, noise, 0, *result, 0, error);
    return status;
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_job *job = NULL;
    ptl_error *error = NULL;
    ptl_block end = 0;
    ptl_compute_options options;
    watch whole = {"here", 2.0}, half = {"job", 0.3};
    int is_done = 0;

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = options.height = 2048;
    options.progress = show;
    options.progress_interval_ms = 100;

    /* On this thread. */
    options.user_data = &whole;
    if (ptl_engine_create(NULL, &engine, &error) == PTL_OK &&
        ptl_graph_create(engine, &graph, &error) == PTL_OK &&
        build(graph, &end, &error) == PTL_OK &&
        ptl_graph_compute(graph, end, 0, &options, &image, &error) == PTL_OK) {
        printf("here: done\n");

        /* On a thread of its own; the callback still runs on this one, inside ptl_job_wait(). */
        options.user_data = &half;
        options.width = options.height = 4096;
        ptl_image_release(image);
        image = NULL;
        if (ptl_graph_compute_start(graph, end, 0, &options, &job, &error) == PTL_OK &&
            ptl_job_wait(job, -1, &image, &error) == PTL_E_CANCELLED) {
            printf("job: %s\n", ptl_error_message(error));
            ptl_error_release(error);
            error = NULL;
            is_done = 1;
        }
    }
    if (error != NULL) {
        fprintf(stderr, "%s\n", ptl_error_message(error));
    }
    /* every release takes NULL */
    ptl_error_release(error);
    ptl_job_release(job);
    ptl_image_release(image);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return is_done ? EXIT_SUCCESS : EXIT_FAILURE;
}
