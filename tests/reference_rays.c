// What rays meet: the tree against every triangle one by one.
#include "reference_world.h"

#include "scene.h"

struct limits {
    long double near, far;
};

// By Möller and Trumbore over all lit triangles. `clear`: no edge is so near that rounding may
// decide.
static long double nearest_of(const struct sb_scene *scene, const struct triangles *all,
                              const struct ray *ray, const struct limits *limits,
                              bool *clear)
{
    long double nearest = INFINITY;
    *clear = true;
    for (int i = 0; i < all->count; i++) {
        if (scene->draw[all->name[i].draw].lamp >= 0)
            continue;
        long double weight[3];
        const long double t = plane_hit(ray, all->corner[i], weight);
        if (isnan(t))
            continue;
        const long double least = fminl(weight[0], fminl(weight[1], weight[2]));
        if (least < -1e-9L || t < limits->near - 1e-9L || t > limits->far + 1e-9L)
            continue;
        if (least < 1e-9L || t < limits->near + 1e-9L || t > limits->far - 1e-9L)
            *clear = false;
        else
            nearest = fminl(nearest, t);
    }
    return nearest;
}

static struct sb_ref_ray ref_ray(const struct ray *ray, const struct limits *limits)
{
    return (struct sb_ref_ray){
        .origin = {(double)ray->from.x, (double)ray->from.y, (double)ray->from.z},
        .direction = {(double)ray->way.x, (double)ray->way.y, (double)ray->way.z},
        .near = (double)limits->near,
        .far = (double)limits->far};
}

// In one ray of four, a component or two of the direction are zero.
static struct ray random_ray(struct sb_random *random, double low, double high)
{
    struct sb_vec3 from = {between(random, low, high), between(random, low, high),
                           between(random, low, high)};
    struct sb_vec3 way = {between(random, -1, 1), between(random, -1, 1),
                          between(random, -1, 1)};
    const int kind = (int)sb_random_below(random, 12);
    if (kind == 0)
        way.x = 0;
    if (kind == 1)
        way.y = -0.0;
    if (kind == 2)
        way = (struct sb_vec3){0, -way.y, -0.0};
    return (struct ray){vec3l_of(from), vec3l_of(way)};
}

// Returns how many rays hit something.
static int check_rays(const struct sb_scene *scene, int rays, double low, double high)
{
    struct sb_random random = sb_random_seed(11);
    struct triangles all = triangles_of(scene);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    int hits = 0, unclear = 0;
    for (int i = 0; i < rays; i++) {
        const struct ray ray = random_ray(&random, low, high);
        struct limits limits = {i % 3 == 0 ? between(&random, 0, 2) : 0,
                                i % 2 == 0 ? between(&random, 2, 8) : INFINITY};
        const struct sb_ref_ray asked = ref_ray(&ray, &limits);
        const double hit = sb_ref_geometry_hit(geometry, &asked);
        assert_int_equal(sb_ref_geometry_blocked(geometry, &asked), hit < INFINITY);
        bool clear;
        const long double expected = nearest_of(scene, &all, &ray, &limits, &clear);
        unclear += !clear;
        if (clear)
            check_close(hit, (double)expected, 1e-11 * (1 + fabs((double)expected)));
        hits += hit < INFINITY;
    }
    assert_in_range(unclear, 0, rays / 20);
    sb_ref_geometry_free(&geometry);
    triangles_free(&all);
    return hits;
}

static void rays_meet_the_nearest_of_random_triangles(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    for (int count = 1; count < 2000; count = 5 * count + 2) {
        float(*corner)[3] = calloc(3 * (size_t)count, sizeof *corner);
        for (int i = 0; i < 3 * count; i++) {
            for (int k = 0; k < 3; k++) // of each triangle around the first corner
                corner[i][k] =
                    (float)(i % 3 == 0 ? between(&random, -4, 4)
                                       : corner[i - i % 3][k] + between(&random, -1, 1));
        }
        struct sb_arena arena = {0};
        const struct sb_mesh mesh = soup(&arena, (const float(*)[3])corner, count);
        struct sb_scene scene = scene_of(&mesh, 1);
        const int hits = check_rays(&scene, 1000, -4, 4);
        if (count > 100)
            assert_in_range(hits, 100, 1000);
        sb_scene_free(&scene);
        sb_arena_free(&arena);
        free(corner);
    }
}

static void rays_meet_the_nearest_triangle_of_every_shipped_scene(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_variant variant = scene_variant(1, 5, 0);
        variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        assert_true(check_rays(&scene, 800, -4, 4) > 20);
        sb_scene_free(&scene);
    }
}

static void many_triangles_at_one_place_are_no_trouble(void **state)
{
    (void)state;
    enum { COUNT = 500 };
    float corner[3 * COUNT][3];
    for (int i = 0; i < 3 * COUNT; i++)
        memcpy(corner[i], (const float[3][3]){{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}[i % 3],
               sizeof corner[i]);
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, (const float(*)[3])corner, COUNT);
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    struct sb_ref_ray ray = {.direction = {0, 0, 4}, .far = INFINITY};
    assert_true(sb_ref_geometry_hit(geometry, &ray) == 0.5);
    ray.direction.z = -4;
    assert_true(sb_ref_geometry_hit(geometry, &ray) == INFINITY);
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void a_scene_of_nothing_stops_no_ray(void **state)
{
    (void)state;
    struct sb_scene scene = {0};
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    const struct sb_ref_ray ray = {
        .direction = {1, 2, 3}, .far = INFINITY, .truth = true};
    assert_true(sb_ref_geometry_hit(geometry, &ray) == INFINITY);
    assert_false(sb_ref_geometry_blocked(geometry, &ray));
    struct sb_ref_cover cover[16 * 16];
    sb_ref_geometry_cover(geometry, 2, cover);
    for (int i = 0; i < 16 * 16; i++)
        assert_int_equal(cover[i].draw, -1);
    sb_ref_geometry_free(&geometry);
}

static void lamps_stop_no_ray(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(0, 1, 0);
    variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
    struct sb_scene scene = made("sphere", &variant);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    const float *at = light_of(&scene, SB_LIGHT_POINT, 0)->position;
    const struct sb_ref_ray ray = {.origin = {at[0], at[1], at[2]},
                                   .direction = {at[0], at[1], at[2]},
                                   .far = INFINITY};
    assert_int_equal(scene.draw[1].lamp, 0);
    assert_false(sb_ref_geometry_blocked(geometry, &ray));
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
}

// --- leaks -----------------------------------------------------------------------------

// From inside a closed mesh at every corner and every point of every edge: whatever rounding
// does there, some triangle must be met.
static void check_closed(const struct sb_mesh *mesh, struct sb_vec3 by,
                         struct sb_vec3 eye)
{
    struct sb_scene scene = scene_of(mesh, 1);
    struct sb_draw *draw = (struct sb_draw *)scene.draw;
    draw->model[12] = (float)by.x;
    draw->model[13] = (float)by.y;
    draw->model[14] = (float)by.z;
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    struct sb_random random = sb_random_seed(3);
    const struct sb_vec3 from = sb_vec3_add(by, eye);
    for (int i = 0; i < mesh->index_count; i++) {
        const int next = i % 3 == 2 ? i - 2 : i + 1;
        const struct sb_vec3
            a = sb_ref_geometry_vertex(geometry, 0, (int)mesh->index[i]).position,
            b = sb_ref_geometry_vertex(geometry, 0, (int)mesh->index[next]).position;
        for (int k = 0; k < 6; k++) {
            const double t = k == 0 ? 0 : k == 1 ? 0.5 : sb_random_unit(&random);
            const struct sb_vec3 target =
                sb_vec3_add(a, sb_vec3_scale(sb_vec3_sub(b, a), t));
            const struct sb_ref_ray ray = {
                .origin = from, .direction = sb_vec3_sub(target, from), .far = INFINITY};
            assert_true(sb_ref_geometry_blocked(geometry, &ray));
            const double hit = sb_ref_geometry_hit(geometry, &ray);
            check_close(hit, 1, 1e-9 * (1 + fabs(by.x)));
        }
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
}

static void nothing_leaks_through_edges_and_corners(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    const struct sb_mesh mesh[2] = {sb_mesh_cube(&arena, 6),
                                    sb_mesh_sphere(&arena, 14, 20)};
    for (int i = 0; i < 2; i++) {
        // From the middle many rays run along axes and in the planes of boxes.
        check_closed(&mesh[i], (struct sb_vec3){0}, (struct sb_vec3){0});
        check_closed(&mesh[i], (struct sb_vec3){0}, (struct sb_vec3){0.1, -0.23, 0.31});
        check_closed(&mesh[i], (struct sb_vec3){1000.3, -70, 0.7},
                     (struct sb_vec3){0.11, 0.2, -0.3});
    }
    sb_arena_free(&arena);
}

// Where it runs from the origin along `axis`, through three corners and two sides of a triangle
// that faces it; zeros of both signs.
static void check_outline(int axis)
{
    static const double outline[][2] = {{0, 0.25}, {0.25, 0}, {0, 0}, {1, 0}, {0, 1}};
    float corner[3][3] = {{0}};
    for (int i = 0; i < 3; i++)
        corner[i][axis] = 2;
    corner[1][(axis + 1) % 3] = corner[2][(axis + 2) % 3] = 1;
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, (const float(*)[3])corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    for (size_t i = 0; i < 2 * (sizeof outline / sizeof *outline); i++) {
        const double zero = i % 2 == 0 ? 0.0 : -0.0;
        double from[3] = {0}, way[3] = {zero, zero, zero};
        from[(axis + 1) % 3] = outline[i / 2][0];
        from[(axis + 2) % 3] = outline[i / 2][1];
        way[axis] = 1;
        const struct sb_ref_ray ray = {.origin = {from[0], from[1], from[2]},
                                       .direction = {way[0], way[1], way[2]},
                                       .far = INFINITY};
        assert_true(sb_ref_geometry_hit(geometry, &ray) == 2);
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

static void a_ray_in_the_side_of_a_box_is_in_the_box(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++)
        check_outline(axis);
}

static void both_sides_of_a_triangle_stop_rays_and_the_limits_count(void **state)
{
    (void)state;
    const float corner[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    struct sb_arena arena = {0};
    const struct sb_mesh mesh = soup(&arena, corner, 1);
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_ref_geometry *geometry = sb_ref_geometry_new(&scene, 16, 16);
    sb_ref_geometry_rays(geometry);
    for (int side = -1; side <= 1; side += 2) {
        struct sb_ref_ray ray = {
            .origin = {0, 0, 3.0 * side}, .direction = {0, 0, -1.5 * side}, .far = 2};
        assert_true(sb_ref_geometry_hit(geometry, &ray) ==
                    2); // in units of the direction
        ray.far = 1.99;
        assert_true(sb_ref_geometry_hit(geometry, &ray) == INFINITY);
        ray.far = INFINITY;
        ray.near = 2;
        assert_true(sb_ref_geometry_hit(geometry, &ray) == 2);
        ray.near = 2.01;
        assert_false(sb_ref_geometry_blocked(geometry, &ray));
        // Half way from the lower edge to the upper corner; the truth is 3.
        double away;
        ray.near = 0;
        assert_true(sb_ref_geometry_corners_away(geometry, &ray, &away) == 2);
        check_close(away, 0.5 * sqrt(1 + 1 + 9) + 0.5 * sqrt(1 + 9), 1e-15);
        ray.far = 1.99;
        assert_true(sb_ref_geometry_corners_away(geometry, &ray, &away) == INFINITY);
        assert_true(away == INFINITY);
    }
    sb_ref_geometry_free(&geometry);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_the_nearest_of_random_triangles),
        cmocka_unit_test(rays_meet_the_nearest_triangle_of_every_shipped_scene),
        cmocka_unit_test(many_triangles_at_one_place_are_no_trouble),
        cmocka_unit_test(a_scene_of_nothing_stops_no_ray),
        cmocka_unit_test(lamps_stop_no_ray),
        cmocka_unit_test(nothing_leaks_through_edges_and_corners),
        cmocka_unit_test(a_ray_in_the_side_of_a_box_is_in_the_box),
        cmocka_unit_test(both_sides_of_a_triangle_stop_rays_and_the_limits_count),
    };
    return run_tests(tests);
}
