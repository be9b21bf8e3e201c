// The sphere light in double: what rounding costs the float text.
#define real double
#include "physics/light_sphere.glsl"

#include "light_sphere.h"

void light_sphere_double(const float axis[3], float sin_s, float cos_s, const float v[3], float ax,
                         float ay, double result[2])
{
    light_cap cap = { vec3((real)axis[0], (real)axis[1], (real)axis[2]), (real)sin_s, (real)cos_s };
    vec3 wo = vec3((real)v[0], (real)v[1], (real)v[2]);
    vec2 sum = light_cap_ggx(cap, wo, (real)ax, (real)ay);
    result[0] = sum[0];
    result[1] = sum[1];
}
