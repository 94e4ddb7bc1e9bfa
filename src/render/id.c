// The program behind the id image: which draw each pixel shows, and how many are covered.
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
#define DESKTOP "#version 330 core\n"
#define GLES    "#version 300 es\nprecision highp float;\nprecision highp int;\n"

bool sb_id_program_make(struct sb_gl_program *program, bool gles, struct sb_error *err)
{
    const struct sb_program source = {
        .vertex = gles ? GLES VERTEX : DESKTOP VERTEX,
        .fragment = gles ? GLES FRAGMENT : DESKTOP FRAGMENT,
    };
    if (sb_gl_program_make(&source, program))
        return true;
    return sb_fail(err, SB_GL_ERROR, "the program of the id image does not compile: %s",
                   program->log ? program->log : "the driver gives no log");
}
