// From a plan entry and a driver's caps to a job: `auto` values decided, limits checked,
// GLSL put together.
#pragma once

#include "base/text.h"
#include "glsl/glsl.h"
#include "job/job.h"
#include "suite/suite.h"

struct sb_assemble_params {
    const char *data_dir; // holds shaders/
    const char *shaders;  // another shader folder; NULL: data_dir/shaders
    const struct sb_axes *axes;
    const char *scene;
    const struct sb_variant *variant; // resolved
    const struct sb_caps *caps;
    const struct sb_suite
        *suite;  // that specialise=uber is for all of; NULL: for the variant alone
    uint32_t id; // of the job
    // The lights must be uniforms, whatever the variant says: so that a program that has them
    // as constants has a twin of the same class whose lights can be switched off.
    bool movable_lights;
    // The programs "probe" and "inputs" too. GLSL ES 1.00 has neither: it has one output.
    bool probe;
    // Only the program "rows", which lights points of a table (scene/point.h): `scene` and the axes
    // of targets and storage do not matter.
    bool rows;
};

enum sb_role {
    SB_ROLE_SHADE,
    SB_ROLE_SHADOW,
    SB_ROLE_LAMP,
    SB_ROLE_PROBE, // those from here are drawn, but never timed
    SB_ROLE_INPUTS,
    SB_ROLE_ROWS,
    SB_ROLE_COUNT
};

struct sb_built { // a program's final texts: vertex, geometry, fragment
    enum sb_role role;
    struct sb_glsl_source source[3];
};

// Owns the job's texts; the job points into it: do not move it. A job whose programs "probe" and
// "inputs" are to be drawn must be released first.
struct sb_assembly {
    struct sb_job job; // job.variant: with every `auto` decided
    struct sb_built *built;
    int built_count;
    struct sb_program
        *program;         // of the job, in the same order: that which lights comes first
    uint64_t source_hash; // of all texts that are timed,
    uint64_t lit_hash;    // and of those of them that light
    bool lit_per_vertex;  // the lighting is evaluated in the vertex shader
    bool lights_fixed;    // the lights are constants of the program
    // The program reads what nothing has set, as a source text does: its picture may be
    // anything, and cannot be judged.
    bool undefined;
    struct sb_arena arena;
};

// SB_OVER_LIMIT names the limit, what the driver has and what the variant wants;
// SB_BAD_INPUT: a #version that the context cannot take, or shaders that cannot be read.
// *assembly must be zeroed; free also after failure.
bool sb_assemble(const struct sb_assemble_params *params, struct sb_assembly *assembly,
                 struct sb_error *err);
void sb_assembly_free(struct sb_assembly *assembly);

// Gives the job's programs other names for all that no one asks for by name (glsl/rename.h): the
// same program, of another text.
void sb_assembly_rename(struct sb_assembly *assembly);

// Vertex, geometry and fragment text of the first program of a role; texts are NULL where there is
// none.
const struct sb_glsl_source *sb_assembly_sources(const struct sb_assembly *assembly,
                                                 enum sb_role role);

// A driver's compile log with the original files and lines.
void sb_assembly_explain(const struct sb_assembly *assembly,
                         const struct sb_prepared *prepared, struct sb_text *text);

// Runs glslangValidator over every program, its stages linked. SB_COMPILE_FAILED with its first message
// at the original line; SB_USAGE where the program is not installed.
bool sb_assembly_validate(const struct sb_assembly *assembly, struct sb_error *err);

// Caps of a generous driver that does not exist, for `show`, `--validate` and tests: GL 4.6
// or GLES 3.2 with every limit high.
void sb_caps_ideal(bool gles, struct sb_caps *caps);
