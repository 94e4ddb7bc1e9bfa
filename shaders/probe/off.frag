// PROBE=off, in fragment shaders of either stage: nothing is told of the maps.
#define PROBE_MAP(number, texel)
#define PROBE_PIXEL_OUT
