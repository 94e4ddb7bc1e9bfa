// The shipped shaders in highp, and everything that they can be made of, against the reference: what
// the driver computes is right to 2e-5 in linear light, on whatever it was given.
#include "accuracy_world.h"

#define HIGHP                                                                            \
    "precision=highp,p_color=highp,stage=fragment,target=rgba32f,width=128,height=128"

// -1: how many there are is not known.
static bool is_none(int64_t count)
{
    return count <= 0;
}

static bool is_right(const struct one_params *params)
{
    struct one one;
    one_measure(&one, params);
    const struct sb_accuracy *accuracy = &one.task.accuracy;
    const struct sb_split *split = &accuracy->split;
    const bool right = split->part[SB_BY_ARITHMETIC].max <= 2e-5 &&
                       is_none(split->raw_nonfinite) && is_none(split->raw_negative);
    if (!right)
        print_error(
            "%s %s: %g at %d,%d, term %s; raw terms not finite %ld, negative %ld; "
            "%s\n",
            params->preset ? params->preset : params->scene, params->words,
            split->part[SB_BY_ARITHMETIC].max, split->part[SB_BY_ARITHMETIC].x,
            split->part[SB_BY_ARITHMETIC].y, accuracy->term ? accuracy->term : "none",
            (long)split->raw_nonfinite, (long)split->raw_negative,
            sb_text_get(&one.task.note));
    // A program that is drawn otherwise when it tells of its lights tells its inputs at least.
    const bool altered = one.task.status == SB_INSTRUMENTATION;
    assert_true(altered == (split->raw_nonfinite < 0));
    assert_true(altered ==
                (strstr(sb_text_get(&one.task.note), "driver's branches") != NULL));
    assert_true(altered ? !accuracy->term : true);
    // Little is left out, but for edges that several samples mix.
    const bool mixed = strstr(params->words, "samples=") != NULL;
    assert_true(split->compared > (mixed ? 0 : 9 * split->mismatched));
    one_free(&one);
    return right;
}

static void the_five_presets_are_right_to_2e_5(void **state)
{
    (void)state;
    static const char *const presets[] = {"delphi", "wikibooks", "lwjgl", "ubo",
                                          "shadows"};
    bool good = true;
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++)
        good &= is_right(&(struct one_params){.preset = presets[i], .words = HIGHP});
    assert_true(good);
}

static void the_slips_of_the_texts_are_part_of_the_reference(void **state)
{
    (void)state;
    static const char *const presets[] = {"lwjgl", "shadows"};
    bool good = true;
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++)
        good &= is_right(&(struct one_params){
            .preset = presets[i],
            .words = HIGHP ",text=as_written,form=naive",
        });
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
        "dir=1,point=2,model=phong,fresnel=schlick,hoist=per_light,space=view",
        "area=2,fresnel=schlick,specular_norm=energy,guard=mask,normalise=off",
        "dir=1,point=2,specular_norm=energy,model=phong,form=naive,fresnel=schlick",
        "dir=1,point=2,specular_norm=energy,fresnel=schlick,stage=vertex,"
        "maps=specular",
        "dir=1,point=2,samples=4",
        "point=2,shadows=2,shadow_filter=4",
        "dir=1,point=4,spot=1,model=phong,maps=diffuse+specular,hoist=per_light,"
        "ambient=per_light,guard=mask",
        "dir=1,point=2,stage=vertex,maps=diffuse+specular",
    };
    bool good = true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char all[256];
        snprintf(all, sizeof all, HIGHP ",%s", words[i]);
        good &= is_right(&(struct one_params){.scene = "room", .words = all});
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
