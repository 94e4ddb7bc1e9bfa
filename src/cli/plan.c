// shadebench plan: which programs serve many light counts best. Nothing is measured.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/plan_costs.h"
#include "base/file.h"
#include "cli/compare.h"
#include "cli/table.h"
#include "results/csv.h"
#include "scene/lights.h"

enum { PROGRAMS_MAX = 64, DEMANDS_MAX = 1000 };
#define STOPS_PAYING 0.01 // share that one more program must save

struct planning {
    const struct sb_options *options;
    struct sb_demand *demand;
    int demand_count, demand_capacity;
    int programs; // asked for
    struct sb_compared compared;
    struct sb_plan_costs *costs;
    struct sb_plan *plan;
    struct sb_arena arena;
};

// --- demands -----------------------------------------------------------------------------

// Equal ones add up.
static bool add_demand(struct planning *it, const struct sb_demand *demand,
                       struct sb_error *err)
{
    for (int i = 0; i < it->demand_count; i++)
        if (memcmp(it->demand[i].count, demand->count, sizeof demand->count) == 0) {
            it->demand[i].weight += demand->weight;
            return true;
        }
    if (it->demand_count == DEMANDS_MAX)
        return sb_fail(err, SB_BAD_INPUT, "more than %d different demands", DEMANDS_MAX);
    it->demand =
        sb_grow(it->demand, it->demand_count, &it->demand_capacity, sizeof *it->demand);
    it->demand[it->demand_count++] = *demand;
    return true;
}

static bool read_cell(const char *path, int line, const char *name, const char *word,
                      bool whole, double *value, struct sb_error *err)
{
    if (sb_number_read(name, word, 0, whole ? 256 : 1e12, whole, value, err))
        return true;
    return sb_fail(err, SB_BAD_INPUT, "%s:%d: %s", path, line, err->text);
}

// Which type a column counts, SB_PLAN_TYPES for the weight, -1 for none of these.
static int column_of(const char *name)
{
    const struct sb_axes *axes = sb_axes_builtin();
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        if (strcmp(axes->row[sb_light_structs[t].axis].name, name) == 0)
            return t;
    return strcmp(name, "weight") == 0 ? SB_PLAN_TYPES : -1;
}

static bool read_line(struct planning *it, const char *path, const struct sb_csv *csv,
                      int line, struct sb_error *err)
{
    struct sb_demand demand = {.weight = 1};
    for (int c = 0; c < csv->column_count; c++) {
        const char *name = csv->cell[0][c], *word = csv->cell[line][c];
        const int column = column_of(name);
        double value;
        if (!*word)
            continue;
        if (!read_cell(path, line + 1, name, word, column < SB_PLAN_TYPES, &value, err))
            return false;
        if (column < SB_PLAN_TYPES)
            demand.count[column] = (int)value;
        else
            demand.weight = value;
    }
    return demand.weight <= 0 || add_demand(it, &demand, err);
}

static bool check_column(const char *path, const struct sb_csv *csv, int column,
                         struct sb_error *err)
{
    const char *name = csv->cell[0][column];
    if (column_of(name) < 0)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s:1: unknown column \"%s\"; valid: dir point spot area weight",
                       path, name);
    if (sb_csv_column(csv, name) != column)
        return sb_fail(err, SB_BAD_INPUT, "%s:1: column \"%s\" stands there twice", path,
                       name);
    return true;
}

static bool read_demands(struct planning *it, const char *path, struct sb_error *err)
{
    struct sb_csv csv = {0};
    bool good = sb_csv_read(path, &csv, err);
    for (int c = 0; good && c < csv.column_count; c++)
        good = check_column(path, &csv, c, err);
    for (int line = 1; good && line < csv.row_count; line++)
        good = read_line(it, path, &csv, line, err);
    if (good && it->demand_count == 0)
        good = sb_fail(err, SB_BAD_INPUT,
                       "%s: no demand has a weight; lines of light counts with weights "
                       "above 0 are wanted",
                       path);
    sb_csv_free(&csv);
    return good;
}

// The light counts of the entries of a suite, or of a preset, each as often as it stands there.
static bool take_suite(struct planning *it, const char *word, struct sb_error *err)
{
    struct sb_suite suite = {0};
    struct sb_options options = *it->options;
    struct sb_arena *arena = &it->arena;
    const char *data = sb_data_dir(arena, options.data, err), *path = NULL;
    if (!data)
        return false;
    const char *preset = sb_arena_printf(arena, "%s/bench/presets/%s.yaml", data, word);
    if (sb_file_exists(preset))
        options.preset = word;
    else if (!(path = sb_cli_suite_path(word, data, arena, err)))
        return false;
    bool good = sb_cli_load_suite(&options, path, data, &suite, err);
    for (int i = 0; good && i < suite.entry_count; i++) {
        struct sb_demand demand = {.weight = 1};
        for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
            demand.count[t] =
                sb_lights_shining(&suite.entry[i].variant, (enum sb_light_type)t);
        good = add_demand(it, &demand, err);
    }
    sb_suite_free(&suite);
    return good;
}

static bool take_demands(struct planning *it, struct sb_error *err)
{
    const struct sb_options *options = it->options;
    if (options->word_count == 0 && !options->demands)
        return sb_fail(err, SB_USAGE,
                       "plan for what? SUITE, whose light counts are the demands, or "
                       "--demands FILE.csv with columns dir, point, spot, area, weight");
    for (int i = 0; i < options->word_count; i++)
        if (!take_suite(it, options->word[i], err))
            return false;
    return !options->demands || read_demands(it, options->demands, err);
}

// --- costs ---------------------------------------------------------------------------------

static bool find_axis(const struct sb_axes *axes, const char *name, int *axis,
                      struct sb_error *err)
{
    *axis = sb_axes_expect(axes, name, err);
    return *axis >= 0;
}

static bool load_costs(struct planning *it, struct sb_error *err)
{
    static const char *const loops[SB_PLAN_KINDS] = {"constant", "dynamic", "padded"};
    if (!it->options->costs)
        return sb_fail(err, SB_USAGE,
                       "plan wants --costs RESULTS: a results folder of shadebench run "
                       "plan, or of another suite with light counts in several loops");
    if (!sb_results_load(it->options, it->options->costs, &it->compared, &it->arena, err))
        return false;
    const struct sb_axes *axes = it->compared.axes;
    struct sb_plan_costs_params params = {
        .axes = axes, .row = it->compared.rows.row, .count = it->compared.rows.count};
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        params.count_axis[t] = sb_light_structs[t].axis;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) // sb_lights_slots
        params.padded[t] = t != SB_LIGHT_DIR;
    if (!find_axis(axes, "loop", &params.loop_axis, err) ||
        !find_axis(axes, "capacity", &params.capacity_axis, err))
        return false;
    for (int k = 0; k < SB_PLAN_KINDS; k++)
        params.loop_value[k] = sb_axis_value_find(&axes->row[params.loop_axis], loops[k]);
    it->costs = sb_plan_costs_new(&params, err);
    if (!it->costs)
        return sb_fail(err, err->status, "%s: %s", it->compared.path, err->text);
    return true;
}

static double cost(void *user, const struct sb_plan_program *program,
                   const struct sb_demand *demand)
{
    return sb_plan_cost(user, program, demand, NULL);
}

// The first type of which more, or fewer, are wanted than any kind of loop was measured with.
static const char *unknown_type(const struct planning *it, const struct sb_demand *demand)
{
    for (int t = 0; t < SB_PLAN_TYPES; t++) {
        bool known = false;
        for (int k = 0; k < SB_PLAN_KINDS; k++) {
            const struct sb_plan_line *line =
                sb_plan_costs_line(it->costs, (enum sb_plan_kind)k);
            known |= line->rows >= 2 && demand->count[t] >= line->least[t] &&
                     demand->count[t] <= line->most[t];
        }
        if (!known)
            return sb_light_structs[t].name;
    }
    return "light";
}

// Every demand must have a cost in some program: what was not measured is not made up.
static bool check_served(const struct planning *it, struct sb_error *err)
{
    for (int d = 0; d < it->demand_count; d++) {
        bool served = false;
        for (int p = 0; !served && p < sb_plan_candidates(it->plan); p++)
            served = sb_plan_server(it->plan, &p, 1, d) >= 0;
        const int *count = it->demand[d].count;
        if (!served)
            return sb_fail(err, SB_BAD_INPUT,
                           "%s: nothing measured tells what dir=%d point=%d spot=%d "
                           "area=%d costs; measure as few and as many of each %s as are "
                           "wanted",
                           it->compared.path, count[0], count[1], count[2], count[3],
                           unknown_type(it, &it->demand[d]));
    }
    return true;
}

// --- telling -------------------------------------------------------------------------------

static void program_text(const struct sb_plan_program *program, struct sb_text *text)
{
    static const char *const names[SB_PLAN_TYPES] = {"dir", "point", "spot", "area"};
    bool any = false;
    sb_text_printf(text, "%s(", sb_plan_kind_words[program->kind]);
    for (int t = 0; t < SB_PLAN_TYPES; t++)
        if (program->capacity[t] > 0) {
            sb_text_printf(text, "%s%s %d", any ? ", " : "", names[t],
                           program->capacity[t]);
            any = true;
        }
    sb_text_add(text, any ? ")" : "no light)");
}

struct step {
    int chosen[PROGRAMS_MAX];
    double ms, least; // least: NAN, not looked for
};

static void programs_text(const struct planning *it, const struct step *step, int count,
                          struct sb_text *text)
{
    for (int i = 0; i < count; i++) {
        sb_text_add(text, i ? " " : "");
        program_text(sb_plan_candidate(it->plan, step->chosen[i]), text);
    }
}

static void print_head(const struct planning *it)
{
    const struct sb_row *row = sb_plan_costs_first(it->costs);
    double weight = 0;
    for (int d = 0; d < it->demand_count; d++)
        weight += it->demand[d].weight;
    printf("%d demands of weight %g, %d programs to choose from\ncosts: %s on %s, timer "
           "%s\n",
           it->demand_count, weight, sb_plan_candidates(it->plan), row->scene,
           row->renderer ? row->renderer : "?",
           row->timer_source ? row->timer_source : "?");
    for (int k = 0; k < SB_PLAN_KINDS; k++) {
        const struct sb_plan_line *line =
            sb_plan_costs_line(it->costs, (enum sb_plan_kind)k);
        if (line->rows > 0)
            printf("  %s: %d rows; between them %.3g ms, and a light %.3g %.3g %.3g %.3g "
                   "ms (dir point spot area); rows are off by up to %.0f %%\n",
                   sb_plan_kind_words[k], line->rows, line->floor, line->price[0],
                   line->price[1], line->price[2], line->price[3], 100 * line->worst);
    }
    printf("\n");
}

static double saves(const struct step *step, int k)
{
    return k > 0 && isfinite(step[k - 1].ms) ? 1 - step[k].ms / step[k - 1].ms
                                             : (double)NAN;
}

// The last number of programs of which the last one saves enough.
static int pays_up_to(const struct step *step, int steps)
{
    int pays = 1;
    for (int k = 1; k < steps; k++)
        if (!(saves(step, k) < STOPS_PAYING))
            pays = k + 1;
    return pays;
}

static void print_steps(const struct planning *it, const struct step *step, int steps)
{
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    const int pays = pays_up_to(step, steps);
    sb_table_column(table, "programs", true);
    sb_table_column(table, "ms", true);
    sb_table_column(table, "saves", true);
    if (it->options->exhaustive)
        sb_table_column(table, "best of all", true);
    sb_table_column(table, "which", false);
    for (int k = 0; k < steps; k++) {
        const bool all = isfinite(step[k].ms);
        sb_text_clear(&text);
        programs_text(it, &step[k], k + 1, &text);
        sb_table_cellf(table, "%d", k + 1);
        sb_table_real(table, "%.3f", all ? step[k].ms : (double)NAN);
        sb_table_real(table, "%.1f %%", 100 * saves(step, k));
        if (it->options->exhaustive)
            sb_table_real(table, "%.3f", step[k].least);
        sb_table_cell(table, all ? sb_text_get(&text) : "none that serve all demands");
    }
    sb_table_print(table);
    if (pays < steps)
        printf("\nbeyond %d program%s another one saves less than %.0f %%\n", pays,
               pays > 1 ? "s" : "", 100 * STOPS_PAYING);
    sb_text_free(&text);
    sb_table_free(&table);
}

// Who draws what, with the last choice.
static void print_demands(const struct planning *it, const struct step *step, int count)
{
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    static const char *const titles[] = {"dir", "point", "spot", "area", "weight", "ms"};
    for (int i = 0; i < 6; i++)
        sb_table_column(table, titles[i], true);
    sb_table_column(table, "known", false);
    sb_table_column(table, "drawn by", false);
    for (int d = 0; d < it->demand_count; d++) {
        const int server = sb_plan_server(it->plan, step->chosen, count, d);
        if (server < 0) // so many programs cannot serve all
            continue;
        const struct sb_plan_program *program = sb_plan_candidate(it->plan, server);
        bool measured;
        const double ms = sb_plan_cost(it->costs, program, &it->demand[d], &measured);
        for (int t = 0; t < SB_PLAN_TYPES; t++)
            sb_table_cellf(table, "%d", it->demand[d].count[t]);
        sb_table_real(table, "%g", it->demand[d].weight);
        sb_table_real(table, "%.3f", ms);
        sb_table_cell(table, measured ? "measured" : "modelled");
        sb_text_clear(&text);
        program_text(program, &text);
        sb_table_cell(table, sb_text_get(&text));
    }
    printf("\nwith %d program%s:\n", count, count > 1 ? "s" : "");
    sb_table_print(table);
    sb_text_free(&text);
    sb_table_free(&table);
}

static json_t *program_json(const struct sb_plan_program *program)
{
    return json_pack("{sssisisisi}", "kind", sb_plan_kind_words[program->kind], "dir",
                     program->capacity[0], "point", program->capacity[1], "spot",
                     program->capacity[2], "area", program->capacity[3]);
}

static json_t *steps_json(const struct planning *it, const struct step *step, int steps)
{
    json_t *list = json_array();
    for (int k = 0; k < steps; k++) {
        json_t *programs = json_array();
        for (int i = 0; i <= k; i++)
            json_array_append_new(
                programs, program_json(sb_plan_candidate(it->plan, step[k].chosen[i])));
        json_t *object = json_pack("{soso}", "ms", sb_compare_number(step[k].ms),
                                   "programs", programs);
        json_object_set_new(object, "saves", sb_compare_number(saves(step, k)));
        if (!isnan(step[k].least))
            json_object_set_new(object, "best_ms", json_real(step[k].least));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *demands_json(const struct planning *it, const struct step *step, int count)
{
    json_t *list = json_array();
    for (int d = 0; d < it->demand_count; d++) {
        const struct sb_demand *demand = &it->demand[d];
        const int server = sb_plan_server(it->plan, step->chosen, count, d);
        bool measured = false;
        json_t *object = json_pack("{sisisisisf}", "dir", demand->count[0], "point",
                                   demand->count[1], "spot", demand->count[2], "area",
                                   demand->count[3], "weight", demand->weight);
        json_array_append_new(list, object);
        if (server < 0)
            continue;
        const struct sb_plan_program *program = sb_plan_candidate(it->plan, server);
        const double ms = sb_plan_cost(it->costs, program, demand, &measured);
        json_object_set_new(object, "ms", sb_compare_number(ms));
        json_object_set_new(object, "measured", json_boolean(measured));
        json_object_set_new(object, "drawn_by", program_json(program));
    }
    return list;
}

// --- the command ---------------------------------------------------------------------------

static bool read_programs(struct planning *it, struct sb_error *err)
{
    double value = 8;
    if (it->options->programs && !sb_number_read("--programs", it->options->programs, 1,
                                                 PROGRAMS_MAX, true, &value, err))
        return false;
    it->programs = (int)value;
    return true;
}

static void choose(struct planning *it, struct step *step, int steps)
{
    for (int k = 0; k < steps; k++) {
        int ignored[PROGRAMS_MAX];
        step[k].ms = sb_plan_choose(it->plan, k + 1, step[k].chosen);
        step[k].least = NAN;
        double least;
        if (it->options->exhaustive && sb_plan_exhaust(it->plan, k + 1, ignored, &least))
            step[k].least = least;
    }
}

static bool make_plan(struct planning *it, struct sb_error *err)
{
    if (!read_programs(it, err) || !take_demands(it, err) || !load_costs(it, err))
        return false;
    struct sb_plan_params params = {
        .demand = it->demand,
        .demand_count = it->demand_count,
        .cost = cost,
        .user = it->costs,
    };
    for (int k = 0; k < SB_PLAN_KINDS; k++)
        params.kind[k] = sb_plan_costs_line(it->costs, (enum sb_plan_kind)k)->rows >= 2;
    it->plan = sb_plan_new(&params);
    return check_served(it, err);
}

int sb_cmd_plan(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct planning it = {.options = options};
    int code = 0;
    if (!make_plan(&it, &err)) {
        code = sb_cli_fail(&err);
    } else {
        const int candidates = sb_plan_candidates(it.plan);
        const int steps = it.programs < candidates ? it.programs : candidates;
        struct step *step = sb_alloc((size_t)steps * sizeof *step);
        choose(&it, step, steps);
        if (options->json) {
            sb_cli_print_json(json_pack("{sososi}", "steps", steps_json(&it, step, steps),
                                        "demands",
                                        demands_json(&it, &step[steps - 1], steps),
                                        "pays_up_to", pays_up_to(step, steps)));
        } else {
            print_head(&it);
            print_steps(&it, step, steps);
            print_demands(&it, &step[steps - 1], steps);
        }
        free(step);
    }
    sb_plan_free(&it.plan);
    sb_plan_costs_free(&it.costs);
    sb_results_free(&it.compared);
    sb_arena_free(&it.arena);
    free(it.demand);
    return code;
}
