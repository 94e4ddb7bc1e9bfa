#include "assemble/decide.h"

#include <inttypes.h>

#include "scene/lights.h"

static const struct sb_glsl_version versions[] = {
    {SB_GLSL_100, "100", 100, true, "es100"},
    {SB_GLSL_300ES, "300 es", 300, true, "es300"},
    {SB_GLSL_310ES, "310 es", 310, true, "es300"},
    {SB_GLSL_330, "330 core", 330, false, "gl"},
    {SB_GLSL_450, "450 core", 450, false, "gl"},
};
enum { VERSION_COUNT = sizeof versions / sizeof *versions };

const struct sb_glsl_version *sb_glsl_version_of(int value)
{
    for (int i = 0; i < VERSION_COUNT; i++)
        if (versions[i].value == value)
            return &versions[i];
    return NULL;
}

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
    const bool es310 = caps->glsl >= 310 && sb_shadows_want_es310(variant);
    if (wanted == SB_GLSL_AUTO)
        wanted = !caps->gles ? SB_GLSL_330 : es310 ? SB_GLSL_310ES : SB_GLSL_300ES;
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
// of the material and its shininess. In vec4: 4 + 4 + 3 + 1 + 1 + 3 + 1. With space=view a mat4
// and a mat3 more, with hoist=per_light a mat4, with loop=dynamic a number for each array.
enum { OTHER_FLOATS = 16 + 16 + 9 + 3 + 3 + 9 + 1, OTHER_VEC4 = 17 };

static void count_others(const struct sb_variant *variant, struct need *need)
{
    *need = (struct need){.least = OTHER_FLOATS, .most = 4 * OTHER_VEC4};
    if (variant->value[SB_AXIS_SPACE] == SB_SPACE_VIEW) {
        need->least += 16 + 9;
        need->most += 4 * (4 + 3);
    }
    if (variant->value[SB_AXIS_HOIST] == SB_HOIST_PER_LIGHT) {
        need->least += 16;
        need->most += 4 * 4;
    }
    if (variant->value[SB_AXIS_LOOP] == SB_LOOP_DYNAMIC) {
        need->least += SB_LIGHT_STRUCT_COUNT;
        need->most += 4 * SB_LIGHT_STRUCT_COUNT;
    }
}

// A member of an array of structs and an array for that member are packed alike.
static void count_array(const struct sb_variant *variant, int row, int64_t slots,
                        struct need *need)
{
    struct sb_light_members members;
    sb_light_members_of(&sb_light_structs[row], variant, &members);
    for (int i = 0; i < members.count; i++) {
        need->least += slots * members.field[i]->components;
        need->most += slots * 4;
    }
    need->block += slots * (int64_t)sb_light_std140_size(&members);
}

static void count(const struct sb_variant *variant, struct need *need)
{
    count_others(variant, need);
    if (variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED) {
        count_array(variant, SB_LIGHT_UNIFIED, sb_lights_unified_slots(variant), need);
        return;
    }
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        count_array(variant, t, sb_lights_slots(variant, (enum sb_light_type)t), need);
}

struct room { // where the lights may go, and what there is for them
    struct need need;
    int64_t limit; // floats of the stage that lights
    int64_t block_limit;
    bool vertex, block_fits, es100;
};

static void look(const struct sb_caps *caps, const struct sb_variant *variant,
                 struct room *room)
{
    count(variant, &room->need);
    room->vertex = variant->value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    room->es100 = variant->value[SB_AXIS_GLSL] == SB_GLSL_100;
    room->limit = room->vertex ? caps->vertex_uniform_components
                               : caps->fragment_uniform_components;
    room->block_limit = caps->uniform_block_size;
    room->block_fits = !room->es100 && room->need.block <= room->block_limit;
}

static bool fail_uniform(const struct room *room, const char *word, struct sb_error *err)
{
    return sb_fail(err, SB_OVER_LIMIT,
                   "storage=%s: the %s shader wants %" PRId64 " uniform components, "
                   "this driver has %" PRId64 " (GL_MAX_%s_UNIFORM_COMPONENTS); fewer "
                   "lights fit%s",
                   word, room->vertex ? "vertex" : "fragment", room->need.least,
                   room->limit, room->vertex ? "VERTEX" : "FRAGMENT",
                   room->block_fits ? ", or storage=ubo_std140" : "");
}

static bool fail_block(const struct room *room, const char *word, struct sb_error *err)
{
    return sb_fail(err, SB_OVER_LIMIT,
                   "storage=%s: the lights want a uniform block of %" PRId64
                   " bytes, this driver has %" PRId64
                   " (GL_MAX_UNIFORM_BLOCK_SIZE); fewer "
                   "lights fit",
                   word, room->need.block, room->block_limit);
}

static bool fail_es100(const char *word, const char *lacks, struct sb_error *err)
{
    return sb_fail(err, SB_BAD_INPUT,
                   "storage=%s: GLSL ES 1.00 has no %s; valid with glsl=100: auto global "
                   "uniform arrays",
                   word, lacks);
}

// The text asks for the offsets of two lights and takes the rest of the block to follow them.
static bool check_slip(const struct sb_variant *variant, struct sb_error *err)
{
    int lights = 0;
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        lights += sb_lights_shining(variant, (enum sb_light_type)t);
    if (variant->value[SB_AXIS_TEXT] != SB_TEXT_AS_WRITTEN ||
        variant->value[SB_AXIS_SOURCE] != SB_SOURCE_UBO || lights <= 2)
        return true;
    return sb_fail(
        err, SB_BAD_INPUT,
        "storage=ubo_shared with text=as_written: the text asks for the offsets "
        "of two lights only, so where the third of %d goes is not known; valid: "
        "at most 2 lights, text=corrected, or another storage",
        lights);
}

static bool check_fixed(const struct room *room, const struct sb_axes *axes,
                        const struct sb_variant *variant, struct sb_error *err)
{
    const int storage = (int)variant->value[SB_AXIS_STORAGE];
    const int update = (int)variant->value[SB_AXIS_UPDATE];
    const char *word = axes->row[SB_AXIS_STORAGE].values[storage].name;
    if (storage == SB_STORAGE_CONSTANT && room->es100)
        return fail_es100(word, "constant arrays", err);
    if (update == SB_UPDATE_STATIC)
        return true;
    return sb_fail(err, SB_BAD_INPUT,
                   "storage=%s: the lights are part of the shader, so update=%s has "
                   "nothing to upload; valid: update=static, or another storage",
                   word, axes->row[SB_AXIS_UPDATE].values[update].name);
}

static bool check_storage(const struct room *room, const struct sb_axes *axes,
                          const struct sb_variant *variant, struct sb_error *err)
{
    const int storage = (int)variant->value[SB_AXIS_STORAGE];
    const char *word = axes->row[SB_AXIS_STORAGE].values[storage].name;
    switch (storage) {
    case SB_STORAGE_UNIFORM:
    case SB_STORAGE_ARRAYS:
        return room->need.least <= room->limit || fail_uniform(room, word, err);
    case SB_STORAGE_UBO_STD140:
    case SB_STORAGE_UBO_SHARED: // its size is the driver's affair; taken to be that of std140
        if (room->es100)
            return fail_es100(word, "uniform blocks", err);
        return (room->block_fits || fail_block(room, word, err)) &&
               (storage != SB_STORAGE_UBO_SHARED || check_slip(variant, err));
    default:
        return check_fixed(room, axes, variant, err);
    }
}

bool sb_decide_storage(const struct sb_axes *axes, const struct sb_caps *caps,
                       struct sb_variant *variant, struct sb_error *err)
{
    struct room room = {0};
    look(caps, variant, &room);

    // How tightly uniforms are packed is the driver's affair. `auto` takes them where the
    // loosest packing fits; who asks for them by name is refused only where none does.
    if (variant->value[SB_AXIS_STORAGE] == SB_STORAGE_AUTO)
        variant->value[SB_AXIS_STORAGE] = room.block_fits && room.need.most > room.limit
                                              ? SB_STORAGE_UBO_STD140
                                              : SB_STORAGE_UNIFORM;
    return check_storage(&room, axes, variant, err);
}

bool sb_decide_slips(const struct sb_axes *axes, const struct sb_variant *variant,
                     struct sb_error *err)
{
    static const struct {
        int source, axis, value;
        const char *why;
    } rules[] = {
        {SB_SOURCE_LWJGL, SB_AXIS_SPACE, SB_SPACE_VIEW,
         "its slips are those of view space"},
        {SB_SOURCE_UBO, SB_AXIS_MODEL, SB_MODEL_PHONG,
         "its highlights are of its own kind"},
        {SB_SOURCE_SHADOWS, SB_AXIS_MODEL, SB_MODEL_PHONG,
         "its highlights are of its own kind"},
    };
    const double *value = variant->value;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const struct sb_axis *axis = &axes->row[rules[i].axis];
        if (value[SB_AXIS_TEXT] != SB_TEXT_AS_WRITTEN ||
            value[SB_AXIS_SOURCE] != rules[i].source ||
            value[rules[i].axis] == rules[i].value)
            continue;
        return sb_fail(err, SB_BAD_INPUT,
                       "%s=%s with text=as_written of %s: %s; valid: %s=%s, or "
                       "text=corrected",
                       axis->name, axis->values[(int)value[rules[i].axis]].name,
                       axes->row[SB_AXIS_SOURCE].values[rules[i].source].name,
                       rules[i].why, axis->name, axis->values[rules[i].value].name);
    }
    return true;
}

bool sb_decide_loop(const struct sb_variant *variant, struct sb_error *err)
{
    if (variant->value[SB_AXIS_LOOP] != SB_LOOP_DYNAMIC ||
        variant->value[SB_AXIS_GLSL] != SB_GLSL_100)
        return true;
    return sb_fail(
        err, SB_BAD_INPUT,
        "loop=dynamic: GLSL ES 1.00 has constant loop bounds only (appendix A.4); "
        "valid with glsl=100: unrolled constant padded");
}
