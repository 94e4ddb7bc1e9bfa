// The files of a program cache, as docs/formats.md has them, whole and damaged.
#include "test.h"

#include "job/program_file.h"
#include "math/random.h"

enum { BINARY = 75, SIZE = SB_PROGRAM_FILE_HEADER + BINARY };

static const struct sb_program_key key = {0x1122334455667788u, 0x99aabbccddeeff00u};
static unsigned char binary[BINARY];

static unsigned char *encode(size_t *size)
{
    for (int i = 0; i < BINARY; i++)
        binary[i] = (unsigned char)(i * 37 + 5);
    const struct sb_program_file file = {key, 0x8741, binary, BINARY};
    unsigned char *data = sb_program_file_encode(&file, size);
    assert_non_null(data);
    return data;
}

// In a block of exactly that size, so that a sanitiser sees a byte read too many.
static bool decodes(const unsigned char *data, size_t size, struct sb_program_file *file,
                    struct sb_error *err)
{
    unsigned char *exact = malloc(size ? size : 1);
    memcpy(exact, data, size);
    *err = (struct sb_error){0};
    const bool ok = sb_program_file_decode(exact, size, "here", &key, file, err);
    free(exact);
    return ok;
}

static void check_rejected(const unsigned char *data, size_t size, const char *why)
{
    struct sb_program_file file;
    struct sb_error err;
    if (decodes(data, size, &file, &err))
        fail_msg("accepted where \"%s\" was expected", why);
    assert_int_equal(err.status, SB_BAD_INPUT);
    assert_memory_equal(err.text, "here: ", 6);
    check_contains(err.text, why);
}

static void a_file_has_the_documented_bytes(void **state)
{
    (void)state;
    static const unsigned char head[] = {
        'S',    'B',  'P',  'R',  'O',  'G',  '\r', '\n', // magic
        1,      0,    0,    0,                            // version
        0x41,   0x87, 0,    0,                            // format
        0x88,   0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11, // driver
        0x00,   0xff, 0xee, 0xdd, 0xcc, 0xbb, 0xaa, 0x99, // sources
        BINARY, 0,    0,    0,    0,    0,    0,    0,    // size
    };
    size_t size;
    unsigned char *data = encode(&size);
    assert_int_equal(size, SIZE);
    assert_memory_equal(data, head, sizeof head);
    assert_memory_equal(data + SB_PROGRAM_FILE_HEADER, binary, BINARY);
    // FNV-1a as its authors have it: isthe.com/chongo/tech/comp/fnv
    uint64_t sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        if (i < 40 || i >= 48)
            sum = (sum ^ data[i]) * 0x100000001b3u;
    for (int i = 0; i < 8; i++)
        assert_int_equal(data[40 + i], sum >> (8 * i) & 255);
    free(data);
}

static void what_was_written_is_read(void **state)
{
    (void)state;
    size_t size;
    unsigned char *data = encode(&size);
    struct sb_program_file file;
    struct sb_error err = {0};
    assert_true(sb_program_file_decode(data, size, "here", &key, &file, &err));
    assert_int_equal(file.format, 0x8741);
    assert_int_equal(file.size, BINARY);
    assert_memory_equal(file.binary, binary, BINARY);
    free(data);
}

static void every_flipped_bit_is_noticed(void **state)
{
    (void)state;
    size_t size;
    unsigned char *data = encode(&size);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        check_rejected(data, size,
                       bit < 64                  ? "no file of a program"
                       : bit < 96                ? "version"
                       : bit >= 256 && bit < 320 ? "bytes of a binary of"
                                                 : "checksum");
        data[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    free(data);
}

static void every_other_length_is_noticed(void **state)
{
    (void)state;
    size_t size;
    unsigned char *data = encode(&size);
    unsigned char longer[SIZE + 9] = {0};
    memcpy(longer, data, size);
    for (size_t length = 0; length < size; length++)
        check_rejected(longer, length,
                       length < SB_PROGRAM_FILE_HEADER ? "has more than 48"
                                                       : "bytes of a binary of 75");
    for (size_t length = size + 1; length <= sizeof longer; length++)
        check_rejected(longer, length, "bytes of a binary of 75");
    free(data);
}

static void random_damage_is_noticed(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(20240611);
    size_t size;
    unsigned char *data = encode(&size);
    for (int round = 0; round < 20000; round++) {
        unsigned char bytes[SIZE];
        memcpy(bytes, data, size);
        const size_t length =
            sb_random_below(&random, 4) ? size : sb_random_below(&random, size);
        const uint64_t changes = 1 + sb_random_below(&random, 8);
        for (uint64_t i = 0; i < changes; i++)
            bytes[sb_random_below(&random, size)] = (unsigned char)sb_random_u64(&random);
        struct sb_program_file file;
        struct sb_error err;
        const bool same = length == size && memcmp(bytes, data, size) == 0;
        assert_int_equal(decodes(bytes, length, &file, &err), same);
    }
    free(data);
}

static void files_of_another_key_are_told_apart(void **state)
{
    (void)state;
    for (int part = 0; part < 2; part++) {
        const struct sb_program_file file = {
            {key.driver + (part == 0), key.sources + (part == 1)}, 1, "x", 1};
        size_t size;
        unsigned char *data = sb_program_file_encode(&file, &size);
        check_rejected(data, size, part == 0 ? "another driver" : "another program");
        free(data);
    }
}

static void empty_and_huge_binaries_are_not_kept(void **state)
{
    (void)state;
    size_t size;
    struct sb_program_file file = {key, 1, "", 0};
    assert_null(sb_program_file_encode(&file, &size));
    file.size = SB_PROGRAM_FILE_LIMIT - SB_PROGRAM_FILE_HEADER + 1;
    assert_null(sb_program_file_encode(&file, &size)); // reads none of it
    file.size = SIZE_MAX;
    assert_null(sb_program_file_encode(&file, &size));
}

static void names_are_those_of_their_keys(void **state)
{
    (void)state;
    char name[SB_PROGRAM_FILE_NAME];
    sb_program_file_name(&key, name);
    assert_string_equal(name, "1122334455667788-99aabbccddeeff00.program");
}

// --- keys --------------------------------------------------------------------------------------

static void each_word_of_a_driver_is_in_its_key(void **state)
{
    (void)state;
    struct sb_caps caps = {0};
    uint64_t seen[7];
    seen[0] = sb_program_key_driver(&caps);
    char *const words[] = {caps.vendor, caps.renderer, caps.version, caps.glsl_version,
                           caps.context};
    for (int i = 0; i < 5; i++) {
        words[i][0] = 'x'; // the same letter: places count, too
        seen[i + 1] = sb_program_key_driver(&caps);
        words[i][0] = '\0';
    }
    caps.gles = 1;
    seen[6] = sb_program_key_driver(&caps);
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < i; j++)
            assert_true(seen[i] != seen[j]);
}

static void each_text_of_a_program_is_in_its_key(void **state)
{
    (void)state;
    static const char *const ab[] = {"a", "b"}, *const ba[] = {"b", "a"},
                             *const joined[] = {"ab"},
                             *const glued[] = {"a\1"
                                               "b"};
    const struct sb_program sources[] = {
        {"shade", "v", NULL, "f"}, {"shade", "v", "", "f"},   {"shade", "v", "g", "f"},
        {"shade", "vf", NULL, ""}, {"shade", "f", NULL, "v"}, {"shade", "v", NULL, "f "},
    };
    const struct sb_program_parts parts[] = {
        {&sources[0], NULL, NULL, 0, 0},   {&sources[1], NULL, NULL, 0, 0},
        {&sources[2], NULL, NULL, 0, 0},   {&sources[3], NULL, NULL, 0, 0},
        {&sources[4], NULL, NULL, 0, 0},   {&sources[5], NULL, NULL, 0, 0},
        {&sources[0], ab, NULL, 2, 0},     {&sources[0], ba, NULL, 2, 0},
        {&sources[0], joined, NULL, 1, 0}, {&sources[0], NULL, ab, 0, 2},
        {&sources[0], NULL, ba, 0, 2},     {&sources[0], ab, ab, 1, 1},
        {&sources[0], glued, NULL, 1, 0},
    };
    enum { COUNT = sizeof parts / sizeof *parts };
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < i; j++)
            if (sb_program_key_sources(&parts[i]) == sb_program_key_sources(&parts[j]))
                fail_msg("programs %d and %d have one key", i, j);
    struct sb_program lamp = sources[0];
    lamp.role = "lamp";
    assert_true(sb_program_key_sources(&(struct sb_program_parts){.source = &lamp}) ==
                sb_program_key_sources(&parts[0]));
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_has_the_documented_bytes),
        cmocka_unit_test(what_was_written_is_read),
        cmocka_unit_test(every_flipped_bit_is_noticed),
        cmocka_unit_test(every_other_length_is_noticed),
        cmocka_unit_test(random_damage_is_noticed),
        cmocka_unit_test(files_of_another_key_are_told_apart),
        cmocka_unit_test(empty_and_huge_binaries_are_not_kept),
        cmocka_unit_test(names_are_those_of_their_keys),
        cmocka_unit_test(each_word_of_a_driver_is_in_its_key),
        cmocka_unit_test(each_text_of_a_program_is_in_its_key),
    };
    return run_tests(tests);
}
