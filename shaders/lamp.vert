// Vertex shader of the program "lamp": a cube that shows where a light is.
#include "version/$(GLSL_FAMILY).glsl"

ATTRIBUTE highp vec3 a_position;

uniform highp mat4 u_model;
uniform highp mat4 u_view_projection;

void main()
{
    gl_Position = u_view_projection * (u_model * vec4(a_position, 1.0));
}
