// shadebench probe: what this driver is, and which of its answers can be believed.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "cli/common.h"
#include "cli/table.h"
#include "measure/machine.h"
#include "measure/record.h"

static void print_timers(const struct sb_driver *driver)
{
    struct sb_table *table = sb_table_new();
    sb_table_column(table, "timer", false);
    sb_table_column(table, "verdict", false);
    sb_table_column(table, "error", true);
    sb_table_column(table, "bits", true);
    sb_table_column(table, "step ns", true);
    sb_table_column(table, "empty ns", true);
    sb_table_column(table, "why", false);
    for (int i = 0; i < driver->audit.source_count; i++) {
        const struct sb_timer_source *source = &driver->audit.source[i];
        sb_table_cell(table, source->name);
        sb_table_cell(table, i == driver->timer ? "in use"
                             : source->credible ? "credible"
                             : source->usable   ? "not credible"
                                                : "not there");
        if (source->usable && isfinite(source->error))
            sb_table_cellf(table, "%.1f %%", 100 * source->error);
        else
            sb_table_cell(table, NULL);
        sb_table_cellf(table, "%d", source->bits);
        sb_table_cellf(table, "%.0f", source->granularity_ns);
        sb_table_cellf(table, "%.0f", source->empty_ns);
        sb_table_cell(table, source->reason);
    }
    sb_table_print(table);
    sb_table_free(&table);
}

static bool same_finding(const struct sb_driver *driver, int i, int k)
{
    const struct sb_precision_reading *reading = driver->probe.reading;
    return reading[i].vertex_stage == reading[k].vertex_stage &&
           reading[i].carrier == reading[k].carrier &&
           strcmp(driver->verdict[i].text, driver->verdict[k].text) == 0;
}

// Precisions of one carrier that come to the same share a row.
static void print_precision(const struct sb_driver *driver)
{
    struct sb_table *table = sb_table_new();
    struct sb_text names = {0};
    sb_table_column(table, "stage", false);
    sb_table_column(table, "carrier", false);
    sb_table_column(table, "precision", false);
    sb_table_column(table, "effective", false);
    for (int i = 0; i < driver->probe.count;) {
        const struct sb_precision_reading *reading = &driver->probe.reading[i];
        const int first = i;
        sb_text_clear(&names);
        for (; i < driver->probe.count && same_finding(driver, first, i); i++)
            sb_text_printf(&names, "%s%s", i > first ? ", " : "",
                           sb_precision_names[driver->probe.reading[i].precision]);
        sb_table_cell(table, reading->vertex_stage ? "vertex" : "fragment");
        sb_table_cell(table, sb_carriers[reading->carrier].name);
        sb_table_cell(table, sb_text_get(&names));
        sb_table_cell(table, driver->verdict[first].text);
    }
    sb_table_print(table);
    sb_text_free(&names);
    sb_table_free(&table);
}

static void print_driver(const struct sb_driver *driver)
{
    const struct sb_caps *caps = &driver->caps;
    printf("context   %s\nrenderer  %s\nvendor    %s\nversion   %s\nglsl      %s\n",
           caps->context, caps->renderer, caps->vendor, caps->version,
           caps->glsl_version);
    printf(
        "limits    %lld vertex and %lld fragment uniform components, uniform blocks of "
        "%lld bytes, textures up to %lld, %s\n\n",
        (long long)caps->vertex_uniform_components,
        (long long)caps->fragment_uniform_components, (long long)caps->uniform_block_size,
        (long long)caps->texture_size,
        caps->colour_float  ? "float targets"
        : caps->colour_half ? "half-float targets"
                            : "no float targets");
    printf("Timers, against the wall clock of drained batches of synthetic loads:\n");
    print_timers(driver);
    printf("\nPrecision qualifiers, by chained operations and by values carried:\n");
    print_precision(driver);
    printf("\nNested conditionals in a loop: %d of %d compile and draw right.\n",
           driver->probe.nesting, SB_NESTING_ASKED);
}

int sb_cmd_probe(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct sb_suite suite = {0};
    struct sb_driver driver = {0};
    struct sb_driver_params params;
    const struct sb_suite_params plan = {.set = options->set.item,
                                         .set_count = options->set.count};
    int code = 0;
    if (options->word_count) {
        if (!sb_cli_fail_axis("word", options->word[0], NULL, &err))
            sb_fail(&err, SB_USAGE, "probe takes no words: \"%s\"", options->word[0]);
        return sb_cli_fail(&err);
    }
    if (!sb_suite_load(&plan, &suite, &err) ||
        !sb_cli_driver_params(options, &suite, &params, &err) ||
        !sb_driver_examine(&params, &driver, &err)) {
        code = sb_cli_fail(&err);
        goto done;
    }
    if (options->json) {
        json_t *object = json_object();
        json_object_set_new(object, "caps", sb_caps_json(&driver.caps));
        json_object_set_new(object, "timers", sb_audit_json(&driver));
        json_object_set_new(object, "precision", sb_precision_json(&driver));
        json_object_set_new(object, "nesting", json_integer(driver.probe.nesting));
        json_object_set_new(object, "machine", sb_machine_json());
        json_object_set_new(object, "environment", sb_environment_json());
        sb_cli_print_json(object);
    } else {
        print_driver(&driver);
    }
    if (driver.timer < 0)
        code = sb_status_rows[SB_NO_TIMER].exit_code;

done:
    sb_driver_close(&driver);
    sb_suite_free(&suite);
    return code;
}
