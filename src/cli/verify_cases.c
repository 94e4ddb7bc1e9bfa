// shadebench verify without --classes: the hard cases, their breaking points, what their guards
// cost, and a search for more.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/words.h"
#include "cases/crew.h"
#include "cli/verify.h"
#include "measure/interrupt.h"
#include "results/row_file.h"

// --- the command line ---------------------------------------------------------------------

// "naive,robust" as bits of places in `names`; NULL: 0.
static bool read_set(const char *option, const char *list, const char *const *names,
                     int count, unsigned *set, struct sb_arena *arena,
                     struct sb_error *err)
{
    char *rest = list ? sb_arena_strdup(arena, list) : NULL;
    for (char *word = rest; word; word = rest) {
        int place = 0;
        rest = strchr(word, ',');
        if (rest)
            *rest++ = '\0';
        while (place < count && strcmp(names[place], word) != 0)
            place++;
        if (place == count) {
            sb_fail_unknown(err, option, "word", word, names, count);
            return false;
        }
        *set |= 1u << place;
    }
    return true;
}

static bool read_number(const char *option, const char *text, double least, double most,
                        bool whole, double *value, struct sb_error *err)
{
    return !text || sb_number_read(option, text, least, most, whole, value, err);
}

static bool read_asked(struct sb_verify *verify, struct sb_error *err)
{
    const struct sb_options *options = verify->options;
    const char *precisions[SB_CASE_PRECISION_COUNT];
    for (int i = 0; i < SB_CASE_PRECISION_COUNT; i++)
        precisions[i] = sb_case_precisions[i].name;
    for (int i = 0; i < options->word_count; i++)
        if (!sb_cases_select(options->word[i], verify->it, &verify->case_count, err))
            return false;
    if (!read_set("--form", options->form, sb_case_form_names, SB_CASE_FORM_COUNT,
                  &verify->forms, &verify->arena, err) ||
        !read_set("--precision", options->precision, precisions, SB_CASE_PRECISION_COUNT,
                  &verify->precisions, &verify->arena, err) ||
        !read_number("--search", options->search, 0.01, 1e6, false, &verify->seconds,
                     err) ||
        !read_number("--seed", options->seed, 0, 9007199254740991.0, true, &verify->seed,
                     err))
        return false;
    if (options->all && options->precision)
        return sb_fail(err, SB_USAGE,
                       "--all asks every precision: leave out --precision %s",
                       options->precision);
    if (options->all)
        verify->precisions = (1u << SB_CASE_PRECISION_COUNT) - 1;
    return true;
}

// Cases say themselves what variant they are asked with: only the platform is the user's.
static bool check_plan(const struct sb_options *options, struct sb_error *err)
{
    const char *given = options->preset        ? "--preset"
                        : options->scene       ? "--scene"
                        : options->sweep.count ? options->sweep.item[0].origin
                        : options->cross.count ? options->cross.item[0].origin
                                               : NULL;
    const struct sb_axes *axes = sb_axes_builtin();
    for (int i = 0; !given && i < options->set.count; i++) {
        const int axis = sb_axes_find(axes, options->set.item[i].axis);
        if (axis >= 0 && axes->row[axis].kind != SB_PLATFORM)
            given = options->set.item[i].origin;
    }
    return !given || sb_fail(err, SB_USAGE,
                             "%s: each case has a variant of its own; only platform axes "
                             "can be set, or a plan verified with --classes",
                             given);
}

static const char *results_dir(struct sb_verify *verify)
{
    char now[32];
    if (verify->options->output)
        return verify->options->output;
    sb_timestamp_name(now);
    return sb_arena_printf(&verify->arena, "shadebench-results/verify-%s", now);
}

static bool open_driver(struct sb_verify *verify, const struct sb_driver_params *params,
                        struct sb_error *err)
{
    verify->env = (struct sb_case_env){sb_axes_builtin(), &verify->driver, verify->data,
                                       verify->options->shaders};
    return sb_driver_connect(params, &verify->driver, err) &&
           sb_driver_probe(&verify->driver, err);
}

static bool is_interrupted(void *user)
{
    (void)user;
    return sb_interrupted();
}

static struct sb_matrix_params matrix_params(const struct sb_verify *verify)
{
    return (struct sb_matrix_params){
        .env = &verify->env,
        .it = verify->it,
        .count = verify->case_count,
        .forms = verify->forms,
        .precisions = verify->precisions,
        .stop = is_interrupted,
    };
}

struct helping {
    struct sb_verify *verify;
    const struct sb_driver_params *params;
};

// In a process of its own. What is wrong with the driver, the first process says.
static void help(void *user, struct sb_crew *crew)
{
    struct helping *helping = user;
    struct sb_error err = {0};
    if (!open_driver(helping->verify, helping->params, &err))
        return;
    struct sb_matrix_params params = matrix_params(helping->verify);
    params.crew = crew;
    sb_matrix_help(&params);
}

// A process for each processor, but for matrices of a few cells.
static void start_crew(struct sb_verify *verify, const struct sb_driver_params *params)
{
    enum { FEW = 4 };
    struct helping helping = {verify, params};
    const bool few = verify->case_count > 0 && verify->case_count < FEW;
    verify->crew = sb_crew_start(few ? 0 : sb_processors() - 1, help, &helping);
}

static bool open_all(struct sb_verify *verify, struct sb_error *err)
{
    struct sb_driver_params params;
    // Where nothing is timed Mesa may keep its shader cache, which most of a second start is. What
    // the user has set stays.
    if (!verify->options->time)
        setenv("MESA_SHADER_CACHE_DISABLE", "false", 0);
    if (!read_asked(verify, err) || !check_plan(verify->options, err) ||
        !sb_cli_load_suite(verify->options, NULL, verify->data, &verify->platform, err) ||
        !sb_cli_driver_params(verify->options, &verify->platform, &params, err))
        return false;
    sb_progress("opening the context and probing its precision");
    verify->dir = results_dir(verify);
    // Timers are audited in the state that a run finds them in, and by a process that is alone.
    if (verify->options->time) {
        verify->env = (struct sb_case_env){sb_axes_builtin(), &verify->driver,
                                           verify->data, verify->options->shaders};
        return sb_driver_examine(&params, &verify->driver, err);
    }
    start_crew(verify, &params);
    return open_driver(verify, &params, err);
}

// --- asking -------------------------------------------------------------------------------

struct asking {
    struct sb_verify *verify;
    struct sb_row_file *file;
    const char *what;
    bool failed; // rows cannot be written: said once, and the rest is asked all the same
    struct sb_error err;
};

static void show_progress(const struct asking *asking, const struct sb_matrix_cell *cell,
                          int count, int total)
{
    char line[200], bar[21];
    for (int i = 0; i < 20; i++)
        bar[i] = i * total < count * 20 ? '#' : '.';
    bar[20] = '\0';
    snprintf(line, sizeof line, "[%s] %s %d of %d, %s %s %s", bar, asking->what, count,
             total, cell->it->id, sb_case_form_names[cell->form],
             sb_case_precisions[cell->precision].name);
    sb_progress(line);
}

static void cell_done(void *user, const struct sb_matrix_cell *cell, int count, int total)
{
    struct asking *asking = user;
    struct sb_arena arena = {0};
    struct sb_case_row row;
    sb_verify_row(asking->verify, cell, &arena, &row);
    if (!asking->failed &&
        !sb_row_file_add(asking->file, &row, 1, sizeof row, &asking->err)) {
        asking->failed = true;
        sb_warn("%s", asking->err.text);
    }
    sb_arena_free(&arena);
    show_progress(asking, cell, count, total);
}

static void broken_done(void *user, const struct sb_matrix_cell *cell, int count,
                        int total)
{
    show_progress(user, cell, count, total);
}

static void worsen(struct sb_verify *verify, int code)
{
    verify->code = sb_exit_code_worse(verify->code, code);
}

static void ask_matrix(struct sb_verify *verify, struct asking *asking)
{
    struct sb_matrix_params params = matrix_params(verify);
    params.crew = verify->crew;
    params.done = cell_done;
    params.user = asking;
    asking->what = "cell";
    sb_matrix_ask(&params, &verify->matrix);
    sb_crew_end(&verify->crew);
    for (int i = 0; i < verify->matrix.count; i++)
        if (!sb_matrix_holds(&verify->matrix.cell[i]))
            worsen(verify, 1);
    params.done = broken_done;
    asking->what = "breaking point";
    if (verify->options->breaking)
        sb_matrix_break(&params, &verify->matrix);
}

// --- the search ---------------------------------------------------------------------------

// The precisions that were asked for; else highp, and half precision as it is to be had.
static unsigned searched_precisions(const struct sb_verify *verify)
{
    const bool real = !sb_case_unavailable(&verify->env, SB_CASE_HALF, false);
    unsigned set = verify->precisions
                       ? verify->precisions
                       : SB_IN_HIGHP | 1u << (real ? SB_CASE_HALF : SB_CASE_EMULATED);
    return real ? set : set & ~(1u << SB_CASE_HALF);
}

static void search_all(struct sb_verify *verify)
{
    const unsigned precisions = searched_precisions(verify);
    int count = 0;
    for (int i = 0; i < SB_CASE_PRECISION_COUNT; i++)
        count += precisions >> i & 1;
    for (int i = 0; i < SB_CASE_PRECISION_COUNT; i++) {
        struct sb_error err = {0};
        if (!(precisions >> i & 1) || sb_interrupted())
            continue;
        struct sb_cli_searched *searched = &verify->searched[verify->searched_count++];
        searched->params = (struct sb_search_params){
            .env = &verify->env,
            .seconds = verify->seconds / count,
            .seed = (uint64_t)verify->seed,
            .form = verify->forms == 1u << SB_CASE_NAIVE ? SB_CASE_NAIVE : SB_CASE_ROBUST,
            .precision = (enum sb_case_precision)i,
            .stop = is_interrupted,
        };
        char line[160];
        snprintf(line, sizeof line, "searching in %s for %.3g s",
                 sb_case_precisions[i].name, searched->params.seconds);
        sb_progress(line);
        if (!sb_search(&searched->params, &searched->findings, &err))
            worsen(verify, sb_cli_fail(&err));
        if (searched->findings.count)
            worsen(verify, 1);
    }
}

// --- prices -------------------------------------------------------------------------------

static json_t *arguments_json(int argc, char **argv)
{
    json_t *list = json_array();
    for (int i = 1; i < argc; i++)
        json_array_append_new(list, json_string(argv[i]));
    return list;
}

static void price_guards(struct sb_verify *verify, int argc, char **argv)
{
    struct sb_error err = {0};
    if (!sb_prices_find(&verify->env, verify->it, verify->case_count,
                        &verify->platform.entry[0].variant, &verify->prices, &err)) {
        sb_warn("%s", err.text);
        return;
    }
    json_t *arguments = arguments_json(argc, argv);
    const struct sb_prices_params params = {
        .driver = &verify->driver,
        .timer = verify->options->timer,
        .data_dir = verify->data,
        .shaders = verify->options->shaders,
        .dir = sb_path_join(&verify->arena, verify->dir, "time"),
        .scene = "containers",
        .seed = verify->seed,
        .rounds = 120,
        .budget = 300,
        .arguments = arguments,
    };
    verify->priced = sb_prices_measure(&verify->prices, &params, &err);
    json_decref(arguments);
    if (!verify->priced)
        worsen(verify, sb_cli_fail(&err));
    else if (verify->prices.exit_code)
        worsen(verify, verify->prices.exit_code);
    sb_prices_apply(&verify->prices, &verify->matrix);
}

// --- all of it ----------------------------------------------------------------------------

// Breaking points and prices are known last, and stand in the rows of cells asked long before.
static bool rewrite_rows(struct sb_verify *verify, struct sb_row_file *file,
                         struct sb_error *err)
{
    const int count = verify->matrix.count;
    struct sb_case_row *row = sb_alloc(((size_t)count + 1) * sizeof *row);
    for (int i = 0; i < count; i++)
        sb_verify_row(verify, &verify->matrix.cell[i], &verify->arena, &row[i]);
    const bool good = sb_row_file_replace(file, row, count, sizeof *row, err);
    free(row);
    return good;
}

static bool write_files(struct sb_verify *verify, const struct asking *asking,
                        struct sb_error *err)
{
    // Cells of a crew come in any order, too.
    const bool later =
        verify->options->breaking || verify->options->time || verify->matrix.count > 1;
    if (asking->failed)
        *err = asking->err;
    return !asking->failed && (!later || rewrite_rows(verify, asking->file, err)) &&
           sb_verify_write_junit(verify, err);
}

static void verify_all(struct sb_verify *verify, int argc, char **argv,
                       struct sb_row_file *file)
{
    struct sb_error err = {0};
    struct asking asking = {.verify = verify, .file = file};
    ask_matrix(verify, &asking);
    if (verify->seconds > 0)
        search_all(verify);
    if (verify->options->time && !sb_interrupted())
        price_guards(verify, argc, argv);
    sb_progress("");
    if (sb_interrupted())
        worsen(verify, sb_status_rows[SB_INTERRUPTED].exit_code);
    if (!write_files(verify, &asking, &err))
        worsen(verify,
               asking.failed ? sb_status_rows[err.status].exit_code : sb_cli_fail(&err));
    if (verify->options->json)
        sb_cli_print_json(sb_verify_json(verify));
    else
        sb_verify_print(verify);
}

static struct sb_row_file *open_file(const char *dir, struct sb_error *err)
{
    return sb_row_file_open(&(struct sb_row_file_params){dir, "cases.csv",
                                                         sb_case_columns,
                                                         sb_case_column_count},
                            err);
}

int sb_cli_verify_cases(const struct sb_options *options, int argc, char **argv,
                        const char *data, struct sb_error *err)
{
    struct sb_verify *verify = sb_alloc(sizeof *verify);
    struct sb_row_file *file = NULL;
    *verify = (struct sb_verify){.options = options, .data = data, .seed = 1};
    sb_interrupt_install();
    if (open_all(verify, err) && (file = open_file(verify->dir, err)))
        verify_all(verify, argc, argv, file);
    else
        verify->code = sb_cli_fail(err);
    const int code = verify->code;
    sb_crew_end(&verify->crew);
    sb_row_file_close(&file);
    for (int i = 0; i < verify->searched_count; i++)
        sb_findings_free(&verify->searched[i].findings);
    sb_prices_free(&verify->prices);
    sb_matrix_free(&verify->matrix);
    sb_driver_close(&verify->driver);
    sb_suite_free(&verify->platform);
    sb_arena_free(&verify->arena);
    free(verify);
    return code;
}
