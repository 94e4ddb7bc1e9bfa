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

enum light_storage { AS_UNIFORMS, AS_ARRAYS, AS_STD140, AS_SHARED, LIGHT_STORAGES };

struct light_text {                   // lights as a shader declares them
    int count[SB_LIGHT_STRUCT_COUNT]; // array sizes; 0: no array
    enum light_storage storage;
};

static inline const char *member_type(const struct sb_light_field *field)
{
    return field->components == 1 ? "float" : "vec3";
}

// "u_point[3].diffuse", or "u_point_diffuse[3]".
static inline void add_member(struct sb_text *text, const struct light_text *lights,
                              int number, int light, const struct sb_light_field *field)
{
    const char *array = sb_light_structs[number].array;
    if (lights->storage == AS_ARRAYS)
        sb_text_printf(text, "%s_%s[%d]", array, field->name, light);
    else
        sb_text_printf(text, "%s[%d].%s", array, light, field->name);
}

static inline void add_lights(struct sb_text *text, const struct light_text *lights)
{
    const bool arrays = lights->storage == AS_ARRAYS,
               block = lights->storage >= AS_STD140;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
        const struct sb_light_struct *row = &sb_light_structs[s];
        if (!arrays)
            sb_text_printf(text, "struct %s {\n", row->type);
        for (int f = 0; f < row->field_count; f++) {
            const struct sb_light_field *field = &row->field[f];
            if (!arrays)
                sb_text_printf(text, "    %s %s;\n", member_type(field), field->name);
            else if (lights->count[s] > 0)
                sb_text_printf(text, "uniform %s %s_%s[%d];\n", member_type(field),
                               row->array, field->name, lights->count[s]);
        }
        if (!arrays)
            sb_text_add(text, "};\n");
    }
    if (block)
        sb_text_printf(text, "layout(%s) uniform Lights {\n",
                       lights->storage == AS_STD140 ? "std140" : "shared");
    for (int s = 0; !arrays && s < SB_LIGHT_STRUCT_COUNT; s++) {
        if (lights->count[s] > 0)
            sb_text_printf(text, "%s%s %s[%d];\n", block ? "    " : "uniform ",
                           sb_light_structs[s].type, sb_light_structs[s].array,
                           lights->count[s]);
    }
    if (block)
        sb_text_add(text, "};\n");
}
