// A unit: a variant's lighting as a program that lights points of a table, so that its formulas
// can be asked at any input. It is the text that pictures are drawn with: only where the inputs
// come from differs (docs/glsl.md, "Rows").
#pragma once

#include "assemble/assemble.h"
#include "cases/points.h"
#include "measure/driver.h"

struct sb_unit_params {
    const struct sb_axes *axes;
    const struct sb_variant *variant; // resolved
    const struct sb_driver *driver;   // probed; must outlive the unit
    const char *data_dir, *shaders;   // as in sb_assemble_params
    uint32_t id;                      // of its job
};
struct sb_unit {
    const struct sb_driver *driver;
    struct sb_assembly assembly; // .job.variant: as the driver has it
    bool loaded;
};
// *unit must be zeroed; sb_unit_close also after failure. SB_COMPILE_FAILED names file and line.
bool sb_unit_open(struct sb_unit *unit, const struct sb_unit_params *params,
                  struct sb_error *err);
void sb_unit_close(struct sb_unit *unit);

// What the driver made of each point: its colour and pages of the probe (job.h, enum sb_probe_page),
// 16 channels each, `light` one image a light.
struct sb_unit_told {
    struct sb_image inputs, frame, *light;
    int lights;
};
// `lights`: of how many lights, from the first, the terms are wanted. Free also after failure.
bool sb_unit_light(const struct sb_unit *unit, const struct sb_points *points, int lights,
                   struct sb_unit_told *told, struct sb_error *err);
void sb_unit_told_free(struct sb_unit_told *told);

// The colours that so many points at a time leave in the variant's target, added by blending.
bool sb_unit_add(const struct sb_unit *unit, const struct sb_points *points, int adding,
                 struct sb_image *sums, struct sb_error *err);

// 12 values of a page of one point, and its colour.
const float *sb_told_page(const struct sb_image *page, int point);
const float *sb_told_colour(const struct sb_unit_told *told, int point);
