// The sun below the horizon: not in the program, and so not paid for.
#include "assemble_words.h"

static struct sb_error err;

// Does any stage hold this text?
static bool holds(const struct sb_assembly *assembly, const char *part)
{
    for (int stage = 0; stage < STAGES; stage++) {
        const char *text = shade_of(assembly, stage)->text;
        if (text && strstr(text, part))
            return true;
    }
    return false;
}

static void assemble_blocks(const char *words, struct sb_assembly *assembly)
{
    const struct assembling from = {.words = words, .scene = "blocks"};
    if (!assemble_from(&from, assembly, &err))
        fail_msg("%s: %s", words, err.text);
}

// Whether the programs of two variants have the same text.
static bool same_text(const char *a, const char *b)
{
    struct sb_assembly one, other;
    assemble_blocks(a, &one);
    assemble_blocks(b, &other);
    const bool same = one.source_hash == other.source_hash;
    sb_assembly_free(&one);
    sb_assembly_free(&other);
    return same;
}

static const char *const implementations[] = {
    "",
    "storage=constant",
    "storage=arrays loop=unrolled",
    "storage=ubo_std140 layout=unified",
    "storage=ubo_shared stage=vertex",
    "layout=unified space=view",
    "hoist=per_light space=view model=phong",
};
enum { IMPLEMENTATIONS = sizeof implementations / sizeof *implementations };

static void at_night_the_program_is_that_of_no_directional_light(void **state)
{
    (void)state;
    for (int i = 0; i < IMPLEMENTATIONS; i++) {
        static const char *const nights[] = {"90.5", "180", "360"};
        char none[200], night[200];
        snprintf(none, sizeof none, "point=2 spot=1 dir=0 %s", implementations[i]);
        for (int n = 0; n < 3; n++) {
            snprintf(night, sizeof night, "point=2 spot=1 dir=1 sun=%s %s", nights[n],
                     implementations[i]);
            if (!same_text(night, none))
                fail_msg("%s: is not the program of %s", night, none);
        }
    }
}

// At 90 degrees exactly it has not set yet, and the other directional lights never do.
static void until_it_has_set_and_for_other_suns_the_program_pays(void **state)
{
    (void)state;
    static const char *const days[] = {"-90", "0", "89.9", "90"};
    for (int i = 0; i < IMPLEMENTATIONS; i++) {
        char none[200], day[200], other[200];
        snprintf(none, sizeof none, "point=2 dir=0 %s", implementations[i]);
        for (int d = 0; d < 4; d++) {
            snprintf(day, sizeof day, "point=2 dir=1 sun=%s %s", days[d],
                     implementations[i]);
            assert_false(same_text(day, none));
        }
        snprintf(other, sizeof other, "point=2 dir=2 sun=120 %s", implementations[i]);
        assert_false(same_text(other, none));
    }
    // All day it is one program, which only gets other numbers.
    assert_true(same_text("dir=1 sun=-90", "dir=1 sun=90"));
    assert_true(same_text("dir=2 sun=120", "dir=1"));
}

static void no_word_of_the_sun_is_left_in_the_text_at_night(void **state)
{
    (void)state;
    struct sb_assembly day, night;
    assemble_blocks("point=1 dir=1 sun=90 storage=constant", &day);
    assemble_blocks("point=1 dir=1 sun=91 storage=constant", &night);
    assert_true(holds(&day, "DirLight u_dir["));
    assert_false(holds(&night, "u_dir[1]"));
    assert_true(holds(&day, "#define NR_DIR_LIGHTS 1\n"));
    assert_true(holds(&night, "#define NR_DIR_LIGHTS 0\n"));
    sb_assembly_free(&day);
    sb_assembly_free(&night);
}

// The text's own loop has its arrays at their full size, and asks for the intensity: there the
// slot of the sun stays, as the text has it.
static void a_padded_loop_keeps_the_slot(void **state)
{
    (void)state;
    struct sb_assembly night;
    assemble_blocks("point=3 dir=1 sun=91 loop=padded capacity=5", &night);
    assert_true(holds(&night, "#define MAX_DIR_LIGHTS 1\n"));
    assert_true(holds(&night, "#define NR_DIR_LIGHTS 0\n"));
    sb_assembly_free(&night);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_night_the_program_is_that_of_no_directional_light),
        cmocka_unit_test(until_it_has_set_and_for_other_suns_the_program_pays),
        cmocka_unit_test(no_word_of_the_sun_is_left_in_the_text_at_night),
        cmocka_unit_test(a_padded_loop_keeps_the_slot),
    };
    return run_tests(tests);
}
