// GIVEN=rows: take_row() sets the inputs from the point's row.
#include "generated/row.glsl"

#define TAKE_INPUTS row_is(ROW_POINT); take_row();
