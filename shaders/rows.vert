// Vertex shader of the program "rows": lights points of a table, where "shade" lights those of a
// scene. No mesh, no camera.
#include "version/$(GLSL_FAMILY).glsl"
#include "rows/$(STAGE).vert"
