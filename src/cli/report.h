// What `run` prints of its rows: the table, and JSON.
#pragma once

#include <jansson.h>

#include "results/row.h"
#include "suite/suite.h"

// One row a plan entry, in the plan's order.
void sb_report_table(const struct sb_suite *suite, const struct sb_row *row, int count);
json_t *sb_report_json(const struct sb_axes *axes, const struct sb_row *row, int count);
