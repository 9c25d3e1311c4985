/* What a program does wrong: each time the right status, a message that names the argument, and
 * outputs that are untouched (handles: NULL). */
#include "check.h"

#include <math.h>

static ptl_engine *engine;
static ptl_graph *graph;
static ptl_block source, end;

/* The call is refused, with a message that names the argument. */
#define REFUSED(part, call) EXPECT_MESSAGE(PTL_E_INVALID_ARGUMENT, part, call)

/* A pointer that no call may leave where a handle should be NULL. */
#define POISON(type) ((type *)(void *)&engine)

static void setup(void)
{
    OK(ptl_engine_create(NULL, &engine, &error));
    OK(ptl_graph_create(engine, &graph, &error));
    OK(ptl_graph_add_block(graph, "test parameters", &source, &error));
    OK(ptl_graph_add_block(graph, "end", &end, &error));
    OK(ptl_graph_connect(graph, source, 0, end, 0, &error));
}

static void null_handles(void)
{
    ptl_block block = 77;
    uint32_t port = 77;
    uint64_t seed = 77;
    double value = 77;
    int64_t number = 77;
    const ptl_block_type *type = POISON(const ptl_block_type);
    ptl_graph *new_graph = POISON(ptl_graph);
    ptl_bytes *bytes = POISON(ptl_bytes);
    ptl_image *image = POISON(ptl_image);
    ptl_job *job = POISON(ptl_job);

    REFUSED("`engine` is NULL", ptl_graph_create(NULL, &new_graph, &error));
    CHECK(new_graph == NULL);
    new_graph = POISON(ptl_graph);
    REFUSED("`engine` is NULL", ptl_graph_load(NULL, "", 0, &new_graph, &error));
    CHECK(new_graph == NULL);
    new_graph = POISON(ptl_graph);
    REFUSED("`engine` is NULL", ptl_graph_load_file(NULL, "", &new_graph, &error));
    CHECK(new_graph == NULL);
    new_graph = POISON(ptl_graph);
    REFUSED("`graph` is NULL", ptl_graph_clone(NULL, &new_graph, &error));
    CHECK(new_graph == NULL);
    REFUSED("`engine` is NULL", ptl_engine_set_log(NULL, 1, NULL, NULL, NULL, &error));
    REFUSED("`graph` is NULL", ptl_graph_add_block(NULL, "end", &block, &error));
    REFUSED("`graph` is NULL", ptl_graph_remove_block(NULL, end, &error));
    REFUSED("`graph` is NULL", ptl_graph_connect(NULL, source, 0, end, 0, &error));
    REFUSED("`graph` is NULL", ptl_graph_disconnect(NULL, end, 0, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_float(NULL, source, "level", &value, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_int(NULL, source, "count", 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_text(NULL, source, "note", "a", &error));
    REFUSED("`graph` is NULL", ptl_graph_reset_param(NULL, source, "note", &error));
    REFUSED("`graph` is NULL", ptl_graph_get_float(NULL, source, "level", &value, 1, NULL, &error));
    REFUSED("`graph` is NULL", ptl_graph_get_int(NULL, source, "count", &number, &error));
    REFUSED("`graph` is NULL", ptl_graph_get_text(NULL, source, "note", &bytes, &error));
    CHECK(bytes == NULL);
    REFUSED("`graph` is NULL", ptl_graph_set_block_seed(NULL, source, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_reset_block_seed(NULL, source, &error));
    REFUSED("`graph` is NULL", ptl_graph_get_block_seed(NULL, source, &seed, NULL, &error));
    REFUSED("`graph` is NULL", ptl_graph_block_type(NULL, source, &type, &error));
    CHECK(type == NULL);
    REFUSED("`graph` is NULL", ptl_graph_block_id(NULL, source, &bytes, &error));
    REFUSED("`graph` is NULL", ptl_graph_block_type_id(NULL, source, &bytes, &error));
    REFUSED("`graph` is NULL", ptl_graph_input_source(NULL, end, 0, &block, &port, &error));
    REFUSED("`graph` is NULL", ptl_graph_validate(NULL, end, &error));
    REFUSED("`graph` is NULL", ptl_graph_save(NULL, &bytes, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_size(NULL, 1, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_seed(NULL, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_supersampling(NULL, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_precision(NULL, 1, &error));
    REFUSED("`graph` is NULL", ptl_graph_set_folder(NULL, "a", &error));
    REFUSED("`graph` is NULL", ptl_graph_compute(NULL, end, 0, NULL, &image, &error));
    CHECK(image == NULL);
    REFUSED("`graph` is NULL",
            ptl_graph_compute_into(NULL, end, 0, NULL, &value, sizeof value, 0, &error));
    REFUSED("`graph` is NULL",
            ptl_graph_compute_bands(NULL, end, 0, NULL, 0, NULL, NULL, &error));
    REFUSED("`graph` is NULL", ptl_graph_compute_start(NULL, end, 0, NULL, &job, &error));
    CHECK(job == NULL);
    REFUSED("`graph` is NULL", ptl_graph_write_files(NULL, NULL, &error));
    REFUSED("`job` is NULL", ptl_job_wait(NULL, 0, &image, &error));
    REFUSED("`image` is NULL", ptl_image_copy(NULL, 0, &value, 8, 0, &error));
    REFUSED("`image` is NULL", ptl_image_save(NULL, "a.png", &error));
    CHECK(block == 77 && port == 77 && seed == 77 && number == 77);
    CHECK(ptl_job_poll(NULL, NULL) == PTL_E_INVALID_ARGUMENT);
}

static void null_getters(void)
{
    size_t size = 77;
    CHECK(ptl_engine_block_type_count(NULL) == 0 && ptl_engine_block_type_at(NULL, 0) == NULL);
    CHECK(ptl_engine_find_block_type(NULL, "end") == NULL);
    CHECK(ptl_engine_find_block_type(engine, NULL) == NULL);
    CHECK(ptl_block_type_id(NULL) == NULL && ptl_block_type_name(NULL) == NULL);
    CHECK(ptl_block_type_category(NULL) == NULL && ptl_block_type_doc(NULL) == NULL);
    CHECK(ptl_block_type_plugin(NULL) == NULL && ptl_block_type_flags(NULL) == 0);
    CHECK(ptl_block_type_param_count(NULL) == 0 && ptl_block_type_input_count(NULL) == 0);
    CHECK(ptl_block_type_output_count(NULL) == 0);
    CHECK(ptl_graph_block_count(NULL) == 0 && ptl_graph_block_at(NULL, 0) == 0);
    CHECK(ptl_graph_find_block(NULL, "0") == 0 && ptl_graph_find_block(graph, NULL) == 0);
    CHECK(ptl_graph_main_result(NULL) == 0 && ptl_graph_warning_count(NULL) == 0);
    CHECK(ptl_error_status(NULL) == PTL_OK && ptl_error_message(NULL) == NULL);
    CHECK(ptl_error_block(NULL) == 0 && ptl_error_param(NULL) == NULL);
    CHECK(ptl_error_fault_count(NULL) == 0 && ptl_has_feature(NULL) == 0);
    CHECK(ptl_image_pixels(NULL, &size) == NULL && size == 0);
    size = 77;
    CHECK(ptl_bytes_data(NULL, &size) == NULL && size == 0);
    CHECK(ptl_cancel_is_requested(NULL) == 0);
    CHECK(ptl_engine_retain(NULL) == NULL && ptl_graph_retain(NULL) == NULL);
    CHECK(ptl_image_retain(NULL) == NULL && ptl_cancel_retain(NULL) == NULL);
    ptl_engine_release(NULL);
    ptl_graph_release(NULL);
    ptl_image_release(NULL);
    ptl_cancel_release(NULL);
    ptl_job_release(NULL);
    ptl_error_release(NULL);
    ptl_bytes_release(NULL);
    ptl_cancel_request(NULL);
    ptl_engine_options_init(NULL, sizeof(ptl_engine_options));
    ptl_compute_options_init(NULL, sizeof(ptl_compute_options));
}

static void null_arguments(void)
{
    ptl_block block = 77;
    uint32_t port = 77;
    ptl_graph *loaded = POISON(ptl_graph);
    const double value = 0.5;

    REFUSED("`out` is NULL", ptl_engine_create(NULL, NULL, &error));
    REFUSED("`out` is NULL", ptl_graph_create(engine, NULL, &error));
    REFUSED("`out` is NULL", ptl_cancel_create(NULL, &error));
    REFUSED("`type_id` is NULL", ptl_graph_add_block(graph, NULL, &block, &error));
    REFUSED("`out` is NULL", ptl_graph_add_block(graph, "end", NULL, &error));
    REFUSED("`param` is NULL", ptl_graph_set_int(graph, source, NULL, 1, &error));
    REFUSED("`utf8` is NULL", ptl_graph_set_text(graph, source, "note", NULL, &error));
    REFUSED("`values` is NULL", ptl_graph_set_float(graph, source, "level", NULL, 1, &error));
    REFUSED("`values` is NULL", ptl_graph_get_float(graph, source, "level", NULL, 1, NULL, &error));
    REFUSED("`out` is NULL", ptl_graph_get_int(graph, source, "count", NULL, &error));
    REFUSED("`out` is NULL", ptl_graph_get_text(graph, source, "note", NULL, &error));
    REFUSED("`src` is NULL", ptl_graph_input_source(graph, end, 0, NULL, &port, &error));
    REFUSED("`out_port` is NULL", ptl_graph_input_source(graph, end, 0, &block, NULL, &error));
    REFUSED("`out` is NULL", ptl_graph_compute(graph, end, 0, NULL, NULL, &error));
    REFUSED("`out` is NULL", ptl_graph_compute_start(graph, end, 0, NULL, NULL, &error));
    REFUSED("`data` is NULL", ptl_graph_load(engine, NULL, 5, &loaded, &error));
    CHECK(loaded == NULL);
    REFUSED("`seed` is NULL", ptl_graph_get_block_seed(graph, source, NULL, NULL, &error));
    REFUSED("`inout` is NULL", ptl_graph_get_info(graph, NULL, &error));
    CHECK(block == 77 && port == 77);
    /* Without a place for the error there is still a status. */
    CHECK(ptl_graph_set_float(graph, source, "level", &value, 2, NULL) == PTL_E_INVALID_ARGUMENT);
}

/* Handles of the wrong type are refused; a live object of any type tells what it is. */
static void wrong_types(void)
{
    void *as_void = engine;
    ptl_graph *no_graph = (ptl_graph *)as_void;
    ptl_image *no_image = (ptl_image *)as_void;
    ptl_block block = 77;
    size_t size = 77;

    REFUSED("`graph` is not a ptl_graph", ptl_graph_add_block(no_graph, "end", &block, &error));
    CHECK(block == 77 && ptl_graph_block_count(no_graph) == 0);
    CHECK(ptl_image_pixels(no_image, &size) == NULL && size == 0);
    ptl_graph_release(no_graph);
    CHECK(ptl_engine_block_type_count(engine) > 0);
}

static void stale_blocks(void)
{
    ptl_block old = 0, next = 0, from = 77;
    uint32_t port = 77;
    ptl_image *image = POISON(ptl_image);

    OK(ptl_graph_add_block(graph, "invert", &old, &error));
    OK(ptl_graph_remove_block(graph, old, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_remove_block(graph, old, &error));
    OK(ptl_graph_add_block(graph, "invert", &next, &error));
    CHECK(next != old);
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_connect(graph, source, 0, old, 0, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_disconnect(graph, old, 0, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_set_int(graph, old, "count", 1, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_set_block_seed(graph, old, 1, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_input_source(graph, old, 0, &from, &port, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_validate(graph, old, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_compute(graph, old, 0, NULL, &image, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_compute(graph, 0, 0, NULL, &image, &error));
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_compute(graph, UINT64_MAX, 0, NULL, &image, &error));
    CHECK(image == NULL && from == 77 && port == 77);
    OK(ptl_graph_remove_block(graph, next, &error));
}

static void wrong_connections(void)
{
    ptl_block one = 0, two = 0;
    OK(ptl_graph_add_block(graph, "invert", &one, &error));
    OK(ptl_graph_add_block(graph, "invert", &two, &error));
    OK(ptl_graph_connect(graph, one, 0, two, 0, &error));
    EXPECT_MESSAGE(PTL_E_CYCLE, "cycle", ptl_graph_connect(graph, two, 0, one, 0, &error));
    EXPECT(PTL_E_CYCLE, ptl_graph_connect(graph, one, 0, one, 0, &error));
    EXPECT_MESSAGE(PTL_E_TYPE_MISMATCH, "text",
                   ptl_graph_connect(graph, source, 1, one, 0, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_connect(graph, source, 2, one, 0, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_connect(graph, source, 0, one, 1, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_connect(graph, source, UINT32_MAX, one, UINT32_MAX, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_disconnect(graph, one, 1, &error));
    EXPECT(PTL_E_UNCONNECTED, ptl_graph_validate(graph, two, &error));
    OK(ptl_graph_remove_block(graph, one, &error));
    OK(ptl_graph_remove_block(graph, two, &error));
}

static void wrong_values(void)
{
    double value = NAN, read = 77;
    const double two[2] = {0.25, 0.5};
    uint32_t count = 77;
    int64_t number = 77;
    ptl_bytes *bytes = POISON(ptl_bytes);

    EXPECT_MESSAGE(PTL_E_OUT_OF_RANGE, "allowed 0..=1",
                   ptl_graph_set_float(graph, source, "level", &value, 1, &error));
    value = INFINITY;
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_float(graph, source, "level", &value, 1, &error));
    value = 1.5;
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_float(graph, source, "level", &value, 1, &error));
    REFUSED("`count`", ptl_graph_set_float(graph, source, "level", two, 2, &error));
    REFUSED("`count`", ptl_graph_set_float(graph, source, "level", NULL, 0, &error));
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_graph_set_float(graph, source, "count", two, 1, &error));
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_int(graph, source, "count", 1001, &error));
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_int(graph, source, "count", INT64_MAX, &error));
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_int(graph, source, "look", -1, &error));
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_int(graph, source, "look", 2, &error));
    EXPECT(PTL_E_PARSE, ptl_graph_set_text(graph, source, "count", "many", &error));
    EXPECT_MESSAGE(PTL_E_NOT_FOUND, "did you mean \"level\"",
                   ptl_graph_set_text(graph, source, "levle", "1", &error));
    REFUSED("`utf8` is not UTF-8 from byte 1",
            ptl_graph_set_text(graph, source, "note", "a\xff", &error));
    REFUSED("`param` is not UTF-8", ptl_graph_set_text(graph, source, "\xc3", "a", &error));
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_graph_get_int(graph, source, "level", &number, &error));
    EXPECT(PTL_E_TYPE_MISMATCH,
           ptl_graph_get_float(graph, source, "note", &read, 1, &count, &error));
    EXPECT_MESSAGE(PTL_E_BUFFER_TOO_SMALL, "`capacity`",
                   ptl_graph_get_float(graph, source, "level", NULL, 0, &count, &error));
    EXPECT(PTL_E_NOT_FOUND, ptl_graph_get_text(graph, source, "none", &bytes, &error));
    CHECK(read == 77 && count == 77 && number == 77 && bytes == NULL);
    OK(ptl_graph_get_float(graph, source, "level", &read, 1, &count, &error));
    CHECK(read == 0.5 && count == 1);
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_size(graph, 0, 5, &error));
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_set_supersampling(graph, 7, &error));
    REFUSED("`precision`", ptl_graph_set_precision(graph, 0, &error));
    REFUSED("`min_level`", ptl_engine_set_log(engine, 0, NULL, NULL, NULL, &error));
}

static void errors_tell_where(void)
{
    ptl_error *error = NULL;
    ptl_fault fault;
    CHECK(ptl_graph_set_int(graph, source, "count", 5000, &error) == PTL_E_OUT_OF_RANGE);
    CHECK(ptl_error_block(error) == source);
    CHECK(strcmp(ptl_error_param(error), "count") == 0);
    CHECK(ptl_error_fault_count(error) == 1);
    fault.struct_size = sizeof fault;
    CHECK(ptl_error_fault_at(error, 0, &fault) == PTL_OK);
    CHECK(fault.status == PTL_E_OUT_OF_RANGE && fault.block == source && fault.line == 0);
    CHECK(strcmp(fault.param, "count") == 0 && strstr(fault.message, "5000") != NULL);
    fault.status = 77;
    CHECK(ptl_error_fault_at(error, 1, &fault) == PTL_E_NOT_FOUND && fault.status == 77);
    ptl_error_release(error);
}

static void wrong_structs(void)
{
    struct {
        ptl_compute_options known;
        uint64_t tail;
    } newer;
    ptl_compute_options *options = &newer.known;
    ptl_image_info info;
    ptl_image *image = NULL;
    ptl_engine *other = POISON(ptl_engine);
    ptl_engine_options engine_options;

    memset(&newer, 0, sizeof newer);
    REFUSED("`options` has struct_size 0",
            ptl_graph_compute(graph, end, 0, options, &image, &error));
    options->struct_size = UINT32_MAX;
    REFUSED("`options`", ptl_graph_compute(graph, end, 0, options, &image, &error));
    options->struct_size = sizeof newer;
    newer.tail = 1;
    EXPECT_MESSAGE(PTL_E_UNSUPPORTED, "`options`",
                   ptl_graph_compute(graph, end, 0, options, &image, &error));
    newer.tail = 0;
    OK(ptl_graph_compute(graph, end, 0, options, &image, &error));
    ptl_image_release(image);
    /* As much as a program of an older version would have: the size, nothing behind it. */
    options->struct_size = (uint32_t)offsetof(ptl_compute_options, format);
    options->width = options->height = 9;
    options->format = 0xdead;
    OK(ptl_graph_compute(graph, end, 0, options, &image, &error));
    memset(&info, 0x55, sizeof info);
    info.struct_size = (uint32_t)offsetof(ptl_image_info, channels);
    CHECK(ptl_image_get_info(image, &info) == PTL_OK);
    CHECK(info.width == 9 && info.height == 9 && info.channels == 0x55555555);
    info.struct_size = 1;
    CHECK(ptl_image_get_info(image, &info) == PTL_E_INVALID_ARGUMENT);
    ptl_image_release(image);

    PTL_COMPUTE_OPTIONS_INIT(options);
    CHECK(options->struct_size == sizeof *options && options->format == 0);
    options->region[2] = 1;
    EXPECT_MESSAGE(PTL_E_UNSUPPORTED, "`region`",
                   ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->flags = 1u << 31;
    EXPECT_MESSAGE(PTL_E_UNSUPPORTED, "`flags`",
                   ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->reserved1 = &newer;
    EXPECT(PTL_E_UNSUPPORTED, ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->format = 0x0102;
    REFUSED("`format`", ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->width = 5;
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_graph_compute(graph, end, 0, options, &image, &error));
    options->height = UINT32_MAX;
    EXPECT(PTL_E_LIMIT, ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->width = options->height = 4096;
    options->memory_limit = 1000;
    EXPECT(PTL_E_LIMIT, ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->supersampling = 7;
    EXPECT(PTL_E_OUT_OF_RANGE, ptl_graph_compute(graph, end, 0, options, &image, &error));
    PTL_COMPUTE_OPTIONS_INIT(options);
    options->precision = 9;
    REFUSED("`precision`", ptl_graph_compute(graph, end, 0, options, &image, &error));
    CHECK(image == NULL);

    PTL_ENGINE_OPTIONS_INIT(&engine_options);
    engine_options.read_folder_count = 1;
    REFUSED("`read_folders` is NULL", ptl_engine_create(&engine_options, &other, &error));
    CHECK(other == NULL);
    PTL_ENGINE_OPTIONS_INIT(&engine_options);
    engine_options.flags = 2;
    EXPECT(PTL_E_UNSUPPORTED, ptl_engine_create(&engine_options, &other, &error));
}

static void wrong_buffers(void)
{
    unsigned char pixels[8 * 5 * 3 + 7];
    ptl_compute_options options;
    ptl_image *image = NULL;
    size_t i;

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = 8;
    options.height = 5;
    options.format = PTL_FORMAT_RGB8;
    memset(pixels, 7, sizeof pixels);
    EXPECT_MESSAGE(PTL_E_BUFFER_TOO_SMALL, "120 needed",
                   ptl_graph_compute_into(graph, end, 0, &options, pixels, 119, 0, &error));
    EXPECT(PTL_E_INVALID_ARGUMENT,
           ptl_graph_compute_into(graph, end, 0, &options, pixels, 120, 23, &error));
    REFUSED("`pixels` is NULL",
            ptl_graph_compute_into(graph, end, 0, &options, NULL, 120, 0, &error));
    EXPECT(PTL_E_BUFFER_TOO_SMALL,
           ptl_graph_compute_into(graph, end, 0, &options, NULL, 0, 0, &error));
    EXPECT(PTL_E_BUFFER_TOO_SMALL,
           ptl_graph_compute_into(graph, end, 0, &options, pixels, 120, SIZE_MAX, &error));
    EXPECT(PTL_E_INVALID_ARGUMENT,
           ptl_graph_compute_into(graph, end, 0, &options, pixels, SIZE_MAX, 0, &error));
    OK(ptl_graph_compute(graph, end, 0, &options, &image, &error));
    EXPECT(PTL_E_BUFFER_TOO_SMALL, ptl_image_copy(image, 0, pixels, 119, 0, &error));
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_image_copy(image, 0, pixels, 120, 23, &error));
    REFUSED("`dst` is NULL", ptl_image_copy(image, 0, NULL, 120, 0, &error));
    REFUSED("`format`", ptl_image_copy(image, 5, pixels, 120, 0, &error));
    for (i = 0; i < sizeof pixels; i++) CHECK(pixels[i] == 7);

    /* Rows need not be aligned: 8 pixels of 3 bytes, one byte between rows. */
    OK(ptl_graph_compute_into(graph, end, 0, &options, pixels, sizeof pixels, 25, &error));
    for (i = 0; i < sizeof pixels; i++) {
        CHECK(pixels[i] == (i % 25 == 24 || i >= 4 * 25 + 24 ? 7 : 128));
    }
    ptl_image_release(image);
}

static void wrong_files(void)
{
    ptl_graph *loaded = POISON(ptl_graph);
    ptl_image *image = NULL;
    ptl_block file = 0;

    EXPECT(PTL_E_PARSE, ptl_graph_load(engine, "<graph", 6, &loaded, &error));
    CHECK(loaded == NULL);
    EXPECT(PTL_E_PARSE, ptl_graph_load(engine, NULL, 0, &loaded, &error));
    EXPECT(PTL_E_IO, ptl_graph_load_file(engine, "no such folder/graph.xml", &loaded, &error));
    EXPECT(PTL_E_IO, ptl_graph_load_file(engine, "", &loaded, &error));
    CHECK(loaded == NULL);

    OK(ptl_graph_compute(graph, end, 0, NULL, &image, &error));
    EXPECT(PTL_E_IO, ptl_image_save(image, "no such folder/picture.png", &error));
    EXPECT(PTL_E_UNSUPPORTED, ptl_image_save(image, "picture.no such format", &error));
    ptl_image_release(image);
    image = NULL;

    OK(ptl_graph_add_block(graph, "load file", &file, &error));
    OK(ptl_graph_set_text(graph, file, "path", "/etc/passwd", &error));
    EXPECT(PTL_E_DENIED, ptl_graph_compute(graph, file, 0, NULL, &image, &error));
    CHECK(image == NULL);
}

int main(void)
{
    setup();
    null_handles();
    null_getters();
    null_arguments();
    wrong_types();
    stale_blocks();
    wrong_connections();
    wrong_values();
    errors_tell_where();
    wrong_structs();
    wrong_buffers();
    wrong_files();
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    return 0;
}
