#include "form.glsl"

// Which of the faces XP XN YP YN ZP ZN a direction from the light meets, and where: x and y in
// [0, 1], z the number of the face. The axes of the faces are those of cameras that look along
// the face's direction with "up" y for X and Z, x for YP and -x for YN.
//
// Robust: the first of z, x, y that is as large as the largest, so that each direction has one
// face. In cube maps the hardware has an order of its own (OpenGL 4.6 core, 8.13).
P_POSITION vec3 shadow_face_robust(P_POSITION vec3 direction)
{
    P_POSITION vec3 d = direction;
    P_POSITION vec3 a = abs(d);
    P_POSITION float m = max(a.x, max(a.y, a.z));
    P_POSITION vec3 at;
    if (a.z == m)
        at = d.z > 0.0 ? vec3(-d.x, d.y, 4.0) : vec3(d.x, d.y, 5.0);
    else if (a.x == m)
        at = d.x > 0.0 ? vec3(d.z, d.y, 0.0) : vec3(-d.z, d.y, 1.0);
    else
        at = d.y > 0.0 ? vec3(-d.z, d.x, 2.0) : vec3(-d.z, -d.x, 3.0);
    return vec3(at.xy / m * 0.5 + 0.5, at.z);
}

// The largest by comparisons that are all strict: where two are equally large, on the edges and
// diagonals of the cube, no face is picked. -1: none.
P_POSITION vec3 shadow_face_naive(P_POSITION vec3 direction)
{
    P_POSITION vec3 d = direction;
    P_POSITION vec3 a = abs(d);
    P_POSITION float m = max(a.x, max(a.y, a.z));
    P_POSITION vec3 at = vec3(0.0, 0.0, -1.0);
    if (a.x > a.y && a.x > a.z)
        at = d.x > 0.0 ? vec3(d.z, d.y, 0.0) : vec3(-d.z, d.y, 1.0);
    if (a.y > a.x && a.y > a.z)
        at = d.y > 0.0 ? vec3(-d.z, d.x, 2.0) : vec3(-d.z, -d.x, 3.0);
    if (a.z > a.x && a.z > a.y)
        at = d.z > 0.0 ? vec3(-d.x, d.y, 4.0) : vec3(d.x, d.y, 5.0);
    return vec3(at.xy / m * 0.5 + 0.5, at.z);
}
