// Lamps, drawn unlit with a program of their own, and pixels of several samples.
#include "gl_test.h"
#include "render/render.h"
#include "render_shaders.h"
#include "test.h"

enum { SIZE = 16, DRAWS = 3, POINTS = 2 };

static struct sb_caps caps;

// Upright bars from left to right, the middle one reaching half a pixel to the right; the
// outer ones show lamps.
struct world {
    struct sb_vertex vertex[4];
    struct sb_mesh mesh;
    struct sb_material material;
    struct sb_draw draw[DRAWS];
    struct sb_light light[1 + POINTS];
    struct sb_scene scene;
};
static const float edges[DRAWS][2] = {{-1, -0.5f}, {-0.5f, 0.0625f}, {0.5f, 1}};
static const int lamps[DRAWS] = {1, -1, 0};
static const float background[4] = {0, 0, 0, 1};

static void world_make(struct world *world)
{
    static const uint32_t index[6] = {0, 1, 2, 0, 2, 3};
    static const float corner[4][2] = {{0, -1}, {1, -1}, {1, 1}, {0, 1}};
    *world = (struct world){.material.diffuse = {0.2f, 0.4f, 0.6f}};
    for (int i = 0; i < 4; i++) {
        memcpy(world->vertex[i].position, corner[i], sizeof corner[i]);
        world->scene.camera.view_projection[5 * i] = 1;
    }
    for (int i = 0; i < DRAWS; i++) {
        struct sb_draw *draw = &world->draw[i];
        draw->lamp = lamps[i];
        draw->model[0] = edges[i][1] - edges[i][0];
        draw->model[12] = edges[i][0];
        draw->model[5] = draw->model[10] = draw->model[15] = 1;
    }
    for (int i = 0; i <= POINTS; i++) {
        for (int c = 0; c < 3; c++)
            world->light[i].diffuse[c] = (float)(3 * i + c + 1);
    }
    world->mesh = (struct sb_mesh){
        .vertex = world->vertex, .index = index, .vertex_count = 4, .index_count = 6};
    memcpy(world->scene.clear_colour, background, sizeof background);
    world->scene.name = "bars";
    world->scene.mesh = &world->mesh;
    world->scene.material = &world->material;
    world->scene.draw = world->draw;
    world->scene.lights =
        (struct sb_lights){world->light, {[SB_LIGHT_DIR] = 1, [SB_LIGHT_POINT] = POINTS}};
    world->scene.mesh_count = world->scene.material_count = 1;
    world->scene.draw_count = DRAWS;
}

static const char lit_fragment[] = "struct material { vec3 diffuse; };\n"
                                   "uniform material u_material;\n"
                                   "out vec4 o_color;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    o_color = vec4(u_material.diffuse, 1.0);\n"
                                   "}\n";
static const char lamp_fragment[] = "uniform vec3 u_lamp_colour;\n"
                                    "out vec4 o_color;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    o_color = vec4(u_lamp_colour, 1.0);\n"
                                    "}\n";

struct fixture {
    struct world world;
    struct sb_variant variant;
    struct sb_upload upload;
    struct sb_gl_program lit, lamp;
    struct sb_binding lit_binding, lamp_binding;
    struct sb_ring ring;
};

static void bind_program(struct sb_binding *binding, const struct fixture *fixture,
                         struct sb_gl_program *program, const char *body)
{
    struct sb_error err = {0};
    struct sb_text vertex = {0}, fragment = {0};
    add_vertex_shader(&vertex, caps.gles);
    add_version(&fragment, caps.gles);
    sb_text_add(&fragment, body);
    const struct sb_program source = {.vertex = vertex.data, .fragment = fragment.data};
    if (!sb_gl_program_make(&source, program))
        fail_msg("%s", program->log);
    const struct sb_binding_params params = {
        .program = program->name,
        .upload = &fixture->upload,
        .variant = &fixture->variant,
    };
    assert_true(sb_binding_make(binding, &params, &err));
    sb_text_free(&vertex);
    sb_text_free(&fragment);
}

// False where the driver has no such targets.
static bool fixture_make(struct fixture *fixture, enum sb_gl_format format, int samples)
{
    const struct sb_shape shape = {SIZE, SIZE, format, samples, 1};
    struct sb_error err = {0};
    *fixture = (struct fixture){0};
    sb_variant_init(sb_axes_builtin(), &fixture->variant);
    world_make(&fixture->world);
    if (!sb_ring_make(&fixture->ring, &caps, &shape, &err)) {
        assert_int_equal(err.status, SB_OVER_LIMIT);
        sb_ring_free(&fixture->ring);
        return false;
    }
    sb_upload_make(&fixture->upload, &fixture->world.scene);
    bind_program(&fixture->lit_binding, fixture, &fixture->lit, lit_fragment);
    bind_program(&fixture->lamp_binding, fixture, &fixture->lamp, lamp_fragment);
    return true;
}

static void fixture_free(struct fixture *fixture)
{
    assert_null(sb_gl_error());
    sb_ring_free(&fixture->ring);
    sb_binding_free(&fixture->lit_binding);
    sb_binding_free(&fixture->lamp_binding);
    sb_gl_program_free(&fixture->lit);
    sb_gl_program_free(&fixture->lamp);
    sb_upload_free(&fixture->upload);
}

static int64_t draw_frame(const struct fixture *fixture, int layers)
{
    return sb_frame_draw(&(struct sb_frame_params){
        .binding = &fixture->lit_binding,
        .lamp = &fixture->lamp_binding,
        .target = &fixture->ring.target[0],
        .layers = layers,
        .phase = -1,
        .gles = caps.gles,
    });
}

// Column x of every row, where a pixel is of one colour.
static void check_column(const struct sb_image *image, int x, const float *want)
{
    for (int y = 0; y < SIZE; y++) {
        for (int c = 0; c < 3; c++)
            check_close(sb_image_at(image, x, y)[c], want[c], 0);
    }
}

static void check_bars(const struct fixture *fixture, struct sb_image *image)
{
    struct sb_error err = {0};
    assert_true(sb_target_read(&fixture->ring.target[0], image, &err));
    for (int x = 0; x < 4; x++) // the second point light's colour
        check_column(image, x, (const float[]){7, 8, 9});
    for (int x = 4; x < 8; x++)
        check_column(image, x, fixture->world.material.diffuse);
    for (int x = 9; x < 12; x++)
        check_column(image, x, background);
    for (int x = 12; x < SIZE; x++)
        check_column(image, x, (const float[]){4, 5, 6});
}

static void lamps_have_the_colour_of_their_light_whatever_is_uploaded(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    assert_true(fixture_make(&fixture, SB_GL_RGBA32F, 1));
    sb_binding_lights(&fixture.lit_binding, 0, 1 + POINTS); // black
    draw_frame(&fixture, 2);
    check_bars(&fixture, &image);
    sb_image_free(&image);
    fixture_free(&fixture);
}

static GLuint programs_seen[16];
static int draws_seen;
static PFNGLDRAWELEMENTSPROC real_draw;
static PFNGLUSEPROGRAMPROC real_use;
static int switches_seen;

static void GLAD_API_PTR see_draw(GLenum mode, GLsizei count, GLenum type, const void *at)
{
    GLint program;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    if (draws_seen < 16)
        programs_seen[draws_seen] = (GLuint)program;
    draws_seen++;
    real_draw(mode, count, type, at);
}

static void GLAD_API_PTR see_use(GLuint program)
{
    switches_seen++;
    real_use(program);
}

static void lamps_follow_the_lit_draws_after_one_change_of_program(void **state)
{
    (void)state;
    struct fixture fixture;
    assert_true(fixture_make(&fixture, SB_GL_RGBA8, 1));
    const GLuint lit = fixture.lit.name, lamp = fixture.lamp.name;
    const GLuint order[] = {lit, lit, lamp, lamp, lamp, lamp};
    real_draw = glad_glDrawElements;
    real_use = glad_glUseProgram;
    glad_glDrawElements = see_draw;
    glad_glUseProgram = see_use;
    draws_seen = switches_seen = 0;
    draw_frame(&fixture, 2);
    glad_glDrawElements = real_draw;
    glad_glUseProgram = real_use;
    assert_int_equal(draws_seen, 2 * DRAWS);
    assert_memory_equal(programs_seen, order, sizeof order);
    assert_int_equal(switches_seen, 2);
    fixture_free(&fixture);
}

static void without_a_lamp_program_one_program_draws_all(void **state)
{
    (void)state;
    struct fixture fixture;
    assert_true(fixture_make(&fixture, SB_GL_RGBA8, 1));
    real_draw = glad_glDrawElements;
    glad_glDrawElements = see_draw;
    draws_seen = 0;
    sb_frame_draw(&(struct sb_frame_params){
        .binding = &fixture.lit_binding,
        .target = &fixture.ring.target[0],
        .layers = 1,
        .phase = -1,
        .gles = caps.gles,
    });
    glad_glDrawElements = real_draw;
    assert_int_equal(draws_seen, DRAWS);
    fixture_free(&fixture);
}

// The middle bar ends in the middle of column 8.
static void a_pixel_at_an_edge_is_a_mixture_where_it_has_several_samples(void **state)
{
    (void)state;
    static const enum sb_gl_format formats[] = {SB_GL_RGBA16F, SB_GL_RGBA32F};
    int tried = 0;
    for (int i = 0; i < 2; i++) {
        struct fixture fixture;
        struct sb_image image;
        if (!fixture_make(&fixture, formats[i], 4))
            continue;
        fixture.world.material.diffuse[0] = 0.25f; // exact in halves
        fixture.world.material.diffuse[1] = 0.5f;
        fixture.world.material.diffuse[2] = 0.75f;
        const int64_t calls = draw_frame(&fixture, 1);
        check_bars(&fixture, &image);
        // Where the samples lie is the driver's choice: a quarter, a half or three.
        const double share = 4 * sb_image_at(&image, 8, 0)[0] / 0.25;
        assert_true(share == 1 || share == 2 || share == 3);
        for (int y = 0; y < SIZE; y++) {
            for (int c = 0; c < 3; c++)
                check_close(sb_image_at(&image, 8, y)[c],
                            share / 4 * fixture.world.material.diffuse[c], 0);
        }
        sb_image_free(&image);
        fixture_free(&fixture);

        // The resolve is the only difference in calls.
        assert_true(fixture_make(&fixture, formats[i], 1));
        assert_int_equal(draw_frame(&fixture, 1) + 3, calls);
        fixture_free(&fixture);
        tried++;
    }
    if (tried == 0)
        skip();
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_have_the_colour_of_their_light_whatever_is_uploaded),
        cmocka_unit_test(lamps_follow_the_lit_draws_after_one_change_of_program),
        cmocka_unit_test(without_a_lamp_program_one_program_draws_all),
        cmocka_unit_test(a_pixel_at_an_edge_is_a_mixture_where_it_has_several_samples),
    };
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
