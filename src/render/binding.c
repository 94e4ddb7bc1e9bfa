// A program bound to a scene: where its uniforms are, and those that stay for all frames.
#include "render/shadow.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "math/mat.h"

// --- materials in a block --------------------------------------------------------------

static const struct {
    const char *name;
    size_t source; // in struct sb_material
    size_t size;
} material_fields[] = {
    {"u_material.ambient", offsetof(struct sb_material, ambient), 3 * sizeof(float)},
    {"u_material.diffuse", offsetof(struct sb_material, diffuse), 3 * sizeof(float)},
    {"u_material.specular", offsetof(struct sb_material, specular), 3 * sizeof(float)},
    {"u_material.shininess", offsetof(struct sb_material, shininess), sizeof(float)},
};
enum { MATERIAL_FIELDS = sizeof material_fields / sizeof *material_fields };

// One buffer with a range for each material, so that a draw only says which range it takes.
static void make_materials(struct sb_binding *binding)
{
    const GLuint program = binding->program;
    const struct sb_scene *scene = binding->upload->scene;
    const GLuint block = glGetUniformBlockIndex(program, "MaterialBlock");
    if (block == GL_INVALID_INDEX)
        return;
    GLint size = 0, alignment = 1;
    glUniformBlockBinding(program, block, 1);
    glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    binding->material_size = size;
    binding->material_stride = (size + alignment - 1) / alignment * alignment;

    const size_t total = (size_t)binding->material_stride * (size_t)scene->material_count;
    unsigned char *ranges = sb_alloc(total);
    for (int f = 0; f < MATERIAL_FIELDS; f++) {
        GLuint index;
        GLint offset = -1;
        glGetUniformIndices(program, 1, &material_fields[f].name, &index);
        if (index != GL_INVALID_INDEX)
            glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
        for (int i = 0; offset >= 0 && i < scene->material_count; i++)
            memcpy(ranges + i * binding->material_stride + offset,
                   (const char *)&scene->material[i] + material_fields[f].source,
                   material_fields[f].size);
    }
    glGenBuffers(1, &binding->materials);
    glBindBuffer(GL_UNIFORM_BUFFER, binding->materials);
    glBufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)total, ranges, GL_STATIC_DRAW);
    free(ranges);
}

// --- the camera ------------------------------------------------------------------------

// The view matrix is a turn and a move, so its inverse is the turn back, and the eye.
static void set_camera(const struct sb_binding *binding)
{
    const struct sb_camera *camera = &binding->upload->scene->camera;
    float rotation[9], inverse[16] = {[15] = 1};
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++) {
            rotation[3 * column + row] = camera->view[4 * column + row];
            inverse[4 * row + column] = camera->view[4 * column + row];
        }
    }
    memcpy(&inverse[12], camera->eye, sizeof camera->eye);
    const struct {
        const char *name;
        const float *value;
    } matrices[] = {
        {"u_view_projection", camera->view_projection},
        {"u_view", camera->view},
        {"u_view_inverse", inverse},
    };
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; i++) {
        const GLint location = glGetUniformLocation(binding->program, matrices[i].name);
        if (location >= 0)
            glUniformMatrix4fv(location, 1, GL_FALSE, matrices[i].value);
    }
    const GLint turn = glGetUniformLocation(binding->program, "u_view_rotation");
    const GLint eye = glGetUniformLocation(binding->program, "u_camera_position");
    if (turn >= 0)
        glUniformMatrix3fv(turn, 1, GL_FALSE, rotation);
    if (eye >= 0)
        glUniform3fv(eye, 1, camera->eye);
}

// space=view: object to view, in double.
static void make_normal_matrices(struct sb_binding *binding)
{
    const struct sb_scene *scene = binding->upload->scene;
    binding->normal_matrices =
        sb_alloc((size_t)scene->draw_count * 9 * sizeof *binding->normal_matrices);
    for (int i = 0; i < scene->draw_count; i++) {
        for (int at = 0; at < 9; at++) {
            const int column = at / 3, row = at % 3;
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += (double)scene->camera.view[4 * k + row] *
                       scene->draw[i].normal_matrix[3 * column + k];
            binding->normal_matrices[9 * i + at] = (float)sum;
        }
    }
}

// --- lights ----------------------------------------------------------------------------

struct sb_phase sb_phase_of(const struct sb_variant *variant, int number)
{
    const bool casters_stand = variant->value[SB_AXIS_UPDATE] != SB_UPDATE_SHADOWS;
    return (struct sb_phase){
        .number = number,
        .still_points = casters_stand ? sb_shadow_casters(variant) : 0,
        .scale = variant->value[SB_AXIS_SCALE],
    };
}

// The lights of the whole list that the binding has.
static void choose_lights(struct sb_binding *binding,
                          const struct sb_binding_params *params)
{
    const struct sb_lights *all = &binding->upload->scene->lights;
    struct sb_lights *chosen = &binding->phase[0];
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        chosen->count[type] =
            params->light_count ? params->light_count[type] : all->count[type];
    const int total = sb_lights_total(chosen);
    binding->number = sb_alloc(((size_t)total + 1) * sizeof *binding->number);
    for (int i = 0; i < total; i++)
        binding->number[i] = params->light_count ? params->light[i] : i;
}

static void make_phases(struct sb_binding *binding,
                        const struct sb_binding_params *params)
{
    const struct sb_variant *variant = params->variant;
    const struct sb_scene *scene = binding->upload->scene;
    const size_t all = (size_t)sb_lights_total(&scene->lights);
    const size_t total = (size_t)sb_lights_total(&binding->phase[0]);
    const bool moves = variant->value[SB_AXIS_UPDATE] != SB_UPDATE_STATIC;
    struct sb_light *moved = sb_alloc((all + 1) * sizeof *moved);
    binding->phase_count = moves ? SB_PHASES : 1;
    binding->as_lit =
        sb_alloc(((size_t)binding->phase_count * total + 1) * sizeof *binding->as_lit);
    binding->now_light = sb_alloc((total + 1) * sizeof *binding->now_light);
    binding->now = binding->phase[0];
    binding->now.light = binding->now_light;
    struct sb_light *light = binding->as_lit;
    for (int i = 0; i < binding->phase_count; i++) {
        const struct sb_phase phase = sb_phase_of(variant, i);
        const int *number = binding->number;
        binding->phase[i] = binding->phase[0];
        binding->phase[i].light = light;
        sb_lights_phase(&scene->lights, &phase, moved);
        for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
            for (int n = 0; n < binding->phase[i].count[type]; n++, light++)
                *light =
                    sb_light_as_lit(&moved[*number++], type, variant, &scene->camera);
        }
    }
    free(moved);
}

void sb_binding_lights(const struct sb_binding *binding, int off_first, int off_count)
{
    const struct sb_lights *lights = &binding->phase[0];
    for (int i = 0; i < sb_lights_total(lights); i++) {
        struct sb_light *now = &binding->now_light[i];
        *now = lights->light[i];
        if (binding->number[i] < off_first || binding->number[i] - off_first >= off_count)
            continue;
        memset(now->ambient, 0, sizeof now->ambient);
        memset(now->diffuse, 0, sizeof now->diffuse);
        memset(now->specular, 0, sizeof now->specular);
    }
    sb_light_upload_set(&binding->lights, &binding->now);
}

int64_t sb_binding_phase(const struct sb_binding *binding, int phase)
{
    const struct sb_lights *lights = &binding->phase[phase];
    if (!binding->shares_program || !binding->lights.sets_uniforms)
        return sb_light_upload_set(&binding->lights, lights);
    memcpy(binding->now_light, lights->light,
           (size_t)sb_lights_total(lights) * sizeof *lights->light);
    return 0; // when it is bound
}

// --- all of it -------------------------------------------------------------------------

static bool set_maps(struct sb_binding *binding, struct sb_error *err)
{
    static const char *const names[SB_MAP_COUNT] = {
        [SB_MAP_DIFFUSE] = "u_diffuse_map",
        [SB_MAP_SPECULAR] = "u_specular_map",
        [SB_MAP_NORMAL] = "u_normal_map",
    };
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        binding->map[i] = glGetUniformLocation(binding->program, names[i]);
        // An unbound sampler would read black without a word.
        if (binding->map[i] >= 0 && !binding->upload->map[i])
            return sb_fail(err, SB_BAD_INPUT,
                           "the program samples %s, which scene %s does not have",
                           names[i], binding->upload->scene->name);
        if (binding->map[i] >= 0)
            glUniform1i(binding->map[i], i);
    }
    return true;
}

static void find_draw_uniforms(struct sb_binding *binding,
                               const struct sb_binding_params *params)
{
    for (int i = 0; i < params->draw_uniform_count; i++) {
        const struct sb_draw_uniform *it = &params->draw_uniform[i];
        const GLint location = glGetUniformLocation(binding->program, it->name);
        if (location < 0)
            continue;
        binding->draw_uniform[binding->draw_uniform_count] = location;
        binding->draw_uniform_value[binding->draw_uniform_count++] = it->value;
    }
}

bool sb_binding_make(struct sb_binding *binding, const struct sb_binding_params *params,
                     struct sb_error *err)
{
    const GLuint program = params->program;
    const struct sb_scene *scene = params->upload->scene;
    *binding = (struct sb_binding){
        .upload = params->upload,
        .program = program,
        .draw = params->draw,
        .draw_count = params->draw_count,
        .shares_program = params->shares_program,
        .model = glGetUniformLocation(program, "u_model"),
        .normal_matrix = glGetUniformLocation(program, "u_normal_matrix"),
        .ambient = glGetUniformLocation(program, "u_material.ambient"),
        .diffuse = glGetUniformLocation(program, "u_material.diffuse"),
        .specular = glGetUniformLocation(program, "u_material.specular"),
        .shininess = glGetUniformLocation(program, "u_material.shininess"),
        .draw_number = glGetUniformLocation(program, "u_draw"),
        .lamp_colour = glGetUniformLocation(program, "u_lamp_colour"),
    };
    glUseProgram(program);
    if (!set_maps(binding, err))
        return false;
    set_camera(binding);
    const GLint ambient = glGetUniformLocation(program, "u_scene_ambient");
    if (ambient >= 0)
        glUniform3fv(ambient, 1, scene->ambient);
    if (params->variant->value[SB_AXIS_SPACE] == SB_SPACE_VIEW)
        make_normal_matrices(binding);
    make_materials(binding);

    find_draw_uniforms(binding, params);
    choose_lights(binding, params);
    sb_light_upload_make(&binding->lights, program, params->variant, &binding->phase[0]);
    make_phases(binding, params);
    sb_binding_lights(binding, 0, 0);
    return true;
}

void sb_binding_free(struct sb_binding *binding)
{
    glUseProgram(0); // a program in use outlives its deletion
    sb_light_upload_free(&binding->lights);
    glDeleteBuffers(1, &binding->materials);
    free(binding->normal_matrices);
    free(binding->number);
    free(binding->as_lit);
    free(binding->now_light);
    *binding = (struct sb_binding){0};
}
