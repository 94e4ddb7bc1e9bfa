#include "base/environment.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

extern char **environ;

void sb_environment_apply(const char *const *setting, int count)
{
    for (int i = 0; i < count; i++) {
        char *name = sb_strdup(setting[i]);
        char *equals = strchr(name, '=');
        if (equals)
            *equals = '\0';
        if (equals)
            setenv(name, equals + 1, 1);
        else
            unsetenv(name);
        free(name);
    }
}

static bool names(const char *variable, const char *const *setting, int count)
{
    const size_t length = strcspn(variable, "=");
    for (int i = 0; i < count; i++)
        if (strcspn(setting[i], "=") == length &&
            strncmp(setting[i], variable, length) == 0)
            return true;
    return false;
}

char **sb_environment_with(const char *const *setting, int count, struct sb_arena *arena)
{
    int own = 0, used = 0;
    while (environ[own])
        own++;
    char **with = sb_arena_alloc(arena, (size_t)(own + count + 1) * sizeof *with);
    for (int i = 0; i < own; i++)
        if (!names(environ[i], setting, count))
            with[used++] = environ[i];
    for (int i = 0; i < count; i++)
        if (strchr(setting[i], '=') && !names(setting[i], setting + i + 1, count - i - 1))
            with[used++] = sb_arena_strdup(arena, setting[i]);
    return with;
}
