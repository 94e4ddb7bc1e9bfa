// stage=fragment: what the lighting needs is interpolated (Phong 1975).
VARYING_OUT P_VARYING vec3 v_position;
VARYING_OUT P_VARYING vec3 v_normal;
WITH_NORMAL_MAP(VARYING_OUT P_VARYING vec3 v_tangent;)
WITH_NORMAL_MAP(VARYING_OUT P_VARYING vec3 v_bitangent;)

void hand_over(highp vec3 position, highp vec3 normal)
{
    v_position = position;
    v_normal = normal;
}

void hand_over_frame(highp vec3 normal, highp vec3 tangent)
{
    IF_NORMAL_MAP(v_tangent = tangent;)
    IF_NORMAL_MAP(v_bitangent = cross(normal, tangent) * a_tangent.w;)
}
