// bench/power: INJECT operations of extra work, where a point is lit, that change no pixel.
// Each needs the one before and none is linear, so a compiler can neither drop nor fold them:
// x -> x * x + 0.25 stays within [0, 0.5], which it does not know. All stand in a row, without a
// loop, so that twice as many are twice the work; bit by bit, since a macro cannot count.
// Start: within [-1, 1], of the point that is lit, so that nothing is made once for all.
#define EXTRA_PAIR x = x * x; x = x + 0.25;
#if (INJECT & 1) != 0
#define EXTRA_1 x = x * x;
#else
#define EXTRA_1
#endif
#define ROW_2 EXTRA_PAIR
#if (INJECT & 2) != 0
#define EXTRA_2 ROW_2
#else
#define EXTRA_2
#endif
#define ROW_4 ROW_2 ROW_2
#if (INJECT & 4) != 0
#define EXTRA_4 ROW_4
#else
#define EXTRA_4
#endif
#define ROW_8 ROW_4 ROW_4
#if (INJECT & 8) != 0
#define EXTRA_8 ROW_8
#else
#define EXTRA_8
#endif
#define ROW_16 ROW_8 ROW_8
#if (INJECT & 16) != 0
#define EXTRA_16 ROW_16
#else
#define EXTRA_16
#endif
#define ROW_32 ROW_16 ROW_16
#if (INJECT & 32) != 0
#define EXTRA_32 ROW_32
#else
#define EXTRA_32
#endif
#define ROW_64 ROW_32 ROW_32
#if (INJECT & 64) != 0
#define EXTRA_64 ROW_64
#else
#define EXTRA_64
#endif
#define ROW_128 ROW_64 ROW_64
#if (INJECT & 128) != 0
#define EXTRA_128 ROW_128
#else
#define EXTRA_128
#endif
#define ROW_256 ROW_128 ROW_128
#if (INJECT & 256) != 0
#define EXTRA_256 ROW_256
#else
#define EXTRA_256
#endif
#define ROW_512 ROW_256 ROW_256
#if (INJECT & 512) != 0
#define EXTRA_512 ROW_512
#else
#define EXTRA_512
#endif
#define ROW_1024 ROW_512 ROW_512
#if (INJECT & 1024) != 0
#define EXTRA_1024 ROW_1024
#else
#define EXTRA_1024
#endif
#define ROW_2048 ROW_1024 ROW_1024
#if (INJECT & 2048) != 0
#define EXTRA_2048 ROW_2048
#else
#define EXTRA_2048
#endif
#define EXTRA EXTRA_2048 EXTRA_1024 EXTRA_512 EXTRA_256 EXTRA_128 EXTRA_64 EXTRA_32 EXTRA_16 EXTRA_8 EXTRA_4 EXTRA_2 EXTRA_1
// `red` becomes x where x is above 2, which is nowhere.
#if INJECT > 0
#define INJECT_WORK(red, start) highp float x = 0.5 * start; EXTRA red = x > 2.0 ? x : red;
#else
#define INJECT_WORK(red, start)
#endif
