#include <stddef.h>

#include "job/caps.h"

const struct sb_caps_row sb_caps_rows[] = {
#define CAP_TEXT(name, help)   {#name, help, true, offsetof(struct sb_caps, name)},
#define CAP_NUMBER(name, help) {#name, help, false, offsetof(struct sb_caps, name)},
#include "job/caps.def"
#undef CAP_TEXT
#undef CAP_NUMBER
};
const int sb_caps_row_count = sizeof sb_caps_rows / sizeof *sb_caps_rows;
