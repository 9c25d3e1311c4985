/* Plug-ins from C: loaded from a file, found in a folder, linked into the program. */
#include "check.h"

/* Linked into the program, under a name of its own. */
#define ptl_plugin_entry_v1 linked_plugin
#include "../plugins/points.c"
#undef ptl_plugin_entry_v1

static float first_sample(ptl_engine *engine, const char *type)
{
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_block source = 0, block = 0;
    ptl_compute_options options;
    size_t size = 0;
    float sample;

    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = options.height = 16;
    options.threads = 1;
    options.format = PTL_FORMAT_GREY_F32;
    EXPECT(PTL_OK, ptl_graph_create(engine, &graph, &error));
    EXPECT(PTL_OK, ptl_graph_add_block(graph, "color fill", &source, &error));
    EXPECT(PTL_OK, ptl_graph_set_int(graph, source, "red", 64, &error));
    EXPECT(PTL_OK, ptl_graph_set_int(graph, source, "green", 64, &error));
    EXPECT(PTL_OK, ptl_graph_set_int(graph, source, "blue", 64, &error));
    EXPECT(PTL_OK, ptl_graph_add_block(graph, type, &block, &error));
    EXPECT(PTL_OK, ptl_graph_connect(graph, source, 0, block, 0, &error));
    EXPECT(PTL_OK, ptl_graph_compute(graph, block, 0, &options, &image, &error));
    sample = ((const float *)ptl_image_pixels(image, &size))[0];
    CHECK(size == 16 * 16 * sizeof(float));
    ptl_image_release(image);
    ptl_graph_release(graph);
    return sample;
}

static void check_blocks(ptl_engine *engine, uint32_t builtin)
{
    const ptl_block_type *type = ptl_engine_find_block_type(engine, "ptlib-test.invert");
    CHECK(ptl_engine_block_type_count(engine) == builtin + 1);
    CHECK(type != NULL && type == ptl_engine_block_type_at(engine, builtin));
    CHECK(strcmp(ptl_block_type_plugin(type), "ptlib-test.points") == 0);
    CHECK(strcmp(ptl_block_type_name(type), "Invert") == 0);
    CHECK(strcmp(ptl_block_type_category(type), "adjust") == 0);
    CHECK(ptl_block_type_flags(type) & PTL_BLOCK_TILES);
    CHECK(first_sample(engine, "ptlib-test.invert") == first_sample(engine, "invert"));
}

struct seen {
    int good, bad, stop_after;
};

static int32_t PTL_CALL note(const ptl_scan_report *report, void *user_data)
{
    struct seen *seen = (struct seen *)user_data;
    CHECK(report->struct_size == sizeof *report && report->reserved0 == 0);
    CHECK(strlen(report->path) > 0);
    if (report->status == PTL_OK) {
        CHECK(strlen(report->plugin_id) > 0 && strlen(report->plugin_version) > 0);
        CHECK(report->block_count > 0 && strlen(report->message) == 0);
        seen->good++;
    } else {
        CHECK(strlen(report->plugin_id) == 0 && report->block_count == 0);
        CHECK(strlen(report->message) > 0);
        seen->bad++;
    }
    return seen->good + seen->bad == seen->stop_after;
}

/* The first sample of a block's result, with a source at its input, if it has one. */
static float sample_of(ptl_engine *engine, const char *type)
{
    const ptl_block_type *info = ptl_engine_find_block_type(engine, type);
    ptl_graph *graph = NULL;
    ptl_image *image = NULL;
    ptl_block source = 0, block = 0;
    ptl_compute_options options;
    const double all = 1.0;
    size_t size = 0;
    float sample;

    CHECK(info != NULL && strlen(ptl_block_type_plugin(info)) > 0);
    EXPECT(PTL_OK, ptl_graph_create(engine, &graph, &error));
    EXPECT(PTL_OK, ptl_graph_add_block(graph, type, &block, &error));
    if (ptl_block_type_input_count(info) > 0) {
        EXPECT(PTL_OK, ptl_graph_add_block(graph, "hexagons.tiles", &source, &error));
        EXPECT(PTL_OK, ptl_graph_set_float(graph, source, "gap", &all, 1, &error));
        EXPECT(PTL_OK, ptl_graph_connect(graph, source, 0, block, 0, &error));
    }
    if (strcmp(type, "reaction-diffusion.gray-scott") == 0) {
        EXPECT(PTL_OK, ptl_graph_set_int(graph, block, "cells", 16, &error));
        EXPECT(PTL_OK, ptl_graph_set_int(graph, block, "steps", 20, &error));
    }
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = options.height = 40;
    options.threads = 1;
    options.format = PTL_FORMAT_GREY_F32;
    EXPECT(PTL_OK, ptl_graph_compute(graph, block, 0, &options, &image, &error));
    sample = ((const float *)ptl_image_pixels(image, &size))[0];
    CHECK(size == 40 * 40 * sizeof(float) && sample >= 0.0f && sample <= 1.0f);
    ptl_image_release(image);
    ptl_graph_release(graph);
    return sample;
}

/* Plug-ins in C, C++ and Rust in one process, and in one graph. */
static void check_all(const char *folder)
{
    static const char *const types[] = {
        "hexagons.tiles", "kuwahara.anisotropic", "gradient-noise.perlin",
        "gradient-noise.simplex", "reaction-diffusion.gray-scott"};
    ptl_engine *engine = NULL;
    struct seen seen = {0, 0, -1};
    char more[4096];
    size_t i;

    EXPECT(PTL_OK, ptl_engine_create(NULL, &engine, &error));
    sprintf(more, "%s/more", folder);
    EXPECT(PTL_OK, ptl_engine_scan_plugins(engine, more, note, &seen, &error));
    CHECK(seen.good == 5 && seen.bad == 0);
    for (i = 0; i < sizeof types / sizeof types[0]; i++)
        sample_of(engine, types[i]);
    /* Joints only are black: white when inverted, and black still when painted. */
    CHECK(sample_of(engine, "ptlib-rust.invert") == 1.0f);
    CHECK(sample_of(engine, "kuwahara.anisotropic") == 0.0f);
    ptl_engine_release(engine);
}

int main(void)
{
    const char *folder = getenv("PTLIB_TEST_PLUGINS");
    char file[4096];
    ptl_engine *engine = NULL, *other = NULL;
    struct seen seen = {0, 0, -1};
    uint32_t builtin;

    CHECK(folder != NULL && strlen(folder) < 4000);
    sprintf(file, "%s/points.ptplugin.so", folder);
    EXPECT(PTL_OK, ptl_engine_create(NULL, &engine, &error));
    builtin = ptl_engine_block_type_count(engine);

    EXPECT_MESSAGE(PTL_E_INVALID_ARGUMENT, "`engine`", ptl_engine_load_plugin(NULL, file, &error));
    EXPECT_MESSAGE(PTL_E_INVALID_ARGUMENT, "`path`", ptl_engine_load_plugin(engine, NULL, &error));
    EXPECT_MESSAGE(PTL_E_PLUGIN_LOAD, "No such file",
                   ptl_engine_load_plugin(engine, "nowhere.ptplugin.so", &error));
    EXPECT_MESSAGE(PTL_E_PLUGIN_DESCRIPTOR, "leads nowhere",
                   ptl_engine_register_plugin(engine, NULL, &error));
    CHECK(ptl_engine_block_type_count(engine) == builtin);

    EXPECT(PTL_OK, ptl_engine_load_plugin(engine, file, &error));
    EXPECT(PTL_OK, ptl_engine_load_plugin(engine, file, &error));
    check_blocks(engine, builtin);

    /* The same blocks from another place are refused. */
    EXPECT_MESSAGE(PTL_E_PLUGIN_DUPLICATE, "points.ptplugin.so",
                   ptl_engine_register_plugin(engine, &linked_plugin, &error));

    EXPECT(PTL_OK, ptl_engine_create(NULL, &other, &error));
    EXPECT(PTL_OK, ptl_engine_register_plugin(other, &linked_plugin, &error));
    EXPECT(PTL_OK, ptl_engine_register_plugin(other, &linked_plugin, &error));
    check_blocks(other, builtin);
    ptl_engine_release(other);

    EXPECT(PTL_OK, ptl_engine_create(NULL, &other, &error));
    EXPECT_MESSAGE(PTL_E_INVALID_ARGUMENT, "`engine`",
                   ptl_engine_scan_plugins(NULL, folder, note, &seen, &error));
    EXPECT(PTL_OK, ptl_engine_scan_plugins(other, "not/a/folder", note, &seen, &error));
    CHECK(seen.good == 0 && seen.bad == 0);
    EXPECT(PTL_OK, ptl_engine_scan_plugins(other, folder, note, &seen, &error));
    CHECK(seen.good == 1 && seen.bad == 1);
    check_blocks(other, builtin);
    EXPECT(PTL_OK, ptl_engine_scan_plugins(other, folder, NULL, NULL, &error));
    seen.good = seen.bad = 0;
    seen.stop_after = 1;
    EXPECT(PTL_E_CANCELLED, ptl_engine_scan_plugins(other, folder, note, &seen, &error));
    CHECK(seen.good + seen.bad == 1);
    /* The usual folders: whatever is there, it does no harm. */
    seen.stop_after = -1;
    EXPECT(PTL_OK, ptl_engine_scan_plugins(other, NULL, note, &seen, &error));
    ptl_engine_release(other);
    ptl_engine_release(engine);
    check_all(folder);
    return 0;
}
