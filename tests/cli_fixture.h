// Runs the program as a user would, for the tests of cli/.
#pragma once

#include "test.h"

#include <jansson.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "results/csv.h"

struct answer {
    int code;         // exit code; 128 and the signal's number, if one killed it
    char text[65536]; // stdout and stderr together
};

static char test_dir[64]; // of this program, made by begin_tests

static inline void begin_tests(void)
{
    snprintf(test_dir, sizeof test_dir, "/tmp/shadebench-cli-XXXXXX");
    if (!mkdtemp(test_dir))
        abort();
    // Variables of whoever runs the tests must not change what is run.
    unsetenv("SHADEBENCH_DATA");
}

// What main returns: `failed` tests, or a folder that cannot be removed.
static inline int end_tests(int failed)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", test_dir);
    return failed | (system(command) != 0);
}

// Shell words are written with @ for test_dir and $SB for the program.
static inline void expand(char *to, size_t room, const char *from)
{
    size_t n = 0;
    for (; *from; from++) {
        const bool program = strncmp(from, "$SB", 3) == 0;
        char one[2] = {*from, '\0'};
        const char *part = *from == '@' ? test_dir : program ? SB_PROGRAM : one;
        assert_true(n + strlen(part) < room);
        n += (size_t)sprintf(to + n, "%s", part);
        from += program ? 2 : 0;
    }
    to[n] = '\0';
}

static inline void run_shell(struct answer *answer, const char *line)
{
    char command[4096];
    expand(command, sizeof command, line);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(answer->text, 1, sizeof answer->text - 1, pipe);
    answer->text[length] = '\0';
    while (fgetc(pipe) != EOF)
        continue; // a reader that leaves early would kill the writer
    const int status = pclose(pipe);
    answer->code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// `arguments` go through the shell: quote them.
static inline void run_program(struct answer *answer, const char *arguments)
{
    char line[4096];
    snprintf(line, sizeof line, "$SB %s 2>&1 </dev/null", arguments);
    run_shell(answer, line);
}

// Exit code and a part of the text, in one check that shows both when it fails.
#define check_answer(arguments, code, part)                                              \
    check_answer_at(arguments, code, part, __FILE__, __LINE__)
static inline void check_answer_at(const char *arguments, int code, const char *part,
                                   const char *file, int line)
{
    static struct answer answer;
    run_program(&answer, arguments);
    if (answer.code == code && strstr(answer.text, part))
        return;
    print_error("shadebench %s\nexit code %d, wanted %d, with \"%s\" in:\n%s\n",
                arguments, answer.code, code, part, answer.text);
    _fail(file, line);
}

// The same for a line of shell.
#define check_shell(line, code, part) check_shell_at(line, code, part, __FILE__, __LINE__)
static inline void check_shell_at(const char *text, int code, const char *part,
                                  const char *file, int line)
{
    static struct answer answer;
    run_shell(&answer, text);
    if (answer.code == code && strstr(answer.text, part))
        return;
    print_error("%s\nexit code %d, wanted %d, with \"%s\" in:\n%s\n", text, answer.code,
                code, part, answer.text);
    _fail(file, line);
}

static inline int count_lines(const char *text)
{
    int lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

static inline const char *write_file(const char *name, const char *text)
{
    static char path[128];
    struct sb_error err = {0};
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    if (!sb_file_replace(path, text, strlen(text), &err))
        fail_msg("%s", err.text);
    return path;
}

// The file `name` in test_dir, whole; to be freed.
static inline char *read_file(const char *name)
{
    char path[256];
    size_t size;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    const char *data = sb_file_read(&arena, path, (size_t)1 << 30, &size, &err);
    if (!data)
        fail_msg("%s", err.text);
    char *copy = malloc(size + 1);
    memcpy(copy, data, size + 1);
    sb_arena_free(&arena);
    return copy;
}

// The JSON that the program prints on stdout; it must end with `code`.
static inline json_t *run_json(const char *arguments, int code)
{
    static struct answer answer;
    char line[4096];
    json_error_t cause;
    snprintf(line, sizeof line, "$SB %s 2>/dev/null </dev/null", arguments);
    run_shell(&answer, line);
    json_t *json = json_loads(answer.text, 0, &cause);
    if (!json || answer.code != code)
        fail_msg("%s: exit code %d, JSON: %s\n%s", arguments, answer.code,
                 json ? "good" : cause.text, answer.text);
    return json;
}

static inline void read_csv(const char *name, struct sb_csv *csv)
{
    char path[256];
    struct sb_error err = {0};
    *csv = (struct sb_csv){0};
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    if (!sb_csv_read(path, csv, &err))
        fail_msg("%s", err.text);
}

static inline const char *csv_cell(const struct sb_csv *csv, int line, const char *column)
{
    const int at = sb_csv_column(csv, column);
    if (at < 0 || line >= csv->row_count)
        fail_msg("line %d has no %s", line, column);
    return csv->cell[line][at];
}

// "complete" of the last process in run.json.
static inline bool run_is_complete(const char *name)
{
    json_error_t cause;
    char *text = read_file(name);
    json_t *run = json_loads(text, 0, &cause);
    free(text);
    assert_non_null(run);
    const json_t *processes = json_object_get(run, "processes");
    const json_t *last = json_array_get(processes, json_array_size(processes) - 1);
    const json_t *complete = json_object_get(last, "complete");
    assert_true(json_is_boolean(complete));
    const bool answer = json_is_true(complete);
    json_decref(run);
    return answer;
}
