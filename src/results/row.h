// Rows of the results files: structs made from columns.def, and the table that describes them.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "axis/variant.h"

#define SB_NO_COUNT INT64_MIN // a count that was not measured; 0 is a value

typedef const char *sb_cell_TEXT;
typedef double sb_cell_REAL;
typedef int64_t sb_cell_COUNT;

struct sb_sample_row {
#define SAMPLE(type, name, help) sb_cell_##type name;
#define SUMMARY(type, name, help)
#define CASE(type, field, name, help)
#define AXES()
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
};

struct sb_row {
    const struct sb_variant *axes; // the columns of the axes
#define SAMPLE(type, name, help)
#define SUMMARY(type, name, help) sb_cell_##type name;
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
#undef CASE
};

struct sb_case_row {
#define SAMPLE(type, name, help)
#define SUMMARY(type, name, help)
#define CASE(type, field, name, help) sb_cell_##type field;
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
#undef CASE
#undef AXES
};

enum sb_column_type { SB_TEXT, SB_REAL, SB_COUNT, SB_AXES };

struct sb_column {
    const char *name, *help; // SB_AXES: NULL; all axes stand here
    enum sb_column_type type;
    size_t offset; // into the row
};
extern const struct sb_column sb_sample_columns[];
extern const struct sb_column sb_summary_columns[];
extern const struct sb_column sb_case_columns[];
extern const int sb_sample_column_count, sb_summary_column_count, sb_case_column_count;

// Makes every cell of a row absent.
void sb_columns_clear(void *row, const struct sb_column *columns, int count);
// A row with every cell absent.
void sb_row_init(struct sb_row *row);
void sb_sample_row_init(struct sb_sample_row *row);
void sb_case_row_init(struct sb_case_row *row);

// The time of a sample a frame, by its timer source. NAN where flagged.
double sb_sample_frame_ns(const struct sb_sample_row *row);
double sb_sample_frame_ms(const struct sb_sample_row *row);
