// Area lights by two points of theirs: the nearest for diffuse light and distance, the one
// nearest to the reflected ray for highlights. No integral: with a radius of 0 it is the point
// light exactly, and that is the test of it.
#include "area_shape/$(AREA_SHAPE).glsl"

Incident area_incident(AreaLight light, Surface surface)
{
    P_POSITION vec3 light_position = light.position;
    P_POSITION vec3 to_centre = light_position - surface.position;
    P_POSITION vec3 to_light = area_nearest(light, to_centre);
    P_VECTOR vec3 direction = unit_difference(to_light);
    PROBE_TERM(TERM_DISTANCE, length(to_light))
    PROBE_DIRECTION(direction)
    P_VECTOR vec3 highlight = direction;
    WITH_SPECULAR(P_POSITION vec3 ray;)
    IF_SPECULAR(ray = reflect(-view_of(surface), surface.normal);)
    IF_SPECULAR(highlight = unit_difference(area_nearest_ray(light, to_centre, ray));)
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(POINT_LIGHT_OF(light), length(to_light));)
    PROBE_TERM(TERM_ATTENUATION, factor)
    return Incident(direction, highlight, factor, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}
