// PNG, writing it fast: bands of rows are filtered and deflated side by side on all cores,
// each to an IDAT chunk of its own (ISO/IEC 15948; see deflate.h).
#include "image/png_write.h"

#include "base/log.h"
#include "base/threads.h"
#include "image/deflate.h"

#include <stdlib.h>
#include <string.h>

enum {
    BAND_BYTES = 256 << 10, // of filtered rows, or one row
    BANDS = 16,             // made at a time, so that memory stays small
};

typedef struct band {
    uint8_t *rows;    // filtered: each with its filter's number before it
    uint8_t *scratch; // two rows without alpha
    uint16_t *tokens;
    uint8_t *chunk; // length, type, data, checksum
    size_t chunk_bytes;
    size_t row_bytes; // of all filtered rows
    uint32_t adler;   // of them
} band;

typedef struct encoder {
    const ag_log *log;
    const char *name;
    const ag_image *image;
    size_t channels;     // 3 or 4
    int filter;          // PNG's number: 2 Up, 4 Paeth
    uint32_t band_rows;  // rows of a band
    uint32_t first_band; // of those that are being made
    uint32_t crc[4][256];
    band bands[BANDS];
} encoder;

// CRC-32 of ISO 3309, four bytes at a time: crc[k][i] is byte i followed by k zero bytes.
static void fill_crc(uint32_t crc[4][256])
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t v = i;
        for (int bit = 0; bit < 8; bit++)
            v = v >> 1 ^ (v & 1 ? 0xedb88320 : 0);
        crc[0][i] = v;
    }
    for (int k = 1; k < 4; k++)
        for (uint32_t i = 0; i < 256; i++)
            crc[k][i] = crc[k - 1][i] >> 8 ^ crc[0][crc[k - 1][i] & 255];
}

static uint32_t crc_of(const encoder *e, const uint8_t *p, size_t size)
{
    uint32_t v = 0xffffffff;
    for (; size >= 4; size -= 4, p += 4) {
        v ^= (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
        v = e->crc[3][v & 255] ^ e->crc[2][v >> 8 & 255] ^ e->crc[1][v >> 16 & 255] ^
            e->crc[0][v >> 24];
    }
    for (; size; size--)
        v = v >> 8 ^ e->crc[0][(v ^ *p++) & 255];
    return ~v;
}

static void put_u32(uint8_t *out, uint32_t v)
{
    for (int i = 0; i < 4; i++)
        out[i] = (uint8_t)(v >> (24 - 8 * i));
}

// Put length, type and checksum around the `size` bytes at chunk + 8.
static size_t finish_chunk(const encoder *e, uint8_t *chunk, const char *type, size_t size)
{
    put_u32(chunk, (uint32_t)size);
    memcpy(chunk + 4, type, 4);
    put_u32(chunk + 8 + size, crc_of(e, chunk + 4, size + 4));
    return size + 12;
}

// ISO/IEC 15948, 9.4, on differences: with p = a + b - c, p - a = b - c and p - b = a - c.
static void filter_paeth(const uint8_t *row, const uint8_t *above, size_t size, size_t channels,
                         uint8_t *restrict out)
{
    for (size_t i = 0; i < channels; i++)
        out[i] = (uint8_t)(row[i] - above[i]);
    for (size_t i = channels; i < size; i++) {
        int16_t a = row[i - channels], b = above[i], c = above[i - channels];
        int16_t da = (int16_t)(b - c), db = (int16_t)(a - c), dc = (int16_t)(da + db);
        int16_t pa = (int16_t)(da < 0 ? -da : da), pb = (int16_t)(db < 0 ? -db : db);
        int16_t pc = (int16_t)(dc < 0 ? -dc : dc);
        int16_t bc = pb <= pc ? b : c, least = pb <= pc ? pb : pc;
        out[i] = (uint8_t)(row[i] - (pa <= least ? a : bc));
    }
}

static void filter_up(const uint8_t *row, const uint8_t *above, size_t size, uint8_t *restrict out)
{
    for (size_t i = 0; i < size; i++)
        out[i] = (uint8_t)(row[i] - above[i]);
}

// Row `y` as it is filed: the image's own, or without alpha in `scratch`.
static const uint8_t *file_row(const encoder *e, uint32_t y, uint8_t *scratch)
{
    size_t width = e->image->width;
    const uint8_t *in = (const uint8_t *)e->image->pixels + y * width * 4;
    if (e->channels == 4)
        return in;
    for (size_t x = 0; x < width; x++) {
        scratch[3 * x] = in[4 * x];
        scratch[3 * x + 1] = in[4 * x + 1];
        scratch[3 * x + 2] = in[4 * x + 2];
    }
    return scratch;
}

static void filter_rows(const encoder *e, band *b, uint32_t first, uint32_t end)
{
    size_t size = e->image->width * e->channels;
    uint8_t *spare[2] = { b->scratch, b->scratch + size }, *out = b->rows;
    const uint8_t *above = memset(spare[0], 0, size);
    if (first > 0)
        above = file_row(e, first - 1, spare[0]);
    for (uint32_t y = first; y < end; y++, out += size + 1) {
        const uint8_t *row = file_row(e, y, spare[(y - first + 1) % 2]);
        out[0] = (uint8_t)e->filter;
        if (e->filter == 4)
            filter_paeth(row, above, size, e->channels, out + 1);
        else
            filter_up(row, above, size, out + 1);
        above = row;
    }
    b->row_bytes = (size_t)(out - b->rows);
}

static void encode_band(void *context, size_t index)
{
    encoder *e = context;
    band *b = &e->bands[index];
    uint32_t height = e->image->height, first = (e->first_band + (uint32_t)index) * e->band_rows;
    uint32_t end = height - first < e->band_rows ? height : first + e->band_rows;
    filter_rows(e, b, first, end);
    b->adler = deflate_adler(1, b->rows, b->row_bytes);
    uint8_t *data = b->chunk + 8;
    size_t size = 0;
    if (first == 0) { // zlib's header (RFC 1950): deflate, a window of 32 KiB, fast
        data[size++] = 0x78;
        data[size++] = 0x01;
    }
    size += deflate_runs(b->rows, b->row_bytes, b->tokens, data + size);
    b->chunk_bytes = finish_chunk(e, b->chunk, "IDAT", size);
}

static bool allocate_bands(encoder *e, uint32_t count)
{
    size_t row = e->image->width * e->channels, filtered = (row + 1) * e->band_rows;
    bool sound = true;
    for (uint32_t i = 0; i < count && i < BANDS; i++) {
        band *b = &e->bands[i];
        b->rows = malloc(filtered);
        b->scratch = malloc(2 * row);
        b->tokens = malloc(filtered * sizeof *b->tokens);
        b->chunk = malloc(deflate_bound(filtered) + 16);
        sound = sound && b->rows && b->scratch && b->tokens && b->chunk;
    }
    return sound;
}

static void free_bands(encoder *e)
{
    for (int i = 0; i < BANDS; i++) {
        free(e->bands[i].rows);
        free(e->bands[i].scratch);
        free(e->bands[i].tokens);
        free(e->bands[i].chunk);
    }
}

static ag_status put_begin(const encoder *e, file_writer *out)
{
    uint8_t bytes[8 + 25 + 13];
    memcpy(bytes, "\x89PNG\r\n\x1a\n", 8);
    uint8_t *header = bytes + 8, *srgb = header + 25;
    put_u32(header + 8, e->image->width);
    put_u32(header + 12, e->image->height);
    const uint8_t kind[5] = { 8, e->channels == 4 ? 6 : 2, 0, 0, 0 };
    memcpy(header + 16, kind, 5);
    finish_chunk(e, header, "IHDR", 13);
    srgb[8] = 0; // perceptual
    finish_chunk(e, srgb, "sRGB", 1);
    return file_writer_put(out, bytes, sizeof bytes);
}

static ag_status put_note(const encoder *e, const note_chunk *note, file_writer *out)
{
    uint8_t *chunk = malloc(note->size + 12);
    if (!chunk)
        return log_fail(e->log, AG_ERROR_MEMORY, "%s: no memory to write it", e->name);
    memcpy(chunk + 8, note->data, note->size);
    ag_status status = file_writer_put(out, chunk, finish_chunk(e, chunk, note->type, note->size));
    free(chunk);
    return status;
}

static ag_status put_bands(encoder *e, uint32_t count, file_writer *out, uint32_t *adler)
{
    for (e->first_band = 0; e->first_band < count; e->first_band += BANDS) {
        uint32_t left = count - e->first_band, now = left < BANDS ? left : BANDS;
        parallel_for(now, encode_band, e);
        for (uint32_t i = 0; i < now; i++) {
            const band *b = &e->bands[i];
            *adler = deflate_adler_join(*adler, b->adler, b->row_bytes);
            ag_status status = file_writer_put(out, b->chunk, b->chunk_bytes);
            if (status)
                return status;
        }
    }
    return AG_OK;
}

static ag_status put_end(const encoder *e, uint32_t adler, file_writer *out)
{
    uint8_t bytes[12 + 9 + 12];
    size_t size = deflate_end(bytes + 8);
    put_u32(bytes + 8 + size, adler);
    size = finish_chunk(e, bytes, "IDAT", size + 4);
    size += finish_chunk(e, bytes + size, "IEND", 0);
    return file_writer_put(out, bytes, size);
}

ag_status png_write_fast(const ag_log *log, const char *name, const ag_image *image, bool opaque,
                         int filter, const note_chunk *notes, size_t note_count, file_writer *out)
{
    encoder *e = calloc(1, sizeof *e);
    if (!e)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory to write it", name);
    e->log = log;
    e->name = name;
    e->image = image;
    e->channels = opaque ? 3 : 4;
    e->filter = filter;
    size_t row = image->width * e->channels;
    e->band_rows = row < BAND_BYTES ? (uint32_t)(BAND_BYTES / row) : 1;
    uint32_t count = (image->height - 1) / e->band_rows + 1, adler = 1;
    fill_crc(e->crc);
    ag_status status = AG_OK;
    if (!allocate_bands(e, count))
        status = log_fail(log, AG_ERROR_MEMORY, "%s: no memory to write it", name);
    if (!status)
        status = put_begin(e, out);
    for (size_t i = 0; i < note_count && !status; i++)
        status = put_note(e, &notes[i], out);
    if (!status)
        status = put_bands(e, count, out, &adler);
    if (!status)
        status = put_end(e, adler, out);
    free_bands(e);
    free(e);
    return status;
}
