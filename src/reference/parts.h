// The parts of the shading, one job each; for src/reference/ and its tests only.
//
// Vectors are in the space of the lighting unless said. Nothing here allocates or keeps state.
#pragma once

#include "reference/shade.h"

// --- what the variant asks for --------------------------------------------------------------

// The variant's axes as plain numbers, so that no loop asks for them again.
struct sb_ref_choice {
    int model, ambient, attenuation, cone, area_shape; // values of these axes
    int slips;         // the source text whose slips are kept; SB_SOURCE_NONE: no slip
    bool schlick;      // highlights are whiter at grazing angles
    bool energy;       // … and have the same energy, whatever their exponent
    bool cuts_back;    // no highlights where the surface faces away
    bool keeps_length; // interpolated normals stay as they are
    bool spreads;      // f_frame=naive: normal maps by 2 texel - 1
    bool restores;     // z of a normal map follows from x and y
    bool makes_cone;   // hoist=per_light: from the angles, with a unit axis
    bool eases;        // f_cone=naive: the smooth cone is a smoothstep
    bool unified;      // the light arrays have the members of layout=unified
    bool passes_off;   // lights of intensity 0 are passed over
    const bool *maps;  // sb_ref_maps_of
    int casters;       // the first point lights cast shadows
    int taps;          // shadow lookups, a side of their square
    int size, store;   // of a shadow map: texels a side, value of the axis
    double bias;
    bool bias_slopes;
    bool per_vertex; // f_shadow=naive: distances are interpolated, and unbounded
};
struct sb_ref_choice sb_ref_choose(const struct sb_ref_shading *shading);
// SB_MAP_COUNT: which maps are read.
const bool *sb_ref_maps_of(const struct sb_variant *variant);

// --- vectors --------------------------------------------------------------------------------

static inline struct sb_vec3 sb_ref_vec(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static inline struct sb_vec3 sb_ref_product(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

// The unit vector of a zero vector is zero.
static inline struct sb_vec3 sb_ref_unit(struct sb_vec3 v)
{
    const double v2 = sb_vec3_dot(v, v);
    return v2 > 0 ? sb_vec3_scale(v, 1 / sqrt(v2)) : v;
}

// -incident + 2 (incident . normal) normal: where a ray from `incident` leaves to.
static inline struct sb_vec3 sb_ref_reflect(struct sb_vec3 incident,
                                            struct sb_vec3 normal)
{
    const struct sb_vec3 up = sb_vec3_scale(normal, 2 * sb_vec3_dot(incident, normal));
    return sb_vec3_sub(up, incident);
}

// Vectors to the axes of the world and back. The view matrix is a turn and a move; its turn
// counts as orthogonal, which in floats it is to 1e-7.
struct sb_vec3 sb_ref_to_world(const struct sb_ref_shading *shading, struct sb_vec3 v);
struct sb_vec3 sb_ref_from_world(const struct sb_ref_shading *shading, struct sb_vec3 v);

// --- the surface ----------------------------------------------------------------------------

struct sb_ref_surface {
    struct sb_vec3 position, normal;
    struct sb_vec3 view; // unit length; 0 at the eye
    double shortfall;    // 1 - |normal|^2; exactly 0 where it is a unit vector, or zero
    double shininess;
};
struct sb_ref_surface sb_ref_surface_of(const struct sb_ref_shading *shading,
                                        const struct sb_ref_choice *choice,
                                        const struct sb_ref_input *input,
                                        const struct sb_material *material);

// What a map has there, raw: as a driver sampled it, or exactly.
struct sb_vec3 sb_ref_texel(const struct sb_ref_shading *shading,
                            const struct sb_ref_input *input, enum sb_map map);

// --- one light as it arrives ----------------------------------------------------------------

struct sb_ref_incident {
    struct sb_vec3 to_light;  // to its nearest point; 0 for directional lights
    double distance;          // its length
    struct sb_vec3 direction; // unit length; 0 on the light itself
    struct sb_vec3 highlight; // as direction, to where highlights come from
    double attenuation, cone;
    bool
        in_cone; // of a hard or exponential cone: is the cosine at least the cut-off's? …
    double cone_margin; // … and by how much it is on its side
};
struct sb_ref_incident sb_ref_incident_of(const struct sb_ref_shading *shading,
                                          const struct sb_ref_choice *choice,
                                          const struct sb_ref_surface *surface,
                                          const struct sb_light *light,
                                          enum sb_light_type type);

double sb_ref_attenuation(int law, const struct sb_light *light, double distance);

// Fills incident->cone and ->in_cone from to_light and distance.
void sb_ref_cone(const struct sb_ref_choice *choice, const struct sb_light *light,
                 struct sb_ref_incident *incident);

// Vectors from the surface to the point of an area light that is nearest to it, and to the one
// that is nearest to a ray (to what is called nearest there: docs/glsl.md, area_shape). For
// boxes, to_centre and ray are along the axes of the world.
struct sb_vec3 sb_ref_area_nearest(int shape, const struct sb_light *light,
                                   struct sb_vec3 to_centre);
struct sb_vec3 sb_ref_area_nearest_ray(int shape, const struct sb_light *light,
                                       struct sb_vec3 to_centre, struct sb_vec3 ray);

// The specular factor for light from `highlight`; `intensity`: attenuation, cone and shadow,
// which a slip raises to the power too.
double sb_ref_specular(const struct sb_ref_choice *choice,
                       const struct sb_ref_surface *surface, struct sb_vec3 highlight,
                       double intensity);

// What share of the way from its specular colour F0 to white the surface reflects of light from
// `highlight` (Schlick 1994, equation 15): F = F0 + (1 - F0) (1 - |c|)^5. The cosine c is that of
// the eye to the half vector (blinn) or to the normal (phong).
double sb_ref_schlick(const struct sb_ref_choice *choice,
                      const struct sb_ref_surface *surface, struct sb_vec3 highlight);

// --- shadows --------------------------------------------------------------------------------

// Which share of the light of a caster reaches the surface, 0 to 1.
struct sb_ref_sight {
    const struct sb_light *light;
    int caster;              // its number
    struct sb_vec3 to_light; // from the surface
    struct sb_vec3 side;     // unit normal of the surface itself, not of a map
    double distance, n_dot_l;
};
double sb_ref_shown(const struct sb_ref_shading *shading,
                    const struct sb_ref_choice *choice, const struct sb_ref_sight *sight);

// The pure parts of a lookup. A texel of a shadow map: faces go XP XN YP YN ZP ZN, x and y as
// in docs/glsl.md, "Shadow maps".
struct sb_ref_texel {
    int face, x, y;
};
struct sb_ref_texel sb_ref_texel_of(struct sb_vec3 direction, int size); // not 0
// Through the texel's centre: its component along the axis of the face is 1 or -1.
struct sb_vec3 sb_ref_texel_centre(struct sb_ref_texel texel, int size);
// The directions of the lookups around `direction`: side * side of them, side up to 4.
void sb_ref_taps(int side, int size, struct sb_vec3 direction, struct sb_vec3 *tap);
double sb_ref_bias(const struct sb_ref_choice *choice, double n_dot_l);
// What a texel holds of a surface at `depth` along the axis of its face and at `distance`, both
// in units of the light's range; INFINITY: what was cleared.
double sb_ref_stored(int store, double depth, double distance);
// Is it lit? `largest`: the distance's largest component, in the same units.
bool sb_ref_passes(int store, double stored, double largest, double distance,
                   double bias);
