// The cone of a spot light. For narrow cones 1 - cos is what counts, and what a cosine in
// double has lost: at 0.02 degrees nine of its sixteen digits. So cosines are kept as 1 - cos,
// made from Lagrange's identity: sin^2 a = |d x axis|^2 / (|d|^2 |axis|^2), and
// 1 - cos a = sin^2 a / (1 + cos a).
#include "reference/parts.h"

// The angle between the axis and the way from the light to the surface.
struct angle {
    double cos, one_minus_cos; // of the angle itself
    // What the shader has for them: with hoist=once the axis is as uploaded, rounded to floats,
    // and the product as much longer or shorter as it is.
    double product, one_minus_product;
};

// |axis|^2 - 1, which a ramp multiplies by up to 1024. The squares of floats are exact in double,
// and so are sums with what they round (Knuth's TwoSum).
static double plus(double a, double b, double *rounded)
{
    const double sum = a + b, of_b = sum - a;
    *rounded += (a - (sum - of_b)) + (b - of_b);
    return sum;
}

static double square_less_one(struct sb_vec3 axis)
{
    double rounded = 0;
    double sum = plus(axis.x * axis.x, -1, &rounded);
    sum = plus(sum, axis.y * axis.y, &rounded);
    sum = plus(sum, axis.z * axis.z, &rounded);
    return sum + rounded;
}

static struct angle angle_of(const struct sb_ref_choice *choice,
                             const struct sb_light *light,
                             const struct sb_ref_incident *incident)
{
    const struct sb_vec3 axis = sb_ref_vec(light->direction);
    const double axis2 = sb_vec3_dot(axis, axis), d = incident->distance;
    if (!(d > 0 && axis2 > 0)) // a zero vector: its products are 0
        return (struct angle){0, 1, 0, 1};
    const struct sb_vec3 across = sb_vec3_cross(incident->to_light, axis);
    const double length = sqrt(axis2);
    const double sin2 = sb_vec3_dot(across, across) / (d * d * axis2);
    const double c = -sb_vec3_dot(incident->to_light, axis) / (d * length);
    const double rest = c > 0 ? sin2 / (1 + c) : 1 - c;
    // |axis| - 1
    const double excess = choice->makes_cone ? 0 : square_less_one(axis) / (length + 1);
    return (struct angle){c, rest, c + excess * c, rest - excess * c};
}

// The float next to a quarter turn is a little more, and stands for it.
static double cut_off(const struct sb_light *light)
{
    return light->cutoff == (float)(SB_PI / 2) ? SB_PI / 2 : light->cutoff;
}

static double one_minus_cut_off(const struct sb_ref_choice *choice,
                                const struct sb_light *light)
{
    if (!choice->makes_cone)
        return 1 - (double)light->cos_cutoff;
    if (cut_off(light) ==
        SB_PI / 2) // exactly: what is level with the light is decided by it
        return 1;
    const double half = sin(0.5 * cut_off(light));
    return 2 * half * half;
}

// cos inner - cos outer = 2 sin((outer + inner) / 2) sin((outer - inner) / 2)
static double inner_less_outer(const struct sb_light *light)
{
    const double outer = cut_off(light), inner = light->inner;
    return 2 * sin(0.5 * (outer + inner)) * sin(0.5 * (outer - inner));
}

// cos^exponent with the cosine clamped to [1e-4, 1]. OpenGL 2.1, 2.14.1. Of the angle itself: the
// length of a rounded axis would count as often as the exponent says.
static double exponent(const struct sb_light *light, const struct angle *angle)
{
    const double log_cos =
        angle->cos > 0.5 ? log1p(-angle->one_minus_cos) : log(fmax(angle->cos, 1e-4));
    return exp(light->exponent * log_cos);
}

static double linear(const struct sb_ref_choice *choice, const struct sb_light *light,
                     const struct angle *angle)
{
    const double share = choice->makes_cone
                             ? angle->one_minus_cos / one_minus_cut_off(choice, light)
                             : angle->one_minus_cos * light->inv_one_minus_cos;
    return fmax(1 - share, 0);
}

// A smoothstep of the cosine: equal edges are a step.
static double eased(const struct sb_ref_choice *choice, const struct sb_light *light,
                    const struct angle *angle)
{
    const double inside = one_minus_cut_off(choice, light) - angle->one_minus_product;
    const double width = choice->makes_cone
                             ? inner_less_outer(light)
                             : (double)light->cos_inner - (double)light->cos_cutoff;
    const double t = width > 0 ? fmin(fmax(inside / width, 0), 1) : inside >= 0;
    return t * t * (3 - 2 * t);
}

// A ramp of the cosine with a bounded divisor (Filament, LightManager::setSpotParams). With
// cos a = 1 - x the sum of scale and offset is made first, in which they cancel exactly or to
// the last bit.
static double smooth(const struct sb_ref_choice *choice, const struct sb_light *light,
                     const struct angle *angle)
{
    const double rest = angle->one_minus_product;
    double ramp;
    if (choice->makes_cone) {
        ramp = (one_minus_cut_off(choice, light) - rest) /
               fmax(inner_less_outer(light), 1.0 / 1024);
    } else {
        const double scale = light->cone_scale, offset = light->cone_offset;
        ramp = (scale + offset) - rest * scale;
    }
    return fmin(fmax(ramp, 0), 1);
}

void sb_ref_cone(const struct sb_ref_choice *choice, const struct sb_light *light,
                 struct sb_ref_incident *incident)
{
    const struct angle angle = angle_of(choice, light, incident);
    if (light->cutoff >= (float)SB_PI) { // no cone
        incident->in_cone = true;
        incident->cone = 1;
        incident->cone_margin = INFINITY;
        return;
    }
    switch (choice->cone) {
    case SB_CONE_LINEAR:
        incident->cone = linear(choice, light, &angle);
        return;
    case SB_CONE_SMOOTH:
        incident->cone =
            choice->eases ? eased(choice, light, &angle) : smooth(choice, light, &angle);
        return;
    default:
        incident->cone_margin =
            fabs(one_minus_cut_off(choice, light) - angle.one_minus_product);
        incident->in_cone = angle.one_minus_product <= one_minus_cut_off(choice, light);
        incident->cone = !incident->in_cone             ? 0
                         : choice->cone == SB_CONE_HARD ? 1
                                                        : exponent(light, &angle);
    }
}
