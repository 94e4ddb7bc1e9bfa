// Reading a shadow map back. OpenGL ES reads no depth buffers, and no faces of arrays as floats
// without extensions: so a small shader fetches the texels and hands out their bits, which an
// integer target takes everywhere.
#include "render/calls.h"
#include "render/shadow.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/text.h"

// Where a face stands in the cross (columns from the left, rows from the bottom), and its
// picture: what is to the right and what is up there.
struct tile {
    int column, row;
    struct sb_vec3 right, up;
};
// clang-format off
static const struct tile tiles[SB_FACES] = {
    {2, 1, { 0, 0,  1}, {0, 1,  0}}, // XP
    {0, 1, { 0, 0, -1}, {0, 1,  0}}, // XN
    {1, 2, { 1, 0,  0}, {0, 0,  1}}, // YP
    {1, 0, { 1, 0,  0}, {0, 0, -1}}, // YN
    {3, 1, {-1, 0,  0}, {0, 1,  0}}, // ZP
    {1, 1, { 1, 0,  0}, {0, 1,  0}}, // ZN
};

static const struct { const char *sampler, *fetch; } kinds[SB_SHADOW_MAP_VALUE_COUNT] = {
    [SB_SHADOW_MAP_SIX2D]      = {"sampler2D",        "at"},
    [SB_SHADOW_MAP_ARRAY2D]    = {"sampler2DArray",   "vec3(at, u_layer)"},
    [SB_SHADOW_MAP_CUBE]       = {"samplerCube",      "direction"},
    [SB_SHADOW_MAP_CUBE_ARRAY] = {"samplerCubeArray", "vec4(direction, u_layer)"},
};
// clang-format on

static void add_head(struct sb_text *text, const struct sb_shadow *shadow)
{
    const bool cube_array = shadow->kind == SB_SHADOW_MAP_CUBE_ARRAY;
    if (!shadow->gles)
        sb_text_add(text, "#version 330 core\n"
                          "#ifdef GL_ARB_texture_cube_map_array\n"
                          "#extension GL_ARB_texture_cube_map_array : enable\n"
                          "#endif\n");
    else
        sb_text_printf(text,
                       "#version %s es\n"
                       "#ifdef GL_EXT_texture_cube_map_array\n"
                       "#extension GL_EXT_texture_cube_map_array : enable\n"
                       "#endif\n"
                       "#ifdef GL_OES_texture_cube_map_array\n"
                       "#extension GL_OES_texture_cube_map_array : enable\n"
                       "#endif\n"
                       "precision highp float;\n",
                       cube_array ? "310" : "300");
}

static bool program_make(const struct sb_shadow *shadow, struct sb_gl_program *program,
                         struct sb_error *err)
{
    struct sb_text vertex = {0}, fragment = {0};
    add_head(&vertex, shadow);
    sb_text_add(&vertex,
                "void main()\n" // one triangle that covers the target
                "{\n"
                "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
                "                       gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
                "}\n");
    add_head(&fragment, shadow);
    sb_text_printf(
        &fragment,
        "uniform %s%s u_map;\n"
        "uniform vec3 u_forward, u_right, u_up;\n"
        "uniform vec3 u_s, u_t;\n"
        "uniform float u_layer, u_size;\n"
        "out highp uint o_bits;\n"
        "void main()\n"
        "{\n"
        "    vec2 p = 2.0 * gl_FragCoord.xy / u_size - 1.0;\n"
        "    vec3 direction = u_forward + p.x * u_right + p.y * u_up;\n"
        "    vec2 at = vec2(dot(direction, u_s), dot(direction, u_t)) * 0.5 + 0.5;\n"
        "    o_bits = floatBitsToUint(texture(u_map, %s).r);\n"
        "}\n",
        shadow->gles ? "highp " : "", kinds[shadow->kind].sampler,
        kinds[shadow->kind].fetch);
    const struct sb_program source = {.vertex = sb_text_get(&vertex),
                                      .fragment = sb_text_get(&fragment)};
    const bool good = sb_gl_program_make(&source, program);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    return good || sb_fail(err, SB_GL_ERROR,
                           "the program that reads shadow maps does not compile: %s",
                           program->log ? program->log : "the driver gives no log");
}

static void set(GLuint program, const char *name, struct sb_vec3 v)
{
    glUniform3f(glGetUniformLocation(program, name), (float)v.x, (float)v.y, (float)v.z);
}

// Draws one face into the bound target.
static void draw_face(const struct sb_shadow *shadow, GLuint program, int caster,
                      int face)
{
    const struct sb_face *it = &sb_shadow_faces(shadow->kind)[face];
    const bool array = shadow->kind == SB_SHADOW_MAP_ARRAY2D;
    const int place = shadow->texture_count == 1            ? 0
                      : shadow->kind == SB_SHADOW_MAP_SIX2D ? SB_FACES * caster + face
                                                            : caster;
    glBindTexture(shadow->target, shadow->texture[place]);
    set(program, "u_forward", it->forward);
    set(program, "u_right", tiles[face].right);
    set(program, "u_up", tiles[face].up);
    set(program, "u_s", sb_vec3_cross(it->forward, it->up));
    set(program, "u_t", it->up);
    glUniform1f(glGetUniformLocation(program, "u_layer"),
                (float)(array ? SB_FACES * caster + face : caster));
    // Read as it is, not compared.
    if (shadow->store == SB_SHADOW_STORE_DEPTH)
        glTexParameteri(shadow->target, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (shadow->store == SB_SHADOW_STORE_DEPTH)
        glTexParameteri(shadow->target, GL_TEXTURE_COMPARE_MODE,
                        GL_COMPARE_REF_TO_TEXTURE);
}

// Reads the bound target into its place in the cross.
static void copy_face(const struct tile *tile, int size, GLuint *texels,
                      struct sb_image *image)
{
    glReadPixels(0, 0, size, size, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            memcpy(sb_image_at(image, tile->column * size + x, tile->row * size + y),
                   &texels[4 * ((size_t)y * (size_t)size + (size_t)x)], sizeof(float));
}

static void read_faces(const struct sb_shadow *shadow, GLuint program, int caster,
                       struct sb_image *image)
{
    const size_t size = (size_t)shadow->size;
    GLuint *texels = sb_alloc(size * size * 4 * sizeof *texels);
    int64_t calls = 0;
    GLuint vertex_array;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    sb_frame_state(shadow->gles, &calls);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glViewport(0, 0, shadow->size, shadow->size);
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "u_map"), SB_MAP_COUNT);
    glUniform1f(glGetUniformLocation(program, "u_size"), (float)shadow->size);
    glActiveTexture(GL_TEXTURE0 + SB_MAP_COUNT);
    for (int face = 0; face < SB_FACES; face++) {
        draw_face(shadow, program, caster, face);
        copy_face(&tiles[face], shadow->size, texels, image);
    }
    glUseProgram(0);
    glDeleteVertexArrays(1, &vertex_array);
    free(texels);
}

bool sb_shadow_read(const struct sb_shadow *shadow, const struct sb_caps *caps,
                    int caster, struct sb_image *image, struct sb_error *err)
{
    if (caster < 0 || caster >= shadow->casters)
        return sb_fail(err, SB_BAD_INPUT,
                       "no shadow map of point light %d: the first %d point lights cast "
                       "shadows",
                       caster, shadow->casters);
    const struct sb_target_params params = {
        .width = shadow->size,
        .height = shadow->size,
        .samples = 1,
        .format = SB_GL_R32UI,
    };
    struct sb_gl_program program = {0};
    struct sb_target target = {0};
    bool good = program_make(shadow, &program, err) &&
                sb_target_make(&target, caps, &params, err);
    if (good) {
        sb_image_init(image, 4 * shadow->size, 3 * shadow->size, 1);
        read_faces(shadow, program.name, caster, image);
        const char *error = sb_gl_error();
        if (error) {
            sb_image_free(image);
            good = sb_fail(err, SB_GL_ERROR,
                           "%s when reading the shadow map of point light %d", error,
                           caster);
        }
    }
    sb_target_free(&target);
    sb_gl_program_free(&program);
    return good;
}
