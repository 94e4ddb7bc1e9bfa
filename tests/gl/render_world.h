// A scene for the tests of uniforms: a triangle that covers the whole target, and lights whose
// floats all differ; and a program that shows each of them in a pixel of its own.
#pragma once

#include "gl_test.h"
#include "render/render.h"
#include "render_shaders.h"
#include "test.h"

enum { DIR = 2, POINT = 4, SPOT = 2, AREA = 2, LIGHTS = DIR + POINT + SPOT + AREA };
enum { MEMBERS_MAX = 256 };

static struct sb_caps caps;

struct world {
    struct sb_vertex vertex[3];
    struct sb_mesh mesh;
    struct sb_material material;
    struct sb_draw draw;
    struct sb_light light[LIGHTS];
    struct sb_scene scene;
};

static inline void number(void *floats, size_t size, float *next)
{
    float *value = floats;
    for (size_t i = 0; i < size / sizeof *value; i++)
        value[i] = (*next)++;
}

static inline void world_make(struct world *world)
{
    static const uint32_t index[3] = {0, 1, 2};
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    *world = (struct world){
        .vertex = {{.position = {-1, -1, 0}},
                   {.position = {3, -1, 0}},
                   {.position = {-1, 3, 0}}},
    };
    float next = 1;
    number(world->light, sizeof world->light, &next);
    memcpy(world->draw.model, identity, sizeof identity);
    world->draw.lamp = -1;
    memcpy(world->scene.camera.view, identity, sizeof identity);
    memcpy(world->scene.camera.view_projection, identity, sizeof identity);
    world->mesh = (struct sb_mesh){
        .vertex = world->vertex, .index = index, .vertex_count = 3, .index_count = 3};
    world->scene.name = "triangle";
    world->scene.mesh = &world->mesh;
    world->scene.material = &world->material;
    world->scene.draw = &world->draw;
    world->scene.mesh_count = world->scene.material_count = world->scene.draw_count = 1;
    world->scene.lights = (struct sb_lights){world->light, {DIR, POINT, SPOT, AREA}};
}

struct fixture {
    struct world world;
    struct sb_variant variant;
    struct sb_upload upload;
    struct sb_gl_program program;
    struct sb_binding binding;
    struct sb_target target;
};

// World and variant, for the test to change before fixture_make.
static inline void fixture_init(struct fixture *fixture)
{
    *fixture = (struct fixture){0};
    world_make(&fixture->world);
    sb_variant_init(sb_axes_builtin(), &fixture->variant);
}

static inline void fixture_make(struct fixture *fixture, const char *vertex,
                                const char *fragment)
{
    const struct sb_target_params target = {MEMBERS_MAX, 1, 1, SB_GL_RGBA32F};
    const struct sb_program source = {.vertex = vertex, .fragment = fragment};
    struct sb_error err = {0};
    sb_upload_make(&fixture->upload, &fixture->world.scene);
    if (!sb_gl_program_make(&source, &fixture->program))
        fail_msg("%s\n%s", fixture->program.log, fragment);
    // Whatever binding points the program starts out with.
    GLint blocks = 0;
    glGetProgramiv(fixture->program.name, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLint i = 0; i < blocks; i++)
        glUniformBlockBinding(fixture->program.name, (GLuint)i, 3);
    const struct sb_binding_params params = {
        .program = fixture->program.name,
        .upload = &fixture->upload,
        .variant = &fixture->variant,
    };
    assert_true(sb_binding_make(&fixture->binding, &params, &err));
    if (!sb_target_make(&fixture->target, &caps, &target, &err))
        fail_msg("%s", err.text);
}

static inline void fixture_free(struct fixture *fixture)
{
    assert_null(sb_gl_error());
    sb_target_free(&fixture->target);
    sb_binding_free(&fixture->binding);
    sb_gl_program_free(&fixture->program);
    sb_upload_free(&fixture->upload);
}

static inline int64_t draw_frame(const struct fixture *fixture, int phase)
{
    return sb_frame_draw(&(struct sb_frame_params){
        .binding = &fixture->binding,
        .target = &fixture->target,
        .layers = 1,
        .phase = phase,
        .gles = caps.gles,
    });
}

static inline void read_target(const struct fixture *fixture, struct sb_image *image)
{
    struct sb_error err = {0};
    if (!sb_target_read(&fixture->target, image, &err))
        fail_msg("%s", err.text);
}

// The program whose pixel i shows the i-th member of all lights declared.
static inline void fixture_make_members(struct fixture *fixture,
                                        const struct light_text *lights)
{
    struct sb_text vertex = {0}, text = {0};
    add_vertex_shader(&vertex, caps.gles);
    add_version(&text, caps.gles);
    add_lights(&text, lights);
    sb_text_add(&text, "out vec4 o_color;\nvoid main()\n{\n"
                       "    int x = int(gl_FragCoord.x);\n    o_color = vec4(0.0);\n");
    int pixel = 0;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
        const struct sb_light_struct *row = &sb_light_structs[s];
        for (int i = 0; i < lights->count[s]; i++) {
            for (int f = 0; f < row->field_count; f++) {
                const bool vector = row->field[f].components == 3;
                sb_text_printf(&text, "    if (x == %d) o_color.%s = ", pixel++,
                               vector ? "xyz" : "x");
                add_member(&text, lights, s, i, &row->field[f]);
                sb_text_add(&text, ";\n");
            }
        }
    }
    sb_text_add(&text, "}\n");
    assert_in_range(pixel, 1, MEMBERS_MAX);
    fixture_make(fixture, vertex.data, text.data);
    sb_text_free(&vertex);
    sb_text_free(&text);
}

// What the program of fixture_make_members shows are these lights: `want` has as many of
// each struct as were declared, at least.
static inline void check_members(const struct fixture *fixture,
                                 const struct light_text *lights,
                                 const struct sb_light *const want[SB_LIGHT_STRUCT_COUNT])
{
    struct sb_image image;
    draw_frame(fixture, -1);
    read_target(fixture, &image);
    int pixel = 0;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
        const struct sb_light_struct *row = &sb_light_structs[s];
        for (int i = 0; i < lights->count[s]; i++) {
            for (int f = 0; f < row->field_count; f++, pixel++) {
                const struct sb_light_field *field = &row->field[f];
                const float *truth =
                    (const void *)((const char *)&want[s][i] + field->offset);
                for (int c = 0; c < field->components; c++) {
                    if (sb_image_at(&image, pixel, 0)[c] != truth[c])
                        fail_msg("storage %d: %s[%d].%s[%d] is %g, not %g",
                                 lights->storage, row->array, i, field->name, c,
                                 sb_image_at(&image, pixel, 0)[c], truth[c]);
                }
            }
        }
    }
    sb_image_free(&image);
}

static inline void want_lists(const struct sb_light *want[SB_LIGHT_STRUCT_COUNT],
                              const struct sb_lights *lights)
{
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        int count;
        want[type] = sb_lights_of(lights, type, &count);
    }
    want[SB_LIGHT_UNIFIED] = lights->light;
}

static inline int run_with_context(const struct CMUnitTest *tests, size_t count)
{
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const int failed = _cmocka_run_group_tests("render", tests, count, NULL, NULL);
    gl_test_close(&test);
    return failed;
}
