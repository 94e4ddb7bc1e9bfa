#include "cases/shadow_world.h"

#include <math.h>
#include <string.h>

static bool draw(struct sb_shadow_world *world, enum sb_probe_page page,
                 struct sb_image *image, struct sb_error *err)
{
    const struct sb_image_request request = {
        .job = world->drawn.task.assembly.job.id, .kind = SB_IMAGE_PROBE, .page = page};
    return world->driver->fns->image(world->driver->runner, &request, image, err);
}

bool sb_shadow_world_open(struct sb_shadow_world *world, const struct sb_case_env *env,
                          const struct sb_variant *variant, const char *scene,
                          struct sb_error *err)
{
    const double *value = variant->value;
    int count;
    world->driver = env->driver;
    world->size = (int)value[SB_AXIS_SHADOW_SIZE];
    world->bias = value[SB_AXIS_SHADOW_BIAS];
    if (!sb_scene_make(scene, variant, &world->scene, err) ||
        !sb_case_task_open(env, variant, scene, &world->drawn, err))
        return false;
    const struct sb_light *light =
        sb_lights_of(&world->scene.lights, SB_LIGHT_POINT, &count);
    world->light =
        (struct sb_vec3){light->position[0], light->position[1], light->position[2]};
    world->range = light->range;
    world->geometry = sb_ref_geometry_new(&world->scene, (int)value[SB_AXIS_WIDTH],
                                          (int)value[SB_AXIS_HEIGHT]);
    sb_ref_geometry_rays(world->geometry);
    return draw(world, SB_PROBE_INPUTS, &world->inputs, err) &&
           draw(world, SB_PROBE_LIGHT, &world->lit, err);
}

void sb_shadow_world_close(struct sb_shadow_world *world)
{
    sb_image_free(&world->inputs);
    sb_image_free(&world->lit);
    sb_ref_geometry_free(&world->geometry);
    if (world->driver)
        sb_task_free(&world->drawn.task, world->driver);
    sb_scene_free(&world->scene);
    *world = (struct sb_shadow_world){0};
}

// --- pixels -------------------------------------------------------------------------------

enum {
    COLOUR = 4,
    NORMAL = COLOUR + 3,
    SHOWN = COLOUR + 3,
    N_DOT_L = COLOUR + 4,
    REACHED = COLOUR + 11
};

int sb_shadow_pixel_count(const struct sb_shadow_world *world)
{
    return world->lit.width * world->lit.height;
}

bool sb_shadow_pixel_at(const struct sb_shadow_world *world, int pixel,
                        struct sb_shadow_pixel *at)
{
    const float *position =
        world->inputs.data + (size_t)pixel * (size_t)world->inputs.channels + COLOUR;
    const float *lit = world->lit.data + (size_t)pixel * (size_t)world->lit.channels;
    const struct sb_vec3 place = {position[0], position[1], position[2]};
    at->from_light = sb_vec3_sub(place, world->light);
    at->distance = sb_vec3_length(at->from_light);
    at->normal =
        (struct sb_vec3){position[NORMAL - COLOUR], position[NORMAL - COLOUR + 1],
                         position[NORMAL - COLOUR + 2]};
    at->n_dot_l = lit[N_DOT_L];
    at->shown = lit[SHOWN];
    return lit[REACHED] == 1;
}

// --- rays and texels ----------------------------------------------------------------------

double sb_shadow_seen(const struct sb_shadow_world *world, struct sb_vec3 direction)
{
    const double length = sb_vec3_length(direction);
    const struct sb_ref_ray ray = {
        .origin = world->light,
        .direction = direction,
        .near = world->range / 1000 / length,
        .far = 2 * world->range / length, // corners of a face are beyond the range
    };
    return sb_ref_geometry_hit(world->geometry, &ray) * length;
}

static double largest(struct sb_vec3 v)
{
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

double sb_shadow_texel(const struct sb_shadow_world *world, struct sb_vec3 from_light)
{
    return 2 * largest(from_light) / world->size;
}

struct sb_vec3 sb_shadow_centre(const struct sb_shadow_world *world,
                                struct sb_vec3 direction, int x, int y)
{
    const double m = largest(direction), n = world->size;
    double d[3] = {direction.x / m, direction.y / m, direction.z / m};
    const int axis = fabs(d[2]) == 1 ? 2 : fabs(d[0]) == 1 ? 0 : 1;
    const int step[2] = {x, y};
    for (int i = 0, k = 0; i < 3; i++)
        if (i != axis)
            d[i] = (2 * (fmin(floor((d[i] + 1) * n / 2), n - 1) + step[k++]) + 1 - n) / n;
    return (struct sb_vec3){d[0], d[1], d[2]};
}

// --- what is right ------------------------------------------------------------------------

enum { AROUND = 9 }; // texels: 3 x 3

static struct sb_vec3 around(const struct sb_shadow_world *world,
                             struct sb_vec3 from_light, int i)
{
    return i == AROUND / 2 ? from_light
                           : sb_shadow_centre(world, from_light, i % 3 - 1, i / 3 - 1);
}

double sb_shadow_gap(const struct sb_shadow_world *world, struct sb_vec3 from_light)
{
    double gap = INFINITY;
    for (int i = 0; i < AROUND; i++) {
        const struct sb_vec3 to = around(world, from_light, i);
        // To the plane through the place that faces the light's ray.
        const double along = sb_vec3_dot(to, from_light) / sb_vec3_length(to);
        const double here = along - sb_shadow_seen(world, to);
        gap = here < gap ? here : gap;
    }
    return gap > 0 ? gap : 0;
}

// Do all texels around a place see the plane that its surface lies in, and nothing before it?
static bool sees_the_plane(const struct sb_shadow_world *world,
                           const struct sb_shadow_pixel *at)
{
    const double slack =
        0.1 * sb_shadow_texel(world, at->from_light) * sb_vec3_length(at->normal);
    for (int i = 0; i < AROUND; i++) {
        const struct sb_vec3 to = around(world, at->from_light, i);
        const double along = sb_shadow_seen(world, to) / sb_vec3_length(to);
        const struct sb_vec3 off = sb_vec3_sub(sb_vec3_scale(to, along), at->from_light);
        if (!(fabs(sb_vec3_dot(off, at->normal)) < slack))
            return false;
    }
    return true;
}

enum sb_shadow_truth sb_shadow_truth(const struct sb_shadow_world *world,
                                     const struct sb_shadow_pixel *at)
{
    // The most that shadow_bias_kind=slope makes of the bias is ten times as much.
    const double passed_over = 10 * world->bias * world->range;
    const double texel = sb_shadow_texel(world, at->from_light);
    if (at->distance >= world->range)
        return SB_SHADOW_EDGE;
    if (sb_shadow_gap(world, at->from_light) > passed_over + 2 * texel)
        return SB_SHADOW_DARK;
    const double cosine = -sb_vec3_dot(at->from_light, at->normal);
    return cosine > 0.05 * at->distance && sees_the_plane(world, at) ? SB_SHADOW_LIT
                                                                     : SB_SHADOW_EDGE;
}

// --- the map ------------------------------------------------------------------------------

bool sb_shadow_map_read(const struct sb_shadow_world *world, struct sb_image *map,
                        struct sb_error *err)
{
    const struct sb_image_request request = {.job = world->drawn.task.assembly.job.id,
                                             .kind = SB_IMAGE_SHADOW};
    return world->driver->fns->image(world->driver->runner, &request, map, err);
}

bool sb_shadow_map_direction(const struct sb_shadow_world *world, int x, int y,
                             struct sb_vec3 *direction)
{
    const int n = world->size, column = x / n, row = y / n;
    const double u = (2 * (x % n) + 1.0) / n - 1, v = (2 * (y % n) + 1.0) / n - 1;
    const struct sb_vec3 middle[4] = {{-1, v, -u}, {u, v, -1}, {1, v, u}, {-u, v, 1}};
    if (row != 1 && column != 1)
        return false;
    *direction = row == 2   ? (struct sb_vec3){u, 1, v}
                 : row == 0 ? (struct sb_vec3){u, -1, -v}
                            : middle[column];
    return true;
}
