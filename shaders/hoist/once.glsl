// hoist=once: what is the same for all fragments comes from the CPU; what is the same for all
// lights is made before the first (the rest of this axis: IF_VIEW, IF_DIFFUSE_MAP and their
// like in src/effects/effects.def).
GIVEN_UNIFORM P_POSITION vec3 u_camera_position; // world space

P_POSITION vec3 eye()
{
    return u_camera_position;
}

P_ATTENUATION vec3 cone_axis(SpotLight light)
{
    return light.direction;
}

// Macros, since a light has what its cone reads and no more. The inverse is made in double,
// without cancellation; scale and offset of the cosine are the ramp.
#define CONE_COS_CUTOFF(light)        light.cos_cutoff
#define CONE_INV_ONE_MINUS_COS(light) light.inv_one_minus_cos
#define CONE_RAMP(light)              vec2(light.cone_scale, light.cone_offset)
