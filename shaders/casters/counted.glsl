// specialise=uber: a program for scenes with fewer casters than NR_SHADOWS, and with fewer lights.
uniform highp int u_caster_count;

#define WHERE_LIT(i, code) if (POINT_IS_ON(i)) { code }
#define WHERE_SHADED(i, lookups) ((i) < u_caster_count ? (lookups) : 1.0)
