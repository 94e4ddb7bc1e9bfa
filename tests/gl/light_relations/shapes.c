// Area lights against brute force: the point of the shape that is nearest to the surface, or to
// the reflected ray, is looked for among points all over the shape, by nothing but the shape's
// own definition.
#include "relations.h"

// --- shapes, as sets of points ---------------------------------------------------------------

enum shape { SPHERE, TUBE, BOX, CAPSULE, SHAPES };
static const char *const shape_words[SHAPES] = {"sphere", "tube", "box", "capsule"};

// A point of the shape, from numbers in [-1, 1]: three of a box or ball, one along a segment.
static struct sb_vec3 point_of(enum shape shape, const struct sb_light *light,
                               const double t[4])
{
    struct sb_vec3 point = vec(light->position);
    const double solid[3] = {t[0], t[1], t[2]};
    if (shape == TUBE || shape == CAPSULE)
        point = sb_vec3_add(point, sb_vec3_scale(vec(light->direction), t[3]));
    if (shape == BOX)
        return sb_vec3_add(point, (struct sb_vec3){solid[0] * light->extent[0],
                                                   solid[1] * light->extent[1],
                                                   solid[2] * light->extent[2]});
    if (shape == TUBE)
        return point;
    const struct sb_vec3 inside = {solid[0], solid[1], solid[2]};
    const double beyond = fmax(sb_vec3_length(inside), 1);
    return sb_vec3_add(point, sb_vec3_scale(inside, light->radius / beyond));
}

// What is to be least: the distance to a point, or to a line through `from`.
struct aim {
    struct sb_vec3 from;
    struct sb_vec3 line; // of unit length; 0: none
};

static double miss(const struct aim *aim, struct sb_vec3 point)
{
    const struct sb_vec3 to = sb_vec3_sub(point, aim->from);
    const double along = sb_vec3_dot(to, aim->line);
    return sb_vec3_dot(to, to) - along * along;
}

// The best of the points at -1, -1/2, 0, 1/2, 1 times `width` around t, in each of the numbers
// that the shape has; false: it is t itself.
static void best_around(enum shape shape, const struct sb_light *light,
                        const struct aim *aim, double width, double t[4])
{
    const bool line = shape == TUBE || shape == CAPSULE;
    const int solid = shape == TUBE ? 1 : 125, along = line ? 5 : 1;
    double least = INFINITY, best[4] = {0};
    for (int i = 0; i < solid * along; i++) {
        const int step[4] = {shape == TUBE ? 2 : i % 5, shape == TUBE ? 2 : i / 5 % 5,
                             shape == TUBE ? 2 : i / 25 % 5, line ? i / solid % 5 : 2};
        double at[4];
        for (int k = 0; k < 4; k++)
            at[k] = fmin(fmax(t[k] + width * (step[k] - 2) / 2, -1), 1);
        const double missed = miss(aim, point_of(shape, light, at));
        if (missed < least) {
            least = missed;
            memcpy(best, at, sizeof best);
        }
    }
    memcpy(t, best, sizeof best);
}

static struct sb_vec3 nearest(enum shape shape, const struct sb_light *light,
                              const struct aim *aim)
{
    double t[4] = {0};
    for (double width = 1; width > 1e-8; width *= 0.7)
        best_around(shape, light, aim, width, t);
    return point_of(shape, light, t);
}

// --- pictures --------------------------------------------------------------------------------

static enum shape shape;

static struct sb_vec3 reflected_ray(const struct form *form)
{
    const double along = sb_vec3_dot(form->normal, form->to_eye);
    return sb_vec3_sub(sb_vec3_scale(form->normal, 2 * along), form->to_eye);
}

// Where highlights come from. Of a box it is the point nearest to where the reflected ray is as
// far as the centre; of the other shapes the one nearest to the ray, of a capsule the nearest of
// the ball around the nearest of the segment.
static struct sb_vec3 highlight_of(const struct sb_light *light, struct sb_vec3 place,
                                   struct sb_vec3 ray)
{
    const struct sb_vec3 to_centre = sb_vec3_sub(vec(light->position), place);
    const double depth = fmax(sb_vec3_dot(to_centre, ray), 0);
    const struct sb_vec3 there = sb_vec3_add(place, sb_vec3_scale(ray, depth));
    if (shape == BOX)
        return nearest(BOX, light, &(struct aim){.from = there});
    return nearest(shape, light, &(struct aim){.from = place, .line = ray});
}

// What every pixel must show: looked for once, and compared in several ways.
static struct wanted {
    double diffuse, highlight;
    bool decided;
} wanted[SIDE][SIDE];
static bool highlights; // are on trial

static struct wanted look_for(const struct setting *setting, struct sb_vec3 place)
{
    const struct sb_light *light = &setting->light[0];
    const struct sb_vec3 near = nearest(shape, light, &(struct aim){.from = place});
    const struct sb_vec3 to_light = sb_vec3_sub(near, place);
    const double d = sb_vec3_length(to_light);
    struct form form = form_begin(setting, place, to_light);
    form.factor = 1 / (light->constant + light->linear * d + light->quadratic * d * d);
    if (!highlights)
        return (struct wanted){form_diffuse(&form), 0, true};
    const struct sb_vec3 ray = reflected_ray(&form);
    const struct sb_vec3 to_centre = sb_vec3_sub(vec(light->position), place);
    const double reach = sb_vec3_length(vec(light->direction)) + light->radius;
    // What is nearest to a line may lie behind the surface, where there is no ray.
    if (sb_vec3_dot(to_centre, ray) <= reach * 1.01)
        return (struct wanted){.decided = false};
    form.highlight =
        sb_vec3_normalise(sb_vec3_sub(highlight_of(light, place, ray), place));
    return (struct wanted){form_diffuse(&form), form_phong(&form), true};
}

static bool by_area(const struct setting *setting, struct sb_vec3 place, double colour[3])
{
    const int x = (int)((place.x + 2) * 8), y = (int)((place.y + 2) * 8);
    (void)setting;
    colour[1] = wanted[y][x].diffuse;
    colour[2] = wanted[y][x].highlight;
    return wanted[y][x].decided;
}

static struct sb_light area_light(double x, double y, double z)
{
    struct sb_light light = light_at(x, y, z);
    light.direction[0] = 0.5f;
    light.direction[1] = 0.375f;
    light.direction[2] = -0.25f;
    light.radius = 0.25f;
    light.extent[0] = 0.5f;
    light.extent[1] = 0.25f;
    light.extent[2] = 0.125f;
    return light;
}

static const char *words_of(enum shape number, const char *more)
{
    static char words[200];
    snprintf(words, sizeof words, "area_shape=%s ambient=none model=%s %s",
             shape_words[number], highlights ? "phong" : "lambert", more);
    return words;
}

static void check_shape(const struct setting *setting, int least)
{
    // Looking takes its time, so of four pixels one is looked for.
    for (int y = 0; y < SIDE; y += 2)
        for (int x = 0; x < SIDE; x += 2)
            wanted[y][x] = look_for(setting, place_of(setting, x, y));
    for (int w = 0; ways[w]; w++) {
        char more[100];
        static const char *const evaluated[] = {"hoist=once", "hoist=per_light",
                                                "f_area=naive"};
        for (int e = 0; e < 3; e++) {
            // Nobody stands in the light, nor looks along it: the textbooks' forms are right too.
            snprintf(more, sizeof more, "%s %s", ways[w], evaluated[e]);
            check_form(setting, words_of(shape, more), by_area, e == 2 ? 2e-5 : 5e-6,
                       least);
        }
    }
}

// The light hangs over the square, so that each of its parts is the nearest one somewhere.
void area_lights_shine_from_their_nearest_point(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    setting_one(&setting, SB_LIGHT_AREA, area_light(-0.25, 0.5, 1));
    highlights = false;
    for (shape = 0; shape < SHAPES; shape++)
        check_shape(&setting, SIDE * SIDE / 4);
}

void highlights_come_from_the_point_nearest_to_the_reflected_ray(void **state)
{
    (void)state;
    struct setting setting;
    setting_init(&setting);
    setting.shininess = 24;
    highlights = true;
    setting_look(&setting, (struct sb_vec3){2, 1.5, 1.5}, (struct sb_vec3){0, 0, 0},
                 (struct sb_vec3){0, 0, 1});
    for (shape = 0; shape < SHAPES; shape++) {
        struct sb_image image;
        struct sb_light point = area_light(-1, -0.75, 1.25);
        setting_one(&setting, SB_LIGHT_AREA, point);
        check_shape(&setting, SIDE * SIDE / 10);
        // There are highlights, brighter than those of the centre alone.
        draw(&setting, words_of(shape, ""), &image);
        double brightest = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            brightest = fmax(brightest, image.data[4 * i + 2]);
        assert_true(brightest > 0.1);
        sb_image_free(&image);
        struct setting centre = setting;
        setting_one(&centre, SB_LIGHT_POINT, point);
        check_other(&setting, words_of(shape, ""), &centre, "ambient=none model=phong",
                    0.05);
    }
}

void area_lights_of_no_size_are_point_lights(void **state)
{
    (void)state;
    struct setting area, point;
    setting_init(&area);
    setting_init(&point);
    struct sb_light light = light_at(0.5, -0.25, 0.75);
    memset(light.direction, 0, sizeof light.direction);
    light.radius = 0;
    setting_one(&area, SB_LIGHT_AREA, light);
    setting_one(&point, SB_LIGHT_POINT, light);
    for (int s = 0; s < SHAPES; s++)
        for (int w = 0; ways[w]; w++)
            for (int m = 0; m < 2; m++) {
                char with[200], without[160];
                snprintf(without, sizeof without, "ambient=per_light model=%s %s",
                         m ? "phong" : "blinn", ways[w]);
                snprintf(with, sizeof with, "area_shape=%s %s", shape_words[s], without);
                check_same(&area, with, &point, without, 1, 1e-6);
            }
}

// The camera is turned, the box is not.
void boxes_stay_along_the_axes_of_the_world_in_view_space(void **state)
{
    (void)state;
    struct setting setting, quarter;
    setting_init(&setting);
    setting_one(&setting, SB_LIGHT_AREA, area_light(-0.25, 0.5, 1));
    quarter = setting;
    // As if the box were turned with it.
    quarter.light[0].extent[0] = setting.light[0].extent[1];
    quarter.light[0].extent[1] = setting.light[0].extent[0];
    static const char *const stages[] = {"stage=fragment", "stage=vertex"};
    for (int s = 0; s < 2; s++) {
        char world[100], view[160];
        snprintf(world, sizeof world, "area_shape=box %s", stages[s]);
        snprintf(view, sizeof view, "%s space=view", world);
        check_same(&setting, world, &setting, view, 1, 2e-6);
        check_other(&setting, world, &quarter, world, 0.01);
        // Whatever way up it is held.
        struct setting turned = setting;
        setting_look(&turned, (struct sb_vec3){1.5, -2, 3},
                     (struct sb_vec3){0.25, 0.5, 0}, (struct sb_vec3){-2, 1, 0.5});
        check_same(&setting, world, &turned, view, 1, 2e-6);
    }
}
