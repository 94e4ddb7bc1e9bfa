// space=view: what the vertex shader hands to the lighting. The normal matrix leads to view
// space by itself.
uniform highp mat4 u_view;

highp vec3 lit_position(highp vec4 world)
{
    return (u_view * world).xyz;
}

highp vec3 lit_direction(highp vec3 world) // w = 0: not translated
{
    return (u_view * vec4(world, 0.0)).xyz;
}
