// The program on a real context, from its arguments to files, tables and exit codes.
#include "cli_gl.h"

// Few and short: what is drawn is on trial here, not how exactly it is timed.
#define MEASURE "measure: {rounds: 10, first_look: 10, budget: 1, batch: 1}\n"
#define SMALL   "base: {width: 64, height: 64, "

static void run_suite(struct answer *answer, const char *name, const char *text,
                      const char *more)
{
    char line[512], file[64];
    snprintf(file, sizeof file, "%s.yaml", name);
    write_file(file, text);
    snprintf(line, sizeof line, "run @/%s -q %s -o @/%s %s", file, platform, name, more);
    run_timed(answer, line);
}

// The line of summary.csv on which these cells stand, `count` column and value pairs.
static int find_line(const struct sb_csv *csv, const char *const *cells, int count)
{
    int found = 0;
    for (int line = 1; line < csv->row_count; line++) {
        bool same = true;
        for (int i = 0; i < count; i += 2)
            same &= strcmp(csv_cell(csv, line, cells[i]), cells[i + 1]) == 0;
        if (same && !found)
            found = line;
    }
    if (!found)
        fail_msg("no line with %s=%s", cells[0], cells[1]);
    return found;
}
#define FIND(csv, ...)                                                                   \
    find_line(csv, (const char *const[]){__VA_ARGS__},                                   \
              (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)))

static double number(const struct sb_csv *csv, int line, const char *column)
{
    return strtod(csv_cell(csv, line, column), NULL);
}

// A row with a time. That it is bound by its fragments, or exact, is not asked for here.
static void check_measured(const struct sb_csv *csv, int line)
{
    const enum sb_status status = sb_status_find(csv_cell(csv, line, "status"));
    if (status == SB_STATUS_COUNT || sb_status_rows[status].exit_code != 0)
        fail_msg("%s: %s: %s", csv_cell(csv, line, "variant"),
                 csv_cell(csv, line, "status"), csv_cell(csv, line, "note"));
    assert_true(number(csv, line, "median_ms") > 0);
    assert_string_equal(csv_cell(csv, line, "nonfinite"), "0");
}

static void same_picture(const struct sb_csv *csv, int a, int b, bool same)
{
    static struct answer answer;
    char line[1024];
    snprintf(line, sizeof line,
             "cmp -- '@/main/images/containers-%s.png' '@/main/images/containers-%s.png' "
             "2>&1",
             csv_cell(csv, a, "variant"), csv_cell(csv, b, "variant"));
    run_shell(&answer, line);
    if (answer.code != (same ? 0 : 1))
        fail_msg("%s%s", line, answer.text);
}

static void the_axes_do_on_a_driver_what_they_say(void **state)
{
    (void)state;
    static struct answer answer;
    char text[1024];
    struct sb_csv csv;
    const bool gles = gl_test_gles();
    snprintf(text, sizeof text,
             "suite: main\n" SMALL "point: 4, spot: 1, dir: 1}\n"
             "sweep:\n"
             "  storage: [uniform, ubo_std140]\n"
             "  stage: vertex\n"
             "  target: [%s%s]\n"
             "  layers: 4\n"
             "  tessellation: 4000\n"
             "  precision: mediump\n"
             "  glsl: [%s]\n" MEASURE,
             caps.colour_half ? "rgba16f" : "rgba8", caps.colour_float ? ", rgba32f" : "",
             gles               ? "100, 300es"
             : caps.glsl >= 450 ? "330, 450"
                                : "330");
    run_suite(&answer, "main", text, "--images");
    if (answer.code != 0)
        fail_msg("%s", answer.text);
    read_csv("main/summary.csv", &csv);
    for (int line = 1; line < csv.row_count; line++)
        check_measured(&csv, line);

    const int uniform = FIND(&csv, "storage", "uniform");
    const int ubo = FIND(&csv, "storage", "ubo_std140");
    const int vertex = FIND(&csv, "stage", "vertex");
    const int layers = FIND(&csv, "layers", "4");
    const int fine = FIND(&csv, "tessellation", "4000");
    same_picture(&csv, uniform, ubo, true);
    same_picture(&csv, uniform, layers, true); // equal depths draw over each other
    same_picture(&csv, uniform, vertex, false);
    same_picture(&csv, uniform, FIND(&csv, "glsl", gles ? "100" : "330"), true);
    assert_string_equal(csv_cell(&csv, uniform, "input_hash"),
                        csv_cell(&csv, vertex, "input_hash"));
    check_close(number(&csv, layers, "fragments"), 4 * number(&csv, uniform, "fragments"),
                0);
    check_close(number(&csv, layers, "vertices"), 4 * number(&csv, uniform, "vertices"),
                0);
    // 64 x 64 pixels hold no more, and the scene fills a part of them.
    assert_true(number(&csv, uniform, "fragments") < 64 * 64);
    assert_true(number(&csv, uniform, "fragments") > 64 * 64 / 4);
    // "As near as its meshes allow": three vertices a triangle.
    check_close(number(&csv, fine, "vertices") / (3 * 4000), 1, 0.25);
    assert_true(number(&csv, fine, "vertices") > number(&csv, uniform, "vertices"));
    sb_csv_free(&csv);
}

// "fp16 but p_uniform fp32, p_output fp32": what a term is said to be is what stands behind its
// name, else what the cell begins with.
static void check_term(const char *cell, const char *term, const char *wanted)
{
    const char *own = strstr(cell, term);
    const char *word = own ? own + strlen(term) + 1 : cell;
    if (strncmp(word, wanted, strlen(wanted)) != 0)
        fail_msg("%s is %s by the probe, and \"%s\" in the row", term, wanted, cell);
}

// What the probe measures is what the row says; no renderer is asked for its name.
static void precision_in_the_rows_is_what_the_probe_measured(void **state)
{
    (void)state;
    static const struct {
        const char *term, *carrier;
    } terms[] = {
        {"p_vector", "arithmetic"}, {"p_sum", "arithmetic"},  {"p_uniform", "uniform"},
        {"p_varying", "varying"},   {"p_sampler", "sampler"}, {"p_output", "output"},
    };
    struct sb_csv csv;
    char line[128];
    size_t i;
    const json_t *reading;
    int checked = 0;
    if (!is_egl())
        skip();
    snprintf(line, sizeof line, "probe %s --json", platform);
    json_t *probe = run_json(line, 0);
    read_csv("main/summary.csv", &csv);
    json_array_foreach(json_object_get(probe, "precision"), i, reading)
    {
        const char *effective = json_string_value(json_object_get(reading, "effective"));
        const char *carrier = json_string_value(json_object_get(reading, "carrier"));
        const char *word = json_string_value(json_object_get(reading, "precision"));
        const char *stage = json_string_value(json_object_get(reading, "stage"));
        // Desktop GLSL takes the qualifiers and ignores them (GLSL 4.60, 4.7).
        if (!gl_test_gles())
            assert_string_equal(effective, "fp32");
        if (strcmp(stage, "fragment") != 0 || strcmp(word, "lowp") == 0)
            continue; // no row asks for lowp
        const int at = FIND(&csv, "precision", word, "stage", "fragment");
        assert_string_equal(csv_cell(&csv, at, "precision_requested"), word);
        for (size_t t = 0; t < sizeof terms / sizeof *terms; t++)
            if (strcmp(terms[t].carrier, carrier) == 0) {
                check_term(csv_cell(&csv, at, "precision_effective"), terms[t].term,
                           effective);
                checked++;
            }
    }
    assert_in_range(checked, 2 * 5, 2 * 6); // the output where there are float targets
    sb_csv_free(&csv);
    json_decref(probe);
}

static void a_timer_that_did_not_pass_is_refused_with_the_reason(void **state)
{
    (void)state;
    char line[256];
    size_t i;
    const json_t *timer;
    json_error_t cause;
    if (!is_egl() || gl_test_gles())
        skip();
    char *text = read_file("main/run.json");
    json_t *run = json_loads(text, 0, &cause);
    const json_t *process = json_array_get(json_object_get(run, "processes"), 0);
    bool tried = false;
    json_array_foreach(json_object_get(process, "timers"), i, timer)
    {
        const char *name = json_string_value(json_object_get(timer, "timer"));
        // Far off, so that another audit says the same.
        const double error = json_number_value(json_object_get(timer, "error"));
        if (tried || !json_is_true(json_object_get(timer, "usable")) || error < 0.5)
            continue;
        tried = true;
        snprintf(line, sizeof line, "run -q %s --set width=64 --timer %s -o @/timer",
                 platform, name);
        check_answer(line, 3, "of the wall time");
    }
    json_decref(run);
    free(text);
    if (!tried)
        skip();
}

// One run: broken vertex lighting, whole fragment lighting, the wall clock, two scenes.
static void a_shader_that_does_not_compile_costs_only_its_rows(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    char line[256];
    snprintf(line, sizeof line, "cp -r '%s/shaders' @/broken", SB_SOURCE_DIR);
    check_shell(line, 0, "");
    check_shell("sed -i 's/Shade shade = shade_surface/nowhere = 1.0; &/' "
                "@/broken/stage/vertex.vert; grep -n nowhere @/broken/stage/vertex.vert",
                0, "11:");
    run_suite(&answer, "scenes",
              "suite: scenes\nscene: [plane, sphere]\n" SMALL
              "dir: 32, point: 32, spot: 32}\n"
              "sweep: {stage: [fragment, vertex]}\n" MEASURE,
              "--timer wall --shaders @/broken");
    if (answer.code != 3)
        fail_msg("exit code %d: %s", answer.code, answer.text);
    check_contains(answer.text, "compile_failed");
    check_contains(answer.text, "stage/vertex.vert:11");
    read_csv("scenes/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 4);
    for (int i = 1; i <= 4; i++) {
        if (strcmp(csv_cell(&csv, i, "stage"), "fragment") == 0) {
            check_measured(&csv, i); // and so no light of the 96 is dead
            continue;
        }
        assert_string_equal(csv_cell(&csv, i, "status"), "compile_failed");
        assert_string_equal(csv_cell(&csv, i, "context"), gl_test_context());
        assert_string_not_equal(csv_cell(&csv, i, "glsl"), "auto");
        check_contains(csv_cell(&csv, i, "note"), "stage/vertex.vert:11");
        check_contains(csv_cell(&csv, i, "note"), "nowhere");
        assert_string_equal(csv_cell(&csv, i, "median_ms"), "");
    }
    sb_csv_free(&csv);

    // By the wall clock there is no GPU time, and none is made up.
    read_csv("scenes/samples.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2 * 10);
    for (int i = 1; i < csv.row_count; i++) {
        assert_string_equal(csv_cell(&csv, i, "timer_source"), "wall");
        assert_string_equal(csv_cell(&csv, i, "gpu_ns"), "");
        assert_true(number(&csv, i, "wall_ns") > 0);
    }
    sb_csv_free(&csv);
}

// Lit per vertex, where so many lights are soon drawn.
static void up_to_256_lights_of_each_type_run_or_name_the_limit(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    if (!is_egl())
        skip();
    run_suite(&answer, "many",
              "suite: many\n" SMALL "stage: vertex}\n"
              "cross: {dir: [0, 256], point: [0, 256], spot: [0, 256],\n"
              "        storage: [uniform, ubo_std140]}\n"
              "exclude: [\"dir=256,point=256,spot=0\", \"dir=256,point=0,spot=256\",\n"
              "          \"dir=0,point=256,spot=256\", \"dir=0,point=0,spot=0\",\n"
              "          \"dir=256,point=256,spot=256,storage=uniform\",\n"
              "          \"storage=ubo_std140,point=0\", "
              "\"storage=ubo_std140,spot=0\"]\n" MEASURE,
              "");
    if (answer.code != 0 && answer.code != 3)
        fail_msg("exit code %d: %s", answer.code, answer.text);
    read_csv("many/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 4);
    FIND(&csv, "dir", "256", "point", "256", "spot", "256", "storage", "ubo_std140");
    for (int i = 1; i <= 4; i++) {
        if (strcmp(csv_cell(&csv, i, "status"), "over_limit") == 0) {
            assert_int_equal(answer.code, 3);
            assert_true(strpbrk(csv_cell(&csv, i, "note"), "0123456789") != NULL);
            continue;
        }
        check_measured(&csv, i);
    }
    sb_csv_free(&csv);
}

// softpipe prints what its compiler made of each shader; llvmpipe prints nothing.
static void what_a_driver_prints_of_its_shaders_stands_in_the_row(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    if (!is_egl())
        skip();
    run_timed(&answer,
              "run -q --context egl --driver softpipe --driver-stats --rounds 5 --set "
              "point=1 --set width=16 --set height=16 -o @/says");
    if (no_timer(&answer))
        skip();
    assert_int_equal(answer.code, 0);
    read_csv("says/summary.csv", &csv);
    check_contains(csv_cell(&csv, 1, "driver_stats"), "FS shader: ");
    check_contains(csv_cell(&csv, 1, "driver_stats"), " inst, ");
    sb_csv_free(&csv);
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_axes_do_on_a_driver_what_they_say),
        cmocka_unit_test(precision_in_the_rows_is_what_the_probe_measured),
        cmocka_unit_test(a_timer_that_did_not_pass_is_refused_with_the_reason),
        cmocka_unit_test(a_shader_that_does_not_compile_costs_only_its_rows),
        cmocka_unit_test(what_a_driver_prints_of_its_shaders_stands_in_the_row),
        cmocka_unit_test(up_to_256_lights_of_each_type_run_or_name_the_limit),
    };
    return end_tests(run_tests(tests));
}
