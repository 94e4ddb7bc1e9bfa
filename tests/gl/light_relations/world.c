#include "relations.h"

// Vertices stand at the centres of the pixels, and one more around the picture.
enum { ROW = SIDE + 2, VERTICES = ROW * ROW, INDICES = 6 * (ROW - 1) * (ROW - 1) };

const char *const ways[] = {"stage=fragment space=world", "stage=fragment space=view",
                            "stage=vertex space=world", "stage=vertex space=view", NULL};

// --- settings --------------------------------------------------------------------------------

struct sb_light light_at(double x, double y, double z)
{
    struct sb_light light = {
        .position = {(float)x, (float)y, (float)z},
        .w = 1,
        .direction = {0, 0, -1},
        .range = 5,
        .intensity = 1,
        .ambient = {1, 1, 1},
        .diffuse = {1, 1, 1},
        .specular = {1, 1, 1},
        .constant = 1,
        .linear = 0.25f,
        .quadratic = 0.5f,
        .exponent = 3,
    };
    sb_light_set_cone(&light, 25 * SB_PI / 180, 35 * SB_PI / 180);
    return light;
}

void setting_init(struct setting *setting)
{
    *setting = (struct setting){
        .shininess = 6,
        .ambient = {0.25f, 0.25f, 0.25f},
        .size = 1,
        .tangent = {1, 0, 0, 1},
        .normal = {128, 128, 255},
    };
    setting_look(setting, (struct sb_vec3){1.5, -2, 3}, (struct sb_vec3){0.25, 0.5, 0},
                 (struct sb_vec3){1, 2, 0.5});
}

void setting_look(struct setting *setting, struct sb_vec3 eye, struct sb_vec3 target,
                  struct sb_vec3 up)
{
    setting->view = sb_mat4_look_at(eye, target, up);
    setting->eye[0] = eye.x;
    setting->eye[1] = eye.y;
    setting->eye[2] = eye.z;
}

void setting_add(struct setting *setting, enum sb_light_type type, struct sb_light light)
{
    int before = 0, total = 0;
    for (int i = 0; i < SB_LIGHT_TYPE_COUNT; i++) {
        before += i <= (int)type ? setting->count[i] : 0;
        total += setting->count[i];
    }
    assert_true(total < LIGHTS_MAX);
    memmove(&setting->light[before + 1], &setting->light[before],
            (size_t)(total - before) * sizeof light);
    setting->light[before] = light;
    setting->count[type]++;
}

void setting_one(struct setting *setting, enum sb_light_type type, struct sb_light light)
{
    memset(setting->count, 0, sizeof setting->count);
    setting_add(setting, type, light);
}

struct sb_vec3 place_of(const struct setting *setting, int x, int y)
{
    return (struct sb_vec3){((2 * x + 1) / 16.0 - 2) * setting->size,
                            ((2 * y + 1) / 16.0 - 2) * setting->size, 0};
}

// --- the scene -------------------------------------------------------------------------------

struct world {
    struct sb_vertex vertex[VERTICES];
    uint32_t index[INDICES];
    struct sb_mesh mesh;
    struct sb_material material;
    struct sb_draw draw;
    unsigned char texel[4];
    struct sb_scene scene;
};

static void mesh_make(struct world *world, const struct setting *setting)
{
    uint32_t *next = world->index;
    for (int y = 0; y < ROW; y++)
        for (int x = 0; x < ROW; x++) {
            struct sb_vertex *vertex = &world->vertex[y * ROW + x];
            const struct sb_vec3 place = place_of(setting, x - 1, y - 1);
            vertex->position[0] = (float)place.x;
            vertex->position[1] = (float)place.y;
            vertex->normal[2] = 1;
            memcpy(vertex->tangent, setting->tangent, sizeof vertex->tangent);
            if (x == ROW - 1 || y == ROW - 1)
                continue;
            const uint32_t corner = (uint32_t)(y * ROW + x);
            const uint32_t quad[] = {corner, corner + 1,       corner + ROW + 1,
                                     corner, corner + ROW + 1, corner + ROW};
            memcpy(next, quad, sizeof quad);
            next += 6;
        }
    world->mesh = (struct sb_mesh){
        .vertex = world->vertex,
        .index = world->index,
        .vertex_count = VERTICES,
        .index_count = INDICES,
    };
}

static void camera_make(struct sb_camera *camera, const struct setting *setting)
{
    // Whatever the eye sees, the target shows the square.
    *camera = (struct sb_camera){.view_projection = {[0] = (float)(0.5 / setting->size),
                                                     [5] = (float)(0.5 / setting->size),
                                                     [15] = 1}};
    memcpy(camera->projection, camera->view_projection, sizeof camera->projection);
    for (int i = 0; i < 16; i++)
        camera->view[i] = (float)setting->view.m[i];
    for (int i = 0; i < 3; i++)
        camera->eye[i] = (float)setting->eye[i];
}

static void world_make(struct world *world, const struct setting *setting)
{
    *world = (struct world){
        .material = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, setting->shininess},
        .draw = {.lamp = -1,
                 .model = {[0] = 1, [5] = 1, [10] = 1, [15] = 1},
                 .normal_matrix = {[0] = 1, [4] = 1, [8] = 1}},
        .texel = {setting->normal[0], setting->normal[1], setting->normal[2], 255},
    };
    mesh_make(world, setting);
    struct sb_scene *scene = &world->scene;
    scene->name = "square";
    scene->mesh = &world->mesh;
    scene->material = &world->material;
    scene->draw = &world->draw;
    scene->mesh_count = scene->material_count = scene->draw_count = 1;
    scene->map[SB_MAP_NORMAL] = (struct sb_texture){1, 1, world->texel};
    scene->lights.light = setting->light;
    memcpy(scene->lights.count, setting->count, sizeof setting->count);
    memcpy(scene->ambient, setting->ambient, sizeof scene->ambient);
    camera_make(&scene->camera, setting);
}

// --- drawing ---------------------------------------------------------------------------------

static void assemble_here(const struct setting *setting, const char *words,
                          struct sb_assembly *assembly)
{
    char all[400];
    struct sb_error err = {0};
    snprintf(all, sizeof all, "%starget=rgba32f dir=%d point=%d spot=%d area=%d %s",
             relations_caps.gles ? "api=gles " : "", setting->count[SB_LIGHT_DIR],
             setting->count[SB_LIGHT_POINT], setting->count[SB_LIGHT_SPOT],
             setting->count[SB_LIGHT_AREA], words);
    if (!assemble_with(sb_axes_builtin(), all, &relations_caps, assembly, &err))
        fail_msg("%s: %s", all, err.text);
}

struct drawing { // a program bound to the square
    struct world world;
    struct sb_assembly assembly;
    struct sb_upload upload;
    struct sb_gl_program program;
    struct sb_binding binding;
    struct sb_target target;
};

static struct drawing *drawing_make(const struct setting *setting, const char *words)
{
    static struct drawing drawing;
    const struct sb_target_params size = {SIDE, SIDE, 1, SB_GL_RGBA32F};
    struct sb_error err = {0};
    world_make(&drawing.world, setting);
    assemble_here(setting, words, &drawing.assembly);
    sb_upload_make(&drawing.upload, &drawing.world.scene);
    if (!sb_gl_program_make(&drawing.assembly.program[0], &drawing.program))
        fail_msg("%s", drawing.program.log);
    const struct sb_binding_params params = {
        .program = drawing.program.name,
        .upload = &drawing.upload,
        .variant = &drawing.assembly.job.variant,
    };
    if (!sb_binding_make(&drawing.binding, &params, &err) ||
        !sb_target_make(&drawing.target, &relations_caps, &size, &err))
        fail_msg("%s", err.text);
    return &drawing;
}

static void drawing_free(struct drawing *drawing)
{
    assert_null(sb_gl_error());
    sb_target_free(&drawing->target);
    sb_binding_free(&drawing->binding);
    sb_gl_program_free(&drawing->program);
    sb_upload_free(&drawing->upload);
    sb_assembly_free(&drawing->assembly);
}

static void drawing_show(const struct drawing *drawing, int phase, struct sb_image *image)
{
    struct sb_error err = {0};
    sb_frame_draw(&(struct sb_frame_params){
        .binding = &drawing->binding,
        .target = &drawing->target,
        .layers = 1,
        .phase = phase,
        .gles = relations_caps.gles,
    });
    if (!sb_target_read(&drawing->target, image, &err))
        fail_msg("%s", err.text);
}

void draw_phase(const struct setting *setting, const char *words, int phase,
                struct sb_image *image)
{
    struct drawing *drawing = drawing_make(setting, words);
    drawing_show(drawing, phase, image);
    drawing_free(drawing);
}

void draw_shortened(const struct setting *setting, const char *words, int left,
                    struct sb_image *image)
{
    struct drawing *drawing = drawing_make(setting, words);
    struct sb_lights few = drawing->binding.phase[0];
    few.count[SB_LIGHT_POINT] = left;
    sb_light_upload_set(&drawing->binding.lights, &few);
    drawing_show(drawing, -1, image);
    drawing_free(drawing);
}

void reflect_block(const struct setting *setting, const char *words, const char *member,
                   int *size, int *offset)
{
    struct drawing *drawing = drawing_make(setting, words);
    const GLuint program = drawing->program.name;
    const GLuint block = glGetUniformBlockIndex(program, "Lights");
    GLuint index = GL_INVALID_INDEX;
    *offset = -1;
    glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_DATA_SIZE, size);
    glGetUniformIndices(program, 1, &member, &index);
    if (index != GL_INVALID_INDEX)
        glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, offset);
    drawing_free(drawing);
}

void draw(const struct setting *setting, const char *words, struct sb_image *image)
{
    draw_phase(setting, words, -1, image);
}

// --- comparing -------------------------------------------------------------------------------

void check_form(const struct setting *setting, const char *words, closed_form form,
                double tolerance, int least)
{
    struct sb_image image;
    int decided = 0;
    draw(setting, words, &image);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const struct sb_vec3 place = place_of(setting, x, y);
            const float *got = sb_image_at(&image, x, y);
            double want[3] = {0};
            if (!form(setting, place, want))
                continue;
            decided++;
            for (int c = 0; c < 3; c++)
                if (!(fabs(got[c] - want[c]) <= tolerance))
                    fail_msg("%s: at %g, %g channel %d is %.9g, not %.9g", words, place.x,
                             place.y, c, got[c], want[c]);
        }
    sb_image_free(&image);
    if (decided < least)
        fail_msg("%s: only %d pixels are decided", words, decided);
}

// The largest difference, of b's picture times a factor.
static double difference(const struct setting *a, const char *words_a,
                         const struct setting *b, const char *words_b, double factor)
{
    struct sb_image one, other;
    double most = 0;
    draw(a, words_a, &one);
    draw(b, words_b, &other);
    for (int i = 0; i < SIDE * SIDE * 4; i++) {
        if (i % 4 == 3)
            continue; // alpha is 1
        const double d = fabs(one.data[i] - factor * other.data[i]);
        most = d >= 0 ? fmax(most, d) : INFINITY; // NaN too
    }
    sb_image_free(&one);
    sb_image_free(&other);
    return most;
}

void check_same(const struct setting *a, const char *words_a, const struct setting *b,
                const char *words_b, double factor, double tolerance)
{
    const double most = difference(a, words_a, b, words_b, factor);
    if (!(most <= tolerance))
        fail_msg("%s: and %s: differ by %g", words_a, words_b, most);
}

void check_other(const struct setting *a, const char *words_a, const struct setting *b,
                 const char *words_b, double least)
{
    const double most = difference(a, words_a, b, words_b, 1);
    if (!(most >= least))
        fail_msg("%s: and %s: differ by %g only", words_a, words_b, most);
}

// --- closed forms ----------------------------------------------------------------------------

struct form form_begin(const struct setting *setting, struct sb_vec3 place,
                       struct sb_vec3 to_light)
{
    const struct sb_vec3 eye = {setting->eye[0], setting->eye[1], setting->eye[2]};
    const struct sb_vec3 unit = sb_vec3_normalise(to_light);
    return (struct form){
        .to_light = unit,
        .highlight = unit,
        .normal = {0, 0, 1},
        .to_eye = sb_vec3_normalise(sb_vec3_sub(eye, place)),
        .factor = 1,
        .shininess = setting->shininess,
    };
}

double form_diffuse(const struct form *form)
{
    return form->factor * fmax(sb_vec3_dot(form->normal, form->to_light), 0);
}

static double highlight(const struct form *form, double cosine)
{
    const bool seen = form->side == BOTH || sb_vec3_dot(form->normal, form->to_light) > 0;
    return seen ? form->factor * pow(fmax(cosine, 0), form->shininess) : 0;
}

double form_phong(const struct form *form)
{
    const double along = sb_vec3_dot(form->normal, form->highlight);
    const struct sb_vec3 reflected =
        sb_vec3_sub(sb_vec3_scale(form->normal, 2 * along), form->highlight);
    return highlight(form, sb_vec3_dot(reflected, form->to_eye));
}

double form_blinn(const struct form *form)
{
    const struct sb_vec3 half =
        sb_vec3_normalise(sb_vec3_add(form->highlight, form->to_eye));
    return highlight(form, sb_vec3_dot(form->normal, half));
}
