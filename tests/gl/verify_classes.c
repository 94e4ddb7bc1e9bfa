// `shadebench verify --classes` on a real context: every class of the shipped suite holds, and a
// shader that is broken in one place breaks the class that it belongs to.
#include "cli_gl.h"

static void every_class_of_the_shipped_suite_draws_one_picture(void **state)
{
    (void)state;
    char arguments[160];
    size_t c, v, differing = 0;
    const json_t *class, *variant;
    if (!is_egl())
        skip();
    snprintf(arguments, sizeof arguments, "verify --classes -q --json %s", platform);
    json_t *json = run_json(arguments, 0);
    assert_true(json_integer_value(json_object_get(json, "compared")) >= 150);
    json_array_foreach(json_object_get(json, "classes"), c, class)
    {
        const json_t *variants = json_object_get(class, "variants");
        json_array_foreach(variants, v, variant)
        {
            const char *id = json_string_value(json_object_get(variant, "variant"));
            const char *status = json_string_value(json_object_get(variant, "status"));
            // GL 3.3 and ES 3.0 need not have these; all else they must.
            const bool optional = strstr(id, "cube_array") || strstr(id, "layered");
            if (strcmp(status, optional ? "over_limit" : "ok") != 0 &&
                strcmp(status, "ok") != 0)
                fail_msg("%s: %s: %s", id, status,
                         json_string_value(json_object_get(variant, "note")));
        }
        assert_true(json_is_true(json_object_get(class, "exact")));
        const double most =
            json_number_value(json_object_get(class, "largest_difference"));
        assert_true(most <= 1e-4);
        differing += most > 0;
    }
    // Other programs round in other places: were no bit to differ anywhere, one program would
    // have been compared with itself.
    assert_true(differing > 0);
    json_decref(json);
}

// One wrong place in the file of one value of an implementation axis.
static const struct {
    const char *sweep, *base, *file, *edit;
} mutations[] = {
    {"guard: [branch, mask]", "spot: 2, cone: hard", "guard/mask.glsl",
     "s/? 1.0 : 0.0/? 0.75 : 0.0/"},
    {"loop: [constant, dynamic]", "spot: 2", "loop/dynamic.glsl",
     "s/i < u_spot_count/i < u_spot_count - 1/"},
    {"space: [world, view]", "point: 2", "space/view.glsl",
     "s/return -position/return position.yxz/"},
    {"hoist: [once, per_light]", "spot: 2", "hoist/per_light.glsl",
     "s/-cosines.y [*] scale/-cosines.x * scale/"},
    {"shadow_map: [cube, array2d]", "point: 2, shadows: 2", "shadow_map/array2d.glsl",
     "s/6 [*] caster/6 * caster + 1/"},
};

static void a_value_that_draws_something_else_breaks_its_class(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mutations / sizeof *mutations; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "suite: one\nscene: room\ntarget: 64x64\nbase: {%s}\nsweep: {%s}\n",
                 mutations[i].base, mutations[i].sweep);
        write_file("one.yaml", text);
        snprintf(text, sizeof text, "verify --classes @/one.yaml -q %s", platform);
        check_answer(text, 0, "1 pairs of pictures compared: 0 failed");

        snprintf(text, sizeof text,
                 "rm -rf @/wrong; cp -r '" SB_SOURCE_DIR "/shaders' @/wrong && "
                 "sed -i '%s' @/wrong/%s && ! cmp -s '" SB_SOURCE_DIR
                 "/shaders/%s' @/wrong/%s",
                 mutations[i].edit, mutations[i].file, mutations[i].file,
                 mutations[i].file);
        check_shell(text, 0, ""); // the edit did change something
        snprintf(text, sizeof text, "verify --classes @/one.yaml -q --shaders @/wrong %s",
                 platform);
        check_answer(text, 3, "1 pairs of pictures compared: 1 failed");
        check_answer(text, 3, " differs from ");
        check_answer(text, 3, " of 64 x 64, and should not: ");
    }
}

static void a_variant_that_does_not_compile_fails(void **state)
{
    (void)state;
    char line[256];
    write_file("two.yaml",
               "suite: two\nbase: {spot: 2}\nsweep: {guard: [branch, mask]}\n");
    check_shell("cp -r '" SB_SOURCE_DIR "/shaders' @/nowhere && echo 'nowhere' >> "
                "@/nowhere/guard/mask.glsl",
                0, "");
    snprintf(line, sizeof line, "verify --classes @/two.yaml -q --shaders @/nowhere %s",
             platform);
    check_answer(line, 3, "compile_failed");
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_class_of_the_shipped_suite_draws_one_picture),
        cmocka_unit_test(a_value_that_draws_something_else_breaks_its_class),
        cmocka_unit_test(a_variant_that_does_not_compile_fails),
    };
    return end_tests(run_tests(tests));
}
