#include "scene/make.h"

struct mesh_builder {
    struct sb_vertex *vertex;
    uint32_t *index;
    int vertex_count, index_count;
};

static struct mesh_builder start(struct sb_arena *arena, int vertices, int triangles)
{
    return (struct mesh_builder){
        .vertex = sb_arena_alloc(arena, (size_t)vertices * sizeof(struct sb_vertex)),
        .index = sb_arena_alloc(arena, (size_t)triangles * 3 * sizeof(uint32_t)),
    };
}

static struct sb_mesh finish(const struct mesh_builder *builder)
{
    return (struct sb_mesh){
        .vertex = builder->vertex,
        .index = builder->index,
        .vertex_count = builder->vertex_count,
        .index_count = builder->index_count,
    };
}

static void add_vertex(struct mesh_builder *builder, struct sb_vec3 position,
                       struct sb_vec3 normal, double u, double v, struct sb_vec3 tangent)
{
    builder->vertex[builder->vertex_count++] = (struct sb_vertex){
        .position = {(float)position.x, (float)position.y, (float)position.z},
        .normal = {(float)normal.x, (float)normal.y, (float)normal.z},
        .uv = {(float)u, (float)v},
        .tangent = {(float)tangent.x, (float)tangent.y, (float)tangent.z, 1},
    };
}

static void add_triangle(struct mesh_builder *builder, int a, int b, int c)
{
    uint32_t *index = builder->index + builder->index_count;
    index[0] = (uint32_t)a;
    index[1] = (uint32_t)b;
    index[2] = (uint32_t)c;
    builder->index_count += 3;
}

// A rectangle cut into cells, facing cross(right, up).
struct grid {
    struct sb_vec3 centre, right, up; // from the centre to the middle of two sides
    int columns, rows;
    double tiles_u, tiles_v; // how often a texture repeats along it
};

static void add_grid(struct mesh_builder *builder, const struct grid *grid)
{
    const struct sb_vec3 tangent = sb_vec3_normalise(grid->right);
    const struct sb_vec3 normal = sb_vec3_normalise(sb_vec3_cross(grid->right, grid->up));
    const int first = builder->vertex_count, stride = grid->columns + 1;
    for (int row = 0; row <= grid->rows; row++) {
        for (int column = 0; column <= grid->columns; column++) {
            // Counted from the middle, because i/n and 1 - (n - i)/n need not round to
            // the same float, and the faces of a cube that meet at an edge would come
            // apart.
            const double s = (double)(2 * column - grid->columns) / grid->columns;
            const double t = (double)(2 * row - grid->rows) / grid->rows;
            const struct sb_vec3 across =
                sb_vec3_add(sb_vec3_scale(grid->right, s), sb_vec3_scale(grid->up, t));
            add_vertex(builder, sb_vec3_add(grid->centre, across), normal,
                       grid->tiles_u * column / grid->columns,
                       grid->tiles_v * row / grid->rows, tangent);
        }
    }
    for (int row = 0; row < grid->rows; row++) {
        for (int column = 0; column < grid->columns; column++) {
            const int corner = first + row * stride + column;
            add_triangle(builder, corner, corner + 1, corner + 1 + stride);
            add_triangle(builder, corner, corner + 1 + stride, corner + stride);
        }
    }
}

struct sb_mesh sb_mesh_cube(struct sb_arena *arena, int cells)
{
    static const struct {
        struct sb_vec3 out, right, up;
    } face[6] = {
        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    };
    struct mesh_builder builder =
        start(arena, 6 * (cells + 1) * (cells + 1), 12 * cells * cells);
    for (int i = 0; i < 6; i++) {
        const struct grid grid = {
            .centre = sb_vec3_scale(face[i].out, 0.5),
            .right = sb_vec3_scale(face[i].right, 0.5),
            .up = sb_vec3_scale(face[i].up, 0.5),
            .columns = cells,
            .rows = cells,
            .tiles_u = 1,
            .tiles_v = 1,
        };
        add_grid(&builder, &grid);
    }
    return finish(&builder);
}

// One point of the sphere; column / slices and row / stacks are its u and v, and half a
// column is what the vertices at the poles are shifted by.
static void add_sphere_vertex(struct mesh_builder *builder, double column, int slices,
                              int row, int stacks)
{
    const double u = column / slices, v = (double)row / stacks;
    // The last column closes the seam only if it is the first one's float for float.
    const double longitude = 2 * SB_PI * (column < slices ? u : 0) - SB_PI;
    const double latitude = SB_PI * (v - 0.5);
    const int pole = row == 0 ? -1 : row == stacks ? 1 : 0; // where cos would not be 0
    const double radius = pole ? 0 : cos(latitude);
    const double height = pole ? pole : sin(latitude);
    const struct sb_vec3 out = {radius * sin(longitude), height, radius * cos(longitude)};
    add_vertex(builder, out, out, u, v,
               (struct sb_vec3){cos(longitude), 0, -sin(longitude)});
}

void sb_sphere_cells(double triangles, int *stacks, int *slices)
{
    *stacks = (int)fmax(2, round((1 + sqrt(1 + triangles)) / 2));
    *slices = (int)fmax(3, round(triangles / (2 * (*stacks - 1))));
}

struct sb_mesh sb_mesh_sphere(struct sb_arena *arena, int stacks, int slices)
{
    // Rows from the south pole up. The poles have a vertex for each triangle that meets
    // there, the other rows one more than slices, for the seam.
    struct mesh_builder builder =
        start(arena, 2 * slices + (stacks - 1) * (slices + 1), 2 * slices * (stacks - 1));
    for (int row = 0; row <= stacks; row++) {
        const bool pole = row == 0 || row == stacks;
        for (int column = 0; column < slices + !pole; column++)
            add_sphere_vertex(&builder, pole ? column + 0.5 : column, slices, row,
                              stacks);
    }

    const int stride = slices + 1;
    const int north = builder.vertex_count - slices, below_north = north - stride;
    for (int column = 0; column < slices; column++) {
        add_triangle(&builder, column, slices + column + 1, slices + column);
        for (int corner = slices + column; corner + stride < north; corner += stride) {
            add_triangle(&builder, corner, corner + 1, corner + 1 + stride);
            add_triangle(&builder, corner, corner + 1 + stride, corner + stride);
        }
        add_triangle(&builder, below_north + column, below_north + column + 1,
                     north + column);
    }
    return finish(&builder);
}

struct sb_mesh sb_mesh_plane(struct sb_arena *arena, double width, double height,
                             int columns, int rows)
{
    struct mesh_builder builder =
        start(arena, (columns + 1) * (rows + 1), 2 * columns * rows);
    const struct grid grid = {
        .right = {width / 2, 0, 0},
        .up = {0, height / 2, 0},
        .columns = columns,
        .rows = rows,
        .tiles_u = width,
        .tiles_v = height,
    };
    add_grid(&builder, &grid);
    return finish(&builder);
}
