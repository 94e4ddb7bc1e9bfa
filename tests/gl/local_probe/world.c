// Jobs of whole scenes.
#include "probe.h"

void *probe_runner;
struct sb_caps probe_caps;
const struct sb_runner_fns *const probe_fns = &sb_runner_local;

// Words into the variant; returns the scene.
static const char *read_words(char *text, struct sb_variant *variant)
{
    const struct sb_axes *axes = sb_axes_builtin();
    const char *scene = "sphere";
    struct sb_error err = {0};
    sb_variant_init(axes, variant);
    for (char *rest = text, *word; (word = strtok_r(rest, " ", &rest)) != NULL;) {
        char *value = strchr(word, '=');
        assert_non_null(value);
        *value++ = '\0';
        if (strcmp(word, "scene") == 0) {
            scene = value;
            continue;
        }
        const int axis = sb_axes_expect(axes, word, &err);
        if (axis < 0 || !sb_variant_set(axes, variant, axis, value, &err))
            fail_msg("%s", err.text);
    }
    if (!sb_variant_resolve(axes, variant, &err))
        fail_msg("%s", err.text);
    return scene;
}

bool job_make(struct probe_job *job, const char *words)
{
    static uint32_t next = 1;
    char text[600];
    struct sb_error err = {0};
    struct sb_prepared prepared;
    *job = (struct probe_job){.id = next++};
    snprintf(text, sizeof text, "%swidth=48 height=48 shadow_size=128 %s",
             probe_caps.gles ? "api=gles " : "", words);
    const char *scene = read_words(text, &job->variant);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = sb_axes_builtin(),
        .scene = scene,
        .variant = &job->variant,
        .caps = &probe_caps,
        .id = job->id,
        .probe = true,
    };
    if (!sb_assemble(&params, &job->assembly, &err)) {
        if (err.status != SB_OVER_LIMIT)
            fail_msg("%s: %s", words, err.text);
        sb_assembly_free(&job->assembly);
        return false;
    }
    job->variant = job->assembly.job.variant;
    if (!sb_scene_make(scene, &job->variant, &job->scene, &err))
        fail_msg("%s", err.text);
    if (!probe_fns->prepare(probe_runner, &job->assembly.job, &prepared))
        fail_msg("%s: %s", words, prepared.error.text);
    return true;
}

void job_free(struct probe_job *job)
{
    probe_fns->release(probe_runner, job->id);
    sb_scene_free(&job->scene);
    sb_assembly_free(&job->assembly);
}

void job_image(const struct probe_job *job, const struct sb_image_request *request,
               struct sb_image *image)
{
    struct sb_error err = {0};
    struct sb_image_request whole = *request;
    whole.job = job->id;
    *image = (struct sb_image){0};
    if (!probe_fns->image(probe_runner, &whole, image, &err))
        fail_msg("%s", err.text);
}

void job_page(const struct probe_job *job, enum sb_probe_page page, int light,
              struct sb_image *image)
{
    const struct sb_image_request request = {
        .kind = SB_IMAGE_PROBE, .page = page, .light = light};
    job_image(job, &request, image);
    assert_int_equal(image->channels, CHANNELS);
}

long differing(const struct sb_image *a, const struct sb_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    long count = 0;
    const int channels = a->channels < b->channels ? a->channels : b->channels;
    for (long i = 0; i < (long)a->width * a->height; i++)
        count += memcmp(&a->data[i * a->channels], &b->data[i * b->channels],
                        (size_t)channels * sizeof *a->data) != 0;
    return count;
}

struct sb_vec3 vector_of(const float *v)
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

enum sb_light_type type_of(const struct probe_job *job, int light)
{
    int type = 0;
    while (light >= job->scene.lights.count[type])
        light -= job->scene.lights.count[type++];
    return (enum sb_light_type)type;
}

// --- closed forms --------------------------------------------------------------------------

static double attenuation(const struct sb_variant *variant, const struct sb_light *light,
                          double d)
{
    const double q = fmin(d / light->range, 1);
    switch ((int)variant->value[SB_AXIS_ATTENUATION]) {
    case SB_ATTENUATION_POLYNOMIAL:
        return 1 / (light->constant + light->linear * d + light->quadratic * d * d);
    case SB_ATTENUATION_RADIUS:
        return fmax(1 - d / light->range, 0);
    case SB_ATTENUATION_WINDOWED:
        return pow(1 - pow(q, 4), 2) / (d * d + 1);
    default:
        return 1;
    }
}

static double cone(const struct sb_variant *variant, const struct sb_light *light,
                   double cosine)
{
    const double edge = cos(light->cutoff), inner = cos(light->inner);
    switch ((int)variant->value[SB_AXIS_CONE]) {
    case SB_CONE_HARD:
        return cosine >= edge;
    case SB_CONE_EXPONENT:
        return cosine >= edge ? pow(cosine, light->exponent) : 0;
    case SB_CONE_LINEAR:
        return fmax(1 - (1 - cosine) / (1 - edge), 0);
    default:
        return fmin(fmax((cosine - edge) / fmax(inner - edge, 1.0 / 1024), 0), 1);
    }
}

static double specular(const struct probe_job *job, struct sb_vec3 l,
                       const struct place *place)
{
    const double *value = job->variant.value;
    const struct sb_vec3 n = place->normal, v = place->view;
    const struct sb_vec3 half = sb_vec3_normalise(sb_vec3_add(l, v));
    const double n_dot_l = sb_vec3_dot(n, l);
    const struct sb_vec3 mirrored = sb_vec3_sub(sb_vec3_scale(n, 2 * n_dot_l), l);
    const double cosine = value[SB_AXIS_MODEL] == SB_MODEL_BLINN
                              ? sb_vec3_dot(n, half)
                              : sb_vec3_dot(mirrored, v);
    const bool cut = value[SB_AXIS_SPECULAR_SIDE] == SB_SPECULAR_FRONT && n_dot_l <= 0;
    if (value[SB_AXIS_MODEL] == SB_MODEL_LAMBERT || cut)
        return 0;
    return pow(fmin(fmax(cosine, 0), 1), job->scene.material[0].shininess);
}

// The vector to the light, to the ball's surface for area lights, which are balls here.
static struct sb_vec3 to_light(const struct sb_light *light, enum sb_light_type type,
                               struct sb_vec3 position)
{
    if (type == SB_LIGHT_DIR)
        return sb_vec3_scale(vector_of(light->direction), -1);
    const struct sb_vec3 to = sb_vec3_sub(vector_of(light->position), position);
    if (type != SB_LIGHT_AREA)
        return to;
    const double d = sb_vec3_length(to);
    return sb_vec3_scale(to, fmax(d - light->radius, 0) / d);
}

void terms_of(const struct probe_job *job, int number, const struct place *place,
              double page[12])
{
    const struct sb_light *light = &job->scene.lights.light[number];
    const enum sb_light_type type = type_of(job, number);
    const struct sb_vec3 to = to_light(light, type, place->position);
    const struct sb_vec3 l = sb_vec3_normalise(to);
    const bool far = type != SB_LIGHT_DIR, spot = type == SB_LIGHT_SPOT;
    const struct sb_vec3 axis = vector_of(light->direction);
    page[0] = far ? sb_vec3_length(to) : 0;
    page[1] = far ? attenuation(&job->variant, light, page[0]) : 1;
    page[2] = spot ? cone(&job->variant, light, -sb_vec3_dot(l, axis)) : 1;
    page[3] = 1;
    page[4] = sb_vec3_dot(place->normal, l);
    page[5] = specular(job, l, place);
    page[6] = l.x;
    page[7] = l.y;
    page[8] = l.z;
    page[9] = page[1] * page[2] * fmax(page[4], 0);
    page[10] = page[1] * page[2] * page[5];
    page[11] = 1;
}
