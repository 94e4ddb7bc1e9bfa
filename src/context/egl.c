// EGL without a window: the surfaceless platform, else a device, else the default
// display.
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "base/mem.h"
#include "base/text.h"
#include "context/context.h"
#include "context/versions.h"

enum { DEVICE_MAX = 32 };

struct egl {
    void *library;
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface;
    PFNEGLGETPROCADDRESSPROC get_proc;
    PFNEGLGETERRORPROC get_error;
    PFNEGLQUERYSTRINGPROC query_string;
    PFNEGLGETDISPLAYPROC get_display;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLTERMINATEPROC terminate;
    PFNEGLBINDAPIPROC bind_api;
    PFNEGLCHOOSECONFIGPROC choose_config;
    PFNEGLCREATECONTEXTPROC create_context;
    PFNEGLDESTROYCONTEXTPROC destroy_context;
    PFNEGLCREATEPBUFFERSURFACEPROC create_pbuffer;
    PFNEGLDESTROYSURFACEPROC destroy_surface;
    PFNEGLMAKECURRENTPROC make_current;
    PFNEGLRELEASETHREADPROC release_thread;
    // Extensions; NULL where the library has none of them.
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
    PFNEGLQUERYDEVICESEXTPROC query_devices;
    PFNEGLQUERYDISPLAYATTRIBEXTPROC query_display;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string;
};

// `word` as a whole word of a list of extensions; the list may be NULL.
static bool has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);
    while (list && *list) {
        const size_t next = strcspn(list, " ");
        if (next == length && strncmp(list, word, length) == 0)
            return true;
        list += next + strspn(list + next, " ");
    }
    return false;
}

static void release_display(struct egl *egl)
{
    if (egl->display == EGL_NO_DISPLAY)
        return;
    egl->make_current(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (egl->surface != EGL_NO_SURFACE)
        egl->destroy_surface(egl->display, egl->surface);
    if (egl->context != EGL_NO_CONTEXT)
        egl->destroy_context(egl->display, egl->context);
    egl->terminate(egl->display);
    egl->display = EGL_NO_DISPLAY;
    egl->surface = EGL_NO_SURFACE;
    egl->context = EGL_NO_CONTEXT;
}

static void egl_close(void *self)
{
    struct egl *egl = self;
    if (!egl)
        return;
    release_display(egl);
    if (egl->release_thread)
        egl->release_thread();
    if (egl->library)
        dlclose(egl->library);
    free(egl);
}

static bool load(struct egl *egl, struct sb_text *why)
{
    egl->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!egl->library) {
        sb_text_add(why, "libEGL.so.1 is not installed");
        return false;
    }
    void *lib = egl->library;
    egl->get_proc = (PFNEGLGETPROCADDRESSPROC)dlsym(lib, "eglGetProcAddress");
    egl->get_error = (PFNEGLGETERRORPROC)dlsym(lib, "eglGetError");
    egl->query_string = (PFNEGLQUERYSTRINGPROC)dlsym(lib, "eglQueryString");
    egl->get_display = (PFNEGLGETDISPLAYPROC)dlsym(lib, "eglGetDisplay");
    egl->initialize = (PFNEGLINITIALIZEPROC)dlsym(lib, "eglInitialize");
    egl->terminate = (PFNEGLTERMINATEPROC)dlsym(lib, "eglTerminate");
    egl->bind_api = (PFNEGLBINDAPIPROC)dlsym(lib, "eglBindAPI");
    egl->choose_config = (PFNEGLCHOOSECONFIGPROC)dlsym(lib, "eglChooseConfig");
    egl->create_context = (PFNEGLCREATECONTEXTPROC)dlsym(lib, "eglCreateContext");
    egl->destroy_context = (PFNEGLDESTROYCONTEXTPROC)dlsym(lib, "eglDestroyContext");
    egl->create_pbuffer =
        (PFNEGLCREATEPBUFFERSURFACEPROC)dlsym(lib, "eglCreatePbufferSurface");
    egl->destroy_surface = (PFNEGLDESTROYSURFACEPROC)dlsym(lib, "eglDestroySurface");
    egl->make_current = (PFNEGLMAKECURRENTPROC)dlsym(lib, "eglMakeCurrent");
    egl->release_thread = (PFNEGLRELEASETHREADPROC)dlsym(lib, "eglReleaseThread");
    // EGL 1.2 is the newest of these: a library that has it has the others.
    if (!egl->bind_api || !egl->release_thread || !egl->get_proc) {
        sb_text_add(why, "libEGL.so.1 is older than EGL 1.2");
        return false;
    }
    const char *client = egl->query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_word(client, "EGL_EXT_platform_base"))
        egl->get_platform_display =
            (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl->get_proc("eglGetPlatformDisplayEXT");
    if (has_word(client, "EGL_EXT_platform_device") &&
        (has_word(client, "EGL_EXT_device_enumeration") ||
         has_word(client, "EGL_EXT_device_base")))
        egl->query_devices =
            (PFNEGLQUERYDEVICESEXTPROC)egl->get_proc("eglQueryDevicesEXT");
    if (has_word(client, "EGL_EXT_device_query") ||
        has_word(client, "EGL_EXT_device_base")) {
        egl->query_display =
            (PFNEGLQUERYDISPLAYATTRIBEXTPROC)egl->get_proc("eglQueryDisplayAttribEXT");
        egl->query_device_string =
            (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->get_proc("eglQueryDeviceStringEXT");
    }
    return true;
}

static bool create_context(struct egl *egl, bool gles, bool surfaceless)
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             gles ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!egl->bind_api(gles ? EGL_OPENGL_ES_API : EGL_OPENGL_API) ||
        !egl->choose_config(egl->display, wanted, &config, 1, &count) || count < 1)
        return false;
    const struct sb_gl_version *version = sb_gl_versions(gles);
    for (; version->major && egl->context == EGL_NO_CONTEXT; version++) {
        // The profile mask belongs to desktop OpenGL: OpenGL ES refuses it.
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     version->major,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     version->minor,
                                     gles ? EGL_NONE : EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        egl->context =
            egl->create_context(egl->display, config, EGL_NO_CONTEXT, attributes);
    }
    if (egl->context == EGL_NO_CONTEXT)
        return false;
    if (!surfaceless) {
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        egl->surface = egl->create_pbuffer(egl->display, config, size);
        if (egl->surface == EGL_NO_SURFACE)
            return false;
    }
    return egl->make_current(egl->display, egl->surface, egl->surface, egl->context);
}

// A current context on `display`; else what failed is added to *why, and nothing is kept.
static bool open_on(struct egl *egl, EGLDisplay display, const char *where, bool gles,
                    struct sb_text *why)
{
    const char *separator = why->length ? "; " : "";
    if (display == EGL_NO_DISPLAY || !egl->initialize(display, NULL, NULL)) {
        sb_text_printf(why, "%s%s does not initialise (EGL error 0x%04x)", separator,
                       where, (unsigned)egl->get_error());
        return false;
    }
    egl->display = display;
    const bool surfaceless = has_word(egl->query_string(display, EGL_EXTENSIONS),
                                      "EGL_KHR_surfaceless_context");
    if (create_context(egl, gles, surfaceless))
        return true;
    sb_text_printf(why, "%s%s has no %s (EGL error 0x%04x)", separator, where,
                   sb_gl_wanted(gles), (unsigned)egl->get_error());
    release_display(egl);
    return false;
}

static bool open_surfaceless(struct egl *egl, bool gles, struct sb_text *why)
{
    if (!egl->get_platform_display ||
        !has_word(egl->query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                  "EGL_MESA_platform_surfaceless"))
        return false;
    EGLDisplay display = egl->get_platform_display(EGL_PLATFORM_SURFACELESS_MESA,
                                                   EGL_DEFAULT_DISPLAY, NULL);
    return open_on(egl, display, "the surfaceless platform", gles, why);
}

// Device number `only`, or with -1 the first one that opens.
static bool open_device(struct egl *egl, int only, bool gles, struct sb_text *why)
{
    EGLDeviceEXT devices[DEVICE_MAX];
    EGLint count = 0;
    if (!egl->get_platform_display || !egl->query_devices ||
        !egl->query_devices(DEVICE_MAX, devices, &count))
        count = 0;
    if (only >= count) {
        sb_text_printf(why, "there is no device %d; EGL lists %d, counted from 0", only,
                       (int)count);
        return false;
    }
    for (int i = only < 0 ? 0 : only; i < (only < 0 ? count : only + 1); i++) {
        char where[32];
        snprintf(where, sizeof where, "device %d", i);
        EGLDisplay display =
            egl->get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
        if (open_on(egl, display, where, gles, why))
            return true;
    }
    return false;
}

static void *egl_open(const struct sb_context_options *options, struct sb_error *err)
{
    const bool gles = options->gles;
    struct egl *egl = sb_alloc(sizeof *egl);
    struct sb_text why = {0};
    bool opened = load(egl, &why);
    if (opened && options->device >= 0)
        opened = open_device(egl, options->device, gles, &why);
    else if (opened)
        opened = open_surfaceless(egl, gles, &why) || open_device(egl, -1, gles, &why) ||
                 open_on(egl, egl->get_display(EGL_DEFAULT_DISPLAY),
                         "the default display", gles, &why);
    if (!opened) {
        sb_fail(err, SB_NO_GL, "egl: %s", sb_text_get(&why));
        egl_close(egl);
        egl = NULL;
    }
    sb_text_free(&why);
    return egl;
}

static sb_proc egl_proc(void *self, const char *name)
{
    struct egl *egl = self;
    return (sb_proc)egl->get_proc(name);
}

// EGL_MESA_device_software: "the device is a software renderer".
static bool egl_software(void *self)
{
    const struct egl *egl = self;
    EGLAttrib device = 0;
    return egl->query_display && egl->query_device_string &&
           egl->query_display(egl->display, EGL_DEVICE_EXT, &device) && device &&
           has_word(egl->query_device_string((EGLDeviceEXT)device, EGL_EXTENSIONS),
                    "EGL_MESA_device_software");
}

const struct sb_context_fns sb_context_egl = {
    .name = "egl",
    .help = "EGL: surfaceless or on a device; no display needed",
    .open = egl_open,
    .close = egl_close,
    .proc = egl_proc,
    .software = egl_software,
};
