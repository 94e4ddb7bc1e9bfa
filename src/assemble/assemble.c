#include "assemble/assemble.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "assemble/choose.h"
#include "assemble/decide.h"
#include "assemble/defines.h"
#include "assemble/emulated.h"
#include "assemble/fixed_lights.h"
#include "assemble/light_structs.h"
#include "assemble/platform.h"
#include "assemble/reduced.h"
#include "assemble/rows.h"
#include "base/file.h"
#include "base/hash.h"
#include "glsl/rename.h"

static bool check_api(const struct sb_variant *variant, const struct sb_caps *caps,
                      struct sb_error *err)
{
    const bool gles = variant->value[SB_AXIS_API] == SB_API_GLES;
    if (gles == (caps->gles != 0))
        return true;
    return sb_fail(err, SB_BAD_INPUT, "api=%s: the context is %s; valid here: %s",
                   gles ? "gles" : "gl", caps->gles ? "OpenGL ES" : "desktop OpenGL",
                   caps->gles ? "gles" : "gl");
}

// --- programs --------------------------------------------------------------------------

static const struct {
    const char *name;
    const char *stem[3]; // what the files of its stages begin with
    const char *probe;   // the value of PROBE
} roles[SB_ROLE_COUNT] = {
    [SB_ROLE_SHADE] = {"shade", {"shade", "shade", "shade"}, "off"},
    [SB_ROLE_SHADOW] = {"shadow", {"shadow", "shadow", "shadow"}, "off"},
    [SB_ROLE_LAMP] = {"lamp", {"lamp", "lamp", "lamp"}, "off"},
    [SB_ROLE_PROBE] = {"probe", {"shade", "shade", "shade"}, "on"},
    [SB_ROLE_INPUTS] = {"inputs", {"shade", "shade", "shade"}, "inputs"},
    [SB_ROLE_ROWS] = {"rows", {"rows", "rows", "shade"}, "on"},
};

// Also the suffixes of the files that begin them. SB_STAGE_VERT is stage 0.
static const char *const stage_names[] = {"vert", "geom", "frag"};
enum { VERTEX, GEOMETRY, FRAGMENT, STAGES };
static_assert(SB_STAGE_GEOM == SB_STAGE_VERT + GEOMETRY &&
                  SB_STAGE_FRAG == SB_STAGE_VERT + FRAGMENT,
              "stages are counted alike");

static bool is_asked(const struct sb_variant *variant, enum sb_role role, int stage)
{
    const bool shadows = variant->value[SB_AXIS_SHADOWS] > 0;
    const bool layered = variant->value[SB_AXIS_SHADOW_PASS] == SB_SHADOW_PASS_LAYERED;
    switch (role) {
    case SB_ROLE_SHADOW:
        return shadows && (stage != GEOMETRY || layered);
    case SB_ROLE_LAMP:
        return variant->value[SB_AXIS_LAMPS] == SB_LAMPS_ON && stage != GEOMETRY;
    default:
        return stage != GEOMETRY;
    }
}

// What the programs of one variant are built from.
struct building {
    struct sb_glsl_params glsl;
    struct sb_defines defines;
    const struct sb_variant *variant;
    const struct sb_glsl_version *version; // the context's
    struct sb_assembly *assembly;
    bool reduced; // to what is used
};

// Only what lights has terms of reduced precision.
static bool emulates(const struct sb_variant *variant, enum sb_role role)
{
    return sb_is_emulated(variant) && role != SB_ROLE_SHADOW && role != SB_ROLE_LAMP;
}

static bool build_program(struct building *building, enum sb_role role,
                          struct sb_glsl_source source[STAGES], struct sb_error *err)
{
    struct sb_assembly *assembly = building->assembly;
    const struct sb_variant *variant = building->variant;
    const bool emulated = emulates(variant, role);
    const struct sb_glsl_version *version =
        emulated ? sb_emulated_source_version(variant) : building->version;
    sb_defines_probe(&building->defines, roles[role].probe);
    sb_defines_family(&building->defines, version->family);
    building->glsl.version = version->text;
    for (int stage = 0; stage < STAGES; stage++) {
        if (!is_asked(variant, role, stage))
            continue;
        building->glsl.file = sb_arena_printf(
            &assembly->arena, "%s.%s", roles[role].stem[stage], stage_names[stage]);
        // Lit per vertex, the fragments take what vertices hand on.
        if (role == SB_ROLE_ROWS)
            sb_defines_rows(&building->defines,
                            stage == VERTEX || !assembly->lit_per_vertex);
        if (!sb_glsl_build(&building->glsl, &source[stage], err))
            return false;
    }
    if (emulated)
        return sb_emulate_sources(variant, building->version, &source[VERTEX],
                                  &source[FRAGMENT], err);
    return !building->reduced ||
           sb_reduce_sources(&source[VERTEX], &source[FRAGMENT], err);
}

static bool same_source(const struct sb_glsl_source *a, const struct sb_glsl_source *b)
{
    return (a->text == NULL) == (b->text == NULL) &&
           (!a->text || (a->hash == b->hash && strcmp(a->text, b->text) == 0));
}

// The place of a program with the same texts and role, or -1.
static int find_built(const struct sb_assembly *assembly, enum sb_role role,
                      const struct sb_glsl_source source[STAGES])
{
    for (int i = 0; i < assembly->built_count; i++) {
        const struct sb_built *built = &assembly->built[i];
        bool same = built->role == role;
        for (int stage = 0; same && stage < STAGES; stage++)
            same = same_source(&built->source[stage], &source[stage]);
        if (same)
            return i;
    }
    return -1;
}

// Adds the program, unless it is there. *place is where it stands.
static bool add_program(struct building *building, enum sb_role role, int *place,
                        struct sb_error *err)
{
    struct sb_assembly *assembly = building->assembly;
    struct sb_built made = {.role = role};
    const bool good = build_program(building, role, made.source, err);
    *place = good ? find_built(assembly, role, made.source) : -1;
    if (good && *place < 0 && made.source[VERTEX].text) {
        *place = assembly->built_count;
        assembly->built[assembly->built_count++] = made;
        return true;
    }
    for (int stage = 0; stage < STAGES; stage++)
        sb_glsl_free(&made.source[stage]);
    return good;
}

// Of the texts of roles up to `last`.
static uint64_t hash_sources(const struct sb_assembly *assembly, enum sb_role last)
{
    uint64_t hash = SB_HASH_START;
    for (int i = 0; i < assembly->built_count; i++) {
        const struct sb_built *built = &assembly->built[i];
        for (int stage = 0; built->role <= last && stage < STAGES; stage++) {
            const struct sb_glsl_source *source = &built->source[stage];
            if (source->text)
                hash = sb_hash(hash, &source->hash, sizeof source->hash);
        }
    }
    return hash;
}

static void list_programs(struct sb_assembly *assembly)
{
    struct sb_job *job = &assembly->job;
    assembly->program = sb_arena_alloc(&assembly->arena, (size_t)assembly->built_count *
                                                             sizeof *assembly->program);
    for (int i = 0; i < assembly->built_count; i++) {
        const struct sb_glsl_source *source = assembly->built[i].source;
        assembly->program[job->program_count++] = (struct sb_program){
            .role = roles[assembly->built[i].role].name,
            .vertex = source[VERTEX].text,
            .geometry = source[GEOMETRY].text,
            .fragment = source[FRAGMENT].text,
        };
    }
    job->program = assembly->program;
}

// Builds the programs of these roles (a set of bits) for one variant; *place is that of the last.
static bool build(const struct sb_assemble_params *params, struct building *building,
                  uint32_t wanted, int *place, struct sb_error *err)
{
    const struct sb_variant *variant = building->variant;
    struct sb_assembly *assembly = building->assembly;
    struct sb_arena *arena = &assembly->arena;
    struct sb_text structs = {0}, arrays = {0}, lights = {0}, row = {0}, row_lights = {0},
                   switches = {0};
    bool good = false;
    building->defines.arena = arena;
    if (!sb_defines_make(&building->defines, params->axes, variant,
                         building->version->family, err))
        goto done;
    if (assembly->lights_fixed && !params->rows &&
        !sb_fixed_lights(params->scene, variant, &lights, err))
        goto done;
    sb_light_structs_text(variant, &structs);
    sb_light_arrays_text(variant, &arrays);
    sb_row_text(variant, &row);
    sb_row_lights_text(variant, &row_lights);
    if (building->defines.switched)
        sb_switches_text(sb_effects_of(params->axes, variant), &switches);
    const struct sb_glsl_text given[] = {
        {SB_LIGHT_STRUCTS_FILE, sb_text_get(&structs)},
        {SB_LIGHT_ARRAYS_FILE, sb_text_get(&arrays)},
        {SB_FIXED_LIGHTS_FILE, sb_text_get(&lights)},
        {SB_ROW_FILE, sb_text_get(&row)},
        {SB_ROW_LIGHTS_FILE, sb_text_get(&row_lights)},
        {SB_SWITCHES_FILE, sb_text_get(&switches)},
    };
    building->glsl = (struct sb_glsl_params){
        .root = params->shaders ? params->shaders
                                : sb_path_join(arena, params->data_dir, "shaders"),
        .define = building->defines.row,
        .define_count = building->defines.count,
        .given = given,
        .given_count = sizeof given / sizeof *given,
    };
    good = true;
    for (int role = 0; good && role < SB_ROLE_COUNT; role++)
        if (wanted >> role & 1)
            good = add_program(building, (enum sb_role)role, place, err);

done:
    sb_text_free(&switches);
    sb_text_free(&row_lights);
    sb_text_free(&row);
    sb_text_free(&lights);
    sb_text_free(&arrays);
    sb_text_free(&structs);
    return good;
}

// What is open in the variant, and what of it the driver cannot do.
static const struct sb_glsl_version *decide(const struct sb_assemble_params *params,
                                            struct sb_variant *variant,
                                            struct sb_error *err)
{
    if (params->movable_lights && sb_lights_are_fixed(variant))
        variant->value[SB_AXIS_STORAGE] = SB_STORAGE_AUTO;
    if (!check_api(variant, params->caps, err))
        return NULL;
    const struct sb_glsl_version *version =
        sb_decide_version(params->axes, params->caps, variant, err);
    if (version && !sb_decide_emulation(version, variant, err))
        return NULL;
    if (params->rows)
        return version && sb_decide_rows(params->axes, variant, err) ? version : NULL;
    return version && sb_decide_slips(params->axes, variant, err) &&
                   sb_decide_loop(variant, err) &&
                   sb_decide_shadows(params->axes, params->caps, variant, err) &&
                   sb_decide_storage(params->axes, params->caps, variant, err)
               ? version
               : NULL;
}

// --- what lights which draws ------------------------------------------------------------

// The job's variant stays what was asked for; what its programs have decided is written into it.
static void take_decisions(struct sb_assembly *assembly, const struct sb_choice *choice,
                           const struct sb_variant *decided)
{
    struct sb_variant *variant = &assembly->job.variant;
    if (choice->whole)
        *variant = *decided;
    variant->value[SB_AXIS_GLSL] = decided->value[SB_AXIS_GLSL];
    variant->value[SB_AXIS_STORAGE] = decided->value[SB_AXIS_STORAGE];
}

static bool build_lit(const struct sb_assemble_params *params,
                      struct sb_assembly *assembly, const struct sb_choice *choice,
                      struct sb_choice_program *program, int *place, struct sb_error *err)
{
    struct sb_calls *calls = &program->calls;
    struct building building = {.variant = &calls->variant, .assembly = assembly};
    building.version = decide(params, &calls->variant, err);
    if (!building.version)
        return false;
    if (program == choice->program) // before its programs are built: that may fail
        take_decisions(assembly, choice, &calls->variant);
    assembly->lit_per_vertex = calls->variant.value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    assembly->lights_fixed = sb_lights_are_fixed(&calls->variant);
    building.defines.left_out =
        sb_effects_of(params->axes, &calls->variant) & ~calls->effects;
    building.defines.switched = choice->switched;
    building.reduced = calls->variant.value[SB_AXIS_SPECIALISE] != SB_SPECIALISE_ASKED;
    const uint32_t role = params->rows ? SB_ROLE_ROWS : SB_ROLE_SHADE;
    return build(params, &building, UINT32_C(1) << role, place, err);
}

static const int *copy(struct sb_arena *arena, const int *values, int count)
{
    int *copied = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *copied);
    if (count > 0)
        memcpy(copied, values, (size_t)count * sizeof *copied);
    return copied;
}

static int lit_draws(const struct sb_scene *scene, int *draw)
{
    int count = 0;
    for (int i = 0; i < scene->draw_count; i++)
        if (scene->draw[i].lamp < 0)
            draw[count++] = i;
    return count;
}

static void add_lit(struct sb_assembly *assembly, const struct sb_choice *choice,
                    const struct sb_choice_program *program, struct sb_lit *lit)
{
    const struct sb_calls *calls = &program->calls;
    struct sb_arena *arena = &assembly->arena;
    int lights = 0;
    lit->variant = calls->variant;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        lit->light_count[t] = calls->light_count[t];
        lights += calls->light_count[t];
    }
    lit->light = copy(arena, calls->light, lights);
    if (program->draw) {
        lit->draw = copy(arena, program->draw, program->draw_count);
        lit->draw_count = program->draw_count;
    } else {
        int *draw =
            sb_arena_alloc(arena, ((size_t)choice->scene.draw_count + 1) * sizeof *draw);
        lit->draw_count = lit_draws(&choice->scene, draw);
        lit->draw = draw;
    }
}

// Entries by program, so that a frame changes it as seldom as it can; else in the scene's order.
static void list_lit(struct sb_assembly *assembly, const struct sb_choice *choice,
                     const int *place)
{
    struct sb_job *job = &assembly->job;
    struct sb_lit *lit =
        sb_arena_alloc(&assembly->arena, (size_t)choice->program_count * sizeof *lit);
    for (int built = 0; built < assembly->built_count; built++) {
        for (int i = 0; i < choice->program_count; i++) {
            if (place[i] != built)
                continue;
            add_lit(assembly, choice, &choice->program[i], &lit[job->lit_count]);
            lit[job->lit_count++].program = built;
        }
    }
    job->lit = lit;
    struct sb_job_uniform *uniform = sb_arena_alloc(
        &assembly->arena, ((size_t)choice->uniform_count + 1) * sizeof *uniform);
    for (int i = 0; i < choice->uniform_count; i++)
        uniform[i] = (struct sb_job_uniform){
            sb_arena_strdup(&assembly->arena, choice->uniform[i].name),
            copy(&assembly->arena, choice->uniform[i].value, choice->scene.draw_count)};
    job->uniform = uniform;
    job->uniform_count = choice->uniform_count;
    job->draw_count = choice->scene.draw_count;
}

// What else is drawn, and instrumented twins: of a program that lights all both, else that which
// tells what any of them is given.
static bool build_others(const struct sb_assemble_params *params,
                         struct sb_assembly *assembly, bool whole, struct sb_error *err)
{
    const struct sb_variant *variant = &assembly->job.variant;
    const bool es100 = variant->value[SB_AXIS_GLSL] == SB_GLSL_100;
    const uint32_t inputs = UINT32_C(1) << SB_ROLE_INPUTS,
                   probes = inputs | UINT32_C(1) << SB_ROLE_PROBE;
    struct building building = {
        .variant = variant,
        .version = sb_glsl_version_of((int)variant->value[SB_AXIS_GLSL]),
        .assembly = assembly,
    };
    uint32_t wanted = UINT32_C(1) << SB_ROLE_SHADOW | UINT32_C(1) << SB_ROLE_LAMP;
    int place;
    if (params->probe && !es100)
        wanted |= whole ? probes : inputs;
    return build(params, &building, wanted, &place, err);
}

static bool build_all(const struct sb_assemble_params *params,
                      struct sb_assembly *assembly, struct sb_choice *choice,
                      struct sb_error *err)
{
    const size_t room = (size_t)choice->program_count + SB_ROLE_COUNT;
    int *place = sb_arena_alloc(&assembly->arena, room * sizeof *place);
    assembly->built = sb_arena_alloc(&assembly->arena, room * sizeof *assembly->built);
    for (int i = 0; i < choice->program_count; i++)
        if (!build_lit(params, assembly, choice, &choice->program[i], &place[i], err))
            return false;
    assembly->undefined = sb_platform_undefined(&assembly->job.variant);
    if (!params->rows && !build_others(params, assembly, choice->whole, err))
        return false;
    if (!choice->whole)
        list_lit(assembly, choice, place);
    return true;
}

bool sb_assemble(const struct sb_assemble_params *params, struct sb_assembly *assembly,
                 struct sb_error *err)
{
    struct sb_choice choice = {0};
    assembly->job.variant = *params->variant;
    const bool good =
        sb_choose(params, &choice, err) && build_all(params, assembly, &choice, err);
    sb_choice_free(&choice);
    if (!good)
        return false;
    assembly->source_hash = hash_sources(assembly, SB_ROLE_PROBE - 1);
    assembly->lit_hash = hash_sources(assembly, SB_ROLE_SHADE);
    list_programs(assembly);
    assembly->job.id = params->id;
    if (!params->rows)
        assembly->job.scene = sb_arena_strdup(&assembly->arena, params->scene);
    return true;
}

void sb_assembly_free(struct sb_assembly *assembly)
{
    for (int i = 0; i < assembly->built_count; i++)
        for (int stage = 0; stage < STAGES; stage++)
            sb_glsl_free(&assembly->built[i].source[stage]);
    sb_arena_free(&assembly->arena);
    memset(assembly, 0, sizeof *assembly);
}

static const char *renamed(struct sb_assembly *assembly, const char *text)
{
    char *other = text ? sb_glsl_rename(text) : NULL;
    const char *kept = other ? sb_arena_strdup(&assembly->arena, other) : NULL;
    free(other);
    return kept;
}

void sb_assembly_rename(struct sb_assembly *assembly)
{
    for (int i = 0; i < assembly->job.program_count; i++) {
        struct sb_program *program = &assembly->program[i];
        program->vertex = renamed(assembly, program->vertex);
        program->geometry = renamed(assembly, program->geometry);
        program->fragment = renamed(assembly, program->fragment);
    }
}

const struct sb_glsl_source *sb_assembly_sources(const struct sb_assembly *assembly,
                                                 enum sb_role role)
{
    static const struct sb_glsl_source none[STAGES];
    for (int i = 0; i < assembly->built_count; i++)
        if (assembly->built[i].role == role)
            return assembly->built[i].source;
    return none;
}

// --- messages --------------------------------------------------------------------------

void sb_assembly_explain(const struct sb_assembly *assembly,
                         const struct sb_prepared *prepared, struct sb_text *text)
{
    const int place = prepared->failed_program;
    const struct sb_glsl_source *source =
        place < assembly->built_count ? assembly->built[place].source : NULL;
    const char *log = prepared->log ? prepared->log : "";
    if (source && prepared->failed_stage != SB_STAGE_LINK)
        sb_glsl_explain(&source[prepared->failed_stage - SB_STAGE_VERT], log, text);
    else // of linking: speaks of several stages, by name
        sb_text_add(text, log);
}
