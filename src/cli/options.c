#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "base/words.h"
#include "cli/common.h"
#include "cli/write.h"

enum {
    PROBE = 1,
    LIST = 2,
    SHOW = 4,
    RUN = 8,
    VERIFY = 16,
    COMPARE = 32,
    EXPLAIN = 64,
    FIT = 128,
    PLANNER = 256,
    GATE = 512,
    HISTORY = 1024,
    ALL = 2047
};
enum {
    PLAN = RUN | SHOW | VERIFY | EXPLAIN | GATE | HISTORY
};                                       // commands that take variants
enum { MEASURE = RUN | GATE | HISTORY }; // those that take measure settings
enum {
    WORKERS = RUN | PROBE | EXPLAIN | GATE | HISTORY
};                                                 // those that may draw by a worker
enum { OFFLINE = LIST | COMPARE | FIT | PLANNER }; // those that are of no platform

enum option_type { FLAG, TEXT, ASSIGNMENT, OUTPUT };

struct option {
    const char *name;
    char letter;
    const char *argument; // NULL: a flag
    unsigned commands;
    enum option_type type;
    size_t offset;
    const char *help;
};

#define AT(field) offsetof(struct sb_options, field)
// clang-format off
static const struct option options_table[] = {
    {"set",      0,   "AXIS=VALUE", PLAN,             ASSIGNMENT, AT(set),      "give one axis a value, over the suite's; may be repeated"},
    {"sweep",    0,   "AXIS=LIST",  PLAN,             ASSIGNMENT, AT(sweep),    "vary one axis, the others at their base: 1,2,4 or 0..32 step 4 or 1..64 x2"},
    {"cross",    0,   "AXIS=LIST",  PLAN,             ASSIGNMENT, AT(cross),    "multiply all variants by these values"},
    {"scene",    0,   "NAME",       PLAN,             TEXT,       AT(scene),    "the scene to draw (shadebench list scenes)"},
    {"preset",   0,   "NAME,…",     PLAN,             TEXT,       AT(preset),   "start from a preset, or from several side by side (shadebench list presets)"},
    {"output",   'o', "DIR",        RUN|VERIFY|GATE,  TEXT,       AT(output),   "results folder; default: shadebench-results/SUITE-DATE, gate-DATE or verify-DATE"},
    {"resume",   0,   "DIR",        RUN,              TEXT,       AT(resume),   "go on with an interrupted run, or with its next process, on all its platforms"},
    {"images",   0,   NULL,         RUN,              FLAG,       AT(images),   "write a PNG of each variant, of its shadow maps, and a contact sheet"},
    {"payback",  0,   NULL,         RUN,              FLAG,       AT(payback),  "policies: draw, too, the frames after which each has paid for its programs"},
    {"ablate",   0,   NULL,         RUN,              FLAG,       AT(ablate),   "leave out each effect of each variant alone: what it costs, and who would see it go"},
    {"dump",     0,   "DIR",        RUN,              TEXT,       AT(dump),     "write the float picture, ids and scene of each variant (docs/formats.md)"},
    {"program-cache", 0, "DIR",    RUN,              TEXT,       AT(program_cache), "keep program binaries there and load them: compile times are then not those of a compiler"},
    {"check",    0,   NULL,         RUN,              FLAG,       AT(check),    "judge the suite's `expect:`; exit code 1: something is missed (docs/formats.md)"},
    {"fail-on-inconclusive", 0, NULL, RUN,            FLAG,       AT(fail_on_inconclusive), "--check: exit code 4 where a time's interval lies across its budget"},
    {"classes",  0,   NULL,         VERIFY,           FLAG,       AT(classes),  "not cases: compare the pictures of each equivalence class"},
    {"form",     0,   "NAME,…",     VERIFY,           TEXT,       AT(form),     "cases: naive, robust; default: both"},
    {"precision",0,   "NAME,…",     VERIFY,           TEXT,       AT(precision),"cases: highp, mediump, fp16, fixed10; default: highp, fixed10 and mediump, or fp16 where mediump is not half precision here"},
    {"all",      0,   NULL,         VERIFY,           FLAG,       AT(all),      "cases: every precision, emulated ones besides the real one"},
    {"breaking", 0,   NULL,         VERIFY,           FLAG,       AT(breaking), "cases: how far each that scales holds"},
    {"time",     0,   NULL,         VERIFY,           FLAG,       AT(time),     "cases: what each guard costs here, timed"},
    {"search",   0,   "SECONDS",    VERIFY,           TEXT,       AT(search),   "look for hard cases that nobody has written down"},
    {"seed",     0,   "N",          VERIFY,           TEXT,       AT(seed),     "of the search, and of the order of timed rounds [1]"},
    {"write",    0,   "FORMAT=FILE", RUN|GATE,        OUTPUT,     AT(write),    "write the results for another program, too (shadebench list formats); FILE -: to stdout, instead of the table; may be repeated"},
    {"pareto",   0,   NULL,         COMPARE,          FLAG,       AT(pareto),   "rank the rows of a run over time and error: the front, and what is dominated"},
    {"terms",    0,   NULL,         COMPARE,          FLAG,       AT(terms),    "the price of each term's precision, from a run of the suite terms"},
    {"policies", 0,   NULL,         COMPARE,          FLAG,       AT(policies), "what each policy (axis specialise) saves against the program for all scenes"},
    {"ablation", 0,   NULL,         COMPARE,          FLAG,       AT(ablation), "what each effect costs, and who would see it go, from a run --ablate"},
    {"tolerance",0,   "SHARE",      COMPARE,          TEXT,       AT(tolerance),"two runs: what is no change, as 2% or 0.02 [2%]"},
    {"force",    0,   NULL,         COMPARE,          FLAG,       AT(force),    "two runs: compare, and mark, rows of other conditions, too"},
    {"check",    0,   NULL,         COMPARE,          FLAG,       AT(check),    "two runs: exit code 1 where a row is hurt or gone, or its error or status became worse"},
    {"ms",       0,   "N,…",        FIT,              TEXT,       AT(ms),       "frame times in which lights are to fit; default: powers of two among those measured"},
    {"programs", 0,   "K",          PLANNER,          TEXT,       AT(programs), "so many programs at most [8]"},
    {"demands",  0,   "FILE",       PLANNER,          TEXT,       AT(demands),  "CSV of demands: dir,point,spot,area,weight"},
    {"costs",    0,   "RESULTS",    PLANNER,          TEXT,       AT(costs),    "a run with light counts in several loops: shadebench run plan"},
    {"exhaustive",0,  NULL,         PLANNER,          FLAG,       AT(exhaustive),"try all choices, too, where they are few enough"},
    {"validate", 0,   NULL,         SHOW,             FLAG,       AT(validate), "check the sources with glslangValidator"},
    {"effects",  0,   NULL,         SHOW,             FLAG,       AT(effects),  "not sources: what each draw of the scene calls for, and why the rest is left out"},
    {"base",     0,   "SHADERS",    GATE,             TEXT,       AT(base),     "what is held against: a shader folder, or a git revision of head's"},
    {"head",     0,   "SHADERS",    GATE,             TEXT,       AT(head),     "what is judged, likewise; default: the shaders of this program, or --shaders"},
    {"base-set", 0,   "AXIS=VALUE", GATE,             ASSIGNMENT, AT(base_set), "two variants: give base's side of the plan a value; may be repeated"},
    {"head-set", 0,   "AXIS=VALUE", GATE,             ASSIGNMENT, AT(head_set), "and head's"},
    {"base-env", 0,   "NAME=VALUE", GATE,             ASSIGNMENT, AT(base_env), "two environments: set a variable for base's process; may be repeated"},
    {"head-env", 0,   "NAME=VALUE", GATE,             ASSIGNMENT, AT(head_env), "and for head's"},
    {"tolerance",0,   "SHARE",      GATE,             TEXT,       AT(tolerance),"what head may cost more, as 2% or 0.02 [2%; of instructions 0.5%]"},
    {"metric",   0,   "NAME",       GATE|HISTORY,     TEXT,       AT(metric),   "what is measured (shadebench list metrics); default: cpu where a CPU draws, else gpu"},
    {"selftest", 0,   NULL,         GATE,             FLAG,       AT(selftest), "hold base against itself, renamed: how much does this machine favour one of two equal programs? Exit code 3: more than half the tolerance"},
    {"keep-equal", 0, NULL,         GATE,             FLAG,       AT(keep_equal), "time variants whose final sources are equal, too: a gate that must not alarm"},
    {"cases",    0,   "all|CASE,…", GATE,             TEXT,       AT(cases),    "verify hard cases, or families of them, on both sides, too: exit code 1 where one that base passes fails"},
    {"fail-on-inconclusive", 0, NULL, GATE,           FLAG,       AT(fail_on_inconclusive), "exit code 4 where a variant is neither clearly slower nor clearly not"},
    {"bisect",   0,   NULL,         GATE,             FLAG,       AT(bisect),   "exit codes for git bisect run: 125, skip, in place of 3, 4 and 77; 128, stop, where the command itself is wrong"},
    {"file",     0,   "FILE",       HISTORY,          TEXT,       AT(file),     "the history [shadebench-history.csv]"},
    {"commit",   0,   "ID",         HISTORY,          TEXT,       AT(commit),   "add: what is measured; default: HEAD of the git repository that the shaders lie in"},
    {"date",     0,   "DATE",       HISTORY,          TEXT,       AT(date),     "add: of the commit, as git writes it, such as 2026-11-22T03:02:03+02:00; default: now"},
    {"pairs",    0,   "N",          HISTORY,          TEXT,       AT(pairs),    "add: pairs of batches of each variant and the anchor in each process [60]"},
    {"variant",  0,   "GLOB",       HISTORY,          TEXT,       AT(variant),  "show: variants, or SCENE/VARIANT, that match; default: all"},
    {"tolerance",0,   "SHARE",      HISTORY,          TEXT,       AT(tolerance),"show: what is no change of level, as 2% or 0.02 [2%]"},
    {"wide",     0,   NULL,         HISTORY,          FLAG,       AT(wide),     "show: CSV with a column a variant, time,commit,…, as Otava reads it, of the rows that go with the last one"},
    {"check",    0,   NULL,         HISTORY,          FLAG,       AT(check),    "show: exit code 1 where a level is above the first by more than the tolerance, or went up lately"},
    {"recent",   0,   "N",          HISTORY,          TEXT,       AT(recent),   "show --check: how many commits are lately [10]"},
    {"timer",    0,   "NAME",       RUN|PROBE|VERIFY|GATE|HISTORY, TEXT,       AT(timer),    "timer source to use, if its audit allows; default: auto; run, none: pictures and errors alone"},
    {"pixel",    0,   "X,Y",        EXPLAIN,          TEXT,       AT(pixel),    "the pixel to explain, counted from the lower left"},
    {"device",   0,   "N",          RUN|PROBE|VERIFY|EXPLAIN|GATE|HISTORY, TEXT,  AT(device),   "EGL device number, where there are several"},
    {"driver-stats", 0, NULL,      RUN,              FLAG,       AT(driver_stats), "keep what the driver prints of its shaders (instructions, registers), where it does"},
    {"platform", 0,   "NAME",       RUN,              TEXT,       AT(platform), "of a plan over several platforms, only the variants of this one: driver=softpipe"},
    {"worker",   0,   "COMMAND",    WORKERS,          TEXT,       AT(worker),   "what starts a worker: 'ssh HOST shadebench-worker'; default: the one beside this program"},
    {"worker-limit", 0, "SECONDS",  WORKERS,          TEXT,       AT(worker_limit), "a worker that takes longer over one call is killed [120]"},
    {"in-process", 0, NULL,         WORKERS,          FLAG,       AT(in_process), "draw in this process, for a debugger: a driver that crashes ends it"},
    {"shaders",  0,   "DIR",        PLAN,             TEXT,       AT(shaders),  "another shader folder"},
    {"data",     0,   "DIR",        ALL,              TEXT,       AT(data),     "folder that holds shaders/ and bench/"},
    {"json",     0,   NULL,         ALL,              FLAG,       AT(json),     "results on stdout as JSON"},
    {"quiet",    'q', NULL,         ALL,              FLAG,       AT(quiet),    "no progress, warnings only"},
    {"verbose",  'v', NULL,         ALL,              FLAG,       AT(verbose),  "say more"},
    {"help",     'h', NULL,         ALL,              FLAG,       AT(help),     "this text"},
};
// clang-format on
#undef AT
enum { OPTION_COUNT = sizeof options_table / sizeof *options_table };

// --context egl is --set context=egl.
static bool is_option(const struct sb_axis *axis)
{
    return axis->kind == SB_PLATFORM || axis->flags & SB_OPTION;
}

// Names of all options of a command, for messages; returns their number.
static int option_names(const struct sb_command *command, const char **names, int room,
                        struct sb_arena *arena)
{
    int count = 0;
    for (int i = 0; i < OPTION_COUNT && count < room; i++)
        if (options_table[i].commands & command->bit)
            names[count++] = sb_arena_printf(arena, "--%s", options_table[i].name);
    for (int i = 0; (command->bit & MEASURE) && i < sb_measure_row_count && count < room;
         i++) {
        char *name = sb_arena_printf(arena, "--%s", sb_measure_rows[i].name);
        for (char *p = name; *p; p++)
            *p = *p == '_' ? '-' : *p;
        names[count++] = name;
    }
    const struct sb_axes *axes = sb_axes_builtin();
    for (int i = 0; !(command->bit & OFFLINE) && i < axes->count && count < room; i++)
        if (is_option(&axes->row[i]))
            names[count++] = sb_arena_printf(arena, "--%s", axes->row[i].name);
    return count;
}

// `name` and `value` are those of the option; `value` may be NULL.
static bool unknown_option(const struct sb_command *command, const char *word,
                           const char *name, const char *value, struct sb_arena *arena,
                           struct sb_error *err)
{
    if ((command->bit & PLAN) && sb_cli_fail_axis("option", name, value, err)) {
        sb_fail(err, SB_USAGE, "%s: %s", command->name, err->text);
        return false;
    }
    const char *names[96];
    const int count = option_names(command, names, 96, arena);
    return sb_fail_unknown(err, command->name, "option", word, names, count);
}

// `text` is axis=values; the origin names the option for messages about the value.
static bool add_assignment(struct sb_assignments *list, const char *option,
                           const char *text, struct sb_arena *arena, struct sb_error *err)
{
    const char *equals = strchr(text, '=');
    const bool variable = strstr(option, "-env") != NULL;
    if (!equals || equals == text)
        return sb_fail(err, SB_USAGE,
                       "--%s %s: %s=VALUE in one word is wanted, such as --%s %s", option,
                       text, variable ? "NAME" : "AXIS", option,
                       variable ? "LP_NUM_THREADS=1" : "point=4");
    if (list->count == SB_ASSIGNMENTS_MAX)
        return sb_fail(err, SB_USAGE, "--%s: more than %d of them", option,
                       SB_ASSIGNMENTS_MAX);
    char *axis = sb_arena_strdup(arena, text);
    axis[equals - text] = '\0';
    list->item[list->count++] = (struct sb_assignment){
        .axis = axis,
        .values = axis + (equals - text) + 1,
        .origin = sb_arena_printf(arena, "--%s %s", option, text),
    };
    return true;
}

// --first-look 30 and --context egl: options that come from other tables.
static bool derived_option(const struct sb_command *command, const char *name,
                           const char *value, struct sb_options *options,
                           struct sb_arena *arena, bool *known)
{
    char *plain = sb_arena_strdup(arena, name);
    for (char *p = plain; *p; p++)
        *p = *p == '-' ? '_' : *p;
    struct sb_assignments *list = NULL;
    for (int i = 0; (command->bit & MEASURE) && i < sb_measure_row_count; i++)
        if (strcmp(sb_measure_rows[i].name, plain) == 0)
            list = &options->setting;
    const struct sb_axes *axes = sb_axes_builtin();
    const int axis = sb_axes_find(axes, plain);
    if (!(command->bit & OFFLINE) && axis >= 0 && is_option(&axes->row[axis]))
        list = &options->set;
    *known = list != NULL;
    if (!list || !value || list->count == SB_ASSIGNMENTS_MAX)
        return false;
    list->item[list->count++] = (struct sb_assignment){
        .axis = plain,
        .values = value,
        .origin = sb_arena_printf(arena, "--%s %s", name, value),
    };
    return true;
}

static const struct option *find_option(const struct sb_command *command,
                                        const char *name, char letter)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option *option = &options_table[i];
        if ((option->commands & command->bit) &&
            (letter ? option->letter == letter : strcmp(option->name, name) == 0))
            return option;
    }
    return NULL;
}

// One option at argv[*i]; steps over its argument.
static bool parse_option(const struct sb_command *command, int argc, char **argv, int *i,
                         struct sb_options *options, struct sb_arena *arena,
                         struct sb_error *err)
{
    const char *word = argv[*i];
    const bool is_long = word[1] == '-';
    char *name = sb_arena_strdup(arena, word + 1 + is_long);
    char *value = is_long ? strchr(name, '=') : NULL;
    if (value)
        *value++ = '\0';
    const char *next = value ? value : *i + 1 < argc ? argv[*i + 1] : NULL;
    if (!is_long && name[1])
        return unknown_option(command, word, name, NULL, arena, err);

    const struct option *option = find_option(command, name, is_long ? 0 : name[0]);
    if (option && option->type == FLAG) {
        if (value)
            return sb_fail(err, SB_USAGE, "--%s takes no value", option->name);
        *(bool *)((char *)options + option->offset) = true;
        return true;
    }
    bool known = option != NULL;
    bool good = false;
    if (option && next && option->type == TEXT) {
        *(const char **)((char *)options + option->offset) = next;
        good = true;
    } else if (option && next) {
        void *list = (char *)options + option->offset;
        if (option->type == OUTPUT
                ? !sb_outputs_add(list, next, err)
                : !add_assignment(list, option->name, next, arena, err))
            return false;
        good = true;
    } else if (!option && is_long) {
        good = derived_option(command, name, next, options, arena, &known);
    }
    if (!known)
        return unknown_option(command, word, name, next && *next != '-' ? next : NULL,
                              arena, err);
    if (!good)
        return sb_fail(err, SB_USAGE, "%s wants a value", word);
    *i += !value;
    return true;
}

bool sb_options_parse(const struct sb_command *command, int argc, char **argv,
                      struct sb_options *options, struct sb_arena *arena,
                      struct sb_error *err)
{
    bool only_words = false;
    for (int i = 0; i < argc; i++) {
        if (!only_words && strcmp(argv[i], "--") == 0) {
            only_words = true;
        } else if (!only_words && argv[i][0] == '-' && argv[i][1]) {
            if (!parse_option(command, argc, argv, &i, options, arena, err))
                return false;
        } else if (options->word_count == SB_WORDS_MAX) {
            return sb_fail(err, SB_USAGE, "more than %d words", SB_WORDS_MAX);
        } else {
            options->word_at[options->word_count] = i;
            options->word[options->word_count++] = argv[i];
        }
    }
    if (options->quiet)
        sb_log_set_level(SB_LOG_QUIET);
    else if (options->verbose)
        sb_log_set_level(SB_LOG_VERBOSE);
    return true;
}

static void help_line(const char *name, const char *argument, char letter,
                      const char *help)
{
    char left[64];
    const int shown = snprintf(left, sizeof left, "%c%c%c --%s%s%s", letter ? '-' : ' ',
                               letter ? letter : ' ', letter ? ',' : ' ', name,
                               argument ? " " : "", argument ? argument : "");
    for (char *p = left; *p; p++)
        *p = *p == '_' && p < left + shown ? '-' : *p;
    printf("  %-26s %s\n", left, help);
}

static void program_help(void)
{
    printf(
        "shadebench measures GLSL lighting shaders: time and error of every variant.\n\n"
        "usage: shadebench COMMAND [WORD...] [OPTION...]\n\n");
    for (int i = 0; i < sb_command_count; i++)
        printf("  %-8s %s\n", sb_commands[i].name, sb_commands[i].help);
    printf("\nshadebench COMMAND --help tells more. Start with: shadebench run lights\n");
}

void sb_options_help(const struct sb_command *command)
{
    if (!command) {
        program_help();
        return;
    }
    printf("usage: shadebench %s %s [OPTION...]\n%s\n\n", command->name, command->words,
           command->details);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (options_table[i].commands & command->bit)
            help_line(options_table[i].name, options_table[i].argument,
                      options_table[i].letter, options_table[i].help);
    const struct sb_axes *axes = sb_axes_builtin();
    if (!(command->bit & OFFLINE))
        printf("\nplatform, each also as --set NAME=VALUE:\n");
    for (int i = 0; !(command->bit & OFFLINE) && i < axes->count; i++)
        if (is_option(&axes->row[i]))
            help_line(axes->row[i].name, axes->row[i].values ? "WORD" : "N", 0,
                      axes->row[i].help);
    if (!(command->bit & MEASURE))
        return;
    printf("\nmeasuring, each also under `measure:` in a suite:\n");
    for (int i = 0; i < sb_measure_row_count; i++) {
        char help[256], init[32];
        snprintf(help, sizeof help, "%s [%s]", sb_measure_rows[i].help,
                 sb_number_text(sb_measure_rows[i].init, init));
        help_line(sb_measure_rows[i].name, "N", 0, help);
    }
}
