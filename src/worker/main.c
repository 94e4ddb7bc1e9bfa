// shadebench-worker: the half that draws, behind a pipe (docs/formats.md, "Worker protocol").
// shadebench starts it; started by hand it waits for requests.
#include <stdio.h>
#include <string.h>

#include "base/log.h"
#include "job/null.h"
#include "wire/worker_main.h"
#ifdef SB_HAVE_GL
#include "local/local.h"
#endif

static const struct sb_runner_fns *pick_runner(const struct sb_context_params *params,
                                               struct sb_error *err)
{
    (void)err;
    if (strcmp(params->context, "null") == 0)
        return &sb_runner_null;
#ifdef SB_HAVE_GL
    return &sb_runner_local;
#else
    sb_fail(err, SB_NO_GL, "this worker was built without GL: only --context null");
    return NULL;
#endif
}

int main(int argc, char **argv)
{
    if (argc == 1)
        return sb_worker_main(pick_runner);
    if (strcmp(argv[1], "--version") == 0) {
        printf("shadebench-worker %s\n", SB_VERSION);
        return 0;
    }
    sb_warn(
        "shadebench-worker takes no arguments; shadebench starts it (docs/formats.md)");
    return sb_status_rows[SB_USAGE].exit_code;
}
