#include <stdlib.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/mem.h"
#include "gl/program_cache.h"
#include "job/program_file.h"

struct sb_gl_program_cache {
    char *dir;
    uint64_t driver;
    bool told;      // of a file that was rejected
    bool read_only; // one could not be written
};

struct sb_gl_program_cache *sb_gl_program_cache_open(const char *dir,
                                                     const struct sb_caps *caps)
{
    struct sb_error err = {0};
    if (caps->program_binary == 0) {
        sb_warn(
            "program cache %s: %s gives no program binaries; all programs are compiled",
            dir, caps->renderer);
        return NULL;
    }
    if (!sb_dir_make(dir, &err)) {
        sb_warn("program cache: %s; all programs are compiled", err.text);
        return NULL;
    }
    struct sb_gl_program_cache *cache = sb_alloc(sizeof *cache);
    cache->dir = sb_strdup(dir);
    cache->driver = sb_program_key_driver(caps);
    return cache;
}

void sb_gl_program_cache_close(struct sb_gl_program_cache *cache)
{
    if (cache)
        free(cache->dir);
    free(cache);
}

static void reject(struct sb_gl_program_cache *cache, const char *why)
{
    if (cache->told)
        sb_debug("program cache: %s", why);
    else
        sb_warn(
            "program cache: %s; it is compiled again, as are others that are no better",
            why);
    cache->told = true;
}

// The program of a binary, or 0 where the driver does not want it.
static GLuint load_binary(const struct sb_program_file *file)
{
    const GLuint name = glCreateProgram();
    GLint done = GL_FALSE;
    glProgramBinary(name, file->format, file->binary, (GLsizei)file->size);
    glGetProgramiv(name, GL_LINK_STATUS, &done);
    if (done)
        return name;
    sb_gl_error(); // GL_INVALID_ENUM: a format of another driver
    glDeleteProgram(name);
    return 0;
}

static bool load(struct sb_gl_program_cache *cache, const char *path,
                 const struct sb_program_key *key, struct sb_gl_program *program)
{
    struct sb_arena arena = {0};
    struct sb_program_file file = {0};
    struct sb_error err = {0};
    size_t size = 0;
    *program = (struct sb_gl_program){0};
    if (!sb_file_exists(path))
        return false;
    const int64_t start = sb_clock_ns();
    const char *data = sb_file_read(&arena, path, SB_PROGRAM_FILE_LIMIT, &size, &err);
    if (data && sb_program_file_decode(data, size, path, key, &file, &err)) {
        program->name = load_binary(&file);
        if (program->name == 0)
            sb_fail(&err, SB_BAD_INPUT, "%s: the driver refuses this binary", path);
    }
    if (program->name != 0) {
        program->link_ms = (double)(sb_clock_ns() - start) / 1e6;
        program->binary_hash = sb_hash(SB_HASH_START, file.binary, file.size);
        program->cached = true;
    } else {
        reject(cache, err.text);
    }
    sb_arena_free(&arena);
    return program->cached;
}

static void store(struct sb_gl_program_cache *cache, const char *path,
                  const struct sb_program_key *key, const struct sb_gl_program *program)
{
    struct sb_error err = {0};
    GLenum format = 0;
    size_t binary_size = 0, size = 0;
    unsigned char *binary = sb_gl_program_binary(program->name, &format, &binary_size);
    const struct sb_program_file file = {*key, format, binary, binary_size};
    unsigned char *data = binary ? sb_program_file_encode(&file, &size) : NULL;
    if (data && !sb_file_replace_shared(path, (const char *)data, size, &err)) {
        sb_warn("program cache: %s; no more programs are kept", err.text);
        cache->read_only = true;
    }
    free(data);
    free(binary);
}

bool sb_gl_program_cached(struct sb_gl_program_cache *cache,
                          const struct sb_program *source, struct sb_gl_program *program)
{
    if (!cache)
        return sb_gl_program_make(source, program);
    const struct sb_program_parts parts = {
        .source = source,
        .attribute = sb_gl_attributes,
        .attribute_count = SB_GL_ATTRIBUTES,
    };
    const struct sb_program_key key = {cache->driver, sb_program_key_sources(&parts)};
    char name[SB_PROGRAM_FILE_NAME];
    struct sb_arena arena = {0};
    sb_program_file_name(&key, name);
    const char *path = sb_path_join(&arena, cache->dir, name);
    bool ok = load(cache, path, &key, program);
    if (!ok) {
        ok = sb_gl_program_make(source, program);
        if (ok && !cache->read_only)
            store(cache, path, &key, program);
    }
    sb_arena_free(&arena);
    return ok;
}
