// The slips of `shadows` (docs/sources.md).

// The intensity, shadow included, stands inside the power and again outside: I^(n + 1).
void slip_add_specular(Surface surface, Incident light, inout Lit lit)
{
    P_ATTENUATION float intensity = light.factor * light.shown;
    P_SPECULAR float c = dot(reflect(-light.highlight, surface.normal), view_of(surface));
    P_SPECULAR float factor = pow(max(c * intensity, 0.0), surface.shininess);
    P_COLOR float weight = intensity * factor;
    PROBE_TERM(TERM_SPECULAR, factor)
    PROBE_TERM(TERM_SPECULAR_WEIGHT, weight)
    P_SUM vec3 added = light.specular * weight;
    IF_SPECULAR_MAP_EACH(added *= specular_map(v_uv);)
    lit.specular += added;
}
#define add_specular slip_add_specular

// The colour of the surface tints highlights: IF_TINTED in shaders/shade.frag.

// The shadow is looked up twice for each light.
#if NR_SHADOWS > 0
#define CASTER_LOOKUPS(i) min(CASTER_SHOWN(i), CASTER_SHOWN(i))
#endif
