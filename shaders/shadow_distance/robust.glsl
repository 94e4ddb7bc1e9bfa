// f_shadow=robust: the place is interpolated, and its distance from the light taken for each
// fragment.
uniform P_UNIFORM vec3 u_light_position; // world space

#define CARRIED vec3

highp vec3 carried(highp vec3 world)
{
    return world;
}

P_ATTENUATION float carried_distance(P_POSITION vec3 position)
{
    P_POSITION vec3 light_position = u_light_position;
    return length(light_position - position);
}
