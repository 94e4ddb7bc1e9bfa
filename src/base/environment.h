// Variables of this process's environment.
#pragma once

// "NAME=VALUE" sets, "NAME" unsets.
void sb_environment_apply(const char *const *setting, int count);
