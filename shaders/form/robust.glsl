// form=robust: of a formula that has two forms, the guarded one, free of avoidable
// cancellation. A formula with one form takes the same name, so callers know of neither.
#define unit            unit_robust
#define unit_difference unit_difference_robust
#define attenuation     attenuation_robust
#define cone            cone_robust
#define specular_factor specular_factor_robust
#define along_segment   along_segment_robust
