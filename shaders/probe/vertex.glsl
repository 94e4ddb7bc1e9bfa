// Where the page of a vertex goes: into a buffer, by transform feedback.
out highp vec4 v_probe0;
out highp vec4 v_probe1;
out highp vec4 v_probe2;

void probe_out(highp mat3x4 page)
{
    v_probe0 = page[0];
    v_probe1 = page[1];
    v_probe2 = page[2];
}
