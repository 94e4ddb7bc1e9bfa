#include <math.h>

#include "math/mat.h"
#include "scene/lights.h"

#define CIRCLE 0.05                  // radius in the scene's own units
#define STEP   (1.1 * SB_PI / 180.0) // the text of `sun` moves it so far each frame

// Along the circle through the light's own place, which is where phase 0 is.
static void move(struct sb_light *light, const struct sb_phase *phase)
{
    const double turn = 2 * SB_PI * phase->number / SB_PHASES;
    const double radius = CIRCLE * phase->scale;
    light->position[0] = (float)(light->position[0] + radius * (cos(turn) - 1));
    light->position[2] = (float)(light->position[2] + radius * sin(turn));
}

// As the sun goes, from +y to +x.
static void turn_about_z(struct sb_light *light, const struct sb_phase *phase)
{
    const double turn = STEP * phase->number, x = light->direction[0],
                 y = light->direction[1];
    light->direction[0] = (float)(x * cos(turn) + y * sin(turn));
    light->direction[1] = (float)(y * cos(turn) - x * sin(turn));
}

void sb_lights_phase(const struct sb_lights *lights, const struct sb_phase *phase,
                     struct sb_light *out)
{
    const struct sb_light *light = lights->light;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        for (int i = 0; i < lights->count[type]; i++, light++, out++) {
            *out = *light;
            if (phase->number == 0 || (type == SB_LIGHT_POINT && i < phase->still_points))
                continue;
            if (type == SB_LIGHT_DIR)
                turn_about_z(out, phase);
            else
                move(out, phase);
        }
    }
}
