// Far from the origin, and places in textures.
#include <math.h>
#include <stdio.h>

#include "base/text.h"
#include "cases/judge.h"
#include "cases/picture.h"
#include "cases/unit.h"
#include "cases/vectors.h"

// --- large-world --------------------------------------------------------------------------

static bool picture_at(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, double offset,
                       struct sb_case_picture *picture, struct sb_error *err)
{
    struct sb_variant variant;
    char words[64];
    snprintf(words, sizeof words, "offset=%.0f", offset);
    return sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                           words, &variant, err) &&
           sb_case_picture(&(struct sb_case_picture_params){env, &variant, "containers"},
                           picture, err);
}

// How many pixels have to show the same triangle as at the origin. A space that holds far out moves
// no edge but by rounding; where world space has moved them, its lighting is judged by the rest.
static double same_share(const struct sb_case_setting *setting)
{
    return setting->form == SB_CASE_ROBUST ? 0.99 : 0.5;
}

// The largest difference to the picture of the same world at the origin, up to the first offset that
// is too far: farther out nothing is left to compare.
bool sb_vectors_far_world(const struct sb_case_env *env, const struct sb_case *it,
                          const struct sb_case_setting *setting,
                          struct sb_outcome *outcome, struct sb_error *err)
{
    static const double offset[] = {1e4, 1e6, 1e9};
    const double bound = sb_criterion_bound(&it->criterion[0], setting->precision);
    struct sb_case_picture wanted = {0};
    bool good = picture_at(env, it, setting, 0, &wanted, err);
    double worst = 0;
    for (size_t i = 0; good && worst <= bound && i < sizeof offset / sizeof *offset;
         i++) {
        struct sb_case_picture got = {0};
        good = picture_at(env, it, setting, offset[i], &got, err);
        if (good) {
            worst =
                fmax(worst, sb_case_picture_compare(&got, &wanted, same_share(setting)));
            if (worst > bound)
                sb_text_printf(&outcome->note, "from an offset of %g on", offset[i]);
        }
        sb_case_picture_free(&got);
    }
    sb_case_picture_free(&wanted);
    if (good)
        sb_vectors_judge(&it->criterion[0], setting, worst, outcome);
    return good;
}

// --- fragcoord-16 -------------------------------------------------------------------------

enum { TEXELS = 2048 };

// Which texel a coordinate falls into, of the texels' centres. No shader of ours looks anything up
// by gl_FragCoord; the texture coordinate is a varying like it, and is lost in the same way.
bool sb_vectors_lookups(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_outcome *outcome,
                        struct sb_error *err)
{
    struct sb_unit unit = {0};
    struct sb_unit_told told = {0};
    struct sb_points points;
    const struct sb_unit_params params = {
        .axes = env->axes,
        .variant = setting->variant,
        .driver = env->driver,
        .data_dir = env->data_dir,
        .shaders = env->shaders,
        .id = sb_case_next_job(),
    };
    sb_points_init(&points, setting->variant);
    for (int i = 0; i < TEXELS; i++)
        sb_points_add(&points)->uv[0] = (float)((i + 0.5) / TEXELS);
    int flips = 0;
    const bool good =
        sb_unit_open(&unit, &params, err) && sb_unit_light(&unit, &points, 0, &told, err);
    for (int i = 0; good && i < TEXELS; i++)
        flips += floor(sb_told_page(&told.inputs, i)[6] * TEXELS) != i;
    if (good && setting->form == SB_CASE_NAIVE && flips == 0)
        sb_text_add(&outcome->note, "the driver keeps a mediump coordinate in 32 bits");
    if (good)
        sb_vectors_judge(&it->criterion[0], setting, 100.0 * flips / TEXELS, outcome);
    sb_unit_told_free(&told);
    sb_points_free(&points);
    sb_unit_close(&unit);
    return good;
}
