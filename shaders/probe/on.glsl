// PROBE=on: the program "probe" computes what "shade" does and tells what came of it
// (docs/glsl.md, "Probes"). Values are copied into highp at the call.
#include "probe/$(STAGE).glsl"

#define TERM_DISTANCE        0
#define TERM_ATTENUATION     1
#define TERM_CONE            2
#define TERM_SHOWN           3
#define TERM_N_DOT_L         4
#define TERM_SPECULAR        5
#define TERM_DIRECTION       6
#define TERM_DIFFUSE_WEIGHT  9
#define TERM_SPECULAR_WEIGHT 10
// Of no light: told with the first one.
#define TERM_VIEW            12
#define TERM_NORMAL          13

// The terms of a light that has none of its own.
#define PROBE_UNTOLD mat3x4(0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

uniform highp int u_probe_page;  // 0: inputs, 1: frame, 2: light
uniform highp int u_probe_light; // of the whole list

// Pages: place p is [p / 4][p % 4].
highp mat3x4 probe_now = PROBE_UNTOLD; // the light that is being added
highp mat3x4 probe_light = mat3x4(0.0); // u_probe_light
highp mat3x4 probe_inputs = mat3x4(0.0);
highp mat3x4 probe_frame = mat3x4(0.0);
highp int probe_number = 0; // of the light that is being added
highp int probe_nonfinite = 0;
highp int probe_negative = 0;
highp int probe_first = 0; // the first that is not finite; 0: none
highp uint probe_bad = 0u; // bit p: place p of this light is known not to be finite
highp uint probe_decisions = 0u;
bool probe_reached = true; // highlights are not cut

void probe_put(inout highp mat3x4 page, highp int place, highp vec3 value)
{
    for (highp int i = 0; i < 3; i++)
        page[(place + i) / 4][(place + i) % 4] = value[i];
}

// By its bits: drivers may take a comparison to know that there is no NaN.
void probe_raw(highp int place, highp float value)
{
    highp uint bit = 1u << uint(place);
    if ((floatBitsToUint(value) & 0x7F800000u) != 0x7F800000u || (probe_bad & bit) != 0u)
        return;
    probe_bad |= bit;
    probe_nonfinite++;
    if (probe_first == 0)
        probe_first = 16 * probe_number + place + 1;
}

void probe_raw_vector(highp int place, highp int step, highp vec3 value)
{
    probe_raw(place, value.x);
    probe_raw(place + step, value.y);
    probe_raw(place + 2 * step, value.z);
}

void probe_term(highp int place, highp float value)
{
    highp uint bits = floatBitsToUint(value);
    probe_now[place / 4][place % 4] = value;
    probe_raw(place, value);
    if (place != TERM_N_DOT_L && bits > 0x80000000u && bits <= 0xFF800000u)
        probe_negative++;
}

void probe_direction(highp vec3 value)
{
    probe_put(probe_now, TERM_DIRECTION, value);
    probe_raw_vector(TERM_DIRECTION, 1, value);
}

void probe_view(highp vec3 value)
{
    probe_put(probe_frame, 6, value);
    probe_raw_vector(TERM_VIEW, 0, value);
}

void probe_normal(highp vec3 value)
{
    probe_put(probe_frame, 9, value);
    probe_raw_vector(TERM_NORMAL, 0, value);
}

void probe_inputs_are(highp vec3 position, highp vec3 normal, highp vec2 uv)
{
    probe_put(probe_inputs, 0, position);
    probe_put(probe_inputs, 3, normal);
    probe_put(probe_inputs, 6, vec3(uv, 0.0));
}

void probe_frame_is(highp vec3 tangent, highp vec3 bitangent)
{
    probe_put(probe_frame, 0, tangent);
    probe_put(probe_frame, 3, bitangent);
}

void probe_decide(highp int outcome)
{
    probe_decisions = (probe_decisions * 31u + uint(outcome) + 1u) & 0xFFFFFFu;
}

bool probe_decided(bool outcome)
{
    probe_decide(outcome ? 1 : 0);
    return outcome;
}

void probe_shown(highp float share)
{
    probe_term(TERM_SHOWN, share);
    probe_decide(int(16.0 * share + 0.5));
}

void probe_next_light()
{
    if (!probe_reached) {
        probe_now[TERM_SPECULAR / 4][TERM_SPECULAR % 4] = 0.0;
        probe_now[TERM_SPECULAR_WEIGHT / 4][TERM_SPECULAR_WEIGHT % 4] = 0.0;
    }
    if (probe_number == u_probe_light) {
        probe_light = probe_now;
        probe_light[2][3] = 1.0;
    }
    probe_now = PROBE_UNTOLD;
    probe_number++;
    probe_bad &= (1u << uint(TERM_VIEW)) | (1u << uint(TERM_NORMAL));
    probe_reached = true;
}

void probe_tell()
{
    highp mat3x4 page = probe_inputs;
    page[2] = vec4(float(probe_nonfinite), float(probe_negative), float(probe_decisions),
                   float(probe_first));
    if (u_probe_page == 1)
        page = probe_frame;
    if (u_probe_page == 2)
        page = probe_light;
    probe_out(page);
}

#define PROBE_TERM(place, value) probe_term(place, value);
#define PROBE_RAW(place, value) probe_raw(place, value);
#define PROBE_DIRECTION(value) probe_direction(value);
#define PROBE_NORMAL(value) probe_normal(value);
#define PROBE_VIEW(value) probe_view(value);
#define PROBE_INPUTS(position, normal, uv) probe_inputs_are(position, normal, uv);
#define PROBE_FRAME(tangent, bitangent) probe_frame_is(tangent, bitangent);
#define PROBE_DECIDED(outcome) probe_decided(outcome)
#define PROBE_SIDE(outcome) probe_reached = probe_decided(outcome);
#define PROBE_SHOWN(share) probe_shown(share);
#define PROBE_NEXT_LIGHT probe_next_light();
#define PROBE_OUT probe_tell();
