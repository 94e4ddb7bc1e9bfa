#include "effects/bounds.h"

#include <string.h>

static struct sb_vec3 vec3(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static struct sb_vec3 placed(const float m[16], const float p[3])
{
    const double x = p[0], y = p[1], z = p[2];
    return (struct sb_vec3){m[0] * x + m[4] * y + m[8] * z + m[12],
                            m[1] * x + m[5] * y + m[9] * z + m[13],
                            m[2] * x + m[6] * y + m[10] * z + m[14]};
}

static struct sb_vec3 lower(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)};
}

static struct sb_vec3 upper(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)};
}

static struct sb_vec3 corner(const struct sb_scene *scene, int draw, int index)
{
    const struct sb_draw *it = &scene->draw[draw];
    const struct sb_mesh *mesh = &scene->mesh[it->mesh];
    return placed(it->model, mesh->vertex[mesh->index[index]].position);
}

// The plane of the first triangle, if all others lie in it and face the same way.
static void find_plane(const struct sb_scene *scene, int draw, struct sb_bounds *bounds)
{
    const struct sb_mesh *mesh = &scene->mesh[scene->draw[draw].mesh];
    bounds->flat = mesh->index_count >= 3;
    bounds->offset = -INFINITY;
    for (int i = 0; bounds->flat && i + 2 < mesh->index_count; i += 3) {
        const struct sb_vec3 a = corner(scene, draw, i);
        const struct sb_vec3 ab = sb_vec3_sub(corner(scene, draw, i + 1), a);
        const struct sb_vec3 ac = sb_vec3_sub(corner(scene, draw, i + 2), a);
        const struct sb_vec3 n = sb_vec3_cross(ab, ac);
        const double length = sb_vec3_length(n);
        if (i == 0 && length > 0)
            bounds->normal = sb_vec3_scale(n, 1 / length);
        bounds->flat =
            length > 0 && sb_vec3_dot(n, bounds->normal) > (1 - 1e-9) * length &&
            fabs(sb_vec3_dot(sb_vec3_sub(a, corner(scene, draw, 0)), bounds->normal)) <
                1e-6 * bounds->radius;
        bounds->offset = fmax(bounds->offset, sb_vec3_dot(bounds->normal, a));
    }
}

void sb_bounds_of(const struct sb_scene *scene, int draw, struct sb_bounds *bounds)
{
    const struct sb_draw *it = &scene->draw[draw];
    const struct sb_mesh *mesh = &scene->mesh[it->mesh];
    *bounds = (struct sb_bounds){.low = {INFINITY, INFINITY, INFINITY},
                                 .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < mesh->vertex_count; i++) {
        const struct sb_vec3 at = placed(it->model, mesh->vertex[i].position);
        bounds->low = lower(bounds->low, at);
        bounds->high = upper(bounds->high, at);
    }
    bounds->centre = sb_vec3_scale(sb_vec3_add(bounds->low, bounds->high), 0.5);
    for (int i = 0; i < mesh->vertex_count; i++) {
        const struct sb_vec3 at = placed(it->model, mesh->vertex[i].position);
        bounds->radius =
            fmax(bounds->radius, sb_vec3_length(sb_vec3_sub(at, bounds->centre)));
    }
    find_plane(scene, draw, bounds);
}

// The farthest that the box reaches along a direction.
static double farthest(const struct sb_bounds *bounds, struct sb_vec3 n)
{
    return fmax(n.x * bounds->low.x, n.x * bounds->high.x) +
           fmax(n.y * bounds->low.y, n.y * bounds->high.y) +
           fmax(n.z * bounds->low.z, n.z * bounds->high.z);
}

static bool is_behind(const struct sb_bounds *plane, const struct sb_bounds *other)
{
    return plane->flat && farthest(other, plane->normal) <=
                              plane->offset + 1e-6 * (plane->radius + other->radius);
}

double sb_bounds_distance(const struct sb_bounds *bounds, struct sb_vec3 point)
{
    const struct sb_vec3 nearest = lower(upper(point, bounds->low), bounds->high);
    return sb_vec3_length(sb_vec3_sub(point, nearest));
}

// Half the angle that the sphere fills, seen from a point outside of it.
static double half_angle(double radius, double distance)
{
    return asin(fmin(radius / distance, 1));
}

static double angle_between(struct sb_vec3 a, struct sb_vec3 b)
{
    // Of any length; exact near 0 and pi, where acos is not.
    return atan2(sb_vec3_length(sb_vec3_cross(a, b)), sb_vec3_dot(a, b));
}

bool sb_bounds_in_cone(const struct sb_bounds *bounds, struct sb_vec3 apex,
                       struct sb_vec3 axis, double angle)
{
    const struct sb_vec3 to_centre = sb_vec3_sub(bounds->centre, apex);
    const double distance = sb_vec3_length(to_centre);
    return distance <= bounds->radius ||
           angle_between(to_centre, axis) - half_angle(bounds->radius, distance) <= angle;
}

bool sb_bounds_between(const struct sb_bounds *bounds, struct sb_vec3 point,
                       const struct sb_bounds *other)
{
    const struct sb_vec3 to_centre = sb_vec3_sub(bounds->centre, point);
    const struct sb_vec3 to_other = sb_vec3_sub(other->centre, point);
    const double distance = sb_vec3_length(to_centre);
    const double other_distance = sb_vec3_length(to_other);
    if (is_behind(bounds, other))
        return false;
    if (other_distance <= other->radius || distance <= bounds->radius)
        return true;
    return other_distance - other->radius <= distance + bounds->radius &&
           angle_between(to_centre, to_other) <=
               half_angle(bounds->radius, distance) +
                   half_angle(other->radius, other_distance);
}

// --- shapes ----------------------------------------------------------------------------------

// Looking at each vertex from each triangle; beyond, a mesh is taken to be any shape.
static const int64_t CONVEX_WORK_MAX = 4000000;

static bool is_even(const struct sb_mesh *mesh)
{
    for (int i = 0; i + 2 < mesh->index_count; i += 3) {
        const struct sb_vertex *a = &mesh->vertex[mesh->index[i]];
        for (int k = 1; k < 3; k++) {
            const struct sb_vertex *b = &mesh->vertex[mesh->index[i + k]];
            for (int c = 0; c < 3; c++)
                if (a->normal[c] != b->normal[c])
                    return false;
        }
    }
    return true;
}

// Signed distance of a point from a triangle's plane, relative to the triangle's size.
static bool in_front(struct sb_vec3 corner, struct sb_vec3 normal, double length,
                     struct sb_vec3 point)
{
    const double rounding = 1e-5;
    const struct sb_vec3 way = sb_vec3_sub(point, corner);
    return sb_vec3_dot(way, normal) > rounding * length * sb_vec3_length(way);
}

static bool is_convex(const struct sb_mesh *mesh)
{
    if ((int64_t)mesh->index_count / 3 * mesh->vertex_count > CONVEX_WORK_MAX)
        return mesh->sphere;
    for (int i = 0; i + 2 < mesh->index_count; i += 3) {
        const struct sb_vec3 a = vec3(mesh->vertex[mesh->index[i]].position);
        const struct sb_vec3 b = vec3(mesh->vertex[mesh->index[i + 1]].position);
        const struct sb_vec3 c = vec3(mesh->vertex[mesh->index[i + 2]].position);
        const struct sb_vec3 normal = sb_vec3_cross(sb_vec3_sub(b, a), sb_vec3_sub(c, a));
        const double length = sb_vec3_length(normal);
        for (int v = 0; v < mesh->vertex_count; v++)
            if (in_front(a, normal, length, vec3(mesh->vertex[v].position)))
                return false;
    }
    return true;
}

void sb_shape_facts_of(const struct sb_mesh *mesh, struct sb_shape_facts *facts)
{
    facts->even = is_even(mesh);
    facts->convex = is_convex(mesh);
}

bool sb_draw_keeps_length(const struct sb_draw *draw)
{
    const float *m = draw->normal_matrix;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double dot = 0;
            for (int r = 0; r < 3; r++)
                dot += (double)m[3 * i + r] * (double)m[3 * k + r];
            if (fabs(dot - (i == k)) > 1e-6)
                return false;
        }
    return true;
}
