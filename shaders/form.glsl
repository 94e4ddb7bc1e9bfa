// Which of its two forms a formula has: the robust one is guarded and free of avoidable
// cancellation, the naive one is what textbooks print. Both stand in one file, and one of them
// takes the plain name. A formula with one form has the plain name too, so callers know of
// neither.
#define unit            unit_$(F_UNIT)
#define unit_difference unit_difference_$(F_UNIT)
#define attenuation     attenuation_$(F_ATTENUATION)
#define cone            cone_$(F_CONE)
#define specular_factor specular_factor_$(F_HIGHLIGHT)
#define along_segment   along_segment_$(F_AREA)
#define schlick         schlick_$(F_HIGHLIGHT)
