// shadebench explain: one pixel of a variant, with everything that was computed on the way.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "cli/common.h"
#include "cli/explain_json.h"
#include "measure/explain.h"

// "211,97"
static bool read_pixel(const char *text, int *x, int *y, struct sb_error *err)
{
    char rest;
    if (text && sscanf(text, "%d,%d%c", x, y, &rest) == 2)
        return true;
    return sb_fail(
        err, SB_USAGE,
        text ? "--pixel %s: X,Y is wanted, counted from the lower left, such as "
               "--pixel 128,96"
             : "explain: which pixel? --pixel X,Y, counted from the lower left",
        text);
}

// --- text: the JSON, line by line ---------------------------------------------------------

static void print_number(const json_t *value)
{
    if (json_is_integer(value))
        printf("  %lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        printf("  %.17g", json_real_value(value));
    else if (json_is_string(value))
        printf("  %s", json_string_value(value));
    else
        printf("  %s", json_is_true(value) ? "yes" : json_is_false(value) ? "no" : "-");
}

static bool is_flat(const json_t *value)
{
    size_t i;
    json_t *item;
    if (json_is_object(value))
        return false;
    json_array_foreach(value, i, item) if (json_is_object(item) ||
                                           json_is_array(item)) return false;
    return true;
}

static void print_value(const json_t *value)
{
    size_t i;
    json_t *item;
    if (!json_is_array(value))
        print_number(value);
    json_array_foreach(value, i, item) print_number(item);
}

// A term of a light: what the reference and the driver have of it, component by component.
static void print_term(const char *name, const json_t *term, int indent)
{
    const json_t *reference = json_object_get(term, "reference");
    const json_t *driver = json_object_get(term, "driver");
    for (size_t i = 0; i < json_array_size(reference); i++) {
        char ulps[32] = "";
        const json_t *off = json_object_get(term, "ulps");
        if (i == 0 && json_is_real(off))
            snprintf(ulps, sizeof ulps, "%.3g", json_real_value(off));
        else if (i == 0)
            snprintf(ulps, sizeof ulps, "%s", json_string_value(off));
        const json_t *value[2] = {json_array_get(reference, i),
                                  json_array_get(driver, i)};
        printf("%*s%-16s", indent, "", i == 0 ? name : "");
        for (int k = 0; k < 2; k++)
            if (json_is_real(value[k]))
                printf(" %25.17g", json_real_value(value[k]));
            else
                printf(" %25s", json_string_value(value[k]));
        if (i == 0)
            printf(" %10s %5lld\n", ulps,
                   (long long)json_integer_value(json_object_get(term, "bits")));
        else
            putchar('\n');
    }
}

static void print_tree(const json_t *object, int indent)
{
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)object, name, value)
    {
        size_t i;
        json_t *item;
        if (json_object_get(value, "reference") && json_object_get(value, "ulps")) {
            print_term(name, value, indent);
        } else if (is_flat(value)) {
            printf("%*s%-16s", indent, "", name);
            print_value(value);
            putchar('\n');
        } else if (json_is_object(value)) {
            printf("%*s%s\n", indent, "", name);
            if (strcmp(name, "terms") == 0)
                printf("%*s%-16s %25s %25s %10s %5s\n", indent + 2, "", "", "reference",
                       "driver", "ulps", "bits");
            print_tree(value, indent + 2);
        } else {
            json_array_foreach(value, i, item)
            {
                printf("%*s%s %zu\n", indent, "", name, i);
                print_tree(item, indent + 2);
            }
        }
    }
}

// --- the command --------------------------------------------------------------------------

static bool explain(const struct sb_options *options, const struct sb_suite *suite,
                    const struct sb_driver *driver, const char *data, int x, int y,
                    struct sb_error *err)
{
    const struct sb_prepare_params prepare = {
        .suite = suite,
        .driver = driver,
        .data_dir = data,
        .shaders = options->shaders,
    };
    struct sb_task task = {.entry = &suite->entry[0]};
    struct sb_truths *truths = sb_truths_new(&suite->axes);
    struct sb_explanation explanation = {0};
    sb_task_prepare(&task, &prepare, 1);
    bool good = task.loaded;
    if (!good)
        sb_fail(err, task.status, "%s", sb_text_get(&task.note));
    const struct sb_explain_params params = {
        .task = &task,
        .driver = driver,
        .truths = truths,
        .x = x,
        .y = y,
    };
    good = good && sb_explain(&params, &explanation, err);
    if (good) {
        json_t *json = sb_explanation_json(&explanation, &task, driver);
        if (options->json) {
            sb_cli_print_json(json);
        } else {
            print_tree(json, 0);
            json_decref(json);
        }
    }
    sb_explanation_free(&explanation);
    sb_truths_free(&truths);
    sb_task_free(&task, driver);
    return good;
}

int sb_cmd_explain(const struct sb_options *given, int argc, char **argv)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_options options = *given;
    struct sb_suite suite = {0};
    struct sb_driver_params params;
    struct sb_driver driver = {0};
    int x = 0, y = 0;
    (void)argc, (void)argv;
    const char *data = sb_data_dir(&arena, options.data, &err);
    bool good = data && read_pixel(options.pixel, &x, &y, &err);
    if (good && options.word_count > 1)
        good =
            sb_fail(&err, SB_USAGE, "explain takes one variant; \"%s\" is one too many",
                    options.word[1]);
    if (good && options.word_count == 1)
        good = sb_cli_add_variant(options.word[0], &options, &arena, &err);
    good = good && sb_cli_load_suite(&options, NULL, data, &suite, &err);
    if (good && suite.entry_count != 1)
        good = sb_fail(&err, SB_USAGE, "explain takes one variant, not %d",
                       suite.entry_count);
    good = good && sb_cli_driver_params(&options, &suite, &params, &err) &&
           sb_driver_connect(&params, &driver, &err) && sb_driver_probe(&driver, &err) &&
           explain(&options, &suite, &driver, data, x, y, &err);
    const int code = good ? 0 : sb_cli_fail(&err);
    sb_driver_close(&driver);
    sb_suite_free(&suite);
    sb_arena_free(&arena);
    return code;
}
