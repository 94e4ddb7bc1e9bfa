// What the axes of the scene make of it: sun, atmosphere, lamps, maps, and the phases of moving
// lights. And the numbers of the texts, as far as other tests do not hold them.
#include "scene.h"

#include "math/mat.h"

#define DEGREE (SB_PI / 180)

static struct sb_scene under_sun(const char *name, int dirs, double angle)
{
    struct sb_variant variant = scene_variant(dirs, 0, 0);
    variant.value[SB_AXIS_SUN] = angle;
    return made(name, &variant);
}

// The LWJGL book: "Dawn: (-1, 0, 0), mid day: (0, 1, 0), dusk: (1, 0, 0)", to the light.
static void the_sun_goes_from_dawn_over_noon_to_dusk(void **state)
{
    (void)state;
    static const struct {
        double angle, to_light[3];
    } at[] = {{-90, {-1, 0, 0}},
              {0, {0, 1, 0}},
              {90, {1, 0, 0}},
              {30, {0.5, 0.86602540378, 0}},
              {-45, {-0.70710678118, 0.70710678118, 0}}};
    for (int i = 0; i < sb_scene_row_count; i++) {
        for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
            struct sb_scene scene = under_sun(sb_scene_rows[i].name, 2, at[k].angle);
            assert_int_equal(scene.lights.count[SB_LIGHT_DIR], 2);
            for (int c = 0; c < 3; c++)
                check_close(-scene.lights.light[0].direction[c], at[k].to_light[c], 1e-7);
            sb_scene_free(&scene);
        }
    }
}

// factor = 1 - (|angle| - 80) / 10 from 80 degrees on; green max(factor, 0.9), blue
// max(factor, 0.5).
static void a_low_sun_fades_and_reddens(void **state)
{
    (void)state;
    static const struct {
        double angle, red, green, blue;
    } at[] = {
        {0, 1, 1, 1},           {79, 1, 1, 1},         {-80, 1, 1, 1},
        {81, 0.9, 0.81, 0.81},  {85, 0.5, 0.45, 0.25}, {-85, 0.5, 0.45, 0.25},
        {-89, 0.1, 0.09, 0.05},
    };
    static const double ambient = 0.05, diffuse = 0.4,
                        specular = 0.5; // of the containers
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        struct sb_scene scene = under_sun("containers", 1, at[i].angle);
        const struct sb_light *sun = scene.lights.light;
        const double factor[3] = {at[i].red, at[i].green, at[i].blue};
        for (int c = 0; c < 3; c++) {
            check_close(sun->ambient[c], ambient * factor[c], 1e-7);
            check_close(sun->diffuse[c], diffuse * factor[c], 1e-7);
            check_close(sun->specular[c], specular * factor[c], 1e-7);
        }
        check_close(sun->intensity, at[i].red, 1e-7);
        sb_scene_free(&scene);
    }
}

static void at_the_horizon_a_little_is_left_of_the_sun(void **state)
{
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        struct sb_scene scene = under_sun("blocks", 1, 90 * side);
        assert_true(scene.lights.light[0].intensity > 0);
        assert_true(scene.lights.light[0].intensity < 0.01);
        assert_true(scene.lights.light[0].diffuse[2] > 0);
        sb_scene_free(&scene);
    }
}

static void at_night_the_list_begins_behind_the_sun(void **state)
{
    (void)state;
    struct sb_scene day = under_sun("blocks", 4, 10);
    struct sb_scene night = under_sun("blocks", 4, 90.5);
    struct sb_scene alone = under_sun("blocks", 1, 200);
    assert_int_equal(day.lights.count[SB_LIGHT_DIR], 4);
    assert_int_equal(night.lights.count[SB_LIGHT_DIR], 3);
    assert_memory_equal(night.lights.light, day.lights.light + 1,
                        3 * sizeof *day.lights.light);
    assert_int_equal(sb_lights_total(&alone.lights), 0);
    sb_scene_free(&day);
    sb_scene_free(&night);
    sb_scene_free(&alone);
}

static struct sb_scene in_atmosphere(const char *name, int atmosphere)
{
    struct sb_variant variant = scene_variant(2, 8, 2);
    variant.value[SB_AXIS_AREA] = 2;
    variant.value[SB_AXIS_ATMOSPHERE] = atmosphere;
    return made(name, &variant);
}

static double brightest(const float c[3])
{
    return fmax(c[0], fmax(c[1], c[2]));
}

static void atmospheres_change_colours_only_and_leave_no_light_black(void **state)
{
    (void)state;
    struct sb_scene scene[SB_ATMOSPHERE_VALUE_COUNT];
    for (int a = 0; a < SB_ATMOSPHERE_VALUE_COUNT; a++)
        scene[a] = in_atmosphere("containers", a);
    for (int a = 0; a < SB_ATMOSPHERE_VALUE_COUNT; a++) {
        for (int i = 0; i < sb_lights_total(&scene[a].lights); i++) {
            struct sb_light light = scene[a].lights.light[i];
            const struct sb_light *own = &scene[0].lights.light[i];
            for (int c = 0; c < 3; c++)
                assert_true(light.diffuse[c] > 0 && light.specular[c] > 0);
            for (int b = 0; b < a; b++) {
                const struct sb_light *other = &scene[b].lights.light[i];
                assert_memory_not_equal(light.diffuse, other->diffuse, 12);
                assert_memory_not_equal(light.specular, other->specular, 12);
                if (brightest(own->ambient) > 0)
                    assert_memory_not_equal(light.ambient, other->ambient, 12);
            }
            memcpy(light.ambient, own->ambient, sizeof light.ambient);
            memcpy(light.diffuse, own->diffuse, sizeof light.diffuse);
            memcpy(light.specular, own->specular, sizeof light.specular);
            assert_memory_equal(&light, own, sizeof light);
        }
        for (int b = 0; b < a; b++) {
            assert_memory_not_equal(scene[a].clear_colour, scene[b].clear_colour,
                                    sizeof scene->clear_colour);
            assert_memory_not_equal(scene[a].ambient, scene[b].ambient,
                                    sizeof scene->ambient);
        }
    }
    for (int a = 0; a < SB_ATMOSPHERE_VALUE_COUNT; a++)
        sb_scene_free(&scene[a]);
}

static void atmospheres_are_what_their_names_say(void **state)
{
    (void)state;
    struct sb_scene own = in_atmosphere("containers", SB_ATMOSPHERE_OWN);
    struct sb_scene desert = in_atmosphere("containers", SB_ATMOSPHERE_DESERT);
    struct sb_scene factory = in_atmosphere("containers", SB_ATMOSPHERE_FACTORY);
    struct sb_scene horror = in_atmosphere("containers", SB_ATMOSPHERE_HORROR);
    struct sb_scene lab = in_atmosphere("containers", SB_ATMOSPHERE_LAB);
    for (int i = 0; i < 8; i++) {
        const float *d = light_of(&desert, SB_LIGHT_POINT, i)->diffuse;
        const float *f = light_of(&factory, SB_LIGHT_POINT, i)->diffuse;
        const float *h = light_of(&horror, SB_LIGHT_POINT, i)->diffuse;
        const float *l = light_of(&lab, SB_LIGHT_POINT, i)->diffuse;
        assert_true(d[0] > d[2] && f[2] > f[0] && h[0] > h[1] && l[1] > l[0] &&
                    l[1] > l[2]);
        assert_true(brightest(h) <
                    0.6 * brightest(light_of(&own, SB_LIGHT_POINT, i)->diffuse));
    }
    const float *own_sun = own.lights.light[0].diffuse;
    assert_true(brightest(desert.lights.light[0].diffuse) > brightest(own_sun));
    assert_true(brightest(horror.lights.light[0].diffuse) < 0.5 * brightest(own_sun));
    check_close(brightest(horror.clear_colour), 0, 0);
    assert_true(lab.clear_colour[1] > 0.8);
    // The four colours come in turn, each as bright as the light.
    const struct sb_light *lamp = light_of(&factory, SB_LIGHT_POINT, 0);
    const struct sb_light *own_lamp = light_of(&own, SB_LIGHT_POINT, 0);
    for (int i = 0; i < 4; i++) {
        const double ratio =
            brightest(own_lamp[i + 4].diffuse) / brightest(own_lamp[i].diffuse);
        for (int c = 0; c < 3; c++)
            check_close(lamp[i + 4].diffuse[c], ratio * lamp[i].diffuse[c], 1e-6);
        for (int k = 0; k < i; k++)
            assert_true(fabs(lamp[i].diffuse[0] / brightest(lamp[i].diffuse) -
                             lamp[k].diffuse[0] / brightest(lamp[k].diffuse)) > 0.02);
    }
    sb_scene_free(&own);
    sb_scene_free(&desert);
    sb_scene_free(&factory);
    sb_scene_free(&horror);
    sb_scene_free(&lab);
}

static void an_atmosphere_keeps_the_sun_on_its_way(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(1, 0, 0);
    variant.value[SB_AXIS_ATMOSPHERE] = SB_ATMOSPHERE_DESERT;
    struct sb_scene own = made("blocks", &variant);
    variant.value[SB_AXIS_SUN] = 85;
    struct sb_scene low = made("blocks", &variant);
    static const double factor[3] = {0.5, 0.45, 0.25};
    for (int c = 0; c < 3; c++)
        check_close(low.lights.light[0].diffuse[c],
                    own.lights.light[0].diffuse[c] * factor[c], 1e-7);
    sb_scene_free(&own);
    sb_scene_free(&low);
}

static void lamps_are_small_cubes_where_the_point_lights_are(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_variant variant = scene_variant(0, 5, 0);
        struct sb_scene off = made(sb_scene_rows[i].name, &variant);
        variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
        struct sb_scene on = made(sb_scene_rows[i].name, &variant);
        assert_int_equal(on.draw_count, off.draw_count + 5);
        assert_memory_equal(on.draw, off.draw, (size_t)off.draw_count * sizeof *off.draw);
        for (int d = 0; d < off.draw_count; d++)
            assert_int_equal(off.draw[d].lamp, -1);
        for (int k = 0; k < 5; k++) {
            const struct sb_draw *draw = &on.draw[off.draw_count + k];
            const struct sb_mesh *mesh = &on.mesh[draw->mesh];
            const float *at = light_of(&on, SB_LIGHT_POINT, k)->position;
            assert_int_equal(draw->lamp, k);
            assert_int_equal(mesh->index_count, 36);
            for (int v = 0; v < mesh->vertex_count; v++) {
                for (int c = 0; c < 3; c++) { // the model is not turned
                    const double x = draw->model[5 * c] * mesh->vertex[v].position[c] +
                                     draw->model[12 + c];
                    check_close(fabs(x - at[c]), 0.1, 1e-6);
                }
            }
        }
        sb_scene_free(&off);
        sb_scene_free(&on);
    }
}

// In the text the maps are the material.
static void maps_take_the_place_of_the_containers_colours(void **state)
{
    (void)state;
    static const struct {
        int maps;
        bool diffuse, specular;
    } row[] = {
        {SB_MAPS_NONE, false, false}, {SB_MAPS_D, true, false},
        {SB_MAPS_S, false, true},     {SB_MAPS_N, false, false},
        {SB_MAPS_DS, true, true},     {SB_MAPS_DN, true, false},
        {SB_MAPS_SN, false, true},    {SB_MAPS_DSN, true, true},
    };
    assert_int_equal(sizeof row / sizeof *row, SB_MAPS_VALUE_COUNT);
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        struct sb_variant variant = scene_variant(0, 0, 0);
        variant.value[SB_AXIS_MAPS] = row[i].maps;
        struct sb_scene scene = made("containers", &variant);
        const struct sb_material *material = scene.material;
        for (int c = 0; c < 3; c++) {
            static const double own[3] = {1, 0.5, 0.31};
            check_close(material->ambient[c], row[i].diffuse ? 1 : own[c], 1e-7);
            check_close(material->diffuse[c], row[i].diffuse ? 1 : own[c], 1e-7);
            check_close(material->specular[c], row[i].specular ? 1 : 0.5, 0);
        }
        check_close(material->shininess, 32, 0);
        sb_scene_free(&scene);
    }
}

// --- phases ----------------------------------------------------------------------------

enum { DIRS = 3, POINTS = 4, SPOTS = 2, AREAS = 2, ALL = DIRS + POINTS + SPOTS + AREAS };

static struct sb_scene moving(double scale)
{
    struct sb_variant variant = scene_variant(DIRS, POINTS, SPOTS);
    variant.value[SB_AXIS_AREA] = AREAS;
    variant.value[SB_AXIS_SCALE] = scale;
    return made("room", &variant);
}

static double apart(const float a[3], const float b[3])
{
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

static void phase_0_is_the_scene_itself(void **state)
{
    (void)state;
    struct sb_scene scene = moving(3);
    struct sb_light out[ALL];
    sb_lights_phase(&scene.lights, &(struct sb_phase){.scale = 3}, out);
    assert_memory_equal(out, scene.lights.light, sizeof out);
    sb_scene_free(&scene);
}

// A regular octagon, so that the last phase is as far from phase 0 as from the one before.
static void places_go_around_a_small_circle(void **state)
{
    (void)state;
    static const double scales[] = {1, 0.25, 100};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        struct sb_scene scene = moving(scales[s]);
        struct sb_light before[ALL], out[ALL];
        const double chord = 2 * 0.05 * sin(SB_PI / SB_PHASES) * scales[s];
        memcpy(before, scene.lights.light, sizeof before);
        for (int phase = 1; phase <= SB_PHASES; phase++) {
            sb_lights_phase(
                &scene.lights,
                &(struct sb_phase){.number = phase % SB_PHASES, .scale = scales[s]}, out);
            for (int i = DIRS; i < ALL; i++) {
                check_close(apart(out[i].position, before[i].position) / chord, 1, 1e-4);
                struct sb_light same = out[i]; // in all else
                memcpy(same.position, scene.lights.light[i].position,
                       sizeof same.position);
                assert_memory_equal(&same, &scene.lights.light[i], sizeof same);
            }
            memcpy(before, out, sizeof before);
        }
        sb_scene_free(&scene);
    }
}

static void suns_turn_a_step_of_the_text_about_z(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(DIRS, 0, 0);
    variant.value[SB_AXIS_SUN] = 20;
    struct sb_scene scene = made("blocks", &variant);
    struct sb_light out[DIRS];
    for (int phase = 0; phase < SB_PHASES; phase++) {
        sb_lights_phase(&scene.lights, &(struct sb_phase){.number = phase, .scale = 1},
                        out);
        const double angle = (20 + 1.1 * phase) * DEGREE;
        check_close(out[0].direction[0], -sin(angle), 1e-6);
        check_close(out[0].direction[1], -cos(angle), 1e-6);
        for (int i = 0; i < DIRS; i++) {
            const float *now = out[i].direction, *own = scene.lights.light[i].direction;
            check_close(now[2], own[2], 0);
            check_close(hypot(now[0], now[1]), hypot(own[0], own[1]), 1e-6);
            check_close(now[0] * own[0] + now[1] * own[1],
                        cos(1.1 * phase * DEGREE) * (own[0] * own[0] + own[1] * own[1]),
                        1e-6);
        }
    }
    sb_scene_free(&scene);
}

static void casters_stand_still_where_asked(void **state)
{
    (void)state;
    struct sb_scene scene = moving(1);
    struct sb_light out[ALL];
    sb_lights_phase(&scene.lights,
                    &(struct sb_phase){.number = 5, .still_points = 2, .scale = 1}, out);
    for (int i = 0; i < ALL; i++) {
        const bool still = i >= DIRS && i < DIRS + 2;
        assert_int_equal(memcmp(&out[i], &scene.lights.light[i], sizeof *out) == 0,
                         still);
    }
    sb_scene_free(&scene);
}

// --- the texts -------------------------------------------------------------------------

static void check_vector(const float got[3], double x, double y, double z)
{
    check_close(got[0], x, 1e-7);
    check_close(got[1], y, 1e-7);
    check_close(got[2], z, 1e-7);
}

// The wikibook's light0, light1, frontMaterial and scene_ambient.
static void the_tunnel_has_the_numbers_of_the_wikibook(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 9, 9);
    struct sb_scene scene = made("tunnel", &variant);
    const struct sb_light *light0 = light_of(&scene, SB_LIGHT_POINT, 0);
    check_vector(light0->position, 0, 1, 2);
    check_vector(light0->diffuse, 1, 1, 1);
    check_vector(light0->specular, 1, 1, 1);
    const struct sb_light *light1 = light_of(&scene, SB_LIGHT_SPOT, 0);
    check_vector(light1->position, 0, -2, 0);
    check_vector(light1->diffuse, 2, 0, 0);
    check_vector(light1->specular, 0.1, 0.1, 0.1);
    check_vector(light1->direction, 0, 1, 0);
    check_close(light1->cutoff, 80 * DEGREE, 1e-6);
    check_close(light1->exponent, 10, 0);
    for (int i = 0; i < sb_lights_total(&scene.lights); i++) {
        check_close(scene.lights.light[i].constant, 0, 0);
        check_close(scene.lights.light[i].linear, 1, 0);
        check_close(scene.lights.light[i].quadratic, 0, 0);
    }
    check_vector(scene.ambient, 0.2, 0.2, 0.2);
    check_vector(scene.material->ambient, 0.2, 0.2, 0.2);
    check_vector(scene.material->diffuse, 1, 0.8, 0.8);
    check_vector(scene.material->specular, 1, 1, 1);
    check_close(scene.material->shininess, 5, 0);
    sb_scene_free(&scene);
}

static void spheres_have_a_material_each(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    struct sb_scene scene = made("spheres", &variant);
    assert_int_equal(scene.draw_count, 8);
    assert_int_equal(scene.material_count, 8);
    for (int a = 0; a < 8; a++) {
        const struct sb_material *it = &scene.material[a];
        assert_int_equal(scene.draw[a].material, a);
        for (int c = 0; c < 3; c++)
            assert_true(it->diffuse[c] >= 0.1f);
        for (int b = 0; b < a; b++) {
            const struct sb_material *other = &scene.material[b];
            assert_memory_not_equal(it->ambient, other->ambient, sizeof it->ambient);
            assert_memory_not_equal(it->diffuse, other->diffuse, sizeof it->diffuse);
            assert_memory_not_equal(it->specular, other->specular, sizeof it->specular);
            assert_true(it->shininess != other->shininess);
        }
    }
    sb_scene_free(&scene);
}

// A reflectance has no colour.
static void blocks_reflect_grey(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    struct sb_scene scene = made("blocks", &variant);
    const float *specular = scene.material->specular;
    assert_true(specular[0] > 0);
    check_vector(specular, specular[0], specular[0], specular[0]);
    check_vector(scene.material->ambient, scene.material->diffuse[0],
                 scene.material->diffuse[1], scene.material->diffuse[2]);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sun_goes_from_dawn_over_noon_to_dusk),
        cmocka_unit_test(a_low_sun_fades_and_reddens),
        cmocka_unit_test(at_the_horizon_a_little_is_left_of_the_sun),
        cmocka_unit_test(at_night_the_list_begins_behind_the_sun),
        cmocka_unit_test(atmospheres_change_colours_only_and_leave_no_light_black),
        cmocka_unit_test(atmospheres_are_what_their_names_say),
        cmocka_unit_test(an_atmosphere_keeps_the_sun_on_its_way),
        cmocka_unit_test(lamps_are_small_cubes_where_the_point_lights_are),
        cmocka_unit_test(maps_take_the_place_of_the_containers_colours),
        cmocka_unit_test(phase_0_is_the_scene_itself),
        cmocka_unit_test(places_go_around_a_small_circle),
        cmocka_unit_test(suns_turn_a_step_of_the_text_about_z),
        cmocka_unit_test(casters_stand_still_where_asked),
        cmocka_unit_test(the_tunnel_has_the_numbers_of_the_wikibook),
        cmocka_unit_test(spheres_have_a_material_each),
        cmocka_unit_test(blocks_reflect_grey),
    };
    return run_tests(tests);
}
