#include "test.h"

#include "scene/make.h"

static struct sb_vec3 vec3(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static const struct sb_vertex *corner(const struct sb_mesh *mesh, int index)
{
    return &mesh->vertex[mesh->index[index]];
}

// Vertices at the same place are one point of the surface, whatever else they carry.
static int compare_places(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(float));
}

struct topology {
    int points, edges, open_edges;
};

static struct topology topology_of(const struct sb_mesh *mesh)
{
    const size_t n = (size_t)mesh->vertex_count;
    float(*place)[3] = calloc(n, sizeof *place);
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++)
            place[i][k] = mesh->vertex[i].position[k] + 0.0f; // -0 is 0
    }
    qsort(place, n, sizeof *place, compare_places);
    int points = 0;
    for (size_t i = 0; i < n; i++) {
        if (points == 0 || memcmp(place[points - 1], place[i], sizeof *place) != 0)
            memcpy(place[points++], place[i], sizeof *place);
    }

    // used[a * points + b]: how often a triangle runs from a to b.
    unsigned char *used = calloc((size_t)points * (size_t)points, 1);
    for (int i = 0; i < mesh->index_count; i++) {
        const int next = i % 3 == 2 ? i - 2 : i + 1;
        int end[2];
        for (int k = 0; k < 2; k++) {
            const float *at = corner(mesh, k ? next : i)->position;
            const float key[3] = {at[0] + 0.0f, at[1] + 0.0f, at[2] + 0.0f};
            const float(*found)[3] =
                bsearch(key, place, (size_t)points, sizeof *place, compare_places);
            end[k] = (int)(found - (const float(*)[3])place);
        }
        used[end[0] * points + end[1]]++;
    }

    struct topology t = {.points = points};
    for (int a = 0; a < points; a++) {
        for (int b = a + 1; b < points; b++) {
            const int there = used[a * points + b], back = used[b * points + a];
            t.edges += there || back;
            t.open_edges += (there || back) && !(there == 1 && back == 1);
        }
    }
    free(used);
    free(place);
    return t;
}

static void check_closed(const struct sb_mesh *mesh)
{
    const struct topology t = topology_of(mesh);
    assert_int_equal(t.open_edges, 0);
    assert_int_equal(t.points - t.edges + mesh->index_count / 3, 2); // Euler, of a ball
}

// A sixth of the sum of a . (b x c), which is positive where triangles face outwards.
static double signed_volume(const struct sb_mesh *mesh)
{
    double sum = 0;
    for (int i = 0; i < mesh->index_count; i += 3)
        sum += sb_vec3_dot(vec3(corner(mesh, i)->position),
                           sb_vec3_cross(vec3(corner(mesh, i + 1)->position),
                                         vec3(corner(mesh, i + 2)->position)));
    return sum / 6;
}

// Every triangle against its vertices: normals of unit length on the outside, and the
// tangent frame pointing where u and v really grow.
static void check_frames(const struct sb_mesh *mesh)
{
    for (int i = 0; i < mesh->index_count; i += 3) {
        const struct sb_vertex *a = corner(mesh, i), *b = corner(mesh, i + 1),
                               *c = corner(mesh, i + 2);
        const struct sb_vec3 ab = sb_vec3_sub(vec3(b->position), vec3(a->position));
        const struct sb_vec3 ac = sb_vec3_sub(vec3(c->position), vec3(a->position));
        const double du1 = b->uv[0] - a->uv[0], dv1 = b->uv[1] - a->uv[1];
        const double du2 = c->uv[0] - a->uv[0], dv2 = c->uv[1] - a->uv[1];
        const double det = du1 * dv2 - du2 * dv1;
        const struct sb_vec3 along_u = sb_vec3_scale(
            sb_vec3_sub(sb_vec3_scale(ab, dv2), sb_vec3_scale(ac, dv1)), 1 / det);
        const struct sb_vec3 along_v = sb_vec3_scale(
            sb_vec3_sub(sb_vec3_scale(ac, du1), sb_vec3_scale(ab, du2)), 1 / det);
        for (int k = 0; k < 3; k++) {
            const struct sb_vertex *v = corner(mesh, i + k);
            const struct sb_vec3 n = vec3(v->normal), t = vec3(v->tangent);
            check_close(sb_vec3_length(n), 1, 1e-6);
            check_close(sb_vec3_length(t), 1, 1e-6);
            check_close(sb_vec3_dot(n, t), 0, 1e-6);
            check_close(fabs(v->tangent[3]), 1, 0);
            const struct sb_vec3 bitangent =
                sb_vec3_scale(sb_vec3_cross(n, t), v->tangent[3]);
            assert_true(sb_vec3_dot(n, sb_vec3_cross(ab, ac)) > 0);
            assert_true(sb_vec3_dot(t, along_u) > 0);
            assert_true(sb_vec3_dot(bitangent, along_v) > 0);
        }
    }
}

// Every vertex serves some triangle.
static void check_all_used(const struct sb_mesh *mesh)
{
    unsigned char *used = calloc((size_t)mesh->vertex_count, 1);
    for (int i = 0; i < mesh->index_count; i++)
        used[mesh->index[i]] = 1;
    for (int i = 0; i < mesh->vertex_count; i++)
        assert_true(used[i]);
    free(used);
}

static void cubes_are_closed_and_of_volume_one(void **state)
{
    (void)state;
    static const int cells[] = {1, 2, 3, 7, 10};
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
        struct sb_arena arena = {0};
        const struct sb_mesh mesh = sb_mesh_cube(&arena, cells[i]);
        assert_int_equal(mesh.index_count / 3, 12 * cells[i] * cells[i]);
        check_closed(&mesh);
        check_frames(&mesh);
        check_all_used(&mesh);
        check_close(signed_volume(&mesh), 1, 1e-6);
        sb_arena_free(&arena);
    }
}

// Between two rings lies a frustum of a pyramid over regular polygons; exact, not a
// limit.
static double polyhedron_volume(int stacks, int slices)
{
    double volume = 0;
    for (int i = 0; i < stacks; i++) {
        const double low = -SB_PI / 2 + SB_PI * i / stacks, high = low + SB_PI / stacks;
        const double polygon = slices / 2.0 * sin(2 * SB_PI / slices);
        const double a = polygon * cos(low) * cos(low);
        const double b = polygon * cos(high) * cos(high);
        volume += (sin(high) - sin(low)) / 3 * (a + b + sqrt(a * b));
    }
    return volume;
}

static void spheres_are_closed_and_of_the_volume_of_their_frustums(void **state)
{
    (void)state;
    static const int shape[][2] = {{2, 3}, {2, 4}, {3, 5}, {8, 16}, {15, 31}};
    for (size_t i = 0; i < sizeof shape / sizeof *shape; i++) {
        const int stacks = shape[i][0], slices = shape[i][1];
        struct sb_arena arena = {0};
        const struct sb_mesh mesh = sb_mesh_sphere(&arena, stacks, slices);
        assert_int_equal(mesh.index_count / 3, 2 * slices * (stacks - 1));
        check_closed(&mesh);
        check_frames(&mesh);
        check_all_used(&mesh);
        check_close(signed_volume(&mesh), polyhedron_volume(stacks, slices), 1e-6);
        sb_arena_free(&arena);
    }
}

static void sphere_normals_are_positions(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = sb_mesh_sphere(&arena, 9, 14);
    for (int i = 0; i < mesh.vertex_count; i++)
        assert_memory_equal(mesh.vertex[i].position, mesh.vertex[i].normal,
                            sizeof mesh.vertex[i].normal);
    sb_arena_free(&arena);
}

static void planes_face_z_and_tile_once_a_unit(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = sb_mesh_plane(&arena, 3, 5, 4, 7);
    assert_int_equal(mesh.index_count / 3, 2 * 4 * 7);
    check_frames(&mesh);
    check_all_used(&mesh);
    const struct topology t = topology_of(&mesh);
    assert_int_equal(t.open_edges, 2 * (4 + 7));
    assert_int_equal(t.points - t.edges + mesh.index_count / 3, 1); // Euler, of a disc

    double area = 0;
    for (int i = 0; i < mesh.index_count; i += 3) {
        const struct sb_vec3 a = vec3(corner(&mesh, i)->position);
        area += sb_vec3_cross(sb_vec3_sub(vec3(corner(&mesh, i + 1)->position), a),
                              sb_vec3_sub(vec3(corner(&mesh, i + 2)->position), a))
                    .z /
                2;
    }
    check_close(area, 15, 1e-5);
    for (int i = 0; i < mesh.vertex_count; i++) {
        const struct sb_vertex *v = &mesh.vertex[i];
        check_close(v->uv[0] - v->position[0], 1.5, 1e-6);
        check_close(v->uv[1] - v->position[1], 2.5, 1e-6);
        check_close(v->position[2], 0, 0);
    }
    sb_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubes_are_closed_and_of_volume_one),
        cmocka_unit_test(spheres_are_closed_and_of_the_volume_of_their_frustums),
        cmocka_unit_test(sphere_normals_are_positions),
        cmocka_unit_test(planes_face_z_and_tile_once_a_unit),
    };
    return run_tests(tests);
}
