// The judgement of a timer audit, and of a precision probe: pure functions over readings.
// Reading is the business of layer gl; nothing here knows GL.
#pragma once

#include <stdbool.h>
#include <stdint.h>

enum sb_load { SB_LOAD_FRAGMENT, SB_LOAD_VERTEX, SB_LOAD_COUNT };

enum { SB_TIMER_MAX = 8, SB_READING_MAX = 1024 };

// One batch of `frames` whole frames of a synthetic load, timed by one source. A source
// that reads no query (wall) leaves query_ns equal to wall_ns.
struct sb_timer_reading {
    int source; // place in sb_audit.source
    enum sb_load load;
    int size;            // the target is size x size pixels
    int frames;          // K: whole frames in the batch, over a ring of targets
    int64_t query_ns;    // what the source says of the batch
    int64_t wall_ns;     // monotonic clock from before the first command to drained
    int64_t wait_ns;     // what waiting for any batch costs by itself, a part of wall_ns
    int64_t drained_ns;  // K frames, each drained by itself: the sum of their wall times
    int64_t samples;     // samples that passed in the batch, and in one frame; -1 where
    int64_t samples_one; // the API cannot count them
    bool disjoint;
};

struct sb_timer_source {
    const char *name;      // "elapsed+finish": the word in --timer and timer_source
    bool usable;           // the context has what it needs
    int bits;              // GL_QUERY_COUNTER_BITS; 0 for wall
    double granularity_ns; // smallest non-zero difference seen between short readings
    double empty_ns;       // median of a query around nothing
    // Filled by sb_audit_judge:
    bool credible;
    double error;      // largest |query/wall - 1| over loads, sizes, batch lengths;
                       // NAN where none could be judged; for wall the share of the wait
    double missing_ns; // most that a batch of one frame was misread by: a constant cost
    char reason[160];  // why it is not credible, or "" : one clause, for people
};

struct sb_audit {
    struct sb_timer_source source[SB_TIMER_MAX]; // in ladder order
    int source_count;
    struct sb_timer_reading reading[SB_READING_MAX];
    int reading_count;
    int chosen; // filled by the judge: first credible source, or -1
};

// Judges every usable source over the readings, fills credible, error, reason and chosen.
//
// Readings of equal source, load, size and batch length repeat each other; disjoint ones
// are left out. A ratio within one batch is judged by its median over the repeats, one
// between batches by the least times, which a busy machine disturbs least. A source is
// credible when all of this holds:
//
// - it has counter bits, or reads no query (query_ns equals wall_ns throughout);
// - no reading is negative, not all are disjoint, and at most a quarter is absurd (over
//   ten times its wall; the first query of a context may be);
// - samples that passed in K frames are K times one frame's, and the fragment load's more
//   than none;
// - query / (wall - wait) lies in [1 - tolerance, 1 + tolerance]. Judged from 2 ms of wall on,
//   since shorter batches are mostly overhead; each load must have such batches. A source
//   that reads no query is the wall clock itself: its error is the share of the wait, which
//   says how far it may be trusted, and refuses nothing;
// - K >= 2 frames of the fragment load in a batch take at least 0.8 of K drained frames,
//   else draws were dropped. Judged where a drained frame takes 1 ms or more, so that the
//   draining itself counts for little; there must be such batches. The vertex load is
//   exempt: the vertex work of a frame may overlap the pixels of the frame before, which
//   draining forbids;
// - twice the frames read as 0.8 to 1.25 times twice the time, from 2 ms of wall on. These
//   are two batches, whose noise does not cancel as that of two clocks over one batch
//   does. For the vertex load 0.7 will do: two stages that overlap fully turn 2 and 4
//   units of time into 2 and 3.
void sb_audit_judge(struct sb_audit *audit, double tolerance);

// --- precision ---------------------------------------------------------------------------

enum sb_effective {
    SB_EFFECTIVE_UNKNOWN,
    SB_EFFECTIVE_FP32,
    SB_EFFECTIVE_FP16,
    SB_EFFECTIVE_OTHER
};
extern const char *const sb_effective_names[]; // "unknown", "fp32", "fp16", "other"

// What a precision qualifier stands on, each probed by itself.
enum sb_carrier {
    SB_CARRIER_ARITHMETIC, // operations on local variables
    SB_CARRIER_UNIFORM,
    SB_CARRIER_VARYING, // fragment stage: declared so in both stages; vertex stage: in this
                        // one alone
    SB_CARRIER_SAMPLER, // what a lookup in a float texture returns
    SB_CARRIER_OUTPUT,  // of the fragment shader, to a float target
    SB_CARRIER_COUNT
};

struct sb_carrier_row {
    const char *name;
    bool vertex; // the vertex stage has it, as the fragment stage has all
};
extern const struct sb_carrier_row sb_carriers[SB_CARRIER_COUNT];

enum { SB_PRECISION_COUNT = 3, SB_PRECISION_MAX = 2 * SB_CARRIER_COUNT * 3 };
extern const char *const sb_precision_names[SB_PRECISION_COUNT]; // "highp" …

// What one stage made of one carrier at one declared precision.
//
// Arithmetic: results of chained operations on uniforms (docs/method.md has the table; two
// operations at least, since drivers fold single ones). The others carry one value each from
// where it is single precision to where it is computed with at highp; the rest of the sum
// named here is done by the reader, so that the same four numbers answer the same questions.
struct sb_precision_reading {
    bool vertex_stage;
    enum sb_carrier carrier;
    int precision; // 0 highp 1 mediump 2 lowp
    float add;     // (2048+1)+1, or 2 * carried 2049 - 2048:  2050 fp32, 2048 fp16
    float square;  // (256*256)/256, carried 65536 / 256:      256 fp32; inf, 255.875 fp16
    float tiny;    // ((2^-14*2^-6)*2^10)*2^10, carried 2^-20 * 2^20: 1 kept, 0 flushed
    float round;   // (1+b)*1-1, carried 1+b - 1, b = 1.5*2^-11: b fp32; RNE 2^-10; RTZ 0
    // NAN where not asked. Arithmetic:
    float lone;      // 2048+1, alone between highp: 2049 where folded, else 2048 at fp16
    float nan_left;  // max(0/0, 1)
    float nan_right; // max(1, 0/0)
    float pow_zero;  // pow(0, 0)
    // Uniform, sampler, and varying where the stage that reads declares it so:
    float used; // (carried 2049-1024)-1024 at the carrier's precision: 1 kept, 0 rounded
};

// Fills stage, carrier and precision of all that there is to ask, at most SB_PRECISION_MAX:
// the fragment stage first, carriers in the order above. The rest is NAN. Returns the count.
int sb_precision_questions(struct sb_precision_reading *reading);

struct sb_precision_verdict {
    enum sb_effective effective; // OTHER: a mixture of the two, or neither; UNKNOWN is
                                 // never given: it stands for "not probed"
    bool overflow_inf;           // else saturates (fp16 only)
    bool subnormals;             // kept (fp16 only)
    bool round_nearest;          // else towards zero (fp16 only)
    bool lone_folded;    // arithmetic of fp16: a lone operation between highp is at fp32
    bool rounded_in_use; // carried at fp32, and rounded when computed with at fp16
    // "honoured as fp16 (overflow to inf, subnormals kept, round to nearest even)",
    // "ignored: fp32", "partly: …"
    char text[160];
};
void sb_precision_judge(const struct sb_precision_reading *reading,
                        struct sb_precision_verdict *verdict);
