#include <math.h>
#include <stdio.h>

#include "stats/audit.h"

const char *const sb_precision_names[SB_PRECISION_COUNT] = {"highp", "mediump", "lowp"};

const char *const sb_effective_names[] = {
    [SB_EFFECTIVE_UNKNOWN] = "unknown",
    [SB_EFFECTIVE_FP32] = "fp32",
    [SB_EFFECTIVE_FP16] = "fp16",
    [SB_EFFECTIVE_OTHER] = "other",
};

const struct sb_carrier_row sb_carriers[SB_CARRIER_COUNT] = {
    [SB_CARRIER_ARITHMETIC] = {"arithmetic", true},
    [SB_CARRIER_UNIFORM] = {"uniform", true},
    [SB_CARRIER_VARYING] = {"varying", true},
    [SB_CARRIER_SAMPLER] = {"sampler", true},
    [SB_CARRIER_OUTPUT] = {"output", false},
};

int sb_precision_questions(struct sb_precision_reading *reading)
{
    int count = 0;
    for (int i = 0; i < SB_PRECISION_MAX; i++) {
        const int precision = i % SB_PRECISION_COUNT;
        const int carrier = i / SB_PRECISION_COUNT % SB_CARRIER_COUNT;
        const bool vertex = i / SB_PRECISION_COUNT / SB_CARRIER_COUNT;
        if (vertex && !sb_carriers[carrier].vertex)
            continue;
        reading[count++] = (struct sb_precision_reading){
            .vertex_stage = vertex,
            .carrier = (enum sb_carrier)carrier,
            .precision = precision,
            .add = NAN,
            .square = NAN,
            .tiny = NAN,
            .round = NAN,
            .lone = NAN,
            .nan_left = NAN,
            .nan_right = NAN,
            .pow_zero = NAN,
            .used = NAN,
        };
    }
    return count;
}

// What each number gives away. IEEE 754 binary16 has 11 significant bits, 65504 as its
// largest and 2^-14 as its smallest normal number. A quotient may be 2.5 ulp of fp32 off
// and an interpolated value some ulp, which is far less than what fp16 takes away.

static bool near(float x, float y)
{
    return fabsf(x - y) <= 0x1p-20f * fmaxf(1, y);
}

static enum sb_effective of_add(float add)
{
    // 2049 needs 12 bits: the tie goes to the even 2048 each time, or is cut to it.
    return near(add, 2050)   ? SB_EFFECTIVE_FP32
           : near(add, 2048) ? SB_EFFECTIVE_FP16
                             : SB_EFFECTIVE_OTHER;
}

static enum sb_effective of_square(float square)
{
    // Where 65536 saturates, 65504 / 256 = 255.875 comes back, give or take its last bit.
    const bool saturated = square >= 255.75f && square < 255.95f;
    return near(square, 256)                   ? SB_EFFECTIVE_FP32
           : saturated || (square == INFINITY) ? SB_EFFECTIVE_FP16
                                               : SB_EFFECTIVE_OTHER;
}

static enum sb_effective of_round(float round)
{
    // 1 + 0.75 ulp is rounded up to nearest, or cut to 1.
    return near(round, 0x1.8p-11f)                   ? SB_EFFECTIVE_FP32
           : near(round, 0x1p-10f) || near(round, 0) ? SB_EFFECTIVE_FP16
                                                     : SB_EFFECTIVE_OTHER;
}

static enum sb_effective of_used(float used)
{
    return near(used, 1)   ? SB_EFFECTIVE_FP32
           : near(used, 0) ? SB_EFFECTIVE_FP16
                           : SB_EFFECTIVE_OTHER;
}

// All that the reading says, question by question.
struct answers {
    enum sb_effective add, square, round, used, lone; // UNKNOWN: not asked
    bool kept,
        flushed; // 2^-20 is a normal number of fp32: only fp16 can flush it, and it
                 // may as well keep it
};

static struct answers answers_of(const struct sb_precision_reading *reading)
{
    struct answers answers = {
        .add = of_add(reading->add),
        .square = of_square(reading->square),
        .round = of_round(reading->round),
        .kept = near(reading->tiny, 1),
        .flushed = near(reading->tiny, 0),
    };
    if (!isnan(reading->used))
        answers.used = of_used(reading->used);
    if (!isnan(reading->lone)) // 2048 + 1 lacks the second 1 of the chain
        answers.lone = of_add(reading->lone == 2048 ? 2048 : reading->lone + 1);
    return answers;
}

static bool all_fp32(const struct answers *a, bool wide)
{
    // A value carried whole may be rounded as soon as it is computed with below highp.
    const bool use = a->used == SB_EFFECTIVE_UNKNOWN || a->used == SB_EFFECTIVE_FP32 ||
                     (a->used == SB_EFFECTIVE_FP16 && !wide);
    const bool lone = a->lone == SB_EFFECTIVE_UNKNOWN || a->lone == SB_EFFECTIVE_FP32;
    return a->add == SB_EFFECTIVE_FP32 && a->square == SB_EFFECTIVE_FP32 &&
           a->round == SB_EFFECTIVE_FP32 && a->kept && use && lone;
}

static bool all_fp16(const struct answers *a)
{
    const bool use = a->used == SB_EFFECTIVE_UNKNOWN || a->used == SB_EFFECTIVE_FP16;
    return a->add == SB_EFFECTIVE_FP16 && a->square == SB_EFFECTIVE_FP16 &&
           a->round == SB_EFFECTIVE_FP16 && (a->kept || a->flushed) && use &&
           a->lone != SB_EFFECTIVE_OTHER;
}

static const char *word(enum sb_effective effective)
{
    return effective == SB_EFFECTIVE_FP32   ? "fp32"
           : effective == SB_EFFECTIVE_FP16 ? "fp16"
                                            : "neither";
}

static void say_mixture(const struct sb_precision_reading *reading,
                        const struct answers *a, struct sb_precision_verdict *verdict)
{
    const bool some_half = a->add == SB_EFFECTIVE_FP16 ||
                           a->square == SB_EFFECTIVE_FP16 ||
                           a->round == SB_EFFECTIVE_FP16 || a->flushed ||
                           a->lone == SB_EFFECTIVE_FP16 || a->used == SB_EFFECTIVE_FP16;
    const bool chain = reading->carrier == SB_CARRIER_ARITHMETIC;
    int length = snprintf(
        verdict->text, sizeof verdict->text, "%s: %s %s, %s %s, rounding %s, 2^-20 %s",
        some_half ? "partly" : "neither fp32 nor fp16", chain ? "addition" : "2049",
        word(a->add), chain ? "multiplication" : "65536", word(a->square), word(a->round),
        a->kept      ? "kept"
        : a->flushed ? "flushed"
                     : "wrong");
    const enum sb_effective last = chain ? a->lone : a->used;
    if (last != SB_EFFECTIVE_UNKNOWN)
        snprintf(verdict->text + length, sizeof verdict->text - (size_t)length, ", %s %s",
                 chain ? "alone" : "in use", word(last));
}

void sb_precision_judge(const struct sb_precision_reading *reading,
                        struct sb_precision_verdict *verdict)
{
    const struct answers answers = answers_of(reading);
    const bool wide = reading->precision == 0;
    *verdict = (struct sb_precision_verdict){.effective = SB_EFFECTIVE_OTHER};
    if (all_fp32(&answers, wide)) {
        verdict->effective = SB_EFFECTIVE_FP32;
        verdict->rounded_in_use = answers.used == SB_EFFECTIVE_FP16;
        snprintf(verdict->text, sizeof verdict->text, "%s fp32%s",
                 wide ? "honoured as" : "ignored:",
                 verdict->rounded_in_use ? ", rounded once arithmetic takes it" : "");
    } else if (all_fp16(&answers)) {
        verdict->effective = SB_EFFECTIVE_FP16;
        verdict->overflow_inf = reading->square == INFINITY;
        verdict->subnormals = answers.kept;
        verdict->round_nearest = !near(reading->round, 0);
        verdict->lone_folded = answers.lone == SB_EFFECTIVE_FP32;
        snprintf(verdict->text, sizeof verdict->text,
                 "%s fp16 (overflow %s, subnormals %s, round %s%s)",
                 wide ? "not honoured:" : "honoured as",
                 verdict->overflow_inf ? "to inf" : "saturates",
                 verdict->subnormals ? "kept" : "flushed",
                 verdict->round_nearest ? "to nearest even" : "towards zero",
                 verdict->lone_folded ? "; a lone operation fp32" : "");
    } else {
        say_mixture(reading, &answers, verdict);
    }
}
