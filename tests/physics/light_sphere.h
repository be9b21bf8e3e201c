// The sphere light's text in double.
#ifndef TESTS_PHYSICS_LIGHT_SPHERE_H
#define TESTS_PHYSICS_LIGHT_SPHERE_H

void light_sphere_double(const float axis[3], float sin_s, float cos_s, const float v[3], float ax,
                         float ay, double result[2]);

#endif
