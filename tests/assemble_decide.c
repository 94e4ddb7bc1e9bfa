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
        for (int stage = VERTEX; stage <= FRAGMENT; stage += FRAGMENT - VERTEX)
            assert_memory_equal(shade_of(&assembly, stage)->text, rows[i].line,
                                strlen(rows[i].line));
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

static double stored(const char *words, const struct sb_caps *caps)
{
    return decided(words, caps, SB_AXIS_STORAGE);
}

// Components of a light where each member takes a vec4, and packed: directional 12 and 9,
// point 24 and 12, spot 36 and 17, area 28 and 13, of any type 44 and 19; each kind of light
// has one number more with loop=padded. Of the other uniforms: 68 and 57.
static void auto_storage_is_uniform_as_far_as_the_loosest_packing_fits(void **state)
{
    (void)state;
    static const struct {
        const char *fits, *does_not;
    } rows[] = {
        {"point=39", "point=40"},
        {"dir=79", "dir=80"},
        {"spot=26", "spot=27"},
        {"area=34", "area=35"},
        {"layout=unified point=21", "layout=unified point=22"},
        {"layout=unified dir=6 point=6 spot=9", "layout=unified dir=6 point=6 spot=10"},
        {"dir=80 sun=100", "dir=81 sun=100"}, // one is below the horizon
        {"point=1 loop=padded capacity=15 area=1",
         "point=1 loop=padded capacity=16 area=1"},
        {"point=38 space=view", "point=39 space=view"},
        {"point=39 hoist=per_light", "dir=1 point=39 hoist=per_light"},
        {"dir=78 loop=dynamic", "dir=79 loop=dynamic"},
        {"point=34 ambient=per_light", "point=35 ambient=per_light"},
        {"point=79 attenuation=none", "point=80 attenuation=none"},
        {"point=59 attenuation=radius", "point=60 attenuation=radius"},
    };
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.fragment_uniform_components = 1024;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (stored(rows[i].fits, &caps) != SB_STORAGE_UNIFORM)
            fail_msg("%s: not uniform", rows[i].fits);
        if (stored(rows[i].does_not, &caps) != SB_STORAGE_UBO_STD140)
            fail_msg("%s: not ubo_std140", rows[i].does_not);
    }
    caps.vertex_uniform_components = 256;
    assert_true(stored("dir=79", &caps) == SB_STORAGE_UNIFORM);
    assert_true(stored("stage=vertex dir=15", &caps) == SB_STORAGE_UNIFORM);
    assert_true(stored("stage=vertex dir=16", &caps) == SB_STORAGE_UBO_STD140);
    // Nowhere else to go: taken as far as any packing could fit.
    caps.uniform_block_size = 0;
    assert_true(stored("point=80", &caps) == SB_STORAGE_UNIFORM);
    check_refused("point=81", &caps, SB_OVER_LIMIT, "GL_MAX_FRAGMENT_UNIFORM_COMPONENTS");
}

static void uniform_by_name_is_refused_where_no_packing_fits(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.fragment_uniform_components = 1024;
    assert_true(stored("storage=uniform point=80", &caps) == SB_STORAGE_UNIFORM);
    assert_true(stored("storage=arrays point=80", &caps) == SB_STORAGE_ARRAYS);
    check_refused("storage=uniform point=81", &caps, SB_OVER_LIMIT,
                  "fragment shader wants 1029 uniform components, this driver has 1024");
    check_refused("storage=uniform point=81", &caps, SB_OVER_LIMIT, "storage=ubo_std140");
    check_refused("storage=arrays point=81", &caps, SB_OVER_LIMIT,
                  "storage=arrays: the fragment shader wants 1029");
    caps.vertex_uniform_components = 0;
    check_refused("storage=uniform stage=vertex", &caps, SB_OVER_LIMIT,
                  "GL_MAX_VERTEX_UNIFORM_COMPONENTS");
}

// In std140 directional and point lights with ambient light of their own take 64 bytes, a
// light of any type 96.
static void a_block_is_refused_where_it_is_too_large(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    caps.uniform_block_size = 16384;
    assert_true(stored("storage=ubo_std140 ambient=per_light point=256", &caps) ==
                SB_STORAGE_UBO_STD140);
    check_refused("storage=ubo_std140 ambient=per_light point=256 dir=1", &caps,
                  SB_OVER_LIMIT,
                  "16448 bytes, this driver has 16384 (GL_MAX_UNIFORM_BLOCK_SIZE)");
    assert_true(stored("storage=ubo_shared ambient=per_light point=256", &caps) ==
                SB_STORAGE_UBO_SHARED);
    check_refused("storage=ubo_shared ambient=per_light point=256 dir=1", &caps,
                  SB_OVER_LIMIT,
                  "storage=ubo_shared: the lights want a uniform block of 16448 bytes");
    check_refused("storage=ubo_std140 point=1 spot=1 loop=padded capacity=256", &caps,
                  SB_OVER_LIMIT, "bytes");
    check_refused("storage=ubo_std140 ambient=per_light layout=unified point=171", &caps,
                  SB_OVER_LIMIT, "16416 bytes");
    caps.uniform_block_size = 65536;
    decided("storage=ubo_std140 dir=256 point=256 spot=256", &caps, SB_AXIS_STORAGE);
}

// A slip that nothing is left of would be a second name for the corrected text.
static void slips_are_refused_where_the_variant_leaves_nothing_of_them(void **state)
{
    (void)state;
    struct sb_caps caps;
    sb_caps_ideal(false, &caps);
    check_refused(
        "source=lwjgl text=as_written point=1", &caps, SB_BAD_INPUT,
        "space=world with text=as_written of lwjgl: its slips are those of view "
        "space; valid: space=view, or text=corrected");
    check_refused("source=ubo text=as_written point=1 model=blinn", &caps, SB_BAD_INPUT,
                  "valid: model=phong");
    check_refused("source=shadows text=as_written point=1 model=lambert", &caps,
                  SB_BAD_INPUT, "valid: model=phong");
    decided("source=lwjgl text=as_written point=1 space=view model=blinn", &caps,
            SB_AXIS_SPACE);
    decided("source=ubo text=corrected point=1 model=blinn", &caps, SB_AXIS_MODEL);
}

static void glsl_100_lacks_blocks_constant_arrays_and_free_loop_bounds(void **state)
{
    (void)state;
    static const struct {
        const char *words, *message;
    } rows[] = {
        {"storage=ubo_std140", "no uniform blocks; valid with glsl=100: auto global "
                               "uniform arrays"},
        {"storage=ubo_shared", "no uniform blocks; valid with glsl=100"},
        {"storage=constant", "no constant arrays; valid with glsl=100: auto global "
                             "uniform arrays"},
        {"loop=dynamic", "valid with glsl=100: unrolled constant padded"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char words[128];
        snprintf(words, sizeof words, "api=gles glsl=100 point=1 %s", rows[i].words);
        check_refused(words, NULL, SB_BAD_INPUT, rows[i].message);
    }
    struct sb_caps caps;
    sb_caps_ideal(true, &caps);
    caps.fragment_uniform_components = 1024;
    assert_true(stored("api=gles glsl=100 point=80", &caps) == SB_STORAGE_UNIFORM);
    check_refused("api=gles glsl=100 point=81", &caps, SB_OVER_LIMIT, "fewer lights fit");
    decided("api=gles glsl=100 point=81 storage=global", &caps, SB_AXIS_STORAGE);
    decided("api=gles glsl=100 point=1 loop=padded capacity=3", &caps, SB_AXIS_LOOP);
    decided("api=gles point=1 loop=dynamic", &caps, SB_AXIS_LOOP);
}

static void lights_in_the_text_cannot_be_updated(void **state)
{
    (void)state;
    check_refused(
        "storage=constant point=1 update=lights", NULL, SB_BAD_INPUT,
        "storage=constant: the lights are part of the shader, so update=lights");
    check_refused("storage=global point=1 update=lights", NULL, SB_BAD_INPUT,
                  "valid: update=static");
    decided("storage=global point=1", NULL, SB_AXIS_STORAGE);
    decided("storage=uniform point=1 update=lights", NULL, SB_AXIS_STORAGE);
}

static void the_slip_of_two_queried_offsets_goes_as_far_as_two_lights(void **state)
{
    (void)state;
    const char *const slip =
        "source=ubo text=as_written model=phong storage=ubo_shared point=2";
    char words[128];
    decided(slip, NULL, SB_AXIS_STORAGE);
    snprintf(words, sizeof words, "%s dir=1", slip);
    check_refused(words, NULL, SB_BAD_INPUT, "the third of 3");
    snprintf(words, sizeof words, "%s dir=1 sun=100", slip);
    decided(words, NULL, SB_AXIS_STORAGE);
    decided("source=ubo text=as_written model=phong storage=ubo_std140 point=3", NULL,
            SB_AXIS_STORAGE);
    decided("source=ubo storage=ubo_shared point=3", NULL, SB_AXIS_STORAGE);
}

// A twin of the same class whose lights can be switched off.
static void movable_lights_are_uniforms(void **state)
{
    (void)state;
    static const char *const words[] = {"point=2 storage=constant",
                                        "point=2 storage=global",
                                        "point=2 storage=ubo_shared"};
    static const int movable[] = {SB_STORAGE_UNIFORM, SB_STORAGE_UNIFORM,
                                  SB_STORAGE_UBO_SHARED};
    for (int i = 0; i < 3; i++) {
        struct assembling from = {.words = words[i]};
        struct sb_assembly assembly;
        struct sb_error err = {0};
        assert_true(assemble_from(&from, &assembly, &err));
        assert_int_equal(assembly.lights_fixed, i < 2);
        sb_assembly_free(&assembly);
        from.movable_lights = true;
        assert_true(assemble_from(&from, &assembly, &err));
        assert_false(assembly.lights_fixed);
        assert_true(assembly.job.variant.value[SB_AXIS_STORAGE] == movable[i]);
        sb_assembly_free(&assembly);
    }
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

// The std140 layout of a GLSL struct of floats and vec3, by the rules of OpenGL 4.6 core,
// 7.6.2.2, from the text of the shader, against the table by which buffers are filled.
static void check_struct(const char *glsl, const struct sb_light_struct *row,
                         const struct sb_light_members *members)
{
    char opening[64];
    snprintf(opening, sizeof opening, "struct %s {", row->type);
    const char *at = strstr(glsl, opening);
    assert_non_null(at);
    const char *end = strchr(at, '}');
    size_t offset = 0;
    for (int i = 0; i < members->count; i++) {
        char kind[8], member[32];
        at = strstr(at + 1, "P_UNIFORM ");
        assert_true(at && at < end);
        assert_int_equal(sscanf(at, "P_UNIFORM %7s %31[a-z_0-9];", kind, member), 2);
        assert_string_equal(member, members->field[i]->name);
        const int components = strcmp(kind, "vec3") == 0 ? 3 : 1;
        assert_int_equal(components, members->field[i]->components);
        if (components == 3)
            offset = (offset + 15) / 16 * 16;
        assert_int_equal(offset, sb_light_std140_offset(members, i));
        offset += (size_t)components * 4;
    }
    assert_int_equal((offset + 15) / 16 * 16, sb_light_std140_size(members));
    const char *next = strstr(at + 1, "P_UNIFORM "); // of another struct, if any
    assert_true(!next || end < next);
}

// uniform P_UNIFORM vec3 u_point_position[ … and the struct that is made of such elements.
static void check_arrays(const char *glsl, const struct sb_light_struct *row,
                         const struct sb_light_members *members)
{
    struct sb_text made = {0};
    sb_text_printf(&made, "#define %s(i) %s(", row->element, row->type);
    for (int i = 0; i < members->count; i++) {
        char line[96];
        snprintf(line, sizeof line, "uniform P_UNIFORM %s %s_%s[MAX_%sS];\n",
                 members->field[i]->components == 3 ? "vec3" : "float", row->array,
                 members->field[i]->name, row->element);
        check_contains(glsl, line);
        sb_text_printf(&made, "%s%s_%s[i]", i ? ", " : "", row->array,
                       members->field[i]->name);
    }
    sb_text_add(&made, ")\n");
    check_contains(glsl, sb_text_get(&made));
    sb_text_free(&made);
}

static const char *const members_asked[] = {
    "",
    "layout=unified",
    "ambient=per_light loop=padded hoist=per_light",
    "model=lambert attenuation=radius cone=linear",
    "attenuation=windowed cone=hard area_shape=box",
    "attenuation=none cone=exponent area_shape=capsule",
    "layout=unified loop=padded hoist=per_light ambient=per_light attenuation=radius",
};
enum { MEMBERS_ASKED = sizeof members_asked / sizeof *members_asked };

static void shaders_declare_the_members_that_the_table_gives_their_variant(void **state)
{
    (void)state;
    for (int asked = 0; asked < MEMBERS_ASKED; asked++) {
        for (int arrays = 0; arrays < 2; arrays++) {
            char words[192];
            struct sb_assembly assembly;
            snprintf(words, sizeof words, "storage=%s dir=1 point=1 spot=1 %s %s",
                     arrays ? "arrays" : "uniform",
                     strstr(members_asked[asked], "unified") ? "" : "area=1",
                     members_asked[asked]);
            assemble(words, &assembly);
            const struct sb_variant *variant = &assembly.job.variant;
            const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
            const char *glsl = shade_of(&assembly, FRAGMENT)->text;
            for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
                const struct sb_light_struct *row = &sb_light_structs[s];
                struct sb_light_members members;
                sb_light_members_of(row, variant, &members);
                check_struct(glsl, row, &members);
                if (arrays && (s == SB_LIGHT_UNIFIED) == unified)
                    check_arrays(glsl, row, &members);
            }
            sb_assembly_free(&assembly);
        }
    }
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
        cmocka_unit_test(slips_are_refused_where_the_variant_leaves_nothing_of_them),
        cmocka_unit_test(glsl_100_lacks_blocks_constant_arrays_and_free_loop_bounds),
        cmocka_unit_test(lights_in_the_text_cannot_be_updated),
        cmocka_unit_test(the_slip_of_two_queried_offsets_goes_as_far_as_two_lights),
        cmocka_unit_test(movable_lights_are_uniforms),
        cmocka_unit_test(deciding_leaves_what_was_asked_for_by_name_alone),
        cmocka_unit_test(shaders_declare_the_members_that_the_table_gives_their_variant),
    };
    return run_tests(tests);
}
