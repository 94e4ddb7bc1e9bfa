// Assembling from words: assemble("stage=vertex point=2", ...).
#pragma once

#include "test.h"

#include "assemble/assemble.h"

static inline void variant_of_words(const struct sb_axes *axes, const char *words,
                                    struct sb_variant *variant)
{
    struct sb_error err = {0};
    char text[512];
    sb_variant_init(axes, variant);
    snprintf(text, sizeof text, "%s", words);
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

// caps NULL: the ideal driver of the variant's API.
static inline bool assemble_with(const struct sb_axes *axes, const char *words,
                                 const struct sb_caps *caps, struct sb_assembly *assembly,
                                 struct sb_error *err)
{
    struct sb_variant variant;
    variant_of_words(axes, words, &variant);
    struct sb_caps ideal;
    sb_caps_ideal(variant.value[SB_AXIS_API] == SB_API_GLES, &ideal);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = axes,
        .scene = "sphere",
        .variant = &variant,
        .caps = caps ? caps : &ideal,
        .id = 7,
    };
    *assembly = (struct sb_assembly){0};
    return sb_assemble(&params, assembly, err);
}

static inline void assemble(const char *words, struct sb_assembly *assembly)
{
    struct sb_error err = {0};
    if (!assemble_with(sb_axes_builtin(), words, NULL, assembly, &err))
        fail_msg("%s: %s", words, err.text);
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
