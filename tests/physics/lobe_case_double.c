// The lobes' densities in double.
#define real double
#include "lobe_case.h"

double lobe_density_double(const lobe_case *c, const double wi[3])
{
    return lobe_density(c, lobe_vec3(wi));
}
