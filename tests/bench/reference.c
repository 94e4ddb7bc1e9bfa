// How long a picture of the reference takes: bench_reference. No test: it checks nothing.
// Prints, for 1024 x 1024 pixels and 16 lights, one line a scene and number of threads.
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "reference/render.h"

enum { SIDE = 1024, LIGHTS = 16, REPEATS = 3 };

static void measure(const char *name, int threads)
{
    struct sb_error err = {0};
    struct sb_variant variant;
    struct sb_scene scene = {0};
    struct sb_ref_ground ground;
    double best[3] = {1e9, 1e9, 1e9};
    long covered = 0;
    sb_variant_init(sb_axes_builtin(), &variant);
    sb_variant_put(&variant, SB_AXIS_DIR, 1);
    sb_variant_put(&variant, SB_AXIS_POINT, 10);
    sb_variant_put(&variant, SB_AXIS_SPOT, LIGHTS - 11);
    sb_variant_put(&variant, SB_AXIS_WIDTH, SIDE);
    sb_variant_put(&variant, SB_AXIS_HEIGHT, SIDE);
    if (!sb_variant_resolve(sb_axes_builtin(), &variant, &err) ||
        !sb_scene_make(name, &variant, &scene, &err)) {
        fprintf(stderr, "%s\n", err.text);
        exit(1);
    }
    for (int i = 0; i < REPEATS; i++) {
        struct sb_ref_picture ideal, model;
        const int64_t begin = sb_clock_ns();
        sb_ref_ground_make(&ground, &scene, SIDE, SIDE, threads);
        const int64_t covers = sb_clock_ns();
        sb_ref_ideal(&ground, &variant, &ideal);
        const int64_t shown = sb_clock_ns();
        sb_ref_model(&ground, &variant, &model);
        const int64_t end = sb_clock_ns();
        const double ms[3] = {(double)(covers - begin) * 1e-6,
                              (double)(shown - covers) * 1e-6,
                              (double)(end - shown) * 1e-6};
        for (int k = 0; k < 3; k++)
            best[k] = ms[k] < best[k] ? ms[k] : best[k];
        covered = 0;
        for (long p = 0; p < (long)SIDE * SIDE; p++)
            covered += ground.cover[p].draw >= 0;
        sb_ref_picture_free(&ideal);
        sb_ref_picture_free(&model);
        sb_ref_ground_free(&ground);
    }
    printf("%-11s %d threads: geometry %.0f ms, ideal %.0f ms, model %.0f ms, "
           "%.0f ns a covered pixel and light\n",
           name, threads, best[0], best[1], best[2],
           best[2] * 1e6 / (double)covered / LIGHTS);
    sb_scene_free(&scene);
}

int main(void)
{
    static const char *const scenes[] = {"sphere", "containers", "room", "tunnel"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (int threads = 1; threads <= 2; threads++)
            measure(scenes[i], threads);
    return 0;
}
