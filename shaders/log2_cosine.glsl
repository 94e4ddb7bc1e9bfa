// log2 of the cosine of an angle below 90 degrees from the square s of its sine: half of
// log2(1 - s), by the series of ln(1 - s). Five terms are right to 2e-6 of it up to s = 1/8.
#define LOG2_COSINE(s) (-0.72134752 * s * (1.0 + s * (0.5 + s * (0.33333333 + s * (0.25 + s * 0.2)))))
