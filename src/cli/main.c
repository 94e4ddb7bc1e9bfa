// shadebench: the command line. One file a subcommand; this one picks it.
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "base/words.h"
#include "cli/common.h"

// clang-format off
const struct sb_command sb_commands[] = {
    {"probe", "", "what this driver is, which of its timers tells the truth, what mediump does",
     "Opens a context, proves its timers against the wall clock and probes its precision\nqualifiers. Exit code 3: no timer is credible.", 1, sb_cmd_probe},
    {"list", "[WHAT]", "suites, presets, scenes, axes, contexts, columns, settings, statuses",
     "Without a word: the suites and what else can be listed.", 2, sb_cmd_list},
    {"show", "VARIANT | SUITE", "the final GLSL of a variant (point=4,stage=vertex), or the plan of a suite",
     "A variant is AXIS=VALUE,… ; `default` is the variant of all defaults. Needs no GL.", 4, sb_cmd_show},
    {"run", "[SUITE]", "measure a suite, or what --set and --sweep ask for",
     "SUITE is the name of a shipped suite (shadebench list suites) or a YAML file. Without\nSUITE, --set and --sweep say what to run. Exit codes: 0 done, 2 input, 3 a row is not\nvalid, 77 no GL here, 130 interrupted.", 8, sb_cmd_run},
};
// clang-format on
const int sb_command_count = sizeof sb_commands / sizeof *sb_commands;

static const struct sb_command *find_command(const char *word, struct sb_error *err)
{
    const char *names[16];
    for (int i = 0; i < sb_command_count; i++) {
        if (strcmp(sb_commands[i].name, word) == 0)
            return &sb_commands[i];
        names[i] = sb_commands[i].name;
    }
    sb_fail_unknown(err, "", "command", word, names, sb_command_count);
    return NULL;
}

int main(int argc, char **argv)
{
    struct sb_error err = {0};
    const char *word = argc > 1 ? argv[1] : "--help";
    if (strcmp(word, "--version") == 0) {
        printf("shadebench %s\n", SB_VERSION);
        return 0;
    }
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
        strcmp(word, "help") == 0) {
        sb_options_help(NULL);
        return argc > 1 ? 0 : sb_status_rows[SB_USAGE].exit_code;
    }
    const struct sb_command *command = find_command(word, &err);
    if (!command)
        return sb_cli_fail(&err);
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
    // A pipe that was closed, or a full disk behind stdout, is no success.
    if (fflush(stdout) != 0 && code == 0)
        code = sb_status_rows[SB_WRITE_FAILED].exit_code;
    return code;
}
