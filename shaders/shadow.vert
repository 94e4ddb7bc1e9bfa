// Vertex shader of the program "shadow", which draws the scene as a point light sees it.
#include "version/$(GLSL_FAMILY).glsl"

ATTRIBUTE highp vec3 a_position;

uniform highp mat4 u_model;

#include "shadow_pass/$(SHADOW_PASS).glsl"

void main()
{
    hand_over((u_model * vec4(a_position, 1.0)).xyz);
}
