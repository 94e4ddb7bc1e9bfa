// The hard cases of vectors, normals and tangent frames: robust forms hold, naive ones are caught,
// and what holds at the catalogue's inputs holds at others too.
#include "cases/vectors.h"
#include "case_world.h"
#include "cases/unit.h"

static void robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_vectors);
    check_vertex("zero-normal");
}

static void naive_forms_are_caught(void **state)
{
    (void)state;
    static const char *const both[] = {
        "zero-normal", "normal-shortening", "antipodal-normals", "tbn-parallel",
        "normalmap-z", "normalmap-flat",    "half-vector-zero",  "reflect-nonunit",
    };
    for (size_t i = 0; i < sizeof both / sizeof *both; i++)
        check_naive(both[i], SB_IN_HIGHP | SB_IN_HALF);
    check_naive("normal-nonuniform", SB_IN_HIGHP);
    check_naive("normal-singular", SB_IN_HIGHP);
    check_naive("large-world", SB_IN_HIGHP);
    check_naive("world-pos-16", SB_IN_HALF);
    if (case_half == SB_CASE_EMULATED) // llvmpipe's mediump coordinates have 32 bits
        check_naive("fragcoord-16", SB_IN_HALF);
}

// --- inputs that are not in the catalogue -------------------------------------------------

static struct sb_vec3 scaled(struct sb_random *random, struct sb_vec3 v, double lowest)
{
    return sb_vec3_scale(v, pow(2, lowest * sb_random_unit(random)));
}

static void put(float *out, struct sb_vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

// Normals of any length, and none.
static void any_normals(struct sb_random *random, struct sb_points *points)
{
    struct sb_vec3 normal = sb_any_direction(random);
    normal = sb_random_below(random, 8) ? scaled(random, normal, -5)
                                        : sb_vec3_scale(normal, 0);
    sb_vectors_add(points, &(struct sb_vectors_point){normal, sb_any_direction(random),
                                                      sb_any_direction(random)});
}

// Between two normals up to 120 degrees apart, anywhere.
static void between_any_normals(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 up = sb_any_direction(random);
    const struct sb_vec3 across = sb_vectors_across(up);
    const double t = sb_random_unit(random), slope = 3 * sb_random_unit(random);
    const struct sb_vec3 lean =
        sb_vec3_normalise(sb_vec3_add(up, sb_vec3_scale(across, slope)));
    const struct sb_vec3 normal =
        sb_vec3_add(sb_vec3_scale(up, t), sb_vec3_scale(lean, 1 - t));
    sb_vectors_add(points, &(struct sb_vectors_point){
                               normal, sb_vec3_add(up, sb_vec3_scale(across, 0.5)),
                               sb_vec3_sub(up, sb_vec3_scale(across, 0.5))});
}

// Any tangent: along the normal, across it, none, and a bitangent that is rounding only.
static void any_frames(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 normal = sb_any_direction(random);
    const struct sb_vec3 light =
        sb_vec3_add(normal, sb_vec3_scale(sb_any_direction(random), 0.5));
    struct sb_point *point =
        sb_vectors_add(points, &(struct sb_vectors_point){normal, light, light});
    struct sb_vec3 tangent = sb_vec3_scale(normal, 2 * sb_random_unit(random) - 1);
    if (sb_random_below(random, 2))
        tangent = sb_vec3_cross(normal, sb_any_direction(random));
    if (sb_random_below(random, 4) == 0)
        tangent = (struct sb_vec3){0, 0, 0};
    put(point->tangent, tangent);
    put(point->bitangent, sb_vec3_cross(normal, tangent));
    for (int c = 0; c < 3; c++)
        point->texel[SB_MAP_NORMAL][c] =
            (float)((c == 2 ? 0.75 : 0.375) + 0.25 * sb_random_unit(random));
}

// Texels outside of the circle, of 8 bits.
static void any_long_bumps(struct sb_random *random, struct sb_points *points)
{
    struct sb_point *point = sb_vectors_add(
        points, &(struct sb_vectors_point){
                    {0, 0, 1}, sb_any_direction(random), sb_any_direction(random)});
    int x, y;
    do {
        x = (int)sb_random_below(random, 255) + 1;
        y = (int)sb_random_below(random, 255) + 1;
    } while ((x - 128) * (x - 128) + (y - 128) * (y - 128) < 130 * 130);
    for (int c = 0; c < 3; c++)
        point->texel[SB_MAP_NORMAL][c] = (float[3]){(float)x, (float)y, 128}[c] / 255;
}

// The flat texel, any frame at right angles to any normal.
static void any_flat_bumps(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 normal = sb_any_direction(random);
    const struct sb_vec3 across = sb_vectors_across(normal);
    struct sb_point *point = sb_vectors_add(
        points, &(struct sb_vectors_point){
                    normal, sb_vec3_add(normal, sb_vec3_scale(across, 0.3)), normal});
    put(point->tangent, across);
    put(point->bitangent, sb_vec3_cross(normal, across));
    for (int c = 0; c < 3; c++)
        point->texel[SB_MAP_NORMAL][c] = (float)((c == 2 ? 255 : 128) / 255.0);
}

static struct sb_vec3 eighths(struct sb_random *random)
{
    double v[3];
    for (int c = 0; c < 3; c++)
        v[c] = ((double)sb_random_below(random, 32) - 15.5) / 8;
    return (struct sb_vec3){v[0], v[1], v[2]};
}

// Light and eye on one line through a point anywhere: sums and differences are exact.
static void any_opposite_eyes(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 at = eighths(random), d = eighths(random);
    struct sb_point *point = sb_vectors_add(
        points, &(struct sb_vectors_point){sb_any_direction(random), sb_vec3_add(at, d),
                                           sb_vec3_sub(at, d)});
    put(point->position, at);
}

static void any_peaks(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 normal = sb_any_direction(random);
    const struct sb_vec3 across = sb_vectors_across(normal);
    const struct sb_vec3 side = sb_vec3_scale(across, sb_random_unit(random));
    sb_vectors_add(
        points,
        &(struct sb_vectors_point){normal, scaled(random, sb_vec3_add(normal, side), 5),
                                   scaled(random, sb_vec3_sub(normal, side), 5)})
        ->material.shininess = (float)pow(2, 10 * sb_random_unit(random));
}

static void any_places(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 at = scaled(random, sb_any_direction(random), 13);
    const struct sb_vec3 normal = sb_any_direction(random);
    struct sb_point *point = sb_vectors_add(
        points, &(struct sb_vectors_point){
                    normal, sb_vec3_add(at, sb_any_direction(random)), {0, 0, 0}});
    put(point->position, at);
}

static const struct other {
    const char *id;
    void (*add)(struct sb_random *random, struct sb_points *points);
} others[] = {
    {"zero-normal", any_normals},
    {"normal-shortening", between_any_normals},
    {"antipodal-normals", any_normals},
    {"tbn-parallel", any_frames},
    {"normalmap-z", any_long_bumps},
    {"normalmap-flat", any_flat_bumps},
    {"half-vector-zero", any_opposite_eyes},
    {"reflect-nonunit", any_peaks},
    {"world-pos-16", any_places},
};

static void add_others(struct sb_points *points, const struct sb_case_setting *setting,
                       const void *user)
{
    const struct other *other = user;
    struct sb_random random = sb_random_seed(23);
    (void)setting;
    for (int i = 0; i < 500; i++)
        other->add(&random, points);
}

static void robust_forms_hold_at_other_inputs(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        check_inputs(case_of(others[i].id), SB_IN_HIGHP | 1u << SB_CASE_HALF,
                     &(struct inputs){.add = add_others, .user = &others[i]});
}

// --- relations ----------------------------------------------------------------------------

// The colours that a variant of a case gives its own points.
static void colours_of(const char *id, const char *more, struct sb_unit_told *told)
{
    const struct sb_case *it = case_of(id);
    struct sb_variant own, variant;
    struct sb_unit unit = {0};
    struct sb_points points;
    struct sb_error err = {0};
    const struct sb_case_setting setting = {SB_CASE_ROBUST, SB_CASE_HIGHP, false, &own};
    assert_true(sb_case_variant(&case_env, it, setting.form, setting.precision, false,
                                NULL, &own, &err));
    assert_true(sb_case_variant(&case_env, it, setting.form, setting.precision, false,
                                more, &variant, &err));
    sb_points_init(&points, &own);
    it->points(&points, &setting);
    assert_true(sb_points_validate(&points, &err));
    if (!sb_case_unit_open(&unit, &case_env, &variant, &err) ||
        !sb_unit_light(&unit, &points, 0, told, &err))
        fail_msg("%s: %s", id, err.text);
    sb_unit_close(&unit);
    sb_points_free(&points);
}

// Flat texels, and flat frames, are lit as without a map; `every`: of so many points the last has
// another frame.
static void check_as_without_map(const char *id, int every)
{
    struct sb_unit_told mapped, plain;
    colours_of(id, "", &mapped);
    colours_of(id, "maps=none", &plain);
    for (int p = 0; p < mapped.inputs.height * mapped.inputs.width; p++)
        if (every == 0 || p % every != every - 1)
            for (int c = 0; c < 3; c++)
                check_close(sb_told_colour(&mapped, p)[c], sb_told_colour(&plain, p)[c],
                            0.5 / 255);
    sb_unit_told_free(&mapped);
    sb_unit_told_free(&plain);
}

static void what_is_flat_is_lit_as_without_a_map(void **state)
{
    (void)state;
    // In highp, or emulated, both APIs run the same shaders: the one without half floats asks.
    if (case_half == SB_CASE_HALF)
        return;
    check_as_without_map("normalmap-flat", 0);
    check_as_without_map("tbn-parallel", 5);
}

static void the_inputs_are_those_of_scenes(void **state)
{
    (void)state;
    check_family_valid(&sb_cases_vectors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_inputs_are_those_of_scenes),
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_are_caught),
        cmocka_unit_test(robust_forms_hold_at_other_inputs),
        cmocka_unit_test(what_is_flat_is_lit_as_without_a_map),
    };
    return CASE_TESTS(tests);
}
