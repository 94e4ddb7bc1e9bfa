// run --dump: what it writes is what the scene is, float for float.
#include "cli_fixture.h"

#include "image/image.h"
#include "scene.h"

#define DUMP "run --context null -q --rounds 20 --first-look 10 "

static struct sb_scene scene; // what must have been dumped
static json_t *dumped;

static json_t *read_json(const char *name)
{
    json_error_t cause;
    char *text = read_file(name);
    json_t *json = json_loads(text, 0, &cause);
    if (!json)
        fail_msg("%s:%d: %s", name, cause.line, cause.text);
    free(text);
    return json;
}

static void read_picture(const char *name, struct sb_image *image)
{
    char path[256];
    struct sb_error err = {0};
    snprintf(path, sizeof path, "%s/%s", test_dir, name);
    if (!sb_image_read_pfm(image, path, &err))
        fail_msg("%s", err.text);
}

// The variant of the dump and its scene.
static int begin(void **state)
{
    (void)state;
    struct sb_error err = {0};
    struct sb_variant variant = scene_variant(2, 5, 3);
    variant.value[SB_AXIS_WIDTH] = variant.value[SB_AXIS_HEIGHT] = 64;
    variant.value[SB_AXIS_TESSELLATION] = 0;
    variant.value[SB_AXIS_SCALE] = 0.37; // floats that need all their digits
    variant.value[SB_AXIS_SUN] = -91;    // the scene's own
    if (!sb_scene_make("containers", &variant, &scene, &err))
        fail_msg("%s", err.text);
    check_answer(DUMP "--set dir=2 --set point=5 --set spot=3 --set scale=0.37 "
                      "--set width=64 --set height=64 --dump @/dump/deep -o @/out",
                 0, "results:");
    dumped = read_json(
        "dump/deep/containers-context=null,dir=2,point=5,spot=3,width=64,height=64,"
        "scale=0.37/scene.json");
    return 0;
}

static int end(void **state)
{
    (void)state;
    json_decref(dumped);
    sb_scene_free(&scene);
    return 0;
}

// Floats that a program reads must be the floats that were uploaded, bit for bit.
#define check_floats(list, floats, count)                                                \
    check_floats_at(list, floats, count, #list, __LINE__)
static void check_floats_at(const json_t *list, const float *floats, int count,
                            const char *what, int line)
{
    if ((int)json_array_size(list) != count)
        fail_msg("line %d: %s: %zu numbers, wanted %d", line, what, json_array_size(list),
                 count);
    for (int i = 0; i < count; i++) {
        const float read = (float)json_number_value(json_array_get(list, (size_t)i));
        if (memcmp(&read, &floats[i], sizeof read) != 0)
            fail_msg("line %d: %s: number %d is %.9g, not %.9g", line, what, i, read,
                     floats[i]);
    }
}

static void camera_and_background_are_those_of_the_scene(void **state)
{
    (void)state;
    const json_t *camera = json_object_get(dumped, "camera");
    check_floats(json_object_get(camera, "eye"), scene.camera.eye, 3);
    check_floats(json_object_get(camera, "view"), scene.camera.view, 16);
    check_floats(json_object_get(camera, "projection"), scene.camera.projection, 16);
    check_floats(json_object_get(camera, "view_projection"), scene.camera.view_projection,
                 16);
    check_floats(json_object_get(dumped, "ambient"), scene.ambient, 3);
    check_floats(json_object_get(dumped, "clear_colour"), scene.clear_colour, 4);
}

// The floats of a light by the places of the struct; the dump by the names of the table.
static void every_member_of_every_light_is_dumped_by_its_name(void **state)
{
    (void)state;
    const json_t *lights = json_object_get(dumped, "lights");
    const json_t *spot = json_array_get(json_object_get(lights, "spot"), 2);
    const json_t *dir = json_array_get(json_object_get(lights, "dir"), 1);
    const json_t *point = json_array_get(json_object_get(lights, "point"), 4);
    const struct sb_light *wanted = &scene.lights.light[2 + 5 + 2];
    assert_int_equal(json_array_size(json_object_get(lights, "dir")), 2);
    assert_int_equal(json_array_size(json_object_get(lights, "point")), 5);
    assert_int_equal(json_array_size(json_object_get(lights, "spot")), 3);
    assert_int_equal(json_array_size(json_object_get(lights, "area")), 0);
#define VECTOR(light, name) check_floats(json_object_get(light, #name), wanted->name, 3)
#define SCALAR(light, name)                                                              \
    assert_true((float)json_number_value(json_object_get(light, #name)) == wanted->name)
    VECTOR(spot, position);
    VECTOR(spot, direction);
    VECTOR(spot, ambient);
    VECTOR(spot, diffuse);
    VECTOR(spot, specular);
    SCALAR(spot, range);
    SCALAR(spot, constant);
    SCALAR(spot, linear);
    SCALAR(spot, quadratic);
    SCALAR(spot, cutoff);
    SCALAR(spot, inner);
    SCALAR(spot, cos_cutoff);
    SCALAR(spot, exponent);
    SCALAR(spot, intensity);
    wanted = &scene.lights.light[1];
    VECTOR(dir, direction);
    VECTOR(dir, diffuse);
    assert_null(json_object_get(dir, "position"));
    wanted = &scene.lights.light[2 + 4];
    VECTOR(point, position);
    VECTOR(point, specular);
    assert_null(json_object_get(point, "cutoff"));
#undef VECTOR
#undef SCALAR
}

static void check_member(const json_t *json, const char *name, const struct sb_mesh *mesh,
                         size_t offset, int components)
{
    const json_t *list = json_object_get(json, name);
    assert_int_equal(json_array_size(list), components * mesh->vertex_count);
    for (int i = 0; i < components * mesh->vertex_count; i++) {
        float wanted;
        const float read = (float)json_number_value(json_array_get(list, (size_t)i));
        memcpy(&wanted,
               (const char *)&mesh->vertex[i / components] + offset +
                   (size_t)(i % components) * sizeof wanted,
               sizeof wanted);
        if (memcmp(&read, &wanted, sizeof read) != 0)
            fail_msg("%s[%d] is %.9g, not %.9g", name, i, read, wanted);
    }
}

static void geometry_is_that_of_the_scene(void **state)
{
    (void)state;
    const json_t *meshes = json_object_get(dumped, "meshes");
    assert_int_equal(json_array_size(meshes), scene.mesh_count);
    for (int m = 0; m < scene.mesh_count; m++) {
        const json_t *json = json_array_get(meshes, (size_t)m);
        const struct sb_mesh *mesh = &scene.mesh[m];
        check_member(json, "position", mesh, offsetof(struct sb_vertex, position), 3);
        check_member(json, "normal", mesh, offsetof(struct sb_vertex, normal), 3);
        check_member(json, "uv", mesh, offsetof(struct sb_vertex, uv), 2);
        check_member(json, "tangent", mesh, offsetof(struct sb_vertex, tangent), 4);
        const json_t *index = json_object_get(json, "index");
        assert_int_equal(json_array_size(index), mesh->index_count);
        for (int i = 0; i < mesh->index_count; i++)
            assert_int_equal(json_integer_value(json_array_get(index, (size_t)i)),
                             mesh->index[i]);
    }
}

static void draws_and_materials_are_those_of_the_scene(void **state)
{
    (void)state;
    const json_t *draws = json_object_get(dumped, "draws");
    const json_t *materials = json_object_get(dumped, "materials");
    assert_int_equal(json_array_size(draws), scene.draw_count);
    for (int i = 0; i < scene.draw_count; i++) {
        const json_t *draw = json_array_get(draws, (size_t)i);
        const struct sb_draw *wanted = &scene.draw[i];
        assert_int_equal(json_integer_value(json_object_get(draw, "mesh")), wanted->mesh);
        assert_int_equal(json_integer_value(json_object_get(draw, "material")),
                         wanted->material);
        assert_int_equal(json_integer_value(json_object_get(draw, "lamp")), wanted->lamp);
        check_floats(json_object_get(draw, "model"), wanted->model, 16);
        check_floats(json_object_get(draw, "normal_matrix"), wanted->normal_matrix, 9);
    }
    assert_int_equal(json_array_size(materials), scene.material_count);
    for (int i = 0; i < scene.material_count; i++) {
        const json_t *material = json_array_get(materials, (size_t)i);
        const struct sb_material *wanted = &scene.material[i];
        check_floats(json_object_get(material, "ambient"), wanted->ambient, 3);
        check_floats(json_object_get(material, "diffuse"), wanted->diffuse, 3);
        check_floats(json_object_get(material, "specular"), wanted->specular, 3);
        assert_true((float)json_number_value(json_object_get(material, "shininess")) ==
                    wanted->shininess);
    }
}

static void the_variant_is_there_as_words(void **state)
{
    (void)state;
    const json_t *values = json_object_get(dumped, "values");
    static const char *const words[][2] = {
        {"point", "5"},
        {"stage", "fragment"},
        {"storage", "uniform"}, // not "auto"
        {"shadow_map", ""},     // moot: nothing casts a shadow
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        assert_string_equal(json_string_value(json_object_get(values, words[i][0])),
                            words[i][1]);
    assert_int_equal(json_integer_value(json_object_get(dumped, "width")), 64);
    assert_string_equal(json_string_value(json_object_get(dumped, "scene")),
                        "containers");
}

static void pictures_and_maps_are_float_maps(void **state)
{
    (void)state;
#define FOLDER                                                                           \
    "dump/deep/"                                                                         \
    "containers-context=null,dir=2,point=5,spot=3,width=64,height=64,scale=0.37/"
    static const char *const maps[] = {
        FOLDER "map-diffuse.pfm", FOLDER "map-specular.pfm", FOLDER "map-normal.pfm"};
    struct sb_image image;
    read_picture(FOLDER "colour.pfm", &image);
    assert_int_equal(image.width, 64);
    assert_int_equal(image.channels, 3);
    sb_image_free(&image);
    read_picture(FOLDER "id.pfm", &image);
    assert_int_equal(image.channels, 1);
    assert_true(*sb_image_at(&image, 63, 63) == 1); // the null runner's id
    sb_image_free(&image);
    for (int m = 0; m < SB_MAP_COUNT; m++) {
        read_picture(maps[m], &image);
        assert_int_equal(image.width, scene.map[m].width);
        assert_int_equal(image.height, scene.map[m].height);
        for (int i = 0; i < 3 * image.width * image.height; i++) {
            const float byte = image.data[i] * 255;
            if (lrintf(byte) != scene.map[m].texel[i / 3 * 4 + i % 3] ||
                fabsf(byte - rintf(byte)) > 1e-4f)
                fail_msg("map %d, value %d: %.9g", m, i, image.data[i]);
        }
        sb_image_free(&image);
    }
}

static void each_variant_has_a_folder_of_its_own(void **state)
{
    (void)state;
    check_answer(DUMP "--sweep point=1,2 --dump @/each -o @/each-out", 0, "results:");
    json_t *one = read_json("each/containers-context=null,point=1/scene.json");
    json_t *two = read_json("each/containers-context=null,point=2/scene.json");
    const json_t *of_two = json_object_get(json_object_get(two, "lights"), "point");
    assert_string_equal(json_string_value(json_object_get(one, "variant")),
                        "context=null,point=1");
    assert_int_equal(json_array_size(of_two), 2);
    json_decref(one);
    json_decref(two);
}

static void a_dump_that_cannot_be_written_is_named_and_nothing_is_lost(void **state)
{
    (void)state;
    // A file where the folder should be; and a folder that fills up.
    check_shell("touch @/taken; exec $SB " DUMP "--dump @/taken/sub -o @/a 2>&1", 2,
                "taken: cannot make the folder");
    check_shell("trap '' XFSZ; ulimit -f 64; exec $SB " DUMP
                "--dump @/filled -o @/b 2>&1",
                3, "pfm: File too large");
    // What an earlier process measured stays, and goes on without the obstacle.
    check_answer(DUMP "--half-width 0.0001 --dump @/good -o @/c", 0, "results:");
    char *before = read_file("c/samples.csv");
    check_shell("rm -r @/good; touch @/good; exec $SB run --resume @/c --processes 2 -q "
                "2>&1",
                2, "good: cannot make the folder");
    char *after = read_file("c/samples.csv");
    assert_string_equal(before, after);
    free(before);
    free(after);
    check_answer("run --resume @/c --processes 2 -q --dump @/other", 2, "--dump");
    check_shell("rm @/good; exec $SB run --resume @/c --processes 2 -q 2>&1", 0,
                "results:");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera_and_background_are_those_of_the_scene),
        cmocka_unit_test(every_member_of_every_light_is_dumped_by_its_name),
        cmocka_unit_test(geometry_is_that_of_the_scene),
        cmocka_unit_test(draws_and_materials_are_those_of_the_scene),
        cmocka_unit_test(the_variant_is_there_as_words),
        cmocka_unit_test(pictures_and_maps_are_float_maps),
        cmocka_unit_test(each_variant_has_a_folder_of_its_own),
        cmocka_unit_test(a_dump_that_cannot_be_written_is_named_and_nothing_is_lost),
    };
    return end_tests(cmocka_run_group_tests(tests, begin, end));
}
