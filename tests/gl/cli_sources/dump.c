// Reads what `run --dump` wrote into plain structs, triangles already in world space.
#include "test.h"

#include <jansson.h>

#include "sources.h"

static const json_t *member(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    if (!value)
        fail_msg("scene.json: no \"%s\"", name);
    return value;
}

// Numbers are floats: nine digits, rounded.
static double number(const json_t *value)
{
    if (!json_is_number(value))
        fail_msg("scene.json: not a number");
    return (float)json_number_value(value);
}

static double number_or_0(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    return value ? number(value) : 0;
}

static struct vec vec_at(const json_t *list, int place)
{
    const size_t first = 3 * (size_t)place;
    return (struct vec){number(json_array_get(list, first)),
                        number(json_array_get(list, first + 1)),
                        number(json_array_get(list, first + 2))};
}

static struct vec vec_or_0(const json_t *object, const char *name)
{
    const json_t *list = json_object_get(object, name);
    return list ? vec_at(list, 0) : (struct vec){0, 0, 0};
}

static void numbers(const json_t *list, double *out, int count)
{
    assert_int_equal(json_array_size(list), count);
    for (int i = 0; i < count; i++)
        out[i] = number(json_array_get(list, (size_t)i));
}

static void read_lights(const json_t *scene, const char *type, struct dump_lights *lights)
{
    size_t i;
    const json_t *it;
    const json_t *list = member(member(scene, "lights"), type);
    assert_true(json_array_size(list) <= LIGHTS_MAX);
    json_array_foreach(list, i, it)
    {
        lights->light[i] = (struct dump_light){
            .position = vec_or_0(it, "position"),
            .direction = vec_or_0(it, "direction"),
            .ambient = vec_or_0(it, "ambient"),
            .diffuse = vec_or_0(it, "diffuse"),
            .specular = vec_or_0(it, "specular"),
            .range = number_or_0(it, "range"),
            .intensity = number(member(it, "intensity")),
            .constant = number_or_0(it, "constant"),
            .linear = number_or_0(it, "linear"),
            .quadratic = number_or_0(it, "quadratic"),
            .cutoff = number_or_0(it, "cutoff"),
            .inner = number_or_0(it, "inner"),
            .exponent = number_or_0(it, "exponent"),
        };
        lights->count++;
    }
}

static struct dump_corner corner(const json_t *mesh, int vertex, const double model[16],
                                 const double normal_matrix[9])
{
    const struct vec n = vec_at(member(mesh, "normal"), vertex);
    const json_t *uv = member(mesh, "uv"), *tangent = member(mesh, "tangent");
    const double *m = normal_matrix;
    double t[4];
    for (int i = 0; i < 4; i++)
        t[i] = number(json_array_get(tangent, 4 * (size_t)vertex + (size_t)i));
    struct dump_corner c = {
        .position = transform(model, vec_at(member(mesh, "position"), vertex), 1),
        .normal = {m[0] * n.x + m[3] * n.y + m[6] * n.z,
                   m[1] * n.x + m[4] * n.y + m[7] * n.z,
                   m[2] * n.x + m[5] * n.y + m[8] * n.z},
        .tangent = transform(model, (struct vec){t[0], t[1], t[2]}, 0),
        .u = number(json_array_get(uv, 2 * (size_t)vertex)),
        .v = number(json_array_get(uv, 2 * (size_t)vertex + 1)),
    };
    c.normal = normalize(c.normal);
    c.bitangent = scaled(cross(c.normal, c.tangent), t[3]);
    return c;
}

static void read_draw(const json_t *scene, const json_t *json, struct dump_draw *draw)
{
    double model[16], normal_matrix[9];
    const size_t mesh_number = (size_t)json_integer_value(member(json, "mesh"));
    const json_t *mesh = json_array_get(member(scene, "meshes"), mesh_number);
    const json_t *index = member(mesh, "index");
    const int corners = (int)json_array_size(index);
    numbers(member(json, "model"), model, 16);
    numbers(member(json, "normal_matrix"), normal_matrix, 9);
    draw->material = (int)json_integer_value(member(json, "material"));
    draw->lamp = (int)json_integer_value(member(json, "lamp"));
    draw->triangle_count = corners / 3;
    draw->corner = calloc((size_t)corners, sizeof *draw->corner);
    assert_non_null(draw->corner);
    for (int i = 0; i < corners; i++) {
        const int vertex = (int)json_integer_value(json_array_get(index, (size_t)i));
        draw->corner[i] = corner(mesh, vertex, model, normal_matrix);
        draw->centre = add(draw->centre, scaled(draw->corner[i].position, 1.0 / corners));
    }
    for (int i = 0; i < corners; i++)
        draw->radius =
            fmax(draw->radius, length(minus(draw->corner[i].position, draw->centre)));
}

// Gauss and Jordan, with the largest pivot of each column.
static void invert(const double m[16], double out[16])
{
    double a[4][8] = {{0}};
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            a[row][column] = m[4 * column + row];
            a[row][4 + column] = row == column;
        }
    for (int c = 0; c < 4; c++) {
        int best = c;
        for (int row = c + 1; row < 4; row++)
            best = fabs(a[row][c]) > fabs(a[best][c]) ? row : best;
        for (int k = 0; k < 8; k++) {
            const double kept = a[c][k];
            a[c][k] = a[best][k];
            a[best][k] = kept;
        }
        const double pivot = a[c][c];
        for (int k = 0; k < 8; k++)
            a[c][k] /= pivot;
        for (int row = 0; row < 4; row++) {
            const double factor = row == c ? 0 : a[row][c];
            for (int k = 0; k < 8; k++)
                a[row][k] -= factor * a[c][k];
        }
    }
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            out[4 * column + row] = a[row][4 + column];
}

static void read_scene(struct dump *dump, const json_t *scene)
{
    const json_t *camera = member(scene, "camera"), *values = member(scene, "values");
    const json_t *materials = member(scene, "materials"), *draws = member(scene, "draws");
    const char *maps = json_string_value(member(values, "maps"));
    dump->has_diffuse_map = strstr(maps, "diffuse") != NULL;
    dump->has_specular_map = strstr(maps, "specular") != NULL;
    dump->has_normal_map = strstr(maps, "normal") != NULL;
    dump->as_written =
        strcmp(json_string_value(member(values, "text")), "as_written") == 0;
    // "" where nothing casts a shadow
    dump->shadow_size = atof(json_string_value(member(values, "shadow_size")));
    dump->shadow_bias = atof(json_string_value(member(values, "shadow_bias")));
    dump->eye = vec_at(member(camera, "eye"), 0);
    dump->ambient = vec_at(member(scene, "ambient"), 0);
    numbers(member(camera, "view"), dump->view, 16);
    numbers(member(camera, "view_projection"), dump->view_projection, 16);
    invert(dump->view_projection, dump->inverse);
    read_lights(scene, "dir", &dump->dir);
    read_lights(scene, "point", &dump->point);
    read_lights(scene, "spot", &dump->spot);
    dump->material_count = (int)json_array_size(materials);
    dump->material = calloc((size_t)dump->material_count, sizeof *dump->material);
    for (int i = 0; i < dump->material_count; i++) {
        const json_t *it = json_array_get(materials, (size_t)i);
        dump->material[i] = (struct dump_material){
            vec_or_0(it, "ambient"), vec_or_0(it, "diffuse"), vec_or_0(it, "specular"),
            number(member(it, "shininess"))};
    }
    dump->draw_count = (int)json_array_size(draws);
    dump->draw = calloc((size_t)dump->draw_count, sizeof *dump->draw);
    for (int i = 0; i < dump->draw_count; i++)
        read_draw(scene, json_array_get(draws, (size_t)i), &dump->draw[i]);
}

static void read_pfm(struct sb_image *image, const char *folder, const char *name)
{
    char path[512];
    struct sb_error err = {0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!sb_image_read_pfm(image, path, &err))
        fail_msg("%s", err.text);
}

void dump_read(struct dump *dump, const char *folder)
{
    char path[512];
    json_error_t cause;
    *dump = (struct dump){0};
    snprintf(path, sizeof path, "%s/scene.json", folder);
    json_t *scene = json_load_file(path, 0, &cause);
    if (!scene)
        fail_msg("%s:%d: %s", path, cause.line, cause.text);
    read_scene(dump, scene);
    json_decref(scene);
    read_pfm(&dump->colour, folder, "colour.pfm");
    read_pfm(&dump->id, folder, "id.pfm");
    if (dump->has_diffuse_map)
        read_pfm(&dump->diffuse_map, folder, "map-diffuse.pfm");
    if (dump->has_specular_map)
        read_pfm(&dump->specular_map, folder, "map-specular.pfm");
    if (dump->has_normal_map)
        read_pfm(&dump->normal_map, folder, "map-normal.pfm");
}

void dump_free(struct dump *dump)
{
    for (int i = 0; i < dump->draw_count; i++)
        free(dump->draw[i].corner);
    free(dump->draw);
    free(dump->material);
    sb_image_free(&dump->colour);
    sb_image_free(&dump->id);
    sb_image_free(&dump->diffuse_map);
    sb_image_free(&dump->specular_map);
    sb_image_free(&dump->normal_map);
}
