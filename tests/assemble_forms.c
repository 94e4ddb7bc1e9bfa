// A form axis changes the formulas that it names, and no other line of any program.
#include "assemble_words.h"

// With cone=linear, whose light structs have the same members for both forms.
#define EVERYTHING                                                                       \
    "dir=1 point=2 spot=1 area=1 area_shape=capsule shadows=1 shadow_map=six2d "         \
    "maps=normal normal_store=rg target=rgba16f cone=linear"

enum { FUNCTIONS = 4 };

static const struct form {
    int axis;
    const char *function[FUNCTIONS]; // the plain names
} forms[] = {
    {SB_AXIS_F_UNIT, {"unit", "unit_difference", "vertex_normal", "half_vector"}},
    {SB_AXIS_F_ATTENUATION, {"attenuation"}},
    {SB_AXIS_F_CONE, {"cone", "CONE_RAMP(light)", "CONE_EDGES(light)"}},
    {SB_AXIS_F_HIGHLIGHT, {"specular_factor", "schlick"}},
    {SB_AXIS_F_AREA,
     {"ball_nearest", "ball_nearest_ray", "segment_nearest", "segment_nearest_ray"}},
    {SB_AXIS_F_FRAME, {"decoded_normal", "restored_normal", "normal_in_frame"}},
    {SB_AXIS_F_OUTPUT, {"output_colour"}},
    {SB_AXIS_F_SHADOW, {"shadow_stored", "shadow_face", "shadow_share"}},
};
enum { FORMS = sizeof forms / sizeof *forms };

static int functions_of(const struct form *form)
{
    int count = 0;
    while (count < FUNCTIONS && form->function[count])
        count++;
    return count;
}

// "#define unit   unit_naive" of a function of this form.
static bool is_choice(const struct form *form, const char *line)
{
    char name[64], value[64], wanted[80];
    if (sscanf(line, "#define %63s %63s", name, value) != 2)
        return false;
    for (int i = 0; i < functions_of(form); i++) {
        const char *function = form->function[i];
        const int stem = (int)strcspn(function, "(");
        snprintf(wanted, sizeof wanted, "%.*s_naive%s", stem, function, function + stem);
        if (!strcmp(name, function) && !strcmp(value, wanted))
            return true;
    }
    return false;
}

// The next line, without what ends it; false: there is none.
static bool next_line(const char **rest, char *line, size_t size)
{
    if (!**rest)
        return false;
    const size_t length = strcspn(*rest, "\n");
    snprintf(line, size, "%.*s", (int)length, *rest);
    *rest += length + ((*rest)[length] == '\n');
    return true;
}

// The number of functions that are chosen otherwise in the second text. No other line differs.
static int count_choices(const struct form *form, const char *robust, const char *naive)
{
    enum { LINE = 1000 };
    char a[LINE], b[LINE], define[64];
    int choices = 0;
    snprintf(define, sizeof define, "#define %s naive",
             sb_axes_builtin()->row[form->axis].define);
    while (next_line(&robust, a, sizeof a)) {
        assert_true(next_line(&naive, b, sizeof b));
        if (!strcmp(a, b) || !strcmp(b, define))
            continue;
        if (!is_choice(form, b))
            fail_msg("%s: \"%s\" for \"%s\"", define, b, a);
        choices++;
    }
    assert_int_equal(*naive, '\0');
    return choices;
}

static void a_form_changes_its_functions_and_nothing_else(void **state)
{
    (void)state;
    struct sb_assembly robust;
    assemble(EVERYTHING, &robust);
    for (int f = 0; f < FORMS; f++) {
        const struct form *form = &forms[f];
        struct sb_assembly naive;
        char words[256];
        snprintf(words, sizeof words, EVERYTHING " %s=naive",
                 sb_axes_builtin()->row[form->axis].name);
        assemble(words, &naive);
        assert_int_equal(count_choices(form, shade_of(&robust, FRAGMENT)->text,
                                       shade_of(&naive, FRAGMENT)->text),
                         functions_of(form));
        // The vertex shader has a form of its own for normals, and so all of form.glsl.
        assert_in_range(count_choices(form, shade_of(&robust, VERTEX)->text,
                                      shade_of(&naive, VERTEX)->text),
                        0, functions_of(form));
        for (int stage = 0; stage < STAGES; stage++) {
            const char *a = sb_assembly_sources(&robust, SB_ROLE_SHADOW)[stage].text;
            const char *b = sb_assembly_sources(&naive, SB_ROLE_SHADOW)[stage].text;
            if (a && form->axis != SB_AXIS_F_SHADOW)
                count_choices(form, a, b);
            else if (a) // carries a number in the place of a vector
                assert_non_null(strstr(b, "#define CARRIED float"));
        }
        sb_assembly_free(&naive);
    }
    sb_assembly_free(&robust);
}

static void form_is_all_of_them_unless_they_are_given(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_variant naive, but_one, one;
    variant_of_words(axes, EVERYTHING " form=naive", &naive);
    variant_of_words(axes, EVERYTHING " form=naive f_cone=robust", &but_one);
    variant_of_words(axes, EVERYTHING " f_cone=naive", &one);
    for (int f = 0; f < FORMS; f++) {
        const int axis = forms[f].axis;
        const bool cone = axis == SB_AXIS_F_CONE;
        assert_true(naive.value[axis] == SB_F_UNIT_NAIVE);
        assert_int_equal(but_one.value[axis] == SB_F_UNIT_NAIVE, !cone);
        assert_int_equal(one.value[axis] == SB_F_UNIT_NAIVE, cone);
    }
}

static void a_form_of_what_does_not_occur_is_moot(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int live; // of the eight, in their order
    } cases[] = {
        {"dir=1", 0x09},
        {"dir=1 model=lambert", 0x01},
        {"point=1", 0x0B},
        {"point=1 attenuation=none shadows=1", 0x89},
        {"spot=1", 0x0F},
        {"area=1", 0x1B},
        {"area=1 area_shape=box", 0x0B},
        {"maps=diffuse+normal", 0x29},
        {"target=rgba16f", 0x49},
        {"precision=mixed", 0x49},
        {"target=rgba32f", 0x09},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct sb_variant variant;
        int live = 0;
        variant_of_words(sb_axes_builtin(), cases[i].words, &variant);
        for (int f = 0; f < FORMS; f++)
            live |= !sb_variant_moot(sb_axes_builtin(), &variant, forms[f].axis) << f;
        if (live != cases[i].live)
            fail_msg("%s: %x", cases[i].words, (unsigned)live);
    }
}

static void a_wide_output_is_written_as_it_is(void **state)
{
    (void)state;
    static const char *const words[] = {"point=1", "point=1 target=rgba16f",
                                        "point=1 p_output=mediump"};
    for (int i = 0; i < 3; i++) {
        struct sb_assembly assembly;
        assemble(words[i], &assembly);
        const char *text = shade_of(&assembly, FRAGMENT)->text;
        const char *define = strstr(text, "#define IF_NARROW_OUTPUT(code) code\n");
        assert_int_equal(define != NULL, i > 0);
        sb_assembly_free(&assembly);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_form_changes_its_functions_and_nothing_else),
        cmocka_unit_test(form_is_all_of_them_unless_they_are_given),
        cmocka_unit_test(a_form_of_what_does_not_occur_is_moot),
        cmocka_unit_test(a_wide_output_is_written_as_it_is),
    };
    return run_tests(tests);
}
