#include "assemble/assemble.h"

#include <assert.h>
#include <string.h>

#include "assemble/decide.h"
#include "assemble/defines.h"
#include "assemble/emulated.h"
#include "assemble/fixed_lights.h"
#include "assemble/light_structs.h"
#include "assemble/platform.h"
#include "assemble/rows.h"
#include "base/file.h"
#include "base/hash.h"

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

static bool is_timed(int role)
{
    return role < SB_ROLE_PROBE;
}

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

// What all programs of a variant are built from.
struct building {
    struct sb_glsl_params glsl;
    struct sb_defines defines;
    const struct sb_glsl_version *version; // the context's
    struct sb_assembly *assembly;
};

// Only what lights has terms of reduced precision.
static bool emulates(const struct sb_variant *variant, enum sb_role role)
{
    return sb_is_emulated(variant) && role != SB_ROLE_SHADOW && role != SB_ROLE_LAMP;
}

static bool build_program(struct building *building, enum sb_role role,
                          struct sb_error *err)
{
    struct sb_assembly *assembly = building->assembly;
    const struct sb_variant *variant = &assembly->job.variant;
    struct sb_glsl_source *source = assembly->source[role];
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
    return !emulated || sb_emulate_sources(variant, building->version, &source[VERTEX],
                                           &source[FRAGMENT], err);
}

static bool is_wanted(const struct sb_assemble_params *params, bool es100, int role)
{
    if (params->rows || role == SB_ROLE_ROWS)
        return params->rows && role == SB_ROLE_ROWS;
    return is_timed(role) || (params->probe && !es100);
}

static bool build_all(struct building *building, const struct sb_assemble_params *params,
                      struct sb_error *err)
{
    struct sb_assembly *assembly = building->assembly;
    const bool es100 = assembly->job.variant.value[SB_AXIS_GLSL] == SB_GLSL_100;
    assembly->source_hash = SB_HASH_START;
    for (int role = 0; role < SB_ROLE_COUNT; role++) {
        if (!is_wanted(params, es100, role))
            continue;
        if (!build_program(building, (enum sb_role)role, err))
            return false;
        for (int stage = 0; stage < STAGES; stage++) {
            const struct sb_glsl_source *source = &assembly->source[role][stage];
            if (is_timed(role) && source->text)
                assembly->source_hash =
                    sb_hash(assembly->source_hash, &source->hash, sizeof source->hash);
        }
    }
    return true;
}

static void list_programs(struct sb_assembly *assembly)
{
    struct sb_job *job = &assembly->job;
    for (int role = 0; role < SB_ROLE_COUNT; role++) {
        const struct sb_glsl_source *source = assembly->source[role];
        if (source[VERTEX].text)
            assembly->program[job->program_count++] = (struct sb_program){
                .role = roles[role].name,
                .vertex = source[VERTEX].text,
                .geometry = source[GEOMETRY].text,
                .fragment = source[FRAGMENT].text,
            };
    }
    job->program = assembly->program;
}

static bool build(const struct sb_assemble_params *params,
                  const struct sb_glsl_version *version, struct sb_assembly *assembly,
                  struct sb_error *err)
{
    const struct sb_variant *variant = &assembly->job.variant;
    struct sb_arena *arena = &assembly->arena;
    struct building building = {
        .defines = {.arena = arena}, .version = version, .assembly = assembly};
    struct sb_text structs = {0}, arrays = {0}, lights = {0}, row = {0}, row_lights = {0};
    bool good = false;
    if (!sb_defines_make(&building.defines, params->axes, variant, version->family, err))
        goto done;
    if (assembly->lights_fixed && !params->rows &&
        !sb_fixed_lights(params->scene, variant, &lights, err))
        goto done;
    sb_light_structs_text(variant, &structs);
    sb_light_arrays_text(variant, &arrays);
    sb_row_text(variant, &row);
    sb_row_lights_text(variant, &row_lights);
    const struct sb_glsl_text given[] = {
        {SB_LIGHT_STRUCTS_FILE, sb_text_get(&structs)},
        {SB_LIGHT_ARRAYS_FILE, sb_text_get(&arrays)},
        {SB_FIXED_LIGHTS_FILE, sb_text_get(&lights)},
        {SB_ROW_FILE, sb_text_get(&row)},
        {SB_ROW_LIGHTS_FILE, sb_text_get(&row_lights)},
    };
    building.glsl = (struct sb_glsl_params){
        .root = params->shaders ? params->shaders
                                : sb_path_join(arena, params->data_dir, "shaders"),
        .define = building.defines.row,
        .define_count = building.defines.count,
        .given = given,
        .given_count = sizeof given / sizeof *given,
    };
    good = build_all(&building, params, err);

done:
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

bool sb_assemble(const struct sb_assemble_params *params, struct sb_assembly *assembly,
                 struct sb_error *err)
{
    struct sb_variant *variant = &assembly->job.variant;
    *variant = *params->variant;
    const struct sb_glsl_version *version = decide(params, variant, err);
    assembly->lit_per_vertex = variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    assembly->lights_fixed = sb_lights_are_fixed(variant);
    assembly->undefined = sb_platform_undefined(variant);
    if (!version || !build(params, version, assembly, err))
        return false;
    list_programs(assembly);
    assembly->job.id = params->id;
    if (!params->rows)
        assembly->job.scene = sb_arena_strdup(&assembly->arena, params->scene);
    return true;
}

void sb_assembly_free(struct sb_assembly *assembly)
{
    for (int role = 0; role < SB_ROLE_COUNT; role++)
        for (int stage = 0; stage < STAGES; stage++)
            sb_glsl_free(&assembly->source[role][stage]);
    sb_arena_free(&assembly->arena);
    memset(assembly, 0, sizeof *assembly);
}

// --- messages --------------------------------------------------------------------------

// The sources of a place in job.program.
static const struct sb_glsl_source *sources_of(const struct sb_assembly *assembly,
                                               int program)
{
    for (int role = 0; role < SB_ROLE_COUNT; role++)
        if (assembly->source[role][VERTEX].text && program-- == 0)
            return assembly->source[role];
    return NULL;
}

void sb_assembly_explain(const struct sb_assembly *assembly,
                         const struct sb_prepared *prepared, struct sb_text *text)
{
    const struct sb_glsl_source *source = sources_of(assembly, prepared->failed_program);
    const char *log = prepared->log ? prepared->log : "";
    if (source && prepared->failed_stage != SB_STAGE_LINK)
        sb_glsl_explain(&source[prepared->failed_stage - SB_STAGE_VERT], log, text);
    else // of linking: speaks of several stages, by name
        sb_text_add(text, log);
}

void sb_caps_ideal(bool gles, struct sb_caps *caps)
{
    *caps = (struct sb_caps){
        .context = "null",
        .vendor = "none",
        .renderer = "ideal",
        .gles = gles,
        .api_version = gles ? 320 : 460,
        .glsl = gles ? 320 : 460,
        .vertex_uniform_components = 65536,
        .fragment_uniform_components = 65536,
        .uniform_block_size = 65536,
        .varying_components = 128,
        .texture_units = 32,
        .combined_texture_units = 192,
        .texture_size = 16384,
        .cube_map_size = 16384,
        .array_layers = 2048,
        .renderbuffer_size = 16384,
        .samples = 32,
        .colour_float = 1,
        .colour_half = 1,
        .elapsed_bits = 64,
        .timestamp_bits = 64,
        .disjoint = gles,
        .samples_passed = !gles,
        .program_binary = 1,
        .geometry_shader = 1,
        .cube_map_array = 1,
    };
}
