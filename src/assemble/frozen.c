#include "assemble/frozen.h"

#include <string.h>

#include "assemble/decide.h"
#include "assemble/fixed_lights.h"
#include "base/hash.h"

bool sb_assemble_frozen(const struct sb_frozen_params *params,
                        struct sb_assembly *assembly, struct sb_error *err)
{
    const struct sb_variant *variant = params->variant;
    struct sb_arena *arena = &assembly->arena;
    if ((variant->value[SB_AXIS_API] == SB_API_GLES) != (params->caps->gles != 0))
        return sb_fail(err, SB_BAD_INPUT,
                       "a frozen program of the other API than the "
                       "context's");
    assembly->program = sb_arena_alloc(arena, sizeof *assembly->program);
    *assembly->program = (struct sb_program){
        .role = "shade",
        .vertex = sb_arena_strdup(arena, params->frozen->vertex),
        .fragment = sb_arena_strdup(arena, params->frozen->fragment),
    };
    assembly->job = (struct sb_job){
        .id = params->id,
        .variant = *variant,
        .scene = sb_arena_strdup(arena, params->scene),
        .program = assembly->program,
        .program_count = 1,
    };
    const char *const text[] = {params->frozen->vertex, params->frozen->fragment};
    uint64_t hash = SB_HASH_START;
    for (int i = 0; i < 2; i++)
        hash = sb_hash(hash, text[i], strlen(text[i]) + 1); // the NUL keeps them apart
    assembly->source_hash = assembly->lit_hash = hash;
    assembly->lit_per_vertex = variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    assembly->lights_fixed = sb_lights_are_fixed(variant);
    return true;
}
