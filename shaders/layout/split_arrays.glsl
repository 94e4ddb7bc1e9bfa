// The light arrays of layout=split, declared by LIGHT_ARRAY(type, name, size) of the storage.
#if MAX_DIR_LIGHTS > 0
LIGHT_ARRAY(DirLight, u_dir, MAX_DIR_LIGHTS)
#endif
#if MAX_POINT_LIGHTS > 0
LIGHT_ARRAY(PointLight, u_point, MAX_POINT_LIGHTS)
#endif
#if MAX_SPOT_LIGHTS > 0
LIGHT_ARRAY(SpotLight, u_spot, MAX_SPOT_LIGHTS)
#endif
#if MAX_AREA_LIGHTS > 0
LIGHT_ARRAY(AreaLight, u_area, MAX_AREA_LIGHTS)
#endif
