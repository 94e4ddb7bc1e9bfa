// What the programs of the presets say, choice by choice, of what the source texts are known for.
#include "assemble_words.h"

#include "base/file.h"
#include "suite/suite.h"

// The program of a preset with some axes set otherwise ("text=as_written").
static void assemble_preset(const char *name, const char *words,
                            struct sb_assembly *assembly)
{
    char path[256], given[200];
    struct sb_assignment set[4];
    struct sb_suite_params params = {
        .path = path, .data_dir = SB_SOURCE_DIR, .set = set, .set_count = 0};
    struct sb_suite suite = {0};
    struct sb_error err = {0};
    struct sb_caps caps;
    snprintf(path, sizeof path, "%s/bench/presets/%s.yaml", SB_SOURCE_DIR, name);
    snprintf(given, sizeof given, "%s", words);
    for (char *rest = given, *word; (word = strtok_r(rest, " ", &rest)) != NULL;) {
        char *value = strchr(word, '=');
        *value++ = '\0';
        set[params.set_count++] = (struct sb_assignment){word, value, words};
    }
    if (!sb_suite_load(&params, &suite, &err))
        fail_msg("%s", err.text);
    assert_int_equal(suite.entry_count, 1);
    const struct sb_plan_entry *entry = &suite.entry[0];
    sb_caps_ideal(entry->variant.value[SB_AXIS_API] == SB_API_GLES, &caps);
    const struct sb_assemble_params job = {
        .data_dir = SB_SOURCE_DIR,
        .axes = sb_axes_builtin(),
        .scene = entry->scene,
        .variant = &entry->variant,
        .caps = &caps,
    };
    *assembly = (struct sb_assembly){0};
    if (!sb_assemble(&job, assembly, &err))
        fail_msg("%s: %s", name, err.text);
    sb_suite_free(&suite);
}

static int count_in(const char *text, const char *part)
{
    int count = 0;
    while ((text = strstr(text, part)) != NULL) {
        count++;
        text += strlen(part);
    }
    return count;
}

// The fragment shader of a preset has all of these.
static void check_text(const char *name, const char *words, const char *const *parts)
{
    struct sb_assembly assembly;
    assemble_preset(name, words, &assembly);
    for (; *parts; parts++)
        check_contains(shade_of(&assembly, FRAGMENT)->text, *parts);
    sb_assembly_free(&assembly);
}
#define CHECK_TEXT(name, words, ...)                                                     \
    check_text(name, words, (const char *const[]){__VA_ARGS__, NULL})

static void delphi_is_mediump_with_lowp_colours_and_fetches_for_each_light(void **state)
{
    (void)state;
    CHECK_TEXT("delphi", "api=gles", "#define P_POSITION mediump\n",
               "#define P_UNIFORM mediump\n", "#define P_COLOR lowp\n",
               "#define NR_POINT_LIGHTS 4\n",
               "LIGHT_ARRAY(PointLight, u_point, MAX_POINT_LIGHTS)",
               "#define IF_DIFFUSE_MAP(code) \n",
               "#define IF_DIFFUSE_MAP_EACH(code) code",
               "#define IF_SPECULAR_MAP_EACH(code) code");
    struct sb_assembly assembly;
    assemble_preset("delphi", "", &assembly);
    assert_int_equal(assembly.job.program_count, 2); // the lamps have their own
    sb_assembly_free(&assembly);
}

static void wikibooks_has_its_lights_in_the_shader_as_globals_or_constants(void **state)
{
    (void)state;
    static const char array[] = "Light u_light[2]";
    for (int constant = 0; constant < 2; constant++) {
        struct sb_assembly assembly;
        assemble_preset("wikibooks", constant ? "storage=constant" : "", &assembly);
        const char *text = shade_of(&assembly, FRAGMENT)->text;
        check_contains(text, array);
        assert_int_equal(count_in(text, "const Light u_light[2]"), constant);
        assert_int_equal(count_in(text, "uniform Light"), 0);
        sb_assembly_free(&assembly);
    }
    CHECK_TEXT("wikibooks", "api=gles glsl=100", "#version 100\n", array,
               "i < NR_LIGHTS");
}

static void lwjgl_has_room_for_five_and_asks_for_the_intensity(void **state)
{
    (void)state;
    CHECK_TEXT("lwjgl", "", "#define MAX_POINT_LIGHTS 5\n", "#define MAX_SPOT_LIGHTS 5\n",
               "#define NR_POINT_LIGHTS 3\n", "POINT_LIGHT(i).intensity > 0.0",
               "#define SLIPS none\n");
    CHECK_TEXT("lwjgl", "loop=constant", "#define MAX_POINT_LIGHTS 3\n");
    CHECK_TEXT("lwjgl", "loop=dynamic", "i < u_point_count");
    CHECK_TEXT("lwjgl", "text=as_written", "u_camera_position - position");
}

static void ubo_has_blocks_of_the_layout_asked_for_and_a_uniform_bound(void **state)
{
    (void)state;
    CHECK_TEXT("ubo", "", "layout(shared) uniform Lights {",
               "layout(shared) uniform MaterialBlock {",
               "uniform highp int u_light_count;", "i < u_light_count");
    CHECK_TEXT("ubo", "storage=ubo_std140", "layout(std140) uniform Lights {");
    CHECK_TEXT("ubo", "text=as_written", "slip_no_light", "slip_specular_factor");
}

// --- shadows ---------------------------------------------------------------------------------

// The fragment shader as the compiler sees it, without macros; false: no validator.
static bool preprocess(const struct sb_assembly *assembly, char *to, size_t room)
{
    char folder[] = "/tmp/shadebench-text-XXXXXX", line[512];
    struct sb_error err = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(line, sizeof line, "%s/it.frag", folder);
    const char *text = shade_of(assembly, FRAGMENT)->text;
    assert_true(sb_file_replace(line, text, strlen(text), &err));
    snprintf(line, sizeof line, "glslangValidator -E %s/it.frag 2>/dev/null; rm -r %s",
             folder, folder);
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    const size_t length = fread(to, 1, room - 1, pipe);
    to[length] = '\0';
    assert_true(length < room - 1);
    pclose(pipe);
    return length > 0;
}

static void shadows_looks_a_shadow_up_once_and_as_written_twice(void **state)
{
    (void)state;
    static char text[200000];
    int calls[2];
    for (int slip = 0; slip < 2; slip++) {
        struct sb_assembly assembly;
        assemble_preset("shadows", slip ? "text=as_written" : "", &assembly);
        const bool there = preprocess(&assembly, text, sizeof text);
        sb_assembly_free(&assembly);
        if (!there)
            skip();
        calls[slip] = count_in(text, "shadow_share_robust") - 1; // less its definition
    }
    assert_int_equal(calls[0], 1);
    assert_int_equal(calls[1], 2);
}

static void shadows_compares_in_six_textures_and_has_no_gloss_map(void **state)
{
    (void)state;
    CHECK_TEXT("shadows", "", "u_shadow_map[6 * NR_SHADOWS]",
               "#define SHADOW_BIAS 0.01\n", "GIVEN_MAP(u_normal_map)",
               "#define IF_SPECULAR_MAP(code) \n", "max(1.0 - d / range, 0.0)");
    struct sb_assembly assembly;
    assemble_preset("shadows", "", &assembly);
    check_contains(shade_of(&assembly, VERTEX)->text, "a_tangent");
    assert_null(strstr(shade_of(&assembly, FRAGMENT)->text, "GIVEN_MAP(u_specular"));
    sb_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(delphi_is_mediump_with_lowp_colours_and_fetches_for_each_light),
        cmocka_unit_test(wikibooks_has_its_lights_in_the_shader_as_globals_or_constants),
        cmocka_unit_test(lwjgl_has_room_for_five_and_asks_for_the_intensity),
        cmocka_unit_test(ubo_has_blocks_of_the_layout_asked_for_and_a_uniform_bound),
        cmocka_unit_test(shadows_looks_a_shadow_up_once_and_as_written_twice),
        cmocka_unit_test(shadows_compares_in_six_textures_and_has_no_gloss_map),
    };
    return run_tests(tests);
}
