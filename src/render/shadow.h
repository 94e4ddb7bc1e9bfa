// Shadow maps of the first point lights of a scene: textures and framebuffers, the passes that
// draw them, and reading them back.
//
// A map holds, for each direction from its light, what the program of role "shadow" stores
// (docs/glsl.md): 1 - d/range cleared to 0, or with shadow_store=depth the depth. The faces
// are squares with a field of view of 90 degrees, from a depth of range / SB_SHADOW_NEAR to
// range.
#pragma once

#include "math/vec.h"
#include "render/render.h"

enum { SB_SHADOW_NEAR = 1000, SB_FACES = 6 };

// The way a camera of a face looks, and what is up in its picture.
struct sb_face {
    struct sb_vec3 forward, up;
};
// XP XN YP YN ZP ZN for this value of axis shadow_map: those of the text `shadows` for 2D
// textures, those of table 8.19 of OpenGL 4.6 core for cube maps.
const struct sb_face *sb_shadow_faces(int kind);

struct sb_shadow {
    const struct sb_upload *upload;
    int kind, store; // values of the axes shadow_map and shadow_store
    bool layered, gles;
    int casters, size; // point lights; texels a side
    GLenum target;     // of the textures
    GLuint *texture;   // six a caster, one a caster, or one
    int texture_count;
    GLuint *framebuffer; // one a face; layered: one a texture
    int framebuffer_count;
    GLuint depth_buffer, depth_texture; // of the passes; 0: the map is the depth buffer
    GLuint program;
    GLint model, face, light_position, light_range, first_layer;
    struct sb_lights phase[SB_PHASES]; // world space; the first one is the scene's own
    int phase_count;                   // SB_PHASES where casters move, else 1
    struct sb_light *light;            // owns the phases' lights
};

// How many lights cast shadows in this variant.
int sb_shadow_casters(const struct sb_variant *variant);

struct sb_shadow_params {
    GLuint program; // of role "shadow"; the caller's, must outlive this
    const struct sb_upload *upload;
    const struct sb_variant
        *variant; // resolved, and within the limits of sb_decide_shadows
    const struct sb_caps *caps;
};
// *shadow must be zeroed; sb_shadow_free also after failure. SB_OVER_LIMIT where the driver
// refuses the textures, SB_BAD_INPUT where a caster has no range.
bool sb_shadow_make(struct sb_shadow *shadow, const struct sb_shadow_params *params,
                    struct sb_error *err);
void sb_shadow_free(struct sb_shadow *shadow);

// Maps of one texel, for a program that could look up more casters than the scene has: what it does
// not look up must be bound all the same, and the same in every frame. Only for sb_shadow_bind.
void sb_shadow_make_unused(struct sb_shadow *shadow, const struct sb_variant *variant);

// Draws all maps anew for these lights of world space (the first point lights are the
// casters); lamps cast no shadow, since they stand around the light. Sets all state, returns
// the number of GL calls, leaves framebuffer and viewport changed.
int64_t sb_shadow_draw(const struct sb_shadow *shadow, const struct sb_lights *lights);

// Vertices of all its passes.
int64_t sb_shadow_vertices(const struct sb_shadow *shadow);

// Points the samplers u_shadow_map of a program at the units behind those of the maps; once. Those
// of casters that the scene has not, too: two samplers of different types may not share a unit.
void sb_shadow_set_units(GLuint program);
// Binds the textures to these units; returns the number of GL calls.
int64_t sb_shadow_bind(const struct sb_shadow *shadow);

// The map of one caster as stored, one channel, unfolded to a cross of 4 x 3 faces as they are
// seen from the light: XN ZN XP ZP from left to right, YP above ZN and YN below it; 0 in the
// corners. Initialises *image, which the caller frees; on false there is nothing to free.
bool sb_shadow_read(const struct sb_shadow *shadow, const struct sb_caps *caps,
                    int caster, struct sb_image *image, struct sb_error *err);
