// The hard cases of vectors, normals and tangent frames: robust forms hold, naive ones are caught,
// and what holds at the catalogue's inputs holds at others too.
#include <math.h>

#include "cases/unit.h"
#include "cases/vectors.h"
#include "gl_test.h"
#include "local/local.h"
#include "test.h"

static struct sb_driver driver;

static struct sb_case_env env_of(void)
{
    return (struct sb_case_env){sb_axes_builtin(), &driver, SB_SOURCE_DIR, NULL};
}

static enum sb_verdict verdict_of(const struct sb_case *it, enum sb_case_form form,
                                  int precision, bool vertex, char *words, size_t size)
{
    const struct sb_case_env env = env_of();
    struct sb_outcome outcome;
    sb_case_ask(&env, it, form, (enum sb_case_precision)precision, vertex, &outcome);
    snprintf(words, size, "%s %s %s %s: %s %g, bound %g, point %d %s", it->id,
             sb_case_form_names[form], sb_case_precisions[precision].name,
             vertex ? "vertex" : "fragment", sb_figure_rows[outcome.figure].name,
             outcome.measured, outcome.bound, outcome.point, sb_text_get(&outcome.note));
    sb_text_free(&outcome.note);
    return outcome.verdict;
}

// The settings that the row names: half precision as the driver has it, and where it has none (so
// that each is asked in one kind of context) highp and emulation. That takes a second to compile,
// so it is asked of fragments only.
static bool is_asked(const struct sb_case *it, int precision, int vertex)
{
    const struct sb_case_env env = env_of();
    const bool real = !sb_case_unavailable(&env, SB_CASE_HALF, false);
    if ((precision == SB_CASE_HALF) != real || (precision == SB_CASE_EMULATED && vertex))
        return false;
    const unsigned precisions = it->precisions ? it->precisions : SB_IN_HIGHP;
    const unsigned stages = it->stages ? it->stages : SB_IN_FRAGMENT;
    return (precisions >> precision & 1) && (stages >> vertex & 1);
}

static void robust_forms_hold(void **state)
{
    (void)state;
    char words[512];
    int asked = 0;
    assert_int_equal(sb_cases_vectors.count, 13);
    for (int i = 0; i < sb_cases_vectors.count; i++)
        for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
            for (int vertex = 0; vertex < 2; vertex++) {
                const struct sb_case *it = &sb_cases_vectors.row[i];
                if (!is_asked(it, precision, vertex))
                    continue;
                const enum sb_verdict verdict = verdict_of(it, SB_CASE_ROBUST, precision,
                                                           vertex, words, sizeof words);
                if (verdict != SB_VERDICT_PASS)
                    fail_msg("%s", words);
                asked++;
            }
    assert_true(asked >= 10);
}

// Where highp has nothing to lose, or a driver's half precision leaves a coordinate alone. Emulation
// is asked where half precision itself is what is naive.
static bool may_pass(const struct sb_case *it, int precision)
{
    if (precision == SB_CASE_EMULATED && !it->keeps_inputs)
        return true;
    const bool high = precision == SB_CASE_HIGHP;
    return (strcmp(it->id, "world-pos-16") == 0 && high) ||
           (strcmp(it->id, "fragcoord-16") == 0 && precision == SB_CASE_HALF);
}

static void naive_forms_are_caught(void **state)
{
    (void)state;
    char words[512];
    for (int i = 0; i < sb_cases_vectors.count; i++)
        for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
            for (int vertex = 0; vertex < 2; vertex++) {
                const struct sb_case *it = &sb_cases_vectors.row[i];
                if (!is_asked(it, precision, vertex) || may_pass(it, precision))
                    continue;
                if (verdict_of(it, SB_CASE_NAIVE, precision, vertex, words,
                               sizeof words) == SB_VERDICT_PASS)
                    fail_msg("%s", words);
            }
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
    struct sb_vec3 normal = sb_vectors_direction(random);
    normal = sb_random_below(random, 8) ? scaled(random, normal, -5)
                                        : sb_vec3_scale(normal, 0);
    sb_vectors_add(points,
                   &(struct sb_vectors_point){normal, sb_vectors_direction(random),
                                              sb_vectors_direction(random)});
}

// Between two normals up to 120 degrees apart, anywhere.
static void between_any_normals(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 up = sb_vectors_direction(random);
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
    const struct sb_vec3 normal = sb_vectors_direction(random);
    const struct sb_vec3 light =
        sb_vec3_add(normal, sb_vec3_scale(sb_vectors_direction(random), 0.5));
    struct sb_point *point =
        sb_vectors_add(points, &(struct sb_vectors_point){normal, light, light});
    struct sb_vec3 tangent = sb_vec3_scale(normal, 2 * sb_random_unit(random) - 1);
    if (sb_random_below(random, 2))
        tangent = sb_vec3_cross(normal, sb_vectors_direction(random));
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
    struct sb_point *point =
        sb_vectors_add(points, &(struct sb_vectors_point){{0, 0, 1},
                                                          sb_vectors_direction(random),
                                                          sb_vectors_direction(random)});
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
    const struct sb_vec3 normal = sb_vectors_direction(random);
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
        points, &(struct sb_vectors_point){sb_vectors_direction(random),
                                           sb_vec3_add(at, d), sb_vec3_sub(at, d)});
    put(point->position, at);
}

static void any_peaks(struct sb_random *random, struct sb_points *points)
{
    const struct sb_vec3 normal = sb_vectors_direction(random);
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
    const struct sb_vec3 at = scaled(random, sb_vectors_direction(random), 13);
    const struct sb_vec3 normal = sb_vectors_direction(random);
    struct sb_point *point = sb_vectors_add(
        points, &(struct sb_vectors_point){
                    normal, sb_vec3_add(at, sb_vectors_direction(random)), {0, 0, 0}});
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

static void ask_others(const struct other *other, int precision)
{
    const struct sb_case_env env = env_of();
    const struct sb_case *it = sb_case_expect(other->id, NULL, NULL);
    struct sb_random random = sb_random_seed(23);
    struct sb_variant variant;
    struct sb_points points;
    struct sb_outcome outcome = {0};
    struct sb_error err = {0};
    const struct sb_case_setting setting = {
        SB_CASE_ROBUST, (enum sb_case_precision)precision, false, &variant};
    assert_true(sb_case_variant(&env, it, setting.form, setting.precision, false, NULL,
                                &variant, &err));
    sb_points_init(&points, &variant);
    for (int i = 0; i < 500; i++)
        other->add(&random, &points);
    if (!sb_points_validate(&points, &err) ||
        !sb_case_ask_points(&env, it, &setting, &points, &outcome, &err))
        fail_msg("%s: %s", it->id, err.text);
    if (outcome.verdict != SB_VERDICT_PASS)
        fail_msg("%s %s: %s of %d: %g, bound %g, point %d", it->id,
                 sb_case_precisions[precision].name, sb_figure_rows[outcome.figure].name,
                 outcome.of, outcome.measured, outcome.bound, outcome.point);
    sb_points_free(&points);
}

static void robust_forms_hold_at_other_inputs(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++)
            if (precision != SB_CASE_EMULATED &&
                is_asked(sb_case_expect(others[i].id, NULL, NULL), precision, false))
                ask_others(&others[i], precision);
}

// --- relations ----------------------------------------------------------------------------

// The colours that a variant of a case gives its own points.
static void colours_of(const char *id, const char *more, struct sb_unit_told *told)
{
    const struct sb_case_env env = env_of();
    const struct sb_case *it = sb_case_expect(id, NULL, NULL);
    struct sb_variant own, variant;
    struct sb_unit unit = {0};
    struct sb_points points;
    struct sb_error err = {0};
    const struct sb_case_setting setting = {SB_CASE_ROBUST, SB_CASE_HIGHP, false, &own};
    assert_true(sb_case_variant(&env, it, setting.form, setting.precision, false, NULL,
                                &own, &err));
    assert_true(sb_case_variant(&env, it, setting.form, setting.precision, false, more,
                                &variant, &err));
    const struct sb_unit_params params = {.axes = env.axes,
                                          .variant = &variant,
                                          .driver = env.driver,
                                          .data_dir = env.data_dir,
                                          .id = 1};
    sb_points_init(&points, &own);
    it->points(&points, &setting);
    assert_true(sb_points_validate(&points, &err));
    if (!sb_unit_open(&unit, &params, &err) ||
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
    check_as_without_map("normalmap-flat", 0);
    check_as_without_map("tbn-parallel", 5);
}

static void the_inputs_are_those_of_scenes(void **state)
{
    (void)state;
    for (int i = 0; i < sb_cases_vectors.count; i++) {
        const struct sb_case *it = &sb_cases_vectors.row[i];
        const struct sb_case_env env = env_of();
        struct sb_variant variant;
        struct sb_points points;
        struct sb_error err = {0};
        const struct sb_case_setting setting = {SB_CASE_ROBUST, SB_CASE_HIGHP, false,
                                                &variant};
        if (!it->points)
            continue;
        assert_true(sb_case_variant(&env, it, SB_CASE_ROBUST, SB_CASE_HIGHP, false, NULL,
                                    &variant, &err));
        sb_points_init(&points, &variant);
        it->points(&points, &setting);
        for (double x = it->scale.from; it->scale.name && x <= it->scale.to; x *= 2)
            it->scale.points(&points, &setting, x);
        if (!sb_points_validate(&points, &err))
            fail_msg("%s: %s", it->id, err.text);
        sb_points_free(&points);
    }
}

int main(void)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &driver, &err) || !sb_driver_probe(&driver, &err))
        gl_test_unavailable(&err);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_inputs_are_those_of_scenes),
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_are_caught),
        cmocka_unit_test(robust_forms_hold_at_other_inputs),
        cmocka_unit_test(what_is_flat_is_lit_as_without_a_map),
    };
    const int code = cmocka_run_group_tests(tests, NULL, NULL);
    sb_driver_close(&driver);
    return code;
}
