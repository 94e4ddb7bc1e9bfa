// Fragment shader of the program "shade": light that leaves the surface, times the maps that
// the lights have not applied already (hoist).
#include "version/$(GLSL_FAMILY).glsl"

VARYING_IN P_VARYING vec2 v_uv;
DECLARE_O_COLOR

#include "probe/$(PROBE).frag"
#include "maps/$(MAPS).glsl"
#include "stage/$(STAGE).frag"

void main()
{
    Shade shade = shade_here();
    IF_DIFFUSE_MAP(shade.diffuse *= diffuse_map(v_uv);)
    IF_SPECULAR_MAP(shade.specular *= specular_map(v_uv);)
    IF_TINTED(shade.specular *= diffuse_map(v_uv);)
    IF_SPECULAR(shade.diffuse += shade.specular;)
    o_color = vec4(shade.diffuse, 1.0);
    PROBE_PIXEL_OUT
}
