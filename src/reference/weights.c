// Where a point of the window lies in a triangle.
#include <float.h>
#include <math.h>

#include "reference/geometry_state.h"

struct sb_ref_edges sb_ref_edges_of(const struct sb_ref_seen seen[3])
{
    struct sb_ref_edges edges = {0};
    double largest = 0; // what the determinant is a difference of
    for (int i = 0; i < 3; i++) {
        const struct sb_ref_seen *from = &seen[(i + 1) % 3], *to = &seen[(i + 2) % 3];
        edges.edge[i] = sb_ref_edge(from, to);
        edges.det += edges.edge[i] * seen[i].w;
        largest += (fabs(from->x * to->y) + fabs(to->x * from->y)) * fabs(seen[i].w);
    }
    if (fabs(edges.det) > 64 * DBL_EPSILON * largest)
        edges.facing = edges.det > 0 ? 1 : -1;
    return edges;
}

static struct sb_ref_edges edges_at(const struct sb_ref_geometry *geometry,
                                    struct sb_ref_cover at, double x, double y)
{
    const struct sb_ref_clip *corner[3];
    sb_ref_clip_corners(geometry, at, corner);
    struct sb_ref_seen seen[3];
    for (int i = 0; i < 3; i++)
        seen[i] = sb_ref_see(corner[i], x, y);
    return sb_ref_edges_of(seen);
}

bool sb_ref_geometry_weights(const struct sb_ref_geometry *geometry,
                             struct sb_ref_cover at, int x, int y, double weight[3])
{
    const struct sb_ref_edges edges = edges_at(
        geometry, at, 2.0 * x + 1 - geometry->width, 2.0 * y + 1 - geometry->height);
    const double sum = edges.edge[0] + edges.edge[1] + edges.edge[2];
    if (edges.facing == 0 || sum == 0)
        return false;
    for (int i = 0; i < 3; i++)
        weight[i] = edges.edge[i] / sum;
    return true;
}

bool sb_ref_geometry_inside(const struct sb_ref_geometry *geometry,
                            struct sb_ref_cover at, int x, int y)
{
    const struct sb_ref_clip *corner[3];
    sb_ref_clip_corners(geometry, at, corner);
    for (int i = 0; i < 4; i++) {
        const struct sb_ref_edges edges =
            edges_at(geometry, at, 2.0 * (x + i % 2) - geometry->width,
                     2.0 * (y + i / 2) - geometry->height);
        double z = 0;
        for (int k = 0; k < 3; k++) {
            if (edges.facing == 0 || edges.edge[k] * edges.facing < 0)
                return false;
            z += edges.edge[k] * corner[k]->z;
        }
        if (!(fabs(z) <= fabs(edges.det))) // between -w and w
            return false;
    }
    return true;
}
