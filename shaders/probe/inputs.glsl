// PROBE=inputs: the program "inputs" tells what a point is lit by, and nothing that comes of its
// lights, so that a compiler is left to treat them as it treats those of "shade".
#include "probe/given.glsl"
#include "probe/untold.glsl"

void probe_tell()
{
    if (u_probe_page == 1)
        probe_out(probe_frame);
    else
        probe_out(probe_inputs);
}

#define PROBE_OUT probe_tell();
