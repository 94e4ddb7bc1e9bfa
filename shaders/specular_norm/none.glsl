// specular_norm=none: 1 is the most that a highlight can be, whatever its shininess.
#define NORM_TIMES(n, power) power
#define NORM_POW(c, n)       pow(c, n)
#define NORM_EXP2(exponent)  exp2(exponent)
