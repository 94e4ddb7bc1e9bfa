// Two-sided critical values: x such that the variable lies in [-x, x] with probability
// `level`, in (0,1).
#pragma once

double sb_normal_critical(double level);

// Student's t with df >= 1 degrees of freedom.
double sb_student_critical(double level, int df);
