// shadebench show --effects: what the draws of a scene call for, and why the rest is left out.
// Needs no GL.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/show.h"
#include "effects/calls.h"

struct shown {
    const struct sb_axes *axes;
    const struct sb_plan_entry *entry;
    struct sb_scene scene;
    struct sb_analysis analysis;
    int lit; // draws that show no lamp
};

// --- what is left out --------------------------------------------------------------------

static bool same_decision(const struct sb_decision *a, const struct sb_decision *b)
{
    return strcmp(a->what, b->what) == 0 && strcmp(a->why, b->why) == 0;
}

// Draws of one decision are told together, at the first of them. 0: not the first.
static int draws_of(const struct sb_analysis *analysis, int place)
{
    const struct sb_decision *decision = analysis->decision;
    int draws = 0;
    for (int i = 0; i < place; i++)
        if (same_decision(&decision[i], &decision[place]))
            return 0;
    for (int i = place; i < analysis->decision_count; i++)
        draws += same_decision(&decision[i], &decision[place]);
    return draws;
}

static void print_left_out(const struct shown *it)
{
    const struct sb_analysis *analysis = &it->analysis;
    for (int i = 0; i < analysis->decision_count; i++) {
        const struct sb_decision *decision = &analysis->decision[i];
        const int draws = draws_of(analysis, i);
        if (draws == it->lit)
            printf("  %s: left out everywhere: %s\n", decision->what, decision->why);
        else if (draws > 0)
            printf("  %s: left out of %d of %d draws: %s\n", decision->what, draws,
                   it->lit, decision->why);
    }
    if (analysis->decision_count == 0)
        printf("  nothing is left out\n");
}

static json_t *left_out_json(const struct shown *it)
{
    json_t *list = json_array();
    for (int i = 0; i < it->analysis.decision_count; i++) {
        const struct sb_decision *decision = &it->analysis.decision[i];
        json_array_append_new(list, json_pack("{sisssssi}", "draw", decision->draw,
                                              "what", decision->what, "why",
                                              decision->why, "light", decision->light));
    }
    return list;
}

// --- what stays ----------------------------------------------------------------------------

static bool same_calls(const struct sb_axes *axes, const struct sb_calls *a,
                       const struct sb_calls *b)
{
    return a->effects == b->effects && sb_variant_equal(axes, &a->variant, &b->variant);
}

static void add_calls(const struct sb_calls *calls, struct sb_text *text)
{
    bool any = false;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        if (calls->light_count[t] > 0) {
            sb_text_printf(text, "%s%d %s%s", any ? ", " : "", calls->light_count[t],
                           sb_light_structs[t].name,
                           calls->light_count[t] > 1 ? "s" : "");
            any = true;
        }
    sb_text_add(text, any ? ":" : "no light:");
    for (int e = 0; e < SB_EFFECT_COUNT; e++)
        if (calls->effects >> e & 1)
            sb_text_printf(text, " %s", sb_effect_rows[e].name);
    const int casters = sb_calls_casters(calls);
    if (casters > 0)
        sb_text_printf(text, " shadows of %d", casters);
    if (calls->effects == 0)
        sb_text_add(text, " nothing");
}

static void print_calls(const struct shown *it)
{
    const struct sb_analysis *analysis = &it->analysis;
    bool *told = sb_alloc((size_t)analysis->draw_count + 1);
    struct sb_text text = {0};
    add_calls(&analysis->scene, &text);
    printf("  the scene calls for %s\n", sb_text_get(&text));
    for (int d = 0; d < analysis->draw_count; d++) {
        int draws = 0;
        if (told[d] || it->scene.draw[d].lamp >= 0)
            continue;
        for (int i = d; i < analysis->draw_count; i++)
            if (it->scene.draw[i].lamp < 0 &&
                same_calls(it->axes, &analysis->draw[d], &analysis->draw[i])) {
                told[i] = true;
                draws++;
            }
        sb_text_clear(&text);
        add_calls(&analysis->draw[d], &text);
        printf("  %d draw%s, from number %d on, call for %s\n", draws,
               draws > 1 ? "s" : "", d, sb_text_get(&text));
    }
    sb_text_free(&text);
    free(told);
}

static json_t *calls_json(const struct sb_calls *calls)
{
    json_t *object = json_object(), *effects = json_array(), *lights = json_array();
    int total = 0;
    for (int e = 0; e < SB_EFFECT_COUNT; e++)
        if (calls->effects >> e & 1)
            json_array_append_new(effects, json_string(sb_effect_rows[e].name));
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        total += calls->light_count[t];
    for (int i = 0; i < total; i++)
        json_array_append_new(lights, json_integer(calls->light[i]));
    json_object_set_new(object, "lights", lights);
    json_object_set_new(object, "casters", json_integer(sb_calls_casters(calls)));
    json_object_set_new(object, "effects", effects);
    return object;
}

static json_t *draws_json(const struct shown *it)
{
    json_t *list = json_array();
    for (int d = 0; d < it->analysis.draw_count; d++)
        if (it->scene.draw[d].lamp < 0) {
            json_t *object = calls_json(&it->analysis.draw[d]);
            json_object_set_new(object, "draw", json_integer(d));
            json_array_append_new(list, object);
        }
    return list;
}

// --- one entry -----------------------------------------------------------------------------

static bool look(struct shown *it, struct sb_error *err)
{
    if (!sb_scene_make(it->entry->scene, &it->entry->variant, &it->scene, err))
        return false;
    sb_analyse(&(struct sb_analysis_params){.axes = it->axes,
                                            .variant = &it->entry->variant,
                                            .scene = &it->scene,
                                            .explain = true},
               &it->analysis);
    for (int d = 0; d < it->scene.draw_count; d++)
        it->lit += it->scene.draw[d].lamp < 0;
    return true;
}

static bool show_entry(const struct sb_suite *suite, const struct sb_plan_entry *entry,
                       json_t *list, struct sb_error *err)
{
    struct shown it = {.axes = &suite->axes, .entry = entry};
    const bool good = look(&it, err);
    if (good && list) {
        json_array_append_new(
            list, json_pack("{sssssososo}", "scene", entry->scene, "variant", entry->id,
                            "scene_calls", calls_json(&it.analysis.scene), "draws",
                            draws_json(&it), "left_out", left_out_json(&it)));
    } else if (good) {
        printf("%s, %s: %d draws\n", entry->scene, entry->id, it.lit);
        if (sb_lights_total(&it.scene.lights) == 0)
            printf("  no light is asked for: --set point=4, or dir, spot, area\n");
        print_left_out(&it);
        print_calls(&it);
        printf("\n");
    }
    sb_analysis_free(&it.analysis);
    sb_scene_free(&it.scene);
    return good;
}

// Entries that differ only in how they are drawn call for the same.
static bool was_shown(const struct sb_suite *suite, int place)
{
    const struct sb_plan_entry *entry = &suite->entry[place];
    for (int i = 0; i < place; i++)
        if (strcmp(suite->entry[i].scene, entry->scene) == 0 &&
            sb_variant_same_class(&suite->axes, &suite->entry[i].variant,
                                  &entry->variant))
            return true;
    return false;
}

bool sb_show_effects(const struct sb_options *options, const struct sb_suite *suite,
                     struct sb_error *err)
{
    json_t *list = options->json ? json_array() : NULL;
    bool good = true;
    for (int i = 0; good && i < suite->entry_count; i++)
        if (!was_shown(suite, i))
            good = show_entry(suite, &suite->entry[i], list, err);
    if (good && list)
        sb_cli_print_json(json_incref(list));
    json_decref(list);
    return good;
}
