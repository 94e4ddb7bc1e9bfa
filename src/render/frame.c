// One frame. It sets every piece of state that this program ever changes, and what drivers
// differ in by default, so that a variant is measured in the same state whatever was drawn
// before it.
#include "render/calls.h"
#include "render/render.h"
#include "render/shadow.h"

void sb_frame_state(bool gles, int64_t *calls)
{
    static const struct {
        GLenum capability;
        bool on, desktop_only;
    } state[] = {
        {GL_DEPTH_TEST, true, false},
        {GL_CULL_FACE, true, false},
        {GL_BLEND, false, false},
        {GL_DITHER, false, false}, // on by default
        {GL_SCISSOR_TEST, false, false},
        {GL_POLYGON_OFFSET_FILL, false, false},
        {GL_RASTERIZER_DISCARD, false, false},
        {GL_FRAMEBUFFER_SRGB, false, true}, // targets hold linear light
    };
    for (size_t i = 0; i < sizeof state / sizeof *state; i++) {
        if (state[i].desktop_only && gles)
            continue;
        if (state[i].on)
            GL(glEnable(state[i].capability));
        else
            GL(glDisable(state[i].capability));
    }
    // LEQUAL: with LESS only the first of several layers would be shaded.
    GL(glDepthFunc(GL_LEQUAL));
    GL(glDepthMask(GL_TRUE));
    GL(glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE));
    GL(glFrontFace(GL_CCW));
    GL(glCullFace(GL_BACK));
}

static void clear(const struct sb_target *target, const float *colour, int64_t *calls)
{
    static const GLuint background[4];
    static const GLfloat far = 1, nothing[4];
    if (target->format == SB_GL_R32UI || target->format == SB_GL_RGBA32UI)
        GL(glClearBufferuiv(GL_COLOR, 0, background));
    else
        GL(glClearBufferfv(GL_COLOR, 0, colour));
    for (int i = 1; i <= target->more_count; i++)
        GL(glClearBufferfv(GL_COLOR, i, nothing));
    GL(glClearBufferfv(GL_DEPTH, 0, &far));
}

void sb_frame_bind(const struct sb_binding *binding, int64_t *calls)
{
    GL(glUseProgram(binding->program));
    if (binding->shares_program && binding->lights.sets_uniforms)
        *calls += sb_light_upload_set(&binding->lights, &binding->now);
    if (binding->lights.buffer)
        GL(glBindBufferBase(GL_UNIFORM_BUFFER, 0, binding->lights.buffer));
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (binding->map[i] < 0)
            continue;
        GL(glActiveTexture(GL_TEXTURE0 + (GLenum)i));
        GL(glBindTexture(GL_TEXTURE_2D, binding->upload->map[i]));
    }
}

// Where some materials lack a map, each draw says which texture it is.
static void set_maps(const struct sb_binding *binding, const struct sb_material *material,
                     int64_t *calls)
{
    const struct sb_upload *upload = binding->upload;
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (binding->map[i] < 0 || !upload->neutral[i])
            continue;
        GL(glActiveTexture(GL_TEXTURE0 + (GLenum)i));
        GL(glBindTexture(GL_TEXTURE_2D,
                         material->lacks >> i & 1 ? upload->neutral[i] : upload->map[i]));
    }
}

static void set_material(const struct sb_binding *binding, int number, int64_t *calls)
{
    const struct sb_material *material = &binding->upload->scene->material[number];
    set_maps(binding, material, calls);
    if (binding->materials)
        GL(glBindBufferRange(GL_UNIFORM_BUFFER, 1, binding->materials,
                             number * binding->material_stride, binding->material_size));
    if (binding->ambient >= 0)
        GL(glUniform3fv(binding->ambient, 1, material->ambient));
    if (binding->diffuse >= 0)
        GL(glUniform3fv(binding->diffuse, 1, material->diffuse));
    if (binding->specular >= 0)
        GL(glUniform3fv(binding->specular, 1, material->specular));
    if (binding->shininess >= 0)
        GL(glUniform1f(binding->shininess, material->shininess));
}

// A lamp keeps the colour of its light also where that is uploaded black.
static void set_lamp(const struct sb_binding *binding, int number, int64_t *calls)
{
    int count;
    const struct sb_light *point =
        sb_lights_of(&binding->upload->scene->lights, SB_LIGHT_POINT, &count);
    if (binding->lamp_colour >= 0 && number >= 0 && number < count)
        GL(glUniform3fv(binding->lamp_colour, 1, point[number].diffuse));
}

void sb_frame_place(const struct sb_binding *binding, int number, int64_t *calls)
{
    const struct sb_scene *scene = binding->upload->scene;
    const struct sb_draw *it = &scene->draw[number];
    const float *normal_matrix = binding->normal_matrices
                                     ? &binding->normal_matrices[9 * number]
                                     : it->normal_matrix;
    if (binding->model >= 0)
        GL(glUniformMatrix4fv(binding->model, 1, GL_FALSE, it->model));
    if (binding->normal_matrix >= 0)
        GL(glUniformMatrix3fv(binding->normal_matrix, 1, GL_FALSE, normal_matrix));
    set_material(binding, it->material, calls);
    set_lamp(binding, it->lamp, calls);
    if (binding->draw_number >= 0)
        GL(glUniform1ui(binding->draw_number, (GLuint)number + 1));
    for (int i = 0; i < binding->draw_uniform_count; i++)
        GL(glUniform1i(binding->draw_uniform[i], binding->draw_uniform_value[i][number]));
    GL(glBindVertexArray(binding->upload->mesh[it->mesh].vertex_array));
}

static void draw(const struct sb_binding *binding, int number, int64_t *calls)
{
    const struct sb_scene *scene = binding->upload->scene;
    const struct sb_mesh *mesh = &scene->mesh[scene->draw[number].mesh];
    sb_frame_place(binding, number, calls);
    GL(glDrawElements(GL_TRIANGLES, mesh->index_count, GL_UNSIGNED_INT, NULL));
}

enum draws { ALL_DRAWS, LIT_DRAWS, LAMP_DRAWS };

// Number `place` of those that the binding lights.
static int draw_at(const struct sb_binding *binding, int place)
{
    return binding->draw ? binding->draw[place] : place;
}

static void draw_layer(const struct sb_binding *binding, enum draws which, int64_t *calls)
{
    const struct sb_scene *scene = binding->upload->scene;
    const int count = binding->draw ? binding->draw_count : scene->draw_count;
    for (int i = 0; i < count; i++) {
        const int number = draw_at(binding, i);
        const enum draws kind = scene->draw[number].lamp >= 0 ? LAMP_DRAWS : LIT_DRAWS;
        if (which == ALL_DRAWS || which == kind)
            draw(binding, number, calls);
    }
}

static void draw_all(const struct sb_binding *binding, int binding_count,
                     enum draws which, int layers, int64_t *calls)
{
    if (binding_count <= 1)
        sb_frame_bind(binding, calls);
    for (int layer = 0; layer < layers; layer++) {
        for (int i = 0; i < binding_count || i == 0; i++) {
            if (binding_count > 1)
                sb_frame_bind(&binding[i], calls);
            draw_layer(&binding[i], which, calls);
        }
    }
}

// Draws go to the first attachment only, or to all but the first one.
static void choose_attachments(const struct sb_target *target, bool first, bool more,
                               int64_t *calls)
{
    GLenum buffers[1 + SB_TARGET_MORE];
    for (int i = 0; i <= target->more_count; i++)
        buffers[i] = (i == 0 ? first : more) ? GL_COLOR_ATTACHMENT0 + (GLenum)i : GL_NONE;
    GL(glDrawBuffers(1 + target->more_count, buffers));
}

// The program of lamps has one output. What the lit draws behind a lamp have left in the other
// attachments is wiped out by drawing it again: LEQUAL lets the same depth pass.
static void draw_lamps(const struct sb_frame_params *params, int64_t *calls)
{
    const struct sb_target *target = params->target;
    if (target->more_count == 0) {
        draw_all(params->lamp, 1, LAMP_DRAWS, params->layers, calls);
        return;
    }
    choose_attachments(target, true, false, calls);
    draw_all(params->lamp, 1, LAMP_DRAWS, params->layers, calls);
    choose_attachments(target, false, true, calls);
    draw_all(params->blank, 1, LAMP_DRAWS, params->layers, calls);
    choose_attachments(target, true, true, calls);
}

static void draw_picture(const struct sb_frame_params *params, int64_t *calls)
{
    const struct sb_binding *binding = params->binding;
    const struct sb_target *target = params->target;
    GL(glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer));
    GL(glViewport(0, 0, target->width, target->height));
    sb_frame_state(params->gles, calls);
    if (params->pixel) {
        GL(glEnable(GL_SCISSOR_TEST));
        GL(glScissor(params->pixel[0], params->pixel[1], 1, 1));
    }
    clear(target, binding->upload->scene->clear_colour, calls);
    if (params->unused_shadow)
        *calls += sb_shadow_bind(params->unused_shadow);
    if (params->shadow)
        *calls += sb_shadow_bind(params->shadow);
    draw_all(binding, params->binding_count, params->lamp ? LIT_DRAWS : ALL_DRAWS,
             params->layers, calls);
    if (params->lamp)
        draw_lamps(params, calls);
    *calls += sb_target_resolve(target);
}

int64_t sb_frame_draw(const struct sb_frame_params *params)
{
    int64_t calls = 0;
    for (int i = 0; params->phase >= 0 && (i < params->binding_count || i == 0); i++)
        calls += sb_binding_phase(&params->binding[i], params->phase);
    if (params->shadow && params->phase >= 0 && params->shadow->phase_count > 1)
        calls += sb_shadow_draw(params->shadow, &params->shadow->phase[params->phase]);
    if (!params->shadows_only)
        draw_picture(params, &calls);
    return calls;
}

void sb_frame_end_shadows(const struct sb_target *target)
{
    static const float black[4];
    int64_t calls = 0;
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    clear(target, black, &calls);
    sb_target_resolve(target);
}
