// The shipped shaders in highp, and everything that they can be made of, against the reference: what
// the driver computes per fragment is right to 2e-5 in linear light, on whatever it was given.
#include "accuracy_world.h"

#define HIGHP                                                                            \
    "precision=highp,p_color=highp,stage=fragment,target=rgba32f,width=128,height=128"

static double arithmetic_error(const struct one_params *params)
{
    struct one one;
    one_measure(&one, params);
    const struct sb_accuracy *accuracy = &one.task.accuracy;
    const double error = accuracy->split.part[SB_BY_ARITHMETIC].max;
    if (getenv("SHOW") || !(error <= 2e-5))
        print_error("%s %s: %g at %d,%d, term %s; %s\n",
                    params->preset ? params->preset : params->scene, params->words, error,
                    accuracy->split.part[SB_BY_ARITHMETIC].x,
                    accuracy->split.part[SB_BY_ARITHMETIC].y,
                    accuracy->term ? accuracy->term : "none",
                    sb_text_get(&one.task.note));
    if (getenv("SHOW"))
        print_error("   interp %g raw %ld %ld cmp %ld mis %ld flips %ld\n",
                    accuracy->split.part[1].max, (long)accuracy->split.raw_nonfinite,
                    (long)accuracy->split.raw_negative, (long)accuracy->split.compared,
                    (long)accuracy->split.mismatched, (long)accuracy->split.flips);
    // Little is left out.
    assert_true(accuracy->split.compared > 9 * accuracy->split.mismatched);
    one_free(&one);
    return error;
}

static void the_five_presets_are_right_to_2e_5(void **state)
{
    (void)state;
    static const char *const presets[] = {"delphi", "wikibooks", "lwjgl", "ubo",
                                          "shadows"};
    bool good = true;
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++)
        good &= arithmetic_error(
                    &(struct one_params){.preset = presets[i], .words = HIGHP}) <= 2e-5;
    assert_true(good);
}

static void the_slips_of_the_texts_are_part_of_the_reference(void **state)
{
    (void)state;
    static const char *const presets[] = {"lwjgl", "shadows"};
    bool good = true;
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++)
        good &= arithmetic_error(&(struct one_params){
                    .preset = presets[i],
                    .words = HIGHP ",text=as_written,form=naive",
                }) <= 2e-5;
    assert_true(good);
}

static void every_law_model_cone_shape_and_map_is_right_to_2e_5(void **state)
{
    (void)state;
    static const char *const words[] = {
        "dir=2,model=lambert",
        "dir=2,model=phong",
        "dir=2,model=phong,specular_side=both",
        "point=3,attenuation=none",
        "point=3,attenuation=radius",
        "point=3,attenuation=windowed,space=view",
        "point=3,ambient=per_light,storage=ubo_std140",
        "spot=3,cone=hard",
        "spot=3,cone=exponent,layout=unified",
        "spot=3,cone=linear,hoist=per_light",
        "spot=3,cone=smooth,guard=mask",
        "area=3,area_shape=sphere",
        "area=3,area_shape=tube",
        "area=3,area_shape=box,space=view",
        "area=3,area_shape=capsule",
        "dir=1,point=2,maps=diffuse+specular",
        "dir=1,point=2,maps=diffuse+specular+normal,ambient=per_light",
        "dir=1,point=2,maps=normal,space=view,normalise=off",
        "dir=1,point=2,shininess=256",
        "point=2,shadows=2,shadow_filter=4",
    };
    bool good = true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char all[256];
        snprintf(all, sizeof all, HIGHP ",%s", words[i]);
        good &=
            arithmetic_error(&(struct one_params){.scene = "room", .words = all}) <= 2e-5;
    }
    assert_true(good);
}

int main(void)
{
    open_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_five_presets_are_right_to_2e_5),
        cmocka_unit_test(the_slips_of_the_texts_are_part_of_the_reference),
        cmocka_unit_test(every_law_model_cone_shape_and_map_is_right_to_2e_5),
    };
    const int failed = run_tests(tests);
    sb_driver_close(&driver);
    return failed;
}
