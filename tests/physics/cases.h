// The table of cases in C, once in float and once in double.
#ifndef TESTS_PHYSICS_CASES_H
#define TESTS_PHYSICS_CASES_H

#include <stdint.h>

enum { CASES_INPUTS = 4096 };

uint32_t cases_count(void);

// Input i of every case: a fixed set that fills [0, 1)^4 evenly.
void cases_input(uint32_t i, float u[4]);

float cases_float(uint32_t id, const float u[4]);
double cases_double(uint32_t id, const float u[4]);

#endif
