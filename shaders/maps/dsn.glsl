// maps=diffuse+specular+normal.
#include "maps/d.glsl"
#include "maps/s.glsl"
#include "maps/n.glsl"
