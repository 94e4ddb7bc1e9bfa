// stage=fragment: what the lighting needs is interpolated (Phong 1975).
VARYING_OUT P_VARYING vec3 v_position;
VARYING_OUT P_VARYING vec3 v_normal;

void hand_over(highp vec3 position, highp vec3 normal)
{
    v_position = position;
    v_normal = normal;
}
