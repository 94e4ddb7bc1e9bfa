// What one light adds: attenuation, cone, side, ambient light and model.
#include "relations.h"

// Single precision, through a power of 6 or so.
#define CLOSE 2e-6

static struct sb_vec3 to_first(const struct setting *setting, struct sb_vec3 place)
{
    return sb_vec3_sub(vec(setting->light[0].position), place);
}

// --- attenuation -----------------------------------------------------------------------------

static double fall_none(const struct sb_light *light, double d)
{
    (void)light;
    (void)d;
    return 1;
}

static double fall_polynomial(const struct sb_light *light, double d)
{
    return 1 / (light->constant + light->linear * d + light->quadratic * d * d);
}

static double fall_radius(const struct sb_light *light, double d)
{
    return fmax(1 - d / light->range, 0);
}

static double fall_windowed(const struct sb_light *light, double d)
{
    const double window = fmax(1 - pow(d / light->range, 4), 0);
    return window * window / (d * d + 1);
}

static double (*fall)(const struct sb_light *light, double d);

static bool fallen_off(const struct setting *setting, struct sb_vec3 place,
                       double colour[3])
{
    const struct sb_vec3 to_light = to_first(setting, place);
    struct form form = form_begin(setting, place, to_light);
    form.factor = fall(&setting->light[0], sb_vec3_length(to_light));
    colour[0] = form.factor;
    colour[1] = form_diffuse(&form);
    colour[2] = form_blinn(&form);
    return true;
}

void attenuation_follows_its_closed_form(void **state)
{
    (void)state;
    static const struct {
        const char *word;
        double (*law)(const struct sb_light *, double);
    } laws[] = {{"none", fall_none},
                {"polynomial", fall_polynomial},
                {"radius", fall_radius},
                {"windowed", fall_windowed}};
    static const char *const forms[] = {"robust", "naive"};
    struct setting setting;
    setting_init(&setting);
    for (int l = 0; l < 4; l++)
        for (int w = 0; ways[w]; w++)
            for (int f = 0; f < 2; f++) {
                char words[200];
                if (f > 0 && w > 0) // neither stage nor space matters to the form
                    continue;
                struct sb_light light = light_at(-0.3, 0.2, 0.75);
                snprintf(words, sizeof words,
                         "attenuation=%s %s ambient=per_light form=%s", laws[l].word,
                         ways[w], forms[f]);
                fall = laws[l].law;
                setting_one(&setting, SB_LIGHT_POINT, light);
                check_form(&setting, words, fallen_off, CLOSE, SIDE * SIDE);
                light.range = 1.5; // ends in the picture
                setting_one(&setting, SB_LIGHT_POINT, light);
                check_form(&setting, words, fallen_off, CLOSE, SIDE * SIDE);
                // The wikibook's 1/d.
                light.constant = light.quadratic = 0;
                light.linear = 1;
                setting_one(&setting, SB_LIGHT_POINT, light);
                check_form(&setting, words, fallen_off, CLOSE, SIDE * SIDE);
            }
}

// Right at the light 1/d has no value. The robust form stops at 10000 times the light's colour.
void the_pole_of_an_inverse_distance_is_cut_off(void **state)
{
    (void)state;
    static const char words[] = "attenuation=polynomial ambient=per_light";
    struct setting setting;
    struct sb_image image;
    setting_init(&setting);
    const struct sb_vec3 place = place_of(&setting, 5, 9);
    struct sb_light light = light_at(place.x, place.y, 0);
    light.constant = light.quadratic = 0;
    light.linear = 1;
    setting_one(&setting, SB_LIGHT_POINT, light);
    draw(&setting, words, &image);
    assert_int_equal(sb_image_count_nonfinite(&image), 0);
    check_close(sb_image_at(&image, 5, 9)[0], 1e4, 1);
    // Its neighbours are an eighth away.
    check_close(sb_image_at(&image, 6, 9)[0], 8, 1e-4);
    sb_image_free(&image);
    // As textbooks have it, the pole is there.
    draw(&setting, "attenuation=polynomial ambient=per_light form=naive", &image);
    assert_false(isfinite(sb_image_at(&image, 5, 9)[0]));
    check_close(sb_image_at(&image, 6, 9)[0], 8, 1e-4);
    sb_image_free(&image);
}

// --- cones -----------------------------------------------------------------------------------

// By the angle, as a reader of the texts would; false where it ends within rounding.
typedef bool (*cone_law)(const struct sb_light *light, double angle, double *share);
enum { EDGE_PER_RADIAN = 2000 };

static bool within(double angle, double limit, bool *inside)
{
    *inside = angle < limit;
    return fabs(angle - limit) > 1.0 / EDGE_PER_RADIAN;
}

static bool cone_hard(const struct sb_light *light, double angle, double *share)
{
    bool inside;
    const bool decided = within(angle, light->cutoff, &inside);
    *share = inside;
    return decided;
}

static bool cone_exponent(const struct sb_light *light, double angle, double *share)
{
    bool inside;
    const bool decided = within(angle, light->cutoff, &inside);
    *share = inside ? pow(fmax(cos(angle), 0), light->exponent) : 0;
    return decided;
}

static bool cone_linear(const struct sb_light *light, double angle, double *share)
{
    *share = fmax(1 - (1 - cos(angle)) / (1 - cos(light->cutoff)), 0);
    return true;
}

static bool cone_smooth(const struct sb_light *light, double angle, double *share)
{
    const double outer = cos(light->cutoff), inner = cos(light->inner);
    *share = fmin(fmax((cos(angle) - outer) / (inner - outer), 0), 1);
    return true;
}

static bool cone_eased(const struct sb_light *light, double angle, double *share)
{
    cone_smooth(light, angle, share);
    *share *= *share * (3 - 2 * *share);
    return true;
}

static cone_law cone;

static bool in_cone(const struct setting *setting, struct sb_vec3 place, double colour[3])
{
    const struct sb_light *light = &setting->light[0];
    const struct sb_vec3 to_light = to_first(setting, place);
    struct form form = form_begin(setting, place, to_light);
    const struct sb_vec3 axis = sb_vec3_normalise(vec(light->direction));
    const double angle = acos(-sb_vec3_dot(form.to_light, axis));
    const bool decided = cone(light, angle, &form.factor);
    colour[0] = form.factor;
    colour[1] = form_diffuse(&form);
    colour[2] = form_blinn(&form);
    return decided;
}

static const struct {
    const char *word;
    cone_law law;
} cones[] = {{"hard", cone_hard},
             {"exponent", cone_exponent},
             {"linear", cone_linear},
             {"smooth", cone_smooth}};

// Where, of what cut-off, in every way to evaluate it.
static void check_cones(struct setting *setting, const struct sb_light *light)
{
    static const char *const evaluated[] = {"",
                                            "form=naive",
                                            "hoist=per_light",
                                            "hoist=per_light form=naive",
                                            "guard=mask",
                                            "layout=unified hoist=per_light"};
    setting_one(setting, SB_LIGHT_SPOT, *light);
    for (int l = 0; l < 4; l++)
        for (int w = 0; ways[w]; w++)
            for (int e = 0; e < 6; e++) {
                char words[200];
                if (e > 0 && w % 3 != 0) // by light in world and by vertex in view space
                    continue;
                snprintf(words, sizeof words,
                         "cone=%s attenuation=none ambient=per_light %s %s",
                         cones[l].word, ways[w], evaluated[e]);
                const bool eases = l == 3 && strstr(evaluated[e], "naive");
                cone = eases ? cone_eased : cones[l].law;
                // The ramp and the line divide roundings by the width of the cone.
                check_form(setting, words, in_cone, 2e-5, SIDE * SIDE * 9 / 10);
            }
}

void cones_follow_their_closed_forms(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    struct sb_light light = light_at(-0.5, 0.25, 1.5);
    const struct sb_vec3 axis = sb_vec3_normalise((struct sb_vec3){0.3, -0.2, -1});
    light.direction[0] = (float)axis.x;
    light.direction[1] = (float)axis.y;
    light.direction[2] = (float)axis.z;
    check_cones(&setting, &light);
    light.exponent = 0;
    sb_light_set_cone(&light, 0.5, 1.4);
    check_cones(&setting, &light);
}

void a_cone_of_more_than_a_right_angle_lights_behind_itself(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    struct sb_light light = light_at(0.5, 0.25, 0.5);
    const struct sb_vec3 axis = sb_vec3_normalise((struct sb_vec3){0.9, 0.3, 0.25});
    light.direction[0] = (float)axis.x;
    light.direction[1] = (float)axis.y;
    light.direction[2] = (float)axis.z;
    sb_light_set_cone(&light, 1.5, 2);
    for (int l = 0; l < 4; l++) {
        // A power of a cosine that is not positive has no form to go by (but for 0).
        if (cones[l].law == cone_exponent)
            continue;
        char words[100];
        setting_one(&setting, SB_LIGHT_SPOT, light);
        snprintf(words, sizeof words, "cone=%s attenuation=none ambient=per_light",
                 cones[l].word);
        cone = cones[l].law;
        check_form(&setting, words, in_cone, CLOSE, SIDE * SIDE * 9 / 10);
    }
}

// --- sides, ambient light, models ------------------------------------------------------------

static enum form_side side;
static double (*model)(const struct form *form);
static bool scene_ambient, light_ambient;

static bool by_model(const struct setting *setting, struct sb_vec3 place,
                     double colour[3])
{
    struct form form = form_begin(setting, place, to_first(setting, place));
    form.side = side;
    form.factor =
        fall_polynomial(&setting->light[0], sb_vec3_length(to_first(setting, place)));
    colour[0] = scene_ambient   ? setting->ambient[0]
                : light_ambient ? form.factor * setting->light[0].ambient[0]
                                : 0;
    colour[1] = form_diffuse(&form);
    colour[2] = model ? model(&form) : 0;
    return true;
}

static void check_model(const struct setting *setting, const char *words)
{
    for (int w = 0; ways[w]; w++) {
        char all[200];
        snprintf(all, sizeof all, "%s %s", words, ways[w]);
        // The power multiplies what is rounded in the cosine.
        check_form(setting, all, by_model, CLOSE * fmax(1, setting->shininess / 8),
                   SIDE * SIDE);
    }
}

// The eye is before the wall and the light behind it, low, so that there is a highlight to cut.
void a_wall_that_faces_away_shows_highlights_where_asked(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    setting_look(&setting, (struct sb_vec3){2.5, 0.5, 0.75}, (struct sb_vec3){0, 0, 0},
                 (struct sb_vec3){0, 0, 1});
    setting_one(&setting, SB_LIGHT_POINT, light_at(-2, -1, -0.5));
    scene_ambient = light_ambient = false;
    static const char *const guards[] = {"branch", "mask"};
    for (int g = 0; g < 2; g++)
        for (int m = 0; m < 2; m++) {
            char words[120], front[100];
            snprintf(front, sizeof front, "ambient=none guard=%s model=%s", guards[g],
                     m ? "phong" : "blinn");
            model = m ? form_phong : form_blinn;
            side = FRONT;
            check_model(&setting, front);
            snprintf(words, sizeof words, "specular_side=both %s", front);
            side = BOTH;
            check_model(&setting, words);
            check_other(&setting, words, &setting, front, 1e-3);
        }
}

void ambient_light_is_of_the_scene_of_each_light_or_none(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    struct sb_light light = light_at(0.5, -0.25, 0.5);
    light.ambient[0] = 0.375f;
    side = FRONT;
    model = form_blinn;
    for (int i = 0; i < 3; i++) {
        static const char *const words[] = {"ambient=none", "ambient=scene",
                                            "ambient=per_light"};
        scene_ambient = i == 1;
        light_ambient = i == 2;
        setting_one(&setting, SB_LIGHT_POINT, light);
        check_model(&setting, words[i]);
        // From behind a wall too: ambient light has no direction.
        light.position[2] = -0.5f;
        setting_one(&setting, SB_LIGHT_POINT, light);
        check_model(&setting, words[i]);
        light.position[2] = 0.5f;
    }
}

void models_follow_their_closed_forms(void **state)
{
    (void)state;
    static const struct {
        const char *word;
        double (*highlight)(const struct form *);
    } models[] = {{"lambert", NULL}, {"phong", form_phong}, {"blinn", form_blinn}};
    struct setting setting;
    setting_init(&setting);
    side = FRONT;
    scene_ambient = light_ambient = false;
    for (int m = 0; m < 3; m++)
        for (int s = 0; s < 3; s++) {
            static const float shininess[] = {1, 8, 32};
            char words[100];
            setting.shininess = shininess[s];
            model = models[m].highlight;
            setting_one(&setting, SB_LIGHT_POINT, light_at(0.5, -0.25, 0.5));
            snprintf(words, sizeof words, "ambient=none model=%s form=%s", models[m].word,
                     s == 1 ? "naive" : "robust");
            check_model(&setting, words);
            snprintf(words, sizeof words, "ambient=none model=%s hoist=per_light",
                     models[m].word);
            check_model(&setting, words);
        }
}

static bool by_sun(const struct setting *setting, struct sb_vec3 place, double colour[3])
{
    const struct sb_vec3 travels = vec(setting->light[0].direction);
    struct form form = form_begin(setting, place, sb_vec3_scale(travels, -1));
    colour[0] = setting->light[0].ambient[0];
    colour[1] = form_diffuse(&form);
    colour[2] = form_blinn(&form);
    return true;
}

void directional_lights_may_be_of_any_length(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    for (int w = 0; ways[w]; w++)
        for (int i = -1; i <= 1; i++)
            for (int layout = 0; layout < 2; layout++) {
                char words[160];
                struct sb_light light = light_at(0, 0, 0);
                light.direction[0] = ldexpf(0.5f, 4 * i);
                light.direction[1] = ldexpf(-0.25f, 4 * i);
                light.direction[2] = ldexpf(-0.875f, 4 * i);
                setting_one(&setting, SB_LIGHT_DIR, light);
                snprintf(words, sizeof words, "ambient=per_light layout=%s %s",
                         layout ? "unified" : "split", ways[w]);
                check_form(&setting, words, by_sun, CLOSE, SIDE * SIDE);
            }
}
