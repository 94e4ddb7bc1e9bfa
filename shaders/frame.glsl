// The normal that a map gives in the frame of tangent, bitangent and normal, each as
// interpolated but for the normal.
#include "form.glsl"

// A tangent of length 0, as exporters write it where texture coordinates collapse (MikkTSpace),
// or along the normal, and so a bitangent of length 0: the frame is flat, and the surface keeps
// its own normal. The determinant of the unit vectors tells all of them; below 1/1024 (a
// tangent within 0.06 degrees of the normal) half precision holds no direction of it.
P_VECTOR vec3 normal_in_frame_robust(P_VECTOR vec3 normal, P_VECTOR vec3 tangent,
                                     P_VECTOR vec3 bitangent, P_VECTOR vec3 bump)
{
    P_VECTOR float t2 = dot(tangent, tangent);
    P_VECTOR float b2 = dot(bitangent, bitangent);
    P_VECTOR vec3 t = t2 > 0.0 ? tangent * inversesqrt(t2) : vec3(0.0);
    P_VECTOR vec3 b = b2 > 0.0 ? bitangent * inversesqrt(b2) : vec3(0.0);
    P_VECTOR float volume = dot(cross(t, b), normal);
    return abs(volume) > 1.0 / 1024.0 ? unit(mat3(t, b, normal) * bump) : normal;
}

P_VECTOR vec3 normal_in_frame_naive(P_VECTOR vec3 normal, P_VECTOR vec3 tangent,
                                    P_VECTOR vec3 bitangent, P_VECTOR vec3 bump)
{
    return unit(mat3(normalize(tangent), normalize(bitangent), normal) * bump);
}
