// The passes that draw shadow maps: the scene as each of the lights sees it.
#include "render/calls.h"
#include "render/shadow.h"

#include "math/mat.h"

// clang-format off
static const struct sb_face text_faces[SB_FACES] = {
    {{ 1,  0,  0}, { 0, 1, 0}},
    {{-1,  0,  0}, { 0, 1, 0}},
    {{ 0,  1,  0}, { 1, 0, 0}},
    {{ 0, -1,  0}, {-1, 0, 0}},
    {{ 0,  0,  1}, { 0, 1, 0}},
    {{ 0,  0, -1}, { 0, 1, 0}},
};

// s and t of table 8.19 grow to the right and upwards in the pictures of these cameras.
static const struct sb_face cube_faces[SB_FACES] = {
    {{ 1,  0,  0}, {0, -1,  0}},
    {{-1,  0,  0}, {0, -1,  0}},
    {{ 0,  1,  0}, {0,  0,  1}},
    {{ 0, -1,  0}, {0,  0, -1}},
    {{ 0,  0,  1}, {0, -1,  0}},
    {{ 0,  0, -1}, {0, -1,  0}},
};
// clang-format on

const struct sb_face *sb_shadow_faces(int kind)
{
    return kind == SB_SHADOW_MAP_SIX2D || kind == SB_SHADOW_MAP_ARRAY2D ? text_faces
                                                                        : cube_faces;
}

// World to clip, in double.
static void face_matrix(const struct sb_light *light, const struct sb_face *face,
                        float *out)
{
    const struct sb_vec3 eye = {light->position[0], light->position[1],
                                light->position[2]};
    const double far = light->range, near = far / SB_SHADOW_NEAR;
    const struct sb_mat4 matrix =
        sb_mat4_multiply(sb_mat4_perspective(SB_PI / 2, 1, near, far),
                         sb_mat4_look_at(eye, sb_vec3_add(eye, face->forward), face->up));
    for (int i = 0; i < 16; i++)
        out[i] = (float)matrix.m[i];
}

static void clear(const struct sb_shadow *shadow, int framebuffer, int64_t *calls)
{
    static const GLfloat nothing[4], far = 1;
    GL(glBindFramebuffer(GL_FRAMEBUFFER, shadow->framebuffer[framebuffer]));
    if (shadow->store != SB_SHADOW_STORE_DEPTH)
        GL(glClearBufferfv(GL_COLOR, 0, nothing));
    GL(glClearBufferfv(GL_DEPTH, 0, &far));
}

static void draw_scene(const struct sb_shadow *shadow, int64_t *calls)
{
    const struct sb_scene *scene = shadow->upload->scene;
    for (int i = 0; i < scene->draw_count; i++) {
        const struct sb_draw *it = &scene->draw[i];
        if (it->lamp >= 0)
            continue;
        GL(glUniformMatrix4fv(shadow->model, 1, GL_FALSE, it->model));
        GL(glBindVertexArray(shadow->upload->mesh[it->mesh].vertex_array));
        GL(glDrawElements(GL_TRIANGLES, scene->mesh[it->mesh].index_count,
                          GL_UNSIGNED_INT, NULL));
    }
}

static void draw_caster(const struct sb_shadow *shadow, const struct sb_light *light,
                        int caster, int64_t *calls)
{
    const struct sb_face *faces = sb_shadow_faces(shadow->kind);
    const bool one_texture = shadow->texture_count == 1;
    float matrix[SB_FACES][16];
    for (int face = 0; face < SB_FACES; face++)
        face_matrix(light, &faces[face], matrix[face]);
    if (shadow->light_position >= 0)
        GL(glUniform3fv(shadow->light_position, 1, light->position));
    if (shadow->light_range >= 0)
        GL(glUniform1f(shadow->light_range, light->range));
    if (shadow->layered) {
        // Clearing clears all layers, and so all casters where they share a texture.
        if (caster == 0 || !one_texture)
            clear(shadow, caster, calls);
        if (shadow->first_layer >= 0)
            GL(glUniform1i(shadow->first_layer, one_texture ? SB_FACES * caster : 0));
        GL(glUniformMatrix4fv(shadow->face, SB_FACES, GL_FALSE, matrix[0]));
        draw_scene(shadow, calls);
        return;
    }
    for (int face = 0; face < SB_FACES; face++) {
        clear(shadow, SB_FACES * caster + face, calls);
        GL(glUniformMatrix4fv(shadow->face, 1, GL_FALSE, matrix[face]));
        draw_scene(shadow, calls);
    }
}

int64_t sb_shadow_draw(const struct sb_shadow *shadow, const struct sb_lights *lights)
{
    int64_t count = 0, *const calls = &count;
    int points;
    const struct sb_light *point = sb_lights_of(lights, SB_LIGHT_POINT, &points);
    sb_frame_state(shadow->gles, calls);
    GL(glDisable(GL_CULL_FACE)); // open surfaces cast shadows too
    GL(glViewport(0, 0, shadow->size, shadow->size));
    GL(glUseProgram(shadow->program));
    for (int i = 0; i < shadow->casters; i++)
        draw_caster(shadow, &point[i], i, calls);
    return count;
}

int64_t sb_shadow_vertices(const struct sb_shadow *shadow)
{
    const struct sb_scene *scene = shadow->upload->scene;
    int64_t vertices = 0;
    for (int i = 0; i < scene->draw_count; i++)
        if (scene->draw[i].lamp < 0)
            vertices += scene->mesh[scene->draw[i].mesh].index_count;
    return vertices * shadow->casters * (shadow->layered ? 1 : SB_FACES);
}
