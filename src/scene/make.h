// What the scenes are made of; for src/scene/ and its tests only. Everything is computed
// in double, in the scene's own units, and rounded to float once, when it is placed.
#pragma once

#include "math/mat.h"
#include "scene/scene.h"

#define SB_DEGREE       (SB_PI / 180)
#define SB_GOLDEN_ANGLE 2.39996322972865332 // its multiples spread evenly over the circle

// --- the axes that place a scene: p becomes p * scale + offset (1, 1, 1) - origin -------

struct sb_placement {
    double scale, offset;
    struct sb_vec3 origin; // space=eye: the eye, scaled and moved; else 0
    double aspect;         // of the target, width to height
};
// The eye is that of the scene's sb_camera_params.
struct sb_placement sb_placement_of(const struct sb_variant *variant, struct sb_vec3 eye);
// Triangles asked for, or where the variant asks for none the scene's own number.
double sb_triangles_wanted(const struct sb_variant *variant, double own);
struct sb_vec3 sb_placed(const struct sb_placement *place, struct sb_vec3 point);

struct sb_camera_params {
    struct sb_vec3 eye, target;
    double fov; // radians, of the shorter side of the target: what a square one shows,
                // every shape shows
    double near, far; // before scaling
};
struct sb_camera sb_camera_make(const struct sb_placement *place,
                                const struct sb_camera_params *params);

struct sb_draw sb_draw_make(const struct sb_placement *place, int mesh, int material,
                            struct sb_mat4 model);

// --- meshes ----------------------------------------------------------------------------

// The cube from -1/2 to 1/2, each face cut into cells x cells squares: 12 cells^2
// triangles.
struct sb_mesh sb_mesh_cube(struct sb_arena *arena, int cells);

// The unit sphere by latitude and longitude, poles at +-y: 2 slices (stacks - 1)
// triangles. stacks >= 2, slices >= 3. u = 1/2 faces +z.
struct sb_mesh sb_mesh_sphere(struct sb_arena *arena, int stacks, int slices);
// About so many triangles, with twice as many slices as stacks.
void sb_sphere_cells(double triangles, int *stacks, int *slices);

// A rectangle in the plane z = 0 around the origin, facing +z, with tiles of 1 x 1 unit:
// 2 columns rows triangles.
struct sb_mesh sb_mesh_plane(struct sb_arena *arena, double width, double height,
                             int columns, int rows);

// --- textures --------------------------------------------------------------------------

// A crate: boards in a metal frame. The boards have no specular reflection.
void sb_texture_make(struct sb_arena *arena, struct sb_texture map[SB_MAP_COUNT]);

// --- lights ----------------------------------------------------------------------------

struct sb_light_params {
    struct sb_vec3 position, direction; // of an area light: half its segment
    struct sb_vec3 ambient, diffuse, specular;
    double intensity; // makers leave it alone: their lights are on, and colours hold it
    double range, constant, linear, quadratic;
    double inner, outer; // half angles of the cone, radians
    double exponent;
    double radius;
    struct sb_vec3 extent; // as radius and range, before scaling
};

// Light number i of a list of any length, so that shorter lists are beginnings of longer.
typedef struct sb_light_params (*sb_light_maker)(int i);

void sb_lights_make(struct sb_scene *scene, const struct sb_placement *place,
                    const sb_light_maker maker[SB_LIGHT_TYPE_COUNT],
                    const struct sb_variant *variant);

// What the axes `sun` and `atmosphere` make of a light: the sun's direction and colour, to be
// called for the first directional light; the colours of light number i of its type; and the
// colours of the scene itself.
void sb_light_follow_sun(struct sb_light_params *light, const struct sb_variant *variant);
void sb_light_tint(struct sb_light_params *light, enum sb_light_type type, int i,
                   const struct sb_variant *variant);
void sb_background_tint(struct sb_vec3 *ambient, struct sb_vec3 *clear,
                        const struct sb_variant *variant);

// Light number i's own point in the unit cube: evenly spread for every length of the
// list.
struct sb_vec3 sb_light_spread(int i);

// A unit vector at most acos(cos_limit) away from `axis`, which must not be parallel to
// y; (u, v) in the unit square map to the cap evenly.
struct sb_vec3 sb_light_cap(struct sb_vec3 axis, double cos_limit, double u, double v);

// A colour of light number i, neighbours far apart in hue, no component above `intensity`
// or below a tenth of it, so that no surface is blind to it; ambient is a sixteenth of
// it, as in the text of `containers`.
void sb_light_colour(struct sb_light_params *light, int i, double intensity);

// The size of area light number i, whatever its shape is: half sides, a radius, and half a
// segment, nearly level; no point of it is farther than 0.9 from its middle.
void sb_light_shape(struct sb_light_params *light, int i);

// The text's sun, which is the first directional light of every scene; others, from
// within 60 degrees of +z; and the text's flashlight, held at the eye and pointing along
// -z.
struct sb_light_params sb_light_sun(void);
struct sb_light_params sb_light_from_front(int i);
struct sb_light_params sb_light_torch(struct sb_vec3 eye);

// Somewhere over a field of 10 x 10 units, `room` higher than things of height 1.5.
struct sb_light_params sb_light_above(int i, double room);

// --- the corridor that `plane` and `tunnel` share --------------------------------------

// Along z, seen from inside towards -z: floor, ceiling and walls at a distance of `half` from
// the axis, and a wall that closes the far end.
struct sb_corridor {
    double half, near_z, far_z;
};
enum { SB_CORRIDOR_MESHES = 2, SB_CORRIDOR_DRAWS = 5 };

// About so many triangles; for sb_scene_parts.
void sb_corridor_make(const struct sb_corridor *corridor, double triangles,
                      struct sb_arena *arena, struct sb_mesh mesh[SB_CORRIDOR_MESHES]);
void sb_corridor_place(const struct sb_corridor *corridor,
                       const struct sb_placement *place,
                       struct sb_draw draw[SB_CORRIDOR_DRAWS]);

// The page's frontMaterial, and a light from across the corridor: it falls on floor, ceiling
// or a wall, all of which the eye sees.
extern const struct sb_material sb_corridor_material;
struct sb_light_params sb_light_across(int i);

// --- a yard, of which most scenes for effects are made -----------------------------------

struct sb_yard_object { // stands on the ground
    double x, z, size;
    double turn; // degrees about y
    bool ball;   // else a cube
    int material;
};
struct sb_yard {
    double side; // of the ground, around the origin
    int tiles;   // it is tiles x tiles draws, so that each may call for lights of its own
    const struct sb_yard_object *object;
    int object_count;
    const struct sb_material *material; // that of the ground first
    int material_count;
    double triangles, ambient;
    struct sb_camera_params camera;
    sb_light_maker light[SB_LIGHT_TYPE_COUNT];
};
void sb_yard_make(struct sb_scene *scene, const struct sb_yard *yard,
                  const struct sb_variant *variant);

// A dozen things of four colours, lit from above, seen from a little above: for a scene to change.
extern const struct sb_yard sb_yard_common;

// Lights of a yard: over it, as sb_light_above; spot lights shine down.
struct sb_light_params sb_yard_dir(int i);
struct sb_light_params sb_yard_point(int i);
struct sb_light_params sb_yard_spot(int i);
struct sb_light_params sb_yard_area(int i);

// --- scenes ----------------------------------------------------------------------------

struct sb_scene_parts {
    const struct sb_mesh *mesh;
    const struct sb_draw *draw; // already placed
    const struct sb_material *material;
    int mesh_count, draw_count, material_count;
    double ambient, clear; // grey
    struct sb_camera_params camera;
    sb_light_maker light[SB_LIGHT_TYPE_COUNT];
};
// Copies the parts, places camera and lights as the variant says, and adds the textures, and
// the lamps that show the point lights.
void sb_scene_fill(struct sb_scene *scene, const struct sb_scene_parts *parts,
                   const struct sb_variant *variant);

void sb_scene_containers(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_sphere(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_plane(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_tunnel(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_blocks(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_spheres(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_room(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_night(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_flashlight(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_lamps4(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_lamps64(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_mixed(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_partly_mapped(struct sb_scene *scene, const struct sb_variant *variant);
void sb_scene_one_caster(struct sb_scene *scene, const struct sb_variant *variant);
