// Builds the tree of the triangles by the surface area heuristic in bins (Wald, "On fast
// construction of SAH-based bounding volume hierarchies", 2007).
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "reference/geometry_state.h"

enum {
    BINS = 16,
    LEAF_MAX = 8,  // triangles, where no cut is worth its node
    SAH_DEPTH = 56 // below it halves of the list: 31 levels more are enough
};

struct box {
    double low[3], high[3];
};
static const struct box nothing = {{INFINITY, INFINITY, INFINITY},
                                   {-INFINITY, -INFINITY, -INFINITY}};

static double least(double a, double b)
{
    return b < a ? b : a;
}

static double most(double a, double b)
{
    return b > a ? b : a;
}

static void include(struct box *box, const struct box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = least(box->low[axis], other->low[axis]);
        box->high[axis] = most(box->high[axis], other->high[axis]);
    }
}

static double half_area(const struct box *box)
{
    const double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1],
                 z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

static double middle(const struct box *box, int axis)
{
    return 0.5 * (box->low[axis] + box->high[axis]);
}

struct builder {
    struct sb_ref_tree *tree;
    struct box *box; // by triangle
    int *order;      // triangles, as the tree has them
};

// A plane between two bins of the triangles' middles.
struct split {
    int axis, bin; // the first bin behind it
    double from, bins_per_unit;
    double cost; // areas times triangles
};

static int bin_of(const struct split *split, const struct box *box)
{
    const double bin = (middle(box, split->axis) - split->from) * split->bins_per_unit;
    return bin < BINS - 1 ? (int)bin : BINS - 1;
}

static void try_axis(const struct builder *builder, int begin, int end, int axis,
                     struct split *best)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = begin; i < end; i++) {
        const double at = middle(&builder->box[builder->order[i]], axis);
        low = least(low, at);
        high = most(high, at);
    }
    struct split split = {
        .axis = axis, .from = low, .bins_per_unit = BINS / (high - low)};
    if (!(high > low) || !isfinite(split.bins_per_unit))
        return;
    struct box box[BINS];
    int count[BINS] = {0};
    for (int i = 0; i < BINS; i++)
        box[i] = nothing;
    for (int i = begin; i < end; i++) {
        const struct box *own = &builder->box[builder->order[i]];
        const int bin = bin_of(&split, own);
        include(&box[bin], own);
        count[bin]++;
    }
    double behind[BINS]; // cost of the bins from i on
    struct box sum = nothing;
    for (int i = BINS - 1, n = 0; i > 0; i--) {
        include(&sum, &box[i]);
        n += count[i];
        behind[i] = half_area(&sum) * n;
    }
    sum = nothing;
    for (int i = 1, n = 0; i < BINS; i++) {
        include(&sum, &box[i - 1]);
        n += count[i - 1];
        split.bin = i;
        split.cost = half_area(&sum) * n + behind[i];
        if (n > 0 && n < end - begin && split.cost < best->cost)
            *best = split;
    }
}

// Puts what lies before the plane in front, and returns where the rest begins.
static int divide(struct builder *builder, int begin, int end, const struct split *split)
{
    int *order = builder->order;
    while (begin < end) {
        if (bin_of(split, &builder->box[order[begin]]) < split->bin) {
            begin++;
        } else {
            const int other = order[--end];
            order[end] = order[begin];
            order[begin] = other;
        }
    }
    return begin;
}

static void build(struct builder *builder, int number, int begin, int end, int depth)
{
    struct sb_ref_node *node = &builder->tree->node[number];
    struct box box = nothing;
    for (int i = begin; i < end; i++)
        include(&box, &builder->box[builder->order[i]]);
    *node = (struct sb_ref_node){.first = begin, .count = end - begin};
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis] = box.low[axis];
        node->high[axis] = box.high[axis];
    }

    struct split best = {.cost = INFINITY};
    for (int axis = 0; axis < 3 && depth < SAH_DEPTH; axis++)
        try_axis(builder, begin, end, axis, &best);
    // A node costs about as much as a triangle.
    const double area = half_area(&box), whole = area * (end - begin);
    if (end - begin <= LEAF_MAX && !(best.cost + area < whole))
        return;
    const int cut = best.cost < INFINITY ? divide(builder, begin, end, &best)
                                         : begin + (end - begin) / 2;
    const int first = builder->tree->node_count;
    builder->tree->node_count += 2;
    node->first = first;
    node->count = 0;
    build(builder, first, begin, cut, depth + 1);
    build(builder, first + 1, cut, end, depth + 1);
}

static struct box box_of(const struct sb_ref_triangle *triangle)
{
    struct box box = nothing;
    for (int i = 0; i < 3; i++) {
        for (int axis = 0; axis < 3; axis++) {
            box.low[axis] = least(box.low[axis], triangle->corner[i][axis]);
            box.high[axis] = most(box.high[axis], triangle->corner[i][axis]);
        }
    }
    return box;
}

void sb_ref_tree_build(struct sb_ref_tree *tree)
{
    const size_t count = (size_t)tree->triangle_count;
    if (count == 0)
        return;
    struct builder builder = {
        .tree = tree,
        .box = sb_alloc(count * sizeof *builder.box),
        .order = sb_alloc(count * sizeof *builder.order),
    };
    for (size_t i = 0; i < count; i++) {
        builder.box[i] = box_of(&tree->triangle[i]);
        builder.order[i] = (int)i;
    }
    tree->node = sb_alloc(2 * count * sizeof *tree->node);
    tree->node_count = 1;
    build(&builder, 0, 0, tree->triangle_count, 0);

    struct sb_ref_triangle *ordered = sb_alloc(count * sizeof *ordered);
    for (size_t i = 0; i < count; i++)
        ordered[i] = tree->triangle[builder.order[i]];
    free(tree->triangle);
    tree->triangle = ordered;
    free(builder.box);
    free(builder.order);
}

void sb_ref_tree_free(struct sb_ref_tree **tree)
{
    if (!*tree)
        return;
    free((*tree)->node);
    free((*tree)->triangle);
    free((*tree)->sphere);
    free(*tree);
    *tree = NULL;
}
