// What a point was given to be lit by: the inputs and the frame, which every probe tells.
#include "probe/page.glsl"
#include "probe/$(STAGE).glsl"

highp mat3x4 probe_inputs = mat3x4(0.0);
highp mat3x4 probe_frame = mat3x4(0.0);

void probe_inputs_are(highp vec3 position, highp vec3 normal, highp vec2 uv)
{
    probe_put(probe_inputs, 0, position);
    probe_put(probe_inputs, 3, normal);
    probe_put(probe_inputs, 6, vec3(uv, 0.0));
}

void probe_frame_is(highp vec3 tangent, highp vec3 bitangent)
{
    probe_put(probe_frame, 0, tangent);
    probe_put(probe_frame, 3, bitangent);
}

#define PROBE_INPUTS(position, normal, uv) probe_inputs_are(position, normal, uv);
#define PROBE_FRAME(tangent, bitangent) probe_frame_is(tangent, bitangent);
