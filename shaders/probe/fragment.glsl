// Where the page of a fragment goes: into targets beside that of o_color.
layout(location = 1) out highp vec4 o_probe0;
layout(location = 2) out highp vec4 o_probe1;
layout(location = 3) out highp vec4 o_probe2;

void probe_out(highp mat3x4 page)
{
    o_probe0 = page[0];
    o_probe1 = page[1];
    o_probe2 = page[2];
}
