// Lit per vertex: the row of vertices.
#include "probe.h"

static struct sb_vec3 world_of(const struct sb_draw *draw, const float *p)
{
    const float *m = draw->model;
    double out[3];
    for (int i = 0; i < 3; i++)
        out[i] = (double)m[i] * p[0] + (double)m[4 + i] * p[1] + (double)m[8 + i] * p[2] +
                 m[12 + i];
    return (struct sb_vec3){out[0], out[1], out[2]};
}

enum { LIGHTS_MAX = 8 };
struct row {
    struct sb_image inputs, frame, light[LIGHTS_MAX];
    int lights;
};

static void row_make(const struct probe_job *job, struct row *row)
{
    row->lights = sb_lights_total(&job->scene.lights);
    assert_in_range(row->lights, 0, LIGHTS_MAX);
    job_page(job, SB_PROBE_INPUTS, 0, &row->inputs);
    job_page(job, SB_PROBE_FRAME, 0, &row->frame);
    for (int l = 0; l < row->lights; l++)
        job_page(job, SB_PROBE_LIGHT, l, &row->light[l]);
}

static void row_free(struct row *row)
{
    sb_image_free(&row->inputs);
    sb_image_free(&row->frame);
    for (int l = 0; l < row->lights; l++)
        sb_image_free(&row->light[l]);
}

// The sums of the equation of docs/glsl.md from the factors that were told; ambient=none.
static void check_sums(const struct probe_job *job, const struct row *row, int at,
                       const struct sb_material *material)
{
    const float *diffuse = sb_image_at(&row->inputs, at, 0);
    const float *specular = sb_image_at(&row->frame, at, 0) + PAGE;
    for (int c = 0; c < 3; c++) {
        double sum[2] = {0};
        for (int l = 0; l < row->lights; l++) {
            const struct sb_light *light = &job->scene.lights.light[l];
            const float *page = sb_image_at(&row->light[l], at, 0) + PAGE;
            sum[0] += (double)page[9] * light->diffuse[c];
            sum[1] += (double)page[10] * light->specular[c];
        }
        check_close(diffuse[c], material->diffuse[c] * sum[0], 1e-5);
        check_close(specular[c], material->specular[c] * sum[1], 1e-5);
    }
    assert_true(diffuse[3] == 0);
}

static void check_lights(const struct probe_job *job, const struct row *row, int at)
{
    const float *inputs = sb_image_at(&row->inputs, at, 0) + PAGE;
    const float *frame = sb_image_at(&row->frame, at, 0) + PAGE;
    struct place place = {.position = vector_of(inputs), .normal = vector_of(frame + 9)};
    place.view =
        sb_vec3_normalise(sb_vec3_sub(vector_of(job->scene.camera.eye), place.position));
    check_close(sb_vec3_dot(place.view, vector_of(frame + 6)), 1, 1e-5);
    for (int l = 0; l < row->lights; l++) {
        double want[12];
        const float *page = sb_image_at(&row->light[l], at, 0) + PAGE;
        terms_of(job, l, &place, want);
        for (int k = 0; k < 12; k++)
            if (fabs(want[4]) > 1e-5)
                check_close(page[k], want[k], 5e-5);
    }
}

static void check_rows(const char *words)
{
    struct probe_job job;
    struct row row;
    assert_true(job_make(&job, words));
    const struct sb_scene *scene = &job.scene;
    row_make(&job, &row);
    int at = 0;
    for (int d = 0; d < scene->draw_count; d++) {
        const struct sb_draw *draw = &scene->draw[d];
        const struct sb_mesh *mesh = &scene->mesh[draw->mesh];
        for (int v = 0; draw->lamp < 0 && v < mesh->vertex_count; v++, at++) {
            const float *inputs = sb_image_at(&row.inputs, at, 0) + PAGE;
            const struct sb_vec3 want = world_of(draw, mesh->vertex[v].position);
            check_close(sb_vec3_length(sb_vec3_sub(vector_of(inputs), want)), 0,
                        1e-5 * (1 + sb_vec3_length(want)));
            assert_memory_equal(inputs + 6, mesh->vertex[v].uv, 2 * sizeof *inputs);
            check_close(sb_vec3_length(vector_of(inputs + 3)), 1, 1e-5);
            check_sums(&job, &row, at, &scene->material[draw->material]);
            if (scene->material_count == 1)
                check_lights(&job, &row, at);
        }
    }
    assert_int_equal(row.inputs.width, at);
    assert_int_equal(row.inputs.height, 1);
    row_free(&row);
    job_free(&job);
}

void vertices_tell_what_they_hand_on(void **state)
{
    (void)state;
    check_rows("stage=vertex ambient=none dir=1 point=2 spot=1");
    check_rows("stage=vertex ambient=none model=phong guard=mask point=2 "
               "specular_side=both storage=ubo_std140");
    check_rows("scene=plane stage=vertex ambient=none point=2 lamps=on");
}
