// The shading of the reference against closed forms: lights straight above, known cosines, the
// laws' numbers, edges of cones, shapes of lights.
#include "lit_world.h"

static struct sb_ref_terms terms_of(const struct world *world)
{
    struct sb_ref_terms terms[WORLD_LIGHTS];
    shade(world, terms);
    return terms[0];
}

// The direction from the origin at an angle from the normal, in the plane of x and z.
static struct sb_vec3 leaning(double angle)
{
    return (struct sb_vec3){sin(angle), 0, cos(angle)};
}

static void look_along(struct world *world, double angle)
{
    const struct sb_vec3 eye = leaning(angle);
    put3(world->scene.camera.eye, 8 * eye.x, 8 * eye.y, 8 * eye.z);
}

static void set_normal(struct world *world, double angle)
{
    world->input.normal = leaning(angle);
}

// --- light and surface ----------------------------------------------------------------------

static void light_from_straight_above_arrives_whole(void **state)
{
    (void)state;
    static const char *const models[] = {"lambert", "phong", "blinn"};
    for (int m = 0; m < 3; m++) {
        for (int type = 0; type < SB_LIGHT_AREA; type++) {
            struct world world;
            char words[80];
            snprintf(words, sizeof words, "attenuation=none,cone=hard,model=%s",
                     models[m]);
            world_make(&world, words);
            struct sb_light *light =
                world_add(&world, type, 0, 0, type == SB_LIGHT_DIR ? -3 : 3);
            if (type == SB_LIGHT_SPOT) {
                put3(light->direction, 0, 0, -1);
                sb_light_set_cone(light, 0.1, 0.2);
            }
            const struct sb_ref_terms it = terms_of(&world);
            assert_true(it.distance[0] == (type == SB_LIGHT_DIR ? 0 : 3));
            assert_true(it.direction[0] == 0 && it.direction[1] == 0 &&
                        it.direction[2] == 1);
            assert_true(it.n_dot_l[0] == 1 && it.attenuation[0] == 1 && it.cone[0] == 1 &&
                        it.shown[0] == 1 && it.diffuse_weight[0] == 1);
            assert_true(it.specular[0] == (m > 0) && it.specular_weight[0] == (m > 0));
            const struct sb_ref_shade made = shade(&world, NULL);
            assert_true(made.diffuse.x == 1 && made.specular.z == (m > 0));
            assert_true(made.view.z == 1 && made.normal.z == 1);
            const struct sb_vec3 colour =
                sb_ref_colour(&world.shading, &made, &world.input);
            assert_true(colour.y == 1 + (m > 0));
        }
    }
}

static void a_surface_takes_the_cosine_of_the_angle_to_the_light(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "point=1,attenuation=none");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    for (int i = -180; i <= 180; i += 7) {
        const double a = i * SB_PI / 180;
        set_normal(&world, a);
        const struct sb_ref_terms it = terms_of(&world);
        check_close(it.n_dot_l[0], cos(a), 4e-16);
        check_close(it.diffuse_weight[0], fmax(cos(a), 0), 4e-16);
    }
}

static void phong_is_a_power_of_the_angle_to_the_mirror_direction(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "dir=1,model=phong");
    struct sb_light *sun = world_add(&world, SB_LIGHT_DIR, -3, 0, -4);
    const double a = atan2(sun->direction[0], sun->direction[2]) + SB_PI; // of its place
    for (int i = -8; i <= 8; i++) {
        const double off = i * 0.2;
        look_along(&world, off - a);
        check_close(terms_of(&world).specular[0], pow(fmax(cos(off), 0), 8), 1e-6);
    }
    set_normal(&world, 0);
    put3(world.scene.camera.eye, -3, 0, 4); // the very mirror
    check_close(terms_of(&world).specular[0], 1, 1e-15);
}

static void blinn_is_a_power_of_the_angle_to_half_way(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "dir=1,model=blinn,specular_side=both");
    world_add(&world, SB_LIGHT_DIR, -3, 0, -4);
    put3(world.scene.camera.eye, -3, 0, 4); // as far on the other side
    for (int i = -10; i <= 10; i++) {
        set_normal(&world, i * 0.3);
        check_close(terms_of(&world).specular[0], pow(fmax(cos(i * 0.3), 0), 8), 1e-15);
    }
}

static void highlights_at_a_million_are_as_wide_as_they_should_be(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "dir=1,model=blinn");
    world_add(&world, SB_LIGHT_DIR, 0, 0, -1);
    for (double n = 1; n < 2e6; n *= 10) {
        world.material.shininess = (float)n;
        const double a = 1 / sqrt(n) / 4;
        set_normal(&world, a);
        const long double c = cosl((long double)a);
        check_close(terms_of(&world).specular[0], (double)powl(c, (long double)n), 1e-12);
    }
}

static void a_surface_that_faces_away_has_highlights_only_where_both_sides_do(
    void **state)
{
    (void)state;
    for (int both = 0; both < 2; both++) {
        struct world world;
        world_make(&world, both ? "point=1,model=blinn,specular_side=both"
                                : "point=1,model=blinn");
        world_add(&world, SB_LIGHT_POINT, 2, 0, -0.5f);
        put3(world.scene.camera.eye, 0, 0, 4);
        const struct sb_ref_terms it = terms_of(&world);
        assert_true(it.n_dot_l[0] < 0 && it.diffuse_weight[0] == 0);
        const double half = (acos(-0.5 / sqrt(4.25))) / 2;
        check_close(it.specular[0], both ? pow(cos(half), 8) : 0, 1e-15);
        assert_int_equal(shade(&world, NULL).decisions, both ? 0 : sb_ref_decide(0, 0));
    }
}

// --- laws -----------------------------------------------------------------------------------

static double law(const char *name, float z)
{
    struct world world;
    char words[60];
    snprintf(words, sizeof words, "point=1,attenuation=%s", name);
    world_make(&world, words);
    struct sb_light *light = world_add(&world, SB_LIGHT_POINT, 0, 0, z);
    light->range = 8;
    light->constant = 1;
    light->linear = 0.5f;
    light->quadratic = 0.25f;
    return terms_of(&world).attenuation[0];
}

static void each_law_of_attenuation_has_its_numbers(void **state)
{
    (void)state;
    check_close(law("none", 2), 1, 0);
    check_close(law("polynomial", 2), 1.0 / 3, 0);
    check_close(law("radius", 2), 0.75, 0);
    check_close(law("radius", 9), 0, 0);
    check_close(law("windowed", 2), pow(1 - 1.0 / 256, 2) / 5, 1e-16);
    check_close(law("windowed", 8), 0, 0);
    check_close(law("windowed", 0), 1, 0);
    struct world world;
    world_make(&world, "point=1,attenuation=polynomial");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 0.25f)->constant = 0; // all are 0
    check_close(terms_of(&world).attenuation[0], 1e4, 1e-11);
}

// --- cones ----------------------------------------------------------------------------------

enum { DEGREES = 30 };

// A spot light on z whose axis leans by an angle, and so is seen from there at this angle.
static struct sb_ref_terms spot(const char *words, double angle, double inner,
                                double outer, double exponent)
{
    struct world world;
    world_make(&world, words);
    struct sb_light *light = world_add(&world, SB_LIGHT_SPOT, 0, 0, 2);
    put3(light->direction, sin(angle), 0, -cos(angle));
    sb_light_set_cone(light, inner, outer);
    light->exponent = (float)exponent;
    const struct sb_ref_terms it = terms_of(&world);
    check_close(it.diffuse_weight[0], it.cone[0], 0);
    return it;
}

static void a_hard_cone_ends_at_its_cut_off_angle(void **state)
{
    (void)state;
    static const char *const words[] = {"spot=1,cone=hard",
                                        "spot=1,cone=hard,hoist=per_light"};
    for (int h = 0; h < 2; h++)
        for (double outer = 0.1; outer < 3.1; outer += 0.2) {
            check_close(spot(words[h], outer - 1e-5, 0, outer, 1).cone[0], 1, 0);
            check_close(spot(words[h], outer + 1e-5, 0, outer, 1).cone[0], 0, 0);
        }
}

static void an_exponent_is_a_power_of_the_cosine_inside_the_cone(void **state)
{
    (void)state;
    static const char *const words[] = {"spot=1,cone=exponent",
                                        "spot=1,cone=exponent,hoist=per_light"};
    for (int h = 0; h < 2; h++) {
        check_close(spot(words[h], 0.5, 0, 0.7, 10).cone[0], pow(cos(0.5), 10), 2e-7);
        check_close(spot(words[h], 0.8, 0, 0.7, 10).cone[0], 0, 0);
        check_close(spot(words[h], 2, 0, 2.5, 0).cone[0], 1, 0);
        check_close(spot(words[h], 2, 0, 2.5, 2).cone[0], 1e-8, 1e-15); // clamped
    }
}

static void a_linear_cone_falls_in_a_line_of_the_cosine(void **state)
{
    (void)state;
    static const char *const words[] = {"spot=1,cone=linear",
                                        "spot=1,cone=linear,hoist=per_light"};
    for (int h = 0; h < 2; h++) {
        // 1 - cos a = 2 sin^2(a / 2)
        for (double outer = 3.5e-4; outer < 3; outer *= 3) // from 0.02 degrees on
            for (double part = 0; part < 1.2; part += 0.1) {
                const double share = sin(part * outer / 2) / sin(outer / 2);
                check_close(spot(words[h], part * outer, 0, outer, 1).cone[0],
                            fmax(1 - share * share, 0), 4e-7);
            }
        check_close(spot(words[h], SB_PI, 0, 3, 1).cone[0], 0, 0); // behind
    }
}

static void a_smooth_cone_is_a_ramp_from_the_outer_to_the_inner_cosine(void **state)
{
    (void)state;
    static const char *const words[] = {"spot=1,cone=smooth",
                                        "spot=1,cone=smooth,hoist=per_light"};
    for (int h = 0; h < 2; h++) {
        const double inner = 0.3, outer = 0.6, middle = (cos(0.3) + cos(0.6)) / 2;
        check_close(spot(words[h], 0.29, inner, outer, 1).cone[0], 1, 0);
        check_close(spot(words[h], acos(middle), inner, outer, 1).cone[0], 0.5, 1e-6);
        check_close(spot(words[h], 0.61, inner, outer, 1).cone[0], 0, 0);
        // Equal angles: the divisor stays at 1/1024.
        const double off = acos(cos(0.5) + 0.25 / 1024);
        check_close(spot(words[h], off, 0.5, 0.5, 1).cone[0], 0.25, 1e-4);
    }
}

static void a_naive_smooth_cone_is_a_smoothstep(void **state)
{
    (void)state;
    static const char *const words[] = {
        "spot=1,cone=smooth,f_cone=naive",
        "spot=1,cone=smooth,f_cone=naive,hoist=per_light"};
    for (int h = 0; h < 2; h++) {
        const double quarter = acos(cos(0.6) + (cos(0.3) - cos(0.6)) / 4);
        check_close(spot(words[h], 0.29, 0.3, 0.6, 1).cone[0], 1, 0);
        check_close(spot(words[h], quarter, 0.3, 0.6, 1).cone[0], 10.0 / 64, 1e-6);
        check_close(spot(words[h], 0.61, 0.3, 0.6, 1).cone[0], 0, 0);
        // Equal angles: a step.
        check_close(spot(words[h], 0.499, 0.5, 0.5, 1).cone[0], 1, 0);
        check_close(spot(words[h], 0.501, 0.5, 0.5, 1).cone[0], 0, 0);
    }
}

// --- area lights ----------------------------------------------------------------------------

static const char *const shapes[] = {"sphere", "tube", "box", "capsule"};

static void make_area(struct world *world, int shape, const char *more)
{
    char words[120];
    snprintf(words, sizeof words, "area=1,attenuation=none,area_shape=%s%s",
             shapes[shape], more);
    world_make(world, words);
}

static void a_light_of_no_size_is_a_point_light(void **state)
{
    (void)state;
    for (int shape = 0; shape < 4; shape++)
        for (int phong = 0; phong < 2; phong++) {
            struct world world;
            make_area(&world, shape, phong ? ",model=phong" : ",model=blinn");
            world.variant.value[SB_AXIS_ATTENUATION] = SB_ATTENUATION_POLYNOMIAL;
            put3(world.scene.camera.eye, -1, 0.5, 3);
            for (int i = 0; i < 2; i++) {
                struct sb_light *light = world_add(
                    &world, i ? SB_LIGHT_AREA : SB_LIGHT_POINT, 0.75f, -0.5f, 2);
                light->quadratic = 0.125f;
            }
            struct sb_ref_terms terms[2];
            shade(&world, terms);
            const double *point = (const double *)&terms[0];
            const double *none = (const double *)&terms[1];
            for (size_t i = 0; i < sizeof *terms / sizeof *point; i++)
                check_close(none[i], point[i], 2e-15);
        }
}

static void light_comes_from_the_nearest_point_of_a_shape(void **state)
{
    (void)state;
    // Each shape reaches down to z = 2 over x = 0.5, whatever its centre is over.
    for (int shape = 0; shape < 4; shape++) {
        struct world world;
        make_area(&world, shape, ",model=lambert");
        struct sb_light *light = world_add(&world, SB_LIGHT_AREA, 0.5f, 0, 3);
        world.input.position = (struct sb_vec3){0.5, 0, 0};
        light->radius = shape == SB_AREA_SPHERE ? 1 : 0.25f;
        put3(light->extent, 1, 2, 1);
        put3(light->direction, 1.5, 0, 0);
        if (shape == SB_AREA_TUBE)
            light->position[2] = 2;
        if (shape == SB_AREA_CAPSULE)
            light->position[2] = 2.25f;
        const struct sb_ref_terms above = terms_of(&world);
        check_close(above.distance[0], 2, 1e-15);
        check_close(above.direction[2], 1, 1e-15);
        if (shape == SB_AREA_SPHERE)
            continue;
        // From beyond its end it is the end that is nearest.
        world.input.position.x = shape == SB_AREA_BOX ? 1.5 + 1.5 : 2 + 1.5;
        const struct sb_ref_terms aside = terms_of(&world);
        const double far =
            shape == SB_AREA_CAPSULE ? sqrt(1.5 * 1.5 + 2.25 * 2.25) - 0.25 : 2.5;
        check_close(aside.distance[0], far, 1e-15);
    }
}

static void from_inside_a_light_there_is_no_way_to_it(void **state)
{
    (void)state;
    for (int shape = 0; shape < 4; shape++) {
        struct world world;
        make_area(&world, shape, ",model=lambert,ambient=per_light");
        struct sb_light *light = world_add(&world, SB_LIGHT_AREA, 0.5f, 0, 0);
        light->radius = 1;
        put3(light->extent, 1, 1, 1);
        put3(light->direction, 1, 0, 0); // the tube runs through the point
        put3(light->ambient, 1, 1, 1);
        put3(world.material.ambient, 2, 2, 2);
        const struct sb_ref_terms it = terms_of(&world);
        assert_true(it.distance[0] == 0 && it.n_dot_l[0] == 0 && it.attenuation[0] == 1);
        assert_true(shade(&world, NULL).diffuse.x == 2);
    }
}

static void a_mirrored_ray_that_meets_a_shape_has_the_whole_highlight(void **state)
{
    (void)state;
    for (int shape = 0; shape < 4; shape++)
        for (int phong = 0; phong < 2; phong++) {
            struct world world;
            make_area(&world, shape, phong ? ",model=phong" : ",model=blinn");
            put3(world.scene.camera.eye, -1, 0, 4); // mirrored: (1, 0, 4)
            struct sb_light *light = world_add(&world, SB_LIGHT_AREA, 0.25f, 0, 4);
            light->radius = 0.9f;
            put3(light->extent, 0.9, 0.5, 0.5);
            put3(light->direction, 1.5, 0, 0);
            check_close(terms_of(&world).specular[0], 1, 1e-14);
        }
}

static void a_tube_along_the_ray_shines_from_its_middle(void **state)
{
    (void)state;
    struct world world;
    make_area(&world, SB_AREA_TUBE, ",model=phong");
    put3(world.scene.camera.eye, 0, 0, 4);
    struct sb_light *light = world_add(&world, SB_LIGHT_AREA, 3, 0, 4);
    put3(light->direction, 0, 0, 2); // the mirrored ray's direction
    check_close(terms_of(&world).specular[0], pow(0.8, 8), 1e-15);
    put3(light->direction, 0, 0, 0); // and of no length it is its middle
    check_close(terms_of(&world).specular[0], pow(0.8, 8), 1e-15);
}

// --- ambient light --------------------------------------------------------------------------

static void ambient_light_is_none_the_scenes_or_each_lights(void **state)
{
    (void)state;
    static const char *const kinds[] = {"none", "scene", "per_light"};
    for (int kind = 0; kind < 3; kind++) {
        struct world world;
        char words[80];
        snprintf(words, sizeof words,
                 "spot=1,attenuation=polynomial,cone=hard,ambient=%s", kinds[kind]);
        world_make(&world, words);
        put3(world.scene.ambient, 0.5, 0.25, 0);
        put3(world.material.ambient, 2, 4, 8);
        struct sb_light *light = world_add(&world, SB_LIGHT_SPOT, 0, 0, -2);
        put3(light->direction, 0, 0, 1); // from behind
        put3(light->ambient, 1, 0.5, 0.25);
        light->quadratic = 0.25f;
        sb_light_set_cone(light, 0.1, 0.2);
        const struct sb_ref_shade made = shade(&world, NULL);
        const struct sb_vec3 want[] = {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}};
        assert_memory_equal(&made.diffuse, &want[kind], sizeof want[0]);
    }
}

static void lights_that_are_off_are_passed_over_by_a_padded_loop_only(void **state)
{
    (void)state;
    // Casters have a loop of their own.
    static const char *const words[] = {"point=1", "point=1,loop=padded,shadows=1",
                                        "point=1,loop=padded"};
    for (int i = 0; i < 3; i++) {
        struct world world;
        world_make(&world, words[i]);
        world_add(&world, SB_LIGHT_POINT, 0, 0, 2)->intensity = 0;
        assert_true(terms_of(&world).diffuse_weight[0] == (i < 2));
        assert_true(shade(&world, NULL).diffuse.x == (i < 2));
    }
}

// --- zero vectors, and normals of any length ------------------------------------------------

static void zero_vectors_light_nothing(void **state)
{
    (void)state;
    static const char *const words[] = {"point=1,model=phong", "point=1,model=blinn",
                                        "point=1,model=phong,normalise=off",
                                        "point=1,model=blinn,normalise=off"};
    for (int i = 0; i < 4; i++) {
        struct world world;
        world_make(&world, words[i]);
        struct sb_light *light = world_add(&world, SB_LIGHT_POINT, 0, 0, 0);
        struct sb_ref_terms it = terms_of(&world); // on the surface
        assert_true(it.n_dot_l[0] == 0 && it.specular[0] == 0 && it.attenuation[0] == 1);
        light->position[2] = 2;
        world.input.normal = (struct sb_vec3){0, 0, 0};
        it = terms_of(&world);
        assert_true(it.n_dot_l[0] == 0 && it.specular[0] == 0);
        world_make(&world, words[i]);
        put3(world.scene.camera.eye, 0, 0, 0); // on the eye there is no view vector
        world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
        it = terms_of(&world);
        assert_true(it.n_dot_l[0] == 1 && it.specular[0] == i % 2);
    }
}

static void opposite_light_and_view_have_no_half_vector(void **state)
{
    (void)state;
    struct world world;
    world_make(&world, "point=1,model=blinn,specular_side=both");
    world_add(&world, SB_LIGHT_POINT, 0, 0, -4);
    assert_true(terms_of(&world).specular[0] == 0);
}

static void a_short_normal_weakens_light_unless_it_is_restored(void **state)
{
    (void)state;
    static const char *const models[] = {"phong", "blinn"};
    for (int blinn = 0; blinn < 2; blinn++) {
        struct world world;
        char words[80];
        snprintf(words, sizeof words, "dir=1,normalise=off,model=%s", models[blinn]);
        world_make(&world, words);
        world_add(&world, SB_LIGHT_DIR, 0, 0, -1);
        world.input.normal.z = 0.96;
        const struct sb_ref_terms it = terms_of(&world);
        check_close(it.n_dot_l[0], 0.96, 0);
        // Blinn: N . H = 0.96. Phong: 2 (N . L) N - L = (2 0.96^2 - 1) z.
        const double c = blinn ? 0.96 : 2 * 0.96 * 0.96 - 1;
        check_close(it.specular[0], pow(c, 8), 1e-15);
        world.shading.ideal = true;
        assert_true(terms_of(&world).n_dot_l[0] == 1);
        assert_true(terms_of(&world).specular[0] == 1);
    }
}

// --- maps -----------------------------------------------------------------------------------

static void maps_multiply_what_leaves_the_surface(void **state)
{
    (void)state;
    static const unsigned char half[4] = {51, 102, 204, 255}, some[4] = {255, 0, 51, 255};
    struct world world;
    world_make(&world, "point=1,maps=diffuse+specular,attenuation=none");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    world.scene.map[SB_MAP_DIFFUSE] = (struct sb_texture){1, 1, half};
    world.scene.map[SB_MAP_SPECULAR] = (struct sb_texture){1, 1, some};
    const struct sb_ref_shade made = shade(&world, NULL);
    const struct sb_vec3 colour = sb_ref_colour(&world.shading, &made, &world.input);
    check_close(colour.x, 0.2 + 1, 1e-15);
    check_close(colour.y, 0.4 + 0, 1e-15);
    check_close(colour.z, 0.8 + 0.2, 1e-15);
}

static void texels_that_are_given_are_not_looked_up(void **state)
{
    (void)state;
    static const unsigned char other[4] = {7, 8, 9, 255};
    struct world world;
    world_make(&world, "point=1,maps=diffuse+specular+normal,attenuation=none");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    for (int m = 0; m < SB_MAP_COUNT; m++)
        world.scene.map[m] = (struct sb_texture){1, 1, other};
    world.input.sampled = true;
    world.input.texel[SB_MAP_DIFFUSE] = (struct sb_vec3){0.25, 0.5, 0.75};
    world.input.texel[SB_MAP_SPECULAR] = (struct sb_vec3){1, 0, 0.125};
    world.input.texel[SB_MAP_NORMAL] =
        (struct sb_vec3){128 / 255.0, 128 / 255.0, 1}; // straight up
    const struct sb_ref_shade made = shade(&world, NULL);
    assert_true(made.normal.x == 0 && made.normal.y == 0 && made.normal.z == 1);
    const struct sb_vec3 colour = sb_ref_colour(&world.shading, &made, &world.input);
    check_close(colour.x, 0.25 + 1, 1e-15);
    check_close(colour.y, 0.5 + 0, 1e-15);
    check_close(colour.z, 0.75 + 0.125, 1e-15);
}

static void a_normal_map_turns_the_normal_in_its_frame(void **state)
{
    (void)state;
    static const unsigned char along_tangent[4] = {255, 1, 1, 255};
    struct world world;
    world_make(&world, "point=1,maps=normal,normalise=off");
    world_add(&world, SB_LIGHT_POINT, 0, 0, 2);
    world.scene.map[SB_MAP_NORMAL] = (struct sb_texture){1, 1, along_tangent};
    world.input.normal = (struct sb_vec3){0, 0, 0.5};
    world.input.tangent = (struct sb_vec3){0, 3, 0};
    world.input.bitangent = (struct sb_vec3){-7, 0, 0};
    // (1, -1, -1) in the frame y, -x, z / 2: normalise=off leaves the last as it came.
    const struct sb_ref_shade made = shade(&world, NULL);
    const double length = sqrt(1 + 1 + 0.25);
    check_close(made.normal.x, 1 / length, 1e-15);
    check_close(made.normal.y, 1 / length, 1e-15);
    check_close(made.normal.z, -0.5 / length, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_from_straight_above_arrives_whole),
        cmocka_unit_test(a_surface_takes_the_cosine_of_the_angle_to_the_light),
        cmocka_unit_test(phong_is_a_power_of_the_angle_to_the_mirror_direction),
        cmocka_unit_test(blinn_is_a_power_of_the_angle_to_half_way),
        cmocka_unit_test(highlights_at_a_million_are_as_wide_as_they_should_be),
        cmocka_unit_test(
            a_surface_that_faces_away_has_highlights_only_where_both_sides_do),
        cmocka_unit_test(each_law_of_attenuation_has_its_numbers),
        cmocka_unit_test(a_hard_cone_ends_at_its_cut_off_angle),
        cmocka_unit_test(an_exponent_is_a_power_of_the_cosine_inside_the_cone),
        cmocka_unit_test(a_linear_cone_falls_in_a_line_of_the_cosine),
        cmocka_unit_test(a_smooth_cone_is_a_ramp_from_the_outer_to_the_inner_cosine),
        cmocka_unit_test(a_naive_smooth_cone_is_a_smoothstep),
        cmocka_unit_test(a_light_of_no_size_is_a_point_light),
        cmocka_unit_test(light_comes_from_the_nearest_point_of_a_shape),
        cmocka_unit_test(from_inside_a_light_there_is_no_way_to_it),
        cmocka_unit_test(a_mirrored_ray_that_meets_a_shape_has_the_whole_highlight),
        cmocka_unit_test(a_tube_along_the_ray_shines_from_its_middle),
        cmocka_unit_test(ambient_light_is_none_the_scenes_or_each_lights),
        cmocka_unit_test(lights_that_are_off_are_passed_over_by_a_padded_loop_only),
        cmocka_unit_test(zero_vectors_light_nothing),
        cmocka_unit_test(opposite_light_and_view_have_no_half_vector),
        cmocka_unit_test(a_short_normal_weakens_light_unless_it_is_restored),
        cmocka_unit_test(maps_multiply_what_leaves_the_surface),
        cmocka_unit_test(texels_that_are_given_are_not_looked_up),
        cmocka_unit_test(a_normal_map_turns_the_normal_in_its_frame),
    };
    return run_tests(tests);
}
