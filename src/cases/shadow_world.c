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

enum { COLOUR = 4, SHOWN = COLOUR + 3, N_DOT_L = COLOUR + 4, REACHED = COLOUR + 11 };

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
