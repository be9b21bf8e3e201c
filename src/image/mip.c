// Mip chains.  Even sizes take the fast rows below; odd ones the general filter.
#include "image/mip.h"

#include "image/srgb.h"

#include <math.h>
#include <stdlib.h>

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
    // For sums of four linear values of 16 bits: 1/16 of the sum -> code, off by at most
    // one, and the least sum that is coded as i or higher.
    uint16_t linear[256];
    uint8_t guess[65536 / 4];
    uint32_t threshold[257];
} filter;

static void filter_init_sums(filter *f)
{
    for (int i = 0; i < 256; i++)
        f->linear[i] = (uint16_t)lrint(65535 * srgb_to_linear(i / 255.0));
    for (int i = 1; i < 256; i++)
        f->threshold[i] = (uint32_t)ceil(4 * 65535 * srgb_to_linear((i - 0.5) / 255));
    f->threshold[256] = UINT32_MAX;
    unsigned code = 0;
    for (uint32_t i = 0; i < sizeof f->guess; i++) {
        while (i * 16 >= f->threshold[code + 1])
            code++;
        f->guess[i] = (uint8_t)code;
    }
}

static void filter_init(filter *f, image_mip_kind kind)
{
    f->kind = kind;
    if (kind == IMAGE_MIP_SRGB) {
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

static uint8_t encode_sum(const filter *f, uint32_t sum)
{
    uint32_t guess = f->guess[sum >> 4];
    return (uint8_t)(guess + (sum >= f->threshold[guess + 1]));
}

static void srgb_texel_by_alpha(const filter *f, const uint8_t *const p[4], uint8_t *out)
{
    uint32_t alpha = 0;
    for (int i = 0; i < 4; i++)
        alpha += p[i][3];
    for (int c = 0; c < 3; c++) {
        uint64_t sum = 0, plain = 0;
        for (int i = 0; i < 4; i++) {
            sum += (uint64_t)p[i][3] * f->linear[p[i][c]];
            plain += f->linear[p[i][c]];
        }
        out[c] = encode_sum(f, (uint32_t)(alpha ? (4 * sum + alpha / 2) / alpha : plain));
    }
    out[3] = (uint8_t)((alpha + 2) >> 2);
}

static void srgb_row(const filter *f, const uint8_t *a, const uint8_t *b, uint32_t count,
                     uint8_t *out)
{
    const uint16_t *linear = f->linear;
    for (uint32_t x = 0; x < count; x++, a += 8, b += 8, out += 4) {
        if ((a[3] & a[7] & b[3] & b[7]) != 255) {
            srgb_texel_by_alpha(f, (const uint8_t *const[]) { a, a + 4, b, b + 4 }, out);
            continue;
        }
        for (int c = 0; c < 3; c++)
            out[c] = encode_sum(f, (uint32_t)linear[a[c]] + linear[a[c + 4]] + linear[b[c]] +
                                       linear[b[c + 4]]);
        out[3] = 255;
    }
}

static void normal_row(const uint8_t *a, const uint8_t *b, uint32_t count, uint8_t *out)
{
    for (uint32_t x = 0; x < count; x++, a += 8, b += 8, out += 4) {
        float n[3]; // of any length: 4 * 127.5 times the mean
        for (int c = 0; c < 3; c++)
            n[c] = (float)(a[c] + a[c + 4] + b[c] + b[c + 4] - 510);
        store_normal(n, out);
        out[3] = (uint8_t)((a[3] + a[7] + b[3] + b[7] + 2) >> 2);
    }
}

static void filter_even(const filter *f, const uint8_t *in, uint32_t width, uint32_t height,
                        uint8_t *out)
{
    size_t stride = (size_t)width * 4;
    uint32_t count = width / 2;
    for (uint32_t y = 0; y < height / 2; y++, in += 2 * stride, out += (size_t)count * 4) {
        if (f->kind == IMAGE_MIP_SRGB)
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
