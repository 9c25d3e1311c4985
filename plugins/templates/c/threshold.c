/* A plug-in for ptlib in C: one block that makes an image black and white.
 *
 * Copy this folder, and change, from the bottom up: the vendor, the list of blocks, the block's
 * description, its parameters, what it computes. The rules are at the top of ptlib_plugin.h. */
#include <stdlib.h>

#include <ptlib/ptlib_plugin.h>

/* What the parameters became. One of these serves all threads of a computation. */
typedef struct threshold {
    float level;
} threshold;

static ptlp_status PTLP_CALL create(const ptlp_block *block, const ptlp_host *host, void **instance)
{
    (void)block;
    (void)host;
    *instance = calloc(1, sizeof(threshold));
    return *instance ? PTLP_OK : PTLP_E_NO_MEMORY;
}

static void PTLP_CALL destroy(void *instance)
{
    free(instance);
}

static ptlp_status PTLP_CALL prepare(void *instance, const ptlp_job *job, const ptlp_setup *setup)
{
    threshold *self = (threshold *)instance;
    (void)job;
    self->level = (float)setup->values[0]->number; /* in the order of `params` */
    return PTLP_OK;
}

static ptlp_status PTLP_CALL compute(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *inputs,
    const ptlp_wire *const *outputs)
{
    const threshold *self = (const threshold *)instance;
    const ptlp_tile *from = (const ptlp_tile *)inputs[0]->value;
    const ptlp_tile *to = (const ptlp_tile *)outputs[0]->value;
    uint32_t channel, x, y;
    (void)job;
    for (channel = 0; channel < to->channels; channel++) {
        for (y = 0; y < to->height; y++) {
            const float *source = from->planes[channel] + y * from->row_stride;
            float *target = to->planes[channel] + y * to->row_stride;
            for (x = 0; x < to->width; x++)
                target[x] = source[x] >= self->level ? 1.0f : 0.0f;
        }
    }
    return PTLP_OK;
}

static const ptlp_param level = {
    sizeof(ptlp_param),
    PTLP_PARAM_FLOAT,
    0, 0,
    0.0, 1.0,  /* what is allowed */
    0.0, 1.0,  /* what a slider offers */
    0.5,       /* the default */
    "level", "Values below it become black, others white.",
    NULL, NULL, NULL, NULL};
static const ptlp_param *const params[] = {&level};

static const ptlp_port image = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, 0, 0, 0, "image", "What is divided."};
static const ptlp_port result = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_AS_INPUT, 0, 0, "image", NULL};
static const ptlp_port *const inputs[] = {&image};
static const ptlp_port *const outputs[] = {&result};

static const ptlp_block block = {
    sizeof(ptlp_block),
    1, /* counts up whenever results change */
    PTLP_SHAPE_POINT,
    PTLP_THREADS_TILES,
    0,
    1, 1, 1, /* inputs, outputs, parameters */
    "my-vendor.threshold", NULL, "adjust",
    "Black where an image is below a level, white elsewhere.",
    NULL, NULL,
    inputs, outputs, params,
    NULL,
    create, destroy, prepare, compute, NULL};
static const ptlp_block *const blocks[] = {&block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "my-vendor.threshold", "Threshold", "My vendor", "1.0.0", "MIT", NULL,
    NULL, NULL, NULL,
    blocks, sizeof blocks / sizeof blocks[0], 0};
