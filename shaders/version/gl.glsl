// Desktop GLSL, 3.30 and newer. Precision qualifiers are taken there and mean nothing (GLSL 4.60,
// 4.7); on samplers 3.30 does not have them.
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D sampler2D
#define TEXTURE texture
#define DECLARE_O_COLOR out P_OUTPUT vec4 o_color;
