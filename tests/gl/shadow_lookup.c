// What the shade program gets when it looks a shadow map up: the shipped GLSL, asked about
// points of a room, against a count made here from the closed form of what each texel sees.
#include "shadow_world.h"

#include "math/random.h"

enum { SIZE = 64, SIDE = 64, POINTS = SIDE * SIDE };

// Point i of the list is asked about by pixel i: its place, and the cosine of the angle
// between its normal and the light.
static float points[POINTS][4];

static const char probe_vertex[] =
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
    "                       gl_VertexID == 2 ? 3.0 : -1.0,\n"
    "                       0.0, 1.0);\n"
    "}\n";
static const char probe_fragment[] =
    "#include \"version/$(GLSL_FAMILY).glsl\"\n"
    "#include \"generated/light_structs.glsl\"\n"
    "uniform PointLight u_point[NR_POINT_LIGHTS];\n"
    "uniform SAMPLER(highp, sampler2D) u_points;\n"
    "#include \"shadows.glsl\"\n"
    "out highp vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    highp vec4 it = texelFetch(u_points, ivec2(gl_FragCoord.xy), 0);\n"
    "    o_color = vec4(0.0);\n"
    "#define TO_LIGHT(i) u_point[i].position - it.xyz\n"
    "#define ASK(i) o_color[i] = caster_visibility(i, u_point[i], TO_LIGHT(i), it.w);\n"
    "    EACH_CASTER(ASK)\n"
    "}\n";

struct probe {
    struct fixture fixture;
    struct sb_gl_program program;
    struct sb_target target;
    GLuint list, vertex_array;
};

static void probe_program_make(struct probe *probe)
{
    const struct sb_glsl_text vertex_text = {"probe.vert", probe_vertex};
    const struct sb_glsl_text fragment_text = {"probe.frag", probe_fragment};
    struct sb_glsl_source vertex, fragment;
    build_stage(&probe->fixture.variant, "probe.vert", &vertex_text, &vertex);
    build_stage(&probe->fixture.variant, "probe.frag", &fragment_text, &fragment);
    const struct sb_program source = {.vertex = vertex.text, .fragment = fragment.text};
    if (!sb_gl_program_make(&source, &probe->program))
        fail_msg("%s\n%s", probe->program.log, fragment.text);
    sb_glsl_free(&vertex);
    sb_glsl_free(&fragment);
}

static void set_uniforms(const struct probe *probe)
{
    const GLuint program = probe->program.name;
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "u_points"), 0);
    for (int i = 0; i < CASTERS; i++) {
        char name[40];
        snprintf(name, sizeof name, "u_point[%d].position", i);
        glUniform3fv(glGetUniformLocation(program, name), 1,
                     probe->fixture.world.light[i].position);
        snprintf(name, sizeof name, "u_point[%d].range", i);
        glUniform1f(glGetUniformLocation(program, name),
                    probe->fixture.world.light[i].range);
    }
    sb_shadow_set_units(program);
}

// Draws the answers, one channel a caster.
static void ask(const char *words, struct sb_image *answers)
{
    const struct sb_target_params params = {SIDE, SIDE, 1, SB_GL_RGBA32F};
    struct sb_error err = {0};
    struct probe probe = {0};
    fixture_make(&probe.fixture, words);
    probe_program_make(&probe);
    set_uniforms(&probe);
    glGenVertexArrays(1, &probe.vertex_array);
    glBindVertexArray(probe.vertex_array);
    glGenTextures(1, &probe.list);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, probe.list);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, SIDE, SIDE, 0, GL_RGBA, GL_FLOAT, points);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    if (!sb_target_make(&probe.target, &caps, &params, &err))
        fail_msg("%s", err.text);
    sb_shadow_bind(&probe.fixture.shadow);
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, SIDE, SIDE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (!sb_target_read(&probe.target, answers, &err))
        fail_msg("%s", err.text);
    sb_target_free(&probe.target);
    glDeleteTextures(1, &probe.list);
    glDeleteVertexArrays(1, &probe.vertex_array);
    sb_gl_program_free(&probe.program);
    fixture_free(&probe.fixture);
}

// Places all over the room.
static void scatter_points(void)
{
    struct sb_random random = sb_random_seed(5);
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < 3; j++)
            points[i][j] = (float)(room.low[j] + sb_random_unit(&random) *
                                                     (room.high[j] - room.low[j]));
        points[i][3] = 1;
    }
}

// --- the count -----------------------------------------------------------------------------

// The direction of the centre of the texel that a direction meets. All kinds divide their
// faces alike.
static void texel_centre(const double *d, double *centre)
{
    const double m = largest_of(d);
    for (int i = 0; i < 3; i++) {
        const double at = floor((d[i] / m * 0.5 + 0.5) * SIZE);
        centre[i] = fabs(d[i]) == m ? copysign(1, d[i]) : (2 * at + 1) / SIZE - 1;
    }
}

// Margin by which a tap finds the point lit; negative: in shadow.
static double tap(int caster, const double *to_point, const double *direction, int store,
                  double bias)
{
    double centre[3];
    texel_centre(direction, centre);
    const double d = length_of(to_point);
    const double seen = stored_seen(caster, centre, store), left = 1 - d / range;
    if (store != SB_SHADOW_STORE_DEPTH)
        return fmin(left, left + bias - seen);
    const double near = range / 1000;
    const double m = largest_of(to_point) * (1 - bias * range / d);
    return fmin(left, seen - (1 / near - 1 / fmax(m, near)) / (1 / near - 1 / range));
}

// The share of the taps that are lit; *margin: the least of theirs.
static double share(int caster, const float *point, int side, int store, double bias,
                    double *margin)
{
    double to_point[3];
    int axis = 0, lit = 0;
    for (int i = 0; i < 3; i++)
        to_point[i] = point[i] - lights[caster][i];
    for (int i = 1; i < 3; i++)
        if (fabs(to_point[i]) > fabs(to_point[axis]))
            axis = i;
    const double texel = 2 * fabs(to_point[axis]) / SIZE;
    *margin = INFINITY;
    for (int i = 0; i < side * side; i++) {
        double direction[3] = {to_point[0], to_point[1], to_point[2]};
        direction[(axis + 1) % 3] += (i / side - 0.5 * (side - 1)) * texel;
        direction[(axis + 2) % 3] += (i % side - 0.5 * (side - 1)) * texel;
        const double by = tap(caster, to_point, direction, store, bias);
        lit += by > 0;
        *margin = fmin(*margin, fabs(by));
    }
    return lit / (double)(side * side);
}

// Texels whose centre lies on an outline of the block (the rasteriser has 1/256 of a texel),
// taps on the border of two texels and comparisons of nearly equal values may go either way.
enum { MAY_DIFFER = POINTS / 100 };

static void check_answers(const char *words, int side, int store)
{
    struct sb_image answers;
    int wrong = 0, between = 0;
    ask(words, &answers);
    for (int i = 0; i < POINTS; i++)
        for (int c = 0; c < CASTERS; c++) {
            double margin;
            const double want = share(c, points[i], side, store, 0.01, &margin);
            const double got = answers.data[4 * i + c];
            check_close(got * side * side, rint(got * side * side), 0);
            wrong += got != want;
            between += got > 0 && got < 1;
        }
    sb_image_free(&answers);
    if (wrong > MAY_DIFFER)
        fail_msg("%s: %d of %d answers differ", words, wrong, CASTERS * POINTS);
    assert_true(side == 1 ? between == 0 : between > POINTS / 50);
}

static void the_share_of_lit_taps_is_what_a_count_finds(void **state)
{
    (void)state;
    static const struct {
        const char *word;
        int store;
    } stores[] = {{"r32f", SB_SHADOW_STORE_R32F}, {"depth", SB_SHADOW_STORE_DEPTH}};
    scatter_points();
    for (int i = 0; i < 4; i++)
        for (int side = 1; side <= 4; side *= 2)
            for (int s = 0; s < 2; s++) {
                char words[200];
                snprintf(words, sizeof words,
                         "%s shadow_size=%d shadow_filter=%d shadow_store=%s", ways[i],
                         SIZE, side * side, stores[s].word);
                // How many taps there are has nothing to do with what they compare.
                if (can(words) && (s == 0 || side == 2))
                    check_answers(words, side, stores[s].store);
            }
}

static void every_kind_of_map_and_way_to_draw_it_gives_the_same_answers(void **state)
{
    (void)state;
    static const char *const qualities[] = {
        "shadow_store=r8", "shadow_store=r16f shadow_filter=4",
        "shadow_store=r32f shadow_filter=16",
        "shadow_store=depth shadow_filter=16 shadow_bias_kind=slope"};
    scatter_points();
    for (int q = 0; q < 4; q++) {
        struct sb_image first = {0};
        for (int i = 0; ways[i]; i++) {
            char words[200];
            struct sb_image answers;
            struct sb_image_difference difference;
            snprintf(words, sizeof words, "%s shadow_size=%d %s", ways[i], SIZE,
                     qualities[q]);
            if (!can(words))
                continue;
            ask(words, &answers);
            if (!first.data) {
                first = answers;
                continue;
            }
            sb_image_compare(&first, &answers, &difference);
            // On the border of two texels the units of cube maps may round the other way.
            if (difference.pixels > POINTS / 1000)
                fail_msg("%s: %ld of %d points differ", words, difference.pixels, POINTS);
            sb_image_free(&answers);
        }
        sb_image_free(&first);
    }
}

// Behind the wall that a texel's very centre sees, a point is lit as long as it is not farther
// behind than the bias.
static void scatter_points_behind_walls(double *behind)
{
    struct sb_random random = sb_random_seed(6);
    for (int i = 0; i < POINTS; i++) {
        double d[3];
        direction_of(SB_SHADOW_MAP_CUBE, i % 6, (2.0 * (i % 61) + 3) / SIZE - 1,
                     (2.0 * (i % 53) + 3) / SIZE - 1, d);
        behind[i] = 0.12 * sb_random_unit(&random);
        const double t = distance_seen(0, d) + behind[i] * range / length_of(d);
        for (int j = 0; j < 3; j++)
            points[i][j] = (float)(lights[0][j] + t * d[j]);
        points[i][3] = (float)sb_random_unit(&random);
    }
}

static void check_bias(const char *words, bool slope)
{
    static double behind[POINTS];
    struct sb_image answers;
    int lit[2] = {0};
    scatter_points_behind_walls(behind);
    ask(words, &answers);
    for (int i = 0; i < POINTS; i++) {
        const double angle = acos((double)points[i][3]);
        const double bias = 0.01 * (slope ? 1 + fmin(tan(angle), 9) : 1);
        if (fabs(behind[i] - bias) < 1e-4)
            continue;
        const double d[3] = {points[i][0] - lights[0][0], points[i][1] - lights[0][1],
                             points[i][2] - lights[0][2]};
        const bool want = behind[i] < bias && length_of(d) < range;
        lit[want]++;
        if (answers.data[4 * i] != want)
            fail_msg("%s: %g behind at a cosine of %g: %g", words, behind[i],
                     (double)points[i][3], (double)answers.data[4 * i]);
    }
    assert_true(lit[0] > 100 && lit[1] > 100);
    sb_image_free(&answers);
}

static void the_bias_lights_what_is_so_much_farther(void **state)
{
    (void)state;
    static const char *const stores[] = {"r32f", "depth"};
    for (int slope = 0; slope < 2; slope++)
        for (int i = 0; i < 2; i++) {
            char words[150];
            snprintf(
                words, sizeof words,
                "shadow_size=%d shadow_bias=0.01 shadow_bias_kind=%s shadow_store=%s",
                SIZE, slope ? "slope" : "constant", stores[i]);
            check_bias(words, slope);
        }
}

// Directions on which two or three components are equal belong to some face in every kind,
// and find the same open room there.
static void directions_between_faces_are_lit_like_their_neighbours(void **state)
{
    (void)state;
    for (int i = 0; i < POINTS; i++) {
        const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 % 3 - 1};
        const float t = 0.25f + 0.5f * (float)(i / 27 % 2);
        for (int j = 0; j < 3; j++) // exact in binary: the difference is t, or 0
            points[i][j] = (float)lights[0][j] + t * (float)step[j];
        points[i][3] = 1;
    }
    for (int i = 0; i < 4; i++)
        for (int side = 1; side <= 4; side *= 4) {
            char words[200];
            struct sb_image answers;
            snprintf(words, sizeof words, "%s shadow_size=%d shadow_filter=%d", ways[i],
                     SIZE, side * side);
            if (!can(words))
                continue;
            ask(words, &answers);
            for (int p = 0; p < POINTS; p++) {
                double margin, to_point[3];
                for (int j = 0; j < 3; j++)
                    to_point[j] = points[p][j] - lights[0][j];
                if (largest_of(to_point) > 0 &&
                    share(0, points[p], 5, SB_SHADOW_STORE_R32F, 0.01, &margin) == 1)
                    check_close(answers.data[4 * p], 1, 0);
            }
            sb_image_free(&answers);
        }
}

static void the_maps_keep_out_of_the_units_of_the_textures(void **state)
{
    (void)state;
    struct fixture fixture;
    fixture_make(&fixture, "shadow_map=six2d shadow_store=r8 shadow_size=16");
    GLuint mine;
    glGenTextures(1, &mine);
    for (GLenum unit = 0; unit < SB_MAP_COUNT; unit++) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, mine);
    }
    sb_shadow_draw(&fixture.shadow, &fixture.shadow.phase[0]);
    assert_int_equal(sb_shadow_bind(&fixture.shadow), 2 * 6 * CASTERS);
    for (GLenum unit = 0; unit < SB_MAP_COUNT + 6 * CASTERS; unit++) {
        GLint bound;
        glActiveTexture(GL_TEXTURE0 + unit);
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
        assert_int_equal(bound, unit < SB_MAP_COUNT
                                    ? mine
                                    : fixture.shadow.texture[unit - SB_MAP_COUNT]);
    }
    glDeleteTextures(1, &mine);
    fixture_free(&fixture);
}

int main(void)
{
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_share_of_lit_taps_is_what_a_count_finds),
        cmocka_unit_test(every_kind_of_map_and_way_to_draw_it_gives_the_same_answers),
        cmocka_unit_test(the_bias_lights_what_is_so_much_farther),
        cmocka_unit_test(directions_between_faces_are_lit_like_their_neighbours),
        cmocka_unit_test(the_maps_keep_out_of_the_units_of_the_textures),
    };
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
