// Desktop GLSL, 3.30 and newer. Precision qualifiers are taken there and mean nothing (GLSL 4.60,
// 4.7); on samplers 3.30 does not have them.
#if __VERSION__ < 400 && NR_SHADOWS > 0
#ifdef GL_ARB_texture_cube_map_array
#extension GL_ARB_texture_cube_map_array : enable
#endif
#endif
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D sampler2D
#define SAMPLER(precision, type) type
#define TEXTURE texture
#define DECLARE_O_COLOR layout(location = 0) out P_OUTPUT vec4 o_color;
