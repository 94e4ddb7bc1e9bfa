// Which programs a job has, and whose message is whose.
#include "assemble_words.h"
#include "shader_folder.h"

static const char *const files[] = {"shade.vert",  "shade.frag",  "shadow.vert",
                                    "shadow.geom", "shadow.frag", "lamp.vert",
                                    "lamp.frag"};
enum { FILES = sizeof files / sizeof *files };

// Each file says its name in its second line.
static void make_files(struct shader_folder *folder)
{
    folder_make(folder);
    for (int i = 0; i < FILES; i++) {
        char text[64];
        snprintf(text, sizeof text, "\n// %s\n", files[i]);
        folder_write(folder, files[i], text);
    }
}

static void assemble_in(const struct shader_folder *folder, const char *words,
                        struct sb_assembly *assembly)
{
    const struct assembling from = {.words = words, .shaders = folder->root};
    struct sb_error err = {0};
    if (!assemble_from(&from, assembly, &err))
        fail_msg("%s: %s", words, err.text);
}

static void check_text(const char *text, const char *role, const char *stage)
{
    char line[64];
    snprintf(line, sizeof line, "\n// %s.%s\n", role, stage);
    check_contains(text, line);
}

// `layered`: the program of the shadows has a geometry shader.
static void check_programs(const char *words, const char *const *roles, int count,
                           bool layered)
{
    struct shader_folder folder;
    struct sb_assembly assembly;
    make_files(&folder);
    assemble_in(&folder, words, &assembly);
    assert_int_equal(assembly.job.program_count, count);
    for (int i = 0; i < count; i++) {
        const struct sb_program *program = &assembly.job.program[i];
        assert_string_equal(program->role, roles[i]);
        check_text(program->vertex, roles[i], "vert");
        check_text(program->fragment, roles[i], "frag");
        const bool geometry = layered && strcmp(roles[i], "shadow") == 0;
        assert_int_equal(program->geometry != NULL, geometry);
        if (geometry)
            check_text(program->geometry, roles[i], "geom");
    }
    sb_assembly_free(&assembly);
    folder_free(&folder);
}

static void probes_are_the_lit_program_told_apart_by_a_define(void **state)
{
    (void)state;
    struct sb_assembly plain, probed;
    struct sb_error err = {0};
    assemble("point=1 lamps=on", &plain);
    const struct assembling from = {.words = "point=1 lamps=on", .probe = true};
    assert_true(assemble_from(&from, &probed, &err));
    assert_int_equal(probed.job.program_count, plain.job.program_count + 2);
    assert_int_equal(probed.source_hash, plain.source_hash);
    for (int i = 0; i < plain.job.program_count; i++) {
        assert_string_equal(plain.job.program[i].vertex, probed.job.program[i].vertex);
        assert_string_equal(plain.job.program[i].fragment,
                            probed.job.program[i].fragment);
        check_contains(plain.job.program[i].fragment, "#define PROBE off\n");
    }
    const struct sb_program *probe = &probed.job.program[plain.job.program_count];
    assert_string_equal(probe->role, "probe");
    check_contains(probe->fragment, "#define PROBE on\n");
    check_contains(probe->fragment, "o_probe0");
    assert_null(strstr(probed.job.program[0].fragment, "o_probe0"));
    const struct sb_program *inputs = probe + 1;
    assert_string_equal(inputs->role, "inputs");
    check_contains(inputs->fragment, "#define PROBE inputs\n");
    check_contains(inputs->fragment, "o_probe0");
    assert_null(strstr(inputs->fragment, "u_probe_light"));
    sb_assembly_free(&plain);
    sb_assembly_free(&probed);
}

static void glsl_es_1_00_has_no_probe(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    struct sb_error err = {0};
    const struct assembling from = {.words = "api=gles glsl=100 point=1", .probe = true};
    assert_true(assemble_from(&from, &assembly, &err));
    assert_int_equal(assembly.job.program_count, 1);
    sb_assembly_free(&assembly);
}

static void a_job_has_the_programs_that_it_draws_with_the_lit_one_first(void **state)
{
    (void)state;
    static const char *const all[] = {"shade", "shadow", "lamp"};
    static const char *const lamp[] = {"shade", "lamp"};
    check_programs("point=1", all, 1, false);
    check_programs("point=1 shadows=1", all, 2, false);
    check_programs("point=1 shadows=1 shadow_pass=layered", all, 2, true);
    check_programs("point=1 lamps=on", lamp, 2, false);
    check_programs("point=2 shadows=2 lamps=on shadow_pass=layered", all, 3, true);
    check_programs("lamps=on", all, 1, false); // moot: no light to show
}

static void the_job_points_to_what_was_asked_for(void **state)
{
    (void)state;
    struct sb_assembly assembly;
    assemble("point=1", &assembly);
    assert_int_equal(assembly.job.id, 7);
    assert_string_equal(assembly.job.scene, "sphere");
    assert_string_equal(assembly.job.program[0].vertex,
                        shade_of(&assembly, VERTEX)->text);
    assert_false(assembly.lit_per_vertex);
    sb_assembly_free(&assembly);
    assemble("stage=vertex", &assembly);
    assert_true(assembly.lit_per_vertex);
    sb_assembly_free(&assembly);
}

static void a_change_in_any_text_is_another_source(void **state)
{
    (void)state;
    const char *const words = "point=1 shadows=1 lamps=on shadow_pass=layered";
    struct shader_folder folder;
    struct sb_assembly assembly;
    uint64_t seen[FILES + 1];
    make_files(&folder);
    for (int i = 0; i <= FILES; i++) {
        if (i > 0)
            folder_write(&folder, files[i - 1], "// changed\n");
        assemble_in(&folder, words, &assembly);
        seen[i] = assembly.source_hash;
        sb_assembly_free(&assembly);
        for (int before = 0; before < i; before++)
            assert_true(seen[before] != seen[i]);
    }
    folder_free(&folder);
}

// The line of the flat text that says "// shadow.geom".
static int line_of(const char *text, const char *file)
{
    int line = 1;
    const char *end = strstr(text, file);
    assert_non_null(end);
    for (const char *at = text; at < end; at++)
        line += *at == '\n';
    return line;
}

static void a_drivers_log_is_read_by_program_and_stage(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int program;
        enum sb_failed_stage stage;
        const char *file;
    } rows[] = {
        {"point=1", 0, SB_STAGE_VERT, "shade.vert"},
        {"point=1", 0, SB_STAGE_FRAG, "shade.frag"},
        {"point=1 shadows=1 lamps=on", 1, SB_STAGE_VERT, "shadow.vert"},
        {"point=1 shadows=1 lamps=on shadow_pass=layered", 1, SB_STAGE_GEOM,
         "shadow.geom"},
        {"point=1 shadows=1 lamps=on", 2, SB_STAGE_FRAG, "lamp.frag"},
        {"point=1 lamps=on", 1, SB_STAGE_VERT, "lamp.vert"},
    };
    struct shader_folder folder;
    make_files(&folder);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sb_assembly assembly;
        assemble_in(&folder, rows[i].words, &assembly);
        const struct sb_program *program = &assembly.job.program[rows[i].program];
        const char *text[] = {program->vertex, program->geometry, program->fragment};
        const int line = line_of(text[rows[i].stage - SB_STAGE_VERT], rows[i].file);
        char log[64], wanted[64];
        snprintf(log, sizeof log, "0:%d(3): error: x\n", line);
        snprintf(wanted, sizeof wanted, "%s:2:3: error: x\n", rows[i].file);
        struct sb_prepared prepared = {
            .failed_program = rows[i].program, .failed_stage = rows[i].stage, .log = log};
        struct sb_text explained = {0};
        sb_assembly_explain(&assembly, &prepared, &explained);
        assert_string_equal(sb_text_get(&explained), wanted);
        sb_text_clear(&explained);
        prepared.failed_stage = SB_STAGE_LINK; // speaks of several stages, by name
        sb_assembly_explain(&assembly, &prepared, &explained);
        assert_string_equal(sb_text_get(&explained), log);
        sb_text_free(&explained);
        sb_assembly_free(&assembly);
    }
    folder_free(&folder);
}

static void a_file_that_is_missing_is_named(void **state)
{
    (void)state;
    struct shader_folder folder;
    struct sb_assembly assembly;
    struct sb_error err = {0};
    folder_make(&folder);
    folder_write(&folder, "shade.vert", "");
    folder_write(&folder, "shade.frag", "");
    const struct assembling from = {.words = "point=1 lamps=on", .shaders = folder.root};
    assert_false(assemble_from(&from, &assembly, &err));
    check_contains(err.text, "lamp.vert: No such file");
    sb_assembly_free(&assembly);
    folder_free(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probes_are_the_lit_program_told_apart_by_a_define),
        cmocka_unit_test(glsl_es_1_00_has_no_probe),
        cmocka_unit_test(a_job_has_the_programs_that_it_draws_with_the_lit_one_first),
        cmocka_unit_test(the_job_points_to_what_was_asked_for),
        cmocka_unit_test(a_change_in_any_text_is_another_source),
        cmocka_unit_test(a_drivers_log_is_read_by_program_and_stage),
        cmocka_unit_test(a_file_that_is_missing_is_named),
    };
    return run_tests(tests);
}
