// The program on the context that the test is for: what the tests of the command line on a real
// driver share.
#pragma once

#include "cli_fixture.h"

#include "gl_test.h"

static char platform[64]; // "--context egl --api gl"
static struct sb_caps caps;

// What is the driver's, whatever opens it, is tried in one kind of context: starts take
// seconds, since each proves its timers.
static inline bool is_egl(void)
{
    return strcmp(gl_test_context(), "egl") == 0;
}

// Did the program find no timer to be believed? On a busy machine that is the right answer, and
// not what is on trial.
static inline bool no_timer(const struct answer *answer)
{
    return answer->code == 3 && strstr(answer->text, "no timer source passed");
}

// As run_program, a few times where there was no timer.
static inline void run_timed(struct answer *answer, const char *line)
{
    for (int tries = 0; tries < 4; tries++) {
        run_program(answer, line);
        if (!no_timer(answer))
            return;
    }
}

static inline void begin_gl_tests(void)
{
    struct gl_test test;
    gl_test_open(&test); // or the end, where there is no such context
    caps = test.caps;
    gl_test_close(&test);
    begin_tests();
    snprintf(platform, sizeof platform, "--context %s --api %s", gl_test_context(),
             gl_test_gles() ? "gles" : "gl");
    // The program has no shim that keeps the driver's modules mapped, so the leaks of the
    // driver would have no name there; the programs of local_*.c look for ours.
    setenv("ASAN_OPTIONS", "handle_segv=2:detect_leaks=0", 1);
}
