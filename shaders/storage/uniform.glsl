// The lights as plain uniforms.
#if NR_DIR_LIGHTS > 0
uniform DirLight u_dir[NR_DIR_LIGHTS];
#endif
#if NR_POINT_LIGHTS > 0
uniform PointLight u_point[NR_POINT_LIGHTS];
#endif
#if NR_SPOT_LIGHTS > 0
uniform SpotLight u_spot[NR_SPOT_LIGHTS];
#endif
