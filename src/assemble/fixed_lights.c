#include "assemble/fixed_lights.h"

#include <stdio.h>
#include <string.h>

#include "scene/scene.h"

bool sb_lights_are_fixed(const struct sb_variant *variant)
{
    const int storage = (int)variant->value[SB_AXIS_STORAGE];
    return storage == SB_STORAGE_CONSTANT || storage == SB_STORAGE_GLOBAL;
}

// --- values ----------------------------------------------------------------------------

// Nine digits tell any two floats apart; without dot or exponent it would be an integer.
static void add_float(struct sb_text *text, float value)
{
    char number[32];
    snprintf(number, sizeof number, "%.9g", (double)value);
    sb_text_printf(text, "%s%s", number, strpbrk(number, ".e") ? "" : ".0");
}

static void add_floats(struct sb_text *text, const float *value, int components)
{
    if (components == 1) {
        add_float(text, value[0]);
        return;
    }
    sb_text_printf(text, "vec%d(", components);
    for (int i = 0; i < components; i++) {
        sb_text_add(text, i ? ", " : "");
        add_float(text, value[i]);
    }
    sb_text_add(text, ")");
}

struct array { // one GLSL array
    const struct sb_light_struct *row;
    struct sb_light_members members;
    const struct sb_light *light;
    int slots;
};

static void add_light(struct sb_text *text, const struct array *array, int number)
{
    sb_text_printf(text, "%s(", array->row->type);
    for (int i = 0; i < array->members.count; i++) {
        const struct sb_light_field *field = array->members.field[i];
        const void *value = (const char *)&array->light[number] + field->offset;
        sb_text_add(text, i ? ", " : "");
        add_floats(text, value, field->components);
    }
    sb_text_add(text, ")");
}

static void add_material(struct sb_text *text, const struct sb_material *material)
{
    const float *const colours[] = {material->ambient, material->diffuse,
                                    material->specular};
    sb_text_add(text, "Material(");
    for (int i = 0; i < 3; i++) {
        add_floats(text, colours[i], 3);
        sb_text_add(text, ", ");
    }
    add_float(text, material->shininess);
    sb_text_add(text, ")");
}

// --- what is declared ------------------------------------------------------------------

struct fixed {
    struct array array[SB_LIGHT_TYPE_COUNT];
    int array_count;
    const struct sb_material *material; // NULL: lit draws differ in it
};

// Of the lit draws; a lamp is drawn without a material.
static const struct sb_material *only_material(const struct sb_scene *scene)
{
    const struct sb_material *only = NULL;
    for (int i = 0; i < scene->draw_count; i++) {
        const struct sb_material *material = &scene->material[scene->draw[i].material];
        if (scene->draw[i].lamp >= 0)
            continue;
        if (only && only != material)
            return NULL;
        only = material;
    }
    return only;
}

static void place_lights(const struct sb_scene *scene, const struct sb_variant *variant,
                         enum sb_light_type type, struct sb_light *out)
{
    int count;
    const struct sb_light *light = sb_lights_of(&scene->lights, type, &count);
    for (int i = 0; i < count; i++)
        out[i] = sb_light_as_lit(&light[i], type, variant, &scene->camera);
}

static void add_array(struct fixed *fixed, int number, const struct sb_variant *variant,
                      const struct sb_light *light, int slots)
{
    struct array *array = &fixed->array[fixed->array_count++];
    *array =
        (struct array){.row = &sb_light_structs[number], .light = light, .slots = slots};
    sb_light_members_of(array->row, variant, &array->members);
}

// Split: an array a type. Unified: one, whose free slots come behind all lights.
static void collect(struct sb_scene *scene, const struct sb_variant *variant,
                    struct fixed *fixed)
{
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    const int total = sb_lights_unified_slots(variant);
    int slots[SB_LIGHT_TYPE_COUNT];
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        slots[t] = sb_lights_slots(variant, (enum sb_light_type)t);
    struct sb_light *out =
        sb_arena_alloc(&scene->arena, (size_t)(total + 1) * sizeof *out);
    if (unified && total > 0)
        add_array(fixed, SB_LIGHT_UNIFIED, variant, out, total);
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        place_lights(scene, variant, (enum sb_light_type)t, out);
        if (!unified && slots[t] > 0)
            add_array(fixed, t, variant, out, slots[t]);
        out += unified ? scene->lights.count[t] : slots[t];
    }
    fixed->material = only_material(scene);
}

static void add_constants(struct sb_text *text, const struct fixed *fixed)
{
    for (int a = 0; a < fixed->array_count; a++) {
        const struct array *array = &fixed->array[a];
        const char *type = array->row->type;
        sb_text_printf(text, "const %s %s[%d] = %s[%d](", type, array->row->array,
                       array->slots, type, array->slots);
        for (int i = 0; i < array->slots; i++) {
            sb_text_add(text, i ? ",\n    " : "\n    ");
            add_light(text, array, i);
        }
        sb_text_add(text, ");\n");
    }
    if (fixed->material) {
        sb_text_add(text, "const Material u_material = ");
        add_material(text, fixed->material);
        sb_text_add(text, ";\n");
    }
}

static void add_globals(struct sb_text *text, const struct fixed *fixed)
{
    for (int a = 0; a < fixed->array_count; a++)
        sb_text_printf(text, "%s %s[%d];\n", fixed->array[a].row->type,
                       fixed->array[a].row->array, fixed->array[a].slots);
    if (fixed->material)
        sb_text_add(text, "Material u_material;\n");
    sb_text_add(text, "\nvoid fill_lights()\n{\n");
    for (int a = 0; a < fixed->array_count; a++) {
        const struct array *array = &fixed->array[a];
        for (int i = 0; i < array->slots; i++) {
            sb_text_printf(text, "    %s[%d] = ", array->row->array, i);
            add_light(text, array, i);
            sb_text_add(text, ";\n");
        }
    }
    if (fixed->material) {
        sb_text_add(text, "    u_material = ");
        add_material(text, fixed->material);
        sb_text_add(text, ";\n");
    }
    sb_text_add(text, "}\n");
}

bool sb_fixed_lights(const char *scene_name, const struct sb_variant *variant,
                     struct sb_text *text, struct sb_error *err)
{
    struct sb_scene scene = {0};
    const bool good = sb_scene_make(scene_name, variant, &scene, err);
    if (good) {
        struct fixed fixed = {0};
        collect(&scene, variant, &fixed);
        if (!fixed.material)
            sb_text_add(text, "uniform Material u_material;\n");
        if (variant->value[SB_AXIS_STORAGE] == SB_STORAGE_CONSTANT)
            add_constants(text, &fixed);
        else
            add_globals(text, &fixed);
    }
    sb_scene_free(&scene);
    return good;
}
