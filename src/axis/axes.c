#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "axis/variant.h"
#include "base/mem.h"
#include "base/words.h"

_Static_assert(SB_AXIS_BUILTIN_COUNT <= SB_AXIS_MAX, "more built-in axes than rows");
_Static_assert(SB_AXIS_MAX <= 128, "sb_variant.given has 128 bits");

const char *const sb_axis_kind_names[SB_AXIS_KIND_COUNT] = {
    [SB_PLATFORM] = "platform",
    [SB_SCENE] = "scene",
    [SB_QUALITY] = "quality",
    [SB_IMPLEMENTATION] = "implementation",
};

// clang-format off
#define VALUE(id, name, text, sets, flags, help) {name, text, sets, help, flags},
#define NUMBER(...)
#define CHOICE(id, name, kind, define, when, needs, init, help, ...) \
    static const struct sb_value values_##id[] = {__VA_ARGS__};
#include "axis/axes.def"
#undef CHOICE
#undef NUMBER
#undef VALUE

static const struct sb_axes builtin = {
    .count = SB_AXIS_BUILTIN_COUNT,
    .row = {
#define VALUE(...)
#define NUMBER(id, name, kind, flags, define, when, needs, init, min, max, help) \
    {#name, define, when, needs, help, SB_##kind, flags, NULL, 0, init, min, max},
#define CHOICE(id, name, kind, define, when, needs, init, help, ...) \
    {#name, define, when, needs, help, SB_##kind, 0, values_##id, \
     SB_##id##_VALUE_COUNT, SB_##init, 0, SB_##id##_VALUE_COUNT - 1},
#include "axis/axes.def"
#undef CHOICE
#undef NUMBER
#undef VALUE
    },
};
// clang-format on

const struct sb_axes *sb_axes_builtin(void)
{
    return &builtin;
}

bool sb_axis_is_shorthand(const struct sb_axis *axis)
{
    for (int i = 0; i < axis->value_count; i++)
        if (*axis->values[i].sets)
            return true;
    return false;
}

int sb_axes_find(const struct sb_axes *axes, const char *name)
{
    for (int i = 0; i < axes->count; i++)
        if (strcmp(axes->row[i].name, name) == 0)
            return i;
    return -1;
}

int sb_axes_expect(const struct sb_axes *axes, const char *name, struct sb_error *err)
{
    const int axis = sb_axes_find(axes, name);
    if (axis < 0) {
        const char *names[SB_AXIS_MAX];
        for (int i = 0; i < axes->count; i++)
            names[i] = axes->row[i].name;
        sb_fail_unknown(err, "", "axis", name, names, axes->count);
    }
    return axis;
}

int sb_axis_value_find(const struct sb_axis *axis, const char *name)
{
    for (int i = 0; i < axis->value_count; i++)
        if (strcmp(axis->values[i].name, name) == 0)
            return i;
    return -1;
}

int sb_axis_value_expect(const struct sb_axis *axis, const char *name,
                         struct sb_error *err)
{
    const int place = sb_axis_value_find(axis, name);
    if (place < 0) {
        const char **names = sb_alloc((size_t)axis->value_count * sizeof *names);
        for (int i = 0; i < axis->value_count; i++)
            names[i] = axis->values[i].name;
        sb_fail_unknown(err, axis->name, "value", name, names, axis->value_count);
        free(names);
    }
    return place;
}

bool sb_number_read(const char *name, const char *word, double min, double max,
                    bool whole, double *value, struct sb_error *err)
{
    char low[32], high[32];
    const char *wrong = NULL;
    double number;
    if (!sb_parse_number(word, &number))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: \"%s\" is not a number; valid: %snumbers from %s to %s", name,
                       word, whole ? "whole " : "", sb_number_text(min, low),
                       sb_number_text(max, high));
    if (number < min || number > max)
        wrong = "out of range";
    else if (whole && number != floor(number))
        wrong = "not a whole number";
    if (wrong)
        return sb_fail(err, SB_BAD_INPUT, "%s: %s is %s; valid: %snumbers from %s to %s",
                       name, word, wrong, whole ? "whole " : "", sb_number_text(min, low),
                       sb_number_text(max, high));
    *value = number + 0.0; // -0 becomes 0: equal numbers must print and hash alike
    return true;
}

static bool is_identifier(const char *word)
{
    for (const char *p = word; *p; p++)
        if (!isalpha((unsigned char)*p) && *p != '_' &&
            (p == word || !isdigit((unsigned char)*p)))
            return false;
    return *word != '\0';
}

static bool check_names(const struct sb_axes *axes, const struct sb_axis *row,
                        struct sb_error *err)
{
    if (!is_identifier(row->name) || strlen(row->name) > SB_NAME_MAX)
        return sb_fail(
            err, SB_BAD_INPUT,
            "axis \"%s\": the name must be letters, digits and _, at most %d of "
            "them, and not start with a digit",
            row->name, SB_NAME_MAX);
    if (sb_axes_find(axes, row->name) >= 0)
        return sb_fail(err, SB_BAD_INPUT,
                       "axis \"%s\": there is one of that name already", row->name);
    if (!*row->define)
        return true;
    // GLSL 3.30, 3.3: macros with __ in them or the prefix GL_ are reserved.
    if (!is_identifier(row->define) || strstr(row->define, "__") ||
        strncmp(row->define, "GL_", 3) == 0)
        return sb_fail(
            err, SB_BAD_INPUT,
            "axis \"%s\": define \"%s\" is no name that GLSL leaves free: letters, "
            "digits and single _, not starting with GL_",
            row->name, row->define);
    for (int i = 0; i < axes->count; i++)
        if (strcmp(axes->row[i].define, row->define) == 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "axis \"%s\": define %s belongs to axis \"%s\"", row->name,
                           row->define, axes->row[i].name);
    return true;
}

static bool has_control_character(const char *text)
{
    for (; *text; text++)
        if (iscntrl((unsigned char)*text))
            return true;
    return false;
}

static bool check_values(const struct sb_axis *row, struct sb_error *err)
{
    if (row->value_count < 1)
        return sb_fail(err, SB_BAD_INPUT, "axis \"%s\": no values", row->name);
    if (!(row->init >= 0 && row->init < row->value_count &&
          row->init == floor(row->init)))
        return sb_fail(err, SB_BAD_INPUT, "axis \"%s\": init is no place in its values",
                       row->name);
    for (int i = 0; i < row->value_count; i++) {
        const struct sb_value *value = &row->values[i];
        if (!*value->name || strlen(value->name) > SB_NAME_MAX ||
            strpbrk(value->name, " ,|=<>!") || has_control_character(value->name))
            return sb_fail(
                err, SB_BAD_INPUT,
                "axis \"%s\": value \"%s\" must be one word of at most %d bytes, without "
                ", | = < > !",
                row->name, value->name, SB_NAME_MAX);
        if (sb_axis_value_find(row, value->name) != i)
            return sb_fail(err, SB_BAD_INPUT,
                           "axis \"%s\": value \"%s\" stands there twice", row->name,
                           value->name);
        if (has_control_character(value->text))
            return sb_fail(err, SB_BAD_INPUT,
                           "axis \"%s\": the text of \"%s\" must be one line", row->name,
                           value->name);
    }
    return true;
}

static bool check_numbers(const struct sb_axis *row, struct sb_error *err)
{
    if (!isfinite(row->min) || !isfinite(row->max) || row->min > row->max)
        return sb_fail(err, SB_BAD_INPUT, "axis \"%s\": min must be at most max",
                       row->name);
    if (!(row->init >= row->min && row->init <= row->max))
        return sb_fail(err, SB_BAD_INPUT,
                       "axis \"%s\": init must lie between min and max", row->name);
    if ((row->flags & SB_WHOLE) &&
        (row->min != floor(row->min) || row->max != floor(row->max) ||
         row->init != floor(row->init)))
        return sb_fail(err, SB_BAD_INPUT,
                       "axis \"%s\": min, max and init must be whole numbers", row->name);
    return true;
}

bool sb_axes_add(struct sb_axes *axes, const struct sb_axis *row, struct sb_error *err)
{
    if (axes->count == SB_AXIS_MAX)
        return sb_fail(err, SB_BAD_INPUT, "axis \"%s\": there is room for %d axes in all",
                       row->name, SB_AXIS_MAX);
    if (!check_names(axes, row, err) || !sb_condition_check(axes, row->when, err) ||
        !sb_condition_check(axes, row->needs, err))
        return false;
    if (!(row->values ? check_values(row, err) : check_numbers(row, err)))
        return false;
    axes->row[axes->count++] = *row;
    return true;
}
