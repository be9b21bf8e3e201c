// Radiance pictures (.hdr, .pic), reading.
//
// Greg Ward, "Real Pixels", Graphics Gems II (1991), and "Radiance File Formats": text
// header, an empty line, the resolution line, then scanlines of RGBE pixels: flat, with
// the old run lengths (1, 1, 1, n) or with the new ones, channel after channel.
//
// A mantissa m of exponent e stands for m * 2^(e - 136), as nearly every reader has it;
// Radiance itself puts it half a step higher.  The values are divided by the product of
// the header's EXPOSURE lines (and COLORCORR lines), so that they are the scene's.
#include "image/codec.h"

#include "base/log.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const ag_log *log;
    const char *name;
    const uint8_t *next, *end;
} reader;

typedef struct header {
    uint32_t width, height;         // px, of the picture as seen
    bool columns;                   // scanlines are columns
    bool flip_x, flip_y;            // ... that run from the right; from the bottom
    double exposure, correction[3]; // the products; pixels have been multiplied by them
} header;

static uint32_t scanline_length(const header *h)
{
    return h->columns ? h->height : h->width;
}

static uint32_t scanline_count(const header *h)
{
    return h->columns ? h->width : h->height;
}

// The next line without its end; false when there is none or it is too long.
static bool read_line(reader *r, char *line, size_t capacity)
{
    const uint8_t *end = memchr(r->next, '\n', (size_t)(r->end - r->next));
    if (!end || (size_t)(end - r->next) >= capacity)
        return false;
    size_t length = (size_t)(end - r->next);
    memcpy(line, r->next, length);
    if (length && line[length - 1] == '\r')
        length--;
    line[length] = 0;
    r->next = end + 1;
    return true;
}

static bool is_factor(double v)
{
    return v > 0 && isfinite(v);
}

// One `NAME=value` line of the header.
static ag_status read_variable(const reader *r, const char *line, header *h)
{
    if (strncmp(line, "FORMAT=", 7) == 0 && !strstr(line, "32-bit_rle_rgbe"))
        return log_fail(r->log, AG_ERROR_UNSUPPORTED,
                        "%s: the Radiance header says %s; only 32-bit_rle_rgbe can be read",
                        r->name, line);
    double v[3] = { 1, 1, 1 };
    char *end = NULL;
    if (strncmp(line, "EXPOSURE=", 9) == 0) {
        v[0] = strtod(line + 9, &end);
        h->exposure *= v[0];
    } else if (strncmp(line, "COLORCORR=", 10) == 0) {
        end = (char *)line + 10;
        for (int c = 0; c < 3; c++) {
            v[c] = strtod(end, &end);
            h->correction[c] *= v[c];
        }
    }
    bool sound = is_factor(v[0]) && is_factor(v[1]) && is_factor(v[2]) && is_factor(h->exposure);
    for (int c = 0; c < 3; c++)
        sound = sound && is_factor(h->correction[c]) && is_factor(h->exposure * h->correction[c]);
    if (!sound)
        return log_fail(r->log, AG_ERROR_FORMAT,
                        "%s: the Radiance header's %s is no positive number", r->name, line);
    return AG_OK;
}

static bool parse_axis(const char **text, char *sign, char *axis, uint32_t *size)
{
    const char *p = *text + strspn(*text, " ");
    if ((p[0] != '+' && p[0] != '-') || (p[1] != 'X' && p[1] != 'Y') || p[2] != ' ')
        return false;
    *sign = p[0];
    *axis = p[1];
    p += 2 + strspn(p + 2, " ");
    uint64_t value = 0;
    const char *digits = p;
    for (; *p >= '0' && *p <= '9' && p - digits < 10; p++)
        value = value * 10 + (uint64_t)(*p - '0');
    *text = p;
    *size = (uint32_t)value;
    return p > digits && value <= UINT32_MAX;
}

// The first axis is that from scanline to scanline.  +X runs to the right, +Y upwards.
static bool parse_resolution(const char *line, header *h)
{
    char sign[2], axis[2];
    uint32_t size[2];
    if (!parse_axis(&line, &sign[0], &axis[0], &size[0]) ||
        !parse_axis(&line, &sign[1], &axis[1], &size[1]) || axis[0] == axis[1])
        return false;
    if (line[strspn(line, " ")])
        return false;
    h->columns = axis[0] == 'X';
    int x = h->columns ? 0 : 1, y = 1 - x;
    h->width = size[x];
    h->height = size[y];
    h->flip_x = sign[x] == '-';
    h->flip_y = sign[y] == '+';
    return true;
}

static ag_status read_header(reader *r, header *h)
{
    *h = (header) { .exposure = 1, .correction = { 1, 1, 1 } };
    char line[4096];
    bool more;
    while ((more = read_line(r, line, sizeof line)) && line[0]) {
        ag_status status = read_variable(r, line, h);
        if (status)
            return status;
    }
    if (!more || !read_line(r, line, sizeof line))
        return log_fail(r->log, AG_ERROR_FORMAT,
                        "%s: the Radiance header is cut short or has a line above 4095 bytes",
                        r->name);
    if (!parse_resolution(line, h))
        return log_fail(r->log, AG_ERROR_FORMAT,
                        "%s: the Radiance resolution line is \"%.80s\", not as \"-Y 512 +X 1024\"",
                        r->name, line);
    return AG_OK;
}

// New run lengths: each of the four channels by itself, into planes of `length` bytes.
static bool read_new_scanline(reader *r, uint8_t *planes, uint32_t length)
{
    r->next += 4;
    for (uint32_t channel = 0; channel < 4; channel++) {
        uint8_t *out = planes + (size_t)channel * length, *end = out + length;
        while (out < end) {
            if (r->end - r->next < 2)
                return false;
            size_t n = *r->next++;
            if (n > 128) { // a run
                n -= 128;
                if (n > (size_t)(end - out))
                    return false;
                memset(out, *r->next++, n);
            } else { // as they are
                if (n == 0 || n > (size_t)(end - out) || n > (size_t)(r->end - r->next))
                    return false;
                memcpy(out, r->next, n);
                r->next += n;
            }
            out += n;
        }
    }
    return true;
}

// Flat pixels and old run lengths: (1, 1, 1, n) repeats the pixel before it n times, and
// n counts for 256 times more with each such mark that follows another.
static bool read_old_scanline(reader *r, uint8_t *planes, uint32_t length)
{
    unsigned shift = 0;
    for (uint32_t i = 0; i < length;) {
        if (r->end - r->next < 4)
            return false;
        const uint8_t *p = r->next;
        r->next += 4;
        if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
            uint64_t n = shift < 32 ? (uint64_t)p[3] << shift : UINT64_MAX;
            if (i == 0 || n > length - i)
                return false;
            for (uint32_t channel = 0; channel < 4; channel++) {
                uint8_t *out = planes + (size_t)channel * length + i;
                memset(out, out[-1], (size_t)n);
            }
            i += (uint32_t)n;
            shift += 8;
        } else {
            for (uint32_t channel = 0; channel < 4; channel++)
                planes[(size_t)channel * length + i] = p[channel];
            i++;
            shift = 0;
        }
    }
    return true;
}

static bool read_scanline(reader *r, uint8_t *planes, uint32_t length)
{
    const uint8_t *p = r->next;
    bool is_new = length >= 8 && length <= 32767 && r->end - p >= 4 && p[0] == 2 && p[1] == 2 &&
                  (uint32_t)(p[2] << 8 | p[3]) == length;
    return is_new ? read_new_scanline(r, planes, length) : read_old_scanline(r, planes, length);
}

// scale[c][e] = what a mantissa of exponent e is multiplied by, in channel c.
static void fill_scale(const header *h, float scale[3][256])
{
    for (int c = 0; c < 3; c++)
        for (int e = 0; e < 256; e++) {
            double v = e ? ldexp(1, e - 136) / (h->exposure * h->correction[c]) : 0;
            scale[c][e] = (float)fmin(v, (double)FLT_MAX / 256);
        }
}

static void expand(const uint8_t *planes, uint32_t length, float scale[3][256], float *out,
                   ptrdiff_t step)
{
    const uint8_t *red = planes, *green = red + length, *blue = green + length;
    const uint8_t *exponent = blue + length;
    for (uint32_t i = 0; i < length; i++, out += step) {
        uint8_t e = exponent[i];
        out[0] = (float)red[i] * scale[0][e];
        out[1] = (float)green[i] * scale[1][e];
        out[2] = (float)blue[i] * scale[2][e];
        out[3] = 1;
    }
}

static ag_status read_pixels(reader *r, const header *h, uint8_t *planes, float *pixels)
{
    float scale[3][256];
    fill_scale(h, scale);
    uint32_t length = scanline_length(h), count = scanline_count(h);
    ptrdiff_t right = h->flip_x ? -4 : 4, down = (ptrdiff_t)h->width * (h->flip_y ? -4 : 4);
    pixels += h->flip_x ? (size_t)(h->width - 1) * 4 : 0;
    pixels += h->flip_y ? (size_t)(h->height - 1) * h->width * 4 : 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!read_scanline(r, planes, length))
            return log_fail(r->log, AG_ERROR_FORMAT,
                            "%s: the Radiance picture is broken or cut short in scanline %u of %u",
                            r->name, i + 1, count);
        expand(planes, length, scale, pixels + (ptrdiff_t)i * (h->columns ? right : down),
               h->columns ? down : right);
    }
    return AG_OK;
}

// The least that a scanline takes: a pixel and a run, or, the new way, two bytes for 127.
static bool is_plausible(const header *h, size_t bytes)
{
    uint64_t length = scanline_length(h), old_least = length > 1 ? 8 : 4;
    uint64_t new_least = 4 + 4 * 2 * ((length + 126) / 127);
    uint64_t least = length > 32767 || old_least < new_least ? old_least : new_least;
    return codec_size_is_plausible(h->width, h->height, bytes, 4096) &&
           scanline_count(h) <= bytes / least;
}

ag_status image_decode_hdr(const ag_log *log, const char *name, const void *data, size_t size,
                           ag_image **image)
{
    *image = NULL;
    reader r = { log, name, data, (const uint8_t *)data + size };
    header h;
    ag_status status = read_header(&r, &h);
    if (status)
        return status;
    size_t left = (size_t)(r.end - r.next);
    if (!is_plausible(&h, left))
        return codec_fail_size(log, name, "Radiance", h.width, h.height, left);
    uint8_t *planes = malloc((size_t)scanline_length(&h) * 4);
    if (!planes)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory for a scanline", name);
    status = image_allocate(log, name, h.width, h.height, AG_FORMAT_RGBA32F, image);
    if (!status)
        status = read_pixels(&r, &h, planes, (*image)->pixels);
    free(planes);
    if (status) {
        ag_image_destroy(*image);
        *image = NULL;
    }
    return status;
}
