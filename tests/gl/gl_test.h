// The context that a program under tests/gl/ runs in: SB_TEST_CONTEXT (egl, osmesa, glfw;
// egl if unset) and SB_TEST_API (gl, gles; gl if unset). Where it cannot be opened the
// program exits with 77, "skipped", unless SB_REQUIRE_CONTEXTS, a list such as
// "egl,osmesa", names it: then that is a failure.
#pragma once

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context/context.h"
#include "gl/gl.h"

static inline const char *gl_test_context(void)
{
    const char *name = getenv("SB_TEST_CONTEXT");
    return name ? name : "egl";
}

static inline bool gl_test_gles(void)
{
    const char *api = getenv("SB_TEST_API");
    return api && strcmp(api, "gles") == 0;
}

// Whether the comma list SB_REQUIRE_CONTEXTS holds gl_test_context().
static inline bool gl_test_required(void)
{
    const char *name = gl_test_context(), *list = getenv("SB_REQUIRE_CONTEXTS");
    while (list && *list) {
        const size_t length = strcspn(list, ",");
        if (length == strlen(name) && strncmp(list, name, length) == 0)
            return true;
        list += length + strspn(list + length, ",");
    }
    return false;
}

// Ends the program: for what a failed open said.
static inline _Noreturn void gl_test_unavailable(const struct sb_error *err)
{
    const bool failed = gl_test_required() || err->status != SB_NO_GL;
    fprintf(stderr, "%s: %s\n", failed ? "failed" : "skipped", err->text);
    exit(failed ? 1 : 77);
}

struct gl_test {
    const struct sb_context_fns *fns;
    void *context;
    struct sb_caps caps;
};

// A current context with its entry points loaded, or the end of the program.
static inline void gl_test_open(struct gl_test *test)
{
    struct sb_error err = {0};
    const struct sb_context_options options = {.gles = gl_test_gles(), .device = -1};
    memset(test, 0, sizeof *test);
    test->context = sb_context_open(gl_test_context(), &options, &test->fns, &err);
    if (!test->context ||
        !sb_gl_load(test->fns->proc, test->context, options.gles, &test->caps, &err))
        gl_test_unavailable(&err);
}

static inline void gl_test_close(struct gl_test *test)
{
    test->fns->close(test->context);
}
