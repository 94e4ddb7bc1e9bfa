// loop=dynamic: bounds that are uniforms.
uniform highp int u_dir_count;
uniform highp int u_point_count;
uniform highp int u_spot_count;
uniform highp int u_area_count;
uniform highp int u_light_count;

#define EACH_DIR(one)   for (highp int i = 0; i < u_dir_count; i++) { one(i) }
#define EACH_POINT(one) for (highp int i = NR_SHADOWS; i < u_point_count; i++) { one(i) }
#define EACH_SPOT(one)  for (highp int i = 0; i < u_spot_count; i++) { one(i) }
#define EACH_AREA(one)  for (highp int i = 0; i < u_area_count; i++) { one(i) }
#define POINT_IS_ON(i)  ((i) < u_point_count)
#define EACH_LIGHT(one) for (highp int i = 0; i < u_light_count; i++) { one(i) }
