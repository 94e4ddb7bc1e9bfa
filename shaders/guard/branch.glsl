// guard=branch: what does not light is not added. 0 * infinity is NaN, and here no factor of 0
// is multiplied with anything.
#define CUT(inside, value) (PROBE_DECIDED(inside) ? (value) : 0.0)
