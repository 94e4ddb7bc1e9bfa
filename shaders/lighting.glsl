// The lighting of one point, the same text in the vertex and in the fragment shader:
//   shade.diffuse  = material.ambient * ambient + material.diffuse * sum(diffuse)
//   shade.specular = material.specular * sum(specular)
// docs/glsl.md has the whole equation.
#include "unit.glsl"
#include "surface.glsl"
#include "lights/structs.glsl"
#include "storage/$(STORAGE).glsl"
#include "model/$(MODEL).glsl"
#include "ambient/$(AMBIENT).glsl"
#include "attenuation/$(ATTENUATION).glsl"
#include "cone/$(CONE).glsl"
#include "lights/add.glsl"
#include "lights/dir.glsl"
#include "lights/point.glsl"
#include "lights/spot.glsl"

struct Material {
    P_UNIFORM vec3 ambient;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM vec3 specular;
    P_UNIFORM float shininess;
};
uniform Material u_material;
uniform P_POSITION vec3 u_camera_position;

Shade shade_surface(P_POSITION vec3 position, P_VECTOR vec3 normal)
{
    Surface surface = Surface(position, normal, vec3(0.0), u_material.shininess);
    IF_SPECULAR(surface.view = unit_difference(u_camera_position - position);)

    Lit lit = Lit(vec3(0.0), vec3(0.0), vec3(0.0));
    IF_AMBIENT(lit.ambient = scene_ambient();)
    add_dir_lights(surface, lit);
    add_point_lights(surface, lit);
    add_spot_lights(surface, lit);

    // Copies, so that the precision of the uniforms does not raise that of the products.
    P_COLOR vec3 ambient = u_material.ambient;
    P_COLOR vec3 diffuse = u_material.diffuse;
    P_COLOR vec3 specular = u_material.specular;
    Shade shade = Shade(vec3(0.0), vec3(0.0));
    IF_AMBIENT(shade.diffuse = ambient * lit.ambient;)
    IF_DIFFUSE(shade.diffuse += diffuse * lit.diffuse;)
    IF_SPECULAR(shade.specular = specular * lit.specular;)
    return shade;
}
