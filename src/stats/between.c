#include <math.h>

#include "stats/between.h"
#include "stats/critical.h"

struct sb_interval sb_between_processes(const double *process_medians, int n,
                                        double level)
{
    struct sb_interval interval = {NAN, NAN, NAN, n};
    double mean = 0, squares = 0;
    for (int i = 0; i < n; i++) {
        if (!(process_medians[i] > 0))
            return interval;
        mean += log(process_medians[i]) / n;
    }
    if (n < 1)
        return interval;
    interval.point = exp(mean);
    if (n < 2)
        return interval;
    for (int i = 0; i < n; i++)
        squares += pow(log(process_medians[i]) - mean, 2);
    const double error = sqrt(squares / (n - 1) / n); // standard error of the mean
    const double reach = sb_student_critical(level, n - 1) * error;
    interval.lo = exp(mean - reach);
    interval.hi = exp(mean + reach);
    return interval;
}
