#include "reference/render.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/parallel.h"

void sb_ref_ground_make(struct sb_ref_ground *ground, const struct sb_scene *scene,
                        int width, int height, int threads)
{
    *ground = (struct sb_ref_ground){
        .scene = scene,
        .width = width,
        .height = height,
        .threads = threads,
        .geometry = sb_ref_geometry_new(scene, width, height),
        .cover = sb_alloc((size_t)width * (size_t)height * sizeof *ground->cover),
        .first_vertex =
            sb_alloc((size_t)scene->draw_count * sizeof *ground->first_vertex),
    };
    sb_ref_geometry_cover(ground->geometry, threads, ground->cover);
    sb_ref_geometry_rays(ground->geometry);
    for (int i = 0; i < scene->draw_count; i++) {
        ground->first_vertex[i] = ground->vertex_count;
        if (scene->draw[i].lamp < 0)
            ground->vertex_count += scene->mesh[scene->draw[i].mesh].vertex_count;
    }
}

void sb_ref_ground_free(struct sb_ref_ground *ground)
{
    sb_ref_geometry_free(&ground->geometry);
    free(ground->cover);
    free(ground->first_vertex);
    *ground = (struct sb_ref_ground){0};
}

bool sb_ref_ground_interior(const struct sb_ref_ground *ground, int x, int y)
{
    const struct sb_ref_cover at = ground->cover[(long)y * ground->width + x];
    if (at.draw < 0 || !sb_ref_geometry_inside(ground->geometry, at, x, y))
        return false;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < ground->height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < ground->width; i++)
            if (ground->cover[(long)j * ground->width + i].draw != at.draw)
                return false;
    return true;
}

void sb_ref_picture_free(struct sb_ref_picture *picture)
{
    sb_image64_free(&picture->colour);
    free(picture->decisions);
    free(picture->margin);
    free(picture->valid);
    free(picture->vertex);
    *picture = (struct sb_ref_picture){0};
}

// --- how it is lit -----------------------------------------------------------------------

enum model { IDEAL, MODEL, GIVEN };

struct lighting {
    struct sb_ref_shading shading;
    struct sb_light *light; // owned; NULL: the scene's own
};

static bool is_as_written(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN;
}

// The lights as the variant's shaders have them. The one array of layout=unified keeps
// directional lights as a vector to the light.
static struct sb_light *lights_as_lit(const struct sb_scene *scene,
                                      const struct sb_variant *variant)
{
    const int total = sb_lights_total(&scene->lights);
    const bool unified = variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    struct sb_light *light = sb_alloc(((size_t)total + 1) * sizeof *light);
    int at = 0;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        for (int i = 0; i < scene->lights.count[type]; i++, at++) {
            light[at] =
                sb_light_as_lit(&scene->lights.light[at], (enum sb_light_type)type,
                                variant, &scene->camera);
            for (int c = 0; unified && type == SB_LIGHT_DIR && c < 3; c++)
                light[at].direction[c] = -light[at].position[c];
        }
    return light;
}

// World space and the scene's own lights serve every space. What a slip does depends on the
// space that the text works in.
static void lighting_make(struct lighting *lighting, const struct sb_ref_ground *ground,
                          const struct sb_variant *variant, enum model model)
{
    const bool own_space = model == GIVEN || is_as_written(variant);
    *lighting = (struct lighting){
        .shading =
            {
                .variant = variant,
                .scene = ground->scene,
                .geometry = ground->geometry,
                .lights = ground->scene->lights,
                .view_space = own_space && variant->value[SB_AXIS_SPACE] == SB_SPACE_VIEW,
                .ideal = model == IDEAL,
            },
    };
    if (own_space) {
        lighting->light = lights_as_lit(ground->scene, variant);
        lighting->shading.lights.light = lighting->light;
    }
}

static struct sb_vec3 turned(const float *m, struct sb_vec3 v)
{
    return (struct sb_vec3){m[0] * v.x + m[4] * v.y + m[8] * v.z,
                            m[1] * v.x + m[5] * v.y + m[9] * v.z,
                            m[2] * v.x + m[6] * v.y + m[10] * v.z};
}

// From world space to the space of the lighting.
static struct sb_ref_input to_lighting(const struct lighting *lighting,
                                       const struct sb_ref_input *input)
{
    const float *view = lighting->shading.scene->camera.view;
    if (!lighting->shading.view_space)
        return *input;
    const struct sb_vec3 moved = {view[12], view[13], view[14]};
    struct sb_ref_input there = *input;
    there.position = sb_vec3_add(turned(view, input->position), moved);
    there.normal = turned(view, input->normal);
    there.tangent = turned(view, input->tangent);
    there.bitangent = turned(view, input->bitangent);
    return there;
}

static const struct sb_material *material_of(const struct sb_ref_ground *ground, int draw)
{
    return &ground->scene->material[ground->scene->draw[draw].material];
}

// --- what needs no lighting --------------------------------------------------------------

static struct sb_vec3 vec3_of(const float *v)
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

// The colour of the background and of lamps. False: the draw is lit.
static bool unlit(const struct sb_ref_ground *ground, int draw, struct sb_vec3 *colour)
{
    const struct sb_scene *scene = ground->scene;
    if (draw < 0) {
        *colour = vec3_of(scene->clear_colour);
        return true;
    }
    if (scene->draw[draw].lamp < 0)
        return false;
    int count;
    const struct sb_light *point = sb_lights_of(&scene->lights, SB_LIGHT_POINT, &count);
    *colour = vec3_of(point[scene->draw[draw].lamp].diffuse);
    return true;
}

// `shade`: NULL: of no one point.
static void put(struct sb_ref_picture *picture, int x, int y, struct sb_vec3 colour,
                const struct sb_ref_shade *shade)
{
    double *pixel = sb_image64_at(&picture->colour, x, y);
    const long at = (long)y * picture->colour.width + x;
    pixel[0] = colour.x;
    pixel[1] = colour.y;
    pixel[2] = colour.z;
    picture->decisions[at] = shade ? shade->decisions : 0;
    picture->margin[at] = shade ? (float)shade->margin : INFINITY;
    picture->valid[at] = 1;
}

// --- pictures ----------------------------------------------------------------------------

struct work {
    const struct sb_ref_ground *ground;
    const struct sb_ref_given *given;
    struct lighting lighting;
    enum model model;
    bool per_vertex;
    struct sb_ref_picture *picture;
};

// Where a mesh stands for a sphere, its outline does not end the sphere.
static struct sb_ref_cover seen(const struct sb_ref_ground *ground, int x, int y)
{
    const struct sb_ref_cover at = ground->cover[(long)y * ground->width + x];
    struct sb_ref_input input;
    for (int i = 0; at.draw < 0 && i < ground->scene->draw_count; i++) {
        const struct sb_ref_cover try = {.draw = i, .triangle = 0};
        if (ground->scene->mesh[ground->scene->draw[i].mesh].sphere &&
            sb_ref_geometry_truth(ground->geometry, try, x, y, &input))
            return try;
    }
    return at;
}

static void ideal_pixel(struct work *work, int x, int y)
{
    const struct sb_ref_ground *ground = work->ground;
    const struct sb_ref_shading *shading = &work->lighting.shading;
    const struct sb_ref_cover at = seen(ground, x, y);
    struct sb_ref_input input;
    struct sb_ref_shade shade;
    struct sb_vec3 colour;
    if (unlit(ground, at.draw, &colour)) {
        put(work->picture, x, y, colour, NULL);
    } else if (sb_ref_geometry_truth(ground->geometry, at, x, y, &input)) {
        input = to_lighting(&work->lighting, &input);
        sb_ref_shade(shading, &input, material_of(ground, at.draw), &shade, NULL);
        put(work->picture, x, y, sb_ref_colour(shading, &shade, &input), &shade);
    }
}

// `maps`: 12 values of SB_PROBE_MAPS; NULL: nothing is known of a driver's lookups.
static void take_texels(struct sb_ref_input *input, const float *maps)
{
    input->sampled = maps != NULL;
    for (int i = 0; maps && i < SB_MAP_COUNT; i++)
        input->texel[i] = vec3_of(maps + 3 * i);
}

// What the corners hand on, interpolated; uv from the vertices too.
static struct sb_vec3 gouraud(const struct sb_ref_shading *shading,
                              struct sb_ref_cover at, const double weight[3],
                              const struct sb_ref_shade *const corner[3],
                              const float *maps)
{
    struct sb_ref_input input = sb_ref_geometry_input(shading->geometry, at, weight);
    struct sb_ref_shade shade = {0};
    take_texels(&input, maps);
    for (int i = 0; i < 3; i++) {
        shade.diffuse =
            sb_vec3_add(shade.diffuse, sb_vec3_scale(corner[i]->diffuse, weight[i]));
        shade.specular =
            sb_vec3_add(shade.specular, sb_vec3_scale(corner[i]->specular, weight[i]));
    }
    return sb_ref_colour(shading, &shade, &input);
}

static void gouraud_pixel(struct work *work, int x, int y, struct sb_ref_cover at,
                          const double weight[3], const float *maps)
{
    const struct sb_ref_ground *ground = work->ground;
    const struct sb_ref_shade *shade[3];
    int corner[3];
    sb_ref_geometry_corners(ground->geometry, at, corner);
    for (int i = 0; i < 3; i++)
        shade[i] = &work->picture->vertex[ground->first_vertex[at.draw] + corner[i]];
    put(work->picture, x, y, gouraud(&work->lighting.shading, at, weight, shade, maps),
        NULL);
}

static void lit_pixel(struct work *work, int x, int y, int draw,
                      const struct sb_ref_input *input)
{
    const struct sb_ref_shading *shading = &work->lighting.shading;
    struct sb_ref_shade shade;
    sb_ref_shade(shading, input, material_of(work->ground, draw), &shade, NULL);
    put(work->picture, x, y, sb_ref_colour(shading, &shade, input), &shade);
}

static void model_pixel(struct work *work, int x, int y)
{
    const struct sb_ref_ground *ground = work->ground;
    const struct sb_ref_cover at = ground->cover[(long)y * ground->width + x];
    struct sb_vec3 colour;
    double weight[3];
    if (unlit(ground, at.draw, &colour)) {
        put(work->picture, x, y, colour, NULL);
    } else if (!sb_ref_geometry_weights(ground->geometry, at, x, y, weight)) {
        return; // seen edge-on
    } else if (work->per_vertex) {
        gouraud_pixel(work, x, y, at, weight, NULL);
    } else {
        struct sb_ref_input input = sb_ref_geometry_input(ground->geometry, at, weight);
        input = to_lighting(&work->lighting, &input);
        lit_pixel(work, x, y, at.draw, &input);
    }
}

static struct sb_ref_input given_input(const float *inputs, const float *frame,
                                       const float *maps)
{
    struct sb_ref_input input = {
        .position = vec3_of(inputs),
        .normal = vec3_of(inputs + 3),
        .uv = {inputs[6], inputs[7]},
    };
    if (frame) {
        input.tangent = vec3_of(frame);
        input.bitangent = vec3_of(frame + 3);
    }
    take_texels(&input, maps);
    return input;
}

enum { PROBE_COLOUR_CHANNELS = 4 }; // before the values of the page

static const float *page_at(const struct sb_image *image, int x, int y)
{
    return image ? sb_image_at(image, x, y) + PROBE_COLOUR_CHANNELS : NULL;
}

static void given_pixel(struct work *work, int x, int y)
{
    const struct sb_ref_ground *ground = work->ground;
    const struct sb_ref_given *given = work->given;
    const float *seen_by_driver = sb_image_at(given->geometry, x, y);
    const struct sb_ref_cover at = {.draw = (int)seen_by_driver[0] - 1,
                                    .triangle = (int)seen_by_driver[1] - 1};
    struct sb_vec3 colour;
    if (unlit(ground, at.draw, &colour)) {
        put(work->picture, x, y, colour, NULL);
    } else if (work->per_vertex) {
        const double second = seen_by_driver[2], third = seen_by_driver[3];
        const double weight[3] = {1 - second - third, second, third};
        gouraud_pixel(work, x, y, at, weight, page_at(given->maps, x, y));
    } else {
        struct sb_ref_input input =
            given_input(page_at(given->inputs, x, y), page_at(given->frame, x, y),
                        page_at(given->maps, x, y));
        input.lacks = material_of(ground, at.draw)->lacks;
        lit_pixel(work, x, y, at.draw, &input);
    }
}

static void render_row(void *user, int y)
{
    struct work *work = user;
    for (int x = 0; x < work->ground->width; x++) {
        if (work->model == IDEAL)
            ideal_pixel(work, x, y);
        else if (work->model == MODEL)
            model_pixel(work, x, y);
        else
            given_pixel(work, x, y);
    }
}

static void render_vertices(void *user, int draw)
{
    struct work *work = user;
    const struct sb_ref_ground *ground = work->ground;
    const struct sb_draw *it = &ground->scene->draw[draw];
    if (it->lamp >= 0)
        return;
    for (int i = 0; i < ground->scene->mesh[it->mesh].vertex_count; i++) {
        const struct sb_ref_input own = sb_ref_geometry_vertex(ground->geometry, draw, i);
        const struct sb_ref_input input = to_lighting(&work->lighting, &own);
        sb_ref_shade(&work->lighting.shading, &input, material_of(ground, draw),
                     &work->picture->vertex[ground->first_vertex[draw] + i], NULL);
    }
}

static void render(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                   enum model model, const struct sb_ref_given *given,
                   struct sb_ref_picture *picture)
{
    const size_t pixels = (size_t)ground->width * (size_t)ground->height;
    struct work work = {
        .ground = ground,
        .given = given,
        .model = model,
        .per_vertex = model != IDEAL && variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX,
        .picture = picture,
    };
    *picture = (struct sb_ref_picture){
        .decisions = sb_alloc(pixels * sizeof *picture->decisions),
        .margin = sb_alloc(pixels * sizeof *picture->margin),
        .valid = sb_alloc(pixels),
    };
    sb_image64_init(&picture->colour, ground->width, ground->height, 3);
    lighting_make(&work.lighting, ground, variant, model);
    if (work.per_vertex) {
        picture->vertex =
            sb_alloc(((size_t)ground->vertex_count + 1) * sizeof *picture->vertex);
        sb_parallel_for(ground->threads, ground->scene->draw_count, render_vertices,
                        &work);
    }
    sb_parallel_for(ground->threads, ground->height, render_row, &work);
    free(work.lighting.light);
}

void sb_ref_ideal(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  struct sb_ref_picture *picture)
{
    render(ground, variant, IDEAL, NULL, picture);
}

void sb_ref_model(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  struct sb_ref_picture *picture)
{
    render(ground, variant, MODEL, NULL, picture);
}

void sb_ref_given(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  const struct sb_ref_given *given, struct sb_ref_picture *picture)
{
    render(ground, variant, GIVEN, given, picture);
}

// --- one point ---------------------------------------------------------------------------

static void point_at(const struct lighting *lighting, const struct sb_material *material,
                     struct sb_ref_point *point)
{
    point->eye = lighting->shading.view_space
                     ? (struct sb_vec3){0, 0, 0}
                     : vec3_of(lighting->shading.scene->camera.eye);
    sb_ref_shade(&lighting->shading, &point->input, material, &point->shade,
                 point->terms);
    point->colour = sb_ref_colour(&lighting->shading, &point->shade, &point->input);
}

bool sb_ref_ideal_at(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                     int x, int y, struct sb_ref_point *point)
{
    struct lighting lighting;
    struct sb_vec3 colour;
    const struct sb_ref_cover at = seen(ground, x, y);
    if (unlit(ground, at.draw, &colour) ||
        !sb_ref_geometry_truth(ground->geometry, at, x, y, &point->input))
        return false;
    lighting_make(&lighting, ground, variant, IDEAL);
    point->input = to_lighting(&lighting, &point->input);
    point_at(&lighting, material_of(ground, at.draw), point);
    free(lighting.light);
    return true;
}

void sb_ref_given_at(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                     int draw, const float *inputs, const float *frame, const float *maps,
                     struct sb_ref_point *point)
{
    struct lighting lighting;
    lighting_make(&lighting, ground, variant, GIVEN);
    point->input = given_input(inputs, frame, maps);
    point->input.lacks = material_of(ground, draw)->lacks;
    point_at(&lighting, material_of(ground, draw), point);
    free(lighting.light);
}

void sb_ref_vertex_at(const struct sb_ref_ground *ground,
                      const struct sb_variant *variant, int draw, int vertex,
                      struct sb_ref_point *point)
{
    struct lighting lighting;
    lighting_make(&lighting, ground, variant, GIVEN);
    point->input = sb_ref_geometry_vertex(ground->geometry, draw, vertex);
    point->input = to_lighting(&lighting, &point->input);
    point_at(&lighting, material_of(ground, draw), point);
    free(lighting.light);
}

struct sb_vec3 sb_ref_gouraud_at(const struct sb_ref_ground *ground,
                                 const struct sb_variant *variant, struct sb_ref_cover at,
                                 const double weight[3],
                                 const struct sb_ref_shade *corner[3], const float *maps)
{
    struct lighting lighting;
    lighting_make(&lighting, ground, variant, GIVEN);
    const struct sb_vec3 colour = gouraud(&lighting.shading, at, weight, corner, maps);
    free(lighting.light);
    return colour;
}
