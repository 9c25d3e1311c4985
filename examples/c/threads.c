/* Many threads compute one graph at once, each with its own seed. Link with -pthread.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#define _POSIX_C_SOURCE 200112L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include <ptlib/ptlib.h>

#define THREADS 8

typedef struct task {
    const ptl_graph *graph; /* const: any number of threads may use it */
    ptl_block block;
    uint64_t seed;
    pthread_t thread;
    ptl_status status;
    ptl_error *error;
    ptl_image *image;
} task;

static void *compute(void *argument)
{
    task *mine = (task *)argument;
    ptl_compute_options options;
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.flags = PTL_COMPUTE_SEED;
    options.seed = mine->seed;
    options.format = PTL_FORMAT_GREY8;
    mine->status =
        ptl_graph_compute(mine->graph, mine->block, 0, &options, &mine->image, &mine->error);
    return NULL;
}

static ptl_status build(ptl_graph *graph, ptl_block *result, ptl_error **error)
{
    ptl_block noise = 0;
    ptl_status status = ptl_graph_add_block(graph, "simple noise", &noise, error);
    if (status == PTL_OK) status = ptl_graph_add_block(graph, "end", result, error);
    if (status == PTL_OK) status = ptl_graph_connect(graph, noise, 0, *result, 0, error);
    return status;
}

/* Starts all tasks, waits for them, and tells how many failed. */
static int run(task *tasks, const ptl_graph *graph, ptl_block block)
{
    int i, started, failed = 0;
    for (started = 0; started < THREADS; started++) {
        task *one = &tasks[started];
        one->graph = graph;
        one->block = block;
        one->seed = (uint64_t)started;
        one->status = PTL_OK;
        one->error = NULL;
        one->image = NULL;
        if (pthread_create(&one->thread, NULL, compute, one) != 0) break;
    }
    for (i = 0; i < started; i++) {
        pthread_join(tasks[i].thread, NULL);
        if (tasks[i].status == PTL_OK) {
            const unsigned char *pixels =
                (const unsigned char *)ptl_image_pixels(tasks[i].image, NULL);
            printf("seed %d: first pixel %d\n", i, pixels[0]);
        } else {
            fprintf(stderr, "seed %d: %s\n", i, ptl_error_message(tasks[i].error));
            failed++;
        }
        ptl_image_release(tasks[i].image);
        ptl_error_release(tasks[i].error);
    }
    return failed + THREADS - started;
}

int main(void)
{
    static task tasks[THREADS];
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_error *error = NULL;
    ptl_block end = 0;
    int failed = 1;

    if (ptl_engine_create(NULL, &engine, &error) == PTL_OK &&
        ptl_graph_create(engine, &graph, &error) == PTL_OK &&
        build(graph, &end, &error) == PTL_OK) {
        failed = run(tasks, graph, end);
    }
    if (error != NULL) {
        fprintf(stderr, "%s\n", ptl_error_message(error));
    }
    /* every release takes NULL */
    ptl_error_release(error);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
