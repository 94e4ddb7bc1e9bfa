// What the tests of export/ write: a run and a pair, with texts that every format must escape.
#pragma once

#include "test.h"

#include "export/export.h"

#define NONE                                                                             \
    {                                                                                    \
        NAN, NAN, NAN, 0                                                                 \
    }

static const double four_ns[] = {1e6, 2e6, 3e6, 4e6};
static const double four_cpu_ns[] = {2e6, 2e6, 2e6, 6e6};
static const struct sb_export_counter errors[] = {{"max_err", 0.25}, {"flip_mean", NAN}};

enum { OK, QUOTED, BROKEN, LATE, RUN_ROWS };
static const struct sb_export_row run_rows[RUN_ROWS] = {
    [OK] = {.scene = "room",
            .variant = "point=8,stage=fragment",
            .status = "ok",
            .frame_ns = {2.5e6, 2e6, 3.5e6, 4},
            .cpu_ns = 2e6,
            .ratio = {1.25, 1.125, 1.5, 4},
            .batch = 7,
            .sample_ns = four_ns,
            .sample_cpu_ns = four_cpu_ns,
            .sample_count = 4,
            .counter = errors,
            .counter_count = 2},
    // No samples, no CPU time, no interval, and one ratio that is none.
    [QUOTED] = {.scene = "plane",
                .variant = "form=\"a, b\",<c>&d|e f/g é\xFF",
                .status = "not_fragment_bound",
                .message = "valid, \"but\" <so>",
                .frame_ns = {1.5e6, NAN, NAN, 1},
                .cpu_ns = NAN,
                .ratio = NONE},
    [BROKEN] = {.scene = "room",
                .variant = "point=9",
                .outcome = SB_EXPORT_ERROR,
                .status = "compile_failed",
                .message = "0:1: 'x' : \"syntax\"\terror & more",
                .details = "line one\nline <two>",
                .frame_ns = {9e6, 8e6, 10e6, 3}, // not to be believed
                .cpu_ns = NAN,
                .ratio = NONE},
    [LATE] = {.scene = "room",
              .variant = "point=10",
              .outcome = SB_EXPORT_SKIPPED,
              .status = "not_measured",
              .frame_ns = NONE,
              .cpu_ns = NAN,
              .ratio = NONE},
};
static const struct sb_export_property run_properties[] = {
    {"renderer", "pipe | \"r\" <1>", SB_EXPORT_TEXT, SB_EXPORT_HEAD},
    {"num_cpus", "2", SB_EXPORT_NUMBER, 0},
    {"load_avg", "0.5 0.25 1", SB_EXPORT_NUMBERS, SB_EXPORT_ONCE},
    {"seed", "1", SB_EXPORT_NUMBER, SB_EXPORT_HEAD | SB_EXPORT_ONCE},
    {"cpu", NULL, SB_EXPORT_TEXT, SB_EXPORT_HEAD},
};
static const struct sb_export run_export = {
    .name = "shadebench run lights",
    .property = run_properties,
    .property_count = 5,
    .row = run_rows,
    .row_count = RUN_ROWS,
};

enum { BASE, HEAD, OTHER_BASE, OTHER_HEAD, PAIR_ROWS };
static const struct sb_export_row pair_rows[PAIR_ROWS] = {
    [BASE] = {.scene = "room",
              .variant = "point=8",
              .side = "base",
              .outcome = SB_EXPORT_FAILED, // not its own
              .frame_ns = {2e6, 1.9e6, 2.1e6, 4},
              .cpu_ns = NAN,
              .ratio = NONE},
    [HEAD] = {.scene = "room",
              .variant = "point=8",
              .side = "head",
              .outcome = SB_EXPORT_FAILED,
              .status = "regression",
              .message = "slower by more than 2 %",
              .details = "tolerance 2 %\np = 0.0001",
              .frame_ns = {2.5e6, 2.4e6, 2.6e6, 4},
              .cpu_ns = NAN,
              .ratio = {1.25, 1.2, 1.3, 4}},
    [OTHER_BASE] = {.scene = "room",
                    .variant = "point=1",
                    .side = "base",
                    .frame_ns = {1e6, NAN, NAN, 4},
                    .cpu_ns = NAN,
                    .ratio = NONE},
    [OTHER_HEAD] = {.scene = "room",
                    .variant = "point=1",
                    .side = "head",
                    .status = "unchanged",
                    .frame_ns = {1e6, NAN, NAN, 4},
                    .cpu_ns = NAN,
                    .ratio = {1, 0.99, 1.01, 4}},
};
static const struct sb_export pair_export = {
    .name = "shadebench gate",
    .row = pair_rows,
    .row_count = PAIR_ROWS,
};

// Of a gate that counts instructions, and of one whose sides are the same program.
static const double two_counts[] = {1000000, 1000002};
static const struct sb_export_counter counts[] = {{"instructions", 1000001},
                                                  {"instructions", 1050000}};
enum { COUNTED_BASE, COUNTED_HEAD, SAME_BASE, SAME_HEAD, UNTIMED_ROWS };
static const struct sb_export_row untimed_rows[UNTIMED_ROWS] = {
    [COUNTED_BASE] = {.scene = "room",
                      .variant = "point=8",
                      .side = "base",
                      .frame_ns = NONE,
                      .cpu_ns = NAN,
                      .ratio = NONE,
                      .batch = 1,
                      .sample_instructions = two_counts,
                      .sample_count = 2,
                      .counter = &counts[0],
                      .counter_count = 1},
    [COUNTED_HEAD] = {.scene = "room",
                      .variant = "point=8",
                      .side = "head",
                      .status = "pass",
                      .frame_ns = NONE,
                      .cpu_ns = NAN,
                      .ratio = {1.05, 1.04, 1.06, 2},
                      .batch = 1,
                      .sample_instructions = two_counts,
                      .sample_count = 2,
                      .counter = &counts[1],
                      .counter_count = 1},
    [SAME_BASE] = {.scene = "room",
                   .variant = "point=1",
                   .side = "base",
                   .outcome = SB_EXPORT_SKIPPED,
                   .frame_ns = NONE,
                   .cpu_ns = NAN,
                   .ratio = NONE},
    [SAME_HEAD] = {.scene = "room",
                   .variant = "point=1",
                   .side = "head",
                   .outcome = SB_EXPORT_SKIPPED,
                   .status = "skipped",
                   .frame_ns = NONE,
                   .cpu_ns = NAN,
                   .ratio = NONE,
                   .equal = true},
};
static const struct sb_export untimed_export = {
    .name = "shadebench gate",
    .row = untimed_rows,
    .row_count = UNTIMED_ROWS,
};

static inline const struct sb_export_format *format_of(const char *name)
{
    struct sb_error err = {0};
    const struct sb_export_format *format = sb_export_format_find("test", name, &err);
    if (!format)
        fail_msg("%s", err.text);
    return format;
}

// To be freed.
static inline char *written(const char *format, const struct sb_export *export)
{
    struct sb_text text = {0};
    format_of(format)->write(export, &text);
    return text.data;
}

// Shows where two texts part.
static inline void check_text(const char *text, const char *wanted)
{
    size_t at = 0;
    while (text[at] && text[at] == wanted[at])
        at++;
    if (text[at] != wanted[at])
        fail_msg("from byte %zu on \"%.80s\", wanted \"%.80s\", in\n%s", at, text + at,
                 wanted + at, text);
}
