// Every #include of src/ against src/layers.txt, the one list of what may include what.
#include "test.h"

#include <dirent.h>

#include "axis/axis.h"
#include "base/file.h"
#include "base/text.h"

enum { LAYERS = 32 };

static char layer[LAYERS][32], allowed[LAYERS][512];
static int layer_count;

static int find(const char *name)
{
    for (int i = 0; i < layer_count; i++)
        if (strcmp(layer[i], name) == 0)
            return i;
    return -1;
}

static void read_layers(struct sb_arena *arena)
{
    char *text =
        sb_file_read(arena, SB_SOURCE_DIR "/src/layers.txt", 1 << 16, NULL, NULL);
    assert_non_null(text);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        char *colon = strchr(line, ':');
        if (line[0] == '#' || !colon)
            continue;
        sscanf(line, "%31s", layer[layer_count]);
        // Blanks on both sides, so that " math " is found as a word.
        snprintf(allowed[layer_count], sizeof allowed[0], " %s ", colon + 1);
        layer_count++;
    }
}

static bool may_include(const char *from, const char *to)
{
    char word[40];
    snprintf(word, sizeof word, " %.31s ", to);
    const char *list = allowed[find(from)];
    return strcmp(from, to) == 0 || strstr(list, word) || strstr(list, " * ");
}

// All other layers iterate over the table of axes.
static bool may_name_axes(const char *folder)
{
    static const char *const folders[] = {"axis",     "scene",  "effects", "reference",
                                          "assemble", "render", "cases"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        if (strcmp(folder, folders[i]) == 0)
            return true;
    return false;
}

static int axes_named(const char *folder, const char *name, const char *text)
{
    static const char *const axis[] = {
#define VALUE(...)
#define CHOICE(id, ...) "SB_AXIS_" #id,
#define NUMBER(id, ...) "SB_AXIS_" #id,
#include "axis/axes.def"
#undef CHOICE
#undef NUMBER
#undef VALUE
    };
    int named = 0;
    for (int i = 0; i < SB_AXIS_BUILTIN_COUNT; i++) {
        const char *at = strstr(text, axis[i]);
        const char end = at ? at[strlen(axis[i])] : 'A';
        // SB_AXIS_P is no axis, but begins SB_AXIS_POINT.
        if (end == '_' || (end >= 'A' && end <= 'Z'))
            continue;
        print_error("src/%s/%s names %s; a layer that may is scene, effects, reference, "
                    "assemble, render or cases\n",
                    folder, name, axis[i]);
        named++;
    }
    return named;
}

static int check_file(struct sb_arena *arena, const char *folder, const char *name)
{
    int broken = 0;
    char *path = sb_arena_printf(arena, SB_SOURCE_DIR "/src/%s/%s", folder, name);
    char *text = sb_file_read(arena, path, 1 << 20, NULL, NULL);
    for (char *p = text; (p = strstr(p, "\n#include \"")); p++) {
        char target[32] = "";
        sscanf(p, "\n#include \"%31[a-z]/", target);
        if (find(target) >= 0 && may_include(folder, target))
            continue;
        print_error("src/%s/%s includes \"%s/…\"; src/layers.txt allows%s\n", folder,
                    name, target, allowed[find(folder)]);
        broken++;
    }
    return broken + (may_name_axes(folder) ? 0 : axes_named(folder, name, text));
}

static void every_include_goes_down_the_layers_and_axes_stay_where_they_may(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    static const char *const suffixes[] = {".c", ".h", ".def"};
    int broken = 0, seen = 0;
    read_layers(&arena);
    for (int i = 0; i < layer_count; i++) {
        const char *folder = sb_arena_printf(&arena, SB_SOURCE_DIR "/src/%s", layer[i]);
        for (int s = 0; s < 3 && sb_dir_exists(folder); s++) {
            int count = 0;
            char **names = sb_dir_list(&arena, folder, suffixes[s], &count, NULL);
            for (int n = 0; n < count; n++)
                broken += check_file(&arena, layer[i], names[n]);
            seen += count;
        }
    }
    assert_true(seen > 50);
    assert_int_equal(broken, 0);
    sb_arena_free(&arena);
}

static void every_folder_of_src_is_a_layer(void **state)
{
    (void)state;
    DIR *dir = opendir(SB_SOURCE_DIR "/src");
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));)
        if (entry->d_name[0] != '.' && !strchr(entry->d_name, '.') &&
            find(entry->d_name) < 0)
            fail_msg("src/%s stands in no line of src/layers.txt", entry->d_name);
    closedir(dir);
}

static void a_layer_lists_only_layers_above_it_in_the_file(void **state)
{
    (void)state;
    for (int i = 0; i < layer_count; i++)
        for (int j = i; j < layer_count; j++) {
            char word[40];
            snprintf(word, sizeof word, " %.31s ", layer[j]);
            if (strstr(allowed[i], word))
                fail_msg("%s may include %s, which stands below it", layer[i], layer[j]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_include_goes_down_the_layers_and_axes_stay_where_they_may),
        cmocka_unit_test(every_folder_of_src_is_a_layer),
        cmocka_unit_test(a_layer_lists_only_layers_above_it_in_the_file),
    };
    return run_tests(tests);
}
