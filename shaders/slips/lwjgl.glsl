// The slips of `lwjgl` (docs/sources.md): positions are in view space, and the place of the
// camera in world space is subtracted from them. (The other one, light directions that were
// not transformed, is in what is uploaded.)
P_POSITION vec3 slip_to_eye(P_POSITION vec3 position)
{
    return u_camera_position - position;
}
#define to_eye slip_to_eye
