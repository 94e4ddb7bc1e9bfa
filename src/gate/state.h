// What the files of this folder share: a gate under way.
#pragma once

#include "base/mem.h"
#include "gate/gate.h"
#include "measure/task.h"
#include "results/row_file.h"
#include "stats/counts.h"

struct sb_gate_pair { // one plan entry, on both sides
    struct sb_task task[SB_SIDES];
    const char *picture;             // word for the row; NULL: not looked at
    bool timed;                      // both are sound and their sources differ
    bool active;                     // more pairs are wanted
    struct sb_counts_reading counts; // metric instructions: what `reading` is made of
    int batch[SB_SIDES]; // frames; the same on both sides, unless params->own_batches
    double *value[SB_SIDES];
    int *process; // that each pair was measured in, of one session (sb_gate_pair_keep)
    int count, capacity; // pairs
    int written;         // of them, on disk
    int flagged; // others, of which a batch has no time; those that a worker lost aside
    struct sb_gate_reading reading;
};

struct sb_gate_session { // the processes that draw, and what they hold
    const struct sb_gate_params *params;
    int process; // 0: the gate's own; then one a confirmation
    enum sb_metric metric;
    const char *
        timer; // of the metric gpu: the source in use, on both sides; NULL: not chosen yet
    bool callgrind;                    // the processes run under it
    struct sb_driver driver[SB_SIDES]; // one and the same, unless params->apart
    bool open[SB_SIDES];               // this session's to close
    struct sb_gate_pair *pair;
    int pair_count;
};

// sides.c: opens the drivers, finds the metric and proves the timer it needs.
bool sb_gate_session_open(struct sb_gate_session *session,
                          const struct sb_gate_params *params, struct sb_error *err);
// Assembles and prepares entry `entry` of the plans as session->pair[place], in the order of places.
void sb_gate_session_prepare(struct sb_gate_session *session, int place, int entry);
void sb_gate_session_close(struct sb_gate_session *session);

// pictures.c: judges the pictures of all pairs that are loaded; sets `picture` and fails tasks.
void sb_gate_pictures(struct sb_gate_session *session);

// pairs.c
// Both sides are there, sound, and worth comparing.
bool sb_gate_pair_timed(const struct sb_gate_pair *pair);
// Both batches of a pair; where the sides share a process, as one message.
bool sb_gate_pair_shoot(struct sb_gate_session *session, const struct sb_gate_pair *pair,
                        enum sb_side first, struct sb_sample sample[SB_SIDES],
                        struct sb_error *err);
// The row of pairs.csv, and the two values where both are some.
void sb_gate_pair_row(const struct sb_gate_session *session,
                      const struct sb_gate_pair *pair, int round, enum sb_side first,
                      const struct sb_sample sample[SB_SIDES], struct sb_pair_row *row);
void sb_gate_pair_keep(struct sb_gate_pair *pair, enum sb_metric metric, int process,
                       const struct sb_sample sample[SB_SIDES]);
struct sb_gate_rounds {
    struct sb_gate_session *session;
    const struct sb_gate_rule *rule;
    bool fixed;     // rule->confirm_pairs of each pair: a confirmation, or the self-test
    double seconds; // at most
    struct sb_row_file *file; // NULL: the pairs are not written
    struct sb_arena *arena;   // for texts of rows
};
// The batch lengths of each pair that is timed, and a few unrecorded rounds. Does
// the metric see all of the work? SB_NO_TIMER where it does not.
bool sb_gate_make_ready(struct sb_gate_session *session, struct sb_error *err);
// Until no pair is active, the time is up or a signal came. False: the pairs could not be written.
bool sb_gate_rounds_run(struct sb_gate_rounds *rounds, struct sb_error *err);

// counts.c, for the metric instructions
enum { SB_COUNTS_ENVIRONMENT = 2 };
// What the processes' environment has: one thread, and no cache that shortens the second run.
extern const char *const sb_counts_environment[SB_COUNTS_ENVIRONMENT];
struct sb_gate_state;
// Opens gate->counting and tells of it. SB_BAD_INPUT where this metric says nothing here.
bool sb_gate_counts_open(struct sb_gate_state *gate, struct sb_gate_result *result,
                         struct sb_error *err);
// Counts all pairs of the session that are active, and judges them. False: the pairs could not be
// written.
bool sb_gate_counts_run(struct sb_gate_state *gate, struct sb_gate_result *result,
                        struct sb_error *err);
// Counts all candidates once more, in one fresh process.
bool sb_gate_counts_confirm(struct sb_gate_state *gate, struct sb_error *err);

// gate.c: as rows have it, 16 hexadecimal digits.
const char *sb_gate_hash_text(struct sb_arena *arena, uint64_t hash);

// record.c
struct sb_gate_state {
    struct sb_gate_params params;
    struct sb_gate_session session;
    struct sb_gate_session counting; // the same plan, where instructions are counted
    struct sb_row_file *pairs, *summary;
    struct sb_gate_row *row;
    char started[32];
    struct sb_arena arena; // texts of rows
};
// gate.json; before the first pair with complete = false.
bool sb_gate_record(const struct sb_gate_state *state,
                    const struct sb_gate_result *result, bool complete,
                    struct sb_error *err);
