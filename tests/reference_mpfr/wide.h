// Arithmetic of 200 bits that reads like arithmetic: every result is a new number of a pool that
// is emptied as a whole. At this width textbook formulas may cancel as they like.
#pragma once

#include <assert.h>
#include <mpfr.h>
#include <stdbool.h>

#include "math/vec.h"

enum { WIDE_BITS = 200, WIDE_POOL = 8192 };

typedef mpfr_srcptr wide;
struct wide3 {
    wide x, y, z;
};

static mpfr_t wide_pool[WIDE_POOL];
static int wide_used, wide_made;

static inline void wide_empty(void)
{
    wide_used = 0;
}

static inline void wide_free(void)
{
    for (int i = 0; i < wide_made; i++)
        mpfr_clear(wide_pool[i]);
    wide_made = 0;
    mpfr_free_cache();
}

static inline mpfr_ptr wide_new(void)
{
    assert(wide_used < WIDE_POOL);
    if (wide_used == wide_made)
        mpfr_init2(wide_pool[wide_made++], WIDE_BITS);
    return wide_pool[wide_used++];
}

static inline wide of(double a)
{
    const mpfr_ptr r = wide_new();
    mpfr_set_d(r, a, MPFR_RNDN);
    return r;
}

#define WIDE_BINARY(name, function)                                                      \
    static inline wide name(wide a, wide b)                                              \
    {                                                                                    \
        const mpfr_ptr r = wide_new();                                                   \
        function(r, a, b, MPFR_RNDN);                                                    \
        return r;                                                                        \
    }
WIDE_BINARY(plus, mpfr_add)
WIDE_BINARY(minus, mpfr_sub)
WIDE_BINARY(times, mpfr_mul)
WIDE_BINARY(over, mpfr_div)
WIDE_BINARY(power, mpfr_pow)
WIDE_BINARY(larger, mpfr_max)
WIDE_BINARY(smaller, mpfr_min)
#undef WIDE_BINARY

#define WIDE_UNARY(name, function)                                                       \
    static inline wide name(wide a)                                                      \
    {                                                                                    \
        const mpfr_ptr r = wide_new();                                                   \
        function(r, a, MPFR_RNDN);                                                       \
        return r;                                                                        \
    }
WIDE_UNARY(root, mpfr_sqrt)
WIDE_UNARY(cosine, mpfr_cos)
WIDE_UNARY(negative, mpfr_neg)
#undef WIDE_UNARY

static inline wide pi(void)
{
    const mpfr_ptr r = wide_new();
    mpfr_const_pi(r, MPFR_RNDN);
    return r;
}

static inline double narrow(wide a)
{
    return mpfr_get_d(a, MPFR_RNDN);
}
static inline bool exceeds(wide a, wide b)
{
    return mpfr_cmp(a, b) > 0;
}
static inline bool positive(wide a)
{
    return mpfr_sgn(a) > 0;
}
static inline wide clamped(wide a, double low, double high)
{
    return smaller(larger(a, of(low)), of(high));
}

// --- vectors --------------------------------------------------------------------------------

static inline struct wide3 of3(struct sb_vec3 v)
{
    return (struct wide3){of(v.x), of(v.y), of(v.z)};
}
static inline struct wide3 floats3(const float v[3])
{
    return (struct wide3){of(v[0]), of(v[1]), of(v[2])};
}
static inline struct wide3 plus3(struct wide3 a, struct wide3 b)
{
    return (struct wide3){plus(a.x, b.x), plus(a.y, b.y), plus(a.z, b.z)};
}
static inline struct wide3 minus3(struct wide3 a, struct wide3 b)
{
    return (struct wide3){minus(a.x, b.x), minus(a.y, b.y), minus(a.z, b.z)};
}
static inline struct wide3 times3(struct wide3 a, wide s)
{
    return (struct wide3){times(a.x, s), times(a.y, s), times(a.z, s)};
}
static inline wide dot(struct wide3 a, struct wide3 b)
{
    return plus(plus(times(a.x, b.x), times(a.y, b.y)), times(a.z, b.z));
}
static inline wide length3(struct wide3 a)
{
    return root(dot(a, a));
}
// A zero vector stays zero.
static inline struct wide3 unit3(struct wide3 a)
{
    const wide l = length3(a);
    return positive(l) ? times3(a, over(of(1), l)) : a;
}
static inline struct wide3 reflect3(struct wide3 incident, struct wide3 normal)
{
    return minus3(incident, times3(normal, times(of(2), dot(normal, incident))));
}
