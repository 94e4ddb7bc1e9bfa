// A driver to ask hard cases of, for the tests of cases.
#pragma once

#include "cases/verify.h"
#include "gl_test.h"
#include "local/local.h"
#include "test.h"

static struct sb_driver case_driver;

static inline void open_case_driver(void)
{
    struct sb_error err = {0};
    const struct sb_driver_params params = {
        .runner = &sb_runner_local,
        .context = {.context = gl_test_context(), .gles = gl_test_gles(), .device = -1},
    };
    if (!sb_driver_connect(&params, &case_driver, &err) ||
        !sb_driver_probe(&case_driver, &err))
        gl_test_unavailable(&err);
}

// `shaders`: another folder; NULL: the shipped one.
static inline struct sb_case_env case_env(const char *shaders)
{
    return (struct sb_case_env){
        .axes = sb_axes_builtin(),
        .driver = &case_driver,
        .data_dir = SB_SOURCE_DIR,
        .shaders = shaders,
    };
}

// Half precision as this context has it.
static inline enum sb_case_precision case_half(const struct sb_case_env *env)
{
    return sb_case_unavailable(env, SB_CASE_HALF, false) ? SB_CASE_EMULATED
                                                         : SB_CASE_HALF;
}
