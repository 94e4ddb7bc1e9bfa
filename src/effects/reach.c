#include "effects/reach.h"

static bool is(const struct sb_variant *variant, int axis, int value)
{
    return (int)variant->value[axis] == value;
}

static struct sb_vec3 vec3(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

// --- fall-off -------------------------------------------------------------------------------

// Falls: no coefficient is negative. Never more than 10000 times the colour.
static double polynomial(const struct sb_light *light, double d)
{
    const double sum = light->constant + d * (light->linear + d * light->quadratic);
    return 1 / fmax(sum, 1e-4);
}

static double windowed(const struct sb_light *light, double d)
{
    const double q = d / light->range, window = 1 - q * q * q * q;
    return q < 1 ? window * window / (d * d + 1) : 0;
}

double sb_reach_factor(const struct sb_variant *variant, const struct sb_light *light,
                       double distance)
{
    if (is(variant, SB_AXIS_WITHOUT, SB_WITHOUT_ATTENUATION))
        return 1; // what would end shines everywhere then
    if (is(variant, SB_AXIS_F_ATTENUATION, SB_F_ATTENUATION_NAIVE))
        return INFINITY;
    switch ((int)variant->value[SB_AXIS_ATTENUATION]) {
    case SB_ATTENUATION_POLYNOMIAL:
        return polynomial(light, distance);
    case SB_ATTENUATION_RADIUS:
        return fmax(1 - distance / light->range, 0);
    case SB_ATTENUATION_WINDOWED:
        return windowed(light, distance);
    default:
        return 1;
    }
}

double sb_reach_distance(const struct sb_variant *variant, const struct sb_light *light,
                         double factor)
{
    double near = 0, far = 1;
    while (far < 1e18 && sb_reach_factor(variant, light, far) >= factor)
        far *= 2;
    if (far >= 1e18)
        return INFINITY;
    for (int i = 0; i < 100; i++) {
        const double middle = (near + far) / 2;
        if (sb_reach_factor(variant, light, middle) >= factor)
            near = middle;
        else
            far = middle;
    }
    return far;
}

// From its position to its farthest point, whatever its shape has of these.
static double extent_of(const struct sb_reach_params *params)
{
    const struct sb_light *light = params->light;
    switch ((int)params->variant->value[SB_AXIS_AREA_SHAPE]) {
    case SB_AREA_SPHERE:
        return light->radius;
    case SB_AREA_TUBE:
        return sb_vec3_length(vec3(light->direction));
    case SB_AREA_BOX:
        return sb_vec3_length(vec3(light->extent));
    default:
        return light->radius + sb_vec3_length(vec3(light->direction));
    }
}

// --- colours ---------------------------------------------------------------------------------

static double largest_product(const float a[3], const float b[3])
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, (double)a[i] * (double)b[i]);
    return largest;
}

static double highlight_norm(const struct sb_variant *variant, double n)
{
    if (!is(variant, SB_AXIS_SPECULAR_NORM, SB_SPECULAR_NORM_ENERGY))
        return 1;
    return is(variant, SB_AXIS_MODEL, SB_MODEL_PHONG) ? (n + 2) / (2 * SB_PI)
                                                      : (n + 8) / (8 * SB_PI);
}

// Cosines and powers of them are 1 at most, and so are maps.
static void reflect_colours(const struct sb_reach_params *params, struct sb_reach *reach)
{
    static const float white[3] = {1, 1, 1};
    const struct sb_variant *variant = params->variant;
    const struct sb_light *light = params->light;
    const struct sb_material *material = params->material;
    const bool schlick = is(variant, SB_AXIS_FRESNEL, SB_FRESNEL_SCHLICK);
    reach->diffuse = largest_product(light->diffuse, material->diffuse);
    if (!is(variant, SB_AXIS_MODEL, SB_MODEL_LAMBERT))
        reach->specular =
            largest_product(light->specular, schlick ? white : material->specular) *
            highlight_norm(variant, material->shininess);
    if (is(variant, SB_AXIS_AMBIENT, SB_AMBIENT_PER_LIGHT))
        reach->ambient = largest_product(light->ambient, material->ambient);
}

static bool is_off(const struct sb_light *light)
{
    bool black = true;
    for (int i = 0; i < 3; i++)
        black &=
            light->ambient[i] <= 0 && light->diffuse[i] <= 0 && light->specular[i] <= 0;
    return light->intensity <= 0 || black;
}

// --- rounding --------------------------------------------------------------------------------

static double largest_coordinate(struct sb_vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

// How far positions may be off as the shader has them, from the precision of positions and the
// largest coordinate: a few of its last places.
static double rounding(const struct sb_reach_params *params)
{
    const struct sb_bounds *bounds = params->bounds;
    const double place = params->type == SB_LIGHT_DIR
                             ? 0
                             : largest_coordinate(vec3(params->light->position));
    const double largest =
        place + largest_coordinate(bounds->low) + largest_coordinate(bounds->high);
    switch ((int)params->variant->value[SB_AXIS_P_POSITION]) {
    case SB_P_POSITION_HIGHP:
        return ldexp(largest, -21);
    case SB_P_POSITION_MEDIUMP:
        return ldexp(largest, -8);
    default:
        return INFINITY; // lowp may hold no position at all
    }
}

// --- both ------------------------------------------------------------------------------------

static void set_none(struct sb_reach *reach, enum sb_reach_why why)
{
    reach->bound = reach->diffuse = reach->specular = reach->ambient = 0;
    reach->why = why;
}

static bool is_in_cone(const struct sb_reach_params *params)
{
    const struct sb_light *light = params->light;
    const double cutoff = light->cutoff;
    struct sb_bounds bounds = *params->bounds;
    bounds.radius += rounding(params);
    return params->type != SB_LIGHT_SPOT || cutoff >= (double)(float)SB_PI ||
           is(params->variant, SB_AXIS_F_CONE, SB_F_CONE_NAIVE) ||
           is(params->variant, SB_AXIS_WITHOUT, SB_WITHOUT_CONE) ||
           sb_bounds_in_cone(&bounds, vec3(light->position), vec3(light->direction),
                             cutoff + SB_PI / 180);
}

static double factor_of(const struct sb_reach_params *params, struct sb_reach *reach)
{
    if (params->type == SB_LIGHT_DIR)
        return 1;
    reach->distance = sb_bounds_distance(params->bounds, vec3(params->light->position));
    if (params->type == SB_LIGHT_AREA)
        reach->distance = fmax(reach->distance - extent_of(params), 0);
    return sb_reach_factor(params->variant, params->light,
                           fmax(0.99 * reach->distance - rounding(params), 0));
}

void sb_reach_of(const struct sb_reach_params *params, struct sb_reach *reach)
{
    *reach = (struct sb_reach){.why = SB_REACH_LIT};
    if (is_off(params->light)) {
        set_none(reach, SB_REACH_OFF);
        return;
    }
    reflect_colours(params, reach);
    const double factor = factor_of(params, reach);
    const double sum = reach->diffuse + reach->specular + reach->ambient;
    if (sum <= 0) {
        set_none(reach, SB_REACH_ABSORBED);
    } else if (factor <= 0) {
        set_none(reach, SB_REACH_OUT_OF_RANGE);
    } else if (!is_in_cone(params)) {
        set_none(reach, SB_REACH_OUT_OF_CONE);
    } else {
        // Where there is nothing, an unbounded factor makes nothing of it.
        reach->diffuse = reach->diffuse > 0 ? reach->diffuse * factor : 0;
        reach->specular = reach->specular > 0 ? reach->specular * factor : 0;
        reach->ambient = reach->ambient > 0 ? reach->ambient * factor : 0;
        reach->bound = reach->diffuse + reach->specular + reach->ambient;
    }
}
