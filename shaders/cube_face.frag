// Fragment shader of a program "rows" that tells which face of a shadow map directions of a table
// meet, and where: for the case of directions between faces. Its vertex shader is rows.vert.
#include "version/$(GLSL_FAMILY).glsl"
#include "given/rows.glsl"
#include "probe/page.glsl"
#include "probe/fragment.glsl"

DECLARE_O_COLOR

#include "shadow_map/face.glsl"

void main()
{
    row_is(int(gl_FragCoord.y) * ROW_POINTS_ACROSS + int(gl_FragCoord.x));
    P_POSITION vec3 direction = row_vec3(0);
    P_POSITION vec3 at = shadow_face(direction);
    o_color = vec4(0.0);
    probe_out(mat3x4(vec4(at, 0.0), vec4(0.0), vec4(0.0)));
}
