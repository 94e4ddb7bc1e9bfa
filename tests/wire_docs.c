// docs/formats.md has every field of the worker protocol, and the version: who writes a worker of their
// own has nothing else to go by.
#include "test.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/file.h"
#include "base/text.h"
#include "wire/messages.h"

static char *section, *row; // of the document; the row of one call

static void read_section(struct sb_arena *arena)
{
    section = sb_file_read(arena, SB_SOURCE_DIR "/docs/formats.md", 1 << 20, NULL, NULL);
    assert_non_null(section);
    section = strstr(section, "\n## Worker protocol\n");
    assert_non_null(section);
}

static void pick_row(struct sb_arena *arena, const char *call)
{
    const char *at = strstr(section, sb_arena_printf(arena, "\n| `%s` |", call));
    if (!at)
        fail_msg("no row of %s", call);
    row = sb_arena_printf(arena, "%.*s", (int)strcspn(at + 1, "\n"), at + 1);
}

// Every key of what is sent, at any depth.
static void check_keys(struct sb_arena *arena, const json_t *json)
{
    const char *key;
    json_t *value;
    size_t i;
    json_array_foreach((json_t *)json, i, value) check_keys(arena, value);
    json_object_foreach((json_t *)json, key, value)
    {
        if (strcmp(key, "call") != 0 && !strstr(row, sb_arena_printf(arena, "`%s`", key)))
            fail_msg("%s is not in: %s", key, row);
        if (strcmp(key, "caps") != 0) // a list of its own, caps.def
            check_keys(arena, value);
    }
}

static void check_call(struct sb_arena *arena, const char *call, struct sb_frame *frame)
{
    pick_row(arena, call);
    check_keys(arena, frame->head);
    sb_frame_free(frame);
}

static void requests(struct sb_arena *arena)
{
    const char *const environment[] = {"A=B"};
    struct sb_frame frame = {.head = sb_wire_call("open")};
    sb_wire_put_open(frame.head, &(struct sb_context_params){.context = "null",
                                                             .program_cache = "cache",
                                                             .count_folder = "counts",
                                                             .environment = environment,
                                                             .environment_count = 1});
    check_call(arena, "open", &frame);

    const int number[1] = {0};
    const struct sb_program program = {.role = "shade", .vertex = "", .fragment = ""};
    const struct sb_lit lit = {.light = number, .draw = number, .draw_count = 1};
    const struct sb_job_uniform uniform = {.name = "u", .value = number};
    sb_wire_put_job(&(struct sb_job){.scene = "room",
                                     .program = &program,
                                     .program_count = 1,
                                     .lit = &lit,
                                     .lit_count = 1,
                                     .uniform = &uniform,
                                     .uniform_count = 1,
                                     .draw_count = 1},
                    &frame);
    check_call(arena, "prepare", &frame);

    frame.head = sb_wire_call("round");
    json_object_set_new(frame.head, "shots", sb_wire_pack_shots(&(struct sb_shot){0}, 1));
    check_call(arena, "round", &frame);

    struct sb_image rows;
    sb_image_init(&rows, 1, 1, 1);
    sb_wire_put_request(&(struct sb_image_request){.rows = &rows}, &frame);
    sb_image_free(&rows);
    check_call(arena, "image", &frame);
}

static void answers(struct sb_arena *arena)
{
    static const struct sb_audit audit = {
        .source = {{.name = "clock"}}, .source_count = 1, .reading_count = 1};
    static const struct sb_probe probe = {.count = 1};
    struct sb_frame frame = {.head = json_object()};
    json_object_set_new(frame.head, "audit", sb_wire_pack_audit(&audit));
    check_call(arena, "audit", &frame);

    frame.head = json_object();
    json_object_set_new(frame.head, "probe", sb_wire_pack_probe(&probe));
    check_call(arena, "probe", &frame);

    frame.head = json_object();
    sb_wire_put_prepared(&(struct sb_prepared){0}, &frame);
    json_object_del(json_object_get(frame.head, "error"), "status"); // of every call
    json_object_del(json_object_get(frame.head, "error"), "text");
    check_call(arena, "prepare", &frame);

    frame.head = json_object();
    json_object_set_new(frame.head, "sample",
                        sb_wire_pack_sample(&(struct sb_sample){0}));
    check_call(arena, "round", &frame);

    struct sb_image image;
    sb_image_init(&image, 1, 1, 1);
    frame.head = json_object();
    sb_wire_put_image(&image, &frame);
    sb_image_free(&image);
    check_call(arena, "image", &frame);
}

static void the_document_has_every_field_of_every_call(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    read_section(&arena);
    requests(&arena);
    answers(&arena);
    sb_arena_free(&arena);
}

static void the_document_has_the_version(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    read_section(&arena);
    check_contains(section, sb_arena_printf(&arena, "`version` is %d,", SB_WIRE_VERSION));
    sb_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_document_has_every_field_of_every_call),
        cmocka_unit_test(the_document_has_the_version),
    };
    return run_tests(tests);
}
