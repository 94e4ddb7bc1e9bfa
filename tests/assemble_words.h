// Assembling from words: assemble("stage=vertex point=2", ...).
#pragma once

#include "test.h"

#include "assemble/assemble.h"

static inline void variant_of_words(const struct sb_axes *axes, const char *words,
                                    struct sb_variant *variant)
{
    struct sb_error err = {0};
    char text[1024];
    sb_variant_init(axes, variant);
    assert_true(strlen(words) < sizeof text);
    strcpy(text, words);
    for (char *rest = text, *word; (word = strtok_r(rest, " ", &rest)) != NULL;) {
        char *value = strchr(word, '=');
        assert_non_null(value);
        *value = '\0';
        const int axis = sb_axes_expect(axes, word, &err);
        if (axis < 0 || !sb_variant_set(axes, variant, axis, value + 1, &err))
            fail_msg("%s", err.text);
    }
    if (!sb_variant_resolve(axes, variant, &err))
        fail_msg("%s", err.text);
}

struct assembling { // zero: the default
    const struct sb_axes *axes;
    const char *words, *scene;
    const char *shaders;        // a folder
    const struct sb_caps *caps; // NULL: the ideal driver of the variant's API
    bool movable_lights, probe;
};

static inline bool assemble_from(const struct assembling *from,
                                 struct sb_assembly *assembly, struct sb_error *err)
{
    const struct sb_axes *axes = from->axes ? from->axes : sb_axes_builtin();
    struct sb_variant variant;
    variant_of_words(axes, from->words ? from->words : "", &variant);
    struct sb_caps ideal;
    sb_caps_ideal(variant.value[SB_AXIS_API] == SB_API_GLES, &ideal);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .shaders = from->shaders,
        .axes = axes,
        .scene = from->scene ? from->scene : "sphere",
        .variant = &variant,
        .caps = from->caps ? from->caps : &ideal,
        .id = 7,
        .movable_lights = from->movable_lights,
        .probe = from->probe,
    };
    *assembly = (struct sb_assembly){0};
    return sb_assemble(&params, assembly, err);
}

static inline bool assemble_with(const struct sb_axes *axes, const char *words,
                                 const struct sb_caps *caps, struct sb_assembly *assembly,
                                 struct sb_error *err)
{
    const struct assembling from = {.axes = axes, .words = words, .caps = caps};
    return assemble_from(&from, assembly, err);
}

static inline void assemble(const char *words, struct sb_assembly *assembly)
{
    struct sb_error err = {0};
    if (!assemble_with(sb_axes_builtin(), words, NULL, assembly, &err))
        fail_msg("%s: %s", words, err.text);
}

// The sources of the program that lights.
enum { VERTEX, GEOMETRY, FRAGMENT, STAGES };
static inline const struct sb_glsl_source *shade_of(const struct sb_assembly *assembly,
                                                    int stage)
{
    return &sb_assembly_sources(assembly, SB_ROLE_SHADE)[stage];
}

// For one of many programs. Under the sanitisers, which watch our code, it is only assembled: a
// process of the validator takes longer than all else, and does the same in every build.
static inline bool validate_in_sweep(const struct sb_assembly *assembly,
                                     struct sb_error *err)
{
#ifdef __SANITIZE_ADDRESS__
    (void)assembly;
    (void)err;
    return true;
#else
    return sb_assembly_validate(assembly, err);
#endif
}

// Programs that validate exit with 77 then: skipped.
static inline bool validator_is_missing(void)
{
    struct sb_assembly assembly;
    struct sb_error err = {0};
    if (assemble_with(sb_axes_builtin(), "", NULL, &assembly, &err))
        sb_assembly_validate(&assembly, &err);
    sb_assembly_free(&assembly);
    if (err.status == SB_USAGE)
        print_message("skipped: %s\n", err.text);
    return err.status == SB_USAGE;
}
