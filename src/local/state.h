// What the files of this folder share: an open runner, and its entries of the seam
// (contracts in job/job.h).
#pragma once

#include "context/context.h"
#include "gl/program_cache.h"
#include "gl/timer.h"
#include "local/count.h"
#include "local/local.h"
#include "render/render.h"
#include "render/shadow.h"

// --- things that jobs share, by reference count (pool.c) -------------------------------

struct sb_shared_scene {
    struct sb_shared_scene *next;
    int users;
    uint64_t hash; // sb_scene_hash
    struct sb_scene scene;
    struct sb_upload upload;
};
struct sb_shared_ring {
    struct sb_shared_ring *next;
    int users;
    struct sb_shape shape; // layers do not matter here
    struct sb_ring ring;
};
struct sb_pool {
    struct sb_shared_scene *scenes;
    struct sb_shared_ring *rings;
};

// Found or made; every get needs its put. NULL after failure.
struct sb_shared_scene *sb_pool_scene_get(struct sb_pool *pool, const char *name,
                                          const struct sb_variant *variant,
                                          struct sb_error *err);
void sb_pool_scene_put(struct sb_pool *pool,
                       struct sb_shared_scene *scene); // NULL: nothing
struct sb_shared_ring *sb_pool_ring_get(struct sb_pool *pool, const struct sb_caps *caps,
                                        const struct sb_shape *shape,
                                        struct sb_error *err);
void sb_pool_ring_put(struct sb_pool *pool, struct sb_shared_ring *ring); // NULL: nothing

// --- the runner ------------------------------------------------------------------------

enum sb_local_role {
    SB_LOCAL_SHADE, // may have several programs: struct sb_local_lit
    SB_LOCAL_SHADOW,
    SB_LOCAL_LAMP,
    SB_LOCAL_ROWS,  // alone in its job
    SB_LOCAL_PROBE, // those from here are compiled when a picture of them is asked for
    SB_LOCAL_INPUTS,
    SB_LOCAL_ROLE_COUNT
};

enum { SB_LOCAL_PROBES = SB_LOCAL_ROLE_COUNT - SB_LOCAL_PROBE };

struct sb_local_probe {
    struct sb_program source;  // the caller's texts; role NULL: none
    struct sb_binding binding; // program 0: not made yet
};

// The programs that light, and what each of them lights.
struct sb_local_lit {
    struct sb_gl_program *program; // in the order of the job
    int *place;                    // in the job's programs, of each
    int program_count;
    struct sb_binding *binding; // one an entry of the job's `lit`; one where it has none
    int binding_count;
    int *values; // own what the bindings point to
};

struct sb_local_job {
    struct sb_local_job *next;
    uint32_t id;
    struct sb_gl_program_cache *cache; // the runner's; NULL: none
    struct sb_variant variant;
    struct sb_shape shape;
    struct sb_shared_scene *scene;                     // NULL with a program "rows"
    struct sb_gl_program program[SB_LOCAL_ROLE_COUNT]; // name 0: the job has none
    struct sb_local_lit lit;                           // of the lit draws
    struct sb_binding lamp;                            // of lamps
    struct sb_local_probe probe[SB_LOCAL_PROBES];      // "probe" and "inputs"
    struct sb_binding blank; // wipes out behind lamps; program 0: not made yet
    struct sb_shadow shadow; // casters 0: none
    struct sb_shadow
        unused_shadow; // for a program that could look up more; casters 0: none
    struct sb_shared_ring *ring, *half; // half: for shots with shrink=2, made on demand
};

struct sb_local {
    const struct sb_context_fns *context;
    void *window;                      // the context's own state
    struct sb_gl_program_cache *cache; // NULL: none
    bool driver_stats;                 // to be asked for
    struct sb_caps caps;
    struct sb_gl_program id_program;
    // Made when first asked for; name 0, or no framebuffer: not yet.
    struct sb_gl_program geometry_program, blank_program;
    struct sb_target probe_target, rows_target;
    GLuint no_vertices;               // a vertex array without attributes; 0: not yet
    const struct sb_timer_fns *timer; // NULL: none chosen yet, samples carry no GPU time
    struct sb_query query;
    struct sb_counter counter; // counts the batches of rounds
    struct sb_pool pool;
    struct sb_local_job *jobs;
};

// Compiles the job's programs; what fails, and how long it took, goes into *result.
bool sb_local_compile(struct sb_local_job *job, const struct sb_job *request,
                      struct sb_prepared *result);
// Room for the programs of role "shade" among the request's. The next one of them to compile:
struct sb_gl_program *sb_local_lit_next(struct sb_local_lit *lit,
                                        const struct sb_job *request, int place);
// Binds the compiled programs to the lights and draws that the request says.
bool sb_local_lit_bind(struct sb_local_job *job, const struct sb_job *request,
                       struct sb_error *err);
// Runs of draws of one program in a frame, less 1.
int sb_local_lit_switches(const struct sb_local_lit *lit, int layers);
void sb_local_lit_free(struct sb_local_lit *lit); // zeroes it

// Compiles the program "probe" or "inputs" of a job that has its source; the error names stage
// and message.
bool sb_local_compile_probe(struct sb_local_job *job, enum sb_local_role role,
                            struct sb_error *err);
// Compiles the program "rows", the only one of its job.
bool sb_local_compile_rows(struct sb_local_job *job, const struct sb_job *request,
                           struct sb_prepared *result);
// SB_BAD_INPUT where the job has no such program.
bool sb_local_has_role(const struct sb_local_job *job, enum sb_local_role role,
                       struct sb_error *err);

bool sb_local_prepare(void *self, const struct sb_job *request,
                      struct sb_prepared *result);
bool sb_local_round(void *self, const struct sb_shot *shots, int count,
                    struct sb_sample *samples, struct sb_error *err);
bool sb_local_image(void *self, const struct sb_image_request *request,
                    struct sb_image *image, struct sb_error *err);
// SB_IMAGE_PROBE_COLOUR and SB_IMAGE_PROBE (probe.c).
bool sb_local_probe_image(struct sb_local *local, struct sb_local_job *job,
                          const struct sb_image_request *request, struct sb_image *image,
                          struct sb_error *err);
// SB_IMAGE_ROWS (rows.c).
bool sb_local_rows_image(struct sb_local *local, struct sb_local_job *job,
                         const struct sb_image_request *request, struct sb_image *image,
                         struct sb_error *err);
void sb_local_release(void *self, uint32_t id);

// SB_INTERNAL where no such job is prepared.
struct sb_local_job *sb_local_job_find(const struct sb_local *local, uint32_t id,
                                       struct sb_error *err);

// Puts the job's lights, as these bindings have uploaded them, and its shadow maps in the state of
// a picture: the first phase, and those off that the request wants off. Afterwards
// sb_local_lights_on, before anything waits: no upload may be left over for the next batch.
void sb_local_still(const struct sb_local_job *job, const struct sb_binding *binding,
                    int binding_count, const struct sb_image_request *request);
void sb_local_lights_on(const struct sb_binding *binding, int binding_count,
                        const struct sb_image_request *request);
// The size of the picture that is asked for.
struct sb_shape sb_local_shape(const struct sb_local_job *job,
                               const struct sb_image_request *request);
// Reads a target that was drawn to, or reports what went wrong.
bool sb_local_read(const struct sb_local_job *job, const struct sb_target *target,
                   const struct sb_target_part *part, struct sb_image *image,
                   struct sb_error *err);

// A frame of the job's own programs, its lights as they were last uploaded.
struct sb_frame_params sb_local_frame(const struct sb_local *local,
                                      const struct sb_local_job *job);

// One timed batch of shot->frames: nothing but clocks and the timer between the first
// command and the drain, nothing in flight afterwards. *calls (may be NULL): GL calls of
// one frame. Moving lights are left at the phase of the last frame. `counter` (may be NULL) is
// started and stopped; who gives it reads it.
void sb_local_batch(struct sb_local *local, const struct sb_local_job *job,
                    const struct sb_ring *ring, const struct sb_shot *shot,
                    struct sb_counter *counter, struct sb_sample *sample, int64_t *calls);

// False with SB_GL_ERROR where the driver has reported one since the last call; `what`
// was being done to the job: "preparing".
bool sb_local_gl_ok(const char *what, uint32_t job, struct sb_error *err);
