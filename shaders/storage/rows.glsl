// In the program "rows": the lights stand in the point's row, and are put together where they
// are read.
#include "generated/row_lights.glsl"
#include "storage/filled.glsl"

Material u_material;
