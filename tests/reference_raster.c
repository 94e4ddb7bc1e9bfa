// Which triangle each pixel shows.
#include "reference_world.h"

#include "scene.h"

static struct sb_ref_cover *covers_of(const struct sb_scene *scene, int width, int height,
                                      int threads)
{
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(scene, width, height);
    struct sb_ref_cover *cover = calloc((size_t)width * (size_t)height, sizeof *cover);
    sb_ref_geometry_cover(geometry, threads, cover);
    sb_ref_geometry_free(&geometry);
    return cover;
}

// --- shared edges ----------------------------------------------------------------------

enum { SIZE = 32, CELLS = 9 };

// Adds one to every pixel that a triangle alone covers.
static void count_alone(const float corner[3][3], const float view_projection[16],
                        int count[SIZE * SIZE])
{
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    memcpy(scene.camera.view_projection, view_projection, sizeof identity);
    struct sb_ref_cover *cover = covers_of(&scene, SIZE, SIZE, 1);
    for (int i = 0; i < SIZE * SIZE; i++)
        count[i] += cover[i].draw == 0;
    free(cover);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

// A bumpy sheet of cells that reaches beyond the window on all sides, cut along random
// diagonals into triangles that face both ways.
static void check_sheet(struct sb_random *random, bool on_centres,
                        const float view_projection[16], double depth)
{
    float point[CELLS + 1][CELLS + 1][3];
    for (int row = 0; row <= CELLS; row++) {
        for (int column = 0; column <= CELLS; column++) {
            double x = 2.4 * (column + between(random, -0.3, 0.3)) / CELLS - 1.2;
            double y = 2.4 * (row + between(random, -0.3, 0.3)) / CELLS - 1.2;
            if (on_centres) { // of pixels, whose sides are 2 / SIZE
                x = (floor(x * SIZE / 2) + 0.5) * 2 / SIZE;
                y = (floor(y * SIZE / 2) + 0.5) * 2 / SIZE;
            }
            const double away = depth > 0 ? depth * between(random, 1, 1.2) : 0.5;
            const double spread = depth > 0 ? 1.3 * away : 1;
            point[row][column][0] = (float)(x * spread);
            point[row][column][1] = (float)(y * spread);
            point[row][column][2] = (float)(depth > 0 ? -away : away);
        }
    }
    int count[SIZE * SIZE] = {0};
    for (int row = 0; row < CELLS; row++) {
        for (int column = 0; column < CELLS; column++) {
            const float *square[4] = {point[row][column], point[row][column + 1],
                                      point[row + 1][column + 1], point[row + 1][column]};
            const int turn = (int)sb_random_below(random, 2);
            for (int half = 0; half < 2; half++) {
                const int flip = (int)sb_random_below(random, 2);
                const int number[3] = {turn, turn + 1 + half + flip,
                                       turn + 2 + half - flip};
                float corner[3][3];
                for (int i = 0; i < 3; i++)
                    memcpy(corner[i], square[number[i] % 4], sizeof corner[i]);
                count_alone(corner, view_projection, count);
            }
        }
    }
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_int_equal(count[i], 1);
}

static void triangles_that_share_edges_cover_each_pixel_once(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    for (int i = 0; i < 8; i++)
        check_sheet(&random, false, identity, 0);
}

static void so_they_do_where_corners_and_edges_lie_on_centres_of_pixels(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(2);
    for (int i = 0; i < 8; i++)
        check_sheet(&random, true, identity, 0);
}

static void so_they_do_in_perspective(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    const struct sb_mat4 projection = sb_mat4_perspective(SB_PI / 2, 1, 0.1, 100);
    float m[16];
    for (int i = 0; i < 16; i++)
        m[i] = (float)projection.m[i];
    for (int i = 0; i < 8; i++)
        check_sheet(&random, false, m, 2);
}

// The rule of ties: a point on an edge belongs to what lies right of it, and on a horizontal
// one to what lies above.
static void a_square_takes_its_left_and_lower_border(void **state)
{
    (void)state;
    const float low = (float)(5 - SIZE + 0.0) / SIZE, high = (float)(15.0 - SIZE) / SIZE;
    const float square[4][3] = {
        {low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}};
    float corner[6][3];
    for (int i = 0; i < 6; i++)
        memcpy(corner[i], square[(int[]){0, 1, 2, 2, 3, 0}[i]], sizeof corner[i]);
    int count[SIZE * SIZE] = {0};
    count_alone(corner, identity, count);
    count_alone(corner + 3, identity, count);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) // centres at 2 x + 1: from 5 to 13, not 15
            assert_int_equal(count[y * SIZE + x], x >= 2 && x <= 6 && y >= 2 && y <= 6);
    }
}

// --- against rays in long double -------------------------------------------------------

// What the ray through a pixel meets first. `clear`: so clearly that rounding cannot matter.
static int seen_by_ray(const struct triangles *all, const struct ray *ray, bool *clear)
{
    const long double edge_room = 1e-9L;
    long double nearest = 1, next = INFINITY;
    int found = -1;
    *clear = true;
    for (int i = 0; i < all->count; i++) {
        long double weight[3];
        const long double t = plane_hit(ray, all->corner[i], weight);
        if (isnan(t) || t < -1e-6L || t > 1 + 1e-6L)
            continue;
        const long double least = fminl(weight[0], fminl(weight[1], weight[2]));
        if (fabsl(least) < edge_room || fabsl(t) < 1e-9L)
            *clear = false;
        if (least < 0 || t < 0)
            continue;
        next = fminl(next, fmaxl(t, nearest));
        if (t < nearest) {
            nearest = t;
            found = i;
        }
    }
    *clear &= next - nearest > 1e-9L;
    return found;
}

// Returns how many pixels show a triangle.
static int check_against_rays(const struct sb_scene *scene, int width, int height)
{
    struct triangles all = triangles_of(scene);
    struct sb_ref_cover *cover = covers_of(scene, width, height, 1);
    int covered = 0, unclear = 0;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const struct ray ray = pixel_ray(scene, width, height, x, y);
            bool clear;
            const int found = seen_by_ray(&all, &ray, &clear);
            const struct sb_ref_cover *at = &cover[y * width + x];
            covered += at->draw >= 0;
            unclear += !clear;
            if (!clear)
                continue;
            assert_int_equal(at->draw, found < 0 ? -1 : all.name[found].draw);
            if (found >= 0)
                assert_int_equal(at->triangle, all.name[found].triangle);
        }
    }
    assert_in_range(unclear, 0, width * height / 8);
    free(cover);
    triangles_free(&all);
    return covered;
}

static void random_triangles_around_the_eye_are_seen_as_rays_see_them(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(4);
    for (int round = 0; round < 40; round++) {
        enum { COUNT = 24 };
        float corner[3 * COUNT][3];
        for (int i = 0; i < 3 * COUNT; i++) {
            for (int k = 0; k < 3; k++)
                corner[i][k] = (float)between(&random, -3, 3);
        }
        struct sb_arena arena = {0};
        const struct sb_mesh mesh[2] = {
            soup(&arena, (const float(*)[3])corner, COUNT / 2),
            soup(&arena, (const float(*)[3])corner + 3 * COUNT / 2, COUNT / 2)};
        struct sb_scene scene = scene_of(mesh, 2);
        look_from(&scene,
                  (struct sb_vec3){between(&random, -1, 1), between(&random, -1, 1), 1},
                  (struct sb_vec3){0.1, 0.2, 0});
        assert_true(check_against_rays(&scene, 29, 17) > 0);
        sb_scene_free(&scene);
        sb_arena_free(&arena);
    }
}

static void every_shipped_scene_is_seen_as_rays_see_it(void **state)
{
    (void)state;
    enum { WIDTH = 64, HEIGHT = 64 };
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_variant variant = scene_variant(1, 3, 1);
        variant.value[SB_AXIS_TESSELLATION] = 0;
        variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        const int covered = check_against_rays(&scene, WIDTH, HEIGHT);
        assert_true(covered > WIDTH * HEIGHT / 8);
        // Whoever stands in a closed room sees no background.
        if (strcmp(scene.name, "room") == 0 || strcmp(scene.name, "tunnel") == 0 ||
            strcmp(scene.name, "plane") == 0)
            assert_int_equal(covered, WIDTH * HEIGHT);
        sb_scene_free(&scene);
    }
}

// --- closed forms ----------------------------------------------------------------------

static void a_floor_that_runs_through_the_eye_s_plane_ends_at_near_and_far(void **state)
{
    (void)state;
    enum { N = 256 };
    const float corner[6][3] = {{-1e4f, -1, 1e4f}, {1e4f, -1, 1e4f},   {1e4f, -1, -1e4f},
                                {1e4f, -1, -1e4f}, {-1e4f, -1, -1e4f}, {-1e4f, -1, 1e4f}};
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 2);
    struct sb_scene scene = scene_of(&mesh, 1);
    const double near = 1.5, far = 20;
    const struct sb_mat4 projection = sb_mat4_perspective(SB_PI / 2, 1, near, far);
    for (int i = 0; i < 16; i++)
        scene.camera.view_projection[i] = (float)projection.m[i];
    struct sb_ref_cover *cover = covers_of(&scene, N, N, 1);
    for (int y = 0; y < N; y++) {
        const double distance = -1 / ((y + 0.5) * 2 / N - 1); // y / w is -1 / distance
        for (int x = 0; x < N; x++)
            assert_int_equal(cover[y * N + x].draw,
                             distance > near && distance < far ? 0 : -1);
    }
    free(cover);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void a_sphere_covers_the_circle_that_its_outline_is(void **state)
{
    (void)state;
    enum { N = 200 };
    struct sb_variant variant = scene_variant(1, 0, 0);
    variant.value[SB_AXIS_TESSELLATION] = 50000;
    struct sb_scene scene = made("sphere", &variant);
    struct sb_ref_cover *cover = covers_of(&scene, N, N, 2);
    for (int y = 0; y < N; y++) {
        for (int x = 0; x < N; x++) {
            const double radius = hypot((x + 0.5) * 2 / N - 1, (y + 0.5) * 2 / N - 1);
            if (fabs(radius - 0.8) > 1e-3) // of half the window (sphere.c)
                assert_int_equal(cover[y * N + x].draw, radius < 0.8 ? 0 : -1);
        }
    }
    free(cover);
    sb_scene_free(&scene);
}

// --- depth -----------------------------------------------------------------------------

static void of_two_draws_at_one_depth_the_first_stays(void **state)
{
    (void)state;
    const float corner[3][3] = {
        {-0.9f, -0.8f, 0.1f}, {0.7f, -0.3f, 0.6f}, {0, 0.9f, -0.3f}};
    struct sb_arena arena = {0};
    const struct sb_mesh one = soup(&arena, corner, 1), mesh[3] = {one, one, one};
    struct sb_scene scene = scene_of(mesh, 3);
    struct sb_ref_cover *cover = covers_of(&scene, SIZE, SIZE, 1);
    int covered = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        covered += cover[i].draw == 0;
        assert_true(cover[i].draw <= 0);
    }
    assert_true(covered > 100);
    free(cover);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void the_order_of_draws_changes_nothing_where_depths_differ(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(1, 4, 0);
    variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
    struct sb_scene scene = made("containers", &variant);
    struct sb_ref_cover *forwards = covers_of(&scene, 128, 128, 1);
    struct sb_draw *turned = calloc((size_t)scene.draw_count, sizeof *turned);
    for (int i = 0; i < scene.draw_count; i++)
        turned[i] = scene.draw[scene.draw_count - 1 - i];
    scene.draw = turned;
    struct sb_ref_cover *backwards = covers_of(&scene, 128, 128, 1);
    for (int i = 0; i < 128 * 128; i++) {
        assert_int_equal(forwards[i].draw, backwards[i].draw < 0 ? -1
                                                                 : scene.draw_count - 1 -
                                                                       backwards[i].draw);
        if (forwards[i].draw >= 0)
            assert_int_equal(forwards[i].triangle, backwards[i].triangle);
    }
    free(turned);
    free(forwards);
    free(backwards);
    sb_scene_free(&scene);
}

static void what_lies_on_the_far_plane_or_before_the_near_one_is_not_seen(void **state)
{
    (void)state;
    static const struct {
        float z;
        bool seen;
    } at[] = {{-1.01f, false}, {-1, true}, {0.999f, true}, {1, false}, {1.01f, false}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        const float z = at[i].z;
        const float corner[3][3] = {{-3, -3, z}, {3, -3, z}, {0, 5, z}};
        int count[SIZE * SIZE] = {0};
        count_alone(corner, identity, count);
        for (int k = 0; k < SIZE * SIZE; k++)
            assert_int_equal(count[k], at[i].seen);
    }
}

static void a_tilted_triangle_is_cut_at_both_planes(void **state)
{
    (void)state;
    const float corner[3][3] = {{-3, -3, -6}, {3, -3, 0}, {0, 5, 5}}; // z = x + y
    int count[SIZE * SIZE] = {0};
    count_alone(corner, identity, count);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int sum = i % SIZE + i / SIZE + 1 - SIZE; // x + y in pixels
        if (abs(sum) != SIZE / 2)                       // on a plane
            assert_int_equal(count[i], abs(sum) < SIZE / 2);
    }
}

// --- threads ---------------------------------------------------------------------------

static void the_number_of_threads_changes_nothing(void **state)
{
    (void)state;
    enum { WIDTH = 131, HEIGHT = 67 };
    const struct sb_variant variant = scene_variant(1, 2, 0);
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        struct sb_ref_cover *one = covers_of(&scene, WIDTH, HEIGHT, 1);
        for (int threads = 2; threads <= 80; threads = 3 * threads - 1) {
            struct sb_ref_cover *some = covers_of(&scene, WIDTH, HEIGHT, threads);
            assert_memory_equal(one, some, WIDTH * HEIGHT * sizeof *one);
            free(some);
        }
        free(one);
        sb_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_that_share_edges_cover_each_pixel_once),
        cmocka_unit_test(so_they_do_where_corners_and_edges_lie_on_centres_of_pixels),
        cmocka_unit_test(so_they_do_in_perspective),
        cmocka_unit_test(a_square_takes_its_left_and_lower_border),
        cmocka_unit_test(random_triangles_around_the_eye_are_seen_as_rays_see_them),
        cmocka_unit_test(every_shipped_scene_is_seen_as_rays_see_it),
        cmocka_unit_test(a_floor_that_runs_through_the_eye_s_plane_ends_at_near_and_far),
        cmocka_unit_test(a_sphere_covers_the_circle_that_its_outline_is),
        cmocka_unit_test(of_two_draws_at_one_depth_the_first_stays),
        cmocka_unit_test(the_order_of_draws_changes_nothing_where_depths_differ),
        cmocka_unit_test(what_lies_on_the_far_plane_or_before_the_near_one_is_not_seen),
        cmocka_unit_test(a_tilted_triangle_is_cut_at_both_planes),
        cmocka_unit_test(the_number_of_threads_changes_nothing),
    };
    return run_tests(tests);
}
