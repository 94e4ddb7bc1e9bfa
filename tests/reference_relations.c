// Relations that the reference's shading must keep whatever the numbers are: the order of
// lights, their parts, turns, mirrors, scales and spaces. And the slips of the source texts
// against what docs/sources.md says of them.
#include "lit_world.h"

#include "math/random.h"

static double between(struct sb_random *random, double low, double high)
{
    return low + (high - low) * sb_random_unit(random);
}

static struct sb_vec3 any_vector(struct sb_random *random)
{
    return (struct sb_vec3){between(random, -1, 1), between(random, -1, 1),
                            between(random, -1, 1)};
}

static void put_vector(float out[3], struct sb_vec3 v)
{
    put3(out, v.x, v.y, v.z);
}

static void add_any(struct world *world, enum sb_light_type type,
                    struct sb_random *random)
{
    struct sb_light *light = world_add(world, type, 0, 0, 0);
    if (type != SB_LIGHT_DIR)
        put_vector(light->position, sb_vec3_scale(any_vector(random), 3));
    struct sb_vec3 direction = any_vector(random);
    if (type == SB_LIGHT_SPOT) { // at the point, so that it is in the cone
        direction = sb_vec3_normalise(
            sb_vec3_sub(sb_vec3_scale(direction, 0.3),
                        sb_vec3_normalise(sb_ref_vec(light->position))));
        sb_light_set_cone(light, 0.3, between(random, 0.5, 2));
    }
    put_vector(light->direction, direction);
    put_vector(light->extent, (struct sb_vec3){0.4, 0.2, 0.3});
    for (int i = 0; i < 3; i++) {
        light->ambient[i] = (float)between(random, 0, 1);
        light->diffuse[i] = (float)between(random, 0, 1);
        light->specular[i] = (float)between(random, 0, 1);
    }
    light->radius = 0.3f;
    light->range = 8;
    light->linear = 0.25f;
    light->quadratic = 0.125f;
    light->exponent = 3;
}

// A world of each kind: number after number goes through the values of all axes.
static void make_any(struct world *world, int number, struct sb_random *random)
{
    static const struct {
        int axis, values;
    } axes[] = {
        {SB_AXIS_MODEL, SB_MODEL_VALUE_COUNT},
        {SB_AXIS_ATTENUATION, SB_ATTENUATION_VALUE_COUNT},
        {SB_AXIS_CONE, SB_CONE_VALUE_COUNT},
        {SB_AXIS_AREA_SHAPE, SB_AREA_SHAPE_VALUE_COUNT},
        {SB_AXIS_AMBIENT, SB_AMBIENT_VALUE_COUNT},
        {SB_AXIS_SPECULAR_SIDE, SB_SPECULAR_SIDE_VALUE_COUNT},
        {SB_AXIS_FRESNEL, SB_FRESNEL_VALUE_COUNT},
        {SB_AXIS_SPECULAR_NORM, SB_SPECULAR_NORM_VALUE_COUNT},
        {SB_AXIS_HOIST, SB_HOIST_VALUE_COUNT},
        {SB_AXIS_NORMALISE, SB_NORMALISE_VALUE_COUNT},
    };
    world_make(world, "");
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++) {
        world->variant.value[axes[i].axis] = number % axes[i].values;
        number = number / axes[i].values * 7 + (int)sb_random_below(random, 1000);
    }
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        for (int i = 0; i < 2; i++)
            add_any(world, type, random);
    put_vector(world->scene.camera.eye, sb_vec3_scale(any_vector(random), 4));
    put3(world->scene.ambient, 0.5, 0.25, 0.125);
    put3(world->material.ambient, 0.3, 0.2, 0.1);
    world->material.shininess = (float)between(random, 1, 64);
    world->input.position = any_vector(random);
    world->input.normal =
        sb_vec3_scale(sb_vec3_normalise(any_vector(random)), between(random, 0.8, 1));
}

static void check_vectors(struct sb_vec3 a, struct sb_vec3 b, double tolerance)
{
    check_close(a.x, b.x, tolerance);
    check_close(a.y, b.y, tolerance);
    check_close(a.z, b.z, tolerance);
}

enum { WORLDS = 2000 };

// --- lights ---------------------------------------------------------------------------------

static void the_order_of_lights_of_a_type_does_not_matter(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        struct sb_ref_terms terms[8], again[8];
        const struct sb_ref_shade before = shade(&world, terms);
        for (int pair = 0; pair < 8; pair += 2) {
            const struct sb_light first = world.light[pair];
            world.light[pair] = world.light[pair + 1];
            world.light[pair + 1] = first;
        }
        const struct sb_ref_shade after = shade(&world, again);
        check_vectors(after.diffuse, before.diffuse, 1e-14);
        check_vectors(after.specular, before.specular, 1e-14);
        for (int light = 0; light < 8; light++)
            assert_memory_equal(&again[light], &terms[light ^ 1], sizeof *terms);
        // Asking for terms or not is the same.
        const struct sb_ref_shade without = shade(&world, NULL);
        assert_memory_equal(&without, &after, offsetof(struct sb_ref_shade, decisions));
        assert_int_equal(without.decisions, after.decisions);
    }
}

static void a_light_in_two_parts_is_the_light(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(2);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        const struct sb_ref_shade whole = shade(&world, NULL);
        struct sb_light parts[16];
        for (int light = 0; light < 8; light++) {
            parts[2 * light] = world.light[light];
            float *colour[] = {parts[2 * light].ambient, parts[2 * light].diffuse,
                               parts[2 * light].specular};
            for (int c = 0; c < 9; c++)
                colour[c / 3][c % 3] *= 0.5f;
            parts[2 * light + 1] = parts[2 * light];
        }
        world.shading.lights = (struct sb_lights){parts, {4, 4, 4, 4}};
        const struct sb_ref_shade halves = shade(&world, NULL);
        check_vectors(halves.diffuse, whole.diffuse, 1e-14);
        check_vectors(halves.specular, whole.specular, 1e-14);
    }
}

// Sums are made of what the terms say.
static void the_terms_add_up(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        world.variant.value[SB_AXIS_AMBIENT] = SB_AMBIENT_NONE;
        struct sb_ref_terms terms[8];
        const struct sb_ref_shade made = shade(&world, terms);
        double diffuse = 0, specular = 0;
        for (int light = 0; light < 8; light++) {
            const struct sb_ref_terms *it = &terms[light];
            const double factor = it->attenuation[0] * it->cone[0] * it->shown[0];
            check_close(it->diffuse_weight[0], factor * fmax(it->n_dot_l[0], 0), 0);
            check_close(it->specular_weight[0], factor * it->specular[0], 0);
            diffuse += world.light[light].diffuse[1] * it->diffuse_weight[0];
            specular += world.light[light].specular[1] * it->specular_weight[0];
        }
        check_close(made.diffuse.y, diffuse, 1e-14);
        check_close(made.specular.y, specular, 1e-14);
    }
}

// --- motions, which floats have exactly -----------------------------------------------------

struct motion {
    struct sb_vec3 (*vector)(struct sb_vec3 v);
    double scale; // of lengths
};

static void move_floats(float v[3], const struct motion *motion, double scale)
{
    put_vector(v, sb_vec3_scale(motion->vector(sb_ref_vec(v)), scale));
}

static void move(struct world *world, const struct motion *motion)
{
    const double scale = motion->scale;
    for (int i = 0; i < sb_lights_total(&world->shading.lights); i++) {
        struct sb_light *light = &world->light[i];
        const bool area = i >= 6;
        move_floats(light->position, motion, scale);
        move_floats(light->direction, motion, area ? scale : 1);
        move_floats(light->extent, motion, scale);
        for (int c = 0; c < 3; c++)
            light->extent[c] = fabsf(light->extent[c]);
        light->radius *= (float)scale;
        light->range *= (float)scale;
        light->linear /= (float)scale;
        light->quadratic /= (float)(scale * scale);
    }
    move_floats(world->scene.camera.eye, motion, scale);
    struct sb_ref_input *input = &world->input;
    input->position = sb_vec3_scale(motion->vector(input->position), scale);
    input->normal = motion->vector(input->normal);
}

static struct sb_vec3 quarter_turn(struct sb_vec3 v)
{
    return (struct sb_vec3){-v.y, v.x, v.z};
}
static struct sb_vec3 third_turn(struct sb_vec3 v)
{
    return (struct sb_vec3){v.z, v.x, v.y};
}
static struct sb_vec3 mirrored(struct sb_vec3 v)
{
    return (struct sb_vec3){v.x, -v.y, v.z};
}
static struct sb_vec3 as_it_is(struct sb_vec3 v)
{
    return v;
}

static void turned_mirrored_and_scaled_worlds_are_lit_alike(void **state)
{
    (void)state;
    static const struct motion motions[] = {
        {quarter_turn, 1},   {third_turn, 1},    {mirrored, 1},
        {as_it_is, 0x1p-20}, {as_it_is, 0x1p12}, {quarter_turn, 0.25},
    };
    struct sb_random random = sb_random_seed(4);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        const struct motion *motion = &motions[i % 6];
        // The windowed law has a length of its own: d^2 + 1.
        if (motion->scale != 1 &&
            world.variant.value[SB_AXIS_ATTENUATION] == SB_ATTENUATION_WINDOWED)
            continue;
        struct sb_ref_terms terms[8], moved[8];
        const struct sb_ref_shade before = shade(&world, terms);
        move(&world, motion);
        const struct sb_ref_shade after = shade(&world, moved);
        check_vectors(after.diffuse, before.diffuse, 1e-13);
        check_vectors(after.specular, before.specular, 1e-13);
        check_vectors(after.normal, motion->vector(before.normal), 1e-15);
        check_vectors(after.view, motion->vector(before.view), 1e-15);
        assert_int_equal(after.decisions, before.decisions);
        for (int light = 0; light < 8; light++) {
            const double d = terms[light].distance[0] * motion->scale;
            check_close(moved[light].distance[0], d, 1e-14 * d);
            check_close(moved[light].cone[0], terms[light].cone[0], 1e-13);
            check_close(moved[light].n_dot_l[0], terms[light].n_dot_l[0], 1e-14);
        }
    }
}

// A turn that floats have exactly and that is not its own inverse.
static struct sb_vec3 seen(struct sb_vec3 v)
{
    return (struct sb_vec3){v.y, -v.z, -v.x};
}

static void view_space_is_no_different(void **state)
{
    (void)state;
    // seen(), and the eye at (0.5, -1, 2) to the origin.
    static const float view[16] = {0, 0, -1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1, 2, 0.5f, 1};
    struct sb_random random = sb_random_seed(5);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        put3(world.scene.camera.eye, 0.5, -1, 2);
        memcpy(world.scene.camera.view, view, sizeof view);
        for (int light = 0; light < 8; light++) // places that view space has exactly
            for (int c = 0; c < 3; c++)
                world.light[light].position[c] =
                    rintf(world.light[light].position[c] * 1024) / 1024;
        struct sb_ref_terms terms[8], again[8];
        const struct sb_ref_shade before = shade(&world, terms);

        struct sb_light lights[8];
        for (int light = 0; light < 8; light++)
            lights[light] = sb_light_to_view(&world.light[light], light / 2,
                                             &world.scene.camera, false);
        world.shading.view_space = true;
        world.shading.lights.light = lights;
        world.input.position =
            seen(sb_vec3_sub(world.input.position, (struct sb_vec3){0.5, -1, 2}));
        world.input.normal = seen(world.input.normal);
        const struct sb_ref_shade after = shade(&world, again);
        check_vectors(after.diffuse, before.diffuse, 1e-13);
        check_vectors(after.specular, before.specular, 1e-13);
        for (int light = 0; light < 8; light++)
            check_close(again[light].distance[0], terms[light].distance[0], 1e-14);
    }
}

static void one_array_for_all_types_lights_alike(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(6);
    for (int i = 0; i < WORLDS; i++) {
        struct world world;
        make_any(&world, i, &random);
        world.shading.lights.count[SB_LIGHT_AREA] = 0;
        const struct sb_ref_shade before = shade(&world, NULL);
        struct sb_light lights[6];
        for (int light = 0; light < 6; light++)
            lights[light] = sb_light_unified(&world.light[light], light / 2);
        world.shading.lights.light = lights;
        world.variant.value[SB_AXIS_LAYOUT] = SB_LAYOUT_UNIFIED;
        struct sb_ref_terms terms[6];
        const struct sb_ref_shade after = shade(&world, terms);
        // The vector to a sun is rounded to floats there.
        const double x = terms[0].direction[0], z = terms[0].direction[2];
        check_close(z * lights[0].position[0], x * lights[0].position[2], 2e-16);
        check_vectors(after.diffuse, before.diffuse, 1e-6);
        check_vectors(after.specular, before.specular, 1e-5);
    }
}

// --- decisions ------------------------------------------------------------------------------

static void decisions_are_hashed_light_by_light(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "point=2,spot=2,shadows=1,model=phong,cone=hard");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    world_add(&world, SB_LIGHT_POINT, 0, 0, -2);
    for (int i = 0; i < 2; i++) {
        struct sb_light *light = world_add(&world, SB_LIGHT_SPOT, 0, 0, 2);
        put3(light->direction, i, 0, i - 1);
        sb_light_set_cone(light, 0.1, 0.2);
    }
    static const int all[] = {16, 1, 0, 1, 1, 0, 1}; // shadow N; N; cone N; cone N
    static const int cones[] = {16, 1, 0};
    uint32_t hash = 0;
    for (int i = 0; i < 7; i++)
        hash = sb_ref_decide(hash, all[i]);
    assert_int_equal(shade(&world, NULL).decisions, hash);
    // No highlights to cut, and a cone that has no edge.
    world.variant.value[SB_AXIS_SPECULAR_SIDE] = SB_SPECULAR_BOTH;
    hash = 0;
    for (int i = 0; i < 3; i++)
        hash = sb_ref_decide(hash, cones[i]);
    assert_int_equal(shade(&world, NULL).decisions, hash);
    world.variant.value[SB_AXIS_MODEL] = SB_MODEL_LAMBERT;
    world.variant.value[SB_AXIS_SPECULAR_SIDE] = SB_SPECULAR_FRONT;
    world.variant.value[SB_AXIS_CONE] = SB_CONE_SMOOTH;
    assert_int_equal(shade(&world, NULL).decisions, sb_ref_decide(0, 16));
}

// --- slips (docs/sources.md) ----------------------------------------------------------------

static void lwjgl_subtracts_a_position_in_view_space_from_the_cameras(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "point=1,source=lwjgl,text=as_written,space=view");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    world.shading.view_space = true;
    put3(world.scene.camera.eye, 3, 0, 1);
    world.input.position = (struct sb_vec3){0, 0, -3};
    check_vectors(shade(&world, NULL).view, (struct sb_vec3){0.6, 0, 0.8}, 1e-15);
    world.variant.value[SB_AXIS_TEXT] = SB_TEXT_CORRECTED;
    check_vectors(shade(&world, NULL).view, (struct sb_vec3){0, 0, 1}, 0);
}

static void ubo_compares_the_ray_with_the_normal_and_keeps_its_length(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "dir=1,source=ubo,text=as_written,model=phong");
    world_add(&world, SB_LIGHT_DIR, -3, 0, -4);
    world.input.normal.z = 0.5;
    for (int ideal = 0; ideal < 2; ideal++) { // the text is no matter of quality
        world.shading.ideal = ideal;
        put3(world.scene.camera.eye, 0, (float)(5 * ideal), 4); // wherever the eye is
        struct sb_ref_terms it;
        shade(&world, &it);
        check_close(it.n_dot_l[0], 0.4, 1e-15);
        check_close(it.specular[0], pow(0.8, 8), 1e-15);
    }
}

static void shadows_has_the_intensity_in_the_power_too_and_tints_highlights(void **state)
{
    (void)state;
    static const unsigned char red[4] = {255, 0, 51, 255};
    struct world world;
    world_make(&world,
               "point=1,source=shadows,text=as_written,model=phong,attenuation=radius,"
               "maps=diffuse");
    world.scene.map[SB_MAP_DIFFUSE] = (struct sb_texture){1, 1, red};
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2)->range = 8; // 3/4 are left
    put3(world.scene.camera.eye, 3, 0, 4);                 // R . V = 0.8
    struct sb_ref_terms it;
    const struct sb_ref_shade made = shade(&world, &it);
    check_close(it.specular[0], pow(0.75 * 0.8, 8), 1e-16);
    check_close(it.specular_weight[0], pow(0.75 * 0.8, 8) * 0.75, 1e-16);
    const struct sb_vec3 colour = sb_ref_colour(&world.shading, &made, &world.input);
    check_close(colour.x, 0.75 + it.specular_weight[0], 1e-15);
    check_close(colour.y, 0, 0);
    check_close(colour.z, colour.x / 5, 1e-15);
    world.light[0].range = 1; // out of reach
    shade(&world, &it);
    assert_true(it.specular[0] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_of_lights_of_a_type_does_not_matter),
        cmocka_unit_test(a_light_in_two_parts_is_the_light),
        cmocka_unit_test(the_terms_add_up),
        cmocka_unit_test(turned_mirrored_and_scaled_worlds_are_lit_alike),
        cmocka_unit_test(view_space_is_no_different),
        cmocka_unit_test(one_array_for_all_types_lights_alike),
        cmocka_unit_test(decisions_are_hashed_light_by_light),
        cmocka_unit_test(lwjgl_subtracts_a_position_in_view_space_from_the_cameras),
        cmocka_unit_test(ubo_compares_the_ray_with_the_normal_and_keeps_its_length),
        cmocka_unit_test(shadows_has_the_intensity_in_the_power_too_and_tints_highlights),
    };
    return run_tests(tests);
}
