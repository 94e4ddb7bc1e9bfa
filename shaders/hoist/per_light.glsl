// hoist=per_light: trigonometry of the cone, map fetches and the place of the camera again for
// each light, as the source texts do. Drivers may take out of the loop what they prove to be
// the same.
GIVEN_UNIFORM P_POSITION vec3 u_camera_position; // world space; a slip reads it
uniform highp mat4 u_view_inverse;

P_POSITION vec3 eye()
{
    return (u_view_inverse * vec4(0.0, 0.0, 0.0, 1.0)).xyz;
}

P_ATTENUATION vec3 cone_axis(SpotLight light)
{
    P_VECTOR vec3 axis = light.direction;
    return unit(axis);
}

// From half a turn on there is no cone, as lights that are made once have it (src/scene/lights.h).
bool is_cone(P_ATTENUATION float cutoff)
{
    P_ATTENUATION float half_turn = 3.1415925;
    return cutoff < half_turn;
}

P_ATTENUATION float cosine_of(P_ATTENUATION float cutoff)
{
    return is_cone(cutoff) ? cos(cutoff) : -2.0;
}

// 1 - cos a = 2 sin^2(a / 2), which does not cancel.
P_ATTENUATION float inv_one_minus_cos_of(P_ATTENUATION float cutoff)
{
    P_ATTENUATION float s = sin(0.5 * cutoff);
    return is_cone(cutoff) ? 0.5 / (s * s) : 0.0;
}

// Scale and offset of the cosine, from the inner and the outer angle.
P_ATTENUATION vec2 ramp_of(P_ATTENUATION vec2 angles)
{
    P_ATTENUATION vec2 cosines = cos(angles);
    P_ATTENUATION float scale = 1.0 / max(cosines.x - cosines.y, 1.0 / 1024.0);
    return is_cone(angles.y) ? vec2(scale, -cosines.y * scale) : vec2(0.0, 1.0);
}

// Outer and inner cosine.
P_ATTENUATION vec2 edges_of(P_ATTENUATION vec2 angles)
{
    return is_cone(angles.y) ? cos(angles.yx) : vec2(-2.0, -1.0);
}

// Macros, since a light has what its cone reads and no more.
#define CONE_COS_CUTOFF(light)        cosine_of(light.cutoff)
#define CONE_INV_ONE_MINUS_COS(light) inv_one_minus_cos_of(light.cutoff)
#define CONE_RAMP(light)              ramp_of(vec2(light.inner, light.cutoff))
#define CONE_EDGES(light)             edges_of(vec2(light.inner, light.cutoff))
