// As many casters as the program is made for: each shines and is shadowed.
#define WHERE_LIT(i, code) code
#define WHERE_SHADED(i, lookups) lookups
