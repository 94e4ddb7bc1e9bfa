// attenuation=polynomial: 1 / (constant + linear d + quadratic d^2), the law of OpenGL's fixed
// function (OpenGL 2.1, 2.14.1). k: the three coefficients.
//
// Where the constant is 0 the sum vanishes at the light, and its inverse is infinite in half
// precision from 1.5e-5 on. So a light is never more than 10000 times brighter than its colour.
P_ATTENUATION float attenuation(P_ATTENUATION float d, P_ATTENUATION vec3 k)
{
    return 1.0 / max(k.x + d * (k.y + d * k.z), 1e-4);
}
