// An explanation as JSON, from which its text is printed too.
#pragma once

#include <jansson.h>

#include "measure/explain.h"

json_t *sb_explanation_json(const struct sb_explanation *explanation,
                            const struct sb_task *task, const struct sb_driver *driver);
