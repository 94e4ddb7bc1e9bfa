// Adds one light to the sums.
#include "specular_side/$(SPECULAR_SIDE).glsl"

P_VECTOR vec3 view_of(Surface surface)
{
    IF_VIEW_EACH(surface.view = unit_difference(to_eye(surface.position));)
    return surface.view;
}

#include "guard/$(GUARD)_sides.glsl"

void add_light(Surface surface, Incident light, inout Lit lit)
{
    IF_AMBIENT(add_ambient(light, lit);)
    P_VECTOR float n_dot_l = dot(surface.normal, light.direction);
    add_sides(surface, light, n_dot_l, lit);
}
