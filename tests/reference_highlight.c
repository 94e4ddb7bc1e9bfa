// What specular_norm and fresnel mean, of the reference: the energy that a highlight reflects, and
// what a surface reflects from head-on to grazing.
#include "lit_world.h"

// What leaves towards the eye of light from all around, the eye on the normal.
static double energy(struct world *world)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double a = (i + 0.5) * SB_PI / 2 / STEPS;
        put3(world->light[0].direction, -sin(a), 0, -cos(a));
        struct sb_ref_terms it[1];
        shade(world, it);
        const double ring = 2 * SB_PI * sin(a) * SB_PI / 2 / STEPS;
        sum += it[0].specular[0] * cos(a) * ring;
    }
    return sum;
}

// Blinn's factor is a simple one that is near the true one, (n + 2) (n + 4) / (8 pi (2^(-n/2) + n)).
static void the_energy_of_a_highlight_does_not_depend_on_its_exponent(void **state)
{
    (void)state;
    for (double n = 1; n < 5000; n *= 4) {
        struct world world;
        world_make(&world, "dir=1,model=phong,specular_norm=energy");
        world_add(&world, SB_LIGHT_DIR, 0, 0, -1);
        world.material.shininess = (float)n;
        check_close(energy(&world), 1, 1e-4);
        world.variant.value[SB_AXIS_MODEL] = SB_MODEL_BLINN;
        const double factor = (n + 2) * (n + 4) / (exp2(-n / 2) + n);
        check_close(energy(&world), (n + 8) / factor, 1e-4);
        assert_true(fabs((n + 8) / factor - 1) < 0.08);
    }
}

static void a_black_surface_mirrors_at_a_grazing_angle_only(void **state)
{
    (void)state;
    for (int m = 0; m < 2; m++) {
        struct world world;
        world_make(&world, m ? "dir=1,model=phong,fresnel=schlick"
                             : "dir=1,model=blinn,fresnel=schlick");
        world_add(&world, SB_LIGHT_DIR, 0, 0, -1);
        put3(world.material.specular, 0, 0.25, 1);
        for (double a = 0; a < 1.57; a += 0.01) { // in the very mirror
            put3(world.light[0].direction, -sin(a), 0, -cos(a));
            put3(world.scene.camera.eye, -sin(a), 0, cos(a));
            const struct sb_vec3 made = shade(&world, NULL).specular;
            const double k = pow(1 - cos(a), 5); // the half vector is the normal
            check_close(made.x, k, 1e-6);
            check_close(made.y, 0.25 + 0.75 * k, 1e-6);
            check_close(made.z, 1, 1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_energy_of_a_highlight_does_not_depend_on_its_exponent),
        cmocka_unit_test(a_black_surface_mirrors_at_a_grazing_angle_only),
    };
    return run_tests(tests);
}
