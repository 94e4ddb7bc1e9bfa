// compare --policies and --ablation: the rows of a run that are held against others.
#include <stdio.h>

#include "base/log.h"
#include "cli/compare.h"
#include "cli/report.h"

typedef void report_fn(const struct sb_axes *axes, const struct sb_row *row, int count);

static int print(const struct sb_options *options, const struct sb_compared *compared,
                 report_fn *report, const char *makes)
{
    bool any = false;
    for (int i = 0; i < compared->rows.count; i++)
        any |= compared->rows.row[i].against != NULL;
    if (!any) {
        struct sb_error err = {0};
        sb_fail(&err, SB_BAD_INPUT,
                "%s: no row is held against another; such rows are made by %s",
                compared->path, makes);
        return sb_cli_fail(&err);
    }
    if (options->json)
        sb_cli_print_json(
            sb_report_json(compared->axes, compared->rows.row, compared->rows.count));
    else
        report(compared->axes, compared->rows.row, compared->rows.count);
    return 0;
}

int sb_compare_policies(const struct sb_options *options, struct sb_compared *compared)
{
    return print(options, compared, sb_report_policies,
                 "suites that sweep `specialise`: shadebench run effects");
}

int sb_compare_ablation(const struct sb_options *options, struct sb_compared *compared)
{
    return print(options, compared, sb_report_ablation, "shadebench run --ablate");
}
