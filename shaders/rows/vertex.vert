// stage=vertex: each vertex is a point; what it hands on is captured, and nothing is drawn.
#include "given/rows.glsl"

VARYING_OUT P_VARYING vec2 v_uv;
highp vec2 a_uv;
highp vec3 v_position;
highp vec3 v_normal;

#define ROW_POINT gl_VertexID
#include "stage/vertex.vert"
#include "vertex_normal.glsl"
#include "given/rows_inputs.glsl"

void main()
{
    TAKE_INPUTS
    a_uv = v_uv;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    hand_over(v_position, vertex_normal(v_normal));
}
