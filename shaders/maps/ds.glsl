// maps=diffuse+specular.
#include "maps/d.glsl"
#include "maps/s.glsl"
