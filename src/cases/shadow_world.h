// A picture of a scene with one shadow caster, what the driver told of it, and the same geometry for
// rays in double: what the cases of shadows measure with. World space.
#pragma once

#include "cases/own.h"
#include "reference/geometry.h"

struct sb_shadow_world {
    const struct sb_driver *driver;
    struct sb_case_task drawn;
    struct sb_scene scene;
    struct sb_ref_geometry *geometry;
    struct sb_vec3 light; // where the caster is
    double range;
    double bias;                 // in units of the range
    int size;                    // texels a side of a face
    struct sb_image inputs, lit; // pages SB_PROBE_INPUTS and SB_PROBE_LIGHT of the caster
};

// Draws `scene` with the variant, whose only light casts shadows. *world must be zeroed; close also
// after failure. SB_OVER_LIMIT and SB_BAD_INPUT: the driver has no such map.
bool sb_shadow_world_open(struct sb_shadow_world *world, const struct sb_case_env *env,
                          const struct sb_variant *variant, const char *scene,
                          struct sb_error *err);
void sb_shadow_world_close(struct sb_shadow_world *world);

// A pixel that the light was evaluated at.
struct sb_shadow_pixel {
    struct sb_vec3 from_light; // to the surface
    struct sb_vec3 normal;     // as interpolated
    double distance, n_dot_l, shown;
};
bool sb_shadow_pixel_at(const struct sb_shadow_world *world, int pixel,
                        struct sb_shadow_pixel *at);
int sb_shadow_pixel_count(const struct sb_shadow_world *world);

// How far the light sees in a direction, by the exact geometry; INFINITY: nothing in its range.
double sb_shadow_seen(const struct sb_shadow_world *world, struct sb_vec3 direction);

// Is a place lit, by the exact geometry? EDGE: a texel around it sees something else, or so little
// before it that the bias may pass over it, and a map may say either.
enum sb_shadow_truth { SB_SHADOW_EDGE, SB_SHADOW_LIT, SB_SHADOW_DARK };
enum sb_shadow_truth sb_shadow_truth(const struct sb_shadow_world *world,
                                     const struct sb_shadow_pixel *at);

// How far a place is behind what the light sees first, along its ray: the least of the 3 x 3 texels
// around it, >= 0. 0 where nothing lies before it, or the edge of its shadow is within a texel.
double sb_shadow_gap(const struct sb_shadow_world *world, struct sb_vec3 from_light);

// Side of a texel at that place, world units: a face is two of the largest component wide.
double sb_shadow_texel(const struct sb_shadow_world *world, struct sb_vec3 from_light);

// The direction of the centre of the texel x, y texels from the one that the direction meets. Over
// the edge of a face it goes on in the plane of the face.
struct sb_vec3 sb_shadow_centre(const struct sb_shadow_world *world,
                                struct sb_vec3 direction, int x, int y);

// The stored map, unfolded as docs/glsl.md draws it, and the direction of a texel of that picture; false
// in its corners.
bool sb_shadow_map_read(const struct sb_shadow_world *world, struct sb_image *map,
                        struct sb_error *err);
bool sb_shadow_map_direction(const struct sb_shadow_world *world, int x, int y,
                             struct sb_vec3 *direction);
