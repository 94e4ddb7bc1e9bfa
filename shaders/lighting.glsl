// The lighting of one point, the same text in the vertex and in the fragment shader:
//   shade.diffuse  = material.ambient * ambient + material.diffuse * sum(diffuse)
//   shade.specular = material.specular * sum(specular)
// docs/glsl.md has the whole equation.
#include "probe/$(PROBE).glsl"
#include "unit.glsl"
#include "surface.glsl"

// What there is to read.
#include "generated/light_structs.glsl"
#include "material.glsl"
#include "storage/$(STORAGE).glsl"
#include "loop/$(LOOP).glsl"
#include "hoist/$(HOIST).glsl"
#include "space/$(SPACE).glsl"

// The formulas.
#include "guard/$(GUARD).glsl"
#include "specular_norm/$(SPECULAR_NORM).glsl"
#include "model/$(MODEL).glsl"
#include "fresnel/$(FRESNEL).glsl"
#include "ambient/$(AMBIENT).glsl"
#include "attenuation/$(ATTENUATION).glsl"
#include "cone/$(CONE).glsl"
#include "lights/terms.glsl"
#include "slips/$(SLIPS).glsl" // may put its own in place of those above

// The lights.
#include "lights/add.glsl"
#include "lights/dir.glsl"
#include "lights/point.glsl"
#include "lights/spot.glsl"
#include "layout/$(LAYOUT).glsl"

Shade shade_surface(P_POSITION vec3 position, P_VECTOR vec3 normal)
{
    fill_lights();
    Surface surface = Surface(position, normal, vec3(0.0), u_material.shininess);
    PROBE_NORMAL(surface.normal)
    IF_VIEW(surface.view = unit_difference(to_eye(position));)
    IF_VIEW(PROBE_VIEW(surface.view))
    IF_SPECULAR_NORM(log2_norm = log2(HIGHLIGHT_NORM(surface.shininess));)

    Lit lit = no_light();
    IF_AMBIENT(lit.ambient += scene_ambient();)
    add_lights(surface, lit);

    // Copies, so that the precision of the uniforms does not raise that of the products.
    P_COLOR vec3 ambient = u_material.ambient;
    P_COLOR vec3 diffuse = u_material.diffuse;
    P_COLOR vec3 specular = REFLECTED;
    Shade shade = Shade(vec3(0.0), vec3(0.0));
    IF_AMBIENT(shade.diffuse = ambient * lit.ambient;)
    IF_DIFFUSE(shade.diffuse += diffuse * lit.diffuse;)
    IF_SPECULAR(shade.specular = specular * lit.specular;)
    PROBE_OUT
    return shade;
}
