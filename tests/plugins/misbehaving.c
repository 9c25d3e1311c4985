/* One block that breaks one promise, which the build chooses: -DBREAKS=n. The check of plug-ins
 * must find each. */
#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "ptlib/ptlib_plugin.h"

enum promise {
    NONE,          /* keeps all */
    CRASH,         /* reads memory that is not there */
    EXIT,          /* ends the process */
    HANG,          /* never returns */
    PRINT,         /* writes to the standard output */
    OUTSIDE,       /* writes beside its rectangle */
    UNWRITTEN,     /* leaves the last sample as it is */
    INPUT,         /* changes its input */
    RECTANGLE,     /* depends on the rectangle */
    CALLS,         /* depends on how often it was called */
    DEAF,          /* does not hear that it shall stop */
    LOCALE,        /* changes the locale */
    ROUNDING,      /* changes the floating-point mode */
    LEAK,          /* keeps memory */
    NOT_A_NUMBER,  /* gives numbers that are none */
    SLOW_LOAD      /* works while it is loaded */
};

static void spin(int milliseconds)
{
    const clock_t end = clock() + (clock_t)milliseconds * (CLOCKS_PER_SEC / 1000);
    while (clock() < end) {
    }
}

static ptlp_status PTLP_CALL init(const ptlp_host *host, const char *path)
{
    (void)host;
    (void)path;
    if (BREAKS == SLOW_LOAD)
        spin(300);
    return PTLP_OK;
}

static ptlp_status PTLP_CALL create(const ptlp_block *block, const ptlp_host *host, void **instance)
{
    static void *volatile kept[100000];
    static int count;
    (void)block;
    (void)host;
    *instance = malloc(1);
    if (BREAKS == LEAK && count < 100000) {
        void *memory = malloc(65536);
        if (memory)
            memset(memory, 1, 65536);
        kept[count++] = memory;
    }
    return *instance ? PTLP_OK : PTLP_E_NO_MEMORY;
}

static void PTLP_CALL destroy(void *instance)
{
    free(instance);
}

static void misbehave(const ptlp_tile *from, const ptlp_tile *to)
{
    static volatile int never = 1;
    switch (BREAKS) {
    case CRASH: *(volatile int *)8 = 1; break;
    case EXIT: exit(3);
    case HANG:
        while (never) {
        }
        break;
    case PRINT: puts("hello"), fflush(stdout); break;
    case OUTSIDE: to->planes[0][(to->height - 1) * to->row_stride + to->width] = 0.0f; break;
    case INPUT: from->planes[0][0] = 0.5f; break;
    case DEAF: spin(400); break;
    case LOCALE: setlocale(LC_ALL, "C.UTF-8"); break;
    case ROUNDING: fesetround(FE_UPWARD); break;
    default: break;
    }
}

static ptlp_status PTLP_CALL compute(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    static int calls;
    const ptlp_tile *from = (const ptlp_tile *)in[0]->value;
    const ptlp_tile *to = (const ptlp_tile *)out[0]->value;
    uint32_t channel, x, y;
    (void)instance;
    (void)job;
    calls++;
    for (channel = 0; channel < to->channels; channel++) {
        for (y = 0; y < to->height; y++) {
            for (x = 0; x < to->width; x++) {
                const int is_last = x + 1 == to->width && y + 1 == to->height;
                float value = from->planes[channel][y * from->row_stride + x];
                if (BREAKS == RECTANGLE && is_last)
                    value *= 0.5f;
                if (BREAKS == CALLS && calls % 2 == 0)
                    value *= 0.5f;
                if (BREAKS == NOT_A_NUMBER && is_last)
                    value = (float)NAN;
                if (BREAKS != UNWRITTEN || !is_last)
                    to->planes[channel][y * to->row_stride + x] = value;
            }
        }
    }
    misbehave(from, to);
    return PTLP_OK;
}

static const ptlp_port image = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, 0, 0, 0, "image", NULL};
static const ptlp_port result = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_AS_INPUT, 0, 0, "image", NULL};
static const ptlp_port *const inputs[] = {&image};
static const ptlp_port *const outputs[] = {&result};

static const ptlp_block block = {
    sizeof(ptlp_block), 1, PTLP_SHAPE_POINT, PTLP_THREADS_TILES, 0, 1, 1, 0,
    "ptlib-test.misbehaving", NULL, "testing", "The image, and trouble.", NULL, NULL,
    inputs, outputs, NULL, NULL, create, destroy, NULL, compute, NULL};
static const ptlp_block *const blocks[] = {&block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "ptlib-test.misbehaving", "Trouble", "The tests of ptlib", "1.0.0", "MIT OR Apache-2.0", NULL,
    init, NULL, NULL, blocks, 1, 0};
