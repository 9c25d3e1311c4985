/* Plug-ins that the host must refuse: the build chooses the fault, -DBAD=n. */
#include <math.h>

#include "ptlib/ptlib_plugin.h"

enum fault {
    NONE,
    ABI_MAJOR,
    ENTRY_SIZE_SHORT,
    ENTRY_SIZE_LONG,
    ENTRY_FLAGS,
    ID_NULL,
    ID_WORDS,
    ID_RESERVED,
    NAME_NOT_UTF8,
    INIT,
    INIT_WITH_WORD,
    BLOCKS_NULL,
    BLOCK_NULL,
    BLOCK_SIZE,
    BLOCK_TWICE,
    BLOCK_ID_PREFIX,
    BLOCK_ID_CAPITALS,
    BLOCK_DOC,
    BLOCK_FLAGS,
    SHAPE,
    THREADS,
    NO_OUTPUTS,
    COMPUTE_NULL,
    PREPARE_NULL,
    POINT_ANYWHERE,
    GATHER_NOWHERE,
    PORT_SIZE,
    PORT_KIND,
    PORT_FLAGS,
    PORTS_MANY,
    PLANES,
    PLANES_INPUT,
    PLANES_MANY,
    TEXT_OUTPUT_OF_POINT,
    PARAM_SIZE,
    PARAM_ID_NULL,
    PARAM_ID_TWICE,
    PARAM_TYPE,
    PARAM_RANGE,
    PARAM_RANGE_NAN,
    PARAM_SOFT,
    PARAM_DEFAULT,
    PARAM_NOT_WHOLE,
    PARAMS_MANY,
    CHOICE_WITHOUT_IDS,
    CHOICE_ID_NULL,
    CHOICE_DEFAULT
};

#define IF(fault, then, otherwise) ((BAD) == (fault) ? (then) : (otherwise))

static ptlp_status PTLP_CALL init(const ptlp_host *host, const char *path)
{
    (void)path;
    if (BAD == INIT_WITH_WORD) {
        const ptlp_log *log = (const ptlp_log *)host->get_extension(host, PTLP_LOG);
        log->write(host, NULL, PTLP_LOG_ERROR, "the licence server is on fire");
    }
    return BAD == INIT || BAD == INIT_WITH_WORD ? 77 : PTLP_OK;
}

static ptlp_status PTLP_CALL prepare(void *instance, const ptlp_job *job, const ptlp_setup *setup)
{
    (void)instance;
    (void)job;
    (void)setup;
    return PTLP_OK;
}

static ptlp_status PTLP_CALL compute(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *in,
    const ptlp_wire *const *out)
{
    (void)instance;
    (void)job;
    (void)in;
    (void)out;
    return PTLP_OK;
}

static const ptlp_port input = {
    IF(PORT_SIZE, 8, sizeof(ptlp_port)),
    IF(PORT_KIND, 99, PTL_KIND_IMAGE),
    IF(POINT_ANYWHERE, PTLP_PORT_ANYWHERE, IF(PORT_FLAGS, 64, 0)),
    0, 0, 0, "image", NULL};
static const ptlp_port *const inputs[] = {&input};

static const ptlp_port output = {
    sizeof(ptlp_port),
    IF(TEXT_OUTPUT_OF_POINT, PTL_KIND_TEXT, PTL_KIND_IMAGE),
    0,
    IF(TEXT_OUTPUT_OF_POINT, 0, IF(PLANES, 2, IF(PLANES_INPUT, PTLP_PLANES_AS_INPUT,
        IF(PLANES_MANY, PTLP_PLANES_COLOUR_ALPHA, PTLP_PLANES_GREY)))),
    IF(PLANES_INPUT, 5, 0), 0, "image", NULL};
static const ptlp_port second = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_COLOUR_ALPHA, 0, 0, "second", NULL};
static const ptlp_port third = {
    sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_COLOUR_ALPHA, 0, 0, "third", NULL};
static const ptlp_port *const outputs[] = {&output, &second, &third};

static const char *const ids[] = {"first", IF(CHOICE_ID_NULL, NULL, "second")};
static const ptlp_param param = {
    IF(PARAM_SIZE, 4096, sizeof(ptlp_param)),
    IF(PARAM_TYPE, 42, BAD >= CHOICE_WITHOUT_IDS ? PTLP_PARAM_CHOICE : PTLP_PARAM_INT),
    0,
    BAD >= CHOICE_WITHOUT_IDS ? 2 : 0,
    IF(PARAM_RANGE, 9, IF(PARAM_RANGE_NAN, NAN, IF(PARAM_NOT_WHOLE, -0.5, 0))),
    8,
    IF(PARAM_SOFT, -3, IF(PARAM_RANGE, 9, 0)),
    8,
    IF(PARAM_DEFAULT, 11, IF(CHOICE_DEFAULT, 2, 1)),
    IF(PARAM_ID_NULL, NULL, "size"),
    "How large.", NULL, NULL,
    IF(CHOICE_WITHOUT_IDS, NULL, BAD > CHOICE_WITHOUT_IDS ? ids : NULL),
    NULL};
static const ptlp_param *const params[] = {&param, &param};

static const ptlp_block block = {
    IF(BLOCK_SIZE, 100, sizeof(ptlp_block)), 1,
    IF(SHAPE, 4, IF(GATHER_NOWHERE, PTLP_SHAPE_GATHER, PTLP_SHAPE_POINT)),
    IF(THREADS, 0, PTLP_THREADS_TILES),
    IF(BLOCK_FLAGS, 1u << 31, 0),
    IF(PORTS_MANY, 10000, 1),
    IF(NO_OUTPUTS, 0, IF(PLANES_MANY, 3, 1)),
    IF(PARAMS_MANY, 10000, IF(PARAM_ID_TWICE, 2, BAD >= PARAM_SIZE || BAD == PREPARE_NULL)),
    IF(BLOCK_ID_PREFIX, "other.block", IF(BLOCK_ID_CAPITALS, "bad.Block", "bad.block")),
    NULL, "testing", IF(BLOCK_DOC, NULL, "Trouble."), NULL, NULL,
    inputs, outputs, params, NULL, NULL, NULL,
    IF(PREPARE_NULL, NULL, prepare), IF(COMPUTE_NULL, NULL, compute), NULL};
static const ptlp_block *const blocks[] = {IF(BLOCK_NULL, NULL, &block), &block};

const ptlp_entry ptl_plugin_entry_v1 = {
    IF(ENTRY_SIZE_SHORT, 16, IF(ENTRY_SIZE_LONG, 1000000, sizeof(ptlp_entry))),
    IF(ABI_MAJOR, 2, PTLP_ABI_MAJOR), PTLP_ABI_MINOR,
    IF(ENTRY_FLAGS, 1, 0),
    IF(ID_NULL, NULL, IF(ID_WORDS, "bad plug-in", IF(ID_RESERVED, "ptl.more", "bad"))),
    IF(NAME_NOT_UTF8, "\xff\xfe", "Trouble"),
    "The tests of ptlib", "1.0.0", "MIT OR Apache-2.0", NULL,
    init, NULL, NULL, IF(BLOCKS_NULL, NULL, blocks), IF(BLOCK_TWICE, 2, 1), 0};
