// Lights as they are uploaded: the C structs have the std140 layout of the GLSL structs
// of the same name in shaders/lights/, so a uniform block takes them as they are. A vec3
// and the float behind it share 16 bytes (OpenGL 4.6 core, 7.6.2.2, rules 1 and 3).
//
// The field table serves whoever sets them one uniform at a time.
#pragma once

#include <stddef.h>

struct sb_dir_light {   // parallel light, not attenuated
    float direction[3]; // the way the light travels, world space; of any length but 0
    float pad0;
    float ambient[3], pad1;
    float diffuse[3], pad2;
    float specular[3], pad3;
};

struct sb_point_light {
    float position[3]; // world space
    float range;       // reach in world units; 0: unlimited
    float ambient[3];
    float constant; // 1 / (constant + linear d + quadratic d^2)
    float diffuse[3];
    float linear;
    float specular[3];
    float quadratic;
};

struct sb_spot_light { // a point light and a cone
    float position[3];
    float range;
    float ambient[3];
    float constant;
    float diffuse[3];
    float linear;
    float specular[3];
    float quadratic;
    float direction[3];      // the way the cone points, unit length
    float cos_cutoff;        // cosine of the half angle of the cone
    float exponent;          // cone=exponent: pow(cos, exponent)
    float inv_one_minus_cos; // cone=linear: 1 / (1 - cos cutoff), made in double
    float cone_scale;        // cone=smooth: clamp(cos * scale + offset, 0, 1), from inner
    float cone_offset;       // and outer cosine (Filament, LightManager::setSpotParams)
};

struct sb_lights { // counts in the order of the whole list: dir, point, spot
    const struct sb_dir_light *dir;
    const struct sb_point_light *point;
    const struct sb_spot_light *spot;
    int dir_count, point_count, spot_count;
};

enum sb_light_type { SB_LIGHT_DIR, SB_LIGHT_POINT, SB_LIGHT_SPOT, SB_LIGHT_TYPE_COUNT };

// The values a field may have; the words for them stand in validate.c.
enum sb_field_range { SB_FINITE, SB_NOT_NEGATIVE, SB_COSINE, SB_SHININESS };

struct sb_light_field { // one GLSL member
    const char *name;   // "diffuse"
    int offset, components;
    enum sb_field_range range;
};
struct sb_light_type_row {
    const char *name;                   // "point light", for messages
    const char *array;                  // "u_point": the GLSL array
    size_t size;                        // of the struct
    const struct sb_light_field *field; // every member, in order, padding included
    int field_count;
    int axis; // SB_AXIS_POINT
};
extern const struct sb_light_type_row sb_light_types[SB_LIGHT_TYPE_COUNT];

// The array and count of one type.
const void *sb_lights_of(const struct sb_lights *lights, enum sb_light_type type,
                         int *count);

// Sets every member that follows from the half angles of the cone, in radians, computed
// in double: 1 - cos(outer) in float would lose what a narrow cone is made of. 0 <= inner
// <= outer, 0 < outer < pi.
void sb_spot_light_set_cone(struct sb_spot_light *light, double inner, double outer);
