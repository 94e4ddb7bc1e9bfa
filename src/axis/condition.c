#include <ctype.h>
#include <string.h>

#include "axis/variant.h"

enum relation { EQUAL, NOT_EQUAL, LESS_EQUAL, GREATER_EQUAL, LESS, GREATER };

// Two-character operators first, so that < does not take the place of <=.
static const char *const relation_text[] = {
    [NOT_EQUAL] = "!=", [LESS_EQUAL] = "<=", [GREATER_EQUAL] = ">=",
    [EQUAL] = "=",      [LESS] = "<",        [GREATER] = ">",
};
static const enum relation relation_order[] = {NOT_EQUAL, LESS_EQUAL, GREATER_EQUAL,
                                               EQUAL,     LESS,       GREATER};

struct term {
    int axis;
    enum relation relation;
    double value;
};

enum { WORD_MAX = 128 };

static void skip_blanks(const char **cursor)
{
    *cursor += strspn(*cursor, " \t");
}

// Copies up to the first of `stop`, without the blanks at its end; false where the buffer
// is too small, for half a word could name something else.
static bool take_word(const char **cursor, const char *stop, char word[static WORD_MAX])
{
    skip_blanks(cursor);
    size_t length = strcspn(*cursor, stop);
    const char *const start = *cursor;
    *cursor += length;
    while (length && isblank((unsigned char)start[length - 1]))
        length--;
    if (length >= WORD_MAX)
        return false;
    memcpy(word, start, length);
    word[length] = '\0';
    return true;
}

static bool take_relation(const char **cursor, enum relation *relation)
{
    for (size_t i = 0; i < sizeof relation_order / sizeof *relation_order; i++) {
        const char *const text = relation_text[relation_order[i]];
        if (strncmp(*cursor, text, strlen(text)) == 0) {
            *relation = relation_order[i];
            *cursor += strlen(text);
            return true;
        }
    }
    return false;
}

static bool take_value(const struct sb_axis *axis, const char *word, struct term *term,
                       struct sb_error *err)
{
    if (!axis->values) {
        if (!sb_parse_number(word, &term->value))
            return sb_fail(err, SB_BAD_INPUT, "%s: \"%s\" is not a number", axis->name,
                           word);
        return true;
    }
    if (term->relation != EQUAL && term->relation != NOT_EQUAL)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: %s is for numbers; valid here: = !=", axis->name,
                       relation_text[term->relation]);
    const int place = sb_axis_value_expect(axis, word, err);
    if (place < 0)
        return false;
    term->value = place;
    return true;
}

static bool take_term(const struct sb_axes *axes, const char **cursor, struct term *term,
                      struct sb_error *err)
{
    const char *const start = *cursor;
    char name[WORD_MAX], value[WORD_MAX];
    if (!take_word(cursor, "=!<>,|", name) || !take_relation(cursor, &term->relation) ||
        !take_word(cursor, ",|", value))
        return sb_fail(err, SB_BAD_INPUT,
                       "condition \"%s\": wanted: axis, one of = != < <= > >=, value",
                       start);
    term->axis = sb_axes_expect(axes, name, err);
    return term->axis >= 0 && take_value(&axes->row[term->axis], value, term, err);
}

static bool term_holds(const struct term *term, const struct sb_variant *v)
{
    const double value = v->value[term->axis];
    switch (term->relation) {
    case EQUAL:
        return value == term->value;
    case NOT_EQUAL:
        return value != term->value;
    case LESS:
        return value < term->value;
    case LESS_EQUAL:
        return value <= term->value;
    case GREATER:
        return value > term->value;
    case GREATER_EQUAL:
        return value >= term->value;
    }
    return false;
}

// Parses all of it; with `v`, *holds is what it comes to.
static bool walk(const struct sb_axes *axes, const char *condition,
                 const struct sb_variant *v, bool *holds, struct sb_error *err)
{
    const char *cursor = condition;
    bool any = false, all = true;
    skip_blanks(&cursor);
    for (bool more = *cursor; more;) {
        struct term term;
        if (!take_term(axes, &cursor, &term, err))
            return false;
        all = all && (!v || term_holds(&term, v));
        if (*cursor == '|') {
            any = any || all;
            all = true;
        }
        more = *cursor++;
    }
    *holds = any || all;
    return true;
}

bool sb_condition_check(const struct sb_axes *axes, const char *condition,
                        struct sb_error *err)
{
    bool holds;
    return walk(axes, condition, NULL, &holds, err);
}

bool sb_condition_holds(const struct sb_axes *axes, const char *condition,
                        const struct sb_variant *v)
{
    bool holds;
    return walk(axes, condition, v, &holds, NULL) && holds;
}
