// Normal matrices: what the upload makes of a model matrix, and what textbooks make of it. A model
// is turn * scaling, so the right normal is turn * (normal / scale), which needs no inverse.
#include <math.h>

#include "cases/vectors.h"
#include "math/mat.h"

struct model {
    double scale[3];
    double angle; // of the turn about (1, 2, 3)
};

static struct sb_mat4 matrix_of(const struct model *model)
{
    struct sb_mat4 m = sb_mat4_rotation(model->angle, (struct sb_vec3){1, 2, 3});
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m.m[4 * column + row] *= model->scale[column];
    return m;
}

// --- forms --------------------------------------------------------------------------------

struct matrix { // of floats, as the shader has it
    float m[9];
};

// As sb_draw_make uploads it.
static struct matrix uploaded(struct sb_mat4 m)
{
    const struct sb_mat3 normal = sb_mat4_normal_matrix(m);
    struct matrix out;
    for (int i = 0; i < 9; i++)
        out.m[i] = (float)normal.m[i];
    return out;
}

static struct matrix upper_left(struct sb_mat4 m)
{
    struct matrix out;
    for (int i = 0; i < 9; i++)
        out.m[i] = (float)m.m[4 * (i / 3) + i % 3];
    return out;
}

// transpose(inverse(mat3(M))): cofactors over the determinant, in floats.
static struct matrix inverse_transpose(struct sb_mat4 m)
{
    const struct matrix a = upper_left(m);
    struct matrix out;
    for (int i = 0; i < 9; i++) {
        const int c = (i / 3 + 1) % 3, d = (i / 3 + 2) % 3;
        const int r = (i + 1) % 3, s = (i + 2) % 3;
        out.m[i] = a.m[3 * c + r] * a.m[3 * d + s] - a.m[3 * d + r] * a.m[3 * c + s];
    }
    const float determinant = a.m[0] * out.m[0] + a.m[1] * out.m[1] + a.m[2] * out.m[2];
    for (int i = 0; i < 9; i++)
        out.m[i] /= determinant;
    return out;
}

// The direction of matrix * normal, products in floats as the vertex shader has them; its unit
// vector is vertex_normal() of shaders/vertex_normal.glsl, which keeps a zero vector.
static struct sb_vec3 turned(const struct matrix *matrix, struct sb_vec3 normal)
{
    const float n[3] = {(float)normal.x, (float)normal.y, (float)normal.z};
    float v[3];
    for (int r = 0; r < 3; r++)
        v[r] = matrix->m[r] * n[0] + matrix->m[3 + r] * n[1] + matrix->m[6 + r] * n[2];
    return (struct sb_vec3){v[0], v[1], v[2]};
}

// --- asking -------------------------------------------------------------------------------

static double angle_between(struct sb_vec3 a, struct sb_vec3 b)
{
    a = sb_vec3_normalise(a);
    b = sb_vec3_normalise(b);
    return 180 / SB_PI * atan2(sb_vec3_length(sb_vec3_cross(a, b)), sb_vec3_dot(a, b));
}

static struct sb_vec3 right_normal(const struct model *model, struct sb_vec3 normal)
{
    const struct sb_vec3 over = {normal.x / model->scale[0], normal.y / model->scale[1],
                                 normal.z / model->scale[2]};
    const struct model turn = {{1, 1, 1}, model->angle};
    return sb_mat4_transform_point(matrix_of(&turn), over);
}

enum { NORMALS = 64, TURNS = 5, DECADES = 7 }; // ratios from 1 to 1e6
#define TURN 0.7                               // radians

// The largest angle to the right normal.
static double worst_angle(const struct model *model, const struct matrix *matrix)
{
    struct sb_random random = sb_random_seed(3);
    double worst = 0;
    for (int i = 0; i < NORMALS; i++) {
        const struct sb_vec3 normal = sb_any_direction(&random);
        const struct sb_vec3 got = turned(matrix, normal);
        const double angle = angle_between(got, right_normal(model, normal));
        worst = fmax(worst, isfinite(angle) ? angle : INFINITY);
    }
    return worst;
}

// Is this the normal of an image? What lies on the outer side of a surface is on the outer side of
// its image: M n . M^-T n = n . n > 0. Flat images have M n in their plane; there a normal stands
// on it, of a length > 0 where the surface is not edge-on to the direction that is lost. Of a line
// and of a point no normal is left, and any, as 0, will do that does not point inwards.
static bool is_normal(const struct model *model, struct sb_vec3 normal,
                      struct sb_vec3 outwards, struct sb_vec3 got)
{
    const double n[3] = {normal.x, normal.y, normal.z};
    const double lengths = sb_vec3_length(got) * sb_vec3_length(outwards);
    const double along = sb_vec3_dot(got, outwards);
    int flat = -1, rank = 3;
    for (int c = 0; c < 3; c++)
        if (model->scale[c] == 0) {
            flat = c;
            rank--;
        }
    if (rank == 3)
        return along > 0;
    if (rank < 2)
        return along >= -1e-6 * lengths;
    return fabs(along) <= 1e-6 * lengths &&
           (fabs(n[flat]) < 0.05 || sb_vec3_length(got) > 0);
}

// Elements that are not finite, and normals that are none of the surface.
static double count_bad(const struct model *model, const struct matrix *matrix)
{
    const struct sb_mat4 m = matrix_of(model);
    struct sb_random random = sb_random_seed(5);
    double bad = 0;
    for (int i = 0; i < 9; i++)
        bad += !isfinite(matrix->m[i]);
    for (int i = 0; i < NORMALS; i++) {
        const struct sb_vec3 normal = sb_any_direction(&random);
        const struct sb_vec3 outwards = sb_mat4_transform_point(m, normal);
        bad += !is_normal(model, normal, outwards, turned(matrix, normal));
    }
    return bad;
}

bool sb_vectors_nonuniform(const struct sb_case_env *env, const struct sb_case *it,
                           const struct sb_case_setting *setting,
                           struct sb_outcome *outcome, struct sb_error *err)
{
    (void)env, (void)err;
    double worst = 0;
    for (int i = 0; i < 3 * DECADES * TURNS; i++) {
        const int axis = i / TURNS / DECADES, decade = i / TURNS % DECADES;
        struct model model = {{1, 1, 1}, TURN * (i % TURNS)};
        model.scale[axis] = pow(10, decade);
        model.scale[(axis + 1) % 3] = pow(10, decade / 2.0);
        const struct sb_mat4 m = matrix_of(&model);
        const struct matrix matrix =
            setting->form == SB_CASE_NAIVE ? upper_left(m) : uploaded(m);
        worst = fmax(worst, worst_angle(&model, &matrix));
    }
    sb_vectors_judge(&it->criterion[0], setting, worst, outcome);
    return true;
}

bool sb_vectors_singular(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_outcome *outcome, struct sb_error *err)
{
    (void)env, (void)err;
    static const double scale[][3] = {
        {1, 0, 1},          {0, 2, 3},
        {1, 1, 0},                     // flat
        {1, 0, 0},          {0, 0, 0}, // a line, a point
        {-1, 1, 1},         {1, -2, 3},
        {-1, -1, -1}, // mirrored
        {0.01, -100, 1},    {1e-20, 1e-20, -1e-20},
        {1e15, 1e15, 1e15}, // far from 1
    };
    double bad = 0;
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++)
        for (int turn = 0; turn < TURNS; turn++) {
            const struct model model = {{scale[i][0], scale[i][1], scale[i][2]},
                                        TURN * turn};
            const struct sb_mat4 m = matrix_of(&model);
            const struct matrix matrix =
                setting->form == SB_CASE_NAIVE ? inverse_transpose(m) : uploaded(m);
            bad += count_bad(&model, &matrix);
        }
    sb_vectors_judge(&it->criterion[0], setting, bad, outcome);
    return true;
}
