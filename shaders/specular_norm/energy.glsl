// specular_norm=energy: the power times a factor that makes up for its width, so that all
// exponents reflect the same energy. The factor is the model's, HIGHLIGHT_NORM(n).
//
// In half precision the power is rounded away below 2^-24 (below 2^-14 where subnormals are
// flushed), and a factor that comes after cannot bring it back. So its logarithm goes into the
// exponent. It is that of the material, and made once, before the first light (lighting.glsl).
P_SPECULAR float log2_norm;

// As textbooks have it: for each light, behind the power.
#define NORM_TIMES(n, power) (HIGHLIGHT_NORM(n) * (power))

#define NORM_EXP2(exponent) exp2((exponent) + log2_norm)

// c in [0, 1]. At 0 the logarithm is undefined.
P_SPECULAR float norm_pow(P_SPECULAR float c, P_SPECULAR float n)
{
    return c > 0.0 ? NORM_EXP2(n * log2(c)) : 0.0;
}
#define NORM_POW(c, n) norm_pow(c, n)
