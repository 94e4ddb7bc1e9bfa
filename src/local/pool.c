// Scenes and targets that jobs share. A sweep prepares many variants of one scene and one
// size: each scene is uploaded once, and each size has one ring.
#include "local/state.h"

#include <stdlib.h>

#include "base/mem.h"

static void scene_free(struct sb_shared_scene *shared)
{
    sb_upload_free(&shared->upload);
    sb_scene_free(&shared->scene);
    free(shared);
}

struct sb_shared_scene *sb_pool_scene_get(struct sb_pool *pool, const char *name,
                                          const struct sb_variant *variant,
                                          struct sb_error *err)
{
    struct sb_shared_scene *made = sb_alloc(sizeof *made);
    if (!sb_scene_make(name, variant, &made->scene, err)) {
        scene_free(made);
        return NULL;
    }
    made->hash = sb_scene_hash(&made->scene);
    for (struct sb_shared_scene *old = pool->scenes; old; old = old->next) {
        if (old->hash == made->hash) {
            scene_free(made);
            old->users++;
            return old;
        }
    }
    sb_upload_make(&made->upload, &made->scene);
    made->users = 1;
    made->next = pool->scenes;
    pool->scenes = made;
    return made;
}

void sb_pool_scene_put(struct sb_pool *pool, struct sb_shared_scene *scene)
{
    if (!scene || --scene->users > 0)
        return;
    struct sb_shared_scene **link = &pool->scenes;
    while (*link != scene)
        link = &(*link)->next;
    *link = scene->next;
    scene_free(scene);
}

struct sb_shared_ring *sb_pool_ring_get(struct sb_pool *pool, const struct sb_caps *caps,
                                        const struct sb_shape *shape,
                                        struct sb_error *err)
{
    for (struct sb_shared_ring *old = pool->rings; old; old = old->next) {
        if (old->shape.width == shape->width && old->shape.height == shape->height &&
            old->shape.format == shape->format && old->shape.samples == shape->samples) {
            old->users++;
            return old;
        }
    }
    struct sb_shared_ring *made = sb_alloc(sizeof *made);
    if (!sb_ring_make(&made->ring, caps, shape, err)) {
        sb_ring_free(&made->ring);
        free(made);
        return NULL;
    }
    made->shape = *shape;
    made->users = 1;
    made->next = pool->rings;
    pool->rings = made;
    return made;
}

void sb_pool_ring_put(struct sb_pool *pool, struct sb_shared_ring *ring)
{
    if (!ring || --ring->users > 0)
        return;
    struct sb_shared_ring **link = &pool->rings;
    while (*link != ring)
        link = &(*link)->next;
    *link = ring->next;
    sb_ring_free(&ring->ring);
    free(ring);
}
