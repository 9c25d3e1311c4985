/* From the engine to the pixels and back, and every order of releasing what was made. */
#include "check.h"

static void count_free(void *user_data) { ++*(int *)user_data; }

static void count_log(int32_t level, const char *message, void *user_data)
{
    CHECK(level >= PTL_LOG_WARNING && message != NULL);
    (void)user_data;
}

static void versions(void)
{
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", PTL_VERSION_MAJOR, PTL_VERSION_MINOR,
             PTL_VERSION_PATCH);
    CHECK(strcmp(ptl_version_string(), text) == 0);
    CHECK(ptl_has_feature("teapots") == 0);
    CHECK(strcmp(ptl_status_name(PTL_E_STALE_HANDLE), "PTL_E_STALE_HANDLE") == 0);
    CHECK(strcmp(ptl_status_name(12345), "unknown status") == 0);
}

static void catalogue(const ptl_engine *engine)
{
    const ptl_block_type *type = ptl_engine_find_block_type(engine, "test parameters");
    ptl_param_info param;
    ptl_port_info port;
    uint32_t i;

    CHECK(type != NULL && strcmp(ptl_block_type_id(type), "test parameters") == 0);
    CHECK(strcmp(ptl_block_type_name(type), "Test parameters") == 0);
    CHECK(strcmp(ptl_block_type_category(type), "testing") == 0);
    CHECK(strcmp(ptl_block_type_plugin(type), "") == 0 && *ptl_block_type_doc(type) != '\0');
    CHECK(ptl_block_type_flags(type) == PTL_BLOCK_TILES);
    CHECK(ptl_block_type_input_count(type) == 1 && ptl_block_type_output_count(type) == 2);
    CHECK(ptl_block_type_param_count(type) == 5);
    param.struct_size = sizeof param;
    CHECK(ptl_block_type_param_info(type, 0, &param) == PTL_OK);
    CHECK(param.type == PTL_PARAM_INT && strcmp(param.id, "count") == 0);
    CHECK(strcmp(param.unit, "things") == 0 && strcmp(param.doc, "Changes nothing.") == 0);
    CHECK(param.min == -5 && param.max == 1000 && param.soft_min == 0 && param.soft_max == 10);
    CHECK(param.step == 1 && param.default_value[0] == 3 && param.components == 1);
    CHECK(strcmp(param.default_text, "3") == 0 && param.enum_count == 0);
    CHECK(ptl_block_type_param_info(type, 1, &param) == PTL_OK);
    CHECK(param.type == PTL_PARAM_FLOAT && param.step == 0 && param.default_value[0] == 0.5);
    CHECK(ptl_block_type_param_info(type, 2, &param) == PTL_OK);
    CHECK(param.type == PTL_PARAM_FLAG && param.max == 1);
    CHECK(strcmp(param.id, "is off") == 0 && strcmp(param.name, "Is off") == 0);
    CHECK(ptl_block_type_param_info(type, 3, &param) == PTL_OK);
    CHECK(param.type == PTL_PARAM_CHOICE && param.enum_count == 2 && param.max == 1);
    CHECK(strcmp(param.enum_ids[1], "colour") == 0 && *param.enum_docs[1] != '\0');
    CHECK(strcmp(param.default_text, "grey") == 0);
    CHECK(ptl_block_type_param_info(type, 4, &param) == PTL_OK);
    CHECK(param.type == PTL_PARAM_TEXT && param.components == 0);
    CHECK(strcmp(param.default_text, "nothing") == 0);
    CHECK(ptl_block_type_param_info(type, 5, &param) == PTL_E_NOT_FOUND);
    port.struct_size = sizeof port;
    CHECK(ptl_block_type_input_info(type, 0, &port) == PTL_OK);
    CHECK(port.kind == PTL_KIND_TEXT && port.flags == PTL_PORT_OPTIONAL);
    CHECK(ptl_block_type_output_info(type, 1, &port) == PTL_OK && port.kind == PTL_KIND_TEXT);
    CHECK(ptl_block_type_output_info(type, 2, &port) == PTL_E_NOT_FOUND);
    /* Everything that is listed is found again. */
    for (i = 0; i < ptl_engine_block_type_count(engine); i++) {
        type = ptl_engine_block_type_at(engine, i);
        CHECK(ptl_engine_find_block_type(engine, ptl_block_type_id(type)) == type);
    }
    CHECK(ptl_engine_block_type_at(engine, i) == NULL);
    CHECK(ptl_engine_find_block_type(engine, "no such type") == NULL);
}

static int text_is(ptl_bytes *bytes, const char *text)
{
    size_t size = 0;
    const char *data = (const char *)ptl_bytes_data(bytes, &size);
    const int same = size == strlen(text) && strcmp(data, text) == 0;
    ptl_bytes_release(bytes);
    return same;
}

static void parameters(ptl_graph *graph, ptl_block block)
{
    double value = 0.25;
    int64_t number = 0;
    uint64_t seed = 0;
    int32_t is_own = 5;
    ptl_bytes *bytes = NULL;

    OK(ptl_graph_set_float(graph, block, "level", &value, 1, &error));
    value = 0;
    OK(ptl_graph_get_float(graph, block, "level", &value, 1, NULL, &error));
    CHECK(value == 0.25);
    OK(ptl_graph_set_int(graph, block, "count", 8, &error));
    OK(ptl_graph_get_int(graph, block, "count", &number, &error));
    CHECK(number == 8);
    OK(ptl_graph_set_int(graph, block, "is off", 1, &error));
    OK(ptl_graph_get_text(graph, block, "is off", &bytes, &error));
    CHECK(text_is(bytes, "true"));
    OK(ptl_graph_reset_param(graph, block, "is off", &error));
    OK(ptl_graph_get_int(graph, block, "is off", &number, &error));
    CHECK(number == 0);
    OK(ptl_graph_set_text(graph, block, "look", "colour", &error));
    OK(ptl_graph_get_int(graph, block, "look", &number, &error));
    CHECK(number == 1);
    OK(ptl_graph_get_text(graph, block, "look", &bytes, &error));
    CHECK(text_is(bytes, "colour"));
    OK(ptl_graph_set_text(graph, block, "note", "K\xc3\xa4se", &error));
    OK(ptl_graph_get_text(graph, block, "note", &bytes, &error));
    CHECK(text_is(bytes, "K\xc3\xa4se"));
    OK(ptl_graph_reset_param(graph, block, "look", &error));

    OK(ptl_graph_get_block_seed(graph, block, &seed, &is_own, &error));
    CHECK(seed == 42 && is_own == 0);
    OK(ptl_graph_set_block_seed(graph, block, UINT64_MAX, &error));
    OK(ptl_graph_get_block_seed(graph, block, &seed, &is_own, &error));
    CHECK(seed == UINT64_MAX && is_own == 1);
    OK(ptl_graph_reset_block_seed(graph, block, &error));
    OK(ptl_graph_get_block_seed(graph, block, &seed, NULL, &error));
    CHECK(seed == 42);
}

static void settings(ptl_graph *graph)
{
    ptl_graph_info info;
    info.struct_size = sizeof info;
    OK(ptl_graph_set_size(graph, 40, 30, &error));
    OK(ptl_graph_set_seed(graph, 42, &error));
    OK(ptl_graph_set_supersampling(graph, 2, &error));
    OK(ptl_graph_set_precision(graph, PTL_PRECISION_8BIT, &error));
    OK(ptl_graph_set_folder(graph, ".", &error));
    OK(ptl_graph_set_folder(graph, NULL, &error));
    OK(ptl_graph_get_info(graph, &info, &error));
    CHECK(info.width == 40 && info.height == 30 && info.seed == 42 && info.supersampling == 2);
    CHECK(info.precision == PTL_PRECISION_8BIT && info.block_count == ptl_graph_block_count(graph));
}

/* Two blocks, connected; returns the result. */
static ptl_block build(ptl_graph *graph, ptl_block *source)
{
    ptl_block end = 0, from = 0;
    uint32_t port = 5;
    const ptl_block_type *type = NULL;
    ptl_bytes *bytes = NULL;

    OK(ptl_graph_add_block(graph, "test parameters", source, &error));
    CHECK(ptl_graph_main_result(graph) == 0);
    OK(ptl_graph_add_block(graph, "end", &end, &error));
    OK(ptl_graph_connect(graph, *source, 0, end, 0, &error));
    OK(ptl_graph_input_source(graph, end, 0, &from, &port, &error));
    CHECK(from == *source && port == 0);
    OK(ptl_graph_disconnect(graph, end, 0, &error));
    OK(ptl_graph_input_source(graph, end, 0, &from, &port, &error));
    CHECK(from == 0);
    OK(ptl_graph_connect(graph, *source, 0, end, 0, &error));
    OK(ptl_graph_validate(graph, end, &error));
    CHECK(ptl_graph_main_result(graph) == end && ptl_graph_block_count(graph) == 2);
    CHECK(ptl_graph_block_at(graph, 1) == end && ptl_graph_block_at(graph, 2) == 0);
    OK(ptl_graph_block_type(graph, end, &type, &error));
    CHECK(strcmp(ptl_block_type_id(type), "end") == 0);
    CHECK(ptl_block_type_flags(type) & PTL_BLOCK_IS_RESULT);
    OK(ptl_graph_block_type_id(graph, end, &bytes, &error));
    CHECK(text_is(bytes, "end"));
    OK(ptl_graph_block_id(graph, end, &bytes, &error));
    CHECK(ptl_graph_find_block(graph, (const char *)ptl_bytes_data(bytes, NULL)) == end);
    ptl_bytes_release(bytes);
    return end;
}

/* A graph that is written and read again is the same. */
static void save_and_load(ptl_engine *engine, const ptl_graph *graph)
{
    ptl_bytes *first = NULL, *second = NULL;
    ptl_graph *loaded = NULL;
    size_t size = 0, other = 0;
    const void *data;

    OK(ptl_graph_save(graph, &first, &error));
    data = ptl_bytes_data(first, &size);
    OK(ptl_graph_load(engine, data, size, &loaded, &error));
    CHECK(ptl_graph_warning_count(loaded) == 0);
    OK(ptl_graph_save(loaded, &second, &error));
    CHECK(memcmp(ptl_bytes_data(second, &other), data, size) == 0 && size == other);
    ptl_bytes_release(first);
    ptl_bytes_release(second);
    ptl_graph_release(loaded);
}

/* Faults of a file tell their places; warnings stay with the graph. */
static void faults_of_files(ptl_engine *engine)
{
    static const char broken[] = "<texturegraph width=\"x\"/>\n";
    static const char strange[] =
        "<texturegraph width=\"8\" height=\"8\" seed=\"0\" supersampling=\"1\">\n"
        "<block id=\"0\" type=\"no such type\"/>\n</texturegraph>\n";
    ptl_error *error = NULL;
    ptl_graph *graph = NULL;
    ptl_fault fault;

    fault.struct_size = sizeof fault;
    CHECK(ptl_graph_load(engine, broken, sizeof broken - 1, &graph, &error) != PTL_OK);
    CHECK(ptl_error_fault_count(error) > 0 && ptl_error_fault_at(error, 0, &fault) == PTL_OK);
    CHECK(fault.line > 0 && fault.column > 0);
    ptl_error_release(error);
    OK(ptl_graph_load(engine, strange, sizeof strange - 1, &graph, &error));
    CHECK(ptl_graph_warning_count(graph) > 0);
    CHECK(ptl_graph_warning_at(graph, 0, &fault) == PTL_OK && fault.line == 2);
    CHECK(strstr(fault.message, "no such type") != NULL);
    ptl_graph_release(graph);
}

/* Graphs write files only where the engine's options say so. */
static void files(void)
{
    const char *const here[] = {"."};
    ptl_engine_options options;
    ptl_engine *closed = NULL, *open = NULL;
    ptl_graph *graph = NULL;
    ptl_block source = 0, file = 0;
    FILE *picture;
    int i;

    PTL_ENGINE_OPTIONS_INIT(&options);
    OK(ptl_engine_create(&options, &closed, &error));
    options.write_folders = here;
    options.write_folder_count = 1;
    OK(ptl_engine_create(&options, &open, &error));
    for (i = 0; i < 2; i++) {
        OK(ptl_graph_create(i == 0 ? closed : open, &graph, &error));
        OK(ptl_graph_set_folder(graph, ".", &error));
        OK(ptl_graph_write_files(graph, NULL, &error));
        OK(ptl_graph_add_block(graph, "test parameters", &source, &error));
        OK(ptl_graph_add_block(graph, "save file", &file, &error));
        OK(ptl_graph_connect(graph, source, 0, file, 0, &error));
        OK(ptl_graph_set_text(graph, file, "path", "written.png", &error));
        remove("written.png");
        EXPECT(i == 0 ? PTL_E_DENIED : PTL_OK, ptl_graph_write_files(graph, NULL, &error));
        picture = fopen("written.png", "rb");
        CHECK((picture != NULL) == (i == 1));
        if (picture != NULL) CHECK(fclose(picture) == 0);
        ptl_graph_release(graph);
    }
    ptl_engine_release(closed);
    ptl_engine_release(open);
}

/* Makes one of everything and releases them in the order that `order` names. */
static void release_in_order(const int order[5])
{
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_job *job = NULL;
    ptl_cancel *cancel = NULL;
    ptl_block source = 0, end;
    ptl_compute_options options;
    int i, freed = 0;

    OK(ptl_engine_create(NULL, &engine, &error));
    OK(ptl_engine_set_log(engine, PTL_LOG_WARNING, count_log, &freed, count_free, &error));
    OK(ptl_graph_create(engine, &graph, &error));
    OK(ptl_cancel_create(&cancel, &error));
    end = build(graph, &source);
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.cancel = cancel;
    OK(ptl_graph_compute(graph, end, 0, &options, &image, &error));
    OK(ptl_graph_compute_start(graph, end, 0, &options, &job, &error));
    for (i = 0; i < 5; i++) {
        switch (order[i]) {
        case 0: ptl_engine_release(engine); break;
        case 1: ptl_graph_release(graph); break;
        case 2: ptl_image_release(image); break;
        case 3: ptl_job_release(job); break;
        default: ptl_cancel_release(cancel); break;
        }
    }
    CHECK(freed == 1);
}

static void all_orders(int order[5], int count)
{
    int i;
    if (count == 5) release_in_order(order);
    for (i = count; i < 5; i++) {
        const int kept = order[count];
        order[count] = order[i];
        order[i] = kept;
        all_orders(order, count + 1);
        order[i] = order[count];
        order[count] = kept;
    }
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_graph *graph = NULL, *copy = NULL;
    ptl_engine_options options;
    ptl_block source = 0, end;
    int order[5] = {0, 1, 2, 3, 4}, freed = 0;

    versions();
    PTL_ENGINE_OPTIONS_INIT(&options);
    options.threads = 2;
    options.flags = PTL_ENGINE_NO_CACHE;
    OK(ptl_engine_create(&options, &engine, &error));
    catalogue(engine);
    OK(ptl_engine_set_log(engine, PTL_LOG_DEBUG, count_log, &freed, count_free, &error));
    OK(ptl_engine_set_log(engine, PTL_LOG_DEBUG, NULL, NULL, NULL, &error));
    CHECK(freed == 1);

    OK(ptl_graph_create(engine, &graph, &error));
    end = build(graph, &source);
    settings(graph);
    parameters(graph, source);
    save_and_load(engine, graph);
    faults_of_files(engine);
    files();

    /* A copy is a graph of its own; handles of blocks are valid in both. */
    OK(ptl_graph_clone(graph, &copy, &error));
    OK(ptl_graph_remove_block(graph, source, &error));
    CHECK(ptl_graph_block_count(graph) == 1 && ptl_graph_block_count(copy) == 2);
    OK(ptl_graph_validate(copy, end, &error));
    CHECK(ptl_graph_retain(copy) == copy && ptl_engine_retain(engine) == engine);
    ptl_graph_release(copy);
    ptl_engine_release(engine);
    ptl_graph_release(graph);
    ptl_engine_release(engine);
    OK(ptl_graph_validate(copy, end, &error));
    ptl_graph_release(copy);

    all_orders(order, 0);
    return 0;
}
