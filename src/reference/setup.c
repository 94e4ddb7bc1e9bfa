// Which pixels a triangle may cover. Nothing is decided here that a pixel's own test decides:
// the polygon that is left behind the near plane serves for its bounds alone.
#include <math.h>

#include "reference/raster.h"

enum { POLYGON_MAX = 4 }; // a triangle cut by a plane

struct polygon {
    struct sb_ref_clip corner[POLYGON_MAX];
    int count;
};

// What of a triangle lies behind the near plane, z + w >= 0 (Sutherland and Hodgman, "Reentrant
// polygon clipping", 1974).
static void cut(struct polygon *polygon)
{
    const struct polygon whole = *polygon;
    polygon->count = 0;
    for (int i = 0; i < whole.count; i++) {
        const struct sb_ref_clip *a = &whole.corner[i];
        const struct sb_ref_clip *b = &whole.corner[(i + 1) % whole.count];
        const double at_a = a->z + a->w, at_b = b->z + b->w;
        if (at_a >= 0)
            polygon->corner[polygon->count++] = *a;
        if ((at_a >= 0) == (at_b >= 0))
            continue;
        const double t = at_a / (at_a - at_b);
        polygon->corner[polygon->count++] =
            (struct sb_ref_clip){a->x + (b->x - a->x) * t, a->y + (b->y - a->y) * t,
                                 a->z + (b->z - a->z) * t, a->w + (b->w - a->w) * t};
    }
}

struct range {
    double low, high;
};
static void widen(struct range *range, double value)
{
    range->low = fmin(range->low, value);
    range->high = fmax(range->high, value);
}

// The pixels of a row or column of `size` whose centres lie in a range of half pixels from the
// middle, and some more: rounding must not lose one.
static void pixels_of(const struct range *range, int size, int *first, int *last)
{
    const double low = (range->low + size - 1) / 2, high = (range->high + size - 1) / 2;
    *first = (int)ceil(fmin(fmax(low - 1e-3 - 1e-9 * fabs(low), 0), size));
    *last = (int)floor(fmin(fmax(high + 1e-3 + 1e-9 * fabs(high), -1), size - 1));
}

static bool bound(const struct sb_ref_geometry *geometry, struct sb_ref_setup *setup)
{
    struct polygon polygon = {.count = 3};
    for (int i = 0; i < 3; i++)
        polygon.corner[i] = *setup->corner[i];
    cut(&polygon);
    if (polygon.count == 0)
        return false;
    struct range x = {INFINITY, -INFINITY}, y = x, z = x;
    for (int i = 0; i < polygon.count; i++) {
        const struct sb_ref_clip *corner = &polygon.corner[i];
        if (corner->w > 0) {
            widen(&x, corner->x / corner->w);
            widen(&y, corner->y / corner->w);
            widen(&z, corner->z / corner->w);
        } else { // the near plane runs through the eye, or the eye's plane through a corner
            x = y = (struct range){-INFINITY, INFINITY};
        }
    }
    pixels_of(&x, geometry->width, &setup->x0, &setup->x1);
    pixels_of(&y, geometry->height, &setup->y0, &setup->y1);
    setup->low = z.low;
    setup->high = z.high;
    return setup->x0 <= setup->x1;
}

void sb_ref_setup_make(const struct sb_ref_geometry *geometry, struct sb_ref_cover name,
                       struct sb_ref_setup *setup)
{
    *setup = (struct sb_ref_setup){.name = name, .y1 = -1};
    sb_ref_clip_corners(geometry, name, setup->corner);
    if (!bound(geometry, setup) || setup->y1 < setup->y0) {
        setup->y1 = setup->y0 - 1;
        return;
    }
    const double x = setup->x0 + setup->x1 + 1 - geometry->width;
    const double y = setup->y0 + setup->y1 + 1 - geometry->height;
    struct sb_ref_seen seen[3];
    for (int i = 0; i < 3; i++) {
        seen[i] = sb_ref_see(setup->corner[i], x, y);
        const double w = setup->corner[i]->w;
        setup->cut |= !(w > 0 && fabs(setup->corner[i]->z) <= w);
    }
    const struct sb_ref_edges edges = sb_ref_edges_of(seen);
    setup->det = edges.det;
    setup->facing = edges.facing;
    if (edges.facing == 0) // an edge-on triangle covers nothing
        setup->y1 = setup->y0 - 1;
}
