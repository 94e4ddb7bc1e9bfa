// What the maps gave to each pixel, against lookups that are made here.
#include "probe.h"

static double texel_at(const struct sb_texture *map, long x, long y, int channel)
{
    x = (x % map->width + map->width) % map->width;
    y = (y % map->height + map->height) % map->height;
    return map->texel[4 * (y * map->width + x) + channel] / 255.0;
}

// Between the four texels around uv.
static double looked_up(const struct sb_texture *map, const double uv[2], int channel)
{
    const double x = uv[0] * map->width - 0.5, y = uv[1] * map->height - 0.5;
    const double s = x - floor(x), t = y - floor(y);
    const long i = (long)floor(x), j = (long)floor(y);
    return (1 - t) * ((1 - s) * texel_at(map, i, j, channel) +
                      s * texel_at(map, i + 1, j, channel)) +
           t * ((1 - s) * texel_at(map, i, j + 1, channel) +
                s * texel_at(map, i + 1, j + 1, channel));
}

// False where nothing is lit; `at`: a pixel of the geometry picture.
static bool uv_of(const struct sb_scene *scene, const float *at, double uv[2])
{
    if (at[0] == 0 || scene->draw[(int)at[0] - 1].lamp >= 0)
        return false;
    const struct sb_mesh *mesh = &scene->mesh[scene->draw[(int)at[0] - 1].mesh];
    const uint32_t *index = &mesh->index[3 * ((int)at[1] - 1)];
    const double weight[3] = {1.0 - at[2] - at[3], at[2], at[3]};
    for (int c = 0; c < 2; c++) {
        uv[c] = 0;
        for (int i = 0; i < 3; i++)
            uv[c] += weight[i] * mesh->vertex[index[i]].uv[c];
    }
    return true;
}

struct error {
    double sum;
    long count;
};

// `read`: a letter of each map that the variant reads. Filters may have weights of 8 bits.
static void check_pixel(const struct probe_job *job, const float *page,
                        const double uv[2], const char *read, struct error *error)
{
    static const char letters[SB_MAP_COUNT + 1] = "dsn";
    for (int m = 0; m < SB_MAP_COUNT; m++)
        for (int c = 0; c < 3; c++) {
            if (!strchr(read, letters[m])) {
                assert_true(page[3 * m + c] == 0);
                continue;
            }
            const double off =
                fabs(page[3 * m + c] - looked_up(&job->scene.map[m], uv, c));
            assert_true(off < 0.02);
            error->sum += off;
            error->count++;
        }
    assert_true(page[9] == 0 && page[10] == 0 && page[11] == 0);
}

static void check_maps(const char *words, const char *read, bool inputs_only)
{
    struct probe_job job;
    struct sb_image geometry, page;
    struct error error = {0};
    assert_true(job_make(&job, words));
    job_image(&job, &(struct sb_image_request){.kind = SB_IMAGE_GEOMETRY}, &geometry);
    job_image(&job,
              &(struct sb_image_request){
                  .kind = SB_IMAGE_PROBE,
                  .page = SB_PROBE_MAPS,
                  .inputs_only = inputs_only,
              },
              &page);
    assert_int_equal(page.width, geometry.width);
    assert_int_equal(page.height, geometry.height);
    assert_int_equal(page.channels, CHANNELS);
    for (long i = 0; i < (long)page.width * page.height; i++) {
        double uv[2];
        const float *told = &page.data[CHANNELS * i + PAGE];
        if (uv_of(&job.scene, &geometry.data[4 * i], uv))
            check_pixel(&job, told, uv, read, &error);
        else
            for (int k = 0; k < 12; k++)
                assert_true(told[k] == 0);
    }
    if (*read)
        assert_true(error.count > 1000 && error.sum / (double)error.count < 0.003);
    sb_image_free(&geometry);
    sb_image_free(&page);
    job_free(&job);
}

void texels_are_told_as_they_were_looked_up(void **state)
{
    (void)state;
    static const struct {
        const char *words, *read;
    } cases[] = {
        {"scene=room point=1 maps=none", ""},
        {"scene=room point=1 maps=diffuse", "d"},
        {"scene=room point=2 maps=specular hoist=per_light specular_side=both", "s"},
        {"scene=room point=1 maps=normal", "n"},
        {"scene=plane point=2 lamps=on maps=diffuse+specular+normal", "dsn"},
        {"scene=room point=2 maps=diffuse+specular+normal hoist=per_light "
         "specular_side=both",
         "dsn"},
        {"scene=room point=2 maps=diffuse+specular stage=vertex", "ds"},
        {"scene=plane point=2 maps=diffuse stage=vertex lamps=on", "d"},
        {"scene=room point=2 maps=none stage=vertex", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int inputs_only = 0; inputs_only < 2; inputs_only++)
            check_maps(cases[i].words, cases[i].read, inputs_only);
}
