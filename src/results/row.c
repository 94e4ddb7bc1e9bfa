#include <math.h>

#include "results/row.h"

const struct sb_column sb_sample_columns[] = {
#define SAMPLE(type, name, help)                                                         \
    {#name, help, SB_##type, offsetof(struct sb_sample_row, name)},
#define SUMMARY(type, name, help)
#define CASE(type, field, name, help)
#define AXES()
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
#undef AXES
};

const struct sb_column sb_summary_columns[] = {
#define SAMPLE(type, name, help)
#define SUMMARY(type, name, help) {#name, help, SB_##type, offsetof(struct sb_row, name)},
#define AXES()                    {NULL, NULL, SB_AXES, offsetof(struct sb_row, axes)},
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
#undef CASE
#undef AXES
};

const struct sb_column sb_case_columns[] = {
#define SAMPLE(type, name, help)
#define SUMMARY(type, name, help)
#define AXES()
#define CASE(type, field, name, help)                                                    \
    {name, help, SB_##type, offsetof(struct sb_case_row, field)},
#include "results/columns.def"
#undef SAMPLE
#undef SUMMARY
#undef CASE
#undef AXES
};

const int sb_sample_column_count = sizeof sb_sample_columns / sizeof *sb_sample_columns;
const int sb_summary_column_count =
    sizeof sb_summary_columns / sizeof *sb_summary_columns;
const int sb_case_column_count = sizeof sb_case_columns / sizeof *sb_case_columns;

void sb_columns_clear(void *row, const struct sb_column *columns, int count)
{
    for (int i = 0; i < count; i++) {
        void *cell = (char *)row + columns[i].offset;
        switch (columns[i].type) {
        case SB_TEXT:
        case SB_AXES:
            *(const void **)cell = NULL;
            break;
        case SB_REAL:
            *(double *)cell = NAN;
            break;
        case SB_COUNT:
            *(int64_t *)cell = SB_NO_COUNT;
            break;
        }
    }
}

void sb_row_init(struct sb_row *row)
{
    sb_columns_clear(row, sb_summary_columns, sb_summary_column_count);
}

void sb_sample_row_init(struct sb_sample_row *row)
{
    sb_columns_clear(row, sb_sample_columns, sb_sample_column_count);
}

void sb_case_row_init(struct sb_case_row *row)
{
    sb_columns_clear(row, sb_case_columns, sb_case_column_count);
}

double sb_sample_frame_ns(const struct sb_sample_row *row)
{
    if (row->flags != 0)
        return NAN;
    const int64_t ns = row->gpu_ns == SB_NO_COUNT ? row->wall_ns : row->gpu_ns;
    return (double)ns / (double)row->batch;
}

double sb_sample_frame_ms(const struct sb_sample_row *row)
{
    return sb_sample_frame_ns(row) * 1e-6;
}
