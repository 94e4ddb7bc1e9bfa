// A room with a box in it, lit by two point lights, whose shadow maps have a closed form: the
// walls are planes along the axes, and so are the sides of the box.
#pragma once

#include "assemble/decide.h"
#include "assemble/defines.h"
#include "assemble/light_structs.h"
#include "assemble_words.h"
#include "gl_test.h"
#include "render/shadow.h"

enum { CASTERS = 2, KINDS = SB_SHADOW_MAP_VALUE_COUNT };

static struct sb_caps caps;

struct box {
    double low[3], high[3];
};
static const struct box room = {{-2, -2.5, -3}, {2.25, 2, 3}};
// Before the edge between XP and ZN of the first light, and not in the middle of it.
static const struct box block = {{0.5, -0.75, -1.25}, {1.125, 0.25, -0.5}};
static const double lights[CASTERS][3] = {{0.25, -0.125, 0.0625}, {-1, 1, 0.5}};
// The corners of the room are farther away, no wall is.
static const double range = 4;

// --- closed forms --------------------------------------------------------------------------

// How far a ray goes before it leaves the box it began in.
static inline double distance_out(const struct box *box, const double *from,
                                  const double *direction)
{
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double side = direction[i] > 0 ? box->high[i] : box->low[i];
        if (direction[i] != 0)
            least = fmin(least, (side - from[i]) / direction[i]);
    }
    return least;
}

// How far it goes before it enters the box; infinity where it passes by.
static inline double distance_in(const struct box *box, const double *from,
                                 const double *direction)
{
    double in = 0, out = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double a = (box->low[i] - from[i]) / direction[i];
        const double b = (box->high[i] - from[i]) / direction[i];
        in = fmax(in, fmin(a, b));
        out = fmin(out, fmax(a, b));
    }
    return in < out ? in : INFINITY;
}

// To what the light sees in a direction of any length; in units of that length.
static inline double distance_seen(int caster, const double *direction)
{
    return fmin(distance_out(&room, lights[caster], direction),
                distance_in(&block, lights[caster], direction));
}

static inline double length_of(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static inline double largest_of(const double *v)
{
    return fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
}

// What a texel stores whose centre lies in this direction.
static inline double stored_seen(int caster, const double *direction, int store)
{
    const double t = distance_seen(caster, direction);
    const double m = t * largest_of(direction), near = range / 1000;
    if (store == SB_SHADOW_STORE_DEPTH)
        return (1 / near - 1 / m) / (1 / near - 1 / range);
    const double stored = 1 - t * length_of(direction) / range;
    return fmax(stored, 0); // the corners of the room are out of range
}

// The faces of the text, by where it looks into its six textures, and those of table 8.19 of
// OpenGL 4.6 core: the direction of face coordinates u, v in [-1, 1].
static inline void direction_of(int kind, int face, double u, double v, double *d)
{
    const bool text = kind == SB_SHADOW_MAP_SIX2D || kind == SB_SHADOW_MAP_ARRAY2D;
    const double text_direction[6][3] = {{1, v, u},    {-1, v, -u}, {v, 1, -u},
                                         {-v, -1, -u}, {-u, v, 1},  {u, v, -1}};
    const double cube_direction[6][3] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v},
                                         {u, -1, -v}, {u, -v, 1},  {-u, -v, -1}};
    memcpy(d, text ? text_direction[face] : cube_direction[face], 3 * sizeof *d);
}

// --- the scene -----------------------------------------------------------------------------

struct world {
    struct sb_vertex vertex[2][8];
    struct sb_mesh mesh[2];
    struct sb_material material;
    struct sb_draw draw[3];
    struct sb_light light[CASTERS];
    struct sb_scene scene;
};

static inline void box_make(const struct box *box, struct sb_vertex *vertex)
{
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 3; j++)
            vertex[i].position[j] = (float)(i >> j & 1 ? box->high[j] : box->low[j]);
}

static inline void world_make(struct world *world)
{
    // Two triangles a side; the way they turn does not matter to a shadow.
    static const uint32_t index[36] = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6,
                                       0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6,
                                       0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    *world = (struct world){0};
    box_make(&room, world->vertex[0]);
    box_make(&block, world->vertex[1]);
    for (int i = 0; i < 2; i++)
        world->mesh[i] = (struct sb_mesh){.vertex = world->vertex[i],
                                          .index = index,
                                          .vertex_count = 8,
                                          .index_count = 36};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++)
            world->draw[i].model[5 * j] = 1;
        world->draw[i].mesh = i % 2;
        world->draw[i].lamp = -1;
    }
    // A lamp around the first light: a hundredth of the room.
    world->draw[2].lamp = 0;
    for (int j = 0; j < 3; j++) {
        world->draw[2].model[5 * j] = 0.01f;
        world->draw[2].model[12 + j] = (float)lights[0][j];
    }
    for (int i = 0; i < CASTERS; i++) {
        for (int j = 0; j < 3; j++)
            world->light[i].position[j] = (float)lights[i][j];
        world->light[i].range = (float)range;
    }
    world->scene.name = "room";
    world->scene.mesh = world->mesh;
    world->scene.material = &world->material;
    world->scene.draw = world->draw;
    world->scene.mesh_count = 2;
    world->scene.material_count = 1;
    world->scene.draw_count = 3;
    world->scene.lights = (struct sb_lights){world->light, {0, CASTERS, 0, 0}};
}

// --- programs from the shipped shaders -----------------------------------------------------

static inline void build_stage(const struct sb_variant *variant, const char *file,
                               const struct sb_glsl_text *given,
                               struct sb_glsl_source *source)
{
    struct sb_variant decided = *variant;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_defines defines = {.arena = &arena};
    struct sb_text structs = {0};
    decided.value[SB_AXIS_STORAGE] = SB_STORAGE_UNIFORM;
    const struct sb_glsl_version *version =
        sb_decide_version(sb_axes_builtin(), &caps, &decided, &err);
    if (!version ||
        !sb_defines_make(&defines, sb_axes_builtin(), &decided, version->family, &err))
        fail_msg("%s", err.text);
    sb_light_structs_text(&decided, &structs);
    const struct sb_glsl_text texts[] = {
        {SB_LIGHT_STRUCTS_FILE, sb_text_get(&structs)},
        given ? *given : (struct sb_glsl_text){"", ""},
    };
    const struct sb_glsl_params params = {
        .root = SB_SOURCE_DIR "/shaders",
        .file = file,
        .version = version->text,
        .define = defines.row,
        .define_count = defines.count,
        .given = texts,
        .given_count = given ? 2 : 1,
    };
    *source = (struct sb_glsl_source){0};
    if (!sb_glsl_build(&params, source, &err))
        fail_msg("%s", err.text);
    sb_text_free(&structs);
    sb_arena_free(&arena);
}

static inline void shadow_program_make(const struct sb_variant *variant,
                                       struct sb_gl_program *program)
{
    const bool layered = variant->value[SB_AXIS_SHADOW_PASS] == SB_SHADOW_PASS_LAYERED;
    struct sb_glsl_source vertex, geometry, fragment;
    build_stage(variant, "shadow.vert", NULL, &vertex);
    build_stage(variant, "shadow.geom", NULL, &geometry);
    build_stage(variant, "shadow.frag", NULL, &fragment);
    const struct sb_program source = {
        .vertex = vertex.text,
        .geometry = layered ? geometry.text : NULL,
        .fragment = fragment.text,
    };
    if (!sb_gl_program_make(&source, program))
        fail_msg("%s", program->log);
    sb_glsl_free(&vertex);
    sb_glsl_free(&geometry);
    sb_glsl_free(&fragment);
}

// --- all of it -----------------------------------------------------------------------------

struct fixture {
    struct world world;
    struct sb_variant variant;
    struct sb_upload upload;
    struct sb_gl_program program;
    struct sb_shadow shadow;
};

static inline void shadow_variant(const char *words, struct sb_variant *variant)
{
    char text[400];
    snprintf(text, sizeof text, "%spoint=2 shadows=2 %s", caps.gles ? "api=gles " : "",
             words);
    variant_of_words(sb_axes_builtin(), text, variant);
}

// Whether this context can do it.
static inline bool can(const char *words)
{
    struct sb_variant variant;
    struct sb_error err = {0};
    shadow_variant(words, &variant);
    if (!sb_decide_version(sb_axes_builtin(), &caps, &variant, &err))
        return false;
    return sb_decide_shadows(sb_axes_builtin(), &caps, &variant, &err);
}

// Draws the maps.
static inline void fixture_make(struct fixture *fixture, const char *words)
{
    struct sb_error err = {0};
    *fixture = (struct fixture){0};
    world_make(&fixture->world);
    shadow_variant(words, &fixture->variant);
    sb_upload_make(&fixture->upload, &fixture->world.scene);
    shadow_program_make(&fixture->variant, &fixture->program);
    const struct sb_shadow_params params = {
        .program = fixture->program.name,
        .upload = &fixture->upload,
        .variant = &fixture->variant,
        .caps = &caps,
    };
    if (!sb_shadow_make(&fixture->shadow, &params, &err))
        fail_msg("%s: %s", words, err.text);
    sb_shadow_draw(&fixture->shadow, &fixture->shadow.phase[0]);
}

static inline void fixture_free(struct fixture *fixture)
{
    assert_null(sb_gl_error());
    sb_shadow_free(&fixture->shadow);
    sb_gl_program_free(&fixture->program);
    sb_upload_free(&fixture->upload);
}

// Kinds of map and ways to draw them: "shadow_map=cube shadow_pass=layered". NULL behind the
// last one.
static const char *const ways[] = {
    "shadow_map=six2d",
    "shadow_map=array2d",
    "shadow_map=cube",
    "shadow_map=cube_array",
    "shadow_map=array2d shadow_pass=layered",
    "shadow_map=cube shadow_pass=layered",
    "shadow_map=cube_array shadow_pass=layered",
    NULL,
};
