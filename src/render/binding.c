// A program bound to a scene: where its uniforms are, and those that stay for all frames.
#include "render/render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static const char *const map_names[SB_MAP_COUNT] = {
    [SB_MAP_DIFFUSE] = "u_diffuse_map",
    [SB_MAP_SPECULAR] = "u_specular_map",
    [SB_MAP_NORMAL] = "u_normal_map",
};

// Offsets are asked for rather than computed from the C structs: that is right for every
// block layout and for a block with fewer lights than the scene has.
static struct sb_light_slot find_slot(GLuint program, GLuint block, const char *name)
{
    struct sb_light_slot slot = {glGetUniformLocation(program, name), -1};
    if (slot.location >= 0 || block == GL_INVALID_INDEX)
        return slot;
    GLuint index;
    glGetUniformIndices(program, 1, &name, &index);
    if (index != GL_INVALID_INDEX)
        glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &slot.offset);
    return slot;
}

static void find_lights(struct sb_binding *binding)
{
    const GLuint program = binding->program;
    const struct sb_lights *lights = &binding->upload->scene->lights;
    const GLuint block = glGetUniformBlockIndex(program, "Lights");
    if (block != GL_INVALID_INDEX) {
        glUniformBlockBinding(program, block, 0);
        glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_DATA_SIZE,
                                  &binding->block_size);
        binding->block = sb_alloc((size_t)binding->block_size);
        glGenBuffers(1, &binding->buffer);
        glBindBuffer(GL_UNIFORM_BUFFER, binding->buffer);
        glBufferData(GL_UNIFORM_BUFFER, binding->block_size, binding->block,
                     GL_STATIC_DRAW);
    }

    size_t slots = 0;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        int count;
        sb_lights_of(lights, type, &count);
        slots += (size_t)count * (size_t)sb_light_types[type].field_count;
    }
    binding->slot = sb_alloc(slots * sizeof *binding->slot);
    struct sb_light_slot *slot = binding->slot;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        int count;
        sb_lights_of(lights, type, &count);
        for (int i = 0; i < count; i++) {
            for (int f = 0; f < row->field_count; f++) {
                char name[96];
                snprintf(name, sizeof name, "%s[%d].%s", row->array, i,
                         row->field[f].name);
                *slot++ = find_slot(program, block, name);
            }
        }
    }
}

bool sb_binding_make(struct sb_binding *binding, GLuint program,
                     const struct sb_upload *upload, struct sb_error *err)
{
    const struct sb_scene *scene = upload->scene;
    *binding = (struct sb_binding){
        .upload = upload,
        .program = program,
        .model = glGetUniformLocation(program, "u_model"),
        .normal_matrix = glGetUniformLocation(program, "u_normal_matrix"),
        .ambient = glGetUniformLocation(program, "u_material.ambient"),
        .diffuse = glGetUniformLocation(program, "u_material.diffuse"),
        .specular = glGetUniformLocation(program, "u_material.specular"),
        .shininess = glGetUniformLocation(program, "u_material.shininess"),
        .draw = glGetUniformLocation(program, "u_draw"),
    };
    glUseProgram(program);
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        binding->map[i] = glGetUniformLocation(program, map_names[i]);
        // An unbound sampler would read black without a word.
        if (binding->map[i] >= 0 && !upload->map[i])
            return sb_fail(err, SB_BAD_INPUT,
                           "the program samples %s, which scene %s does not have",
                           map_names[i], scene->name);
        if (binding->map[i] >= 0)
            glUniform1i(binding->map[i], i);
    }
    const GLint view_projection = glGetUniformLocation(program, "u_view_projection");
    const GLint eye = glGetUniformLocation(program, "u_camera_position");
    const GLint ambient = glGetUniformLocation(program, "u_scene_ambient");
    if (view_projection >= 0)
        glUniformMatrix4fv(view_projection, 1, GL_FALSE, scene->camera.view_projection);
    if (eye >= 0)
        glUniform3fv(eye, 1, scene->camera.eye);
    if (ambient >= 0)
        glUniform3fv(ambient, 1, scene->ambient);

    find_lights(binding);
    sb_binding_lights(binding, 0, 0);
    return true;
}

void sb_binding_free(struct sb_binding *binding)
{
    glUseProgram(0); // a program in use outlives its deletion
    glDeleteBuffers(1, &binding->buffer);
    free(binding->slot);
    free(binding->block);
    *binding = (struct sb_binding){0};
}

static bool is_colour(const struct sb_light_field *field)
{
    return strcmp(field->name, "ambient") == 0 || strcmp(field->name, "diffuse") == 0 ||
           strcmp(field->name, "specular") == 0;
}

static void set_field(struct sb_binding *binding, const struct sb_light_slot *slot,
                      const float *value, int components)
{
    if (slot->offset >= 0)
        memcpy(binding->block + slot->offset, value, (size_t)components * sizeof *value);
    else if (slot->location >= 0 && components == 1)
        glUniform1fv(slot->location, 1, value);
    else if (slot->location >= 0)
        glUniform3fv(slot->location, 1, value);
}

void sb_binding_lights(struct sb_binding *binding, int off_first, int off_count)
{
    static const float black[3];
    const struct sb_light_slot *slot = binding->slot;
    int place = 0; // in the whole list
    glUseProgram(binding->program);
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        int count;
        const char *light = sb_lights_of(&binding->upload->scene->lights, type, &count);
        for (int i = 0; i < count; i++, place++, light += row->size) {
            const bool off = place >= off_first && place - off_first < off_count;
            for (int f = 0; f < row->field_count; f++) {
                const struct sb_light_field *field = &row->field[f];
                const float *value = (const void *)(light + field->offset);
                set_field(binding, slot++, off && is_colour(field) ? black : value,
                          field->components);
            }
        }
    }
    if (binding->buffer) {
        glBindBuffer(GL_UNIFORM_BUFFER, binding->buffer);
        glBufferSubData(GL_UNIFORM_BUFFER, 0, binding->block_size, binding->block);
    }
}
