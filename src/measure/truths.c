#include "measure/truths.h"

#include <stdlib.h>

#include "base/hash.h"
#include "base/mem.h"
#include "base/parallel.h"
#include "reference/share.h"

// What is kept takes no more than this, and the last three things asked for.
static const size_t BYTES_KEPT = (size_t)400 << 20;

enum kind { GROUND, IDEAL, MODEL };

struct kept {
    struct kept *next; // used longer ago
    enum kind kind;
    uint64_t key;
    size_t bytes;
    struct sb_scene scene;         // of a ground
    struct sb_ref_ground ground;   // likewise
    struct sb_ref_picture picture; // of the others
};

struct sb_truths {
    const struct sb_axes *axes;
    struct kept *first; // used last
    int rendered;
};

struct sb_truths *sb_truths_new(const struct sb_axes *axes)
{
    struct sb_truths *truths = sb_alloc(sizeof *truths);
    truths->axes = axes;
    return truths;
}

static void kept_free(struct kept *kept)
{
    sb_ref_picture_free(&kept->picture);
    sb_ref_ground_free(&kept->ground);
    sb_scene_free(&kept->scene);
    free(kept);
}

void sb_truths_free(struct sb_truths **truths)
{
    while (*truths && (*truths)->first) {
        struct kept *kept = (*truths)->first;
        (*truths)->first = kept->next;
        kept_free(kept);
    }
    free(*truths);
    *truths = NULL;
}

int sb_truths_rendered(const struct sb_truths *truths)
{
    return truths->rendered;
}

static void put_first(struct sb_truths *truths, struct kept *kept)
{
    kept->next = truths->first;
    truths->first = kept;
}

// What was used longest ago goes.
static void trim(struct sb_truths *truths)
{
    size_t bytes = 0;
    int count = 0;
    for (struct kept **link = &truths->first; *link;) {
        struct kept *kept = *link;
        bytes += kept->bytes;
        if (++count <= 3 || bytes <= BYTES_KEPT) {
            link = &kept->next;
            continue;
        }
        *link = kept->next;
        kept_free(kept);
    }
}

// NULL: it must be made. What is found becomes the one used last.
static struct kept *find(struct sb_truths *truths, enum kind kind, uint64_t key)
{
    for (struct kept **link = &truths->first; *link; link = &(*link)->next) {
        struct kept *kept = *link;
        if (kept->kind != kind || kept->key != key)
            continue;
        *link = kept->next;
        put_first(truths, kept);
        return kept;
    }
    return NULL;
}

static struct kept *add(struct sb_truths *truths, enum kind kind, uint64_t key,
                        size_t bytes)
{
    struct kept *kept = sb_alloc(sizeof *kept);
    kept->kind = kind;
    kept->key = key;
    kept->bytes = bytes;
    put_first(truths, kept);
    return kept;
}

static uint64_t with_size(uint64_t key, int width, int height)
{
    const int size[2] = {width, height};
    return sb_hash(key, size, sizeof size);
}

static struct kept *ground_of(struct sb_truths *truths, const struct sb_task *task,
                              int width, int height, struct sb_error *err)
{
    const uint64_t key = with_size(task->prepared.input_hash, width, height);
    struct kept *kept = find(truths, GROUND, key);
    if (kept)
        return kept;
    struct sb_scene scene = {0};
    if (!sb_scene_make(task->entry->scene, &task->assembly.job.variant, &scene, err)) {
        sb_scene_free(&scene);
        return NULL;
    }
    const size_t pixels = (size_t)width * (size_t)height;
    const size_t triangles = (size_t)sb_scene_triangles(&scene);
    kept = add(truths, GROUND, key, 8 * pixels + 400 * triangles);
    kept->scene = scene;
    sb_ref_ground_make(&kept->ground, &kept->scene, width, height, sb_processors());
    return kept;
}

static const struct sb_ref_picture *picture_of(struct sb_truths *truths, enum kind kind,
                                               const struct kept *ground,
                                               const struct sb_variant *variant)
{
    const int width = ground->ground.width, height = ground->ground.height;
    const uint64_t share = kind == IDEAL
                               ? sb_ref_ideal_key(truths->axes, variant, &ground->scene)
                               : sb_ref_model_key(truths->axes, variant, &ground->scene);
    const uint64_t key = with_size(share, width, height);
    struct kept *kept = find(truths, kind, key);
    if (!kept) {
        kept = add(truths, kind, key, 33 * (size_t)width * (size_t)height);
        (kind == IDEAL ? sb_ref_ideal : sb_ref_model)(&ground->ground, variant,
                                                      &kept->picture);
        truths->rendered++;
    }
    return &kept->picture;
}

bool sb_truths_get(struct sb_truths *truths, const struct sb_task *task, int width,
                   int height, struct sb_truth *truth, struct sb_error *err)
{
    const struct sb_variant *variant = &task->assembly.job.variant;
    const struct kept *ground = ground_of(truths, task, width, height, err);
    if (!ground)
        return false;
    *truth = (struct sb_truth){
        .scene = &ground->scene,
        .ground = &ground->ground,
        .ideal = picture_of(truths, IDEAL, ground, variant),
        .model = picture_of(truths, MODEL, ground, variant),
    };
    // The three that were asked for last stand first.
    trim(truths);
    return true;
}
