// The light array of layout=unified, declared by LIGHT_ARRAY(type, name, size) of the storage.
#if MAX_LIGHTS > 0
LIGHT_ARRAY(Light, u_light, MAX_LIGHTS)
#endif
