// A program that runs beside the test, on a terminal of its own, so that a test can follow
// its progress and stop it at a stage. Include it before anything else.
#pragma once

#define _XOPEN_SOURCE 700 // posix_openpt

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli_fixture.h"

struct running {
    pid_t pid;
    int terminal;
    size_t length;
    char text[1 << 18]; // what it said, the newest of it
};

static inline void start_program(struct running *it, const char *arguments)
{
    char line[4096], command[4200];
    expand(line, sizeof line, arguments);
    snprintf(command, sizeof command, "exec '%s' %s", SB_PROGRAM, line);
    it->length = 0;
    it->text[0] = '\0';
    it->terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (it->terminal < 0) {
        print_message("no pseudo-terminal to be had here\n");
        skip();
    }
    assert_int_equal(grantpt(it->terminal), 0);
    assert_int_equal(unlockpt(it->terminal), 0);
    const int program_side = open(ptsname(it->terminal), O_RDWR | O_NOCTTY);
    assert_true(program_side >= 0);
    it->pid = fork();
    assert_true(it->pid >= 0);
    if (it->pid == 0) {
        dup2(program_side, STDOUT_FILENO);
        dup2(program_side, STDERR_FILENO);
        close(program_side);
        close(it->terminal);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    close(program_side);
}

// Takes in more of what it says. False once it has ended, or said nothing for a minute.
static inline bool read_more(struct running *it)
{
    struct pollfd ready = {.fd = it->terminal, .events = POLLIN};
    if (poll(&ready, 1, 60000) <= 0)
        return false;
    if (it->length > sizeof it->text / 2) {
        it->length /= 2;
        memmove(it->text, it->text + it->length, it->length);
    }
    const ssize_t count =
        read(it->terminal, it->text + it->length, sizeof it->text - 1 - it->length);
    if (count <= 0)
        return false;
    it->length += (size_t)count;
    it->text[it->length] = '\0';
    return true;
}

static inline void wait_until_said(struct running *it, const char *part)
{
    while (!strstr(it->text, part))
        if (!read_more(it)) {
            kill(it->pid, SIGKILL);
            fail_msg("it never said \"%s\": %s", part, it->text);
        }
}

// Its exit code, or 128 and the number of the signal that killed it.
static inline int finish(struct running *it)
{
    int status;
    while (read_more(it))
        continue;
    close(it->terminal);
    assert_int_equal(waitpid(it->pid, &status, 0), it->pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static inline void wait_until_handled(const struct running *it, int number)
{
    // The handler is taken away as the first signal arrives (SigCgt in /proc/PID/status).
    char path[64], line[256];
    snprintf(path, sizeof path, "/proc/%d/status", (int)it->pid);
    for (unsigned long long caught = ~0ull; caught >> (number - 1) & 1;) {
        FILE *file = fopen(path, "r");
        assert_non_null(file);
        while (fgets(line, sizeof line, file))
            sscanf(line, "SigCgt: %llx", &caught);
        fclose(file);
    }
}
