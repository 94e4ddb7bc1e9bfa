#include <math.h>
#include <string.h>

#include "axis/variant.h"
#include "base/hash.h"

void sb_variant_init(const struct sb_axes *axes, struct sb_variant *v)
{
    *v = (struct sb_variant){0};
    for (int i = 0; i < axes->count; i++)
        v->value[i] = axes->row[i].init;
}

void sb_variant_put(struct sb_variant *v, int axis, double value)
{
    v->value[axis] = value;
    v->given[axis / 64] |= UINT64_C(1) << axis % 64;
}

bool sb_variant_given(const struct sb_variant *v, int axis)
{
    return v->given[axis / 64] >> axis % 64 & 1;
}

static bool is_implemented(const struct sb_axis *axis, double value)
{
    if (axis->values)
        return !(axis->values[(int)value].flags & SB_TODO);
    return !(axis->flags & SB_TODO) || value == axis->init;
}

static void add_value(const struct sb_axis *axis, double value, struct sb_text *text)
{
    if (axis->values)
        sb_text_add(text, axis->values[(int)value].name);
    else
        sb_text_number(text, value);
}

static bool check_implemented(const struct sb_axis *axis, double value,
                              struct sb_error *err)
{
    if (is_implemented(axis, value))
        return true;
    struct sb_text word = {0}, valid = {0};
    add_value(axis, value, &word);
    if (!axis->values)
        add_value(axis, axis->init, &valid);
    for (int i = 0; i < axis->value_count; i++)
        if (is_implemented(axis, i))
            sb_text_printf(&valid, "%s%s", valid.length ? " " : "", axis->values[i].name);
    sb_fail(err, SB_NOT_IMPLEMENTED, "%s=%s: not implemented yet; implemented: %s",
            axis->name, sb_text_get(&word), valid.length ? sb_text_get(&valid) : "none");
    sb_text_free(&word);
    sb_text_free(&valid);
    return false;
}

static bool read_value(const struct sb_axis *axis, const char *word, double *value,
                       struct sb_error *err)
{
    if (!axis->values)
        return sb_number_read(axis->name, word, axis->min, axis->max,
                              axis->flags & SB_WHOLE, value, err);
    const int place = sb_axis_value_expect(axis, word, err);
    if (place < 0)
        return false;
    *value = place;
    return true;
}

bool sb_variant_set(const struct sb_axes *axes, struct sb_variant *v, int axis,
                    const char *word, struct sb_error *err)
{
    double value;
    if (!read_value(&axes->row[axis], word, &value, err) ||
        !check_implemented(&axes->row[axis], value, err))
        return false;
    sb_variant_put(v, axis, value);
    return true;
}

// `sets` is made of words "axis=value" with blanks between them.
static bool expand_one(const struct sb_axes *axes, struct sb_variant *v, const char *sets,
                       struct sb_error *err)
{
    for (sets += strspn(sets, " "); *sets; sets += strspn(sets, " ")) {
        const size_t length = strcspn(sets, " ");
        char word[128];
        if (length >= sizeof word)
            return sb_fail(err, SB_INTERNAL, "shorthand: \"%s\" is too long", sets);
        memcpy(word, sets, length);
        word[length] = '\0';
        sets += length;
        char *const equals = strchr(word, '=');
        if (!equals)
            return sb_fail(err, SB_INTERNAL, "shorthand: no = in \"%s\"", word);
        *equals = '\0';
        const int axis = sb_axes_expect(axes, word, err);
        double value;
        if (axis < 0 || !read_value(&axes->row[axis], equals + 1, &value, err))
            return false;
        if (!sb_variant_given(v, axis))
            v->value[axis] = value;
    }
    return true;
}

static bool expand(const struct sb_axes *axes, struct sb_variant *v, struct sb_error *err)
{
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        const double value = v->value[i];
        const bool whole = axis->values || axis->flags & SB_WHOLE;
        const double min = axis->values ? 0 : axis->min;
        const double max = axis->values ? axis->value_count - 1 : axis->max;
        if (!(value >= min && value <= max) || (whole && value != floor(value)))
            return sb_fail(err, SB_BAD_INPUT, "%s: %g is out of range", axis->name,
                           value);
        if (axis->values && !expand_one(axes, v, axis->values[(int)value].sets, err))
            return false;
    }
    return true;
}

bool sb_variant_resolve(const struct sb_axes *axes, struct sb_variant *v,
                        struct sb_error *err)
{
    return expand(axes, v, err) && sb_variant_settle(axes, v, err);
}

bool sb_variant_settle(const struct sb_axes *axes, struct sb_variant *v,
                       struct sb_error *err)
{
    // `when` names earlier rows only (sb_axes_add), so one pass in order is stable.
    for (int i = 0; i < axes->count; i++)
        if (sb_variant_moot(axes, v, i))
            v->value[i] = axes->row[i].init;
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        if (sb_variant_moot(axes, v, i))
            continue;
        if (!check_implemented(axis, v->value[i], err))
            return false;
        if (v->value[i] == axis->init || sb_condition_holds(axes, axis->needs, v))
            continue;
        struct sb_text word = {0};
        add_value(axis, v->value[i], &word);
        sb_fail(err, SB_BAD_INPUT, "%s=%s needs %s", axis->name, sb_text_get(&word),
                axis->needs);
        sb_text_free(&word);
        return false;
    }
    return true;
}

bool sb_variant_untimed(const struct sb_axes *axes, const struct sb_variant *v)
{
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        if (axis->values && axis->values[(int)v->value[a]].flags & SB_UNTIMED)
            return true;
    }
    return false;
}

bool sb_variant_moot(const struct sb_axes *axes, const struct sb_variant *v, int axis)
{
    return !sb_condition_holds(axes, axes->row[axis].when, v);
}

bool sb_variant_equal(const struct sb_axes *axes, const struct sb_variant *a,
                      const struct sb_variant *b)
{
    for (int i = 0; i < axes->count; i++)
        if (a->value[i] != b->value[i] && !sb_axis_is_shorthand(&axes->row[i]))
            return false;
    return true;
}

bool sb_variant_same_class(const struct sb_axes *axes, const struct sb_variant *a,
                           const struct sb_variant *b)
{
    for (int i = 0; i < axes->count; i++)
        if (a->value[i] != b->value[i] && !sb_axis_is_shorthand(&axes->row[i]) &&
            axes->row[i].kind != SB_IMPLEMENTATION)
            return false;
    return true;
}

uint64_t sb_variant_hash(const struct sb_axes *axes, const struct sb_variant *v)
{
    uint64_t hash = SB_HASH_START;
    for (int i = 0; i < axes->count; i++)
        if (!sb_axis_is_shorthand(&axes->row[i]))
            hash = sb_hash(hash, &v->value[i], sizeof v->value[i]);
    return hash;
}

void sb_variant_value_text(const struct sb_axes *axes, const struct sb_variant *v,
                           int axis, struct sb_text *text)
{
    if (!sb_variant_moot(axes, v, axis))
        add_value(&axes->row[axis], v->value[axis], text);
}

void sb_variant_id(const struct sb_axes *axes, const struct sb_variant *v,
                   struct sb_text *text)
{
    const size_t start = text->length;
    for (int i = 0; i < axes->count; i++) {
        if (!sb_variant_given(v, i) || sb_variant_moot(axes, v, i))
            continue;
        sb_text_printf(text, "%s%s=", text->length > start ? "," : "", axes->row[i].name);
        add_value(&axes->row[i], v->value[i], text);
    }
    if (text->length == start)
        sb_text_add(text, "default");
}
