// Bounds and reach against brute force: nothing that touches, or is lit, is ever missed.
#include "scene.h"

#include <math.h>

#include "effects/reach.h"
#include "math/mat.h"
#include "math/random.h"
#include "scene/make.h"

enum { POINTS = 400, TRIES = 300 };

static struct sb_vec3 any(struct sb_random *random, double size)
{
    return (struct sb_vec3){size * (2 * sb_random_unit(random) - 1),
                            size * (2 * sb_random_unit(random) - 1),
                            size * (2 * sb_random_unit(random) - 1)};
}

static struct sb_vec3 placed(const struct sb_draw *draw, const float p[3])
{
    const float *m = draw->model;
    const double x = p[0], y = p[1], z = p[2];
    return (struct sb_vec3){m[0] * x + m[4] * y + m[8] * z + m[12],
                            m[1] * x + m[5] * y + m[9] * z + m[13],
                            m[2] * x + m[6] * y + m[10] * z + m[14]};
}

// A point of a triangle of the draw.
static struct sb_vec3 on_draw(struct sb_random *random, const struct sb_scene *scene,
                              int draw)
{
    const struct sb_mesh *mesh = &scene->mesh[scene->draw[draw].mesh];
    const int triangle = (int)sb_random_below(random, (uint32_t)mesh->index_count / 3);
    double a = sb_random_unit(random), b = sb_random_unit(random);
    if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    struct sb_vec3 corner[3];
    for (int i = 0; i < 3; i++)
        corner[i] = placed(&scene->draw[draw],
                           mesh->vertex[mesh->index[3 * triangle + i]].position);
    return sb_vec3_add(
        sb_vec3_scale(corner[0], 1 - a - b),
        sb_vec3_add(sb_vec3_scale(corner[1], a), sb_vec3_scale(corner[2], b)));
}

static void boxes_and_spheres_hold_their_draws(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    const struct sb_variant variant = scene_variant(0, 1, 0);
    for (int s = 0; s < sb_scene_row_count; s++) {
        struct sb_scene scene = made(sb_scene_rows[s].name, &variant);
        for (int d = 0; d < scene.draw_count; d++) {
            struct sb_bounds bounds;
            sb_bounds_of(&scene, d, &bounds);
            for (int i = 0; i < 50; i++) {
                const struct sb_vec3 p = on_draw(&random, &scene, d),
                                     from = any(&random, 9);
                const double distance = sb_vec3_length(sb_vec3_sub(p, from));
                assert_true(sb_vec3_length(sb_vec3_sub(p, bounds.centre)) <=
                            bounds.radius * (1 + 1e-9));
                assert_true(sb_bounds_distance(&bounds, p) < 1e-9);
                assert_true(sb_bounds_distance(&bounds, from) <= distance + 1e-9);
                if (bounds.flat)
                    check_close(sb_vec3_dot(bounds.normal, p), bounds.offset, 1e-5);
            }
        }
        sb_scene_free(&scene);
    }
}

static struct sb_bounds ball(struct sb_vec3 centre, double radius)
{
    const struct sb_vec3 all = {radius, radius, radius};
    return (struct sb_bounds){.low = sb_vec3_sub(centre, all),
                              .high = sb_vec3_add(centre, all),
                              .centre = centre,
                              .radius = radius};
}

static struct sb_vec3 in_ball(struct sb_random *random, const struct sb_bounds *ball)
{
    for (;;) {
        const struct sb_vec3 p = any(random, ball->radius);
        if (sb_vec3_length(p) <= ball->radius)
            return sb_vec3_add(ball->centre, p);
    }
}

static void no_point_of_a_sphere_in_a_cone_is_missed(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(2);
    int outside = 0;
    for (int t = 0; t < TRIES; t++) {
        const struct sb_bounds it = ball(any(&random, 5), 2 * sb_random_unit(&random));
        const struct sb_vec3 apex = any(&random, 5);
        const struct sb_vec3 axis = sb_vec3_normalise(any(&random, 1));
        const double angle = SB_PI * sb_random_unit(&random);
        const bool in = sb_bounds_in_cone(&it, apex, axis, angle);
        outside += !in;
        for (int i = 0; i < POINTS && !in; i++) {
            const struct sb_vec3 way = sb_vec3_sub(in_ball(&random, &it), apex);
            assert_true(sb_vec3_dot(way, axis) < cos(angle) * sb_vec3_length(way) + 1e-9);
        }
    }
    assert_in_range(outside, TRIES / 5, TRIES); // it does tell
}

static void no_point_between_is_missed(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    int apart = 0;
    for (int t = 0; t < TRIES; t++) {
        const struct sb_bounds receiver = ball(any(&random, 6), sb_random_unit(&random));
        const struct sb_bounds other = ball(any(&random, 6), sb_random_unit(&random));
        const struct sb_vec3 light = any(&random, 6);
        const bool between = sb_bounds_between(&receiver, light, &other);
        apart += !between;
        for (int i = 0; i < POINTS && !between; i++) {
            // From the light to a point of the receiver: is any of it in the other?
            const struct sb_vec3 to = in_ball(&random, &receiver);
            const double share = sb_random_unit(&random);
            const struct sb_vec3 p =
                sb_vec3_add(light, sb_vec3_scale(sb_vec3_sub(to, light), share));
            assert_true(sb_vec3_length(sb_vec3_sub(p, other.centre)) >= other.radius);
        }
    }
    assert_in_range(apart, TRIES / 5, TRIES);
}

static void what_lies_behind_a_plane_does_not_shadow_it(void **state)
{
    (void)state;
    struct sb_bounds ground = ball((struct sb_vec3){0, 0, 0}, 1);
    ground.flat = true;
    ground.normal = (struct sb_vec3){0, 1, 0};
    const struct sb_vec3 light = {0, 3, 0};
    struct sb_bounds other = ball((struct sb_vec3){0, -0.5, 0}, 0.5);
    assert_false(sb_bounds_between(&ground, light, &other));
    other = ball((struct sb_vec3){0, 0.5, 0}, 0.6);
    assert_true(sb_bounds_between(&ground, light, &other));
}

// --- shapes --------------------------------------------------------------------------------

static void cubes_and_planes_are_even_and_convex_and_spheres_round(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    struct sb_shape_facts facts;
    const struct sb_mesh cube = sb_mesh_cube(&arena, 3),
                         plane = sb_mesh_plane(&arena, 2, 3, 4, 5),
                         sphere = sb_mesh_sphere(&arena, 9, 18);
    sb_shape_facts_of(&cube, &facts);
    assert_true(facts.even && facts.convex);
    sb_shape_facts_of(&plane, &facts);
    assert_true(facts.even && facts.convex);
    sb_shape_facts_of(&sphere, &facts);
    assert_true(!facts.even && facts.convex);
    // A cube with a corner pushed in.
    struct sb_vertex *vertex = (struct sb_vertex *)cube.vertex;
    for (int i = 0; i < cube.vertex_count; i++)
        if (vertex[i].position[0] > 0.4f && vertex[i].position[1] > 0.4f &&
            vertex[i].position[2] > 0.4f)
            vertex[i].position[1] = 0;
    sb_shape_facts_of(&cube, &facts);
    assert_false(facts.convex);
    vertex[0].normal[0] += 0.5f;
    sb_shape_facts_of(&cube, &facts);
    assert_false(facts.even);
    sb_arena_free(&arena);
}

static void only_turned_and_moved_draws_keep_the_length_of_normals(void **state)
{
    (void)state;
    const struct sb_placement place = {.scale = 1, .aspect = 1};
    const struct sb_vec3 up = {0, 1, 0};
    struct sb_draw draw = sb_draw_make(&place, 0, 0, sb_mat4_rotation(1, up));
    assert_true(sb_draw_keeps_length(&draw));
    struct sb_mat4 squeezed = sb_mat4_rotation(0, up);
    squeezed.m[5] = 0.5;
    draw = sb_draw_make(&place, 0, 0, squeezed);
    assert_false(sb_draw_keeps_length(&draw));
}

// --- fall-off --------------------------------------------------------------------------------

static void factors_fall_and_end_where_their_law_says(void **state)
{
    (void)state;
    struct sb_variant v = scene_variant(0, 1, 0);
    const struct sb_light light = {
        .range = 5, .constant = 1, .linear = 0.3, .quadratic = 0.2, .intensity = 1};
    static const int laws[] = {SB_ATTENUATION_NONE, SB_ATTENUATION_POLYNOMIAL,
                               SB_ATTENUATION_RADIUS, SB_ATTENUATION_WINDOWED};
    for (int l = 0; l < 4; l++) {
        v.value[SB_AXIS_ATTENUATION] = laws[l];
        double before = INFINITY;
        for (int i = 0; i <= 100; i++) {
            const double factor = sb_reach_factor(&v, &light, 0.1 * i);
            assert_true(factor <= before && factor >= 0);
            before = factor;
        }
    }
    v.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_RADIUS;
    check_close(sb_reach_distance(&v, &light, 1e-9), 5, 1e-6);
    check_close(sb_reach_distance(&v, &light, 0.5), 2.5, 1e-9);
    v.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_WINDOWED;
    check_close(sb_reach_distance(&v, &light, 1e-12), 5, 1e-3);
    v.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_POLYNOMIAL;
    // 1 + 0.3 d + 0.2 d^2 = 100 at d = (sqrt(0.09 + 79.2) - 0.3) / 0.4.
    check_close(sb_reach_distance(&v, &light, 0.01), (sqrt(79.29) - 0.3) / 0.4, 1e-5);
    v.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_NONE;
    assert_true(isinf(sb_reach_distance(&v, &light, 0.5)));
    v.value[SB_AXIS_F_ATTENUATION] = SB_F_ATTENUATION_NAIVE;
    assert_true(isinf(sb_reach_factor(&v, &light, 1e6)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_and_spheres_hold_their_draws),
        cmocka_unit_test(no_point_of_a_sphere_in_a_cone_is_missed),
        cmocka_unit_test(no_point_between_is_missed),
        cmocka_unit_test(what_lies_behind_a_plane_does_not_shadow_it),
        cmocka_unit_test(cubes_and_planes_are_even_and_convex_and_spheres_round),
        cmocka_unit_test(only_turned_and_moved_draws_keep_the_length_of_normals),
        cmocka_unit_test(factors_fall_and_end_where_their_law_says),
    };
    return run_tests(tests);
}
