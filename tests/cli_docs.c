// docs/ci.md: every block of shell in it runs, every YAML parses, and the scripts in the YAML run, as
// they stand. What they run in is a clone of a project whose shadebench draws nothing
// (--context null), in which building and installing do nothing, and whose main is one commit behind.
#include <yaml.h>

#include "cli_fixture.h"

enum { TEXT_MAX = 8192, BLOCKS_MAX = 64 };

struct block {
    char language[16];
    char text[TEXT_MAX];
};
static struct block block[BLOCKS_MAX];
static int block_count;

static void read_blocks(void)
{
    static char line[1024];
    FILE *file = fopen(SB_SOURCE_DIR "/docs/ci.md", "r");
    struct block *open = NULL;
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, "```", 3) == 0) {
            if (!open) {
                assert_true(block_count < BLOCKS_MAX);
                open = &block[block_count++];
                sscanf(line, "```%15s", open->language);
            } else {
                open = NULL;
            }
        } else if (open) {
            assert_true(strlen(open->text) + strlen(line) < TEXT_MAX);
            strcat(open->text, line);
        }
    }
    assert_null(open); // each is closed
    fclose(file);
}

// --- the project -------------------------------------------------------------------------------

static const char make_project[] =
    "set -e; exec 2>&1\n"
    "mkdir -p @/project/scripts @/project/build/release/bin @/stubs\n"
    "cp -r " SB_SOURCE_DIR "/shaders " SB_SOURCE_DIR "/bench @/project\n"
    "cd @/project\n"
    "echo '#!/bin/sh' >scripts/build; chmod +x scripts/build\n"
    "cp @/wrapper build/release/bin/shadebench; chmod +x build/release/bin/shadebench\n"
    "echo '#!/bin/sh' >@/stubs/apt-get; chmod +x @/stubs/apt-get\n"
    "git init -q . && git add -A && git commit -qm one && git branch -M main\n"
    "git tag v1.0\n"
    "git clone -q --bare . @/origin.git\n"
    "for i in 1 2; do for f in shaders/model/*.glsl; do echo \"// $i\" >>$f; done\n"
    "git commit -qam \"comment $i\"; done\n"
    "git branch topic && git reset -q --hard v1.0\n"
    "git push -q @/origin.git topic\n";

// A fresh clone, and in it a script as a CI service runs it: sh -e.
static void run_in_clone(const char *script, struct answer *answer)
{
    static int number;
    char line[512];
    write_file("script", script);
    snprintf(line, sizeof line,
             "exec 2>&1; git clone -q -b topic @/origin.git @/clone%d && cd @/clone%d && "
             "SHADEBENCH_DATA=$PWD GITHUB_WORKSPACE=$PWD CI_PROJECT_DIR=$PWD sh -e "
             "@/script",
             number, number);
    number++;
    run_shell(answer, line);
}

static void every_block_of_shell_runs(void **state)
{
    (void)state;
    int shells = 0;
    for (int i = 0; i < block_count; i++) {
        static struct answer answer;
        if (strcmp(block[i].language, "sh") != 0)
            continue;
        shells++;
        run_in_clone(block[i].text, &answer);
        if (answer.code != 0)
            fail_msg("%s\nexit code %d: %s", block[i].text, answer.code, answer.text);
        if (strstr(block[i].text, "bisect"))
            check_contains(answer.text, "is the first bad commit");
        else if (strstr(block[i].text, "--base "))
            check_contains(answer.text, " pass\n");
    }
    assert_int_equal(shells, 7);
}

// --- YAML --------------------------------------------------------------------------------------

struct job { // what a file has a runner do
    char script[TEXT_MAX];
    char uses[8][64];
    int use_count;
};

static const char *scalar(yaml_document_t *document, int item)
{
    const yaml_node_t *node = yaml_document_get_node(document, item);
    return node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

static void add_script(struct job *job, const char *line)
{
    assert_true(strlen(job->script) + strlen(line) + 2 < TEXT_MAX);
    strcat(job->script, line);
    strcat(job->script, "\n");
}

// `run: TEXT`, `script: [LINE, …]` and `before_script:`, in the order in which they stand.
static void gather(yaml_document_t *document, int item, struct job *job)
{
    const yaml_node_t *node = yaml_document_get_node(document, item);
    if (node->type == YAML_SEQUENCE_NODE)
        for (yaml_node_item_t *it = node->data.sequence.items.start;
             it < node->data.sequence.items.top; it++)
            gather(document, *it, job);
    if (node->type != YAML_MAPPING_NODE)
        return;
    for (yaml_node_pair_t *it = node->data.mapping.pairs.start;
         it < node->data.mapping.pairs.top; it++) {
        const char *key = scalar(document, it->key);
        const yaml_node_t *value = yaml_document_get_node(document, it->value);
        if (strcmp(key, "run") == 0) {
            add_script(job, scalar(document, it->value));
        } else if (strcmp(key, "uses") == 0) {
            snprintf(job->uses[job->use_count++], 64, "%s", scalar(document, it->value));
        } else if (strstr(key, "script")) {
            for (yaml_node_item_t *line = value->data.sequence.items.start;
                 line < value->data.sequence.items.top; line++)
                add_script(job, scalar(document, *line));
        } else {
            gather(document, it->value, job);
        }
    }
}

static void parse(const char *text, struct job *job)
{
    yaml_parser_t parser;
    yaml_document_t document;
    *job = (struct job){0};
    assert_true(yaml_parser_initialize(&parser));
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, strlen(text));
    if (!yaml_parser_load(&parser, &document))
        fail_msg("line %zu: %s", parser.problem_mark.line + 1, parser.problem);
    assert_non_null(yaml_document_get_root_node(&document));
    gather(&document, 1, job);
    yaml_document_delete(&document);
    yaml_parser_delete(&parser);
}

static void the_jobs_of_the_yaml_run_and_leave_what_they_upload(void **state)
{
    (void)state;
    int jobs = 0;
    for (int i = 0; i < block_count; i++) {
        static struct answer answer;
        static struct job job;
        if (strcmp(block[i].language, "yaml") != 0)
            continue;
        parse(block[i].text, &job);
        for (int u = 0; u < job.use_count; u++)
            if (strncmp(job.uses[u], "actions/checkout@", 17) != 0 &&
                strncmp(job.uses[u], "actions/upload-artifact@", 24) != 0)
                fail_msg("%s is wanted, too", job.uses[u]);
        add_script(&job, "ls gate/gate.csv gate/pairs.csv gate.xml budgets.xml "
                         "budgets/summary.csv");
        // The null runner's pictures are no lighting, so `run --check` misses its budgets: that
        // is its answer, and not the script's mistake.
        add_script(&job, "echo all done");
        run_in_clone(job.script, &answer);
        if (answer.code == 1 && strstr(answer.text, "missed")) {
            assert_non_null(strstr(answer.text, "20 pass"));
            jobs++;
            continue;
        }
        if (answer.code != 0 || !strstr(answer.text, "all done"))
            fail_msg("%s\nexit code %d: %s", job.script, answer.code, answer.text);
        check_contains(answer.text, "20 pass");
        jobs++;
    }
    assert_int_equal(jobs, 2);
}

int main(void)
{
    static struct answer answer;
    begin_tests();
    run_shell(&answer, "command -v git && command -v tar");
    if (answer.code != 0) {
        print_message("skipped: no git here\n");
        return end_tests(77);
    }
    static const char *const settings[][2] = {
        {"GIT_AUTHOR_NAME", "n"},    {"GIT_AUTHOR_EMAIL", "a@b.c"},
        {"GIT_COMMITTER_NAME", "n"}, {"GIT_COMMITTER_EMAIL", "a@b.c"},
        {"GITHUB_BASE_REF", "main"}, {"CI_MERGE_REQUEST_TARGET_BRANCH_NAME", "main"},
        {"HOME", test_dir},          {"GIT_CONFIG_NOSYSTEM", "1"},
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        setenv(settings[i][0], settings[i][1], 1);
    char path[4096];
    snprintf(path, sizeof path, "%s/stubs:%s", test_dir, getenv("PATH"));
    setenv("PATH", path, 1);
    write_file("wrapper", "#!/bin/sh\nexec '" SB_PROGRAM "' \"$@\" --context null\n");
    check_shell(make_project, 0, "");
    read_blocks();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_block_of_shell_runs),
        cmocka_unit_test(the_jobs_of_the_yaml_run_and_leave_what_they_upload),
    };
    return end_tests(run_tests(tests));
}
