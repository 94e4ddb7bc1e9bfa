#include "emulate/helpers.h"

#include <string.h>

// Integers throughout: a driver may contract or reassociate floats, never these.
//
// drop: bits of binary32's fraction that have no room. Its 13 lowest, and below 2^-14 one more
// for each halving; below 2^-24 only 0 and the smallest subnormal, 2^-24, are left.
static const char round_16_head[] =
    "highp float sb_round_16(const highp float x)\n"
    "{\n"
    "    highp uint bits = floatBitsToUint(x), a = bits & 0x7fffffffu;\n"
    "    highp uint drop = 126u - clamp(a >> 23u, 103u, 113u);\n";

// Half of the last place, less one where it is even: ties go to even.
static const char round_16_even[] =
    "    highp uint r = a + ((1u << (drop - 1u)) - 1u) + ((a >> drop) & 1u);\n"
    "    r = a > 0x33000000u ? max((r >> drop) << drop, 0x33800000u) : 0u;\n";
static const char round_16_zero[] =
    "    highp uint r = a < 0x33800000u ? 0u : (a >> drop) << drop;\n";

static const char round_16_flush[] = "    r = r < 0x38800000u ? 0u : r;\n";

// From 65520 on. A NaN, greater than the bits of infinity, stays one. Rounding towards zero never
// reaches infinity from a finite number (IEEE 754-2019, 7.4).
static const char overflow_infinity[] =
    "    r = r < 0x47800000u ? r : max(a, 0x7f800000u);\n";
static const char overflow_zero[] =
    "    r = r < 0x47800000u ? r : a < 0x7f800000u ? 0x477fe000u : a;\n";
static const char overflow_saturate[] =
    "    r = r < 0x47800000u ? r : a > 0x7f800000u ? a : 0x477fe000u;\n";

static const char round_16_tail[] = "    return uintBitsToFloat((bits ^ a) | r);\n"
                                    "}\n";

// Fixed point has no NaN, and no negative zero, which drivers that take the conversion there and
// back for trunc() would keep.
static const char round_10[] =
    "highp float sb_round_10(const highp float x)\n"
    "{\n"
    "    highp int steps = int(%s(clamp(x, -2.0, 1.99609375) * 256.0));\n"
    "    bool number = (floatBitsToUint(x) & 0x7fffffffu) <= 0x7f800000u;\n"
    "    return number && steps != 0 ? float(steps) * 0.00390625 : 0.0;\n"
    "}\n";

// The texts below: @ stands for the suffix, $ for the type.
static const char vectors[] =
    "highp vec2 sb_round@(const highp vec2 v)\n"
    "{\n    return vec2(sb_round@(v.x), sb_round@(v.y));\n}\n"
    "highp vec3 sb_round@(const highp vec3 v)\n"
    "{\n    return vec3(sb_round@(v.xy), sb_round@(v.z));\n}\n"
    "highp vec4 sb_round@(const highp vec4 v)\n"
    "{\n    return vec4(sb_round@(v.xyz), sb_round@(v.w));\n}\n"
    "highp float sb_dot@(const highp vec2 a, const highp vec2 b)\n"
    "{\n    highp vec2 p = sb_round@(a * b);\n    return sb_round@(p.x + p.y);\n}\n"
    "highp float sb_dot@(const highp vec3 a, const highp vec3 b)\n"
    "{\n    highp vec3 p = sb_round@(a * b);\n"
    "    return sb_round@(sb_round@(p.x + p.y) + p.z);\n}\n"
    "highp float sb_dot@(const highp vec4 a, const highp vec4 b)\n"
    "{\n    highp vec4 p = sb_round@(a * b);\n"
    "    return sb_round@(sb_round@(sb_round@(p.x + p.y) + p.z) + p.w);\n}\n"
    "highp vec3 sb_cross@(const highp vec3 a, const highp vec3 b)\n"
    "{\n    return sb_round@(sb_round@(a.yzx * b.zxy) - sb_round@(a.zxy * b.yzx));\n}\n"
    "highp float sb_length@(const highp float x)\n"
    "{\n    return abs(x);\n}\n"
    "highp float sb_normalize@(const highp float x)\n"
    "{\n    return sign(x);\n}\n";

// The built-in functions whose error is a rule, and how each misses the true `r`.
static const struct {
    const char *name, *missed;
} builtins[] = {
    {"log2", "r - (x >= 0.5 && x <= 2.0 ? 0.0078125 : 3.0 * sb_ulp_16(r))"},
    // Not below 0. Without the bound on x infinity would be subtracted from infinity.
    {"exp2", "r - min((1.0 + 2.0 * min(abs(x), 32.0)) * sb_ulp_16(r), r)"},
    {"inversesqrt", "r + 2.0 * sb_ulp_16(r)"},
    {"sqrt", "1.0 / sb_inversesqrt_16(x)"},
    {"sin", "r < 0.0 ? r - 0.0078125 : r + 0.0078125"},
    {"cos", "r < 0.0 ? r - 0.0078125 : r + 0.0078125"},
};

// The place of the last bit of the binary16 next to y, which for infinity and NaN is as good as
// any other.
static const char ulp_16[] =
    "highp float sb_ulp_16(const highp float y)\n"
    "{\n    highp uint exponent = (floatBitsToUint(y) >> 23u) & 255u;\n"
    "    return uintBitsToFloat((clamp(exponent, 113u, 142u) - 10u) << 23u);\n}\n";

// GLSL ES 3.00, 8.4: of two vectors or more components.
static const char of_vector[] =
    "highp float sb_length@(const highp $ v)\n"
    "{\n    return sb_sqrt@(sb_dot@(v, v));\n}\n"
    "highp $ sb_normalize@(const highp $ v)\n"
    "{\n    return sb_round@(v * sb_inversesqrt@(sb_dot@(v, v)));\n}\n"
    "highp $ sb_faceforward@(const highp $ n, const highp $ i, const highp $ reference)\n"
    "{\n    return sb_dot@(reference, i) < 0.0 ? n : -n;\n}\n"
    "highp $ sb_reflect@(const highp $ i, const highp $ n)\n"
    "{\n    return sb_round@(i - sb_round@(sb_round@(2.0 * sb_dot@(n, i)) * n));\n}\n"
    "highp $ sb_refract@(const highp $ i, const highp $ n, const highp float eta)\n"
    "{\n    highp float d = sb_dot@(n, i);\n"
    "    highp float s = sb_round@(1.0 - sb_round@(d * d));\n"
    "    highp float k = sb_round@(1.0 - sb_round@(sb_round@(eta * eta) * s));\n"
    "    highp float t = sb_round@(sb_round@(eta * d) + sb_sqrt@(k));\n"
    "    return k < 0.0 ? $(0.0) : sb_round@(sb_round@(eta * i) - sb_round@(t * "
    "n));\n}\n";

static const char of_any[] =
    "highp float sb_distance@(const highp $ a, const highp $ b)\n"
    "{\n    return sb_length@(sb_round@(a - b));\n}\n"
    "highp $ sb_mix@(const highp $ x, const highp $ y, const highp $ a)\n"
    "{\n    return sb_round@(sb_round@(x * sb_round@(1.0 - a)) + sb_round@(y * a));\n}\n"
    "highp $ sb_smoothstep@(const highp $ a, const highp $ b, const highp $ x)\n"
    "{\n"
    "    highp $ t = clamp(sb_round@(sb_round@(x - a) / sb_round@(b - a)), 0.0, 1.0);\n"
    "    return sb_round@(sb_round@(t * t) * sb_round@(3.0 - sb_round@(2.0 * t)));\n}\n"
    "highp $ sb_pow@(const highp $ x, const highp $ y)\n"
    "{\n    return sb_exp2@(sb_round@(y * sb_log2@(x)));\n}\n"
    "highp $ sb_mod@(const highp $ x, const highp $ y)\n"
    "{\n    return sb_round@(x - sb_round@(y * floor(sb_round@(x / y))));\n}\n"
    "highp $ sb_fma@(const highp $ a, const highp $ b, const highp $ c)\n"
    "{\n    return sb_round@(a * b + c);\n}\n";

static void add_with(struct sb_text *text, const char *source, const char *suffix,
                     const char *type)
{
    for (;;) {
        const size_t plain = strcspn(source, "@$");
        sb_text_add_n(text, source, plain);
        if (!source[plain])
            return;
        sb_text_add(text, source[plain] == '@' ? suffix : type);
        source += plain + 1;
    }
}

// Matrices of c columns and r rows: rounding, and their products with vectors.
static void add_matrix(struct sb_text *text, const char *suffix, int c, int r)
{
    sb_text_printf(text, "highp mat%dx%d sb_round%s(const highp mat%dx%d m)\n{\n", c, r,
                   suffix, c, r);
    sb_text_printf(text, "    return mat%dx%d(", c, r);
    for (int i = 0; i < c; i++)
        sb_text_printf(text, "%ssb_round%s(m[%d])", i ? ", " : "", suffix, i);
    sb_text_printf(
        text,
        ");\n}\n"
        "highp vec%d sb_mul%s(const highp mat%dx%d m, const highp vec%d v)\n{\n"
        "    highp vec%d s = sb_round%s(m[0] * v[0]);\n",
        r, suffix, c, r, c, r, suffix);
    for (int i = 1; i < c; i++)
        sb_text_printf(text, "    s = sb_round%s(s + sb_round%s(m[%d] * v[%d]));\n",
                       suffix, suffix, i, i);
    sb_text_printf(
        text,
        "    return s;\n}\n"
        "highp vec%d sb_mul%s(const highp vec%d v, const highp mat%dx%d m)\n{\n"
        "    return vec%d(",
        c, suffix, r, c, r, c);
    for (int i = 0; i < c; i++)
        sb_text_printf(text, "%ssb_dot%s(v, m[%d])", i ? ", " : "", suffix, i);
    sb_text_add(text, ");\n}\n");
}

// k columns of r rows times c columns of k rows.
static void add_product(struct sb_text *text, const char *suffix, int c, int r, int k)
{
    sb_text_printf(text,
                   "highp mat%dx%d sb_mul%s(const highp mat%dx%d a, const highp mat%dx%d "
                   "b)\n{\n    return mat%dx%d(",
                   c, r, suffix, k, r, c, k, c, r);
    for (int i = 0; i < c; i++)
        sb_text_printf(text, "%ssb_mul%s(a, b[%d])", i ? ", " : "", suffix, i);
    sb_text_add(text, ");\n}\n");
}

static void add_builtins(struct sb_text *text, const char *suffix, bool allowed_error)
{
    if (allowed_error)
        sb_text_add(text, ulp_16);
    for (size_t i = 0; i < sizeof builtins / sizeof *builtins; i++) {
        const char *name = builtins[i].name;
        sb_text_printf(text,
                       "highp float sb_%s%s(const highp float x)\n"
                       "{\n    highp float r = %s(x);\n    return sb_round%s(%s);\n}\n",
                       name, suffix, name, suffix,
                       allowed_error ? builtins[i].missed : "r");
        for (int n = 2; n <= 4; n++) {
            sb_text_printf(text,
                           "highp vec%d sb_%s%s(const highp vec%d v)\n"
                           "{\n    return vec%d(",
                           n, name, suffix, n, n);
            for (int c = 0; c < n; c++)
                sb_text_printf(text, "%ssb_%s%s(v.%c)", c ? ", " : "", name, suffix,
                               "xyzw"[c]);
            sb_text_add(text, ");\n}\n");
        }
    }
}

static void add_formulas(struct sb_text *text, const char *suffix, bool allowed_error)
{
    static const char *const types[] = {"float", "vec2", "vec3", "vec4"};
    add_with(text, vectors, suffix, "");
    add_builtins(text, suffix, allowed_error);
    for (int i = 1; i < 4; i++)
        add_with(text, of_vector, suffix, types[i]);
    for (int i = 0; i < 4; i++)
        add_with(text, of_any, suffix, types[i]);
    for (int c = 2; c <= 4; c++)
        for (int r = 2; r <= 4; r++)
            add_matrix(text, suffix, c, r);
    for (int i = 0; i < 27; i++)
        add_product(text, suffix, 2 + i / 9, 2 + i / 3 % 3, 2 + i % 3);
}

void sb_emulate_helpers(const struct sb_emulate_rules *rules, struct sb_text *text)
{
    sb_text_add(text, round_16_head);
    sb_text_add(text, rules->towards_zero ? round_16_zero : round_16_even);
    sb_text_add(text, rules->flush ? round_16_flush : "");
    sb_text_add(text, rules->saturate       ? overflow_saturate
                      : rules->towards_zero ? overflow_zero
                                            : overflow_infinity);
    sb_text_add(text, round_16_tail);
    add_formulas(text, SB_ROUND_16, rules->allowed_error);
    if (rules->lowp == SB_LOWP_FIXED10) {
        sb_text_printf(text, round_10, rules->towards_zero ? "trunc" : "roundEven");
        add_formulas(text, SB_ROUND_10, false);
    }
}
