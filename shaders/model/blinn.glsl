// model=blinn: cosine between the half vector and the normal (Blinn 1977). Opposite light and
// view vectors have no half vector: unit() gives zero, and no highlight.
//
// The clamp keeps pow() in its domain (a base below 0 is undefined) and a product of rounded
// unit vectors from exceeding 1, which the power would multiply: 7.4 for 1 in half precision
// at a shininess of 1024. The shininess is never 0: pow(0, 0) is undefined.
P_SPECULAR float specular_factor(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 half_vector = unit(to_light + surface.view);
    P_SPECULAR float c = dot(surface.normal, half_vector);
    return pow(clamp(c, 0.0, 1.0), surface.shininess);
}
