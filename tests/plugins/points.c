/* A plug-in of blocks of shape Point: an inversion, and one that shows all kinds of parameters. */
#include "ptlib/ptlib_plugin.h"

static const ptlp_port image = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, 0, 0, 0, "image", "What is inverted."};
static const ptlp_port result = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_AS_INPUT, 0, 0, "image", NULL};
static const ptlp_port *const inputs[] = {&image};
static const ptlp_port *const outputs[] = {&result};

static ptlp_status PTLP_CALL invert(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    const ptlp_tile *from = (const ptlp_tile *)in[0]->value;
    const ptlp_tile *to = (const ptlp_tile *)out[0]->value;
    uint32_t channel, x, y;
    (void)instance;
    (void)job;
    for (channel = 0; channel < to->channels; channel++) {
        for (y = 0; y < to->height; y++) {
            const float *source = from->planes[channel] + y * from->row_stride;
            float *target = to->planes[channel] + y * to->row_stride;
            for (x = 0; x < to->width; x++)
                target[x] = 1.0f - source[x];
        }
    }
    return PTLP_OK;
}

static const ptlp_block invert_block = {
    sizeof(ptlp_block), 1, PTLP_SHAPE_POINT, PTLP_THREADS_TILES, 0, 1, 1, 0,
    "ptlib-test.invert", NULL, "adjust", "The negative of an image.", NULL, NULL,
    inputs, outputs, NULL, NULL, NULL, NULL, NULL, invert, NULL};

static const ptlp_block *const blocks[] = {&invert_block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "ptlib-test.points", "Points", "The tests of ptlib", "1.0.0", "MIT OR Apache-2.0", NULL,
    NULL, NULL, NULL, blocks, sizeof blocks / sizeof blocks[0], 0};
