/* Values: each kind there and back, copied and borrowed; what is refused; inputs of graphs. */
#include "check.h"

static int freed;

static void PTL_CALL count_free(void *user_data)
{
    ++*(int *)user_data;
}

/* A vertex as renderers have it: position, texture coordinate, normal. */
typedef struct vertex {
    float position[3], texcoord[2], normal[3];
} vertex;

static vertex vertices[3] = {
    {{0, 0, 0}, {0, 0}, {0, 0, 1}}, {{2, 0, 0}, {1, 0}, {0, 0, 1}}, {{0, 3, 0}, {0, 1}, {0, 0, 1}}};
static uint32_t indices[3] = {0, 1, 2};

static ptl_stream stream(const char *id, uint32_t components, const void *data, size_t stride)
{
    ptl_stream made;
    made.struct_size = sizeof made;
    made.type = PTL_STREAM_F32;
    made.components = components;
    made.flags = 0;
    made.id = id;
    made.data = data;
    made.stride = stride;
    return made;
}

static ptl_stream streams[3];
static const ptl_stream *const pointers[3] = {&streams[0], &streams[1], &streams[2]};

static ptl_mesh_data triangle(void)
{
    ptl_mesh_data mesh;
    memset(&mesh, 0, sizeof mesh);
    streams[0] = stream("position", 3, vertices[0].position, sizeof *vertices);
    streams[1] = stream("texcoord", 2, vertices[0].texcoord, sizeof *vertices);
    streams[2] = stream("normal", 3, vertices[0].normal, sizeof *vertices);
    mesh.struct_size = sizeof mesh;
    mesh.vertex_count = 3;
    mesh.index_count = 3;
    mesh.indices = indices;
    mesh.streams = pointers;
    mesh.stream_count = 3;
    mesh.bounds_max[0] = 777;
    return mesh;
}

static ptl_value *mesh_of(const ptl_mesh_data *data, uint32_t flags)
{
    ptl_value *value = NULL;
    OK(ptl_value_from_mesh(data, flags, count_free, &freed, &value, &error));
    CHECK(ptl_value_kind(value) == PTL_KIND_MESH);
    return value;
}

static ptl_mesh_data view_of(const ptl_value *value)
{
    ptl_mesh_data view;
    view.struct_size = sizeof view;
    OK(ptl_value_mesh(value, &view, &error));
    return view;
}

static void meshes(void)
{
    const ptl_mesh_data data = triangle();
    ptl_mesh_data view;
    ptl_points_data points;
    ptl_value *value, *same;

    /* Copied: packed memory of the library, and nothing of ours is needed. */
    freed = 0;
    value = mesh_of(&data, 0);
    CHECK(freed == 1);
    view = view_of(value);
    CHECK(view.vertex_count == 3 && view.index_count == 3 && view.stream_count == 3);
    CHECK(view.indices != indices && memcmp(view.indices, indices, sizeof indices) == 0);
    CHECK(strcmp(view.streams[1]->id, "texcoord") == 0 && view.streams[1]->stride == 8);
    CHECK(((uintptr_t)view.streams[0]->data & 63) == 0);
    CHECK(memcmp((const char *)view.streams[0]->data + 24, vertices[2].position, 12) == 0);
    CHECK(view.bounds_max[0] == 2 && view.bounds_max[1] == 3 && view.bounds_min[0] == 0);
    points.struct_size = sizeof points;
    EXPECT_MESSAGE(PTL_E_TYPE_MISMATCH, "kind mesh", ptl_value_points(value, &points, &error));
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_value_image(value, 0, (ptl_image **)&same, &error));
    ptl_value_release(value);
    CHECK(freed == 1);

    /* Borrowed: the same pointers, until the last reference is gone. */
    freed = 0;
    value = mesh_of(&data, PTL_VALUE_BORROW);
    view = view_of(value);
    CHECK(view.indices == indices && view.streams[2]->data == (const void *)vertices[0].normal);
    CHECK(view.streams[0]->stride == sizeof(vertex) && view.streams[0]->components == 3);
    same = ptl_value_retain(value);
    CHECK(same == value);
    ptl_value_release(value);
    CHECK(freed == 0);
    ptl_value_release(same);
    CHECK(freed == 1);

    /* A normal of another length is copied and made right; ours stays as it is. */
    freed = 0;
    vertices[1].normal[2] = 5;
    value = mesh_of(&data, PTL_VALUE_BORROW);
    view = view_of(value);
    CHECK(view.streams[2]->data != (const void *)vertices[0].normal && vertices[1].normal[2] == 5);
    CHECK(((const float *)view.streams[2]->data)[5] == 1);
    CHECK(view.streams[0]->data == (const void *)vertices[0].position);
    vertices[1].normal[2] = 1;
    ptl_value_release(value);
    CHECK(freed == 1);
}

/* The mesh is refused, borrowed and copied, and freed once each time. */
static void refused(const ptl_mesh_data *mesh, ptl_status expected, const char *part)
{
    uint32_t flags;
    for (flags = 0; flags <= PTL_VALUE_BORROW; flags++) {
        ptl_value *value = (ptl_value *)&freed;
        freed = 0;
        EXPECT_MESSAGE(expected, part,
                       ptl_value_from_mesh(mesh, flags, count_free, &freed, &value, &error));
        CHECK(value == NULL && freed == 1);
    }
}

/* Refused after `change`, which is taken back. */
#define REFUSED(expected, part, change, back) \
    do { \
        mesh = triangle(); \
        change; \
        refused(&mesh, expected, part); \
        back; \
    } while (0)

static void wrong_meshes(void)
{
    ptl_mesh_data mesh;
    const ptl_stream *const twice[2] = {&streams[0], &streams[0]};
    const ptl_stream *const none[1] = {NULL};
    float nan = 0;
    nan = nan / nan;

    refused(NULL, PTL_E_INVALID_ARGUMENT, "`mesh` is NULL");
    REFUSED(PTL_E_INVALID_ARGUMENT, "struct_size 8", mesh.struct_size = 8, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "struct_size 0", mesh.struct_size = 0, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "mesh.flags", mesh.flags = 1, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "mesh.reserved0", mesh.reserved0 = 1, );
    REFUSED(PTL_E_LIMIT, "vertices", mesh.vertex_count = 0xffffffffu, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "multiples of 3", mesh.index_count = 2, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "mesh.indices", mesh.indices = NULL, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "no elements", mesh.index_count = 0, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "aligned",
            mesh.indices = (const uint32_t *)(const void *)((const char *)indices + 1), );
    REFUSED(PTL_E_INVALID_ARGUMENT, "mesh.streams", mesh.streams = NULL, );
    REFUSED(PTL_E_LIMIT, "33 streams", mesh.stream_count = 33, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "mesh.streams[0]",
            (mesh.streams = none, mesh.stream_count = 1), );
    REFUSED(PTL_E_INVALID_ARGUMENT, "given twice",
            (mesh.streams = twice, mesh.stream_count = 2), );
    REFUSED(PTL_E_INVALID_ARGUMENT, "no stream \"position\"", streams[0].id = "place", );
    REFUSED(PTL_E_INVALID_ARGUMENT, "id", streams[0].id = NULL, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "ASCII", streams[1].id = "h\xc3\xb6he", );
    REFUSED(PTL_E_INVALID_ARGUMENT, "struct_size", streams[1].struct_size = 1, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "type", streams[1].type = 3, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "allowed 2 of f32", streams[1].type = PTL_STREAM_U32, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "2 components", streams[0].components = 2, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "flags", streams[1].flags = 2, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "NULL", streams[1].data = NULL, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "aligned",
            streams[1].data = (const char *)streams[1].data + 2, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "stride 3", streams[0].stride = 3, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "stride 0", streams[0].stride = 0, );
    REFUSED(PTL_E_INVALID_ARGUMENT, "memory", streams[0].stride = (size_t)-1 / 4 * 4, );
    REFUSED(PTL_E_OUT_OF_RANGE, "index 2 of 3 is 99, allowed below 3; 1 such index",
            indices[2] = 99, indices[2] = 2);
    REFUSED(PTL_E_OUT_OF_RANGE, "element 1 of 3 is", vertices[1].texcoord[0] = nan,
            vertices[1].texcoord[0] = 1);
    /* A newer struct that uses what is unknown. */
    {
        struct {
            ptl_mesh_data data;
            uint64_t more;
        } newer;
        newer.data = triangle();
        newer.data.struct_size = sizeof newer;
        newer.more = 1;
        refused(&newer.data, PTL_E_UNSUPPORTED, "does not know");
        newer.more = 0;
        ptl_value_release(mesh_of(&newer.data, 0));
    }
    mesh = triangle();
    freed = 0;
    EXPECT(PTL_E_INVALID_ARGUMENT,
           ptl_value_from_mesh(&mesh, 0, count_free, &freed, NULL, &error));
    CHECK(freed == 1);
    {
        ptl_value *value = NULL;
        EXPECT(PTL_E_UNSUPPORTED, ptl_value_from_mesh(&mesh, 2, NULL, NULL, &value, &error));
    }
}

static void points_and_strands(void)
{
    static float place[4][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    static float radius = 0.5f, zero[3];
    static uint32_t first_point[3] = {0, 2, 4};
    ptl_stream position = stream("position", 3, place, 12);
    ptl_stream constant = stream("radius", 1, &radius, 0);
    const ptl_stream *const list[2] = {&position, &constant};
    ptl_points_data points, points_view;
    ptl_strands_data strands, strands_view;
    ptl_value *value = NULL;

    memset(&points, 0, sizeof points);
    constant.flags = PTL_STREAM_CONSTANT;
    points.struct_size = sizeof points;
    points.point_count = 4;
    points.stream_count = 2;
    points.streams = list;
    freed = 0;
    OK(ptl_value_from_points(&points, PTL_VALUE_BORROW, count_free, &freed, &value, &error));
    points_view.struct_size = sizeof points_view;
    OK(ptl_value_points(value, &points_view, &error));
    CHECK(ptl_value_kind(value) == PTL_KIND_POINTS && points_view.bounds_max[0] == 3);
    CHECK(points_view.streams[1]->data == (const void *)&radius);
    CHECK(points_view.streams[1]->flags == PTL_STREAM_CONSTANT && freed == 0);
    ptl_value_release(value);
    CHECK(freed == 1);
    constant = stream("direction", 3, zero, 0);
    constant.flags = PTL_STREAM_CONSTANT;
    EXPECT_MESSAGE(PTL_E_OUT_OF_RANGE, "\"direction\"",
                   ptl_value_from_points(&points, 0, NULL, NULL, &value, &error));

    memset(&strands, 0, sizeof strands);
    strands.struct_size = sizeof strands;
    strands.strand_count = 2;
    strands.point_count = 4;
    strands.first_point = first_point;
    strands.point_streams = list;
    strands.point_stream_count = 1;
    OK(ptl_value_from_strands(&strands, 0, NULL, NULL, &value, &error));
    strands_view.struct_size = sizeof strands_view;
    OK(ptl_value_strands(value, &strands_view, &error));
    CHECK(ptl_value_kind(value) == PTL_KIND_STRANDS && strands_view.strand_count == 2);
    CHECK(strands_view.first_point[2] == 4 && strands_view.strand_streams == NULL);
    ptl_value_release(value);
    first_point[1] = 5;
    EXPECT_MESSAGE(PTL_E_OUT_OF_RANGE, "entry 2 of 3 is 4",
                   ptl_value_from_strands(&strands, 0, NULL, NULL, &value, &error));
    first_point[1] = 1;
    EXPECT_MESSAGE(PTL_E_OUT_OF_RANGE, "2 points or more",
                   ptl_value_from_strands(&strands, PTL_VALUE_BORROW, NULL, NULL, &value, &error));
    CHECK(value == NULL);
}

static ptl_value *text_of(const char *characters)
{
    ptl_text_data text;
    ptl_value *value = NULL;
    memset(&text, 0, sizeof text);
    text.struct_size = sizeof text;
    text.text = characters;
    text.size = strlen(characters);
    OK(ptl_value_from_text(&text, 0, NULL, NULL, &value, &error));
    return value;
}

static ptl_value *image_of(void *pixels, ptl_format format)
{
    ptl_image_data image;
    ptl_value *value = NULL;
    memset(&image, 0, sizeof image);
    image.struct_size = sizeof image;
    image.format = format;
    image.width = image.height = 2;
    image.pixels = pixels;
    freed = 0;
    OK(ptl_value_from_image(&image, PTL_VALUE_BORROW, count_free, &freed, &value, &error));
    CHECK(freed == 1 && ptl_value_kind(value) == PTL_KIND_IMAGE);
    ptl_value_release(value);
    image.width = 0;
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    image.width = 0x7fffffff;
    EXPECT(PTL_E_LIMIT, ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    image.width = 2;
    image.row_stride = 1;
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    image.row_stride = 0;
    image.pixels = NULL;
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    image.pixels = pixels;
    image.format = PTL_FORMAT_AUTO;
    EXPECT(PTL_E_INVALID_ARGUMENT, ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    image.format = format;
    OK(ptl_value_from_image(&image, 0, NULL, NULL, &value, &error));
    return value;
}

static void texts_gradients_and_images(void)
{
    static const ptl_gradient_stop stops[2] = {{1, {1, 1, 1}}, {0, {0, 0, 0.5f}}};
    ptl_gradient_stop wrong = {0.5f, {0, 2, 0}};
    unsigned char pixels[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    unsigned char back[16];
    ptl_gradient_data gradient;
    ptl_text_data text;
    ptl_image *image = NULL;
    ptl_value *value = text_of("D(10)");

    text.struct_size = sizeof text;
    OK(ptl_value_text(value, &text, &error));
    CHECK(text.size == 5 && strcmp(text.text, "D(10)") == 0);
    gradient.struct_size = sizeof gradient;
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_value_gradient(value, &gradient, &error));
    ptl_value_release(value);
    text.text = "\xff";
    text.size = 1;
    EXPECT_MESSAGE(PTL_E_INVALID_ARGUMENT, "UTF-8",
                   ptl_value_from_text(&text, 0, NULL, NULL, &value, &error));

    gradient.stop_count = 2;
    gradient.stops = stops;
    OK(ptl_value_from_gradient(&gradient, 0, NULL, NULL, &value, &error));
    OK(ptl_value_gradient(value, &gradient, &error));
    CHECK(gradient.stop_count == 2 && gradient.stops[0].color[2] == 0.5f);
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_value_text(value, &text, &error));
    ptl_value_release(value);
    gradient.stop_count = 1;
    gradient.stops = &wrong;
    EXPECT_MESSAGE(PTL_E_OUT_OF_RANGE, "stop 0 of 1 has 2",
                   ptl_value_from_gradient(&gradient, 0, NULL, NULL, &value, &error));

    value = image_of(pixels, PTL_FORMAT_RGBA8);
    OK(ptl_value_image(value, PTL_FORMAT_RGBA8, &image, &error));
    ptl_value_release(value);
    OK(ptl_image_copy(image, PTL_FORMAT_RGBA8, back, sizeof back, 0, &error));
    CHECK(memcmp(pixels, back, sizeof back) == 0);
    ptl_image_release(image);
    value = NULL;
    CHECK(ptl_value_kind(NULL) == PTL_KIND_NONE && ptl_value_retain(NULL) == NULL);
    ptl_value_release(NULL);
}

/* A graph of an input, perhaps another block, and its result. */
static ptl_graph *graph_of(ptl_engine *engine, const char *input, const char *between,
                           ptl_block *end)
{
    ptl_graph *graph = NULL;
    ptl_block block, next;
    OK(ptl_graph_create(engine, &graph, &error));
    OK(ptl_graph_set_size(graph, 2, 2, &error));
    OK(ptl_graph_add_block(graph, input, &block, &error));
    OK(ptl_graph_set_text(graph, block, "name", "mine", &error));
    if (between != NULL) {
        OK(ptl_graph_add_block(graph, between, &next, &error));
        OK(ptl_graph_connect(graph, block, 0, next, 0, &error));
        block = next;
    }
    *end = block;
    return graph;
}

static void inputs_of_graphs(ptl_engine *engine)
{
    unsigned char pixels[4] = {0, 100, 200, 255}, back[4];
    const ptl_mesh_data data = triangle();
    ptl_mesh_data view;
    ptl_block end, input;
    ptl_value *value, *result = NULL;
    ptl_image *image = NULL;
    ptl_compute_options options;
    ptl_graph *graph = graph_of(engine, "image input", "invert", &end);

    /* An image from memory, through a block, to pixels. */
    CHECK(ptl_graph_find_input(graph, "other") == 0 && ptl_graph_find_input(NULL, "mine") == 0);
    input = ptl_graph_find_input(graph, "mine");
    CHECK(input != 0 && input != end);
    EXPECT_MESSAGE(PTL_E_UNCONNECTED, "ptl_graph_set_input",
                   ptl_graph_compute(graph, end, 0, NULL, &image, &error));
    value = text_of("no image");
    EXPECT_MESSAGE(PTL_E_TYPE_MISMATCH, "kind image",
                   ptl_graph_set_input(graph, input, value, &error));
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_graph_set_input(graph, end, value, &error));
    ptl_value_release(value);
    value = image_of(pixels, PTL_FORMAT_GREY8);
    OK(ptl_graph_set_input(graph, input, value, &error));
    ptl_value_release(value);
    OK(ptl_graph_compute(graph, end, 0, NULL, &image, &error));
    OK(ptl_image_copy(image, PTL_FORMAT_GREY8, back, sizeof back, 0, &error));
    CHECK(back[0] == 255 && back[1] == 155 && back[2] == 55 && back[3] == 0);
    ptl_image_release(image);
    OK(ptl_graph_set_input(graph, input, NULL, &error));
    EXPECT(PTL_E_UNCONNECTED, ptl_graph_compute(graph, end, 0, NULL, &image, &error));
    EXPECT(PTL_E_INVALID_ARGUMENT,
           ptl_graph_set_input(graph, input, (const ptl_value *)engine, &error));
    ptl_graph_release(graph);

    /* A text that a turtle draws. */
    graph = graph_of(engine, "text input", "turtle", &end);
    value = text_of("D(0.2)");
    OK(ptl_graph_set_input(graph, ptl_graph_find_input(graph, "mine"), value, &error));
    ptl_value_release(value);
    PTL_COMPUTE_OPTIONS_INIT(&options);
    options.width = options.height = 16;
    OK(ptl_graph_compute_value(graph, end, 0, &options, &result, &error));
    CHECK(ptl_value_kind(result) == PTL_KIND_IMAGE);
    ptl_value_release(result);
    ptl_graph_release(graph);

    /* A mesh comes back as it was lent: the same pointers. */
    graph = graph_of(engine, "mesh input", NULL, &end);
    freed = 0;
    value = mesh_of(&data, PTL_VALUE_BORROW);
    OK(ptl_graph_set_input(graph, end, value, &error));
    ptl_value_release(value);
    OK(ptl_graph_compute_value(graph, end, 0, NULL, &result, &error));
    view = view_of(result);
    CHECK(view.indices == indices && view.streams[0]->data == (const void *)vertices[0].position);
    EXPECT(PTL_E_TYPE_MISMATCH, ptl_graph_compute(graph, end, 0, NULL, &image, &error));
    OK(ptl_graph_remove_block(graph, end, &error));
    CHECK(freed == 0);
    ptl_value_release(result);
    CHECK(freed == 1);
    EXPECT(PTL_E_STALE_HANDLE, ptl_graph_set_input(graph, end, NULL, &error));
    ptl_graph_release(graph);
}

int main(void)
{
    ptl_engine *engine = NULL;
    const ptl_block_type *type;
    meshes();
    wrong_meshes();
    points_and_strands();
    texts_gradients_and_images();
    OK(ptl_engine_create(NULL, &engine, &error));
    type = ptl_engine_find_block_type(engine, "mesh input");
    CHECK(type != NULL && (ptl_block_type_flags(type) & PTL_BLOCK_IS_INPUT) != 0);
    inputs_of_graphs(engine);
    ptl_engine_release(engine);
    return 0;
}
