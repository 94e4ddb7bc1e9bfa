#include "base/environment.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

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
