// Adds one light to the sums.
#include "specular_side/$(SPECULAR_SIDE).glsl"

P_VECTOR vec3 view_of(Surface surface)
{
    IF_VIEW_EACH(surface.view = unit_difference(to_eye(surface.position));)
    IF_VIEW_EACH(PROBE_VIEW(surface.view))
    return surface.view;
}

#include "guard/$(GUARD)_sides.glsl"

void add_light(Surface surface, Incident light, inout Lit lit)
{
    IF_AMBIENT(add_ambient(light, lit);)
    P_VECTOR float n_dot_l = dot(surface.normal, light.direction);
    PROBE_TERM(TERM_N_DOT_L, n_dot_l)
    add_sides(surface, light, n_dot_l, lit);
    PROBE_NEXT_LIGHT
}
