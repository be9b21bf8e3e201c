// Many halves at once: with F16C where the processor has it.
#include "image/half.h"

#if defined(__x86_64__)
#include <immintrin.h>

__attribute__((target("avx,f16c"))) static size_t from_floats_f16c(const float *in, uint16_t *out,
                                                                   size_t count, int clamp)
{
    const __m256 most = _mm256_set1_ps(65504), least = _mm256_set1_ps(-65504);
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        __m256 v = _mm256_loadu_ps(in + i);
        if (clamp) {
            v = _mm256_and_ps(v, _mm256_cmp_ps(v, v, _CMP_ORD_Q)); // NaN -> 0
            v = _mm256_max_ps(_mm256_min_ps(v, most), least);
        }
        _mm_storeu_si128((__m128i *)(void *)(out + i),
                         _mm256_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
    }
    return i;
}

__attribute__((target("avx,f16c"))) static size_t to_floats_f16c(const uint16_t *in, float *out,
                                                                 size_t count)
{
    size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        __m128i v = _mm_loadu_si128((const __m128i *)(const void *)(in + i));
        _mm256_storeu_ps(out + i, _mm256_cvtph_ps(v));
    }
    return i;
}

static int has_f16c(void)
{
    return __builtin_cpu_supports("avx2"); // clang 14 cannot ask for f16c; all with AVX2 have it
}
#else
static size_t from_floats_f16c(const float *in, uint16_t *out, size_t count, int clamp)
{
    (void)in, (void)out, (void)count, (void)clamp;
    return 0;
}

static size_t to_floats_f16c(const uint16_t *in, float *out, size_t count)
{
    (void)in, (void)out, (void)count;
    return 0;
}

static int has_f16c(void)
{
    return 0;
}
#endif

void half_from_floats(const float *in, uint16_t *out, size_t count)
{
    for (size_t i = has_f16c() ? from_floats_f16c(in, out, count, 0) : 0; i < count; i++)
        out[i] = half_from_float(in[i]);
}

void half_from_floats_clamped(const float *in, uint16_t *out, size_t count)
{
    for (size_t i = has_f16c() ? from_floats_f16c(in, out, count, 1) : 0; i < count; i++)
        out[i] = half_from_float_clamped(in[i]);
}

void half_to_floats(const uint16_t *in, float *out, size_t count)
{
    for (size_t i = has_f16c() ? to_floats_f16c(in, out, count) : 0; i < count; i++)
        out[i] = half_to_float(in[i]);
}
