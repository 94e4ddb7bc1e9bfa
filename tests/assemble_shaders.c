// The shipped shaders through glslangValidator: a selection of programs in which every two values
// of two choices meet, as far as they can. Skipped where it is not installed.
#include "assemble_words.h"
#include "shader_folder.h"

#include "math/random.h"

enum { VALUES = 8 };

static const struct choice {
    const char *axis;
    const char *value[VALUES];
} choices[] = {
    {"glsl", {"330", "450", "300es", "310es", "100"}},
    {"dir", {"0", "1", "3"}},
    {"point", {"0", "2", "4"}},
    {"spot", {"0", "1", "3"}},
    {"area", {"0", "1", "3"}},
    {"area_shape", {"sphere", "tube", "box", "capsule"}},
    {"model", {"blinn", "phong", "lambert"}},
    {"ambient", {"scene", "per_light", "none"}},
    {"attenuation", {"polynomial", "none", "radius", "windowed"}},
    {"cone", {"smooth", "linear", "hard", "exponent"}},
    {"specular_side", {"front", "both"}},
    {"maps",
     {"none", "diffuse", "specular", "normal", "diffuse+specular", "diffuse+normal",
      "specular+normal", "diffuse+specular+normal"}},
    {"shadows", {"0", "1", "2"}},
    {"source", {"none", "lwjgl", "ubo", "shadows", "delphi", "wikibooks"}},
    {"text", {"corrected", "as_written"}},
    {"fresnel", {"none", "schlick"}},
    {"specular_norm", {"none", "energy"}},
    {"sun", {"-91", "30", "100"}},
    {"lamps", {"off", "on"}},
    {"stage", {"fragment", "vertex"}},
    {"precision", {"highp", "mixed", "mediump", "lowp"}},
    {"p_sampler", {"highp", "mediump", "lowp"}},
    {"normalise", {"on", "off"}},
    {"normal_store", {"rgb", "rg"}},
    {"f_unit", {"robust", "naive"}},
    {"f_attenuation", {"robust", "naive"}},
    {"f_cone", {"robust", "naive"}},
    {"f_highlight", {"robust", "naive"}},
    {"f_area", {"robust", "naive"}},
    {"f_frame", {"robust", "naive"}},
    {"f_output", {"robust", "naive"}},
    {"f_shadow", {"robust", "naive"}},
    {"shadow_bias_kind", {"constant", "slope"}},
    {"shadow_filter", {"1", "4", "16"}},
    {"shadow_store", {"r8", "r16f", "r32f", "depth"}},
    {"layout", {"split", "unified"}},
    {"storage", {"constant", "global", "uniform", "arrays", "ubo_std140", "ubo_shared"}},
    {"loop", {"constant", "unrolled", "dynamic", "padded"}},
    {"capacity", {"0", "5"}},
    {"hoist", {"once", "per_light"}},
    {"space", {"world", "view"}},
    {"guard", {"branch", "mask"}},
    {"shadow_map", {"six2d", "array2d", "cube", "cube_array"}},
    {"shadow_pass", {"faces", "layered"}},
};
enum { CHOICES = sizeof choices / sizeof *choices };

// What is refused other than by `needs`; assemble_decide.c has the messages.
static const char *const refused[] = {
    "glsl=100,loop=dynamic",
    "glsl=100,shadows>0",
    "glsl=300es,shadow_map=cube_array",
    "glsl=300es,shadow_pass=layered",
    "glsl=100,storage=constant",
    "glsl=100,storage=ubo_std140",
    "glsl=100,storage=ubo_shared",
    "text=as_written,source=lwjgl,space=world",
    "text=as_written,source=ubo,model!=phong",
    "text=as_written,source=shadows,model!=phong",
    "text=as_written,source=ubo,storage=ubo_shared,dir>0|"
    "text=as_written,source=ubo,storage=ubo_shared,point>2|"
    "text=as_written,source=ubo,storage=ubo_shared,spot>0|"
    "text=as_written,source=ubo,storage=ubo_shared,area>0",
};

static int axis_of(int choice)
{
    return sb_axes_find(sb_axes_builtin(), choices[choice].axis);
}

static int values_of(int choice)
{
    int count = 0;
    while (count < VALUES && choices[choice].value[count])
        count++;
    return count;
}

static bool is_refused(const struct sb_variant *variant)
{
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (sb_condition_holds(sb_axes_builtin(), refused[i], variant))
            return true;
    return false;
}

// A place in the values of each choice; -1: moot.
struct program {
    int place[CHOICES];
    struct sb_variant variant;
};

static void put(struct program *program, int choice)
{
    const char *word = choices[choice].value[program->place[choice]];
    struct sb_error err = {0};
    if (!sb_variant_set(sb_axes_builtin(), &program->variant, axis_of(choice), word,
                        &err))
        fail_msg("%s", err.text);
}

// What the table rules out here gives way, and what is moot is no choice.
static bool settle(struct program *program)
{
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_variant *variant = &program->variant;
    const int glsl = (int)variant->value[SB_AXIS_GLSL];
    sb_variant_put(variant, SB_AXIS_API,
                   glsl == SB_GLSL_330 || glsl == SB_GLSL_450 ? SB_API_GL : SB_API_GLES);
    for (int c = 0; c < CHOICES; c++) {
        const struct sb_axis *axis = &axes->row[axis_of(c)];
        if (variant->value[axis_of(c)] != axis->init &&
            !sb_condition_holds(axes, axis->needs, variant)) {
            program->place[c] = 0; // by convention the table's init
            put(program, c);
        }
    }
    struct sb_error err = {0};
    if (!sb_variant_resolve(axes, variant, &err) || is_refused(variant))
        return false;
    for (int c = 0; c < CHOICES; c++)
        if (sb_variant_moot(axes, variant, axis_of(c)))
            program->place[c] = -1;
    return true;
}

// `pair`: two choices and their values, which must survive; NULL: any program.
struct pair {
    int choice[2], place[2];
};

static bool draw_program(struct sb_random *random, const struct pair *pair,
                         struct program *program)
{
    sb_variant_init(sb_axes_builtin(), &program->variant);
    for (int c = 0; c < CHOICES; c++)
        program->place[c] = (int)sb_random_below(random, (uint64_t)values_of(c));
    for (int i = 0; i < 2; i++)
        program->place[pair->choice[i]] = pair->place[i];
    for (int c = 0; c < CHOICES; c++)
        put(program, c);
    if (!settle(program))
        return false;
    return program->place[pair->choice[0]] == pair->place[0] &&
           program->place[pair->choice[1]] == pair->place[1];
}

static bool met[CHOICES][CHOICES][VALUES][VALUES];

// Number of pairs that this program is the first to have; `take`: they are met now.
static int news(const struct program *program, bool take)
{
    int count = 0;
    for (int a = 0; a < CHOICES; a++)
        for (int b = a + 1; b < CHOICES; b++) {
            if (program->place[a] < 0 || program->place[b] < 0)
                continue;
            bool *seen = &met[a][b][program->place[a]][program->place[b]];
            count += !*seen;
            *seen |= take;
        }
    return count;
}

static bool is_valid(const char *words)
{
    const struct assembling from = {.words = words, .probe = true};
    struct sb_assembly assembly;
    struct sb_error err = {0};
    const bool good =
        assemble_from(&from, &assembly, &err) && validate_in_sweep(&assembly, &err);
    if (!good)
        print_error("%s: %s\n", words, err.text);
    sb_assembly_free(&assembly);
    return good;
}

static void check_valid(const char *words)
{
    if (!is_valid(words))
        fail();
}

static bool is_valid_program(const struct program *program)
{
    char words[1024];
    const bool gles = program->variant.value[SB_AXIS_API] == SB_API_GLES;
    int length = snprintf(words, sizeof words, "api=%s", gles ? "gles" : "gl");
    for (int c = 0; c < CHOICES; c++)
        if (program->place[c] >= 0)
            length += snprintf(words + length, sizeof words - (size_t)length, " %s=%s",
                               choices[c].axis, choices[c].value[program->place[c]]);
    return is_valid(words);
}

// Greedy: of some programs that have this pair, the one with the most new ones; false: none
// can be.
static bool meet(struct sb_random *random, const struct pair *pair, struct program *best)
{
    int best_news = 0;
    for (int tries = 0, found = 0; found < 40 && tries < 400; tries++) {
        struct program program;
        if (!draw_program(random, pair, &program))
            continue;
        found++;
        const int count = news(&program, false);
        if (count > best_news) {
            best_news = count;
            *best = program;
        }
    }
    if (best_news > 0)
        news(best, true);
    return best_news > 0;
}

static void every_two_values_of_two_choices_make_a_valid_program(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    int programs = 0, bad = 0, pairs = 0, apart = 0;
    for (int a = 0; a < CHOICES; a++)
        for (int b = a + 1; b < CHOICES; b++)
            for (int i = 0; i < values_of(a) * values_of(b); i++) {
                const struct pair pair = {{a, b}, {i / values_of(b), i % values_of(b)}};
                pairs++;
                if (met[a][b][pair.place[0]][pair.place[1]])
                    continue;
                struct program program;
                if (!meet(&random, &pair, &program)) {
                    apart++;
                    continue;
                }
                programs++;
                bad += !is_valid_program(&program);
            }
    print_message("%d pairs in %d programs; %d can never meet\n", pairs - apart, programs,
                  apart);
    assert_int_equal(bad, 0);
    assert_in_range(apart, 1, pairs / 25);
}

// The three choices that reach into each other most, with versions and others by turns.
static void every_layout_storage_and_loop_go_together(void **state)
{
    (void)state;
    static const char *const layouts[] = {"split area=1", "unified"};
    static const char *const storages[] = {"constant", "global",     "uniform",
                                           "arrays",   "ubo_std140", "ubo_shared"};
    static const char *const loops[] = {"constant", "unrolled", "dynamic capacity=4",
                                        "padded capacity=4"};
    static const char *const turns[] = {
        "api=gl space=view", "api=gles hoist=per_light", "api=gl glsl=450 stage=vertex",
        "api=gles glsl=310es space=view hoist=per_light stage=vertex",
        "api=gles dir=2 sun=100"};
    int bad = 0;
    for (int i = 0; i < 2 * 6 * 4; i++) {
        char words[256];
        snprintf(words, sizeof words,
                 "dir=1 point=3 spot=2 layout=%s storage=%s loop=%s %s", layouts[i / 24],
                 storages[i / 4 % 6], loops[i % 4], turns[i % 5]);
        bad += !is_valid(words);
    }
    for (int i = 0; i < 2 * 3 * 3; i++) { // what GLSL ES 1.00 has of them
        static const int kept[] = {0, 1, 3};
        char words[256];
        snprintf(words, sizeof words,
                 "api=gles glsl=100 dir=1 point=3 spot=2 layout=%s storage=%s loop=%s %s",
                 layouts[i / 9], storages[1 + i / 3 % 3], loops[kept[i % 3]],
                 i % 2 ? "stage=vertex" : "space=view");
        bad += !is_valid(words);
    }
    assert_int_equal(bad, 0);
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
    static const char *const words[] = {
        "storage=ubo_std140",
        "api=gles stage=vertex storage=ubo_shared",
        "api=gles glsl=100",
        "storage=constant loop=unrolled area=256",
        "api=gles glsl=100 storage=global layout=unified",
        "point=1 loop=dynamic capacity=256 storage=arrays",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char all[128];
        snprintf(all, sizeof all, "dir=256 point=256 spot=256 %s", words[i]);
        check_valid(all);
    }
}

// --- messages --------------------------------------------------------------------------------

static void copy_files(const struct sb_glsl_source *source, struct shader_folder *folder)
{
    for (int i = 0; i < source->file_count; i++) {
        if (strncmp(source->file_name[i], "generated/", 10) == 0) // no file
            continue;
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
    copy_files(shade_of(&good, VERTEX), folder);
    copy_files(shade_of(&good, FRAGMENT), folder);
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

static const struct {
    const char *file, *text;
} smallest[] = {
    {"shade.vert", "void main() { gl_Position = vec4(0.0); }\n"},
    {"shade.frag", "void main() {}\n"},
    {"shadow.vert", "void main() { gl_Position = vec4(0.0); }\n"},
    {"shadow.geom", "layout(triangles) in;\n"
                    "layout(triangle_strip, max_vertices = 3) out;\nvoid main() {}\n"},
    {"shadow.frag", "void main() {}\n"},
    {"lamp.vert", "void main() { gl_Position = vec4(0.0); }\n"},
    {"lamp.frag", "void main() {}\n"},
};
enum { SMALLEST = sizeof smallest / sizeof *smallest };

static void the_validator_reads_every_stage_of_every_program(void **state)
{
    (void)state;
    struct shader_folder folder;
    folder_make(&folder);
    for (int wrong = -1; wrong < SMALLEST; wrong++) {
        char mistake[64] = "";
        for (int i = 0; i < SMALLEST; i++)
            folder_write(&folder, smallest[i].file,
                         i == wrong ? "\nvoid main() { nowhere = 1.0; }\n"
                                    : smallest[i].text);
        if (wrong >= 0)
            snprintf(mistake, sizeof mistake, "ERROR: %s:2: 'nowhere'",
                     smallest[wrong].file);
        const struct assembling from = {
            .words = "point=1 shadows=1 shadow_pass=layered lamps=on",
            .shaders = folder.root};
        struct sb_assembly assembly;
        struct sb_error err = {0};
        assert_true(assemble_from(&from, &assembly, &err));
        assert_int_equal(sb_assembly_validate(&assembly, &err), wrong < 0);
        check_contains(err.text, mistake);
        sb_assembly_free(&assembly);
    }
    folder_free(&folder);
}

static void a_drivers_log_is_given_the_file_and_line_of_a_mistake(void **state)
{
    (void)state;
    struct shader_folder folder;
    struct sb_assembly assembly;
    assemble_mistaken(&folder, &assembly);
    int line = 1; // of the flat text
    for (const char *at = shade_of(&assembly, FRAGMENT)->text;
         at < strstr(shade_of(&assembly, FRAGMENT)->text, "undeclared"); at++)
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
    char *name = strstr(shade_of(&assembly, VERTEX)->text, "P_VARYING vec3 v_normal");
    assert_non_null(name);
    memcpy(name, "P_VARYING vec2 v_normal", 23);
    char *use = strstr(shade_of(&assembly, VERTEX)->text, "v_normal = normal;");
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
        cmocka_unit_test(every_two_values_of_two_choices_make_a_valid_program),
        cmocka_unit_test(every_layout_storage_and_loop_go_together),
        cmocka_unit_test(every_term_can_have_every_precision),
        cmocka_unit_test(two_hundred_and_fifty_six_lights_of_each_type_are_valid),
        cmocka_unit_test(the_validator_names_the_file_and_line_of_a_mistake),
        cmocka_unit_test(the_validator_reads_every_stage_of_every_program),
        cmocka_unit_test(a_drivers_log_is_given_the_file_and_line_of_a_mistake),
        cmocka_unit_test(the_validator_names_what_does_not_link),
        cmocka_unit_test(without_the_validator_that_is_said),
    };
    if (validator_is_missing())
        return 77;
    return run_tests(tests);
}
