// shadow_pass=faces: one pass a face.
uniform highp mat4 u_face; // world to clip

#include "shadow_distance/$(F_SHADOW).glsl"

out P_VARYING CARRIED v_carried;

void hand_over(highp vec3 world)
{
    v_carried = carried(world);
    gl_Position = u_face * vec4(world, 1.0);
}
