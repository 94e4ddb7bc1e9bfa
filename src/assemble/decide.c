#include "assemble/decide.h"

#include <inttypes.h>
#include <string.h>

#include "scene/lights.h"

static const struct sb_glsl_version versions[] = {
    {SB_GLSL_100, "100", 100, true, "es100"},
    {SB_GLSL_300ES, "300 es", 300, true, "es300"},
    {SB_GLSL_310ES, "310 es", 310, true, "es300"},
    {SB_GLSL_330, "330 core", 330, false, "gl"},
    {SB_GLSL_450, "450 core", 450, false, "gl"},
};
enum { VERSION_COUNT = sizeof versions / sizeof *versions };

// ES versions on desktop GL need ARB_ES3_compatibility, and there their qualifiers are not
// honoured: a second way to the numbers of 330, under a misleading name.
static bool takes(const struct sb_caps *caps, const struct sb_glsl_version *version)
{
    return version->gles == (caps->gles != 0) && version->number <= caps->glsl;
}

const struct sb_glsl_version *sb_decide_version(const struct sb_axes *axes,
                                                const struct sb_caps *caps,
                                                struct sb_variant *variant,
                                                struct sb_error *err)
{
    int wanted = (int)variant->value[SB_AXIS_GLSL];
    if (wanted == SB_GLSL_AUTO)
        wanted = caps->gles ? SB_GLSL_300ES : SB_GLSL_330;
    struct sb_text valid = {0};
    for (int i = 0; i < VERSION_COUNT; i++) {
        const struct sb_glsl_version *version = &versions[i];
        if (!takes(caps, version))
            continue;
        if (version->value == wanted) {
            variant->value[SB_AXIS_GLSL] = wanted;
            sb_text_free(&valid);
            return version;
        }
        sb_text_printf(&valid, " %s",
                       axes->row[SB_AXIS_GLSL].values[version->value].name);
    }
    sb_fail(err, SB_BAD_INPUT,
            "glsl=%s: this %s context takes GLSL up to %" PRId64 "; valid here:%s",
            axes->row[SB_AXIS_GLSL].values[wanted].name,
            caps->gles ? "OpenGL ES" : "desktop OpenGL", caps->glsl,
            valid.length ? sb_text_get(&valid) : " none");
    sb_text_free(&valid);
    return NULL;
}

// --- where the lights are kept -------------------------------------------------------------

struct need {
    int64_t least; // floats of all uniforms, packed without a gap
    int64_t most;  // where each uniform, a single float too, takes a vec4 for itself
    int64_t block; // bytes of the lights in std140
};

// Of the other uniforms: two mat4, a mat3, the camera, the scene's ambient light, three colours
// of the material and its shininess. In vec4: 4 + 4 + 3 + 1 + 1 + 3 + 1.
enum { OTHER_FLOATS = 16 + 16 + 9 + 3 + 3 + 9 + 1, OTHER_VEC4 = 17 };

static void count(const struct sb_variant *variant, struct need *need)
{
    *need = (struct need){.least = OTHER_FLOATS, .most = 4 * OTHER_VEC4};
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const struct sb_light_type_row *type = &sb_light_types[t];
        const int64_t lights = (int64_t)variant->value[type->axis];
        for (int f = 0; f < type->field_count; f++) {
            if (strncmp(type->field[f].name, "pad", 3) == 0)
                continue; // padding is in C only
            need->least += lights * type->field[f].components;
            need->most += lights * 4;
        }
        need->block += lights * (int64_t)type->size;
    }
}

static bool fail_uniform(const struct need *need, bool vertex, int64_t limit,
                         bool block_fits, struct sb_error *err)
{
    return sb_fail(err, SB_OVER_LIMIT,
                   "storage=uniform: the %s shader wants %" PRId64 " uniform components, "
                   "this driver has %" PRId64 " (GL_MAX_%s_UNIFORM_COMPONENTS); fewer "
                   "lights fit%s",
                   vertex ? "vertex" : "fragment", need->least, limit,
                   vertex ? "VERTEX" : "FRAGMENT",
                   block_fits ? ", or storage=ubo_std140" : "");
}

static bool fail_block(const struct need *need, int64_t limit, struct sb_error *err)
{
    return sb_fail(err, SB_OVER_LIMIT,
                   "storage=ubo_std140: the lights want a uniform block of %" PRId64
                   " bytes, this driver has %" PRId64
                   " (GL_MAX_UNIFORM_BLOCK_SIZE); fewer "
                   "lights fit",
                   need->block, limit);
}

bool sb_decide_storage(const struct sb_axes *axes, const struct sb_caps *caps,
                       struct sb_variant *variant, struct sb_error *err)
{
    struct need need;
    count(variant, &need);
    const bool vertex = variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    const bool blocks = variant->value[SB_AXIS_GLSL] != SB_GLSL_100;
    const int64_t limit =
        vertex ? caps->vertex_uniform_components : caps->fragment_uniform_components;

    const bool block_fits = blocks && need.block <= caps->uniform_block_size;

    // How tightly uniforms are packed is the driver's affair. `auto` takes them where the
    // loosest packing fits; who asks for them by name is refused only where none does.
    int storage = (int)variant->value[SB_AXIS_STORAGE];
    if (storage == SB_STORAGE_AUTO)
        storage =
            block_fits && need.most > limit ? SB_STORAGE_UBO_STD140 : SB_STORAGE_UNIFORM;
    variant->value[SB_AXIS_STORAGE] = storage;
    switch (storage) {
    case SB_STORAGE_UNIFORM:
        return need.least <= limit || fail_uniform(&need, vertex, limit, block_fits, err);
    case SB_STORAGE_UBO_STD140:
        if (!blocks)
            return sb_fail(
                err, SB_BAD_INPUT,
                "storage=ubo_std140: GLSL ES 1.00 has no uniform blocks; valid "
                "with glsl=100: auto uniform");
        return block_fits || fail_block(&need, caps->uniform_block_size, err);
    default:
        return sb_fail(err, SB_NOT_IMPLEMENTED, "storage=%s: not implemented yet",
                       axes->row[SB_AXIS_STORAGE].values[storage].name);
    }
}
