// The table of cases in double: what rounding costs the float text.
#define real double
#include "cases.glsl"

#include "cases.h"

double cases_double(uint32_t id, const float u[4])
{
    return physics_case(id, vec4((real)u[0], (real)u[1], (real)u[2], (real)u[3]));
}
