// Low-discrepancy points for one sample of one pixel: as many pairs of numbers as the path asks
// for, each the sample's member of an Owen-scrambled Sobol set of its own.
//
// Burley 2020, "Practical Hash-based Owen Scrambling": sets of two dimensions are padded; the
// order of each is shuffled and its digits are scrambled by the same hash, that of Laine & Karras
// 2011 in the constants of Vegdahl 2021 ("Building a Better LK Hash").
#ifndef AG_TRACE_SAMPLER_H
#define AG_TRACE_SAMPLER_H

#include "physics/lang.glsl"

typedef struct sampler {
    uint32_t index; // of the sample in its pixel
    uint32_t seed;  // of the pixel
    uint32_t drawn; // sets so far
} sampler;

// A bijection that leaves no pattern; Wellons 2018, "lowbias32".
static inline uint32_t sampler_hash(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

static inline uint32_t sampler_mix(uint32_t a, uint32_t b)
{
    return sampler_hash(a ^ (b * 0x9e3779b9u + 0x85ebca6bu));
}

static inline uint32_t sampler_reversed(uint32_t x)
{
    x = __builtin_bswap32(x);
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

// Scrambles the digits of a number whose bits are reversed: each bit by those below it.
static inline uint32_t sampler_scrambled(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
}

// The second dimension of Sobol's sequence, its bits reversed, of an index: the bits are those of
// a polynomial over GF(2) in x, and it is taken at x + 1; x^16 first.
static inline uint32_t sampler_sobol(uint32_t x)
{
    x ^= x >> 16;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xccccccccu) >> 2;
    return x ^ (x & 0xaaaaaaaau) >> 1;
}

// Of a number whose bits are reversed, in [0, 1).
static inline float sampler_float(uint32_t x)
{
    return (float)(sampler_reversed(x) >> 8) * 0x1p-24f;
}

// The place in its set of the sample, its bits reversed, and the seed of the set.
static inline uint32_t sampler_place(sampler *s, uint32_t *seed)
{
    *seed = sampler_mix(s->seed, s->drawn++);
    return sampler_reversed(sampler_scrambled(sampler_reversed(s->index), sampler_hash(*seed)));
}

// The two numbers of a set at a place.
static inline float sampler_first(uint32_t at, uint32_t seed)
{
    return sampler_float(sampler_scrambled(at, sampler_mix(seed, 1)));
}

static inline float sampler_second(uint32_t at, uint32_t seed)
{
    return sampler_float(sampler_scrambled(sampler_sobol(at), sampler_mix(seed, 2)));
}

static inline vec2 sampler_pair(sampler *s)
{
    uint32_t seed, at = sampler_place(s, &seed);
    return vec2(sampler_first(at, seed), sampler_second(at, seed));
}

static inline float sampler_number(sampler *s)
{
    uint32_t seed, at = sampler_place(s, &seed);
    return sampler_first(at, seed);
}

// Dice for one ray: those of no set.
static inline uint32_t sampler_roll(const sampler *s)
{
    return sampler_mix(s->seed, sampler_mix(s->index, s->drawn));
}

#endif
