// GIVEN=interpolated: all inputs stand ready.
#define TAKE_INPUTS
