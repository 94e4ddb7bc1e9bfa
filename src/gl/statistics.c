#include "gl/statistics.h"

#include <string.h>

enum { TEXT_MAX = 2000 };

static void GLAD_API_PTR collect(GLenum source, GLenum type, GLuint id, GLenum severity,
                                 GLsizei length, const GLchar *message, const void *user)
{
    // The callback's pointer is const by its signature; the text behind it is the caller's.
    struct sb_text *text = (struct sb_text *)(uintptr_t)user;
    (void)id, (void)severity;
    const size_t size = length < 0 ? strlen(message) : (size_t)length;
    if (source != GL_DEBUG_SOURCE_SHADER_COMPILER || type != GL_DEBUG_TYPE_OTHER ||
        text->length + size > TEXT_MAX)
        return;
    if (text->length)
        sb_text_add(text, "; ");
    for (size_t i = 0; i < size; i++) // one line in a table
        if (message[i] != '\n' || i + 1 < size)
            sb_text_add_n(text, message[i] == '\n' ? " " : &message[i], 1);
}

void sb_gl_statistics_begin(struct sb_text *text)
{
    if (!glDebugMessageCallback)
        return;
    glDebugMessageCallback(collect, text);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glEnable(GL_DEBUG_OUTPUT);
}

void sb_gl_statistics_end(void)
{
    if (!glDebugMessageCallback)
        return;
    glDisable(GL_DEBUG_OUTPUT);
    glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(NULL, NULL);
}
