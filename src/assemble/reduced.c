#include "assemble/reduced.h"

#include "emulate/compile.h"
#include "glsl/reduce.h"

static bool reduce(struct sb_glsl_source *source, bool fragment, struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *plain = sb_source_preprocess(source->text, fragment, &arena, err);
    if (plain)
        sb_glsl_reduce(source, plain);
    sb_arena_free(&arena);
    return plain != NULL;
}

bool sb_reduce_sources(struct sb_glsl_source *vertex, struct sb_glsl_source *fragment,
                       struct sb_error *err)
{
    return reduce(vertex, false, err) && reduce(fragment, true, err);
}
