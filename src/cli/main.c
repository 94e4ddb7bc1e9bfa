// shadebench: the command line. One file a subcommand; this one picks it.
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "base/words.h"
#include "cli/common.h"

// clang-format off
const struct sb_command sb_commands[] = {
    {"probe", "", "what this driver is, which of its timers tells the truth, what mediump does",
     "Opens a context, proves its timers against the wall clock and probes its precision\nqualifiers. Exit code 3: no timer is credible.", 1, sb_cmd_probe},
    {"list", "[WHAT]", "suites, presets, scenes, axes, cases, contexts, columns, settings, statuses",
     "Without a word: the suites and what else can be listed.", 2, sb_cmd_list},
    {"show", "VARIANT | SUITE | --effects SCENE", "the final GLSL of a variant (point=4,stage=vertex), the plan of a suite, or what a scene calls for",
     "A variant is AXIS=VALUE,…, after the name of a preset where it has one; `default` is the\nvariant of all defaults. Needs no GL.", 4, sb_cmd_show},
    {"run", "[SUITE]", "measure a suite, or what --set and --sweep ask for",
     "SUITE is the name of a shipped suite (shadebench list suites) or a YAML file. Without\nSUITE, --set and --sweep say what to run. Exit codes: 0 done, 1 --check missed,\n2 input, 3 a row is not valid, 4 --fail-on-inconclusive, 77 no GL here, 130 interrupted.", 8, sb_cmd_run},
    {"gate", "[SUITE] --base SHADERS", "is head slower than base, or wrong? two shader folders, variants or environments, side by side",
     "Draws and times every variant of SUITE (ci, where none is given) on both sides, base and head in\nturns, pictures first. Exit codes: 0 no confirmed regression, 1 a regression or a worse picture,\n3 head is not valid, 4 with --fail-on-inconclusive, 77 no GL here (docs/ci.md).", 512, sb_cmd_gate},
    {"history", "add [SUITE] | show", "what variants cost over many commits, relative to an anchor that never changes: the creep no gate sees",
     "add measures every variant of SUITE (ci, where none is given) against the anchor, a frozen program,\nand appends a row each to --file. show tells the levels of each series, where they change, and how\nfar it has crept. Exit codes: 0 done, 1 show --check found a creep, 2 input, 3 a variant is not\nvalid, 77 no GL here (docs/history.md).", 1024, sb_cmd_history},
    {"compare", "A B | --pareto | --terms | --policies | --ablation RESULTS", "two runs, row by row; which rows of a run are beaten in time and error; what terms, policies and effects cost",
     "RESULTS, A and B are results folders or their summary.csv. Nothing is measured, no driver is\nopened. A B: the frame times of B over those of A; rows of other drivers, timers, sizes or inputs\nare refused. Exit codes: 0 done, 1 --check and a row became worse, 2 nothing to compare.\n--pareto: a row is dominated by another of the same scene axes, target and platform whose time\ninterval lies wholly below and which is no worse in any error.", 32, sb_cmd_compare},
    {"fit", "RESULTS", "what the next light of each type costs, how many fit in a frame, and which stage is faster from where on",
     "RESULTS is a results folder or its summary.csv; shadebench run fit measures such. Nothing is\nmeasured, no driver is opened. Mixes of types that the run holds are predicted, not fitted, and\nthe errors printed (docs/fit.md).", 128, sb_cmd_fit},
    {"verify", "[CASE...] | --classes [SUITE]", "do the hard cases hold here? do variants that differ only in how they do it draw the same picture?",
     "Asks the formulas of the shaders, naive and robust, at inputs at which lighting goes wrong, and\nholds what comes back against double precision. CASE is a case or a family (shadebench list\ncases); without one, all. Exit code 1: a robust form does not hold, or the search has found\nsomething.\nWith --classes: draws every variant of SUITE (classes, where none is given) and compares it\nwith the first of its equivalence class: same scene, equal on all but implementation axes. Exit\ncode 3: two pictures differ that must not, or a variant cannot be drawn.", 16, sb_cmd_verify},
    {"explain", "VARIANT --pixel X,Y", "everything that was computed on the way to one pixel",
     "Prints at full precision what the driver interpolated there, the material and the lights as\nuploaded, and each term of each light: in double from the same inputs, as the driver had\nit, and how many units in the last place they are apart. VARIANT is an id, as tables and\nsummary.csv print it.", 64, sb_cmd_explain},
    {"plan", "[SUITE...] --costs RESULTS", "which few programs serve many light counts best",
     "Demands are the light counts of the entries of each SUITE, or lines of --demands. Costs come\nfrom a run; nothing is measured, no driver is opened, and nothing beyond what was measured\nis made up (docs/plan.md).", 256, sb_cmd_plan},
};
// clang-format on
const int sb_command_count = sizeof sb_commands / sizeof *sb_commands;

static bool is_suite(const char *word)
{
    struct sb_error ignored;
    struct sb_arena arena = {0};
    const char *data = sb_data_dir(&arena, NULL, &ignored);
    const char *path = data ? sb_cli_suite_path(word, data, &arena, &ignored) : NULL;
    const bool found = path && sb_file_exists(path);
    sb_arena_free(&arena);
    return found;
}

static const struct sb_command *find_command(const char *word, struct sb_error *err)
{
    const char *names[16];
    for (int i = 0; i < sb_command_count; i++) {
        if (strcmp(sb_commands[i].name, word) == 0)
            return &sb_commands[i];
        names[i] = sb_commands[i].name;
    }
    if (is_suite(word))
        sb_fail(err, SB_USAGE, "\"%s\" is a suite: shadebench run %s", word, word);
    else
        sb_fail_unknown(err, "", "command", word, names, sb_command_count);
    return NULL;
}

// A standard descriptor that is closed would be the number of the first file opened, and the
// table would go into samples.csv. Writing to this one fails.
static void claim_descriptors(void)
{
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd ? O_RDONLY : O_WRONLY) != fd)
            return;
}

static int run_command(const struct sb_command *command, int argc, char **argv)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_options options = {0};
    int code;
    if (!sb_options_parse(command, argc - 2, argv + 2, &options, &arena, &err)) {
        code = sb_cli_fail(&err);
    } else if (options.help) {
        sb_options_help(command);
        code = 0;
    } else {
        code = command->run(&options, argc, argv);
    }
    sb_arena_free(&arena);
    return code;
}

static int run_word(int argc, char **argv)
{
    struct sb_error err = {0};
    const char *word = argc > 1 ? argv[1] : "--help";
    const bool help = strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
                      strcmp(word, "help") == 0;
    if (strcmp(word, "--version") == 0) {
        printf("shadebench %s\n", SB_VERSION);
        return 0;
    }
    const struct sb_command *command = NULL;
    if ((!help || argc > 2) && !(command = find_command(argv[1 + help], &err)))
        return sb_cli_fail(&err);
    if (!help)
        return run_command(command, argc, argv);
    sb_options_help(command);
    return argc > 1 ? 0 : sb_status_rows[SB_USAGE].exit_code;
}

// git bisect run takes codes up to 127 for "bad", which a word that is not understood is not: 128
// ends the bisection. The gate itself ends with no usage code there (cli/gate.c).
static int bisect_code(int argc, char **argv, int code)
{
    if (code == sb_status_rows[SB_USAGE].exit_code)
        for (int i = 1; i < argc; i++)
            if (strcmp(argv[i], "--bisect") == 0)
                return SB_EXIT_STOP_BISECTION;
    return code;
}

int main(int argc, char **argv)
{
    claim_descriptors();
    signal(SIGPIPE, SIG_IGN); // a reader that leaves, as head does, ends no measurement
    const int code = bisect_code(argc, argv, run_word(argc, argv));
    // A closed stdout, or a full disk behind it, is no success.
    const bool printed = fflush(stdout) == 0 && !ferror(stdout);
    if (!printed)
        sb_warn("stdout cannot be written; what was to be shown is lost");
    return printed ? code
                   : sb_exit_code_worse(code, sb_status_rows[SB_WRITE_FAILED].exit_code);
}
