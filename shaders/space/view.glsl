// space=view: lights, positions and normals are in view space, where the eye is the origin.
P_POSITION vec3 to_eye(P_POSITION vec3 position)
{
    return -position;
}

// Vectors, for what is bound to the axes of the world: shadow maps and boxes.
uniform highp mat3 u_view_rotation;

P_POSITION vec3 to_world(P_POSITION vec3 v)
{
    return v * u_view_rotation; // by its transpose, which is its inverse
}

P_POSITION vec3 from_world(P_POSITION vec3 v)
{
    return u_view_rotation * v;
}
