// guard=mask: what does not light is evaluated and multiplied by 0.
#define CUT(inside, value) ((value) * ((inside) ? 1.0 : 0.0))
