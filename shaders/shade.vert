// Vertex shader of the program "shade": puts the geometry in its place and hands the surface
// to the stage that lights it. The geometry is highp in every variant: not it is on trial, and
// every variant covers the same pixels.
#include "version/$(GLSL_FAMILY).glsl"
#include "given/$(GIVEN).glsl"
#include "generated/switches.glsl"

ATTRIBUTE highp vec3 a_position;
ATTRIBUTE highp vec3 a_normal;
ATTRIBUTE highp vec2 a_uv;
ATTRIBUTE highp vec4 a_tangent; // w: sign of the bitangent

uniform highp mat4 u_model;
uniform highp mat3 u_normal_matrix; // to the space of the lighting
uniform highp mat4 u_view_projection;

VARYING_OUT P_VARYING vec2 v_uv; // the linker drops it where no map reads it

#include "space/$(SPACE).vert"
#include "stage/$(STAGE).vert"
#include "vertex_normal.glsl"

void main()
{
    highp vec4 world = u_model * vec4(a_position, 1.0);
    gl_Position = u_view_projection * world;
    v_uv = a_uv;

    highp vec3 normal = vertex_normal(u_normal_matrix * a_normal);
    hand_over(lit_position(world), normal);
    IF_NORMAL_MAP(hand_over_frame(normal, lit_direction(mat3(u_model) * a_tangent.xyz));)
}
