// Fragment shader of the program "lamp": not lit, of one colour.
#include "version/$(GLSL_FAMILY).glsl"

uniform P_UNIFORM vec3 u_lamp_colour;
DECLARE_O_COLOR

void main()
{
    o_color = vec4(u_lamp_colour, 1.0);
}
