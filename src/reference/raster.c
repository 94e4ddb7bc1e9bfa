// Fills triangles, a band of rows at a time. Homogeneous edge functions need no clipping of
// what is filled (Olano and Greer 1997): corners behind the eye are corners like any other.
#include "reference/raster.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/parallel.h"

enum { SETUPS_AT_ONCE = 4096, BANDS_PER_THREAD = 8, LEAST_BAND = 8 };

// The sign of a d - b c, exactly. Rounding is monotonic, so products that differ after it tell
// the sign; of equal ones fma gives what was rounded off.
static int sign_of(double a, double d, double b, double c)
{
    const double left = a * d, right = b * c;
    if (left != right)
        return left > right ? 1 : -1;
    const double rest = fma(a, d, -left) - fma(b, c, -right);
    return (rest > 0) - (rest < 0);
}

// On which side of an edge the point lies; on the edge itself, where a point would lie that is
// infinitely little to its right and, infinitely less, above it. So no point is on an edge,
// and triangles that share one, seen from either side, share out its points (OpenGL 4.6 core,
// 14.6.1: exactly one of them). 0: no edge.
static int side_of(const struct sb_ref_seen *from, const struct sb_ref_seen *to)
{
    int sign = sign_of(from->x, to->y, to->x, from->y);
    if (sign == 0) // by X
        sign = sign_of(to->w, from->y, from->w, to->y);
    if (sign == 0) // by Y
        sign = sign_of(from->w, to->x, to->w, from->x);
    return sign;
}

struct row {
    const struct sb_ref_setup *triangle;
    int width;
    double y[3]; // of the corners, as seen from the row
    double edge[3],
        slope[3];      // edge functions at pixel x0, and from one pixel to the next,
                       // positive in the triangle
    double doubt[3];   // below it an edge function says nothing
    double z, z_slope; // z/w in the same way
    double *depth;     // of the row's pixels
    struct sb_ref_cover *cover; // likewise
};

static bool covers(const struct row *row, int x)
{
    struct sb_ref_seen seen[3];
    for (int i = 0; i < 3; i++) {
        const struct sb_ref_clip *corner = row->triangle->corner[i];
        seen[i] = sb_ref_see(corner, 2.0 * x + 1 - row->width, 0);
        seen[i].y = row->y[i];
    }
    const int facing = row->triangle->facing;
    return side_of(&seen[0], &seen[1]) == facing &&
           side_of(&seen[1], &seen[2]) == facing && side_of(&seen[2], &seen[0]) == facing;
}

static bool surely_covers(const struct row *row, int x)
{
    const double steps = x - row->triangle->x0;
    return row->edge[0] + steps * row->slope[0] > row->doubt[0] &&
           row->edge[1] + steps * row->slope[1] > row->doubt[1] &&
           row->edge[2] + steps * row->slope[2] > row->doubt[2];
}

static void put(const struct row *row, int x)
{
    const struct sb_ref_setup *triangle = row->triangle;
    double z = row->z + (x - triangle->x0) * row->z_slope;
    if (!triangle->cut)
        z = z < triangle->low ? triangle->low : z > triangle->high ? triangle->high : z;
    else if (z < -1)
        return;
    if (z < row->depth[x]) { // GL_LESS; the far plane is what the depth is cleared to
        row->depth[x] = z;
        row->cover[x] = triangle->name;
    }
}

static void start_row(struct row *row, double y)
{
    const struct sb_ref_setup *triangle = row->triangle;
    const double x = 2.0 * triangle->x0 + 1 - row->width;
    const double across = 2.0 * (triangle->x1 - triangle->x0);
    struct sb_ref_seen seen[3];
    for (int i = 0; i < 3; i++) {
        seen[i] = sb_ref_see(triangle->corner[i], x, y);
        row->y[i] = seen[i].y;
    }
    double z = 0, z_slope = 0;
    for (int i = 0; i < 3; i++) {
        const struct sb_ref_seen *from = &seen[(i + 1) % 3], *to = &seen[(i + 2) % 3];
        // sb_ref_edge differentiated by X; a pixel has two halves.
        const double slope = 2 * (to->w * from->y - from->w * to->y);
        const double edge = sb_ref_edge(from, to);
        row->edge[i] = triangle->facing * edge;
        row->slope[i] = triangle->facing * slope;
        // Rounding errors are some units in the last place of the products, which are
        // largest at one of the row's ends.
        row->doubt[i] = 1e-13 * ((fabs(from->x) + fabs(from->w) * across) * fabs(to->y) +
                                 (fabs(to->x) + fabs(to->w) * across) * fabs(from->y));
        z += edge * triangle->corner[i]->z;
        z_slope += slope * triangle->corner[i]->z;
    }
    row->z = z / triangle->det;
    row->z_slope = z_slope / triangle->det;
}

// Leaves out what surely lies outside.
static void narrow(const struct row *row, int *first, int *last)
{
    for (int i = 0; i < 3; i++) {
        const double slope = row->slope[i];
        if (fabs(slope) <= 16 * row->doubt[i]) // the edge runs along the row
            continue;
        const double root = row->triangle->x0 - row->edge[i] / slope;
        if (slope > 0 && root - 1 > *first)
            *first = (int)fmin(root - 1, *last + 1.0);
        if (slope < 0 && root + 1 < *last)
            *last = (int)fmax(root + 1, *first - 1.0);
    }
}

static void fill_row(const struct row *row)
{
    int first = row->triangle->x0, last = row->triangle->x1;
    narrow(row, &first, &last);
    // Edge functions are linear: between two pixels that the triangle surely covers are
    // others such.
    for (; first <= last && !surely_covers(row, first); first++) {
        if (covers(row, first))
            put(row, first);
    }
    for (; first <= last && !surely_covers(row, last); last--) {
        if (covers(row, last))
            put(row, last);
    }
    for (int x = first; x <= last; x++)
        put(row, x);
}

// --- bands -----------------------------------------------------------------------------

struct picture {
    const struct sb_ref_geometry *geometry;
    struct sb_ref_setup *triangle;
    int64_t triangles;
    int64_t *first; // by draw: how many triangles come before; one more at the end
    int band;       // rows
    struct sb_ref_cover *cover;
};

static void make_setups(void *context, int item)
{
    const struct picture *picture = context;
    const int64_t begin = (int64_t)item * SETUPS_AT_ONCE;
    const int64_t end = begin + SETUPS_AT_ONCE < picture->triangles
                            ? begin + SETUPS_AT_ONCE
                            : picture->triangles;
    int draw = 0;
    for (int64_t i = begin; i < end; i++) {
        while (i >= picture->first[draw + 1])
            draw++;
        const struct sb_ref_cover name = {draw, (int32_t)(i - picture->first[draw])};
        sb_ref_setup_make(picture->geometry, name, &picture->triangle[i]);
    }
}

static void fill_band(void *context, int item)
{
    const struct picture *picture = context;
    const int width = picture->geometry->width, height = picture->geometry->height;
    const int begin = item * picture->band;
    const int end = begin + picture->band < height ? begin + picture->band : height;
    const size_t pixels = (size_t)(end - begin) * (size_t)width;
    struct sb_ref_cover *cover = picture->cover + (size_t)begin * (size_t)width;
    double *depth = sb_alloc(pixels * sizeof *depth);
    for (size_t i = 0; i < pixels; i++) {
        depth[i] = 1;
        cover[i] = (struct sb_ref_cover){.draw = -1};
    }
    for (int64_t i = 0; i < picture->triangles; i++) {
        const struct sb_ref_setup *triangle = &picture->triangle[i];
        const int last = triangle->y1 < end - 1 ? triangle->y1 : end - 1;
        for (int y = triangle->y0 > begin ? triangle->y0 : begin; y <= last; y++) {
            const size_t at = (size_t)(y - begin) * (size_t)width;
            struct row row = {.triangle = triangle,
                              .width = width,
                              .depth = depth + at,
                              .cover = cover + at};
            start_row(&row, 2.0 * y + 1 - height);
            fill_row(&row);
        }
    }
    free(depth);
}

void sb_ref_geometry_cover(const struct sb_ref_geometry *geometry, int threads,
                           struct sb_ref_cover *cover)
{
    const struct sb_scene *scene = geometry->scene;
    struct picture picture = {.geometry = geometry, .cover = cover};
    picture.first = sb_alloc(((size_t)scene->draw_count + 1) * sizeof *picture.first);
    for (int i = 0; i < scene->draw_count; i++) {
        picture.first[i] = picture.triangles;
        picture.triangles += scene->mesh[scene->draw[i].mesh].index_count / 3;
    }
    picture.first[scene->draw_count] = picture.triangles;
    picture.triangle = sb_alloc((size_t)picture.triangles * sizeof *picture.triangle + 1);
    sb_parallel_for(threads,
                    (int)((picture.triangles + SETUPS_AT_ONCE - 1) / SETUPS_AT_ONCE),
                    make_setups, &picture);

    const int even = geometry->height / (threads * BANDS_PER_THREAD);
    picture.band = even > LEAST_BAND ? even : LEAST_BAND;
    sb_parallel_for(threads, (geometry->height + picture.band - 1) / picture.band,
                    fill_band, &picture);
    free(picture.triangle);
    free(picture.first);
}
