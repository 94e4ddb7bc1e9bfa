// Scenes of a few triangles, and what a ray through a pixel meets: in world space and long
// double, by other formulas than the reference's own.
#pragma once

#include "test.h"

#include "math/random.h"
#include "reference/geometry.h"
#include "scene/make.h"

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static inline double between(struct sb_random *random, double low, double high)
{
    return low + (high - low) * sb_random_unit(random);
}

// --- scenes ----------------------------------------------------------------------------

static inline void look_from(struct sb_scene *scene, struct sb_vec3 eye,
                             struct sb_vec3 target)
{
    const struct sb_placement place = {.scale = 1, .aspect = 1};
    scene->camera = sb_camera_make(
        &place, &(struct sb_camera_params){
                    .eye = eye, .target = target, .fov = 1, .near = 0.1, .far = 50});
}

// One draw a mesh, all models the identity.
static inline struct sb_scene scene_of(const struct sb_mesh *mesh, int count)
{
    struct sb_scene scene = {.mesh_count = count, .draw_count = count};
    struct sb_mesh *own = sb_arena_alloc(&scene.arena, (size_t)count * sizeof *own);
    struct sb_draw *draw = sb_arena_alloc(&scene.arena, (size_t)count * sizeof *draw);
    memcpy(own, mesh, (size_t)count * sizeof *own);
    for (int i = 0; i < count; i++) {
        draw[i] = (struct sb_draw){.mesh = i, .lamp = -1};
        memcpy(draw[i].model, identity, sizeof identity);
        for (int k = 0; k < 3; k++)
            draw[i].normal_matrix[4 * k] = 1;
    }
    scene.mesh = own;
    scene.draw = draw;
    memcpy(scene.camera.view_projection, identity, sizeof identity);
    return scene;
}

// A mesh of `count` triangles, corner after corner, which the arena owns.
static inline struct sb_mesh soup(struct sb_arena *arena, const float (*corner)[3],
                                  int count)
{
    struct sb_vertex *vertex = sb_arena_alloc(arena, 3 * (size_t)count * sizeof *vertex);
    uint32_t *index = sb_arena_alloc(arena, 3 * (size_t)count * sizeof *index);
    for (int i = 0; i < 3 * count; i++) {
        memcpy(vertex[i].position, corner[i], sizeof vertex[i].position);
        index[i] = (uint32_t)i;
    }
    return (struct sb_mesh){vertex, index, 3 * count, 3 * count, false};
}

// --- rays, in long double ----------------------------------------------------------------

struct vec3l {
    long double x, y, z;
};
static inline struct vec3l minus(struct vec3l a, struct vec3l b)
{
    return (struct vec3l){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline struct vec3l cross(struct vec3l a, struct vec3l b)
{
    return (struct vec3l){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                          a.x * b.y - a.y * b.x};
}
static inline long double dot(struct vec3l a, struct vec3l b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline struct vec3l vec3l_of(struct sb_vec3 v)
{
    return (struct vec3l){v.x, v.y, v.z};
}

// By Gauss and Jordan with pivots; rows of 4.
static inline void solve4(long double m[4][5])
{
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int row = i; row < 4; row++) {
            if (fabsl(m[row][i]) > fabsl(m[pivot][i]))
                pivot = row;
        }
        for (int k = 0; k < 5; k++) {
            const long double other = m[i][k];
            m[i][k] = m[pivot][k];
            m[pivot][k] = other;
        }
        for (int row = 0; row < 4; row++) {
            const long double factor = row == i ? 0 : m[row][i] / m[i][i];
            for (int k = 4; k >= i; k--)
                m[row][k] -= factor * m[i][k];
        }
    }
    for (int i = 0; i < 4; i++)
        m[i][4] /= m[i][i];
}

static inline struct vec3l world_at(const struct sb_scene *scene, long double ndc_x,
                                    long double ndc_y, long double ndc_z)
{
    const long double ndc[4] = {ndc_x, ndc_y, ndc_z, 1};
    long double m[4][5];
    for (int row = 0; row < 4; row++) {
        for (int k = 0; k < 4; k++)
            m[row][k] = scene->camera.view_projection[4 * k + row];
        m[row][4] = ndc[row];
    }
    solve4(m);
    return (struct vec3l){m[0][4] / m[3][4], m[1][4] / m[3][4], m[2][4] / m[3][4]};
}

// From the near plane (t = 0) to the far plane (t = 1).
struct ray {
    struct vec3l from, way;
};
static inline struct ray pixel_ray(const struct sb_scene *scene, int width, int height,
                                   long double x, long double y)
{
    const long double ndc_x = 2 * (x + 0.5L) / width - 1,
                      ndc_y = 2 * (y + 0.5L) / height - 1;
    const struct vec3l from = world_at(scene, ndc_x, ndc_y, -1);
    return (struct ray){from, minus(world_at(scene, ndc_x, ndc_y, 1), from)};
}

// Möller and Trumbore 1997. `weight` of corners 0 to 2; returns t, NAN where ray and plane
// are parallel.
static inline long double plane_hit(const struct ray *ray, const struct vec3l corner[3],
                                    long double weight[3])
{
    const struct vec3l e1 = minus(corner[1], corner[0]), e2 = minus(corner[2], corner[0]);
    const struct vec3l p = cross(ray->way, e2);
    const long double det = dot(e1, p);
    if (det == 0)
        return NAN;
    const struct vec3l s = minus(ray->from, corner[0]), q = cross(s, e1);
    weight[1] = dot(s, p) / det;
    weight[2] = dot(ray->way, q) / det;
    weight[0] = 1 - weight[1] - weight[2];
    return dot(e2, q) / det;
}

// A triangle of a draw in world space, from the floats themselves.
static inline void world_corners(const struct sb_scene *scene, struct sb_ref_cover at,
                                 struct vec3l corner[3])
{
    const struct sb_draw *draw = &scene->draw[at.draw];
    const struct sb_mesh *mesh = &scene->mesh[draw->mesh];
    for (int i = 0; i < 3; i++) {
        const float *p = mesh->vertex[mesh->index[3 * at.triangle + i]].position;
        long double out[3];
        for (int row = 0; row < 3; row++) {
            out[row] = draw->model[12 + row];
            for (int k = 0; k < 3; k++)
                out[row] += (long double)draw->model[4 * k + row] * p[k];
        }
        corner[i] = (struct vec3l){out[0], out[1], out[2]};
    }
}

// Every triangle of a scene, one after another.
struct triangles {
    struct sb_ref_cover *name;
    struct vec3l (*corner)[3];
    int count;
};
static inline struct triangles triangles_of(const struct sb_scene *scene)
{
    const size_t most = (size_t)sb_scene_triangles(scene);
    struct triangles all = {.name = calloc(most + 1, sizeof *all.name),
                            .corner = calloc(most + 1, sizeof *all.corner)};
    for (int draw = 0; draw < scene->draw_count; draw++) {
        const int count = scene->mesh[scene->draw[draw].mesh].index_count / 3;
        for (int i = 0; i < count; i++) {
            all.name[all.count] = (struct sb_ref_cover){draw, i};
            world_corners(scene, all.name[all.count], all.corner[all.count]);
            all.count++;
        }
    }
    return all;
}
static inline void triangles_free(struct triangles *all)
{
    free(all->name);
    free(all->corner);
}
