// One frame. It sets every piece of state that this program ever changes, and what drivers
// differ in by default, so that a variant is measured in the same state whatever was drawn
// before it.
#include "render/render.h"

// Counts the calls where they are made, so that the number cannot drift from the code.
#define GL(call) (++*calls, (call))

static void set_state(bool gles, int64_t *calls)
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
    static const GLfloat far = 1;
    if (target->format == SB_GL_R32UI)
        GL(glClearBufferuiv(GL_COLOR, 0, background));
    else
        GL(glClearBufferfv(GL_COLOR, 0, colour));
    GL(glClearBufferfv(GL_DEPTH, 0, &far));
}

static void bind(const struct sb_binding *binding, int64_t *calls)
{
    GL(glUseProgram(binding->program));
    if (binding->buffer)
        GL(glBindBufferBase(GL_UNIFORM_BUFFER, 0, binding->buffer));
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (binding->map[i] < 0)
            continue;
        GL(glActiveTexture(GL_TEXTURE0 + (GLenum)i));
        GL(glBindTexture(GL_TEXTURE_2D, binding->upload->map[i]));
    }
}

static void draw(const struct sb_binding *binding, int number, int64_t *calls)
{
    const struct sb_scene *scene = binding->upload->scene;
    const struct sb_draw *it = &scene->draw[number];
    const struct sb_material *material = &scene->material[it->material];
    if (binding->model >= 0)
        GL(glUniformMatrix4fv(binding->model, 1, GL_FALSE, it->model));
    if (binding->normal_matrix >= 0)
        GL(glUniformMatrix3fv(binding->normal_matrix, 1, GL_FALSE, it->normal_matrix));
    if (binding->ambient >= 0)
        GL(glUniform3fv(binding->ambient, 1, material->ambient));
    if (binding->diffuse >= 0)
        GL(glUniform3fv(binding->diffuse, 1, material->diffuse));
    if (binding->specular >= 0)
        GL(glUniform3fv(binding->specular, 1, material->specular));
    if (binding->shininess >= 0)
        GL(glUniform1f(binding->shininess, material->shininess));
    if (binding->draw >= 0)
        GL(glUniform1ui(binding->draw, (GLuint)number + 1));
    GL(glBindVertexArray(binding->upload->mesh[it->mesh].vertex_array));
    GL(glDrawElements(GL_TRIANGLES, scene->mesh[it->mesh].index_count, GL_UNSIGNED_INT,
                      NULL));
}

int64_t sb_frame_draw(const struct sb_frame_params *params)
{
    const struct sb_target *target = params->target;
    const struct sb_scene *scene = params->binding->upload->scene;
    int64_t count = 0, *const calls = &count;
    GL(glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer));
    GL(glViewport(0, 0, target->width, target->height));
    set_state(params->gles, calls);
    clear(target, scene->clear_colour, calls);
    bind(params->binding, calls);
    for (int layer = 0; layer < params->layers; layer++) {
        for (int i = 0; i < scene->draw_count; i++)
            draw(params->binding, i, calls);
    }
    return count;
}
