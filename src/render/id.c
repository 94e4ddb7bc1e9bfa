// Programs that tell which draw, and what of it, each pixel shows; and one that wipes out.
#include "render/render.h"

#define VERTEX                                                                           \
    "in vec3 a_position;\n"                                                              \
    "uniform mat4 u_model;\n"                                                            \
    "uniform mat4 u_view_projection;\n"                                                  \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    gl_Position = u_view_projection * (u_model * vec4(a_position, 1.0));\n"         \
    "}\n"
#define FRAGMENT                                                                         \
    "uniform uint u_draw;\n"                                                             \
    "layout(location = 0) out uint o_id;\n"                                              \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    o_id = u_draw;\n"                                                               \
    "}\n"
#define GEOMETRY_VERTEX                                                                  \
    "in vec3 a_position;\n"                                                              \
    "uniform mat4 u_model;\n"                                                            \
    "uniform mat4 u_view_projection;\n"                                                  \
    "flat out int v_triangle;\n"                                                         \
    "out vec2 v_weight;\n"                                                               \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    int corner = gl_VertexID % 3;\n"                                                \
    "    v_triangle = gl_VertexID / 3 + 1;\n"                                            \
    "    v_weight = vec2(corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0);\n"           \
    "    gl_Position = u_view_projection * (u_model * vec4(a_position, 1.0));\n"         \
    "}\n"
#define GEOMETRY_FRAGMENT                                                                \
    "uniform uint u_draw;\n"                                                             \
    "flat in int v_triangle;\n"                                                          \
    "in vec2 v_weight;\n"                                                                \
    "layout(location = 0) out uvec4 o_geometry;\n"                                       \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    o_geometry = floatBitsToUint(vec4(float(u_draw), float(v_triangle), "           \
    "v_weight));\n"                                                                      \
    "}\n"
#define BLANK_FRAGMENT                                                                   \
    "layout(location = 1) out vec4 o_1;\n"                                               \
    "layout(location = 2) out vec4 o_2;\n"                                               \
    "layout(location = 3) out vec4 o_3;\n"                                               \
    "void main()\n"                                                                      \
    "{\n"                                                                                \
    "    o_1 = o_2 = o_3 = vec4(0.0);\n"                                                 \
    "}\n"
#define DESKTOP "#version 330 core\n"
#define GLES    "#version 300 es\nprecision highp float;\nprecision highp int;\n"

static bool make(const struct sb_program *source, const char *what,
                 struct sb_gl_program *program, struct sb_error *err)
{
    if (sb_gl_program_make(source, program))
        return true;
    sb_fail(err, SB_GL_ERROR, "the program of the %s does not compile: %s", what,
            program->log ? program->log : "the driver gives no log");
    sb_gl_program_free(program);
    return false;
}

bool sb_id_program_make(struct sb_gl_program *program, bool gles, struct sb_error *err)
{
    const struct sb_program source = {
        .vertex = gles ? GLES VERTEX : DESKTOP VERTEX,
        .fragment = gles ? GLES FRAGMENT : DESKTOP FRAGMENT,
    };
    return make(&source, "id image", program, err);
}

bool sb_geometry_program_make(struct sb_gl_program *program, bool gles,
                              struct sb_error *err)
{
    const struct sb_program source = {
        .vertex = gles ? GLES GEOMETRY_VERTEX : DESKTOP GEOMETRY_VERTEX,
        .fragment = gles ? GLES GEOMETRY_FRAGMENT : DESKTOP GEOMETRY_FRAGMENT,
    };
    return make(&source, "geometry image", program, err);
}

bool sb_blank_program_make(struct sb_gl_program *program, bool gles, struct sb_error *err)
{
    const struct sb_program source = {
        .vertex = gles ? GLES VERTEX : DESKTOP VERTEX,
        .fragment = gles ? GLES BLANK_FRAGMENT : DESKTOP BLANK_FRAGMENT,
    };
    return make(&source, "lamps of a probe", program, err);
}
