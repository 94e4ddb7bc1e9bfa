#include "scene/scene.h"

#include <string.h>

#include "base/hash.h"
#include "base/words.h"
#include "scene/make.h"

// clang-format off
const struct sb_scene_row sb_scene_rows[] = {
    {"containers", "ten turned cubes, a sun, lamps, a flashlight", sb_scene_containers, false},
    {"sphere",     "one sphere, lit from the viewer's side",       sb_scene_sphere,     true},
    {"plane",      "a corridor with many lamps of short reach",    sb_scene_plane,      false},
    {"tunnel",     "a corridor with the wikibook's two lights",    sb_scene_tunnel,     false},
    {"blocks",     "a field of blocks under a sun that moves",     sb_scene_blocks,     false},
    {"spheres",    "eight spheres, each of its own material",      sb_scene_spheres,    false},
    {"room",       "a closed room, for shadows of point lights",   sb_scene_room,       false},
    {"night",      "a yard at night, with one lamp",               sb_scene_night,      false},
    {"flashlight", "a dark yard, a flashlight on a few things",    sb_scene_flashlight, false},
    {"lamps4",     "four lamps over a few things",                 sb_scene_lamps4,     false},
    {"lamps64",    "a field of tiles, each reached by few of 64 lamps", sb_scene_lamps64, false},
    {"mixed",      "matte and glossy things",                      sb_scene_mixed,      false},
    {"partly_mapped", "things with all maps, some, and none",      sb_scene_partly_mapped, false},
    {"one_caster", "a lamp whose shadows fall on a few things",    sb_scene_one_caster, false},
};
// clang-format on
const int sb_scene_row_count = sizeof sb_scene_rows / sizeof *sb_scene_rows;

const struct sb_scene_row *sb_scene_expect(const char *name, struct sb_error *err)
{
    const char *names[24];
    for (int i = 0; i < sb_scene_row_count; i++) {
        if (strcmp(sb_scene_rows[i].name, name) == 0)
            return &sb_scene_rows[i];
        names[i] = sb_scene_rows[i].name;
    }
    sb_fail_unknown(err, "", "scene", name, names, sb_scene_row_count);
    return NULL;
}

bool sb_scene_analytic(const char *name)
{
    for (int i = 0; i < sb_scene_row_count; i++)
        if (strcmp(sb_scene_rows[i].name, name) == 0)
            return sb_scene_rows[i].analytic;
    return false;
}

bool sb_scene_make(const char *name, const struct sb_variant *variant,
                   struct sb_scene *scene, struct sb_error *err)
{
    const struct sb_scene_row *row = sb_scene_expect(name, err);
    if (!row)
        return false;
    scene->name = row->name;
    row->make(scene, variant);
    return sb_scene_validate(scene, err);
}

void sb_scene_free(struct sb_scene *scene)
{
    sb_arena_free(&scene->arena);
    *scene = (struct sb_scene){0};
}

static uint64_t hash_array(uint64_t hash, const void *data, int count, size_t element)
{
    hash =
        sb_hash(hash, &count, sizeof count); // so that neighbours cannot trade elements
    return sb_hash(hash, data, (size_t)count * element);
}

uint64_t sb_scene_hash(const struct sb_scene *scene)
{
    uint64_t hash = SB_HASH_START;
    for (int i = 0; i < scene->mesh_count; i++) {
        const struct sb_mesh *mesh = &scene->mesh[i];
        hash = hash_array(hash, mesh->vertex, mesh->vertex_count, sizeof *mesh->vertex);
        hash = hash_array(hash, mesh->index, mesh->index_count, sizeof *mesh->index);
    }
    hash =
        hash_array(hash, scene->material, scene->material_count, sizeof *scene->material);
    hash = hash_array(hash, scene->draw, scene->draw_count, sizeof *scene->draw);
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        const struct sb_texture *map = &scene->map[i];
        hash = sb_hash(hash, &map->width, sizeof map->width);
        hash = hash_array(hash, map->texel, map->width * map->height, 4);
    }
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        int count;
        const struct sb_light *light = sb_lights_of(&scene->lights, type, &count);
        hash = hash_array(hash, light, count, sizeof *light);
    }
    hash = sb_hash(hash, scene->ambient, sizeof scene->ambient);
    hash = sb_hash(hash, scene->clear_colour, sizeof scene->clear_colour);
    return sb_hash(hash, &scene->camera, sizeof scene->camera);
}

int64_t sb_scene_triangles(const struct sb_scene *scene)
{
    int64_t triangles = 0;
    for (int i = 0; i < scene->draw_count; i++)
        triangles += scene->mesh[scene->draw[i].mesh].index_count / 3;
    return triangles;
}
