// The environment's spherical harmonics.
#include "bake/harmonics.h"

#include "physics/environment.glsl"
#include "physics/sh.glsl"

void harmonics_project(const cube_level *level, float coefficients[9][3])
{
    double sum[9][3] = { { 0 } };
    for (uint32_t y = 0; y < level->size; y++) {
        for (uint32_t x = 0; x < level->size; x++) {
            double angle = cube_solid_angle(level->size, x, y);
            float s = cube_coordinate(level->size, x), t = cube_coordinate(level->size, y);
            for (uint32_t face = 0; face < 6; face++) {
                vec3 d = normalize(environment_cube_direction(face, s, t));
                const float *texel = cube_texel(level, face, (int32_t)x, (int32_t)y);
                for (uint32_t i = 0; i < 9; i++) {
                    double weight = angle * (double)sh_basis(i, d);
                    for (int channel = 0; channel < 3; channel++)
                        sum[i][channel] += weight * (double)texel[channel];
                }
            }
        }
    }
    for (int i = 0; i < 9; i++)
        for (int channel = 0; channel < 3; channel++)
            coefficients[i][channel] = (float)sum[i][channel];
}
