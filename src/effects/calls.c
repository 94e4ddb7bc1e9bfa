#include "effects/calls.h"

#include <stdlib.h>
#include <string.h>

#include "effects/needs.h"
#include "effects/reach.h"

// Directional lights turn, and others go on circles, while a scene is shown: all phases count.
struct moving {
    struct sb_lights lights; // of one phase
    struct sb_light *light;  // owns them: phases one after another
    int phases, total;
};

struct analysing {
    const struct sb_analysis_params *params;
    struct sb_analysis *analysis;
    struct moving moving;
    struct sb_bounds *bounds;     // of each draw
    struct sb_shape_facts *shape; // of each mesh
    struct sb_reach
        *reach; // of each light on the draw that is looked at, over all phases
    int *order; // of lights, by bound
};

static bool is(const struct sb_variant *variant, int axis, int value)
{
    return (int)variant->value[axis] == value;
}

static const struct sb_light *light_at(const struct analysing *it, int phase, int number)
{
    return &it->moving.light[phase * it->moving.total + number];
}

static struct sb_vec3 position_of(const struct sb_light *light)
{
    return (struct sb_vec3){light->position[0], light->position[1], light->position[2]};
}

static enum sb_light_type type_of(const struct sb_lights *lights, int number)
{
    int type = 0;
    while (number >= lights->count[type])
        number -= lights->count[type++];
    return (enum sb_light_type)type;
}

// --- decisions in words ----------------------------------------------------------------------

static void decide(struct analysing *it, int draw, int light, const char *what,
                   const char *why)
{
    struct sb_analysis *analysis = it->analysis;
    if (!it->params->explain)
        return;
    analysis->decision =
        sb_grow(analysis->decision, analysis->decision_count,
                &analysis->decision_capacity, sizeof *analysis->decision);
    analysis->decision[analysis->decision_count++] =
        (struct sb_decision){draw, light, what, why};
}

static const char *light_name(struct analysing *it, int number)
{
    const struct sb_lights *lights = &it->params->scene->lights;
    const enum sb_light_type type = type_of(lights, number);
    for (int t = 0; t < (int)type; t++)
        number -= lights->count[t];
    return sb_arena_printf(&it->analysis->arena, "%s %d", sb_light_structs[type].name,
                           number);
}

static const char *reach_text(struct analysing *it, int number)
{
    const struct sb_variant *variant = it->params->variant;
    const struct sb_light *light = light_at(it, 0, number);
    struct sb_arena *arena = &it->analysis->arena;
    const double threshold = variant->value[SB_AXIS_THRESHOLD];
    switch (it->reach[number].why) {
    case SB_REACH_OFF:
        return "off, or black";
    case SB_REACH_ABSORBED:
        return "the material reflects none of it";
    case SB_REACH_OUT_OF_RANGE:
        return sb_arena_printf(arena, "out of range: its light ends at %.3g",
                               (double)light->range);
    case SB_REACH_OUT_OF_CONE:
        return sb_arena_printf(arena, "outside its cone of %.3g degrees",
                               (double)light->cutoff * 180 / SB_PI);
    default:
        return sb_arena_printf(arena,
                               "out of reach: its fall-off is below %.3g beyond %.3g",
                               threshold, sb_reach_distance(variant, light, threshold));
    }
}

// --- lights ----------------------------------------------------------------------------------

static void worse(struct sb_reach *most, const struct sb_reach *other)
{
    if (other->bound > most->bound)
        *most = *other;
}

// What each light adds to the draw at most, in any phase.
static void look_at_lights(struct analysing *it, int draw)
{
    const struct sb_scene *scene = it->params->scene;
    struct sb_reach_params params = {
        .variant = it->params->variant,
        .bounds = &it->bounds[draw],
        .material = &scene->material[scene->draw[draw].material],
    };
    for (int n = 0; n < it->moving.total; n++) {
        params.type = type_of(&scene->lights, n);
        for (int phase = 0; phase < it->moving.phases; phase++) {
            struct sb_reach reach;
            params.light = light_at(it, phase, n);
            sb_reach_of(&params, &reach);
            if (phase == 0)
                it->reach[n] = reach;
            worse(&it->reach[n], &reach);
        }
    }
}

// By bound, ascending; an insertion sort of a few hundred.
static void order_lights(struct analysing *it)
{
    for (int i = 0; i < it->moving.total; i++) {
        int at = i;
        for (; at > 0 && it->reach[it->order[at - 1]].bound > it->reach[i].bound; at--)
            it->order[at] = it->order[at - 1];
        it->order[at] = i;
    }
}

// The smallest go, for as long as all that went together stay below the threshold.
static void choose_lights(struct analysing *it, int draw, struct sb_needs *needs)
{
    const double threshold = it->params->variant->value[SB_AXIS_THRESHOLD];
    double gone = 0;
    look_at_lights(it, draw);
    order_lights(it);
    for (int i = 0; i < it->moving.total; i++) {
        const int number = it->order[i];
        gone += it->reach[number].bound;
        needs->lit[number] = gone > threshold;
        if (!needs->lit[number])
            decide(it, draw, number, light_name(it, number), reach_text(it, number));
    }
}

// --- shadows ---------------------------------------------------------------------------------

// A convex body with flat faces is unlit wherever it shadows itself. Where normals are rounded, or
// highlights are not cut, its own shadow shows.
static bool shadows_itself(const struct analysing *it, int draw)
{
    const struct sb_shape_facts *shape = &it->shape[it->params->scene->draw[draw].mesh];
    return !shape->convex || !shape->even ||
           sb_maps_asked(it->params->variant) & 1U << SB_MAP_NORMAL ||
           is(it->params->variant, SB_AXIS_SPECULAR_SIDE, SB_SPECULAR_BOTH);
}

static bool may_be_shadowed(const struct analysing *it, int draw, int light)
{
    const struct sb_scene *scene = it->params->scene;
    if (shadows_itself(it, draw))
        return true;
    for (int phase = 0; phase < it->moving.phases; phase++) {
        const struct sb_vec3 from = position_of(light_at(it, phase, light));
        for (int other = 0; other < scene->draw_count; other++)
            if (other != draw && scene->draw[other].lamp < 0 &&
                sb_bounds_between(&it->bounds[draw], from, &it->bounds[other]))
                return true;
    }
    return false;
}

// Casters up to the last that matters, and their lights with them: the number of a caster is that of
// its map.
static void choose_casters(struct analysing *it, int draw, struct sb_needs *needs)
{
    const int asked = (int)it->params->variant->value[SB_AXIS_SHADOWS];
    const int first = it->params->scene->lights.count[SB_LIGHT_DIR];
    for (int i = 0; i < asked; i++) {
        if (needs->lit[first + i] && may_be_shadowed(it, draw, first + i))
            needs->casters = i + 1;
        else if (needs->lit[first + i])
            decide(it, draw, -1,
                   sb_arena_printf(&it->analysis->arena, "shadows of point light %d", i),
                   "nothing stands between");
    }
    for (int i = 0; i < needs->casters; i++)
        needs->lit[first + i] = true;
}

// --- effects ---------------------------------------------------------------------------------

// Do the lights that stay fall off, and by which terms?
static void look_at_falloff(const struct analysing *it, struct sb_needs *needs)
{
    const struct sb_variant *variant = it->params->variant;
    const bool polynomial = is(variant, SB_AXIS_ATTENUATION, SB_ATTENUATION_POLYNOMIAL);
    for (int n = it->moving.lights.count[SB_LIGHT_DIR]; n < it->moving.total; n++) {
        const struct sb_light *light = light_at(it, 0, n);
        if (!needs->lit[n])
            continue;
        needs->linear |= light->linear > 0;
        needs->quadratic |= light->quadratic > 0;
        needs->falls_off |= !polynomial || light->constant != 1 || light->linear > 0 ||
                            light->quadratic > 0;
        needs->cone |= type_of(&it->moving.lights, n) == SB_LIGHT_SPOT &&
                       light->cutoff < (float)SB_PI;
    }
    // A sum without either is a constant, and a case that needs no code of its own.
    if (!needs->linear && !needs->quadratic)
        needs->linear = true;
}

static void look_at_colours(struct analysing *it, int draw, struct sb_needs *needs)
{
    const struct sb_scene *scene = it->params->scene;
    const struct sb_variant *variant = it->params->variant;
    const struct sb_material *material = &scene->material[scene->draw[draw].material];
    const bool lambert = is(variant, SB_AXIS_MODEL, SB_MODEL_LAMBERT);
    bool lit = false;
    for (int n = 0; n < it->moving.total; n++) {
        lit |= needs->lit[n];
        needs->diffuse |= needs->lit[n] && it->reach[n].diffuse > 0;
        needs->specular |= needs->lit[n] && it->reach[n].specular > 0;
        needs->ambient |= needs->lit[n] && it->reach[n].ambient > 0;
    }
    for (int c = 0; is(variant, SB_AXIS_AMBIENT, SB_AMBIENT_SCENE) && c < 3; c++)
        needs->ambient |= scene->ambient[c] * material->ambient[c] > 0;
    if (lit && !needs->diffuse)
        decide(it, draw, -1, "diffuse", "no light that the material reflects is left");
    if (lit && !needs->specular && !lambert)
        decide(it, draw, -1, "specular",
               "black: the material's highlights, or those of the lights left");
    if (!needs->ambient && !is(variant, SB_AXIS_AMBIENT, SB_AMBIENT_NONE))
        decide(it, draw, -1, "ambient", "black: the light, or the material's colour");
}

static void look_at_maps(struct analysing *it, int draw, struct sb_needs *needs)
{
    static const char *const names[SB_MAP_COUNT] = {"diffuse map", "specular map",
                                                    "normal map"};
    const struct sb_scene *scene = it->params->scene;
    const unsigned asked = sb_maps_asked(it->params->variant);
    // Decoded as textbooks do it, a flat texel is not quite flat: its lookup changes the normal.
    const bool tilts = is(it->params->variant, SB_AXIS_F_FRAME, SB_F_FRAME_NAIVE);
    const unsigned has = ~scene->material[scene->draw[draw].material].lacks |
                         (tilts ? 1U << SB_MAP_NORMAL : 0);
    const bool used[SB_MAP_COUNT] = {needs->diffuse || needs->ambient, needs->specular,
                                     needs->diffuse || needs->specular};
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (!(asked >> i & 1))
            continue;
        if (has >> i & 1 && used[i])
            needs->maps |= 1U << i;
        else
            decide(it, draw, -1, names[i],
                   used[i] ? "the material has none"
                           : "nothing is left that it would change");
    }
}

// Flat faces keep the length of their normals, where nothing is rounded to half precision.
static void look_at_normals(struct analysing *it, int draw, struct sb_needs *needs)
{
    const struct sb_scene *scene = it->params->scene;
    const double *value = it->params->variant->value;
    const bool highp = value[SB_AXIS_P_VARYING] == SB_P_VARYING_HIGHP &&
                       value[SB_AXIS_P_VECTOR] == SB_P_VECTOR_HIGHP;
    const bool lit = needs->diffuse || needs->specular;
    const bool keeps = highp && it->shape[scene->draw[draw].mesh].even &&
                       sb_draw_keeps_length(&scene->draw[draw]) &&
                       !(needs->maps & 1U << SB_MAP_NORMAL);
    needs->renormalise = lit && !keeps;
    if (lit && keeps && is(it->params->variant, SB_AXIS_NORMALISE, SB_NORMALISE_ON) &&
        is(it->params->variant, SB_AXIS_STAGE, SB_STAGE_FRAGMENT))
        decide(it, draw, -1, "renormalise", "its normals are flat");
}

static void look_at_sun(struct analysing *it, int draw)
{
    const struct sb_variant *variant = it->params->variant;
    if (it->moving.lights.count[SB_LIGHT_DIR] < (int)variant->value[SB_AXIS_DIR])
        decide(it, draw, -1, "the sun", "below the horizon");
}

static void look_at_draw(struct analysing *it, int draw, struct sb_needs *needs)
{
    look_at_sun(it, draw);
    choose_lights(it, draw, needs);
    choose_casters(it, draw, needs);
    look_at_colours(it, draw, needs);
    look_at_falloff(it, needs);
    look_at_maps(it, draw, needs);
    look_at_normals(it, draw, needs);
    needs->fresnel = needs->specular;
    sb_needs_leave_out(needs, it->params->variant, &it->moving.lights);
}

// --- all draws ---------------------------------------------------------------------------------

static void unite(struct sb_needs *all, const struct sb_needs *one, int lights)
{
    for (int i = 0; i < lights; i++)
        all->lit[i] |= one->lit[i];
    all->ambient |= one->ambient;
    all->diffuse |= one->diffuse;
    all->specular |= one->specular;
    all->maps |= one->maps;
    all->falls_off |= one->falls_off;
    all->linear |= one->linear;
    all->quadratic |= one->quadratic;
    all->cone |= one->cone;
    all->fresnel |= one->fresnel;
    all->renormalise |= one->renormalise;
    all->casters = one->casters > all->casters ? one->casters : all->casters;
}

static void make_moving(struct moving *moving, const struct sb_analysis_params *params)
{
    const struct sb_lights *lights = &params->scene->lights;
    const bool moves = !is(params->variant, SB_AXIS_UPDATE, SB_UPDATE_STATIC);
    moving->total = sb_lights_total(lights);
    moving->phases = moves ? SB_PHASES : 1;
    moving->light =
        sb_alloc((size_t)(moving->phases * moving->total + 1) * sizeof *moving->light);
    moving->lights = *lights;
    moving->lights.light = moving->light;
    for (int i = 0; i < moving->phases; i++) {
        // Casters move too, whether or not they do here: what is reached is more, never less.
        const struct sb_phase phase = {.number = i,
                                       .scale = params->variant->value[SB_AXIS_SCALE]};
        sb_lights_phase(lights, &phase, moving->light + i * moving->total);
    }
}

static void begin(struct analysing *it)
{
    const struct sb_scene *scene = it->params->scene;
    make_moving(&it->moving, it->params);
    it->bounds = sb_alloc(((size_t)scene->draw_count + 1) * sizeof *it->bounds);
    it->shape = sb_alloc(((size_t)scene->mesh_count + 1) * sizeof *it->shape);
    it->reach = sb_alloc(((size_t)it->moving.total + 1) * sizeof *it->reach);
    it->order = sb_alloc(((size_t)it->moving.total + 1) * sizeof *it->order);
    for (int d = 0; d < scene->draw_count; d++)
        sb_bounds_of(scene, d, &it->bounds[d]);
    for (int m = 0; m < scene->mesh_count; m++)
        sb_shape_facts_of(&scene->mesh[m], &it->shape[m]);
}

static void end(struct analysing *it)
{
    free(it->moving.light);
    free(it->bounds);
    free(it->shape);
    free(it->reach);
    free(it->order);
}

void sb_analyse(const struct sb_analysis_params *params, struct sb_analysis *analysis)
{
    struct analysing it = {.params = params, .analysis = analysis};
    const struct sb_scene *scene = params->scene;
    struct sb_arena *arena = &analysis->arena;
    begin(&it);
    const size_t lights = (size_t)it.moving.total + 1;
    struct sb_needs all = {.lit = sb_arena_alloc(arena, lights * sizeof *all.lit)};
    analysis->draw_count = scene->draw_count;
    analysis->draw =
        sb_arena_alloc(arena, ((size_t)scene->draw_count + 1) * sizeof *analysis->draw);
    for (int d = 0; d < scene->draw_count; d++) {
        struct sb_needs needs = {.lit =
                                     sb_arena_alloc(arena, lights * sizeof *needs.lit)};
        if (scene->draw[d].lamp < 0) {
            look_at_draw(&it, d, &needs);
            unite(&all, &needs, it.moving.total);
        }
        sb_needs_to_calls(&needs, params->axes, params->variant, &scene->lights, arena,
                          &analysis->draw[d]);
    }
    sb_needs_to_calls(&all, params->axes, params->variant, &scene->lights, arena,
                      &analysis->scene);
    end(&it);
}

void sb_analysis_free(struct sb_analysis *analysis)
{
    free(analysis->decision);
    sb_arena_free(&analysis->arena);
    *analysis = (struct sb_analysis){0};
}
