// The lights are elements of arrays, which stand ready.
#define DIR_LIGHT(i)   u_dir[i]
#define POINT_LIGHT(i) u_point[i]
#define SPOT_LIGHT(i)  u_spot[i]
#define AREA_LIGHT(i)  u_area[i]
#define LIGHT(i)       u_light[i]
