#include <string.h>

#include "base/words.h"
#include "suite/suite.h"

const struct sb_measure_row sb_measure_rows[] = {
#define SETTING(name, init, min, max, whole, help)                                       \
    {#name, help, init, min, max, whole, offsetof(struct sb_measure_settings, name)},
#include "suite/measure.def"
#undef SETTING
};
const int sb_measure_row_count = sizeof sb_measure_rows / sizeof *sb_measure_rows;

static double *field(struct sb_measure_settings *settings,
                     const struct sb_measure_row *row)
{
    return (double *)((char *)settings + row->offset);
}

void sb_measure_defaults(struct sb_measure_settings *settings)
{
    for (int i = 0; i < sb_measure_row_count; i++)
        *field(settings, &sb_measure_rows[i]) = sb_measure_rows[i].init;
}

bool sb_measure_set(struct sb_measure_settings *settings, const char *name,
                    const char *value, struct sb_error *err)
{
    const char *names[sizeof sb_measure_rows / sizeof *sb_measure_rows];
    for (int i = 0; i < sb_measure_row_count; i++) {
        const struct sb_measure_row *row = &sb_measure_rows[i];
        names[i] = row->name;
        if (strcmp(row->name, name) == 0)
            return sb_number_read(name, value, row->min, row->max, row->whole,
                                  field(settings, row), err);
    }
    return sb_fail_unknown(err, "", "setting", name, names, sb_measure_row_count);
}
