// The tunnel of the GLSL wikibook's page on multiple lights, without its lights. A wall closes
// the far end, so that every pixel of the target is covered.
#include "scene/make.h"

const struct sb_material sb_corridor_material = {
    .ambient = {0.2f, 0.2f, 0.2f},
    .diffuse = {1, 0.8f, 0.8f},
    .specular = {1, 1, 1},
    .shininess = 5,
};

void sb_corridor_make(const struct sb_corridor *corridor, double triangles,
                      struct sb_arena *arena, struct sb_mesh mesh[SB_CORRIDOR_MESHES])
{
    // 2 (4 across along + across^2) triangles; a cell is square where `along` is `across`
    // times length / width, which makes 2 (4 length / width + 1) across^2.
    const double width = 2 * corridor->half, length = corridor->near_z - corridor->far_z;
    const double square = 2 * (4 * length / width + 1);
    const double across = fmax(1, round(sqrt(triangles / square)));
    const double along = fmax(1, round((triangles / 2 - across * across) / (4 * across)));
    mesh[0] = sb_mesh_plane(arena, width, length, (int)across, (int)along);
    mesh[1] = sb_mesh_plane(arena, width, width, (int)across, (int)across);
}

// The four long sides are the same mesh: its height runs down the corridor, its front faces
// inwards. Written out, because the cosine of a quarter turn is not 0 in double.
void sb_corridor_place(const struct sb_corridor *corridor,
                       const struct sb_placement *place,
                       struct sb_draw draw[SB_CORRIDOR_DRAWS])
{
    static const struct {
        struct sb_vec3 right, front;
    } side[4] = {
        {{1, 0, 0}, {0, 1, 0}},   // floor
        {{0, 1, 0}, {-1, 0, 0}},  // the wall on the right
        {{-1, 0, 0}, {0, -1, 0}}, // ceiling
        {{0, -1, 0}, {1, 0, 0}},
    };
    const double half = corridor->half, near_z = corridor->near_z;
    const double far_z = corridor->far_z;
    for (int i = 0; i < 4; i++) {
        const struct sb_vec3 right = side[i].right, front = side[i].front;
        // clang-format off
        const struct sb_mat4 model = {{
            right.x,          right.y,          right.z,              0,
            0,                0,                -1,                   0,
            front.x,          front.y,          front.z,              0,
            -half * front.x,  -half * front.y,  (near_z + far_z) / 2, 1,
        }};
        // clang-format on
        draw[i] = sb_draw_make(place, 0, 0, model);
    }
    draw[4] =
        sb_draw_make(place, 1, 0, sb_mat4_translation((struct sb_vec3){0, 0, far_z}));
}

struct sb_light_params sb_light_across(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    const double turn = 2 * SB_PI * at.x;
    struct sb_light_params light = {.direction = {cos(turn), sin(turn), at.y - 0.5}};
    light.direction = sb_vec3_normalise(light.direction);
    sb_light_colour(&light, i, 0.1);
    return light;
}
