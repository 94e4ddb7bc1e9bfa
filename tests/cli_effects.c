// show --effects, run --ablate, compare --policies and --ablation, and plan, as a user types them.
#include "cli_fixture.h"

static void show_effects_says_what_is_left_out_and_why(void **state)
{
    (void)state;
    check_answer("show --effects night --set point=1 --set dir=1 --set sun=120", 0,
                 "the sun: left out everywhere: below the horizon");
    check_answer("show --effects flashlight --set spot=1", 0,
                 "outside its cone of 9 degrees");
    check_answer(
        "show --effects lamps64 --set point=64 --set attenuation=windowed", 0,
        "point light 7: left out of 75 of 80 draws: out of range: its light ends at 2.2");
    check_answer("show --effects mixed,point=1", 2, "");
    check_answer("show --effects mixed --set point=2", 0,
                 "specular: left out of 9 of 17 draws: black");
    check_answer("show --effects effects", 0, "partly_mapped");
    check_answer("show --effects mixed", 0, "no light is asked for");
    check_answer("show --effects mixd", 2, "mixd");
    check_answer("show --effects mixed --set point=1 --json", 0, "\"scene_calls\"");
}

static void a_larger_threshold_leaves_out_more(void **state)
{
    (void)state;
    check_answer("show --effects lamps64 --set point=64 --threshold 0.2", 0,
                 "out of reach: its fall-off is below 0.2 beyond");
    check_answer("show --effects lamps64 --set point=64 --threshold 2", 2, "threshold");
}

#define RUN "run --context null -q --rounds 12 --first-look 12 "

static void ablate_adds_each_effect_that_is_there(void **state)
{
    (void)state;
    check_answer(RUN
                 "--ablate --set point=2 --set maps=diffuse --scene spheres -o @/ablate",
                 0, "Each effect left out alone");
    check_answer("compare --ablation @/ablate", 0, "diffuse_map");
    check_answer("compare --ablation @/ablate", 0, "renormalise");
    check_answer("compare --ablation @/ablate --json", 0, "without=specular");
    check_answer("run --resume @/ablate -q", 0, "Each effect left out alone");
}

static void policies_are_held_against_uber(void **state)
{
    (void)state;
    check_answer(RUN "effects -o @/effects", 0, "Policies, over the faster program");
    check_answer("compare --policies @/effects", 0, "All scenes together");
    check_answer("compare --policies @/effects", 0, "specialise=object,bucket=pow2");
}

static void what_has_no_such_rows_is_refused(void **state)
{
    (void)state;
    check_answer(RUN "--set point=1 -o @/plain", 0, "");
    check_answer(
        "compare --policies @/plain", 2,
        "no row is held against another; such rows are made by suites that sweep");
    check_answer("compare --ablation @/plain", 2, "run --ablate");
    check_answer("compare --policies --ablation @/plain", 2, "not both");
}

static void plan_chooses_from_what_was_measured(void **state)
{
    (void)state;
    check_answer(RUN "plan -o @/costs", 0, "");
    write_file("demands.csv", "dir,point,weight\n1,4,10\n0,16,1\n0,1,20\n");
    check_answer("plan --demands @/demands.csv --costs @/costs --programs 3 --exhaustive",
                 0, "best of all");
    check_answer("plan --demands @/demands.csv --costs @/costs --programs 2 --json", 0,
                 "\"programs\"");
    check_answer("plan effects --costs @/costs --programs 2", 0, "drawn by");
    check_answer("plan delphi --costs @/costs --programs 2", 0, "drawn by");
    // However uneven the weights, every demand is served.
    write_file("uneven.csv", "point,weight\n1,1000000\n8,1\n");
    check_answer("plan --demands @/uneven.csv --costs @/costs --programs 1", 0,
                 "point 8)");
}

static void plan_refuses_what_it_cannot_know(void **state)
{
    (void)state;
    check_answer("plan", 2, "plan for what?");
    check_answer("plan lights", 2, "--costs RESULTS");
    check_answer("plan lights --costs @/nowhere", 2, "no such folder");
    check_answer("plan lights --costs @/costs --programs 0", 2, "--programs");
    write_file("many.csv", "area\n3\n");
    check_answer("plan --demands @/many.csv --costs @/costs", 2,
                 "nothing measured tells what dir=0 point=0 spot=0 area=3 costs");
    write_file("bad.csv", "dir,points\n1,2\n");
    check_answer(
        "plan --demands @/bad.csv --costs @/costs", 2,
        "bad.csv:1: unknown column \"points\"; valid: dir point spot area weight");
    write_file("bad.csv", "dir,weight,dir\n1,2,3\n");
    check_answer("plan --demands @/bad.csv --costs @/costs", 2,
                 "\"dir\" stands there twice");
    write_file("bad.csv", "dir,weight\n1,2\n-1,1\n");
    check_answer("plan --demands @/bad.csv --costs @/costs", 2, "bad.csv:3: dir");
    write_file("bad.csv", "dir,weight\n1.5,2\n");
    check_answer("plan --demands @/bad.csv --costs @/costs", 2, "bad.csv:2: dir");
    write_file("bad.csv", "dir,weight\n1,0\n");
    check_answer("plan --demands @/bad.csv --costs @/costs", 2, "no demand has a weight");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(show_effects_says_what_is_left_out_and_why),
        cmocka_unit_test(a_larger_threshold_leaves_out_more),
        cmocka_unit_test(ablate_adds_each_effect_that_is_there),
        cmocka_unit_test(policies_are_held_against_uber),
        cmocka_unit_test(what_has_no_such_rows_is_refused),
        cmocka_unit_test(plan_chooses_from_what_was_measured),
        cmocka_unit_test(plan_refuses_what_it_cannot_know),
    };
    return end_tests(run_tests(tests));
}
