// What the files behind reference/geometry.h share; for them only.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "math/mat.h"
#include "reference/geometry.h"

// A vertex in clip space with x and y multiplied by width and height, so that a point X half
// pixels right of the window's middle and Y above it has x = X w and y = Y w, and centres and
// corners of pixels have whole X and Y.
struct sb_ref_clip {
    double x, y, z, w;
};

struct sb_ref_geometry {
    const struct sb_scene *scene;
    int width, height;
    size_t *first; // by draw: where its vertices begin in the two arrays below
    struct sb_ref_input *vertex;
    struct sb_ref_clip *clip;
    struct sb_ref_tree *tree; // NULL until sb_ref_geometry_rays
};

// --- triangles in the window -----------------------------------------------------------

// A corner as seen from a point of the window: (x - X w, y - Y w). Coordinates relative to the
// point keep edge functions from cancelling, and belong to the vertex alone: triangles that
// share it see the same.
struct sb_ref_seen {
    double x, y, w;
};
static inline struct sb_ref_seen sb_ref_see(const struct sb_ref_clip *clip, double x,
                                            double y)
{
    return (struct sb_ref_seen){clip->x - x * clip->w, clip->y - y * clip->w, clip->w};
}

// The edge function of two corners: the determinant of (x, y, w) of both and of the point's
// own direction (Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates",
// 1997, section 3), which is (0, 0, 1) here.
static inline double sb_ref_edge(const struct sb_ref_seen *from,
                                 const struct sb_ref_seen *to)
{
    return from->x * to->y - to->x * from->y;
}

// The three edge functions, each by the corner it lies opposite to, and the determinant of the
// triangle, which is the sum of edge[i] w[i] wherever the point is. The point has barycentric
// coordinates edge[i] / (edge[0] + edge[1] + edge[2]), and lies in front of the eye
// if that sum has the sign of `det`.
struct sb_ref_edges {
    double edge[3], det;
    int facing; // the sign of det; 0 where it is what rounding has left: seen edge-on
};
struct sb_ref_edges sb_ref_edges_of(const struct sb_ref_seen seen[3]);

void sb_ref_clip_corners(const struct sb_ref_geometry *geometry, struct sb_ref_cover at,
                         const struct sb_ref_clip *corner[3]);

// --- spheres ---------------------------------------------------------------------------

// World to object space of a draw whose mesh stands for the unit sphere.
struct sb_ref_sphere {
    struct sb_vec3 centre; // world
    struct sb_mat3 inverse;
};
// False where the model is flat, and so has no inverse.
bool sb_ref_sphere_make(const struct sb_draw *draw, struct sb_ref_sphere *sphere);
double sb_ref_sphere_hit(const struct sb_ref_sphere *sphere,
                         const struct sb_ref_ray *ray);

// --- the tree of the triangles ---------------------------------------------------------

struct sb_ref_triangle {
    double corner[3][3];
    bool sphere; // of a draw that rays with `truth` meet as a sphere
};

// An axis-aligned box, and what is in it: `count` triangles from `first`, or, where count is 0,
// the two nodes from `first`.
struct sb_ref_node {
    double low[3], high[3];
    int32_t first, count;
};

enum { SB_REF_TREE_DEPTH = 96 }; // no leaf lies deeper
struct sb_ref_tree {
    struct sb_ref_node *node; // the root first
    struct sb_ref_triangle *triangle;
    struct sb_ref_sphere *sphere;
    int node_count, triangle_count, sphere_count;
};

// Orders `triangle` and makes the nodes above it.
void sb_ref_tree_build(struct sb_ref_tree *tree);
void sb_ref_tree_free(struct sb_ref_tree **tree);

// Maps that the material of a draw lacks; 0 where the scene has no materials.
unsigned sb_ref_lacks(const struct sb_scene *scene, int draw);
