// Percentage-closer filtering (Reeves, Salesin and Cook 1987): the share of the taps that are
// lit. The taps form a grid one texel wide in the plane of the face that the direction meets,
// and each is a direction of its own that picks its own face: at the edges of a face the filter
// goes on over the neighbour, in every kind of map alike.
P_ATTENUATION float shadow_filter(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                                  P_POSITION float reference)
{
    P_POSITION vec3 a = abs(direction);
    P_POSITION float m = max(a.x, max(a.y, a.z));
    P_POSITION float texel = m * (2.0 / float(SHADOW_SIZE)); // a face is 2 m wide
    P_POSITION vec3 z = vec3(0.0, 0.0, texel);
    P_POSITION vec3 s = a.z != m && a.x == m ? z : vec3(texel, 0.0, 0.0);
    P_POSITION vec3 t = a.z != m && a.x != m ? z : vec3(0.0, texel, 0.0);
    P_POSITION vec3 corner = direction - (s + t) * (0.5 * float(SHADOW_TAPS - 1));
    P_ATTENUATION float lit = 0.0;
    for (int i = 0; i < SHADOW_TAPS; i++)
        for (int j = 0; j < SHADOW_TAPS; j++)
            lit += shadow_tap(SHADOW_MAP_ARGUMENTS, corner + s * float(i) + t * float(j),
                              reference);
    return lit / float(SHADOW_TAPS * SHADOW_TAPS);
}
