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
// without cancellation; scale and offset of the cosine are the ramp, the cosines of the outer
// and the inner angle its edges. Of these two a light has the one that its form reads.
#define CONE_COS_CUTOFF(light)        light.cos_cutoff
#define CONE_INV_ONE_MINUS_COS(light) light.inv_one_minus_cos
#define CONE_RAMP(light)              CONE_RAMP_$(F_CONE)(light)
#define CONE_RAMP_robust(light)       vec2(light.cone_scale, light.cone_offset)
#define CONE_RAMP_naive(light)        vec2(0.0)
#define CONE_EDGES(light)             CONE_EDGES_$(F_CONE)(light)
#define CONE_EDGES_robust(light)      vec2(0.0)
#define CONE_EDGES_naive(light)       vec2(light.cos_cutoff, light.cos_inner)
