// Google Benchmark's CSV, byte for byte: ten columns, then a column a counter.
#include "export_rows.h"

#define HEADER                                                                           \
    "name,iterations,real_time,cpu_time,time_unit,bytes_per_second,items_per_second,"    \
    "label,error_occurred,error_message"

static void names_are_quoted_and_what_is_absent_is_an_empty_cell(void **state)
{
    (void)state;
    char *text = written("gbench-csv", &run_export);
    check_text(text, HEADER
               ",\"ci_lo_ns\",\"ci_hi_ns\",\"ratio\",\"ratio_lo\",\"ratio_hi\","
               "\"max_err\"\n"
               "\"room/point=8,stage=fragment\",7,1000000,2000000,ns,,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment\",7,2000000,2000000,ns,,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment\",7,3000000,2000000,ns,,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment\",7,4000000,6000000,ns,,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment_mean\",4,2500000,3000000,ns,,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment_median\",4,2500000,2000000,ns,,,,,,"
               "2000000,3500000,1.25,1.125,1.5,0.25\n"
               "\"room/point=8,stage=fragment_stddev\",4,1290994.4487358057,2000000,ns"
               ",,,,,,,,,,,\n"
               "\"room/point=8,stage=fragment_cv\",4,0.5163977794943223,"
               "0.6666666666666666,ns,,,,,,,,,,,\n"
               "\"plane/form=\"\"a, b\"\",<c>&d|e f/g é\xEF\xBF\xBD\",0,1500000,0,ns,,,,,"
               ",,,,,,\n"
               "\"plane/form=\"\"a, b\"\",<c>&d|e f/g é\xEF\xBF\xBD_median\",1,1500000,0,"
               "ns,,,\"not_fragment_bound\",,,,,,,,\n"
               "\"room/point=9\",,,,,,,,true,\"compile_failed: 0:1: 'x' : "
               "\"\"syntax\"\"\terror & more\",,,,,,\n"
               "\"room/point=10\",,,,,,,,false,\"not_measured\",,,,,,\n");
    free(text);
}

static void without_counters_there_are_ten_columns(void **state)
{
    (void)state;
    const struct sb_export export = {.name = "x", .row = &run_rows[LATE], .row_count = 1};
    char *text = written("gbench-csv", &export);
    check_text(text, HEADER "\n\"room/point=10\",,,,,,,,false,\"not_measured\"\n");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_quoted_and_what_is_absent_is_an_empty_cell),
        cmocka_unit_test(without_counters_there_are_ten_columns),
    };
    return run_tests(tests);
}
