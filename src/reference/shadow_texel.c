// Which texels of a shadow map a lookup asks, and what each holds: docs/glsl.md, "Shadow maps".
// All kinds of map divide the directions into the same texels.
#include "reference/parts.h"

enum { XP, XN, YP, YN, ZP, ZN };
#define NEAR 1e-3 // near plane of a face, in units of the light's range

static double largest(struct sb_vec3 v)
{
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

// The cell of a face from -m to m.
static int cell_of(double at, double m, int size)
{
    const int cell = (int)floor((at + m) * size / (2 * m));
    return cell < 0 ? 0 : cell >= size ? size - 1 : cell;
}

// Where components are equal, z goes before x before y.
struct sb_ref_texel sb_ref_texel_of(struct sb_vec3 d, int size)
{
    const double m = largest(d);
    double x, y;
    int face;
    if (fabs(d.z) == m) {
        face = d.z > 0 ? ZP : ZN;
        x = d.z > 0 ? -d.x : d.x;
        y = d.y;
    } else if (fabs(d.x) == m) {
        face = d.x > 0 ? XP : XN;
        x = d.x > 0 ? d.z : -d.z;
        y = d.y;
    } else {
        face = d.y > 0 ? YP : YN;
        x = -d.z;
        y = d.y > 0 ? d.x : -d.x;
    }
    return (struct sb_ref_texel){face, cell_of(x, m, size), cell_of(y, m, size)};
}

struct sb_vec3 sb_ref_texel_centre(struct sb_ref_texel texel, int size)
{
    const double x = (2 * texel.x + 1 - size) / (double)size;
    const double y = (2 * texel.y + 1 - size) / (double)size;
    switch (texel.face) {
    case XP:
        return (struct sb_vec3){1, y, x};
    case XN:
        return (struct sb_vec3){-1, y, -x};
    case YP:
        return (struct sb_vec3){y, 1, -x};
    case YN:
        return (struct sb_vec3){-y, -1, -x};
    case ZP:
        return (struct sb_vec3){-x, y, 1};
    default:
        return (struct sb_vec3){x, y, -1};
    }
}

// Percentage-closer filtering (Reeves, Salesin and Cook 1987): a square of lookups in the plane
// of the face that the direction meets, a texel apart and the direction in their middle.
void sb_ref_taps(int side, int size, struct sb_vec3 direction, struct sb_vec3 *tap)
{
    const double m = largest(direction), texel = m * 2 / size;
    const bool on_z = fabs(direction.z) == m;
    const bool on_x = !on_z && fabs(direction.x) == m;
    for (int i = 0; i < side; i++) {
        for (int j = 0; j < side; j++) {
            const double s = (i - 0.5 * (side - 1)) * texel;
            const double t = (j - 0.5 * (side - 1)) * texel;
            const struct sb_vec3 by = on_z   ? (struct sb_vec3){s, t, 0}
                                      : on_x ? (struct sb_vec3){0, t, s}
                                             : (struct sb_vec3){s, 0, t};
            tap[side * i + j] = sb_vec3_add(direction, by);
        }
    }
}

// bias * (1 + min(tan, 9)) for a slope.
double sb_ref_bias(const struct sb_ref_choice *choice, double n_dot_l)
{
    if (!choice->bias_slopes)
        return choice->bias;
    const double c = fmin(fmax(n_dot_l, 0), 1);
    const double s = sqrt((1 - c) * (1 + c));
    return choice->bias * (1 + (s < 9 * c ? s / c : 9));
}

// To binary16, ties to even: 11 bits, and steps of 2^-24 below 2^-14. |x| < 65504.
static double to_half(double x)
{
    int exponent; // |x| in [2^(exponent - 1), 2^exponent)
    frexp(x, &exponent);
    const double step = ldexp(1, exponent < -13 ? -24 : exponent - 11);
    return rint(x / step) * step;
}

// The depth of what lies at a depth of `far` ranges: the planes of the projection are at
// NEAR and 1, and so 1 - (1 / depth - 1) / 999.
static double depth_of(double depth)
{
    return 1 - (1 / depth - 1) * (NEAR / (1 - NEAR));
}

double sb_ref_stored(int store, double depth, double distance)
{
    const double steps = store == SB_SHADOW_STORE_DEPTH ? 16777215 : 255;
    if (isinf(depth))
        return store == SB_SHADOW_STORE_DEPTH ? 1 : 0;
    switch (store) {
    case SB_SHADOW_STORE_R8:
        return rint(fmin(fmax(1 - distance, 0), 1) * steps) / steps;
    case SB_SHADOW_STORE_R16F:
        return to_half(1 - distance);
    case SB_SHADOW_STORE_R32F:
        return (float)(1 - distance);
    default: // 24 bits
        return rint(depth_of(depth) * steps) / steps;
    }
}

bool sb_ref_passes(int store, double stored, double largest_component, double distance,
                   double bias)
{
    if (store != SB_SHADOW_STORE_DEPTH)
        return 1 - distance + bias > stored;
    // The point is moved to the light by the bias. The reference value of a comparison with a
    // fixed-point depth is clamped (OpenGL 4.6 core, 8.23.1).
    const double m = largest_component * (1 - bias / fmax(distance, NEAR));
    return fmin(depth_of(fmax(m, NEAR)), 1) < stored;
}
