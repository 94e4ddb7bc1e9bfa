// What a reader of results must know of the machine, as JSON.
#pragma once

#include <jansson.h>

// Kernel, CPU model and count, load averages, steal time so far. New reference.
json_t *sb_machine_json(void);

// The environment variables that can change what a driver does. New reference.
json_t *sb_environment_json(void);
