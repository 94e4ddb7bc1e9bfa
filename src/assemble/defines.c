#include "assemble/defines.h"

#include <ctype.h>
#include <string.h>

#include "job/job.h"

static bool same_name(const char *a, const char *b)
{
    const size_t length = strcspn(a, "("); // of a macro with a parameter, the name
    return length == strcspn(b, "(") && !strncmp(a, b, length);
}

// A second #define of a name is an error in some drivers and a warning in others, and they
// differ in which value counts.
static bool add(struct sb_defines *defines, const char *name, const char *value,
                struct sb_error *err)
{
    for (int i = 0; i < defines->count; i++)
        if (same_name(defines->row[i].name, name))
            return sb_fail(err, SB_BAD_INPUT,
                           "define %s: the name is taken; another one is valid", name);
    defines->row[defines->count++] = (struct sb_glsl_define){name, value};
    return true;
}

static bool add_number(struct sb_defines *defines, const char *name, int number,
                       struct sb_error *err)
{
    return add(defines, name, sb_arena_printf(defines->arena, "%d", number), err);
}

// --- axes ------------------------------------------------------------------------------

// A GLSL literal: a float needs a dot or an exponent, and a minus sign parentheses, so that
// `x-BEND` does not become a decrement.
static const char *number_literal(struct sb_arena *arena, double value, bool whole)
{
    char number[32];
    sb_number_text(value, number);
    const bool bare = !whole && !strpbrk(number, ".e");
    return sb_arena_printf(arena, value < 0 ? "(%s%s)" : "%s%s", number,
                           bare ? ".0" : "");
}

static const char *axis_literal(struct sb_arena *arena, const struct sb_axis *axis,
                                double value)
{
    if (!axis->values)
        return number_literal(arena, value, axis->flags & SB_WHOLE);
    const char *text = axis->values[(int)value].text;
    return *text ? text : number_literal(arena, value, true);
}

// The variant with other light counts than were asked for: a sun that is down does not count.
static struct sb_variant with_counts(const struct sb_variant *variant,
                                     int (*count)(const struct sb_variant *,
                                                  enum sb_light_type))
{
    struct sb_variant counted = *variant;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        counted.value[sb_light_structs[t].axis] = count(variant, (enum sb_light_type)t);
    return counted;
}

static bool add_axes(struct sb_defines *defines, const struct sb_axes *axes,
                     const struct sb_variant *variant, struct sb_error *err)
{
    const struct sb_variant shining = with_counts(variant, sb_lights_shining);
    for (int i = 0; i < axes->count; i++) {
        const struct sb_axis *axis = &axes->row[i];
        if (*axis->define &&
            !add(defines, axis->define,
                 axis_literal(defines->arena, axis, shining.value[i]), err))
            return false;
    }
    return true;
}

static const char *effect_body(struct sb_arena *arena, int effect, bool switched)
{
    const struct sb_effect_row *row = &sb_effect_rows[effect];
    return switched && row->switched
               ? sb_arena_printf(arena, "if (u_if_%s) { code }", row->name)
               : "code";
}

// A program whose arrays have room for a light that is off now must hold the code for it.
static bool add_effects(struct sb_defines *defines, const struct sb_axes *axes,
                        const struct sb_variant *variant, struct sb_error *err)
{
    const struct sb_variant slots = with_counts(variant, sb_lights_slots);
    const uint32_t effects = sb_effects_of(axes, &slots) & ~defines->left_out;
    struct sb_arena *arena = defines->arena;
    for (int i = 0; i < SB_EFFECT_COUNT; i++) {
        const char *stem = sb_effect_rows[i].stem;
        const bool in = effects >> i & 1;
        if (!add(defines, sb_arena_printf(arena, "IF_%s(code)", stem),
                 in ? effect_body(arena, i, defines->switched) : "", err) ||
            !add(defines, sb_arena_printf(arena, "WITH_%s(code)", stem), in ? "code" : "",
                 err))
            return false;
    }
    return add(defines, "CASTERS", defines->switched ? "counted" : "fixed", err);
}

// --- lights ----------------------------------------------------------------------------

// "POINT" of the array u_point: what the macros of a light struct have in their names.
static const char *stem_of(struct sb_arena *arena, const struct sb_light_struct *row)
{
    char *stem = sb_arena_strdup(arena, row->array + strlen("u_"));
    for (char *at = stem; *at; at++)
        *at = (char)toupper((unsigned char)*at);
    return stem;
}

// one(first) … one(end - 1)
static const char *repetitions(struct sb_arena *arena, int first, int end)
{
    struct sb_text text = {0};
    for (int i = first; i < end; i++)
        sb_text_printf(&text, i > first ? " one(%d)" : "one(%d)", i);
    char *kept = sb_arena_strdup(arena, sb_text_get(&text));
    sb_text_free(&text);
    return kept;
}

struct span { // of the lights that one loop goes through
    int first, shining, slots;
};

static struct span span_of(const struct sb_variant *variant, int row)
{
    const bool all = row == SB_LIGHT_UNIFIED;
    struct span span = {
        .slots = all ? sb_lights_unified_slots(variant)
                     : sb_lights_slots(variant, (enum sb_light_type)row),
    };
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        if (row == t || all)
            span.shining += sb_lights_shining(variant, (enum sb_light_type)t);
    }
    if (row == SB_LIGHT_POINT) // those that cast shadows have a loop of their own
        span.first = (int)variant->value[SB_AXIS_SHADOWS];
    return span;
}

static bool add_lights(struct sb_defines *defines, const struct sb_variant *variant,
                       struct sb_error *err)
{
    struct sb_arena *arena = defines->arena;
    const bool unrolled = variant->value[SB_AXIS_LOOP] == SB_LOOP_UNROLLED;
    for (int row = 0; row < SB_LIGHT_STRUCT_COUNT; row++) {
        const struct span span = span_of(variant, row);
        const char *stem = stem_of(arena, &sb_light_structs[row]);
        const char *max =
            sb_arena_printf(arena, "MAX_%sS", sb_light_structs[row].element);
        if (!add_number(defines, max, span.slots, err))
            return false;
        if (unrolled && !add(defines, sb_arena_printf(arena, "UNROLLED_%s(one)", stem),
                             repetitions(arena, span.first, span.shining), err))
            return false;
    }
    const int casters = (int)variant->value[SB_AXIS_SHADOWS];
    return add_number(defines, "NR_LIGHTS", span_of(variant, SB_LIGHT_UNIFIED).shining,
                      err) &&
           (casters == 0 ||
            add(defines, "UNROLLED_CASTER(one)", repetitions(arena, 0, casters), err));
}

// --- all of them -----------------------------------------------------------------------

static const char *slips_of(const struct sb_axes *axes, const struct sb_variant *variant)
{
    const bool kept = variant->value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN;
    const int source = kept ? (int)variant->value[SB_AXIS_SOURCE] : SB_SOURCE_NONE;
    return axes->row[SB_AXIS_SOURCE].values[source].name;
}

bool sb_defines_make(struct sb_defines *defines, const struct sb_axes *axes,
                     const struct sb_variant *variant, const char *family,
                     struct sb_error *err)
{
    // Those of the axes last: it is the name of a suite's own axis that has to give way.
    return add(defines, "GLSL_FAMILY", family, err) &&
           add(defines, "PROBE", "off", err) &&
           add(defines, "GIVEN", "interpolated", err) &&
           add_number(defines, "ROW_POINTS_ACROSS", SB_ROW_POINTS_ACROSS, err) &&
           add(defines, "SLIPS", slips_of(axes, variant), err) &&
           add_effects(defines, axes, variant, err) &&
           add_lights(defines, variant, err) && add_axes(defines, axes, variant, err);
}

static void set(struct sb_defines *defines, const char *name, const char *value)
{
    int row = 0;
    while (strcmp(defines->row[row].name, name) != 0)
        row++;
    defines->row[row].value = value;
}

void sb_defines_probe(struct sb_defines *defines, const char *value)
{
    set(defines, "PROBE", value);
}

void sb_defines_rows(struct sb_defines *defines, bool rows)
{
    set(defines, "GIVEN", rows ? "rows" : "interpolated");
    if (rows)
        set(defines, "STORAGE", "rows");
}

void sb_defines_family(struct sb_defines *defines, const char *family)
{
    set(defines, "GLSL_FAMILY", family);
}
