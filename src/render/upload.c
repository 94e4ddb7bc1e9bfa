// A scene on the GPU: one vertex array a mesh, one texture a map.
#include "render/render.h"

#include <stddef.h>
#include <stdlib.h>

#include "base/mem.h"

static void mesh_make(struct sb_gpu_mesh *gpu, const struct sb_mesh *mesh)
{
    static const struct {
        int components;
        size_t offset;
    } attribute[SB_ATTRIBUTES] = {
        {3, offsetof(struct sb_vertex, position)},
        {3, offsetof(struct sb_vertex, normal)},
        {2, offsetof(struct sb_vertex, uv)},
        {4, offsetof(struct sb_vertex, tangent)},
    };
    glGenVertexArrays(1, &gpu->vertex_array);
    glBindVertexArray(gpu->vertex_array);

    glGenBuffers(1, &gpu->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, gpu->vertices);
    glBufferData(GL_ARRAY_BUFFER,
                 (GLsizeiptr)((size_t)mesh->vertex_count * sizeof *mesh->vertex),
                 mesh->vertex, GL_STATIC_DRAW);
    for (GLuint i = 0; i < SB_ATTRIBUTES; i++) {
        glVertexAttribPointer(i, attribute[i].components, GL_FLOAT, GL_FALSE,
                              sizeof(struct sb_vertex),
                              (const void *)attribute[i].offset);
        glEnableVertexAttribArray(i);
    }

    glGenBuffers(1, &gpu->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 (GLsizeiptr)((size_t)mesh->index_count * sizeof *mesh->index),
                 mesh->index, GL_STATIC_DRAW);
    glBindVertexArray(0);
}

static GLuint map_make(const struct sb_texture *texture)
{
    GLuint name;
    glGenTextures(1, &name);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texture->width, texture->height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, texture->texel);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return name;
}

// White, or the flat normal, which robust decoding takes exactly (shaders/maps/n.glsl).
static GLuint neutral_make(enum sb_map map)
{
    static const unsigned char white[4] = {255, 255, 255, 255},
                               flat[4] = {128, 128, 255, 255};
    const struct sb_texture texel = {1, 1, map == SB_MAP_NORMAL ? flat : white};
    return map_make(&texel);
}

static bool is_lacked(const struct sb_scene *scene, int map)
{
    for (int i = 0; i < scene->material_count; i++)
        if (scene->material[i].lacks >> map & 1)
            return true;
    return false;
}

void sb_upload_make(struct sb_upload *upload, const struct sb_scene *scene)
{
    *upload = (struct sb_upload){.scene = scene};
    upload->mesh = sb_alloc((size_t)scene->mesh_count * sizeof *upload->mesh);
    for (int i = 0; i < scene->mesh_count; i++)
        mesh_make(&upload->mesh[i], &scene->mesh[i]);
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (scene->map[i].texel)
            upload->map[i] = map_make(&scene->map[i]);
        if (scene->map[i].texel && is_lacked(scene, i))
            upload->neutral[i] = neutral_make((enum sb_map)i);
    }
}

void sb_upload_make_triangles(struct sb_upload *upload, const struct sb_scene *scene)
{
    *upload = (struct sb_upload){.scene = scene};
    upload->mesh = sb_alloc((size_t)scene->mesh_count * sizeof *upload->mesh);
    for (int i = 0; i < scene->mesh_count; i++) {
        const struct sb_mesh *mesh = &scene->mesh[i];
        const size_t count = (size_t)mesh->index_count;
        struct sb_vertex *vertex = sb_alloc(count * sizeof *vertex);
        uint32_t *index = sb_alloc(count * sizeof *index);
        for (size_t k = 0; k < count; k++) {
            vertex[k] = mesh->vertex[mesh->index[k]];
            index[k] = (uint32_t)k;
        }
        const struct sb_mesh triangles = {.vertex = vertex,
                                          .index = index,
                                          .vertex_count = mesh->index_count,
                                          .index_count = mesh->index_count};
        mesh_make(&upload->mesh[i], &triangles);
        free(vertex);
        free(index);
    }
}

void sb_upload_free(struct sb_upload *upload)
{
    for (int i = 0; upload->mesh && i < upload->scene->mesh_count; i++) {
        const struct sb_gpu_mesh *mesh = &upload->mesh[i];
        glDeleteVertexArrays(1, &mesh->vertex_array);
        glDeleteBuffers(1, &mesh->vertices);
        glDeleteBuffers(1, &mesh->indices);
    }
    glDeleteTextures(SB_MAP_COUNT, upload->map);
    glDeleteTextures(SB_MAP_COUNT, upload->neutral);
    free(upload->mesh);
    *upload = (struct sb_upload){0};
}
