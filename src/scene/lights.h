// Lights as they are uploaded. In C one struct serves every type; a table says which of its
// members the GLSL struct of a type has, in what order, and so whoever sets, prints or checks
// lights goes through the table, one member at a time.
#pragma once

#include <stddef.h>

#include "axis/variant.h"

struct sb_light {
    float position[3]; // world space; of an area light the centre
    float w; // layout=unified: 0 for directional lights, whose position is the unit
             // vector to the light; else 1
    // The way the light travels (directional, of any length but 0), the cone points (spot,
    // unit length), or the segment runs (tube, capsule: half its length, any).
    float direction[3];
    float
        range; // reach in world units; 0: unlimited, and never 0 where the attenuation needs it
    float intensity; // 0: off. The colours hold it already; a padded loop asks for it
    float ambient[3], diffuse[3], specular[3];
    float constant, linear, quadratic; // 1 / (constant + linear d + quadratic d^2)
    float cutoff, inner; // half angles of the cone, radians; cutoff pi: no cone
    float cos_cutoff, cos_inner;
    float exponent;          // cone=exponent: pow(cos, exponent)
    float inv_one_minus_cos; // cone=linear: 1 / (1 - cos cutoff), made in double
    float cone_scale;        // cone=smooth: clamp(cos * scale + offset, 0, 1), from inner
    float cone_offset;       // and outer cosine (Filament, LightManager::setSpotParams)
    float radius;            // of an area light (sphere, capsule), world units
    float extent[3];         // half sides of a box along the axes of the world
};

// The types, in the order of the whole list of a scene.
enum sb_light_type {
    SB_LIGHT_DIR,
    SB_LIGHT_POINT,
    SB_LIGHT_SPOT,
    SB_LIGHT_AREA,
    SB_LIGHT_TYPE_COUNT
};

struct sb_lights {
    const struct sb_light *light; // all types, one after another
    int count[SB_LIGHT_TYPE_COUNT];
};

// The lights of one type, and how many.
const struct sb_light *sb_lights_of(const struct sb_lights *lights,
                                    enum sb_light_type type, int *count);
int sb_lights_total(const struct sb_lights *lights);

// How many lights of a type shine in a scene of this variant: as many as its axis says, but
// for a sun that is below the horizon.
int sb_lights_shining(const struct sb_variant *variant, enum sb_light_type type);

// Elements of the arrays that shaders keep them in: where the loop goes by a number that is
// uploaded, or skips what is off, there may be more than shine.
int sb_lights_slots(const struct sb_variant *variant, enum sb_light_type type);

// The same of layout=unified, which has one array for all types.
int sb_lights_unified_slots(const struct sb_variant *variant);

// --- the GLSL structs ------------------------------------------------------------------

// The values a field may have; the words for them stand in validate.c.
enum sb_field_range {
    SB_FINITE,
    SB_PLACE, // a coordinate, at most 1e18: so that squares of distances are floats
    SB_NOT_NEGATIVE,
    SB_COSINE,
    SB_HALF_ANGLE,
    SB_SHININESS
};

struct sb_light_field { // one GLSL member
    const char *name;   // "diffuse", in C too
    int offset, components;
    enum sb_field_range range;
    const char *when; // the condition under which a shader has it; "": always
};
struct sb_light_struct {                // one GLSL struct
    const char *name;                   // "point light", for messages
    const char *type;                   // "PointLight": the GLSL struct
    const char *element;                // "POINT_LIGHT": the GLSL macro of one of them
    const char *array;                  // "u_point": the GLSL array
    const char *count;                  // "u_point_count": the uniform of loop=dynamic
    const struct sb_light_field *field; // every member that there may be, in order
    int field_count;
    int axis; // SB_AXIS_POINT; -1 for the unified struct
};
// By type, and behind them the one that serves all types of layout=unified.
enum { SB_LIGHT_UNIFIED = SB_LIGHT_TYPE_COUNT, SB_LIGHT_STRUCT_COUNT };
extern const struct sb_light_struct sb_light_structs[SB_LIGHT_STRUCT_COUNT];

// The row of `sb_light_structs` that a light of this type is uploaded as.
int sb_light_struct_of(const struct sb_variant *variant, enum sb_light_type type);

// The members that the shaders of a variant can read: of the struct's fields those whose
// condition holds, in order. What is declared, uploaded, counted and laid out is these.
enum { SB_LIGHT_FIELD_MAX = 19 };
struct sb_light_members {
    const struct sb_light_field *field[SB_LIGHT_FIELD_MAX];
    int count;
};
void sb_light_members_of(const struct sb_light_struct *row,
                         const struct sb_variant *variant,
                         struct sb_light_members *members);

// Bytes of an array element in std140, and where its member `number` lies (OpenGL 4.6 core,
// 7.6.2.2, rules 1, 3, 9 and 10).
size_t sb_light_std140_size(const struct sb_light_members *members);
size_t sb_light_std140_offset(const struct sb_light_members *members, int number);

// --- making them -----------------------------------------------------------------------

// Sets every member that follows from the half angles of the cone, in radians, computed
// in double: 1 - cos(outer) in float would lose what a narrow cone is made of. 0 < outer; of an
// outer angle of 0 the cosine is 1, which sb_scene_validate refuses. An inner angle that is not
// the smaller makes the steepest ramp that there is, which ends at the outer one. A quarter turn
// has the cosine 0. From half a turn on there is no cone, and no exponent (OpenGL 2.1, equation
// 2.8): the share is 1 everywhere, on the axis behind the light too.
#define SB_COS_NO_CONE (-2.0f) // less than all that rounding makes of -1
void sb_light_set_cone(struct sb_light *light, double inner, double outer);

// Turns a light of any type into what layout=unified tells types apart by: w, and the cut-off
// angle.
struct sb_light sb_light_unified(const struct sb_light *light, enum sb_light_type type);

// --- as a variant has them -------------------------------------------------------------

struct sb_camera; // scene.h

// A light of world space in view space: positions with w = 1, directions with w = 0, in
// double from the floats of camera->view. `keep_sun`: directional lights stay as they are.
// The half sides of a box stay along the axes of the world.
struct sb_light sb_light_to_view(const struct sb_light *light, enum sb_light_type type,
                                 const struct sb_camera *camera, bool keep_sun);

// A light of the scene as a variant's shaders have it, whether uploaded or written into
// them: in the variant's space (of which text=as_written of source=lwjgl forgets the
// directional lights), and for layout=unified with what tells the types apart.
struct sb_light sb_light_as_lit(const struct sb_light *light, enum sb_light_type type,
                                const struct sb_variant *variant,
                                const struct sb_camera *camera);

// --- moving them -----------------------------------------------------------------------

// The lights of a scene that moves: places on a small circle, and directional lights turned a
// little further about z. After SB_PHASES of them all comes again.
enum { SB_PHASES = 8 };

struct sb_phase {
    int number;       // 0 to SB_PHASES - 1; 0 is the scene's own lights, bit for bit
    int still_points; // the first point lights that stay where they are
    double scale;     // of the world (axis `scale`)
};
// Writes as many lights as `lights` has, in the same order.
void sb_lights_phase(const struct sb_lights *lights, const struct sb_phase *phase,
                     struct sb_light *out);
