// The shipped shaders through glslangValidator: a selection of programs in which every three
// values of three choices meet. Skipped where it is not installed.
#include "assemble_words.h"
#include "shader_folder.h"

#include "math/random.h"

enum { CHOICES = 14, VALUES = 5 };

static const struct {
    const char *axis;
    const char *value[VALUES];
} choices[CHOICES] = {
    {"glsl", {"330", "450", "300es", "310es", "100"}},
    {"stage", {"fragment", "vertex"}},
    {"model", {"blinn", "phong", "lambert"}},
    {"attenuation", {"polynomial", "none"}},
    {"cone", {"smooth", "linear", "hard"}},
    {"ambient", {"scene", "per_light", "none"}},
    {"storage", {"uniform", "ubo_std140"}},
    {"maps", {"none", "diffuse", "specular", "diffuse+specular"}},
    {"normalise", {"on", "off"}},
    {"precision", {"highp", "mixed", "mediump", "lowp"}},
    {"dir", {"0", "1", "3"}},
    {"point", {"0", "1", "3"}},
    {"spot", {"0", "1", "3"}},
    {"p_sampler", {"highp", "mediump", "lowp"}},
};
enum { GLSL = 0, GLSL_100 = 4, STORAGE = 6 };

static int values_of(int choice)
{
    int count = 0;
    while (count < VALUES && choices[choice].value[count])
        count++;
    return count;
}

// Triples of values of three choices a < b < c that no program has had yet.
static bool met[CHOICES][CHOICES][CHOICES][VALUES][VALUES][VALUES];

// Number of triples that this program is the first to have; `take`: they are met now.
static int news(const int *program, bool take)
{
    int count = 0;
    for (int a = 0; a < CHOICES; a++)
        for (int b = a + 1; b < CHOICES; b++)
            for (int c = b + 1; c < CHOICES; c++) {
                bool *seen = &met[a][b][c][program[a]][program[b]][program[c]];
                count += !*seen;
                *seen |= take;
            }
    return count;
}

static void draw_program(struct sb_random *random, int *program)
{
    for (int i = 0; i < CHOICES; i++)
        program[i] = (int)sb_random_below(random, (uint64_t)values_of(i));
    if (program[GLSL] == GLSL_100)
        program[STORAGE] = 0; // GLSL ES 1.00 has no blocks
}

static int triples(void)
{
    int count = 0;
    for (int a = 0; a < CHOICES; a++)
        for (int b = a + 1; b < CHOICES; b++)
            for (int c = b + 1; c < CHOICES; c++)
                count += values_of(a) * values_of(b) * values_of(c);
    for (int c = 0; c < CHOICES; c++) // of which 100 with blocks cannot be
        if (c != GLSL && c != STORAGE)
            count -= values_of(c);
    return count;
}

static void check_valid(const char *words)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    assemble(words, &assembly);
    if (!sb_assembly_validate(&assembly, &err))
        fail_msg("%s: %s", words, err.text);
    sb_assembly_free(&assembly);
}

static void check_program(const int *program)
{
    char words[512];
    int length =
        snprintf(words, sizeof words, "api=%s", program[GLSL] < 2 ? "gl" : "gles");
    for (int i = 0; i < CHOICES; i++)
        length += snprintf(words + length, sizeof words - (size_t)length, " %s=%s",
                           choices[i].axis, choices[i].value[program[i]]);
    check_valid(words);
}

// Greedy: of some programs drawn at random, the one with the most new triples.
static void every_three_values_of_three_choices_make_a_valid_program(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    int left = triples(), programs = 0;
    while (left > 0) {
        int best[CHOICES], best_news = 0;
        for (int tries = 0; tries < 100 || best_news == 0; tries++) {
            int program[CHOICES];
            draw_program(&random, program);
            const int count = news(program, false);
            if (count > best_news) {
                best_news = count;
                memcpy(best, program, sizeof best);
            }
        }
        left -= news(best, true);
        check_program(best);
        programs++;
    }
    print_message("%d programs\n", programs);
    assert_int_equal(left, 0);
}

static void every_term_can_have_every_precision(void **state)
{
    (void)state;
    for (int a = SB_AXIS_P_POSITION; a <= SB_AXIS_P_SAMPLER; a++)
        for (int stage = 0; stage < 2; stage++) {
            char words[128];
            snprintf(words, sizeof words,
                     "api=gles stage=%s dir=1 point=1 spot=1 maps=diffuse+specular %s=%s",
                     stage ? "vertex" : "fragment", sb_axes_builtin()->row[a].name,
                     stage ? "lowp" : "mediump");
            check_valid(words);
        }
}

static void two_hundred_and_fifty_six_lights_of_each_type_are_valid(void **state)
{
    (void)state;
    check_valid("dir=256 point=256 spot=256 storage=ubo_std140");
    check_valid("api=gles stage=vertex dir=256 point=256 spot=256 storage=ubo_std140");
    check_valid("api=gles glsl=100 dir=256 point=256 spot=256");
}

// --- messages --------------------------------------------------------------------------------

static void copy_files(const struct sb_glsl_source *source, struct shader_folder *folder)
{
    for (int i = 0; i < source->file_count; i++) {
        struct sb_arena arena = {0};
        struct sb_error err = {0};
        char *from =
            sb_arena_printf(&arena, "%s/shaders/%s", SB_SOURCE_DIR, source->file_name[i]);
        char *text = sb_file_read(&arena, from, 1 << 20, NULL, &err);
        assert_non_null(text);
        folder_write(folder, source->file_name[i], text);
        sb_arena_free(&arena);
    }
}

// The shaders of "spot=1" with a mistake in line 2 of cone/smooth.glsl.
static void assemble_mistaken(struct shader_folder *folder, struct sb_assembly *assembly)
{
    struct sb_assembly good;
    assemble("spot=1", &good);
    folder_make(folder);
    copy_files(&good.vertex, folder);
    copy_files(&good.fragment, folder);
    sb_assembly_free(&good);
    folder_write(folder, "cone/smooth.glsl",
                 "highp float cone(SpotLight light, highp vec3 from_light)\n"
                 "{ return undeclared; }\n");
    struct sb_variant variant;
    variant_of_words(sb_axes_builtin(), "spot=1", &variant);
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    const struct sb_assemble_params params = {
        .shaders = folder->root,
        .axes = sb_axes_builtin(),
        .scene = "sphere",
        .variant = &variant,
        .caps = &caps,
    };
    struct sb_error err = {0};
    *assembly = (struct sb_assembly){0};
    if (!sb_assemble(&params, assembly, &err))
        fail_msg("%s", err.text);
}

static void the_validator_names_the_file_and_line_of_a_mistake(void **state)
{
    (void)state;
    struct shader_folder folder;
    struct sb_assembly assembly;
    assemble_mistaken(&folder, &assembly);
    struct sb_error err = {0};
    assert_false(sb_assembly_validate(&assembly, &err));
    assert_int_equal(err.status, SB_COMPILE_FAILED);
    check_contains(err.text, "ERROR: cone/smooth.glsl:2: 'undeclared'");
    sb_assembly_free(&assembly);
    folder_free(&folder);
}

static void a_drivers_log_is_given_the_file_and_line_of_a_mistake(void **state)
{
    (void)state;
    struct shader_folder folder;
    struct sb_assembly assembly;
    assemble_mistaken(&folder, &assembly);
    int line = 1; // of the flat text
    for (const char *at = assembly.fragment.text;
         at < strstr(assembly.fragment.text, "undeclared"); at++)
        line += *at == '\n';
    char log[128];
    snprintf(log, sizeof log, "0:%d(10): error: `undeclared' undeclared\n", line);
    struct sb_prepared prepared = {.failed_stage = SB_STAGE_FRAG, .log = log};
    struct sb_text text = {0};
    sb_assembly_explain(&assembly, &prepared, &text);
    assert_string_equal(sb_text_get(&text),
                        "cone/smooth.glsl:2:10: error: `undeclared' undeclared\n");
    sb_text_clear(&text);
    prepared.failed_stage = SB_STAGE_LINK;
    sb_assembly_explain(&assembly, &prepared, &text);
    assert_string_equal(sb_text_get(&text), log);
    sb_text_free(&text);
    sb_assembly_free(&assembly);
    folder_free(&folder);
}

static void the_validator_names_what_does_not_link(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("point=1", &assembly);
    char *name = strstr(assembly.vertex.text, "P_VARYING vec3 v_normal");
    assert_non_null(name);
    memcpy(name, "P_VARYING vec2 v_normal", 23);
    char *use = strstr(assembly.vertex.text, "v_normal = normal;");
    assert_non_null(use);
    memcpy(use, "v_normal.x = 1.0; ", 18);
    struct sb_error err = {0};
    assert_false(sb_assembly_validate(&assembly, &err));
    assert_int_equal(err.status, SB_COMPILE_FAILED);
    check_contains(err.text, "v_normal");
    sb_assembly_free(&assembly);
}

static void without_the_validator_that_is_said(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("", &assembly);
    struct sb_error err = {0};
    char *path = sb_strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    assert_false(sb_assembly_validate(&assembly, &err));
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(err.status, SB_USAGE);
    check_contains(err.text, "glslangValidator: No such file");
    sb_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_three_values_of_three_choices_make_a_valid_program),
        cmocka_unit_test(every_term_can_have_every_precision),
        cmocka_unit_test(two_hundred_and_fifty_six_lights_of_each_type_are_valid),
        cmocka_unit_test(the_validator_names_the_file_and_line_of_a_mistake),
        cmocka_unit_test(a_drivers_log_is_given_the_file_and_line_of_a_mistake),
        cmocka_unit_test(the_validator_names_what_does_not_link),
        cmocka_unit_test(without_the_validator_that_is_said),
    };
    if (validator_is_missing())
        return 77;
    return run_tests(tests);
}
