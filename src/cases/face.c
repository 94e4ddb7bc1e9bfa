#include "cases/face.h"

#include <stdlib.h>
#include <string.h>

#include "assemble/decide.h"
#include "assemble/defines.h"
#include "base/file.h"
#include "cases/judge.h"

struct texts {
    struct sb_arena arena;
    struct sb_defines defines;
    struct sb_glsl_source source[2]; // vertex, fragment
};

static bool build(const struct sb_case_env *env, struct sb_variant *variant,
                  struct texts *texts, struct sb_error *err)
{
    static const char *const file[] = {"rows.vert", "cube_face.frag"};
    const struct sb_glsl_version *version =
        sb_decide_version(env->axes, &env->driver->caps, variant, err);
    texts->defines.arena = &texts->arena;
    if (!version ||
        !sb_defines_make(&texts->defines, env->axes, variant, version->family, err))
        return false;
    sb_defines_rows(&texts->defines, true);
    const struct sb_glsl_params params = {
        .root = env->shaders ? env->shaders
                             : sb_path_join(&texts->arena, env->data_dir, "shaders"),
        .version = version->text,
        .define = texts->defines.row,
        .define_count = texts->defines.count,
    };
    for (int i = 0; i < 2; i++) {
        struct sb_glsl_params one = params;
        one.file = file[i];
        if (!sb_glsl_build(&one, &texts->source[i], err))
            return false;
    }
    return true;
}

static bool ask(const struct sb_case_env *env, const struct sb_job *job,
                const struct sb_image *rows, struct sb_image *told, struct sb_error *err)
{
    const struct sb_driver *driver = env->driver;
    const struct sb_image_request request = {
        .job = job->id, .kind = SB_IMAGE_ROWS, .rows = rows};
    struct sb_prepared prepared = {0};
    const bool ready = driver->fns->prepare(driver->runner, job, &prepared);
    free(prepared.log);
    if (!ready) {
        *err = prepared.error;
        return false;
    }
    const bool good = driver->fns->image(driver->runner, &request, told, err);
    driver->fns->release(driver->runner, job->id);
    return good;
}

bool sb_faces_tell(const struct sb_case_env *env, const struct sb_variant *variant,
                   const float (*direction)[3], int count, struct sb_image *told,
                   struct sb_error *err)
{
    struct sb_variant decided = *variant;
    struct texts texts = {0};
    struct sb_image rows = {0};
    decided.value[SB_AXIS_STORAGE] =
        SB_STORAGE_UNIFORM; // of lights, which there are none of
    bool good = build(env, &decided, &texts, err);
    if (good) {
        const struct sb_program program = {.role = "rows",
                                           .vertex = texts.source[0].text,
                                           .fragment = texts.source[1].text};
        const struct sb_job job = {.id = sb_case_next_job(),
                                   .variant = decided,
                                   .program = &program,
                                   .program_count = 1};
        sb_image_init(&rows, 1, count, 4);
        for (int i = 0; i < count; i++)
            memcpy(rows.data + 4 * i, direction[i], sizeof direction[i]);
        good = ask(env, &job, &rows, told, err);
    }
    sb_image_free(&rows);
    sb_glsl_free(&texts.source[0]);
    sb_glsl_free(&texts.source[1]);
    sb_arena_free(&texts.arena);
    return good;
}
