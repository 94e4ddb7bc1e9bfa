#include <string.h>

#include "base/text.h"
#include "context/context.h"
#include "context/versions.h"

// Contexts on a real driver stand before the one that is always software.
const struct sb_context_fns *const sb_contexts[] = {
    &sb_context_egl,
    &sb_context_glfw,
    &sb_context_osmesa,
    NULL,
};

const struct sb_gl_version *sb_gl_versions(bool gles)
{
    static const struct sb_gl_version es[] = {{3, 2}, {3, 1}, {3, 0}, {0, 0}};
    static const struct sb_gl_version core[] = {{4, 6}, {4, 5}, {4, 4}, {4, 3}, {4, 2},
                                                {4, 1}, {4, 0}, {3, 3}, {0, 0}};
    return gles ? es : core;
}

const char *sb_gl_wanted(bool gles)
{
    return gles ? "OpenGL ES 3.0 or newer" : "OpenGL core 3.3 or newer";
}

static void *open_first(const struct sb_context_options *options,
                        const struct sb_context_fns **fns, struct sb_error *err)
{
    struct sb_text reasons = {0};
    for (int i = 0; sb_contexts[i]; i++) {
        struct sb_error why = {0};
        void *self = sb_contexts[i]->open(options, &why);
        if (self) {
            *fns = sb_contexts[i];
            sb_text_free(&reasons);
            return self;
        }
        sb_text_printf(&reasons, "%s%s", i ? "; " : "", why.text);
    }
    sb_fail(err, SB_NO_GL, "no context opens: %s", sb_text_get(&reasons));
    sb_text_free(&reasons);
    return NULL;
}

void *sb_context_open(const char *name, const struct sb_context_options *options,
                      const struct sb_context_fns **fns, struct sb_error *err)
{
    if (strcmp(name, "auto") == 0)
        return open_first(options, fns, err);
    struct sb_text valid = {0};
    for (int i = 0; sb_contexts[i]; i++) {
        if (strcmp(sb_contexts[i]->name, name) == 0) {
            sb_text_free(&valid);
            *fns = sb_contexts[i];
            return sb_contexts[i]->open(options, err);
        }
        sb_text_printf(&valid, ", %s", sb_contexts[i]->name);
    }
    sb_fail(err, SB_USAGE, "context \"%s\" is unknown; valid: auto%s", name,
            sb_text_get(&valid));
    sb_text_free(&valid);
    return NULL;
}
