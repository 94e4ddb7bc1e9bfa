// The lighting of one point: the sums over the lights, and what the surface makes of them.
#include "reference/parts.h"

struct sums { // without the material
    struct sb_vec3 ambient, diffuse, specular;
    struct sb_vec3
        grazing; // the part of `specular` that is reflected whatever the material
};

// What the loop over the lights passes around.
struct lighting {
    const struct sb_ref_shading *shading;
    struct sb_ref_choice choice;
    struct sb_ref_surface surface;
    struct sb_vec3 side; // the normal without a map
    struct sums sums;
    uint32_t decisions;
    double margin;
};

static void decide(struct lighting *it, int outcome, double margin)
{
    it->decisions = sb_ref_decide(it->decisions, outcome);
    it->margin = fmin(it->margin, margin);
}

static void add(struct sb_vec3 *sum, const float colour[3], double weight)
{
    sum->x += colour[0] * weight;
    sum->y += colour[1] * weight;
    sum->z += colour[2] * weight;
}

static void put_terms(struct sb_ref_terms *terms, const struct sb_ref_incident *incident,
                      double shown, double n_dot_l, double specular)
{
    const struct sb_vec3 direction = incident->direction;
    const double factor = incident->attenuation * incident->cone * shown;
    *terms = (struct sb_ref_terms){
        .distance = {incident->distance},
        .direction = {direction.x, direction.y, direction.z},
        .attenuation = {incident->attenuation},
        .cone = {incident->cone},
        .shown = {shown},
        .n_dot_l = {n_dot_l},
        .specular = {specular},
        .diffuse_weight = {factor * fmax(n_dot_l, 0)},
        .specular_weight = {factor * specular},
    };
}

static bool is_off(const struct lighting *it, const struct sb_light *light,
                   enum sb_light_type type, int number)
{
    const bool casts = type == SB_LIGHT_POINT && number < it->choice.casters;
    return it->choice.passes_off && !casts && !(light->intensity > 0);
}

static double shown_of(struct lighting *it, const struct sb_light *light, int number,
                       const struct sb_ref_incident *incident, double n_dot_l)
{
    const struct sb_ref_sight sight = {
        .light = light,
        .caster = number,
        .to_light = incident->to_light,
        .side = it->side,
        .distance = incident->distance,
        .n_dot_l = n_dot_l,
    };
    const double shown = sb_ref_shown(it->shading, &it->choice, &sight);
    decide(it, (int)(16 * shown + 0.5), 0);
    return shown;
}

// `terms`: of this light, or NULL.
static void add_light(struct lighting *it, const struct sb_light *light,
                      enum sb_light_type type, int number, struct sb_ref_terms *terms)
{
    const struct sb_ref_choice *choice = &it->choice;
    if (is_off(it, light, type, number)) {
        if (terms)
            *terms = (struct sb_ref_terms){0};
        return;
    }
    const struct sb_ref_incident incident =
        sb_ref_incident_of(it->shading, choice, &it->surface, light, type);
    const double n_dot_l = sb_vec3_dot(it->surface.normal, incident.direction);
    const double factor = incident.attenuation * incident.cone;
    double shown = 1, specular = 0;
    if (type == SB_LIGHT_SPOT &&
        (choice->cone == SB_CONE_HARD || choice->cone == SB_CONE_EXPONENT))
        decide(it, incident.in_cone, incident.cone_margin);
    if (type == SB_LIGHT_POINT && number < choice->casters)
        shown = shown_of(it, light, number, &incident, n_dot_l);
    if (choice->model != SB_MODEL_LAMBERT) {
        if (choice->cuts_back)
            decide(it, n_dot_l > 0, fabs(n_dot_l));
        // A factor of 0 spares the power: no terms are asked of it.
        if ((!choice->cuts_back || n_dot_l > 0) && (terms || factor * shown > 0))
            specular =
                sb_ref_specular(choice, &it->surface, incident.highlight, factor * shown);
    }
    if (choice->ambient == SB_AMBIENT_PER_LIGHT)
        add(&it->sums.ambient, light->ambient, factor);
    add(&it->sums.diffuse, light->diffuse, factor * shown * fmax(n_dot_l, 0));
    add(&it->sums.specular, light->specular, factor * shown * specular);
    if (choice->schlick && factor * shown * specular > 0)
        add(&it->sums.grazing, light->specular,
            factor * shown * specular *
                sb_ref_schlick(choice, &it->surface, incident.highlight));
    if (terms)
        put_terms(terms, &incident, shown, n_dot_l, specular);
}

// F0 S + (1 - F0) G: of each light F0 + (1 - F0) (1 - c)^5.
static struct sb_vec3 reflected(const struct lighting *it, const float f0[3])
{
    const struct sb_vec3 head_on = sb_ref_product(sb_ref_vec(f0), it->sums.specular);
    if (!it->choice.schlick)
        return head_on;
    const struct sb_vec3 rest = {1.0 - f0[0], 1.0 - f0[1], 1.0 - f0[2]};
    return sb_vec3_add(head_on, sb_ref_product(rest, it->sums.grazing));
}

void sb_ref_shade(const struct sb_ref_shading *shading, const struct sb_ref_input *input,
                  const struct sb_material *material, struct sb_ref_shade *shade,
                  struct sb_ref_terms *terms)
{
    struct lighting it = {
        .shading = shading, .choice = sb_ref_choose(shading), .margin = INFINITY};
    it.surface = sb_ref_surface_of(shading, &it.choice, input, material);
    if (it.choice.casters > 0)
        it.side = sb_ref_unit(input->normal);
    if (it.choice.ambient == SB_AMBIENT_SCENE)
        it.sums.ambient = sb_ref_vec(shading->scene->ambient);
    const struct sb_light *light = shading->lights.light;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        for (int i = 0; i < shading->lights.count[type]; i++, light++) {
            add_light(&it, light, type, i, terms);
            if (terms)
                terms++;
        }
    }
    const struct sb_vec3 ambient =
        sb_ref_product(sb_ref_vec(material->ambient), it.sums.ambient);
    const struct sb_vec3 diffuse =
        sb_ref_product(sb_ref_vec(material->diffuse), it.sums.diffuse);
    *shade = (struct sb_ref_shade){
        .diffuse = sb_vec3_add(ambient, diffuse),
        .specular = reflected(&it, material->specular),
        .view = it.surface.view,
        .normal = it.surface.normal,
        .decisions = it.decisions,
        .margin = it.margin,
    };
}

struct sb_vec3 sb_ref_colour(const struct sb_ref_shading *shading,
                             const struct sb_ref_shade *shade,
                             const struct sb_ref_input *input)
{
    const struct sb_ref_choice choice = sb_ref_choose(shading);
    struct sb_vec3 diffuse = shade->diffuse, specular = shade->specular;
    if (choice.maps[SB_MAP_DIFFUSE]) {
        const struct sb_vec3 texel = sb_ref_texel(shading, input, SB_MAP_DIFFUSE);
        diffuse = sb_ref_product(diffuse, texel);
        if (choice.slips == SB_SOURCE_SHADOWS) // it tints highlights
            specular = sb_ref_product(specular, texel);
    }
    if (choice.maps[SB_MAP_SPECULAR])
        specular =
            sb_ref_product(specular, sb_ref_texel(shading, input, SB_MAP_SPECULAR));
    return sb_vec3_add(diffuse, specular);
}
