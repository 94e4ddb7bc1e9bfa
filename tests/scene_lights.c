#include "test.h"

#include "axis/variant.h"
#include "scene/lights.h"

struct place {
    const char *name;
    size_t offset;
};

// The variant of "loop=padded model=lambert", the rest at init.
static void variant_of(const char *words, struct sb_variant *variant)
{
    struct sb_error err = {0};
    char text[128];
    snprintf(text, sizeof text, "%s", words);
    sb_variant_init(sb_axes_builtin(), variant);
    for (char *rest = text, *word; (word = strtok_r(rest, " ", &rest)) != NULL;) {
        char *value = strchr(word, '=');
        *value = '\0';
        const int axis = sb_axes_find(sb_axes_builtin(), word);
        if (!sb_variant_set(sb_axes_builtin(), variant, axis, value + 1, &err))
            fail_msg("%s", err.text);
    }
}

static void check_places(const char *words, int number, size_t size,
                         const struct place *place)
{
    struct sb_variant variant;
    struct sb_light_members members;
    int count = 0;
    variant_of(words, &variant);
    sb_light_members_of(&sb_light_structs[number], &variant, &members);
    for (; place[count].name; count++) {
        assert_true(count < members.count);
        assert_string_equal(members.field[count]->name, place[count].name);
        assert_int_equal(sb_light_std140_offset(&members, count), place[count].offset);
    }
    assert_int_equal(members.count, count);
    assert_int_equal(sb_light_std140_size(&members), size);
}

// By hand after OpenGL 4.6 core, 7.6.2.2: a float stands at a multiple of 4 bytes (rule 1), a
// vec3 at one of 16 (rule 3), and an array of structs has a stride that is one of 16 (rules 9
// and 10). Drivers' own answers are asked for where blocks are drawn with. What a variant
// cannot read is not there.
static void members_that_a_variant_reads_stand_where_std140_puts_them(void **state)
{
    (void)state;
    // clang-format off
    static const struct {
        const char *words;
        int number;
        size_t size;
        struct place place[18];
    } rows[] = {
        // Ambient light of the scene, a law without a range, a ramp made once.
        {"", SB_LIGHT_DIR, 48, {{"direction", 0}, {"diffuse", 16}, {"specular", 32}}},
        {"", SB_LIGHT_POINT, 48, {{"position", 0}, {"constant", 12}, {"diffuse", 16},
            {"linear", 28}, {"specular", 32}, {"quadratic", 44}}},
        {"", SB_LIGHT_SPOT, 80, {{"position", 0}, {"constant", 12}, {"diffuse", 16},
            {"linear", 28}, {"specular", 32}, {"quadratic", 44}, {"direction", 48},
            {"cone_scale", 60}, {"cone_offset", 64}}},
        {"", SB_LIGHT_AREA, 64, {{"position", 0}, {"constant", 12}, {"diffuse", 16},
            {"linear", 28}, {"specular", 32}, {"quadratic", 44}, {"radius", 48}}},
        {"layout=unified", SB_LIGHT_UNIFIED, 96, {{"position", 0}, {"w", 12},
            {"constant", 16}, {"diffuse", 32}, {"linear", 44}, {"specular", 48},
            {"quadratic", 60}, {"direction", 64}, {"cos_cutoff", 76}, {"cone_scale", 80},
            {"cone_offset", 84}}},
        // The struct of a text: of 256 such lights a block has 16384 bytes.
        {"ambient=per_light", SB_LIGHT_POINT, 64, {{"position", 0}, {"ambient", 16},
            {"constant", 28}, {"diffuse", 32}, {"linear", 44}, {"specular", 48},
            {"quadratic", 60}}},
        {"model=lambert loop=padded", SB_LIGHT_DIR, 32, {{"direction", 0},
            {"intensity", 12}, {"diffuse", 16}}},
        {"attenuation=radius loop=padded ambient=none", SB_LIGHT_POINT, 48,
            {{"position", 0}, {"range", 12}, {"diffuse", 16}, {"specular", 32},
            {"intensity", 44}}},
        {"attenuation=none", SB_LIGHT_POINT, 48, {{"position", 0}, {"diffuse", 16},
            {"specular", 32}}},
        {"attenuation=none shadows=1", SB_LIGHT_POINT, 48, {{"position", 0},
            {"range", 12}, {"diffuse", 16}, {"specular", 32}}},
        {"attenuation=windowed area_shape=box", SB_LIGHT_AREA, 64, {{"position", 0},
            {"range", 12}, {"diffuse", 16}, {"specular", 32}, {"extent", 48}}},
        {"attenuation=none area_shape=capsule", SB_LIGHT_AREA, 64, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}, {"radius", 60}}},
        {"attenuation=none area_shape=tube", SB_LIGHT_AREA, 64, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}}},
        // Angles where each light makes its own cosines of them.
        {"attenuation=none cone=hard", SB_LIGHT_SPOT, 80, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}, {"cos_cutoff", 60},
            {"cutoff", 64}}},
        {"attenuation=none f_cone=naive", SB_LIGHT_SPOT, 80, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}, {"cos_cutoff", 60},
            {"cos_inner", 64}}},
        {"layout=unified spot=1 f_cone=naive", SB_LIGHT_UNIFIED, 96, {{"position", 0},
            {"w", 12}, {"constant", 16}, {"diffuse", 32}, {"linear", 44}, {"specular", 48},
            {"quadratic", 60}, {"direction", 64}, {"cos_cutoff", 76}, {"cos_inner", 80}}},
        {"attenuation=none cone=exponent", SB_LIGHT_SPOT, 80, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}, {"cos_cutoff", 60},
            {"exponent", 64}}},
        {"attenuation=none cone=linear", SB_LIGHT_SPOT, 80, {{"position", 0},
            {"diffuse", 16}, {"specular", 32}, {"direction", 48}, {"cos_cutoff", 60},
            {"inv_one_minus_cos", 64}}},
        {"attenuation=none cone=hard hoist=per_light", SB_LIGHT_SPOT, 64,
            {{"position", 0}, {"diffuse", 16}, {"specular", 32}, {"direction", 48},
            {"cutoff", 60}}},
        {"attenuation=none cone=exponent hoist=per_light", SB_LIGHT_SPOT, 80,
            {{"position", 0}, {"diffuse", 16}, {"specular", 32}, {"direction", 48},
            {"exponent", 60}, {"cutoff", 64}}},
        {"attenuation=none cone=smooth hoist=per_light", SB_LIGHT_SPOT, 80,
            {{"position", 0}, {"diffuse", 16}, {"specular", 32}, {"direction", 48},
            {"cutoff", 60}, {"inner", 64}}},
        {"layout=unified cone=smooth hoist=per_light loop=padded ambient=per_light shadows=1",
            SB_LIGHT_UNIFIED, 96, {{"position", 0}, {"w", 12}, {"ambient", 16},
            {"constant", 28}, {"diffuse", 32}, {"linear", 44}, {"specular", 48},
            {"quadratic", 60}, {"direction", 64}, {"cos_cutoff", 76}, {"intensity", 80},
            {"cutoff", 84}, {"inner", 88}, {"range", 92}}},
    };
    // clang-format on
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        check_places(rows[i].words, rows[i].number, rows[i].size, rows[i].place);
}

// What is printed or set by a row's offset must be the member of that name.
static void fields_point_at_the_member_that_they_name(void **state)
{
    (void)state;
    struct sb_light light;
    const struct {
        const char *name;
        const float *member;
        int components;
    } member[] = {
        {"position", light.position, 3},
        {"w", &light.w, 1},
        {"direction", light.direction, 3},
        {"range", &light.range, 1},
        {"intensity", &light.intensity, 1},
        {"ambient", light.ambient, 3},
        {"diffuse", light.diffuse, 3},
        {"specular", light.specular, 3},
        {"constant", &light.constant, 1},
        {"linear", &light.linear, 1},
        {"quadratic", &light.quadratic, 1},
        {"cutoff", &light.cutoff, 1},
        {"inner", &light.inner, 1},
        {"cos_cutoff", &light.cos_cutoff, 1},
        {"cos_inner", &light.cos_inner, 1},
        {"exponent", &light.exponent, 1},
        {"radius", &light.radius, 1},
        {"cone_scale", &light.cone_scale, 1},
        {"cone_offset", &light.cone_offset, 1},
        {"inv_one_minus_cos", &light.inv_one_minus_cos, 1},
        {"extent", light.extent, 3},
    };
    for (int type = 0; type < SB_LIGHT_STRUCT_COUNT; type++) {
        const struct sb_light_struct *row = &sb_light_structs[type];
        for (int i = 0; i < row->field_count; i++) {
            size_t k = 0;
            while (k < sizeof member / sizeof *member &&
                   strcmp(member[k].name, row->field[i].name) != 0)
                k++;
            assert_true(k < sizeof member / sizeof *member);
            assert_ptr_equal((char *)&light + row->field[i].offset, member[k].member);
            assert_int_equal(row->field[i].components, member[k].components);
        }
    }
}

static void types_name_their_own_axis_array_count_and_macro(void **state)
{
    (void)state;
    static const struct {
        int axis;
        const char *array, *count, *element;
    } expected[SB_LIGHT_STRUCT_COUNT] = {
        [SB_LIGHT_DIR] = {SB_AXIS_DIR, "u_dir", "u_dir_count", "DIR_LIGHT"},
        [SB_LIGHT_POINT] = {SB_AXIS_POINT, "u_point", "u_point_count", "POINT_LIGHT"},
        [SB_LIGHT_SPOT] = {SB_AXIS_SPOT, "u_spot", "u_spot_count", "SPOT_LIGHT"},
        [SB_LIGHT_AREA] = {SB_AXIS_AREA, "u_area", "u_area_count", "AREA_LIGHT"},
        [SB_LIGHT_UNIFIED] = {-1, "u_light", "u_light_count", "LIGHT"},
    };
    for (int i = 0; i < SB_LIGHT_STRUCT_COUNT; i++) {
        assert_int_equal(sb_light_structs[i].axis, expected[i].axis);
        assert_string_equal(sb_light_structs[i].array, expected[i].array);
        assert_string_equal(sb_light_structs[i].count, expected[i].count);
        assert_string_equal(sb_light_structs[i].element, expected[i].element);
    }
}

static void a_type_picks_its_own_part_of_the_list(void **state)
{
    (void)state;
    static const struct sb_light light[10];
    const struct sb_lights lights = {light, {1, 2, 3, 4}};
    int count;
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_DIR, &count), light);
    assert_int_equal(count, 1);
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_POINT, &count), light + 1);
    assert_int_equal(count, 2);
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_SPOT, &count), light + 3);
    assert_int_equal(count, 3);
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_AREA, &count), light + 6);
    assert_int_equal(count, 4);
    assert_int_equal(sb_lights_total(&lights), 10);
}

static void only_a_sun_below_the_horizon_does_not_shine(void **state)
{
    (void)state;
    struct sb_variant v = {0};
    v.value[SB_AXIS_DIR] = 3;
    v.value[SB_AXIS_POINT] = 4;
    v.value[SB_AXIS_SPOT] = 5;
    v.value[SB_AXIS_AREA] = 6;
    static const struct {
        double sun;
        int dirs;
    } at[] = {{-91, 3}, {-90, 3}, {0, 3}, {90, 3}, {90.1, 2}, {180, 2}, {360, 2}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        v.value[SB_AXIS_SUN] = at[i].sun;
        assert_int_equal(sb_lights_shining(&v, SB_LIGHT_DIR), at[i].dirs);
        assert_int_equal(sb_lights_shining(&v, SB_LIGHT_POINT), 4);
        assert_int_equal(sb_lights_shining(&v, SB_LIGHT_SPOT), 5);
        assert_int_equal(sb_lights_shining(&v, SB_LIGHT_AREA), 6);
    }
    v.value[SB_AXIS_DIR] = 0;
    assert_int_equal(sb_lights_shining(&v, SB_LIGHT_DIR), 0);
}

// The GLSL wikibook tells types apart by position.w and by a cut-off of at most 90 degrees.
static void unified_lights_tell_their_type(void **state)
{
    (void)state;
    struct sb_light light = {.position = {5, 6, 7},
                             .direction = {0, -3, 4},
                             .diffuse = {1, 2, 3},
                             .linear = 1};
    sb_light_set_cone(&light, 0.3, 0.5);

    const struct sb_light dir = sb_light_unified(&light, SB_LIGHT_DIR);
    check_close(dir.w, 0, 0);
    check_close(dir.position[0], 0, 0); // to the light, of unit length
    check_close(dir.position[1], 0.6, 1e-7);
    check_close(dir.position[2], -0.8, 1e-7);
    assert_true(dir.cutoff > acos(-1.0) / 2);

    const struct sb_light point = sb_light_unified(&light, SB_LIGHT_POINT);
    check_close(point.w, 1, 0);
    assert_memory_equal(point.position, light.position, sizeof point.position);
    assert_memory_equal(point.diffuse, light.diffuse, sizeof point.diffuse);
    check_close(point.linear, 1, 0);
    check_close(point.cutoff, acos(-1.0), 1e-6);
    for (double cosine = -0.9; cosine <= 1; cosine += 0.1) { // by every law
        assert_true(cosine > point.cos_cutoff);
        check_close(pow(fmax(cosine, 0.1), point.exponent), 1, 0);
        check_close(1 - (1 - cosine) * point.inv_one_minus_cos, 1, 0);
        check_close(cosine * point.cone_scale + point.cone_offset, 1, 0);
    }

    const struct sb_light spot = sb_light_unified(&light, SB_LIGHT_SPOT);
    check_close(spot.w, 1, 0);
    light.w = 1; // and nothing else
    assert_memory_equal(&spot, &light, sizeof spot);
}

static void narrow_cones_keep_full_precision(void **state)
{
    (void)state;
    const double degree = acos(-1.0) / 180;
    static const double outer[] = {0.05, 1, 15, 60, 90, 150};
    for (size_t i = 0; i < sizeof outer / sizeof *outer; i++) {
        struct sb_light light = {0};
        sb_light_set_cone(&light, outer[i] / 2 * degree, outer[i] * degree);
        const long double cosine = cosl((long double)outer[i] * degree);
        check_close(light.cos_cutoff, (double)cosine, 6e-8);
        check_close(light.cutoff / (outer[i] * degree), 1, 6e-8);
        check_close(light.inner / (outer[i] / 2 * degree), 1, 6e-8);
        const double expected = (double)(1 / (1 - cosine));
        check_close(light.inv_one_minus_cos / expected, 1, 6e-8);
    }
}

// The float next to a quarter turn is 4.4e-8 more than one, that next to half a turn 8.7e-8.
static void quarter_and_half_turns_are_exact(void **state)
{
    (void)state;
    const double turns[] = {acos(-1.0) / 2, (float)(acos(-1.0) / 2)};
    for (int i = 0; i < 2; i++) {
        struct sb_light light = {0};
        sb_light_set_cone(&light, turns[i], turns[i]);
        check_close(light.cos_cutoff, 0, 0);
        check_close(light.cos_inner, 0, 0);
        check_close(light.cone_offset, 0, 0);
        sb_light_set_cone(&light, 0.5, turns[i]);
        check_close(light.cos_inner, cos(0.5), 6e-8);
    }
    const double halves[] = {acos(-1.0), (float)acos(-1.0), 4};
    for (int i = 0; i < 3; i++) {
        struct sb_light light = {.exponent = 8};
        sb_light_set_cone(&light, halves[i] / 2, halves[i]);
        assert_true(light.cos_cutoff <
                    -1.1); // less than a product of rounded unit vectors
        for (double cosine = -1 - 1e-6; cosine <= 1; cosine += 0.1) { // by every law
            check_close(pow(fmax(cosine, 0.1), light.exponent), 1, 0);
            check_close(1 - (1 - cosine) * light.inv_one_minus_cos, 1, 0);
            check_close(cosine * light.cone_scale + light.cone_offset, 1, 0);
        }
    }
    struct sb_light light = {.exponent = 8}; // just less than half a turn is a cone
    sb_light_set_cone(&light, 1, nextafterf((float)acos(-1.0), 0));
    check_close(light.cos_cutoff, -1, 6e-8);
    check_close(light.exponent, 8, 0);
}

static void the_smooth_cone_is_one_inside_and_zero_outside(void **state)
{
    (void)state;
    const double inner = 0.3, outer = 0.5;
    struct sb_light light = {0};
    sb_light_set_cone(&light, inner, outer);
    check_close(cos(inner) * light.cone_scale + light.cone_offset, 1, 2e-6);
    check_close(cos(outer) * light.cone_scale + light.cone_offset, 0, 2e-6);
}

static void equal_angles_give_a_steep_ramp_that_ends_at_the_outer_one(void **state)
{
    (void)state;
    struct sb_light light = {0};
    sb_light_set_cone(&light, 0.5, 0.5);
    check_close(light.cone_scale, 1024, 0);
    check_close(cos(0.5) * light.cone_scale + light.cone_offset, 0, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_that_a_variant_reads_stand_where_std140_puts_them),
        cmocka_unit_test(fields_point_at_the_member_that_they_name),
        cmocka_unit_test(types_name_their_own_axis_array_count_and_macro),
        cmocka_unit_test(a_type_picks_its_own_part_of_the_list),
        cmocka_unit_test(only_a_sun_below_the_horizon_does_not_shine),
        cmocka_unit_test(unified_lights_tell_their_type),
        cmocka_unit_test(narrow_cones_keep_full_precision),
        cmocka_unit_test(quarter_and_half_turns_are_exact),
        cmocka_unit_test(the_smooth_cone_is_one_inside_and_zero_outside),
        cmocka_unit_test(equal_angles_give_a_steep_ramp_that_ends_at_the_outer_one),
    };
    return run_tests(tests);
}
