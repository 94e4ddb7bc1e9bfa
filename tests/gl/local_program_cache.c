// The program cache, seen from above the seam: what is loaded draws what was compiled, bit for bit,
// and whatever has happened to a file, it is rejected once and made anew.
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "job/program_file.h"
#include "gl/program_cache.h"
#include "local_jobs.h"

enum { JOB = 1, PROGRAMS = 2 }; // "shade" and "lamp"

static char folder[] = "/tmp/sb_program_cache_XXXXXX";
static char cache_dir[64], log_file[64];

// --- the folder ----------------------------------------------------------------------------------

static void clear(const char *dir)
{
    DIR *listing = opendir(dir);
    for (struct dirent *entry; listing && (entry = readdir(listing));) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", dir, entry->d_name);
        if (entry->d_name[0] != '.' && unlink(path) != 0)
            rmdir(path);
    }
    if (listing)
        closedir(listing);
}

// The cache's files, sorted by name.
static int list(char paths[static PROGRAMS][256])
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    int count = 0;
    char **names = sb_dir_list(&arena, cache_dir, SB_PROGRAM_FILE_SUFFIX, &count, &err);
    assert_non_null(names);
    for (int i = 0; i < count && i < PROGRAMS; i++)
        snprintf(paths[i], 256, "%s/%s", cache_dir, names[i]);
    sb_arena_free(&arena);
    return count;
}

struct bytes {
    unsigned char *data;
    size_t size;
};

static struct bytes read_bytes(const char *path)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    struct bytes bytes = {0};
    const char *data = sb_file_read(&arena, path, 1 << 24, &bytes.size, &err);
    if (!data)
        fail_msg("%s", err.text);
    bytes.data = malloc(bytes.size + 1);
    memcpy(bytes.data, data, bytes.size);
    sb_arena_free(&arena);
    return bytes;
}

static void write_bytes(const char *path, const void *data, size_t size)
{
    struct sb_error err = {0};
    assert_true(sb_file_replace(path, data, size, &err));
}

// --- one process's worth of a run ------------------------------------------------------------------

struct drawn {
    struct sb_prepared prepared;
    struct sb_image image;
    int warnings; // of the program cache
    char warning[1024];
};

// Lines of stderr from here on go to the log.
static int divert(void)
{
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    const int log = open(log_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    assert_true(kept >= 0 && log >= 0);
    dup2(log, STDERR_FILENO);
    close(log);
    return kept;
}

static void restore(int kept, struct drawn *drawn)
{
    char line[1024];
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    FILE *log = fopen(log_file, "r");
    while (log && fgets(line, sizeof line, log)) {
        if (!strstr(line, "program cache"))
            continue;
        drawn->warnings++;
        snprintf(drawn->warning, sizeof drawn->warning, "%s", line);
    }
    if (log)
        fclose(log);
}

// Opens a runner on the cache (NULL: none), draws the job, and closes the runner.
static void draw(const char *cache, struct drawn *drawn)
{
    struct sb_error err = {0};
    struct text_job it;
    const struct sb_context_params params = {.context = gl_test_context(),
                                             .gles = gl_test_gles(),
                                             .device = -1,
                                             .program_cache = cache};
    *drawn = (struct drawn){0};
    const int kept = divert();
    runner = fns->open(&params, &caps, &err);
    if (runner) {
        lit_init(&it, JOB, AS_ARRAYS);
        job_add_lamp(&it, lamp);
        if (fns->prepare(runner, &it.job, &drawn->prepared)) {
            const struct sb_image_request request = {.job = JOB, .kind = SB_IMAGE_COLOUR};
            fns->image(runner, &request, &drawn->image, &err);
        } else {
            err = drawn->prepared.error;
        }
        job_free(&it);
        fns->close(runner);
        runner = NULL;
    }
    restore(kept, drawn);
    if (!drawn->image.data)
        fail_msg("%s", err.text);
}

static struct drawn plain; // without a cache

// Draws with the cache, of which `cached` programs are good; with `why` the rest are rejected with
// one warning. Afterwards all are good.
static void check_drawn(int cached, const char *why)
{
    struct drawn drawn;
    draw(cache_dir, &drawn);
    assert_int_equal(drawn.prepared.programs_cached, cached);
    assert_int_equal(differing(&drawn.image, &plain.image), 0);
    assert_int_equal(drawn.warnings, why != NULL);
    if (why)
        check_contains(drawn.warning, why);
    sb_image_free(&drawn.image);
}

static void need_binaries(void)
{
    if (caps.program_binary == 0)
        skip();
}

// Both files as the driver made them.
static void fill(char paths[static PROGRAMS][256])
{
    need_binaries();
    clear(cache_dir);
    check_drawn(0, NULL);
    assert_int_equal(list(paths), PROGRAMS);
}

// --- tests -----------------------------------------------------------------------------------------

static void a_loaded_program_draws_what_the_compiled_one_does(void **state)
{
    (void)state;
    need_binaries();
    struct drawn cold, warm;
    clear(cache_dir);
    draw(cache_dir, &cold);
    draw(cache_dir, &warm);
    assert_int_equal(cold.prepared.programs_cached, 0);
    assert_int_equal(warm.prepared.programs_cached, PROGRAMS);
    assert_int_equal(cold.warnings + warm.warnings, 0);
    assert_int_equal(differing(&cold.image, &plain.image), 0);
    assert_int_equal(differing(&warm.image, &plain.image), 0);
    assert_true(cold.prepared.compile_ms > 0);
    assert_true(warm.prepared.compile_ms == 0);
    assert_true(warm.prepared.link_ms > 0);
    assert_true(warm.prepared.binary_hash == cold.prepared.binary_hash);
    sb_image_free(&cold.image);
    sb_image_free(&warm.image);
}

static void without_a_folder_nothing_is_loaded(void **state)
{
    (void)state;
    struct drawn drawn;
    draw(NULL, &drawn);
    assert_int_equal(drawn.prepared.programs_cached, 0);
    assert_true(drawn.prepared.compile_ms > 0);
    assert_int_equal(drawn.warnings, 0);
    assert_int_equal(differing(&drawn.image, &plain.image), 0);
    sb_image_free(&drawn.image);
}

static void a_flipped_byte_is_rejected_and_rebuilt(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    struct bytes whole = read_bytes(paths[0]);
    // Magic, version, format, driver, sources, size, checksum, and the binary.
    const size_t places[] = {
        0, 8, 12, 16, 24, 32, 39, 40, 48, 60, 48 + (whole.size - 48) / 2, whole.size - 1};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        whole.data[places[i]] ^= 0x55;
        write_bytes(paths[0], whole.data, whole.size);
        whole.data[places[i]] ^= 0x55;
        check_drawn(PROGRAMS - 1, paths[0]);
        check_drawn(PROGRAMS, NULL);
    }
    free(whole.data);
}

static void a_file_cut_short_is_rejected_and_rebuilt(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    struct bytes whole = read_bytes(paths[0]);
    const size_t lengths[] = {0, 1, 8, 47, 48, 49, whole.size / 2, whole.size - 1};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        write_bytes(paths[0], whole.data, lengths[i]);
        check_drawn(PROGRAMS - 1, paths[0]);
        check_drawn(PROGRAMS, NULL);
    }
    free(whole.data);
}

static void several_bad_files_are_one_warning(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    for (int i = 0; i < PROGRAMS; i++)
        write_bytes(paths[i], "garbage", 7);
    check_drawn(0, "compiled again");
    check_drawn(PROGRAMS, NULL);
}

// The file with another key, format or binary, and a checksum that fits.
static void write_changed(const char *path, const struct bytes *whole, uint64_t driver,
                          uint32_t format, uint8_t flip)
{
    struct sb_program_file file = {0};
    struct bytes binary = {malloc(whole->size), whole->size - SB_PROGRAM_FILE_HEADER};
    memcpy(binary.data, whole->data + SB_PROGRAM_FILE_HEADER, binary.size);
    binary.data[binary.size / 2] ^= flip;
    memcpy(&file.key, whole->data + 16, sizeof file.key); // little-endian machines only
    memcpy(&file.format, whole->data + 12, sizeof file.format);
    file.key.driver ^= driver;
    file.format ^= format;
    file.binary = binary.data;
    file.size = binary.size;
    size_t size;
    unsigned char *data = sb_program_file_encode(&file, &size);
    write_bytes(path, data, size);
    free(data);
    free(binary.data);
}

static void what_another_driver_made_is_rejected_and_rebuilt(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    struct bytes whole = read_bytes(paths[0]);
    write_changed(paths[0], &whole, 1, 0, 0);
    check_drawn(PROGRAMS - 1, "another driver");
    check_drawn(PROGRAMS, NULL);
    free(whole.data);
}

static void what_the_driver_refuses_is_rejected_and_rebuilt(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    struct bytes whole = read_bytes(paths[0]);
    write_changed(paths[0], &whole, 0, 0x4000, 0);
    check_drawn(PROGRAMS - 1, "the driver refuses");
    check_drawn(PROGRAMS, NULL);
    // Mesa has a checksum of its own; other drivers need not.
    if (strstr(caps.version, "Mesa")) {
        write_changed(paths[0], &whole, 0, 0, 0x10);
        check_drawn(PROGRAMS - 1, "the driver refuses");
        check_drawn(PROGRAMS, NULL);
    }
    free(whole.data);
}

static void another_programs_file_under_this_name_is_rejected_and_rebuilt(void **state)
{
    (void)state;
    char paths[PROGRAMS][256];
    fill(paths);
    struct bytes other = read_bytes(paths[1]);
    write_bytes(paths[0], other.data, other.size);
    check_drawn(PROGRAMS - 1, "another program");
    check_drawn(PROGRAMS, NULL);
    free(other.data);
}

static void a_folder_that_cannot_be_made_is_no_cache(void **state)
{
    (void)state;
    struct drawn drawn;
    char below[128];
    need_binaries();
    write_bytes(log_file, "", 0);
    snprintf(below, sizeof below, "%s/below", log_file); // a file is no folder
    draw(below, &drawn);
    assert_int_equal(drawn.prepared.programs_cached, 0);
    assert_int_equal(drawn.warnings, 1);
    check_contains(drawn.warning, "all programs are compiled");
    assert_int_equal(differing(&drawn.image, &plain.image), 0);
    sb_image_free(&drawn.image);
}

static void files_that_cannot_be_written_are_one_warning(void **state)
{
    (void)state;
    char paths[PROGRAMS][256], temporary[600];
    fill(paths);
    clear(cache_dir);
    // Where the temporary files would be: root may write to a folder of any mode.
    for (int i = 0; i < PROGRAMS; i++) {
        snprintf(temporary, sizeof temporary, "%s.%ld.tmp", paths[i], (long)getpid());
        assert_int_equal(mkdir(temporary, 0700), 0);
    }
    check_drawn(0, "no more programs are kept");
    assert_int_equal(list(paths), 0);
    clear(cache_dir);
}

static void a_driver_without_binaries_has_no_cache(void **state)
{
    (void)state;
    struct sb_caps none = caps;
    struct drawn drawn = {0};
    none.program_binary = 0;
    const int kept = divert();
    assert_null(sb_gl_program_cache_open(cache_dir, &none));
    restore(kept, &drawn);
    assert_int_equal(drawn.warnings, 1);
    check_contains(drawn.warning, "gives no program binaries");
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_loaded_program_draws_what_the_compiled_one_does),
        cmocka_unit_test(without_a_folder_nothing_is_loaded),
        cmocka_unit_test(a_flipped_byte_is_rejected_and_rebuilt),
        cmocka_unit_test(a_file_cut_short_is_rejected_and_rebuilt),
        cmocka_unit_test(several_bad_files_are_one_warning),
        cmocka_unit_test(what_another_driver_made_is_rejected_and_rebuilt),
        cmocka_unit_test(what_the_driver_refuses_is_rejected_and_rebuilt),
        cmocka_unit_test(another_programs_file_under_this_name_is_rejected_and_rebuilt),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_no_cache),
        cmocka_unit_test(files_that_cannot_be_written_are_one_warning),
        cmocka_unit_test(a_driver_without_binaries_has_no_cache),
    };
    struct gl_test test;
    gl_test_open(&test); // skips where there is no such context
    gl_test_close(&test);
    if (!mkdtemp(folder))
        return 1;
    snprintf(cache_dir, sizeof cache_dir, "%s/cache", folder);
    snprintf(log_file, sizeof log_file, "%s/log", folder);
    draw(NULL, &plain);
    const int failed = run_tests(tests);
    sb_image_free(&plain.image);
    clear(cache_dir);
    rmdir(cache_dir);
    clear(folder);
    rmdir(folder);
    return failed;
}
