// The textures and framebuffers of shadow maps, and how a program finds them.
#include "render/calls.h"
#include "render/shadow.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"

// --- textures ------------------------------------------------------------------------------

struct format {
    const char *name;
    GLenum internal, format, type;
};

// clang-format off
static const struct format formats[SB_SHADOW_STORE_VALUE_COUNT] = {
    [SB_SHADOW_STORE_R8]    = {"r8",    GL_R8,   GL_RED, GL_UNSIGNED_BYTE},
    [SB_SHADOW_STORE_R16F]  = {"r16f",  GL_R16F, GL_RED, GL_HALF_FLOAT},
    [SB_SHADOW_STORE_R32F]  = {"r32f",  GL_R32F, GL_RED, GL_FLOAT},
    [SB_SHADOW_STORE_DEPTH] = {"depth", GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT},
};

static const struct {
    GLenum target;
    int textures_a_caster; // 0: one for all of them
} kinds[SB_SHADOW_MAP_VALUE_COUNT] = {
    [SB_SHADOW_MAP_SIX2D]      = {GL_TEXTURE_2D, SB_FACES},
    [SB_SHADOW_MAP_ARRAY2D]    = {GL_TEXTURE_2D_ARRAY, 0},
    [SB_SHADOW_MAP_CUBE]       = {GL_TEXTURE_CUBE_MAP, 1},
    [SB_SHADOW_MAP_CUBE_ARRAY] = {GL_TEXTURE_CUBE_MAP_ARRAY, 0},
};
// clang-format on

static void allocate(const struct sb_shadow *shadow, const struct format *format)
{
    const int size = shadow->size;
    const GLint internal = (GLint)format->internal;
    if (shadow->target == GL_TEXTURE_2D)
        glTexImage2D(GL_TEXTURE_2D, 0, internal, size, size, 0, format->format,
                     format->type, NULL);
    else if (shadow->target == GL_TEXTURE_CUBE_MAP)
        for (GLenum face = 0; face < SB_FACES; face++)
            glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, internal, size, size,
                         0, format->format, format->type, NULL);
    else
        glTexImage3D(shadow->target, 0, internal, size, size, SB_FACES * shadow->casters,
                     0, format->format, format->type, NULL);
}

// One texel a direction: no level of detail, and no filter but the shader's own.
static GLuint texture_make(const struct sb_shadow *shadow, int store)
{
    const GLenum target = shadow->target;
    GLuint name;
    glGenTextures(1, &name);
    glActiveTexture(GL_TEXTURE0 + SB_MAP_COUNT);
    glBindTexture(target, name);
    allocate(shadow, &formats[store]);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    if (store == SB_SHADOW_STORE_DEPTH) {
        glTexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(target, GL_TEXTURE_COMPARE_FUNC, GL_LESS);
    }
    return name;
}

// --- framebuffers --------------------------------------------------------------------------

static void attach_map(const struct sb_shadow *shadow, int place)
{
    const GLenum attachment = shadow->store == SB_SHADOW_STORE_DEPTH
                                  ? GL_DEPTH_ATTACHMENT
                                  : GL_COLOR_ATTACHMENT0;
    const int caster = place / SB_FACES, face = place % SB_FACES;
    if (shadow->layered)
        glFramebufferTexture(GL_FRAMEBUFFER, attachment, shadow->texture[place], 0);
    else if (shadow->kind == SB_SHADOW_MAP_SIX2D)
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D,
                               shadow->texture[place], 0);
    else if (shadow->kind == SB_SHADOW_MAP_CUBE)
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment,
                               GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face,
                               shadow->texture[caster], 0);
    else
        glFramebufferTextureLayer(GL_FRAMEBUFFER, attachment, shadow->texture[0], 0,
                                  place);
}

static void attach_depth(const struct sb_shadow *shadow)
{
    static const GLenum none = GL_NONE;
    if (shadow->depth_texture)
        glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, shadow->depth_texture,
                             0);
    else if (shadow->depth_buffer)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                  shadow->depth_buffer);
    else {
        glDrawBuffers(1, &none);
        glReadBuffer(GL_NONE);
    }
}

// Attachments with layers need a depth buffer with as many, and of the same kind of texture
// (OpenGL 4.6 core, 9.4.2 and 9.8); single faces share one.
static void depth_make(struct sb_shadow *shadow)
{
    if (shadow->store == SB_SHADOW_STORE_DEPTH)
        return;
    if (shadow->layered) {
        shadow->depth_texture = texture_make(shadow, SB_SHADOW_STORE_DEPTH);
        return;
    }
    glGenRenderbuffers(1, &shadow->depth_buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, shadow->depth_buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, shadow->size,
                          shadow->size);
}

static bool make_objects(struct sb_shadow *shadow, struct sb_error *err)
{
    GLenum status = GL_FRAMEBUFFER_COMPLETE;
    shadow->texture = sb_alloc((size_t)shadow->texture_count * sizeof *shadow->texture);
    for (int i = 0; i < shadow->texture_count; i++)
        shadow->texture[i] = texture_make(shadow, shadow->store);
    depth_make(shadow);
    shadow->framebuffer =
        sb_alloc((size_t)shadow->framebuffer_count * sizeof *shadow->framebuffer);
    glGenFramebuffers(shadow->framebuffer_count, shadow->framebuffer);
    for (int i = 0; i < shadow->framebuffer_count; i++) {
        glBindFramebuffer(GL_FRAMEBUFFER, shadow->framebuffer[i]);
        attach_map(shadow, i);
        attach_depth(shadow);
        if (status == GL_FRAMEBUFFER_COMPLETE)
            status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    }
    const char *error = sb_gl_error();
    if (!error && status == GL_FRAMEBUFFER_COMPLETE)
        return true;
    return sb_fail(
        err, SB_OVER_LIMIT,
        "shadow maps of %d caster%s, %d texels a side, shadow_store=%s: the driver "
        "refused them (%s, framebuffer status 0x%04x)",
        shadow->casters, shadow->casters == 1 ? "" : "s", shadow->size,
        formats[shadow->store].name, error ? error : "no error", (unsigned)status);
}

// --- lights --------------------------------------------------------------------------------

static bool check_ranges(const struct sb_shadow *shadow, struct sb_error *err)
{
    int count;
    const struct sb_light *point =
        sb_lights_of(&shadow->upload->scene->lights, SB_LIGHT_POINT, &count);
    if (shadow->casters > count)
        return sb_fail(err, SB_BAD_INPUT,
                       "shadows=%d: the scene has %d point lights; valid: 0 to %d",
                       shadow->casters, count, count);
    for (int i = 0; i < shadow->casters; i++)
        if (!(point[i].range > 0))
            return sb_fail(
                err, SB_BAD_INPUT,
                "point light %d casts shadows: range %g; valid: greater than 0", i,
                (double)point[i].range);
    return true;
}

static void make_phases(struct sb_shadow *shadow, const struct sb_variant *variant)
{
    const struct sb_lights *lights = &shadow->upload->scene->lights;
    const size_t total = (size_t)sb_lights_total(lights);
    const bool moves = variant->value[SB_AXIS_UPDATE] == SB_UPDATE_SHADOWS;
    shadow->phase_count = moves ? SB_PHASES : 1;
    shadow->light = sb_alloc((size_t)shadow->phase_count * total * sizeof *shadow->light);
    for (int i = 0; i < shadow->phase_count; i++) {
        const struct sb_phase phase = sb_phase_of(variant, i);
        struct sb_light *light = shadow->light + (size_t)i * total;
        sb_lights_phase(lights, &phase, light);
        shadow->phase[i] = *lights;
        shadow->phase[i].light = light;
    }
}

// --- all of it -----------------------------------------------------------------------------

int sb_shadow_casters(const struct sb_variant *variant)
{
    return (int)variant->value[SB_AXIS_SHADOWS];
}

bool sb_shadow_make(struct sb_shadow *shadow, const struct sb_shadow_params *params,
                    struct sb_error *err)
{
    const double *value = params->variant->value;
    const GLuint program = params->program;
    const int kind = (int)value[SB_AXIS_SHADOW_MAP];
    const int casters = sb_shadow_casters(params->variant);
    const int textures =
        kinds[kind].textures_a_caster ? kinds[kind].textures_a_caster * casters : 1;
    const bool layered = value[SB_AXIS_SHADOW_PASS] == SB_SHADOW_PASS_LAYERED;
    *shadow = (struct sb_shadow){
        .upload = params->upload,
        .kind = kind,
        .store = (int)value[SB_AXIS_SHADOW_STORE],
        .layered = layered,
        .gles = params->caps->gles,
        .casters = casters,
        .size = (int)value[SB_AXIS_SHADOW_SIZE],
        .target = kinds[kind].target,
        .texture_count = textures,
        .framebuffer_count = layered ? textures : SB_FACES * casters,
        .program = program,
        .model = glGetUniformLocation(program, "u_model"),
        .face = glGetUniformLocation(program, "u_face"),
        .light_position = glGetUniformLocation(program, "u_light_position"),
        .light_range = glGetUniformLocation(program, "u_light_range"),
        .first_layer = glGetUniformLocation(program, "u_first_layer"),
    };
    if (!check_ranges(shadow, err) || !make_objects(shadow, err))
        return false;
    make_phases(shadow, params->variant);
    return true;
}

void sb_shadow_make_unused(struct sb_shadow *shadow, const struct sb_variant *variant)
{
    const int kind = (int)variant->value[SB_AXIS_SHADOW_MAP];
    const int casters = sb_shadow_casters(variant);
    *shadow = (struct sb_shadow){
        .kind = kind,
        .store = (int)variant->value[SB_AXIS_SHADOW_STORE],
        .casters = casters,
        .size = 1,
        .target = kinds[kind].target,
        .texture_count =
            kinds[kind].textures_a_caster ? kinds[kind].textures_a_caster * casters : 1,
    };
    shadow->texture = sb_alloc((size_t)shadow->texture_count * sizeof *shadow->texture);
    for (int i = 0; i < shadow->texture_count; i++)
        shadow->texture[i] = texture_make(shadow, shadow->store);
}

void sb_shadow_free(struct sb_shadow *shadow)
{
    if (shadow->framebuffer)
        glDeleteFramebuffers(shadow->framebuffer_count, shadow->framebuffer);
    if (shadow->texture)
        glDeleteTextures(shadow->texture_count, shadow->texture);
    glDeleteTextures(1, &shadow->depth_texture); // 0 is ignored
    glDeleteRenderbuffers(1, &shadow->depth_buffer);
    free(shadow->framebuffer);
    free(shadow->texture);
    free(shadow->light);
    *shadow = (struct sb_shadow){0};
}

void sb_shadow_set_units(GLuint program)
{
    glUseProgram(program);
    const GLint one =
        glGetUniformLocation(program, "u_shadow_map"); // or the first of several
    GLint location = one;
    for (int i = 0; location >= 0; i++) {
        char name[32];
        glUniform1i(location, SB_MAP_COUNT + i);
        snprintf(name, sizeof name, "u_shadow_map[%d]", i + 1);
        location = glGetUniformLocation(program, name);
    }
}

int64_t sb_shadow_bind(const struct sb_shadow *shadow)
{
    int64_t count = 0, *const calls = &count;
    for (int i = 0; i < shadow->texture_count; i++) {
        GL(glActiveTexture(GL_TEXTURE0 + (GLenum)(SB_MAP_COUNT + i)));
        GL(glBindTexture(shadow->target, shadow->texture[i]));
    }
    return count;
}
