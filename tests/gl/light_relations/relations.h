// The shipped lighting on a square that lies in z = 0 and looks along +z, drawn through
// sb_assemble and layer render, for closed forms to be held against.
//
// Pixel x, y of the 32 x 32 picture shows the place ((2 x + 1) / 16 - 2, (2 y + 1) / 16 - 2, 0),
// which is a vertex of the square too: so pictures lit by vertex have closed forms as well. The
// material turns the sums over the lights into channels: ambient light is red, diffuse light
// green, highlights are blue.
#pragma once

#include "assemble_words.h"
#include "math/mat.h"
#include "render/render.h"

enum { SIDE = 32, LIGHTS_MAX = 8 };

extern struct sb_caps relations_caps;

struct setting { // what a picture shows; setting_init fills it
    struct sb_light light[LIGHTS_MAX];
    int count[SB_LIGHT_TYPE_COUNT];
    struct sb_mat4 view; // world to view, without scaling
    double eye[3];       // where that puts the camera
    float shininess;
    float ambient[3];        // of the scene
    double size;             // of the square, and of the distances of its pixels; 1
    float tangent[4];        // of the square
    unsigned char normal[3]; // the one texel of the normal map
};

// One white light of each kind at a place, with polynomial coefficients 1, 0.25, 0.5 and a
// range of 5; a cone of 35 and 25 degrees and an exponent of 3.
struct sb_light light_at(double x, double y, double z);
// No light; a camera that looks at the square from the side, turned about its own axis.
void setting_init(struct setting *setting);
void setting_add(struct setting *setting, enum sb_light_type type, struct sb_light light);
// One light.
void setting_one(struct setting *setting, enum sb_light_type type, struct sb_light light);
void setting_look(struct setting *setting, struct sb_vec3 eye, struct sb_vec3 target,
                  struct sb_vec3 up);

// Draws it with the shaders of these axes ("model=phong cone=hard"; the counts of lights, API
// and target are set already).
void draw(const struct setting *setting, const char *words, struct sb_image *image);
// Likewise, but a later frame of update=lights.
void draw_phase(const struct setting *setting, const char *words, int phase,
                struct sb_image *image);

// A light list that gets shorter: all lights are uploaded, then only the first `left` point
// lights.
void draw_shortened(const struct setting *setting, const char *words, int left,
                    struct sb_image *image);
// Bytes of the block Lights, and where a member of it lies (-1: it has no such member).
void reflect_block(const struct setting *setting, const char *words, const char *member,
                   int *size, int *offset);

// What a pixel must show. False: the closed form is not decided there (an edge is too near).
typedef bool (*closed_form)(const struct setting *setting, struct sb_vec3 place,
                            double colour[3]);
struct sb_vec3 place_of(const struct setting *setting, int x, int y);

// Draws, and compares every pixel; at least `least` must be decided.
void check_form(const struct setting *setting, const char *words, closed_form form,
                double tolerance, int least);
// The two pictures agree; or do not, by `tolerance` at least.
void check_same(const struct setting *a, const char *words_a, const struct setting *b,
                const char *words_b, double factor, double tolerance);
void check_other(const struct setting *a, const char *words_a, const struct setting *b,
                 const char *words_b, double least);

// By light and by vertex, in world and in view space: "stage=fragment space=world", … NULL at
// the end.
extern const char *const ways[];

// --- closed forms in double, by the reader's own hand --------------------------------------

static inline struct sb_vec3 vec(const float *v)
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

enum form_side { FRONT, BOTH };
struct form {                 // one light at one place
    struct sb_vec3 to_light;  // unit length
    struct sb_vec3 highlight; // likewise
    struct sb_vec3 normal;
    struct sb_vec3 to_eye; // unit length
    double factor;         // attenuation and cone
    double shininess;
    enum form_side side;
};
struct form form_begin(const struct setting *setting, struct sb_vec3 place,
                       struct sb_vec3 to_light);
double form_diffuse(const struct form *form);
double form_phong(const struct form *form);
double form_blinn(const struct form *form);

// --- the tests, by file ----------------------------------------------------------------------

void attenuation_follows_its_closed_form(void **state);
void the_pole_of_an_inverse_distance_is_cut_off(void **state);
void cones_follow_their_closed_forms(void **state);
void a_cone_of_more_than_a_right_angle_lights_behind_itself(void **state);
void a_wall_that_faces_away_shows_highlights_where_asked(void **state);
void ambient_light_is_of_the_scene_of_each_light_or_none(void **state);
void models_follow_their_closed_forms(void **state);
void directional_lights_may_be_of_any_length(void **state);

void area_lights_shine_from_their_nearest_point(void **state);
void highlights_come_from_the_point_nearest_to_the_reflected_ray(void **state);
void area_lights_of_no_size_are_point_lights(void **state);
void boxes_stay_along_the_axes_of_the_world_in_view_space(void **state);

void a_flat_normal_map_is_none(void **state);
void a_texel_turns_the_normal_in_the_frame_of_the_surface(void **state);
void a_frame_without_room_leaves_the_normal_alone(void **state);
void a_texel_that_is_too_long_lies_in_the_surface(void **state);
void a_mirrored_frame_turns_it_the_other_way(void **state);

void the_order_of_lights_does_not_matter(void **state);
void half_lights_make_a_whole_one(void **state);
void the_light_of_several_is_the_sum_of_each(void **state);
void powers_of_two_scale_pictures_exactly(void **state);
void later_phases_show_lights_that_moved(void **state);
void a_list_that_gets_shorter_leaves_nothing_behind_but_by_the_slip(void **state);
void the_struct_for_all_types_carries_spot_members_that_nobody_reads(void **state);
