// cone=linear: 1 - (1 - cos a) / (1 - cos cut-off), the law of the LWJGL book.
//
// For narrow cones 1 - cos a cancels: with a cut-off of 0.1 degrees it has an error of 0.17 in
// highp, and with 10 degrees 0.15 in half precision. Lagrange's identity has the same value
// without the subtraction: sin^2 a = |l x axis|^2 for unit vectors, and
// 1 - cos a = sin^2 a / (1 + cos a). Behind the light (cones wider than 90 degrees) that
// quotient is the one that fails, and the plain form is exact.
P_ATTENUATION float cone(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec3 axis = light.direction;
    P_ATTENUATION float k = light.inv_one_minus_cos; // made in double, without cancellation
    P_ATTENUATION float cos_a = dot(from_light, axis);
    P_ATTENUATION vec3 c = cross(from_light, axis);
    P_ATTENUATION float one_minus_cos =
        cos_a > 0.0 ? dot(c, c) / (1.0 + cos_a) : 1.0 - cos_a;
    return max(1.0 - one_minus_cos * k, 0.0);
}
