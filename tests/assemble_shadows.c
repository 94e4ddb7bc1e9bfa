// What shadow maps ask of a driver, and what is said where it has less.
#include "assemble_words.h"

static void check_refused(const char *words, const struct sb_caps *caps,
                          enum sb_status status, const char *text)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    const bool good = assemble_with(sb_axes_builtin(), words, caps, &assembly, &err);
    sb_assembly_free(&assembly);
    if (good)
        fail_msg("%s: not refused", words);
    assert_int_equal(err.status, status);
    assert_string_equal(err.text, text);
}

static void check_taken(const char *words, const struct sb_caps *caps)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    if (!assemble_with(sb_axes_builtin(), words, caps, &assembly, &err))
        fail_msg("%s: %s", words, err.text);
    sb_assembly_free(&assembly);
}

static void each_kind_of_map_takes_its_texture_units_and_no_more(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.texture_units = 20;
    check_taken("point=16 shadows=3 shadow_map=six2d maps=diffuse+specular", &caps);
    check_refused(
        "point=16 shadows=3 shadow_map=six2d maps=diffuse+specular+normal", &caps,
        SB_OVER_LIMIT,
        "shadow_map=six2d: 3 casters want 18 texture units and the maps 3, this "
        "driver has 20 (GL_MAX_TEXTURE_IMAGE_UNITS); cube_array or array2d fit");
    check_taken("point=19 shadows=19 shadow_map=cube maps=normal", &caps);
    check_refused(
        "point=20 shadows=20 shadow_map=cube maps=normal", &caps, SB_OVER_LIMIT,
        "shadow_map=cube: 20 casters want 20 texture units and the maps 1, this "
        "driver has 20 (GL_MAX_TEXTURE_IMAGE_UNITS); cube_array or array2d fit");
    check_taken("point=64 shadows=64 shadow_map=array2d maps=diffuse+specular+normal",
                &caps);
    check_taken("point=64 shadows=64 shadow_map=cube_array", &caps);
}

static void sixteen_casters_in_six2d_are_refused_with_the_limit_of_the_driver(
    void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    check_refused(
        "point=16 shadows=16 shadow_map=six2d maps=diffuse+specular", &caps,
        SB_OVER_LIMIT,
        "shadow_map=six2d: 16 casters want 96 texture units and the maps 2, this "
        "driver has 32 (GL_MAX_TEXTURE_IMAGE_UNITS); cube_array or array2d fit");
    caps.cube_map_array = 0;
    check_refused(
        "point=16 shadows=16 shadow_map=six2d", &caps, SB_OVER_LIMIT,
        "shadow_map=six2d: 16 casters want 96 texture units and the maps 0, this "
        "driver has 32 (GL_MAX_TEXTURE_IMAGE_UNITS); array2d fits");
    caps.array_layers = 95;
    check_refused(
        "point=16 shadows=16 shadow_map=six2d", &caps, SB_OVER_LIMIT,
        "shadow_map=six2d: 16 casters want 96 texture units and the maps 0, this "
        "driver has 32 (GL_MAX_TEXTURE_IMAGE_UNITS); fewer casters fit");
}

static void the_units_of_all_stages_are_a_limit_of_their_own(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.combined_texture_units = 32;
    check_taken("point=29 shadows=29", &caps);
    check_refused(
        "point=30 shadows=30", &caps, SB_OVER_LIMIT,
        "shadow_map=cube: 30 casters want 30 texture units and the maps 3, this "
        "driver has 32 (GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS); cube_array or "
        "array2d fit");
}

static void arrays_end_with_the_layers_of_the_driver(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.array_layers = 256;
    check_taken("point=64 shadows=42 shadow_map=cube_array", &caps);
    check_refused(
        "point=64 shadows=43 shadow_map=cube_array", &caps, SB_OVER_LIMIT,
        "shadow_map=cube_array: 43 casters want 258 layers, this driver has 256 "
        "(GL_MAX_ARRAY_TEXTURE_LAYERS); 42 casters fit");
    check_refused("point=64 shadows=64 shadow_map=array2d", &caps, SB_OVER_LIMIT,
                  "shadow_map=array2d: 64 casters want 384 layers, this driver has 256 "
                  "(GL_MAX_ARRAY_TEXTURE_LAYERS); 42 casters fit");
}

static void maps_are_no_larger_than_textures_of_their_kind(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.cube_map_size = 2048;
    caps.texture_size = 4096;
    check_refused(
        "point=1 shadows=1 shadow_size=4096", &caps, SB_OVER_LIMIT,
        "shadow_size=4096: shadow_map=cube takes up to 2048 texels a side on this "
        "driver (GL_MAX_CUBE_MAP_TEXTURE_SIZE)");
    check_taken("point=1 shadows=1 shadow_map=six2d shadow_size=4096", &caps);
    check_refused(
        "point=1 shadows=1 shadow_map=array2d shadow_size=8192", &caps, SB_OVER_LIMIT,
        "shadow_size=8192: shadow_map=array2d takes up to 4096 texels a side on "
        "this driver (GL_MAX_TEXTURE_SIZE)");
}

static void what_the_driver_lacks_is_named_with_what_works(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(true, &caps);
    caps.cube_map_array = caps.geometry_shader = 0;
    check_refused(
        "api=gles point=1 shadows=1 shadow_map=cube_array", &caps, SB_OVER_LIMIT,
        "shadow_map=cube_array: this driver has no cube map arrays; valid here: "
        "six2d array2d cube");
    check_refused("api=gles point=1 shadows=1 shadow_pass=layered", &caps, SB_OVER_LIMIT,
                  "shadow_pass=layered: this driver has no geometry shaders; valid here: "
                  "faces");
    caps.colour_float = 0;
    check_refused("api=gles point=1 shadows=1", &caps, SB_OVER_LIMIT,
                  "shadow_store=r32f: this driver cannot draw to it; valid here: r16f r8 "
                  "depth");
    check_taken("api=gles point=1 shadows=1 shadow_store=r16f", &caps);
    caps.colour_half = 0;
    check_refused(
        "api=gles point=1 shadows=1 shadow_store=r16f", &caps, SB_OVER_LIMIT,
        "shadow_store=r16f: this driver cannot draw to it; valid here: r8 depth");
    check_taken("api=gles point=1 shadows=1 shadow_store=r8", &caps);
    check_taken("api=gles point=1 shadows=1 shadow_store=depth", &caps);
}

static void what_contradicts_itself_is_refused(void **state)
{
    (void)state;
    check_refused("point=2 shadows=3", NULL, SB_BAD_INPUT,
                  "shadows=3: point lights cast them, and there are 2; valid: 0 to 2");
    check_refused("point=2 update=lights+shadows", NULL, SB_BAD_INPUT,
                  "update=lights+shadows: no light casts shadows; valid with shadows=0: "
                  "static lights");
    check_refused(
        "api=gles glsl=100 point=1 shadows=1", NULL, SB_BAD_INPUT,
        "shadows=1: GLSL ES 1.00 has no shadow maps here; valid with glsl=100: 0");
    check_refused(
        "api=gles glsl=300es point=1 shadows=1 shadow_map=cube_array", NULL, SB_BAD_INPUT,
        "shadow_map=cube_array: GLSL ES 3.00 has no cube map arrays; valid here: "
        "six2d array2d cube");
    check_refused(
        "api=gles glsl=300es point=1 shadows=1 shadow_pass=layered", NULL, SB_BAD_INPUT,
        "shadow_pass=layered: GLSL ES 3.00 has no geometry shaders; valid here: "
        "faces");
}

static double version_of(const char *words)
{
    struct sb_assembly assembly;
    assemble(words, &assembly);
    const double version = assembly.job.variant.value[SB_AXIS_GLSL];
    sb_assembly_free(&assembly);
    return version;
}

static void auto_glsl_is_310es_only_where_300es_lacks_the_feature(void **state)
{
    (void)state;
    assert_true(version_of("api=gles point=1 shadows=1") == SB_GLSL_300ES);
    assert_true(version_of("api=gles point=1 shadows=1 shadow_map=cube_array") ==
                SB_GLSL_310ES);
    assert_true(version_of("api=gles point=1 shadows=1 shadow_pass=layered") ==
                SB_GLSL_310ES);
    assert_true(version_of("api=gles point=1 shadow_map=cube_array") == SB_GLSL_300ES);
    assert_true(version_of("point=1 shadows=1 shadow_map=cube_array") == SB_GLSL_330);
}

static void a_job_with_shadows_has_a_program_for_them(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("point=2 shadows=2 shadow_pass=layered", &assembly);
    assert_int_equal(assembly.job.program_count, 2);
    assert_string_equal(assembly.job.program[1].role, "shadow");
    assert_non_null(assembly.job.program[1].geometry);
    sb_assembly_free(&assembly);
    assemble("point=2 shadows=2", &assembly);
    assert_null(assembly.job.program[1].geometry);
    sb_assembly_free(&assembly);
    assemble("point=2", &assembly);
    assert_int_equal(assembly.job.program_count, 1);
    sb_assembly_free(&assembly);
}

static void every_program_with_shadows_is_valid_glsl(void **state)
{
    (void)state;
    static const char *const versions[] = {"api=gl glsl=330", "api=gl glsl=450",
                                           "api=gles glsl=300es", "api=gles glsl=310es"};
    static const char *const maps[] = {
        "shadow_map=six2d",
        "shadow_map=array2d",
        "shadow_map=cube",
        "shadow_map=cube_array",
        "shadow_map=cube shadow_pass=layered",
        "shadow_map=cube_array shadow_pass=layered",
    };
    // Each value of each with each of the others' at least once over the maps.
    static const char *const qualities[] = {
        "shadow_store=r8 shadow_filter=1 shadow_bias_kind=slope precision=mediump",
        "shadow_store=r16f shadow_filter=4 space=view loop=unrolled",
        "shadow_store=r32f shadow_filter=16 precision=lowp loop=dynamic",
        "shadow_store=depth shadow_filter=4 shadow_bias_kind=slope loop=padded",
        "shadow_store=depth shadow_filter=16 precision=mediump storage=arrays",
    };
    if (validator_is_missing())
        skip();
    for (int v = 0; v < 4; v++)
        for (int m = 0; m < 6; m++)
            for (int q = 0; q < 5; q++) {
                struct sb_assembly assembly;
                struct sb_error err = {0};
                char words[300];
                if (v == 2 && m >= 3)
                    continue; // refused
                snprintf(words, sizeof words, "%s point=3 shadows=2 dir=1 %s %s",
                         versions[v], maps[m], qualities[q]);
                assemble(words, &assembly);
                if (!validate_in_sweep(&assembly, &err))
                    fail_msg("%s: %s", words, err.text);
                sb_assembly_free(&assembly);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_map_takes_its_texture_units_and_no_more),
        cmocka_unit_test(
            sixteen_casters_in_six2d_are_refused_with_the_limit_of_the_driver),
        cmocka_unit_test(the_units_of_all_stages_are_a_limit_of_their_own),
        cmocka_unit_test(arrays_end_with_the_layers_of_the_driver),
        cmocka_unit_test(maps_are_no_larger_than_textures_of_their_kind),
        cmocka_unit_test(what_the_driver_lacks_is_named_with_what_works),
        cmocka_unit_test(what_contradicts_itself_is_refused),
        cmocka_unit_test(auto_glsl_is_310es_only_where_300es_lacks_the_feature),
        cmocka_unit_test(a_job_with_shadows_has_a_program_for_them),
        cmocka_unit_test(every_program_with_shadows_is_valid_glsl),
    };
    return run_tests(tests);
}
