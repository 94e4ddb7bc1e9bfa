#include "assemble/light_structs.h"

static const char *type_of(const struct sb_light_field *field)
{
    return field->components == 1 ? "float" : "vec3";
}

// Type(head a tail, head b tail): the rest of a macro's line.
static void add_constructor(struct sb_text *text, const struct sb_light_struct *row,
                            const struct sb_light_members *members, const char *head,
                            const char *tail)
{
    sb_text_printf(text, "%s(", row->type);
    for (int i = 0; i < members->count; i++)
        sb_text_printf(text, "%s%s%s%s", i ? ", " : "", head, members->field[i]->name,
                       tail);
    sb_text_add(text, ")\n");
}

void sb_light_structs_text(const struct sb_variant *variant, struct sb_text *text)
{
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
        const struct sb_light_struct *row = &sb_light_structs[s];
        struct sb_light_members members;
        sb_light_members_of(row, variant, &members);
        sb_text_printf(text, "struct %s {\n", row->type);
        for (int i = 0; i < members.count; i++)
            sb_text_printf(text, "    P_UNIFORM %s %s;\n", type_of(members.field[i]),
                           members.field[i]->name);
        sb_text_printf(text, "};\n#define %s_OF(light) ", row->element);
        add_constructor(text, row, &members, "light.", "");
    }
}

static void add_arrays(struct sb_text *text, const struct sb_light_struct *row,
                       const struct sb_variant *variant)
{
    struct sb_light_members members;
    struct sb_text head = {0};
    sb_light_members_of(row, variant, &members);
    sb_text_printf(text, "#if MAX_%sS > 0\n", row->element);
    for (int i = 0; i < members.count; i++)
        sb_text_printf(text, "uniform P_UNIFORM %s %s_%s[MAX_%sS];\n",
                       type_of(members.field[i]), row->array, members.field[i]->name,
                       row->element);
    sb_text_printf(text, "#define %s(i) ", row->element);
    sb_text_printf(&head, "%s_", row->array);
    add_constructor(text, row, &members, sb_text_get(&head), "[i]");
    sb_text_add(text, "#endif\n");
    sb_text_free(&head);
}

void sb_light_arrays_text(const struct sb_variant *variant, struct sb_text *text)
{
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++)
        if ((s == SB_LIGHT_UNIFIED) == unified)
            add_arrays(text, &sb_light_structs[s], variant);
}
