// model=blinn: cosine between the half vector and the normal (Blinn 1977). Opposite light and
// view vectors have no half vector: unit() gives zero, and no highlight.
//
// The upper clamp keeps a product of rounded unit vectors from exceeding 1, which the power
// would multiply: 7.4 for 1 in half precision at a shininess of 1024. The lower one keeps
// pow() in its domain: a base below 0 is undefined. The shininess is never 0: so is pow(0, 0).

// What is read of a light.
#define SPECULAR_OF(light) light.specular

P_SPECULAR float specular_factor_robust(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 half_vector = unit(to_light + view_of(surface));
    P_SPECULAR float c = dot(surface.normal, half_vector);
    return pow(clamp(c, 0.0, 1.0), surface.shininess);
}

P_SPECULAR float specular_factor_naive(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 half_vector = unit(to_light + view_of(surface));
    P_SPECULAR float c = dot(surface.normal, half_vector);
    return pow(max(c, 0.0), surface.shininess);
}
