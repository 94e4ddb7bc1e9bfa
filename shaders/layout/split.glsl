// layout=split: a loop for each type of light.
#include "lights/area.glsl"

#if MAX_DIR_LIGHTS > 0
#define ADD_DIR(i) add_light(surface, dir_incident(DIR_LIGHT(i)), lit);
void add_dir_lights(Surface surface, inout Lit lit)
{
    EACH_DIR(ADD_DIR)
}
#else
void add_dir_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_POINT_LIGHTS > 0
#include "layout/casters.glsl"
#define ADD_POINT(i) add_light(surface, point_incident(POINT_LIGHT(i), surface.position), lit);
void add_point_lights(Surface surface, inout Lit lit)
{
    add_casters(surface, lit);
    EACH_POINT(ADD_POINT)
}
#else
void add_point_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_SPOT_LIGHTS > 0
#define ADD_SPOT(i) add_light(surface, spot_incident(SPOT_LIGHT(i), surface.position), lit);
void add_spot_lights(Surface surface, inout Lit lit)
{
    EACH_SPOT(ADD_SPOT)
}
#else
void add_spot_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_AREA_LIGHTS > 0
#define ADD_AREA(i) add_light(surface, area_incident(AREA_LIGHT(i), surface), lit);
void add_area_lights(Surface surface, inout Lit lit)
{
    EACH_AREA(ADD_AREA)
}
#else
void add_area_lights(Surface surface, inout Lit lit)
{
}
#endif

void add_lights(Surface surface, inout Lit lit)
{
    add_dir_lights(surface, lit);
    add_point_lights(surface, lit);
    add_spot_lights(surface, lit);
    add_area_lights(surface, lit);
}
