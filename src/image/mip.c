// Mip chains.  Even sizes take the fast rows below; odd ones the general filter.
#include "image/mip.h"

#include "base/pages.h"
#include "image/srgb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

uint32_t image_mip_count(uint32_t width, uint32_t height)
{
    uint32_t count = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size >>= 1)
        count++;
    return count;
}

static uint32_t half_size(uint32_t size)
{
    return size > 1 ? size / 2 : 1;
}

size_t image_mip_offset(uint32_t width, uint32_t height, uint32_t level)
{
    size_t offset = 0;
    for (uint32_t l = 1; l < level; l++) {
        width = half_size(width);
        height = half_size(height);
        offset += (size_t)width * height * 4;
    }
    return offset;
}

// The texels of a line of `size` that texel `i` of the halved line covers.
typedef struct taps {
    uint32_t first, count;
    float weight[3]; // their sum is 1
} taps;

static taps taps_of(uint32_t size, uint32_t i)
{
    if (size == 1)
        return (taps) { 0, 1, { 1 } };
    if (size % 2 == 0)
        return (taps) { 2 * i, 2, { 0.5f, 0.5f } };
    // size = 2 n + 1: from i size / n to (i + 1) size / n, times n / size
    float n = (float)(size / 2), whole = (float)size, at = (float)i;
    return (taps) { 2 * i, 3, { (n - at) / whole, n / whole, (at + 1) / whole } };
}

// What the kinds share: the tables of both directions.
typedef struct filter {
    image_mip_kind kind;
    float decoded[256]; // what a byte stands for
    srgb_encoder encoder;
    // For sums of four linear values of 16 bits: 1/8 of the sum -> code, as the middle of
    // those eight is coded.  A code is at least 80 wide, so that is off by 1/20 at most.
    uint16_t linear[256];
    uint8_t code_of_sum[4 * 65536 / 8];
} filter;

static void filter_init_sums(filter *f)
{
    for (int i = 0; i < 256; i++)
        f->linear[i] = (uint16_t)lrint(65535 * srgb_to_linear(i / 255.0));
    for (uint32_t i = 0; i < sizeof f->code_of_sum; i++)
        f->code_of_sum[i] = srgb_encode(&f->encoder, ((float)i * 8 + 4) / (4 * 65535));
}

static void filter_init(filter *f, image_mip_kind kind)
{
    f->kind = kind;
    if (kind == IMAGE_MIP_SRGB || kind == IMAGE_MIP_SRGB_OPAQUE) {
        srgb_decoder_init(f->decoded);
        srgb_encoder_init(&f->encoder);
        filter_init_sums(f);
        return;
    }
    for (int i = 0; i < 256; i++)
        f->decoded[i] = kind == IMAGE_MIP_NORMAL ? (float)i / 127.5f - 1 : (float)i / 255;
}

static uint8_t byte_of(float v)
{
    return (uint8_t)(v * 255 + 0.5f);
}

static void store_normal(const float n[3], uint8_t *out)
{
    float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length < 1e-6f) { // they cancel out: the surface's own
        out[0] = out[1] = 128;
        out[2] = 255;
        return;
    }
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)((n[c] / length + 1) * 127.5f + 0.5f);
}

// One texel from up to 3 x 3 of them.
static void filter_texel(const filter *f, const uint8_t *in, size_t stride, const taps *tx,
                         const taps *ty, uint8_t *out)
{
    float sum[3] = { 0 }, by_alpha[3] = { 0 }, alpha = 0;
    for (uint32_t y = 0; y < ty->count; y++)
        for (uint32_t x = 0; x < tx->count; x++) {
            const uint8_t *p = in + y * stride + (size_t)x * 4;
            float w = tx->weight[x] * ty->weight[y], wa = w * ((float)p[3] / 255);
            alpha += wa;
            for (int c = 0; c < 3; c++) {
                sum[c] += w * f->decoded[p[c]];
                by_alpha[c] += wa * f->decoded[p[c]];
            }
        }
    out[3] = byte_of(alpha);
    if (f->kind == IMAGE_MIP_NORMAL)
        store_normal(sum, out);
    for (int c = 0; c < 3 && f->kind == IMAGE_MIP_LINEAR; c++)
        out[c] = byte_of(sum[c]);
    for (int c = 0; c < 3 && f->kind == IMAGE_MIP_SRGB; c++)
        out[c] = srgb_encode(&f->encoder, alpha > 0 ? by_alpha[c] / alpha : sum[c]);
    if (f->kind == IMAGE_MIP_SRGB_OPAQUE) {
        for (int c = 0; c < 3; c++)
            out[c] = srgb_encode(&f->encoder, sum[c]);
        out[3] = 255;
    }
}

static void filter_general(const filter *f, const uint8_t *in, uint32_t width, uint32_t height,
                           uint8_t *out)
{
    uint32_t w = half_size(width), h = half_size(height);
    size_t stride = (size_t)width * 4;
    for (uint32_t y = 0; y < h; y++) {
        taps ty = taps_of(height, y);
        for (uint32_t x = 0; x < w; x++, out += 4) {
            taps tx = taps_of(width, x);
            filter_texel(f, in + ty.first * stride + (size_t)tx.first * 4, stride, &tx, &ty, out);
        }
    }
}

// The rows of even sizes: `a` and `b` are two rows of 2 * count texels.

static void linear_row(const uint8_t *a, const uint8_t *b, uint32_t count, uint8_t *out)
{
    for (uint32_t x = 0; x < count; x++, a += 8, b += 8, out += 4)
        for (int c = 0; c < 4; c++)
            out[c] = (uint8_t)((a[c] + a[c + 4] + b[c] + b[c + 4] + 2) >> 2);
}

// `p`: four texels, the red in the lowest byte (a little-endian machine's own).
static uint32_t srgb_texel_by_alpha(const filter *f, const uint32_t p[4])
{
    uint32_t alpha = 0, out = 0;
    for (int i = 0; i < 4; i++)
        alpha += p[i] >> 24;
    for (int shift = 0; shift < 24; shift += 8) {
        uint64_t sum = 0, plain = 0;
        for (int i = 0; i < 4; i++) {
            uint16_t v = f->linear[p[i] >> shift & 255];
            sum += (uint64_t)(p[i] >> 24) * v;
            plain += v;
        }
        uint64_t mean = alpha ? (4 * sum + alpha / 2) / alpha : plain;
        out |= (uint32_t)f->code_of_sum[mean >> 3] << shift;
    }
    return out | (alpha + 2) >> 2 << 24;
}

static bool row_is_opaque(const uint8_t *row, uint32_t texels)
{
    uint8_t all = 255;
    for (uint32_t x = 0; x < texels; x++)
        all &= row[(size_t)x * 4 + 3];
    return all == 255;
}

static void srgb_row_by_alpha(const filter *f, const uint8_t *a, const uint8_t *b, uint32_t count,
                              uint8_t *out)
{
    for (uint32_t x = 0; x < count; x++, a += 8, b += 8, out += 4) {
        uint32_t p[4];
        memcpy(p, a, 8);
        memcpy(p + 2, b, 8);
        uint32_t texel = srgb_texel_by_alpha(f, p);
        memcpy(out, &texel, 4);
    }
}

static void srgb_row(const filter *f, const uint8_t *a, const uint8_t *b, uint32_t count,
                     uint8_t *restrict out)
{
    bool by_alpha = f->kind == IMAGE_MIP_SRGB;
    if (by_alpha && (!row_is_opaque(a, 2 * count) || !row_is_opaque(b, 2 * count))) {
        srgb_row_by_alpha(f, a, b, count, out);
        return;
    }
    const uint16_t *linear = f->linear;
    const uint8_t *code = f->code_of_sum;
    for (uint32_t x = 0; x < count; x++, a += 8, b += 8, out += 4) {
        out[0] = code[(linear[a[0]] + linear[a[4]] + linear[b[0]] + linear[b[4]]) >> 3];
        out[1] = code[(linear[a[1]] + linear[a[5]] + linear[b[1]] + linear[b[5]]) >> 3];
        out[2] = code[(linear[a[2]] + linear[a[6]] + linear[b[2]] + linear[b[6]]) >> 3];
        out[3] = 255;
    }
}

enum { BLOCK = 64 }; // texels at once, in a shape that compilers vectorise

static void normal_block(const uint8_t *a, const uint8_t *b, uint32_t count, uint8_t *out)
{
    float n[3][BLOCK]; // of any length: 4 * 127.5 times the mean
    for (uint32_t x = 0; x < count; x++)
        for (uint32_t c = 0; c < 3; c++) {
            uint32_t i = 8 * x + c;
            n[c][x] = (float)(a[i] + a[i + 4] + b[i] + b[i + 4] - 510);
        }
    uint8_t code[3][BLOCK];
    for (uint32_t x = 0; x < count; x++) {
        float square = n[0][x] * n[0][x] + n[1][x] * n[1][x] + n[2][x] * n[2][x];
        bool none = square < 0.5f; // they cancel out
        float scale = none ? 0 : 127.5f / sqrtf(square);
        for (int c = 0; c < 3; c++)
            code[c][x] = (uint8_t)(int)(n[c][x] * scale + 128 + (none && c == 2 ? 127.5f : 0));
    }
    for (uint32_t x = 0; x < count; x++) {
        for (uint32_t c = 0; c < 3; c++)
            out[4 * x + c] = code[c][x];
        uint32_t i = 8 * x + 3;
        out[4 * x + 3] = (uint8_t)((a[i] + a[i + 4] + b[i] + b[i + 4] + 2) >> 2);
    }
}

static void normal_row(const uint8_t *a, const uint8_t *b, uint32_t count, uint8_t *out)
{
    for (uint32_t x = 0; x < count; x += BLOCK) {
        uint32_t n = count - x < BLOCK ? count - x : BLOCK;
        normal_block(a + (size_t)x * 8, b + (size_t)x * 8, n, out + (size_t)x * 4);
    }
}

static void filter_even(const filter *f, const uint8_t *in, uint32_t width, uint32_t height,
                        uint8_t *out)
{
    size_t stride = (size_t)width * 4;
    uint32_t count = width / 2;
    for (uint32_t y = 0; y < height / 2; y++, in += 2 * stride, out += (size_t)count * 4) {
        if (f->kind == IMAGE_MIP_SRGB || f->kind == IMAGE_MIP_SRGB_OPAQUE)
            srgb_row(f, in, in + stride, count, out);
        else if (f->kind == IMAGE_MIP_NORMAL)
            normal_row(in, in + stride, count, out);
        else
            linear_row(in, in + stride, count, out);
    }
}

void *image_mips(const ag_image *image, image_mip_kind kind)
{
    uint32_t width = image->width, height = image->height;
    uint32_t count = image_mip_count(width, height);
    size_t bytes = image_mip_offset(width, height, count);
    filter *f = malloc(sizeof *f);
    uint8_t *levels = f ? malloc(bytes ? bytes : 1) : NULL;
    if (levels)
        filter_init(f, kind);
    pages_prefer_large(levels, bytes);
    const uint8_t *in = image->pixels;
    uint8_t *out = levels;
    for (uint32_t level = 1; level < count && levels; level++) {
        if (width % 2 == 0 && height % 2 == 0)
            filter_even(f, in, width, height, out);
        else
            filter_general(f, in, width, height, out);
        width = half_size(width);
        height = half_size(height);
        in = out;
        out += (size_t)width * height * 4;
    }
    free(f);
    return levels;
}

ag_status image_halve(const ag_log *log, const ag_image *image, ag_image **half)
{
    uint32_t w = half_size(image->width), h = half_size(image->height);
    ag_status status = image_allocate(log, "image", w, h, AG_FORMAT_RGBA32F, half);
    if (status)
        return status;
    size_t stride = (size_t)image->width * 4;
    float *out = (*half)->pixels;
    for (uint32_t y = 0; y < h; y++) {
        taps ty = taps_of(image->height, y);
        const float *row = (const float *)image->pixels + ty.first * stride;
        for (uint32_t x = 0; x < w; x++, out += 4) {
            taps tx = taps_of(image->width, x);
            float sum[4] = { 0 };
            for (uint32_t j = 0; j < ty.count; j++)
                for (uint32_t i = 0; i < tx.count; i++)
                    for (size_t c = 0; c < 4; c++)
                        sum[c] += ty.weight[j] * tx.weight[i] *
                                  row[j * stride + ((size_t)tx.first + i) * 4 + c];
            for (int c = 0; c < 4; c++)
                out[c] = sum[c];
        }
    }
    return AG_OK;
}
