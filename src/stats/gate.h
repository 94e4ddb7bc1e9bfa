// The regression gate: is head slower than base by more than a tolerance? A pure function of the
// pairs measured so far; who measures asks it after each round and obeys.
//
// Base and head are measured side by side in one process (stats/paired.h). At few looks, known
// beforehand (stats/looks.h), a variant is told apart into clearly too slow, clearly not, or
// neither, for which more pairs are taken. Too slow must be confirmed by a fixed number of pairs
// in a fresh process, since a process may favour one of two equal programs for its whole life;
// so a confirmation can clear a candidate, and creates none.
#pragma once

#include <stdbool.h>

#include "stats/looks.h"
#include "stats/order.h"
#include "stats/signed_rank.h"

enum sb_gate_verdict {
    SB_GATE_OPEN,
    SB_GATE_PASS,
    SB_GATE_IMPROVED,
    SB_GATE_CANDIDATE,
    SB_GATE_REGRESSION,
    SB_GATE_NOT_CONFIRMED,
    SB_GATE_INCONCLUSIVE,
    SB_GATE_SKIPPED, // never read from pairs: the caller's to give
    SB_GATE_INVALID, // read from times that are none; else the caller's too
    SB_GATE_VERDICT_COUNT
};

struct sb_gate_verdict_row {
    const char *word; // "not-confirmed"
    const char *help;
};
extern const struct sb_gate_verdict_row sb_gate_verdict_rows[SB_GATE_VERDICT_COUNT];

// The word's place in the table, or SB_GATE_VERDICT_COUNT.
enum sb_gate_verdict sb_gate_verdict_find(const char *word);

enum { SB_GATE_PAIRS_MAX = SB_SIGNED_RANK_MAX };

struct sb_gate_rule {
    double tolerance; // 0.02: head may take 2 % longer; in [0, 1)
    double alpha;     // 0.05: how probable a false alarm of the whole family may be
    int variants;     // of the family, at least 1
    struct sb_looks looks;
    int confirm_pairs; // as looks.rounds, 1 .. SB_GATE_PAIRS_MAX
};

// Tolerance 2 %, alpha 5 %, looks after 15, 30, 60, 120 and 240 pairs, 120 to confirm.
struct sb_gate_rule sb_gate_rule_default(int variants);

enum { SB_GATE_BLOCK = 5 };

struct sb_gate_reading {
    enum sb_gate_verdict verdict;
    int n;     // pairs that were read
    int looks; // that have been taken, this one included; 0 in a confirmation
    struct sb_interval ratio; // head / base with 95 %; its n: what was ranked (see below)
    // One-sided p-values (stats/signed_rank.h) of ln(head / base):
    double p_slower;     // above ln(1 + tolerance)
    double p_within;     // below ln(1 + tolerance)
    double p_faster;     // below ln(1 - tolerance)
    double alpha;        // p_slower and p_faster count below this …
    double alpha_within; // … p_within below this
    double alpha_spent;  // of the family's alpha, by this variant's looks up to here
    double spread;       // of what was ranked (stats/power.h)
    double
        mde; // the least slowdown that n pairs and a confirmation find with 90 %, tolerance included
    double
        autocorrelation; // of ln(head / base) by ranks, see below; NAN where all are equal
    bool blocked;        // averages were ranked: autocorrelation or processes ask for it
    int ties;            // pairs of equal times
};

// What pairs 0 .. n-1, in the order in which they were measured, say at this look. `over`: no
// more will come, which makes any n a look, the last one.
//
// - CANDIDATE: p_slower < alpha / (variants * looks), of the whole schedule: Bonferroni, so a
//   family that is no slower than the tolerance has a candidate with probability alpha at most;
// - PASS: p_within < alpha / looks. A statement, not the lack of one: slower by less than the
//   tolerance. IMPROVED: it passes, and p_faster < alpha / (variants * looks) at the same look;
//   no pairs are spent on improvements;
// - OPEN: neither, and more may come; so too where n is no look, whatever the pairs say.
//   INCONCLUSIVE: neither, and this was the last look;
// - INVALID where a time is not positive and finite.
//
// Where ln(head / base) is like what it was a pair ago, autocorrelation > 0.2, ranks of pairs would
// claim too much. Then blocks of SB_GATE_BLOCK neighbours are averaged (the last
// takes what is left), and the n / SB_GATE_BLOCK averages are ranked in the pairs' place; ratio,
// spread and mde are theirs too. That few pairs look dependent by chance costs some time:
// averages of 15 or 30 pairs are too few for any verdict. Where neighbouring blocks still depend
// on each other, the confirmation is what keeps alarms down.
// Base and head come first in turns, and the second batch of a pair may be the cheaper: pairs of
// each order are taken to their own median before they are correlated, or that would hide it.
//
// `process`: NULL where all pairs are of one process, which both sides share and whose level cancels.
// Else the number of the processes that pair i is of, base's and head's own: the levels
// of two processes do not cancel, so what is ranked is the average of each two (blocked).
//
// Pairs beyond looks.rounds are not read. `scratch` has room for 4 n values.
struct sb_gate_reading sb_gate_read(const struct sb_gate_rule *rule, const double *base,
                                    const double *head, const int *process, int n,
                                    bool over, double *scratch);

// A candidate measured anew: REGRESSION where p_slower < alpha over the first confirm_pairs
// pairs, else NOT_CONFIRMED. With fewer it is OPEN, or INCONCLUSIVE if it is over. No share for
// the family: every candidate has passed that already.
struct sb_gate_reading sb_gate_confirm(const struct sb_gate_rule *rule,
                                       const double *base, const double *head,
                                       const int *process, int n, bool over,
                                       double *scratch);

// With how many pairs a look lets an unchanged variant pass in nine of ten cases; more than
// looks.rounds: expect it to be inconclusive. INT_MAX at tolerance 0.
int sb_gate_pairs_to_pass(const struct sb_gate_rule *rule, double spread);

// --- base against itself ------------------------------------------------------------------

// What the gate sees where there is nothing to see.
struct sb_gate_bias {
    int variant;              // of the largest |ratio - 1|; -1 where there is none
    struct sb_interval ratio; // its own
    double bias;              // |ratio - 1|; NAN where there is none
    double proven;            // how much of it the interval does not put down to chance
    bool tolerable;           // the tolerance is at least twice the bias
};

// `ratio`: of each variant, head being base. The largest of many is large by chance too, which
// makes this the stricter; `proven` tells a reader how much is not. The interval must be wide
// enough for a selection: of level 1 - 0.05 / variants.
struct sb_gate_bias sb_gate_bias(const struct sb_interval *ratio, int variants,
                                 double tolerance);
