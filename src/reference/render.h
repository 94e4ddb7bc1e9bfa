// Pictures of the reference, in double: the ideal, what a variant's own model makes of it, and the
// same model on the inputs that a driver interpolated. Their differences are where an error
// comes from (docs/accuracy.md).
#pragma once

#include "image/image.h"
#include "reference/shade.h"

// A scene at a size: its geometry, and which triangle each pixel shows. Shared by all variants
// that upload the same floats.
struct sb_ref_ground {
    const struct sb_scene *scene; // the caller's; must outlive this
    int width, height, threads;
    struct sb_ref_geometry *geometry;
    struct sb_ref_cover *cover; // width * height, rows from the bottom up
    int *first_vertex; // a draw: the place of its first vertex among those of all lit
                       // draws; a lamp has none
    int vertex_count;  // of all lit draws
};
void sb_ref_ground_make(struct sb_ref_ground *ground, const struct sb_scene *scene,
                        int width, int height, int threads);
void sb_ref_ground_free(struct sb_ref_ground *ground);

// Is all of a pixel covered by the triangle that its centre shows? It lies in the triangle, and no
// neighbour shows another draw, whose edge could cut through it.
bool sb_ref_ground_interior(const struct sb_ref_ground *ground, int x, int y);

struct sb_ref_picture {
    struct sb_image64
        colour; // 3 channels, linear light; the background has the clear colour
    uint32_t *
        decisions; // a pixel: sb_ref_shade.decisions; lit per vertex, and where nothing is
                   // lit, 0
    float *margin; // a pixel: sb_ref_shade.margin
    unsigned char
        *valid; // a pixel: 0 where there is no such point; the background is valid
    struct sb_ref_shade *vertex; // lit per vertex: of all lit draws; else NULL
};
void sb_ref_picture_free(struct sb_ref_picture *picture);

// The ideal: lit per fragment with unit normals and exact shadows, on the sphere that a mesh may
// stand for. With text=as_written the slips of the text are part of it.
void sb_ref_ideal(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  struct sb_ref_picture *picture);

// The variant's model on exact inputs: Gouraud shading with stage=vertex, normals as they
// are interpolated with normalise=off, shadows from a map.
void sb_ref_model(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  struct sb_ref_picture *picture);

// The same on what a driver interpolated, lights as they were uploaded: pictures of the ground's
// size, as a runner gives them. Lit per fragment from `inputs` and `frame` (pages of
// SB_IMAGE_PROBE; `frame` NULL: no normal map), per vertex from the weights of `geometry`. Of both
// `maps`, SB_PROBE_MAPS of each pixel, has the texels; NULL: the reference samples by itself.
struct sb_ref_given {
    const struct sb_image *geometry, *inputs, *frame, *maps;
};
void sb_ref_given(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                  const struct sb_ref_given *given, struct sb_ref_picture *picture);

// One pixel of each, with all that was computed on the way.
struct sb_ref_point {
    struct sb_vec3 eye; // in the space of the lighting, as all of it
    struct sb_ref_input input;
    struct sb_ref_shade shade;
    struct sb_ref_terms *terms; // one a light; the caller's
    struct sb_vec3 colour;
};
bool sb_ref_ideal_at(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                     int x, int y, struct sb_ref_point *point);
// Of a program that is lit per fragment, from 12 values of SB_PROBE_INPUTS and, with a normal map,
// of SB_PROBE_FRAME. `maps`: 12 of SB_PROBE_MAPS; NULL: the reference samples by itself.
void sb_ref_given_at(const struct sb_ref_ground *ground, const struct sb_variant *variant,
                     int draw, const float *inputs, const float *frame, const float *maps,
                     struct sb_ref_point *point);
// One vertex of a lit draw, as the variant's lights see it.
void sb_ref_vertex_at(const struct sb_ref_ground *ground,
                      const struct sb_variant *variant, int draw, int vertex,
                      struct sb_ref_point *point);
// The colour of a pixel of a program that is lit per vertex, from what the corners of its triangle
// hand on and a driver's weights; `maps` as above.
struct sb_vec3 sb_ref_gouraud_at(const struct sb_ref_ground *ground,
                                 const struct sb_variant *variant, struct sb_ref_cover at,
                                 const double weight[3],
                                 const struct sb_ref_shade *corner[3], const float *maps);
