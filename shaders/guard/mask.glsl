// guard=mask: what does not light is evaluated and multiplied by 0.
#define CUT(inside, value) ((value) * (PROBE_DECIDED(inside) ? 1.0 : 0.0))
