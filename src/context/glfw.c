// GLFW: a hidden window, for drivers that only serve a display.
#include <dlfcn.h>
#include <stdlib.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "base/mem.h"
#include "context/context.h"
#include "context/versions.h"

struct glfw {
    void *library;
    bool initialised;
    GLFWwindow *window;
    int (*init)(void);
    void (*terminate)(void);
    int (*get_error)(const char **description);
    void (*window_hint)(int hint, int value);
    GLFWwindow *(*create_window)(int width, int height, const char *title,
                                 GLFWmonitor *monitor, GLFWwindow *shared);
    void (*destroy_window)(GLFWwindow *window);
    void (*make_current)(GLFWwindow *window);
    void (*swap_interval)(int interval);
    void (*swap_buffers)(GLFWwindow *window);
    GLFWglproc (*get_proc)(const char *name);
};

static void glfw_close(void *self)
{
    struct glfw *glfw = self;
    if (!glfw)
        return;
    if (glfw->window)
        glfw->destroy_window(glfw->window);
    if (glfw->initialised)
        glfw->terminate();
    if (glfw->library)
        dlclose(glfw->library);
    free(glfw);
}

static bool load(struct glfw *glfw, struct sb_error *err)
{
    glfw->library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!glfw->library)
        return sb_fail(err, SB_NO_GL, "glfw: libglfw.so.3 is not installed");
    void *lib = glfw->library;
    glfw->init = (int (*)(void))dlsym(lib, "glfwInit");
    glfw->terminate = (void (*)(void))dlsym(lib, "glfwTerminate");
    glfw->get_error = (int (*)(const char **))dlsym(lib, "glfwGetError");
    glfw->window_hint = (void (*)(int, int))dlsym(lib, "glfwWindowHint");
    glfw->create_window =
        (GLFWwindow * (*)(int, int, const char *, GLFWmonitor *, GLFWwindow *))
            dlsym(lib, "glfwCreateWindow");
    glfw->destroy_window = (void (*)(GLFWwindow *))dlsym(lib, "glfwDestroyWindow");
    glfw->make_current = (void (*)(GLFWwindow *))dlsym(lib, "glfwMakeContextCurrent");
    glfw->swap_interval = (void (*)(int))dlsym(lib, "glfwSwapInterval");
    glfw->swap_buffers = (void (*)(GLFWwindow *))dlsym(lib, "glfwSwapBuffers");
    glfw->get_proc = (GLFWglproc(*)(const char *))dlsym(lib, "glfwGetProcAddress");
    // The newest of these functions: a library that has it has the others.
    if (!glfw->get_error)
        return sb_fail(err, SB_NO_GL, "glfw: libglfw.so.3 is older than GLFW 3.3");
    return true;
}

static void create_window(struct glfw *glfw, bool gles, struct sb_gl_version version,
                          int creation)
{
    glfw->window_hint(GLFW_VISIBLE, GLFW_FALSE);
    glfw->window_hint(GLFW_CLIENT_API, gles ? GLFW_OPENGL_ES_API : GLFW_OPENGL_API);
    glfw->window_hint(GLFW_CONTEXT_CREATION_API, creation);
    glfw->window_hint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
    glfw->window_hint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
    glfw->window_hint(GLFW_OPENGL_PROFILE,
                      gles ? GLFW_OPENGL_ANY_PROFILE : GLFW_OPENGL_CORE_PROFILE);
    glfw->window = glfw->create_window(64, 64, "shadebench", NULL, NULL);
}

static void *glfw_open(const struct sb_context_options *options, struct sb_error *err)
{
    // GLX needs an extension for OpenGL ES, EGL has it built in: so EGL is asked first
    // there.
    const int creation[] = {
        options->gles ? GLFW_EGL_CONTEXT_API : GLFW_NATIVE_CONTEXT_API,
        options->gles ? GLFW_NATIVE_CONTEXT_API : GLFW_EGL_CONTEXT_API};
    const char *why = "no reason given";
    struct glfw *glfw = sb_alloc(sizeof *glfw);
    if (options->device >= 0) {
        sb_fail(err, SB_NO_GL, "glfw: a device can be chosen for context egl only");
        goto error;
    }
    if (!load(glfw, err))
        goto error;
    glfw->initialised = glfw->init();
    if (!glfw->initialised) {
        glfw->get_error(&why);
        sb_fail(err, SB_NO_GL,
                "glfw: %s. It needs a display; without one use context egl, or "
                "start under xvfb-run",
                why);
        goto error;
    }
    for (int i = 0; i < 2; i++) {
        const struct sb_gl_version *version = sb_gl_versions(options->gles);
        for (; version->major && !glfw->window; version++)
            create_window(glfw, options->gles, *version, creation[i]);
    }
    if (!glfw->window) {
        glfw->get_error(&why);
        sb_fail(err, SB_NO_GL, "glfw: no %s on this display: %s",
                sb_gl_wanted(options->gles), why);
        goto error;
    }
    glfw->make_current(glfw->window);
    glfw->swap_interval(0);
    return glfw;

error:
    glfw_close(glfw);
    return NULL;
}

static sb_proc glfw_proc(void *self, const char *name)
{
    struct glfw *glfw = self;
    return glfw->get_proc(name);
}

static void glfw_present(void *self)
{
    struct glfw *glfw = self;
    glfw->swap_buffers(glfw->window);
}

const struct sb_context_fns sb_context_glfw = {
    .name = "glfw",
    .help = "GLFW: a hidden window on the display",
    .open = glfw_open,
    .close = glfw_close,
    .proc = glfw_proc,
    .present = glfw_present,
};
