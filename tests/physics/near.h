// Numbers that agree within a tolerance, for cmocka.
#ifndef TESTS_PHYSICS_NEAR_H
#define TESTS_PHYSICS_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define assert_near(value, expected, tolerance)                                                    \
    near_check(value, expected, tolerance, __FILE__, __LINE__)

static inline void near_check(double value, double expected, double tolerance, const char *file,
                              int line)
{
    if (fabs(value - expected) <= tolerance) // false for NaN
        return;
    print_error("%.9g is not %.9g within %g\n", value, expected, tolerance);
    _fail(file, line);
}

#endif
