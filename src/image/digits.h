// Numbers drawn into a picture: 5x7 dots a character.
#pragma once

#include "image/image.h"

enum { SB_DIGIT_WIDTH = 5, SB_DIGIT_HEIGHT = 7, SB_DIGIT_ADVANCE = 6 };

// Draws 0 to 9, e, - and . white into an image of 3 channels; other characters are left
// blank. The text's lower left dot is at (x, y); each dot is `zoom` pixels wide and high.
// All must lie in the picture.
void sb_digits_draw(struct sb_image *image, int x, int y, int zoom, const char *text);
