// JUnit XML, read back by a strict parser of what XML 1.0 wants of such a document.
#include "test.h"

#include "results/junit.h"

// --- the parser -----------------------------------------------------------------------------

enum { ELEMENTS_MAX = 64, ATTRIBUTES_MAX = 8, TEXT_MAX = 256 };

struct element {
    char name[32];
    struct {
        char name[32], value[TEXT_MAX];
    } attribute[ATTRIBUTES_MAX];
    int attribute_count;
    char text[TEXT_MAX]; // its own, without that of its children
    int parent;          // -1: the root
};

struct document {
    const char *at, *error; // error: what was wrong first; NULL: nothing
    struct element element[ELEMENTS_MAX];
    int count;
};

static void wrong(struct document *document, const char *what)
{
    if (!document->error)
        document->error = what;
}

static bool take(struct document *document, const char *word)
{
    const size_t length = strlen(word);
    if (strncmp(document->at, word, length) != 0)
        return false;
    document->at += length;
    return true;
}

static void take_name(struct document *document, char name[32])
{
    const size_t length = strspn(document->at, "abcdefghijklmnopqrstuvwxyz-");
    if (length == 0 || length > 31)
        wrong(document, "no name");
    snprintf(name, 32, "%.*s", (int)length, document->at);
    document->at += length;
}

// One character or reference, appended to `to`.
static void take_character(struct document *document, char *to, bool attribute)
{
    static const struct {
        const char *reference;
        char character;
    } references[] = {
        {"&lt;", '<'},  {"&gt;", '>'},   {"&amp;", '&'},  {"&quot;", '"'},
        {"&#9;", '\t'}, {"&#10;", '\n'}, {"&#13;", '\r'},
    };
    const size_t length = strlen(to);
    char one = '\0';
    for (size_t i = 0; !one && i < sizeof references / sizeof *references; i++)
        if (take(document, references[i].reference))
            one = references[i].character;
    if (!one) {
        one = *document->at++;
        const unsigned char byte = (unsigned char)one;
        if (one == '&')
            wrong(document, "an unknown reference");
        if (byte < 0x20 && (attribute || (one != '\n' && one != '\t')))
            wrong(document, "a control character");
        if (one == '<')
            wrong(document, "a bare <");
        if (one == '>')
            wrong(document, "a bare >");
    }
    if (length + 1 >= TEXT_MAX) {
        wrong(document, "too long a text");
        return;
    }
    to[length] = one;
    to[length + 1] = '\0';
}

static void take_attributes(struct document *document, struct element *element)
{
    while (!document->error && take(document, " ")) {
        if (element->attribute_count == ATTRIBUTES_MAX) {
            wrong(document, "too many attributes");
            return;
        }
        char *name = element->attribute[element->attribute_count].name;
        char *value = element->attribute[element->attribute_count].value;
        take_name(document, name);
        for (int i = 0; i < element->attribute_count; i++)
            if (strcmp(element->attribute[i].name, name) == 0)
                wrong(document, "an attribute twice");
        element->attribute_count++;
        if (!take(document, "=\""))
            wrong(document, "an attribute without a value");
        while (!document->error && !take(document, "\"")) {
            if (!*document->at)
                wrong(document, "an open attribute");
            else
                take_character(document, value, true);
        }
    }
}

static void take_element(struct document *document, int parent)
{
    if (document->count == ELEMENTS_MAX || !take(document, "<")) {
        wrong(document, "no element, or too many");
        return;
    }
    const int place = document->count++;
    struct element *element = &document->element[place];
    element->parent = parent;
    take_name(document, element->name);
    take_attributes(document, element);
    if (take(document, "/>"))
        return;
    if (!take(document, ">"))
        wrong(document, "an open tag");
    while (!document->error && strncmp(document->at, "</", 2) != 0) {
        if (!*document->at)
            wrong(document, "an open element");
        else if (*document->at == '<')
            take_element(document, place);
        else
            take_character(document, element->text, false);
    }
    char name[32];
    take(document, "</");
    take_name(document, name);
    if (strcmp(name, element->name) != 0 || !take(document, ">"))
        wrong(document, "another end tag");
}

static void parse(struct document *document, const char *text)
{
    memset(document, 0, sizeof *document);
    document->at = text;
    if (!take(document, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"))
        wrong(document, "no declaration");
    take_element(document, -1);
    if (!take(document, "\n") || *document->at)
        wrong(document, "something behind the root");
}

static const char *attribute(const struct element *element, const char *name)
{
    for (int i = 0; i < element->attribute_count; i++)
        if (strcmp(element->attribute[i].name, name) == 0)
            return element->attribute[i].value;
    return "(none)";
}

// The `skip`-th element of that name.
static const struct element *find(const struct document *document, const char *name,
                                  int skip)
{
    for (int i = 0; i < document->count; i++)
        if (strcmp(document->element[i].name, name) == 0 && skip-- == 0)
            return &document->element[i];
    fail_msg("no such <%s>", name);
    return NULL;
}

// --- the tests ------------------------------------------------------------------------------

static void write_and_parse(const struct sb_junit *junit, struct document *document)
{
    struct sb_text text = {0};
    sb_junit_text(junit, &text);
    parse(document, sb_text_get(&text));
    if (document->error)
        fail_msg("%s at \"%.40s\" in\n%s", document->error, document->at, text.data);
    sb_text_free(&text);
}

static void suites_cases_and_counts_are_those_of_the_struct(void **state)
{
    (void)state;
    static struct document document;
    const struct sb_junit_case one[] = {
        {"a", "robust", SB_JUNIT_PASSED, NULL, NULL, NULL, NULL},
        {"a", "naive", SB_JUNIT_PASSED, NULL, NULL, "fail: 44 > 0 values", NULL},
        {"b", "robust", SB_JUNIT_FAILED, "finite", "3 > 0", NULL, NULL},
    };
    const struct sb_junit_case other[] = {
        {"c", "robust", SB_JUNIT_SKIPPED, NULL, "not here", NULL, NULL},
        {"d", "robust", SB_JUNIT_FAILED, NULL, NULL, "why", NULL},
    };
    const struct sb_junit_suite suites[] = {{"one", one, 3}, {"other", other, 2}};
    const struct sb_junit_property property = {"renderer", "r"};
    write_and_parse(&(struct sb_junit){"all", suites, 2, &property, 1}, &document);
    const struct element *root = &document.element[0];
    assert_string_equal(root->name, "testsuites");
    assert_string_equal(attribute(root, "tests"), "5");
    assert_string_equal(attribute(root, "failures"), "2");
    assert_string_equal(attribute(root, "skipped"), "1");
    assert_string_equal(attribute(root, "errors"), "0");
    const struct element *suite = find(&document, "testsuite", 1);
    assert_string_equal(attribute(suite, "name"), "other");
    assert_string_equal(attribute(suite, "tests"), "2");
    assert_string_equal(attribute(suite, "failures"), "1");
    assert_string_equal(attribute(find(&document, "property", 1), "value"), "r");
    const struct element *failed = find(&document, "testcase", 2);
    assert_string_equal(attribute(failed, "classname"), "b");
    const struct element *failure = find(&document, "failure", 0);
    assert_ptr_equal(&document.element[failure->parent], failed);
    assert_string_equal(attribute(failure, "type"), "finite");
    assert_string_equal(attribute(failure, "message"), "3 > 0");
    assert_string_equal(failure->text, "3 > 0");
    assert_string_equal(attribute(find(&document, "skipped", 0), "message"), "not here");
    const struct element *output = find(&document, "system-out", 0);
    assert_string_equal(output->text, "fail: 44 > 0 values");
    assert_string_equal(attribute(&document.element[output->parent], "name"), "naive");
}

static void what_could_not_be_judged_is_an_error_and_details_are_the_text(void **state)
{
    (void)state;
    static struct document document;
    const struct sb_junit_case rows[] = {
        {"a", "x", SB_JUNIT_ERROR, NULL, "no program", NULL, NULL},
        {"a", "y", SB_JUNIT_ERROR, "gl_error", "lost", "out", "line 1\nline 2"},
        {"a", "z", SB_JUNIT_FAILED, "regression", "slower", NULL, "1.1\n[1.0, 1.2]"},
    };
    const struct sb_junit_suite suite = {"one", rows, 3};
    write_and_parse(&(struct sb_junit){"all", &suite, 1, NULL, 0}, &document);
    assert_string_equal(attribute(&document.element[0], "errors"), "2");
    assert_string_equal(attribute(&document.element[0], "failures"), "1");
    assert_string_equal(attribute(find(&document, "testsuite", 0), "errors"), "2");
    const struct element *plain = find(&document, "error", 0);
    assert_string_equal(attribute(plain, "type"), "error");
    assert_string_equal(attribute(plain, "message"), "no program");
    assert_string_equal(plain->text, "no program");
    const struct element *detailed = find(&document, "error", 1);
    assert_string_equal(attribute(detailed, "type"), "gl_error");
    assert_string_equal(attribute(detailed, "message"), "lost");
    assert_string_equal(detailed->text, "line 1\nline 2");
    assert_string_equal(find(&document, "failure", 0)->text, "1.1\n[1.0, 1.2]");
}

// What a parser gives back of a text in an attribute and between tags.
static void check_text(const char *given, const char *wanted)
{
    static struct document document;
    const struct sb_junit_case row = {given, given, SB_JUNIT_FAILED, given, given,
                                      given, NULL};
    const struct sb_junit_suite suite = {given, &row, 1};
    write_and_parse(&(struct sb_junit){given, &suite, 1, NULL, 0}, &document);
    const struct element *failure = find(&document, "failure", 0);
    assert_string_equal(attribute(find(&document, "testcase", 0), "name"), wanted);
    assert_string_equal(attribute(failure, "message"), wanted);
    assert_string_equal(failure->text, wanted);
    assert_string_equal(find(&document, "system-out", 0)->text, wanted);
}

static void any_text_survives_and_what_xml_cannot_hold_is_replaced(void **state)
{
    (void)state;
    check_text("a < b && c > d \"quoted\" 'too' ]]>",
               "a < b && c > d \"quoted\" 'too' ]]>");
    check_text("line\nnext\r\n\ttab", "line\nnext\r\n\ttab");
    check_text("Grüße … \xF0\x9F\x92\xA1", "Grüße … \xF0\x9F\x92\xA1");
    check_text("bell\a and escape\x1B[31m",
               "bell\xEF\xBF\xBD and escape\xEF\xBF\xBD[31m");
    // Latin-1, a cut-off sequence, an overlong slash, a surrogate, U+FFFF, beyond Unicode.
    check_text("\xFC", "\xEF\xBF\xBD");
    check_text("x\xE2\x80", "x\xEF\xBF\xBD\xEF\xBF\xBD");
    check_text("\xC0\xAF", "\xEF\xBF\xBD\xEF\xBF\xBD");
    check_text("\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
    check_text("\xEF\xBF\xBF", "\xEF\xBF\xBD");
    check_text("\xF4\x90\x80\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

// A parser that took anything would let the writer pass.
static void the_parser_refuses_what_is_not_well_formed(void **state)
{
    (void)state;
    static struct document document;
    static const char *const bad[] = {
        "<a></a>",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a><b></a></b>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a b=\"1\" b=\"2\"/>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a>&nbsp;</a>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a>\x01</a>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a b=\"<\"/>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a/>\n<a/>\n",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a>",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        parse(&document, bad[i]);
        if (!document.error)
            fail_msg("taken: %s", bad[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(suites_cases_and_counts_are_those_of_the_struct),
        cmocka_unit_test(what_could_not_be_judged_is_an_error_and_details_are_the_text),
        cmocka_unit_test(any_text_survives_and_what_xml_cannot_hold_is_replaced),
        cmocka_unit_test(the_parser_refuses_what_is_not_well_formed),
    };
    return run_tests(tests);
}
