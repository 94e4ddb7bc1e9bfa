// The pictures of probes against those of the timed programs, and the geometry picture.
#include "probe.h"

static struct sb_image_request request_of(enum sb_image_kind kind, bool inputs_only)
{
    return (struct sb_image_request){
        .kind = kind, .wide = true, .inputs_only = inputs_only};
}

// Number of pixels in which the probe draws another colour than the program that is timed.
static long off_by(const struct probe_job *job, bool inputs_only)
{
    struct sb_image timed, probed, page;
    const struct sb_image_request colour = request_of(SB_IMAGE_COLOUR, false);
    const struct sb_image_request probe = request_of(SB_IMAGE_PROBE_COLOUR, inputs_only);
    const struct sb_image_request inputs = request_of(SB_IMAGE_PROBE, inputs_only);
    job_image(job, &colour, &timed);
    job_image(job, &probe, &probed);
    long count = differing(&timed, &probed);
    if (job->variant.value[SB_AXIS_STAGE] == SB_STAGE_FRAGMENT) {
        job_image(job, &inputs, &page);
        count += differing(&timed, &page);
        sb_image_free(&page);
    }
    sb_image_free(&timed);
    sb_image_free(&probed);
    return count;
}

struct several { // variants
    const char *const *words;
    size_t count, step; // every `step`th
    const char *more;
    bool inputs_only;
};

// How many of the variants are off; each that is, is named.
static int count_off(const struct several *several)
{
    int off = 0;
    for (size_t i = 0; i < several->count; i += several->step) {
        struct probe_job job;
        char all[500];
        snprintf(all, sizeof all, "%s %s", several->words[i], several->more);
        if (!job_make(&job, all))
            continue;
        const long pixels = off_by(&job, several->inputs_only);
        if (pixels > 0)
            print_message("%s: %ld pixels differ\n", all, pixels);
        off += pixels > 0;
        job_free(&job);
    }
    return off;
}

#define MIX "dir=1 point=2 spot=2 "
static const char *const variants[] = {
    "dir=2 point=0",
    "point=3",
    "spot=2",
    "area=2",
    "area=2 area_shape=tube",
    "area=1 area_shape=box space=view",
    "area=2 area_shape=capsule model=phong",
    MIX "area=1",
    MIX "model=phong",
    MIX "model=lambert",
    MIX "model=lambert guard=mask",
    MIX "ambient=per_light",
    MIX "ambient=none",
    MIX "attenuation=none",
    MIX "attenuation=radius",
    MIX "attenuation=windowed",
    MIX "cone=hard",
    MIX "cone=exponent",
    MIX "cone=linear",
    MIX "cone=hard guard=mask",
    MIX "cone=exponent guard=mask model=phong",
    MIX "specular_side=both",
    MIX "guard=mask",
    MIX "guard=mask specular_side=both",
    MIX "maps=diffuse+specular+normal",
    MIX "maps=normal space=view",
    MIX "maps=diffuse+specular hoist=per_light",
    MIX "hoist=per_light cone=linear",
    MIX "hoist=per_light maps=diffuse+specular model=phong ambient=per_light",
    MIX "hoist=per_light maps=specular loop=unrolled cone=exponent",
    MIX "hoist=per_light maps=diffuse+specular+normal guard=mask specular_side=both",
    "dir=1 point=4 spot=1 hoist=per_light maps=diffuse+specular",
    "dir=2 point=8 spot=4 maps=diffuse+specular",
    "point=16 hoist=per_light maps=diffuse",
    "dir=4 point=4 spot=4 hoist=per_light layout=unified maps=specular",
    MIX "hoist=per_light cone=hard space=view",
    MIX "space=view",
    MIX "space=eye offset=1e6",
    MIX "normalise=off",
    MIX "layout=unified",
    MIX "layout=unified loop=padded capacity=6 storage=ubo_std140",
    MIX "layout=unified loop=dynamic capacity=6 storage=arrays",
    MIX "loop=unrolled storage=constant",
    MIX "loop=unrolled storage=global",
    MIX "loop=padded capacity=3",
    MIX "loop=dynamic capacity=4 storage=ubo_shared",
    MIX "storage=arrays",
    MIX "storage=ubo_std140",
    MIX "stage=vertex",
    MIX "stage=vertex model=phong cone=hard maps=diffuse+specular",
    MIX "stage=vertex guard=mask hoist=per_light space=view layout=unified",
    MIX "form=naive",
    MIX "form=naive guard=mask model=phong cone=hard",
    MIX "form=naive cone=exponent stage=vertex",
    "scene=containers point=3 shadows=2",
    "scene=containers point=3 shadows=1 shadow_map=cube shadow_filter=4 guard=mask",
    "scene=containers point=2 shadows=2 shadow_map=array2d shadow_bias_kind=slope "
    "shadow_filter=16 spot=1",
    "scene=room point=1 shadows=1 shadow_store=depth space=view maps=diffuse+normal",
    "scene=containers point=2 lamps=on update=lights",
    "scene=room point=2 shadows=1 update=lights+shadows",
};
enum { VARIANTS = sizeof variants / sizeof *variants };

// What takes time is the driver's compiler: OpenGL draws every other variant and OpenGL ES those
// between, and a sanitised program, which the driver is no part of, a few.
#ifdef __SANITIZE_ADDRESS__
enum { STRIDE = 8 };
#else
enum { STRIDE = 2 };
#endif

static struct several share_of(size_t step, const char *more, bool inputs_only)
{
    const size_t first = probe_caps.gles ? 1 : 0;
    return (struct several){variants + first, VARIANTS - first, step, more, inputs_only};
}

void the_probe_draws_what_the_timed_program_draws(void **state)
{
    (void)state;
    const struct several all = share_of(STRIDE, "precision=highp", false);
    assert_int_equal(count_off(&all), 0);
}

static const char *const presets[] = {
    "scene=containers source=delphi dir=1 point=4 spot=1 model=phong "
    "maps=diffuse+specular ambient=per_light specular_side=both lamps=on update=lights "
    "hoist=per_light",
    "scene=blocks source=lwjgl dir=1 point=3 spot=2 model=phong cone=linear "
    "specular_side=both sun=30 update=lights normalise=off loop=padded capacity=5 "
    "hoist=per_light space=view text=as_written",
    "scene=tunnel source=wikibooks point=1 spot=1 model=phong cone=exponent "
    "layout=unified storage=global hoist=per_light text=as_written",
    "scene=spheres source=ubo point=2 model=phong ambient=per_light layout=unified "
    "storage=ubo_shared loop=dynamic capacity=8 space=view update=lights text=as_written",
    "scene=room source=shadows point=1 model=phong maps=diffuse+normal shadows=1 "
    "ambient=none attenuation=radius specular_side=both update=lights+shadows "
    "text=as_written",
};
enum { PRESETS = sizeof presets / sizeof *presets };

void presets_are_probed_as_they_are_drawn(void **state)
{
    (void)state;
    // The first one's loop is unrolled less, see below.
    const struct several all = {presets + 1, PRESETS - 1, 1, "precision=highp", false};
    assert_int_equal(count_off(&all), 0);
}

// Desktop OpenGL takes the qualifiers for nothing. The last presets only: the first one's loop
// is unrolled less, see below, and the text `ubo` as written starts from what nothing has set.
void reduced_precision_is_probed_as_it_is_drawn(void **state)
{
    (void)state;
    if (!probe_caps.gles)
        skip();
    const struct several several[] = {
        share_of(3 * STRIDE, "precision=mediump", false),
        share_of(7 * STRIDE, "precision=mixed", false),
        {presets + 1, 2, 1, "precision=mediump p_color=lowp", false},
        {presets + 4, 1, 1, "precision=mediump p_color=lowp", false},
    };
    int off = 0;
    for (size_t i = 0; i < sizeof several / sizeof *several; i++)
        off += count_off(&several[i]);
    assert_int_equal(off, 0);
}

// Mesa unrolls loops up to a size, and takes common factors, such as a map's texel, out of sums
// over what it has unrolled. The probe's body is larger, so there is a band of programs that
// are summed in another order: seen with hoist=per_light, maps and four to six point lights.
void loops_that_are_unrolled_less_differ_by_rounding_at_most(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        double ulp; // of 1
    } cases[] = {
        {"scene=containers dir=1 point=4 hoist=per_light maps=diffuse+specular "
         "model=phong ambient=per_light",
         0x1p-23},
        {"scene=containers dir=1 point=6 hoist=per_light maps=diffuse+specular "
         "model=phong ambient=per_light",
         0x1p-23},
        {"scene=containers dir=1 point=4 spot=1 hoist=per_light maps=diffuse+specular "
         "model=phong ambient=per_light specular_side=both precision=mediump "
         "p_color=lowp",
         0x1p-10},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct probe_job job;
        struct sb_image timed, probed;
        struct sb_image_difference difference;
        assert_true(job_make(&job, cases[i].words));
        const struct sb_image_request colour = {.wide = true};
        const struct sb_image_request probe = {.kind = SB_IMAGE_PROBE_COLOUR};
        job_image(&job, &colour, &timed);
        job_image(&job, &probe, &probed);
        sb_image_compare(&timed, &probed, &difference);
        print_message("%s: %ld pixels, %g\n", cases[i].words, difference.pixels,
                      difference.max);
        assert_true(difference.max <= 4 * cases[i].ulp);
        sb_image_free(&timed);
        sb_image_free(&probed);
        job_free(&job);
    }
}

// Loops of several sizes, with what a compiler takes out of their sums: some of them a probe that
// tells of the lights draws otherwise.
static const char *const in_loops[] = {
    "scene=containers dir=1 point=4 hoist=per_light maps=diffuse+specular model=phong "
    "ambient=per_light",
    "scene=containers dir=1 point=6 hoist=per_light maps=diffuse+specular model=phong "
    "ambient=per_light",
    "scene=containers dir=1 point=4 spot=1 hoist=per_light maps=diffuse+specular "
    "model=phong ambient=per_light",
    "scene=containers dir=1 point=4 spot=1 hoist=per_light maps=diffuse+specular "
    "model=phong ambient=per_light guard=mask",
    "scene=room dir=1 point=5 spot=1 hoist=per_light maps=diffuse+specular+normal",
};

void inputs_are_told_without_changing_what_is_drawn(void **state)
{
    (void)state;
    const char *few = "precision=mediump p_color=lowp";
    const struct several several[] = {
        {in_loops, sizeof in_loops / sizeof *in_loops, 1, "precision=highp", true},
        {presets, PRESETS, 1, "precision=highp", true},
        share_of(2 * STRIDE, "precision=highp", true),
        {in_loops, sizeof in_loops / sizeof *in_loops, 1, few, true},
        share_of(5 * STRIDE, few, true),
    };
    int off = 0;
    for (size_t i = 0; i < sizeof several / sizeof *several - (probe_caps.gles ? 0 : 2);
         i++)
        off += count_off(&several[i]);
    assert_int_equal(off, 0);
}

static bool is_told(enum sb_probe_page page, int place)
{
    return page == SB_PROBE_MAPS || place < (page == SB_PROBE_FRAME ? 6 : 8);
}

static void check_same_inputs(const char *words)
{
    struct probe_job job;
    assert_true(job_make(&job, words));
    for (int page = SB_PROBE_INPUTS; page <= SB_PROBE_MAPS; page++) {
        struct sb_image both[2];
        if (page == SB_PROBE_LIGHT)
            continue;
        for (int inputs_only = 0; inputs_only < 2; inputs_only++) {
            struct sb_image_request request = request_of(SB_IMAGE_PROBE, inputs_only);
            request.page = (enum sb_probe_page)page;
            job_image(&job, &request, &both[inputs_only]);
        }
        assert_int_equal(both[0].width, both[1].width);
        for (long i = 0; i < (long)both[1].width * both[1].height; i++)
            for (int k = 0; k < 12; k++) {
                const float all = both[0].data[CHANNELS * i + PAGE + k];
                const float told = both[1].data[CHANNELS * i + PAGE + k];
                assert_true(told == (is_told((enum sb_probe_page)page, k) ? all : 0));
            }
        sb_image_free(&both[0]);
        sb_image_free(&both[1]);
    }
    job_free(&job);
}

void inputs_are_those_of_the_whole_probe(void **state)
{
    (void)state;
    check_same_inputs("scene=room dir=1 point=2 maps=diffuse+specular+normal");
    check_same_inputs("scene=plane point=2 lamps=on space=view");
    check_same_inputs("scene=room point=2 shadows=1 hoist=per_light maps=diffuse");
    check_same_inputs("dir=1 point=2 stage=vertex maps=diffuse+specular");
}

void lamps_have_a_colour_and_nothing_to_tell(void **state)
{
    (void)state;
    struct probe_job job;
    struct sb_image id, page;
    assert_true(job_make(&job, "scene=plane point=3 lamps=on width=96 height=96"));
    const struct sb_image_request ids = {.kind = SB_IMAGE_ID};
    job_image(&job, &ids, &id);
    job_page(&job, SB_PROBE_LIGHT, 1, &page);
    long lamps = 0;
    for (long i = 0; i < (long)id.width * id.height; i++) {
        const float *told = &page.data[CHANNELS * i + PAGE];
        const int draw = (int)id.data[i] - 1;
        if (draw >= 0 && job.scene.draw[draw].lamp < 0) {
            assert_true(told[11] == 1);
            continue;
        }
        lamps += draw >= 0;
        for (int k = 0; k < 12; k++)
            assert_true(told[k] == 0);
    }
    assert_true(lamps > 10);
    assert_int_equal(off_by(&job, false), 0);
    sb_image_free(&id);
    sb_image_free(&page);
    job_free(&job);
}

void one_pixel_tells_what_the_whole_picture_tells(void **state)
{
    (void)state;
    struct probe_job job;
    assert_true(job_make(&job, MIX "cone=hard maps=diffuse+specular"));
    for (int page = SB_PROBE_INPUTS; page <= SB_PROBE_MAPS; page++) {
        struct sb_image all;
        job_page(&job, (enum sb_probe_page)page, 3, &all);
        for (int i = 0; i < 24; i++) {
            struct sb_image one;
            const struct sb_image_request request = {
                .kind = SB_IMAGE_PROBE,
                .page = (enum sb_probe_page)page,
                .light = 3,
                .one_pixel = true,
                .x = 2 * i,
                .y = (11 * i + 20) % 48,
            };
            job_image(&job, &request, &one);
            assert_int_equal(one.width, 1);
            assert_int_equal(one.height, 1);
            assert_int_equal(one.channels, CHANNELS);
            assert_memory_equal(one.data, sb_image_at(&all, request.x, request.y),
                                CHANNELS * sizeof *one.data);
            sb_image_free(&one);
        }
        sb_image_free(&all);
    }
    job_free(&job);
}

void lights_can_be_off_in_a_probe(void **state)
{
    (void)state;
    struct probe_job job;
    assert_true(job_make(&job, "point=2 spot=1 update=lights"));
    struct sb_image timed, probed, all, again;
    struct sb_image_request request = {.wide = true, .off_first = 1, .off_count = 1};
    job_image(&job, &request, &timed);
    request.kind = SB_IMAGE_PROBE_COLOUR;
    job_image(&job, &request, &probed);
    assert_int_equal(differing(&timed, &probed), 0);
    request.off_count = 0;
    job_image(&job, &request, &all);
    assert_true(differing(&probed, &all) > 0);
    request.kind = SB_IMAGE_COLOUR;
    job_image(&job, &request, &again);
    assert_int_equal(differing(&again, &all), 0);
    sb_image_free(&timed);
    sb_image_free(&probed);
    sb_image_free(&all);
    sb_image_free(&again);
    job_free(&job);
}

static void check_refused(const struct sb_image_request *request, const char *part)
{
    struct sb_error err = {0};
    struct sb_image image = {0};
    assert_false(probe_fns->image(probe_runner, request, &image, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, part);
}

void a_program_without_a_probe_says_so(void **state)
{
    (void)state;
    struct probe_job job;
    if (probe_caps.gles) {
        assert_true(job_make(&job, "glsl=100 point=1"));
        check_refused(&(struct sb_image_request){.job = job.id, .kind = SB_IMAGE_PROBE},
                      "probe");
        check_refused(
            &(struct sb_image_request){.job = job.id, .kind = SB_IMAGE_PROBE_COLOUR},
            "GLSL ES 1.00");
        check_refused(&(struct sb_image_request){.job = job.id,
                                                 .kind = SB_IMAGE_PROBE,
                                                 .inputs_only = true},
                      "inputs");
        job_free(&job);
    }
    assert_true(job_make(&job, "point=1"));
    check_refused(
        &(struct sb_image_request){
            .job = job.id, .kind = SB_IMAGE_PROBE, .one_pixel = true, .x = 48},
        "(48, 0)");
    check_refused(&(struct sb_image_request){.job = job.id,
                                             .kind = SB_IMAGE_PROBE,
                                             .page = SB_PROBE_LIGHT,
                                             .inputs_only = true},
                  "nothing of lights");
    job_free(&job);
}

// --- geometry ------------------------------------------------------------------------------

static const char *const scenes[] = {"sphere", "containers", "plane lamps=on", "blocks",
                                     "room",   "tunnel",     "spheres point=2"};
enum { SCENES = sizeof scenes / sizeof *scenes };

void geometry_shows_the_draws_of_the_id_image(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        struct probe_job job;
        struct sb_image id, geometry;
        char words[64];
        snprintf(words, sizeof words, "samples=1 scene=%s", scenes[s]);
        assert_true(job_make(&job, words));
        job_image(&job, &(struct sb_image_request){.kind = SB_IMAGE_ID}, &id);
        job_image(&job, &(struct sb_image_request){.kind = SB_IMAGE_GEOMETRY}, &geometry);
        assert_int_equal(geometry.channels, 4);
        for (long i = 0; i < (long)id.width * id.height; i++) {
            const float *at = &geometry.data[4 * i];
            assert_true(at[0] == id.data[i]);
            if (at[0] == 0) {
                assert_true(at[1] == 0 && at[2] == 0 && at[3] == 0);
                continue;
            }
            const struct sb_draw *draw = &job.scene.draw[(int)at[0] - 1];
            const int triangles = job.scene.mesh[draw->mesh].index_count / 3;
            assert_true(at[1] == floorf(at[1]) && at[1] >= 1 && at[1] <= triangles);
            // Corners are snapped to 1/16 or 1/256 of a pixel, weights are not.
            assert_true(at[2] > -0.05f && at[3] > -0.05f && at[2] + at[3] < 1.05f);
        }
        sb_image_free(&id);
        sb_image_free(&geometry);
        job_free(&job);
    }
}

static struct sb_vec3 world_of(const struct sb_draw *draw, const float *p)
{
    const float *m = draw->model;
    double out[3];
    for (int i = 0; i < 3; i++)
        out[i] = (double)m[i] * p[0] + (double)m[4 + i] * p[1] + (double)m[8 + i] * p[2] +
                 m[12 + i];
    return (struct sb_vec3){out[0], out[1], out[2]};
}

static struct sb_vec3 weighted(const struct sb_scene *scene, const float *at)
{
    const struct sb_draw *draw = &scene->draw[(int)at[0] - 1];
    const struct sb_mesh *mesh = &scene->mesh[draw->mesh];
    const uint32_t *index = &mesh->index[3 * ((int)at[1] - 1)];
    const double weight[3] = {1.0 - at[2] - at[3], at[2], at[3]};
    struct sb_vec3 sum = {0};
    for (int i = 0; i < 3; i++)
        sum = sb_vec3_add(
            sum,
            sb_vec3_scale(world_of(draw, mesh->vertex[index[i]].position), weight[i]));
    return sum;
}

void positions_are_those_of_the_weighted_corners(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        struct probe_job job;
        struct sb_image geometry, page;
        char words[64];
        snprintf(words, sizeof words, "scene=%s", scenes[s]);
        assert_true(job_make(&job, words));
        job_image(&job, &(struct sb_image_request){.kind = SB_IMAGE_GEOMETRY}, &geometry);
        job_page(&job, SB_PROBE_INPUTS, 0, &page);
        long checked = 0;
        for (long i = 0; i < (long)page.width * page.height; i++) {
            const float *at = &geometry.data[4 * i];
            if (at[0] == 0 || job.scene.draw[(int)at[0] - 1].lamp >= 0)
                continue;
            const struct sb_vec3 want = weighted(&job.scene, at);
            const struct sb_vec3 got = vector_of(&page.data[CHANNELS * i + PAGE]);
            check_close(sb_vec3_length(sb_vec3_sub(got, want)), 0,
                        2e-5 * (1 + sb_vec3_length(want)));
            checked++;
        }
        assert_true(checked > 100);
        sb_image_free(&geometry);
        sb_image_free(&page);
        job_free(&job);
    }
}
