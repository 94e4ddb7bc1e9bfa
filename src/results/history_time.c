#include "results/history_time.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

// Days from 1970-01-01 in the Gregorian calendar, by counting years from March, so that the leap
// day is the last of its year; timegm is not POSIX.
static int64_t days_from_date(int year, int month, int day)
{
    const int64_t y = year - (month <= 2);
    const int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
    return 365 * y + y / 4 - y / 100 + y / 400 + of_year - 719468;
}

static int days_of_month(int year, int month)
{
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return days[month - 1] + (leap && month == 2);
}

static void format(int64_t seconds, char time[static 32])
{
    int64_t days = seconds / 86400;
    const unsigned rest = (unsigned)(seconds % 86400);
    int year = 1970, month = 1;
    for (int64_t length;
         days >= (length = days_from_date(year + 1, 1, 1) - days_from_date(year, 1, 1));
         year++)
        days -= length;
    for (; days >= days_of_month(year, month); month++)
        days -= days_of_month(year, month);
    // The remainders say how wide the numbers are at most.
    snprintf(time, 32, "%04u-%02u-%02uT%02u:%02u:%02uZ", (unsigned)year % 10000,
             (unsigned)month % 100, (unsigned)days % 100 + 1, rest / 3600 % 24,
             rest / 60 % 60, rest % 60);
}

// Digits of `pattern` ('0') stand in text, all else is itself; returns whether it is so, for as long
// as the pattern is.
static bool matches(const char *text, const char *pattern)
{
    for (; *pattern; text++, pattern++)
        if (*pattern == '0' ? *text < '0' || *text > '9' : *text != *pattern)
            return false;
    return true;
}

static int number(const char *digits, int count)
{
    int value = 0;
    for (int i = 0; i < count; i++)
        value = 10 * value + digits[i] - '0';
    return value;
}

// Of the zone behind the seconds, in minutes. False: there is no such zone.
static bool read_zone(const char *zone, int *minutes)
{
    *minutes = 0;
    if (strcmp(zone, "Z") == 0)
        return true;
    if ((*zone != '+' && *zone != '-') || !matches(zone + 1, "00:00") || zone[6])
        return false;
    *minutes = (60 * number(zone + 1, 2) + number(zone + 4, 2)) * (*zone == '-' ? -1 : 1);
    return number(zone + 1, 2) <= 23 && number(zone + 4, 2) <= 59;
}

static bool read(const char *given, int64_t *seconds)
{
    int zone = 0, clock = 0;
    if (!matches(given, "0000-00-00"))
        return false;
    const int year = number(given, 4), month = number(given + 5, 2),
              day = number(given + 8, 2);
    if (year < 1971 || month < 1 || month > 12 || day < 1 ||
        day > days_of_month(year, month))
        return false;
    const char *rest = given + 10;
    if (*rest) {
        if (!matches(rest, "T00:00:00") || !read_zone(rest + 9, &zone) ||
            number(rest + 1, 2) > 23 || number(rest + 4, 2) > 59 ||
            number(rest + 7, 2) > 60)
            return false;
        clock =
            3600 * number(rest + 1, 2) + 60 * number(rest + 4, 2) + number(rest + 7, 2);
    }
    *seconds = 86400 * days_from_date(year, month, day) + clock - 60 * zone;
    return true;
}

bool sb_history_time(const char *given, char time[static 32], struct sb_error *err)
{
    int64_t seconds;
    if (!read(given, &seconds))
        return sb_fail(err, SB_USAGE,
                       "\"%s\" is no date; valid: 2026-11-22, 2026-11-22T01:02:03Z, "
                       "2026-11-22T03:02:03+02:00",
                       given);
    format(seconds, time);
    return true;
}
