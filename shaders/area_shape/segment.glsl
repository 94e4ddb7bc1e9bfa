// Points of the segment from centre - half_axis to centre + half_axis.

// How far along half_axis, from -1 to 1, is the point whose projection is dot_axis. A segment
// of no length is its centre: the quotient would be 0 / 0.
P_POSITION float along_segment(P_POSITION float dot_axis, P_POSITION float axis2)
{
    P_POSITION float t = axis2 > 0.0 ? dot_axis / axis2 : 0.0;
    PROBE_RAW(TERM_DISTANCE, t)
    return clamp(t, -1.0, 1.0);
}

// Vector to the segment's nearest point.
P_POSITION vec3 segment_nearest_robust(P_POSITION vec3 to_centre, P_POSITION vec3 half_axis)
{
    P_POSITION float t =
        along_segment(-dot(to_centre, half_axis), dot(half_axis, half_axis));
    return to_centre + t * half_axis;
}

P_POSITION vec3 segment_nearest_naive(P_POSITION vec3 to_centre, P_POSITION vec3 half_axis)
{
    P_POSITION float t = -dot(to_centre, half_axis) / dot(half_axis, half_axis);
    PROBE_RAW(TERM_DISTANCE, t)
    return to_centre + clamp(t, -1.0, 1.0) * half_axis;
}

// Vector to the point of the segment that is nearest to the ray, a unit vector from the surface
// (Karis 2013, "Real shading in Unreal Engine 4", tube lights; Picott 1992): of the segment's
// points less their part along the ray, the shortest.
//
// Where the segment makes a small angle with the ray, its part across the ray is made once and
// then squared: it has lost as many digits as the angle is small, its square no more.
P_POSITION vec3 segment_nearest_ray_robust(P_POSITION vec3 to_centre,
                                           P_POSITION vec3 half_axis, P_POSITION vec3 ray)
{
    P_POSITION vec3 centre_across = to_centre - dot(to_centre, ray) * ray;
    P_POSITION vec3 axis_across = half_axis - dot(half_axis, ray) * ray;
    P_POSITION float t =
        along_segment(-dot(centre_across, axis_across), dot(axis_across, axis_across));
    return to_centre + t * half_axis;
}

// The quotient as printed: its divisor |axis|^2 - (axis . ray)^2 loses twice as many digits, and
// is 0 for a ray along the segment.
P_POSITION vec3 segment_nearest_ray_naive(P_POSITION vec3 to_centre,
                                          P_POSITION vec3 half_axis, P_POSITION vec3 ray)
{
    P_POSITION float axis_along = dot(half_axis, ray);
    P_POSITION float t =
        (dot(to_centre, ray) * axis_along - dot(to_centre, half_axis)) /
        (dot(half_axis, half_axis) - axis_along * axis_along);
    PROBE_RAW(TERM_DISTANCE, t)
    return to_centre + clamp(t, -1.0, 1.0) * half_axis;
}
