// The scene's vertices in double, and what is interpolated between them.
#include "reference/geometry.h"

#include <stdlib.h>

#include "base/mem.h"
#include "reference/geometry_state.h"

static struct sb_vec3 vec3(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static struct sb_mat4 mat4(const float m[16])
{
    struct sb_mat4 matrix;
    for (int i = 0; i < 16; i++)
        matrix.m[i] = m[i];
    return matrix;
}

// `stride`: of the columns; 4 takes the upper 3x3 of a 4x4.
static struct sb_vec3 turned(const float *m, int stride, struct sb_vec3 v)
{
    const float *x = m, *y = m + stride, *z = m + 2 * stride;
    return (struct sb_vec3){x[0] * v.x + y[0] * v.y + z[0] * v.z,
                            x[1] * v.x + y[1] * v.y + z[1] * v.z,
                            x[2] * v.x + y[2] * v.y + z[2] * v.z};
}

static struct sb_ref_input world_of(const struct sb_draw *draw,
                                    const struct sb_vertex *vertex)
{
    struct sb_ref_input in = {
        .position = sb_mat4_transform_point(mat4(draw->model), vec3(vertex->position)),
        .normal = turned(draw->normal_matrix, 3, vec3(vertex->normal)),
        .tangent = turned(draw->model, 4, vec3(vertex->tangent)),
        .uv = {vertex->uv[0], vertex->uv[1]},
    };
    if (sb_vec3_dot(in.normal, in.normal) > 0)
        in.normal = sb_vec3_normalise(in.normal);
    in.bitangent =
        sb_vec3_scale(sb_vec3_cross(in.normal, in.tangent), vertex->tangent[3]);
    return in;
}

static struct sb_ref_clip clip_of(const struct sb_ref_geometry *geometry,
                                  struct sb_vec3 world)
{
    const float *m = geometry->scene->camera.view_projection;
    double clip[4];
    for (int row = 0; row < 4; row++)
        clip[row] =
            m[row] * world.x + m[4 + row] * world.y + m[8 + row] * world.z + m[12 + row];
    return (struct sb_ref_clip){clip[0] * geometry->width, clip[1] * geometry->height,
                                clip[2], clip[3]};
}

struct sb_ref_geometry *sb_ref_geometry_new(const struct sb_scene *scene, int width,
                                            int height)
{
    struct sb_ref_geometry *geometry = sb_alloc(sizeof *geometry);
    *geometry =
        (struct sb_ref_geometry){.scene = scene, .width = width, .height = height};
    geometry->first = sb_alloc((size_t)scene->draw_count * sizeof *geometry->first + 1);
    size_t count = 0;
    for (int i = 0; i < scene->draw_count; i++) {
        geometry->first[i] = count;
        count += (size_t)scene->mesh[scene->draw[i].mesh].vertex_count;
    }
    geometry->vertex = sb_alloc(count * sizeof *geometry->vertex + 1);
    geometry->clip = sb_alloc(count * sizeof *geometry->clip + 1);
    for (int i = 0; i < scene->draw_count; i++) {
        const struct sb_mesh *mesh = &scene->mesh[scene->draw[i].mesh];
        for (int k = 0; k < mesh->vertex_count; k++) {
            const size_t at = geometry->first[i] + (size_t)k;
            geometry->vertex[at] = world_of(&scene->draw[i], &mesh->vertex[k]);
            geometry->clip[at] = clip_of(geometry, geometry->vertex[at].position);
        }
    }
    return geometry;
}

void sb_ref_geometry_free(struct sb_ref_geometry **geometry)
{
    if (!*geometry)
        return;
    sb_ref_tree_free(&(*geometry)->tree);
    free((*geometry)->first);
    free((*geometry)->vertex);
    free((*geometry)->clip);
    free(*geometry);
    *geometry = NULL;
}

void sb_ref_geometry_corners(const struct sb_ref_geometry *geometry,
                             struct sb_ref_cover at, int corner[3])
{
    const struct sb_scene *scene = geometry->scene;
    const uint32_t *index =
        scene->mesh[scene->draw[at.draw].mesh].index + 3 * (size_t)at.triangle;
    for (int i = 0; i < 3; i++)
        corner[i] = (int)index[i];
}

void sb_ref_clip_corners(const struct sb_ref_geometry *geometry, struct sb_ref_cover at,
                         const struct sb_ref_clip *corner[3])
{
    int number[3];
    sb_ref_geometry_corners(geometry, at, number);
    for (int i = 0; i < 3; i++)
        corner[i] = &geometry->clip[geometry->first[at.draw] + (size_t)number[i]];
}

struct sb_ref_input sb_ref_geometry_vertex(const struct sb_ref_geometry *geometry,
                                           int draw, int vertex)
{
    return geometry->vertex[geometry->first[draw] + (size_t)vertex];
}

// a + (b - a) s + (c - a) t: what is the same at all corners is the same between them, and far
// from the origin little is lost.
static double mix(double a, double b, double c, const double weight[3])
{
    return a + ((b - a) * weight[1] + (c - a) * weight[2]);
}

static struct sb_vec3 mix3(struct sb_vec3 a, struct sb_vec3 b, struct sb_vec3 c,
                           const double weight[3])
{
    return (struct sb_vec3){mix(a.x, b.x, c.x, weight), mix(a.y, b.y, c.y, weight),
                            mix(a.z, b.z, c.z, weight)};
}

unsigned sb_ref_lacks(const struct sb_scene *scene, int draw)
{
    const int material = scene->draw[draw].material;
    return material < scene->material_count ? scene->material[material].lacks : 0;
}

struct sb_ref_input sb_ref_geometry_input(const struct sb_ref_geometry *geometry,
                                          struct sb_ref_cover at, const double weight[3])
{
    int corner[3];
    sb_ref_geometry_corners(geometry, at, corner);
    const struct sb_ref_input *vertex = &geometry->vertex[geometry->first[at.draw]];
    const struct sb_ref_input *a = vertex + corner[0], *b = vertex + corner[1],
                              *c = vertex + corner[2];
    return (struct sb_ref_input){
        .position = mix3(a->position, b->position, c->position, weight),
        .normal = mix3(a->normal, b->normal, c->normal, weight),
        .tangent = mix3(a->tangent, b->tangent, c->tangent, weight),
        .bitangent = mix3(a->bitangent, b->bitangent, c->bitangent, weight),
        .uv = {mix(a->uv[0], b->uv[0], c->uv[0], weight),
               mix(a->uv[1], b->uv[1], c->uv[1], weight)},
        .lacks = sb_ref_lacks(geometry->scene, at.draw),
    };
}
