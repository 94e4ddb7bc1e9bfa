// shadow_pass=faces: one pass a face.
uniform highp mat4 u_face; // world to clip

out P_VARYING vec3 v_position;

void hand_over(highp vec3 world)
{
    v_position = world;
    gl_Position = u_face * vec4(world, 1.0);
}
