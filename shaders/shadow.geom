// Geometry shader of the program "shadow" for shadow_pass=layered: one triangle into the six
// layers of a caster.
#include "version/$(GLSL_FAMILY).glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 18) out;

in highp vec3 v_world[];

#include "shadow_distance/$(F_SHADOW).glsl"

out P_VARYING CARRIED v_carried;

uniform highp mat4 u_face[6]; // world to clip
uniform highp int u_first_layer;

void main()
{
    for (int face = 0; face < 6; face++) {
        for (int i = 0; i < 3; i++) {
            // Set for every vertex: which one counts is the driver's choice, and what was
            // written is undefined after EmitVertex() (GLSL 4.60, 7.1.4 and 8.15).
            gl_Layer = u_first_layer + face;
            v_carried = carried(v_world[i]);
            gl_Position = u_face[face] * vec4(v_world[i], 1.0);
            EmitVertex();
        }
        EndPrimitive();
    }
}
