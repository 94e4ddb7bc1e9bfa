#include "assemble_words.h"

#include "scene/lights.h"

static double decided(const char *words, const struct sb_caps *caps, int axis)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    if (!assemble_with(sb_axes_builtin(), words, caps, &assembly, &err))
        fail_msg("%s: %s", words, err.text);
    const double value = assembly.job.variant.value[axis];
    sb_assembly_free(&assembly);
    return value;
}

static void check_refused(const char *words, const struct sb_caps *caps,
                          enum sb_status status, const char *part)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    const bool good = assemble_with(sb_axes_builtin(), words, caps, &assembly, &err);
    sb_assembly_free(&assembly);
    assert_false(good);
    assert_int_equal(err.status, status);
    check_contains(err.text, part);
}

static void auto_glsl_is_330_on_gl_and_300es_on_gles(void **state)
{
    (void)state;
    assert_true(decided("", NULL, SB_AXIS_GLSL) == SB_GLSL_330);
    assert_true(decided("api=gles", NULL, SB_AXIS_GLSL) == SB_GLSL_300ES);
    assert_true(decided("glsl=450", NULL, SB_AXIS_GLSL) == SB_GLSL_450);
}

static void each_version_writes_its_own_first_line(void **state)
{
    (void)state;
    static const struct {
        const char *words, *line;
    } rows[] = {
        {"api=gl", "#version 330 core\n#define GLSL_FAMILY gl\n"},
        {"api=gl glsl=450", "#version 450 core\n#define GLSL_FAMILY gl\n"},
        {"api=gles", "#version 300 es\n#define GLSL_FAMILY es300\n"},
        {"api=gles glsl=310es", "#version 310 es\n#define GLSL_FAMILY es300\n"},
        {"api=gles glsl=100", "#version 100\n#define GLSL_FAMILY es100\n"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        assemble(rows[i].words, &assembly);
        assert_memory_equal(assembly.vertex.text, rows[i].line, strlen(rows[i].line));
        assert_memory_equal(assembly.fragment.text, rows[i].line, strlen(rows[i].line));
        sb_assembly_free(&assembly);
    }
}

static void a_version_that_the_context_cannot_take_is_refused_with_the_valid_ones(
    void **state)
{
    (void)state;
    check_refused("glsl=300es", NULL, SB_BAD_INPUT, "valid here: 330 450");
    check_refused("api=gles glsl=330", NULL, SB_BAD_INPUT, "valid here: 100 300es 310es");
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.glsl = 330;
    check_refused("glsl=450", &caps, SB_BAD_INPUT, "valid here: 330");
    check_refused("api=gles", &caps, SB_BAD_INPUT, "valid here: gl");
    caps.glsl = 140;
    check_refused("", &caps, SB_BAD_INPUT, "up to 140; valid here: none");
    sb_caps_ideal(true, &caps);
    caps.glsl = 100;
    check_refused("api=gles", &caps, SB_BAD_INPUT, "glsl=300es");
    assert_true(decided("api=gles glsl=100", &caps, SB_AXIS_GLSL) == SB_GLSL_100);
}

// Components of a light where each member takes a vec4, and packed: directional 16 and 12,
// point 32 and 16, spot 56 and 24. Of the other uniforms: 68 and 57.
static void auto_storage_is_uniform_as_far_as_the_loosest_packing_fits(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.fragment_uniform_components = 1024;
    assert_true(decided("point=29", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    assert_true(decided("point=30", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UBO_STD140);
    assert_true(decided("dir=59", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    assert_true(decided("dir=60", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UBO_STD140);
    assert_true(decided("spot=17", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    assert_true(decided("spot=18", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UBO_STD140);
    assert_true(decided("stage=vertex point=30", &caps, SB_AXIS_STORAGE) ==
                SB_STORAGE_UNIFORM);
    caps.vertex_uniform_components = 256;
    assert_true(decided("dir=59", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    assert_true(decided("dir=60", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UBO_STD140);
    assert_true(decided("spot=17", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    assert_true(decided("spot=18", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UBO_STD140);
    assert_true(decided("stage=vertex point=30", &caps, SB_AXIS_STORAGE) ==
                SB_STORAGE_UBO_STD140);
    // Nowhere else to go: taken as far as any packing could fit.
    caps.uniform_block_size = 0;
    assert_true(decided("point=60", &caps, SB_AXIS_STORAGE) == SB_STORAGE_UNIFORM);
    check_refused("point=61", &caps, SB_OVER_LIMIT, "GL_MAX_FRAGMENT_UNIFORM_COMPONENTS");
}

static void uniform_by_name_is_refused_where_no_packing_fits(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.fragment_uniform_components = 1024;
    assert_true(decided("storage=uniform point=60", &caps, SB_AXIS_STORAGE) ==
                SB_STORAGE_UNIFORM);
    check_refused("storage=uniform point=61", &caps, SB_OVER_LIMIT,
                  "fragment shader wants 1033 uniform components, this driver has 1024");
    check_refused("storage=uniform point=61", &caps, SB_OVER_LIMIT, "storage=ubo_std140");
    caps.vertex_uniform_components = 0;
    check_refused("storage=uniform stage=vertex", &caps, SB_OVER_LIMIT,
                  "GL_MAX_VERTEX_UNIFORM_COMPONENTS");
}

static void a_block_is_refused_where_it_is_too_large(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.uniform_block_size = 16384;
    assert_true(decided("storage=ubo_std140 point=256", &caps, SB_AXIS_STORAGE) ==
                SB_STORAGE_UBO_STD140);
    check_refused("storage=ubo_std140 point=256 dir=1", &caps, SB_OVER_LIMIT,
                  "16448 bytes, this driver has 16384 (GL_MAX_UNIFORM_BLOCK_SIZE)");
    caps.uniform_block_size = 65536;
    decided("storage=ubo_std140 dir=256 point=256 spot=256", &caps, SB_AXIS_STORAGE);
}

static void glsl_100_has_no_blocks(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(true, &caps);
    caps.fragment_uniform_components = 1024;
    check_refused("api=gles glsl=100 storage=ubo_std140", &caps, SB_BAD_INPUT,
                  "valid with glsl=100: auto uniform");
    assert_true(decided("api=gles glsl=100 point=60", &caps, SB_AXIS_STORAGE) ==
                SB_STORAGE_UNIFORM);
    check_refused("api=gles glsl=100 point=61", &caps, SB_OVER_LIMIT, "fewer lights fit");
}

static void deciding_leaves_what_was_asked_for_by_name_alone(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("stage=vertex", &assembly);
    struct sb_text id = {0};
    sb_variant_id(sb_axes_builtin(), &assembly.job.variant, &id);
    assert_string_equal(sb_text_get(&id), "stage=vertex");
    sb_text_free(&id);
    sb_assembly_free(&assembly);
}

static void the_job_holds_one_program_called_shade(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("point=1", &assembly);
    assert_int_equal(assembly.job.id, 7);
    assert_string_equal(assembly.job.scene, "sphere");
    assert_int_equal(assembly.job.program_count, 1);
    assert_string_equal(assembly.job.program[0].role, "shade");
    assert_string_equal(assembly.job.program[0].vertex, assembly.vertex.text);
    assert_string_equal(assembly.job.program[0].fragment, assembly.fragment.text);
    assert_false(assembly.lit_per_vertex);
    sb_assembly_free(&assembly);
    assemble("stage=vertex", &assembly);
    assert_true(assembly.lit_per_vertex);
    sb_assembly_free(&assembly);
}

// The std140 layout of a GLSL struct of floats and vec3, by the rules of OpenGL 4.6 core,
// 7.6.2.2, from the text of the shader, against the offsets of the C struct.
static void check_struct(const char *glsl, const char *name,
                         const struct sb_light_type_row *type)
{
    char opening[64];
    snprintf(opening, sizeof opening, "struct %s {", name);
    const char *at = strstr(glsl, opening);
    assert_non_null(at);
    at += strlen(opening);
    size_t offset = 0;
    for (int f = 0; f < type->field_count; f++) {
        if (!strncmp(type->field[f].name, "pad", 3))
            continue;
        char kind[8], member[32];
        at = strstr(at, "P_UNIFORM ");
        assert_non_null(at);
        assert_int_equal(sscanf(at, "P_UNIFORM %7s %31[a-z_0-9];", kind, member), 2);
        assert_string_equal(member, type->field[f].name);
        const int components = strcmp(kind, "vec3") == 0 ? 3 : 1;
        assert_int_equal(components, type->field[f].components);
        if (components == 3)
            offset = (offset + 15) / 16 * 16;
        assert_int_equal(offset, type->field[f].offset);
        offset += (size_t)components * 4;
        at++;
    }
    assert_int_equal((offset + 15) / 16 * 16, type->size);
    const char *next = strstr(at, "P_UNIFORM "); // of another struct, if any
    assert_true(!next || strchr(at, '}') < next);
}

static void the_structs_of_the_shaders_are_laid_out_as_those_of_c(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("point=1", &assembly);
    check_struct(assembly.fragment.text, "DirLight", &sb_light_types[SB_LIGHT_DIR]);
    check_struct(assembly.fragment.text, "PointLight", &sb_light_types[SB_LIGHT_POINT]);
    check_struct(assembly.fragment.text, "SpotLight", &sb_light_types[SB_LIGHT_SPOT]);
    sb_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(auto_glsl_is_330_on_gl_and_300es_on_gles),
        cmocka_unit_test(each_version_writes_its_own_first_line),
        cmocka_unit_test(
            a_version_that_the_context_cannot_take_is_refused_with_the_valid_ones),
        cmocka_unit_test(auto_storage_is_uniform_as_far_as_the_loosest_packing_fits),
        cmocka_unit_test(uniform_by_name_is_refused_where_no_packing_fits),
        cmocka_unit_test(a_block_is_refused_where_it_is_too_large),
        cmocka_unit_test(glsl_100_has_no_blocks),
        cmocka_unit_test(deciding_leaves_what_was_asked_for_by_name_alone),
        cmocka_unit_test(the_job_holds_one_program_called_shade),
        cmocka_unit_test(the_structs_of_the_shaders_are_laid_out_as_those_of_c),
    };
    return run_tests(tests);
}
