// Shadows of the reference: which texel a direction meets and what it holds, against cameras,
// enumeration and a projection matrix; and what is seen of a light over a ball and a plane,
// against tangents.
#include "lit_world.h"

#include "math/mat.h"
#include "math/random.h"

static const struct {
    struct sb_vec3 forward, up;
} cameras[6] = {
    // docs/glsl.md: along the axes, with y up for X and Z, x for YP and -x for YN
    {{1, 0, 0}, {0, 1, 0}},   {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}},
    {{0, -1, 0}, {-1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}},
};

// Where a camera sees a direction, from -1 to 1; false where it does not.
static bool seen_by(int face, struct sb_vec3 d, double at[2])
{
    const double depth = sb_vec3_dot(d, cameras[face].forward);
    const struct sb_vec3 right = sb_vec3_cross(cameras[face].forward, cameras[face].up);
    at[0] = sb_vec3_dot(d, right) / depth;
    at[1] = sb_vec3_dot(d, cameras[face].up) / depth;
    return depth > 0 && fabs(at[0]) <= 1 && fabs(at[1]) <= 1;
}

static double between(struct sb_random *random, double low, double high)
{
    return low + (high - low) * sb_random_unit(random);
}

static struct sb_vec3 any_vector(struct sb_random *random)
{
    return (struct sb_vec3){between(random, -1, 1), between(random, -1, 1),
                            between(random, -1, 1)};
}

static void a_direction_meets_the_texel_that_the_camera_of_its_face_shows_it_in(
    void **state)
{
    (void)state;
    enum { SIZE = 37 };
    struct sb_random random = sb_random_seed(1);
    for (int i = 0; i < 20000; i++) {
        const struct sb_vec3 d = any_vector(&random);
        const struct sb_ref_texel texel = sb_ref_texel_of(d, SIZE);
        double at[2];
        assert_true(seen_by(texel.face, d, at));
        assert_int_equal(texel.x, (int)floor((at[0] + 1) / 2 * SIZE));
        assert_int_equal(texel.y, (int)floor((at[1] + 1) / 2 * SIZE));
    }
}

static void every_texel_is_met_through_its_centre(void **state)
{
    (void)state;
    enum { SIZE = 16 };
    for (int i = 0; i < 6 * SIZE * SIZE; i++) {
        const struct sb_ref_texel texel = {i / (SIZE * SIZE), i % SIZE, i / SIZE % SIZE};
        const struct sb_vec3 d = sb_ref_texel_centre(texel, SIZE);
        double at[2];
        assert_true(seen_by(texel.face, d, at));
        check_close(at[0], (texel.x + 0.5) / SIZE * 2 - 1, 1e-15);
        check_close(at[1], (texel.y + 0.5) / SIZE * 2 - 1, 1e-15);
        assert_true(sb_vec3_dot(d, cameras[texel.face].forward) == 1);
        const struct sb_ref_texel again = sb_ref_texel_of(sb_vec3_scale(d, 3), SIZE);
        assert_true(again.face == texel.face && again.x == texel.x && again.y == texel.y);
    }
}

static void edges_and_corners_belong_to_z_before_x_before_y(void **state)
{
    (void)state;
    for (int i = 0; i < 27; i++) {
        const struct sb_vec3 d = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        if (i == 13)
            continue; // no direction
        const int face = d.z != 0   ? (d.z > 0 ? 4 : 5)
                         : d.x != 0 ? (d.x > 0 ? 0 : 1)
                                    : (d.y > 0 ? 2 : 3);
        const struct sb_ref_texel texel = sb_ref_texel_of(d, 8);
        assert_int_equal(texel.face, face);
        assert_in_range(texel.x, 0, 7); // also at the very edge
        assert_in_range(texel.y, 0, 7);
    }
}

static void taps_form_a_square_of_texels_around_the_direction(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    struct sb_random random = sb_random_seed(2);
    for (int i = 0; i < 2000; i++) {
        const struct sb_vec3 d = any_vector(&random);
        const int face = sb_ref_texel_of(d, SIZE).face, side = i % 2 ? 4 : 2;
        struct sb_vec3 tap[16];
        double middle[2];
        seen_by(face, d, middle);
        sb_ref_taps(side, SIZE, d, tap);
        bool found[16] = {false};
        for (int t = 0; t < side * side; t++) {
            double at[2];
            seen_by(face, tap[t], at); // or a little beyond the face
            const double x = (at[0] - middle[0]) * SIZE / 2 + 0.5 * (side - 1);
            const double y = (at[1] - middle[1]) * SIZE / 2 + 0.5 * (side - 1);
            check_close(x, rint(x), 1e-12);
            check_close(y, rint(y), 1e-12);
            assert_in_range((int)rint(x), 0, side - 1);
            assert_in_range((int)rint(y), 0, side - 1);
            found[(int)rint(x) * side + (int)rint(y)] = true;
        }
        for (int t = 0; t < side * side; t++)
            assert_true(found[t]);
    }
    struct sb_vec3 one;
    sb_ref_taps(1, SIZE, (struct sb_vec3){1, 2, 3}, &one);
    assert_true(one.x == 1 && one.y == 2 && one.z == 3);
}

static void a_half_float_is_the_nearest_of_all(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    for (int i = 0; i < 300; i++) {
        const double x = between(&random, -0.73, 1) * (i % 3 ? 1 : 1e-5);
        double best = 0;
        for (int bits = 0; bits <= 0x3c00; bits++) { // 0 to 1
            const int exponent = bits >> 10, fraction = bits & 0x3ff;
            const double half =
                exponent ? ldexp(1024 + fraction, exponent - 25) : ldexp(fraction, -24);
            if (fabs(fabs(x) - half) < fabs(fabs(x) - best))
                best = half;
        }
        check_close(sb_ref_stored(SB_SHADOW_STORE_R16F, 0.5, 1 - x), copysign(best, x),
                    1e-17);
    }
    // Ties go to even.
    const double tie = 0.5 + ldexp(1, -12), next = 0.5 + ldexp(3, -12);
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R16F, 0.5, 1 - tie) == 0.5);
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R16F, 0.5, 1 - next) ==
                0.5 + ldexp(1, -10));
}

static void a_map_stores_the_distance_or_the_depth_in_its_format(void **state)
{
    (void)state;
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R32F, 0.5, 0.7) == (float)(1 - 0.7));
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R8, 0.5, 0.7) == 77 / 255.0); // 76.5
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R8, 0.9, 1.2) == 0);          // clamped
    assert_true(sb_ref_stored(SB_SHADOW_STORE_R32F, 0.9, 1.25) == -0.25);
    for (int store = 0; store < SB_SHADOW_STORE_VALUE_COUNT; store++) // cleared
        assert_true(sb_ref_stored(store, INFINITY, INFINITY) ==
                    (store == SB_SHADOW_STORE_DEPTH));
    const struct sb_mat4 projection = sb_mat4_perspective(SB_PI / 2, 1, 0.001, 1);
    for (double depth = 0.001; depth <= 1; depth += 0.037) {
        const double clip_z = -projection.m[10] * depth + projection.m[14];
        check_close(sb_ref_stored(SB_SHADOW_STORE_DEPTH, depth, 1),
                    (clip_z / depth + 1) / 2, 0.51 / 16777215);
    }
}

static void a_slope_makes_the_bias_larger_up_to_ten_times(void **state)
{
    (void)state;
    struct sb_ref_choice choice = {.bias = 0.25, .bias_slopes = true};
    check_close(sb_ref_bias(&choice, 1), 0.25, 0);
    check_close(sb_ref_bias(&choice, cos(0.5)), 0.25 * (1 + tan(0.5)), 1e-15);
    check_close(sb_ref_bias(&choice, cos(1.57)), 2.5, 0);
    check_close(sb_ref_bias(&choice, 0), 2.5, 0);
    check_close(sb_ref_bias(&choice, -1), 2.5, 0);
    choice.bias_slopes = false;
    check_close(sb_ref_bias(&choice, 0.1), 0.25, 0);
}

// --- the ball over the plane ----------------------------------------------------------------

// Only asked whether it is NULL.
static const struct sb_ref_geometry *const there = (const void *)"";

enum { HEIGHT = 5 }; // of the light above the middle of the ball
static const double edge =
    7 * 0.2041241452319315; // tan(asin(1/5)): of the shadow on y = -2

static void over_a_ball(struct world *world, const char *words, double range)
{
    world_make(world, words);
    world_add(world, SB_LIGHT_POINT, 0, HEIGHT, 0)->range = (float)range;
    world->scene.lights = world->shading.lights;
    world->shading.geometry = there;
    world->input.normal = (struct sb_vec3){0, 1, 0};
}

static double shown_at(struct world *world, double x, double y, double z)
{
    struct sb_ref_terms terms;
    world->input.position = (struct sb_vec3){x, y, z};
    const struct sb_ref_shade made = shade(world, &terms);
    const uint32_t shadow = sb_ref_decide(0, (int)(16 * terms.shown[0] + 0.5));
    assert_int_equal(made.decisions, sb_ref_decide(shadow, terms.n_dot_l[0] > 0));
    assert_true(made.diffuse.x == terms.diffuse_weight[0]); // of white light on white
    assert_true(made.specular.x == terms.specular_weight[0]);
    return terms.shown[0];
}

static void the_ideal_shadow_ends_where_the_tangent_does(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    world.shading.ideal = true;
    for (int i = 0; i < 64; i++) {
        const double x = cos(i * 0.1), z = sin(i * 0.1);
        const double in = edge * (1 - 1e-5), out = edge * (1 + 1e-5);
        assert_true(shown_at(&world, in * x, -2, in * z) == 0);
        assert_true(shown_at(&world, out * x, -2, out * z) == 1);
    }
}

static void a_lit_surface_does_not_shadow_itself(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    world.shading.ideal = true;
    const double horizon = 1.0 / HEIGHT; // the y of points that see the light at its edge
    struct sb_random random = sb_random_seed(4);
    for (int i = 0; i < 2000; i++) {
        const double y = between(&random, -1, 1), turn = between(&random, 0, 7);
        const double r = sqrt(1 - y * y);
        if (fabs(y - horizon) < 1e-5)
            continue;
        world.input.normal = (struct sb_vec3){r * cos(turn), y, r * sin(turn)};
        assert_true(shown_at(&world, r * cos(turn), y, r * sin(turn)) == (y > horizon));
    }
}

// Nor does a normal that lies in the surface lead into it.
static void the_normal_of_a_lit_surface_may_lean(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    world.shading.ideal = true;
    for (int i = 0; i < 200; i++) {
        world.input.normal = (struct sb_vec3){cos(i), 0, sin(i)};
        assert_true(shown_at(&world, 3 + 0.01 * i, -2, 0.3) == 1);
    }
}

static void a_place_that_is_rounded_into_the_surface_sees_grazing_light(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    world.shading.ideal = true;
    world.light[0].position[1] = -2 + 1e-6f;
    assert_true(shown_at(&world, 5, -2 - 1e-11, 0) == 1);
}

static void what_is_behind_the_light_casts_no_shadow(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    world.light[0].position[1] = -1.25f; // between ball and plane
    for (int ideal = 0; ideal < 2; ideal++) {
        world.shading.ideal = ideal;
        assert_true(shown_at(&world, 0.25, -2, 0) == 1);
    }
}

static void what_lies_beyond_the_range_is_not_lit(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 10);
    world.shading.ideal = true;
    const double rim = sqrt(100 - 49);
    assert_true(shown_at(&world, rim * 0.9999, -2, 0) == 1);
    assert_true(shown_at(&world, rim * 1.0001, -2, 0) == 0);
    // By a map the same: the bias lights nothing beyond the range, but for f_shadow=naive.
    world.shading.ideal = false;
    assert_true(shown_at(&world, rim * 0.999, -2, 0) == 1);
    assert_true(shown_at(&world, rim * 1.0001, -2, 0) == 0);
    world.variant.value[SB_AXIS_F_SHADOW] = SB_F_SHADOW_NAIVE;
    assert_true(shown_at(&world, rim * 1.0001, -2, 0) == 1);
    world.shading.geometry = NULL; // no shadows at all
    assert_true(shown_at(&world, rim * 1.0001, -2, 0) == 1);
}

// A turn that is not its own inverse, and a move by whole numbers: floats have both exactly.
static void look_along_x(struct sb_camera *camera)
{
    static const float view[16] = {0, 0, -1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 3, -2, -7, 1};
    memcpy(camera->view, view, sizeof view);
}

static struct sb_vec3 turned(struct sb_vec3 v)
{
    return (struct sb_vec3){v.y, -v.z, -v.x};
}

static void shadows_are_the_same_in_view_space(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    for (int i = 0; i < 400; i++) {
        struct world world;
        over_a_ball(&world, "point=1,shadows=1,space=view,shadow_size=32,shadow_filter=4",
                    20);
        world.shading.ideal = i % 2;
        const struct sb_vec3 at = {between(&random, -3, 3), -2, between(&random, -3, 3)};
        const double shown = shown_at(&world, at.x, at.y, at.z);
        look_along_x(&world.scene.camera);
        struct sb_light seen =
            sb_light_to_view(&world.light[0], SB_LIGHT_POINT, &world.scene.camera, false);
        world.shading.view_space = true;
        world.shading.lights.light = &seen;
        world.input.normal = turned(world.input.normal);
        const struct sb_vec3 there_at = turned(at);
        const double again =
            shown_at(&world, there_at.x + 3, there_at.y - 2, there_at.z - 7);
        check_close(again, shown, 0);
    }
}

// What a map shows differs from what is seen only near the edge of the shadow: by half a texel,
// and by what the bias lets through.
static void a_fine_map_shows_what_is_seen_but_near_the_edge(void **state)
{
    (void)state;
    static const char *const stores[] = {"r8", "r16f", "r32f", "depth"};
    static const char *const filters[] = {"1", "4", "16"};
    struct sb_random random = sb_random_seed(6);
    for (int i = 0; i < 12; i++) {
        struct world world;
        char words[200];
        snprintf(words, sizeof words,
                 "point=1,shadows=1,shadow_size=2048,shadow_bias=0.01,shadow_store=%s,"
                 "shadow_filter=%s",
                 stores[i % 4], filters[i / 4]);
        over_a_ball(&world, words, 20);
        for (int p = 0; p < 300; p++) {
            const double r = between(&random, 0, 4), turn = between(&random, 0, 7);
            if (fabs(r - edge) < 0.02)
                continue;
            const double shown = shown_at(&world, r * cos(turn), -2, r * sin(turn));
            assert_true(shown == (r > edge));
        }
    }
}

// Across the edge the share grows by steps of a tap.
static void the_share_of_a_filter_counts_its_taps(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1,shadow_size=64,shadow_filter=16", 20);
    bool met[17] = {false};
    for (int i = 0; i < 4000; i++) {
        const double share =
            16 * shown_at(&world, edge - 0.8 + 1.6 * i / 4000, -2, 0.01 * (i % 40));
        assert_true(share == floor(share) && share >= 0 && share <= 16);
        met[(int)share] = true;
    }
    int different = 0;
    for (int i = 0; i <= 16; i++)
        different += met[i];
    assert_true(met[0] && met[16] && different >= 5);
}

static void the_light_itself_is_lit_and_only_casters_cast(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1", 20);
    assert_true(shown_at(&world, 0, HEIGHT, 0) == 1);
    world.shading.ideal = true;
    assert_true(shown_at(&world, 0, HEIGHT, 0) == 1);
    struct sb_ref_terms terms[2];
    world_add(&world, SB_LIGHT_POINT, 0, HEIGHT, 0);
    world.input.position = (struct sb_vec3){0, -2, 0};
    shade(&world, terms);
    assert_true(terms[0].shown[0] == 0 && terms[0].diffuse_weight[0] == 0);
    assert_true(terms[1].shown[0] == 1 && terms[1].diffuse_weight[0] == 1);
}

static void a_shadow_takes_all_but_ambient_light(void **state)
{
    (void)state;
    struct world world;
    over_a_ball(&world, "point=1,shadows=1,ambient=per_light,attenuation=none", 20);
    put3(world.light[0].ambient, 0.5, 0.25, 1);
    put3(world.material.ambient, 1, 1, 1);
    world.scene.camera.eye[1] = HEIGHT; // a highlight, were there light
    for (int ideal = 0; ideal < 2; ideal++) {
        world.shading.ideal = ideal;
        world.input.position = (struct sb_vec3){0, -2, 0};
        const struct sb_ref_shade made = shade(&world, NULL);
        assert_true(made.diffuse.x == 0.5 && made.diffuse.y == 0.25 &&
                    made.diffuse.z == 1);
        assert_true(made.specular.x == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            a_direction_meets_the_texel_that_the_camera_of_its_face_shows_it_in),
        cmocka_unit_test(every_texel_is_met_through_its_centre),
        cmocka_unit_test(edges_and_corners_belong_to_z_before_x_before_y),
        cmocka_unit_test(taps_form_a_square_of_texels_around_the_direction),
        cmocka_unit_test(a_half_float_is_the_nearest_of_all),
        cmocka_unit_test(a_map_stores_the_distance_or_the_depth_in_its_format),
        cmocka_unit_test(a_slope_makes_the_bias_larger_up_to_ten_times),
        cmocka_unit_test(the_ideal_shadow_ends_where_the_tangent_does),
        cmocka_unit_test(a_lit_surface_does_not_shadow_itself),
        cmocka_unit_test(the_normal_of_a_lit_surface_may_lean),
        cmocka_unit_test(a_place_that_is_rounded_into_the_surface_sees_grazing_light),
        cmocka_unit_test(what_is_behind_the_light_casts_no_shadow),
        cmocka_unit_test(what_lies_beyond_the_range_is_not_lit),
        cmocka_unit_test(shadows_are_the_same_in_view_space),
        cmocka_unit_test(a_fine_map_shows_what_is_seen_but_near_the_edge),
        cmocka_unit_test(the_share_of_a_filter_counts_its_taps),
        cmocka_unit_test(the_light_itself_is_lit_and_only_casters_cast),
        cmocka_unit_test(a_shadow_takes_all_but_ambient_light),
    };
    return run_tests(tests);
}
