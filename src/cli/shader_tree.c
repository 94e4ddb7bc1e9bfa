#include "cli/shader_tree.h"

#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/process.h"

// Runs a program; the first line that it prints there goes to *line, if it is NULL to nowhere.
static bool run_to(enum sb_stream output, enum sb_stream errors, const char *const *words,
                   const char **line, struct sb_arena *arena)
{
    struct sb_text text = {0};
    struct sb_error ignored;
    int exit_code = -1;
    const bool good =
        sb_process_run(&(struct sb_process_params){words, .output = output,
                                                   .errors = errors, .text = &text},
                       &exit_code, &ignored) &&
        exit_code == 0;
    if (line)
        *line = sb_arena_printf(arena, "%.*s", (int)strcspn(sb_text_get(&text), "\n"),
                                sb_text_get(&text));
    sb_text_free(&text);
    return good;
}

static bool run(const char *const *words, const char **line, struct sb_arena *arena)
{
    return run_to(line ? SB_STREAM_TAKEN : SB_STREAM_DROPPED, SB_STREAM_DROPPED, words,
                  line, arena);
}

// Why `of` is in no repository, in git's words: that it belongs to somebody else, as in a container,
// is another thing than that there is none.
static void fail_repository(const char *word, const char *of, struct sb_arena *arena,
                            struct sb_error *err)
{
    const char *why;
    run_to(SB_STREAM_DROPPED, SB_STREAM_TAKEN,
           (const char *const[]){"git", "-C", of, "rev-parse", "--show-prefix", NULL},
           &why, arena);
    sb_fail(err, SB_BAD_INPUT,
            "%s: there is no such folder, and %s lies in no git repository of which it "
            "could be a revision%s%s",
            word, of, why[0] ? "; git says: " : "", why);
}

static bool unpack(const char *of, const char *tree, const char *into,
                   struct sb_arena *arena, struct sb_error *err)
{
    const char *tar = sb_arena_printf(arena, "%s.tar", into);
    const char *const output = sb_arena_printf(arena, "--output=%s", tar);
    if (!sb_dir_make(into, err))
        return false;
    // git archive writes where it stands, so the path must be whole.
    char where[4096];
    const char *whole = tar[0] == '/' || !getcwd(where, sizeof where)
                            ? output
                            : sb_arena_printf(arena, "--output=%s/%s", where, tar);
    const bool good =
        run((const char *const[]){"git", "-C", of, "archive", "--format=tar", whole, tree,
                                  NULL},
            NULL, arena) &&
        run((const char *const[]){"tar", "-xf", tar, "-C", into, NULL}, NULL, arena);
    unlink(tar);
    return good ||
           sb_fail(err, SB_BAD_INPUT, "%s: git archive gives no such folder", tree);
}

const char *sb_shader_tree(const char *word, const char *of, const char *dir,
                           const char *name, struct sb_arena *arena, struct sb_error *err)
{
    const char *prefix, *commit;
    if (sb_dir_exists(word))
        return word;
    const char *revision = sb_arena_printf(arena, "%s^{commit}", word);
    if (!run((const char *const[]){"git", "-C", of, "rev-parse", "--show-prefix", NULL},
             &prefix, arena)) {
        fail_repository(word, of, arena, err);
        return NULL;
    }
    if (word[0] == '-' ||
        !run((const char *const[]){"git", "-C", of, "rev-parse", "--verify", "--quiet",
                                   revision, NULL},
             &commit, arena)) {
        sb_fail(
            err, SB_BAD_INPUT,
            "%s: neither a folder nor a git revision of the repository that %s lies in",
            word, of);
        return NULL;
    }
    const char *into = sb_arena_printf(arena, "%s/%s", dir, name);
    // From inside the repository: with a path, `git archive` of a tree takes that from its root.
    const char *tree = sb_arena_printf(arena, "%s:%s", commit, prefix);
    const char *root;
    if (!run((const char *const[]){"git", "-C", of, "rev-parse", "--show-toplevel", NULL},
             &root, arena))
        root = of;
    return unpack(root, tree, into, arena, err) ? into : NULL;
}

const char *sb_shader_commit(const char *of, struct sb_arena *arena, struct sb_error *err)
{
    const char *commit, *changed;
    if (!run(
            (const char *const[]){"git", "-C", of, "rev-parse", "--verify", "HEAD", NULL},
            &commit, arena)) {
        sb_fail(err, SB_USAGE,
                "--commit ID: which commit is measured? %s lies in no git repository",
                of);
        return NULL;
    }
    if (!run((const char *const[]){"git", "-C", of, "status", "--porcelain", ".", NULL},
             &changed, arena) ||
        changed[0]) {
        sb_fail(err, SB_USAGE,
                "--commit ID: what is measured? %s is not what commit %.12s has", of,
                commit);
        return NULL;
    }
    return commit;
}
