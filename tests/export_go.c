// Go's benchmark text, read by a parser of golang.org/design/14313-benchmark-format.
#include "export_rows.h"

#include <ctype.h>

// --- the parser -----------------------------------------------------------------------------

struct result {
    char name[160];
    long iterations;
    double value[4];
    char unit[4][16];
    int values;
};
struct document {
    char config[16][2][96]; // key, value
    int configs;
    char units[8][64]; // what stands behind `Unit`
    int unit_count;
    struct result result[32];
    int results, ignored;
};

// "key: value": no blanks and no capitals in the key, which starts with a small letter.
static bool take_config(struct document *document, const char *line)
{
    const char *colon = strchr(line, ':');
    if (!colon || !islower((unsigned char)line[0]) || (colon[1] && colon[1] != ' '))
        return false;
    for (const char *p = line; p < colon; p++)
        if (isspace((unsigned char)*p) || isupper((unsigned char)*p))
            return false;
    assert_in_range(document->configs, 0, 15);
    char(*pair)[96] = document->config[document->configs++];
    snprintf(pair[0], 96, "%.*s", (int)(colon - line), line);
    snprintf(pair[1], 96, "%s", colon + 1 + strspn(colon + 1, " "));
    return true;
}

// An even number of fields, and four at least.
static void take_result(struct document *document, char *line)
{
    char *fields[16], *rest = line, *end;
    int count = 0;
    for (char *field; count < 16 && (field = strtok_r(rest, " \t", &rest));)
        fields[count++] = field;
    if (count < 4 || count % 2 || count > 10)
        fail_msg("%d fields in a result", count);
    assert_in_range(document->results, 0, 31);
    struct result *result = &document->result[document->results++];
    snprintf(result->name, sizeof result->name, "%s", fields[0] + strlen("Benchmark"));
    result->iterations = strtol(fields[1], &end, 10);
    assert_true(!*end && result->iterations > 0);
    for (int i = 2; i < count; i += 2) {
        result->value[result->values] = strtod(fields[i], &end);
        assert_true(!*end && isfinite(result->value[result->values]));
        snprintf(result->unit[result->values++], 16, "%s", fields[i + 1]);
    }
}

static void parse(struct document *document, char *text)
{
    memset(document, 0, sizeof *document);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        if (strncmp(line, "Benchmark", 9) == 0)
            take_result(document, line);
        else if (strncmp(line, "Unit ", 5) == 0)
            snprintf(document->units[document->unit_count++], 64, "%s", line + 5);
        else if (!take_config(document, line))
            document->ignored++;
    }
}

static void write_and_parse(struct document *document, const struct sb_export *export)
{
    char *text = written("go", export);
    parse(document, text);
    free(text);
}

// --- the tests ------------------------------------------------------------------------------

static void there_is_a_line_a_sample_and_units_say_what_is_better(void **state)
{
    (void)state;
    static struct document document;
    write_and_parse(&document, &run_export);
    assert_int_equal(document.results, 4 + 1);
    for (int i = 0; i < 4; i++) {
        const struct result *result = &document.result[i];
        // Keys that benchstat can make columns of; the last number is that of processors.
        assert_string_equal(result->name, "Room/point=8/stage=fragment-1");
        assert_int_equal(result->iterations, 7);
        assert_int_equal(result->values, 2);
        check_close(result->value[0], (i + 1) * 1e6, 0);
        assert_string_equal(result->unit[0], "ns/op");
        check_close(result->value[1], i < 3 ? 2e6 : 6e6, 0);
        assert_string_equal(result->unit[1], "cpu-ns/op");
    }
    assert_int_equal(document.unit_count, 2);
    assert_string_equal(document.units[0], "ns/op better=lower");
    assert_string_equal(document.units[1], "cpu-ns/op better=lower");
}

static void blanks_and_slashes_of_a_value_do_not_end_it(void **state)
{
    (void)state;
    static struct document document;
    write_and_parse(&document, &run_export);
    const struct result *result = &document.result[4];
    assert_string_equal(result->name, "Plane/form=\"a/_b\"/<c>&d|e_f_g_é\xEF\xBF\xBD-1");
    assert_int_equal(result->iterations, 1); // the batch is not known
    assert_int_equal(result->values, 1);     // and neither is the CPU time
}

// benchstat compares within one set of configuration lines.
static void what_is_of_one_run_alone_is_no_configuration(void **state)
{
    (void)state;
    static struct document document;
    write_and_parse(&document, &run_export);
    assert_int_equal(document.configs, 2);
    assert_string_equal(document.config[0][0], "renderer");
    assert_string_equal(document.config[0][1], "pipe | \"r\" <1>");
    assert_string_equal(document.config[1][0], "num_cpus");
    assert_int_equal(document.ignored, 3); // the name, load_avg and seed
}

static void the_sides_of_a_pair_are_a_key(void **state)
{
    (void)state;
    static struct document document;
    write_and_parse(&document, &pair_export);
    assert_int_equal(document.results, 4);
    assert_string_equal(document.result[0].name, "Room/point=8/side=base-1");
    assert_string_equal(document.result[1].name, "Room/point=8/side=head-1");
}

static void instructions_have_a_unit_of_their_own(void **state)
{
    (void)state;
    static struct document document;
    write_and_parse(&document, &untimed_export);
    assert_int_equal(document.results, 4);
    for (int i = 0; i < 4; i++) {
        const struct result *result = &document.result[i];
        assert_string_equal(result->name, i < 2 ? "Room/point=8/side=base-1"
                                                : "Room/point=8/side=head-1");
        assert_int_equal(result->values, 1);
        assert_string_equal(result->unit[0], "Ir/op");
        check_close(result->value[0], two_counts[i % 2], 0);
    }
    assert_int_equal(document.unit_count, 3);
    assert_string_equal(document.units[2], "Ir/op better=lower");
}

// A driver's name may hold anything; it stays one line.
static void a_line_end_in_a_property_starts_no_line(void **state)
{
    (void)state;
    static struct document document;
    const struct sb_export_property property = {
        "renderer", "a\nBenchmarkX 1 2 ns/op\r\xFF", SB_EXPORT_TEXT, 0};
    write_and_parse(&document, &(struct sb_export){.name = "n\nx: y",
                                                   .property = &property,
                                                   .property_count = 1});
    assert_int_equal(document.results, 0);
    assert_int_equal(document.configs, 1);
    assert_string_equal(document.config[0][1], "a BenchmarkX 1 2 ns/op \xEF\xBF\xBD");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_is_a_line_a_sample_and_units_say_what_is_better),
        cmocka_unit_test(blanks_and_slashes_of_a_value_do_not_end_it),
        cmocka_unit_test(what_is_of_one_run_alone_is_no_configuration),
        cmocka_unit_test(the_sides_of_a_pair_are_a_key),
        cmocka_unit_test(instructions_have_a_unit_of_their_own),
        cmocka_unit_test(a_line_end_in_a_property_starts_no_line),
    };
    return run_tests(tests);
}
