/* A panic inside a block is an error of that computation; the program and the engine live on. */
#include "check.h"

static ptl_block add(ptl_graph *graph, const char *type)
{
    ptl_block block = 0, end = 0;
    OK(ptl_graph_add_block(graph, type, &block, &error));
    OK(ptl_graph_add_block(graph, "end", &end, &error));
    OK(ptl_graph_connect(graph, block, 0, end, 0, &error));
    return end;
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_graph *good = NULL, *bad = NULL;
    ptl_image *image = NULL;
    ptl_job *job = NULL;
    ptl_block good_end, bad_end, bad_block;
    int i;

    OK(ptl_engine_create(NULL, &engine, &error));
    OK(ptl_graph_create(engine, &good, &error));
    OK(ptl_graph_create(engine, &bad, &error));
    good_end = add(good, "test parameters");
    bad_end = add(bad, "test panic");
    bad_block = ptl_graph_block_at(bad, 0);
    for (i = 0; i < 4; i++) {
        static const char *const messages[] = {"test panic in row", "test panic before"};
        OK(ptl_graph_set_int(bad, bad_block, "early", i % 2, &error));
        EXPECT_MESSAGE(PTL_E_INTERNAL, messages[i % 2],
                       ptl_graph_compute(bad, bad_end, 0, NULL, &image, &error));
        CHECK(image == NULL);
        OK(ptl_graph_compute_start(bad, bad_end, 0, NULL, &job, &error));
        EXPECT_MESSAGE(PTL_E_INTERNAL, messages[i % 2], ptl_job_wait(job, -1, &image, &error));
        ptl_job_release(job);
        /* The same engine, another graph. */
        OK(ptl_graph_compute(good, good_end, 0, NULL, &image, &error));
        ptl_image_release(image);
        image = NULL;
    }
    /* The graph was only read: it can still be changed and looked at. */
    OK(ptl_graph_remove_block(bad, bad_block, &error));
    CHECK(ptl_graph_block_count(bad) == 1);
    ptl_graph_release(bad);
    ptl_graph_release(good);
    ptl_engine_release(engine);
    return 0;
}
