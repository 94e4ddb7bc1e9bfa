#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "measure/machine.h"

// The value of the first line of a /proc file that starts with `key`, or "".
static void proc_value(const char *path, const char *key, char *value, size_t size)
{
    char line[512];
    value[0] = '\0';
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, key, strlen(key)) != 0)
            continue;
        const char *text = line + strlen(key);
        text += strspn(text, " \t:");
        snprintf(value, size, "%.*s", (int)strcspn(text, "\n"), text);
        break;
    }
    if (file)
        fclose(file);
}

json_t *sb_machine_json(void)
{
    struct utsname name;
    char cpu[256], load[128], ticks[256];
    proc_value("/proc/cpuinfo", "model name", cpu, sizeof cpu);
    proc_value("/proc/loadavg", "", load, sizeof load);
    proc_value("/proc/stat", "cpu ", ticks, sizeof ticks);
    long long steal = 0;
    sscanf(ticks, "%*d %*d %*d %*d %*d %*d %*d %lld", &steal);
    if (uname(&name) != 0)
        name = (struct utsname){0};
    json_t *machine = json_object();
    json_object_set_new(
        machine, "kernel",
        json_sprintf("%s %s %s", name.sysname, name.release, name.machine));
    json_object_set_new(machine, "cpu", json_string(cpu));
    json_object_set_new(machine, "cpus", json_integer(sysconf(_SC_NPROCESSORS_ONLN)));
    json_object_set_new(machine, "load_average", json_string(load));
    json_object_set_new(machine, "steal_ticks", json_integer(steal));
    return machine;
}

extern char **environ;

json_t *sb_environment_json(void)
{
    static const char *const prefixes[] = {
        "MESA_", "LIBGL_", "GALLIUM_", "GALLIVM_", "LP_",         "SOFTPIPE_",   "EGL_",
        "__GL_", "__EGL",  "ZINK_",    "VK_",      "DRI_PRIME",   "vblank_mode", "LVP_",
        "NIR_",  "ST_",    "DISPLAY",  "WAYLAND_", "SHADEBENCH_",
    };
    json_t *object = json_object();
    for (char **entry = environ; *entry; entry++) {
        const char *value = strchr(*entry, '=');
        for (size_t i = 0; value && i < sizeof prefixes / sizeof *prefixes; i++)
            if (strncmp(*entry, prefixes[i], strlen(prefixes[i])) == 0)
                json_object_setn_new(object, *entry, (size_t)(value - *entry),
                                     json_string(value + 1));
    }
    return object;
}
