// The sphere that a mesh stands for.
#include "reference_world.h"

#include "scene.h"

enum { WIDTH = 48, HEIGHT = 40 };

static struct vec3l object_point(const struct sb_draw *draw, struct sb_vec3 world)
{
    long double m[4][5];
    const long double in[4] = {world.x, world.y, world.z, 1};
    for (int row = 0; row < 4; row++) {
        for (int k = 0; k < 4; k++)
            m[row][k] = draw->model[4 * k + row];
        m[row][4] = in[row];
    }
    solve4(m);
    return (struct vec3l){m[0][4], m[1][4], m[2][4]};
}

// The smaller distance along a ray at which its point in object space has length 1, by the
// school formula; NAN where there is none.
static long double sphere_distance(const struct sb_draw *draw, const struct ray *ray)
{
    const struct sb_vec3 a = {(double)ray->from.x, (double)ray->from.y,
                              (double)ray->from.z};
    const struct sb_vec3 b = {(double)(ray->from.x + ray->way.x),
                              (double)(ray->from.y + ray->way.y),
                              (double)(ray->from.z + ray->way.z)};
    const struct vec3l from = object_point(draw, a),
                       way = minus(object_point(draw, b), from);
    const long double p = dot(from, way) / dot(way, way),
                      q = (dot(from, from) - 1) / dot(way, way);
    return -p - sqrtl(p * p - q);
}

// A sphere that is stretched, sheared, mirrored and away from the origin.
static struct sb_scene stretched(struct sb_arena *arena, int stacks)
{
    struct sb_mesh mesh = sb_mesh_sphere(arena, stacks, 2 * stacks);
    mesh.sphere = true;
    struct sb_scene scene = scene_of(&mesh, 1);
    struct sb_draw *draw = (struct sb_draw *)scene.draw;
    const struct sb_mat4 model = {
        {-1, 0.25, 0, 0, 0.5, 1.5, 0, 0, 0.125, -0.25, 0.75, 0, 2, 1, -3, 1}};
    const struct sb_mat3 normal = sb_mat4_normal_matrix(model);
    for (int i = 0; i < 16; i++)
        draw->model[i] = (float)model.m[i];
    for (int i = 0; i < 9; i++)
        draw->normal_matrix[i] = (float)normal.m[i];
    look_from(&scene, (struct sb_vec3){0, 2, 1}, (struct sb_vec3){2, 1, -3});
    return scene;
}

struct world {
    struct sb_arena arena;
    struct sb_scene scene;
    struct sb_ref_geometry *geometry;
    struct sb_ref_cover cover[WIDTH * HEIGHT];
};
static void open_world(struct world *world, struct sb_scene scene)
{
    world->scene = scene;
    world->geometry = sb_ref_geometry_new(&world->scene, WIDTH, HEIGHT);
    sb_ref_geometry_cover(world->geometry, 1, world->cover);
}
static void close_world(struct world *world)
{
    sb_ref_geometry_free(&world->geometry);
    sb_scene_free(&world->scene);
    sb_arena_free(&world->arena);
}

// --- pixels ----------------------------------------------------------------------------

// Of every pixel that shows the sphere: on it, in the pixel's ray, in front; the normal square
// to the surface, and the frame that of longitude and latitude.
static void check_truth(const struct world *world, double room)
{
    const struct sb_draw *draw = &world->scene.draw[0];
    int checked = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (world->cover[i].draw < 0)
            continue;
        struct sb_ref_input in;
        assert_true(sb_ref_geometry_truth(world->geometry, world->cover[i], i % WIDTH,
                                          i / WIDTH, &in));
        const struct vec3l p = object_point(draw, in.position);
        check_close((double)dot(p, p), 1, 10 * room);

        const struct ray ray =
            pixel_ray(&world->scene, WIDTH, HEIGHT, i % WIDTH, i / WIDTH);
        const long double t = sphere_distance(draw, &ray);
        const struct vec3l expected = {ray.from.x + t * ray.way.x,
                                       ray.from.y + t * ray.way.y,
                                       ray.from.z + t * ray.way.z};
        const struct vec3l off = minus(vec3l_of(in.position), expected);
        check_close((double)sqrtl(dot(off, off)), 0, 100 * room);

        // East and north at the point, taken through the model, lie in the surface.
        const double ring = hypot((double)p.x, (double)p.z);
        const struct sb_vec3 east = {(double)p.z / ring, 0, -(double)p.x / ring};
        const struct sb_vec3 north = {-(double)(p.x * p.y) / ring, ring,
                                      -(double)(p.z * p.y) / ring};
        struct sb_vec3 out[2];
        for (int k = 0; k < 2; k++) {
            const struct sb_vec3 v = k == 0 ? east : north;
            for (int row = 0; row < 3; row++)
                (&out[k].x)[row] = draw->model[row] * v.x + draw->model[4 + row] * v.y +
                                   draw->model[8 + row] * v.z;
        }
        check_close(sb_vec3_dot(in.normal, out[0]), 0,
                    1e-6); // normal_matrix is of floats
        check_close(sb_vec3_dot(in.normal, out[1]), 0, 1e-6);
        check_close(sb_vec3_length(in.normal), 1, 1e-15);
        assert_true(dot(vec3l_of(in.normal), ray.way) < 0); // outwards
        check_close(sb_vec3_length(sb_vec3_sub(in.tangent, out[0])), 0,
                    100 * room / ring);
        const struct sb_vec3 turn = sb_vec3_cross(in.normal, in.tangent);
        check_close(sb_vec3_length(sb_vec3_sub(in.bitangent, turn)), 0, 1e-15);
        checked++;
    }
    assert_true(checked > 200);
}

static void the_truth_of_a_sphere_lies_on_it_and_on_the_pixel_s_ray(void **state)
{
    (void)state;
    static const double offset[] = {0, 1000};
    for (int i = 0; i < 2; i++) {
        struct sb_variant variant = scene_variant(1, 0, 0);
        variant.value[SB_AXIS_TESSELLATION] = 500;
        variant.value[SB_AXIS_OFFSET] = offset[i];
        struct world world = {0};
        open_world(&world, made("sphere", &variant));
        check_truth(&world, i == 0 ? 1e-13 : 1e-9);
        close_world(&world);
    }
}

static void so_it_does_where_the_model_stretches_and_mirrors_it(void **state)
{
    (void)state;
    struct world world = {0};
    open_world(&world, stretched(&world.arena, 12));
    check_truth(&world, 1e-12);
    close_world(&world);
}

// Twice as many stacks, a quarter of the difference; u and v too, on both sides of the seam,
// which is seen here from behind.
static void triangles_come_closer_to_the_truth_the_smaller_they_are(void **state)
{
    (void)state;
    double before = 0;
    for (int stacks = 10; stacks <= 160; stacks *= 2) {
        struct world world = {0};
        struct sb_mesh mesh = sb_mesh_sphere(&world.arena, stacks, 2 * stacks);
        mesh.sphere = true;
        struct sb_scene scene = scene_of(&mesh, 1);
        look_from(&scene, (struct sb_vec3){0.02, 0.3, -3}, (struct sb_vec3){0});
        open_world(&world, scene);
        double worst = 0;
        int low = 0, high = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const struct sb_ref_cover at = world.cover[i];
            if (at.draw < 0 ||
                hypot(i % WIDTH - WIDTH / 2.0, i / WIDTH - HEIGHT / 2.0) > 8)
                continue;
            double weight[3];
            struct sb_ref_input truth;
            assert_true(sb_ref_geometry_weights(world.geometry, at, i % WIDTH, i / WIDTH,
                                                weight));
            assert_true(
                sb_ref_geometry_truth(world.geometry, at, i % WIDTH, i / WIDTH, &truth));
            const struct sb_ref_input own =
                sb_ref_geometry_input(world.geometry, at, weight);
            const double *a = &own.position.x, *b = &truth.position.x;
            for (int k = 0; k < 14; k++)
                worst = fmax(worst, fabs(a[k] - b[k]));
            low += truth.uv[0] < 0.1;
            high += truth.uv[0] > 0.9;
        }
        assert_true(low > 20 && high > 20);
        if (stacks > 10)
            assert_true(worst < before / 2.5);
        before = worst;
        close_world(&world);
    }
    assert_true(before < 1e-3);
}

// A triangle on one side of the seam may stand for a point on the other.
static void u_goes_on_across_the_seam(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_mesh mesh = sb_mesh_sphere(&world.arena, 4, 40);
    mesh.sphere = true;
    struct sb_scene scene = scene_of(&mesh, 1);
    look_from(&scene, (struct sb_vec3){1.2, 0.3, -1.6}, (struct sb_vec3){0});
    open_world(&world, scene);
    int across = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const struct sb_ref_cover at = world.cover[i];
        struct sb_ref_input in;
        if (at.draw < 0)
            continue;
        assert_true(sb_ref_geometry_truth(world.geometry, at, i % WIDTH, i / WIDTH, &in));
        double mean = 0;
        for (int k = 0; k < 3; k++)
            mean += mesh.vertex[mesh.index[3 * at.triangle + k]].uv[0] / 3;
        assert_true(fabs(in.uv[0] - mean) <= 0.5);
        // u = 1/2 faces +z.
        const double turn = 2 * SB_PI * (in.uv[0] - 0.5);
        const double ring = hypot(in.position.x, in.position.z);
        check_close(sin(turn) * ring, in.position.x, 1e-12);
        check_close(cos(turn) * ring, in.position.z, 1e-12);
        check_close(sin(SB_PI * (in.uv[1] - 0.5)), in.position.y, 1e-12);
        across += in.uv[0] < 0 || in.uv[0] > 1;
    }
    assert_true(across > 3);
    close_world(&world);
}

static void the_truth_of_other_meshes_is_their_triangles(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(1, 0, 0);
    struct world world = {0};
    open_world(&world, made("spheres", &variant)); // whose meshes do not claim to be any
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (world.cover[i].draw < 0)
            continue;
        double weight[3];
        struct sb_ref_input truth;
        assert_true(sb_ref_geometry_truth(world.geometry, world.cover[i], i % WIDTH,
                                          i / WIDTH, &truth));
        assert_true(sb_ref_geometry_weights(world.geometry, world.cover[i], i % WIDTH,
                                            i / WIDTH, weight));
        const struct sb_ref_input own =
            sb_ref_geometry_input(world.geometry, world.cover[i], weight);
        assert_memory_equal(&truth, &own, sizeof own);
    }
    close_world(&world);
}

static void a_ray_beside_the_sphere_has_no_truth(void **state)
{
    (void)state;
    struct sb_variant variant = scene_variant(1, 0, 0);
    struct world world = {0};
    open_world(&world, made("sphere", &variant));
    struct sb_ref_input in;
    const struct sb_ref_cover at = {0, 5};
    assert_false(sb_ref_geometry_truth(world.geometry, at, 0, 0, &in));
    assert_true(sb_ref_geometry_truth(world.geometry, at, WIDTH / 2, HEIGHT / 2, &in));
    close_world(&world);
}

// From inside, and from outside so close that the near plane cuts a cap off.
static void where_the_near_plane_cuts_the_truth_is_the_far_side(void **state)
{
    (void)state;
    static const double eye[] = {0.5, 1.05};
    for (int k = 0; k < 2; k++) {
        struct world world = {0};
        struct sb_mesh mesh = sb_mesh_sphere(&world.arena, 20, 40);
        mesh.sphere = true;
        struct sb_scene scene = scene_of(&mesh, 1);
        look_from(&scene, (struct sb_vec3){0, 0, eye[k]}, (struct sb_vec3){0});
        open_world(&world, scene);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            struct sb_ref_input in;
            assert_int_equal(world.cover[i].draw, 0);
            assert_true(sb_ref_geometry_truth(world.geometry, world.cover[i], i % WIDTH,
                                              i / WIDTH, &in));
            assert_true(in.position.z < eye[k] - 0.1 + 1e-6);
            check_close(sb_vec3_length(in.position), 1, 1e-12);
        }
        close_world(&world);
    }
}

// --- rays ------------------------------------------------------------------------------

static void rays_for_the_truth_meet_the_sphere_itself(void **state)
{
    (void)state;
    struct world world = {0};
    open_world(&world, stretched(&world.arena, 6));
    sb_ref_geometry_rays(world.geometry);
    struct sb_random random = sb_random_seed(9);
    const struct sb_draw *draw = &world.scene.draw[0];
    int met = 0, mesh_missed = 0;
    for (int i = 0; i < 4000; i++) {
        const struct sb_vec3 from = {between(&random, -2, 6), between(&random, -3, 5),
                                     between(&random, -1, 4)};
        const struct sb_vec3 to = {between(&random, 0, 4), between(&random, -1, 3),
                                   between(&random, -5, -1)};
        struct sb_ref_ray ray = {.origin = from,
                                 .direction = sb_vec3_sub(to, from),
                                 .far = INFINITY,
                                 .truth = true};
        const struct vec3l object = object_point(draw, from);
        if (dot(object, object) < 1.01L)
            continue;
        const struct ray precise = {vec3l_of(from), vec3l_of(ray.direction)};
        const long double t = sphere_distance(draw, &precise);
        const double hit = sb_ref_geometry_hit(world.geometry, &ray);
        assert_int_equal(sb_ref_geometry_blocked(world.geometry, &ray), hit < INFINITY);
        if (isnan(t)) {
            assert_true(hit == INFINITY);
            continue;
        }
        check_close(hit, (double)t, 1e-6); // near the outline; else far closer
        met++;
        ray.truth = false;
        const double mesh_hit = sb_ref_geometry_hit(world.geometry, &ray);
        assert_true(mesh_hit >= hit - 1e-6); // which lies inside, but for its floats
        mesh_missed += mesh_hit == INFINITY;

        // The far side, and nothing behind it.
        ray.truth = true;
        ray.near = hit * (1 + 1e-6) + 1e-6;
        const double back = sb_ref_geometry_hit(world.geometry, &ray);
        if (back < INFINITY) {
            const struct sb_vec3 at =
                sb_vec3_add(from, sb_vec3_scale(ray.direction, back));
            const struct vec3l p = object_point(draw, at);
            check_close((double)dot(p, p), 1, 1e-11);
            ray.near = back * (1 + 1e-6);
            assert_false(sb_ref_geometry_blocked(world.geometry, &ray));
        }
    }
    assert_true(met > 1000 && mesh_missed > 50);
    close_world(&world);
}

static void a_ray_along_the_middle_meets_the_sphere_at_a_radius(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_mesh mesh = sb_mesh_sphere(&world.arena, 6, 12);
    mesh.sphere = true;
    open_world(&world, scene_of(&mesh, 1));
    sb_ref_geometry_rays(world.geometry);
    struct sb_ref_ray ray = {
        .origin = {0, 0, 5}, .direction = {0, 0, -2}, .far = INFINITY, .truth = true};
    assert_true(sb_ref_geometry_hit(world.geometry, &ray) == 2);
    ray.near = 2.5;
    assert_true(sb_ref_geometry_hit(world.geometry, &ray) == 3);
    ray.near = 0;
    ray.far = 1.9;
    assert_false(sb_ref_geometry_blocked(world.geometry, &ray));
    ray = (struct sb_ref_ray){.direction = {0, 0.5, 0}, .far = INFINITY, .truth = true};
    assert_true(sb_ref_geometry_hit(world.geometry, &ray) == 2);
    close_world(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_of_a_sphere_lies_on_it_and_on_the_pixel_s_ray),
        cmocka_unit_test(so_it_does_where_the_model_stretches_and_mirrors_it),
        cmocka_unit_test(triangles_come_closer_to_the_truth_the_smaller_they_are),
        cmocka_unit_test(u_goes_on_across_the_seam),
        cmocka_unit_test(the_truth_of_other_meshes_is_their_triangles),
        cmocka_unit_test(a_ray_beside_the_sphere_has_no_truth),
        cmocka_unit_test(where_the_near_plane_cuts_the_truth_is_the_far_side),
        cmocka_unit_test(rays_for_the_truth_meet_the_sphere_itself),
        cmocka_unit_test(a_ray_along_the_middle_meets_the_sphere_at_a_radius),
    };
    return run_tests(tests);
}
