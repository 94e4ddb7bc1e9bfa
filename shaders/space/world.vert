// space=world: what the vertex shader hands to the lighting.
highp vec3 lit_position(highp vec4 world)
{
    return world.xyz;
}

highp vec3 lit_direction(highp vec3 world)
{
    return world;
}
