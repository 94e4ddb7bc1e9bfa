// The shading of the reference against the textbook formulas in 200 bits: random inputs of every
// light type, model, cone, law and shape, and the hard inputs of each.
#include "reference_mpfr/textbook.h"

#include "math/random.h"

static double between(struct sb_random *random, double low, double high)
{
    return low + (high - low) * sb_random_unit(random);
}

static double magnitude(struct sb_random *random, double low, double high)
{
    return exp(between(random, log(low), log(high)));
}

static struct sb_vec3 any_direction(struct sb_random *random)
{
    for (;;) {
        const struct sb_vec3 v = {between(random, -1, 1), between(random, -1, 1),
                                  between(random, -1, 1)};
        const double v2 = sb_vec3_dot(v, v);
        if (v2 <= 1 && v2 > 0.01)
            return sb_vec3_scale(v, 1 / sqrt(v2));
    }
}

static void put_vector(float out[3], struct sb_vec3 v)
{
    put3(out, v.x, v.y, v.z);
}

// --- comparing ------------------------------------------------------------------------------

// Terms agree to 1e-12 of themselves, and to 1e-15 where they are small. Three things make more of
// a rounding than there was, whatever the formula: `scale` says how much.
static void check(const char *name, double got, wide textbook, double scale)
{
    const double want = narrow(textbook);
    const double off = fabs(narrow(minus(of(got), textbook)));
    if (off <= 1e-12 * scale * fmax(fabs(want), 1e-3))
        return;
    fail_msg("%s: %.17g instead of %.17g; scale %g", name, got, want, scale);
}

// A power of n makes n times of a relative error.
static double steepness(const struct world *world)
{
    return fmax(world->material.shininess / 256, 1);
}

// To round the place of the surface turns the direction to the light by 1e-16: much, where the
// cone is narrow.
static double narrowness(const struct sb_light *light, enum sb_light_type type)
{
    return type == SB_LIGHT_SPOT && light->cutoff < 1 ? 1 / light->cutoff : 1;
}

// And a light that is attenuated by more than 1 makes more of a small cosine.
static double brightness(const struct textbook *it)
{
    return fmax(narrow(it->attenuation), 1);
}

static void check_terms(const struct world *world, const struct sb_light *light,
                        enum sb_light_type type, const struct sb_ref_terms *terms,
                        const struct textbook *it)
{
    const double steep = steepness(world), thin = narrowness(light, type);
    const double bright = brightness(it) * thin;
    const wide direction[3] = {it->direction.x, it->direction.y, it->direction.z};
    check("distance", terms->distance[0], it->distance, 1);
    for (int c = 0; c < 3; c++)
        check("direction", terms->direction[c], direction[c], 1);
    check("attenuation", terms->attenuation[0], it->attenuation, 1);
    check("cone", terms->cone[0], it->cone, thin);
    check("n_dot_l", terms->n_dot_l[0], it->n_dot_l, 1);
    check("specular", terms->specular[0], it->specular, steep);
    check("diffuse_weight", terms->diffuse_weight[0], it->diffuse_weight, bright);
    check("specular_weight", terms->specular_weight[0], it->specular_weight,
          steep * bright);
}

struct sums { // of `specular` with the material
    wide diffuse[3], specular[3];
    double scale;
};

static void add(struct sums *sums, const struct world *world,
                const struct textbook_surface *surface, const struct sb_light *light,
                enum sb_light_type type, const struct textbook *it)
{
    for (int c = 0; c < 3; c++) {
        sums->diffuse[c] =
            plus(sums->diffuse[c], times(of(light->diffuse[c]), it->diffuse_weight));
        const wide arrives = times(of(light->specular[c]), it->specular_weight);
        const wide leaves =
            textbook_fresnel(world, surface, it->highlight, world->material.specular[c]);
        sums->specular[c] = plus(sums->specular[c], times(arrives, leaves));
    }
    sums->scale =
        fmax(sums->scale, steepness(world) * narrowness(light, type) * brightness(it));
}

// True where all could be compared: where a decision hangs on the last bits it is anyone's.
static bool compare(const struct world *world)
{
    struct sb_ref_terms terms[WORLD_LIGHTS];
    wide_empty();
    const struct sb_ref_shade made = shade(world, terms);
    const struct textbook_surface surface = textbook_surface(world);
    struct sums sums = {.scale = 1};
    for (int c = 0; c < 3; c++)
        sums.diffuse[c] = sums.specular[c] = of(0);
    const struct sb_light *light = world->light;
    bool all = true;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        for (int i = 0; i < world->shading.lights.count[type]; i++, light++) {
            const struct textbook it = textbook_light(world, &surface, light, type);
            all &= it.margin > 1e-13;
            if (it.margin > 1e-13)
                check_terms(world, light, type, &terms[light - world->light], &it);
            add(&sums, world, &surface, light, type, &it);
        }
    const double diffuse[3] = {made.diffuse.x, made.diffuse.y, made.diffuse.z};
    const double specular[3] = {made.specular.x, made.specular.y, made.specular.z};
    const float *ambient = world->material.ambient;
    for (int c = 0; all && c < 3; c++) {
        const wide scattered = times(of(world->material.diffuse[c]), sums.diffuse[c]);
        const wide around = times(of(ambient[c]), of(world->scene.ambient[c]));
        check("diffuse", diffuse[c], plus(around, scattered), sums.scale);
        check("specular light", specular[c], sums.specular[c], sums.scale);
    }
    return all;
}

// --- random inputs --------------------------------------------------------------------------

static void add_any(struct world *world, enum sb_light_type type,
                    struct sb_random *random)
{
    struct sb_light *light = world_add(world, type, 0, 0, 0);
    const struct sb_vec3 away =
        sb_vec3_scale(any_direction(random), magnitude(random, 0.01, 100));
    const struct sb_vec3 at = sb_vec3_add(world->input.position, away);
    struct sb_vec3 direction = any_direction(random);
    if (type != SB_LIGHT_DIR)
        put_vector(light->position, at);
    if (type == SB_LIGHT_SPOT) { // the point is near the edge of the cone or within
        const double outer = magnitude(random, 3.5e-4, 3);
        const double off = between(random, 0, 1.1) * outer;
        const struct sb_vec3 to = sb_vec3_normalise(
            sb_vec3_sub(world->input.position, sb_ref_vec(light->position)));
        const struct sb_vec3 across = sb_vec3_normalise(sb_vec3_cross(to, direction));
        direction =
            sb_vec3_add(sb_vec3_scale(to, cos(off)), sb_vec3_scale(across, sin(off)));
        sb_light_set_cone(light, between(random, 0, 1) * outer, outer);
        light->exponent = (float)magnitude(random, 0.1, 128);
    }
    put_vector(light->direction, direction);
    if (type == SB_LIGHT_AREA) {
        put_vector(light->direction, sb_vec3_scale(direction, between(random, 0, 3)));
        light->radius = (float)between(random, 0, 2);
        put3(light->extent, between(random, 0, 2), between(random, 0, 2), 1);
    }
    light->range = (float)magnitude(random, 1, 200);
    light->constant = (float)between(random, 0, 2);
    light->linear = (float)between(random, 0, 2);
    light->quadratic = (float)between(random, 0, 2);
    for (int c = 0; c < 3; c++) {
        light->diffuse[c] = (float)between(random, 0, 1);
        light->specular[c] = (float)between(random, 0, 1);
    }
}

static void make_any(struct world *world, struct sb_random *random)
{
    static const unsigned char texel[4] = {200, 90, 240, 255};
    static const struct {
        int axis, values;
    } axes[] = {
        {SB_AXIS_MODEL, SB_MODEL_VALUE_COUNT},
        {SB_AXIS_ATTENUATION, SB_ATTENUATION_VALUE_COUNT},
        {SB_AXIS_CONE, SB_CONE_VALUE_COUNT},
        {SB_AXIS_AREA_SHAPE, SB_AREA_SHAPE_VALUE_COUNT},
        {SB_AXIS_SPECULAR_SIDE, SB_SPECULAR_SIDE_VALUE_COUNT},
        {SB_AXIS_FRESNEL, SB_FRESNEL_VALUE_COUNT},
        {SB_AXIS_SPECULAR_NORM, SB_SPECULAR_NORM_VALUE_COUNT},
        {SB_AXIS_HOIST, SB_HOIST_VALUE_COUNT},
        {SB_AXIS_NORMALISE, SB_NORMALISE_VALUE_COUNT},
    };
    world_make(world, "");
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++)
        world->variant.value[axes[i].axis] =
            (double)sb_random_below(random, (uint64_t)axes[i].values);
    if (sb_random_below(random, 4) == 0)
        world->variant.value[SB_AXIS_MAPS] = SB_MAPS_N;
    world->scene.map[SB_MAP_NORMAL] = (struct sb_texture){1, 1, texel};
    struct sb_ref_input *input = &world->input;
    input->position = sb_vec3_scale(any_direction(random), magnitude(random, 0.1, 10));
    input->normal = sb_vec3_scale(any_direction(random), between(random, 0.7, 1));
    input->tangent = any_direction(random);
    input->bitangent = sb_vec3_cross(input->normal, input->tangent);
    const struct sb_vec3 to_eye =
        sb_vec3_scale(any_direction(random), magnitude(random, 0.1, 100));
    put_vector(world->scene.camera.eye, sb_vec3_add(input->position, to_eye));
    put3(world->scene.ambient, 0.25, 0.5, 1);
    put3(world->material.ambient, 0.5, 0.25, 2);
    put3(world->material.specular, 0.04, 0.5, 1);
    // A power below 1 is steeper than its base near 0, where 1e-17 is made 1e-9.
    world->material.shininess = (float)magnitude(random, 1, 256);
}

static void random_inputs_agree(void **state)
{
    (void)state;
    enum { INPUTS = 10000 };
    struct sb_random random = sb_random_seed(1);
    int compared = 0;
    for (int i = 0; i < INPUTS; i++) {
        struct world world;
        make_any(&world, &random);
        for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
            add_any(&world, type, &random);
        compared += compare(&world);
    }
    assert_in_range(compared, INPUTS - 10, INPUTS);
}

// Within a highlight, whose width is 1 / sqrt(n).
static void highlights_agree_up_to_a_shininess_of_a_million(void **state)
{
    (void)state;
    static const char *const models[] = {"model=phong", "model=blinn"};
    struct sb_random random = sb_random_seed(2);
    for (int i = 0; i < 4000; i++) {
        struct world world;
        world_make(&world, models[i % 2]);
        world.material.shininess = (float)magnitude(&random, 1, 1e6);
        const struct sb_vec3 to_light = any_direction(&random);
        const struct sb_vec3 to_eye = any_direction(&random);
        struct sb_vec3 off = any_direction(&random);
        off = sb_vec3_scale(off, between(&random, 0, 4) / sqrt(world.material.shininess));
        world.input.normal =
            sb_vec3_add(sb_vec3_normalise(sb_vec3_add(to_light, to_eye)), off);
        put_vector(world.scene.camera.eye, sb_vec3_scale(to_eye, 3));
        const struct sb_vec3 at = sb_vec3_scale(to_light, 2);
        world_add(&world, SB_LIGHT_POINT, (float)at.x, (float)at.y, (float)at.z);
        compare(&world);
    }
}

// --- hard inputs: the cases of a lighting shader that lose digits, or have no value ---------

static const char *const models[] = {"model=phong,specular_side=both",
                                     "model=blinn,specular_side=both"};

// A point light, for each model.
static void each_model(void (*make_hard)(struct world *world, double size), double size)
{
    for (int m = 0; m < 2; m++) {
        struct world world;
        world_make(&world, models[m]);
        world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
        put3(world.scene.camera.eye, 1, 0, 2);
        make_hard(&world, size);
        assert_true(compare(&world));
    }
}

static void away(struct world *world, double distance)
{
    world->variant.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_POLYNOMIAL;
    world->light[0].constant = 0;
    world->light[0].quadratic = 1;
    put3(world->light[0].position, distance * 0.3, -distance * 0.2, distance);
}

static void lights_on_the_surface_and_at_any_distance_agree(void **state)
{
    (void)state;
    each_model(away, 0);
    for (double distance = 1e-18; distance < 1e19; distance *= 7)
        each_model(away, distance);
}

static void near_the_range(struct world *world, double gap)
{
    put3(world->light[0].position, 0, 0, 8 * (1 - gap));
    world->light[0].range = 8;
}

static void radius(struct world *world, double gap)
{
    near_the_range(world, gap);
    world->variant.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_RADIUS;
}

static void windowed(struct world *world, double gap)
{
    near_the_range(world, gap);
    world->variant.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_WINDOWED;
}

static void the_end_of_the_range_agrees(void **state)
{
    (void)state;
    for (double gap = 0.5; gap > 1e-7; gap /= 3) {
        each_model(radius, gap);
        each_model(windowed, gap);
        each_model(radius, -gap);
        each_model(windowed, -gap);
    }
    each_model(radius, 0);
    each_model(windowed, 0);
}

static void grazing(struct world *world, double height)
{
    put3(world->light[0].position, 3, 1, height);
    world->variant.value[SB_AXIS_SPECULAR_SIDE] = SB_SPECULAR_FRONT;
}

static void far_from_the_origin(struct world *world, double offset)
{
    const struct sb_vec3 by = {offset, -offset, 2 * offset};
    world->input.position = sb_vec3_add(by, (struct sb_vec3){0.1, 0.2, 0.3});
    put_vector(world->light[0].position, sb_vec3_add(by, (struct sb_vec3){0, 0, 2}));
    put_vector(world->scene.camera.eye, sb_vec3_add(by, (struct sb_vec3){1, 0, 2}));
}

static void grazing_light_and_far_worlds_agree(void **state)
{
    (void)state;
    for (double height = 1; height > 1e-12; height /= 5) {
        each_model(grazing, height);
        each_model(grazing, -height);
    }
    each_model(grazing, 0);
    for (double offset = 1; offset < 1e8; offset *= 10)
        each_model(far_from_the_origin, offset);
}

static void no_half_vector(struct world *world, double unused)
{
    (void)unused;
    put3(world->light[0].position, -1, 0, -2);
}

static void no_normal(struct world *world, double unused)
{
    (void)unused;
    world->input.normal = (struct sb_vec3){0, 0, 0};
}

static void no_view(struct world *world, double unused)
{
    (void)unused;
    put3(world->scene.camera.eye, 0, 0, 0);
}

// Phong: -L . V of a zero normal is a cosine like any other.
static void vectors_that_vanish_agree(void **state)
{
    (void)state;
    each_model(no_normal, 0);
    each_model(no_view, 0);
    // (1, 0, 2) and (-1, 0, -2) are opposite to the last bit in doubles too.
    each_model(no_half_vector, 0);
}

// --- hard cones -----------------------------------------------------------------------------

struct hard_cone {
    double inner, outer, off, exponent; // radians
};

// How many could be compared.
static int every_cone(const struct hard_cone *cone)
{
    int compared = 0;
    for (int i = 0; i < SB_CONE_VALUE_COUNT * SB_HOIST_VALUE_COUNT; i++) {
        struct world world;
        world_make(&world, "spot=1,specular_side=both");
        world.variant.value[SB_AXIS_CONE] = i % SB_CONE_VALUE_COUNT;
        world.variant.value[SB_AXIS_HOIST] = i / SB_CONE_VALUE_COUNT;
        struct sb_light *light = world_add(&world, SB_LIGHT_SPOT, 0, 0, 2);
        put3(light->direction, sin(cone->off), 0, -cos(cone->off));
        sb_light_set_cone(light, cone->inner, cone->outer);
        light->exponent = (float)cone->exponent;
        compared += compare(&world);
    }
    return compared;
}

static void cones_from_a_fiftieth_of_a_degree_to_a_half_turn_agree(void **state)
{
    (void)state;
    int compared = 0, made = 0;
    for (double outer = 3.49e-4; outer < SB_PI; outer *= 1.7)
        for (double part = 0; part <= 1.1; part += 0.1, made += 8)
            compared +=
                every_cone(&(struct hard_cone){part * outer / 2, outer, part * outer, 2});
    assert_true(compared > 0.95 * made); // at the very edge it is anyone's
    const double right = SB_PI / 2, half_turn = 0.9999 * SB_PI;
    static const double exponents[] = {0, 1e-3, 16, 128};
    for (int i = 0; i < 4; i++) {
        const double e = exponents[i];
        every_cone(&(struct hard_cone){0, right, 1, e});
        every_cone(&(struct hard_cone){0, right, right, e});
        every_cone(&(struct hard_cone){0, half_turn, 3, e});
        every_cone(&(struct hard_cone){0.5, 0.5, 0.5 - 1e-4, e}); // equal angles
        every_cone(&(struct hard_cone){0.5, 0.5, 0, e});
    }
}

static void a_spot_light_on_the_surface_agrees(void **state)
{
    (void)state;
    for (int cone = 0; cone < SB_CONE_VALUE_COUNT; cone++) {
        struct world world;
        world_make(&world, "spot=1");
        world.variant.value[SB_AXIS_CONE] = cone;
        struct sb_light *light = world_add(&world, SB_LIGHT_SPOT, 0, 0, 0);
        put3(light->direction, 0, 0, -1);
        sb_light_set_cone(light, 0.2, 0.5);
        assert_true(compare(&world));
    }
}

// --- hard shapes ----------------------------------------------------------------------------

struct hard_shape {
    float position[3], direction[3], radius, extent[3];
};

static void every_shape(const struct hard_shape *shape)
{
    for (int i = 0; i < 2 * SB_AREA_SHAPE_VALUE_COUNT; i++) {
        struct world world;
        world_make(&world, models[i % 2]);
        world.variant.value[SB_AXIS_AREA_SHAPE] = i / 2;
        struct sb_light *light = world_add(&world, SB_LIGHT_AREA, shape->position[0],
                                           shape->position[1], shape->position[2]);
        memcpy(light->direction, shape->direction, sizeof light->direction);
        memcpy(light->extent, shape->extent, sizeof light->extent);
        light->radius = shape->radius;
        assert_true(compare(&world));
    }
}

// The eye is straight above the point, and so is the mirrored ray.
static void shapes_around_through_and_along_the_ray_agree(void **state)
{
    (void)state;
    static const struct hard_shape shapes[] = {
        {{0, 0, 2}, {0, 0, 1}, 0.5f, {1, 1, 1}},       // through the centre, and along it
        {{0, 0, 0}, {1, 0, 0}, 0.5f, {1, 1, 1}},       // the point is its centre
        {{0.25f, 0, 0.125f}, {0, 0, 1}, 2, {1, 1, 1}}, // the point is inside
        {{3, 0, 4}, {0, 0, 2}, 0.5f, {1, 1, 1}},       // a tube parallel to the ray
        {{3, 0, 4}, {0, 0, 0}, 0.5f, {0, 0, 0}},       // of no length
        {{3, 0, 4}, {0, 0, 0}, 0, {0, 0, 0}},          // of no size
        {{3, 1, 4}, {1e-3f, 0, 1}, 1e-6f, {1e-6f, 1e-6f, 1e-6f}}, // nearly parallel
        {{0, 0, -3}, {0, 0, 1}, 1, {1, 1, 1}},                    // behind
        {{0, 0, 1}, {0, 1, 0}, 1, {1, 1, 1}},                     // the point is on it
        {{1e4f, 0, 1e4f}, {1e3f, 0, 0}, 10, {1, 100, 1}},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        every_shape(&shapes[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_inputs_agree),
        cmocka_unit_test(highlights_agree_up_to_a_shininess_of_a_million),
        cmocka_unit_test(lights_on_the_surface_and_at_any_distance_agree),
        cmocka_unit_test(the_end_of_the_range_agrees),
        cmocka_unit_test(grazing_light_and_far_worlds_agree),
        cmocka_unit_test(vectors_that_vanish_agree),
        cmocka_unit_test(cones_from_a_fiftieth_of_a_degree_to_a_half_turn_agree),
        cmocka_unit_test(a_spot_light_on_the_surface_agrees),
        cmocka_unit_test(shapes_around_through_and_along_the_ray_agree),
    };
    const int failures = run_tests(tests);
    wide_free();
    return failures;
}
