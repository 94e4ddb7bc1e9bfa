// Suites from text: written to a file in a folder of its own, loaded, and removed again.
#pragma once

#include <unistd.h>

#include "base/file.h"
#include "suite/suite.h"

static struct sb_suite suite;
static struct sb_error err;
static char folder[64], file[96];

static inline int make_folder(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/shadebench-suite-XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(file, sizeof file, "%s/suite.yaml", folder);
    return 0;
}

static inline int remove_folder(void **state)
{
    (void)state;
    unlink(file);
    return rmdir(folder);
}

static inline int free_suite(void **state)
{
    (void)state;
    sb_suite_free(&suite);
    return 0;
}

static inline bool load_bytes(const char *bytes, size_t size,
                              struct sb_suite_params params)
{
    sb_suite_free(&suite);
    err = (struct sb_error){0};
    params.path = file;
    if (!sb_file_replace(file, bytes, size, &err))
        fail_msg("%s", err.text);
    return sb_suite_load(&params, &suite, &err);
}

static inline bool load_text(const char *text)
{
    return load_bytes(text, strlen(text), (struct sb_suite_params){0});
}

static inline void must_load(const char *text)
{
    if (!load_text(text))
        fail_msg("%s", err.text);
}

// The message begins with file:place and goes on with `part` somewhere.
#define must_fail(text, place, part) must_fail_at(text, place, part, __FILE__, __LINE__)
static inline void must_fail_at(const char *text, const char *place, const char *part,
                                const char *in_file, int line)
{
    if (load_text(text)) {
        print_error("was accepted:\n%s\n", text);
        _fail(in_file, line);
    }
    char begin[160];
    snprintf(begin, sizeof begin, "%s%s: ", file, place);
    if (strncmp(err.text, begin, strlen(begin)) != 0) {
        print_error("not at %s: %s\n", place, err.text);
        _fail(in_file, line);
    }
    check_contains_at(err.text, part, in_file, line);
}

// The ids of all entries, with the scene before it where it is not "containers".
#define must_be(...) must_be_at((const char *[]){__VA_ARGS__, NULL}, __FILE__, __LINE__)
static inline void must_be_at(const char *const *ids, const char *in_file, int line)
{
    int count = 0;
    for (; ids[count]; count++) {
        char id[512] = "";
        if (count < suite.entry_count &&
            strcmp(suite.entry[count].scene, "containers") != 0)
            snprintf(id, sizeof id, "%s:", suite.entry[count].scene);
        if (count < suite.entry_count)
            strncat(id, suite.entry[count].id, sizeof id - strlen(id) - 1);
        if (strcmp(id, ids[count]) != 0) {
            print_error("entry %d is \"%s\", not \"%s\"\n", count, id, ids[count]);
            _fail(in_file, line);
        }
    }
    if (count != suite.entry_count) {
        print_error("%d entries, not %d\n", suite.entry_count, count);
        _fail(in_file, line);
    }
}
