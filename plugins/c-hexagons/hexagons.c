/* Hexagonal tiles with bevelled edges: a plug-in for ptlib in C.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * The hexagons are regular but for a small stretch, which makes whole rows of them fit into the
 * image, so that it tiles. All lengths are measured in tiles: a tile is 1 wide from side to side,
 * and rows of tiles are sqrt(3)/2 apart. The position of a pixel is the only thing that its value
 * depends on, besides the parameters, and what is random about a tile comes from its number.
 *
 * Where the text says "across" and "along", an image with pointed tiles has columns across and rows
 * along; with flat tiles, both directions are exchanged. */
#include <math.h>
#include <stdlib.h>

#include <ptlib/ptlib_plugin.h>

/* sqrt(3)/2: from one row of tiles to the next. */
#define PITCH 0.8660254f

enum { POINTED, FLAT };
enum { LINEAR, ROUND, HOLLOW, SMOOTH };
/* Parameters in their order. */
enum { COLUMNS, ORIENTATION, GAP, BEVEL, PROFILE, VARIATION, TILT };
/* Outputs in their order. */
enum { HEIGHT, TILE, DISTANCE };

static const ptlp_noise *noise;

static ptlp_status PTLP_CALL init(const ptlp_host *host, const char *path)
{
    (void)path;
    noise = (const ptlp_noise *)host->get_extension(host, PTLP_NOISE);
    return noise ? PTLP_OK : PTLP_E_UNSUPPORTED;
}

/* What the parameters became. One of these serves all threads of a computation. */
typedef struct hexagons {
    uint64_t seed;
    int is_flat;
    int profile;
    /* Tiles across and along the image; those along are an even number. */
    uint32_t across;
    uint32_t along;
    /* From pixels to tiles. */
    float scale_across;
    float scale_along;
    float gap;
    float bevel;
    float variation;
    float tilt;
} hexagons;

static ptlp_status PTLP_CALL create(const ptlp_block *block, const ptlp_host *host, void **instance)
{
    (void)block;
    (void)host;
    *instance = calloc(1, sizeof(hexagons));
    return *instance ? PTLP_OK : PTLP_E_NO_MEMORY;
}

static void PTLP_CALL destroy(void *instance)
{
    free(instance);
}

/* The even number nearest to a positive one, at least 2. */
static uint32_t nearest_even(double number)
{
    uint32_t half = (uint32_t)(number / 2.0 + 0.5);
    return 2 * (half > 0 ? half : 1);
}

/* The whole number nearest to a positive one, at least 1. */
static uint32_t nearest(double number)
{
    uint32_t whole = (uint32_t)(number + 0.5);
    return whole > 0 ? whole : 1;
}

static ptlp_status PTLP_CALL prepare(void *instance, const ptlp_job *job, const ptlp_setup *setup)
{
    hexagons *self = (hexagons *)instance;
    const ptlp_value *const *values = setup->values;
    double aspect = (double)setup->height / (double)setup->width;
    uint32_t columns = (uint32_t)values[COLUMNS]->integer;
    uint32_t width = setup->width, height = setup->height;
    (void)job;
    self->seed = setup->seed;
    self->is_flat = values[ORIENTATION]->integer == FLAT;
    self->profile = (int)values[PROFILE]->integer;
    self->gap = (float)values[GAP]->number;
    self->bevel = (float)values[BEVEL]->number;
    self->variation = (float)values[VARIATION]->number;
    self->tilt = (float)values[TILT]->number;
    if (self->is_flat) {
        self->along = columns + (columns & 1);
        self->across = nearest(self->along * (double)PITCH * aspect);
        width = setup->height;
        height = setup->width;
    } else {
        self->across = columns;
        self->along = nearest_even(columns * aspect / (double)PITCH);
    }
    self->scale_across = (float)self->across / (float)width;
    self->scale_along = (float)self->along / (float)height;
    return PTLP_OK;
}

/* A row of tiles near a row of pixels. */
typedef struct tile_row {
    /* Its number, wrapped around. */
    uint32_t number;
    /* Every second one is half a tile farther. */
    float offset;
    /* From its middle line to the pixels. */
    float down;
    /* What is random about the last tile that was asked for. */
    uint32_t column;
    int is_known;
    float value;
    float lean_across;
    float lean_along;
} tile_row;

static tile_row row_of_tiles(const hexagons *self, int32_t number, float along)
{
    tile_row row = {0, 0.0f, 0.0f, 0, 0, 0.0f, 0.0f, 0.0f};
    int32_t count = (int32_t)self->along;
    row.number = (uint32_t)((number % count + count) % count);
    row.offset = row.number & 1 ? 0.5f : 0.0f;
    row.down = (along - (float)number) * PITCH;
    return row;
}

static void know(const hexagons *self, tile_row *row, int32_t column)
{
    int32_t count = (int32_t)self->across;
    uint32_t wrapped = (uint32_t)((column % count + count) % count);
    if (row->is_known && row->column == wrapped)
        return;
    row->is_known = 1;
    row->column = wrapped;
    row->value = noise->uniform(self->seed, wrapped, row->number, 0);
    row->lean_across = 2.0f * noise->uniform(self->seed, wrapped, row->number, 1) - 1.0f;
    row->lean_along = 2.0f * noise->uniform(self->seed, wrapped, row->number, 2) - 1.0f;
}

/* The greatest whole number that is not above one of a moderate size. */
static int32_t whole(float number)
{
    int32_t truncated = (int32_t)number;
    return truncated - ((float)truncated > number);
}

/* Where a pixel lies in its tile. */
typedef struct place {
    tile_row *row;
    int32_t column;
    /* From the middle of the tile. */
    float across;
    float along;
} place;

/* The tile whose middle is nearest is in one of two rows, above and below. */
static place find(tile_row rows[2], float across)
{
    place places[2];
    float squares[2];
    int i;
    for (i = 0; i < 2; i++) {
        float from = across - rows[i].offset;
        places[i].row = &rows[i];
        places[i].column = whole(from + 0.5f);
        places[i].across = from - (float)places[i].column;
        places[i].along = rows[i].down;
        squares[i] = places[i].across * places[i].across + rows[i].down * rows[i].down;
    }
    return places[squares[1] < squares[0]];
}

/* From 0 in the gap to 1 in the middle of the tile. */
static float distance(const hexagons *self, const place *at)
{
    float across = fabsf(at->across), along = fabsf(at->along);
    float slanted = 0.5f * across + PITCH * along;
    float inside = 1.0f - 2.0f * (across > slanted ? across : slanted);
    float rest = 1.0f - self->gap;
    float part = rest > 0.0f ? (inside - self->gap) / rest : 0.0f;
    return part > 0.0f ? part : 0.0f;
}

static float bevelled(const hexagons *self, float distance)
{
    float part = 1.0f;
    if (distance <= 0.0f)
        return 0.0f;
    if (distance < self->bevel)
        part = distance / self->bevel;
    switch (self->profile) {
    case ROUND:
        return sqrtf(part * (2.0f - part));
    case HOLLOW:
        return 1.0f - sqrtf(1.0f - part * part);
    case SMOOTH:
        return part * part * (3.0f - 2.0f * part);
    default:
        return part;
    }
}

static float height(const hexagons *self, const place *at, float distance)
{
    const tile_row *row = at->row;
    float slope = row->lean_across * at->across + row->lean_along * at->along;
    /* A slope is 1.08 at most, so that nothing is cut off at white. */
    float highest = 1.0f - self->tilt * 0.5f;
    float top = highest - self->variation * highest * row->value + self->tilt * 0.46f * slope;
    top = top < 0.0f ? 0.0f : top > 1.0f ? 1.0f : top;
    return bevelled(self, distance) * top;
}

static ptlp_status PTLP_CALL compute(
    void *instance,
    const ptlp_job *job,
    const ptlp_wire *const *inputs,
    const ptlp_wire *const *outputs)
{
    const hexagons *self = (const hexagons *)instance;
    const ptlp_tile *to[3];
    uint32_t outer, inner, output;
    (void)job;
    (void)inputs;
    for (output = 0; output < 3; output++)
        to[output] = (const ptlp_tile *)outputs[output]->value;
    /* Line by line along a row of tiles, which is a column of pixels if they are flat. */
    for (outer = 0; outer < (self->is_flat ? to[0]->width : to[0]->height); outer++) {
        uint32_t line = outer + (self->is_flat ? to[0]->x : to[0]->y);
        float along = ((float)line + 0.5f) * self->scale_along;
        int32_t above = whole(along);
        tile_row rows[2];
        rows[0] = row_of_tiles(self, above, along);
        rows[1] = row_of_tiles(self, above + 1, along);
        for (inner = 0; inner < (self->is_flat ? to[0]->height : to[0]->width); inner++) {
            uint32_t pixel = inner + (self->is_flat ? to[0]->y : to[0]->x);
            place at = find(rows, ((float)pixel + 0.5f) * self->scale_across);
            float values[3];
            uint32_t x = self->is_flat ? outer : inner, y = self->is_flat ? inner : outer;
            know(self, at.row, at.column);
            values[DISTANCE] = distance(self, &at);
            values[HEIGHT] = height(self, &at, values[DISTANCE]);
            values[TILE] = at.row->value;
            for (output = 0; output < 3; output++)
                to[output]->planes[0][y * to[output]->row_stride + x] = values[output];
        }
    }
    return PTLP_OK;
}

#define NUMBER(id, name, lowest, highest, usual_lowest, usual_highest, usual, unit, doc)          \
    static const ptlp_param id = {                                                                \
        sizeof(ptlp_param), PTLP_PARAM_FLOAT, 0, 0, lowest, highest, usual_lowest, usual_highest, \
        usual, name, doc, unit, NULL, NULL, NULL};
#define CHOICE(id, name, ids, docs, usual, doc)                                                   \
    static const ptlp_param id = {                                                                \
        sizeof(ptlp_param), PTLP_PARAM_CHOICE, 0, sizeof ids / sizeof ids[0], 0.0, 0.0, 0.0, 0.0, \
        usual, name, doc, NULL, NULL, ids, docs};
#define OUTPUT(id, name, doc)                                                                     \
    static const ptlp_port id = {                                                                 \
        sizeof(ptlp_port), PTL_KIND_IMAGE, 0, PTLP_PLANES_GREY, 0, 0, name, doc};

static const char *const orientations[] = {"pointed", "flat"};
static const char *const orientation_docs[] = {
    "A corner points up; tiles stand in rows.", "A side is on top; tiles stand in columns."};
static const char *const profiles[] = {"linear", "round", "hollow", "smooth"};
static const char *const profile_docs[] = {
    "An even slope.", "A quarter of a circle, as of a pebble.",
    "The same, but hollow, as of a dish.", "Level at both ends."};

static const ptlp_param columns = {
    sizeof(ptlp_param), PTLP_PARAM_INT, 0, 0, 1.0, 1024.0, 2.0, 64.0, 10.0, "columns",
    "Tiles from the left to the right. Flat ones are always an even number: an odd one counts as "
    "the next. How many fit from top to bottom follows from it.",
    NULL, NULL, NULL, NULL};
CHOICE(orientation, "orientation", orientations, orientation_docs, POINTED, "How the tiles stand.")
NUMBER(gap, "gap", 0.0, 1.0, 0.0, 0.5, 0.06, "of a tile", "Width of the joints between the tiles.")
NUMBER(bevel, "bevel", 0.0, 1.0, 0.0, 1.0, 0.3, "of half a tile",
    "Width of the slope at the edge of a tile: 0 is none, 1 reaches to its middle.")
CHOICE(profile, "profile", profiles, profile_docs, ROUND, "The form of the slope.")
NUMBER(variation, "height variation", 0.0, 1.0, 0.0, 1.0, 0.3, NULL,
    "By how much some tiles are lower than others.")
NUMBER(tilt, "tilt", 0.0, 1.0, 0.0, 1.0, 0.1, NULL,
    "By how much tiles lean, each in a direction of its own.")
static const ptlp_param *const params[] = {
    &columns, &orientation, &gap, &bevel, &profile, &variation, &tilt};

OUTPUT(height_port, "height", "Black joints, white tops: for normal maps and displacement.")
OUTPUT(tile_port, "tile", "A random shade for each tile, its half of the joints included.")
OUTPUT(distance_port, "distance", "From black in the joints to white in the middle of each tile.")
static const ptlp_port *const ports[] = {&height_port, &tile_port, &distance_port};

static const ptlp_block block = {
    sizeof(ptlp_block),
    1,
    PTLP_SHAPE_POINT,
    PTLP_THREADS_TILES,
    PTLP_BLOCK_USES_SEED,
    0, 3, sizeof params / sizeof params[0],
    "hexagons.tiles", "Hexagonal tiles", "pattern",
    "Hexagonal tiles with joints and bevelled edges.",
    NULL, NULL,
    NULL, ports, params,
    NULL,
    create, destroy, prepare, compute, NULL};
static const ptlp_block *const blocks[] = {&block};

const ptlp_entry ptl_plugin_entry_v1 = {
    sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0,
    "hexagons", "Hexagons", "The ptlib project", "1.0.0", "MIT OR Apache-2.0", NULL,
    init, NULL, NULL,
    blocks, sizeof blocks / sizeof blocks[0], 0};
