// Lights that are part of the shader: what the text says is read back and held against the
// scene.
#include "assemble_words.h"

#include "scene/scene.h"

static const char mixed[] = "dir=2 point=3 spot=2 area=2";

struct fixture {
    struct sb_assembly assembly;
    struct sb_scene scene;
    const char *glsl;
};

static void begin(struct fixture *f, const char *scene, const char *words)
{
    const struct assembling from = {.words = words, .scene = scene};
    struct sb_error err = {0};
    *f = (struct fixture){0};
    if (!assemble_from(&from, &f->assembly, &err) ||
        !sb_scene_make(scene, &f->assembly.job.variant, &f->scene, &err))
        fail_msg("%s: %s", words, err.text);
    f->glsl = shade_of(&f->assembly, FRAGMENT)->text;
}

static void end(struct fixture *f)
{
    sb_assembly_free(&f->assembly);
    sb_scene_free(&f->scene);
}

// A GLSL float literal, which has a dot or an exponent.
static const char *read_float(const char *at, float *value)
{
    char *behind;
    *value = strtof(at, &behind);
    assert_true(behind > at);
    assert_true(strcspn(at, ".e") < (size_t)(behind - at));
    return behind;
}

static const char *expect(const char *at, const char *word)
{
    assert_memory_equal(at, word, strlen(word));
    return at + strlen(word);
}

// "PointLight(vec3(1.0, …), …)" at `at`; returns what follows.
static const char *read_light(const struct fixture *f, const char *at,
                              const struct sb_light_struct *row, struct sb_light *light)
{
    struct sb_light_members members;
    sb_light_members_of(row, &f->assembly.job.variant, &members);
    *light = (struct sb_light){0};
    at = expect(expect(at, row->type), "(");
    for (int i = 0; i < members.count; i++) {
        const int components = members.field[i]->components;
        float *value = (float *)((char *)light + members.field[i]->offset);
        at = i ? expect(at, ", ") : at;
        if (components == 3)
            at = expect(at, "vec3(");
        for (int c = 0; c < components; c++)
            at = read_float(c ? expect(at, ", ") : at, &value[c]);
        if (components == 3)
            at = expect(at, ")");
    }
    return expect(at, ")");
}

// const PointLight u_point[3] = PointLight[3](\n    …,\n    …);
static void read_constants(const struct fixture *f, const struct sb_light_struct *row,
                           struct sb_light *light, int count)
{
    char head[96];
    snprintf(head, sizeof head, "const %s %s[%d] = %s[%d](\n    ", row->type, row->array,
             count, row->type, count);
    const char *at = strstr(f->glsl, head);
    assert_non_null(at);
    at += strlen(head);
    for (int i = 0; i < count; i++)
        at = read_light(f, i ? expect(at, ",\n    ") : at, row, &light[i]);
    expect(at, ");\n");
}

// void fill_lights() { … u_point[0] = PointLight(…); … }
static void read_globals(const struct fixture *f, const struct sb_light_struct *row,
                         struct sb_light *light, int count)
{
    char line[96];
    snprintf(line, sizeof line, "\n%s %s[%d];\n", row->type, row->array, count);
    check_contains(f->glsl, line);
    const char *body = strstr(f->glsl, "void fill_lights()\n{\n");
    assert_non_null(body);
    for (int i = 0; i < count; i++) {
        snprintf(line, sizeof line, "\n    %s[%d] = ", row->array, i);
        const char *at = strstr(body, line);
        assert_non_null(at);
        assert_true(at < strstr(body, "\n}\n"));
        assert_null(strstr(at + 1, line));
        expect(read_light(f, at + strlen(line), row, &light[i]), ";\n");
    }
}

static void check_same(const struct fixture *f, const struct sb_light_struct *row,
                       const struct sb_light *read, const struct sb_light *wanted)
{
    struct sb_light_members members;
    sb_light_members_of(row, &f->assembly.job.variant, &members);
    for (int i = 0; i < members.count; i++) {
        const struct sb_light_field *field = members.field[i];
        assert_memory_equal((const char *)read + field->offset,
                            (const char *)wanted + field->offset,
                            (size_t)field->components * sizeof(float));
    }
}

static void check_scene(const char *scene, const char *words)
{
    struct fixture f;
    begin(&f, scene, words);
    const bool global =
        f.assembly.job.variant.value[SB_AXIS_STORAGE] == SB_STORAGE_GLOBAL;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const struct sb_light_struct *row = &sb_light_structs[t];
        struct sb_light read[8];
        int count;
        const struct sb_light *light = sb_lights_of(&f.scene.lights, t, &count);
        assert_in_range(count, 2, 8);
        (global ? read_globals : read_constants)(&f, row, read, count);
        for (int i = 0; i < count; i++)
            check_same(&f, row, &read[i], &light[i]);
    }
    end(&f);
}

static void the_text_holds_the_floats_of_the_scene(void **state)
{
    (void)state;
    static const char *const placed[] = {
        "ambient=per_light loop=padded", "scale=1e-6 attenuation=radius cone=linear",
        "scale=1e6 offset=1e12 cone=exponent", "offset=0.1 scale=0.3 hoist=per_light"};
    for (int i = 0; i < sb_scene_row_count; i++)
        for (int p = 0; p < 4; p++)
            for (int global = 0; global < 2; global++) {
                char words[128];
                snprintf(words, sizeof words, "storage=%s %s %s",
                         global ? "global" : "constant", mixed, placed[p]);
                check_scene(sb_scene_rows[i].name, words);
            }
}

// The product of the view matrix and (v, w), of a rotation and a shift that hardly cancel.
static void check_view(const struct sb_camera *camera, const float world[3], int w,
                       const float view[3])
{
    for (int row = 0; row < 3; row++) {
        long double sum = (long double)camera->view[12 + row] * w;
        for (int k = 0; k < 3; k++)
            sum += (long double)camera->view[4 * k + row] * world[k];
        check_close(view[row], (double)sum, fabs((double)sum) * 1e-7 + 1e-12);
    }
}

static void with_space_view_the_lights_are_in_view_space(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "containers",
          "storage=constant space=view dir=2 point=3 spot=2 area=2 "
          "area_shape=capsule");
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        struct sb_light read[8];
        int count;
        const struct sb_light *light = sb_lights_of(&f.scene.lights, t, &count);
        read_constants(&f, &sb_light_structs[t], read, count);
        for (int i = 0; i < count; i++) {
            if (t != SB_LIGHT_DIR)
                check_view(&f.scene.camera, light[i].position, 1, read[i].position);
            if (t != SB_LIGHT_POINT)
                check_view(&f.scene.camera, light[i].direction, 0, read[i].direction);
            struct sb_light back = read[i]; // nothing else has changed
            memcpy(back.position, light[i].position, sizeof back.position);
            memcpy(back.direction, light[i].direction, sizeof back.direction);
            check_same(&f, &sb_light_structs[t], &back, &light[i]);
        }
    }
    end(&f);
}

static void unified_lights_stand_in_one_array_and_say_what_they_are(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "sphere", "storage=constant layout=unified dir=1 point=2 spot=1");
    struct sb_light read[4];
    read_constants(&f, &sb_light_structs[SB_LIGHT_UNIFIED], read, 4);
    for (int i = 0; i < 4; i++) {
        const struct sb_light *light = &f.scene.lights.light[i];
        assert_true(read[i].w == (i == 0 ? 0 : 1));
        const float *d = light->direction; // of any length
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int c = 0; c < 3; c++) {
            assert_true(read[i].diffuse[c] == light->diffuse[c]);
            check_close(read[i].position[c], i == 0 ? -d[c] / length : light->position[c],
                        1e-6);
        }
        assert_true(read[i].cos_cutoff == (i == 3 ? light->cos_cutoff : -1));
    }
    assert_null(strstr(f.glsl, "\nconst PointLight"));
    end(&f);
}

static void free_slots_are_off(void **state)
{
    (void)state;
    static const struct sb_light off = {0};
    struct sb_light read[8];
    struct fixture f;
    begin(&f, "sphere", "storage=constant loop=padded capacity=3 dir=2 point=1 sun=100");
    const struct sb_light_struct *row = &sb_light_structs[SB_LIGHT_POINT];
    read_constants(&f, row, read, 3);
    assert_true(read[0].intensity > 0);
    check_same(&f, row, &read[1], &off);
    check_same(&f, row, &read[2], &off);
    row = &sb_light_structs[SB_LIGHT_DIR]; // at night the sun's slot is left
    read_constants(&f, row, read, 2);
    assert_true(read[0].intensity > 0);
    check_same(&f, row, &read[1], &off);
    end(&f);

    begin(&f, "sphere",
          "storage=global loop=dynamic layout=unified capacity=5 dir=1 point=1 spot=1");
    row = &sb_light_structs[SB_LIGHT_UNIFIED];
    read_globals(&f, row, read, 5); // the free ones behind all lights
    for (int i = 0; i < 5; i++)
        assert_true((read[i].diffuse[0] > 0) == (i < 3));
    check_same(&f, row, &read[4], &off);
    end(&f);
}

// Of the draws that are lit.
static bool one_material(const struct sb_scene *scene)
{
    int first = -1;
    for (int i = 0; i < scene->draw_count; i++) {
        if (scene->draw[i].lamp >= 0)
            continue;
        if (first >= 0 && scene->draw[i].material != first)
            return false;
        first = scene->draw[i].material;
    }
    return true;
}

static void a_material_that_all_share_is_in_the_text_too(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct fixture f;
        begin(&f, sb_scene_rows[i].name, "storage=constant point=1 lamps=on");
        const struct sb_material *m = &f.scene.material[f.scene.draw[0].material];
        const char *head = "const Material u_material = Material(";
        const char *at = strstr(f.glsl, head);
        const bool shared = one_material(&f.scene);
        assert_int_equal(at != NULL, shared);
        assert_int_equal(strstr(f.glsl, "uniform Material u_material;") != NULL, !shared);
        const float *const wanted[] = {m->ambient, m->diffuse, m->specular};
        at = shared ? at + strlen(head) : NULL;
        for (int c = 0; shared && c < 9; c++) {
            float value;
            at = read_float(at + strspn(at, "vec3(), "), &value);
            assert_true(value == wanted[c / 3][c % 3]);
        }
        float shininess;
        if (shared)
            expect(read_float(expect(at, "), "), &shininess), ");\n");
        assert_true(!shared || shininess == m->shininess);
        end(&f);
    }
}

static void no_light_at_all_is_no_array(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f, "sphere", "storage=global");
    check_contains(f.glsl, "void fill_lights()\n{\n    u_material = Material(");
    for (int i = 0; i < SB_LIGHT_STRUCT_COUNT; i++) {
        char name[32];
        snprintf(name, sizeof name, "\n%s %s[0]", sb_light_structs[i].type,
                 sb_light_structs[i].array);
        assert_null(strstr(f.glsl, name));
    }
    end(&f);
}

static void a_scene_that_is_none_is_refused(void **state)
{
    (void)state;
    const struct assembling from = {.words = "storage=constant", .scene = "sphre"};
    struct sb_assembly assembly;
    struct sb_error err = {0};
    assert_false(assemble_from(&from, &assembly, &err));
    check_contains(err.text, "did you mean \"sphere\"?");
    sb_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_text_holds_the_floats_of_the_scene),
        cmocka_unit_test(with_space_view_the_lights_are_in_view_space),
        cmocka_unit_test(unified_lights_stand_in_one_array_and_say_what_they_are),
        cmocka_unit_test(free_slots_are_off),
        cmocka_unit_test(a_material_that_all_share_is_in_the_text_too),
        cmocka_unit_test(no_light_at_all_is_no_array),
        cmocka_unit_test(a_scene_that_is_none_is_refused),
    };
    return run_tests(tests);
}
