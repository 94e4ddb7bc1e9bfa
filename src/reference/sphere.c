// The unit sphere that a mesh stands for: met by rays, and seen through the centre of a pixel.
#include <math.h>

#include "reference/geometry_state.h"

static struct sb_vec3 column(const float *m, int number, int stride)
{
    m += number * stride;
    return (struct sb_vec3){m[0], m[1], m[2]};
}

static struct sb_vec3 combined(const float *m, int stride, struct sb_vec3 v)
{
    return sb_vec3_add(sb_vec3_add(sb_vec3_scale(column(m, 0, stride), v.x),
                                   sb_vec3_scale(column(m, 1, stride), v.y)),
                       sb_vec3_scale(column(m, 2, stride), v.z));
}

bool sb_ref_sphere_make(const struct sb_draw *draw, struct sb_ref_sphere *sphere)
{
    const struct sb_vec3 x = column(draw->model, 0, 4), y = column(draw->model, 1, 4),
                         z = column(draw->model, 2, 4);
    const struct sb_vec3 row[3] = {sb_vec3_cross(y, z), sb_vec3_cross(z, x),
                                   sb_vec3_cross(x, y)}; // of the inverse, times det
    const double det = sb_vec3_dot(x, row[0]);
    if (det == 0 || !isfinite(1 / det))
        return false;
    sphere->centre = column(draw->model, 3, 4);
    for (int i = 0; i < 3; i++) {
        sphere->inverse.m[i] = row[i].x / det;
        sphere->inverse.m[3 + i] = row[i].y / det;
        sphere->inverse.m[6 + i] = row[i].z / det;
    }
    return true;
}

static struct sb_vec3 to_object(const struct sb_ref_sphere *sphere, struct sb_vec3 v)
{
    const double *m = sphere->inverse.m;
    return (struct sb_vec3){m[0] * v.x + m[3] * v.y + m[6] * v.z,
                            m[1] * v.x + m[4] * v.y + m[7] * v.z,
                            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

double sb_ref_sphere_hit(const struct sb_ref_sphere *sphere, const struct sb_ref_ray *ray)
{
    const struct sb_vec3 origin =
        to_object(sphere, sb_vec3_sub(ray->origin, sphere->centre));
    const struct sb_vec3 way = to_object(sphere, ray->direction);
    // Haines, Günther and Akenine-Möller, "Precision improvements for ray/sphere
    // intersection", Ray Tracing Gems, 2019: the discriminant from the point nearest to the
    // centre, and of the roots of a t^2 - 2 b t + c the smaller from c over the larger.
    const double a = sb_vec3_dot(way, way), b = -sb_vec3_dot(origin, way);
    const struct sb_vec3 nearest = sb_vec3_add(origin, sb_vec3_scale(way, b / a));
    const double discriminant = 1 - sb_vec3_dot(nearest, nearest);
    if (!(discriminant >= 0))
        return INFINITY;
    const double length = sb_vec3_length(origin);
    const double c = (length - 1) * (length + 1);
    const double q = b + copysign(sqrt(a * discriminant), b);
    const double root[2] = {q / a, q != 0 ? c / q : 0};
    double hit = INFINITY;
    for (int i = 0; i < 2; i++) {
        if (root[i] >= ray->near && root[i] <= ray->far && root[i] < hit)
            hit = root[i];
    }
    return hit;
}

// --- through the centre of a pixel -----------------------------------------------------

// A row of view_projection * model: a linear function of a point in object space.
struct plane {
    struct sb_vec3 normal;
    double offset;
};

static struct plane clip_row(const struct sb_scene *scene, const struct sb_draw *draw,
                             int row)
{
    const float *outer = scene->camera.view_projection + row;
    double sum[4];
    for (int i = 0; i < 4; i++) {
        const float *inner = draw->model + 4 * i;
        sum[i] = 0;
        for (int k = 0; k < 4; k++)
            sum[i] += (double)outer[4 * k] * inner[k];
    }
    return (struct plane){{sum[0], sum[1], sum[2]}, sum[3]};
}

static double value(const struct plane *plane, struct sb_vec3 point)
{
    return sb_vec3_dot(plane->normal, point) + plane->offset;
}

// a - s b, of unit normal where that is not zero.
static struct plane difference(const struct plane *a, double s, const struct plane *b)
{
    struct plane plane = {sb_vec3_sub(a->normal, sb_vec3_scale(b->normal, s)),
                          a->offset - s * b->offset};
    const double length = sb_vec3_length(plane.normal);
    if (length > 0) {
        plane.normal = sb_vec3_scale(plane.normal, 1 / length);
        plane.offset /= length;
    }
    return plane;
}

// The first point of the unit sphere on the line of points whose x/w and y/w are given, among
// those in front of the near plane. The line is where the planes x - X w = 0 and y - Y w = 0
// meet, so no matrix is inverted.
static bool first_on_sphere(const struct sb_scene *scene, const struct sb_draw *draw,
                            double ndc_x, double ndc_y, struct sb_vec3 *first)
{
    const struct plane x = clip_row(scene, draw, 0), y = clip_row(scene, draw, 1),
                       z = clip_row(scene, draw, 2), w = clip_row(scene, draw, 3);
    const struct plane a = difference(&x, ndc_x, &w), b = difference(&y, ndc_y, &w);
    const struct sb_vec3 along = sb_vec3_cross(a.normal, b.normal);
    const double along2 = sb_vec3_dot(along, along);
    // The line's point nearest to the centre.
    const struct sb_vec3 nearest =
        sb_vec3_scale(sb_vec3_cross(sb_vec3_sub(sb_vec3_scale(a.normal, b.offset),
                                                sb_vec3_scale(b.normal, a.offset)),
                                    along),
                      1 / along2);
    const double half2 = 1 - sb_vec3_dot(nearest, nearest); // of the chord
    if (!(along2 > 0) || !(half2 >= 0))
        return false;
    double depth = INFINITY;
    for (int i = -1; i <= 1; i += 2) {
        const struct sb_vec3 point =
            sb_vec3_add(nearest, sb_vec3_scale(along, i * sqrt(half2 / along2)));
        const double at_w = value(&w, point), at_z = value(&z, point);
        if (at_w > 0 && at_z >= -at_w && at_z / at_w < depth) {
            depth = at_z / at_w;
            *first = point;
        }
    }
    return depth < INFINITY;
}

// The inverse of what sb_mesh_sphere makes of longitude and latitude. Of the many u of the
// seam it takes the one next to the triangle's own.
static struct sb_ref_input surface_at(const struct sb_ref_geometry *geometry,
                                      struct sb_ref_cover at, struct sb_vec3 point)
{
    const struct sb_draw *draw = &geometry->scene->draw[at.draw];
    const double longitude = atan2(point.x, point.z);
    const double latitude = atan2(point.y, sqrt(point.x * point.x + point.z * point.z));
    const struct sb_vec3 tangent = {cos(longitude), 0, -sin(longitude)};
    const struct sb_vec3 normal = combined(draw->normal_matrix, 3, point);
    struct sb_ref_input input = {
        .position =
            sb_vec3_add(combined(draw->model, 4, point), column(draw->model, 3, 4)),
        .normal = sb_vec3_dot(normal, normal) > 0 ? sb_vec3_normalise(normal) : normal,
        .tangent = combined(draw->model, 4, tangent),
        .uv = {(longitude + SB_PI) / (2 * SB_PI), latitude / SB_PI + 0.5},
        .lacks = sb_ref_lacks(geometry->scene, at.draw),
    };
    input.bitangent = sb_vec3_cross(input.normal, input.tangent); // w is 1
    const double third[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    const double u = sb_ref_geometry_input(geometry, at, third).uv[0];
    input.uv[0] += round(u - input.uv[0]);
    return input;
}

bool sb_ref_geometry_truth(const struct sb_ref_geometry *geometry, struct sb_ref_cover at,
                           int x, int y, struct sb_ref_input *input)
{
    const struct sb_draw *draw = &geometry->scene->draw[at.draw];
    if (!geometry->scene->mesh[draw->mesh].sphere) {
        double weight[3];
        if (!sb_ref_geometry_weights(geometry, at, x, y, weight))
            return false;
        *input = sb_ref_geometry_input(geometry, at, weight);
        return true;
    }
    struct sb_vec3 point = {0};
    if (!first_on_sphere(geometry->scene, draw,
                         (2.0 * x + 1 - geometry->width) / geometry->width,
                         (2.0 * y + 1 - geometry->height) / geometry->height, &point))
        return false;
    *input = surface_at(geometry, at, point);
    return true;
}
