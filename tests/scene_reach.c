// Every light of every scene changes what the eye sees, by every law of attenuation, cone and
// shape. A small picture is traced by brute force, so what is hidden does not count; then each
// light is added up at what it shows.
#include "scene.h"

#include "math/mat.h"

enum { SIZE = 48, LIGHTS = 256 };

static struct sb_vec3 vec3(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

struct point {
    struct sb_vec3 position, normal; // world space
};

struct triangle {
    struct point corner[3];
};

struct picture {
    struct triangle *triangle;
    int triangle_count;
    struct point pixel[SIZE * SIZE];
    int seen[SIZE * SIZE]; // the triangle at a pixel, or -1
};

static struct point placed(const struct sb_draw *draw, const struct sb_vertex *vertex)
{
    const float *m = draw->model, *n = draw->normal_matrix;
    const struct sb_vec3 p = vec3(vertex->position), o = vec3(vertex->normal);
    const struct sb_vec3 normal = {n[0] * o.x + n[3] * o.y + n[6] * o.z,
                                   n[1] * o.x + n[4] * o.y + n[7] * o.z,
                                   n[2] * o.x + n[5] * o.y + n[8] * o.z};
    return (struct point){
        .position = {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                     m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                     m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]},
        .normal = sb_vec3_normalise(normal),
    };
}

static void collect_triangles(struct picture *picture, const struct sb_scene *scene)
{
    picture->triangle =
        calloc((size_t)sb_scene_triangles(scene), sizeof(struct triangle));
    for (int d = 0; d < scene->draw_count; d++) {
        const struct sb_draw *draw = &scene->draw[d];
        const struct sb_mesh *mesh = &scene->mesh[draw->mesh];
        for (int i = 0; i < mesh->index_count; i += 3) {
            struct triangle *it = &picture->triangle[picture->triangle_count++];
            for (int k = 0; k < 3; k++)
                it->corner[k] = placed(draw, &mesh->vertex[mesh->index[i + k]]);
        }
    }
}

// Where the ray meets the front of the triangle (Moeller and Trumbore 1997), or infinity.
static double hit(const struct triangle *it, struct sb_vec3 from, struct sb_vec3 way,
                  double *u, double *v)
{
    const struct sb_vec3 a = it->corner[0].position;
    const struct sb_vec3 ab = sb_vec3_sub(it->corner[1].position, a);
    const struct sb_vec3 ac = sb_vec3_sub(it->corner[2].position, a);
    const struct sb_vec3 p = sb_vec3_cross(way, ac), t = sb_vec3_sub(from, a);
    const double det = sb_vec3_dot(ab, p);
    if (det <= 0)
        return INFINITY;
    *u = sb_vec3_dot(t, p) / det;
    const struct sb_vec3 q = sb_vec3_cross(t, ab);
    *v = sb_vec3_dot(way, q) / det;
    const double distance = sb_vec3_dot(ac, q) / det;
    // A ray through an edge must not fall between its triangles.
    const bool inside = *u >= -1e-12 && *v >= -1e-12 && *u + *v <= 1 + 1e-12;
    return inside && distance > 0 ? distance : INFINITY;
}

static struct sb_vec3 ray(const struct sb_camera *camera, int x, int y)
{
    const double right = ((x + 0.5) / SIZE * 2 - 1) / camera->projection[0];
    const double up = ((y + 0.5) / SIZE * 2 - 1) / camera->projection[5];
    const float *v = camera->view; // its rows are the axes of the view
    return (struct sb_vec3){v[0] * right + v[1] * up - v[2],
                            v[4] * right + v[5] * up - v[6],
                            v[8] * right + v[9] * up - v[10]};
}

static struct point between(const struct triangle *it, double u, double v)
{
    const double weight[3] = {1 - u - v, u, v};
    struct point point = {{0, 0, 0}, {0, 0, 0}};
    for (int k = 0; k < 3; k++) {
        point.position =
            sb_vec3_add(point.position, sb_vec3_scale(it->corner[k].position, weight[k]));
        point.normal =
            sb_vec3_add(point.normal, sb_vec3_scale(it->corner[k].normal, weight[k]));
    }
    point.normal = sb_vec3_normalise(point.normal);
    return point;
}

static void trace(struct picture *picture, const struct sb_scene *scene)
{
    collect_triangles(picture, scene);
    const struct sb_vec3 eye = vec3(scene->camera.eye);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const struct sb_vec3 way = ray(&scene->camera, i % SIZE, i / SIZE);
        double nearest = INFINITY, u = 0, v = 0;
        picture->seen[i] = -1;
        for (int k = 0; k < picture->triangle_count; k++) {
            const double distance = hit(&picture->triangle[k], eye, way, &u, &v);
            if (distance >= nearest)
                continue;
            nearest = distance;
            picture->seen[i] = k;
            picture->pixel[i] = between(&picture->triangle[k], u, v);
        }
    }
}

// --- the laws --------------------------------------------------------------------------

static double no_law(const struct sb_light *light, double d)
{
    (void)light;
    (void)d;
    return 1;
}

static double polynomial(const struct sb_light *light, double d)
{
    return 1 / (light->constant + light->linear * d + light->quadratic * d * d);
}

static double by_radius(const struct sb_light *light, double d)
{
    return fmax(1 - d / light->range, 0);
}

// Karis, "Real Shading in Unreal Engine 4" (2013).
static double windowed(const struct sb_light *light, double d)
{
    const double window = fmax(1 - pow(d / light->range, 4), 0);
    return window * window / (d * d + 1);
}

static double hard(const struct sb_light *light, double cosine)
{
    return cosine > light->cos_cutoff ? 1 : 0;
}

static double by_exponent(const struct sb_light *light, double cosine)
{
    return cosine > light->cos_cutoff ? pow(fmax(cosine, 0), light->exponent) : 0;
}

static double linear(const struct sb_light *light, double cosine)
{
    return fmax(1 - (1 - cosine) * light->inv_one_minus_cos, 0);
}

static double smooth(const struct sb_light *light, double cosine)
{
    return fmin(fmax(cosine * light->cone_scale + light->cone_offset, 0), 1);
}

// Where the light of each shape comes from that reaches a point first.
static struct sb_vec3 middle(const struct sb_light *light, struct sb_vec3 at)
{
    (void)at;
    return vec3(light->position);
}

static struct sb_vec3 nearest_of_segment(const struct sb_light *light, struct sb_vec3 at)
{
    const struct sb_vec3 half = vec3(light->direction), centre = vec3(light->position);
    const double t = sb_vec3_dot(sb_vec3_sub(at, centre), half) / sb_vec3_dot(half, half);
    return sb_vec3_add(centre, sb_vec3_scale(half, fmin(fmax(t, -1), 1)));
}

static struct sb_vec3 nearest_of_box(const struct sb_light *light, struct sb_vec3 at)
{
    const struct sb_vec3 c = vec3(light->position), half = vec3(light->extent);
    return (struct sb_vec3){fmin(fmax(at.x, c.x - half.x), c.x + half.x),
                            fmin(fmax(at.y, c.y - half.y), c.y + half.y),
                            fmin(fmax(at.z, c.z - half.z), c.z + half.z)};
}

typedef double (*law)(const struct sb_light *light, double x);
typedef struct sb_vec3 (*shape)(const struct sb_light *light, struct sb_vec3 at);
static const law attenuations[] = {no_law, polynomial, by_radius, windowed};
static const law cones[] = {hard, by_exponent, linear, smooth};
static const shape shapes[] = {middle, nearest_of_segment, nearest_of_box};
enum { LAWS = 4, SHAPES = 3 };

struct laws {
    law attenuation, cone;
    shape shape;
};

// The brightest component of the light's diffuse contribution.
static double diffuse(const struct sb_light *light, enum sb_light_type type,
                      const struct laws *laws, struct point at)
{
    const float *colour = light->diffuse, *way = light->direction;
    struct sb_vec3 to_light = sb_vec3_scale(vec3(way), -1);
    double factor = 1;
    if (type != SB_LIGHT_DIR) {
        to_light = sb_vec3_sub(laws->shape(light, at.position), at.position);
        const double d = sb_vec3_length(to_light);
        factor = laws->attenuation(light, d);
        if (type == SB_LIGHT_SPOT)
            factor *= laws->cone(light, -sb_vec3_dot(vec3(way), to_light) / d);
    }
    const double facing = sb_vec3_dot(at.normal, sb_vec3_normalise(to_light));
    return factor * fmax(facing, 0) * fmax(colour[0], fmax(colour[1], colour[2]));
}

// A float sum of some 10 resolves 1e-6: a hundred times that cannot vanish.
#define VISIBLE 1e-4

// Whether the light adds something to any pixel: lit there, or at the corners of what is
// there.
static bool changes_a_pixel(const struct picture *picture, const struct sb_light *light,
                            enum sb_light_type type, const struct laws *laws,
                            bool at_vertices)
{
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (picture->seen[i] < 0)
            continue;
        const struct triangle *it = &picture->triangle[picture->seen[i]];
        for (int k = 0; k < (at_vertices ? 3 : 1); k++) {
            const struct point at = at_vertices ? it->corner[k] : picture->pixel[i];
            if (diffuse(light, type, laws, at) > VISIBLE)
                return true;
        }
    }
    return false;
}

static void check_light(const struct picture *picture, const struct sb_scene *scene,
                        enum sb_light_type type, int number, bool at_vertices)
{
    const struct sb_light *light = light_of(scene, type, number);
    const int attenuation_count = type == SB_LIGHT_DIR ? 1 : LAWS;
    const int cone_count = type == SB_LIGHT_SPOT ? LAWS : 1;
    const int shape_count = type == SB_LIGHT_AREA ? SHAPES : 1;
    for (int i = 0; i < attenuation_count * cone_count * shape_count; i++) {
        const int a = i % attenuation_count, c = i / attenuation_count % cone_count;
        const int s = i / attenuation_count / cone_count;
        const struct laws laws = {attenuations[a], cones[c], shapes[s]};
        if (changes_a_pixel(picture, light, type, &laws, at_vertices))
            continue;
        print_error("%s: %s %d changes nothing (attenuation %d, cone %d, shape %d)\n",
                    scene->name, sb_light_structs[type].name, number, a, c, s);
        fail();
    }
}

static void check_variant(const char *name, const struct sb_variant *variant,
                          bool at_vertices)
{
    struct sb_scene scene = made(name, variant);
    struct picture *picture = calloc(1, sizeof *picture);
    trace(picture, &scene);
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        for (int i = 0; i < scene.lights.count[type]; i++)
            check_light(picture, &scene, type, i, at_vertices);
    }
    free(picture->triangle);
    free(picture);
    sb_scene_free(&scene);
}

static struct sb_variant many_lights(double tessellation)
{
    struct sb_variant variant = scene_variant(LIGHTS, LIGHTS, LIGHTS);
    variant.value[SB_AXIS_AREA] = LIGHTS;
    variant.value[SB_AXIS_TESSELLATION] = tessellation;
    return variant;
}

static void every_light_changes_a_pixel_lit_by_fragment(void **state)
{
    (void)state;
    const struct sb_variant variant = many_lights(400);
    for (int i = 0; i < sb_scene_row_count; i++)
        check_variant(sb_scene_rows[i].name, &variant, false);
}

static void every_light_changes_a_pixel_lit_by_vertex(void **state)
{
    (void)state;
    const struct sb_variant variant = many_lights(2000);
    for (int i = 0; i < sb_scene_row_count; i++)
        check_variant(sb_scene_rows[i].name, &variant, true);
}

static void every_light_reaches_the_corners_of_the_plainest_containers(void **state)
{
    (void)state;
    const struct sb_variant variant = many_lights(12);
    check_variant("containers", &variant, true);
}

// How far from a place to what is met first that way, or infinity; negative where that is a
// back: the place is inside something.
static double clearance(const struct picture *picture, struct sb_vec3 from,
                        struct sb_vec3 way)
{
    double nearest = INFINITY, u, v;
    for (int i = 0; i < picture->triangle_count; i++) {
        struct triangle it = picture->triangle[i];
        const double front = hit(&it, from, way, &u, &v);
        it.corner[1] = picture->triangle[i].corner[2];
        it.corner[2] = picture->triangle[i].corner[1];
        const double back = hit(&it, from, way, &u, &v);
        if (fmin(front, back) < fabs(nearest))
            nearest = front < back ? front : -back;
    }
    return nearest;
}

static void check_clearance(const struct picture *picture, const struct sb_scene *scene,
                            enum sb_light_type type, int number)
{
    const struct sb_light *light = light_of(scene, type, number);
    const bool area = type == SB_LIGHT_AREA;
    const struct sb_vec3 at = vec3(light->position), half = vec3(light->direction);
    enum { WAYS = 24 }; // on a spiral around the sphere, and along the segment
    for (int i = 0; i < WAYS + 2; i++) {
        const double y = (2 * i + 1.0) / WAYS - 1, turn = 2.4 * i, r = sqrt(1 - y * y);
        struct sb_vec3 way = {r * cos(turn), y, r * sin(turn)};
        double least = area ? light->radius : 0.05;
        if (i >= WAYS) {
            way = sb_vec3_normalise(sb_vec3_scale(half, i % 2 ? 1 : -1));
            least += area ? sb_vec3_length(half) : 0;
        }
        const double room = clearance(picture, at, way);
        if (room >= least)
            continue;
        print_error("%s: %s %d has %g to the next surface\n", scene->name,
                    sb_light_structs[type].name, number, room);
        fail();
    }
}

static void no_light_is_inside_anything_or_reaches_into_it(void **state)
{
    (void)state;
    const struct sb_variant variant = many_lights(400);
    for (int i = 0; i < sb_scene_row_count; i++) {
        struct sb_scene scene = made(sb_scene_rows[i].name, &variant);
        struct picture picture = {0};
        collect_triangles(&picture, &scene);
        for (int type = SB_LIGHT_POINT; type < SB_LIGHT_TYPE_COUNT; type++) {
            for (int k = 0; k < LIGHTS; k++)
                check_clearance(&picture, &scene, type, k);
        }
        free(picture.triangle);
        sb_scene_free(&scene);
    }
}

static int covered(const char *name)
{
    struct sb_variant variant = scene_variant(0, 0, 0);
    variant.value[SB_AXIS_TESSELLATION] = 400;
    struct sb_scene scene = made(name, &variant);
    struct picture *picture = calloc(1, sizeof *picture);
    trace(picture, &scene);
    int pixels = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        pixels += picture->seen[i] >= 0;
    free(picture->triangle);
    free(picture);
    sb_scene_free(&scene);
    return pixels;
}

static void scenes_cover_a_good_part_of_the_picture(void **state)
{
    (void)state;
    static const char *const inside[] = {"plane", "tunnel", "room"};
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++)
        assert_int_equal(covered(inside[i]), SIZE * SIZE);
    for (int i = 0; i < sb_scene_row_count; i++)
        assert_true(covered(sb_scene_rows[i].name) > SIZE * SIZE * 3 / 10);
}

// --- shadows ---------------------------------------------------------------------------

static bool in_shadow(const struct picture *picture, const struct point *at,
                      struct sb_vec3 light)
{
    const struct sb_vec3 way = sb_vec3_sub(at->position, light);
    double u, v;
    for (int i = 0; i < picture->triangle_count; i++) {
        if (hit(&picture->triangle[i], light, way, &u, &v) < 0.999)
            return true;
    }
    return false;
}

// Of the first lights, which are those that cast them; and what they shine on stays in view.
static void every_lamp_in_the_room_throws_a_shadow_into_view(void **state)
{
    (void)state;
    enum { CASTERS = 64 };
    struct sb_variant variant = scene_variant(0, CASTERS, 0);
    variant.value[SB_AXIS_TESSELLATION] = 400;
    struct sb_scene scene = made("room", &variant);
    struct picture *picture = calloc(1, sizeof *picture);
    trace(picture, &scene);
    for (int i = 0; i < CASTERS; i++) {
        const struct sb_light *light = light_of(&scene, SB_LIGHT_POINT, i);
        const struct sb_vec3 from = vec3(light->position);
        const struct laws laws = {by_radius, hard, middle};
        int lit = 0, dark = 0;
        for (int k = 0; k < SIZE * SIZE; k += 3) {
            const struct point *at = &picture->pixel[k];
            assert_true(sb_vec3_length(sb_vec3_sub(at->position, from)) < light->range);
            if (diffuse(light, SB_LIGHT_POINT, &laws, *at) < 0.01)
                continue;
            *(in_shadow(picture, at, from) ? &dark : &lit) += 1;
        }
        assert_true(lit > SIZE * SIZE / 3 / 10);
        assert_true(dark > SIZE * SIZE / 3 / 50);
    }
    free(picture->triangle);
    free(picture);
    sb_scene_free(&scene);
}

// --- what the axes make of lights ------------------------------------------------------

static void the_sun_changes_a_pixel_from_dawn_to_dusk(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++) {
        for (int angle = -90; angle <= 90; angle += 15) {
            struct sb_variant variant = scene_variant(1, 0, 0);
            variant.value[SB_AXIS_TESSELLATION] = 400;
            variant.value[SB_AXIS_SUN] = angle;
            check_variant(sb_scene_rows[i].name, &variant, false);
        }
    }
}

static void every_light_changes_a_pixel_in_every_atmosphere(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++) {
        for (int k = 0; k < SB_ATMOSPHERE_VALUE_COUNT; k++) {
            struct sb_variant variant = scene_variant(64, 64, 64);
            variant.value[SB_AXIS_AREA] = 64;
            variant.value[SB_AXIS_TESSELLATION] = 400;
            variant.value[SB_AXIS_ATMOSPHERE] = k;
            check_variant(sb_scene_rows[i].name, &variant, false);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_light_changes_a_pixel_lit_by_fragment),
        cmocka_unit_test(every_light_changes_a_pixel_lit_by_vertex),
        cmocka_unit_test(every_light_reaches_the_corners_of_the_plainest_containers),
        cmocka_unit_test(no_light_is_inside_anything_or_reaches_into_it),
        cmocka_unit_test(scenes_cover_a_good_part_of_the_picture),
        cmocka_unit_test(every_lamp_in_the_room_throws_a_shadow_into_view),
        cmocka_unit_test(the_sun_changes_a_pixel_from_dawn_to_dusk),
        cmocka_unit_test(every_light_changes_a_pixel_in_every_atmosphere),
    };
    return run_tests(tests);
}
