// Small GLSL for the tests of layers render and local, written from the contract in
// docs/glsl.md; light structs come out of the field tables.
#pragma once

#include "base/text.h"
#include "scene/lights.h"

static inline void add_version(struct sb_text *text, bool gles)
{
    sb_text_add(text, gles ? "#version 300 es\nprecision highp float;\n"
                             "precision highp int;\n"
                           : "#version 330 core\n");
}

// The whole vertex shader; v_world and v_normal go to the fragment shader.
static inline void add_vertex_shader(struct sb_text *text, bool gles)
{
    add_version(text, gles);
    sb_text_add(text, "in vec3 a_position;\n"
                      "in vec3 a_normal;\n"
                      "uniform mat4 u_model;\n"
                      "uniform mat3 u_normal_matrix;\n"
                      "uniform mat4 u_view_projection;\n"
                      "out vec3 v_world;\n"
                      "out vec3 v_normal;\n"
                      "void main()\n"
                      "{\n"
                      "    vec4 world = u_model * vec4(a_position, 1.0);\n"
                      "    v_world = world.xyz;\n"
                      "    v_normal = u_normal_matrix * a_normal;\n"
                      "    gl_Position = u_view_projection * world;\n"
                      "}\n");
}

// The structs, and counts[type] lights of each type as uniforms or as the block Lights.
static inline void add_lights(struct sb_text *text, const int counts[SB_LIGHT_TYPE_COUNT],
                              bool block)
{
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        sb_text_printf(text, "struct light%d {\n", type);
        for (int f = 0; f < row->field_count; f++)
            sb_text_printf(text, "    %s %s;\n",
                           row->field[f].components == 1 ? "float" : "vec3",
                           row->field[f].name);
        sb_text_add(text, "};\n");
    }
    if (block)
        sb_text_add(text, "layout(std140) uniform Lights {\n");
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        if (counts[type] > 0)
            sb_text_printf(text, "%s light%d %s[%d];\n", block ? "   " : "uniform", type,
                           sb_light_types[type].array, counts[type]);
    }
    if (block)
        sb_text_add(text, "};\n");
}
