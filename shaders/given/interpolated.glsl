// GIVEN=interpolated: what a point is lit by comes from the rasteriser, uniforms and textures.
#define GIVEN_INPUT VARYING_IN
#define GIVEN_UNIFORM uniform
#define GIVEN_MAP(name) uniform SAMPLER2D name;
