// The writers of the table in export.c, and what several of them need.
#pragma once

#include <jansson.h>

#include "export/export.h"

void sb_export_gbench_json(const struct sb_export *export, struct sb_text *text);
void sb_export_gbench_aggregates(const struct sb_export *export, struct sb_text *text);
void sb_export_gbench_csv(const struct sb_export *export, struct sb_text *text);
void sb_export_github_action(const struct sb_export *export, struct sb_text *text);
void sb_export_bencher(const struct sb_export *export, struct sb_text *text);
void sb_export_go(const struct sb_export *export, struct sb_text *text);
void sb_export_junit(const struct sb_export *export, struct sb_text *text);
void sb_export_markdown(const struct sb_export *export, struct sb_text *text);

// "room/point=8", "head/room/point=8".
void sb_export_row_name(const struct sb_export_row *row, struct sb_text *text);

bool sb_export_is_base(const struct sb_export_row *row);

// Has it a time to believe?
bool sb_export_timed(const struct sb_export_row *row);

// Instructions a frame, to be believed as a time is; NAN: not counted.
double sb_export_instructions(const struct sb_export_row *row);

// Has it a ratio to believe? It may, without a time: of instructions.
bool sb_export_has_ratio(const struct sb_export_row *row);

// The other side of a head; NULL: there is none, or nothing is known of it.
const struct sb_export_row *sb_export_base_of(const struct sb_export *export,
                                              const struct sb_export_row *row);

// "regression: slower by more than 2 %", or what there is of it.
void sb_export_says(const struct sb_export_row *row, struct sb_text *text);

// "ms a frame: 1.234 [1.230, 1.240], ratio: 1.05 [1.04, 1.06]"; nothing of what is not known.
void sb_export_times(const struct sb_export_row *row, struct sb_text *text);

// Half the wider side of an interval over its point, as "1.2"; false where it has no bounds.
bool sb_export_half_percent(const struct sb_interval *interval, struct sb_text *text);

// The shortest that reads back, but whole numbers without an exponent: not every reader takes one.
void sb_export_number(struct sb_text *text, double value);

// --- JSON -----------------------------------------------------------------------------------

// Any bytes as a string: those that are no UTF-8 become U+FFFD.
void sb_export_json_text(json_t *object, const char *key, const char *value);
// The same of a key. Steals the reference.
void sb_export_json_object(json_t *object, const char *key, json_t *value);
// Nothing where it is not finite: JSON has no such number.
void sb_export_json_number(json_t *object, const char *key, double value);
// Appends the text of it and a line end, and releases it.
void sb_export_json_add(json_t *value, struct sb_text *text);
