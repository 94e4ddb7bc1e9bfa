#include "test.h"

#include "math/mat.h"

static void check_vec3(struct sb_vec3 a, struct sb_vec3 b, double tolerance)
{
    check_close(a.x, b.x, tolerance);
    check_close(a.y, b.y, tolerance);
    check_close(a.z, b.z, tolerance);
}

static struct sb_vec3 through(struct sb_mat3 m, struct sb_vec3 v)
{
    return (struct sb_vec3){m.m[0] * v.x + m.m[3] * v.y + m.m[6] * v.z,
                            m.m[1] * v.x + m.m[4] * v.y + m.m[7] * v.z,
                            m.m[2] * v.x + m.m[5] * v.y + m.m[8] * v.z};
}

// Clip space, perspective divided out.
static struct sb_vec3 projected(struct sb_mat4 m, struct sb_vec3 p)
{
    double out[4];
    for (int row = 0; row < 4; row++)
        out[row] =
            m.m[row] * p.x + m.m[4 + row] * p.y + m.m[8 + row] * p.z + m.m[12 + row];
    return (struct sb_vec3){out[0] / out[3], out[1] / out[3], out[2] / out[3]};
}

static void product_applies_the_right_matrix_first(void **state)
{
    (void)state;
    const struct sb_mat4 move = sb_mat4_translation((struct sb_vec3){1, 2, 3});
    const struct sb_mat4 grow = sb_mat4_scaling(10);
    const struct sb_vec3 p = {1, 1, 1};
    check_vec3(sb_mat4_transform_point(sb_mat4_multiply(move, grow), p),
               (struct sb_vec3){11, 12, 13}, 0);
    check_vec3(sb_mat4_transform_point(sb_mat4_multiply(grow, move), p),
               (struct sb_vec3){20, 30, 40}, 0);
}

static void rotation_turns_counter_clockwise(void **state)
{
    (void)state;
    const struct sb_vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    check_vec3(sb_mat4_transform_point(sb_mat4_rotation(SB_PI / 2, z), x), y, 1e-15);
    check_vec3(sb_mat4_transform_point(sb_mat4_rotation(SB_PI / 2, x), y), z, 1e-15);
    check_vec3(sb_mat4_transform_point(sb_mat4_rotation(SB_PI / 2, y), z), x, 1e-15);
}

static void a_third_of_a_turn_about_the_diagonal_permutes_the_axes(void **state)
{
    (void)state;
    const struct sb_mat4 m = sb_mat4_rotation(2 * SB_PI / 3, (struct sb_vec3){7, 7, 7});
    check_vec3(sb_mat4_transform_point(m, (struct sb_vec3){1, 2, 3}),
               (struct sb_vec3){3, 1, 2}, 1e-14);
}

static void look_at_puts_the_target_on_the_negative_z_axis(void **state)
{
    (void)state;
    const struct sb_vec3 eye = {3, -4, 5}, target = {-1, 2, 2}, up = {0, 1, 0};
    const struct sb_mat4 view = sb_mat4_look_at(eye, target, up);
    const double distance = sqrt(16 + 36 + 9);
    check_vec3(sb_mat4_transform_point(view, eye), (struct sb_vec3){0, 0, 0}, 1e-14);
    check_vec3(sb_mat4_transform_point(view, target), (struct sb_vec3){0, 0, -distance},
               1e-14);
    // What is above the target is seen above it, and neither left nor right of it.
    const struct sb_vec3 above = sb_mat4_transform_point(view, sb_vec3_add(target, up));
    check_close(above.x, 0, 1e-14);
    assert_true(above.y > 0.5);
}

static void perspective_sends_the_frustum_to_the_cube(void **state)
{
    (void)state;
    const double fov = 1, aspect = 2, near = 0.5, far = 50;
    const struct sb_mat4 m = sb_mat4_perspective(fov, aspect, near, far);
    const double top = near * tan(fov / 2), bottom = -far * tan(fov / 2);
    check_vec3(projected(m, (struct sb_vec3){aspect * top, top, -near}),
               (struct sb_vec3){1, 1, -1}, 1e-14);
    check_vec3(projected(m, (struct sb_vec3){aspect * bottom, bottom, -far}),
               (struct sb_vec3){-1, -1, 1}, 1e-14);
}

// A plane's normal, after the matrix, must be what its transformed edges say.
static void check_normals(struct sb_mat4 m)
{
    const struct sb_vec3 a = {0.3, -1, 0.2}, b = {0.5, 0.4, -0.9};
    const struct sb_vec3 origin = sb_mat4_transform_point(m, (struct sb_vec3){0, 0, 0});
    const struct sb_vec3 a2 = sb_vec3_sub(sb_mat4_transform_point(m, a), origin);
    const struct sb_vec3 b2 = sb_vec3_sub(sb_mat4_transform_point(m, b), origin);
    const struct sb_vec3 n = through(sb_mat4_normal_matrix(m), sb_vec3_cross(a, b));
    const double length = sb_vec3_length(n);
    check_close(sb_vec3_dot(n, sb_vec3_normalise(a2)) / length, 0, 1e-14);
    check_close(sb_vec3_dot(n, sb_vec3_normalise(b2)) / length, 0, 1e-14);
    // The outside stays outside: a point in front of the plane stays in front of it.
    const struct sb_vec3 front = sb_vec3_cross(a, b);
    const struct sb_vec3 front2 = sb_vec3_sub(sb_mat4_transform_point(m, front), origin);
    assert_true(sb_vec3_dot(n, front2) > 0);
}

static struct sb_mat4 stretched(double x, double y, double z)
{
    const struct sb_mat4 turn = sb_mat4_rotation(0.7, (struct sb_vec3){1, -2, 0.5});
    const struct sb_mat4 stretch = {{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 10, 20, 30, 1}};
    return sb_mat4_multiply(turn, stretch);
}

static void normals_stay_normal_under_stretching_and_mirroring(void **state)
{
    (void)state;
    check_normals(stretched(1, 1, 1));
    check_normals(stretched(1, 5, 0.1));
    check_normals(stretched(-1, 1, 1));
    check_normals(stretched(-2, -3, -0.5));
}

static void even_scales_keep_unit_normals_down_to_the_smallest(void **state)
{
    (void)state;
    const struct sb_vec3 n = {0.6, 0, 0.8};
    const struct sb_mat3 turned = sb_mat4_normal_matrix(stretched(1, 1, 1));
    // The cofactors of 1e-170 are 1e-340, which no double holds.
    static const double scale[] = {1e-170, 1e-6, 3, 1e160};
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++) {
        const double s = scale[i];
        const struct sb_mat3 m = sb_mat4_normal_matrix(stretched(s, s, s));
        check_close(sb_vec3_length(through(m, n)), 1, 1e-14);
        check_vec3(through(m, n), through(turned, n), 1e-14);
    }
}

static void flattened_models_keep_the_normal_of_their_plane(void **state)
{
    (void)state;
    const struct sb_mat4 flat = {{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}};
    check_vec3(through(sb_mat4_normal_matrix(flat), (struct sb_vec3){0, 0, 1}),
               (struct sb_vec3){0, 0, 1}, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(product_applies_the_right_matrix_first),
        cmocka_unit_test(rotation_turns_counter_clockwise),
        cmocka_unit_test(a_third_of_a_turn_about_the_diagonal_permutes_the_axes),
        cmocka_unit_test(look_at_puts_the_target_on_the_negative_z_axis),
        cmocka_unit_test(perspective_sends_the_frustum_to_the_cube),
        cmocka_unit_test(normals_stay_normal_under_stretching_and_mirroring),
        cmocka_unit_test(even_scales_keep_unit_normals_down_to_the_smallest),
        cmocka_unit_test(flattened_models_keep_the_normal_of_their_plane),
    };
    return run_tests(tests);
}
