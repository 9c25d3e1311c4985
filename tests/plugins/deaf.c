/* A plug-in with a block that never asks whether it should stop. It says when it starts, and then
 * waits for a while. */
#define _POSIX_C_SOURCE 199309L
#include <time.h>

#include "ptlib/ptlib_plugin.h"

static const ptlp_host *host_of_all;

static ptlp_status PTLP_CALL init(const ptlp_host *host, const char *path)
{
    (void)path;
    host_of_all = host;
    return PTLP_OK;
}

static ptlp_status PTLP_CALL compute(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *inputs,
    const ptlp_wire *const *outputs)
{
    const struct timespec while_others_cancel = {0, 300000000};
    const ptlp_log *log = (const ptlp_log *)host_of_all->get_extension(host_of_all, PTLP_LOG);
    const ptlp_tile *to = (const ptlp_tile *)outputs[0]->value;
    uint32_t x, y;
    (void)instance;
    (void)inputs;
    log->write(host_of_all, job, PTLP_LOG_INFO, "started");
    nanosleep(&while_others_cancel, NULL);
    for (y = 0; y < to->height; y++)
        for (x = 0; x < to->width; x++)
            to->planes[0][y * to->row_stride + x] = 0.5f;
    return PTLP_OK;
}

static const ptlp_port result = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_GREY, 0, 0, "image", NULL};
static const ptlp_port *const outputs_of_all[] = {&result};

static const ptlp_block block = {
    sizeof(ptlp_block), 1, PTLP_SHAPE_WHOLE, PTLP_THREADS_TILES, 0, 0, 1, 0,
    "ptlib-test.deaf", NULL, "noise", "Grey, after a while.", NULL, NULL,
    NULL, outputs_of_all, NULL, NULL, NULL, NULL, NULL, compute, NULL};
static const ptlp_block *const blocks[] = {&block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "ptlib-test.deaf", "Deaf", "The tests of ptlib", "1.0.0", "MIT OR Apache-2.0", NULL,
    init, NULL, NULL, blocks, 1, 0};
