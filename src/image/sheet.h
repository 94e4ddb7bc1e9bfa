// Pictures for people: scaled so that something is seen, shrunk, and put side by side.
#pragma once

#include "image/image.h"

// Maps the values that are not 0 from 0.1 to 1, least to largest, in place: 0, which a shadow
// map is cleared to, stays black. Non-finite values stay as they are.
void sb_image_stretch(struct sb_image *image);

// Copies `from` shrunk by the least whole factor that leaves no side longer than `side`; each
// pixel is the mean of those it stands for. *to must not own data yet.
void sb_image_shrink(const struct sb_image *from, int side, struct sb_image *to);

enum { SB_SHEET_COLUMNS = 8 };

// How long a side of each of `count` pictures may be, so that their sheet stays below about
// 16 million pixels: at most 256.
int sb_sheet_side(int count);

// The pictures row by row from the top left, SB_SHEET_COLUMNS in a row, in cells as large as
// the largest, each at the top left of its cell, with a grey line of one pixel between cells.
// All have the same number of channels; count is above 0. *sheet must not own data yet.
void sb_sheet_make(const struct sb_image *picture, int count, struct sb_image *sheet);
