// The sun of the LWJGL book's chapter "Let there be even more light": it moves from -90
// degrees (dawn, at -x) over 0 (noon, at +y) to 90 (dusk, at +x), and within 10 degrees of the
// horizon it fades and reddens. Above 90 it is night, and the list has no sun
// (sb_lights_shining).
#include "scene/make.h"

#define SCENES_OWN  (-91) // of axis `sun`
#define LOW         80.0  // from here on it fades and reddens
#define HORIZON     90.0
#define LEAST_GREEN 0.9
#define LEAST_BLUE  0.5

// The text's intensity reaches 0 at the horizon. A sun of exactly 0 would be paid for and
// change nothing, as a light that is wired wrongly; so until it has set it keeps this much.
#define LEAST_INTENSITY (1.0 / 256)

void sb_light_follow_sun(struct sb_light_params *light, const struct sb_variant *variant)
{
    const double angle = variant->value[SB_AXIS_SUN];
    if (angle == SCENES_OWN)
        return;
    light->direction =
        (struct sb_vec3){-sin(angle * SB_DEGREE), -cos(angle * SB_DEGREE), 0};
    const double factor =
        fmin(fmax(1 - (fabs(angle) - LOW) / (HORIZON - LOW), LEAST_INTENSITY), 1);
    struct sb_vec3 *const term[] = {&light->ambient, &light->diffuse, &light->specular};
    for (int i = 0; i < 3; i++) {
        term[i]->x *= factor;
        term[i]->y *= factor * fmax(factor, LEAST_GREEN);
        term[i]->z *= factor * fmax(factor, LEAST_BLUE);
    }
    light->intensity *= factor;
}
