// What several subcommands share.
#pragma once

#include <jansson.h>

#include "cli/options.h"
#include "job/job.h"
#include "measure/driver.h"

int sb_cmd_probe(const struct sb_options *options, int argc, char **argv);
int sb_cmd_list(const struct sb_options *options, int argc, char **argv);
int sb_cmd_show(const struct sb_options *options, int argc, char **argv);
int sb_cmd_explain(const struct sb_options *options, int argc, char **argv);
int sb_cmd_verify(const struct sb_options *options, int argc, char **argv);
int sb_cmd_compare(const struct sb_options *options, int argc, char **argv);
int sb_cmd_fit(const struct sb_options *options, int argc, char **argv);
int sb_cmd_plan(const struct sb_options *options, int argc, char **argv);
int sb_cmd_gate(const struct sb_options *options, int argc, char **argv);
int sb_cmd_history(const struct sb_options *options, int argc, char **argv);
int sb_cmd_run(const struct sb_options *options, int argc, char **argv);

enum { SB_EXIT_STOP_BISECTION = 128 }; // what git bisect run takes for "stop"

// Prints the error and returns its exit code.
int sb_cli_fail(const struct sb_error *err);

// What stands in the wrong place but names an axis, one of its values or AXIS=VALUE: fails
// with the way to say it, `unknown suite "point=4"; an axis is set with --set point=4`, and
// returns true. `value` may be NULL. False: it is none of these, and *err is as it was.
bool sb_cli_fail_axis(const char *what, const char *word, const char *value,
                      struct sb_error *err);

// A word with a slash or a dot is a path; else it names a shipped suite. The path, or NULL.
const char *sb_cli_suite_path(const char *word, const char *data_dir,
                              struct sb_arena *arena, struct sb_error *err);

// Do the options say what to draw? --context and its like only say where.
bool sb_cli_is_planned(const struct sb_options *options);

// Loads the suite that the options ask for: `path`, or without one (NULL) --set
// and --sweep alone.
bool sb_cli_load_suite(const struct sb_options *options, const char *path,
                       const char *data_dir, struct sb_suite *suite,
                       struct sb_error *err);

// "point=4,stage=vertex" as assignments over those of --set; "delphi,stage=vertex" names a
// preset first, as ids do, and "default" says nothing. SB_USAGE.
bool sb_cli_add_variant(const char *word, struct sb_options *options,
                        struct sb_arena *arena, struct sb_error *err);

// From options and the suite's platform axes; sets the driver's environment.
bool sb_cli_driver_params(const struct sb_options *options, const struct sb_suite *suite,
                          struct sb_driver_params *params, struct sb_error *err);

// Two raster threads may share a core for a while or not: with one the level of a software driver
// stands still (docs/method.md). Whoever has set a number keeps it. Returns whether it was set here.
bool sb_cli_pin_threads(const struct sb_suite *suite);

// "2%" or "0.02", of the option called `option`. SB_USAGE.
bool sb_cli_read_share(const char *option, const char *text, double *share,
                       struct sb_error *err);

// What a command was started with, the words behind it, for the record beside its results. New
// reference; NULL where JSON cannot hold them.
enum { SB_ARGUMENTS_MAX = 256 };
json_t *sb_cli_arguments_json(int argc, char **argv, struct sb_error *err);

void sb_cli_print_json(json_t *value); // steals the reference
