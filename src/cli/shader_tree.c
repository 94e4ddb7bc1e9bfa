#include "cli/shader_tree.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"

enum { TO_OUTPUT = 1, TO_ERRORS = 2 };

// Runs a program; the first line that it prints to that end goes to *output, cut at its room.
static bool run_to(int end, const char *const *argv, char *output, size_t room)
{
    int ends[2], status = -1;
    size_t length = 0;
    if (pipe(ends) != 0)
        return false;
    const pid_t pid = fork();
    if (pid == 0) {
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(end == TO_OUTPUT ? ends[1] : nothing, 1);
        dup2(end == TO_ERRORS ? ends[1] : nothing, 2);
        close(ends[0]);
        execvp(argv[0], (char *const *)argv);
        _exit(127);
    }
    close(ends[1]);
    for (char chunk[512]; pid > 0;) {
        const ssize_t count = read(ends[0], chunk, sizeof chunk);
        if (count <= 0)
            break;
        for (ssize_t i = 0; i < count && length + 1 < room; i++)
            output[length++] = chunk[i];
    }
    close(ends[0]);
    output[length] = '\0';
    output[strcspn(output, "\n")] = '\0';
    return pid > 0 && waitpid(pid, &status, 0) == pid && status == 0;
}

static bool run(const char *const *argv, char *output, size_t room)
{
    return run_to(TO_OUTPUT, argv, output, room);
}

// Why `of` is in no repository, in git's words: that it belongs to somebody else, as in a container,
// is another thing than that there is none.
static void fail_repository(const char *word, const char *of, struct sb_error *err)
{
    char why[512];
    run_to(TO_ERRORS,
           (const char *const[]){"git", "-C", of, "rev-parse", "--show-prefix", NULL},
           why, sizeof why);
    sb_fail(err, SB_BAD_INPUT,
            "%s: there is no such folder, and %s lies in no git repository of which it "
            "could be a revision%s%s",
            word, of, why[0] ? "; git says: " : "", why);
}

static bool unpack(const char *of, const char *tree, const char *into,
                   struct sb_arena *arena, struct sb_error *err)
{
    char ignored[8];
    const char *tar = sb_arena_printf(arena, "%s.tar", into);
    const char *const output = sb_arena_printf(arena, "--output=%s", tar);
    if (!sb_dir_make(into, err))
        return false;
    // git archive writes where it stands, so the path must be whole.
    char where[4096];
    const char *whole = tar[0] == '/' || !getcwd(where, sizeof where)
                            ? output
                            : sb_arena_printf(arena, "--output=%s/%s", where, tar);
    const bool good = run((const char *const[]){"git", "-C", of, "archive",
                                                "--format=tar", whole, tree, NULL},
                          ignored, sizeof ignored) &&
                      run((const char *const[]){"tar", "-xf", tar, "-C", into, NULL},
                          ignored, sizeof ignored);
    unlink(tar);
    return good ||
           sb_fail(err, SB_BAD_INPUT, "%s: git archive gives no such folder", tree);
}

const char *sb_shader_tree(const char *word, const char *of, const char *dir,
                           const char *name, struct sb_arena *arena, struct sb_error *err)
{
    char prefix[4096], commit[128];
    if (sb_dir_exists(word))
        return word;
    const char *revision = sb_arena_printf(arena, "%s^{commit}", word);
    if (!run((const char *const[]){"git", "-C", of, "rev-parse", "--show-prefix", NULL},
             prefix, sizeof prefix)) {
        fail_repository(word, of, err);
        return NULL;
    }
    if (word[0] == '-' ||
        !run((const char *const[]){"git", "-C", of, "rev-parse", "--verify", "--quiet",
                                   revision, NULL},
             commit, sizeof commit)) {
        sb_fail(
            err, SB_BAD_INPUT,
            "%s: neither a folder nor a git revision of the repository that %s lies in",
            word, of);
        return NULL;
    }
    const char *into = sb_arena_printf(arena, "%s/%s", dir, name);
    // From inside the repository: with a path, `git archive` of a tree takes that from its root.
    const char *tree = sb_arena_printf(arena, "%s:%s", commit, prefix);
    const char *root = of;
    char top[4096];
    if (run((const char *const[]){"git", "-C", of, "rev-parse", "--show-toplevel", NULL},
            top, sizeof top))
        root = top;
    return unpack(root, tree, into, arena, err) ? into : NULL;
}

const char *sb_shader_commit(const char *of, struct sb_arena *arena, struct sb_error *err)
{
    char commit[128], changed[128];
    if (!run(
            (const char *const[]){"git", "-C", of, "rev-parse", "--verify", "HEAD", NULL},
            commit, sizeof commit)) {
        sb_fail(err, SB_USAGE,
                "--commit ID: which commit is measured? %s lies in no git repository",
                of);
        return NULL;
    }
    if (!run((const char *const[]){"git", "-C", of, "status", "--porcelain", ".", NULL},
             changed, sizeof changed) ||
        changed[0]) {
        sb_fail(err, SB_USAGE,
                "--commit ID: what is measured? %s is not what commit %.12s has", of,
                commit);
        return NULL;
    }
    return sb_arena_strdup(arena, commit);
}
