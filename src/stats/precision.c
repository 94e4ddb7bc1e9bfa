#include <math.h>
#include <stdio.h>

#include "stats/audit.h"

// What each operation gives away. IEEE 754 binary16 has 11 significant bits, 65504 as its
// largest and 2^-14 as its smallest normal number.

static enum sb_effective of_add(float add)
{
    // 2049 needs 12 bits: the tie goes to the even 2048 each time, or is cut to it.
    return add == 2050   ? SB_EFFECTIVE_FP32
           : add == 2048 ? SB_EFFECTIVE_FP16
                         : SB_EFFECTIVE_OTHER;
}

static enum sb_effective of_square(float square)
{
    // Where 65536 saturates, 65504 / 256 = 255.875 comes back, give or take its last bit.
    const bool saturated = square >= 255.75f && square < 256;
    return square == 256                       ? SB_EFFECTIVE_FP32
           : saturated || (square == INFINITY) ? SB_EFFECTIVE_FP16
                                               : SB_EFFECTIVE_OTHER;
}

static enum sb_effective of_round(float round)
{
    // 1 + 0.75 ulp is rounded up to nearest, or cut to 1.
    return round == 0x1.8p-11f               ? SB_EFFECTIVE_FP32
           : round == 0x1p-10f || round == 0 ? SB_EFFECTIVE_FP16
                                             : SB_EFFECTIVE_OTHER;
}

static const char *word(enum sb_effective effective)
{
    return effective == SB_EFFECTIVE_FP32   ? "fp32"
           : effective == SB_EFFECTIVE_FP16 ? "fp16"
                                            : "neither";
}

void sb_precision_judge(const struct sb_precision_reading *reading,
                        struct sb_precision_verdict *verdict)
{
    const enum sb_effective add = of_add(reading->add),
                            square = of_square(reading->square),
                            round = of_round(reading->round);
    // 2^-20 is a normal number of fp32: only fp16 can flush it, and it may as well keep
    // it.
    const bool kept = reading->tiny == 1, flushed = reading->tiny == 0;
    const bool wide = reading->precision == 0;
    const bool some_half = add == SB_EFFECTIVE_FP16 || square == SB_EFFECTIVE_FP16 ||
                           round == SB_EFFECTIVE_FP16 || flushed;

    *verdict = (struct sb_precision_verdict){.effective = SB_EFFECTIVE_OTHER};
    if (add == square && add == round && add == SB_EFFECTIVE_FP32 && kept) {
        verdict->effective = SB_EFFECTIVE_FP32;
        snprintf(verdict->text, sizeof verdict->text, "%s fp32",
                 wide ? "honoured as" : "ignored:");
    } else if (add == square && add == round && add == SB_EFFECTIVE_FP16 &&
               (kept || flushed)) {
        verdict->effective = SB_EFFECTIVE_FP16;
        verdict->overflow_inf = reading->square == INFINITY;
        verdict->subnormals = kept;
        verdict->round_nearest = reading->round != 0;
        snprintf(verdict->text, sizeof verdict->text,
                 "%s fp16 (overflow %s, subnormals %s, round %s)",
                 wide ? "not honoured:" : "honoured as",
                 verdict->overflow_inf ? "to inf" : "saturates",
                 kept ? "kept" : "flushed",
                 verdict->round_nearest ? "to nearest even" : "towards zero");
    } else {
        snprintf(verdict->text, sizeof verdict->text,
                 "%s: addition %s, multiplication %s, rounding %s, 2^-20 %s",
                 some_half ? "partly" : "neither fp32 nor fp16", word(add), word(square),
                 word(round),
                 kept      ? "kept"
                 : flushed ? "flushed"
                           : "wrong");
    }
}
