// GLSL ES 3.00 and newer.
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D P_SAMPLER sampler2D
#define TEXTURE texture
#define DECLARE_O_COLOR out P_OUTPUT vec4 o_color;
