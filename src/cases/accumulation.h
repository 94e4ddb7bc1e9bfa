// The cases of accumulation.c that take more than points.
#pragma once

#include "cases/case.h"

typedef bool sb_case_run_fn(const struct sb_case_env *env, const struct sb_case *it,
                            const struct sb_case_setting *setting,
                            struct sb_outcome *outcome, struct sb_error *err);
// accumulation_pictures.c
sb_case_run_fn sb_case_run_gouraud, sb_case_run_extrapolation;
// accumulation_programs.c
sb_case_run_fn sb_case_run_repeat, sb_case_run_links;
