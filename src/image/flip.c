// LDR-FLIP. "The paper" is P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K.
// Åström, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc.
// ACM Comput. Graph. Interact. Tech. 3(2), HPG 2020. Where it leaves something open (the
// border, the D65 white point, the radii of the filters), we do as its authors'
// implementation, version 1.6.

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/metrics.h"

static const double pi = 3.14159265358979323846;

// Linear RGB of BT.709's primaries to XYZ, with D65 at x = 0.31271, y = 0.32902: the
// fractions that the authors use.
static const double xyz_of_rgb[3][3] = {
    {10135552 / 24577794., 8788810 / 24577794., 4435075 / 24577794.},
    {2613072 / 12288897., 8788810 / 12288897., 887015 / 12288897.},
    {1425312 / 73733382., 8788810 / 73733382., 70074185 / 73733382.},
};
static const double rgb_of_xyz[3][3] = {
    {3.2410032329763583, -1.5373989694887853, -0.49861588199636286},
    {-0.9692242522025162, 1.8759299836951757, 0.04155422634008472},
    {0.05563941985197541, -0.20401120612390994, 1.0571489771875333},
};
// XYZ of linear RGB (1,1,1).
static const double white[3] = {23359437 / 24577794., 1, 80288307 / 73733382.};

// Weights from -radius to radius.
struct kernel {
    int radius;
    double *weight; // 2 * radius + 1; in the arena
};

struct kernels {
    struct sb_arena arena;
    struct kernel achromatic, red_green, blue_yellow[2]; // the last is a sum of two
    double share[2];                                     // of each in that sum
    struct kernel smooth, first, second;                 // Gaussian and its derivatives
};

// One picture on its way through the pipelines.
struct seen {
    struct sb_image64 plane[3];    // Y, Cx, Cz; later Hunt-adjusted L*, a*, b*
    struct sb_image64 edge, point; // magnitudes of first and second derivatives
};

struct scratch {
    struct sb_image64 between, down, filtered[3]; // one channel each
    double *padded;                               // a line with its border; owned
};

static void multiply(const double m[static 3][3], const double v[static 3],
                     double product[static 3])
{
    for (int i = 0; i < 3; i++)
        product[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

static struct kernel kernel_new(struct sb_arena *arena, int radius)
{
    return (struct kernel){
        .radius = radius,
        .weight = sb_arena_alloc(arena, (size_t)(2 * radius + 1) * sizeof(double)),
    };
}

// The paper, "Spatial filtering": a contrast sensitivity function, back in space, is a
// sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees. Returns the sum of
// exp() over the window; the kernel sums to 1.
static double make_gaussian(struct kernel *kernel, double b, double pixels_per_degree)
{
    double sum = 0;
    for (int i = -kernel->radius; i <= kernel->radius; i++) {
        const double x = i / pixels_per_degree;
        sum += kernel->weight[i + kernel->radius] = exp(-pi * pi * x * x / b);
    }
    for (int i = 0; i <= 2 * kernel->radius; i++)
        kernel->weight[i] /= sum;
    return sum;
}

// The constants of the three functions are the paper's, "Spatial filtering".
static void make_sensitivity(struct kernels *kernels, double pixels_per_degree)
{
    static const double b_achromatic = 0.0047, b_red_green = 0.0053;
    static const double a_blue_yellow[2] = {34.1, 13.5}, b_blue_yellow[2] = {0.04, 0.025};
    // Three standard deviations, sqrt(b / (2 pi^2)) each, of the widest.
    const int radius =
        (int)ceil(3 * sqrt(b_blue_yellow[0] / (2 * pi * pi)) * pixels_per_degree);
    kernels->achromatic = kernel_new(&kernels->arena, radius);
    make_gaussian(&kernels->achromatic, b_achromatic, pixels_per_degree);
    kernels->red_green = kernel_new(&kernels->arena, radius);
    make_gaussian(&kernels->red_green, b_red_green, pixels_per_degree);
    // In two dimensions each Gaussian is a product, the sum of the two is not: they are
    // filtered with apart, and weighted by their parts of the sum over the square window.
    double part[2];
    for (int i = 0; i < 2; i++) {
        struct kernel *const kernel = &kernels->blue_yellow[i];
        *kernel = kernel_new(&kernels->arena, radius);
        const double sum = make_gaussian(kernel, b_blue_yellow[i], pixels_per_degree);
        part[i] = a_blue_yellow[i] * sqrt(pi / b_blue_yellow[i]) * sum * sum;
    }
    for (int i = 0; i < 2; i++)
        kernels->share[i] = part[i] / (part[0] + part[1]);
}

// Positive weights to a sum of 1, negative ones to -1 (the paper, "Feature detection").
static void balance(struct kernel *kernel)
{
    double above = 0, below = 0;
    for (int i = 0; i <= 2 * kernel->radius; i++) {
        above += fmax(kernel->weight[i], 0);
        below -= fmin(kernel->weight[i], 0);
    }
    for (int i = 0; i <= 2 * kernel->radius; i++)
        kernel->weight[i] /= kernel->weight[i] > 0 ? above : below;
}

// The paper, "Feature detection": derivatives of a Gaussian; from the peak to the trough
// of the first there are w = 0.082 degrees, so that the standard deviation is w / 2.
static void make_features(struct kernels *kernels, double pixels_per_degree)
{
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = (int)ceil(3 * deviation);
    struct kernel *const smooth = &kernels->smooth, *const first = &kernels->first;
    struct kernel *const second = &kernels->second;
    *smooth = kernel_new(&kernels->arena, radius);
    *first = kernel_new(&kernels->arena, radius);
    *second = kernel_new(&kernels->arena, radius);
    double sum = 0;
    for (int i = -radius; i <= radius; i++) {
        const double x = i / deviation, gaussian = exp(-x * x / 2);
        sum += smooth->weight[i + radius] = gaussian;
        first->weight[i + radius] = -x * gaussian;
        second->weight[i + radius] = (x * x - 1) * gaussian;
    }
    for (int i = 0; i <= 2 * radius; i++)
        smooth->weight[i] /= sum;
    balance(first);
    balance(second);
}

static void add_scaled(double *restrict sum, const double *restrict from, double weight,
                       int count)
{
    for (int i = 0; i < count; i++)
        sum[i] += weight * from[i];
}

// Adds `share` of `in`, filtered across and up, to `out`. Beyond the border stands what
// is on it.
static void filter(const struct sb_image64 *in, const struct kernel *across,
                   const struct kernel *up, double share, struct scratch *scratch,
                   struct sb_image64 *out)
{
    const int width = in->width, height = in->height, r = across->radius;
    for (int y = 0; y < height; y++) {
        const double *const from = sb_image64_at(in, 0, y);
        double *const line = sb_image64_at(&scratch->between, 0, y);
        memcpy(scratch->padded + r, from, (size_t)width * sizeof *from);
        for (int i = 0; i < r; i++) {
            scratch->padded[i] = from[0];
            scratch->padded[r + width + i] = from[width - 1];
        }
        memset(line, 0, (size_t)width * sizeof *line);
        for (int i = 0; i <= 2 * r; i++)
            add_scaled(line, scratch->padded + i, share * across->weight[i], width);
    }
    for (int y = 0; y < height; y++)
        for (int i = -up->radius; i <= up->radius; i++) {
            const int v = y + i < 0 ? 0 : y + i >= height ? height - 1 : y + i;
            add_scaled(sb_image64_at(out, 0, y), sb_image64_at(&scratch->between, 0, v),
                       up->weight[i + up->radius], width);
        }
}

static void clear(struct sb_image64 *plane)
{
    memset(plane->data, 0,
           (size_t)plane->width * (size_t)plane->height * sizeof *plane->data);
}

// What a display shows. Encoding as sRGB and decoding again is the identity between.
static double shown(double value)
{
    return value > 0 ? fmin(value, 1) : 0; // a NaN is not above 0
}

// Linear RGB to YCxCz, which is linear in it: L*a*b* without the roots.
static void opponent_of(const double rgb[static 3], struct seen *seen, long pixel)
{
    const double in[3] = {shown(rgb[0]), shown(rgb[1]), shown(rgb[2])};
    double xyz[3];
    multiply(xyz_of_rgb, in, xyz);
    const double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
    seen->plane[0].data[pixel] = 116 * y - 16;
    seen->plane[1].data[pixel] = 500 * (x - y);
    seen->plane[2].data[pixel] = 200 * (y - z);
}

// The cube root of CIELAB with its straight part near 0 (CIE 15:2004, 8.2.1).
static double lab_root(double ratio)
{
    static const double delta = 6. / 29;
    return ratio > delta * delta * delta ? cbrt(ratio)
                                         : ratio / (3 * delta * delta) + 4. / 29;
}

// Linear RGB to L*a*b* with chroma scaled by lightness, for the Hunt effect (the paper,
// "Perceptually uniform color space").
static void hunt_lab_of(const double rgb[static 3], double lab[static 3])
{
    double xyz[3];
    multiply(xyz_of_rgb, rgb, xyz);
    const double x = lab_root(xyz[0] / white[0]), y = lab_root(xyz[1] / white[1]),
                 z = lab_root(xyz[2] / white[2]);
    lab[0] = 116 * y - 16;
    lab[1] = 0.01 * lab[0] * 500 * (x - y);
    lab[2] = 0.01 * lab[0] * 200 * (y - z);
}

// Filtered YCxCz, back in the cube of what a display can show, to Hunt-adjusted L*a*b*.
static void lab_of_opponent(const struct sb_image64 from[static 3], struct seen *seen,
                            long pixel)
{
    const double y = (from[0].data[pixel] + 16) / 116;
    const double x = y + from[1].data[pixel] / 500, z = y - from[2].data[pixel] / 200;
    double rgb[3], lab[3];
    multiply(rgb_of_xyz, (double[]){x * white[0], y * white[1], z * white[2]}, rgb);
    for (int c = 0; c < 3; c++)
        rgb[c] = shown(rgb[c]);
    hunt_lab_of(rgb, lab);
    for (int c = 0; c < 3; c++)
        seen->plane[c].data[pixel] = lab[c];
}

// The length of the gradient (or of the second derivatives) of the achromatic plane.
static void detect(const struct sb_image64 *achromatic, const struct kernel *smooth,
                   const struct kernel *derivative, struct scratch *scratch,
                   struct sb_image64 *out)
{
    const long pixels = (long)out->width * out->height;
    // Y is normalised to [0,1] by (Y + 16) / 116; the offset has no derivative.
    clear(&scratch->down);
    filter(achromatic, derivative, smooth, 1 / 116., scratch, out);
    filter(achromatic, smooth, derivative, 1 / 116., scratch, &scratch->down);
    for (long i = 0; i < pixels; i++)
        out->data[i] = hypot(out->data[i], scratch->down.data[i]);
}

static void look_at(struct seen *seen, const struct kernels *kernels,
                    struct scratch *scratch)
{
    const long pixels = (long)seen->edge.width * seen->edge.height;
    const struct sb_image64 *const plane = seen->plane;
    struct sb_image64 *const filtered = scratch->filtered;
    detect(&plane[0], &kernels->smooth, &kernels->first, scratch, &seen->edge);
    detect(&plane[0], &kernels->smooth, &kernels->second, scratch, &seen->point);
    for (int c = 0; c < 3; c++)
        clear(&filtered[c]);
    filter(&plane[0], &kernels->achromatic, &kernels->achromatic, 1, scratch,
           &filtered[0]);
    filter(&plane[1], &kernels->red_green, &kernels->red_green, 1, scratch, &filtered[1]);
    for (int i = 0; i < 2; i++)
        filter(&plane[2], &kernels->blue_yellow[i], &kernels->blue_yellow[i],
               kernels->share[i], scratch, &filtered[2]);
    for (long i = 0; i < pixels; i++)
        lab_of_opponent(filtered, seen, i);
}

// HyAB (the paper, "Color metric"): city block between lightness and chroma, Euclidean in
// chroma.
static double hyab(const double a[static 3], const double b[static 3])
{
    return fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]);
}

static const double colour_exponent = 0.7, feature_exponent = 0.5; // q_c and q_f

// The largest HyAB that two colours of a display have, between green and blue, to the
// power q_c.
static double largest_colour_error(void)
{
    double green[3], blue[3];
    hunt_lab_of((double[]){0, 1, 0}, green);
    hunt_lab_of((double[]){0, 0, 1}, blue);
    return pow(hyab(green, blue), colour_exponent);
}

// "Color metric": the lower part p_c of the range is spread over p_t of [0,1], the rest
// compressed.
static double redistribute(double distance, double largest)
{
    static const double pc = 0.4, pt = 0.95;
    const double error = pow(distance, colour_exponent), bend = pc * largest;
    return error < bend ? error * pt / bend
                        : pt + (error - bend) / (largest - bend) * (1 - pt);
}

static double error_at(const struct seen *a, const struct seen *b, long i, double largest)
{
    const double p[3] = {a->plane[0].data[i], a->plane[1].data[i], a->plane[2].data[i]};
    const double q[3] = {b->plane[0].data[i], b->plane[1].data[i], b->plane[2].data[i]};
    const double colour = redistribute(hyab(p, q), largest);
    const double edges = fabs(a->edge.data[i] - b->edge.data[i]);
    const double points = fabs(a->point.data[i] - b->point.data[i]);
    const double feature = pow(fmax(edges, points) / sqrt(2), feature_exponent);
    return pow(colour, 1 - feature); // "Final difference"
}

static void seen_init(struct seen *seen, int width, int height)
{
    for (int c = 0; c < 3; c++)
        sb_image64_init(&seen->plane[c], width, height, 1);
    sb_image64_init(&seen->edge, width, height, 1);
    sb_image64_init(&seen->point, width, height, 1);
}

static void seen_free(struct seen *seen)
{
    for (int c = 0; c < 3; c++)
        sb_image64_free(&seen->plane[c]);
    sb_image64_free(&seen->edge);
    sb_image64_free(&seen->point);
}

static void scratch_init(struct scratch *scratch, int width, int height,
                         const struct kernels *kernels)
{
    const int spatial = kernels->achromatic.radius, feature = kernels->smooth.radius;
    const int radius = spatial > feature ? spatial : feature;
    sb_image64_init(&scratch->between, width, height, 1);
    sb_image64_init(&scratch->down, width, height, 1);
    for (int c = 0; c < 3; c++)
        sb_image64_init(&scratch->filtered[c], width, height, 1);
    scratch->padded = sb_alloc((size_t)(width + 2 * radius) * sizeof(double));
}

static void scratch_free(struct scratch *scratch)
{
    sb_image64_free(&scratch->between);
    sb_image64_free(&scratch->down);
    for (int c = 0; c < 3; c++)
        sb_image64_free(&scratch->filtered[c]);
    free(scratch->padded);
}

static struct sb_flip compare(const struct seen *test, const struct seen *truth,
                              struct sb_image *error)
{
    const int width = test->edge.width, height = test->edge.height;
    const long pixels = (long)width * height;
    const double largest = largest_colour_error();
    struct sb_flip flip = {0};
    if (error)
        sb_image_init(error, width, height, 1);
    for (long i = 0; i < pixels; i++) {
        const double e = error_at(test, truth, i, largest);
        flip.mean += e / (double)pixels;
        flip.max = fmax(flip.max, e);
        if (error)
            error->data[i] = (float)e;
    }
    return flip;
}

struct sb_flip sb_flip_measure(const struct sb_image *test,
                               const struct sb_image64 *truth, double pixels_per_degree,
                               struct sb_image *error)
{
    assert(test->channels >= 3 && truth->channels >= 3 && pixels_per_degree >= 1);
    assert(test->width == truth->width && test->height == truth->height);
    const int width = test->width, height = test->height;
    const long pixels = (long)width * height;
    struct kernels kernels = {0};
    make_sensitivity(&kernels, pixels_per_degree);
    make_features(&kernels, pixels_per_degree);
    struct scratch scratch;
    scratch_init(&scratch, width, height, &kernels);
    struct seen a, b;
    seen_init(&a, width, height);
    seen_init(&b, width, height);
    for (long i = 0; i < pixels; i++) {
        const float *const t = test->data + i * test->channels;
        opponent_of((double[]){(double)t[0], (double)t[1], (double)t[2]}, &a, i);
        opponent_of(truth->data + i * truth->channels, &b, i);
    }
    look_at(&a, &kernels, &scratch);
    look_at(&b, &kernels, &scratch);
    const struct sb_flip flip = compare(&a, &b, error);
    seen_free(&a);
    seen_free(&b);
    scratch_free(&scratch);
    sb_arena_free(&kernels.arena);
    return flip;
}
