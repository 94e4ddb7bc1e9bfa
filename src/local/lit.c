// The programs that light: one for all draws, or several, each with draws and lights of its own.
#include "local/state.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

struct sb_gl_program *sb_local_lit_next(struct sb_local_lit *lit,
                                        const struct sb_job *request, int place)
{
    const size_t room = (size_t)request->program_count;
    if (!lit->program) {
        lit->program = sb_alloc(room * sizeof *lit->program);
        lit->place = sb_alloc(room * sizeof *lit->place);
    }
    lit->place[lit->program_count] = place;
    return &lit->program[lit->program_count++];
}

// Of place `place` in the job's programs, or 0.
static GLuint program_at(const struct sb_local_lit *lit, int place)
{
    for (int i = 0; i < lit->program_count; i++)
        if (lit->place[i] == place)
            return lit->program[i].name;
    return 0;
}

// The request's arrays are its own: bindings get copies.
static const int *keep(int **room, const int *values, int count)
{
    int *kept = *room;
    memcpy(kept, values, (size_t)count * sizeof *kept);
    *room += count;
    return kept;
}

static size_t values_wanted(const struct sb_job *request, int draw_count)
{
    size_t wanted = (size_t)request->uniform_count * (size_t)draw_count + 1;
    for (int i = 0; i < request->lit_count; i++)
        wanted += (size_t)request->lit[i].draw_count;
    return wanted;
}

static bool shares_program(const struct sb_job *request, int entry)
{
    for (int i = 0; i < request->lit_count; i++)
        if (i != entry && request->lit[i].program == request->lit[entry].program)
            return true;
    return false;
}

static bool bind_entries(struct sb_local_job *job, const struct sb_job *request,
                         struct sb_error *err)
{
    struct sb_local_lit *lit = &job->lit;
    const int draws = job->scene->scene.draw_count;
    int *room = sb_alloc(values_wanted(request, draws) * sizeof *room);
    struct sb_draw_uniform uniform[SB_DRAW_UNIFORMS_MAX];
    lit->values = room;
    for (int i = 0; i < request->uniform_count; i++)
        uniform[i] = (struct sb_draw_uniform){
            request->uniform[i].name, keep(&room, request->uniform[i].value, draws)};
    for (int i = 0; i < request->lit_count; i++) {
        const struct sb_lit *entry = &request->lit[i];
        const struct sb_binding_params params = {
            .program = program_at(lit, entry->program),
            .upload = &job->scene->upload,
            .variant = &entry->variant,
            .light = entry->light,
            .light_count = entry->light_count,
            .draw = keep(&room, entry->draw, entry->draw_count),
            .draw_count = entry->draw_count,
            .draw_uniform = uniform,
            .draw_uniform_count = request->uniform_count,
            .shares_program = shares_program(request, i),
        };
        if (params.program == 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "job %" PRIu32
                           ": entry %d is lit by program %d, which is none "
                           "of role \"shade\"",
                           job->id, i, entry->program);
        if (!sb_binding_make(&lit->binding[lit->binding_count++], &params, err))
            return false;
    }
    return true;
}

bool sb_local_lit_bind(struct sb_local_job *job, const struct sb_job *request,
                       struct sb_error *err)
{
    struct sb_local_lit *lit = &job->lit;
    if (lit->program_count == 0 || (request->lit_count == 0 && lit->program_count > 1) ||
        request->uniform_count > SB_DRAW_UNIFORMS_MAX)
        return sb_fail(
            err, SB_BAD_INPUT,
            "job %" PRIu32 ": %d programs for the role \"shade\" and %d "
            "uniforms of draws; valid: one, or those of the job's entries, and "
            "at most %d",
            job->id, lit->program_count, request->uniform_count, SB_DRAW_UNIFORMS_MAX);
    const int entries = request->lit_count ? request->lit_count : 1;
    lit->binding = sb_alloc((size_t)entries * sizeof *lit->binding);
    if (request->lit_count)
        return bind_entries(job, request, err);
    lit->binding_count = 1;
    return sb_binding_make(lit->binding,
                           &(struct sb_binding_params){
                               .program = lit->program[0].name,
                               .upload = &job->scene->upload,
                               .variant = &job->variant,
                           },
                           err);
}

int sb_local_lit_switches(const struct sb_local_lit *lit, int layers)
{
    const struct sb_binding *binding = lit->binding;
    const int count = lit->binding_count;
    int within = 0;
    for (int i = 1; i < count; i++)
        within += binding[i].program != binding[i - 1].program;
    const bool between = binding[0].program != binding[count - 1].program;
    return within * layers + between * (layers - 1);
}

void sb_local_lit_free(struct sb_local_lit *lit)
{
    for (int i = 0; i < lit->binding_count; i++)
        sb_binding_free(&lit->binding[i]);
    for (int i = 0; i < lit->program_count; i++)
        sb_gl_program_free(&lit->program[i]);
    free(lit->binding);
    free(lit->program);
    free(lit->place);
    free(lit->values);
    *lit = (struct sb_local_lit){0};
}
