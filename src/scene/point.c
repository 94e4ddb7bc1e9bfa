#include "scene/point.h"

#include <assert.h>

static_assert(sizeof(struct sb_point) % sizeof(float) == 0 &&
                  sizeof(struct sb_light) % sizeof(float) == 0,
              "a row is made of floats");

enum { POINT = sizeof(struct sb_point) / sizeof(float) };
enum { LIGHT = sizeof(struct sb_light) / sizeof(float) };

#define FIELD(name, member, components, when)                                            \
    {                                                                                    \
        name, offsetof(struct sb_point, member) / sizeof(float), components, when        \
    }
#define WITH(map, others) "maps=" map "|" others "|maps=diffuse+specular+normal"

// clang-format off
const struct sb_point_field sb_point_fields[] = {
    FIELD("v_position",           position,           3, ""),
    FIELD("v_normal",             normal,             3, ""),
    FIELD("v_uv",                 uv,                 2, ""),
    FIELD("v_tangent",            tangent,            3, WITH("normal", "maps=diffuse+normal|maps=specular+normal")),
    FIELD("v_bitangent",          bitangent,          3, WITH("normal", "maps=diffuse+normal|maps=specular+normal")),
    FIELD("u_camera_position",    eye,                3, ""),
    FIELD("u_scene_ambient",      ambient,            3, "ambient=scene"),
    FIELD("u_material.ambient",   material.ambient,   3, ""),
    FIELD("u_material.diffuse",   material.diffuse,   3, ""),
    FIELD("u_material.specular",  material.specular,  3, ""),
    FIELD("u_material.shininess", material.shininess, 1, ""),
    FIELD("u_diffuse_map.rgb",    texel[SB_MAP_DIFFUSE],  3, WITH("diffuse", "maps=diffuse+specular|maps=diffuse+normal")),
    FIELD("u_specular_map.rgb",   texel[SB_MAP_SPECULAR], 3, WITH("specular", "maps=diffuse+specular|maps=specular+normal")),
    FIELD("u_normal_map.rgb",     texel[SB_MAP_NORMAL],   3, WITH("normal", "maps=diffuse+normal|maps=specular+normal")),
};
// clang-format on
const int sb_point_field_count = sizeof sb_point_fields / sizeof *sb_point_fields;

int sb_row_floats(int lights)
{
    return (POINT + lights * LIGHT + 3) / 4 * 4;
}

int sb_row_light(int i)
{
    return POINT + i * LIGHT;
}

int sb_row_member(const struct sb_light_field *field)
{
    return (int)((size_t)field->offset / sizeof(float));
}
