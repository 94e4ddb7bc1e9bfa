#include "scene.h"

#include "math/mat.h"

static uint64_t hash_of(const char *name, const struct sb_variant *variant)
{
    struct sb_scene scene = made(name, variant);
    const uint64_t hash = sb_scene_hash(&scene);
    sb_scene_free(&scene);
    return hash;
}

static void the_same_variant_gives_the_same_bytes(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(3, 9, 5);
    for (int i = 0; i < sb_scene_row_count; i++) {
        const char *name = sb_scene_rows[i].name;
        assert_true(hash_of(name, &variant) == hash_of(name, &variant));
    }
}

static void every_axis_that_scenes_read_changes_the_hash(void **state)
{
    (void)state;
    static const struct {
        int axis;
        double value;
    } change[] = {
        {SB_AXIS_DIR, 2},
        {SB_AXIS_POINT, 3},
        {SB_AXIS_SPOT, 4},
        {SB_AXIS_AREA, 5},
        {SB_AXIS_OFFSET, 10},
        {SB_AXIS_SCALE, 2},
        {SB_AXIS_TESSELLATION, 700},
        {SB_AXIS_WIDTH, 512},
        {SB_AXIS_HEIGHT, 300},
        {SB_AXIS_SUN, 30},
        {SB_AXIS_ATMOSPHERE, SB_ATMOSPHERE_HORROR},
        {SB_AXIS_LAMPS, SB_LAMPS_ON},
    };
    enum { CHANGES = sizeof change / sizeof *change };
    uint64_t hash[256];
    int count = 0;
    for (int i = 0; i < sb_scene_row_count; i++) {
        const char *name = sb_scene_rows[i].name;
        struct sb_variant variant = scene_variant(1, 1, 1);
        hash[count++] = hash_of(name, &variant);
        for (int k = 0; k < CHANGES; k++) {
            variant = scene_variant(1, 1, 1);
            variant.value[change[k].axis] = change[k].value;
            hash[count++] = hash_of(name, &variant);
        }
    }
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < i; k++)
            assert_true(hash[i] != hash[k]);
    }
}

static void the_hash_sees_every_light_map_and_index(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(2, 2, 2);
    variant.value[SB_AXIS_AREA] = 2;
    struct sb_scene scene = made("containers", &variant);
    float *const number[] = {
        (float *)&light_of(&scene, SB_LIGHT_DIR, 1)->specular[2],
        (float *)&light_of(&scene, SB_LIGHT_POINT, 1)->quadratic,
        (float *)&light_of(&scene, SB_LIGHT_SPOT, 1)->cone_offset,
        (float *)&light_of(&scene, SB_LIGHT_AREA, 1)->extent[2],
        (float *)&scene.material[0].shininess,
        (float *)&scene.draw[9].normal_matrix[8],
        (float *)&scene.mesh[0].vertex[scene.mesh[0].vertex_count - 1].tangent[3],
        &scene.ambient[2],
        &scene.clear_colour[3],
        &scene.camera.view_projection[15],
    };
    const uint64_t before = sb_scene_hash(&scene);
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        const float old = *number[i];
        *number[i] = nextafterf(old, 2 * old + 1);
        assert_true(sb_scene_hash(&scene) != before);
        *number[i] = old;
    }
    uint32_t *index = (uint32_t *)&scene.mesh[0].index[scene.mesh[0].index_count - 1];
    *index ^= 1;
    assert_true(sb_scene_hash(&scene) != before);
    *index ^= 1;
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        unsigned char *texel = (unsigned char *)scene.map[i].texel;
        texel[4 * 256 * 256 - 1] ^= 1;
        assert_true(sb_scene_hash(&scene) != before);
        texel[4 * 256 * 256 - 1] ^= 1;
    }
    assert_true(sb_scene_hash(&scene) == before);
    sb_scene_free(&scene);
}

static void shorter_lists_of_lights_are_beginnings_of_longer_ones(void **state)
{
    (void)state;
    struct sb_variant most = scene_variant(256, 256, 256);
    most.value[SB_AXIS_AREA] = 256;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene all = made(sb_scene_rows[i].name, &most);
        for (int n = 0; n <= 256; n = 3 * n + 1) {
            // The other types' counts must not matter.
            struct sb_variant variant = scene_variant(n, 256 - n, (n + 128) % 257);
            variant.value[SB_AXIS_AREA] = (n + 64) % 257;
            struct sb_scene some = made(sb_scene_rows[i].name, &variant);
            for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
                int count, all_count;
                const struct sb_light *light = sb_lights_of(&some.lights, type, &count);
                const struct sb_light *all_light =
                    sb_lights_of(&all.lights, type, &all_count);
                assert_int_equal(count, variant.value[sb_light_structs[type].axis]);
                assert_memory_equal(light, all_light, (size_t)count * sizeof *light);
            }
            sb_scene_free(&some);
        }
        sb_scene_free(&all);
    }
}

static void no_two_lights_stand_at_or_come_from_the_same_place(void **state)
{
    (void)state;
    struct sb_variant most = scene_variant(256, 256, 256);
    most.value[SB_AXIS_AREA] = 256;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &most);
        for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
            int count;
            const struct sb_light *light = sb_lights_of(&scene.lights, type, &count);
            for (int a = 0; a < count; a++) {
                for (int b = 0; b < a; b++) {
                    const bool dir = type == SB_LIGHT_DIR;
                    assert_true(memcmp(dir ? light[a].direction : light[a].position,
                                       dir ? light[b].direction : light[b].position,
                                       3 * sizeof(float)) != 0);
                }
            }
        }
        sb_scene_free(&scene);
    }
}

// Which `attenuation=radius` and `windowed` divide by, and shadows are measured in.
static void every_light_that_has_a_place_has_a_reach_and_is_on(void **state)
{
    (void)state;
    struct sb_variant most = scene_variant(256, 256, 256);
    most.value[SB_AXIS_AREA] = 256;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &most);
        for (int k = 0; k < sb_lights_total(&scene.lights); k++) {
            const struct sb_light *light = &scene.lights.light[k];
            check_close(light->intensity, 1, 0);
            check_close(light->w, k < 256 ? 0 : 1, 0);
            assert_true(k < 256 ? light->range == 0 : light->range > 0);
        }
        for (int k = 0; k < 256; k++) {
            const struct sb_light *light = light_of(&scene, SB_LIGHT_AREA, k);
            double square = 0;
            for (int c = 0; c < 3; c++) {
                assert_true(light->extent[c] >= 0.1f);
                square += (double)light->direction[c] * light->direction[c];
            }
            assert_in_range(100 * sqrt(square), 50, 60);
            check_close(light->radius, 0.3, 1e-6);
        }
        sb_scene_free(&scene);
    }
}

static void neighbours_differ_in_hue_and_no_light_lacks_a_colour(void **state)
{
    (void)state;
    const struct sb_variant most = scene_variant(0, 256, 0);
    struct sb_scene scene = made("sphere", &most);
    const struct sb_light *point = light_of(&scene, SB_LIGHT_POINT, 0);
    for (int i = 0; i < 256; i++) {
        const float *c = point[i].diffuse, *next = point[(i + 1) % 256].diffuse;
        const float brightest = fmaxf(c[0], fmaxf(c[1], c[2]));
        double apart = 0;
        for (int k = 0; k < 3; k++) {
            assert_true(c[k] >= 0.1f * brightest - 1e-7f);
            check_close(point[i].ambient[k], c[k] / 16, 1e-9);
            apart = fmax(apart, fabs(c[k] - next[k]));
        }
        assert_true(apart > 0.2 * brightest);
    }
    sb_scene_free(&scene);
}

static void containers_have_the_lights_of_the_text(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(1, 4, 1);
    struct sb_scene scene = made("containers", &variant);
    static const float at[4][3] = {
        {0.7f, 0.2f, 2}, {2.3f, -3.3f, -4}, {-4, 2, -12}, {0, 0, -3}};
    for (int i = 0; i < 4; i++) {
        const struct sb_light *light = light_of(&scene, SB_LIGHT_POINT, i);
        for (int k = 0; k < 3; k++) {
            check_close(light->position[k], at[i][k], 0);
            check_close(light->ambient[k], 0.05f, 0);
            check_close(light->diffuse[k], 0.8f, 0);
            check_close(light->specular[k], 1, 0);
        }
        check_close(light->constant, 1, 0);
        check_close(light->linear, 0.09f, 0);
        check_close(light->quadratic, 0.032f, 0);
    }
    const struct sb_light *sun = light_of(&scene, SB_LIGHT_DIR, 0);
    check_close(sun->direction[0], -0.2f, 0);
    check_close(sun->direction[1], -1, 0);
    check_close(sun->direction[2], -0.3f, 0);
    const struct sb_light *torch = light_of(&scene, SB_LIGHT_SPOT, 0);
    assert_memory_equal(torch->position, scene.camera.eye, sizeof torch->position);
    check_close(torch->direction[2], -1, 0);
    check_close(torch->cos_cutoff, cos(15 * SB_PI / 180), 1e-7);
    sb_scene_free(&scene);
}

static void triangles_are_as_near_as_meshes_allow(void **state)
{
    (void)state;
    // A cube's step is 12 (2n + 1) triangles on each of ten cubes, a sphere's 2 (stacks -
    // 1), a corridor's 8 columns; half of each is the distance allowed.
    for (double wanted = 12; wanted < 30000; wanted = floor(wanted * 1.7)) {
        struct sb_variant variant = scene_variant(0, 0, 0);
        variant.value[SB_AXIS_TESSELLATION] = wanted;
        struct sb_scene containers = made("containers", &variant);
        struct sb_scene sphere = made("sphere", &variant);
        struct sb_scene plane = made("plane", &variant);
        const double cells = sqrt((double)sb_scene_triangles(&containers) / 120);
        check_close(cells, round(cells), 1e-9);
        if (wanted >= 120)
            check_close((double)sb_scene_triangles(&containers), wanted,
                        60 * (2 * cells + 1));
        else
            assert_int_equal(sb_scene_triangles(&containers), 120);
        check_close((double)sb_scene_triangles(&sphere), wanted, sqrt(wanted) / 2 + 1);
        check_close((double)sb_scene_triangles(&plane), wanted, sqrt(wanted) + 4);
        sb_scene_free(&containers);
        sb_scene_free(&sphere);
        sb_scene_free(&plane);
    }
}

// Scenes of several meshes share the triangles out, each mesh in its own steps.
static void scenes_of_many_meshes_come_near_what_is_asked_for(void **state)
{
    (void)state;
    static const char *const name[] = {"tunnel", "blocks", "spheres", "room"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        for (double wanted = 1000; wanted < 1e6; wanted *= 1.7) {
            struct sb_variant variant = scene_variant(0, 0, 0);
            variant.value[SB_AXIS_TESSELLATION] = wanted;
            struct sb_scene scene = made(name[i], &variant);
            check_close((double)sb_scene_triangles(&scene) / wanted, 1, 0.1);
            sb_scene_free(&scene);
        }
    }
}

static struct sb_vec3 project(const struct sb_scene *scene, const float p[3], double *w)
{
    const float *m = scene->camera.view_projection;
    double out[4];
    for (int row = 0; row < 4; row++)
        out[row] = (double)m[row] * p[0] + (double)m[4 + row] * p[1] +
                   (double)m[8 + row] * p[2] + m[12 + row];
    *w = out[3];
    return (struct sb_vec3){out[0] / out[3], out[1] / out[3], out[2] / out[3]};
}

static void view_projection_is_projection_times_view(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        const struct sb_camera *camera = &scene.camera;
        for (int column = 0; column < 4; column++) {
            for (int row = 0; row < 4; row++) {
                double sum = 0;
                for (int k = 0; k < 4; k++)
                    sum += (double)camera->projection[4 * k + row] *
                           camera->view[4 * column + k];
                check_close(camera->view_projection[4 * column + row], sum, 1e-5);
            }
        }
        sb_scene_free(&scene);
    }
}

static void every_shape_of_target_shows_what_a_square_one_shows(void **state)
{
    (void)state;
    static const double shape[][2] = {{256, 256}, {1024, 64}, {64, 1024}};
    for (size_t i = 0; i < sizeof shape / sizeof *shape; i++) {
        struct sb_variant variant = scene_variant(0, 0, 0);
        variant.value[SB_AXIS_WIDTH] = shape[i][0];
        variant.value[SB_AXIS_HEIGHT] = shape[i][1];
        struct sb_scene scene = made("containers", &variant);
        for (int d = 0; d < scene.draw_count; d++) {
            double w;
            const struct sb_vec3 at = project(&scene, scene.draw[d].model + 12, &w);
            assert_true(w > 0 && fabs(at.x) < 1 && fabs(at.y) < 1 && fabs(at.z) < 1);
        }
        sb_scene_free(&scene);
    }
}

static void the_sphere_covers_four_fifths_of_the_height(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(0, 0, 0);
    variant.value[SB_AXIS_TESSELLATION] = 50000;
    struct sb_scene scene = made("sphere", &variant);
    double top = 0, bottom = 0, w;
    for (int i = 0; i < scene.mesh[0].vertex_count; i++) {
        const struct sb_vec3 at = project(&scene, scene.mesh[0].vertex[i].position, &w);
        top = fmax(top, at.y);
        bottom = fmin(bottom, at.y);
    }
    check_close(top, 0.8, 0.001);
    check_close(bottom, -0.8, 0.001);
    sb_scene_free(&scene);
}

static void scale_and_offset_move_the_world_but_not_the_picture(void **state)
{
    (void)state;
    // Powers of two, so that floats round alike.
    const double scale = 4, offset = 16;
    struct sb_variant variant = scene_variant(2, 6, 4);
    variant.value[SB_AXIS_AREA] = 3;
    variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
    struct sb_variant moved = variant;
    moved.value[SB_AXIS_SCALE] = scale;
    moved.value[SB_AXIS_OFFSET] = offset;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene a = made(sb_scene_rows[i].name, &variant);
        struct sb_scene b = made(sb_scene_rows[i].name, &moved);
        const struct sb_light *a_area = light_of(&a, SB_LIGHT_AREA, 2);
        const struct sb_light *b_area = light_of(&b, SB_LIGHT_AREA, 2);
        for (int k = 0; k < 3; k++) {
            check_close(b.camera.eye[k], a.camera.eye[k] * scale + offset, 1e-5);
            check_close(b_area->extent[k], a_area->extent[k] * scale, 1e-6);
            check_close(b_area->direction[k], a_area->direction[k] * scale, 1e-6);
        }
        for (int k = 2; k < sb_lights_total(&a.lights); k++) {
            const struct sb_light *la = &a.lights.light[k], *lb = &b.lights.light[k];
            for (int c = 0; c < 3; c++)
                check_close(lb->position[c], la->position[c] * scale + offset, 1e-5);
            check_close(lb->range, la->range * scale, 0);
            check_close(lb->quadratic, la->quadratic, 0);
        }
        assert_memory_equal(a.lights.light, b.lights.light, 2 * sizeof *a.lights.light);
        check_close(b_area->radius, a_area->radius * scale, 1e-6);
        for (int d = 0; d < a.draw_count; d++) {
            double w_a, w_b;
            assert_int_equal(b.draw[d].lamp, a.draw[d].lamp);
            const struct sb_vec3 at = project(&a, a.draw[d].model + 12, &w_a);
            if (w_a < 0.1) // beside the eye, or behind it
                continue;
            const struct sb_vec3 at_b = project(&b, b.draw[d].model + 12, &w_b);
            check_close(w_b, scale * w_a, 1e-4);
            check_close(at_b.x, at.x, 1e-5);
            check_close(at_b.y, at.y, 1e-5);
            check_close(at_b.z, at.z, 1e-5);
            for (int k = 0; k < 9; k++)
                check_close(b.draw[d].normal_matrix[k], a.draw[d].normal_matrix[k], 1e-7);
        }
        sb_scene_free(&a);
        sb_scene_free(&b);
    }
}

static void the_limits_of_the_axes_still_make_valid_scenes(void **state)
{
    (void)state;
    static const double limit[][4] = {// scale, offset, width, height
                                      {1e-6, 1e12, 1, 16384},
                                      {1e6, 1e12, 16384, 1},
                                      {1e-6, 0, 1, 1},
                                      {1e6, 0, 1, 1}};
    for (int i = 0; i < sb_scene_row_count; i++) {
        for (size_t k = 0; k < 2 * (sizeof limit / sizeof *limit); k++) {
            struct sb_variant variant = scene_variant(256, 256, 256);
            variant.value[SB_AXIS_SPACE] = k % 2 ? SB_SPACE_EYE : SB_SPACE_WORLD;
            variant.value[SB_AXIS_AREA] = 256;
            variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
            variant.value[SB_AXIS_SCALE] = limit[k / 2][0];
            variant.value[SB_AXIS_OFFSET] = limit[k / 2][1];
            variant.value[SB_AXIS_WIDTH] = limit[k / 2][2];
            variant.value[SB_AXIS_HEIGHT] = limit[k / 2][3];
            struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
            sb_scene_free(&scene);
        }
    }
}

static void normal_map_texels_are_unit_vectors_that_point_out(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    struct sb_scene scene = made("sphere", &variant);
    const struct sb_texture *map = &scene.map[SB_MAP_NORMAL];
    double bent = 0;
    for (int i = 0; i < map->width * map->height; i++) {
        double n[3], square = 0;
        for (int k = 0; k < 3; k++) {
            n[k] = (map->texel[4 * i + k] - 128) / 127.0;
            square += n[k] * n[k];
        }
        check_close(sqrt(square), 1, 0.01);
        assert_true(n[2] > 0.5);
        bent = fmax(bent, fabs(n[0]));
    }
    assert_true(bent > 0.1);
    sb_scene_free(&scene);
}

static void boards_do_not_shine_and_nothing_is_black(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    struct sb_scene scene = made("containers", &variant);
    const unsigned char *diffuse = scene.map[SB_MAP_DIFFUSE].texel;
    const unsigned char *specular = scene.map[SB_MAP_SPECULAR].texel;
    assert_int_equal(specular[4 * (128 * 256 + 128)], 0); // the middle of a board
    assert_true(specular[4 * (5 * 256 + 128)] >= 200);    // the frame
    for (int i = 0; i < 256 * 256; i++) {
        for (int k = 0; k < 3; k++)
            assert_true(diffuse[4 * i + k] >= 32); // a black texel hides every light
    }
    sb_scene_free(&scene);
}

// The table and the meshes say it both; lamps are drawn beside what is lit.
static void a_scene_is_analytic_when_all_that_is_lit_stands_for_a_sphere(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(1, 2, 1);
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        bool all = true;
        for (int d = 0; d < scene.draw_count; d++)
            all &= scene.draw[d].lamp >= 0 || scene.mesh[scene.draw[d].mesh].sphere;
        assert_true(sb_scene_analytic(sb_scene_rows[i].name) == all);
        sb_scene_free(&scene);
    }
    assert_true(sb_scene_analytic("sphere"));
    assert_false(sb_scene_analytic("no_such_scene"));
}

static void an_unknown_scene_is_answered_with_the_known_ones(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, 0, 0);
    struct sb_scene scene = {0};
    struct sb_error err;
    assert_false(sb_scene_make("teapot", &variant, &scene, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, "teapot");
    check_contains(err.text, "containers sphere plane tunnel blocks spheres room");
    sb_scene_free(&scene);
}

static void what_is_made_is_validated(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(0, 0, 0);
    variant.value[SB_AXIS_OFFSET] = INFINITY; // which no suite can ask for
    struct sb_scene scene = {0};
    struct sb_error err;
    assert_false(sb_scene_make("containers", &variant, &scene, &err));
    check_contains(err.text, "scene containers, draw 0: model[");
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_variant_gives_the_same_bytes),
        cmocka_unit_test(every_axis_that_scenes_read_changes_the_hash),
        cmocka_unit_test(the_hash_sees_every_light_map_and_index),
        cmocka_unit_test(shorter_lists_of_lights_are_beginnings_of_longer_ones),
        cmocka_unit_test(no_two_lights_stand_at_or_come_from_the_same_place),
        cmocka_unit_test(every_light_that_has_a_place_has_a_reach_and_is_on),
        cmocka_unit_test(neighbours_differ_in_hue_and_no_light_lacks_a_colour),
        cmocka_unit_test(containers_have_the_lights_of_the_text),
        cmocka_unit_test(triangles_are_as_near_as_meshes_allow),
        cmocka_unit_test(scenes_of_many_meshes_come_near_what_is_asked_for),
        cmocka_unit_test(view_projection_is_projection_times_view),
        cmocka_unit_test(every_shape_of_target_shows_what_a_square_one_shows),
        cmocka_unit_test(the_sphere_covers_four_fifths_of_the_height),
        cmocka_unit_test(scale_and_offset_move_the_world_but_not_the_picture),
        cmocka_unit_test(the_limits_of_the_axes_still_make_valid_scenes),
        cmocka_unit_test(normal_map_texels_are_unit_vectors_that_point_out),
        cmocka_unit_test(boards_do_not_shine_and_nothing_is_black),
        cmocka_unit_test(a_scene_is_analytic_when_all_that_is_lit_stands_for_a_sphere),
        cmocka_unit_test(what_is_made_is_validated),
        cmocka_unit_test(an_unknown_scene_is_answered_with_the_known_ones),
    };
    return run_tests(tests);
}
