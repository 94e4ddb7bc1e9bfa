// A closed room with boxes and two pillars in it, seen from inside, for shadows of point
// lights: the lamps hang in different places, and each throws other shadows into view.
#include "scene/make.h"

#define HALF_X 4.0
#define HALF_Y 2.0
#define HALF_Z 5.0
#define BLOCK  0.8 // a pillar is a stack of five

enum { WALLS = 6, BOXES = 4, PILLARS = 2, STACK = 5, CUBES = BOXES + PILLARS * STACK };

static const struct sb_vec3 eye = {0, 0.4, 4.7};

static const struct box {
    double x, z, size, turn; // size: of its side; turn: degrees about y
} box[BOXES] = {
    {-1.2, 1.2, 1.0, 25},
    {1.6, 0.6, 0.7, 50},
    {0.3, -2.6, 1.3, 10},
    {3.0, -3.6, 1.0, 70},
};

static const struct sb_vec3 pillar[PILLARS] = {{-2, 0, -1.6}, {2.1, 0, -1.2}};

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_across(i);
}

// Away from the walls and the pillars by `room`, above the boxes. What would be too near a
// pillar goes towards the middle of the room, where there is room enough between the two.
static struct sb_light_params lamp(int i, double room)
{
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {2 * (HALF_X - room) * (at.x - 0.5),
                     -0.4 + room + (HALF_Y + 0.4 - 2 * room) * at.y,
                     2 - (2 + HALF_Z - room) * at.z},
        .range = 12,
        .constant = 1,
        .linear = 0.22,
        .quadratic = 0.2,
    };
    for (int k = 0; k < PILLARS; k++) {
        const double across = light.position.x - pillar[k].x;
        const double away = light.position.z - pillar[k].z, clear = 0.6 + room;
        if (across * across + away * away < clear * clear)
            light.position.x =
                pillar[k].x - copysign(sqrt(clear * clear - away * away), pillar[k].x);
    }
    sb_light_colour(&light, i, 0.6);
    return light;
}

static struct sb_light_params point_light(int i)
{
    return lamp(i, 0.3);
}

// At the floor, a little farther from the eye than under the lamp: the floor below the eye is
// not in view.
static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = lamp(i, 0.3);
    const struct sb_vec3 at = light.position;
    light.direction =
        sb_vec3_sub((struct sb_vec3){0.7 * at.x, -HALF_Y, 0.6 * at.z - 1.2}, at);
    light.inner = 25 * SB_DEGREE;
    light.outer = 35 * SB_DEGREE;
    light.exponent = 8;
    return light;
}

static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = lamp(i, 0.9);
    sb_light_shape(&light, i);
    return light;
}

// Three meshes, two walls each, and how they stand: columns right, up and front, which faces
// the middle of the room.
static const struct wall {
    int mesh;
    double width, height;
    struct sb_vec3 right, up, front;
    double distance;
} wall[WALLS] = {
    {0, 2 * HALF_X, 2 * HALF_Z, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, HALF_Y},
    {0, 2 * HALF_X, 2 * HALF_Z, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, HALF_Y},
    {1, 2 * HALF_X, 2 * HALF_Y, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, HALF_Z},
    {1, 2 * HALF_X, 2 * HALF_Y, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, HALF_Z},
    {2, 2 * HALF_Z, 2 * HALF_Y, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}, HALF_X},
    {2, 2 * HALF_Z, 2 * HALF_Y, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, HALF_X},
};
enum { WALL_MESHES = 3, CUBE_MESH = WALL_MESHES, MESHES };

static void place_walls(struct sb_draw draw[WALLS], const struct sb_placement *place)
{
    for (int i = 0; i < WALLS; i++) {
        const struct wall *it = &wall[i];
        const struct sb_vec3 at = sb_vec3_scale(it->front, -it->distance);
        const struct sb_mat4 model = {{
            it->right.x, it->right.y, it->right.z, 0, //
            it->up.x, it->up.y, it->up.z, 0,          //
            it->front.x, it->front.y, it->front.z, 0, //
            at.x, at.y, at.z, 1,                      //
        }};
        draw[i] = sb_draw_make(place, it->mesh, 0, model);
    }
}

static void place_cubes(struct sb_draw draw[CUBES], const struct sb_placement *place)
{
    for (int i = 0; i < CUBES; i++) {
        const int k = i - BOXES;
        struct box it = {.size = BLOCK};
        double height = -HALF_Y;
        if (k < 0) {
            it = box[i];
        } else {
            it.x = pillar[k / STACK].x;
            it.z = pillar[k / STACK].z;
            height += k % STACK * BLOCK;
        }
        const struct sb_vec3 at = {it.x, height + it.size / 2, it.z};
        const struct sb_mat4 turned = sb_mat4_multiply(
            sb_mat4_rotation(it.turn * SB_DEGREE, (struct sb_vec3){0, 1, 0}),
            sb_mat4_scaling(it.size));
        draw[i] = sb_draw_make(place, CUBE_MESH, 0,
                               sb_mat4_multiply(sb_mat4_translation(at), turned));
    }
}

static void make_meshes(struct sb_mesh mesh[MESHES], struct sb_arena *arena,
                        double triangles)
{
    // A third of them for the cubes, as near as whole cells allow, the rest for the walls in
    // proportion to their sides.
    const double cells = fmax(1, round(sqrt(triangles / 3 / (12 * CUBES))));
    double area = 0;
    for (int i = 0; i < WALLS; i++)
        area += wall[i].width * wall[i].height;
    const double rest = fmax(triangles - 12 * CUBES * cells * cells, 0);
    const double density = sqrt(rest / 2 / area);
    for (int i = 0; i < WALLS; i += 2)
        mesh[wall[i].mesh] = sb_mesh_plane(arena, wall[i].width, wall[i].height,
                                           (int)fmax(1, round(density * wall[i].width)),
                                           (int)fmax(1, round(density * wall[i].height)));
    mesh[CUBE_MESH] = sb_mesh_cube(arena, (int)cells);
}

void sb_scene_room(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_material material = {
        .ambient = {0.8f, 0.78f, 0.75f},
        .diffuse = {0.8f, 0.78f, 0.75f},
        .specular = {0.3f, 0.3f, 0.3f},
        .shininess = 24,
    };
    const struct sb_placement place = sb_placement_of(variant, eye);
    struct sb_mesh mesh[MESHES];
    struct sb_draw draw[WALLS + CUBES];
    make_meshes(mesh, &scene->arena, sb_triangles_wanted(variant, 800));
    place_walls(draw, &place);
    place_cubes(draw + WALLS, &place);
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = mesh,
                      .mesh_count = MESHES,
                      .material = &material,
                      .material_count = 1,
                      .draw = draw,
                      .draw_count = WALLS + CUBES,
                      .ambient = 0.05,
                      .clear = 0.1,
                      .camera = {.eye = eye,
                                 .target = {0, -0.5, 0},
                                 .fov = 60 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light, area_light},
                  },
                  variant);
}
