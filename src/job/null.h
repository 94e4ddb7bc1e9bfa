// The null runner: no GL. Its times, pictures and failures are scripted, and it logs every
// call, so that order, stopping, checks, files and the command line are tested anywhere.
#pragma once

#include "base/text.h"
#include "job/job.h"

struct sb_null_script {
    // Time of one frame in ns; `shot` counts the shots of the run. NULL: a made-up cost of
    // lights and pixels with 2 % of noise.
    double (*frame_ns)(void *user, const struct sb_job *job, const struct sb_shot *shot,
                       int64_t count);
    // Instructions of a batch, where they are counted. NULL: a made-up cost without noise.
    int64_t (*instructions)(void *user, const struct sb_job *job,
                            const struct sb_shot *shot, int64_t count);
    // Outcome of prepare: fills error and log. NULL: all is well.
    void (*prepare)(void *user, const struct sb_job *job, struct sb_prepared *prepared);
    // The colour that fills an image. NULL: one that depends on the lights that shine.
    float (*colour)(void *user, const struct sb_job *job,
                    const struct sb_image_request *request);
    // Flags of a sample, and whether the whole round fails. NULL: none.
    unsigned (*flags)(void *user, const struct sb_shot *shot, int64_t count);
    bool (*round_fails)(void *user, int64_t round);
    double wall_over_gpu; // wall clock over timer; 0: 1
    double shadow_share;  // time of SB_PART_SHADOWS over that of the whole frame
    bool no_credible_timer;
    void *user;
    struct sb_text *log; // one line a call; NULL: none
};

// The script of an open null runner, to be changed by tests.
struct sb_null_script *sb_null_script(void *runner);
