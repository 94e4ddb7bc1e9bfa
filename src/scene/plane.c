// The tunnel of the GLSL wikibook's page on multiple lights: subway lights of limited
// reach along a corridor seen from inside. A wall closes its far end, so that every pixel
// of the target is covered.
#include "scene/make.h"

#define HALF   2.0 // of its width and height; floor, ceiling and walls are one mesh
#define LENGTH 24.0
#define NEAR_Z 1.0 // behind the eye, which stands at the origin

static const double far_z = NEAR_Z - LENGTH;

static struct sb_light_params dir_light(int i)
{
    if (i == 0)
        return sb_light_sun();
    // From across the corridor: such light falls on floor, ceiling or a wall, all of
    // which the eye sees.
    const struct sb_vec3 at = sb_light_spread(i);
    const double turn = 2 * SB_PI * at.x;
    struct sb_light_params light = {.direction = {cos(turn), sin(turn), at.y - 0.5}};
    light.direction = sb_vec3_normalise(light.direction);
    sb_light_colour(&light, i, 0.1);
    return light;
}

// Along both sides, under the ceiling, from where the eye begins to see walls to the end.
static struct sb_vec3 beside_wall(struct sb_vec3 at, int i)
{
    return (struct sb_vec3){
        .x = (i % 2 ? 1 : -1) * (1.4 + 0.4 * at.x),
        .y = 1 + 0.8 * at.y,
        .z = -4 + at.z * (far_z + 0.5 + 4),
    };
}

static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = {
        .position = beside_wall(sb_light_spread(i), i),
        .range = 7, // with the numbers that the series of `containers` gives for it
        .constant = 1,
        .linear = 0.7,
        .quadratic = 1.8,
    };
    sb_light_colour(&light, i, 0.5);
    return light;
}

// From just under the ceiling, down at the floor.
static struct sb_light_params spot_light(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {2.4 * (at.x - 0.5), HALF - 0.1, -6 + at.z * (far_z + 2 + 6)},
        .direction = {0.6 * (at.y - 0.5), -1, 0},
        .range = 13, // likewise
        .constant = 1,
        .linear = 0.35,
        .quadratic = 0.44,
        .inner = 20 * SB_DEGREE,
        .outer = 30 * SB_DEGREE,
        .exponent = 8,
    };
    sb_light_colour(&light, i, 0.8);
    return light;
}

// The four long sides, each the same mesh: its height runs down the corridor, its front
// faces inwards. Written out, because the cosine of a quarter turn is not 0 in double.
static void place_sides(struct sb_draw draw[4], const struct sb_placement *place)
{
    static const struct {
        struct sb_vec3 right, front;
    } side[4] = {
        {{1, 0, 0}, {0, 1, 0}},   // floor
        {{0, 1, 0}, {-1, 0, 0}},  // the wall on the right
        {{-1, 0, 0}, {0, -1, 0}}, // ceiling
        {{0, -1, 0}, {1, 0, 0}},
    };
    for (int i = 0; i < 4; i++) {
        const struct sb_vec3 right = side[i].right, front = side[i].front;
        // clang-format off
        const struct sb_mat4 model = {{
            right.x,          right.y,          right.z,              0,
            0,                0,                -1,                   0,
            front.x,          front.y,          front.z,              0,
            -HALF * front.x,  -HALF * front.y,  (NEAR_Z + far_z) / 2, 1,
        }};
        // clang-format on
        draw[i] = sb_draw_make(place, 0, 0, model);
    }
}

void sb_scene_plane(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_material material = {
        // the page's frontMaterial
        .ambient = {0.2f, 0.2f, 0.2f},
        .diffuse = {1, 0.8f, 0.8f},
        .specular = {1, 1, 1},
        .shininess = 5,
    };
    // 2 (4 across along + across^2) triangles; a cell is square where `along` is `across`
    // times LENGTH / (2 HALF) = 6, which makes 50 across^2.
    const double triangles = sb_triangles_wanted(variant, 200);
    const double across = fmax(1, round(sqrt(triangles / 50)));
    const double along = fmax(1, round((triangles / 2 - across * across) / (4 * across)));

    const struct sb_placement place = sb_placement_of(variant);
    const struct sb_mesh mesh[2] = {
        sb_mesh_plane(&scene->arena, 2 * HALF, LENGTH, (int)across, (int)along),
        sb_mesh_plane(&scene->arena, 2 * HALF, 2 * HALF, (int)across, (int)across),
    };
    struct sb_draw draw[5];
    place_sides(draw, &place);
    draw[4] =
        sb_draw_make(&place, 1, 0, sb_mat4_translation((struct sb_vec3){0, 0, far_z}));
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = mesh,
                      .mesh_count = 2,
                      .material = &material,
                      .draw = draw,
                      .draw_count = 5,
                      .ambient = 0.2f, // the page's scene_ambient
                      .clear = 0.1f,
                      .camera = {.target = {0, 0, -1},
                                 .fov = 45 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light},
                  },
                  variant);
}
