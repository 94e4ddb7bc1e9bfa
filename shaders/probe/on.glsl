// PROBE=on: the program "probe" computes what "shade" does and tells what came of it
// (docs/glsl.md, "Probes"). Where a value is made it is only kept, and looked at when its light
// is done: whatever stands in a branch may move a compiler to treat that branch differently.
#include "probe/given.glsl"

#define TERM_DISTANCE        0
#define TERM_ATTENUATION     1
#define TERM_CONE            2
#define TERM_SHOWN           3
#define TERM_N_DOT_L         4
#define TERM_SPECULAR        5
#define TERM_DIRECTION       6
#define TERM_DIFFUSE_WEIGHT  9
#define TERM_SPECULAR_WEIGHT 10
#define TERM_VIEW            12 // of no light: told as of the first one
#define TERM_NORMAL          13

// The terms of a light that has none of its own.
#define PROBE_UNTOLD mat3x4(0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

uniform highp int u_probe_light; // of the whole list

highp mat3x4 probe_light = mat3x4(0.0); // u_probe_light's
highp mat3x4 probe_now = PROBE_UNTOLD;  // of the light that is being added
// Its first terms, before bounds that hide what they are. A term that has several bounds has the sum
// here, which is finite where all are.
highp mat2x4 probe_bare = mat2x4(0.0);
highp int probe_number = 0;        // of that light
highp uint probe_nonfinite = 0u;
highp int probe_negative = 0;
highp uint probe_first = 0u; // bit p: place p is not finite, of the first light of which any is
highp int probe_first_light = 0;
highp uint probe_decisions = 0u;
bool probe_cuts = false;   // highlights of that light are cut behind the surface,
bool probe_reached = true; // and are not here

void probe_decide(highp int outcome)
{
    probe_decisions = (probe_decisions * 31u + uint(outcome) + 1u) & 0xFFFFFFu;
}

bool probe_decided(bool outcome)
{
    probe_decide(outcome ? 1 : 0);
    return outcome;
}

// What is not finite and what is below 0, by bits: a compiler may take comparisons to know that
// there is no NaN. Few operations: a loop that grows is unrolled less.
highp uint probe_bad(highp int place, highp float value)
{
    return (floatBitsToUint(value) & 0x7F800000u) == 0x7F800000u ? 1u << uint(place) : 0u;
}

highp uint probe_ones(highp uint bits)
{
    bits -= bits >> 1 & 0x5555u;
    bits = (bits & 0x3333u) + (bits >> 2 & 0x3333u);
    bits = bits + (bits >> 4) & 0x0F0Fu;
    return bits + (bits >> 8) & 0x1Fu;
}

highp int probe_below(highp float value) // and finite: what is not counts as that alone
{
    return floatBitsToUint(value) - 0x80000001u < 0x7F7FFFFFu ? 1 : 0;
}

void probe_look()
{
    highp uint bad = probe_bad(TERM_DISTANCE, probe_now[0][0]) |
                     probe_bad(TERM_DISTANCE, probe_bare[0][0]) |
                     probe_bad(TERM_ATTENUATION, probe_now[0][1]) |
                     probe_bad(TERM_ATTENUATION, probe_bare[0][1]) |
                     probe_bad(TERM_CONE, probe_now[0][2]) |
                     probe_bad(TERM_CONE, probe_bare[0][2]) |
                     probe_bad(TERM_SHOWN, probe_now[0][3]) |
                     probe_bad(TERM_N_DOT_L, probe_now[1][0]) |
                     probe_bad(TERM_SPECULAR, probe_now[1][1]) |
                     probe_bad(TERM_SPECULAR, probe_bare[1][1]) |
                     probe_bad(TERM_DIRECTION, probe_now[1][2]) |
                     probe_bad(TERM_DIRECTION + 1, probe_now[1][3]) |
                     probe_bad(TERM_DIRECTION + 2, probe_now[2][0]) |
                     probe_bad(TERM_DIFFUSE_WEIGHT, probe_now[2][1]) |
                     probe_bad(TERM_SPECULAR_WEIGHT, probe_now[2][2]);
    probe_negative += probe_below(probe_now[0][0]) + probe_below(probe_now[0][1]) +
                      probe_below(probe_now[0][2]) + probe_below(probe_now[0][3]) +
                      probe_below(probe_now[1][1]) + probe_below(probe_now[2][1]) +
                      probe_below(probe_now[2][2]);
    probe_nonfinite += probe_ones(bad);
    probe_first = probe_first == 0u ? bad : probe_first;
    probe_first_light = probe_first == 0u ? probe_number + 1 : probe_first_light;
}

void probe_next_light()
{
    probe_look();
    if (probe_cuts)
        probe_decide(probe_reached ? 1 : 0);
    if (!probe_reached) {
        PROBE_AT(probe_now, TERM_SPECULAR) = 0.0;
        PROBE_AT(probe_now, TERM_SPECULAR_WEIGHT) = 0.0;
    }
    if (probe_number == u_probe_light) {
        probe_light = probe_now;
        probe_light[2][3] = 1.0;
    }
    probe_now = PROBE_UNTOLD;
    probe_bare = mat2x4(0.0);
    probe_cuts = false;
    probe_reached = true;
    probe_number++;
}

// 0 where all was finite. The view and the normal come before the lights, and a light's terms
// in the order in which they follow from each other.
highp int probe_first_one()
{
    highp int order[11] = int[11](
        TERM_DISTANCE, TERM_DIRECTION, TERM_DIRECTION + 1, TERM_DIRECTION + 2,
        TERM_ATTENUATION, TERM_CONE, TERM_SHOWN, TERM_N_DOT_L, TERM_SPECULAR,
        TERM_DIFFUSE_WEIGHT, TERM_SPECULAR_WEIGHT);
    highp uint before = probe_bad(TERM_VIEW, probe_frame[1][2]) |
                        probe_bad(TERM_VIEW, probe_frame[1][3]) |
                        probe_bad(TERM_VIEW, probe_frame[2][0]) |
                        probe_bad(TERM_NORMAL, probe_frame[2][1]) |
                        probe_bad(TERM_NORMAL, probe_frame[2][2]) |
                        probe_bad(TERM_NORMAL, probe_frame[2][3]);
    probe_nonfinite += probe_ones(before);
    if (before != 0u)
        return 1 + ((before >> uint(TERM_NORMAL)) != 0u ? TERM_NORMAL : TERM_VIEW);
    for (highp int i = 0; i < 11; i++)
        if ((probe_first >> uint(order[i]) & 1u) != 0u)
            return 16 * probe_first_light + order[i] + 1;
    return 0;
}

void probe_tell()
{
    highp int first = probe_first_one();
    highp mat3x4 page = probe_inputs;
    page[2] = vec4(float(probe_nonfinite), float(probe_negative), float(probe_decisions),
                   float(first));
    if (u_probe_page == 1)
        page = probe_frame;
    if (u_probe_page == 2)
        page = probe_light;
    probe_out(page);
}

#define PROBE_TERM(place, value) PROBE_AT(probe_now, place) = value;
#define PROBE_RAW(place, value) PROBE_AT(probe_bare, place) += value;
#define PROBE_DIRECTION(value) probe_put(probe_now, TERM_DIRECTION, value);
#define PROBE_VIEW(value) probe_put(probe_frame, 6, value);
#define PROBE_NORMAL(value) probe_put(probe_frame, 9, value);
#define PROBE_DECIDED(outcome) probe_decided(outcome)
#define PROBE_SIDE(outcome) probe_cuts = true; probe_reached = outcome;
#define PROBE_SHOWN(share) probe_now[0][3] = share; probe_decide(int(16.0 * probe_now[0][3] + 0.5));
#define PROBE_NEXT_LIGHT probe_next_light();
#define PROBE_OUT probe_tell();
