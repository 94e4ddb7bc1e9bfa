// Normal maps: one texel turns the normal everywhere, in the frame of tangent, bitangent and
// normal.
#include "relations.h"

static bool spread, restored; // f_frame=naive, normal_store=rg

static double stored(unsigned char texel)
{
    return spread ? texel / 255.0 * 2 - 1 : (texel - 128) / 127.0;
}

// The normal of the map in the frame of the square, whose normal is +z.
static struct sb_vec3 mapped_normal(const struct setting *setting)
{
    const struct sb_vec3 up = {0, 0, 1}, tangent = vec(setting->tangent);
    const struct sb_vec3 bitangent =
        sb_vec3_scale(sb_vec3_cross(up, tangent), setting->tangent[3]);
    const double x = stored(setting->normal[0]), y = stored(setting->normal[1]);
    const double z =
        restored ? sqrt(fmax(1 - x * x - y * y, 0)) : stored(setting->normal[2]);
    struct sb_vec3 sum = sb_vec3_scale(tangent, x);
    sum = sb_vec3_add(sum, sb_vec3_scale(bitangent, y));
    sum = sb_vec3_add(sum, sb_vec3_scale(up, z));
    return sb_vec3_normalise(sum);
}

static bool by_map(const struct setting *setting, struct sb_vec3 place, double colour[3])
{
    const struct sb_vec3 at = vec(setting->light[0].position);
    struct form form = form_begin(setting, place, sb_vec3_sub(at, place));
    form.normal = mapped_normal(setting);
    colour[1] = form_diffuse(&form);
    colour[2] = form_blinn(&form);
    return fabs(sb_vec3_dot(form.normal, form.to_light)) > 1e-4; // an edge of highlights
}

#define PLAIN "ambient=none attenuation=none"

static const char *const spaces[] = {
    "maps=normal ambient=none attenuation=none",
    "maps=normal ambient=none attenuation=none space=view",
    "maps=normal ambient=none attenuation=none hoist=per_light",
    "maps=normal ambient=none attenuation=none normalise=off",
    "maps=normal ambient=none attenuation=none f_frame=naive",
    "maps=normal ambient=none attenuation=none normal_store=rg",
    "maps=normal ambient=none attenuation=none normal_store=rg f_frame=naive",
};
enum { SPACES = sizeof spaces / sizeof *spaces };

static void setting_make(struct setting *setting)
{
    setting_init(setting);
    setting_one(setting, SB_LIGHT_POINT, light_at(0.5, -0.25, 0.75));
}

static void check_map(const struct setting *setting)
{
    for (int i = 0; i < SPACES; i++) {
        spread = strstr(spaces[i], "f_frame=naive");
        restored = strstr(spaces[i], "normal_store=rg");
        const double x = stored(setting->normal[0]), y = stored(setting->normal[1]);
        if (spread && restored && x * x + y * y > 1) // the root of what is below 0
            continue;
        check_form(setting, spaces[i], by_map, 4e-6, SIDE * SIDE * 9 / 10);
    }
}

// (0.5, 0.5, 1) lies between two texels, half of 1/255 from each: spread evenly neither is flat.
void a_flat_normal_map_is_none(void **state)
{
    (void)state;
    struct setting setting;
    setting_make(&setting);
    memcpy(setting.normal, (unsigned char[]){128, 128, 255}, 3);
    check_same(&setting, "maps=normal " PLAIN, &setting, PLAIN, 1, 4e-6);
    check_same(&setting, "maps=normal normal_store=rg " PLAIN, &setting, PLAIN, 1, 4e-6);
    for (int i = 0; i < 4; i++) {
        setting.normal[0] = i & 1 ? 127 : 128;
        setting.normal[1] = i & 2 ? 127 : 128;
        // The normal turns by 1/255 at most along each axis, the power multiplies that.
        const double turned = sqrt(2) / 255;
        check_same(&setting, "maps=normal f_frame=naive " PLAIN, &setting, PLAIN, 1,
                   turned * setting.shininess);
        check_other(&setting, "maps=normal f_frame=naive " PLAIN, &setting, PLAIN, 1e-3);
        check_map(&setting);
    }
}

// No tangent, one along the normal, and no side for the bitangent.
void a_frame_without_room_leaves_the_normal_alone(void **state)
{
    (void)state;
    static const float tangents[][4] = {
        {0, 0, 0, 1}, {0, 0, 2, 1}, {1, 0, 0, 0}, {1e-4f, 0, 1, 1}};
    struct setting setting;
    setting_make(&setting);
    memcpy(setting.normal, (unsigned char[]){200, 60, 220}, 3);
    for (int t = 0; t < 4; t++) {
        memcpy(setting.tangent, tangents[t], sizeof tangents[t]);
        for (int i = 0; i < SPACES; i++)
            if (!strstr(spaces[i], "naive"))
                check_same(&setting, spaces[i], &setting, PLAIN, 1, 4e-6);
    }
    // A hundred times more is a frame.
    setting.tangent[0] = 1e-2f;
    check_other(&setting, spaces[0], &setting, PLAIN, 0.05);
}

// x and y of a texel may be longer than 1; there is no z then.
void a_texel_that_is_too_long_lies_in_the_surface(void **state)
{
    (void)state;
    struct setting setting;
    setting_make(&setting);
    memcpy(setting.normal, (unsigned char[]){230, 217, 255}, 3);
    restored = true;
    spread = false;
    check_form(&setting, "maps=normal normal_store=rg " PLAIN, by_map, 4e-6,
               SIDE * SIDE * 9 / 10);
}

void a_texel_turns_the_normal_in_the_frame_of_the_surface(void **state)
{
    (void)state;
    static const unsigned char texels[][3] = {
        {200, 128, 220}, {128, 60, 220}, {40, 180, 200}, {255, 128, 128}};
    struct setting setting;
    setting_make(&setting);
    for (int t = 0; t < 4; t++)
        for (int turn = 0; turn < 2; turn++) {
            memcpy(setting.normal, texels[t], 3);
            setting.tangent[0] = turn ? 0.6f : 1;
            setting.tangent[1] = turn ? -0.8f : 0;
            check_map(&setting);
        }
}

void a_mirrored_frame_turns_it_the_other_way(void **state)
{
    (void)state;
    static const unsigned char tilted[] = {100, 200, 220}, mirrored[] = {100, 56, 220};
    struct setting setting, other;
    setting_make(&setting);
    memcpy(setting.normal, tilted, 3);
    setting.tangent[0] = 0.6f;
    setting.tangent[1] = -0.8f;
    other = setting;
    setting.tangent[3] = -1;
    check_map(&setting);
    check_other(&setting, spaces[0], &other, spaces[0], 0.05);
    // What it turns the other way is the part along the bitangent: texel b against 256 - b.
    memcpy(other.normal, mirrored, 3);
    check_same(&setting, spaces[0], &other, spaces[0], 1, 4e-6);
}
