#include "cases/price.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "scene/lights.h"

enum { LIGHTS = 8 };

// --- which pairs there are ----------------------------------------------------------------

// What is asked of the variant of a case, made into what is timed.
static bool enlarge(const struct sb_axes *axes, const struct sb_variant *platform,
                    struct sb_variant *variant, struct sb_error *err)
{
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int axis = sb_light_structs[type].axis;
        if (variant->value[axis] > 0)
            sb_variant_put(variant, axis, LIGHTS);
    }
    sb_variant_put(variant, SB_AXIS_WIDTH, 256);
    sb_variant_put(variant, SB_AXIS_HEIGHT, 256);
    for (int a = 0; a < axes->count; a++)
        if (axes->row[a].kind == SB_PLATFORM && sb_variant_given(platform, a))
            sb_variant_put(variant, a, platform->value[a]);
    return sb_variant_resolve(axes, variant, err);
}

static bool is_precision(const struct sb_axis *axis)
{
    return strncmp(axis->name, "p_", 2) == 0 || strcmp(axis->name, "precision") == 0;
}

// The axes that the two differ in. False: there are none whose code has a price of its own.
static bool find_guards(const struct sb_axes *axes, const struct sb_price *price,
                        struct sb_text *guards)
{
    const struct sb_variant *naive = &price->variant[SB_CASE_NAIVE];
    const struct sb_variant *robust = &price->variant[SB_CASE_ROBUST];
    bool priced = false;
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        // What stands for other axes would be told twice.
        if (naive->value[a] == robust->value[a] || sb_axis_is_shorthand(axis))
            continue;
        sb_text_printf(guards, "%s%s", guards->length ? " " : "", axis->name);
        priced = priced || (axis->kind != SB_PLATFORM && !is_precision(axis) &&
                            a != SB_AXIS_TARGET);
    }
    return priced;
}

enum reason { ONE_FORM, ON_CPU, EQUAL, PRECISION, EMULATED, REASON_COUNT };
static const char *const reasons[REASON_COUNT] = {
    [ONE_FORM] = "one form only",
    [ON_CPU] = "cpu: 0 by construction, the GPU runs the same program",
    [EQUAL] = "the same program in highp",
    [PRECISION] = "the forms differ in precision, platform or target only",
    [EMULATED] = "a form is for accuracy only",
};

static void join(struct sb_text *list, const char *word)
{
    sb_text_printf(list, "%s%s", list->length ? ", " : "", word);
}

static struct sb_price *same_pair(const struct sb_axes *axes, struct sb_prices *prices,
                                  const struct sb_price *price)
{
    for (int i = 0; i < prices->count; i++) {
        struct sb_price *other = &prices->row[i];
        if (sb_variant_equal(axes, &other->variant[0], &price->variant[0]) &&
            sb_variant_equal(axes, &other->variant[1], &price->variant[1]))
            return other;
    }
    return NULL;
}

// The reason why the case has no price, or REASON_COUNT.
static enum reason add_case(const struct sb_axes *axes, const struct sb_case *it,
                            struct sb_prices *prices, const struct sb_price *made)
{
    struct sb_price price = *made;
    if (sb_variant_untimed(axes, &price.variant[0]) ||
        sb_variant_untimed(axes, &price.variant[1]))
        return EMULATED;
    if (!find_guards(axes, &price, &price.guards)) {
        const bool equal = price.guards.length == 0;
        sb_text_free(&price.guards);
        return !equal ? PRECISION : it->on_cpu ? ON_CPU : EQUAL;
    }
    struct sb_price *other = same_pair(axes, prices, &price);
    if (other) {
        sb_text_free(&price.guards);
        other->it[other->case_count++] = it;
        return REASON_COUNT;
    }
    price.it[price.case_count++] = it;
    prices->row =
        sb_grow(prices->row, prices->count, &prices->capacity, sizeof *prices->row);
    prices->row[prices->count++] = price;
    return REASON_COUNT;
}

static bool find_case(const struct sb_case_env *env, const struct sb_case *it,
                      const struct sb_variant *platform, struct sb_prices *prices,
                      struct sb_text unpriced[REASON_COUNT], struct sb_error *err)
{
    struct sb_price price = {.vertex = it->stages == SB_IN_VERTEX,
                             .ratio = {NAN, NAN, NAN, 0}};
    enum reason reason = REASON_COUNT;
    if (!it->form[SB_CASE_NAIVE] || !it->form[SB_CASE_ROBUST])
        reason = ONE_FORM;
    else if (it->on_cpu)
        reason = ON_CPU;
    for (int form = 0; reason == REASON_COUNT && form < SB_CASE_FORM_COUNT; form++)
        if (!sb_case_variant(env, it, (enum sb_case_form)form, SB_CASE_HIGHP,
                             price.vertex, NULL, &price.variant[form], err) ||
            !enlarge(env->axes, platform, &price.variant[form], err))
            return false;
    if (reason == REASON_COUNT)
        reason = add_case(env->axes, it, prices, &price);
    if (reason != REASON_COUNT)
        join(&unpriced[reason], it->id);
    return true;
}

bool sb_prices_find(const struct sb_case_env *env, const struct sb_case *const *it,
                    int count, const struct sb_variant *platform,
                    struct sb_prices *prices, struct sb_error *err)
{
    struct sb_text unpriced[REASON_COUNT] = {{0}};
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        for (int i = 0; i < sb_case_families[f]->count; i++) {
            const struct sb_case *one = &sb_case_families[f]->row[i];
            bool asked = count == 0;
            struct sb_error why = {0};
            for (int k = 0; k < count; k++)
                asked = asked || it[k] == one;
            // A variant that this driver cannot have is no reason to price none.
            if (asked && !find_case(env, one, platform, prices, unpriced, &why))
                sb_text_printf(&prices->unpriced, "%s: %s\n", one->id, why.text);
        }
    for (int r = 0; r < REASON_COUNT; r++) {
        if (unpriced[r].length)
            sb_text_printf(&prices->unpriced, "%s: %s\n", reasons[r],
                           sb_text_get(&unpriced[r]));
        sb_text_free(&unpriced[r]);
    }
    return prices->count > 0 ||
           sb_fail(err, SB_BAD_INPUT, "--time: no case that was asked has a price");
}

static bool is_of(const struct sb_price *price, const struct sb_matrix_cell *cell)
{
    if (cell->form != SB_CASE_ROBUST || cell->precision != SB_CASE_HIGHP ||
        cell->vertex != price->vertex)
        return false;
    for (int i = 0; i < price->case_count; i++)
        if (price->it[i] == cell->it)
            return true;
    return false;
}

void sb_prices_apply(const struct sb_prices *prices, struct sb_matrix *matrix)
{
    for (int i = 0; i < matrix->count; i++)
        for (int p = 0; p < prices->count; p++) {
            struct sb_matrix_cell *cell = &matrix->cell[i];
            const struct sb_price *price = &prices->row[p];
            if (!is_of(price, cell))
                continue;
            cell->cost = price->ratio.point;
            cell->cost_lo = price->ratio.lo;
            cell->cost_hi = price->ratio.hi;
        }
}

void sb_prices_free(struct sb_prices *prices)
{
    for (int i = 0; i < prices->count; i++) {
        sb_text_free(&prices->row[i].guards);
        sb_text_free(&prices->row[i].note);
    }
    free(prices->row);
    sb_text_free(&prices->unpriced);
    *prices = (struct sb_prices){0};
}
