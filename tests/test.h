// What every test program includes first. Names of tests are sentences.
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// cmocka 1.1.5 compares floats only, so doubles have their own check.
#define check_close(a, b, tolerance) check_close_at(a, b, tolerance, __FILE__, __LINE__)
static inline void check_close_at(double a, double b, double tolerance, const char *file,
                                  int line)
{
    if (fabs(a - b) <= tolerance || a == b)
        return;
    print_error("%.17g and %.17g differ by more than %g\n", a, b, tolerance);
    _fail(file, line);
}

// `text` holds `part`: for messages.
#define check_contains(text, part) check_contains_at(text, part, __FILE__, __LINE__)
static inline void check_contains_at(const char *text, const char *part, const char *file,
                                     int line)
{
    if (strstr(text, part))
        return;
    print_error("no \"%s\" in \"%s\"\n", part, text);
    _fail(file, line);
}

#undef run_tests // cmocka.h has an old macro of this name
#define run_tests(tests) cmocka_run_group_tests(tests, NULL, NULL)
