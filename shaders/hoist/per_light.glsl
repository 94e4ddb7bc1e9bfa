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

P_ATTENUATION float cosine_of(P_ATTENUATION float angle)
{
    return cos(angle);
}

// 1 - cos a = 2 sin^2(a / 2), which does not cancel.
P_ATTENUATION float inv_one_minus_cos_of(P_ATTENUATION float angle)
{
    P_ATTENUATION float s = sin(0.5 * angle);
    return 0.5 / (s * s);
}

// Scale and offset of the cosine, from the inner and the outer angle.
P_ATTENUATION vec2 ramp_of(P_ATTENUATION vec2 angles)
{
    P_ATTENUATION vec2 cosines = cos(angles);
    P_ATTENUATION float scale = 1.0 / max(cosines.x - cosines.y, 1.0 / 1024.0);
    return vec2(scale, -cosines.y * scale);
}

// Macros, since a light has what its cone reads and no more.
#define CONE_COS_CUTOFF(light)        cosine_of(light.cutoff)
#define CONE_INV_ONE_MINUS_COS(light) inv_one_minus_cos_of(light.cutoff)
#define CONE_RAMP(light)              ramp_of(vec2(light.inner, light.cutoff))
#define CONE_EDGES(light)             cos(vec2(light.cutoff, light.inner))
