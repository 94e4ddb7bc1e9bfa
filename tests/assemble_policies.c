// Which programs the policies make.
#include "assemble_words.h"

#include <ctype.h>

#include "scene/lights.h"

static struct sb_suite suite;
static struct sb_plan_entry entries[4];

static bool assemble_policy(const char *scene, const char *words,
                            struct sb_assembly *assembly, struct sb_error *err)
{
    struct sb_variant variant;
    struct sb_caps caps;
    variant_of_words(sb_axes_builtin(), words, &variant);
    sb_caps_ideal(variant.value[SB_AXIS_API] == SB_API_GLES, &caps);
    *assembly = (struct sb_assembly){0};
    return sb_assemble(
        &(struct sb_assemble_params){.data_dir = SB_SOURCE_DIR,
                                     .axes = sb_axes_builtin(),
                                     .suite = suite.entry_count ? &suite : NULL,
                                     .scene = scene,
                                     .variant = &variant,
                                     .caps = &caps,
                                     .id = 1},
        assembly, err);
}

static void make(const char *scene, const char *words, struct sb_assembly *assembly)
{
    struct sb_error err = {0};
    if (!assemble_policy(scene, words, assembly, &err))
        fail_msg("%s: %s", words, err.text);
}

static int lit_programs(const struct sb_assembly *assembly)
{
    int count = 0;
    for (int i = 0; i < assembly->job.program_count; i++)
        count += strcmp(assembly->program[i].role, "shade") == 0;
    return count;
}

// --- no trace ----------------------------------------------------------------------------------

static bool holds(const char *text, const char *word)
{
    const size_t length = strlen(word);
    for (; *text; text++) {
        size_t i = 0;
        while (i < length && tolower((unsigned char)text[i]) == word[i])
            i++;
        if (i == length)
            return true;
    }
    return false;
}

static void a_scene_without_spots_shadows_or_maps_has_no_trace_of_them(void **state)
{
    (void)state;
    static const char *const words[] = {"spot", "cone", "cutoff",  "shadow",   "caster",
                                        "map",  "area", "tangent", "dirlight", "u_dir"};
    static const char *const policies[] = {"specialise=scene", "specialise=object"};
    static const char *const versions[] = {"api=gl", "api=gl glsl=450",
                                           "api=gles glsl=300es", "api=gles glsl=100"};
    for (int v = 0; v < 4; v++)
        for (int p = 0; p < 2; p++) {
            struct sb_assembly assembly;
            char all[128];
            snprintf(all, sizeof all, "%s %s point=3", versions[v], policies[p]);
            make("spheres", all, &assembly);
            for (int i = 0; i < assembly.job.program_count; i++)
                for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
                    assert_false(holds(assembly.program[i].vertex, words[w]));
                    assert_false(holds(assembly.program[i].fragment, words[w]));
                }
            sb_assembly_free(&assembly);
        }
}

// --- uber --------------------------------------------------------------------------------------

static void one_uber_program_is_the_same_for_every_entry_of_its_suite(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *words;
    } rows[4] = {
        {"night", "specialise=uber loop=dynamic dir=1 sun=120 point=1"},
        {"partly_mapped", "specialise=uber loop=dynamic point=2 "
                          "maps=diffuse+specular+normal"},
        {"flashlight", "specialise=uber loop=dynamic spot=1"},
        {"room", "specialise=uber loop=dynamic point=2 shadows=1 model=lambert"},
    };
    uint64_t hash = 0;
    suite = (struct sb_suite){.axes = *sb_axes_builtin(), .entry = entries};
    for (int i = 0; i < 4; i++) {
        entries[i].scene = rows[i].scene;
        variant_of_words(&suite.axes, rows[i].words, &entries[i].variant);
    }
    suite.entry_count = 4;
    for (int i = 0; i < 4; i++) {
        struct sb_assembly assembly;
        struct sb_error err = {0};
        make(rows[i].scene, rows[i].words, &assembly);
        assert_int_equal(lit_programs(&assembly), 1);
        if (i == 0)
            hash = assembly.lit_hash;
        assert_true(assembly.lit_hash == hash);
        check_contains(assembly.program[0].fragment, "uniform bool u_if_normal_map;");
        check_contains(assembly.program[0].fragment, "u_caster_count");
        check_contains(assembly.program[0].fragment, "u_spot_count");
        if (!sb_assembly_validate(&assembly, &err) && err.status != SB_USAGE)
            fail_msg("%s", err.text);
        sb_assembly_free(&assembly);
    }
    suite.entry_count = 0;
}

static void an_uber_program_is_told_with_each_draw_what_it_calls_for(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    make("mixed", "specialise=uber loop=padded dir=1 point=2", &assembly);
    const struct sb_job_uniform *specular = NULL;
    for (int i = 0; i < assembly.job.uniform_count; i++)
        if (strcmp(assembly.job.uniform[i].name, "u_if_specular") == 0)
            specular = &assembly.job.uniform[i];
    assert_non_null(specular);
    int on = 0;
    for (int d = 0; d < 17; d++)
        on += specular->value[d];
    assert_int_equal(on, 8); // half of the 16 things, and not the ground
    sb_assembly_free(&assembly);
}

// --- scene and object ----------------------------------------------------------------------------

static void draws_that_call_for_the_same_share_a_program(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    make("mixed", "specialise=object dir=1 point=4", &assembly);
    assert_int_equal(lit_programs(&assembly), 4); // matte and glossy, flat and round
    assert_int_equal(assembly.job.lit_count, 17);
    int drawn = 0;
    for (int i = 0; i < assembly.job.lit_count; i++) {
        const struct sb_lit *lit = &assembly.job.lit[i];
        drawn += lit->draw_count;
        // Ordered by program.
        assert_true(i == 0 || lit->program >= assembly.job.lit[i - 1].program);
    }
    assert_int_equal(drawn, 17);
    sb_assembly_free(&assembly);
    make("mixed", "specialise=scene dir=1 point=4", &assembly);
    assert_int_equal(lit_programs(&assembly), 1);
    assert_int_equal(assembly.job.lit_count, 1);
    assert_int_equal(assembly.job.lit[0].draw_count, 17);
    sb_assembly_free(&assembly);
}

static void buckets_round_counts_up(void **state)
{
    (void)state;
    static const char words[] =
        "specialise=object loop=dynamic point=64 attenuation=windowed bucket=%s";
    struct sb_assembly exact, pow2, many;
    char text[160];
    snprintf(text, sizeof text, words, "exact");
    make("lamps64", text, &exact);
    snprintf(text, sizeof text, words, "pow2");
    make("lamps64", text, &pow2);
    snprintf(text, sizeof text, words, "zero_one_many");
    make("lamps64", text, &many);
    assert_true(lit_programs(&exact) > lit_programs(&pow2));
    assert_true(lit_programs(&pow2) > lit_programs(&many));
    for (int i = 0; i < pow2.job.lit_count; i++) {
        const struct sb_lit *lit = &pow2.job.lit[i];
        const int room = (int)lit->variant.value[SB_AXIS_POINT];
        assert_true(room >= lit->light_count[SB_LIGHT_POINT]);
        assert_int_equal(room & (room - 1), 0);
        assert_true(room < 2 * lit->light_count[SB_LIGHT_POINT] || room <= 1);
    }
    sb_assembly_free(&exact);
    sb_assembly_free(&pow2);
    sb_assembly_free(&many);
}

static void asked_is_what_it_was(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    make("mixed", "dir=1 point=4", &assembly);
    assert_int_equal(assembly.job.lit_count, 0);
    assert_int_equal(assembly.job.uniform_count, 0);
    assert_int_equal(lit_programs(&assembly), 1);
    sb_assembly_free(&assembly);
}

static void what_contradicts_a_policy_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *words, *says;
    } rows[] = {
        {"specialise=uber point=1", "valid: loop=dynamic or loop=padded"},
        {"specialise=scene point=1 storage=constant", "a storage other than constant"},
        {"specialise=object point=1 storage=global", "specialise=object: programs"},
        {"specialise=object point=1 source=lwjgl text=as_written", "text=corrected"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        struct sb_error err = {0};
        assert_false(assemble_policy("spheres", rows[i].words, &assembly, &err));
        assert_int_equal(err.status, SB_BAD_INPUT);
        check_contains(err.text, rows[i].says);
        sb_assembly_free(&assembly);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_without_spots_shadows_or_maps_has_no_trace_of_them),
        cmocka_unit_test(one_uber_program_is_the_same_for_every_entry_of_its_suite),
        cmocka_unit_test(an_uber_program_is_told_with_each_draw_what_it_calls_for),
        cmocka_unit_test(draws_that_call_for_the_same_share_a_program),
        cmocka_unit_test(buckets_round_counts_up),
        cmocka_unit_test(asked_is_what_it_was),
        cmocka_unit_test(what_contradicts_a_policy_is_refused),
    };
    return run_tests(tests);
}
