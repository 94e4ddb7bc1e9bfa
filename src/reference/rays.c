// Rays against the triangles and spheres of a scene.
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "reference/geometry_state.h"

// --- gathering -------------------------------------------------------------------------

static void add_triangles(const struct sb_ref_geometry *geometry, int draw, bool sphere,
                          struct sb_ref_tree *tree)
{
    const struct sb_mesh *mesh = &geometry->scene->mesh[geometry->scene->draw[draw].mesh];
    for (int i = 0; i < mesh->index_count; i += 3) {
        struct sb_ref_triangle *triangle = &tree->triangle[tree->triangle_count++];
        triangle->sphere = sphere;
        for (int k = 0; k < 3; k++) {
            const struct sb_vec3 at =
                sb_ref_geometry_vertex(geometry, draw, (int)mesh->index[i + k]).position;
            triangle->corner[k][0] = at.x;
            triangle->corner[k][1] = at.y;
            triangle->corner[k][2] = at.z;
        }
    }
}

void sb_ref_geometry_rays(struct sb_ref_geometry *geometry)
{
    if (geometry->tree)
        return;
    const struct sb_scene *scene = geometry->scene;
    struct sb_ref_tree *tree = sb_alloc(sizeof *tree);
    const size_t triangles = (size_t)sb_scene_triangles(scene);
    tree->triangle = sb_alloc(triangles * sizeof *tree->triangle + 1);
    tree->sphere = sb_alloc((size_t)scene->draw_count * sizeof *tree->sphere + 1);
    for (int i = 0; i < scene->draw_count; i++) {
        const struct sb_draw *draw = &scene->draw[i];
        if (draw->lamp >= 0)
            continue;
        const bool sphere = scene->mesh[draw->mesh].sphere &&
                            sb_ref_sphere_make(draw, &tree->sphere[tree->sphere_count]);
        tree->sphere_count += sphere;
        add_triangles(geometry, i, sphere, tree);
    }
    sb_ref_tree_build(tree);
    geometry->tree = tree;
}

// --- one triangle ----------------------------------------------------------------------

// A ray made ready: the names are those of Woop, Benthin and Wald, "Watertight ray/triangle
// intersection", JCGT 2(1), 2013.
struct walk {
    double origin[3], inverse[3]; // of the direction
    int kx, ky, kz;               // kz: where the direction is largest
    double sx, sy, sz; // what shears the direction to the axis kz, and scales it
    double near, far;
    bool truth;
};

static struct walk walk_of(const struct sb_ref_ray *ray)
{
    const double direction[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    struct walk walk = {.origin = {ray->origin.x, ray->origin.y, ray->origin.z},
                        .near = ray->near,
                        .far = ray->far,
                        .truth = ray->truth};
    for (int axis = 0; axis < 3; axis++) {
        walk.inverse[axis] = 1 / direction[axis];
        if (fabs(direction[axis]) > fabs(direction[walk.kz]))
            walk.kz = axis;
    }
    walk.kx = (walk.kz + 1) % 3;
    walk.ky = (walk.kz + 2) % 3;
    walk.sx = direction[walk.kx] / direction[walk.kz];
    walk.sy = direction[walk.ky] / direction[walk.kz];
    walk.sz = 1 / direction[walk.kz];
    return walk;
}

// Where the ray meets a triangle: barycentric coordinates times their sum, and how far along the
// axis kz the corners are.
struct met {
    double weight[3], sum, z[3];
};

// Sheared corners belong to corner and ray alone, so the two triangles of an edge agree on which
// side of it the ray passes, and it passes both where that is zero: no ray slips between.
static inline bool meet(const struct walk *walk, const struct sb_ref_triangle *triangle,
                        struct met *met)
{
    double x[3], y[3], *const z = met->z;
    for (int i = 0; i < 3; i++) {
        const double *corner = triangle->corner[i];
        z[i] = corner[walk->kz] - walk->origin[walk->kz];
        x[i] = corner[walk->kx] - walk->origin[walk->kx] - walk->sx * z[i];
        y[i] = corner[walk->ky] - walk->origin[walk->ky] - walk->sy * z[i];
    }
    const double u = x[2] * y[1] - y[2] * x[1];
    const double v = x[0] * y[2] - y[0] * x[2];
    const double w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
        return false;
    met->weight[0] = u;
    met->weight[1] = v;
    met->weight[2] = w;
    met->sum = u + v + w;
    return met->sum != 0; // else edge-on
}

// The distance to the triangle; INFINITY: none in [near, far].
static inline double triangle_hit(const struct walk *walk,
                                  const struct sb_ref_triangle *triangle)
{
    struct met met;
    if (!meet(walk, triangle, &met))
        return INFINITY;
    const double *weight = met.weight, *z = met.z;
    const double t =
        walk->sz * (weight[0] * z[0] + weight[1] * z[1] + weight[2] * z[2]) / met.sum;
    return t >= walk->near && t <= walk->far ? t : INFINITY;
}

// How far from the origin the triangle's corners are, interpolated to where it is met.
static double corners_away(const struct walk *walk,
                           const struct sb_ref_triangle *triangle)
{
    struct met met;
    double sum = 0;
    if (!meet(walk, triangle, &met))
        return INFINITY;
    for (int i = 0; i < 3; i++) {
        const double *corner = triangle->corner[i], *from = walk->origin;
        const struct sb_vec3 to = {corner[0] - from[0], corner[1] - from[1],
                                   corner[2] - from[2]};
        sum += met.weight[i] * sb_vec3_length(to);
    }
    return sum / met.sum;
}

// --- the tree --------------------------------------------------------------------------

// Does the ray pass the box before `far`, and where does it enter? By slabs: a NaN, of a ray
// that runs in a side of the box, compares false and so leaves the interval as it is.
static inline bool box_hit(const struct walk *walk, const struct sb_ref_node *node,
                           double *enter)
{
    double near = walk->near, far = walk->far;
    for (int axis = 0; axis < 3; axis++) {
        const double inverse = walk->inverse[axis];
        const double low = (node->low[axis] - walk->origin[axis]) * inverse;
        const double high = (node->high[axis] - walk->origin[axis]) * inverse;
        const double in = inverse < 0 ? high : low, out = inverse < 0 ? low : high;
        // Each is off by at most three roundings (Ize, "Robust BVH ray traversal", JCGT
        // 2(2), 2013), and so is the triangle's own distance.
        const double before = in - 8 * DBL_EPSILON * fabs(in);
        const double behind = out + 8 * DBL_EPSILON * fabs(out);
        if (before > near)
            near = before;
        if (behind < far)
            far = behind;
    }
    *enter = near;
    return near <= far;
}

struct visit {
    int node;
    double enter;
};

// Nearest first; with `any` the first that is found will do. `which`: takes it, or NULL.
static inline double tree_hit(const struct sb_ref_tree *tree, struct walk walk, bool any,
                              const struct sb_ref_triangle **which)
{
    struct visit stack[SB_REF_TREE_DEPTH + 1];
    int count = 0;
    double best = INFINITY, enter;
    if (tree->node_count > 0 && box_hit(&walk, &tree->node[0], &enter))
        stack[count++] = (struct visit){0, enter};
    while (count > 0) {
        const struct visit visit = stack[--count];
        if (visit.enter > walk.far) // something nearer was found meanwhile
            continue;
        const struct sb_ref_node *node = &tree->node[visit.node];
        for (int i = node->first; i < node->first + node->count; i++) {
            const struct sb_ref_triangle *triangle = &tree->triangle[i];
            if (walk.truth && triangle->sphere)
                continue;
            const double t = triangle_hit(&walk, triangle);
            if (!(t < best))
                continue;
            if (any)
                return t;
            best = walk.far = t;
            if (which)
                *which = triangle;
        }
        if (node->count > 0)
            continue;
        double enters[2];
        bool pass[2];
        for (int i = 0; i < 2; i++)
            pass[i] = box_hit(&walk, &tree->node[node->first + i], &enters[i]);
        const int nearer = pass[1] && (!pass[0] || enters[1] < enters[0]);
        for (int i = 0; i < 2; i++) { // the nearer one on top
            const int child = i == 0 ? !nearer : nearer;
            if (pass[child])
                stack[count++] = (struct visit){node->first + child, enters[child]};
        }
    }
    return best;
}

double sb_ref_geometry_hit(const struct sb_ref_geometry *geometry,
                           const struct sb_ref_ray *ray)
{
    const struct sb_ref_tree *tree = geometry->tree;
    double best = INFINITY;
    for (int i = 0; ray->truth && i < tree->sphere_count; i++)
        best = fmin(best, sb_ref_sphere_hit(&tree->sphere[i], ray));
    struct walk walk = walk_of(ray);
    walk.far = fmin(walk.far, best);
    return fmin(best, tree_hit(tree, walk, false, NULL));
}

double sb_ref_geometry_corners_away(const struct sb_ref_geometry *geometry,
                                    const struct sb_ref_ray *ray, double *away)
{
    const struct sb_ref_triangle *which = NULL;
    struct walk walk = walk_of(ray);
    walk.truth = false;
    const double t = tree_hit(geometry->tree, walk, false, &which);
    *away = which ? corners_away(&walk, which) : INFINITY;
    return t;
}

bool sb_ref_geometry_blocked(const struct sb_ref_geometry *geometry,
                             const struct sb_ref_ray *ray)
{
    const struct sb_ref_tree *tree = geometry->tree;
    for (int i = 0; ray->truth && i < tree->sphere_count; i++) {
        if (sb_ref_sphere_hit(&tree->sphere[i], ray) < INFINITY)
            return true;
    }
    return tree_hit(tree, walk_of(ray), true, NULL) < INFINITY;
}
