// loop=unrolled: no loop; the text is repeated, with literal indices.
#define EACH_DIR(one)   UNROLLED_DIR(one)
#define EACH_POINT(one) UNROLLED_POINT(one)
#define EACH_SPOT(one)  UNROLLED_SPOT(one)
#define EACH_AREA(one)  UNROLLED_AREA(one)
#define EACH_LIGHT(one) UNROLLED_LIGHT(one)
