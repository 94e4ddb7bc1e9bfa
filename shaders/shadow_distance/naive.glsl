// f_shadow=naive: the distance is taken at the vertices and interpolated. It is not linear over
// a triangle: in the middle of an edge that the light sees under 90 degrees it is 41 % too far.
uniform P_UNIFORM vec3 u_light_position; // world space

#define CARRIED float

highp float carried(highp vec3 world)
{
    highp vec3 light_position = u_light_position;
    return length(light_position - world);
}

P_ATTENUATION float carried_distance(P_POSITION float d)
{
    return d;
}
