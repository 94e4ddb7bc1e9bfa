// Drivers that crash, hang or babble, programs that are killed, disks that fill up and pipes that
// close: the rest is measured, what is on disk is whole, and whoever reads it is told.
#include "cli_running.h"

#include <time.h>

#define WORKER                                                                           \
    "--context null -q --worker 'exec " SB_FAULTY_WORKER "' --worker-limit $LIMIT "
// Jobs of a gate are base 1, head 2, base 3, head 4 …; of a run 1, 2, 3.
#define GATE                                                                             \
    "gate " WORKER "--sweep point=1,2,4 --keep-equal --base " SB_SOURCE_DIR "/shaders "
#define RUN                                                                              \
    "run " WORKER "--sweep point=1,2,4 --rounds 20 --first-look 10 --half-width 0.5 "

static struct running it;

static void clear_faults(void)
{
    unsetenv("FAULT");
    unsetenv("ONCE");
    unsetenv("AFTER");
    setenv("LIMIT", "60", 1);
}

static bool is_waited_for(const char *what)
{
    return strcmp(what, "hang") == 0 || strcmp(what, "stop") == 0;
}

static void set_fault(const char *what, const char *where)
{
    char fault[64];
    clear_faults();
    snprintf(fault, sizeof fault, "%s@%s", what, where);
    setenv("FAULT", fault, 1);
    // Who hangs is waited for; who does not may take its time on a busy machine.
    setenv("LIMIT", is_waited_for(what) ? "2" : "60", 1);
}

// A folder of its own for each answer.
static const char *next_folder(void)
{
    static int number;
    static char name[32];
    snprintf(name, sizeof name, "f%d", ++number);
    return name;
}

static struct sb_csv csv;
static const char *run_faulty(const char *command, int code, const char *part,
                              const char *file)
{
    static char name[32], path[64], line[1024];
    snprintf(name, sizeof name, "%s", next_folder());
    snprintf(line, sizeof line, "%s-o @/%s", command, name);
    check_answer(line, code, part);
    snprintf(path, sizeof path, "%s/%s", name, file);
    read_csv(path, &csv);
    return name;
}

static void check_cell(int line, const char *column, const char *value)
{
    if (strcmp(csv_cell(&csv, line, column), value) != 0)
        fail_msg("line %d: %s is %s, not %s; %s", line, column,
                 csv_cell(&csv, line, column), value, csv_cell(&csv, line, "note"));
}

static const struct {
    const char *what, *status, *note;
} faults[] = {
    {"segv", "worker_crashed", "was killed by SIGSEGV"},
    {"abort", "worker_crashed", "was killed by SIGABRT"},
    {"exit", "worker_crashed", "ended with exit code 7"},
    {"hang", "worker_hung", "did not answer within 2 s"},
    {"stop", "worker_hung", "did not answer within 2 s"},
    {"garbage", "worker_garbage", "begins no message"},
};
enum { FAULTS = sizeof faults / sizeof *faults };

// --- workers ---------------------------------------------------------------------------------

static void a_variant_that_takes_workers_down_is_invalid_and_the_others_pass(void **state)
{
    (void)state;
    static const char *const wheres[] = {"round:4", "prepare:4", "image:4"};
    for (int i = 0; i < FAULTS; i++)
        for (int w = 0; w < 3; w++) {
            if (is_waited_for(faults[i].what) && w != i % 2)
                continue;
            set_fault(faults[i].what, wheres[w]);
            run_faulty(GATE, 3, "2 pass", "gate.csv");
            check_cell(2, "verdict", "invalid");
            check_cell(2, "status", faults[i].status);
            check_cell(2, "status_of", "head");
            check_contains(csv_cell(&csv, 2, "note"), faults[i].note);
            check_cell(1, "verdict", "pass");
            check_cell(3, "verdict", "pass");
            sb_csv_free(&csv);
        }
    clear_faults();
}

static void a_row_of_a_run_that_takes_workers_down_fails_alone(void **state)
{
    (void)state;
    static const char *const wheres[] = {"round:2", "prepare:2", "image:2"};
    for (int i = 0; i < FAULTS; i++)
        for (int w = 0; w < 3; w++) {
            if (is_waited_for(faults[i].what) && w != i % 2)
                continue;
            set_fault(faults[i].what, wheres[w]);
            run_faulty(RUN, 3, faults[i].status, "summary.csv");
            check_cell(2, "status", faults[i].status);
            check_contains(csv_cell(&csv, 2, "note"), faults[i].note);
            check_cell(1, "status", "ok");
            check_cell(3, "status", "ok");
            check_cell(3, "rounds", "20");
            sb_csv_free(&csv);
        }
    clear_faults();
}

static void a_fault_of_base_is_base_s(void **state)
{
    (void)state;
    set_fault("segv", "round:3");
    run_faulty(GATE, 0, "base: worker_crashed", "gate.csv");
    check_cell(2, "verdict", "invalid");
    check_cell(2, "status_of", "base");
    sb_csv_free(&csv);
    clear_faults();
}

// Once is bad luck: the round is lost, and is in the file as such.
static void a_worker_that_is_lost_once_costs_a_round(void **state)
{
    (void)state;
    char once[96];
    snprintf(once, sizeof once, "%s/once", test_dir);
    set_fault("segv", "round");
    setenv("ONCE", once, 1);
    setenv("AFTER", "150", 1);
    const char *name = run_faulty(GATE, 0, "3 pass", "gate.csv");
    char path[64];
    int lost = 0;
    snprintf(path, sizeof path, "%s/pairs.csv", name);
    sb_csv_free(&csv);
    read_csv(path, &csv);
    for (int i = 1; i < csv.row_count; i++) {
        const bool flagged = strcmp(csv_cell(&csv, i, "base_flags"), "4") == 0;
        assert_int_equal(flagged, csv_cell(&csv, i, "base")[0] == '\0');
        lost += flagged;
    }
    assert_int_equal(lost, 1);
    sb_csv_free(&csv);
    clear_faults();
}

static void a_variant_that_is_lost_in_the_midst_of_its_rounds_keeps_its_pairs(
    void **state)
{
    (void)state;
    set_fault("segv", "round:4");
    setenv("AFTER", "18", 1); // more than making ready takes
    run_faulty(GATE "--tolerance 0% ", 3, "head: worker_crashed", "gate.csv");
    check_cell(2, "verdict", "invalid");
    const int pairs = atoi(csv_cell(&csv, 2, "pairs"));
    assert_in_range(pairs, 1, 60);
    assert_true(atof(csv_cell(&csv, 2, "ratio")) > 0.9);
    check_cell(1, "pairs", "240"); // the others go on
    sb_csv_free(&csv);
    set_fault("segv", "round:3"); // of base
    setenv("AFTER", "18", 1);
    run_faulty(GATE "--tolerance 0% ", 0, "base: worker_crashed", "gate.csv");
    check_cell(2, "status_of", "base");
    assert_true(atoi(csv_cell(&csv, 2, "pairs")) > 0);
    sb_csv_free(&csv);
    clear_faults();
}

static void a_driver_that_does_not_open_ends_either_command_in_one_line(void **state)
{
    (void)state;
    static struct answer answer;
    static const char *const commands[] = {GATE, RUN};
    for (int i = 0; i < FAULTS; i++)
        for (int c = 0; c < 2; c++) {
            char line[1024];
            set_fault(faults[i].what, "open");
            snprintf(line, sizeof line, "%s-o @/%s", commands[c], next_folder());
            run_program(&answer, line);
            assert_int_equal(answer.code, 3);
            check_contains(answer.text, "opening the context: the worker ");
            check_contains(answer.text, faults[i].note);
            assert_int_equal(count_lines(answer.text), 1);
        }
    clear_faults();
}

// With two environments a fault of one side's worker is that side's.
static void an_environment_that_crashes_the_driver_is_told_with_its_side(void **state)
{
    (void)state;
    clear_faults();
    setenv("SIDE", "FAULT=segv@round:2", 1);
    run_faulty("gate " WORKER "--sweep point=1,2 --base-env A=1 --head-env "
               "$SIDE ",
               3, "1 pass", "gate.csv");
    check_cell(1, "status_of", "head");
    check_cell(2, "verdict", "pass");
    sb_csv_free(&csv);
    setenv("SIDE", "FAULT=segv@round:1", 1);
    run_faulty("gate " WORKER "--sweep point=1,2 --head-env A=1 --base-env "
               "$SIDE ",
               0, "base: worker_crashed", "gate.csv");
    check_cell(1, "status_of", "base");
    sb_csv_free(&csv);
}

// --- kill -9 ---------------------------------------------------------------------------------

// Gone, or a zombie that nobody has asked after.
static bool is_gone(int pid)
{
    char path[64], text[256] = "";
    snprintf(path, sizeof path, "/proc/%d/stat", pid);
    FILE *file = fopen(path, "r");
    if (!file)
        return true;
    const char *line = fgets(text, sizeof text, file);
    fclose(file);
    const char *state = line ? strrchr(text, ')') : NULL;
    return !state || state[2] == 'Z' || state[2] == 'X';
}

static void check_workers_gone(void)
{
    char *text = read_file("pids");
    int count = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"), count++)
        for (int tries = 0; !is_gone(atoi(line)); tries++) {
            if (tries == 2000)
                fail_msg("worker %s has outlived its parent", line);
            nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        }
    assert_true(count >= 1);
    free(text);
    unlink("pids");
}

// Starts a command whose worker hangs after some rounds, and kills it there.
static void kill_amid_rounds(const char *command, const char *folder)
{
    static char line[1024];
    char path[256];
    snprintf(line, sizeof line,
             "%s--worker 'echo $$ >>@/pids; exec env $HANG " SB_FAULTY_WORKER "' -o @/%s",
             command, folder);
    setenv("HANG", "FAULT=hang@round AFTER=150", 1); // an @ in a line is a folder
    start_program(&it, line);
    // The hang is reached when the file has grown to what 150 batches leave.
    snprintf(path, sizeof path, "%s/%s/%s", test_dir, folder,
             strncmp(command, "gate", 4) == 0 ? "pairs.csv" : "samples.csv");
    for (long before = -1, now = 0, still = 0; still < 20;
         still = now == before && now > 2000 ? still + 1 : 0) {
        FILE *file = fopen(path, "r");
        before = now;
        if (file) {
            fseek(file, 0, SEEK_END);
            now = ftell(file);
            fclose(file);
        }
        nanosleep(&(struct timespec){.tv_nsec = 25000000}, NULL);
    }
    kill(it.pid, SIGKILL);
    const int code = finish(&it);
    if (code != 128 + SIGKILL)
        fail_msg("it was not killed, exit code %d: %s", code, it.text);
    check_workers_gone();
}

static void a_killed_gate_leaves_its_pairs_and_says_that_it_is_incomplete(void **state)
{
    (void)state;
    kill_amid_rounds(
        "gate --context null --sweep point=1,2,4 --keep-equal --tolerance 0% "
        "--base " SB_SOURCE_DIR "/shaders ",
        "killed-gate");
    read_csv("killed-gate/pairs.csv", &csv); // which no half line would let it
    assert_true(csv.row_count > 30);
    sb_csv_free(&csv);
    check_shell("grep complete @/killed-gate/gate.json", 0, "\"complete\": false");
    check_answer("compare --pareto @/killed-gate", 2, "the gate there is incomplete");
    check_answer("fit @/killed-gate", 2, "whose rows are in gate.csv");
    check_answer(GATE "-o @/killed-gate", 2, "the gate there is incomplete");
    check_answer(GATE "-o @/killed-gate", 2, "pairs.csv exists; name another folder");
}

static void a_killed_run_is_told_by_every_command_that_reads_it(void **state)
{
    (void)state;
    kill_amid_rounds("run --context null --sweep point=1,2,4 --rounds 1000000 "
                     "--half-width 0.0001 --budget 1000 ",
                     "killed-run");
    read_csv("killed-run/samples.csv", &csv);
    assert_true(csv.row_count > 30);
    assert_int_equal((csv.row_count - 1) % 3, 0);
    sb_csv_free(&csv);
    assert_false(run_is_complete("killed-run/run.json"));
    static const char *const readers[] = {
        "compare @/killed-run @/killed-run",
        "compare @/killed-run/summary.csv @/killed-run", "compare --pareto @/killed-run",
        "fit @/killed-run", "plan ci --costs @/killed-run"};
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        static struct answer answer;
        run_program(&answer, readers[i]);
        check_contains(
            answer.text,
            "killed-run: the run is incomplete: its process 1 was stopped, and "
            "the rows hold what was measured until then; go on with: shadebench "
            "run --resume ");
    }
    // By another worker: the one that it was started with would hang again.
    check_answer(
        "run --resume @/killed-run --worker " SB_FAULTY_WORKER
        " --half-width 0.5 --first-look 200",
        0, "process 1 of this run was stopped; a fresh one measures what it lacked");
    // Gone on with, it is complete, and nobody says otherwise.
    static struct answer answer;
    run_program(&answer, "compare --pareto @/killed-run");
    assert_null(strstr(answer.text, "incomplete"));
}

static void a_run_that_lacks_processes_is_told(void **state)
{
    (void)state;
    check_answer("run --context null -q --set point=1 --rounds 20 --first-look 10 "
                 "--processes 1 -o @/lacks",
                 0, "");
    check_shell("sed -i 's/\"processes\": 1.0/\"processes\": 3.0/' @/lacks/run.json", 0,
                "");
    check_answer("compare @/lacks @/lacks", 0,
                 "the run is incomplete: 1 of 3 processes were measured; go on with: "
                 "shadebench run --resume ");
}

// --- disks and pipes -------------------------------------------------------------------------

static void a_full_disk_keeps_the_pairs_and_shows_the_table(void **state)
{
    (void)state;
    static struct answer answer;
    clear_faults();
    run_shell(&answer,
              "{ trap '' XFSZ; ulimit -f 14; exec $SB gate --context null -q "
              "--sweep point=1,2,4 --keep-equal --tolerance 0% --base " SB_SOURCE_DIR
              "/shaders -o @/full; } 2>@/said");
    assert_int_equal(answer.code, 3);
    check_contains(answer.text, "3 inconclusive");
    char *said = read_file("said");
    assert_int_equal(count_lines(said), 1);
    check_contains(said,
                   "full/pairs.csv: File too large; the rows written before are whole");
    free(said);
    read_csv("full/pairs.csv", &csv);
    assert_true(csv.row_count > 30);
    assert_int_equal((csv.row_count - 1) % 3, 0);
    sb_csv_free(&csv);
    check_answer("compare --pareto @/full", 2, "the gate there is incomplete");
}

static void output_that_is_lost_is_no_success_and_loses_no_file(void **state)
{
    (void)state;
    clear_faults();
    check_shell("exec $SB " GATE "-o @/lost1 2>&1 >&-", 3, "stdout");
    check_shell("exec $SB " GATE "-o @/lost2 --json 2>&1 >/dev/full", 3, "stdout");
    check_shell("exec $SB " GATE "-o @/lost3 --write junit=- 2>&1 >/dev/full", 3,
                "standard output");
    check_shell("exec $SB " GATE "-o @/lost4 --write junit=/dev/full 2>&1", 3, "3 pass");
    check_shell("{ $SB " GATE "-o @/lost5; echo $? >@/code; } | true; cat @/code", 0, "");
    for (int i = 1; i <= 5; i++) {
        char path[32];
        snprintf(path, sizeof path, "lost%d/gate.csv", i);
        read_csv(path, &csv);
        check_cell(3, "verdict", "pass");
        sb_csv_free(&csv);
    }
    char *code = read_file("code");
    assert_string_not_equal(code, "0\n");
    free(code);
}

static void a_gate_that_is_interrupted_ends_with_130(void **state)
{
    (void)state;
    start_program(&it, "gate --context null --sweep point=1..60 --keep-equal --tolerance "
                       "0% --base " SB_SOURCE_DIR "/shaders -o @/stopped --write "
                       "junit=@/stopped.xml");
    wait_until_said(&it, "pair 20 of each");
    kill(it.pid, SIGINT);
    assert_int_equal(finish(&it), 130);
    check_contains(it.text, "interrupted: what is not judged is inconclusive");
    char *junit = read_file("stopped.xml");
    check_contains(junit, "failures=\"0\" errors=\"0\"");
    check_contains(junit, "<skipped message=\"inconclusive");
    free(junit);
    start_program(
        &it, "gate --context null --sweep point=1..60 --keep-equal --base " SB_SOURCE_DIR
             "/shaders -o @/early");
    wait_until_said(&it, "compiling variant 3 of 60");
    kill(it.pid, SIGTERM);
    assert_int_equal(finish(&it), 130);
    check_contains(it.text, "60 inconclusive");
}

int main(void)
{
    begin_tests();
    clear_faults();
    unsetenv("GITHUB_STEP_SUMMARY");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            a_variant_that_takes_workers_down_is_invalid_and_the_others_pass),
        cmocka_unit_test(a_row_of_a_run_that_takes_workers_down_fails_alone),
        cmocka_unit_test(a_fault_of_base_is_base_s),
        cmocka_unit_test(a_worker_that_is_lost_once_costs_a_round),
        cmocka_unit_test(
            a_variant_that_is_lost_in_the_midst_of_its_rounds_keeps_its_pairs),
        cmocka_unit_test(a_driver_that_does_not_open_ends_either_command_in_one_line),
        cmocka_unit_test(an_environment_that_crashes_the_driver_is_told_with_its_side),
        cmocka_unit_test(a_killed_gate_leaves_its_pairs_and_says_that_it_is_incomplete),
        cmocka_unit_test(a_killed_run_is_told_by_every_command_that_reads_it),
        cmocka_unit_test(a_run_that_lacks_processes_is_told),
        cmocka_unit_test(a_full_disk_keeps_the_pairs_and_shows_the_table),
        cmocka_unit_test(output_that_is_lost_is_no_success_and_loses_no_file),
        cmocka_unit_test(a_gate_that_is_interrupted_ends_with_130),
    };
    return end_tests(run_tests(tests));
}
