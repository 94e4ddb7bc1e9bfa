#include "test.h"

#include "math/random.h"
#include "stats/audit.h"

enum { REPEATS = 5, FRAME_NS = 3000000, TOLERANCE_PERCENT = 10 };

static struct sb_audit audit;

// What a scripted driver says of one reading that starts out right.
typedef void script_fn(struct sb_timer_reading *reading, int repeat);

// Adds a source with readings over both loads, three sizes and four batch lengths.
static struct sb_timer_source *add_source(const char *name, script_fn *script)
{
    static const int sizes[] = {64, 256, 512};
    const int s = audit.source_count++;
    audit.source[s] = (struct sb_timer_source){.name = name, .usable = true, .bits = 64};
    for (int load = 0; load < SB_LOAD_COUNT; load++)
        for (int size = 0; size < 3; size++)
            for (int frames = 1; frames <= 8; frames *= 2)
                for (int repeat = 0; repeat < REPEATS; repeat++) {
                    const int64_t ns = (int64_t)FRAME_NS * frames;
                    struct sb_timer_reading *reading =
                        &audit.reading[audit.reading_count++];
                    *reading = (struct sb_timer_reading){
                        .source = s,
                        .load = (enum sb_load)load,
                        .size = sizes[size],
                        .frames = frames,
                        .query_ns = ns,
                        .wall_ns = ns + 20000, // what draining adds
                        .drained_ns = ns + 20000 * frames,
                        .samples = (int64_t)sizes[size] * sizes[size] * frames,
                        .samples_one = (int64_t)sizes[size] * sizes[size],
                    };
                    if (script)
                        script(reading, repeat);
                }
    return &audit.source[s];
}

static void judge(void)
{
    sb_audit_judge(&audit, TOLERANCE_PERCENT / 100.0);
}

// Judges one scripted source alone.
static struct sb_timer_source *judge_one(script_fn *script)
{
    struct sb_timer_source *source = add_source("scripted", script);
    judge();
    assert_int_equal(audit.chosen, source->credible ? 0 : -1);
    assert_int_equal(source->reason[0] == '\0', source->credible);
    return source;
}

static int clear_audit(void **state)
{
    (void)state;
    memset(&audit, 0, sizeof audit);
    return 0;
}

static void a_right_timer_is_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(NULL);
    assert_true(source->credible);
    check_close(source->error, 20000.0 / (FRAME_NS + 20000), 1e-12);
}

static void long_wait(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->wait_ns = 400000;
    r->wall_ns = r->query_ns + r->wait_ns;
}

static void the_wait_for_a_batch_is_not_held_against_a_timer(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(long_wait);
    assert_true(source->credible);
    check_close(source->error, 0, 1e-12);
}

static void long_wait_of_the_clock(struct sb_timer_reading *r, int repeat)
{
    long_wait(r, repeat);
    r->query_ns = r->wall_ns;
}

static void the_clock_itself_has_the_wait_as_its_error(void **state)
{
    (void)state;
    struct sb_timer_source *source = add_source("wall", long_wait_of_the_clock);
    source->bits = 0;
    judge();
    assert_true(source->credible);
    check_close(source->error, 400000.0 / FRAME_NS, 1e-12);
    check_close(source->missing_ns, 400000, 0);
}

static void misses_the_start(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->wall_ns = r->query_ns;
    r->query_ns -= r->load == SB_LOAD_VERTEX ? 90000 : 30000;
}

static void what_a_batch_misses_is_told_apart_from_the_share(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(misses_the_start);
    assert_true(source->credible);
    check_close(source->missing_ns, 90000, 0);
    check_close(source->error, 90000.0 / FRAME_NS, 1e-12);
}

static void last_tile_only(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_VERTEX)
        r->query_ns = 0;
    else
        r->query_ns /= (r->size / 64) * (r->size / 64);
}

static void last_tile_of_fragments(struct sb_timer_reading *r, int repeat)
{
    if (r->load == SB_LOAD_FRAGMENT)
        last_tile_only(r, repeat);
}

static void a_timer_of_the_last_tile_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(last_tile_of_fragments);
    assert_false(source->credible);
    check_close(source->error, 1 - 3.0 / 3.02 / 64, 1e-4);
    check_contains(source->reason, "fragment load, 512 x 512");
    check_contains(source->reason, "reads 0.016 of the wall time");
}

static void no_vertex_work(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_VERTEX)
        r->query_ns = 0;
}

static void a_timer_that_misses_vertex_work_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(no_vertex_work);
    assert_false(source->credible);
    check_contains(source->reason, "vertex load");
    check_contains(source->reason, "reads 0.000 of the wall time");
}

static void the_first_credible_source_of_the_ladder_is_chosen(void **state)
{
    (void)state;
    add_source("elapsed", last_tile_only);
    add_source("elapsed+finish", NULL)->usable = false;
    add_source("timestamp+finish", NULL);
    add_source("wall", NULL);
    judge();
    assert_int_equal(audit.chosen, 2);
    assert_false(audit.source[0].credible || audit.source[1].credible);
    assert_true(audit.source[2].credible && audit.source[3].credible);
    check_contains(audit.source[1].reason, "not available");
    assert_true(isnan(audit.source[1].error));
}

static void judging_twice_gives_the_same_verdict(void **state)
{
    (void)state;
    static struct sb_audit first;
    add_source("elapsed", last_tile_only);
    add_source("elapsed+finish", NULL);
    judge();
    memcpy(&first, &audit, sizeof first);
    judge();
    assert_memory_equal(&first, &audit, sizeof first);
}

static void loses_first_frame(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns -= r->query_ns / r->frames;
}

static void a_timer_that_loses_the_first_frame_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(loses_first_frame);
    assert_false(source->credible);
    check_close(source->error, 1, 1e-12);
    check_contains(source->reason, "of the wall time");
}

static void drops_draws(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->wall_ns = r->wall_ns / 4 + r->wall_ns * 3 / (4 * r->frames);
    r->query_ns = r->wall_ns;
}

static void a_driver_that_drops_draws_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(drops_draws);
    assert_false(source->credible);
    check_contains(source->reason, "fragment load");
    check_contains(source->reason, "8 frames");
    check_contains(source->reason, "draws were dropped");
}

// A fifth of the work is left, and what is left is linear in the frames.
static void drops_draws_evenly(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->frames > 1)
        r->query_ns = r->wall_ns = r->wall_ns / 5;
}

static void dropped_draws_are_seen_where_the_time_stays_linear(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(drops_draws_evenly);
    assert_false(source->credible);
    check_contains(source->reason, "a batch takes 0.20 of the same frames");
}

// The next frame's vertex work runs while this frame's pixels are filled.
static void overlaps_vertex_work(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_VERTEX) {
        r->query_ns = (int64_t)FRAME_NS * (r->frames + 1) / 2;
        r->wall_ns = r->query_ns + 20000;
    }
}

static void overlap_of_vertex_work_is_credible(void **state)
{
    (void)state;
    assert_true(judge_one(overlaps_vertex_work)->credible);
}

static void counts_in_steps(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_VERTEX && r->frames == 8) {
        r->wall_ns = r->wall_ns * 5 / 8;
        r->query_ns = r->wall_ns;
    }
}

static void drops_late_frames(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_FRAGMENT && r->frames == 8) {
        r->wall_ns = r->wall_ns * 3 / 4;
        r->query_ns = r->wall_ns;
        r->drained_ns = 0; // not measured there
    }
}

static void superlinear_fragments(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->load == SB_LOAD_FRAGMENT && r->frames == 8) {
        r->wall_ns = r->wall_ns * 3 / 2;
        r->query_ns = r->wall_ns;
    }
}

static void twice_the_frames_must_read_as_twice_the_time(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(counts_in_steps);
    assert_false(source->credible);
    check_contains(source->reason, "vertex load");
    check_contains(source->reason, "twice the frames read as 1.25 times the time");
    clear_audit(state);
    source = judge_one(drops_late_frames);
    assert_false(source->credible);
    check_contains(source->reason, "fragment load");
    check_contains(source->reason, "4 frames: twice the frames read as 1.5");
    clear_audit(state);
    source = judge_one(superlinear_fragments);
    assert_false(source->credible);
    check_contains(source->reason, "4 frames: twice the frames read as 3.0");
}

static void draws_too_few_samples(struct sb_timer_reading *r, int repeat)
{
    if (r->frames == 4 && repeat == 2)
        r->samples -= 1;
}

static void draws_nothing(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->samples = r->samples_one = 0;
}

static void cannot_count(struct sb_timer_reading *r, int repeat)
{
    *(repeat % 2 ? &r->samples : &r->samples_one) = -1;
}

static void samples_must_be_a_frames_times_the_frames(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(draws_too_few_samples);
    assert_false(source->credible);
    check_contains(source->reason, "16383 samples passed, not 4 times 4096");
    clear_audit(state);
    source = judge_one(draws_nothing);
    assert_false(source->credible);
    check_contains(source->reason, "nothing was drawn");
    clear_audit(state);
    assert_true(judge_one(cannot_count)->credible);
}

static void is_wall(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns = r->wall_ns;
}

static void a_counter_of_zero_bits_is_not_credible_but_wall_is(void **state)
{
    (void)state;
    struct sb_timer_source *source = add_source("elapsed", NULL);
    source->bits = 0;
    judge();
    assert_false(source->credible);
    check_contains(source->reason, "0 bits");
    clear_audit(state);
    source = add_source("wall", is_wall);
    source->bits = 0;
    judge();
    assert_true(source->credible);
    assert_int_equal(audit.chosen, 0);
    check_close(source->error, 0, 0);
}

static void wall_too_is_not_credible_where_draws_are_dropped(void **state)
{
    (void)state;
    struct sb_timer_source *source = add_source("wall", drops_draws);
    source->bits = 0;
    judge();
    assert_false(source->credible);
    check_contains(source->reason, "draws were dropped");
}

static void goes_backwards_once(struct sb_timer_reading *r, int repeat)
{
    if (r->size == 256 && r->frames == 2 && repeat == 0 && r->load == SB_LOAD_FRAGMENT)
        r->query_ns = -5;
}

static void a_negative_reading_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(goes_backwards_once);
    assert_false(source->credible);
    check_contains(source->reason, "negative (-5 ns)");
}

static void starts_absurdly(struct sb_timer_reading *r, int repeat)
{
    if (repeat == 0)
        r->query_ns = 1000000000000;
}

static void is_often_absurd(struct sb_timer_reading *r, int repeat)
{
    if (repeat < 2)
        r->query_ns = 1000000000000;
}

static void a_few_absurd_readings_are_borne_and_many_are_not(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(starts_absurdly);
    assert_true(source->credible);
    check_close(source->error, 20000.0 / (FRAME_NS + 20000), 1e-12);
    clear_audit(state);
    source = judge_one(is_often_absurd);
    assert_false(source->credible);
    check_contains(source->reason,
                   "48 of 120 readings are over ten times their wall time");
}

static void is_disjoint(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->disjoint = true;
}

static void is_disjoint_and_wrong_at_times(struct sb_timer_reading *r, int repeat)
{
    if (repeat >= 2) {
        r->disjoint = true;
        r->query_ns = -r->query_ns;
        r->samples = 1;
    }
}

static void disjoint_readings_are_left_out(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(is_disjoint);
    assert_false(source->credible);
    assert_true(isnan(source->error));
    check_contains(source->reason, "all 120 readings are disjoint");
    clear_audit(state);
    assert_true(judge_one(is_disjoint_and_wrong_at_times)->credible);
}

// Noise of 3 % on both clocks alike and on each, and a spike in every fifth reading.
static void is_noisy(struct sb_timer_reading *r, int repeat)
{
    static struct sb_random random;
    if (random.state[0] == 0 && random.state[1] == 0)
        random = sb_random_seed(17);
    const double common = .97 + .06 * sb_random_unit(&random);
    const double spike = repeat == 3 ? 3 : 1;
    r->drained_ns =
        (int64_t)((double)r->drained_ns * (.97 + .06 * sb_random_unit(&random)));
    r->wall_ns = (int64_t)((double)r->wall_ns * common * spike);
    r->query_ns =
        (int64_t)((double)r->query_ns * common * (.98 + .02 * sb_random_unit(&random)) *
                  (repeat == 1 ? 2 : spike));
}

static void noise_with_spikes_is_borne(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++) {
        clear_audit(state);
        const struct sb_timer_source *source = add_source("noisy", is_noisy);
        sb_audit_judge(&audit, .05);
        assert_true(source->credible);
        assert_true(source->error < .05);
    }
}

static void runs_slow(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns = r->wall_ns * 91 / 100;
}

static void runs_slower(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns = r->wall_ns * 89 / 100;
}

static void runs_fast(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns = r->wall_ns * 111 / 100;
}

static void the_tolerance_is_the_same_on_both_sides(void **state)
{
    (void)state;
    assert_true(judge_one(runs_slow)->credible);
    clear_audit(state);
    assert_false(judge_one(runs_slower)->credible);
    clear_audit(state);
    const struct sb_timer_source *source = judge_one(runs_fast);
    assert_false(source->credible);
    check_contains(source->reason, "not 0.90 to 1.10");
}

static void has_overhead_when_small(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->size == 64) {
        r->query_ns /= 20;
        r->wall_ns = r->query_ns + 100000;
        r->drained_ns = r->query_ns + 100000 * r->frames;
    }
}

static void batches_that_are_mostly_overhead_are_not_judged(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(has_overhead_when_small);
    assert_true(source->credible);
    assert_true(source->error < .01);
}

static void is_short(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    r->query_ns /= 20;
    r->wall_ns = r->query_ns + 1000;
}

static void has_short_frames(struct sb_timer_reading *r, int repeat)
{
    (void)repeat;
    if (r->frames > 1)
        r->drained_ns = r->frames * 900000;
}

static void has_a_short_vertex_load(struct sb_timer_reading *r, int repeat)
{
    if (r->load == SB_LOAD_VERTEX)
        is_short(r, repeat);
}

static void a_source_that_cannot_be_judged_is_not_credible(void **state)
{
    (void)state;
    const struct sb_timer_source *source = judge_one(is_short);
    assert_false(source->credible);
    assert_true(isnan(source->error));
    check_contains(source->reason, "no batch of the fragment load took 2 ms");
    clear_audit(state);
    source = judge_one(has_a_short_vertex_load);
    assert_false(source->credible);
    check_contains(source->reason, "no batch of the vertex load took 2 ms");
    clear_audit(state);
    source = judge_one(has_short_frames);
    assert_false(source->credible);
    check_contains(source->reason, "to show dropped draws");
    clear_audit(state);
    audit.source[audit.source_count++] =
        (struct sb_timer_source){.name = "elapsed", .usable = true, .bits = 64};
    judge();
    assert_false(audit.source[0].credible);
    assert_int_equal(audit.chosen, -1);
    check_contains(audit.source[0].reason, "no readings");
}

#define with_audit(test) cmocka_unit_test_setup(test, clear_audit)

int main(void)
{
    const struct CMUnitTest tests[] = {
        with_audit(a_right_timer_is_credible),
        with_audit(the_wait_for_a_batch_is_not_held_against_a_timer),
        with_audit(the_clock_itself_has_the_wait_as_its_error),
        with_audit(what_a_batch_misses_is_told_apart_from_the_share),
        with_audit(a_timer_of_the_last_tile_is_not_credible),
        with_audit(a_timer_that_misses_vertex_work_is_not_credible),
        with_audit(the_first_credible_source_of_the_ladder_is_chosen),
        with_audit(judging_twice_gives_the_same_verdict),
        with_audit(a_timer_that_loses_the_first_frame_is_not_credible),
        with_audit(a_driver_that_drops_draws_is_not_credible),
        with_audit(dropped_draws_are_seen_where_the_time_stays_linear),
        with_audit(overlap_of_vertex_work_is_credible),
        with_audit(twice_the_frames_must_read_as_twice_the_time),
        with_audit(samples_must_be_a_frames_times_the_frames),
        with_audit(a_counter_of_zero_bits_is_not_credible_but_wall_is),
        with_audit(wall_too_is_not_credible_where_draws_are_dropped),
        with_audit(a_negative_reading_is_not_credible),
        with_audit(a_few_absurd_readings_are_borne_and_many_are_not),
        with_audit(disjoint_readings_are_left_out),
        with_audit(noise_with_spikes_is_borne),
        with_audit(the_tolerance_is_the_same_on_both_sides),
        with_audit(batches_that_are_mostly_overhead_are_not_judged),
        with_audit(a_source_that_cannot_be_judged_is_not_credible),
    };
    return run_tests(tests);
}
