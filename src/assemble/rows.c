#include "assemble/rows.h"

void sb_row_text(const struct sb_variant *variant, struct sb_text *text)
{
    sb_text_add(text, "void take_row()\n{\n");
    for (int i = 0; i < sb_point_field_count; i++) {
        const struct sb_point_field *field = &sb_point_fields[i];
        const char *type = field->components == 1   ? "float"
                           : field->components == 2 ? "vec2"
                                                    : "vec3";
        if (sb_condition_holds(sb_axes_builtin(), field->when, variant))
            sb_text_printf(text, "    %s = row_%s(%d);\n", field->name, type,
                           field->place);
    }
    sb_text_add(text, "}\n");
}

// Where the lights of a struct begin in the whole list.
static int first_of(const struct sb_variant *variant, int row)
{
    int first = 0;
    for (int t = 0; row != SB_LIGHT_UNIFIED && t < row; t++)
        first += sb_lights_shining(variant, (enum sb_light_type)t);
    return first;
}

static void add_reader(struct sb_text *text, const struct sb_light_struct *row,
                       const struct sb_variant *variant, int first)
{
    struct sb_light_members members;
    sb_light_members_of(row, variant, &members);
    const int start = sb_row_light(first), stride = sb_row_light(1) - sb_row_light(0);
    sb_text_printf(text, "%s row_%s(highp int i)\n{\n    highp int at = %d + i * %d;\n",
                   row->type, row->array, start, stride);
    sb_text_printf(text, "    return %s(", row->type);
    for (int i = 0; i < members.count; i++)
        sb_text_printf(text, "%srow_%s(at + %d)", i ? ",\n        " : "",
                       members.field[i]->components == 1 ? "float" : "vec3",
                       sb_row_member(members.field[i]));
    sb_text_printf(text, ");\n}\n#define %s(i) row_%s(i)\n", row->element, row->array);
}

void sb_row_lights_text(const struct sb_variant *variant, struct sb_text *text)
{
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++)
        if ((s == SB_LIGHT_UNIFIED) == unified)
            add_reader(text, &sb_light_structs[s], variant, first_of(variant, s));
}

bool sb_decide_rows(const struct sb_axes *axes, const struct sb_variant *variant,
                    struct sb_error *err)
{
    static const struct {
        int axis, value;
    } wanted[] = {
        {SB_AXIS_SPACE, SB_SPACE_WORLD},
        {SB_AXIS_HOIST, SB_HOIST_ONCE},
        {SB_AXIS_TEXT, SB_TEXT_CORRECTED},
        {SB_AXIS_SHADOWS, 0},
    };
    if (variant->value[SB_AXIS_GLSL] == SB_GLSL_100)
        return sb_fail(err, SB_BAD_INPUT,
                       "glsl=100: GLSL ES 1.00 cannot read a table of points; valid: "
                       "another version");
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const struct sb_axis *axis = &axes->row[wanted[i].axis];
        if (variant->value[wanted[i].axis] != wanted[i].value)
            return sb_fail(err, SB_BAD_INPUT,
                           "%s: points of a table are lit with %s=%s only", axis->name,
                           axis->name,
                           axis->values ? axis->values[wanted[i].value].name : "0");
    }
    return true;
}
