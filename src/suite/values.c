#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "suite/values.h"

// Decimal steps leave dust in the last bits: 3 * 0.1 is 0.30000000000000004. A double
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

static bool add_range(const struct sb_axes *axes, int axis, char *item,
                      struct sb_values *values, struct sb_error *err)
{
    char whole[128], word[32];
    snprintf(whole, sizeof whole, "%s", item);
    struct range range;
    if (!read_range(&axes->row[axis], item, whole, &range, err) ||
        !check_range(&axes->row[axis], &range, whole, err))
        return false;
    // The slack lets 0..0.3 step 0.1 reach its end; nothing goes past it.
    const double end = range.last + 1e-12 * fabs(range.last - range.first);
    for (int i = 0;; i++) {
        double value =
            range.multiply ? range.first * pow(range.by, i) : range.first + i * range.by;
        if (value > end)
            return true;
        value = fmin(without_dust(value), range.last);
        if (!add_word(axes, axis, sb_number_text(value, word), values, err))
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
