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

// How far from the middle of every cube: sqrt(3)/2 is as far as a corner gets, and an area
// light reaches 0.9 from its own.
#define POINT_ROOM 0.9
#define AREA_ROOM  1.8

static bool clear_of_cubes(struct sb_vec3 point, double room)
{
    for (int i = 0; i < CUBES; i++) {
        if (sb_vec3_length(sb_vec3_sub(point, cube_at[i])) < room)
            return false;
    }
    return true;
}

// A place on the eye's side of cube i mod 10, 1.5 to 3 from its middle, or farther where
// other cubes stand in the way.
//
// With l and v the directions from the cube to the light and to the eye, and a each of
// its three axes, the sum of (a.l)(a.v) is l.v > 0, so at least one term is positive: the
// light reaches a face that the eye sees, however the cube is turned.
static struct sb_vec3 beside_cube(int i, double room)
{
    const struct sb_vec3 cube = cube_at[i % CUBES], at = sb_light_spread(i);
    const struct sb_vec3 way = sb_light_cap(sb_vec3_sub(eye, cube), 0.4, at.x, at.y);
    double distance = 1.5 + 1.5 * at.z;
    struct sb_vec3 place = sb_vec3_add(cube, sb_vec3_scale(way, distance));
    while (!clear_of_cubes(place, room)) {
        distance += 0.25;
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
        light.position = beside_cube(i, POINT_ROOM);
        sb_light_colour(&light, i, 0.1);
    }
    return light;
}

static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = sb_light_torch(eye);
    if (i > 0) {
        light.position = beside_cube(i, POINT_ROOM);
        light.direction = sb_vec3_sub(cube_at[i % CUBES], light.position);
        light.inner = 30 * SB_DEGREE;
        light.outer = 45 * SB_DEGREE; // all of the cube, so that its corners are lit too
        sb_light_colour(&light, i, 0.1);
    }
    return light;
}

// Farther from the cubes than half the segment and the radius reach.
static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = point_light(TEXT_POINTS + i);
    light.position = beside_cube(TEXT_POINTS + i, AREA_ROOM);
    sb_light_shape(&light, i);
    return light;
}

// In the text the maps are the material; without them it is that of the series' chapter on
// materials.
static struct sb_material material_of(const struct sb_variant *variant)
{
    struct sb_material material = {
        .ambient = {1, 0.5f, 0.31f},
        .diffuse = {1, 0.5f, 0.31f},
        .specular = {0.5f, 0.5f, 0.5f},
        .shininess = 32,
    };
    const int maps = (int)variant->value[SB_AXIS_MAPS];
    const bool diffuse = maps == SB_MAPS_D || maps == SB_MAPS_DS || maps == SB_MAPS_DN ||
                         maps == SB_MAPS_DSN;
    const bool specular = maps == SB_MAPS_S || maps == SB_MAPS_DS || maps == SB_MAPS_SN ||
                          maps == SB_MAPS_DSN;
    for (int i = 0; i < 3; i++) {
        if (diffuse)
            material.ambient[i] = material.diffuse[i] = 1;
        if (specular)
            material.specular[i] = 1;
    }
    return material;
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
    const struct sb_material material = material_of(variant);
    const struct sb_placement place = sb_placement_of(variant, eye);
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
                      .material_count = 1,
                      .draw = draw,
                      .draw_count = CUBES,
                      .ambient = 0.05,
                      .clear = 0.1,
                      .camera = {.eye = eye,
                                 .target = {0, 0, 0},
                                 .fov = 45 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light, area_light},
                  },
                  variant);
}
