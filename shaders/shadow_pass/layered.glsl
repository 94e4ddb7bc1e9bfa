// shadow_pass=layered: the geometry shader makes the six triangles.
out highp vec3 v_world;

void hand_over(highp vec3 world)
{
    v_world = world;
    gl_Position = vec4(world, 1.0);
}
