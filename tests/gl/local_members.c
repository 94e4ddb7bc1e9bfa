// The lights of the shipped shaders: a variant is given what it reads, and nothing else.
#include "assemble_words.h"
#include "gl/program.h"
#include "gl_test.h"
#include "local/local.h"
#include "scene/lights.h"

static void *runner;
static struct sb_caps caps;
static const struct sb_runner_fns *const fns = &sb_runner_local;

static void assemble_here(const char *words, uint32_t id, struct sb_assembly *assembly)
{
    struct sb_variant variant;
    struct sb_error err = {0};
    char all[400];
    snprintf(all, sizeof all, "%swidth=64 height=64 %s", caps.gles ? "api=gles " : "",
             words);
    variant_of_words(sb_axes_builtin(), all, &variant);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = sb_axes_builtin(),
        .scene = "containers",
        .variant = &variant,
        .caps = &caps,
        .id = id,
    };
    *assembly = (struct sb_assembly){0};
    if (!sb_assemble(&params, assembly, &err))
        fail_msg("%s: %s", all, err.text);
}

// --- calls -----------------------------------------------------------------------------

static int64_t calls_of(const char *words)
{
    struct sb_assembly assembly;
    struct sb_prepared prepared;
    assemble_here(words, 1, &assembly);
    if (!fns->prepare(runner, &assembly.job, &prepared))
        fail_msg("%s: %s", words, prepared.error.text);
    fns->release(runner, 1);
    sb_assembly_free(&assembly);
    return prepared.gl_calls;
}

// What a frame does more where the lights are uploaded in it.
static int64_t calls_of_upload(const char *words)
{
    char moving[300];
    snprintf(moving, sizeof moving, "%s update=lights", words);
    return calls_of(moving) - calls_of(words);
}

#define DELPHI                                                                           \
    "source=delphi model=phong ambient=per_light attenuation=polynomial cone=smooth "    \
    "specular_side=both hoist=per_light "

// The text counts its calls: 4 point lights with 7 members each are 28.
static void the_struct_of_delphi_takes_as_many_calls_as_in_its_text(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int uniforms, others;
    } rows[] = {
        {"storage=uniform point=4", 28, 1}, // glUseProgram
        {"storage=arrays point=4", 7, 1},
        {"storage=ubo_std140 point=4", 0, 2}, // glBindBuffer, glBufferSubData
        {"storage=ubo_shared point=4", 0, 2},
        {"storage=uniform dir=1", 4, 1},
        {"storage=uniform spot=1", 10, 1},
        {"storage=uniform dir=1 point=4 spot=1", 4 + 28 + 10, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char words[256];
        snprintf(words, sizeof words, DELPHI "%s", rows[i].words);
        const int64_t calls = calls_of_upload(words);
        if (calls != rows[i].uniforms + rows[i].others)
            fail_msg("%s: %d calls", rows[i].words, (int)calls);
    }
}

// --- members ---------------------------------------------------------------------------

// A driver leaves out the arrays that nothing reads.
static void check_active(const char *words)
{
    struct sb_assembly assembly;
    struct sb_gl_program program;
    assemble_here(words, 1, &assembly);
    if (!sb_gl_program_make(&assembly.job.program[0], &program))
        fail_msg("%s: %s", words, program.log);
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        struct sb_light_members members = {0};
        if (sb_lights_slots(&assembly.job.variant, (enum sb_light_type)t) > 0)
            sb_light_members_of(&sb_light_structs[t], &assembly.job.variant, &members);
        for (int i = 0; i < members.count; i++) {
            char name[64];
            snprintf(name, sizeof name, "%s_%s", sb_light_structs[t].array,
                     members.field[i]->name);
            if (glGetUniformLocation(program.name, name) < 0)
                fail_msg("%s: %s is not read", words, name);
        }
    }
    sb_gl_program_free(&program);
    sb_assembly_free(&assembly);
}

// Not asked: cone=linear and cone=hard with hoist=once, whose forms read different members and
// are both in the text.
static void a_variant_reads_every_member_that_it_declares(void **state)
{
    (void)state;
    static const char *const asked[] = {
        "",
        "ambient=none",
        "ambient=per_light",
        "model=lambert",
        "model=phong loop=padded",
        "attenuation=none",
        "attenuation=radius",
        "attenuation=windowed",
        "cone=exponent",
        "cone=hard form=naive hoist=per_light",
        "cone=exponent hoist=per_light",
        "cone=linear hoist=per_light",
        "cone=smooth hoist=per_light",
        "area_shape=tube",
        "area_shape=box",
        "area_shape=capsule",
    };
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        char words[256];
        snprintf(words, sizeof words, "storage=arrays dir=1 point=2 spot=1 area=1 %s",
                 asked[i]);
        check_active(words);
    }
    check_active("storage=arrays point=2 shadows=1 attenuation=none");
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_struct_of_delphi_takes_as_many_calls_as_in_its_text),
        cmocka_unit_test(a_variant_reads_every_member_that_it_declares),
    };
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    runner = fns->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    const int failed = run_tests(tests);
    fns->close(runner);
    return failed;
}
