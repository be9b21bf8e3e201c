// The text of lights with an outline in double.
#ifndef TESTS_PHYSICS_LIGHT_AREA_H
#define TESTS_PHYSICS_LIGHT_AREA_H

#include "area_truth.h"

void light_area_double(const area_case *c, double result[2]);

#endif
