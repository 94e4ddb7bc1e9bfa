// Pictures of the reference are shared: nothing is computed twice for variants that have the same
// truth, and nothing is shared by variants that have not.
#include "test.h"

#include "measure/truths.h"

enum { SIDE = 24 };

static struct sb_truths *truths;

// How many pictures a variant of `words` of a scene adds.
static int added(const char *scene, const char *words)
{
    struct sb_error err = {0};
    struct sb_assignment set[16];
    char text[256];
    int count = 0;
    snprintf(text, sizeof text, "%s", words);
    for (char *word = strtok(text, ","); word; word = strtok(NULL, ",")) {
        char *equals = strchr(word, '=');
        *equals = '\0';
        set[count++] =
            (struct sb_assignment){.axis = word, .values = equals + 1, .origin = "test"};
    }
    struct sb_suite suite = {0};
    const struct sb_suite_params params = {
        .scene = scene, .set = set, .set_count = count};
    if (!sb_suite_load(&params, &suite, &err))
        fail_msg("%s", err.text);
    struct sb_task task = {.entry = &suite.entry[0]};
    task.assembly.job.variant = suite.entry[0].variant;
    struct sb_scene made = {0};
    assert_true(sb_scene_make(scene, &suite.entry[0].variant, &made, &err));
    task.prepared.input_hash = sb_scene_hash(&made);
    sb_scene_free(&made);

    struct sb_truth truth;
    const int before = sb_truths_rendered(truths);
    assert_true(sb_truths_get(truths, &task, SIDE, SIDE, &truth, &err));
    assert_int_equal(truth.ideal->colour.width, SIDE);
    assert_int_equal(truth.ground->width, SIDE);
    sb_suite_free(&suite);
    return sb_truths_rendered(truths) - before;
}

static void variants_that_differ_in_precision_form_or_storage_share_both(void **state)
{
    (void)state;
    assert_int_equal(added("sphere", "point=1"), 2);
    assert_int_equal(added("sphere", "point=1,precision=mediump"), 0);
    assert_int_equal(added("sphere", "point=1,form=naive,target=rgba32f"), 0);
    assert_int_equal(
        added("sphere", "point=1,storage=ubo_std140,loop=dynamic,space=view"), 0);
    assert_int_equal(added("sphere", "point=1,update=lights,layers=4"), 0);
    // Another origin makes other floats, whose truth is another in its last bits.
    assert_int_equal(added("sphere", "point=1,space=eye"), 2);
    assert_int_equal(added("sphere", "point=1,space=eye,storage=constant"), 0);
    assert_int_equal(added("sphere", "point=1"), 0);
}

static void what_the_model_depends_on_shares_the_ideal_only(void **state)
{
    (void)state;
    added("sphere", "point=1");
    assert_int_equal(added("sphere", "point=1,stage=vertex"), 1);
    assert_int_equal(added("sphere", "point=1,normalise=off"), 1);
    assert_int_equal(added("sphere", "point=1,tessellation=3000"), 1);
    assert_int_equal(added("room", "point=1,shadows=1"), 2);
    assert_int_equal(added("room", "point=1,shadows=1,shadow_size=64"), 1);
    assert_int_equal(added("room", "point=1,shadows=1,shadow_filter=4"), 1);
}

static void another_scene_has_another_truth(void **state)
{
    (void)state;
    added("sphere", "point=1");
    assert_int_equal(added("sphere", "point=2"), 2);
    assert_int_equal(added("sphere", "point=1,model=phong"), 2);
    assert_int_equal(added("containers", "point=1"), 2);
    // Of containers the triangles are what is asked for.
    assert_int_equal(added("containers", "point=1,tessellation=3000"), 2);
}

static int begin(void **state)
{
    (void)state;
    truths = sb_truths_new(sb_axes_builtin());
    return 0;
}

static int end(void **state)
{
    (void)state;
    sb_truths_free(&truths);
    return truths != NULL;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            variants_that_differ_in_precision_form_or_storage_share_both, begin, end),
        cmocka_unit_test_setup_teardown(what_the_model_depends_on_shares_the_ideal_only,
                                        begin, end),
        cmocka_unit_test_setup_teardown(another_scene_has_another_truth, begin, end),
    };
    return run_tests(tests);
}
