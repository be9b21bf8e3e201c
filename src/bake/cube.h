// A cube map in floats with its mip chain: what the bake filters from.
//
// Faces lie as in Vulkan's cube maps.  Each face has a border of one texel, copied from
// its neighbours, so that a bilinear tap needs no test at the edges.
#ifndef AG_BAKE_CUBE_H
#define AG_BAKE_CUBE_H

#include "bake/wide.h"

#include <stdbool.h>
#include <stddef.h>

enum { CUBE_LEVELS_MAX = 10 };

typedef struct cube_level {
    uint32_t size; // texels of an edge, without the borders
    float *texels; // RGBA [6][size + 2][size + 2]
} cube_level;

typedef struct cube {
    cube_level levels[CUBE_LEVELS_MAX]; // each half of the one before, down to 4
    uint32_t level_count;
} cube;

// `size`: a power of two from 8 to 1024.  False when there is no memory.
bool cube_init(cube *c, uint32_t size);
void cube_finish(cube *c); // zero is allowed

// With level 0 filled inside its borders: fill these and the smaller levels.
void cube_complete(cube *c);

// Solid angle, sr, of texel (x, y) of a face of `size`.
double cube_solid_angle(uint32_t size, uint32_t x, uint32_t y);

WIDE_INLINE float *cube_texel(const cube_level *level, uint32_t face, int32_t x, int32_t y)
{
    uint32_t row = level->size + 2;
    return level->texels + 4 * ((size_t)(face * row + (uint32_t)(y + 1)) * row + (uint32_t)(x + 1));
}

// The coordinate, in [-1, 1], of the centre of texel x.
WIDE_INLINE float cube_coordinate(uint32_t size, uint32_t x)
{
    return (2.0f * (float)x + 1.0f) / (float)size - 1.0f;
}

// Where eight directions meet a level.
typedef struct cube_hit {
    i32x8 index;      // texel of the upper left of four, borders counted
    f32x8 right, low; // weights of the right and the lower ones
} cube_hit;

// Directions need not be unit.  Vulkan 1.3, "Cube Map Face Selection".
WIDE_INLINE cube_hit cube_find(uint32_t size, f32x8 x, f32x8 y, f32x8 z)
{
    f32x8 ax = wide_abs(x), ay = wide_abs(y), az = wide_abs(z);
    i32x8 is_z = (az >= ax) & (az >= ay);
    i32x8 is_y = (ay >= ax) & ~is_z;
    f32x8 major = wide_select(is_z, z, wide_select(is_y, y, x));
    i32x8 sign = (i32x8)major & INT32_MIN;
    // +X: (-z, -y), -X: (z, -y); +Y: (x, z), -Y: (x, -z); +Z: (x, -y), -Z: (-x, -y).
    f32x8 flip = (f32x8)((i32x8)wide_select(is_z, x, -z) ^ sign);
    f32x8 s = wide_select(is_y, x, flip);
    f32x8 t = wide_select(is_y, (f32x8)((i32x8)z ^ sign), -y);
    i32x8 face = (is_z & 4) | (is_y & 2);
    face |= (i32x8)((sign >> 31) & 1);

    float half = 0.5f * (float)size;
    f32x8 scale = half / wide_abs(major);
    f32x8 px = s * scale + (half + 0.5f), py = t * scale + (half + 0.5f);
    i32x8 ix = __builtin_convertvector(px, i32x8), iy = __builtin_convertvector(py, i32x8);
    int32_t row = (int32_t)size + 2;
    return (cube_hit) {
        .index = (face * row + iy) * row + ix,
        .right = px - __builtin_convertvector(ix, f32x8),
        .low = py - __builtin_convertvector(iy, f32x8),
    };
}

// The bilinear value for lane `i` of a hit.
WIDE_INLINE f32x4 cube_fetch(const cube_level *level, const cube_hit *hit, int i)
{
    const float *p = level->texels + 4 * (size_t)(uint32_t)hit->index[i];
    const float *q = p + 4 * (size_t)(level->size + 2);
    f32x4 p0 = *(const f32x4 *)p, p1 = *(const f32x4 *)(p + 4);
    f32x4 q0 = *(const f32x4 *)q, q1 = *(const f32x4 *)(q + 4);
    f32x4 a = p0 + (p1 - p0) * hit->right[i];
    f32x4 b = q0 + (q1 - q0) * hit->right[i];
    return a + (b - a) * hit->low[i];
}

#endif
