// How one light of each type arrives at the surface.
#include "reference/parts.h"

static bool has_highlights(const struct sb_ref_choice *choice)
{
    return choice->model != SB_MODEL_LAMBERT;
}

// With layout=unified the shaders have a unit vector to the light in the place of the position;
// a light that has not been made so has a position of 0.
static struct sb_ref_incident directional(const struct sb_ref_choice *choice,
                                          const struct sb_light *light)
{
    const struct sb_vec3 position = sb_ref_vec(light->position);
    const bool placed = choice->unified && sb_vec3_dot(position, position) > 0;
    const struct sb_vec3 travels = sb_ref_vec(light->direction);
    const struct sb_vec3 direction =
        sb_ref_unit(placed ? position : sb_vec3_scale(travels, -1));
    return (struct sb_ref_incident){
        .direction = direction, .highlight = direction, .attenuation = 1, .cone = 1};
}

static void area(const struct sb_ref_shading *shading, const struct sb_ref_choice *choice,
                 const struct sb_ref_surface *surface, const struct sb_light *light,
                 struct sb_ref_incident *incident)
{
    const int shape = choice->area_shape;
    const bool turned = shape == SB_AREA_BOX; // to the axes of the world
    struct sb_vec3 to_centre = incident->to_light;
    struct sb_vec3 ray = sb_ref_reflect(surface->view, surface->normal);
    if (turned) {
        to_centre = sb_ref_to_world(shading, to_centre);
        ray = sb_ref_to_world(shading, ray);
    }
    struct sb_vec3 to_light = sb_ref_area_nearest(shape, light, to_centre);
    struct sb_vec3 highlight = has_highlights(choice)
                                   ? sb_ref_area_nearest_ray(shape, light, to_centre, ray)
                                   : to_light;
    if (turned) {
        to_light = sb_ref_from_world(shading, to_light);
        highlight = sb_ref_from_world(shading, highlight);
    }
    incident->to_light = to_light;
    incident->highlight = sb_ref_unit(highlight);
}

struct sb_ref_incident sb_ref_incident_of(const struct sb_ref_shading *shading,
                                          const struct sb_ref_choice *choice,
                                          const struct sb_ref_surface *surface,
                                          const struct sb_light *light,
                                          enum sb_light_type type)
{
    if (type == SB_LIGHT_DIR)
        return directional(choice, light);
    struct sb_ref_incident incident = {.cone = 1};
    incident.to_light = sb_vec3_sub(sb_ref_vec(light->position), surface->position);
    if (type == SB_LIGHT_AREA)
        area(shading, choice, surface, light, &incident);
    incident.distance = sb_vec3_length(incident.to_light);
    incident.direction = incident.distance > 0
                             ? sb_vec3_scale(incident.to_light, 1 / incident.distance)
                             : incident.to_light;
    if (type != SB_LIGHT_AREA)
        incident.highlight = incident.direction;
    if (type == SB_LIGHT_SPOT)
        sb_ref_cone(choice, light, &incident);
    incident.attenuation =
        sb_ref_attenuation(choice->attenuation, light, incident.distance);
    return incident;
}
