// Fragment shader of the program "shade": light that leaves the surface, times the maps that
// the lights have not applied already (hoist).
#include "version/$(GLSL_FAMILY).glsl"
#include "given/$(GIVEN).glsl"
#include "generated/switches.glsl"

GIVEN_INPUT P_VARYING vec2 v_uv;
DECLARE_O_COLOR

#include "probe/$(PROBE).frag"
#include "maps/$(MAPS).glsl"
#include "stage/$(STAGE).frag"
#include "output.glsl"

#define ROW_POINT int(gl_FragCoord.y) * ROW_POINTS_ACROSS + int(gl_FragCoord.x)
#include "given/$(GIVEN)_inputs.glsl"

void main()
{
    TAKE_INPUTS
    Shade shade = shade_here();
    IF_DIFFUSE_MAP(shade.diffuse *= diffuse_map(v_uv);)
    IF_SPECULAR_MAP(shade.specular *= specular_map(v_uv);)
    IF_TINTED(shade.specular *= diffuse_map(v_uv);)
    IF_SPECULAR(shade.diffuse += shade.specular;)
    IF_NARROW_OUTPUT(shade.diffuse = output_colour(shade.diffuse);)
    o_color = vec4(shade.diffuse, 1.0);
    PROBE_PIXEL_OUT
}
