// Jobs for the tests of layer local, which see the runner as the upper half does: only
// through its table.
#pragma once

#include "gl_test.h"
#include "local/local.h"
#include "render_shaders.h"
#include "scene/scene.h"
#include "test.h"

enum { SIZE = 64, POINTS = 3 };

static void *runner;
static struct sb_caps caps;
static const struct sb_runner_fns *const fns = &sb_runner_local;

static inline int run_with_runner(const struct CMUnitTest *tests, size_t count)
{
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    runner = fns->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    const int failed = _cmocka_run_group_tests("local", tests, count, NULL, NULL);
    fns->close(runner);
    return failed;
}

struct text_job { // a job and what it points to
    struct sb_text vertex, fragment, lamp;
    struct sb_program program[2]; // "shade", and after job_add_lamp "lamp"
    struct sb_job job;
};

static inline void job_init(struct text_job *it, uint32_t id, const char *body)
{
    *it = (struct text_job){0};
    add_vertex_shader(&it->vertex, caps.gles);
    add_version(&it->fragment, caps.gles);
    sb_text_add(&it->fragment, body);
    it->program[0] =
        (struct sb_program){"shade", it->vertex.data, NULL, it->fragment.data};
    it->job = (struct sb_job){
        .id = id, .scene = "sphere", .program = it->program, .program_count = 1};
    sb_variant_init(sb_axes_builtin(), &it->job.variant);
    sb_variant_put(&it->job.variant, SB_AXIS_POINT, POINTS);
    sb_variant_put(&it->job.variant, SB_AXIS_WIDTH, SIZE);
    sb_variant_put(&it->job.variant, SB_AXIS_HEIGHT, SIZE);
    sb_variant_put(&it->job.variant, SB_AXIS_TARGET, SB_TARGET_RGBA32F);
}

// The scene shows its point lights, by a program of this fragment shader.
static inline void job_add_lamp(struct text_job *it, const char *body)
{
    add_version(&it->lamp, caps.gles);
    sb_text_add(&it->lamp, body);
    it->program[1] = (struct sb_program){"lamp", it->vertex.data, NULL, it->lamp.data};
    it->job.program_count = 2;
    sb_variant_put(&it->job.variant, SB_AXIS_LAMPS, SB_LAMPS_ON);
}

static inline void job_free(struct text_job *it)
{
    sb_text_free(&it->lamp);
    sb_text_free(&it->vertex);
    sb_text_free(&it->fragment);
}

// Fails the test with the runner's own words.
static inline void prepare(const struct text_job *it, struct sb_prepared *prepared)
{
    if (!fns->prepare(runner, &it->job, prepared))
        fail_msg("%s", prepared->error.text);
}

static inline void image_of(uint32_t id, enum sb_image_kind kind, struct sb_image *image)
{
    struct sb_error err = {0};
    const struct sb_image_request request = {.job = id, .kind = kind};
    if (!fns->image(runner, &request, image, &err))
        fail_msg("%s", err.text);
}

static const char flat[] = "out vec4 o_color;\n"
                           "void main()\n"
                           "{\n"
                           "    o_color = vec4(2.0, 0.25, -1.0, 0.5);\n"
                           "}\n";

static const char lamp[] = "uniform vec3 u_lamp_colour;\n"
                           "out vec4 o_color;\n"
                           "void main()\n"
                           "{\n"
                           "    o_color = vec4(u_lamp_colour, 1.0);\n"
                           "}\n";

// Diffuse light of all point lights.
static inline void add_lit(struct sb_text *text, enum light_storage storage)
{
    const struct light_text lights = {{[SB_LIGHT_POINT] = POINTS}, storage};
    const char *const members[] = {"position", "ambient", "diffuse"};
    add_lights(text, &lights);
    for (int i = 0; i < 3; i++)
        sb_text_printf(text,
                       storage == AS_ARRAYS
                           ? "vec3 get_%s(int i) { return u_point_%s[i]; }\n"
                           : "vec3 get_%s(int i) { return u_point[i].%s; }\n",
                       members[i], members[i]);
    sb_text_printf(text,
                   "in vec3 v_world;\n"
                   "in vec3 v_normal;\n"
                   "out vec4 o_color;\n"
                   "void main()\n"
                   "{\n"
                   "    vec3 sum = vec3(0.0);\n"
                   "    for (int i = 0; i < %d; i++) {\n"
                   "        vec3 l = normalize(get_position(i) - v_world);\n"
                   "        sum += get_ambient(i);\n"
                   "        sum += get_diffuse(i) * max(dot(normalize(v_normal), l), "
                   "0.0);\n"
                   "    }\n"
                   "    o_color = vec4(sum, 1.0);\n"
                   "}\n",
                   POINTS);
}

static inline void lit_init(struct text_job *it, uint32_t id, enum light_storage storage)
{
    struct sb_text body = {0};
    add_lit(&body, storage);
    job_init(it, id, body.data);
    sb_text_free(&body);
}

static inline long differing(const struct sb_image *a, const struct sb_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    long count = 0;
    for (long i = 0; i < (long)a->width * a->height * a->channels; i++)
        count += memcmp(&a->data[i], &b->data[i], sizeof *a->data) != 0;
    return count;
}
