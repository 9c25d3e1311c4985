/* A plug-in whose blocks take and make meshes, points and strands; one makes them wrongly. */
#include <string.h>

#include "ptlib/ptlib_plugin.h"

static const ptlp_values *values;

static ptlp_status PTLP_CALL init(const ptlp_host *host, const char *path)
{
    (void)path;
    values = (const ptlp_values *)host->get_extension(host, PTLP_VALUES);
    return values ? PTLP_OK : PTLP_E_UNSUPPORTED;
}

static const ptl_stream *find(const ptl_stream *const *streams, uint32_t count, const char *id)
{
    uint32_t i;
    for (i = 0; i < count; i++)
        if (strcmp(streams[i]->id, id) == 0)
            return streams[i];
    return NULL;
}

static const float *element(const ptl_stream *stream, uint32_t i)
{
    return (const float *)(const void *)((const char *)stream->data + i * stream->stride);
}

static const ptl_stream position = {
    sizeof(ptl_stream), PTL_STREAM_F32, 3, 0, "position", NULL, 0};

/* The centre of each triangle of a mesh. */
static ptlp_status PTLP_CALL centres(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    const ptl_mesh_data *mesh = (const ptl_mesh_data *)in[0]->value;
    const ptl_stream *corners = find(mesh->streams, mesh->stream_count, "position");
    const ptl_stream *const wanted[] = {&position};
    ptl_points_data points = {sizeof(ptl_points_data), 0, 0, 1, NULL, {0}, {0}};
    ptlp_status status;
    float *to;
    uint32_t i, axis;
    (void)instance;
    (void)out;
    points.point_count = mesh->index_count / 3;
    points.streams = wanted;
    status = values->points_begin(job, 0, &points);
    if (status != PTLP_OK)
        return status;
    to = (float *)points.streams[0]->data;
    for (i = 0; i < points.point_count; i++) {
        const uint32_t *triangle = mesh->indices + 3 * i;
        for (axis = 0; axis < 3; axis++)
            to[3 * i + axis] = (element(corners, triangle[0])[axis] +
                                element(corners, triangle[1])[axis] +
                                element(corners, triangle[2])[axis]) / 3.0f;
    }
    return values->finish(job, 0);
}

/* A strand upwards from each point; its second output passes the points on. */
static ptlp_status PTLP_CALL hairs(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    const ptl_points_data *points = (const ptl_points_data *)in[0]->value;
    const ptl_stream *roots = find(points->streams, points->stream_count, "position");
    const ptl_stream *const wanted[] = {&position};
    ptl_strands_data strands = {
        sizeof(ptl_strands_data), 0, 0, 0, NULL, NULL, NULL, 1, 1, {0}, {0}};
    ptlp_status status;
    uint32_t *first;
    float *to;
    uint32_t i;
    (void)instance;
    (void)out;
    strands.strand_count = points->point_count;
    strands.point_count = 2 * points->point_count;
    strands.point_streams = wanted;
    /* The roots belong to the strands, too: shared with the input. */
    strands.strand_streams = &roots;
    status = values->strands_begin(job, 0, &strands);
    if (status != PTLP_OK)
        return status;
    first = (uint32_t *)strands.first_point;
    to = (float *)strands.point_streams[0]->data;
    for (i = 0; i < points->point_count; i++) {
        memcpy(to + 6 * i, element(roots, i), 3 * sizeof(float));
        memcpy(to + 6 * i + 3, element(roots, i), 3 * sizeof(float));
        to[6 * i + 5] += 1.0f;
        first[i] = 2 * i;
    }
    first[points->point_count] = 2 * points->point_count;
    status = values->finish(job, 0);
    return status == PTLP_OK ? values->pass(job, 1, 0) : status;
}

static int64_t fault; /* one computation at a time: the tests see to that */

static ptlp_status PTLP_CALL wrong_prepare(
    void *instance, const ptlp_job *job, const ptlp_setup *setup)
{
    (void)instance;
    (void)job;
    fault = setup->values[0]->integer;
    return PTLP_OK;
}

/* A mesh or strands with a fault. */
static ptlp_status PTLP_CALL wrong(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    static const float nowhere[3] = {0};
    ptl_stream borrowed = {
        sizeof(ptl_stream), PTL_STREAM_F32, 3, 0, "position", NULL, sizeof nowhere};
    const ptl_stream *wanted[] = {&position};
    ptl_mesh_data mesh = {sizeof(ptl_mesh_data), 0, 3, 3, NULL, NULL, 1, 0, {0}, {0}};
    ptlp_status status;
    (void)instance;
    (void)in;
    (void)out;
    if (fault == 0)
        return PTLP_OK; /* makes nothing */
    borrowed.data = nowhere;
    if (fault == 1 || fault == 9)
        wanted[0] = &borrowed; /* memory that is not the host's */
    if (fault == 9) {
        borrowed.data = NULL; /* new, but laid out as no stream can be */
        borrowed.stride = 3;
    }
    if (fault == 2)
        mesh.struct_size = 8;
    if (fault == 3)
        mesh.vertex_count = mesh.index_count = 4000000000u;
    mesh.streams = wanted;
    status = values->mesh_begin(job, fault == 4 ? 7 : 0, &mesh);
    if (status != PTLP_OK)
        return status;
    ((uint32_t *)mesh.indices)[2] = fault == 5 ? 99 : 0;
    if (fault == 6)
        memset((void *)mesh.streams[0]->data, 0xff, 4); /* a NaN */
    if (fault == 7)
        return PTLP_OK; /* not finished */
    if (fault == 8)
        return values->text(job, 0, "text", 4); /* another kind */
    return values->finish(job, 0);
}

/* Strands whose list falls. */
static ptlp_status PTLP_CALL falling(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    const ptl_stream *const wanted[] = {&position};
    ptl_strands_data strands = {
        sizeof(ptl_strands_data), 0, 2, 6, NULL, wanted, NULL, 1, 0, {0}, {0}};
    const ptlp_status status = values->strands_begin(job, 0, &strands);
    (void)instance;
    (void)in;
    (void)out;
    if (status != PTLP_OK)
        return status;
    ((uint32_t *)strands.first_point)[1] = 5;
    ((uint32_t *)strands.first_point)[2] = 4;
    return values->finish(job, 0);
}

#define PORT(name, kind, id) \
    static const ptlp_port name = {sizeof(ptlp_port), kind, 0, 0, 0, 0, id, NULL}

PORT(mesh_port, PTL_KIND_MESH, "mesh");
PORT(points_port, PTL_KIND_POINTS, "points");
PORT(strands_port, PTL_KIND_STRANDS, "strands");

static const ptlp_port *const mesh_ports[] = {&mesh_port};
static const ptlp_port *const points_ports[] = {&points_port};
static const ptlp_port *const strands_ports[] = {&strands_port, &points_port};

static const char *const fault_ids[] = {
    "nothing", "foreign memory", "struct size", "counts", "output", "index", "number",
    "unfinished", "kind", "stride"};
static const ptlp_param fault_param = {
    sizeof(ptlp_param), PTLP_PARAM_CHOICE, 0, 10, 0, 0, 0, 0, 0,
    "fault", "What is wrong.", NULL, NULL, fault_ids, NULL};
static const ptlp_param *const fault_params[] = {&fault_param};

#define BLOCK(name, id, ins, in_ports, outs, out_ports, count, params, prepare, compute) \
    static const ptlp_block name = { \
        sizeof(ptlp_block), 1, PTLP_SHAPE_WHOLE, PTLP_THREADS_INSTANCE, 0, ins, outs, count, \
        id, NULL, "testing", "Of the tests.", NULL, NULL, in_ports, out_ports, params, NULL, \
        NULL, NULL, prepare, compute, NULL}

BLOCK(centres_block, "ptlib-test.centres", 1, mesh_ports, 1, points_ports, 0, NULL, NULL, centres);
BLOCK(hairs_block, "ptlib-test.hairs", 1, points_ports, 2, strands_ports, 0, NULL, NULL, hairs);
BLOCK(wrong_block, "ptlib-test.wrong", 0, NULL, 1, mesh_ports, 1, fault_params, wrong_prepare,
      wrong);
BLOCK(falling_block, "ptlib-test.falling", 0, NULL, 1, strands_ports, 0, NULL, NULL, falling);

static const ptlp_block *const blocks[] = {
    &centres_block, &hairs_block, &wrong_block, &falling_block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "ptlib-test.values", "Values", "The tests of ptlib", "1.0.0", "MIT OR Apache-2.0", NULL,
    init, NULL, NULL, blocks, sizeof blocks / sizeof blocks[0], 0};
