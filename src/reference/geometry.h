// The geometry of the reference: the scene's own floats, promoted to double, transformed,
// clipped, rasterised and met by rays. World space unless said.
//
// Nothing here is shared with the GLSL or the drivers: it is what they are checked against.
#pragma once

#include <stdint.h>

#include "math/vec.h"
#include "scene/scene.h"

// What reaches the lighting of one point, interpolated or exact, before normal maps. Of any
// space: that of the lights it is lit by.
struct sb_ref_input {
    struct sb_vec3 position;
    struct sb_vec3
        normal; // as interpolated between unit normals of vertices: of any length
    struct sb_vec3 tangent,
        bitangent; // as interpolated; bitangent: cross(normal, tangent) * w
                   // at the vertices
    double uv[2];
    // What a driver's lookups gave, raw, by enum sb_map; false: the maps are sampled exactly, at uv.
    bool sampled;
    struct sb_vec3 texel[SB_MAP_COUNT];
    unsigned lacks; // of the draw's material
};

// A scene ready to be asked: vertices of every draw in clip and world space, and a tree of the
// triangles for rays, which is built when first needed (thread-safe after
// sb_ref_geometry_rays). Opaque; `scene` must outlive it.
struct sb_ref_geometry;
struct sb_ref_geometry *sb_ref_geometry_new(const struct sb_scene *scene, int width,
                                            int height);
void sb_ref_geometry_free(struct sb_ref_geometry **geometry);

// --- pixels ----------------------------------------------------------------------------

// What a pixel shows: the nearest triangle at its centre.
struct sb_ref_cover {
    int32_t draw;     // -1: background
    int32_t triangle; // of the draw's mesh
};
// Fills width * height covers, rows from the bottom up, with `threads` threads (at least 1).
// Pixel centres, the top-left rule of ties (any consistent rule of OpenGL 4.6 core, 14.6.1),
// depth test GL_LESS between -w and w, no culling.
void sb_ref_geometry_cover(const struct sb_ref_geometry *geometry, int threads,
                           struct sb_ref_cover *cover);

// Barycentric coordinates, perspective-correct, of the centre of pixel (x, y) in the plane of
// a triangle (OpenGL 4.6 core, 14.6.1, equation 14.9); they sum to 1. False where the plane is
// seen edge-on.
bool sb_ref_geometry_weights(const struct sb_ref_geometry *geometry,
                             struct sb_ref_cover at, int x, int y, double weight[3]);

// Do all four corners of the pixel lie in the triangle?
bool sb_ref_geometry_inside(const struct sb_ref_geometry *geometry,
                            struct sb_ref_cover at, int x, int y);

// The numbers of a triangle's vertices in its mesh.
void sb_ref_geometry_corners(const struct sb_ref_geometry *geometry,
                             struct sb_ref_cover at, int corner[3]);

// What the vertex shader hands on of one vertex of a draw: position and tangent frame in world
// space, the normal of unit length (a zero normal stays zero).
struct sb_ref_input sb_ref_geometry_vertex(const struct sb_ref_geometry *geometry,
                                           int draw, int vertex);

// Interpolates between the corners of a triangle by weights.
struct sb_ref_input sb_ref_geometry_input(const struct sb_ref_geometry *geometry,
                                          struct sb_ref_cover at, const double weight[3]);

// The truth that the mesh stands for: of a mesh with `sphere` set, the point of the analytic
// sphere that the ray through the pixel's centre meets first, its normal, uv and tangent frame;
// of any other mesh the triangle's own point. False where the ray misses.
bool sb_ref_geometry_truth(const struct sb_ref_geometry *geometry, struct sb_ref_cover at,
                           int x, int y, struct sb_ref_input *input);

// --- rays, in world space; lamps are not there --------------------------------------------

// Must be called once, by one thread, before the others below.
void sb_ref_geometry_rays(struct sb_ref_geometry *geometry);

// Distance from `origin` along `direction` (of any length but 0, in units of its length) to the
// first triangle in [near, far], both sides; INFINITY where there is none. Of a mesh with `sphere`
// set the analytic sphere is met, if `truth`.
struct sb_ref_ray {
    struct sb_vec3 origin, direction;
    double near, far;
    bool truth;
};
double sb_ref_geometry_hit(const struct sb_ref_geometry *geometry,
                           const struct sb_ref_ray *ray);
// The same for triangles alone; *away: the distances of the triangle's corners from `origin`, in
// world units, interpolated to where the ray meets it.
double sb_ref_geometry_corners_away(const struct sb_ref_geometry *geometry,
                                    const struct sb_ref_ray *ray, double *away);
// Is anything there at all? Faster than the first.
bool sb_ref_geometry_blocked(const struct sb_ref_geometry *geometry,
                             const struct sb_ref_ray *ray);
