// Vertices of the reference, and what it interpolates between them.
#include "reference_world.h"

#include "scene.h"

static struct sb_vec3 of(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static long double distance(struct vec3l a, struct sb_vec3 b)
{
    const struct vec3l d = minus(a, vec3l_of(b));
    return sqrtl(dot(d, d));
}

// --- weights ---------------------------------------------------------------------------

enum { WIDTH = 23, HEIGHT = 31 };

static void weights_of_a_triangle_in_the_window_s_plane_are_areas(void **state)
{
    (void)state;
    // (x + y) / 2 and the like, with x and y from -1 to 1.
    const float corner[3][3] = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double weight[3];
            assert_true(sb_ref_geometry_weights(geometry, (struct sb_ref_cover){0, 0}, x,
                                                y, weight));
            check_close(weight[1], (x + 0.5) / WIDTH, 1e-15);
            check_close(weight[2], (y + 0.5) / HEIGHT, 1e-15);
            check_close(weight[0] + weight[1] + weight[2], 1, 4e-16);
        }
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

// A floor at y = -1 seen along -z with an opening of 90 degrees: a row shows it at distance
// -1 / y, so along z the weight is not that of the window but of 1/w.
static void weights_are_correct_in_perspective(void **state)
{
    (void)state;
    const float corner[3][3] = {
        {0, -1, 8}, {0, -1, -24}, {32, -1, 8}}; // one behind the eye
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    const struct sb_mat4 projection = sb_mat4_perspective(SB_PI / 2, 1, 1, 100);
    for (int i = 0; i < 16; i++)
        scene.camera.view_projection[i] = (float)projection.m[i];
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT / 2; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const double ndc_x = (x + 0.5) * 2 / WIDTH - 1;
            const double ndc_y = (y + 0.5) * 2 / HEIGHT - 1;
            const double away = -1 / ndc_y;
            double weight[3];
            assert_true(sb_ref_geometry_weights(geometry, (struct sb_ref_cover){0, 0}, x,
                                                y, weight));
            check_close(weight[1], (8 + away) / 32, 1e-13);
            check_close(weight[2], ndc_x * away / 32, 1e-13);
            check_close(weight[0] + weight[1] + weight[2], 1, 1e-15);
        }
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void a_triangle_seen_edge_on_has_no_weights(void **state)
{
    (void)state;
    const float corner[3][3] = {
        {0, 0, -1}, {3, 0, -5}, {-2, 0, -7}}; // the eye's own height
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    const struct sb_mat4 projection = sb_mat4_perspective(SB_PI / 2, 1, 0.1, 100);
    for (int i = 0; i < 16; i++)
        scene.camera.view_projection[i] = (float)projection.m[i];
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    double weight[3];
    for (int y = 0; y < HEIGHT; y++)
        assert_false(
            sb_ref_geometry_weights(geometry, (struct sb_ref_cover){0, 0}, 4, y, weight));
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

// --- what is interpolated --------------------------------------------------------------

// At the pixel that shows a triangle and at its neighbours, where the plane is seen but not the
// triangle. `room`: the error of a coordinate in double, after all that was added to it.
static void check_positions(const struct sb_scene *scene, double room)
{
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(scene, WIDTH, HEIGHT);
    struct sb_ref_cover cover[WIDTH * HEIGHT];
    sb_ref_geometry_cover(geometry, 1, cover);
    int checked = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (cover[i].draw < 0)
            continue;
        struct vec3l corner[3];
        world_corners(scene, cover[i], corner);
        for (int step = 0; step < 3; step++) {
            const int x = i % WIDTH + (step == 1), y = i / WIDTH + (step == 2);
            const struct ray ray = pixel_ray(scene, WIDTH, HEIGHT, x, y);
            long double expected[3];
            const long double t = plane_hit(&ray, corner, expected);
            double weight[3];
            const bool seen = sb_ref_geometry_weights(geometry, cover[i], x, y, weight);
            if (step == 0)
                assert_true(seen);
            if (!seen || !(t > 0 && t < 1))
                continue;
            checked++;
            check_close(weight[0] + weight[1] + weight[2], 1, 1e-13);
            const struct sb_ref_input input =
                sb_ref_geometry_input(geometry, cover[i], weight);
            const struct vec3l at = {ray.from.x + t * ray.way.x,
                                     ray.from.y + t * ray.way.y,
                                     ray.from.z + t * ray.way.z};
            // Where a plane is seen nearly edge-on, a little aside is much farther away.
            const struct vec3l normal =
                cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
            const long double slant = fabsl(dot(normal, ray.way)) /
                                      sqrtl(dot(normal, normal) * dot(ray.way, ray.way));
            if (slant > 1e-3L)
                check_close((double)distance(at, input.position), 0,
                            room / (double)slant);
        }
    }
    assert_true(checked > WIDTH * HEIGHT / 8);
    sb_ref_geometry_free(&geometry);
}

static void positions_lie_where_the_pixel_s_ray_meets_the_plane(void **state)
{
    (void)state;
    static const struct {
        double scale, offset, room;
    } place[] = {{1, 0, 1e-12},
                 {1e-6, 0, 1e-18},
                 {1e6, 0, 1e-6},
                 {1, 1000, 2e-11},
                 {1, 1e6, 2e-8}};
    for (size_t k = 0; k < sizeof place / sizeof *place; k++) {
        for (int i = 0; i < sb_scene_row_count; i++) {
            struct sb_variant variant = scene_variant(1, 2, 0);
            variant.value[SB_AXIS_SCALE] = place[k].scale;
            variant.value[SB_AXIS_OFFSET] = place[k].offset;
            struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
            check_positions(&scene, place[k].room);
            sb_scene_free(&scene);
        }
    }
}

static void what_is_the_same_at_all_corners_is_so_between_them_bit_for_bit(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(1, 0, 0);
    struct sb_scene scene = made("containers", &variant); // every face is flat
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    struct sb_ref_cover cover[WIDTH * HEIGHT];
    sb_ref_geometry_cover(geometry, 1, cover);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (cover[i].draw < 0)
            continue;
        double weight[3];
        assert_true(
            sb_ref_geometry_weights(geometry, cover[i], i % WIDTH, i / WIDTH, weight));
        int corner[3];
        sb_ref_geometry_corners(geometry, cover[i], corner);
        const struct sb_ref_input vertex =
            sb_ref_geometry_vertex(geometry, cover[i].draw, corner[1]);
        const struct sb_ref_input input =
            sb_ref_geometry_input(geometry, cover[i], weight);
        assert_memory_equal(&input.normal, &vertex.normal, sizeof vertex.normal);
        assert_memory_equal(&input.bitangent, &vertex.bitangent, sizeof vertex.normal);
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
}

static void weights_of_one_give_the_vertices_back(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(1, 0, 0);
    struct sb_scene scene = made("spheres", &variant);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    for (int triangle = 0; triangle < scene.mesh[0].index_count / 3; triangle += 7) {
        const struct sb_ref_cover at = {3, triangle};
        int corner[3];
        sb_ref_geometry_corners(geometry, at, corner);
        for (int i = 0; i < 3; i++) {
            double weight[3] = {0};
            weight[i] = 1;
            assert_int_equal(corner[i], scene.mesh[0].index[3 * triangle + i]);
            const struct sb_ref_input a = sb_ref_geometry_vertex(geometry, 3, corner[i]),
                                      b = sb_ref_geometry_input(geometry, at, weight);
            const double *x = &a.position.x, *y = &b.position.x;
            for (int k = 0; k < 14; k++)
                check_close(x[k], y[k], 1e-15);
        }
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
}

// --- vertices --------------------------------------------------------------------------

// A mirrored, sheared and unevenly scaled model of a tilted triangle.
static struct sb_scene sheared(struct sb_arena *arena, struct sb_vertex **vertex)
{
    const float corner[3][3] = {
        {0.3f, -0.2f, 1}, {1.1f, 0.4f, 0.7f}, {-0.5f, 0.9f, 1.3f}};
    struct sb_mesh mesh = soup(arena, corner, 1);
    *vertex = (struct sb_vertex *)mesh.vertex;
    const struct sb_vec3 e1 = sb_vec3_sub(of(corner[1]), of(corner[0])),
                         e2 = sb_vec3_sub(of(corner[2]), of(corner[0]));
    const struct sb_vec3 normal = sb_vec3_normalise(sb_vec3_cross(e1, e2));
    for (int i = 0; i < 3; i++) {
        struct sb_vertex *at = &(*vertex)[i];
        for (int k = 0; k < 3; k++) {
            at->normal[k] = (float)(&normal.x)[k];
            at->tangent[k] = (float)(&e1.x)[k];
        }
        at->tangent[3] = i == 1 ? -1 : 1;
        at->uv[0] = 0.25f * (float)i;
        at->uv[1] = 1 - 0.5f * (float)i;
    }
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_draw *draw = (struct sb_draw *)scene.draw;
    struct sb_mat4 model = {{-2, 0.5, 0, 0, 0.25, 4, 1, 0, 0, -1, 0.5, 0, 7, -8, 9, 1}};
    for (int i = 0; i < 16; i++)
        draw->model[i] = (float)model.m[i];
    const struct sb_mat3 turn = sb_mat4_normal_matrix(model);
    for (int i = 0; i < 9; i++)
        draw->normal_matrix[i] = (float)turn.m[i];
    return scene;
}

static void normals_stand_on_the_surface_whatever_the_model_does(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    struct sb_vertex *vertex;
    struct sb_scene scene = sheared(&arena, &vertex);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    struct vec3l corner[3];
    world_corners(&scene, (struct sb_ref_cover){0, 0}, corner);
    for (int i = 0; i < 3; i++) {
        const struct sb_ref_input in = sb_ref_geometry_vertex(geometry, 0, i);
        assert_true(distance(corner[i], in.position) < 1e-14L);
        check_close(sb_vec3_length(in.normal), 1, 1e-15);
        for (int k = 0; k < 3; k++) {
            const struct vec3l side = minus(corner[(k + 1) % 3], corner[k]);
            check_close((double)dot(vec3l_of(in.normal), side), 0, 1e-6); // of floats
        }
        // The tangent was the first side, and is so still; the bitangent is square to both.
        assert_true(distance(minus(corner[1], corner[0]), in.tangent) < 1e-6L);
        check_close(sb_vec3_dot(in.bitangent, in.normal), 0, 1e-14);
        check_close(sb_vec3_dot(in.bitangent, in.tangent), 0, 1e-14);
        const struct sb_vec3 turn = sb_vec3_cross(in.normal, in.tangent);
        check_close(sb_vec3_dot(in.bitangent, turn),
                    sb_vec3_dot(turn, turn) * (i == 1 ? -1 : 1), 1e-12);
        check_close(in.uv[0], 0.25 * i, 0);
        check_close(in.uv[1], 1 - 0.5 * i, 0);
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void a_zero_normal_stays_zero(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    struct sb_vertex *vertex;
    struct sb_scene scene = sheared(&arena, &vertex);
    memset(vertex[2].normal, 0, sizeof vertex[2].normal);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
    const struct sb_ref_input in = sb_ref_geometry_vertex(geometry, 0, 2);
    assert_true(sb_vec3_length(in.normal) == 0 && sb_vec3_length(in.bitangent) == 0);
    assert_true(sb_vec3_length(in.tangent) > 0);
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

// --- whole pixels ----------------------------------------------------------------------

static void a_pixel_is_inside_where_its_four_corners_are(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(7);
    int inside = 0, outside = 0;
    for (int round = 0; round < 60; round++) {
        float corner[3][3];
        for (int i = 0; i < 9; i++)
            corner[i / 3][i % 3] = (float)between(&random, -2, 2);
        struct sb_arena arena = {0};
        const struct sb_mesh mesh = soup(&arena, (const float(*)[3])corner, 1);
        struct sb_scene scene = scene_of(&mesh, 1);
        look_from(&scene, (struct sb_vec3){0.1, 0.2, 0.8}, (struct sb_vec3){0, 0, 0});
        struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, WIDTH, HEIGHT);
        struct vec3l world[3];
        world_corners(&scene, (struct sb_ref_cover){0, 0}, world);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            bool expected = true;
            for (int k = 0; k < 4; k++) {
                const struct ray ray =
                    pixel_ray(&scene, WIDTH, HEIGHT, i % WIDTH - 0.5L + k % 2,
                              i / WIDTH - 0.5L + k / 2);
                long double weight[3];
                const long double t = plane_hit(&ray, world, weight);
                expected &= t >= 0 && t <= 1 && weight[0] >= 0 && weight[1] >= 0 &&
                            weight[2] >= 0;
            }
            assert_int_equal(sb_ref_geometry_inside(geometry, (struct sb_ref_cover){0, 0},
                                                    i % WIDTH, i / WIDTH),
                             expected);
            inside += expected;
            outside += !expected;
        }
        sb_ref_geometry_free(&geometry);
        sb_scene_free(&scene);
        sb_arena_free(&arena);
    }
    assert_true(inside > 1000 && outside > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_of_a_triangle_in_the_window_s_plane_are_areas),
        cmocka_unit_test(weights_are_correct_in_perspective),
        cmocka_unit_test(a_triangle_seen_edge_on_has_no_weights),
        cmocka_unit_test(positions_lie_where_the_pixel_s_ray_meets_the_plane),
        cmocka_unit_test(what_is_the_same_at_all_corners_is_so_between_them_bit_for_bit),
        cmocka_unit_test(weights_of_one_give_the_vertices_back),
        cmocka_unit_test(normals_stand_on_the_surface_whatever_the_model_does),
        cmocka_unit_test(a_zero_normal_stays_zero),
        cmocka_unit_test(a_pixel_is_inside_where_its_four_corners_are),
    };
    return run_tests(tests);
}
