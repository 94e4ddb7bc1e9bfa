// Pictures first: a wrong picture has no time worth comparing.
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "gate/state.h"
#include "measure/accuracy.h"
#include "measure/check.h"
#include "measure/interrupt.h"

// How much worse an error may read and still be no worse: a twentieth of it, and a quarter of an
// 8-bit step, linear light, which rounding alone may make; of FLIP's mean a thousandth.
#define SLACK_SHARE 0.05
#define SLACK_STEP  (0.25 / 255)
#define SLACK_FLIP  1e-3

// An error that head alone does not have, as no pixel of it can be judged, is no better one.
static bool is_worse(double base, double head, double slack)
{
    return !isnan(base) && !(head <= base + slack);
}

static double slack(double base)
{
    return SLACK_SHARE * base + SLACK_STEP;
}

static bool draw(const struct sb_task *task, const struct sb_driver *driver,
                 struct sb_image *image, struct sb_error *err)
{
    const struct sb_image_request request = {.job = task->assembly.job.id,
                                             .kind = SB_IMAGE_COLOUR};
    return driver->fns->image(driver->runner, &request, image, err);
}

// *equal: bit by bit, in the variant's own target. Pictures of two sizes are not.
static bool compare(struct sb_gate_session *session, struct sb_gate_pair *pair,
                    bool *equal, struct sb_error *err)
{
    struct sb_image image[SB_SIDES] = {{0}};
    struct sb_image_difference difference = {0};
    bool good = true;
    for (int side = 0; good && side < SB_SIDES; side++)
        good = draw(&pair->task[side], &session->driver[side], &image[side], err);
    const bool same_size =
        good && image[0].width == image[1].width && image[0].height == image[1].height;
    if (same_size)
        sb_image_compare(&image[SB_BASE], &image[SB_HEAD], &difference);
    *equal = same_size && difference.pixels == 0;
    sb_image_free(&image[SB_BASE]);
    sb_image_free(&image[SB_HEAD]);
    return good;
}

static void say_worse(struct sb_gate_pair *pair)
{
    const struct sb_accuracy *base = &pair->task[SB_BASE].accuracy;
    const struct sb_accuracy *head = &pair->task[SB_HEAD].accuracy;
    struct sb_error err;
    sb_fail(&err, SB_WORSE_PICTURE,
            "max error %.3g/255 -> %.3g/255 at (%d, %d), 99.9 %% %.3g/255 -> %.3g/255, "
            "FLIP %.3g -> %.3g%s%s",
            255 * base->total.max, 255 * head->total.max, head->total.max_x,
            head->total.max_y, 255 * base->total.p999, 255 * head->total.p999,
            base->flip.mean, head->flip.mean, head->term ? ", term " : "",
            head->term ? head->term : "");
    sb_task_fail(&pair->task[SB_HEAD], &err);
    pair->picture = "worse";
}

static void judge_changed(struct sb_gate_session *session, struct sb_gate_pair *pair,
                          struct sb_truths *truths)
{
    struct sb_error ignored = {0};
    for (int side = 0; side < SB_SIDES; side++) {
        struct sb_driver *driver = &session->driver[side];
        if (driver->probe.count == 0) // which term went wrong depends on the precision
            sb_driver_probe(driver, &ignored);
        sb_accuracy_measure(&pair->task[side], driver, truths);
    }
    const struct sb_accuracy *base = &pair->task[SB_BASE].accuracy;
    const struct sb_accuracy *head = &pair->task[SB_HEAD].accuracy;
    pair->picture = "changed";
    if (!base->known || !head->known) {
        sb_task_note(&pair->task[SB_HEAD],
                     "the picture changed, and cannot be held against the reference");
        return;
    }
    pair->picture = "no_worse";
    if (is_worse(base->total.max, head->total.max, slack(base->total.max)) ||
        is_worse(base->total.p999, head->total.p999, slack(base->total.p999)) ||
        is_worse(base->flip.mean, head->flip.mean, SLACK_FLIP))
        say_worse(pair);
}

// A picture that changed must still be that of the others of its class, wherever in the plan they
// stand. What has not changed agrees as much as it did on base's side, which is no matter of head's.
static void check_class(struct sb_gate_session *session, int place)
{
    const struct sb_axes *axes = &session->params->side[SB_HEAD].suite->axes;
    struct sb_task *task = &session->pair[place].task[SB_HEAD];
    for (int i = 0; i < session->pair_count && sb_task_sound(task); i++) {
        struct sb_task *other = &session->pair[i].task[SB_HEAD];
        if (i != place && sb_task_sound(other) && other->loaded &&
            strcmp(task->entry->scene, other->entry->scene) == 0 &&
            sb_variant_same_class(axes, &task->entry->variant, &other->entry->variant))
            sb_check_class(task, other, &session->driver[SB_HEAD]);
    }
}

static void judge(struct sb_gate_session *session, int place, struct sb_truths *truths)
{
    struct sb_gate_pair *pair = &session->pair[place];
    struct sb_task *head = &pair->task[SB_HEAD];
    struct sb_error err = {0};
    bool equal = false;
    for (int side = 0; side < SB_SIDES; side++)
        if (sb_task_sound(&pair->task[side]))
            sb_check_picture(&pair->task[side], &session->driver[side]);
    if (!sb_task_sound(head) || !sb_task_sound(&pair->task[SB_BASE]))
        return;
    if (head->assembly.undefined) {
        pair->picture = "undefined";
        return;
    }
    if (!compare(session, pair, &equal, &err)) {
        sb_task_fail(head, &err);
        return;
    }
    pair->picture = "equal";
    if (equal)
        return;
    judge_changed(session, pair, truths);
    check_class(session, place);
}

void sb_gate_pictures(struct sb_gate_session *session)
{
    struct sb_truths *truths = sb_truths_new(&session->params->side[SB_HEAD].suite->axes);
    for (int i = 0; i < session->pair_count && !sb_interrupted(); i++) {
        struct sb_gate_pair *pair = &session->pair[i];
        if (pair->task[SB_BASE].loaded && pair->task[SB_HEAD].loaded && pair->timed)
            judge(session, i, truths);
    }
    sb_truths_free(&truths);
}
