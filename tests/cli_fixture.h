// Runs the program as a user would, for the tests of cli/.
#pragma once

#include "test.h"

#include <sys/wait.h>
#include <unistd.h>

struct answer {
    int code;         // exit code; -1: killed by a signal
    char text[65536]; // stdout and stderr together
};

// `arguments` go through the shell: quote them.
static inline void run_program(struct answer *answer, const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "%s %s 2>&1 </dev/null", SB_PROGRAM, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(answer->text, 1, sizeof answer->text - 1, pipe);
    answer->text[length] = '\0';
    while (fgetc(pipe) != EOF)
        continue; // a reader that leaves early would kill the writer
    const int status = pclose(pipe);
    answer->code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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

static inline int count_lines(const char *text)
{
    int lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}
