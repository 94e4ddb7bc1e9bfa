// A frame of a scene whose every pixel is known: axis-aligned rectangles, no perspective.
#include "gl_test.h"
#include "render/render.h"
#include "render_shaders.h"
#include "test.h"

enum { SIZE = 16, DRAWS = 4, MATERIALS = 3 };

static struct sb_caps caps;

// Multiples of 1/255 are exact in every format that is compared exactly here.
static const float colours[MATERIALS][3] = {{0.2f, 0, 1}, {0, 0.4f, 1}, {1, 1, 0.6f}};
static const float background[4] = {0, 0, 0.2f, 1};

struct rectangle { // in clip space; depth -1 is nearest
    float x0, y0, x1, y1, depth;
    bool mirrored; // so that it is seen from behind
};
static const struct rectangle rectangles[DRAWS] = {
    {-1, -1, 0, 1, 0, false},
    {-0.5f, -1, 1, 0, 0.5f, false},              // behind the first one
    {-0.75f, 0.25f, 0.75f, 0.75f, -0.5f, false}, // in front of it
    {-1, -1, 1, 1, -0.9f, true},                 // in front of all
};

struct world {
    struct sb_vertex vertex[4];
    struct sb_mesh mesh;
    struct sb_material material[MATERIALS];
    struct sb_draw draw[DRAWS];
    struct sb_scene scene;
};

static void world_make(struct world *world)
{
    static const uint32_t index[6] = {0, 1, 2, 0, 2, 3};
    static const float corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    *world = (struct world){0};
    for (int i = 0; i < 4; i++)
        memcpy(world->vertex[i].position, corner[i], sizeof corner[i]);
    world->mesh = (struct sb_mesh){
        .vertex = world->vertex, .index = index, .vertex_count = 4, .index_count = 6};
    for (int i = 0; i < MATERIALS; i++)
        memcpy(world->material[i].diffuse, colours[i], sizeof colours[i]);
    for (int i = 0; i < DRAWS; i++) {
        const struct rectangle *r = &rectangles[i];
        const float width = r->x1 - r->x0;
        float *model = world->draw[i].model;
        model[0] = r->mirrored ? -width : width;
        model[5] = r->y1 - r->y0;
        model[10] = model[15] = 1;
        model[12] = r->mirrored ? r->x1 : r->x0;
        model[13] = r->y0;
        model[14] = r->depth;
        world->draw[i].material = i % MATERIALS;
        world->draw[i].lamp = -1;
    }
    for (int i = 0; i < 4; i++)
        world->scene.camera.view_projection[5 * i] = 1;
    memcpy(world->scene.clear_colour, background, sizeof background);
    world->scene.name = "rectangles";
    world->scene.mesh = &world->mesh;
    world->scene.material = world->material;
    world->scene.draw = world->draw;
    world->scene.mesh_count = 1;
    world->scene.material_count = MATERIALS;
    world->scene.draw_count = DRAWS;
}

// The draw that a pixel shows, or -1, from the rectangles alone.
static int truth(int px, int py)
{
    const float x = (2 * (float)px + 1) / SIZE - 1, y = (2 * (float)py + 1) / SIZE - 1;
    int nearest = -1;
    for (int i = 0; i < DRAWS; i++) {
        const struct rectangle *r = &rectangles[i];
        const bool inside = x > r->x0 && x < r->x1 && y > r->y0 && y < r->y1;
        if (inside && !r->mirrored &&
            (nearest < 0 || r->depth < rectangles[nearest].depth))
            nearest = i;
    }
    return nearest;
}

static const char flat_colour[] = "struct material { vec3 diffuse; };\n"
                                  "uniform material u_material;\n"
                                  "out vec4 o_color;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    o_color = vec4(u_material.diffuse, 1.0);\n"
                                  "}\n";

struct fixture {
    struct world world;
    struct sb_variant variant;
    struct sb_upload upload;
    struct sb_gl_program program;
    struct sb_binding binding;
    struct sb_ring ring;
};

static void program_make(struct sb_gl_program *program, const char *body)
{
    struct sb_text vertex = {0}, fragment = {0};
    add_vertex_shader(&vertex, caps.gles);
    add_version(&fragment, caps.gles);
    sb_text_add(&fragment, body);
    const struct sb_program source = {.vertex = vertex.data, .fragment = fragment.data};
    if (!sb_gl_program_make(&source, program))
        fail_msg("%s", program->log);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
}

static bool bind_program(struct sb_binding *binding, const struct fixture *fixture,
                         GLuint program, struct sb_error *err)
{
    const struct sb_binding_params params = {
        .program = program,
        .upload = &fixture->upload,
        .variant = &fixture->variant,
    };
    return sb_binding_make(binding, &params, err);
}

static void fixture_make_samples(struct fixture *fixture, enum sb_gl_format format,
                                 int samples)
{
    const struct sb_shape shape = {SIZE, SIZE, format, samples, 1};
    struct sb_error err = {0};
    *fixture = (struct fixture){0};
    sb_variant_init(sb_axes_builtin(), &fixture->variant);
    world_make(&fixture->world);
    sb_upload_make(&fixture->upload, &fixture->world.scene);
    if (format == SB_GL_R32UI)
        assert_true(sb_id_program_make(&fixture->program, caps.gles, &err));
    else
        program_make(&fixture->program, flat_colour);
    assert_true(bind_program(&fixture->binding, fixture, fixture->program.name, &err));
    if (!sb_ring_make(&fixture->ring, &caps, &shape, &err))
        fail_msg("%s", err.text);
}

static void fixture_make(struct fixture *fixture, enum sb_gl_format format)
{
    fixture_make_samples(fixture, format, 1);
}

static void fixture_free(struct fixture *fixture)
{
    assert_null(sb_gl_error());
    sb_ring_free(&fixture->ring);
    sb_binding_free(&fixture->binding);
    sb_gl_program_free(&fixture->program);
    sb_upload_free(&fixture->upload);
}

static int64_t draw_frame(const struct fixture *fixture, int target, int layers)
{
    return sb_frame_draw(&(struct sb_frame_params){
        .binding = &fixture->binding,
        .target = &fixture->ring.target[target],
        .layers = layers,
        .phase = -1,
        .gles = caps.gles,
    });
}

// The colour target holds what `truth` says, in every pixel.
static void check_colours(const struct fixture *fixture, int target)
{
    struct sb_image image;
    struct sb_error err = {0};
    assert_true(sb_target_read(&fixture->ring.target[target], &image, &err));
    // Half floats round 0.2; bytes and floats give it back.
    const double tolerance =
        fixture->ring.target[target].format == SB_GL_RGBA16F ? 0.001 : 0;
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const int draw = truth(x, y);
            const float *want = draw < 0 ? background : colours[draw % MATERIALS];
            for (int c = 0; c < 3; c++)
                check_close(sb_image_at(&image, x, y)[c], want[c], tolerance);
            check_close(sb_image_at(&image, x, y)[3], 1, 0);
        }
    }
    sb_image_free(&image);
}

static void every_pixel_has_the_colour_of_the_nearest_front_face(void **state)
{
    (void)state;
    static const enum sb_gl_format formats[] = {SB_GL_RGBA8, SB_GL_RGBA16F,
                                                SB_GL_RGBA32F};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        struct fixture fixture;
        fixture_make(&fixture, formats[i]);
        draw_frame(&fixture, 0, 1);
        check_colours(&fixture, 0);
        fixture_free(&fixture);
    }
}

static void the_id_image_tells_which_draw_each_pixel_shows(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    struct sb_error err = {0};
    fixture_make(&fixture, SB_GL_R32UI);
    draw_frame(&fixture, 0, 1);
    assert_true(sb_target_read(&fixture.ring.target[0], &image, &err));
    assert_int_equal(image.channels, 1);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++)
            assert_int_equal(*sb_image_at(&image, x, y), truth(x, y) + 1);
    }
    sb_image_free(&image);
    fixture_free(&fixture);
}

static void a_frame_does_not_depend_on_the_state_left_behind(void **state)
{
    (void)state;
    struct fixture fixture;
    fixture_make(&fixture, SB_GL_RGBA8);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 1, 1);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0, -1e9f);
    glEnable(GL_RASTERIZER_DISCARD);
    if (!caps.gles)
        glEnable(GL_FRAMEBUFFER_SRGB);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glFrontFace(GL_CW);
    glCullFace(GL_FRONT_AND_BACK);
    glViewport(3, 3, 2, 2);
    glUseProgram(0);
    draw_frame(&fixture, 0, 1);
    check_colours(&fixture, 0);

    GLboolean dither, srgb = GL_FALSE;
    glGetBooleanv(GL_DITHER, &dither);
    if (!caps.gles)
        srgb = glIsEnabled(GL_FRAMEBUFFER_SRGB);
    assert_false(dither);
    assert_false(srgb);
    fixture_free(&fixture);
}

static void frames_of_a_ring_leave_the_picture_of_one_frame(void **state)
{
    (void)state;
    struct fixture fixture;
    fixture_make(&fixture, SB_GL_RGBA32F);
    for (int i = 0; i < 5; i++)
        draw_frame(&fixture, i % SB_RING_SIZE, 1);
    for (int i = 0; i < SB_RING_SIZE; i++)
        check_colours(&fixture, i);
    fixture_free(&fixture);
}

static void layers_leave_the_picture_of_one(void **state)
{
    (void)state;
    struct fixture fixture;
    fixture_make(&fixture, SB_GL_RGBA8);
    draw_frame(&fixture, 0, 3);
    check_colours(&fixture, 0);
    fixture_free(&fixture);
}

static GLuint samples_of_frame(const struct fixture *fixture, int layers)
{
    GLuint query, samples;
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    draw_frame(fixture, 0, layers);
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &query);
    return samples;
}

static void every_layer_shades_every_visible_pixel_again(void **state)
{
    (void)state;
    if (!caps.samples_passed)
        skip();
    struct fixture fixture;
    fixture_make(&fixture, SB_GL_RGBA8);
    GLuint visible = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        visible += truth(i % SIZE, i / SIZE) >= 0;
    // The first layer shades some that are hidden later; from then on only visible ones
    // pass.
    const GLuint one = samples_of_frame(&fixture, 1);
    assert_true(one >= visible);
    assert_int_equal(samples_of_frame(&fixture, 2), one + visible);
    assert_int_equal(samples_of_frame(&fixture, 3), one + 2 * visible);
    fixture_free(&fixture);
}

static int64_t calls_seen;
static PFNGLDRAWELEMENTSPROC real_draw_elements;
static PFNGLBINDVERTEXARRAYPROC real_bind_vertex_array;
static PFNGLUNIFORMMATRIX4FVPROC real_uniform_matrix;
static PFNGLUNIFORM3FVPROC real_uniform;

static void GLAD_API_PTR count_draw_elements(GLenum mode, GLsizei count, GLenum type,
                                             const void *indices)
{
    calls_seen++;
    real_draw_elements(mode, count, type, indices);
}

static void GLAD_API_PTR count_bind_vertex_array(GLuint name)
{
    calls_seen++;
    real_bind_vertex_array(name);
}

static void GLAD_API_PTR count_uniform_matrix(GLint location, GLsizei count,
                                              GLboolean transpose, const GLfloat *value)
{
    calls_seen++;
    real_uniform_matrix(location, count, transpose, value);
}

static void GLAD_API_PTR count_uniform(GLint location, GLsizei count,
                                       const GLfloat *value)
{
    calls_seen++;
    real_uniform(location, count, value);
}

static void gl_calls_are_those_that_reach_the_driver(void **state)
{
    (void)state;
    struct fixture fixture;
    fixture_make(&fixture, SB_GL_RGBA8);
    real_draw_elements = glad_glDrawElements;
    real_bind_vertex_array = glad_glBindVertexArray;
    real_uniform_matrix = glad_glUniformMatrix4fv;
    real_uniform = glad_glUniform3fv;
    glad_glDrawElements = count_draw_elements;
    glad_glBindVertexArray = count_bind_vertex_array;
    glad_glUniformMatrix4fv = count_uniform_matrix;
    glad_glUniform3fv = count_uniform;
    const int64_t one = draw_frame(&fixture, 0, 1);
    const int64_t seen_one = calls_seen;
    const int64_t four = draw_frame(&fixture, 0, 4);
    glad_glDrawElements = real_draw_elements;
    glad_glBindVertexArray = real_bind_vertex_array;
    glad_glUniformMatrix4fv = real_uniform_matrix;
    glad_glUniform3fv = real_uniform;
    // A draw of the flat program: the model matrix, one colour, the mesh, the draw
    // itself.
    assert_int_equal(seen_one, 4 * DRAWS);
    assert_int_equal(four - one, 3 * seen_one);
    assert_int_equal(calls_seen, 5 * seen_one);
    fixture_free(&fixture);
}

// The upper left texel, once round; then, of the first map, the middle between two texels
// as seen from near and from far.
static const char maps[] =
    "uniform sampler2D u_diffuse_map;\n"
    "uniform sampler2D u_specular_map;\n"
    "uniform sampler2D u_normal_map;\n"
    "out vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    vec2 texel = vec2(1.25, 0.75), middle = vec2(0.5, 0.75);\n"
    "    int x = int(gl_FragCoord.x);\n"
    "    if (x == 0)\n"
    "        o_color = vec4(texture(u_diffuse_map, texel).r,\n"
    "                       texture(u_specular_map, texel).g,\n"
    "                       texture(u_normal_map, texel).b, 1.0);\n"
    "    else if (x == 1)\n"
    "        o_color = textureGrad(u_diffuse_map, middle, vec2(0.01), vec2(0.01));\n"
    "    else\n"
    "        o_color = textureGrad(u_diffuse_map, middle, vec2(8.0), vec2(8.0));\n"
    "}\n";

static void maps_reach_their_samplers_repeat_and_are_filtered_without_levels(void **state)
{
    (void)state;
    // No value occurs twice; the lower row comes first.
    static const unsigned char texels[SB_MAP_COUNT][2][2][4] = {
        {{{1, 2, 3, 255}, {4, 5, 6, 255}}, {{50, 8, 9, 255}, {10, 11, 12, 255}}},
        {{{13, 14, 15, 255}, {16, 17, 18, 255}}, {{19, 102, 21, 255}, {22, 23, 24, 255}}},
        {{{25, 26, 27, 255}, {28, 29, 30, 255}}, {{31, 32, 153, 255}, {34, 35, 36, 255}}},
    };
    struct fixture fixture;
    struct sb_image image;
    struct sb_error err = {0};
    fixture_make(&fixture, SB_GL_RGBA8);
    sb_binding_free(&fixture.binding);
    sb_upload_free(&fixture.upload);
    sb_gl_program_free(&fixture.program);
    for (int i = 0; i < SB_MAP_COUNT; i++)
        fixture.world.scene.map[i] = (struct sb_texture){2, 2, &texels[i][0][0][0]};
    sb_upload_make(&fixture.upload, &fixture.world.scene);
    program_make(&fixture.program, maps);
    assert_true(bind_program(&fixture.binding, &fixture, fixture.program.name, &err));
    draw_frame(&fixture, 0, 1);
    assert_true(sb_target_read(&fixture.ring.target[0], &image, &err));
    for (int x = 0; x < 3; x++)
        assert_int_equal(truth(x, 0), 0);
    check_close(sb_image_at(&image, 0, 0)[0], 50 / 255., 1e-7);
    check_close(sb_image_at(&image, 0, 0)[1], 102 / 255., 1e-7);
    check_close(sb_image_at(&image, 0, 0)[2], 153 / 255., 1e-7);
    // (50 + 10) / 2; drivers may weigh with 8 bits.
    check_close(sb_image_at(&image, 1, 0)[0], 30 / 255., 1.01 / 255);
    check_close(sb_image_at(&image, 2, 0)[0], 30 / 255., 1.01 / 255);
    sb_image_free(&image);
    fixture_free(&fixture);
}

static void a_map_that_the_scene_does_not_have_is_refused_by_name(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_binding binding;
    struct sb_gl_program program;
    struct sb_error err = {0};
    fixture_make(&fixture, SB_GL_RGBA8);
    program_make(&program, maps);
    assert_false(bind_program(&binding, &fixture, program.name, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, "u_diffuse_map");
    check_contains(err.text, "rectangles");
    sb_binding_free(&binding);
    sb_gl_program_free(&program);
    fixture_free(&fixture);
}

static void the_shape_of_a_variant_follows_its_axes(void **state)
{
    (void)state;
    static const enum sb_gl_format format[] = {
        [SB_TARGET_RGBA8] = SB_GL_RGBA8,
        [SB_TARGET_RGBA16F] = SB_GL_RGBA16F,
        [SB_TARGET_RGBA32F] = SB_GL_RGBA32F,
    };
    struct sb_variant variant;
    sb_variant_init(sb_axes_builtin(), &variant);
    sb_variant_put(&variant, SB_AXIS_WIDTH, 320);
    sb_variant_put(&variant, SB_AXIS_HEIGHT, 200);
    sb_variant_put(&variant, SB_AXIS_LAYERS, 7);
    sb_variant_put(&variant, SB_AXIS_SAMPLES, 8);
    for (int i = 0; i < SB_TARGET_VALUE_COUNT; i++) {
        sb_variant_put(&variant, SB_AXIS_TARGET, i);
        const struct sb_shape shape = sb_shape_of(&variant);
        assert_int_equal(shape.width, 320);
        assert_int_equal(shape.height, 200);
        assert_int_equal(shape.layers, 7);
        assert_int_equal(shape.samples, 8);
        assert_int_equal(shape.format, format[i]);
    }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_has_the_colour_of_the_nearest_front_face),
        cmocka_unit_test(the_id_image_tells_which_draw_each_pixel_shows),
        cmocka_unit_test(a_frame_does_not_depend_on_the_state_left_behind),
        cmocka_unit_test(frames_of_a_ring_leave_the_picture_of_one_frame),
        cmocka_unit_test(layers_leave_the_picture_of_one),
        cmocka_unit_test(every_layer_shades_every_visible_pixel_again),
        cmocka_unit_test(gl_calls_are_those_that_reach_the_driver),
        cmocka_unit_test(
            maps_reach_their_samplers_repeat_and_are_filtered_without_levels),
        cmocka_unit_test(a_map_that_the_scene_does_not_have_is_refused_by_name),
        cmocka_unit_test(the_shape_of_a_variant_follows_its_axes),
    };
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
