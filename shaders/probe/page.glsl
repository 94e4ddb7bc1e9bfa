// A page: the 12 floats that are told.
uniform highp int u_probe_page; // 0: inputs, 1: frame, 2: light, 3: maps

// Place p of a page.
#define PROBE_AT(page, p) page[p / 4][p % 4]

void probe_put(inout highp mat3x4 page, highp int place, highp vec3 value)
{
    page[place / 4][place % 4] = value.x;
    page[(place + 1) / 4][(place + 1) % 4] = value.y;
    page[(place + 2) / 4][(place + 2) % 4] = value.z;
}
