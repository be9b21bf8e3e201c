// The lights' densities and hits in double.
#define real double
#include "light_case.h"

double light_density_double(const light_case *c, const double wi[3])
{
    return light_case_density(c, light_vec3(wi));
}

double light_hit_double(const light_case *c, const double wi[3])
{
    return light_case_hit(c, light_vec3(wi));
}
