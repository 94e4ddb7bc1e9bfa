#include "measure/explain.h"

#include <math.h>
#include <string.h>

#include "assemble/platform.h"
#include "reference/share.h"

// What rounding alone makes of a term stays below its limit: a cone multiplies the error of its
// cosine by the inverse of its width.
#define LIMITS_distance        0, 64
#define LIMITS_direction       1, 64
#define LIMITS_attenuation     0x1p-10, 64
#define LIMITS_cone            1, 1024
#define LIMITS_shown           1, 0
#define LIMITS_n_dot_l         1, 64
#define LIMITS_specular        1, 64
#define LIMITS_diffuse_weight  1, 64
#define LIMITS_specular_weight 1, 64

const struct sb_term_row sb_term_rows[SB_TERM_COUNT] = {
#define TERM(name, components, place, axes, help)                                        \
    {#name,        axes, help, components, place, offsetof(struct sb_ref_terms, name),   \
     LIMITS_##name},
    SB_REF_TERMS(TERM)
#undef TERM
};

double sb_ulps(double value, double reference, double floor, int bits)
{
    const int least = bits > 11 ? -126 : -14; // smallest normal exponent
    const double size = fmax(fabs(reference), floor);
    int exponent = least;
    if (!isfinite(value) || !isfinite(reference))
        return isnan(value) && isnan(reference) ? 0 : value == reference ? 0 : INFINITY;
    if (size > 0) // frexp has no exponent of 0
        frexp(size, &exponent);
    const int last = (exponent - 1 > least ? exponent - 1 : least) - (bits - 1);
    return ldexp(fabs(value - reference), -last);
}

// --- what the driver had -----------------------------------------------------------------

struct source {
    const struct sb_explain_params *params;
    bool per_vertex;
    int width, height;
};

static bool draw(const struct source *source, const struct sb_image_request *wanted,
                 struct sb_image *image, struct sb_error *err)
{
    const struct sb_driver *driver = source->params->driver;
    struct sb_image_request request = *wanted;
    request.job = source->params->task->assembly.job.id;
    request.width = source->width;
    request.height = source->height;
    return driver->fns->image(driver->runner, &request, image, err);
}

static bool draw_page(const struct source *source, enum sb_probe_page page, int light,
                      struct sb_image *image, struct sb_error *err)
{
    const struct sb_image_request request = {
        .kind = SB_IMAGE_PROBE,
        .page = page,
        .light = light,
        .one_pixel = !source->per_vertex || page == SB_PROBE_MAPS,
        .x = source->params->x,
        .y = source->params->y,
    };
    return draw(source, &request, image, err);
}

// One pixel of a whole picture.
static bool draw_pixel(const struct source *source,
                       const struct sb_image_request *request, float *pixel,
                       struct sb_error *err)
{
    struct sb_image image = {0};
    if (!draw(source, request, &image, err))
        return false;
    memcpy(pixel, sb_image_at(&image, source->params->x, source->params->y),
           (size_t)image.channels * sizeof *pixel);
    sb_image_free(&image);
    return true;
}

// Where in a picture of probes a point stands.
static const float *place_of(const struct sb_image *image,
                             const struct sb_explanation *explanation,
                             const struct sb_explained_point *point)
{
    const struct sb_ref_ground *ground = explanation->truth.ground;
    return point->vertex < 0
               ? image->data
               : sb_image_at(image,
                             ground->first_vertex[explanation->draw] + point->vertex, 0);
}

enum { PAGE = 4 }; // channels before those of the page

static bool read_inputs(const struct source *source, struct sb_explanation *explanation,
                        struct sb_error *err)
{
    struct sb_image inputs = {0}, frame = {0};
    const bool good = draw_page(source, SB_PROBE_INPUTS, 0, &inputs, err) &&
                      draw_page(source, SB_PROBE_FRAME, 0, &frame, err);
    for (int i = 0; good && i < explanation->point_count; i++) {
        struct sb_explained_point *point = &explanation->point[i];
        const float *of_inputs = place_of(&inputs, explanation, point);
        const float *of_frame = place_of(&frame, explanation, point);
        memcpy(point->inputs, of_inputs + PAGE, sizeof point->inputs);
        memcpy(point->frame, of_frame + PAGE, sizeof point->frame);
        memcpy(point->diffuse, of_inputs, sizeof point->diffuse);
        memcpy(point->specular, of_frame + PAGE, sizeof point->specular);
    }
    sb_image_free(&inputs);
    sb_image_free(&frame);
    return good;
}

static bool read_maps(const struct source *source, struct sb_explanation *explanation,
                      struct sb_error *err)
{
    struct sb_image image = {0};
    explanation->has_maps =
        sb_ref_needs_maps(&source->params->task->assembly.job.variant);
    if (!explanation->has_maps)
        return true;
    if (!draw_page(source, SB_PROBE_MAPS, 0, &image, err))
        return false;
    memcpy(explanation->maps, image.data + PAGE, sizeof explanation->maps);
    sb_image_free(&image);
    return true;
}

// How far the instrumented program's colour is from that of the timed one.
static bool compare_probe(const struct source *source, struct sb_explanation *explanation,
                          struct sb_error *err)
{
    const struct sb_image_request of_probe = {.kind = SB_IMAGE_PROBE_COLOUR};
    const struct sb_image_request of_timed = {
        .kind = SB_IMAGE_COLOUR, .wide = true, .single = true};
    float colour[4], single[4];
    if (!draw_pixel(source, &of_probe, colour, err) ||
        !draw_pixel(source, &of_timed, single, err))
        return false;
    for (int c = 0; c < 3; c++) {
        const double probed = colour[c], timed = single[c];
        const bool same = probed == timed || (isnan(probed) && isnan(timed));
        const double off = isnan(probed - timed) ? INFINITY : fabs(probed - timed);
        if (!same)
            explanation->probe_off = fmax(explanation->probe_off, off);
    }
    return true;
}

// --- side by side ------------------------------------------------------------------------

static void judge(const struct sb_explanation *explanation,
                  struct sb_explained_light *light)
{
    light->wrong = -1;
    for (int t = 0; t < SB_TERM_COUNT; t++) {
        const struct sb_term_row *row = &sb_term_rows[t];
        const double *reference =
            (const double *)((const char *)light->reference + row->offset);
        light->ulps[t] = 0;
        for (int c = 0; c < row->components; c++)
            light->ulps[t] =
                fmax(light->ulps[t], sb_ulps(light->driver[row->place + c], reference[c],
                                             row->floor, explanation->bits[t]));
        const double most = fmin(row->wrong, ldexp(1, explanation->bits[t] - 4));
        if (light->wrong < 0 && !(light->ulps[t] <= most)) // NAN: wrong
            light->wrong = t;
    }
}

static bool read_lights(const struct source *source, struct sb_explanation *explanation,
                        struct sb_error *err)
{
    for (int i = 0; i < explanation->light_count; i++) {
        struct sb_image image = {0};
        if (!draw_page(source, SB_PROBE_LIGHT, i, &image, err))
            return false;
        for (int p = 0; p < explanation->point_count; p++) {
            struct sb_explained_light *light = &explanation->point[p].light[i];
            const float *values = place_of(&image, explanation, &explanation->point[p]);
            memcpy(light->driver, values + PAGE, sizeof light->driver);
            light->reference = &explanation->point[p].reference.terms[i];
            judge(explanation, light);
            if (light->wrong >= 0 && explanation->wrong_term < 0 &&
                explanation->probe_off == 0) {
                explanation->wrong_point = p;
                explanation->wrong_light = i;
                explanation->wrong_term = light->wrong;
            }
        }
        sb_image_free(&image);
    }
    return true;
}

static void list_lights(const struct sb_explain_params *params,
                        struct sb_explanation *explanation,
                        struct sb_explained_point *point)
{
    const struct sb_scene *scene = explanation->truth.scene;
    const size_t total = (size_t)sb_lights_total(&scene->lights) + 1;
    int at = 0;
    point->light = sb_arena_alloc(&explanation->arena, total * sizeof *point->light);
    point->reference.terms =
        sb_arena_alloc(&explanation->arena, total * sizeof *point->reference.terms);
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        for (int i = 0; i < scene->lights.count[type]; i++, at++)
            point->light[at] = (struct sb_explained_light){
                .type = (enum sb_light_type)type,
                .number = i,
                .light =
                    sb_light_as_lit(&scene->lights.light[at], (enum sb_light_type)type,
                                    &params->task->assembly.job.variant, &scene->camera),
                .wrong = -1,
            };
}

static void evaluate(const struct sb_explain_params *params,
                     struct sb_explanation *explanation, struct sb_explained_point *point)
{
    const struct sb_variant *variant = &params->task->assembly.job.variant;
    const struct sb_ref_ground *ground = explanation->truth.ground;
    if (point->vertex < 0)
        sb_ref_given_at(ground, variant, explanation->draw, point->inputs,
                        sb_ref_needs_frame(variant) ? point->frame : NULL,
                        explanation->has_maps ? explanation->maps : NULL,
                        &point->reference);
    else
        sb_ref_vertex_at(ground, variant, explanation->draw, point->vertex,
                         &point->reference);
}

// --- the pixel ---------------------------------------------------------------------------

static bool find_triangle(const struct source *source, struct sb_explanation *explanation,
                          struct sb_error *err)
{
    const struct sb_image_request request = {.kind = SB_IMAGE_GEOMETRY};
    float seen[4];
    if (!draw_pixel(source, &request, seen, err))
        return false;
    explanation->draw = (int)seen[0] - 1;
    explanation->triangle = (int)seen[1] - 1;
    explanation->driver_weight[0] = 1 - seen[2] - seen[3];
    explanation->driver_weight[1] = seen[2];
    explanation->driver_weight[2] = seen[3];
    return true;
}

static void locate(const struct source *source, struct sb_explanation *explanation)
{
    const struct sb_ref_geometry *geometry = explanation->truth.ground->geometry;
    const struct sb_ref_cover at = {explanation->draw, explanation->triangle};
    int corner[3];
    sb_ref_geometry_weights(geometry, at, explanation->x, explanation->y,
                            explanation->weight);
    explanation->exact = sb_ref_geometry_input(geometry, at, explanation->weight);
    sb_ref_geometry_corners(geometry, at, corner);
    explanation->point_count = source->per_vertex ? 3 : 1;
    for (int i = 0; i < explanation->point_count; i++)
        explanation->point[i].vertex = source->per_vertex ? corner[i] : -1;
}

static void take_colours(struct sb_explanation *explanation)
{
    const struct sb_truth *truth = &explanation->truth;
    const int x = explanation->x, y = explanation->y;
    memcpy(explanation->ideal, sb_image64_at(&truth->ideal->colour, x, y),
           sizeof explanation->ideal);
    memcpy(explanation->model, sb_image64_at(&truth->model->colour, x, y),
           sizeof explanation->model);
    memcpy(explanation->given, explanation->model, sizeof explanation->given);
}

// What the reference makes of what the driver had, once the points are evaluated.
static void take_given(const struct sb_explain_params *params,
                       struct sb_explanation *explanation)
{
    const struct sb_explained_point *point = explanation->point;
    struct sb_vec3 given = point->reference.colour;
    if (explanation->point_count == 3) {
        const struct sb_ref_cover at = {explanation->draw, explanation->triangle};
        const struct sb_ref_shade *corner[3];
        double weight[3];
        for (int i = 0; i < 3; i++) {
            corner[i] = &point[i].reference.shade;
            weight[i] = explanation->driver_weight[i];
        }
        given = sb_ref_gouraud_at(explanation->truth.ground,
                                  &params->task->assembly.job.variant, at, weight, corner,
                                  explanation->has_maps ? explanation->maps : NULL);
    }
    memcpy(explanation->given, (double[3]){given.x, given.y, given.z},
           sizeof explanation->given);
}

int sb_effective_bits(const struct sb_task *task, const struct sb_driver *driver,
                      const char *axes)
{
    const struct sb_asked_precision asked =
        sb_platform_precision(&task->assembly.job.variant);
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        const struct sb_asked_term *term = &asked.term[i];
        const struct sb_precision_verdict *verdict = sb_driver_precision(
            driver, term->vertex_stage, term->carrier, term->declared);
        const bool reduced = asked.emulation != SB_EMULATED_NOT ||
                             (verdict && verdict->effective != SB_EFFECTIVE_FP32 &&
                              verdict->effective != SB_EFFECTIVE_UNKNOWN);
        if (term->declared > 0 && reduced && (!axes || strstr(axes, term->name)))
            return 11;
    }
    return 24;
}

static bool has_probe(const struct sb_task *task, struct sb_error *err)
{
    const struct sb_job *job = &task->assembly.job;
    for (int i = 0; i < job->program_count; i++)
        if (strcmp(job->program[i].role, "probe") == 0)
            return true;
    return sb_fail(
        err, SB_BAD_INPUT,
        "glsl=100: a shader of GLSL ES 1.00 has one output, and cannot tell what "
        "it computed on the way; valid: --glsl 300es");
}

// The displayed colour, and with it the size of the picture.
static bool read_own(struct source *source, struct sb_explanation *explanation,
                     struct sb_error *err)
{
    const struct sb_explain_params *params = source->params;
    const struct sb_image_request request = {.kind = SB_IMAGE_COLOUR};
    struct sb_image image = {0};
    if (!draw(source, &request, &image, err))
        return false;
    const int width = image.width, height = image.height;
    const bool inside =
        params->x >= 0 && params->y >= 0 && params->x < width && params->y < height;
    source->width = explanation->width = width;
    source->height = explanation->height = height;
    if (inside)
        memcpy(explanation->own, sb_image_at(&image, params->x, params->y),
               sizeof explanation->own);
    sb_image_free(&image);
    return inside ||
           sb_fail(err, SB_BAD_INPUT,
                   "pixel %d,%d: the picture has %d x %d pixels, counted from 0,0 at the "
                   "lower left",
                   params->x, params->y, width, height);
}

bool sb_explain(const struct sb_explain_params *params,
                struct sb_explanation *explanation, struct sb_error *err)
{
    struct source source = {
        .params = params,
        .per_vertex = params->task->assembly.lit_per_vertex,
        .width = params->width,
        .height = params->height,
    };
    const struct sb_image_request wide = {.kind = SB_IMAGE_COLOUR, .wide = true};
    *explanation = (struct sb_explanation){
        .x = params->x,
        .y = params->y,
        .wrong_point = -1,
        .wrong_light = -1,
        .wrong_term = -1,
    };
    for (int t = 0; t < SB_TERM_COUNT; t++)
        explanation->bits[t] =
            sb_effective_bits(params->task, params->driver, sb_term_rows[t].axes);
    if (!has_probe(params->task, err) || !read_own(&source, explanation, err) ||
        !sb_truths_get(params->truths, params->task, source.width, source.height,
                       &explanation->truth, err) ||
        !find_triangle(&source, explanation, err) ||
        !draw_pixel(&source, &wide, explanation->wide, err))
        return false;
    const struct sb_scene *scene = explanation->truth.scene;
    take_colours(explanation);
    if (explanation->draw < 0 || scene->draw[explanation->draw].lamp >= 0)
        return true;
    explanation->material = &scene->material[scene->draw[explanation->draw].material];
    explanation->light_count = sb_lights_total(&scene->lights);
    if (params->light_max > 0 && explanation->light_count > params->light_max)
        explanation->light_count = params->light_max;
    locate(&source, explanation);
    if (!compare_probe(&source, explanation, err) ||
        !read_inputs(&source, explanation, err) || !read_maps(&source, explanation, err))
        return false;
    for (int i = 0; i < explanation->point_count; i++) {
        list_lights(params, explanation, &explanation->point[i]);
        evaluate(params, explanation, &explanation->point[i]);
    }
    take_given(params, explanation);
    return read_lights(&source, explanation, err);
}

void sb_explanation_free(struct sb_explanation *explanation)
{
    sb_arena_free(&explanation->arena);
    *explanation = (struct sb_explanation){0};
}
