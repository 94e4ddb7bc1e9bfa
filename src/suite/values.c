#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "suite/values.h"

// Decimal factors leave dust in the last bits: 3 * 0.1 is 0.30000000000000004. A double
// tells numbers of 15 digits apart, so rounding to 15 gives the double that a list with
// 0.3 in it would give.
static double without_dust(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    return strtod(text, NULL);
}

// Cuts blanks off both ends, in place.
static char *trim(char *text)
{
    while (isblank((unsigned char)*text))
        text++;
    size_t length = strlen(text);
    while (length && isblank((unsigned char)text[length - 1]))
        length--;
    text[length] = '\0';
    return text;
}

static bool add_word(const struct sb_axes *axes, int axis, const char *word,
                     struct sb_values *values, struct sb_error *err)
{
    struct sb_variant one = {0};
    if (!sb_variant_set(axes, &one, axis, word, err))
        return false;
    if (values->count == SB_VALUES_MAX)
        return sb_fail(err, SB_BAD_INPUT, "%s: more than %d values", axes->row[axis].name,
                       SB_VALUES_MAX);
    values->value[values->count++] = one.value[axis];
    return true;
}

struct range {
    double first, last, by;
    bool multiply;
    // Steps: first and by are whole multiples of 1 / unit. Sums of whole numbers are exact and
    // a division rounds correctly, so that -90 + 82 * 1.1 is the double that is written 0.2.
    // 0: they are no multiples of a power of ten that a double can count in.
    double unit;
};

// `item` is cut up; `whole` is the text for messages.
static bool read_range(const struct sb_axis *axis, char *item, const char *whole,
                       struct range *range, struct sb_error *err)
{
    char *const dots = strstr(item, "..");
    *dots = '\0';
    char *last = trim(dots + 2);
    char *by = last + strcspn(last, " \t");
    if (*by)
        *by++ = '\0';
    by = trim(by);
    const char *number = "1";
    range->multiply = *by == 'x';
    if (range->multiply)
        number = trim(by + 1);
    else if (strncmp(by, "step", 4) == 0)
        number = trim(by + 4);
    else if (*by)
        number = "";
    if (!sb_parse_number(number, &range->by))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: range \"%s\" is not of the form A..B, A..B step S or A..B xF",
                       axis->name, whole);
    const bool integers = axis->flags & SB_WHOLE;
    return sb_number_read(axis->name, trim(item), axis->min, axis->max, integers,
                          &range->first, err) &&
           sb_number_read(axis->name, last, axis->min, axis->max, integers, &range->last,
                          err);
}

static bool check_range(const struct sb_axis *axis, const struct range *range,
                        const char *whole, struct sb_error *err)
{
    const char *wrong = NULL;
    if (range->first > range->last)
        wrong = "must go up";
    else if (!range->multiply && range->by <= 0)
        wrong = "must have a step above 0";
    else if (range->multiply && range->by <= 1)
        wrong = "must have a factor above 1";
    else if (range->multiply && range->first <= 0)
        wrong = "must start above 0 to be multiplied";
    if (wrong)
        return sb_fail(err, SB_BAD_INPUT, "%s: range \"%s\" %s", axis->name, whole,
                       wrong);
    return true;
}

// As many decimals as `first` and `by` need.
static double unit_of(const struct range *range)
{
    static const double most = 9007199254740992.0; // 2^53
    double unit = 1;
    for (int decimals = 0; decimals <= 15; decimals++, unit *= 10) {
        const double first = round(range->first * unit), by = round(range->by * unit);
        if (first / unit == range->first && by / unit == range->by &&
            fabs(first) + by * SB_VALUES_MAX < most)
            return unit;
    }
    return 0;
}

static double step_of(const struct range *range, int i)
{
    if (range->multiply)
        return without_dust(range->first * pow(range->by, i));
    if (range->unit > 0)
        return (round(range->first * range->unit) + i * round(range->by * range->unit)) /
               range->unit;
    return without_dust(range->first + i * range->by);
}

static bool add_range(const struct sb_axes *axes, int axis, char *item,
                      struct sb_values *values, struct sb_error *err)
{
    char whole[128], word[32];
    snprintf(whole, sizeof whole, "%s", item);
    struct range range;
    if (!read_range(&axes->row[axis], item, whole, &range, err) ||
        !check_range(&axes->row[axis], &range, whole, err))
        return false;
    range.unit = unit_of(&range);
    // The slack lets a step of 0.33333333333334 reach 1; nothing goes past the end.
    const double end = range.last + 1e-12 * fabs(range.last - range.first);
    for (int i = 0;; i++) {
        const double value = step_of(&range, i);
        if (value > end)
            return true;
        if (!add_word(axes, axis, sb_number_text(fmin(value, range.last), word), values,
                      err))
            return false;
    }
}

bool sb_values_add(const struct sb_axes *axes, int axis, const char *text,
                   struct sb_values *values, struct sb_error *err)
{
    char *const copy = sb_strdup(text);
    bool good = true;
    for (char *item = copy, *next; good && item; item = next) {
        next = strchr(item, ',');
        if (next)
            *next++ = '\0';
        item = trim(item);
        if (!axes->row[axis].values && strstr(item, ".."))
            good = add_range(axes, axis, item, values, err);
        else
            good = add_word(axes, axis, item, values, err);
    }
    free(copy);
    return good;
}
