// Transfer functions between linear light and what is stored.
#pragma once

// The sRGB transfer function of IEC 61966-2-1, from linear light in [0,1] to [0,1].
// Neither end is clamped: below 0 the straight part goes on, above 1 the curve does.
double sb_srgb_encode(double linear);
// Its inverse, in the same way.
double sb_srgb_decode(double encoded);
