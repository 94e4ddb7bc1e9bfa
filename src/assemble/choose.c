#include "assemble/choose.h"

#include <string.h>

#include "assemble/fixed_lights.h"
#include "effects/needs.h"

static bool is(const struct sb_variant *variant, int axis, int value)
{
    return (int)variant->value[axis] == value;
}

// --- what contradicts itself -------------------------------------------------------------

static bool check_policy(const struct sb_axes *axes, const struct sb_variant *variant,
                         struct sb_error *err)
{
    const int policy = (int)variant->value[SB_AXIS_SPECIALISE];
    const char *word = axes->row[SB_AXIS_SPECIALISE].values[policy].name;
    const bool late = is(variant, SB_AXIS_LOOP, SB_LOOP_DYNAMIC) ||
                      is(variant, SB_AXIS_LOOP, SB_LOOP_PADDED);
    if (policy == SB_SPECIALISE_UBER && !late)
        return sb_fail(err, SB_BAD_INPUT,
                       "specialise=uber: how many lights there are is known at run time "
                       "only; valid: loop=dynamic or loop=padded");
    if (policy != SB_SPECIALISE_ASKED && sb_lights_are_fixed(variant))
        return sb_fail(err, SB_BAD_INPUT,
                       "specialise=%s: programs that hold their lights as constants are "
                       "made for these lights already; valid: a storage other than "
                       "constant and global, or specialise=asked",
                       word);
    if (policy != SB_SPECIALISE_ASKED && !is(variant, SB_AXIS_TEXT, SB_TEXT_CORRECTED))
        return sb_fail(err, SB_BAD_INPUT,
                       "specialise=%s with text=as_written: slips are no effects; valid: "
                       "text=corrected, or specialise=asked",
                       word);
    return true;
}

// --- uber: one for all of the suite -------------------------------------------------------

static const int counts[] = {SB_AXIS_DIR, SB_AXIS_POINT, SB_AXIS_SPOT, SB_AXIS_AREA,
                             SB_AXIS_SHADOWS};

// To what both call for. Laws that both have stay as they are: each law has a program of its own.
static void raise_to(const struct sb_axes *axes, struct sb_variant *variant,
                     const struct sb_variant *own, const struct sb_variant *other)
{
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (other->value[counts[i]] > variant->value[counts[i]])
            variant->value[counts[i]] = other->value[counts[i]];
    variant->value[SB_AXIS_MAPS] =
        sb_maps_value(sb_maps_asked(variant) | sb_maps_asked(other));
    if (is(variant, SB_AXIS_MODEL, SB_MODEL_LAMBERT))
        variant->value[SB_AXIS_MODEL] = other->value[SB_AXIS_MODEL];
    if (is(variant, SB_AXIS_AMBIENT, SB_AMBIENT_NONE))
        variant->value[SB_AXIS_AMBIENT] = other->value[SB_AXIS_AMBIENT];
    for (int i = 0; i < axes->count; i++)
        if (axes->row[i].kind != SB_PLATFORM && sb_variant_moot(axes, own, i) &&
            !sb_variant_moot(axes, other, i))
            variant->value[i] = other->value[i];
}

// The smallest variant that covers every entry of the suite that is lit in the same stage.
static bool cover(const struct sb_assemble_params *params, struct sb_variant *variant,
                  struct sb_error *err)
{
    struct sb_error failure = {0};
    const struct sb_suite *suite = params->suite;
    *variant = *params->variant;
    for (int i = 0; suite && i < suite->entry_count; i++) {
        const struct sb_variant *other = &suite->entry[i].variant;
        if (other->value[SB_AXIS_STAGE] == variant->value[SB_AXIS_STAGE])
            raise_to(params->axes, variant, params->variant, other);
    }
    return sb_variant_settle(params->axes, variant, &failure) ||
           sb_fail(err, failure.status,
                   "specialise=uber: one program for all variants of the suite: %s",
                   failure.text);
}

static const char *switch_name(struct sb_arena *arena, int effect)
{
    return sb_arena_printf(arena, "u_if_%s", sb_effect_rows[effect].name);
}

static int *add_uniform(struct sb_choice *choice, const char *name)
{
    int *value =
        sb_arena_alloc(&choice->arena, (size_t)choice->scene.draw_count * sizeof *value);
    choice->uniform[choice->uniform_count++] = (struct sb_job_uniform){name, value};
    return value;
}

// What a draw calls for goes by its material and the scene's lights, all of them: an uber program
// knows which draws have a map, not which lights reach them.
static void make_switches(struct sb_choice *choice, uint32_t effects)
{
    const struct sb_analysis *analysis = &choice->analysis;
    choice->uniform =
        sb_arena_alloc(&choice->arena, (SB_EFFECT_COUNT + 1) * sizeof *choice->uniform);
    for (int e = 0; e < SB_EFFECT_COUNT; e++) {
        if (!sb_effect_rows[e].switched || !(effects >> e & 1))
            continue;
        int *value = add_uniform(choice, switch_name(&choice->arena, e));
        for (int d = 0; d < choice->scene.draw_count; d++)
            value[d] = (int)(analysis->draw[d].effects >> e & 1);
    }
    int *casters = add_uniform(choice, "u_caster_count");
    for (int d = 0; d < choice->scene.draw_count; d++)
        casters[d] = (int)analysis->draw[d].variant.value[SB_AXIS_SHADOWS];
}

void sb_switches_text(uint32_t effects, struct sb_text *text)
{
    for (int e = 0; e < SB_EFFECT_COUNT; e++)
        if (sb_effect_rows[e].switched && (effects >> e & 1))
            sb_text_printf(text, "uniform bool u_if_%s;\n", sb_effect_rows[e].name);
}

// --- which lights ---------------------------------------------------------------------------

// All lights of the types that the calls still have.
static void take_all_lights(const struct sb_variant *asked, struct sb_choice *choice,
                            struct sb_calls *calls)
{
    int total = 0, taken = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        total += sb_lights_shining(asked, (enum sb_light_type)t);
    int *light = sb_arena_alloc(&choice->arena, ((size_t)total + 1) * sizeof *light);
    for (int t = 0, number = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const int count = sb_lights_shining(asked, (enum sb_light_type)t);
        const bool left = calls->variant.value[sb_light_structs[t].axis] > 0;
        calls->light_count[t] = left ? count : 0;
        for (int i = 0; i < count; i++, number++)
            if (left)
                light[taken++] = number;
    }
    calls->light = light;
}

// --- buckets ----------------------------------------------------------------------------------

static int bucket_of(int count, int bucket, int most)
{
    int size = 1;
    if (count == 0 || bucket == SB_BUCKET_EXACT)
        return count;
    if (bucket == SB_BUCKET_ZERO_ONE_MANY)
        return count == 1 ? 1 : most;
    while (size < count)
        size *= 2;
    return size;
}

// Counts of lights become those of the next larger bucket; the loop goes by what is uploaded.
static void fill_buckets(const struct sb_variant *variant, struct sb_choice *choice)
{
    const int bucket = (int)variant->value[SB_AXIS_BUCKET];
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const int axis = sb_light_structs[t].axis;
        int most = 0;
        for (int i = 0; i < choice->program_count; i++) {
            const int count = choice->program[i].calls.light_count[t];
            most = count > most ? count : most;
        }
        for (int i = 0; i < choice->program_count; i++) {
            struct sb_calls *calls = &choice->program[i].calls;
            calls->variant.value[axis] =
                bucket_of((int)calls->variant.value[axis], bucket, most);
        }
    }
}

// --- policies ---------------------------------------------------------------------------------

static struct sb_choice_program *add_program(struct sb_choice *choice,
                                             const struct sb_calls *calls)
{
    struct sb_choice_program *program = &choice->program[choice->program_count++];
    *program = (struct sb_choice_program){.calls = *calls};
    return program;
}

static bool choose_asked(const struct sb_assemble_params *params,
                         struct sb_choice *choice, struct sb_error *err)
{
    struct sb_calls calls = {0};
    sb_calls_asked(params->axes, params->variant, &calls);
    choice->program = sb_arena_alloc(&choice->arena, sizeof *choice->program);
    choice->whole = is(params->variant, SB_AXIS_WITHOUT, SB_WITHOUT_NOTHING);
    if (!choice->whole) {
        if (!sb_scene_make(params->scene, params->variant, &choice->scene, err))
            return false;
        take_all_lights(params->variant, choice, &calls);
    }
    add_program(choice, &calls);
    return true;
}

static bool analyse(const struct sb_assemble_params *params,
                    const struct sb_variant *variant, struct sb_choice *choice,
                    struct sb_error *err)
{
    if (!sb_scene_make(params->scene, params->variant, &choice->scene, err))
        return false;
    sb_analyse(&(struct sb_analysis_params){.axes = params->axes,
                                            .variant = variant,
                                            .scene = &choice->scene},
               &choice->analysis);
    const size_t room = (size_t)choice->scene.draw_count + 1;
    choice->program = sb_arena_alloc(&choice->arena, room * sizeof *choice->program);
    return true;
}

// Its own picture is exact: whatever reaches a draw by more than nothing stays.
static bool choose_uber(const struct sb_assemble_params *params, struct sb_choice *choice,
                        struct sb_error *err)
{
    struct sb_variant exact = *params->variant, covering;
    struct sb_calls calls = {0};
    exact.value[SB_AXIS_THRESHOLD] = 0;
    if (!cover(params, &covering, err) || !analyse(params, &exact, choice, err))
        return false;
    sb_calls_asked(params->axes, &covering, &calls);
    take_all_lights(params->variant, choice, &calls);
    make_switches(choice, calls.effects);
    choice->switched = true;
    add_program(choice, &calls);
    return true;
}

static bool choose_scene(const struct sb_assemble_params *params,
                         struct sb_choice *choice, struct sb_error *err)
{
    if (!analyse(params, params->variant, choice, err))
        return false;
    add_program(choice, &choice->analysis.scene);
    fill_buckets(params->variant, choice);
    return true;
}

static bool choose_object(const struct sb_assemble_params *params,
                          struct sb_choice *choice, struct sb_error *err)
{
    if (!analyse(params, params->variant, choice, err))
        return false;
    for (int d = 0; d < choice->scene.draw_count; d++) {
        if (choice->scene.draw[d].lamp >= 0)
            continue;
        int *draw = sb_arena_alloc(&choice->arena, sizeof *draw);
        *draw = d;
        struct sb_choice_program *program =
            add_program(choice, &choice->analysis.draw[d]);
        program->draw = draw;
        program->draw_count = 1;
    }
    fill_buckets(params->variant, choice);
    return true;
}

bool sb_choose(const struct sb_assemble_params *params, struct sb_choice *choice,
               struct sb_error *err)
{
    if (!check_policy(params->axes, params->variant, err))
        return false;
    switch ((int)params->variant->value[SB_AXIS_SPECIALISE]) {
    case SB_SPECIALISE_UBER:
        return choose_uber(params, choice, err);
    case SB_SPECIALISE_SCENE:
        return choose_scene(params, choice, err);
    case SB_SPECIALISE_OBJECT:
        return choose_object(params, choice, err);
    default:
        return choose_asked(params, choice, err);
    }
}

void sb_choice_free(struct sb_choice *choice)
{
    sb_analysis_free(&choice->analysis);
    sb_scene_free(&choice->scene);
    sb_arena_free(&choice->arena);
    *choice = (struct sb_choice){0};
}
