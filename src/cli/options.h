// The command line: one table of options, one of commands; parser, --help and completion come
// from them. Every measure setting is an option (--first-look 30), and so is every platform
// axis (--context osmesa is --set context=osmesa).
#pragma once

#include "base/mem.h"
#include "suite/suite.h"

struct sb_export_format;

enum { SB_ASSIGNMENTS_MAX = 64, SB_WORDS_MAX = 64, SB_OUTPUTS_MAX = 16 };

struct sb_assignments {
    struct sb_assignment item[SB_ASSIGNMENTS_MAX];
    int count;
};

struct sb_output {    // of --write
    const char *word; // as it was given
    const struct sb_export_format *format;
    const char *path; // "-": standard output, instead of what the command prints
};
struct sb_outputs {
    struct sb_output item[SB_OUTPUTS_MAX];
    int count;
};

// Parsed options; zero where not given.
struct sb_options {
    const char *data, *shaders, *preset, *scene, *output, *resume, *timer, *device, *dump,
        *pixel, *form, *precision, *search, *seed, *programs, *demands, *costs, *ms,
        *program_cache, *worker, *worker_limit, *tolerance, *base, *head, *metric,
        *platform, *file, *commit, *date, *pairs, *variant, *recent, *cases;
    bool json, quiet, verbose, help, images, validate, classes, pareto, terms, all,
        breaking, time, payback, ablate, policies, ablation, effects, exhaustive,
        in_process, force, check, fail_on_inconclusive, selftest, keep_equal, bisect,
        driver_stats, wide;
    struct sb_assignments set, sweep, cross, setting;
    struct sb_assignments base_set, head_set, base_env, head_env;
    struct sb_outputs write;
    const char *word[SB_WORDS_MAX]; // what is no option
    int word_at[SB_WORDS_MAX];      // where it stands among the arguments
    int word_count;
};

struct sb_command {
    const char *name, *words, *help, *details;
    unsigned bit;
    int (*run)(const struct sb_options *options, int argc, char **argv);
};
extern const struct sb_command sb_commands[];
extern const int sb_command_count;

// Parses what stands behind the command. SB_USAGE names the word and the nearest option.
// Texts are argv's or live in `arena`.
bool sb_options_parse(const struct sb_command *command, int argc, char **argv,
                      struct sb_options *options, struct sb_arena *arena,
                      struct sb_error *err);

void sb_options_help(const struct sb_command *command); // NULL: of the program; to stdout
