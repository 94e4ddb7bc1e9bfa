// form=naive: of a formula that has two forms, the one that textbooks print.
#define unit            unit_naive
#define unit_difference unit_difference_naive
#define attenuation     attenuation_naive
#define cone            cone_naive
#define specular_factor specular_factor_naive
#define along_segment   along_segment_naive
