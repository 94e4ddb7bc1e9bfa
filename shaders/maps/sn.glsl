// maps=specular+normal.
#include "maps/s.glsl"
#include "maps/n.glsl"
