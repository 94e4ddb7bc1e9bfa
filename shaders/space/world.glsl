// space=world: lights, positions and normals are in world space.
P_POSITION vec3 to_eye(P_POSITION vec3 position)
{
    return eye() - position;
}

P_POSITION vec3 to_world(P_POSITION vec3 v)
{
    return v;
}

P_POSITION vec3 from_world(P_POSITION vec3 v)
{
    return v;
}
