// Files that are replaced whole.
#include "test.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"

enum { WRITERS = 3, ROUNDS = 400, SIZE = 40000 };

static char folder[] = "/tmp/sb_base_file_XXXXXX";
static char path[64];

static bool is_whole(const char *bytes, size_t size)
{
    for (size_t i = 1; i < size; i++)
        if (bytes[i] != bytes[0])
            return false;
    return size == SIZE;
}

// Replaces the file by one of a letter of its own and reads what is there, which may be another
// process's. 0: never failed, and never saw a file that is not whole.
static int replace_and_read(char letter)
{
    static char bytes[SIZE];
    memset(bytes, letter, sizeof bytes);
    for (int round = 0; round < ROUNDS; round++) {
        struct sb_arena arena = {0};
        size_t size = 0;
        if (!sb_file_replace_shared(path, bytes, sizeof bytes, NULL))
            return 1;
        const char *seen = sb_file_read(&arena, path, 2 * SIZE, &size, NULL);
        if (!seen || !is_whole(seen, size))
            return 2;
        sb_arena_free(&arena);
    }
    return 0;
}

static void processes_that_share_a_file_never_fail_nor_see_half_of_it(void **state)
{
    (void)state;
    pid_t writer[WRITERS];
    for (int i = 0; i < WRITERS; i++) {
        writer[i] = fork();
        assert_true(writer[i] >= 0);
        if (writer[i] == 0)
            _exit(replace_and_read((char)('a' + i)));
    }
    for (int i = 0; i < WRITERS; i++) {
        int status = -1;
        assert_int_equal(waitpid(writer[i], &status, 0), writer[i]);
        assert_int_equal(status, 0);
    }
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0); // nothing temporary is left
    assert_int_equal(mkdir(folder, 0700), 0);
}

static void a_file_that_cannot_be_replaced_stays_and_is_named(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_int_equal(mkdir(path, 0700), 0);
    assert_false(sb_file_replace_shared(path, "x", 1, &err));
    assert_int_equal(err.status, SB_WRITE_FAILED);
    assert_memory_equal(err.text, path, strlen(path));
    assert_true(sb_dir_exists(path));
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(processes_that_share_a_file_never_fail_nor_see_half_of_it),
        cmocka_unit_test(a_file_that_cannot_be_replaced_stays_and_is_named),
    };
    if (!mkdtemp(folder))
        return 1;
    snprintf(path, sizeof path, "%s/file", folder);
    return run_tests(tests);
}
