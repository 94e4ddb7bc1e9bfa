#include "scene.h"

// A scene whose floats a test may write to.
struct writable {
    struct sb_scene scene;
    struct sb_light *dir, *point, *spot, *area;
    struct sb_draw *draw;
    struct sb_material *material;
    struct sb_vertex *vertex;
    uint32_t *index;
};

static struct writable containers(void)
{
    struct sb_variant variant = scene_variant(1, 5, 3);
    variant.value[SB_AXIS_AREA] = 2;
    struct writable w = {.scene = made("containers", &variant)};
    w.dir = (struct sb_light *)light_of(&w.scene, SB_LIGHT_DIR, 0);
    w.point = (struct sb_light *)light_of(&w.scene, SB_LIGHT_POINT, 0);
    w.spot = (struct sb_light *)light_of(&w.scene, SB_LIGHT_SPOT, 0);
    w.area = (struct sb_light *)light_of(&w.scene, SB_LIGHT_AREA, 0);
    w.draw = (struct sb_draw *)w.scene.draw;
    w.material = (struct sb_material *)w.scene.material;
    w.vertex = (struct sb_vertex *)w.scene.mesh[0].vertex;
    w.index = (uint32_t *)w.scene.mesh[0].index;
    return w;
}

static void check_refused(struct writable *w, const char *part)
{
    struct sb_error err = {0};
    assert_false(sb_scene_validate(&w->scene, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, part);
    sb_scene_free(&w->scene);
}

// Writes a value to a float of a fresh scene, and expects the message.
#define check_value(member, value, part)                                                 \
    do {                                                                                 \
        struct writable fresh = containers();                                            \
        fresh.member = (value);                                                          \
        check_refused(&fresh, part);                                                     \
    } while (0)

static void a_bad_light_is_named_with_field_component_value_and_range(void **state)
{
    (void)state;
    check_value(point[3].diffuse[1], NAN,
                "scene containers, point light 3: diffuse[1] is nan; valid: a finite "
                "number of 0 or more");
    check_value(dir[0].ambient[2], -0.5f,
                "directional light 0: ambient[2] is -0.5; valid");
    check_value(spot[2].position[0], -INFINITY,
                "spot light 2: position[0] is -inf; valid");
    check_value(point[0].quadratic, -1, "point light 0: quadratic is -1; valid");
    check_value(area[1].radius, -0.25f, "area light 1: radius is -0.25; valid");
    check_value(area[0].extent[2], INFINITY, "area light 0: extent[2] is inf; valid");
    check_value(area[1].direction[1], NAN, "area light 1: direction[1] is nan; valid");
    check_value(dir[0].intensity, -1, "directional light 0: intensity is -1; valid");
}

static void half_angles_lie_between_nothing_and_everything(void **state)
{
    (void)state;
    check_value(spot[1].cutoff, -0.125f,
                "spot light 1: cutoff is -0.125; valid: 0 or more, at most pi");
    check_value(spot[0].inner, 3.25f, "spot light 0: inner is 3.25; valid");
    struct writable w = containers();
    w.spot[0].inner = 0;
    w.spot[0].cutoff = (float)acos(-1);
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_scene_free(&w.scene);
}

static void a_cut_off_must_leave_a_cone_and_something_outside_it(void **state)
{
    (void)state;
    check_value(spot[1].cos_cutoff, 1, "spot light 1: cos_cutoff is 1; valid: more than");
    check_value(spot[1].cos_cutoff, -1.5f, "valid: more than -1 and less than 1; or -2");
    check_value(spot[1].cos_cutoff, -1,
                "spot light 1: cos_cutoff is -1; valid: more than");
    struct writable w = containers();
    w.spot[1].cos_cutoff = nextafterf(1, 0);
    assert_true(sb_scene_validate(&w.scene, NULL));
    w.spot[1].cos_cutoff = nextafterf(-1, 0);
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_light_set_cone(&w.spot[1], 0, acos(-1)); // no cone
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_scene_free(&w.scene);
}

static void attenuation_that_divides_by_zero_is_refused(void **state)
{
    (void)state;
    struct writable w = containers();
    w.point[4].constant = w.point[4].linear = w.point[4].quadratic = 0;
    check_refused(&w, "point light 4: constant, linear and quadratic are all 0");
    w = containers();
    w.spot[0].constant = w.spot[0].linear = w.spot[0].quadratic = 0;
    check_refused(&w, "spot light 0: constant, linear and quadratic are all 0");

    w = containers();
    w.area[1].constant = w.area[1].linear = w.area[1].quadratic = 0;
    check_refused(&w, "area light 1: constant, linear and quadratic are all 0");

    w = containers();
    w.point[4].constant = w.point[4].linear = 0; // infinite only at the light itself
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_scene_free(&w.scene);
}

static void a_direction_must_point_somewhere(void **state)
{
    (void)state;
    struct writable w = containers();
    memset(w.dir[0].direction, 0, sizeof w.dir[0].direction);
    check_refused(&w, "directional light 0: direction is 0, 0, 0");
    w = containers();
    memset(w.spot[2].direction, 0, sizeof w.spot[2].direction);
    check_refused(&w, "spot light 2: direction is 0, 0, 0");

    w = containers(); // a segment without length is a point
    memset(w.area[1].direction, 0, sizeof w.area[1].direction);
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_scene_free(&w.scene);
}

// Differences of places must have a square that is a float.
static void places_are_not_too_far_away(void **state)
{
    (void)state;
    check_value(
        point[2].position[1], 3e19f,
        "point light 2: position[1] is 3.000000104103097e+19; valid: -1e18 to 1e18");
    check_value(scene.camera.eye[0], -2e18f, "camera.eye[0] is -");
    check_value(draw[3].model[13], 2e18f, "draw 3: vertex 0 is placed at 2e+18; valid: ");
    check_value(vertex[7].position[2], 3e38f, "vertex 7 is placed at ");
    struct writable w = containers();
    w.point[2].position[1] = 1e18f;
    assert_true(sb_scene_validate(&w.scene, NULL));
    sb_scene_free(&w.scene);
}

static void materials_draws_vertices_and_camera_are_checked_too(void **state)
{
    (void)state;
    check_value(material[0].shininess, 0,
                "material 0: shininess is 0; valid: a finite number of 0.001");
    check_value(material[0].specular[0], -1, "material 0: specular[0] is -1");
    check_value(material[0].lacks, 8, "material 0: lacks is 8; valid: 0 to 7");
    check_value(draw[9].model[12], INFINITY, "draw 9: model[12] is inf");
    check_value(draw[2].normal_matrix[8], NAN, "draw 2: normal_matrix[8] is nan");
    check_value(vertex[7].uv[1], NAN, "vertex 7 of mesh 0: uv[1] is nan");
    check_value(scene.camera.view_projection[5], NAN, "camera.view_projection[5] is nan");
    check_value(scene.ambient[1], -1, "ambient[1] is -1");
}

static void indices_and_numbers_stay_within_their_lists(void **state)
{
    (void)state;
    struct writable w = containers();
    w.index[4] = (uint32_t)w.scene.mesh[0].vertex_count;
    check_refused(&w, "mesh 0: index[4] is 150; valid: less than 150");
    check_value(draw[3].mesh, 1, "draw 3: mesh is 1; valid: 0 or more, less than 1");
    check_value(draw[3].material, -1, "draw 3: material is -1; valid");
    check_value(scene.lights.count[SB_LIGHT_POINT], -1, "-1 in the list of point lights");
    check_value(scene.lights.light, NULL, "1 in the list of directional lights");
    check_value(scene.map[SB_MAP_SPECULAR].width, 0, "map 1: 0 x 256 texels");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bad_light_is_named_with_field_component_value_and_range),
        cmocka_unit_test(a_cut_off_must_leave_a_cone_and_something_outside_it),
        cmocka_unit_test(half_angles_lie_between_nothing_and_everything),
        cmocka_unit_test(attenuation_that_divides_by_zero_is_refused),
        cmocka_unit_test(a_direction_must_point_somewhere),
        cmocka_unit_test(places_are_not_too_far_away),
        cmocka_unit_test(materials_draws_vertices_and_camera_are_checked_too),
        cmocka_unit_test(indices_and_numbers_stay_within_their_lists),
    };
    return run_tests(tests);
}
