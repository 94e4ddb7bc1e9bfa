// Scenes: what is drawn. Generated, a pure function of name and variant, the same bytes
// on every run; plain structs, so that a loader can fill them too.
//
// World space is right-handed, y up, units of the source texts; colours are linear light;
// angles are radians; matrices are column-major as GL takes them.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "axis/variant.h"
#include "base/mem.h"
#include "scene/lights.h"

enum { SB_ATTRIBUTES = 4 }; // a_position, a_normal, a_uv, a_tangent: locations 0 to 3

struct sb_vertex {
    float position[3];
    float normal[3]; // unit length, object space
    float uv[2];
    float tangent[4]; // w: sign of the bitangent cross(normal, tangent.xyz) * w
};

struct sb_mesh { // indexed triangles, counter-clockwise seen from outside
    const struct sb_vertex *vertex;
    const uint32_t *index;
    int vertex_count, index_count;
    bool sphere; // it stands for the unit sphere, which is the truth of it
};

struct sb_material {
    float ambient[3], diffuse[3], specular[3];
    float shininess;
    unsigned
        lacks; // bit i: map i of the scene is not on it: as if it were white, or flat
};

struct sb_draw { // one mesh, placed
    int mesh, material;
    int lamp; // -1; else the number of the point light that this draw shows, unlit
    float model[16];
    float normal_matrix[9]; // sb_mat4_normal_matrix: right for mirrors, and normals of
                            // turned and evenly scaled models keep unit length
};

struct sb_texture { // RGBA8, linear light, rows from the bottom up, repeats
    int width, height;
    const unsigned char *texel;
};
enum sb_map { SB_MAP_DIFFUSE, SB_MAP_SPECULAR, SB_MAP_NORMAL, SB_MAP_COUNT };

struct sb_camera {
    float eye[3];
    float view[16], projection[16], view_projection[16];
};

struct sb_scene {
    const char *name;
    const struct sb_mesh *mesh;
    const struct sb_material *material;
    const struct sb_draw *draw;
    int mesh_count, material_count, draw_count;
    struct sb_texture map[SB_MAP_COUNT];
    struct sb_lights lights;
    float ambient[3]; // the scene's own ambient light
    float clear_colour[4];
    struct sb_camera camera;
    struct sb_arena arena; // owns all of the above
};

struct sb_scene_row { // the table of scenes
    const char *name, *help;
    void (*make)(struct sb_scene *scene, const struct sb_variant *variant);
    bool analytic; // its truth is a closed form (sb_mesh.sphere), not its triangles
};
extern const struct sb_scene_row sb_scene_rows[];
extern const int sb_scene_row_count;

// The row called `name`; an unknown name fails with the nearest and all valid names.
const struct sb_scene_row *sb_scene_expect(const char *name, struct sb_error *err);

// Is the truth of the scene called `name` a closed form? Then more triangles are quality, not
// another picture. False for an unknown name.
bool sb_scene_analytic(const char *name);

// Builds and validates. The variant must be resolved. *scene must be zeroed;
// sb_scene_free also after failure.
bool sb_scene_make(const char *name, const struct sb_variant *variant,
                   struct sb_scene *scene, struct sb_error *err);
void sb_scene_free(struct sb_scene *scene);

// Everything finite and in range; the error names the light (or draw, or material), the
// field, the value and the valid range: "point light 3: diffuse[1] is nan; …".
bool sb_scene_validate(const struct sb_scene *scene, struct sb_error *err);

// Hash over every float, index and texel that is uploaded.
uint64_t sb_scene_hash(const struct sb_scene *scene);

// Triangles of all draws together, each mesh as often as it is drawn.
int64_t sb_scene_triangles(const struct sb_scene *scene);
