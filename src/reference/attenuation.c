#include "reference/parts.h"

// OpenGL 2.1, 2.14.1; a light is never more than 10000 times brighter than its colour.
static double polynomial(const struct sb_light *light, double d)
{
    const double sum = light->constant + d * (light->linear + d * light->quadratic);
    return 1 / fmax(sum, 1e-4);
}

// Karis 2013, "Real shading in Unreal Engine 4", equation 9, with
// 1 - q^4 = (1 - q)(1 + q)(1 + q^2).
static double windowed(const struct sb_light *light, double d)
{
    const double range = light->range;
    if (d >= range)
        return 0;
    const double q = d / range;
    const double window = (range - d) / range * (1 + q) * (1 + q * q);
    return window * window / (d * d + 1);
}

double sb_ref_attenuation(int law, const struct sb_light *light, double distance)
{
    const double range = light->range;
    switch (law) {
    case SB_ATTENUATION_POLYNOMIAL:
        return polynomial(light, distance);
    case SB_ATTENUATION_RADIUS:
        return distance < range ? (range - distance) / range : 0;
    case SB_ATTENUATION_WINDOWED:
        return windowed(light, distance);
    default:
        return 1;
    }
}
