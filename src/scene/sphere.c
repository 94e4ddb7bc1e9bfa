// One sphere, seen whole and lit from the eye's side: curved everywhere, so that every
// angle between normal, light and view occurs, and its truth has a closed form.
#include "scene/make.h"

#define FOV (45 * SB_DEGREE)

// The outline of the unit sphere seen from distance d is a circle of half angle asin(1 /
// d); it covers four fifths of the shorter side of the target.
static struct sb_vec3 eye(void)
{
    return (struct sb_vec3){0, 0, 1 / sin(atan(0.8 * tan(FOV / 2)))};
}

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_from_front(i);
}

// Within 60 degrees of the eye's direction, where the eye sees all of the sphere; 1.5 to
// 3 from its centre.
static struct sb_light_params point_light(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    const struct sb_vec3 way = sb_light_cap((struct sb_vec3){0, 0, 1}, 0.5, at.x, at.y);
    struct sb_light_params light = {
        .position = sb_vec3_scale(way, 1.5 + 1.5 * at.z),
        .range = 50,
        .constant = 1,
        .linear = 0.09,
        .quadratic = 0.032,
    };
    sb_light_colour(&light, i, 0.2);
    return light;
}

static struct sb_light_params spot_light(int i)
{
    if (i == 0)
        return sb_light_torch(eye());
    struct sb_light_params light = point_light(i);
    light.direction = sb_vec3_scale(light.position, -1);
    light.inner = 15 * SB_DEGREE;
    light.outer = 20 * SB_DEGREE;
    light.exponent = 8;
    return light;
}

// As far out as half the segment and the radius demand.
static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = point_light(i);
    light.position =
        sb_vec3_scale(light.position, 1 + 0.5 / sb_vec3_length(light.position));
    sb_light_shape(&light, i);
    return light;
}

void sb_scene_sphere(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_material material = {
        .ambient = {0.7f, 0.7f, 0.7f},
        .diffuse = {0.7f, 0.7f, 0.7f},
        .specular = {0.5f, 0.5f, 0.5f},
        .shininess = 32,
    };
    int stacks, slices;
    sb_sphere_cells(sb_triangles_wanted(variant, 500), &stacks, &slices);
    const struct sb_placement place = sb_placement_of(variant, eye());
    struct sb_mesh mesh = sb_mesh_sphere(&scene->arena, stacks, slices);
    mesh.sphere = true; // so that its triangles are an error that can be measured
    const struct sb_draw draw = sb_draw_make(&place, 0, 0, sb_mat4_scaling(1));
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = &mesh,
                      .mesh_count = 1,
                      .material = &material,
                      .material_count = 1,
                      .draw = &draw,
                      .draw_count = 1,
                      .ambient = 0.05,
                      .clear = 0.1,
                      .camera = {.eye = eye(), .fov = FOV, .near = 0.1, .far = 100},
                      .light = {dir_light, point_light, spot_light, area_light},
                  },
                  variant);
}
