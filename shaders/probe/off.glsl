// PROBE=off: nothing is told, and the driver sees nothing of it.
#define PROBE_TERM(place, value)
#define PROBE_RAW(place, value)
#define PROBE_DIRECTION(value)
#define PROBE_NORMAL(value)
#define PROBE_VIEW(value)
#define PROBE_INPUTS(position, normal, uv)
#define PROBE_FRAME(tangent, bitangent)
#define PROBE_DECIDED(outcome) (outcome)
#define PROBE_SIDE(outcome)
#define PROBE_SHOWN(share)
#define PROBE_NEXT_LIGHT
#define PROBE_OUT
