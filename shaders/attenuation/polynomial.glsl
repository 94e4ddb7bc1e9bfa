// attenuation=polynomial: 1 / (constant + linear d + quadratic d^2), the law of OpenGL's fixed
// function (OpenGL 2.1, 2.14.1).
//
// Where the constant is 0 the sum vanishes at the light, and its inverse is infinite in half
// precision from 1.5e-5 on. So a light is never more than 10000 times brighter than its colour.
P_ATTENUATION float attenuation_robust(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float slope = 0.0;
    IF_LINEAR(slope = k.y;)
    IF_QUADRATIC(slope += d * k.z;)
    return 1.0 / max(k.x + d * slope, 1e-4);
}

P_ATTENUATION float attenuation_naive(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float sum = k.x;
    IF_LINEAR(sum += k.y * d;)
    IF_QUADRATIC(sum += k.z * d * d;)
    return 1.0 / sum;
}
