// The albedo of the lobe.
#include "trace/albedo.h"

#include "image/half.h"

void albedo_init(albedo_table *table)
{
    uint16_t halves[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    bake_dfg(halves);
    float *to = &table->at[0][0][0];
    for (size_t i = 0; i < sizeof halves / sizeof *halves; i++)
        to[i] = half_to_float(halves[i]);
}
