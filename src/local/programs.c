// The programs of a job, by role.
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "local/state.h"

static const char *const roles[SB_LOCAL_ROLE_COUNT] = {
    [SB_LOCAL_SHADE] = "shade", [SB_LOCAL_SHADOW] = "shadow",
    [SB_LOCAL_LAMP] = "lamp",   [SB_LOCAL_ROWS] = "rows",
    [SB_LOCAL_PROBE] = "probe", [SB_LOCAL_INPUTS] = "inputs",
};

// Place in `roles` of a program's role, or SB_LOCAL_ROLE_COUNT.
static int role_of(const struct sb_program *program)
{
    int role = 0;
    while (role < SB_LOCAL_ROLE_COUNT && strcmp(roles[role], program->role) != 0)
        role++;
    return role;
}

static bool refused(const struct sb_gl_program *program, int place, const char *role,
                    struct sb_prepared *result)
{
    static const char *const stages[] = {
        [SB_STAGE_LINK] = "the program \"%s\" does not link: %.*s",
        [SB_STAGE_VERT] = "the vertex shader of program \"%s\" does not compile: %.*s",
        [SB_STAGE_GEOM] = "the geometry shader of program \"%s\" does not compile: %.*s",
        [SB_STAGE_FRAG] = "the fragment shader of program \"%s\" does not compile: %.*s",
    };
    result->failed_program = place;
    result->failed_stage = program->failed_stage;
    result->log = sb_strdup(program->log ? program->log : "");
    const size_t line = strcspn(result->log, "\n");
    return sb_fail(&result->error, SB_COMPILE_FAILED, stages[result->failed_stage], role,
                   (int)(line < 800 ? line : 800), result->log);
}

// One hash for all programs of the job; 0, and no hash, where one of them has none.
static void add_hash(struct sb_prepared *result, int place, uint64_t hash)
{
    const bool none = hash == 0 || (place > 0 && result->binary_hash == 0);
    const uint64_t before = place > 0 ? result->binary_hash : SB_HASH_START;
    result->binary_hash = none ? 0 : sb_hash(before, &hash, sizeof hash);
}

// A program that is compiled later is kept; false where there is no such role, or one already.
static bool take_role(struct sb_local_job *job, const struct sb_program *source, int role)
{
    if (role == SB_LOCAL_ROLE_COUNT)
        return false;
    if (role == SB_LOCAL_SHADE)
        return true;
    if (role < SB_LOCAL_PROBE)
        return job->program[role].name == 0;
    struct sb_program *kept = &job->probe[role - SB_LOCAL_PROBE].source;
    const bool first = kept->role == NULL;
    *kept = *source;
    return first;
}

bool sb_local_compile(struct sb_local_job *job, const struct sb_job *request,
                      struct sb_prepared *result)
{
    int compiled = 0;
    for (int i = 0; i < request->program_count; i++) {
        const struct sb_program *source = &request->program[i];
        const int role = role_of(source);
        if (!take_role(job, source, role))
            return sb_fail(&result->error, SB_BAD_INPUT,
                           "job %" PRIu32 ": a program for the role \"%s\"; valid: any "
                           "for shade, one each for shadow, lamp, probe and inputs",
                           request->id, source->role);
        if (role >= SB_LOCAL_PROBE)
            continue;
        struct sb_gl_program *program = role == SB_LOCAL_SHADE
                                            ? sb_local_lit_next(&job->lit, request, i)
                                            : &job->program[role];
        const bool ok = sb_gl_program_cached(job->cache, source, program);
        result->programs_cached += program->cached;
        result->compile_ms += program->compile_ms;
        result->link_ms += program->link_ms;
        if (!ok)
            return refused(program, i, source->role, result);
        add_hash(result, compiled++, program->binary_hash);
    }
    return true;
}

// Lit per vertex: what the vertex shader hands on, in the order of probe.c.
static const char *const captured[] = {"v_diffuse", "v_specular", "v_probe0", "v_probe1",
                                       "v_probe2"};
enum { CAPTURED_COUNT = sizeof captured / sizeof *captured };

bool sb_local_compile_rows(struct sb_local_job *job, const struct sb_job *request,
                           struct sb_prepared *result)
{
    struct sb_gl_program *program = &job->program[SB_LOCAL_ROWS];
    const bool vertex = sb_lit_per_vertex(&job->variant);
    const bool ok = sb_gl_program_make_captured(request->program, captured,
                                                vertex ? CAPTURED_COUNT : 0, program);
    result->compile_ms = program->compile_ms;
    result->link_ms = program->link_ms;
    return ok || refused(program, 0, request->program->role, result);
}

bool sb_local_compile_probe(struct sb_local_job *job, enum sb_local_role role,
                            struct sb_error *err)
{
    const bool vertex = sb_lit_per_vertex(&job->variant);
    const struct sb_program *source = &job->probe[role - SB_LOCAL_PROBE].source;
    struct sb_gl_program *program = &job->program[role];
    if (sb_gl_program_make_captured(source, captured, vertex ? CAPTURED_COUNT : 0,
                                    program))
        return true;
    struct sb_prepared result = {0};
    refused(program, 0, source->role, &result);
    if (err)
        *err = result.error;
    free(result.log);
    sb_gl_program_free(program);
    return false;
}

bool sb_local_has_role(const struct sb_local_job *job, enum sb_local_role role,
                       struct sb_error *err)
{
    if (job->program[role].name != 0)
        return true;
    return sb_fail(err, SB_BAD_INPUT,
                   "job %" PRIu32 " has no program for the role \"%s\"", job->id,
                   roles[role]);
}
