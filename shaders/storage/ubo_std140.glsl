// The lights in a uniform block, laid out as the C structs are. A block may not be empty.
#if NR_DIR_LIGHTS + NR_POINT_LIGHTS + NR_SPOT_LIGHTS > 0
layout(std140) uniform Lights {
#if NR_DIR_LIGHTS > 0
    DirLight u_dir[NR_DIR_LIGHTS];
#endif
#if NR_POINT_LIGHTS > 0
    PointLight u_point[NR_POINT_LIGHTS];
#endif
#if NR_SPOT_LIGHTS > 0
    SpotLight u_spot[NR_SPOT_LIGHTS];
#endif
};
#endif
