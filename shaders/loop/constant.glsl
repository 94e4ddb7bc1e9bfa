// loop=constant: a bound that is known when the shader is compiled (all that GLSL ES 1.00 has,
// appendix A.4). The first point lights may cast shadows and are added apart (shadows.glsl).
#define EACH_DIR(one)   for (int i = 0; i < NR_DIR_LIGHTS; i++) { one(i) }
#define EACH_POINT(one) for (int i = NR_SHADOWS; i < NR_POINT_LIGHTS; i++) { one(i) }
#define EACH_SPOT(one)  for (int i = 0; i < NR_SPOT_LIGHTS; i++) { one(i) }
#define EACH_AREA(one)  for (int i = 0; i < NR_AREA_LIGHTS; i++) { one(i) }
#define EACH_LIGHT(one) for (int i = 0; i < NR_LIGHTS; i++) { one(i) }
