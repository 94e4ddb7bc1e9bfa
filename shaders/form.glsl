// Which of its two forms a formula has: the robust one is guarded and free of avoidable
// cancellation, the naive one is what textbooks print. Both stand in one file, and one of them
// takes the plain name. A formula with one form has the plain name too, so callers know of
// neither.
#define unit                 unit_$(F_UNIT)
#define unit_difference      unit_difference_$(F_UNIT)
#define vertex_normal        vertex_normal_$(F_UNIT)
#define attenuation          attenuation_$(F_ATTENUATION)
#define cone                 cone_$(F_CONE)
#define specular_factor      specular_factor_$(F_HIGHLIGHT)
#define half_vector          half_vector_$(F_UNIT)
#define schlick              schlick_$(F_HIGHLIGHT)
#define ball_nearest         ball_nearest_$(F_AREA)
#define ball_nearest_ray     ball_nearest_ray_$(F_AREA)
#define segment_nearest      segment_nearest_$(F_AREA)
#define segment_nearest_ray  segment_nearest_ray_$(F_AREA)
#define decoded_normal       decoded_normal_$(F_FRAME)
#define restored_normal      restored_normal_$(F_FRAME)
#define normal_in_frame      normal_in_frame_$(F_FRAME)
#define output_colour        output_colour_$(F_OUTPUT)
#define shadow_stored        shadow_stored_$(F_SHADOW)
#define shadow_face          shadow_face_$(F_SHADOW)
#define shadow_share         shadow_share_$(F_SHADOW)
