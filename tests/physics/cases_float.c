// The table of cases in float: what the GPU must agree with.
#include "cases.glsl"

#include "cases.h"

uint32_t cases_count(void)
{
    return CASE_COUNT;
}

// The additive recurrence of Roberts 2018 (R4): powers of the root of x^5 = x + 1.
void cases_input(uint32_t i, float u[4])
{
    const double root = 1.16730397826141868;
    double step = 1.0;
    for (int k = 0; k < 4; k++) {
        step /= root;
        double x = 0.5 + step * i;
        u[k] = (float)(uint32_t)((x - floor(x)) * 16777216.0) / 16777216.0f; // below 1
    }
}

float cases_float(uint32_t id, const float u[4])
{
    return physics_case(id, vec4(u[0], u[1], u[2], u[3]));
}
