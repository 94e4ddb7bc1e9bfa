#include "math/mat.h"

struct sb_mat4 sb_mat4_multiply(struct sb_mat4 a, struct sb_mat4 b)
{
    struct sb_mat4 product;
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a.m[4 * k + row] * b.m[4 * column + k];
            product.m[4 * column + row] = sum;
        }
    }
    return product;
}

struct sb_vec3 sb_mat4_transform_point(struct sb_mat4 m, struct sb_vec3 point)
{
    const double *a = m.m;
    return (struct sb_vec3){
        a[0] * point.x + a[4] * point.y + a[8] * point.z + a[12],
        a[1] * point.x + a[5] * point.y + a[9] * point.z + a[13],
        a[2] * point.x + a[6] * point.y + a[10] * point.z + a[14],
    };
}

struct sb_mat4 sb_mat4_translation(struct sb_vec3 by)
{
    return (struct sb_mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, by.x, by.y, by.z, 1}};
}

struct sb_mat4 sb_mat4_scaling(double by)
{
    return (struct sb_mat4){{by, 0, 0, 0, 0, by, 0, 0, 0, 0, by, 0, 0, 0, 0, 1}};
}

struct sb_mat4 sb_mat4_rotation(double angle, struct sb_vec3 axis)
{
    // Rodrigues: c I + s [a]x + (1 - c) a aT.
    const struct sb_vec3 a = sb_vec3_normalise(axis);
    const double c = cos(angle), s = sin(angle), d = 1 - c;
    // clang-format off
    return (struct sb_mat4){{
        c + d * a.x * a.x,       d * a.x * a.y + s * a.z, d * a.x * a.z - s * a.y, 0,
        d * a.x * a.y - s * a.z, c + d * a.y * a.y,       d * a.y * a.z + s * a.x, 0,
        d * a.x * a.z + s * a.y, d * a.y * a.z - s * a.x, c + d * a.z * a.z,       0,
        0,                       0,                       0,                       1,
    }};
    // clang-format on
}

struct sb_mat4 sb_mat4_look_at(struct sb_vec3 eye, struct sb_vec3 target,
                               struct sb_vec3 up)
{
    const struct sb_vec3 z = sb_vec3_normalise(sb_vec3_sub(eye, target));
    const struct sb_vec3 x = sb_vec3_normalise(sb_vec3_cross(up, z));
    const struct sb_vec3 y = sb_vec3_cross(z, x);
    // clang-format off
    return (struct sb_mat4){{
        x.x, y.x, z.x, 0,
        x.y, y.y, z.y, 0,
        x.z, y.z, z.z, 0,
        -sb_vec3_dot(x, eye), -sb_vec3_dot(y, eye), -sb_vec3_dot(z, eye), 1,
    }};
    // clang-format on
}

struct sb_mat4 sb_mat4_perspective(double fov_y, double aspect, double near, double far)
{
    const double f = 1 / tan(fov_y / 2);
    // clang-format off
    return (struct sb_mat4){{
        f / aspect, 0, 0, 0,
        0, f, 0, 0,
        0, 0, (far + near) / (near - far), -1,
        0, 0, 2 * far * near / (near - far), 0,
    }};
    // clang-format on
}

struct sb_mat3 sb_mat4_normal_matrix(struct sb_mat4 m)
{
    double largest = 0;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            largest = fmax(largest, fabs(m.m[4 * column + row]));
    int exponent;
    frexp(largest, &exponent);

    // A power of two is taken out exactly, so that products of three elements stay in
    // range.
    struct sb_vec3 column[3];
    for (int i = 0; i < 3; i++)
        column[i] = (struct sb_vec3){ldexp(m.m[4 * i], -exponent),
                                     ldexp(m.m[4 * i + 1], -exponent),
                                     ldexp(m.m[4 * i + 2], -exponent)};

    const struct sb_vec3 cofactor[3] = {sb_vec3_cross(column[1], column[2]),
                                        sb_vec3_cross(column[2], column[0]),
                                        sb_vec3_cross(column[0], column[1])};
    double longest = 0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, sb_vec3_length(cofactor[i]));
    const double mirrored = sb_vec3_dot(column[0], cofactor[0]) < 0 ? -1 : 1;
    const double factor = longest > 0 ? mirrored / longest : 0;

    struct sb_mat3 normal;
    for (int i = 0; i < 3; i++) {
        normal.m[3 * i] = cofactor[i].x * factor;
        normal.m[3 * i + 1] = cofactor[i].y * factor;
        normal.m[3 * i + 2] = cofactor[i].z * factor;
    }
    return normal;
}
