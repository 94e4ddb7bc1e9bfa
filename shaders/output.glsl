// The colour as a target of half floats or an output of reduced precision takes it.
#include "form.glsl"

// 65504 is the largest half float; what is larger becomes infinity there. All channels are
// scaled by one factor, so that the hue stays. NaN and what is below 0 become 0 by a select: of
// NaN max() may return either operand (GLSL 4.60, 8.3). An infinite channel leaves no factor,
// and is bounded by itself.
P_SUM vec3 output_colour_robust(P_SUM vec3 colour)
{
    P_SUM float red = colour.r > 0.0 ? colour.r : 0.0;
    P_SUM float green = colour.g > 0.0 ? colour.g : 0.0;
    P_SUM float blue = colour.b > 0.0 ? colour.b : 0.0;
    P_SUM float largest = max(red, max(green, blue));
    P_SUM float scale = largest > 65504.0 ? 65504.0 / largest : 1.0;
    P_SUM vec3 light = vec3(red, green, blue);
    return min(scale > 0.0 ? light * scale : light, 65504.0);
}

P_SUM vec3 output_colour_naive(P_SUM vec3 colour)
{
    return colour;
}
