// Every guard is needed: with one line of one robust formula taken out, the case that it stands for
// fails; with all of them in place it holds.
#include "base/file.h"
#include "case_world.h"

struct guard {
    const char *file;            // of the shaders
    const char *guarded, *taken; // the text, and what stands there without the guard
    const char *id;              // of the case that must fail …
    bool half, vertex;           // … in half precision, lit per vertex
};

// clang-format off
static const struct guard guards[] = {
    {"unit.glsl", "d2 > 0.0 ? d * inversesqrt(d2) : d", "d * inversesqrt(d2)",
     "light-on-surface", false, false},
    {"vertex_normal.glsl", "n2 > 0.0 ? normal * inversesqrt(n2) : normal", "normal * inversesqrt(n2)",
     "zero-normal", false, true},
    {"attenuation/polynomial.glsl", "max(k.x + d * slope, 1e-4)", "(k.x + d * slope)",
     "att-kc0", false, false},
    {"model/blinn.glsl", "h2 > 1e-4 ? h * inversesqrt(h2) : vec3(0.0)", "h * inversesqrt(h2)",
     "half-vector-zero", false, false},
    {"highlight/on.glsl", "s < 0.125 ? near : log2(min(c, 1.0))", "log2(min(c, 1.0))",
     "spec-pow-16", true, false},
    {"highlight/on.glsl", "s < 0.125 ? near : log2(min(c, 1.0))", "log2(min(c, 1.0))",
     "spec-pow-32", false, false},
    {"cone/linear.glsl", "dot(c, c) / (1.0 + cos_a)", "1.0 - cos_a",
     "cone-narrow", false, false},
    {"cone/linear.glsl", "dot(c, c) / (1.0 + cos_a)", "1.0 - cos_a",
     "cone-narrow", true, false},
    {"area_shape/ball.glsl", "d > radius ? to_centre * ((d - radius) / d) : vec3(0.0)", "to_centre * ((d - radius) / d)",
     "sphere-centre", false, false},
    {"area_shape/segment.glsl", "axis2 > 0.0 ? dot_axis / axis2 : 0.0", "dot_axis / axis2",
     "capsule-degenerate", false, false},
    {"frame.glsl", "abs(volume) > 1.0 / 1024.0 ? unit(mat3(t, b, normal) * bump) : normal", "unit(mat3(t, b, normal) * bump)",
     "tbn-parallel", false, false},
    {"maps/n.glsl", "(texel * 255.0 - 128.0) * (1.0 / 127.0)", "texel * 2.0 - 1.0",
     "normalmap-flat", false, false},
    {"normal_store/rg.glsl", "sqrt(max(1.0 - dot(xy, xy), 0.0))", "sqrt(1.0 - dot(xy, xy))",
     "normalmap-z", false, false},
    {"specular_side/front.glsl", "    return n_dot_l > 0.0;", "    return true;",
     "spec-backface", false, false},
};
// clang-format on

static char root[] = "/tmp/sb-guards-XXXXXX";

static void copy_shaders(void)
{
    char command[512];
    snprintf(command, sizeof command, "cp -r '%s/shaders/.' '%s'", SB_SOURCE_DIR, root);
    assert_int_equal(system(command), 0);
}

// Puts one text in the place of another in a file of the copy.
static void put(const struct guard *guard, const char *from, const char *to)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    const char *path = sb_path_join(&arena, root, guard->file);
    char *text = sb_file_read(&arena, path, 1 << 20, NULL, &err);
    assert_non_null(text);
    const char *at = strstr(text, from);
    if (!at)
        fail_msg("%s: no \"%s\"", guard->file, from);
    struct sb_text changed = {0};
    sb_text_add_n(&changed, text, (size_t)(at - text));
    sb_text_add(&changed, to);
    sb_text_add(&changed, at + strlen(from));
    assert_true(sb_file_replace(path, sb_text_get(&changed), changed.length, &err));
    sb_text_free(&changed);
    sb_arena_free(&arena);
}

static bool holds(const struct sb_case_env *env, const struct guard *guard)
{
    struct sb_outcome outcome;
    sb_case_ask(env, case_of(guard->id), SB_CASE_ROBUST,
                guard->half ? case_half : SB_CASE_HIGHP, guard->vertex, &outcome);
    if (outcome.verdict == SB_VERDICT_NA)
        fail_msg("%s: %s", guard->id, sb_text_get(&outcome.note));
    sb_text_free(&outcome.note);
    return outcome.verdict == SB_VERDICT_PASS;
}

static void without_its_guard_a_case_fails(void **state)
{
    (void)state;
    struct sb_case_env env = case_env;
    env.shaders = root;
    int needless = 0;
    for (size_t i = 0; i < sizeof guards / sizeof *guards; i++) {
        const struct guard *guard = &guards[i];
        // That it holds per fragment in highp its family's program says.
        if ((guard->half || guard->vertex) && !holds(&env, guard))
            fail_msg("%s does not hold", guard->id);
        put(guard, guard->guarded, guard->taken);
        if (holds(&env, guard)) {
            print_error("%s holds without \"%s\"\n", guard->id, guard->guarded);
            needless++;
        }
        put(guard, guard->taken, guard->guarded);
    }
    assert_int_equal(needless, 0);
}

int main(void)
{
    char command[128];
    assert_non_null(mkdtemp(root));
    copy_shaders();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_its_guard_a_case_fails),
    };
    const int code = CASE_TESTS(tests);
    snprintf(command, sizeof command, "rm -r '%s'", root);
    if (system(command) != 0)
        perror(root);
    return code;
}
