// How much of a caster's light reaches the surface: by a ray, or by a map as the variant has it,
// whose texels hold the exact distance along their centres.
#include <math.h>

#include "reference/parts.h"

// The place of a caster in world space. Maps are drawn from the scene's own lights, and the
// way back from view space would round.
static struct sb_vec3 place_of(const struct sb_ref_shading *shading,
                               const struct sb_ref_sight *sight)
{
    if (!shading->view_space)
        return sb_ref_vec(sight->light->position);
    int count;
    const struct sb_light *point =
        sb_lights_of(&shading->scene->lights, SB_LIGHT_POINT, &count);
    return sb_ref_vec(point[sight->caster].position);
}

// --- exact visibility -----------------------------------------------------------------------

// A ray that starts on a surface must not meet it. The start is moved off the surface, to the
// side of the light, and as much of the ray is passed over: a millionth of the ray, and where
// the world is far from its origin as much as the place may be off by rounding.
static double slack_of(struct sb_vec3 at, double distance)
{
    const double far = fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z)));
    return 1e-6 * distance + 1e-12 * far;
}

static double seen(const struct sb_ref_shading *shading, const struct sb_ref_sight *sight)
{
    if (!(sight->distance < sight->light->range))
        return 0;
    const struct sb_vec3 light = place_of(shading, sight);
    const struct sb_vec3 to_light = sb_ref_to_world(shading, sight->to_light);
    const struct sb_vec3 side = sb_ref_to_world(shading, sight->side);
    const struct sb_vec3 at = sb_vec3_sub(light, to_light);
    const double slack = slack_of(at, sight->distance);
    if (!(slack < sight->distance)) // nothing fits between
        return 1;
    const double off = sb_vec3_dot(side, to_light) < 0 ? -slack : slack;
    const struct sb_vec3 start = sb_vec3_add(at, sb_vec3_scale(side, off));
    const struct sb_ref_ray ray = {
        .origin = start,
        .direction = sb_vec3_sub(light, start),
        .near = slack / sight->distance,
        .far = 1,
        .truth = true,
    };
    return sb_ref_geometry_blocked(shading->geometry, &ray) ? 0 : 1;
}

// --- a shadow map ---------------------------------------------------------------------------

// What the map holds of a texel. Along a centre whose component along the axis of its face is 1
// or -1, the ray's parameter is the depth.
static double looked_up(const struct sb_ref_shading *shading,
                        const struct sb_ref_choice *choice, struct sb_vec3 light,
                        double range, struct sb_vec3 direction)
{
    const struct sb_ref_texel texel = sb_ref_texel_of(direction, choice->size);
    const struct sb_vec3 centre = sb_ref_texel_centre(texel, choice->size);
    const struct sb_ref_ray ray = {
        .origin = light,
        .direction = centre,
        .near = range / 1000,
        .far = range,
    };
    if (choice->per_vertex) {
        double away;
        const double t = sb_ref_geometry_corners_away(shading->geometry, &ray, &away);
        return sb_ref_stored(choice->store, t / range, away / range);
    }
    const double depth = sb_ref_geometry_hit(shading->geometry, &ray) / range;
    const double distance = depth * sb_vec3_length(centre);
    return sb_ref_stored(choice->store, depth, fmin(distance, 1));
}

static double mapped(const struct sb_ref_shading *shading,
                     const struct sb_ref_choice *choice, const struct sb_ref_sight *sight)
{
    if (!(sight->distance > 0)) // on the light: nothing is nearer
        return 1;
    if (!choice->per_vertex && !(sight->distance < sight->light->range))
        return 0;
    const struct sb_vec3 light = place_of(shading, sight);
    const struct sb_vec3 to_light = sb_ref_to_world(shading, sight->to_light);
    const double range = sight->light->range;
    const double largest =
        fmax(fabs(to_light.x), fmax(fabs(to_light.y), fabs(to_light.z))) / range;
    const double bias = sb_ref_bias(choice, sight->n_dot_l);
    const int taps = choice->taps * choice->taps;
    struct sb_vec3 tap[16];
    sb_ref_taps(choice->taps, choice->size, sb_vec3_scale(to_light, -1), tap);
    int lit = 0;
    for (int i = 0; i < taps; i++) {
        const double stored = looked_up(shading, choice, light, range, tap[i]);
        lit +=
            sb_ref_passes(choice->store, stored, largest, sight->distance / range, bias);
    }
    return lit / (double)taps;
}

double sb_ref_shown(const struct sb_ref_shading *shading,
                    const struct sb_ref_choice *choice, const struct sb_ref_sight *sight)
{
    if (!shading->geometry)
        return 1;
    return shading->ideal ? seen(shading, sight) : mapped(shading, choice, sight);
}
