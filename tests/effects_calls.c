// What scenes call for: each decision, and that nothing that shows is ever left out.
#include "assemble_words.h"

#include <math.h>

#include "effects/calls.h"
#include "math/random.h"
#include "reference/shade.h"
#include "scene/scene.h"

struct analysed {
    struct sb_variant variant;
    struct sb_scene scene;
    struct sb_analysis analysis;
};

static struct analysed analyse(const char *scene, const char *words)
{
    struct analysed it = {.scene = {0}};
    struct sb_error err = {0};
    variant_of_words(sb_axes_builtin(), words, &it.variant);
    if (!sb_scene_make(scene, &it.variant, &it.scene, &err))
        fail_msg("%s", err.text);
    return it;
}

static void look(struct analysed *it)
{
    sb_analyse(&(struct sb_analysis_params){.axes = sb_axes_builtin(),
                                            .variant = &it->variant,
                                            .scene = &it->scene,
                                            .explain = true},
               &it->analysis);
}

static void done(struct analysed *it)
{
    sb_analysis_free(&it->analysis);
    sb_scene_free(&it->scene);
}

static bool has(const struct sb_calls *calls, enum sb_effect effect)
{
    return calls->effects >> effect & 1;
}

static bool says(const struct sb_analysis *analysis, int draw, const char *what,
                 const char *why)
{
    for (int i = 0; i < analysis->decision_count; i++)
        if (analysis->decision[i].draw == draw &&
            strcmp(analysis->decision[i].what, what) == 0 &&
            strstr(analysis->decision[i].why, why))
            return true;
    return false;
}

static int value(const struct sb_calls *calls, enum sb_axis_id axis)
{
    return (int)calls->variant.value[axis];
}

// --- lights ----------------------------------------------------------------------------------

static struct sb_light *light_at(struct analysed *it, int number)
{
    return (struct sb_light *)&it->scene.lights.light[number];
}

static struct sb_material *material_of(struct analysed *it, int draw)
{
    return (struct sb_material *)&it->scene.material[it->scene.draw[draw].material];
}

static void a_light_that_is_off_or_black_is_left_out_everywhere(void **state)
{
    (void)state;
    struct analysed it = analyse("spheres", "point=3 specialise=scene");
    light_at(&it, 0)->intensity = 0;
    memset(light_at(&it, 2)->diffuse, 0, sizeof(float[3]));
    memset(light_at(&it, 2)->specular, 0, sizeof(float[3]));
    memset(light_at(&it, 2)->ambient, 0, sizeof(float[3]));
    look(&it);
    assert_int_equal(it.analysis.scene.light_count[SB_LIGHT_POINT], 1);
    assert_int_equal(it.analysis.scene.light[0], 1);
    assert_int_equal(value(&it.analysis.scene, SB_AXIS_POINT), 1);
    assert_true(says(&it.analysis, 0, "point light 0", "off"));
    done(&it);
}

static void at_night_the_sun_is_in_no_list(void **state)
{
    (void)state;
    struct analysed it = analyse("night", "dir=2 sun=120 point=1 specialise=scene");
    look(&it);
    assert_int_equal(it.analysis.scene.light_count[SB_LIGHT_DIR], 1); // the other one
    assert_int_equal(sb_lights_shining(&it.analysis.scene.variant, SB_LIGHT_DIR), 1);
    assert_true(says(&it.analysis, 0, "the sun", "below the horizon"));
    done(&it);
}

static void a_cone_that_misses_and_a_range_that_ends_leave_draws_dark(void **state)
{
    (void)state;
    struct analysed it = analyse("flashlight", "spot=1 specialise=object");
    int lit = 0, dark = 0;
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        lit += it.analysis.draw[d].light_count[SB_LIGHT_SPOT];
        dark += says(&it.analysis, d, "spot light 0", "outside its cone of 9 degrees");
    }
    assert_int_equal(lit + dark, it.scene.draw_count);
    assert_true(lit > 0 && dark > 0);
    done(&it);

    it = analyse("lamps64", "point=64 attenuation=windowed specialise=object");
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++)
        assert_in_range(it.analysis.draw[d].light_count[SB_LIGHT_POINT], 1, 20);
    assert_int_equal(it.analysis.scene.light_count[SB_LIGHT_POINT], 64);
    done(&it);
}

// --- materials ---------------------------------------------------------------------------------

static void black_highlights_take_the_model_with_them(void **state)
{
    (void)state;
    struct analysed it = analyse("mixed", "point=4 specialise=object");
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        const bool glossy = material_of(&it, d)->specular[0] > 0;
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_SPECULAR), glossy);
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_VIEW), glossy);
        assert_int_equal(value(&it.analysis.draw[d], SB_AXIS_MODEL) == SB_MODEL_LAMBERT,
                         !glossy);
        assert_int_equal(says(&it.analysis, d, "specular", "black"), !glossy);
    }
    assert_true(has(&it.analysis.scene, SB_EFFECT_SPECULAR));
    done(&it);
}

static void black_ambient_and_diffuse_colours_go(void **state)
{
    (void)state;
    struct analysed it = analyse("spheres", "point=2 specialise=object");
    memset(material_of(&it, 1)->ambient, 0, sizeof(float[3]));
    memset(material_of(&it, 2)->diffuse, 0, sizeof(float[3]));
    look(&it);
    assert_true(has(&it.analysis.draw[0], SB_EFFECT_AMBIENT));
    assert_false(has(&it.analysis.draw[1], SB_EFFECT_AMBIENT));
    assert_int_equal(value(&it.analysis.draw[1], SB_AXIS_AMBIENT), SB_AMBIENT_NONE);
    assert_false(has(&it.analysis.draw[2], SB_EFFECT_DIFFUSE));
    assert_true(has(&it.analysis.draw[2], SB_EFFECT_SPECULAR));
    assert_true(has(&it.analysis.scene, SB_EFFECT_DIFFUSE));
    done(&it);
}

static void maps_stay_where_a_material_has_them_and_something_uses_them(void **state)
{
    (void)state;
    struct analysed it = analyse(
        "partly_mapped", "point=2 maps=diffuse+specular+normal specialise=object");
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        const unsigned lacks = material_of(&it, d)->lacks;
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_DIFFUSE_MAP), !(lacks & 1));
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_SPECULAR_MAP),
                         !(lacks >> 1 & 1));
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_NORMAL_MAP),
                         !(lacks >> 2 & 1));
    }
    done(&it);
    // No highlight: no map of highlights.
    it = analyse("containers", "point=1 maps=diffuse+specular specialise=object");
    memset(material_of(&it, 0)->specular, 0, sizeof(float[3]));
    look(&it);
    assert_int_equal(value(&it.analysis.draw[0], SB_AXIS_MAPS), SB_MAPS_D);
    done(&it);
}

static void flat_faces_are_not_renormalised_and_round_ones_are(void **state)
{
    (void)state;
    struct analysed it = analyse("mixed", "point=1 specialise=object");
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++)
        assert_int_equal(has(&it.analysis.draw[d], SB_EFFECT_RENORMALISE),
                         it.scene.draw[d].mesh == 1); // a ball
    done(&it);
    it = analyse("mixed", "api=gles point=1 specialise=object precision=mediump");
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++)
        assert_true(has(&it.analysis.draw[d], SB_EFFECT_RENORMALISE));
    done(&it);
}

// --- terms -------------------------------------------------------------------------------------

static void terms_of_the_falloff_go_where_every_coefficient_is_zero(void **state)
{
    (void)state;
    struct analysed it = analyse("spheres", "point=2 spot=1 specialise=scene");
    for (int i = 0; i < 3; i++)
        light_at(&it, i)->quadratic = 0;
    look(&it);
    assert_true(has(&it.analysis.scene, SB_EFFECT_LINEAR));
    assert_false(has(&it.analysis.scene, SB_EFFECT_QUADRATIC));
    sb_analysis_free(&it.analysis);
    for (int i = 0; i < 3; i++) {
        light_at(&it, i)->linear = 0;
        light_at(&it, i)->constant = 1;
    }
    look(&it);
    assert_int_equal(value(&it.analysis.scene, SB_AXIS_ATTENUATION), SB_ATTENUATION_NONE);
    sb_analysis_free(&it.analysis);
    light_at(&it, 1)->constant = 2;
    sb_light_set_cone(light_at(&it, 2), 1, 4); // beyond half a turn
    look(&it);
    assert_int_equal(value(&it.analysis.scene, SB_AXIS_ATTENUATION),
                     SB_ATTENUATION_POLYNOMIAL);
    assert_false(has(&it.analysis.scene, SB_EFFECT_CONE));
    done(&it);
}

// --- shadows -----------------------------------------------------------------------------------

static void lookups_stay_where_something_may_stand_between(void **state)
{
    (void)state;
    struct analysed it =
        analyse("one_caster", "point=3 shadows=1 attenuation=radius specialise=object");
    int looked_up = 0, free = 0, out = 0;
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        looked_up += value(&it.analysis.draw[d], SB_AXIS_SHADOWS) == 1;
        free +=
            says(&it.analysis, d, "shadows of point light 0", "nothing stands between");
        out += says(&it.analysis, d, "point light 0", "out of range");
    }
    assert_int_equal(looked_up + free + out, it.scene.draw_count);
    assert_true(looked_up > 0 && free > 0 && out > 0);
    done(&it);
}

static void casters_before_one_that_matters_stay_with_their_lights(void **state)
{
    (void)state;
    struct analysed it =
        analyse("room", "point=2 shadows=2 attenuation=radius specialise=object");
    light_at(&it, 0)->intensity = 0;
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        const struct sb_calls *calls = &it.analysis.draw[d];
        if (value(calls, SB_AXIS_SHADOWS) == 2)
            assert_int_equal(calls->light_count[SB_LIGHT_POINT], 2);
        else
            assert_int_equal(value(calls, SB_AXIS_SHADOWS), 0);
    }
    done(&it);
}

// --- without -----------------------------------------------------------------------------------

static void without_takes_one_effect_from_scenes_and_from_what_is_asked(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        enum sb_effect effect;
    } rows[] = {
        {"without=ambient", SB_EFFECT_AMBIENT},
        {"without=diffuse", SB_EFFECT_DIFFUSE},
        {"without=specular", SB_EFFECT_SPECULAR},
        {"without=attenuation", SB_EFFECT_ATTENUATION},
        {"without=cone", SB_EFFECT_CONE},
        {"without=diffuse_map", SB_EFFECT_DIFFUSE_MAP},
        {"without=specular_map", SB_EFFECT_SPECULAR_MAP},
        {"without=normal_map", SB_EFFECT_NORMAL_MAP},
        {"without=renormalise", SB_EFFECT_RENORMALISE},
        {"without=fresnel", SB_EFFECT_FRESNEL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char words[256];
        struct sb_calls asked, all;
        snprintf(words, sizeof words,
                 "dir=1 point=2 spot=1 area=1 maps=diffuse+specular+normal "
                 "fresnel=schlick %s",
                 rows[i].words);
        struct analysed it = analyse("spheres", words);
        look(&it);
        sb_calls_asked(sb_axes_builtin(), &it.variant, &asked);
        assert_false(has(&asked, rows[i].effect));
        assert_false(has(&it.analysis.scene, rows[i].effect));
        it.variant.value[SB_AXIS_WITHOUT] = SB_WITHOUT_NOTHING;
        sb_calls_asked(sb_axes_builtin(), &it.variant, &all);
        assert_true(has(&all, rows[i].effect));
        done(&it);
    }
}

static void without_a_type_of_light_its_lights_are_gone(void **state)
{
    (void)state;
    static const char *const types[] = {"dir", "point", "spot", "area"};
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        char words[128];
        struct sb_calls asked;
        snprintf(words, sizeof words, "dir=1 point=1 spot=1 area=1 without=%s", types[t]);
        struct analysed it = analyse("spheres", words);
        look(&it);
        sb_calls_asked(sb_axes_builtin(), &it.variant, &asked);
        for (int o = 0; o < SB_LIGHT_TYPE_COUNT; o++) {
            assert_int_equal(it.analysis.scene.light_count[o], o != t);
            assert_int_equal(value(&asked, (enum sb_axis_id)sb_light_structs[o].axis),
                             o != t);
        }
        done(&it);
    }
}

// --- nothing that shows is left out ------------------------------------------------------------

// What a light adds to a point of a draw by the reference, in the brightest channel.
struct sample {
    struct sb_vec3 position, normal;
    int material;
};

static struct sb_vec3 times(const float *m, int stride, const float v[3])
{
    const double x = v[0], y = v[1], z = v[2];
    return (struct sb_vec3){
        m[0] * x + m[stride] * y + m[2 * stride] * z,
        m[1] * x + m[stride + 1] * y + m[2 * stride + 1] * z,
        m[2] * x + m[stride + 2] * y + m[2 * stride + 2] * z,
    };
}

static struct sample sample_of(struct sb_random *random, const struct sb_scene *scene,
                               int draw)
{
    const struct sb_draw *it = &scene->draw[draw];
    const struct sb_mesh *mesh = &scene->mesh[it->mesh];
    const uint64_t corner = sb_random_below(random, (uint64_t)mesh->index_count);
    const struct sb_vertex *vertex = &mesh->vertex[mesh->index[corner]];
    const struct sb_vec3 moved = {it->model[12], it->model[13], it->model[14]};
    return (struct sample){
        sb_vec3_add(times(it->model, 4, vertex->position), moved),
        sb_vec3_normalise(times(it->normal_matrix, 3, vertex->normal)),
        it->material,
    };
}

static double brightest(struct analysed *it, const struct sb_lights *lights,
                        const struct sample *sample)
{
    const struct sb_ref_shading shading = {
        .variant = &it->variant, .scene = &it->scene, .lights = *lights, .ideal = true};
    const struct sb_ref_input input = {.position = sample->position,
                                       .normal = sample->normal};
    struct sb_ref_shade shade;
    sb_ref_shade(&shading, &input, &it->scene.material[sample->material], &shade, NULL);
    const struct sb_vec3 sum = sb_vec3_add(shade.diffuse, shade.specular);
    return fmax(sum.x, fmax(sum.y, sum.z));
}

// The lights that a draw does without, as a list of their own.
static struct sb_lights dropped(const struct analysed *it, int draw,
                                struct sb_light *room)
{
    const struct sb_calls *calls = &it->analysis.draw[draw];
    struct sb_lights lights = {room, {0}};
    int number = 0, kept = 0, count = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const int end = kept + calls->light_count[t];
        for (int i = 0; i < it->scene.lights.count[t]; i++, number++) {
            if (kept < end && calls->light[kept] == number) {
                kept++;
                continue;
            }
            room[count++] = it->scene.lights.light[number];
            lights.count[t]++;
        }
    }
    return lights;
}

static int check_dropped(const char *scene, const char *words)
{
    struct sb_random random = sb_random_seed(7);
    struct analysed it = analyse(scene, words);
    static struct sb_light room[512];
    const double threshold = it.variant.value[SB_AXIS_THRESHOLD];
    int all = 0;
    look(&it);
    for (int d = 0; d < it.scene.draw_count; d++) {
        const struct sb_lights lights = dropped(&it, d, room);
        all += sb_lights_total(&lights);
        for (int i = 0; i < 60 && sb_lights_total(&lights) > 0; i++) {
            const struct sample sample = sample_of(&random, &it.scene, d);
            const double added = brightest(&it, &lights, &sample);
            if (!(added <= threshold))
                fail_msg("%s, %s: draw %d does without %g", scene, words, d, added);
        }
    }
    done(&it);
    return all;
}

static void all_that_is_left_out_of_a_draw_adds_less_than_the_threshold(void **state)
{
    (void)state;
    static const char *const laws[] = {"polynomial", "radius", "windowed"};
    static const char *const cones[] = {"hard", "exponent", "linear", "smooth"};
    static const char *const thresholds[] = {"0", "0.0009765625", "0.05"};
    int left_out = 0;
    for (int l = 0; l < 3; l++)
        for (int t = 0; t < 3; t++)
            for (int c = 0; c < 4; c++) {
                char words[256];
                snprintf(words, sizeof words,
                         "dir=1 point=24 spot=16 area=3 area_shape=capsule ambient=none "
                         "specialise=object attenuation=%s cone=%s threshold=%s "
                         "tessellation=600 model=%s",
                         laws[l], cones[c], thresholds[t], c % 2 ? "phong" : "blinn");
                left_out += check_dropped("lamps64", words);
                left_out += check_dropped("plane", words);
                left_out += check_dropped("containers", words);
            }
    assert_true(left_out > 1000); // else it would prove nothing
}

// How many lights reach draws, over many ranges.
static int reached(const char *update)
{
    char words[128];
    int kept = 0;
    snprintf(words, sizeof words,
             "point=16 attenuation=windowed specialise=object update=%s", update);
    for (int r = 0; r < 20; r++) {
        struct analysed it = analyse("lamps64", words);
        for (int i = 0; i < 16; i++)
            light_at(&it, i)->range = (float)(1.5 + 0.05 * r);
        look(&it);
        for (int d = 0; d < it.scene.draw_count; d++)
            kept += it.analysis.draw[d].light_count[SB_LIGHT_POINT];
        done(&it);
    }
    return kept;
}

static void lights_that_move_are_looked_at_where_they_go(void **state)
{
    (void)state;
    assert_true(reached("lights") > reached("static"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_light_that_is_off_or_black_is_left_out_everywhere),
        cmocka_unit_test(at_night_the_sun_is_in_no_list),
        cmocka_unit_test(a_cone_that_misses_and_a_range_that_ends_leave_draws_dark),
        cmocka_unit_test(black_highlights_take_the_model_with_them),
        cmocka_unit_test(black_ambient_and_diffuse_colours_go),
        cmocka_unit_test(maps_stay_where_a_material_has_them_and_something_uses_them),
        cmocka_unit_test(flat_faces_are_not_renormalised_and_round_ones_are),
        cmocka_unit_test(terms_of_the_falloff_go_where_every_coefficient_is_zero),
        cmocka_unit_test(lookups_stay_where_something_may_stand_between),
        cmocka_unit_test(casters_before_one_that_matters_stay_with_their_lights),
        cmocka_unit_test(without_takes_one_effect_from_scenes_and_from_what_is_asked),
        cmocka_unit_test(without_a_type_of_light_its_lights_are_gone),
        cmocka_unit_test(all_that_is_left_out_of_a_draw_adds_less_than_the_threshold),
        cmocka_unit_test(lights_that_move_are_looked_at_where_they_go),
    };
    return run_tests(tests);
}
