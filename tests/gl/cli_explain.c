// `shadebench explain` on a real context: from the numbers that it prints, and nothing else, an
// evaluation in long double that shares no code with it comes to the same terms and colours.
#include "cli_gl.h"

// --- numbers of the JSON -----------------------------------------------------------------

typedef long double real;
struct v3 {
    real x, y, z;
};

static real scalar(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    if (!json_is_number(value))
        fail_msg("no number %s", name);
    return (real)json_number_value(value);
}

static struct v3 vector(const json_t *object, const char *name)
{
    const json_t *list = json_object_get(object, name);
    if (json_array_size(list) != 3)
        fail_msg("no vector %s", name);
    return (struct v3){(real)json_number_value(json_array_get(list, 0)),
                       (real)json_number_value(json_array_get(list, 1)),
                       (real)json_number_value(json_array_get(list, 2))};
}

static struct v3 add(struct v3 a, struct v3 b)
{
    return (struct v3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static struct v3 times(struct v3 a, real s)
{
    return (struct v3){a.x * s, a.y * s, a.z * s};
}
static struct v3 by(struct v3 a, struct v3 b)
{
    return (struct v3){a.x * b.x, a.y * b.y, a.z * b.z};
}
static struct v3 less(struct v3 a, struct v3 b)
{
    return add(a, times(b, -1));
}
static real dot(struct v3 a, struct v3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static real size_of(struct v3 a)
{
    return sqrtl(dot(a, a));
}
static struct v3 unit(struct v3 a)
{
    return times(a, 1 / size_of(a));
}
static real clamp(real x, real lo, real hi)
{
    return x < lo ? lo : x > hi ? hi : x;
}

// --- the model, as docs/glsl.md has it -----------------------------------------------------

struct variant {
    const char *model, *ambient, *attenuation, *cone, *shape;
    bool both_sides, normalise;
};

struct result {
    real distance, attenuation, cone, n_dot_l, specular;
    struct v3 ambient, diffuse, specular_light;
};

static real attenuation_of(const struct variant *v, const json_t *light, real d)
{
    if (strcmp(v->attenuation, "none") == 0)
        return 1;
    if (strcmp(v->attenuation, "polynomial") == 0)
        return 1 / (scalar(light, "constant") + scalar(light, "linear") * d +
                    scalar(light, "quadratic") * d * d);
    const real q = d / scalar(light, "range");
    if (strcmp(v->attenuation, "radius") == 0)
        return fmaxl(1 - q, 0);
    const real w = 1 - powl(fminl(q, 1), 4);
    return w * w / (d * d + 1);
}

static real cone_of(const struct variant *v, const json_t *light, struct v3 to_light)
{
    const real a = -dot(to_light, vector(light, "direction"));
    if (strcmp(v->cone, "smooth") == 0)
        return clamp(a * scalar(light, "cone_scale") + scalar(light, "cone_offset"), 0,
                     1);
    if (strcmp(v->cone, "linear") == 0)
        return fmaxl(1 - (1 - a) * scalar(light, "inv_one_minus_cos"), 0);
    const bool inside = a >= scalar(light, "cos_cutoff");
    if (strcmp(v->cone, "hard") == 0)
        return inside;
    const real c = a / size_of(vector(light, "direction"));
    return inside ? powl(clamp(c, 1e-4L, 1), scalar(light, "exponent")) : 0;
}

static struct v3 on_segment(struct v3 to_centre, struct v3 axis, real t)
{
    return add(to_centre, times(axis, clamp(t, -1, 1)));
}

static struct v3 on_ball(struct v3 to_centre, real radius)
{
    const real d = size_of(to_centre);
    return d > radius ? times(to_centre, (d - radius) / d) : (struct v3){0, 0, 0};
}

static struct v3 ball_near_ray(struct v3 to_centre, real radius, struct v3 ray)
{
    const struct v3 off = less(times(ray, dot(to_centre, ray)), to_centre);
    const real away = size_of(off);
    return add(to_centre, away > radius ? times(off, radius / away) : off);
}

// Nearest points to the surface and to the reflected ray, as vectors from the surface.
static void area_points(const struct variant *v, const json_t *light, struct v3 to_centre,
                        struct v3 ray, struct v3 *nearest, struct v3 *near_ray)
{
    *nearest = *near_ray = to_centre;
    if (strcmp(v->shape, "box") == 0) {
        const struct v3 h = vector(light, "extent");
        const struct v3 there =
            less(times(ray, fmaxl(dot(to_centre, ray), 0)), to_centre);
        *nearest = add(to_centre, (struct v3){clamp(-to_centre.x, -h.x, h.x),
                                              clamp(-to_centre.y, -h.y, h.y),
                                              clamp(-to_centre.z, -h.z, h.z)});
        *near_ray = add(to_centre,
                        (struct v3){clamp(there.x, -h.x, h.x), clamp(there.y, -h.y, h.y),
                                    clamp(there.z, -h.z, h.z)});
        return;
    }
    if (strcmp(v->shape, "sphere") != 0) {
        const struct v3 axis = vector(light, "direction");
        const struct v3 c = less(to_centre, times(ray, dot(to_centre, ray)));
        const struct v3 a = less(axis, times(ray, dot(axis, ray)));
        *nearest = on_segment(to_centre, axis, -dot(to_centre, axis) / dot(axis, axis));
        *near_ray = on_segment(to_centre, axis, -dot(c, a) / dot(a, a));
    }
    if (strcmp(v->shape, "tube") != 0) {
        const real radius = scalar(light, "radius");
        *nearest = on_ball(*nearest, radius);
        *near_ray = ball_near_ray(*near_ray, radius, ray);
    }
}

static real highlight_of(const struct variant *v, struct v3 n, struct v3 to_light,
                         struct v3 view, real shininess)
{
    real c;
    if (strcmp(v->model, "phong") == 0)
        c = dot(less(times(n, 2 * dot(n, to_light)), to_light), view);
    else
        c = dot(n, unit(add(to_light, view)));
    return powl(clamp(c, 0, 1), shininess);
}

static struct result light_of(const struct variant *v, const json_t *entry,
                              struct v3 position, struct v3 n, struct v3 view,
                              real shininess, real shown)
{
    const char *name = json_string_value(json_object_get(entry, "name"));
    const json_t *light = json_object_get(entry, "as_uploaded");
    struct result r = {.attenuation = 1, .cone = 1};
    struct v3 to_light, to_highlight;
    if (strncmp(name, "directional", 11) == 0) {
        to_light = to_highlight = unit(times(vector(light, "direction"), -1));
    } else {
        struct v3 nearest = less(vector(light, "position"), position), near_ray = nearest;
        const struct v3 ray = less(times(n, 2 * dot(n, view)), view);
        if (strncmp(name, "area", 4) == 0)
            area_points(v, light, nearest, ray, &nearest, &near_ray);
        r.distance = size_of(nearest);
        r.attenuation = attenuation_of(v, light, r.distance);
        to_light = unit(nearest);
        to_highlight = unit(near_ray);
        if (strncmp(name, "spot", 4) == 0)
            r.cone = cone_of(v, light, to_light);
    }
    const real factor = r.attenuation * r.cone;
    r.n_dot_l = dot(n, to_light);
    if (strcmp(v->model, "lambert") != 0 && (v->both_sides || r.n_dot_l > 0))
        r.specular = highlight_of(v, n, to_highlight, view, shininess);
    if (strcmp(v->ambient, "per_light") == 0)
        r.ambient = times(vector(light, "ambient"), factor);
    r.diffuse = times(vector(light, "diffuse"), factor * shown * fmaxl(r.n_dot_l, 0));
    if (r.specular != 0)
        r.specular_light = times(vector(light, "specular"), factor * shown * r.specular);
    return r;
}

// --- held against what was printed -------------------------------------------------------

static void agree(const char *what, real mine, const json_t *printed)
{
    const real theirs = (real)json_number_value(printed);
    const real most = 1e-12L * fmaxl(fabsl(mine), 1e-3L);
    if (!json_is_number(printed) || !(fabsl(mine - theirs) <= most))
        fail_msg("%s: %.20Lg here, %.20Lg there", what, mine, theirs);
}

static void agree3(const char *what, struct v3 mine, const json_t *printed)
{
    agree(what, mine.x, json_array_get(printed, 0));
    agree(what, mine.y, json_array_get(printed, 1));
    agree(what, mine.z, json_array_get(printed, 2));
}

static const json_t *reference(const json_t *terms, const char *name, size_t i)
{
    return json_array_get(json_object_get(json_object_get(terms, name), "reference"), i);
}

static void check_point(const struct variant *v, const json_t *all, const json_t *point,
                        bool maps)
{
    const json_t *inputs = json_object_get(point, "inputs"), *entry;
    const json_t *material = json_object_get(all, "material");
    const struct v3 position = vector(inputs, "position");
    struct v3 n = vector(inputs, "normal");
    const struct v3 view = unit(less(vector(all, "eye"), position));
    struct v3 ambient = {0, 0, 0}, diffuse = {0, 0, 0}, specular = {0, 0, 0};
    size_t i;
    if (v->normalise)
        n = unit(n);
    if (strcmp(v->ambient, "scene") == 0)
        ambient = vector(all, "scene_ambient");
    json_array_foreach(json_object_get(point, "light"), i, entry)
    {
        const json_t *terms = json_object_get(entry, "terms");
        const real shown = (real)json_number_value(reference(terms, "shown", 0));
        const struct result r =
            light_of(v, entry, position, n, view, scalar(material, "shininess"), shown);
        agree("distance", r.distance, reference(terms, "distance", 0));
        agree("attenuation", r.attenuation, reference(terms, "attenuation", 0));
        agree("cone", r.cone, reference(terms, "cone", 0));
        agree("n_dot_l", r.n_dot_l, reference(terms, "n_dot_l", 0));
        agree("specular", r.specular, reference(terms, "specular", 0));
        ambient = add(ambient, r.ambient);
        diffuse = add(diffuse, r.diffuse);
        specular = add(specular, r.specular_light);
    }
    const json_t *leaves = json_object_get(point, "leaves");
    diffuse = add(by(vector(material, "ambient"), ambient),
                  by(vector(material, "diffuse"), diffuse));
    specular = by(vector(material, "specular"), specular);
    agree3("diffuse", diffuse, json_object_get(leaves, "diffuse"));
    agree3("specular", specular, json_object_get(leaves, "specular"));
    if (maps) {
        // A corner has none that a driver sampled.
        const json_t *told = json_object_get(point, "maps");
        const json_t *texels = told ? told : json_object_get(point, "maps_exact");
        diffuse = by(diffuse, vector(texels, "diffuse"));
        specular = by(specular, vector(texels, "specular"));
    }
    agree3("colour", add(diffuse, specular), json_object_get(leaves, "colour"));
}

static void an_outside_evaluation_comes_to_the_same_terms_and_colour(void **state)
{
    static const struct {
        const char *words;
        struct variant v;
    } cases[] = {
        {"dir=2,model=lambert", {"lambert", "scene", "polynomial", "", "", false, true}},
        {"dir=2,point=2,model=phong,shininess=256,specular_side=both",
         {"phong", "scene", "polynomial", "", "", true, true}},
        {"point=2,shininess=256,ambient=per_light",
         {"blinn", "per_light", "polynomial", "", "", false, true}},
        {"point=2,attenuation=none,ambient=none",
         {"blinn", "none", "none", "", "", false, true}},
        {"point=2,attenuation=radius", {"blinn", "scene", "radius", "", "", false, true}},
        {"point=2,attenuation=windowed",
         {"blinn", "scene", "windowed", "", "", false, true}},
        {"spot=3,cone=hard", {"blinn", "scene", "polynomial", "hard", "", false, true}},
        {"spot=3,cone=exponent",
         {"blinn", "scene", "polynomial", "exponent", "", false, true}},
        {"spot=3,cone=linear",
         {"blinn", "scene", "polynomial", "linear", "", false, true}},
        {"spot=3,cone=smooth",
         {"blinn", "scene", "polynomial", "smooth", "", false, true}},
        {"area=3,area_shape=sphere",
         {"blinn", "scene", "polynomial", "", "sphere", false, true}},
        {"area=3,area_shape=tube,model=phong",
         {"phong", "scene", "polynomial", "", "tube", false, true}},
        {"area=3,area_shape=box",
         {"blinn", "scene", "polynomial", "", "box", false, true}},
        {"area=3,area_shape=capsule",
         {"blinn", "scene", "polynomial", "", "capsule", false, true}},
        {"dir=1,point=2,normalise=off",
         {"blinn", "scene", "polynomial", "", "", false, false}},
        {"dir=1,point=2,maps=diffuse+specular",
         {"blinn", "scene", "polynomial", "", "", false, true}},
        {"point=2,shadows=2", {"blinn", "scene", "polynomial", "", "", false, true}},
        {"dir=1,point=2,stage=vertex,maps=diffuse+specular",
         {"blinn", "scene", "polynomial", "", "", false, true}},
    };
    static const char *const scenes[] = {"sphere", "room", "tunnel"};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i += gl_test_gles() ? 4 : 1) {
        char arguments[512];
        const json_t *point;
        size_t p;
        snprintf(arguments, sizeof arguments,
                 "explain %s,width=64,height=64,target=rgba32f --scene %s --pixel %d,%d "
                 "--json -q %s",
                 cases[i].words, scenes[i % 3], 25 + (int)i % 9, 37 - (int)i, platform);
        json_t *json = run_json(arguments, 0);
        const json_t *points = json_object_get(json, "fragment");
        if (!points)
            points = json_object_get(json, "corner");
        if (json_array_size(points) == 0)
            fail_msg("%s: nothing is lit there", arguments);
        json_array_foreach(points, p, point)
            check_point(&cases[i].v, json, point, strstr(cases[i].words, "maps") != NULL);
        json_decref(json);
    }
}

static void text_names_what_it_shows_and_bad_input_what_would_be_valid(void **state)
{
    (void)state;
    char line[256];
    snprintf(line, sizeof line, "explain point=1,width=64,height=64 --pixel 32,32 -q %s",
             platform);
    check_answer(line, 0, "attenuation ");
    check_answer(line, 0, "as_uploaded");
    check_answer(line, 0, "same colour");
    snprintf(line, sizeof line, "explain point=1,width=64,height=64 --pixel 64,0 -q %s",
             platform);
    check_answer(line, 2, "pixel 64,0: the picture has 64 x 64 pixels");
    check_answer("explain point=1", 2, "--pixel X,Y");
    check_answer("explain point=1 --pixel here", 2, "--pixel here: X,Y is wanted");
    check_answer("explain piont=1 --pixel 1,1", 2, "piont");
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_outside_evaluation_comes_to_the_same_terms_and_colour),
        cmocka_unit_test(text_names_what_it_shows_and_bad_input_what_would_be_valid),
    };
    return end_tests(run_tests(tests));
}
