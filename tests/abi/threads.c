/* Several threads and one graph: computing is shared, editing is for one at a time. */
#define _POSIX_C_SOURCE 200112L
#include "check.h"

#include <pthread.h>
#include <sched.h>

#define ROUNDS 200

static ptl_engine *engine;
static ptl_graph *graph;
static ptl_block source, end;

/* Every picture is of one level: no computation sees half an edit. */
static void *compute(void *argument)
{
    ptl_compute_options options;
    int i;
    size_t size = 0, k;
    (void)argument;
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = options.height = 16;
    for (i = 0; i < ROUNDS; i++) {
        ptl_image *image = NULL;
        const float *pixels;
        OK(ptl_graph_compute(graph, end, 0, &options, &image, &error));
        pixels = (const float *)ptl_image_pixels(image, &size);
        CHECK(size == 16 * 16 * sizeof *pixels);
        for (k = 0; k < 16 * 16; k++) CHECK(pixels[k] == pixels[0]);
        ptl_image_release(image);
    }
    return NULL;
}

/* Another editor may be at it: then the graph says so, is not harmed, and can be asked again. */
static void *edit(void *argument)
{
    int i;
    (void)argument;
    for (i = 0; i < ROUNDS; i++) {
        const double level = i / (double)ROUNDS;
        ptl_status status = PTL_E_BUSY;
        long tries;
        for (tries = 0; status == PTL_E_BUSY; tries++) {
            ptl_error *error = NULL;
            status = ptl_graph_set_float(graph, source, "level", &level, 1, &error);
            CHECK((status == PTL_OK) == (error == NULL));
            ptl_error_release(error);
            /* An editor that was interrupted is busy for a while, but not for ever. */
            CHECK(tries < 100000000);
            if (status == PTL_E_BUSY) sched_yield();
        }
        CHECK(status == PTL_OK);
    }
    return NULL;
}

/* Reference counts are shared by all threads. */
static void *retain(void *argument)
{
    int i;
    (void)argument;
    for (i = 0; i < ROUNDS; i++) {
        ptl_graph *more = ptl_graph_retain(graph);
        CHECK(more == graph && ptl_graph_block_count(more) == 3);
        ptl_graph_release(more);
    }
    return NULL;
}

int main(void)
{
    void *(*const work[])(void *) = {compute, compute, edit, edit, retain};
    pthread_t threads[sizeof work / sizeof *work];
    ptl_block invert = 0;
    size_t i;

    OK(ptl_engine_create(NULL, &engine, &error));
    OK(ptl_graph_create(engine, &graph, &error));
    OK(ptl_graph_add_block(graph, "test parameters", &source, &error));
    OK(ptl_graph_add_block(graph, "invert", &invert, &error));
    OK(ptl_graph_add_block(graph, "end", &end, &error));
    OK(ptl_graph_connect(graph, source, 0, invert, 0, &error));
    OK(ptl_graph_connect(graph, invert, 0, end, 0, &error));
    for (i = 0; i < sizeof work / sizeof *work; i++) {
        CHECK(pthread_create(&threads[i], NULL, work[i], NULL) == 0);
    }
    for (i = 0; i < sizeof work / sizeof *work; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
    }
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return 0;
}
