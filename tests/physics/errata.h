// For the tests of docs/errata.md: a printed form is one that misses the truth.
#ifndef TESTS_PHYSICS_ERRATA_H
#define TESTS_PHYSICS_ERRATA_H

#include "near.h"

#define assert_misses(printed, truth, at_least)                                                    \
    errata_check(printed, truth, at_least, __FILE__, __LINE__)

static const double TURN = 6.28318530717958648;

static inline void errata_check(double printed, double truth, double at_least, const char *file,
                                int line)
{
    if (fabs(printed - truth) >= at_least)
        return;
    print_error("%.9g does not miss %.9g by %g\n", printed, truth, at_least);
    _fail(file, line);
}

#endif
