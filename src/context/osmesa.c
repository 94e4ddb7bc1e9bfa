// OSMesa: Mesa's software renderer drawing to plain memory, without EGL or a display.
//
// Newer Mesa has dropped OSMesa and its header, while installed libraries live on: so
// what is needed of GL/osmesa.h is declared here.
#include <dlfcn.h>
#include <stdlib.h>

#include "base/mem.h"
#include "context/context.h"
#include "context/versions.h"

enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_RGBA = 0x1908,
    OSMESA_DEPTH_BITS = 0x30,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
    TYPE_UNSIGNED_BYTE = 0x1401, // GL_UNSIGNED_BYTE
};

struct osmesa {
    void *library;
    void *context; // OSMesaContext
    unsigned char pixel[4];
    void *(*create)(const int *attributes, void *shared);
    unsigned char (*make_current)(void *context, void *buffer, unsigned type, int width,
                                  int height);
    sb_proc (*get_proc)(const char *name);
    void (*destroy)(void *context);
};

static void osmesa_close(void *self)
{
    struct osmesa *osmesa = self;
    if (!osmesa)
        return;
    if (osmesa->context)
        osmesa->destroy(osmesa->context);
    if (osmesa->library)
        dlclose(osmesa->library);
    free(osmesa);
}

static bool load(struct osmesa *osmesa, struct sb_error *err)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6",
                                        "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof *names && !osmesa->library; i++)
        osmesa->library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (!osmesa->library)
        return sb_fail(err, SB_NO_GL,
                       "osmesa: libOSMesa.so.8 (or .so.6) is not installed");
    osmesa->create = (void *(*)(const int *, void *))dlsym(osmesa->library,
                                                           "OSMesaCreateContextAttribs");
    osmesa->make_current = (unsigned char (*)(void *, void *, unsigned, int, int))dlsym(
        osmesa->library, "OSMesaMakeCurrent");
    osmesa->get_proc =
        (sb_proc(*)(const char *))dlsym(osmesa->library, "OSMesaGetProcAddress");
    osmesa->destroy = (void (*)(void *))dlsym(osmesa->library, "OSMesaDestroyContext");
    if (!osmesa->create || !osmesa->make_current || !osmesa->get_proc || !osmesa->destroy)
        return sb_fail(
            err, SB_NO_GL,
            "osmesa: the library has no OSMesaCreateContextAttribs; Mesa 12 or "
            "newer has it");
    return true;
}

static void *osmesa_open(const struct sb_context_options *options, struct sb_error *err)
{
    struct osmesa *osmesa = sb_alloc(sizeof *osmesa);
    if (options->gles) {
        sb_fail(err, SB_NO_GL,
                "osmesa: OSMesa has no OpenGL ES; contexts egl and glfw do");
        goto error;
    }
    if (options->device >= 0) {
        sb_fail(err, SB_NO_GL, "osmesa: a device can be chosen for context egl only");
        goto error;
    }
    if (!load(osmesa, err))
        goto error;
    const struct sb_gl_version *version = sb_gl_versions(false);
    for (; version->major && !osmesa->context; version++) {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  24,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  version->major,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  version->minor,
                                  0};
        osmesa->context = osmesa->create(attributes, NULL);
    }
    // A buffer of one pixel: everything is drawn to framebuffer objects.
    if (!osmesa->context ||
        !osmesa->make_current(osmesa->context, osmesa->pixel, TYPE_UNSIGNED_BYTE, 1, 1)) {
        sb_fail(err, SB_NO_GL, "osmesa: the library gives no %s", sb_gl_wanted(false));
        goto error;
    }
    return osmesa;

error:
    osmesa_close(osmesa);
    return NULL;
}

static sb_proc osmesa_proc(void *self, const char *name)
{
    struct osmesa *osmesa = self;
    return osmesa->get_proc(name);
}

static bool osmesa_software(void *self)
{
    (void)self;
    return true;
}

const struct sb_context_fns sb_context_osmesa = {
    .name = "osmesa",
    .help = "OSMesa: Mesa in software, drawing to memory; desktop OpenGL only",
    .open = osmesa_open,
    .close = osmesa_close,
    .proc = osmesa_proc,
    .software = osmesa_software,
};
