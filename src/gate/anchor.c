#include "gate/anchor.h"

#include <string.h>

#include "base/file.h"
#include "base/hash.h"

// One of the anchor's files; its name and bytes go into the hash.
static const char *read_file(struct sb_anchor *anchor, const char *folder,
                             const char *name, struct sb_error *err)
{
    size_t size;
    const char *text =
        sb_file_read(&anchor->arena, sb_path_join(&anchor->arena, folder, name),
                     (size_t)1 << 20, &size, err);
    if (text)
        anchor->hash = sb_hash(anchor->hash, text, size + 1); // with its NUL
    return text;
}

// The same context and driver; what the texts are of stays.
static void take_platform(const struct sb_suite *like, struct sb_suite *suite)
{
    for (int a = 0; a < suite->axes.count; a++)
        if (suite->axes.row[a].kind == SB_PLATFORM)
            suite->entry[0].variant.value[a] = like->entry[0].variant.value[a];
}

bool sb_anchor_load(const char *data_dir, const struct sb_suite *like, bool gles,
                    struct sb_anchor *anchor, struct sb_error *err)
{
    struct sb_arena *arena = &anchor->arena;
    const char *folder = sb_path_join(arena, data_dir, "bench/anchor");
    const char *texts = sb_path_join(arena, folder, gles ? "gles" : "gl");
    const struct sb_suite_params params = {
        .path = sb_path_join(arena, folder, "anchor.yaml"), .data_dir = data_dir};
    anchor->hash = SB_HASH_START;
    if (!read_file(anchor, folder, "anchor.yaml", err) ||
        !(anchor->text.vertex = read_file(anchor, texts, "shade.vert", err)) ||
        !(anchor->text.fragment = read_file(anchor, texts, "shade.frag", err)) ||
        !sb_suite_load(&params, &anchor->suite, err))
        return false;
    if (anchor->suite.entry_count != 1)
        return sb_fail(err, SB_BAD_INPUT, "%s: %d variants; an anchor is one",
                       params.path, anchor->suite.entry_count);
    take_platform(like, &anchor->suite);
    return true;
}

void sb_anchor_free(struct sb_anchor *anchor)
{
    sb_suite_free(&anchor->suite);
    sb_arena_free(&anchor->arena);
    *anchor = (struct sb_anchor){0};
}

uint64_t sb_anchor_mark(const struct sb_anchor *anchor, uint64_t input_hash)
{
    return sb_hash(anchor->hash, &input_hash, sizeof input_hash);
}
