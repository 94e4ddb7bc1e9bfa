// The macros of what comes of the lights, where nothing of it is told.
#define PROBE_TERM(place, value)
#define PROBE_RAW(place, value)
#define PROBE_DIRECTION(value)
#define PROBE_NORMAL(value)
#define PROBE_VIEW(value)
#define PROBE_DECIDED(outcome) (outcome)
#define PROBE_SIDE(outcome)
#define PROBE_SHOWN(share)
#define PROBE_NEXT_LIGHT
