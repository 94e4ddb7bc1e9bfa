// A point and all that it is lit by, apart from any scene: a row of the table that the program
// "rows" reads (shaders/given/rows.glsl). World space. Floats only, so that a row is the structs
// themselves: one sb_point, then an sb_light for each light of the variant, in the order of its list.
#pragma once

#include "scene/scene.h"

struct sb_point {
    float position[3];
    float normal[3]; // as interpolated, of any length
    float eye[3];
    float uv[2];
    float tangent[3], bitangent[3]; // as interpolated
    float ambient[3];               // the scene's ambient light
    struct sb_material material;
    float texel[SB_MAP_COUNT][3]; // what lookups in the maps give, in [0, 1]
};

// The GLSL variables that the members are put into, and under which condition.
struct sb_point_field {
    const char *name; // "v_position", "u_material.diffuse"
    int place;        // of its first float in the row
    int components;
    const char *when; // "": always
};
extern const struct sb_point_field sb_point_fields[];
extern const int sb_point_field_count;

// Floats of a row, which are padded to whole texels of four …
int sb_row_floats(int lights);
// … and where in it light number i starts, and one of its members lies.
int sb_row_light(int i);
int sb_row_member(const struct sb_light_field *field);
