// maps=diffuse+normal.
#include "maps/d.glsl"
#include "maps/n.glsl"
