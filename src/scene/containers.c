// The ten containers of LearnOpenGL's chapter on multiple lights: a sun, four point
// lights and a flashlight at the places and with the numbers of the text. Further lights
// are ours.
#include "scene/make.h"

enum { CUBES = 10, TEXT_POINTS = 4 };

static const struct sb_vec3 eye = {0, 0, 3};

static const struct sb_vec3 cube_at[CUBES] = {
    {0, 0, 0},         {2, 5, -15},     {-1.5, -2.2, -2.5}, {-3.8, -2, -12.3},
    {2.4, -0.4, -3.5}, {-1.7, 3, -7.5}, {1.3, -2, -2.5},    {1.5, 2, -2.5},
    {1.5, 0.2, -1.5},  {-1.3, 1, -1.5},
};

static const struct sb_vec3 point_at[TEXT_POINTS] = {
    {0.7, 0.2, 2},
    {2.3, -3.3, -4},
    {-4, 2, -12},
    {0, 0, -3},
};

// sqrt(3)/2 is as far as a corner of a cube gets from its centre.
static bool clear_of_cubes(struct sb_vec3 point)
{
    for (int i = 0; i < CUBES; i++) {
        if (sb_vec3_length(sb_vec3_sub(point, cube_at[i])) < 0.9)
            return false;
    }
    return true;
}

// A place between 0.9 and 3 from the middle of cube i mod 10, on the eye's side of it.
//
// With l and v the directions from the cube to the light and to the eye, and a each of
// its three axes, the sum of (a.l)(a.v) is l.v > 0, so at least one term is positive: the
// light reaches a face that the eye sees, however the cube is turned.
static struct sb_vec3 beside_cube(int i)
{
    const struct sb_vec3 cube = cube_at[i % CUBES], at = sb_light_spread(i);
    const struct sb_vec3 way = sb_light_cap(sb_vec3_sub(eye, cube), 0.4, at.x, at.y);
    double distance = 1.5 + 1.5 * at.z;
    struct sb_vec3 place = sb_vec3_add(cube, sb_vec3_scale(way, distance));
    // No two cubes are closer than 2.06, so from 1.16 inwards all is clear, and a step
    // cannot jump over what lies between that and 0.9.
    while (!clear_of_cubes(place)) {
        distance *= 0.8;
        place = sb_vec3_add(cube, sb_vec3_scale(way, distance));
    }
    return place;
}

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_from_front(i);
}

static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = {
        .ambient = {0.05, 0.05, 0.05},
        .diffuse = {0.8, 0.8, 0.8},
        .specular = {1, 1, 1},
        .range = 50,
        .constant = 1,
        .linear = 0.09,
        .quadratic = 0.032,
    };
    if (i < TEXT_POINTS) {
        light.position = point_at[i];
    } else {
        light.position = beside_cube(i);
        sb_light_colour(&light, i, 0.1);
    }
    return light;
}

static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = sb_light_torch(eye);
    if (i > 0) {
        light.position = beside_cube(i);
        light.direction = sb_vec3_sub(cube_at[i % CUBES], light.position);
        light.inner = 30 * SB_DEGREE;
        light.outer = 45 * SB_DEGREE; // all of the cube, so that its corners are lit too
        sb_light_colour(&light, i, 0.1);
    }
    return light;
}

static int cells_of(double triangles)
{
    const double per_cell = 12 * CUBES;
    const double fewer = fmax(1, floor(sqrt(triangles / per_cell))), more = fewer + 1;
    const bool up =
        per_cell * more * more - triangles < triangles - per_cell * fewer * fewer;
    return (int)(up ? more : fewer);
}

void sb_scene_containers(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_material material = {
        .ambient = {1, 0.5f, 0.31f}, // the series' chapter on materials
        .diffuse = {1, 0.5f, 0.31f},
        .specular = {0.5f, 0.5f, 0.5f},
        .shininess = 32,
    };
    const struct sb_placement place = sb_placement_of(variant);
    const struct sb_mesh mesh =
        sb_mesh_cube(&scene->arena, cells_of(sb_triangles_wanted(variant, 12 * CUBES)));
    struct sb_draw draw[CUBES];
    for (int i = 0; i < CUBES; i++) {
        const struct sb_mat4 turned =
            sb_mat4_rotation(20 * i * SB_DEGREE, (struct sb_vec3){1, 0.3, 0.5});
        draw[i] = sb_draw_make(&place, 0, 0,
                               sb_mat4_multiply(sb_mat4_translation(cube_at[i]), turned));
    }
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = &mesh,
                      .mesh_count = 1,
                      .material = &material,
                      .draw = draw,
                      .draw_count = CUBES,
                      .ambient = 0.05f,
                      .clear = 0.1f,
                      .camera = {.eye = eye,
                                 .target = {0, 0, 0},
                                 .fov = 45 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light},
                  },
                  variant);
}
