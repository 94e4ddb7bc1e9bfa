// Every light of every scene changes what the eye sees. A small picture is traced by
// brute force, so what is hidden does not count; then each light is added up at what it
// shows.
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

// The brightest component of the light's diffuse contribution; for spots the lesser of
// the linear and the smooth cone.
static double lambert(struct point at, struct sb_vec3 to_light, const float colour[3])
{
    const double facing = sb_vec3_dot(at.normal, sb_vec3_normalise(to_light));
    return fmax(facing, 0) * fmax(colour[0], fmax(colour[1], colour[2]));
}

static double dir_light(const struct sb_lights *lights, int i, struct point at)
{
    const struct sb_dir_light *light = &lights->dir[i];
    return lambert(at, sb_vec3_scale(vec3(light->direction), -1), light->diffuse);
}

static double point_light(const struct sb_lights *lights, int i, struct point at)
{
    const struct sb_point_light *light = &lights->point[i];
    const struct sb_vec3 to_light = sb_vec3_sub(vec3(light->position), at.position);
    const double d = sb_vec3_length(to_light);
    return lambert(at, to_light, light->diffuse) /
           (light->constant + light->linear * d + light->quadratic * d * d);
}

static double spot_light(const struct sb_lights *lights, int i, struct point at)
{
    const struct sb_spot_light *light = &lights->spot[i];
    const struct sb_vec3 to_light = sb_vec3_sub(vec3(light->position), at.position);
    const double d = sb_vec3_length(to_light);
    const double cosine = -sb_vec3_dot(vec3(light->direction), to_light) / d;
    const double smooth = cosine * light->cone_scale + light->cone_offset;
    const double linear = 1 - (1 - cosine) * light->inv_one_minus_cos;
    const double cone = fmin(fmax(fmin(smooth, linear), 0), 1);
    return cone * lambert(at, to_light, light->diffuse) /
           (light->constant + light->linear * d + light->quadratic * d * d);
}

typedef double (*light_function)(const struct sb_lights *lights, int i, struct point at);
static const light_function light_functions[SB_LIGHT_TYPE_COUNT] = {
    [SB_LIGHT_DIR] = dir_light,
    [SB_LIGHT_POINT] = point_light,
    [SB_LIGHT_SPOT] = spot_light,
};

// The most that the light adds to any pixel: lit there, or at the corners of what is
// there.
static double most(const struct picture *picture, const struct sb_lights *lights,
                   light_function light, int number, bool at_vertices)
{
    double most = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (picture->seen[i] < 0)
            continue;
        if (!at_vertices) {
            most = fmax(most, light(lights, number, picture->pixel[i]));
            continue;
        }
        const struct triangle *it = &picture->triangle[picture->seen[i]];
        for (int k = 0; k < 3; k++)
            most = fmax(most, light(lights, number, it->corner[k]));
    }
    return most;
}

static void check_reach(const char *name, double tessellation, bool at_vertices)
{
    struct sb_variant variant = scene_variant(LIGHTS, LIGHTS, LIGHTS);
    variant.value[SB_AXIS_TESSELLATION] = tessellation;
    struct sb_scene scene = made(name, &variant);
    struct picture *picture = calloc(1, sizeof *picture);
    trace(picture, &scene);
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        for (int i = 0; i < LIGHTS; i++) {
            // A float sum of some 10 resolves 1e-6: a hundred times that cannot vanish.
            if (most(picture, &scene.lights, light_functions[type], i, at_vertices) >
                1e-4)
                continue;
            print_error("%s: %s %d changes nothing\n", name, sb_light_types[type].name,
                        i);
            fail();
        }
    }
    free(picture->triangle);
    free(picture);
    sb_scene_free(&scene);
}

static void every_light_changes_a_pixel_lit_by_fragment(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++)
        check_reach(sb_scene_rows[i].name, 400, false);
}

static void every_light_changes_a_pixel_lit_by_vertex(void **state)
{
    (void)state;
    for (int i = 0; i < sb_scene_row_count; i++)
        check_reach(sb_scene_rows[i].name, 2000, true);
}

static void every_light_reaches_the_corners_of_the_plainest_containers(void **state)
{
    (void)state;
    check_reach("containers", 12, true);
}

static void no_light_is_inside_a_container(void **state)
{
    (void)state;
    const struct sb_variant variant = scene_variant(0, LIGHTS, LIGHTS);
    struct sb_scene scene = made("containers", &variant);
    for (int i = 0; i < LIGHTS; i++) {
        for (int d = 0; d < scene.draw_count; d++) {
            const struct sb_vec3 cube = vec3(scene.draw[d].model + 12);
            const struct sb_vec3 point = vec3(scene.lights.point[i].position);
            const struct sb_vec3 spot = vec3(scene.lights.spot[i].position);
            assert_true(sb_vec3_length(sb_vec3_sub(point, cube)) > sqrt(3) / 2);
            assert_true(sb_vec3_length(sb_vec3_sub(spot, cube)) > sqrt(3) / 2);
        }
    }
    sb_scene_free(&scene);
}

static void the_corridor_covers_every_pixel_from_inside(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(0, 0, 0);
    variant.value[SB_AXIS_TESSELLATION] = 100;
    struct sb_scene scene = made("plane", &variant);
    struct picture *picture = calloc(1, sizeof *picture);
    trace(picture, &scene);
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_true(picture->seen[i] >= 0);
    free(picture->triangle);
    free(picture);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_light_changes_a_pixel_lit_by_fragment),
        cmocka_unit_test(every_light_changes_a_pixel_lit_by_vertex),
        cmocka_unit_test(every_light_reaches_the_corners_of_the_plainest_containers),
        cmocka_unit_test(no_light_is_inside_a_container),
        cmocka_unit_test(the_corridor_covers_every_pixel_from_inside),
    };
    return run_tests(tests);
}
