// Draws a scene with a program: the scene on the GPU, the program bound to it, one frame.
//
// Uniforms are set by name (docs/glsl.md); a name that a program does not have is
// skipped, so the same code serves programs with fewer lights, no maps or no lighting at
// all.
#pragma once

#include "axis/variant.h"
#include "gl/program.h"
#include "gl/target.h"
#include "scene/scene.h"

// --- what a variant draws into: the axes that are no GLSL and no scene -----------------

struct sb_shape {
    int width, height; // pixels
    enum sb_gl_format format;
    int layers; // number of times a frame draws the whole scene
};
struct sb_shape sb_shape_of(const struct sb_variant *variant);

// The widest float format that can be drawn to; where there is none, one that
// sb_target_make refuses with the reason.
enum sb_gl_format sb_format_wide(const struct sb_caps *caps);

// Frames of a batch alternate between the targets, so that no frame waits for, or is
// folded into, the one before it.
enum { SB_RING_SIZE = 2 };
struct sb_ring {
    struct sb_target target[SB_RING_SIZE];
};
// *ring must be zeroed; sb_ring_free also after failure. SB_OVER_LIMIT as sb_target_make.
bool sb_ring_make(struct sb_ring *ring, const struct sb_caps *caps,
                  const struct sb_shape *shape, struct sb_error *err);
void sb_ring_free(struct sb_ring *ring);

// --- a scene on the GPU ----------------------------------------------------------------

struct sb_gpu_mesh {
    GLuint vertex_array, vertices, indices;
};
struct sb_upload {
    const struct sb_scene *scene; // the caller's; must outlive this
    struct sb_gpu_mesh *mesh;     // scene->mesh_count
    GLuint map[SB_MAP_COUNT];     // 0: the scene has none
};
// Maps are sampled bilinearly at full size and repeat: mipmap levels and their selection
// differ between drivers. A driver that runs out of memory says so in sb_gl_error.
void sb_upload_make(struct sb_upload *upload, const struct sb_scene *scene);
void sb_upload_free(struct sb_upload *upload);

// --- a program bound to a scene --------------------------------------------------------

struct sb_light_slot { // where one member of one light goes; -1: not there
    GLint location;    // in the default block
    GLint offset;      // in the block Lights, bytes
};
struct sb_binding {
    const struct sb_upload *upload;
    GLuint program; // the caller's; must outlive this
    GLint model, normal_matrix, ambient, diffuse, specular, shininess, draw;
    GLint map[SB_MAP_COUNT];
    struct sb_light_slot *slot; // types x lights x fields, in the order of the tables
    GLuint buffer;              // of the block Lights; 0: the program has none
    unsigned char *block;       // what is uploaded to it
    GLint block_size;           // bytes
};
// Looks every location up, once, and sets all that does not change from frame to frame,
// lights included. Fails where the program samples a map that the scene does not have.
// sb_binding_free also after failure.
bool sb_binding_make(struct sb_binding *binding, GLuint program,
                     const struct sb_upload *upload, struct sb_error *err);
void sb_binding_free(struct sb_binding *binding);

// Uploads all lights; those at [off_first, off_first + off_count) of the whole list
// (directional, point, spot) with black ambient, diffuse and specular colours.
void sb_binding_lights(struct sb_binding *binding, int off_first, int off_count);

// --- a frame ---------------------------------------------------------------------------

struct sb_frame_params {
    const struct sb_binding *binding;
    const struct sb_target *target;
    int layers;
    bool gles;
};
// A whole frame: target, all state, clear of colour and depth, draws. Returns the number
// of GL calls it made. Leaves the target's framebuffer bound.
int64_t sb_frame_draw(const struct sb_frame_params *params);

// A program whose colour is the number of the draw, from 1, for an SB_GL_R32UI target:
// bound and drawn like any other, so that it covers the pixels that a shader covers which
// computes its position as u_view_projection * (u_model * vec4(a_position, 1)).
bool sb_id_program_make(struct sb_gl_program *program, bool gles, struct sb_error *err);
