// Rows and a results folder as what the writers take.
#include "cli_fixture.h"

#include "export/from_results.h"

static const char samples_csv[] =
    "process,round,place,scene,variant,timer_source,batch,gpu_ns,wall_ns,cpu_ns,"
    "submit_ns,flags\n"
    "0,0,0,room,point=2,t,4,400,500,800,1,0\n"
    "0,0,1,room,point=1,t,2,100,500,50,1,0\n"
    "0,1,0,room,point=1,t,2,110,500,50,1,2\n" // absurd: enters no estimate
    "0,1,1,room,point=2,t,4,404,500,,1,0\n"
    "0,1,2,cave,point=1,t,2,999,999,9,1,0\n"   // of no row
    "1,0,0,room,point=1,wall,2,,130,60,1,0\n"; // by the wall clock

static const char record_json[] =
    "{\"shadebench\": \"0.1.0\", \"suite\": \"s\", \"arguments\": [], \"measure\": "
    "{\"seed\": 42.0}, \"caps\": {\"renderer\": \"from caps\"}, \"entries\": [], "
    "\"processes\": [{\"process\": 0, \"complete\": true}, {\"process\": 1, "
    "\"complete\": true, \"written\": \"2026-11-22T01:02:03Z\", \"machine\": {\"cpu\": "
    "\"fast\", \"cpus\": 2, \"kernel\": \"k\", \"load_average\": \"0.52 0.40 0.31 2/345 "
    "6789\"}}]}";

static struct sb_row rows[2];

static struct sb_export_source source_of(const char *dir)
{
    for (int i = 0; i < 2; i++) {
        sb_row_init(&rows[i]);
        rows[i].scene = "room";
        rows[i].variant = i ? "point=2" : "point=1";
        rows[i].status = "ok";
        rows[i].renderer = "gpu";
        rows[i].timer_source = "elapsed";
        rows[i].median_ms = 0.5 * (i + 1);
        rows[i].ci_lo_ms = 0.25;
        rows[i].ci_hi_ms = 2;
        rows[i].cpu_ms = 4;
        rows[i].batch = 8;
        rows[i].rounds = 30;
        rows[i].ratio = 1.5;
        rows[i].max_err = 0.125;
    }
    return (struct sb_export_source){"run", rows, 2, dir};
}

static const char *folder(void)
{
    static struct answer answer;
    static char dir[128];
    snprintf(dir, sizeof dir, "%s/results", test_dir);
    run_shell(&answer, "mkdir -p @/results");
    write_file("results/samples.csv", samples_csv);
    write_file("results/run.json", record_json);
    return dir;
}

static void load(const struct sb_export_source *source, struct sb_exported *exported)
{
    struct sb_error err = {0};
    *exported = (struct sb_exported){0};
    if (!sb_export_from_results(source, exported, &err))
        fail_msg("%s", err.text);
}

static void times_are_in_ns_a_frame(void **state)
{
    (void)state;
    struct sb_exported exported;
    const struct sb_export_source source = source_of(NULL);
    load(&source, &exported);
    const struct sb_export_row *row = &exported.export.row[1];
    assert_int_equal(exported.export.row_count, 2);
    check_close(row->frame_ns.point, 1e6, 1e-6);
    check_close(row->frame_ns.lo, 0.25e6, 1e-6);
    check_close(row->frame_ns.hi, 2e6, 1e-6);
    check_close(row->cpu_ns, 4e6, 1e-6);
    check_close(row->ratio.point, 1.5, 0);
    assert_true(isnan(row->ratio.lo));
    assert_int_equal(row->batch, 8);
    assert_int_equal(row->sample_count, 0);
    assert_null(row->message);
    double error = NAN;
    for (int i = 0; i < row->counter_count; i++)
        if (strcmp(row->counter[i].name, "max_err") == 0)
            error = row->counter[i].value;
    check_close(error, 0.125, 0);
    sb_exported_free(&exported);
}

static void samples_go_to_their_rows_in_the_order_of_measuring(void **state)
{
    (void)state;
    struct sb_exported exported;
    const struct sb_export_source source = source_of(folder());
    load(&source, &exported);
    const struct sb_export_row *row = exported.export.row;
    assert_int_equal(row[0].sample_count, 2);
    check_close(row[0].sample_ns[0], 50, 0);
    check_close(row[0].sample_ns[1], 65, 0);
    check_close(row[0].sample_cpu_ns[1], 30, 0);
    assert_int_equal(row[1].sample_count, 2);
    check_close(row[1].sample_ns[0], 100, 0);
    check_close(row[1].sample_cpu_ns[0], 200, 0);
    check_close(row[1].sample_ns[1], 101, 0);
    assert_true(isnan(row[1].sample_cpu_ns[1]));
    sb_exported_free(&exported);
}

static const char *property(const struct sb_export *export, const char *name)
{
    for (int i = 0; i < export->property_count; i++)
        if (strcmp(export->property[i].name, name) == 0)
            return export->property[i].value;
    fail_msg("no property %s", name);
    return NULL;
}

static void properties_come_from_the_rows_and_from_run_json(void **state)
{
    (void)state;
    struct sb_exported exported;
    struct sb_export_source source = source_of(folder());
    load(&source, &exported);
    assert_string_equal(property(&exported.export, "renderer"), "gpu");
    assert_string_equal(property(&exported.export, "timer"), "elapsed");
    assert_string_equal(property(&exported.export, "cpu"), "fast");
    assert_string_equal(property(&exported.export, "num_cpus"), "2");
    assert_string_equal(property(&exported.export, "load_avg"), "0.52 0.40 0.31");
    assert_string_equal(property(&exported.export, "seed"), "42");
    assert_string_equal(property(&exported.export, "processes"), "2");
    assert_string_equal(property(&exported.export, "date"), "2026-11-22T01:02:03Z");
    assert_null(property(&exported.export, "gl_version"));
    sb_exported_free(&exported);
    rows[0].renderer = rows[1].renderer = NULL; // nothing compiled
    load(&source, &exported);
    assert_string_equal(property(&exported.export, "renderer"), "from caps");
    sb_exported_free(&exported);
}

static void what_is_missing_in_the_folder_leaves_the_rows(void **state)
{
    (void)state;
    static const struct {
        const char *damage, *part;
    } damages[] = {
        {"rm @/results/samples.csv", "samples.csv: No such file"},
        {"rm @/results/run.json", "run.json: No such file"},
        {"echo '[' >@/results/run.json", "run.json:"},
        {"sed -i 3s/,2,100/,two,100/ @/results/samples.csv", "batch"},
    };
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) {
        struct sb_exported exported = {0};
        struct sb_error err = {0};
        const struct sb_export_source source = source_of(folder());
        check_shell(damages[i].damage, 0, "");
        assert_false(sb_export_from_results(&source, &exported, &err));
        check_contains(err.text, damages[i].part);
        assert_int_equal(exported.export.row_count, 2);
        check_close(exported.export.row[0].frame_ns.point, 0.5e6, 1e-6);
        sb_exported_free(&exported);
    }
}

// 0 done, 1 failed, 4, 77 and 130 undecided, anything else not valid: the order of status.def.
static void every_status_has_the_outcome_of_its_exit_code(void **state)
{
    (void)state;
    for (int i = 0; i < SB_STATUS_COUNT; i++) {
        const int code = sb_status_rows[i].exit_code;
        const enum sb_export_outcome wanted = code == 0   ? SB_EXPORT_PASSED
                                              : code == 1 ? SB_EXPORT_FAILED
                                              : code == 2 || code == 3
                                                  ? SB_EXPORT_ERROR
                                                  : SB_EXPORT_SKIPPED;
        assert_int_equal(sb_export_outcome_of((enum sb_status)i), wanted);
    }
    assert_int_equal(sb_export_outcome_of(SB_OK), SB_EXPORT_PASSED);
    assert_int_equal(sb_export_outcome_of(SB_COMPILE_FAILED), SB_EXPORT_ERROR);
    assert_int_equal(sb_export_outcome_of(SB_NOT_MEASURED), SB_EXPORT_SKIPPED);
}

static void a_failed_row_has_its_status_and_its_note_as_details(void **state)
{
    (void)state;
    struct sb_exported exported;
    const struct sb_export_source source = source_of(NULL);
    rows[0].status = "dead_light";
    rows[0].note = "point light 3";
    rows[0].median_ms = NAN;
    load(&source, &exported);
    const struct sb_export_row *row = &exported.export.row[0];
    assert_int_equal(row->outcome, SB_EXPORT_ERROR);
    assert_string_equal(row->status, "dead_light");
    assert_string_equal(row->message, "point light 3");
    check_contains(row->details, "dead_light: a light changes no pixel");
    check_contains(row->details, "\npoint light 3");
    assert_null(exported.export.row[1].details);
    sb_exported_free(&exported);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_are_in_ns_a_frame),
        cmocka_unit_test(samples_go_to_their_rows_in_the_order_of_measuring),
        cmocka_unit_test(properties_come_from_the_rows_and_from_run_json),
        cmocka_unit_test(what_is_missing_in_the_folder_leaves_the_rows),
        cmocka_unit_test(every_status_has_the_outcome_of_its_exit_code),
        cmocka_unit_test(a_failed_row_has_its_status_and_its_note_as_details),
    };
    return end_tests(run_tests(tests));
}
