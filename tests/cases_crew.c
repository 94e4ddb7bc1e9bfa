// The crew that asks the cells of a matrix, with hands that only count, and hands that die.
#include "test.h"

#include <errno.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include "cases/crew.h"

enum { CELLS = 200, HANDS = 3 };

struct pipes {
    int taken[2]; // cells, as they are taken
    int gate[2];  // a byte lets a hand go on
};

static void open_pipes(struct pipes *pipes)
{
    assert_int_equal(pipe(pipes->taken), 0);
    assert_int_equal(pipe(pipes->gate), 0);
}

static void close_pipes(const struct pipes *pipes)
{
    for (int i = 0; i < 2; i++) {
        close(pipes->taken[i]);
        close(pipes->gate[i]);
    }
}

static int read_cell(const struct pipes *pipes)
{
    int cell = -1;
    while (read(pipes->taken[0], &cell, sizeof cell) < 0 && errno == EINTR)
        continue;
    return cell;
}

static void put(struct sb_crew *crew, int cell)
{
    struct sb_outcome outcome = {
        .verdict = SB_VERDICT_PASS, .measured = cell, .bound = 2.0 * cell, .point = cell};
    sb_text_printf(&outcome.note, "cell %d", cell);
    sb_crew_put(crew, cell, &outcome);
    sb_text_free(&outcome.note);
}

static void wait_for_hands(struct sb_crew *crew)
{
    while (sb_crew_works(crew))
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

static void check_put(struct sb_crew *crew, int cell)
{
    struct sb_outcome outcome;
    char note[32];
    snprintf(note, sizeof note, "cell %d", cell);
    assert_true(sb_crew_get(crew, cell, &outcome));
    assert_int_equal(outcome.verdict, SB_VERDICT_PASS);
    assert_int_equal(outcome.point, cell);
    check_close(outcome.measured, cell, 0);
    check_close(outcome.bound, 2.0 * cell, 0);
    assert_string_equal(sb_text_get(&outcome.note), note);
    sb_text_free(&outcome.note);
    assert_false(sb_crew_get(crew, cell, &outcome)); // once only
}

// --- hands ----------------------------------------------------------------------------------

// Waits with its first cell, so that no hand takes all of them before the others are there.
static void take_all(void *user, struct sb_crew *crew)
{
    const struct pipes *pipes = user;
    char go;
    for (int cell, first = 1; (cell = sb_crew_take(crew)) < CELLS; first = 0) {
        if (write(pipes->taken[1], &cell, sizeof cell) != sizeof cell ||
            (first && read(pipes->gate[0], &go, 1) != 1))
            _exit(1);
        put(crew, cell);
    }
}

static void abort_at_two(void *user, struct sb_crew *crew)
{
    (void)user;
    for (int cell; (cell = sb_crew_take(crew)) < 2;)
        put(crew, cell);
    abort();
}

static void exit_at_once_with_a_cell(void *user, struct sb_crew *crew)
{
    (void)user;
    sb_crew_take(crew);
    _exit(3);
}

static void do_nothing(void *user, struct sb_crew *crew)
{
    (void)user;
    (void)crew;
}

static void never_end(void *user, struct sb_crew *crew)
{
    (void)user;
    sb_crew_take(crew);
    for (;;)
        pause();
}

// --- tests ----------------------------------------------------------------------------------

static void hands_take_every_cell_once(void **state)
{
    (void)state;
    struct pipes pipes;
    int taken[CELLS] = {0};
    open_pipes(&pipes);
    struct sb_crew *crew = sb_crew_start(HANDS, take_all, &pipes);
    assert_non_null(crew);
    for (int i = 0; i < CELLS; i++) {
        if (i == HANDS) // each of them has one
            assert_int_equal(write(pipes.gate[1], "go!", HANDS), HANDS);
        const int cell = read_cell(&pipes);
        assert_in_range(cell, 0, CELLS - 1);
        taken[cell]++;
    }
    wait_for_hands(crew);
    assert_true(sb_crew_take(crew) >= CELLS);
    for (int i = 0; i < CELLS; i++) {
        assert_int_equal(taken[i], 1);
        check_put(crew, i);
    }
    sb_crew_end(&crew);
    assert_null(crew);
    close_pipes(&pipes);
}

static void check_died(struct sb_crew *crew, int cell, const char *why)
{
    struct sb_outcome outcome;
    wait_for_hands(crew);
    assert_true(sb_crew_get(crew, cell, &outcome));
    assert_int_equal(outcome.verdict, SB_VERDICT_FAIL);
    assert_true(isnan(outcome.measured));
    check_contains(sb_text_get(&outcome.note), why);
    sb_text_free(&outcome.note);
    // The rest is the parent's.
    assert_false(sb_crew_get(crew, cell + 1, &outcome));
    assert_int_equal(sb_crew_take(crew), cell + 1);
}

static void a_hand_that_dies_costs_its_cell_alone(void **state)
{
    (void)state;
    struct sb_crew *crew = sb_crew_start(1, abort_at_two, NULL);
    check_died(crew, 2, strsignal(SIGABRT));
    check_put(crew, 0);
    check_put(crew, 1);
    sb_crew_end(&crew);
    crew = sb_crew_start(1, exit_at_once_with_a_cell, NULL);
    check_died(crew, 0, "ended with 3");
    sb_crew_end(&crew);
}

static void hands_that_end_at_once_leave_the_work_to_the_parent(void **state)
{
    (void)state;
    struct sb_crew *crew = sb_crew_start(HANDS, do_nothing, NULL);
    wait_for_hands(crew);
    for (int i = 0; i < CELLS; i++) {
        assert_int_equal(sb_crew_take(crew), i);
        put(crew, i);
        check_put(crew, i);
    }
    sb_crew_end(&crew);
}

static void hands_at_work_are_ended(void **state)
{
    (void)state;
    struct sb_outcome outcome;
    struct sb_crew *crew = sb_crew_start(HANDS, never_end, NULL);
    assert_true(sb_crew_works(crew));
    assert_false(sb_crew_get(crew, 0, &outcome));
    sb_crew_end(&crew);
    assert_null(crew);
    sb_crew_end(&crew); // of none is nothing
}

static void no_hands_are_no_crew(void **state)
{
    (void)state;
    assert_null(sb_crew_start(0, do_nothing, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_hands_are_no_crew),
        cmocka_unit_test(hands_take_every_cell_once),
        cmocka_unit_test(a_hand_that_dies_costs_its_cell_alone),
        cmocka_unit_test(hands_that_end_at_once_leave_the_work_to_the_parent),
        cmocka_unit_test(hands_at_work_are_ended),
    };
    return run_tests(tests);
}
