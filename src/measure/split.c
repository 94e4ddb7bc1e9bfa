#include "measure/split.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"

// Places in SB_PROBE_INPUTS, behind the four channels of the colour.
enum { NONFINITE = 4 + 8, NEGATIVE = 4 + 9, DECISIONS = 4 + 10 };

struct pixel {
    int x, y;
    long at;
    struct sb_ref_cover driver;
};

static struct pixel pixel_of(const struct sb_split_params *params, int x, int y)
{
    const float *seen = sb_image_at(params->geometry, x, y);
    return (struct pixel){
        .x = x,
        .y = y,
        .at = (long)y * params->ground->width + x,
        .driver = {.draw = (int32_t)seen[0] - 1, .triangle = (int32_t)seen[1] - 1},
    };
}

static bool is_lamp(const struct sb_split_params *params, int draw)
{
    return params->ground->scene->draw[draw].lamp >= 0;
}

// Driver and reference show the same triangle, and the reference has a colour there.
static bool matches(const struct sb_split_params *params, const struct pixel *pixel)
{
    const struct sb_ref_cover *own = &params->ground->cover[pixel->at];
    return own->draw == pixel->driver.draw && own->triangle == pixel->driver.triangle &&
           params->ideal->valid[pixel->at] && params->model->valid[pixel->at] &&
           (!params->interior ||
            sb_ref_ground_interior(params->ground, pixel->x, pixel->y));
}

// --- branches that went another way ----------------------------------------------------------

struct flip {
    bool differs;
    double margin; // how near the branch was to going that way in double as well
};

static struct flip flip_at_corners(const struct sb_split_params *params,
                                   const struct pixel *pixel)
{
    const struct sb_ref_ground *ground = params->ground;
    struct flip flip = {.margin = INFINITY};
    int corner[3];
    sb_ref_geometry_corners(ground->geometry, pixel->driver, corner);
    for (int i = 0; i < 3 && params->probe; i++) {
        const int vertex = ground->first_vertex[pixel->driver.draw] + corner[i];
        const uint32_t there = (uint32_t)sb_image_at(params->probe, vertex, 0)[DECISIONS];
        if (there == params->model->vertex[vertex].decisions)
            continue;
        flip.differs = true;
        flip.margin = fmin(flip.margin, params->model->vertex[vertex].margin);
    }
    return flip;
}

// Did the driver, or what it was given, take another branch than the variant's own model?
static struct flip flip_of(const struct sb_split_params *params,
                           const struct pixel *pixel)
{
    if (is_lamp(params, pixel->driver.draw))
        return (struct flip){0};
    if (params->model->vertex)
        return flip_at_corners(params, pixel);
    if (!params->given)
        return (struct flip){0};
    const uint32_t given = params->given->decisions[pixel->at];
    const uint32_t there = params->probe ? (uint32_t)sb_image_at(params->probe, pixel->x,
                                                                 pixel->y)[DECISIONS]
                                         : given;
    return (struct flip){
        .differs = there != given || given != params->model->decisions[pixel->at],
        .margin =
            fmin(params->given->margin[pixel->at], params->model->margin[pixel->at]),
    };
}

// --- the parts -------------------------------------------------------------------------------

// Of one channel of one pixel; NAN: not known.
static void parts_of(const struct sb_split_params *params, const struct pixel *pixel,
                     int channel, double part[SB_BY_COUNT])
{
    const long at = 3 * pixel->at + channel;
    const double ideal = params->ideal->colour.data[at],
                 model = params->model->colour.data[at];
    const double given = params->given ? params->given->colour.data[at] : (double)NAN;
    const double wide = sb_image_at(params->wide, pixel->x, pixel->y)[channel];
    const double own = sb_image_at(params->own, pixel->x, pixel->y)[channel];
    part[SB_BY_FORMULATION] = model - ideal;
    part[SB_BY_INTERPOLATION] = given - model;
    part[SB_BY_ARITHMETIC] = wide - given;
    part[SB_BY_QUANTISATION] = own - wide;
}

static void add_pixel(const struct sb_split_params *params, const struct pixel *pixel,
                      struct sb_split *split, int64_t known[SB_BY_COUNT])
{
    for (int c = 0; c < 3; c++) {
        double part[SB_BY_COUNT];
        const double gouraud = fabs(sb_image_at(params->own, pixel->x, pixel->y)[c] -
                                    params->model->colour.data[3 * pixel->at + c]);
        parts_of(params, pixel, c, part);
        if (params->model->vertex)
            split->gouraud = fmax(split->gouraud, gouraud); // passes over NAN
        for (int p = 0; p < SB_BY_COUNT; p++) {
            const double size = fabs(part[p]);
            if (!isfinite(size)) // not known, or not finite: those are counted elsewhere
                continue;
            known[p]++;
            split->part[p].mean += size;
            if (size > split->part[p].max) {
                split->part[p].max = size;
                split->part[p].x = pixel->x;
                split->part[p].y = pixel->y;
            }
        }
    }
}

// --- raw terms -------------------------------------------------------------------------------

static void count_raw(const struct sb_split_params *params, struct sb_split *split)
{
    const struct sb_image *probe = params->probe;
    split->raw_nonfinite = split->raw_negative = probe ? 0 : -1;
    for (long i = 0; probe && i < (long)probe->width * probe->height; i++) {
        const float *values = probe->data + i * probe->channels;
        split->raw_nonfinite += (int64_t)values[NONFINITE];
        split->raw_negative += (int64_t)values[NEGATIVE];
    }
}

static void take_pixel(const struct sb_split_params *params, const struct pixel *pixel,
                       struct sb_split *split, int64_t known[SB_BY_COUNT])
{
    split->covered++;
    if (!matches(params, pixel)) {
        split->mismatched++;
        return;
    }
    const struct flip flip = flip_of(params, pixel);
    split->flips += flip.differs;
    if (flip.differs && flip.margin <= params->decision_bound)
        return;
    split->compared++;
    split->counted[pixel->at] = 1;
    add_pixel(params, pixel, split, known);
}

void sb_split_measure(const struct sb_split_params *params, struct sb_split *split)
{
    const int width = params->ground->width, height = params->ground->height;
    int64_t known[SB_BY_COUNT] = {0};
    *split = (struct sb_split){
        .counted = sb_alloc((size_t)width * (size_t)height),
        .gouraud = NAN,
    };
    count_raw(params, split);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const struct pixel pixel = pixel_of(params, x, y);
            if (pixel.driver.draw >= 0 || params->ground->cover[pixel.at].draw >= 0)
                take_pixel(params, &pixel, split, known);
        }
    for (int p = 0; p < SB_BY_COUNT; p++) {
        split->part[p].mean = known[p] ? split->part[p].mean / (double)known[p] : NAN;
        split->part[p].max = known[p] ? split->part[p].max : (double)NAN;
    }
    const bool branches_known =
        params->model->vertex ? params->probe != NULL : params->given != NULL;
    if (!branches_known)
        split->flips = -1;
}
