// Each preset draws what its source text says: the picture of `run --dump` against the text's own
// formula, as written and corrected, evaluated in double (cli_sources/).
#include "cli_gl.h"

#include <dirent.h>

#include "cli_sources/sources.h"

#define TOLERANCE 1e-4

// --- one pixel ---------------------------------------------------------------------------

static struct vec evaluate(const struct dump *dump, text_formula formula,
                           const struct surface *at, struct decisions *made)
{
    *made = (struct decisions){0};
    return formula(dump, at, dump->as_written, made);
}

static double largest(struct vec a, struct vec b)
{
    const struct vec d = minus(a, b);
    return fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z)));
}

// Does a sixteenth of a pixel aside decide otherwise? The rasteriser has vertices on a grid of
// 1/256 of a pixel or so, and floats.
static bool is_undecided(const struct dump *dump, text_formula formula, double x,
                         double y, const struct surface *at, const struct decisions *here)
{
    for (int i = 0; i < 4; i++) {
        struct decisions there;
        const struct surface beside =
            trace_pixel(dump, x + (i & 1 ? 1 : -1) / 16.0, y + (i & 2 ? 1 : -1) / 16.0);
        if (beside.draw != at->draw || length(minus(beside.normal, at->normal)) > 0.1)
            return true;
        evaluate(dump, formula, &beside, &there);
        if (there.doubtful || there.bits != here->bits)
            return true;
    }
    return false;
}

// How much the colour depends on the 1/256 of a texel at which maps are sampled: OpenGL does not
// say how exact the weights of a linear filter are, and 8 bits are usual.
static double sampling_spread(const struct dump *dump, text_formula formula,
                              const struct surface *at, struct vec colour)
{
    const struct sb_image *maps[] = {&dump->diffuse_map, &dump->specular_map,
                                     &dump->normal_map};
    int size = 0;
    double spread = 0;
    for (int i = 0; i < 3; i++)
        size = maps[i]->width > size ? maps[i]->width : size;
    for (int i = 0; size && i < 4; i++) {
        struct decisions ignored;
        struct surface moved = *at;
        moved.u += (i & 1 ? 1 : -1) / (256.0 * size);
        moved.v += (i & 2 ? 1 : -1) / (256.0 * size);
        spread = fmax(spread, largest(evaluate(dump, formula, &moved, &ignored), colour));
    }
    return spread;
}

// --- a picture ---------------------------------------------------------------------------

struct agreement {
    long covered, compared, lamps;
    double difference; // largest
    double excess;     // likewise, less what sampling leaves open
};

static struct vec pixel(const struct sb_image *image, int x, int y)
{
    const float *p = sb_image_at(image, x, y);
    return (struct vec){p[0], p[1], p[2]};
}

static void compare_pixel(const struct dump *dump, text_formula formula, int x, int y,
                          struct agreement *sum)
{
    const int drawn = (int)*sb_image_at(&dump->id, x, y) - 1;
    const struct surface at = trace_pixel(dump, x + 0.5, y + 0.5);
    struct decisions made;
    if (drawn < 0)
        return;
    sum->covered++;
    if (dump->draw[drawn].lamp >= 0) { // unlit: the texts have no formula for it
        sum->lamps++;
        return;
    }
    if (at.draw != drawn)
        return;
    const struct vec wanted = evaluate(dump, formula, &at, &made);
    if (made.doubtful || is_undecided(dump, formula, x + 0.5, y + 0.5, &at, &made))
        return;
    const struct vec found = pixel(&dump->colour, x, y);
    const double difference = largest(found, wanted);
    const double left_open =
        difference > TOLERANCE ? sampling_spread(dump, formula, &at, wanted) : 0;
    const double excess = difference - left_open;
    if (excess > TOLERANCE || difference != difference)
        print_error("pixel %d, %d: %.7g %.7g %.7g, by the text %.7g %.7g %.7g\n", x, y,
                    found.x, found.y, found.z, wanted.x, wanted.y, wanted.z);
    sum->compared++;
    sum->difference = fmax(sum->difference, difference);
    sum->excess = difference != difference ? INFINITY : fmax(sum->excess, excess);
}

static void check_picture(const char *name, const struct dump *dump, text_formula formula)
{
    struct agreement sum = {0};
    for (int y = 0; y < dump->colour.height; y++)
        for (int x = 0; x < dump->colour.width; x++)
            compare_pixel(dump, formula, x, y, &sum);
    print_message(
        "%s, %s, %s: %ld of %ld pixels compared (%.1f %%; %ld show lamps), largest "
        "difference %.2g, %.2g beyond what sampling leaves open\n",
        name, dump->as_written ? "as written" : "corrected",
        dump->has_normal_map    ? "normal map"
        : dump->has_diffuse_map ? "maps"
                                : "no maps",
        sum.compared, sum.covered, 100.0 * (double)sum.compared / (double)sum.covered,
        sum.lamps, sum.difference, sum.excess);
    assert_true(sum.covered > dump->colour.width * dump->colour.height / 10);
    if (5 * sum.compared < 3 * sum.covered)
        fail_msg("%s: %ld of %ld pixels could be compared", name, sum.compared,
                 sum.covered);
    if (sum.excess > TOLERANCE)
        fail_msg("%s: differs from its text by %g", name, sum.difference);
}

// --- a preset ----------------------------------------------------------------------------

struct trial {
    const char *preset, *name;
    text_formula formula;
    const char *more; // options
    int pictures;
    double
        slips; // at least so much the slips must change some value, or else the test could
               // not tell; 0: the text has none
};

// Draws the preset's variants, and reads the dumps; returns their number. The texts ramp the cosine
// of a soft cone in a straight line, which the naive smoothstep does not.
static int draw(const struct trial *trial, struct dump *dumps, int room)
{
    static struct answer answer;
    char line[1024], path[128];
    int count = 0;
    snprintf(line, sizeof line,
             "run -q %s --preset %s --set precision=highp --set "
             "p_color=highp --set target=rgba32f --set width=64 --set height=64 --set "
             "form=naive --set f_cone=robust --cross text=as_written,corrected %s "
             "--rounds 10 --first-look 10 "
             "--budget 1 --batch 1 -o @/run-%s --dump @/dump-%s",
             platform, trial->preset, trial->more, trial->name, trial->name);
    run_program(&answer, line);
    if (answer.code != 0 && !no_timer(&answer)) {     // dumps are written all the same
        fprintf(stderr, "%s\n%s", line, answer.text); // cmocka cuts what is this long
        fail_msg("exit code %d", answer.code);
    }
    snprintf(path, sizeof path, "%s/dump-%s", test_dir, trial->name);
    DIR *folder = opendir(path);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        char name[512];
        if (entry->d_name[0] == '.')
            continue;
        assert_true(count < room);
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        dump_read(&dumps[count++], name);
    }
    closedir(folder);
    return count;
}

// The largest difference that the slips make.
static double slips_show(const struct dump *dumps, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < i; j++) {
            const struct dump *a = &dumps[i], *b = &dumps[j];
            if (a->as_written == b->as_written || a->has_normal_map != b->has_normal_map)
                continue;
            for (int p = 0; p < a->colour.width * a->colour.height; p++)
                most =
                    fmax(most, largest(pixel(&a->colour, p, 0), pixel(&b->colour, p, 0)));
        }
    return most;
}

static void check_trial(const struct trial *trial)
{
    struct dump dumps[4];
    if (!is_egl() || !caps.colour_float)
        skip(); // what is the driver's is tried in one kind of context
    const int count = draw(trial, dumps, 4);
    assert_int_equal(count, trial->pictures);
    for (int i = 0; i < count; i++)
        check_picture(trial->name, &dumps[i], trial->formula);
    const double shown = slips_show(dumps, count);
    if (shown < trial->slips)
        fail_msg("%s: the slips change no value by more than %g", trial->name, shown);
    for (int i = 0; i < count; i++)
        dump_free(&dumps[i]);
}

static void delphi_draws_what_its_text_says(void **state)
{
    (void)state;
    check_trial(&(struct trial){"delphi", "delphi", formula_delphi,
                                "--cross maps=none,diffuse+specular", 2, 0});
    // Between lights on all sides, some of which are behind what the eye sees.
    check_trial(&(struct trial){"delphi", "delphi-room", formula_delphi,
                                "--scene room --set maps=none --set point=8", 1, 0});
}

static void wikibooks_draws_what_its_text_says(void **state)
{
    (void)state;
    check_trial(&(struct trial){"wikibooks", "wikibooks", formula_wikibooks, "", 1, 0});
    check_trial(&(struct trial){"wikibooks", "wikibooks-room", formula_wikibooks,
                                "--scene room --set point=8 --set dir=1", 1, 0});
}

static void lwjgl_draws_what_its_text_says(void **state)
{
    (void)state;
    check_trial(&(struct trial){"lwjgl", "lwjgl", formula_lwjgl, "", 2, 0.01});
}

static void ubo_draws_what_its_text_says(void **state)
{
    (void)state;
    check_trial(&(struct trial){"ubo", "ubo", formula_ubo, "", 2, 0.01});
}

static void shadows_draws_what_its_text_says(void **state)
{
    (void)state;
    check_trial(&(struct trial){"shadows", "shadows", formula_shadows,
                                "--cross maps=diffuse,diffuse+normal", 4, 0.01});
    // Lights of long range: to the 25th power the intensity leaves something to be tinted.
    check_trial(&(struct trial){
        "shadows", "shadows-near", formula_shadows,
        "--scene containers --set shadows=0 --set update=lights --set point=4", 2, 0.01});
}

int main(void)
{
    begin_gl_tests();
    // llvmpipe filters 8-bit maps in 8-bit arithmetic unless it is told not to, and a texel that is
    // off by half of 1/255 is seen. Other drivers do not know the variable.
    setenv("GALLIVM_PERF", "no_aos_sampling", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(delphi_draws_what_its_text_says),
        cmocka_unit_test(wikibooks_draws_what_its_text_says),
        cmocka_unit_test(lwjgl_draws_what_its_text_says),
        cmocka_unit_test(ubo_draws_what_its_text_says),
        cmocka_unit_test(shadows_draws_what_its_text_says),
    };
    return end_tests(run_tests(tests));
}
