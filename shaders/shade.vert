// Vertex shader of the program "shade": puts the geometry in its place and hands the surface
// to the stage that lights it. The geometry is highp in every variant: not it is on trial, and
// every variant covers the same pixels.
#include "version/$(GLSL_FAMILY).glsl"

ATTRIBUTE highp vec3 a_position;
ATTRIBUTE highp vec3 a_normal;
ATTRIBUTE highp vec2 a_uv;

uniform highp mat4 u_model;
uniform highp mat3 u_normal_matrix;
uniform highp mat4 u_view_projection;

VARYING_OUT P_VARYING vec2 v_uv; // the linker drops it where no map reads it

#include "stage/$(STAGE).vert"

void main()
{
    highp vec4 world = u_model * vec4(a_position, 1.0);
    gl_Position = u_view_projection * world;
    v_uv = a_uv;

    // A zero normal (the tip of a cone, a collapsed triangle) stays zero, and so unlit, where
    // normalize() gives NaN and blackens every triangle around the vertex.
    highp vec3 normal = u_normal_matrix * a_normal;
    highp float n2 = dot(normal, normal);
    hand_over(world.xyz, n2 > 0.0 ? normal * inversesqrt(n2) : normal);
}
