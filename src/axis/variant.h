// A variant: one value on every axis. Plain data: copied, compared, hashed, sent.
#pragma once

#include "axis/axis.h"

struct sb_variant {
    double value[SB_AXIS_MAX]; // a number, or a place in `values`
    uint64_t given[2]; // bit i: asked for by name; the rest follow shorthand, init
};

// Every axis at init, none given.
void sb_variant_init(const struct sb_axes *axes, struct sb_variant *v);

// Sets one axis by word ("vertex", "64") and marks it given. An unknown word, a number out
// of [min, max], a fraction where whole numbers are wanted: SB_BAD_INPUT with the word and
// the valid ones. A value flagged SB_TODO: SB_NOT_IMPLEMENTED.
bool sb_variant_set(const struct sb_axes *axes, struct sb_variant *v, int axis,
                    const char *word, struct sb_error *err);

// Sets one axis by value, marks it given, no check of flags (for programs, not for input).
void sb_variant_put(struct sb_variant *v, int axis, double value);
bool sb_variant_given(const struct sb_variant *v, int axis);

// Expands shorthand into the axes that were not given, sets moot axes to init, then checks
// `needs` and SB_TODO; a variant that fails these checks is expanded all the same, so that
// `exclude` can be asked about it. Moot axes keep their given bit. After it variants are
// equal when equal on all axes but shorthand; an equivalence class leaves out the
// implementation axes too.
bool sb_variant_resolve(const struct sb_axes *axes, struct sb_variant *v,
                        struct sb_error *err);

// The rest of sb_variant_resolve, of a variant that was resolved once and then changed: shorthand is
// not looked at again, so that terms keep what they have.
bool sb_variant_settle(const struct sb_axes *axes, struct sb_variant *v,
                       struct sb_error *err);

// Is a value of some axis for accuracy only (SB_UNTIMED), so that the variant has no time?
bool sb_variant_untimed(const struct sb_axes *axes, const struct sb_variant *v);

bool sb_variant_moot(const struct sb_axes *axes, const struct sb_variant *v, int axis);
bool sb_variant_equal(const struct sb_axes *axes, const struct sb_variant *a,
                      const struct sb_variant *b);
bool sb_variant_same_class(const struct sb_axes *axes, const struct sb_variant *a,
                           const struct sb_variant *b);

// A hash of what sb_variant_equal compares.
uint64_t sb_variant_hash(const struct sb_axes *axes, const struct sb_variant *v);

// The value as a word or number; "" where the axis is moot.
void sb_variant_value_text(const struct sb_axes *axes, const struct sb_variant *v,
                           int axis, struct sb_text *text);

// The id: `axis=value` of the given, non-moot axes in table order, joined by commas;
// "default" where there are none. The same words in any order give the same id.
void sb_variant_id(const struct sb_axes *axes, const struct sb_variant *v,
                   struct sb_text *text);

// Conditions: `axis op value` with op one of = != < <= > >=; `,` is and, `|` is or and binds
// weaker. Ordered operators are for numbers only. The empty condition holds; one that
// sb_condition_check refuses does not.
bool sb_condition_check(const struct sb_axes *axes, const char *condition,
                        struct sb_error *err);
bool sb_condition_holds(const struct sb_axes *axes, const char *condition,
                        const struct sb_variant *v);
