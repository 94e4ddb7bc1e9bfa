// Everything that docs/glsl.md promises arrives where the shader reads it: each value is
// written to a pixel of its own and compared with the C struct.
#include "gl_test.h"
#include "render/render.h"
#include "render_shaders.h"
#include "test.h"

enum { DIR = 2, POINT = 3, SPOT = 2, FIELDS_MAX = 128 };

static struct sb_caps caps;

// A triangle that covers the whole target, and lights whose floats all differ.
struct world {
    struct sb_vertex vertex[3];
    struct sb_mesh mesh;
    struct sb_material material;
    struct sb_draw draw;
    struct sb_dir_light dir[DIR];
    struct sb_point_light point[POINT];
    struct sb_spot_light spot[SPOT];
    struct sb_scene scene;
};

static void number(void *floats, size_t size, float *next)
{
    float *value = floats;
    for (size_t i = 0; i < size / sizeof *value; i++)
        value[i] = (*next)++;
}

static void world_make(struct world *world)
{
    static const uint32_t index[3] = {0, 1, 2};
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    *world = (struct world){
        .vertex = {{.position = {-1, -1, 0}},
                   {.position = {3, -1, 0}},
                   {.position = {-1, 3, 0}}},
    };
    float next = 1;
    number(world->dir, sizeof world->dir, &next);
    number(world->point, sizeof world->point, &next);
    number(world->spot, sizeof world->spot, &next);
    memcpy(world->draw.model, identity, sizeof identity);
    memcpy(world->scene.camera.view_projection, identity, sizeof identity);
    world->mesh = (struct sb_mesh){world->vertex, index, 3, 3};
    world->scene.name = "triangle";
    world->scene.mesh = &world->mesh;
    world->scene.material = &world->material;
    world->scene.draw = &world->draw;
    world->scene.mesh_count = world->scene.material_count = world->scene.draw_count = 1;
    world->scene.lights =
        (struct sb_lights){world->dir, world->point, world->spot, DIR, POINT, SPOT};
}

// Pixel i shows the i-th member of all lights that `counts` declares.
static void fragment_shader(struct sb_text *text, const int counts[SB_LIGHT_TYPE_COUNT],
                            bool block)
{
    add_version(text, caps.gles);
    add_lights(text, counts, block);
    sb_text_add(text, "out vec4 o_color;\nvoid main()\n{\n"
                      "    int x = int(gl_FragCoord.x);\n    o_color = vec4(0.0);\n");
    int pixel = 0;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        for (int i = 0; i < counts[type]; i++) {
            for (int f = 0; f < row->field_count; f++)
                sb_text_printf(text, "    if (x == %d) o_color = vec4(%s%s[%d].%s%s);\n",
                               pixel++, row->field[f].components == 1 ? "vec3(" : "",
                               row->array, i, row->field[f].name,
                               row->field[f].components == 1 ? "), 1.0" : ", 1.0");
        }
    }
    sb_text_add(text, "}\n");
}

struct fixture {
    struct world world;
    struct sb_upload upload;
    struct sb_gl_program program;
    struct sb_binding binding;
    struct sb_target target;
};

static void fixture_make(struct fixture *fixture, const int counts[SB_LIGHT_TYPE_COUNT],
                         bool block)
{
    struct sb_error err = {0};
    struct sb_text vertex = {0}, fragment = {0};
    *fixture = (struct fixture){0};
    world_make(&fixture->world);
    add_vertex_shader(&vertex, caps.gles);
    fragment_shader(&fragment, counts, block);
    sb_upload_make(&fixture->upload, &fixture->world.scene);
    if (!sb_gl_program_make(vertex.data, fragment.data, &fixture->program))
        fail_msg("%s\n%s", fixture->program.log, fragment.data);
    if (block) // whatever binding point the program starts out with
        glUniformBlockBinding(fixture->program.name, 0, 3);
    assert_true(sb_binding_make(&fixture->binding, fixture->program.name,
                                &fixture->upload, &err));
    if (!sb_target_make(&fixture->target, &caps, FIELDS_MAX, 1, SB_GL_RGBA32F, &err))
        fail_msg("%s", err.text);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
}

static void fixture_free(struct fixture *fixture)
{
    assert_null(sb_gl_error());
    sb_target_free(&fixture->target);
    sb_binding_free(&fixture->binding);
    sb_gl_program_free(&fixture->program);
    sb_upload_free(&fixture->upload);
}

static void draw_frame(const struct fixture *fixture)
{
    sb_frame_draw(&(struct sb_frame_params){
        .binding = &fixture->binding,
        .target = &fixture->target,
        .layers = 1,
        .gles = caps.gles,
    });
}

static bool is_colour(const char *name)
{
    return !strcmp(name, "ambient") || !strcmp(name, "diffuse") ||
           !strcmp(name, "specular");
}

// Draws, and compares with the structs; the colours of lights [first, first + count) of
// the list of declared lights are to be black.
static void check_lights(struct fixture *fixture, const int counts[SB_LIGHT_TYPE_COUNT],
                         int first, int count)
{
    struct sb_image image = {0};
    struct sb_error err = {0};
    draw_frame(fixture);
    assert_true(sb_target_read(&fixture->target, &image, &err));
    int pixel = 0, place = 0;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        int all;
        const char *light = sb_lights_of(&fixture->world.scene.lights, type, &all);
        for (int i = 0; i < all; i++, place++, light += row->size) {
            if (i >= counts[type])
                continue;
            const bool off = place >= first && place < first + count;
            for (int f = 0; f < row->field_count; f++, pixel++) {
                const struct sb_light_field *field = &row->field[f];
                const float *truth = (const void *)(light + field->offset);
                for (int c = 0; c < field->components; c++) {
                    const float want = off && is_colour(field->name) ? 0 : truth[c];
                    if (sb_image_at(&image, pixel, 0)[c] != want)
                        fail_msg("%s[%d].%s[%d] is %g, not %g", row->array, i,
                                 field->name, c, sb_image_at(&image, pixel, 0)[c], want);
                }
            }
        }
    }
    assert_in_range(pixel, 1, FIELDS_MAX);
    sb_image_free(&image);
}

static void every_member_of_every_light_arrives_as_a_uniform(void **state)
{
    (void)state;
    static const int all[] = {DIR, POINT, SPOT};
    struct fixture fixture;
    fixture_make(&fixture, all, false);
    assert_int_equal(fixture.binding.buffer, 0);
    check_lights(&fixture, all, 0, 0);
    fixture_free(&fixture);
}

static void every_member_of_every_light_arrives_in_a_std140_block(void **state)
{
    (void)state;
    static const int all[] = {DIR, POINT, SPOT};
    struct fixture fixture;
    fixture_make(&fixture, all, true);
    assert_int_not_equal(fixture.binding.buffer, 0);
    check_lights(&fixture, all, 0, 0);
    fixture_free(&fixture);
}

static void the_c_structs_have_the_layout_of_the_std140_block(void **state)
{
    (void)state;
    static const int all[] = {DIR, POINT, SPOT};
    struct fixture fixture;
    fixture_make(&fixture, all, true);
    const struct world *world = &fixture.world;
    const unsigned char *block = fixture.binding.block;
    assert_int_equal(fixture.binding.block_size,
                     sizeof world->dir + sizeof world->point + sizeof world->spot);
    assert_memory_equal(block, world->dir, sizeof world->dir);
    assert_memory_equal(block + sizeof world->dir, world->point, sizeof world->point);
    assert_memory_equal(block + sizeof world->dir + sizeof world->point, world->spot,
                        sizeof world->spot);
    fixture_free(&fixture);
}

static void a_program_with_fewer_lights_gets_the_first_of_each_type(void **state)
{
    (void)state;
    static const int fewer[][SB_LIGHT_TYPE_COUNT] = {
        {1, 2, 1}, {0, 3, 0}, {0, 0, 2}, {2, 0, 1}};
    for (size_t i = 0; i < sizeof fewer / sizeof *fewer; i++) {
        for (int block = 0; block < 2; block++) {
            struct fixture fixture;
            fixture_make(&fixture, fewer[i], block);
            check_lights(&fixture, fewer[i], 0, 0);
            fixture_free(&fixture);
        }
    }
}

static void lights_that_are_off_are_black_and_come_back(void **state)
{
    (void)state;
    static const int all[] = {DIR, POINT, SPOT};
    for (int block = 0; block < 2; block++) {
        struct fixture fixture;
        fixture_make(&fixture, all, block);
        for (int first = 0; first < DIR + POINT + SPOT; first++) {
            for (int count = 1; first + count <= DIR + POINT + SPOT; count++) {
                sb_binding_lights(&fixture.binding, first, count);
                check_lights(&fixture, all, first, count);
            }
        }
        sb_binding_lights(&fixture.binding, 0, 0);
        check_lights(&fixture, all, 0, 0);
        fixture_free(&fixture);
    }
}

static const char attributes_vertex[] =
    "in vec3 a_position;\n"
    "in vec3 a_normal;\n"
    "in vec2 a_uv;\n"
    "in vec4 a_tangent;\n"
    "uniform mat4 u_model;\n"
    "uniform mat4 u_view_projection;\n"
    "flat out vec3 v_normal;\n"
    "flat out vec2 v_uv;\n"
    "flat out vec4 v_tangent;\n"
    "void main()\n"
    "{\n"
    "    v_normal = a_normal;\n"
    "    v_uv = a_uv;\n"
    "    v_tangent = a_tangent;\n"
    "    gl_Position = u_view_projection * (u_model * vec4(a_position, 1.0));\n"
    "}\n";

static const char all_values_fragment[] =
    "struct material { vec3 ambient, diffuse, specular; float shininess; };\n"
    "uniform material u_material;\n"
    "uniform mat4 u_model;\n"
    "uniform mat3 u_normal_matrix;\n"
    "uniform mat4 u_view_projection;\n"
    "uniform vec3 u_camera_position;\n"
    "uniform vec3 u_scene_ambient;\n"
    "flat in vec3 v_normal;\n"
    "flat in vec2 v_uv;\n"
    "flat in vec4 v_tangent;\n"
    "out vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    int x = int(gl_FragCoord.x);\n"
    "    o_color = vec4(0.0);\n"
    "    if (x < 4) o_color = u_model[x];\n"
    "    else if (x < 8) o_color = u_view_projection[x - 4];\n"
    "    else if (x < 11) o_color.xyz = u_normal_matrix[x - 8];\n"
    "    else if (x == 11) o_color.xyz = u_camera_position;\n"
    "    else if (x == 12) o_color.xyz = u_scene_ambient;\n"
    "    else if (x == 13) o_color.xyz = u_material.ambient;\n"
    "    else if (x == 14) o_color.xyz = u_material.diffuse;\n"
    "    else if (x == 15) o_color.xyz = u_material.specular;\n"
    "    else if (x == 16) o_color.x = u_material.shininess;\n"
    "    else if (x == 17) o_color.xyz = v_normal;\n"
    "    else if (x == 18) o_color.xy = v_uv;\n"
    "    else if (x == 19) o_color = v_tangent;\n"
    "}\n";

// Other matrices than the identity that still cover the target, and numbers for the rest.
static void world_number(struct world *world)
{
    float next = 1000;
    static const float model[16] = {2, 0, 0, 0, 0, 4, 0, 0, 0, 0, 8, 0, 0, 0, 0, 1};
    static const float halved[16] = {0.5f, 0, 0,      0, 0, 0.25f, 0, 0,
                                     0,    0, 0.125f, 0, 0, 0,     0, 1};
    memcpy(world->draw.model, model, sizeof model);
    memcpy(world->scene.camera.view_projection, halved, sizeof halved);
    number(world->draw.normal_matrix, sizeof world->draw.normal_matrix, &next);
    number(world->scene.camera.eye, sizeof world->scene.camera.eye, &next);
    number(world->scene.ambient, sizeof world->scene.ambient, &next);
    number(&world->material, sizeof world->material, &next);
    struct sb_vertex *vertex = world->vertex;
    number(vertex[0].normal, sizeof vertex[0].normal, &next);
    number(vertex[0].uv, sizeof vertex[0].uv, &next);
    number(vertex[0].tangent, sizeof vertex[0].tangent, &next);
    for (int i = 1; i < 3; i++) {
        memcpy(vertex[i].normal, vertex[0].normal, sizeof vertex[0].normal);
        memcpy(vertex[i].uv, vertex[0].uv, sizeof vertex[0].uv);
        memcpy(vertex[i].tangent, vertex[0].tangent, sizeof vertex[0].tangent);
    }
}

static void every_attribute_and_every_other_uniform_arrives(void **state)
{
    (void)state;
    static const int none[SB_LIGHT_TYPE_COUNT] = {0};
    struct fixture fixture;
    struct sb_text vertex = {0}, fragment = {0};
    struct sb_image image;
    struct sb_error err = {0};
    fixture_make(&fixture, none, false);
    sb_binding_free(&fixture.binding);
    sb_upload_free(&fixture.upload);
    sb_gl_program_free(&fixture.program);
    world_number(&fixture.world);
    sb_upload_make(&fixture.upload, &fixture.world.scene);
    add_version(&vertex, caps.gles);
    sb_text_add(&vertex, attributes_vertex);
    add_version(&fragment, caps.gles);
    sb_text_add(&fragment, all_values_fragment);
    if (!sb_gl_program_make(vertex.data, fragment.data, &fixture.program))
        fail_msg("%s", fixture.program.log);
    assert_true(
        sb_binding_make(&fixture.binding, fixture.program.name, &fixture.upload, &err));
    draw_frame(&fixture);
    assert_true(sb_target_read(&fixture.target, &image, &err));

    const struct world *world = &fixture.world;
    const struct {
        const float *value;
        int count, components; // count pixels of so many components
    } want[] = {
        {world->draw.model, 4, 4},          {world->scene.camera.view_projection, 4, 4},
        {world->draw.normal_matrix, 3, 3},  {world->scene.camera.eye, 1, 3},
        {world->scene.ambient, 1, 3},       {world->material.ambient, 1, 3},
        {world->material.diffuse, 1, 3},    {world->material.specular, 1, 3},
        {&world->material.shininess, 1, 1}, {world->vertex[0].normal, 1, 3},
        {world->vertex[0].uv, 1, 2},        {world->vertex[0].tangent, 1, 4},
    };
    int pixel = 0;
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        for (int j = 0; j < want[i].count * want[i].components; j++)
            check_close(sb_image_at(&image, pixel + j / want[i].components,
                                    0)[j % want[i].components],
                        want[i].value[j], 0);
        pixel += want[i].count;
    }
    assert_int_equal(pixel, 20);
    sb_image_free(&image);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    fixture_free(&fixture);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_member_of_every_light_arrives_as_a_uniform),
        cmocka_unit_test(every_member_of_every_light_arrives_in_a_std140_block),
        cmocka_unit_test(the_c_structs_have_the_layout_of_the_std140_block),
        cmocka_unit_test(a_program_with_fewer_lights_gets_the_first_of_each_type),
        cmocka_unit_test(lights_that_are_off_are_black_and_come_back),
        cmocka_unit_test(every_attribute_and_every_other_uniform_arrives),
    };
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
