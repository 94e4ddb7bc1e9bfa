// Textures of the reference against the equations of OpenGL in long double.
#include "lit_world.h"

#include "math/random.h"

enum { WIDTH = 7, HEIGHT = 4 };
static unsigned char texels[HEIGHT][WIDTH][4];
static const struct sb_texture texture = {WIDTH, HEIGHT, &texels[0][0][0]};

static struct sb_random fill(uint64_t seed)
{
    struct sb_random random = sb_random_seed(seed);
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        texels[i / 4 / WIDTH][i / 4 % WIDTH][i % 4] =
            (unsigned char)sb_random_below(&random, 256);
    return random;
}

static int wrapped(long double i, int size)
{
    const long double m = fmodl(i, size);
    return (int)(m < 0 ? m + size : m);
}

// OpenGL 4.6 core, equations 8.8 to 8.11 and REPEAT: i mod size.
static long double sampled(const double uv[2], int channel)
{
    const long double u = uv[0] * (long double)WIDTH - 0.5L;
    const long double v = uv[1] * (long double)HEIGHT - 0.5L;
    long double sum = 0;
    for (int i = 0; i < 4; i++) {
        const long double x = floorl(u) + i % 2, y = floorl(v) + i / 2;
        const long double a = u - floorl(u), b = v - floorl(v);
        sum += (i % 2 ? a : 1 - a) * (i / 2 ? b : 1 - b) *
               texels[wrapped(y, HEIGHT)][wrapped(x, WIDTH)][channel];
    }
    return sum / 255;
}

static void a_texture_repeats_and_is_bilinear(void **state)
{
    (void)state;
    struct sb_random random = fill(1);
    for (int i = 0; i < 20000; i++) {
        double uv[2];
        for (int k = 0; k < 2; k++)
            uv[k] = (sb_random_unit(&random) - 0.5) * (i % 4 ? 2 : 2000);
        const struct sb_vec3 got = sb_ref_texture(&texture, uv);
        check_close(got.x, (double)sampled(uv, 0), 1e-15);
        check_close(got.y, (double)sampled(uv, 1), 1e-15);
        check_close(got.z, (double)sampled(uv, 2), 1e-15);
    }
}

static void centres_of_texels_are_the_texels(void **state)
{
    (void)state;
    fill(2);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const double uv[2] = {(x + 0.5) / WIDTH + 3, (y + 0.5) / HEIGHT - 2};
        check_close(sb_ref_texture(&texture, uv).x, texels[y][x][0] / 255.0, 1e-14);
    }
}

static void corners_and_numbers_next_to_them_are_within(void **state)
{
    (void)state;
    fill(3);
    static const double at[] = {0, -0.0, 1, -1, 1e-300, -1e-300, -1e-17, 1e9, -1e9 - 1};
    double corner = 0;
    for (int i = 0; i < 4; i++)
        corner += texels[i / 2 ? HEIGHT - 1 : 0][i % 2 ? WIDTH - 1 : 0][1] / 255.0 / 4;
    for (int i = 0; i < 81; i++) {
        const double uv[2] = {at[i % 9], at[i / 9]};
        check_close(sb_ref_texture(&texture, uv).y, corner, 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_texture_repeats_and_is_bilinear),
        cmocka_unit_test(centres_of_texels_are_the_texels),
        cmocka_unit_test(corners_and_numbers_next_to_them_are_within),
    };
    return run_tests(tests);
}
