// Whole jobs of shipped scenes, and what their programs "probe" tell.
#pragma once

#include "axis/variant.h"
#include "../gl_test.h"
#include "local/local.h"
#include "math/vec.h"
#include "reference/shade.h"
#include "scene/scene.h"
#include "test.h"

#include "assemble/assemble.h"

enum { CHANNELS = 16, PAGE = 4 }; // of a probe; where its page begins

extern void *probe_runner;
extern struct sb_caps probe_caps;
extern const struct sb_runner_fns *const probe_fns;

// A prepared job of this number.
struct probe_job {
    uint32_t id;
    struct sb_assembly assembly;
    struct sb_variant variant;
    struct sb_scene scene;
};
// False where the driver has no such thing. "scene=plane" among the words: another than sphere.
bool job_make(struct probe_job *job, const char *words);
void job_free(struct probe_job *job);

void job_image(const struct probe_job *job, const struct sb_image_request *request,
               struct sb_image *image);
// The whole picture of one page; `light` of SB_PROBE_LIGHT.
void job_page(const struct probe_job *job, enum sb_probe_page page, int light,
              struct sb_image *image);

long differing(const struct sb_image *a, const struct sb_image *b);
struct sb_vec3 vector_of(const float *v);

// What the page "light" says of a light, by closed forms in double, from what the other pages say
// of the place.
struct place {
    struct sb_vec3 position, normal, view;
};
void terms_of(const struct probe_job *job, int light, const struct place *place,
              double page[12]);
// The type of a light of the whole list.
enum sb_light_type type_of(const struct probe_job *job, int light);

// Cases.
void the_probe_draws_what_the_timed_program_draws(void **state);
void presets_are_probed_as_they_are_drawn(void **state);
void reduced_precision_is_probed_as_it_is_drawn(void **state);
void loops_that_are_unrolled_less_differ_by_rounding_at_most(void **state);
void inputs_are_told_without_changing_what_is_drawn(void **state);
void inputs_are_those_of_the_whole_probe(void **state);
void lamps_have_a_colour_and_nothing_to_tell(void **state);
void one_pixel_tells_what_the_whole_picture_tells(void **state);
void lights_can_be_off_in_a_probe(void **state);
void a_program_without_a_probe_says_so(void **state);
void geometry_shows_the_draws_of_the_id_image(void **state);
void positions_are_those_of_the_weighted_corners(void **state);
void pages_of_lights_follow_closed_forms(void **state);
void decisions_are_hashed_in_order(void **state);
void a_light_on_the_surface_is_not_finite_in_naive_forms(void **state);
void negative_terms_are_counted(void **state);
void frames_of_normal_maps_are_told(void **state);
void texels_are_told_as_they_were_looked_up(void **state);
void vertices_tell_what_they_hand_on(void **state);
