// What the vertex shader hands on, caught by transform feedback.
#include <string.h>

#include "render/calls.h"
#include "render/render.h"
#include "render/shadow.h"

int64_t sb_capture_vertices(const struct sb_scene *scene)
{
    int64_t count = 0;
    for (int i = 0; i < scene->draw_count; i++)
        if (scene->draw[i].lamp < 0)
            count += scene->mesh[scene->draw[i].mesh].vertex_count;
    return count;
}

// Points, so that each vertex comes once, and in the order of the buffer.
static void draw_points(const struct sb_binding *binding, int64_t *calls)
{
    const struct sb_scene *scene = binding->upload->scene;
    GL(glBeginTransformFeedback(GL_POINTS));
    for (int i = 0; i < scene->draw_count; i++) {
        if (scene->draw[i].lamp >= 0)
            continue;
        sb_frame_place(binding, i, calls);
        GL(glDrawArrays(GL_POINTS, 0, scene->mesh[scene->draw[i].mesh].vertex_count));
    }
    GL(glEndTransformFeedback());
}

void sb_capture_draw(const struct sb_capture_params *params, float *values)
{
    const int64_t vertices = sb_capture_vertices(params->binding->upload->scene);
    const GLsizeiptr size =
        (GLsizeiptr)vertices * params->floats * (GLsizeiptr)sizeof *values;
    int64_t calls = 0;
    GLuint buffer;
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, size, NULL, GL_STREAM_READ);
    // Drawing wants a complete framebuffer, even where all is discarded.
    glBindFramebuffer(GL_FRAMEBUFFER, params->target->framebuffer);
    sb_frame_state(params->gles, &calls);
    if (params->shadow)
        sb_shadow_bind(params->shadow);
    sb_frame_bind(params->binding, &calls);
    glEnable(GL_RASTERIZER_DISCARD);
    draw_points(params->binding, &calls);
    glDisable(GL_RASTERIZER_DISCARD);
    const void *mapped =
        glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, size, GL_MAP_READ_BIT);
    if (mapped)
        memcpy(values, mapped, (size_t)size);
    glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glDeleteBuffers(1, &buffer);
}
