// The albedo of the lobe: the table that the renderer has (bake/dfg.h), in floats.
#ifndef AG_TRACE_ALBEDO_H
#define AG_TRACE_ALBEDO_H

#include "bake/dfg.h"
#include "physics/lang.glsl"

typedef struct albedo_table {
    float at[BAKE_DFG_SIZE][BAKE_DFG_SIZE][2]; // [roughness][NoV]
} albedo_table;

void albedo_init(albedo_table *table);

// Bilinear, held at the edges, as the renderer's sampler.
static inline vec2 albedo_read(const albedo_table *table, float NoV, float roughness)
{
    const float last = BAKE_DFG_SIZE - 1;
    float x = min(max(NoV * BAKE_DFG_SIZE - 0.5f, 0), last);
    float y = min(max(roughness * BAKE_DFG_SIZE - 0.5f, 0), last);
    int x0 = (int)x, y0 = (int)y;
    int x1 = x0 + (x0 < BAKE_DFG_SIZE - 1), y1 = y0 + (y0 < BAKE_DFG_SIZE - 1);
    float fx = x - (float)x0, fy = y - (float)y0;
    vec2 sum = { 0, 0 };
    const float *taps[4] = { table->at[y0][x0], table->at[y0][x1], table->at[y1][x0],
                             table->at[y1][x1] };
    const float weights[4] = { (1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy };
    for (int i = 0; i < 4; i++)
        sum += weights[i] * vec2(taps[i][0], taps[i][1]);
    return sum;
}

#endif
