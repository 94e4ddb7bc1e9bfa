// The seam: what the upper half (deciding, judging) and the lower half (running) say to
// each other. Plain data only, so that a pipe can carry it.
//
//   open -> caps; audit; probe; prepare(job) -> prepared; round(shots) -> samples;
//   image(request) -> pixels; release(job); close
//
// A round is one message: calibration, order, looks and stopping live above the seam.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "axis/variant.h"
#include "image/image.h"
#include "stats/audit.h"

struct sb_context_params {
    const char *context; // "egl", "osmesa", "glfw", "null"; "auto": the first that opens
    bool gles;           // OpenGL ES; else desktop OpenGL, core profile
    int device;          // EGL device number; -1: the default display
    // Folder of program binaries, read on open; NULL: none, each job compiles for itself.
    const char *program_cache;
    // "NAME=VALUE" sets, "NAME" unsets a variable before a driver is loaded.
    const char *const *environment;
    int environment_count;
    bool
        driver_stats; // ask the driver for sb_prepared.driver_stats; compile times then hold that
    // Of a worker: the command that starts one (by /bin/sh; NULL: shadebench-worker beside this
    // program), and how long it may take over one call, or one batch of a round; 0: 120 s.
    const char *worker;
    double worker_limit_s;
    // Samples carry instructions, where the process that draws has a counter (caps.counter).
    // Before it is opened: a driver's threads must be made after the counter.
    bool count;
    // Of a worker, with `count`: its command is started under callgrind, which counts where the
    // kernel does not, and shows the driver another processor than the machine has (caps.cpu).
    // The command must be that of one program: `valgrind OPTIONS COMMAND`.
    bool callgrind;
    const char
        *count_folder; // the worker's own: where callgrind's files go; NULL: it has none
};

// What a driver has. A limit of 0: it has none of that kind. One list, caps.def.
struct sb_caps {
    char context[32];
#define CAP_TEXT(name, help)   char name[160];
#define CAP_NUMBER(name, help) int64_t name;
#include "job/caps.def"
#undef CAP_TEXT
#undef CAP_NUMBER
};

enum { SB_JOB_LIGHT_TYPES = 4 }; // dir, point, spot, area, as scene/lights.h has them

struct sb_program { // final GLSL, by role
    const char *
        role; // "shade": the lit draws, as many as there are entries of job.lit; "shadow": the shadow maps; "lamp": unlit draws;
    // "probe": as shade, and it tells what it computed on the way; "inputs": as
    // shade, and it tells what it was given. Both are compiled when a picture of
    // them is first asked for, and never timed; "rows": lights points of a table
    // (SB_IMAGE_ROWS), alone in its job
    const char *vertex, *geometry, *fragment; // geometry NULL: none
};

// What lights some draws: a program, and the lights that it is given. A program that stands in
// several of these is compiled once.
struct sb_lit {
    int program;               // place in the job's programs, of role "shade"
    struct sb_variant variant; // of its text: what its arrays have room for
    const int *light; // numbers in the scene's whole list, types one after another …
    int light_count[SB_JOB_LIGHT_TYPES]; // … and how many of each
    const int *draw; // numbers of draws that show no lamp, in the order drawn
    int draw_count;
};

struct sb_job_uniform { // an int or bool that programs are told with each draw
    const char *name;
    const int *value; // of each draw of the scene
};

struct sb_job {  // one variant ready to draw
    uint32_t id; // chosen by the caller, unique until released
    struct sb_variant variant;
    const char
        *scene; // generated again by the runner; hashes are compared. NULL with "rows"
    // The runner keeps the texts of the programs "probe" and "inputs", which it compiles later:
    // they must outlive the job. All others it has done with when prepare returns.
    const struct sb_program *program;
    int program_count;
    // 0: one program "shade" lights all draws with all lights. All of these arrays must outlive
    // the job. Each draw that shows no lamp is in one entry.
    const struct sb_lit *lit;
    int lit_count;
    const struct sb_job_uniform *uniform;
    int uniform_count;
    int draw_count; // of the scene, where there are uniforms: so many values each has
};

struct sb_prepared {
    struct sb_error error; // OK, COMPILE_FAILED, OVER_LIMIT, GL_ERROR, BAD_INPUT
    int failed_program;    // COMPILE_FAILED: which program …
    enum sb_failed_stage {
        SB_STAGE_LINK,
        SB_STAGE_VERT,
        SB_STAGE_GEOM,
        SB_STAGE_FRAG
    } failed_stage;
    char *log; // … and the driver's words; malloc'd, the caller frees
    double compile_ms, link_ms,
        first_draw_ms;   // first draw: in the exact measured state, drained
    int64_t vertices;    // per frame, all draws and layers
    int64_t fragments;   // covered pixels of the id target, times layers
    int64_t gl_calls;    // per frame
    int programs;        // that light
    int switches;        // of these in a frame: runs of draws of one program, less 1
    int programs_cached; // of all programs of the job, that came from the program cache
    int casters; // point lights that have a shadow map: what SB_IMAGE_SHADOW shows
    bool
        draws_shadows; // a frame draws the shadow maps again, so that SB_PART_SHADOWS is a
                       // part of it
    uint64_t input_hash;     // of every float uploaded
    uint64_t binary_hash;    // of the program binaries; 0: the driver has none
    char driver_stats[1000]; // what the driver printed of the shaders; "": nothing
};

struct sb_shot {
    uint32_t job;
    int frames; // whole frames in the timed batch
    int shrink; // 1; 2 halves width and height (the fragment-bound check)
    enum sb_shot_part {
        SB_PART_WHOLE,
        SB_PART_SHADOWS // only the uploads and the shadow passes of a frame
    } part;
};

enum { SB_SAMPLE_DISJOINT = 1, SB_SAMPLE_ABSURD = 2, SB_SAMPLE_LOST = 4 };

struct sb_sample {
    uint32_t job;
    int frames;
    int64_t gpu_ns;    // by the timer in use; SB_NO_TIME: that timer reads no query
    int64_t wall_ns;   // from before the first command until drained
    int64_t cpu_ns;    // process CPU time, all threads, over the same span
    int64_t submit_ns; // until the last command was issued
    // Of all threads in user space, over the span of wall_ns, after a frame of the same job that
    // is not counted; SB_NO_TIME: none are.
    int64_t instructions;
    unsigned flags;
};
#define SB_NO_TIME INT64_MIN // 0 ns is a value, never "none"

struct sb_image_request {
    uint32_t job;
    enum sb_image_kind {
        SB_IMAGE_COLOUR, // 4 channels, from the job's own program and target format
        SB_IMAGE_ID,     // 1 channel: 0 background, else draw number + 1
        SB_IMAGE_SHADOW, // 1 channel: the map of one caster, its faces unfolded to a cross of
                         // 4 x 3 faces, as stored
        SB_IMAGE_GEOMETRY, // 4 channels: draw number + 1 (0: background), triangle of its mesh
        // + 1, the driver's own perspective-correct weights of the triangle's
        // second and third vertex
        SB_IMAGE_PROBE_COLOUR, // 4 channels, in the widest format: what the program "probe"
                               // draws, which must be what "shade" draws, bit for bit
        // 16 channels. Lit per fragment, and of SB_PROBE_MAPS always: for each pixel the colour (4),
        // then the 12 values of `page`. Lit per vertex: one row of all vertices of all lit draws,
        // in the order of draws and of their meshes' vertices: the diffuse light that the vertex
        // hands on (3), 0, then the page.
        SB_IMAGE_PROBE,
        // 16 channels, of a job of a program "rows": for each row of `rows` what SB_IMAGE_PROBE has
        // of a pixel or vertex. `adding` > 1: 4 channels, for each so many rows the colour that
        // their drawing one after another, added by blending, leaves in the variant's target.
        SB_IMAGE_ROWS,
    } kind; // of the last two SB_BAD_INPUT where the job has no such program; they have one
            // sample a pixel, whatever the job has
    enum sb_probe_page {
        // [0] position (3), [3] normal (3) as interpolated, [6] uv, [8] non-finite values among
        // the raw terms, [9] negative ones that must not be, [10] the branches' hash (docs/glsl.md),
        // [11] the first non-finite one: 16 * light + place in the page "light" + 1; 0: none
        SB_PROBE_INPUTS,
        // [0] tangent (3), [3] bitangent (3), [6] unit view vector (3), [9] normal as lit (3); per
        // vertex [0] holds the specular light that the vertex hands on, [3] nothing
        SB_PROBE_FRAME,
        // of the light `light` of the whole list: [0] distance [1] attenuation [2] cone
        // [3] share that no shadow takes [4] n_dot_l [5] specular factor [6] unit vector to the
        // light (3) [9] factor on its diffuse colour [10] factor on its specular colour
        // [11] 1 where the shader came to this light
        SB_PROBE_LIGHT,
        // what lookups in the maps gave, in the precision of their results: [0] diffuse (3),
        // [3] specular (3), [6] normal (3) before * 2 - 1, [9] 0; 0 of a map that the
        // pixel had no use for
        SB_PROBE_MAPS,
    } page;
    int light; // SB_PROBE_LIGHT
    const struct sb_image
        *rows;  // SB_IMAGE_ROWS: 4 channels; width: texels of a row (scene/
                // point.h), height: points, up to caps.texture_size each
    int adding; // SB_IMAGE_ROWS: 0, or a divisor of the points
    // The last two kinds by the program "inputs", which disturbs a compiler less: it tells what
    // the lighting is given, and 0 from place 8 of SB_PROBE_INPUTS and from place 6 of
    // SB_PROBE_FRAME. SB_PROBE_LIGHT is SB_BAD_INPUT.
    bool inputs_only;
    bool one_pixel; // SB_IMAGE_PROBE of pixels: only pixel (x, y), an image of 1 x 1
    int x, y;
    int caster;        // SB_IMAGE_SHADOW: number of the point light
    int width, height; // 0: the job's own
    bool wide;         // draw to the widest float format there is, not the job's own, so
                       // that nothing is clamped or rounded away
    bool single;       // draw with one sample a pixel, as probes are drawn
    // Lights [off_first, off_first + off_count) of the whole list, directional lights first,
    // then point, then spot, are uploaded black. off_count 0: all shine.
    int off_first, off_count;
};

// Points side by side in what a program "rows" draws, pixel after pixel, line after line.
enum { SB_ROW_POINTS_ACROSS = 256 };

struct sb_probe { // what a driver makes of shaders
    struct sb_precision_reading reading[SB_PRECISION_MAX]; // in the order of
                                                           // sb_precision_questions
    int count;
    int nesting; // conditionals nested in a loop that it compiles and draws right: a power of
                 // two, up to SB_NESTING_ASKED; 0: none
};
enum { SB_NESTING_ASKED = 64 };

struct sb_runner_fns {
    const char *name, *help;
    void *(*open)(const struct sb_context_params *, struct sb_caps *, struct sb_error *);
    bool (*audit)(void *, struct sb_audit *, struct sb_error *); // reads, never judges
    bool (*use_timer)(void *, int source, struct sb_error *); // a place in audit.source
    bool (*probe)(void *, struct sb_probe *, struct sb_error *);
    bool (*prepare)(void *, const struct sb_job *, struct sb_prepared *);
    bool (*round)(void *, const struct sb_shot *, int count, struct sb_sample *,
                  struct sb_error *); // in this order
    bool (*image)(void *, const struct sb_image_request *, struct sb_image *,
                  struct sb_error *);
    void (*release)(void *, uint32_t job);
    // Where jobs can be lost: false, with why, for one that was given up, which its samples
    // (SB_SAMPLE_LOST) do not tell. NULL: none is.
    bool (*holds)(void *, uint32_t job, struct sb_error *);
    int (*workers)(const void *); // processes that it has used so far; NULL: one
    // Ends the process that draws: the next call is to a fresh one, which is told of the jobs that
    // it needs. NULL: there is none of its own.
    void (*renew)(void *);
    void (*close)(void *);
};

extern const struct sb_runner_fns sb_runner_null; // job/null.h
