// loop=padded: to the size of the array, passing over lights of intensity 0.
#define EACH_DIR(one)   for (int i = 0; i < MAX_DIR_LIGHTS; i++) { if (DIR_LIGHT(i).intensity > 0.0) { one(i) } }
#define EACH_POINT(one) for (int i = NR_SHADOWS; i < MAX_POINT_LIGHTS; i++) { if (POINT_LIGHT(i).intensity > 0.0) { one(i) } }
#define EACH_SPOT(one)  for (int i = 0; i < MAX_SPOT_LIGHTS; i++) { if (SPOT_LIGHT(i).intensity > 0.0) { one(i) } }
#define EACH_AREA(one)  for (int i = 0; i < MAX_AREA_LIGHTS; i++) { if (AREA_LIGHT(i).intensity > 0.0) { one(i) } }
#define POINT_IS_ON(i)  (POINT_LIGHT(i).intensity > 0.0)
#define EACH_LIGHT(one) for (int i = 0; i < MAX_LIGHTS; i++) { if (LIGHT(i).intensity > 0.0) { one(i) } }
