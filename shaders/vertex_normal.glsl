// The unit normal of a vertex, highp in every variant.
#include "form.glsl"

// A zero normal (the tip of a cone, a collapsed triangle) stays zero, and so unlit, where
// normalize() gives NaN and blackens every triangle around the vertex.
highp vec3 vertex_normal_robust(highp vec3 normal)
{
    highp float n2 = dot(normal, normal);
    return n2 > 0.0 ? normal * inversesqrt(n2) : normal;
}

highp vec3 vertex_normal_naive(highp vec3 normal)
{
    return normalize(normal);
}
