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
    int samples; // a pixel
    int layers;  // number of times a frame draws the whole scene
};
struct sb_shape sb_shape_of(const struct sb_variant *variant);

// Is the lighting evaluated in the vertex shader?
bool sb_lit_per_vertex(const struct sb_variant *variant);

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
    // One texel that changes nothing, for materials that lack a map; 0: no material does.
    GLuint neutral[SB_MAP_COUNT];
};
// Maps are sampled bilinearly at full size and repeat: mipmap levels and their selection
// differ between drivers. A driver that runs out of memory says so in sb_gl_error.
void sb_upload_make(struct sb_upload *upload, const struct sb_scene *scene);
// The same meshes with three vertices of their own for each triangle, in order, so that
// gl_VertexID tells triangle and corner. No maps.
void sb_upload_make_triangles(struct sb_upload *upload, const struct sb_scene *scene);
void sb_upload_free(struct sb_upload *upload);

// --- lights, uploaded ------------------------------------------------------------------

// Where one member of one light goes, of those that the program has.
struct sb_light_place {
    int list;       // SB_LIGHT_TYPE_COUNT: the whole list, else the lights of that type
    int light;      // number in it
    size_t source;  // of the member in struct sb_light
    int components; // 1 or 3
    bool pads;      // set to 0 where the list is shorter
    GLint location; // a uniform of its own; -1: none, then it is …
    size_t staged;  // … this far into `staged`
};
struct sb_member_array { // storage=arrays: one uniform array, set by one call
    GLint location;
    int components, count;
    size_t staged;
};
struct sb_light_upload {
    GLuint program, buffer; // buffer: of the block Lights; 0: the program has none
    struct sb_light_place *place;
    struct sb_member_array *array;
    unsigned char *staged; // what the block, or the arrays, are set from
    int place_count, place_capacity, array_count, array_capacity;
    GLint block_size;                   // bytes
    GLint count[SB_LIGHT_STRUCT_COUNT]; // u_point_count …; -1: not there
    bool sets_uniforms;
};
// Looks up, once, where the members of these lights go, and of those that the arrays of the
// variant's loop have room for besides. sb_light_upload_free in any case.
void sb_light_upload_make(struct sb_light_upload *upload, GLuint program,
                          const struct sb_variant *variant,
                          const struct sb_lights *lights);
void sb_light_upload_free(struct sb_light_upload *upload);

// Sets every member that the program has of these lights, which must be as sb_light_as_lit
// makes them, and no more of any type than there is room for. Entries of padded arrays
// beyond them get intensity 0. Returns the number of GL calls.
int64_t sb_light_upload_set(const struct sb_light_upload *upload,
                            const struct sb_lights *lights);

// The phase that frame `number` shows. With update=lights the casters of shadows stand still.
struct sb_phase sb_phase_of(const struct sb_variant *variant, int number);

// --- a program bound to a scene --------------------------------------------------------

// A uniform that differs from draw to draw: what a program that decides at run time asks.
struct sb_draw_uniform {
    const char *name;
    const int *value; // of each draw of the scene
};
enum { SB_DRAW_UNIFORMS_MAX = 8 };

// A program, some lights of the scene, and the draws that they light.
struct sb_binding {
    const struct sb_upload *upload;
    GLuint program;  // the caller's; must outlive this
    const int *draw; // numbers of draws, in the order drawn; the caller's. NULL: all
    int draw_count;
    GLint model, normal_matrix, ambient, diffuse, specular, shininess, draw_number,
        lamp_colour;
    GLint map[SB_MAP_COUNT];
    float *normal_matrices; // 9 a draw, object to view; NULL: those of the draws
    GLuint materials;       // buffer of the block MaterialBlock; 0: the program has none
    GLsizeiptr material_size; // bytes of the block …
    GLintptr material_stride; // … and from one material's range to the next's
    GLint draw_uniform[SB_DRAW_UNIFORMS_MAX];
    const int *draw_uniform_value[SB_DRAW_UNIFORMS_MAX];
    int draw_uniform_count;
    struct sb_light_upload lights;
    int *number;                       // in the scene's whole list, of each of its lights
    struct sb_lights phase[SB_PHASES]; // as lit; the first one is the scene's own
    int phase_count;         // 1, or SB_PHASES where each frame uploads the next
    struct sb_light *as_lit; // owns the phases' lights
    // Lights that are plain uniforms are the program's: where another binding has the same
    // program, they are uploaded each time that this one is bound, from `now`.
    bool shares_program;
    struct sb_lights now;
    struct sb_light *now_light; // owns those of `now`
};
struct sb_binding_params {
    GLuint program;
    const struct sb_upload *upload;
    const struct sb_variant *variant; // resolved; of the program's text
    // Numbers of lights in the scene's whole list, types one after another, and how many of each;
    // light_count NULL: all.
    const int *light, *light_count;
    const int *draw; // as in struct sb_binding
    int draw_count;
    const struct sb_draw_uniform *draw_uniform;
    int draw_uniform_count;
    bool shares_program;
};
// Looks every location up, once, and sets all that does not change from frame to frame,
// and the lights. Fails where the program samples a map that the scene does not have.
// sb_binding_free also after failure.
bool sb_binding_make(struct sb_binding *binding, const struct sb_binding_params *params,
                     struct sb_error *err);
void sb_binding_free(struct sb_binding *binding);

// Uploads the binding's lights as the scene has them; those at [off_first, off_first + off_count)
// of the scene's whole list with black ambient, diffuse and specular colours.
void sb_binding_lights(const struct sb_binding *binding, int off_first, int off_count);

// Where the lights go by the phase that a frame shows. Returns the number of GL calls.
int64_t sb_binding_phase(const struct sb_binding *binding, int phase);

// --- a frame ---------------------------------------------------------------------------

struct sb_shadow; // shadow.h

struct sb_frame_params {
    const struct sb_binding *binding; // one after another; at least one
    int binding_count;                // 0 is 1
    const struct sb_binding
        *lamp; // for draws that show a lamp; NULL: `binding` does them too
    // With a target of several attachments, which lamps do not write: a program that writes 0
    // to all but the first (sb_blank_program_make), bound. Else it does not matter.
    const struct sb_binding *blank;
    const struct sb_shadow *shadow; // maps that `binding` looks up; NULL: none
    const struct sb_shadow
        *unused_shadow; // for its other samplers of maps; NULL: it has none
    const struct sb_target *target;
    int layers;
    int phase;         // of the lights, uploaded first; -1: they are left as they are
    const int *pixel;  // x, y: only this one is cleared and drawn; NULL: all
    bool shadows_only; // no picture: only the lights and the shadow maps
    bool gles;
};
// A whole frame: lights, shadow maps where they change, target, all state, clear of colour
// and depth, draws, resolve. Returns the number of GL calls it made. Leaves the framebuffer
// bound that is read.
int64_t sb_frame_draw(const struct sb_frame_params *params);

// Ends a batch of frames without pictures: clears the target, so that whoever waits for it
// waits for the shadow maps too, and leaves its framebuffer bound. These cannot be waited for
// themselves: OpenGL ES reads no depth buffers.
void sb_frame_end_shadows(const struct sb_target *target);

// A program whose colour is the number of the draw, from 1, for an SB_GL_R32UI target:
// bound and drawn like any other, so that it covers the pixels that a shader covers which
// computes its position as u_view_projection * (u_model * vec4(a_position, 1)).
bool sb_id_program_make(struct sb_gl_program *program, bool gles, struct sb_error *err);

// A program for a scene uploaded as triangles and an SB_GL_RGBA32UI target: the bits of the
// number of the draw, that of the triangle in its mesh, both from 1, and the driver's own
// weights of the triangle's second and third vertex. Covers the pixels of the id program.
bool sb_geometry_program_make(struct sb_gl_program *program, bool gles,
                              struct sb_error *err);

// A program that writes 0 to the outputs at locations 1 to SB_TARGET_MORE.
bool sb_blank_program_make(struct sb_gl_program *program, bool gles,
                           struct sb_error *err);

// --- what the vertex shader hands on ---------------------------------------------------

// Vertices of the meshes of all lit draws, each mesh as often as it is drawn.
int64_t sb_capture_vertices(const struct sb_scene *scene);

struct sb_capture_params {
    const struct sb_binding *binding; // of a program made by sb_gl_program_make_captured
    const struct sb_shadow *shadow;   // maps that `binding` looks up; NULL: none
    const struct sb_target *target;   // any: it is bound and nothing is drawn to it
    int floats;                       // a vertex
    bool gles;
};
// Runs the vertex shader once for each vertex of the meshes of all lit draws, in order, and
// fills `values` with what it hands on. Errors are left to sb_gl_error.
void sb_capture_draw(const struct sb_capture_params *params, float *values);
