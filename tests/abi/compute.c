/* Pixels, progress, cancelling, jobs: on the calling thread and on others. */
#define _POSIX_C_SOURCE 200112L
#include "check.h"

#include <pthread.h>
#include <time.h>

static ptl_engine *engine;
static ptl_graph *graph;
static ptl_block source, slow, end;

typedef struct watch {
    pthread_t thread;
    int calls;
    int cancel_at; /* number of the call that cancels, from 1; 0 for none, -1 for the last */
    double last;
    int nested; /* compute another picture inside the callback */
    ptl_job *release; /* release this job inside the callback */
} watch;

static int32_t watched(const ptl_progress *progress, void *user_data)
{
    watch *w = (watch *)user_data;
    w->calls++;
    CHECK(pthread_equal(pthread_self(), w->thread));
    CHECK(progress->struct_size == sizeof *progress && progress->block != 0);
    CHECK(progress->fraction >= 0 && progress->fraction <= 1);
    CHECK(progress->units_done <= progress->units_total && progress->fraction >= w->last);
    w->last = progress->fraction;
    if (w->nested) {
        ptl_image *image = NULL;
        OK(ptl_graph_compute(graph, source, 0, NULL, &image, &error));
        ptl_image_release(image);
    }
    if (w->release != NULL) {
        ptl_job_release(w->release);
        w->release = NULL;
    }
    return w->cancel_at == w->calls || (w->cancel_at == -1 && progress->fraction == 1);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

static ptl_compute_options watching(watch *w)
{
    ptl_compute_options options;
    memset(w, 0, sizeof *w);
    w->thread = pthread_self();
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.progress = watched;
    options.user_data = w;
    options.progress_interval_ms = 1;
    return options;
}

static void set_milliseconds(int64_t milliseconds)
{
    OK(ptl_graph_set_int(graph, slow, "milliseconds", milliseconds, &error));
}

static void pixels(void)
{
    ptl_compute_options options;
    ptl_image *image = NULL;
    ptl_image_info info;
    const float *floats;
    const unsigned char *bytes;
    unsigned short words[4 * 3 * 4];
    size_t size = 0, i;

    info.struct_size = sizeof info;
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = 4;
    options.height = 3;
    /* PTL_FORMAT_AUTO: one plane of floats, which is the engine's own memory. */
    OK(ptl_graph_compute(graph, source, 0, &options, &image, &error));
    CHECK(ptl_image_get_info(image, &info) == PTL_OK);
    CHECK(info.format == PTL_FORMAT_GREY_F32 && info.width == 4 && info.height == 3);
    CHECK(info.channels == 1 && info.bytes_per_channel == 4 && info.row_stride == 16);
    CHECK(info.color_space == PTL_COLOR_SPACE_SRGB && info.origin == PTL_ORIGIN_TOP_LEFT);
    floats = (const float *)ptl_image_pixels(image, &size);
    CHECK(size == 48 && info.size_bytes == 48 && (uintptr_t)floats % 64 == 0);
    for (i = 0; i < 12; i++) CHECK(floats[i] == 0.5f);
    CHECK(ptl_image_pixels(image, NULL) == floats);
    OK(ptl_image_copy(image, PTL_FORMAT_RGBA16, words, sizeof words, 0, &error));
    for (i = 0; i < 48; i++) CHECK(words[i] == (i % 4 == 3 ? 65535 : 32768));
    CHECK(ptl_image_retain(image) == image);
    ptl_image_release(image);
    CHECK(floats[0] == 0.5f);
    ptl_image_release(image);

    /* In 8-bit precision: bytes. Colour: three channels. */
    OK(ptl_graph_set_text(graph, source, "look", "colour", &error));
    options.precision = PTL_PRECISION_8BIT;
    OK(ptl_graph_compute(graph, source, 0, &options, &image, &error));
    CHECK(ptl_image_get_info(image, &info) == PTL_OK && info.format == PTL_FORMAT_RGB8);
    bytes = (const unsigned char *)ptl_image_pixels(image, &size);
    CHECK(size == 36 && (uintptr_t)bytes % 64 == 0);
    for (i = 0; i < 36; i++) CHECK(i % 3 == 1 ? bytes[i] == 0 : bytes[i] > 0);
    ptl_image_release(image);
    OK(ptl_graph_reset_param(graph, source, "look", &error));

    EXPECT(PTL_E_TYPE_MISMATCH, ptl_graph_compute(graph, source, 1, NULL, &image, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_compute(graph, source, 2, NULL, &image, &error));
}

typedef struct rows {
    uint32_t next;
    int calls, cancel_at;
} rows;

static int32_t take(const ptl_band *band, void *user_data)
{
    rows *taken = (rows *)user_data;
    const float *pixels = (const float *)band->pixels;
    uint32_t i;
    CHECK(band->struct_size == sizeof *band && band->reserved0 == 0);
    CHECK(band->first_row == taken->next && band->width == 4);
    CHECK(band->format == PTL_FORMAT_GREY_F32 && band->row_stride == 16);
    for (i = 0; i < band->rows * band->width; i++) CHECK(pixels[i] == 0.5f);
    taken->next += band->rows;
    return ++taken->calls == taken->cancel_at;
}

static void bands(void)
{
    ptl_compute_options options;
    rows taken = {0, 0, 0};

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = 4;
    options.height = 7;
    OK(ptl_graph_compute_bands(graph, source, 0, &options, 3, take, &taken, &error));
    CHECK(taken.next == 7 && taken.calls == 3);
    memset(&taken, 0, sizeof taken);
    taken.cancel_at = 2;
    EXPECT_MESSAGE(PTL_E_CANCELLED, "at row 3",
                   ptl_graph_compute_bands(graph, source, 0, &options, 3, take, &taken, &error));
    CHECK(taken.next == 6);
    EXPECT(PTL_E_INVALID_ARGUMENT,
           ptl_graph_compute_bands(graph, source, 0, &options, 3, NULL, NULL, &error));
    EXPECT(PTL_E_TYPE_MISMATCH,
           ptl_graph_compute_bands(graph, source, 1, &options, 3, take, &taken, &error));
}

static void progress_on_this_thread(void)
{
    watch w;
    ptl_compute_options options = watching(&w);
    ptl_image *image = NULL;

    set_milliseconds(50);
    OK(ptl_graph_compute(graph, end, 0, &options, &image, &error));
    CHECK(w.calls >= 3 && w.last == 1);
    ptl_image_release(image);

    options = watching(&w);
    w.nested = 1;
    set_milliseconds(20);
    OK(ptl_graph_compute(graph, end, 0, &options, &image, &error));
    CHECK(w.calls >= 2 && w.last == 1);
    ptl_image_release(image);
}

static void cancel_in_callback(int at)
{
    watch w;
    ptl_compute_options options = watching(&w);
    ptl_image *image = NULL;
    ptl_job *job = NULL;
    float pixel[1];

    set_milliseconds(at == -1 ? 20 : 60000);
    w.cancel_at = at;
    EXPECT(PTL_E_CANCELLED, ptl_graph_compute(graph, end, 0, &options, &image, &error));
    CHECK(image == NULL && (at == -1 ? w.last == 1 : w.calls == at));

    options = watching(&w);
    w.cancel_at = at;
    options.width = options.height = 1;
    EXPECT(PTL_E_CANCELLED,
           ptl_graph_compute_into(graph, end, 0, &options, pixel, sizeof pixel, 0, &error));

    options = watching(&w);
    w.cancel_at = at;
    options.width = options.height = 2;
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    EXPECT(PTL_E_CANCELLED, ptl_job_wait(job, -1, &image, &error));
    EXPECT(PTL_E_CANCELLED, ptl_job_wait(job, 0, &image, &error));
    ptl_job_release(job);
}

static void *request_soon(void *cancel)
{
    struct timespec wait = {0, 30 * 1000 * 1000};
    nanosleep(&wait, NULL);
    ptl_cancel_request((ptl_cancel *)cancel);
    return NULL;
}

static void cancel_from_another_thread(void)
{
    ptl_compute_options options;
    ptl_cancel *cancel = NULL;
    ptl_image *image = NULL;
    pthread_t thread;
    double start;

    set_milliseconds(60000);
    OK(ptl_cancel_create(&cancel, &error));
    CHECK(ptl_cancel_is_requested(cancel) == 0 && ptl_cancel_retain(cancel) == cancel);
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.cancel = cancel;
    CHECK(pthread_create(&thread, NULL, request_soon, cancel) == 0);
    start = seconds();
    EXPECT(PTL_E_CANCELLED, ptl_graph_compute(graph, end, 0, &options, &image, &error));
    /* Generous: instrumented runs on a busy machine are slow. It would take a minute. */
    CHECK(seconds() - start < 20);
    pthread_join(thread, NULL);
    CHECK(ptl_cancel_is_requested(cancel) == 1);
    /* It stays asked. */
    EXPECT(PTL_E_CANCELLED, ptl_graph_compute(graph, end, 0, &options, &image, &error));
    ptl_cancel_release(cancel);
    ptl_cancel_release(cancel);
}

static void jobs(void)
{
    watch w;
    ptl_compute_options options = watching(&w);
    ptl_job *job = NULL;
    ptl_image *image = NULL, *again = NULL;
    ptl_cancel *cancel = NULL;
    ptl_progress progress;
    ptl_status status;

    /* Waiting in pieces. */
    set_milliseconds(50);
    options.width = options.height = 3;
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    do {
        ptl_error *error = NULL;
        status = ptl_job_wait(job, 5, &image, &error);
        CHECK(error == NULL && (status == PTL_OK) == (image != NULL));
    } while (status == PTL_PENDING);
    CHECK(status == PTL_OK && w.last == 1);
    progress.struct_size = sizeof progress;
    CHECK(ptl_job_poll(job, &progress) == PTL_OK && progress.fraction == 1);
    CHECK(ptl_job_poll(job, NULL) == PTL_OK);
    OK(ptl_job_wait(job, 0, &again, &error));
    CHECK(again == image);
    ptl_image_release(again);
    ptl_job_release(job);
    job = NULL;
    CHECK(ptl_image_pixels(image, NULL) != NULL);
    ptl_image_release(image);

    /* What is wrong with the graph is told by waiting. */
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_compute_start(graph, 0, 0, NULL, &job, &error));
    CHECK(job == NULL);
    OK(ptl_graph_compute_start(graph, end, 9, NULL, &job, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_job_wait(job, -1, &image, &error));
    ptl_job_release(job);

    /* Released while it runs, without and within a callback. */
    set_milliseconds(60000);
    OK(ptl_graph_compute_start(graph, end, 0, NULL, &job, &error));
    CHECK(ptl_job_poll(job, NULL) == PTL_PENDING);
    ptl_job_release(job);
    options = watching(&w);
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    w.release = job;
    EXPECT(PTL_E_CANCELLED, ptl_job_wait(job, -1, &image, &error));

    /* The caller's request stops it too; releasing it does not make the request. */
    OK(ptl_cancel_create(&cancel, &error));
    options = watching(&w);
    options.cancel = cancel;
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    ptl_job_release(job);
    CHECK(ptl_cancel_is_requested(cancel) == 0);
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    ptl_cancel_request(cancel);
    EXPECT(PTL_E_CANCELLED, ptl_job_wait(job, -1, &image, &error));
    ptl_job_release(job);
    ptl_cancel_release(cancel);
}

int main(void)
{
    ptl_block invert = 0;
    OK(ptl_engine_create(NULL, &engine, &error));
    OK(ptl_graph_create(engine, &graph, &error));
    OK(ptl_graph_add_block(graph, "test parameters", &source, &error));
    OK(ptl_graph_add_block(graph, "test slow", &slow, &error));
    OK(ptl_graph_add_block(graph, "invert", &invert, &error));
    OK(ptl_graph_add_block(graph, "end", &end, &error));
    OK(ptl_graph_connect(graph, slow, 0, invert, 0, &error));
    OK(ptl_graph_connect(graph, invert, 0, end, 0, &error));
    pixels();
    bands();
    progress_on_this_thread();
    cancel_in_callback(1);
    cancel_in_callback(3);
    cancel_in_callback(-1);
    cancel_from_another_thread();
    jobs();
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return 0;
}
