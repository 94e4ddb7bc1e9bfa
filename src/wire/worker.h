// The runner behind a pipe: each call becomes a message to a process of its own, which a driver
// may take down, hang or exhaust without harm to this one.
//
// When a worker dies, does not answer in time or writes garbage, a fresh one takes its place and
// is told of the jobs again as they are needed. A round that this happens in is lost: all its
// samples have SB_SAMPLE_LOST. The batch that was under way is held against its job, as is a
// prepare or an image; at the second time the job is given up: its samples are lost from then on,
// `holds` says why, and its other calls fail with SB_WORKER_CRASHED, _HUNG or _GARBAGE.
#pragma once

#include "job/job.h"

extern const struct sb_runner_fns sb_runner_worker;
