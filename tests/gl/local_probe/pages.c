// What the pages say, against closed forms.
#include "probe.h"

#include "local/state.h"

// The three pages of a place, of one light.
struct told {
    struct sb_image inputs, frame, light;
};

static void tell(const struct probe_job *job, int light, struct told *told)
{
    job_page(job, SB_PROBE_INPUTS, light, &told->inputs);
    job_page(job, SB_PROBE_FRAME, light, &told->frame);
    job_page(job, SB_PROBE_LIGHT, light, &told->light);
}

static void told_free(struct told *told)
{
    sb_image_free(&told->inputs);
    sb_image_free(&told->frame);
    sb_image_free(&told->light);
}

static const float *page_at(const struct sb_image *image, long i)
{
    return &image->data[CHANNELS * i + PAGE];
}

// The view vector is made here: lambert has none, and what is behind is not asked for it.
static struct place place_of(const struct probe_job *job, const struct told *told, long i)
{
    struct place place = {
        .position = vector_of(page_at(&told->inputs, i)),
        .normal = vector_of(page_at(&told->frame, i) + 9),
    };
    place.view =
        sb_vec3_normalise(sb_vec3_sub(vector_of(job->scene.camera.eye), place.position));
    return place;
}

static bool is_lit(const struct told *told, long i)
{
    return page_at(&told->light, i)[11] != 0;
}

// Not so near to a cut that rounding decides.
static bool is_clear(const struct probe_job *job, int number, const struct place *place,
                     const double *want)
{
    const struct sb_light *light = &job->scene.lights.light[number];
    const struct sb_vec3 l = {want[6], want[7], want[8]};
    const double across = -sb_vec3_dot(l, vector_of(light->direction));
    const bool spot = type_of(job, number) == SB_LIGHT_SPOT;
    return fabs(sb_vec3_dot(l, place->normal)) > 1e-5 &&
           (!spot || fabs(across - cos(light->cutoff)) > 1e-5);
}

static void check_light(const struct probe_job *job, int light, const char *words)
{
    // Area lights have a highlight of their own, which laws.c of light_relations checks.
    const bool area = type_of(job, light) == SB_LIGHT_AREA;
    struct told told;
    tell(job, light, &told);
    long lit = 0;
    for (long i = 0; i < (long)told.light.width * told.light.height; i++) {
        double want[12];
        if (!is_lit(&told, i))
            continue;
        const struct place place = place_of(job, &told, i);
        terms_of(job, light, &place, want);
        if (!is_clear(job, light, &place, want))
            continue;
        lit++;
        for (int k = 0; k < 12; k++) {
            const double got = page_at(&told.light, i)[k];
            if ((area && (k == 5 || k == 10)) || fabs(got - want[k]) < 5e-5)
                continue;
            fail_msg("%s: light %d, pixel %ld, place %d: %.9g, not %.9g", words, light, i,
                     k, got, want[k]);
        }
        assert_true(page_at(&told.inputs, i)[8] == 0 && page_at(&told.inputs, i)[9] == 0);
    }
    assert_true(lit > 400);
    told_free(&told);
}

void pages_of_lights_follow_closed_forms(void **state)
{
    (void)state;
    static const char *const words[] = {
        "dir=2 point=0",
        "point=2 attenuation=polynomial",
        "point=2 attenuation=radius model=phong",
        "point=2 attenuation=windowed model=lambert",
        "point=1 attenuation=none specular_side=both",
        "spot=3 cone=smooth",
        "spot=2 cone=hard specular_side=both",
        "spot=2 cone=exponent guard=mask",
        "spot=2 cone=linear",
        "area=2",
        "dir=1 point=2 spot=2 layout=unified hoist=per_light cone=hard",
        "dir=2 point=2 spot=2 area=1 loop=padded capacity=4 guard=mask",
        "dir=1 point=3 spot=1 loop=dynamic capacity=4 storage=ubo_std140",
        "dir=1 point=3 spot=1 loop=unrolled storage=constant",
        "dir=1 point=2 spot=1 guard=mask specular_side=both maps=normal",
    };
    for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
        struct probe_job job;
        struct sb_image none;
        assert_true(job_make(&job, words[w]));
        const int total = sb_lights_total(&job.scene.lights);
        for (int i = 0; i < total; i++)
            check_light(&job, i, words[w]);
        job_page(&job, SB_PROBE_LIGHT, total, &none);
        for (long i = 0; i < (long)none.width * none.height; i++)
            for (int k = 0; k < 12; k++)
                assert_true(page_at(&none, i)[k] == 0);
        sb_image_free(&none);
        job_free(&job);
    }
}

// --- decisions -----------------------------------------------------------------------------

// `cones`: light `light` has a cone that is cut; `shown`: it casts shadows. The hash so far
// goes on; false where rounding may decide.
static bool decide(const struct probe_job *job, int light, const struct told *told,
                   long i, uint32_t *hash)
{
    const double *value = job->variant.value;
    const struct place place = place_of(job, told, i);
    const float *page = page_at(&told->light, i);
    const int first_point = job->scene.lights.count[SB_LIGHT_DIR];
    double want[12];
    terms_of(job, light, &place, want);
    if (type_of(job, light) == SB_LIGHT_SPOT &&
        (value[SB_AXIS_CONE] == SB_CONE_HARD || value[SB_AXIS_CONE] == SB_CONE_EXPONENT))
        *hash = sb_ref_decide(*hash, want[2] > 0);
    if (light >= first_point && light - first_point < (int)value[SB_AXIS_SHADOWS])
        *hash = sb_ref_decide(*hash, (int)(16 * page[3] + 0.5));
    if (value[SB_AXIS_SPECULAR_SIDE] == SB_SPECULAR_FRONT &&
        value[SB_AXIS_MODEL] != SB_MODEL_LAMBERT)
        *hash = sb_ref_decide(*hash, want[4] > 0);
    return is_clear(job, light, &place, want);
}

enum { LIGHTS_MAX = 6 };

static void check_decisions(const char *words)
{
    struct probe_job job;
    struct told told[LIGHTS_MAX];
    if (!job_make(&job, words))
        return;
    const int total = sb_lights_total(&job.scene.lights);
    assert_in_range(total, 1, LIGHTS_MAX);
    for (int l = 0; l < total; l++)
        tell(&job, l, &told[l]);
    long checked = 0;
    for (long i = 0; i < (long)told[0].light.width * told[0].light.height; i++) {
        uint32_t hash = 0;
        bool clear = is_lit(&told[0], i);
        for (int l = 0; clear && l < total; l++)
            clear = decide(&job, l, &told[l], i, &hash);
        if (!clear)
            continue;
        if (page_at(&told[0].inputs, i)[10] != (float)hash)
            fail_msg("%s: pixel %ld: hash %g, not %u", words, i,
                     (double)page_at(&told[0].inputs, i)[10], hash);
        checked++;
    }
    assert_true(checked > 100);
    for (int l = 0; l < total; l++)
        told_free(&told[l]);
    job_free(&job);
}

void decisions_are_hashed_in_order(void **state)
{
    (void)state;
    check_decisions("point=1");
    check_decisions("point=1 specular_side=both");
    check_decisions("point=1 model=lambert");
    check_decisions("spot=1 cone=hard");
    check_decisions("spot=1 cone=exponent model=lambert");
    check_decisions("spot=1 cone=smooth guard=mask");
    check_decisions("dir=1 point=1 spot=2 cone=hard guard=mask");
    check_decisions("dir=1 point=1 spot=2 cone=exponent layout=unified form=naive");
    check_decisions("scene=containers point=3 shadows=2 shadow_filter=4");
    check_decisions(
        "scene=containers dir=1 point=2 shadows=1 shadow_filter=16 guard=mask");
}

// --- what is not finite --------------------------------------------------------------------

static const struct sb_image_request middle = {
    .kind = SB_IMAGE_PROBE, .one_pixel = true, .x = 24, .y = 24};

// The light that the program "probe" of a job has uploaded first: to be changed before
// middle_inputs.
static struct sb_light *first_light(const struct probe_job *job)
{
    struct sb_error err = {0};
    struct sb_local_job *inside =
        sb_local_job_find((struct sb_local *)probe_runner, job->id, &err);
    assert_non_null(inside);
    return inside->probe[0].binding.as_lit;
}

static void middle_inputs(const struct probe_job *job, float inputs[12])
{
    struct sb_image page;
    struct sb_image_request request = middle;
    request.off_first = 99; // uploads the lights, and switches none of them off
    request.off_count = 1;
    job_image(job, &request, &page);
    memcpy(inputs, page.data + PAGE, 12 * sizeof *inputs);
    sb_image_free(&page);
}

void a_light_on_the_surface_is_not_finite_in_naive_forms(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int count, first; // of values; of the first: 1 + its place
    } cases[] = {
        // the unit vector and its cosine
        {"form=naive point=1 specular_side=front guard=branch", 4, 1 + 6},
        {"form=robust point=1 specular_side=front guard=branch", 0, 0},
        {"form=robust point=1 guard=mask", 0, 0},
        {"form=naive spot=1 cone=linear model=lambert", 5, 1 + 6}, // and the cone
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct probe_job job;
        float inputs[12];
        assert_true(job_make(&job, cases[i].words));
        middle_inputs(&job, inputs);
        memcpy(first_light(&job)->position, inputs, 3 * sizeof(float));
        middle_inputs(&job, inputs);
        assert_true(inputs[8] == (float)cases[i].count);
        assert_true(inputs[9] == 0);
        assert_true(inputs[11] == (float)cases[i].first);
        job_free(&job);
    }
}

// A sum below 0 in the divisor of the textbooks' form: attenuation, and both weights of a light
// that reaches the surface, which the middle of the sphere is turned to.
void negative_terms_are_counted(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int count;
    } cases[] = {{"form=naive point=1 model=lambert", 2},
                 {"form=robust point=1 model=lambert", 0},
                 {"form=naive point=1 model=blinn", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct probe_job job;
        float inputs[12];
        assert_true(job_make(&job, cases[i].words));
        middle_inputs(&job, inputs);
        assert_true(inputs[9] == 0);
        first_light(&job)->constant = -100;
        middle_inputs(&job, inputs);
        assert_true(inputs[8] == 0);
        assert_true(inputs[9] == (float)cases[i].count);
        job_free(&job);
    }
}

// --- tangents ------------------------------------------------------------------------------

void frames_of_normal_maps_are_told(void **state)
{
    (void)state;
    struct probe_job job;
    struct told told;
    assert_true(job_make(&job, "scene=room point=1 maps=normal"));
    tell(&job, 0, &told);
    long bent = 0;
    for (long i = 0; i < (long)told.light.width * told.light.height; i++) {
        if (!is_lit(&told, i))
            continue;
        const float *frame = page_at(&told.frame, i);
        // As they come, as long as the room is large.
        const struct sb_vec3 tangent = sb_vec3_normalise(vector_of(frame));
        const struct sb_vec3 bitangent = sb_vec3_normalise(vector_of(frame + 3));
        const struct sb_vec3 normal = vector_of(page_at(&told.inputs, i) + 3);
        const struct sb_vec3 lit = vector_of(frame + 9);
        // The room is of planes: interpolation leaves normals of unit length.
        check_close(sb_vec3_dot(tangent, bitangent), 0, 1e-4);
        check_close(sb_vec3_dot(tangent, normal), 0, 1e-4);
        check_close(fabs(sb_vec3_dot(sb_vec3_cross(normal, tangent), bitangent)), 1,
                    1e-4);
        check_close(sb_vec3_length(lit), 1, 1e-4);
        const struct place place = place_of(&job, &told, i);
        check_close(sb_vec3_dot(place.view, vector_of(frame + 6)), 1, 1e-5);
        bent += sb_vec3_dot(lit, normal) < 0.999;
    }
    assert_true(bent > 20);
    told_free(&told);
    job_free(&job);
}
