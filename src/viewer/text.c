// Text: UTF-8 laid over a canvas in the packaged font.
//
// Letters stand at quarters of a pixel and are hinted in height only, so that their spacing is
// the font's own at any size.
#include "text.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { regular, bold, face_count };

// How a character looks at one size and one quarter of a pixel.
typedef struct glyph {
    uint64_t key; // 0 -> this place of the table is free
    FT_UInt index;
    float advance; // px
    int left, top; // px, from the base line's start to the mask's top left
    int width, height;
    uint8_t *mask; // [height][width]
} glyph;

enum { table_size = 4096 }; // half of it is used at most

struct text {
    FT_Library library;
    FT_Face faces[face_count];
    glyph *table;
    size_t used;
};

// ---- The font --------------------------------------------------------------

__attribute__((format(printf, 3, 4))) static ag_status fail(const ag_log *log, ag_status status,
                                                            const char *format, ...)
{
    char sentence[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    if (log && log->write)
        log->write(log->user, AG_LOG_ERROR, sentence);
    else
        fprintf(stderr, "argand: error: %s\n", sentence);
    return status;
}

static ag_status open_face(const ag_log *log, text *t, int which, const char *name)
{
    const char *folder = getenv("ARGAND_FONTS");
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder ? folder : ARGAND_FONTS, name);
    FT_Error error = FT_New_Face(t->library, path, 0, &t->faces[which]);
    if (!error && FT_IS_SCALABLE(t->faces[which]))
        return AG_OK;
    if (error == FT_Err_Cannot_Open_Resource)
        return fail(log, AG_ERROR_FILE,
                    "%s: cannot be opened, so nothing is written on the window; install Debian's "
                    "fonts-dejavu-core, or name the folder of this font in ARGAND_FONTS",
                    path);
    return fail(log, AG_ERROR_FORMAT, "%s: is no outline font that FreeType can read", path);
}

ag_status text_create(const ag_log *log, text **made)
{
    *made = NULL;
    text *t = calloc(1, sizeof *t);
    ag_status status = AG_ERROR_MEMORY;
    if (!t || !(t->table = calloc(table_size, sizeof *t->table)) || FT_Init_FreeType(&t->library))
        status = fail(log, AG_ERROR_MEMORY, "There is no memory for the font.");
    else if (!(status = open_face(log, t, regular, "DejaVuSans.ttf")))
        status = open_face(log, t, bold, "DejaVuSans-Bold.ttf");
    if (status) {
        text_destroy(t);
        return status;
    }
    *made = t;
    return AG_OK;
}

static void forget_glyphs(text *t)
{
    for (size_t i = 0; t->table && i < table_size; i++)
        free(t->table[i].mask);
    if (t->table)
        memset(t->table, 0, table_size * sizeof *t->table);
    t->used = 0;
}

void text_destroy(text *t)
{
    if (!t)
        return;
    forget_glyphs(t);
    free(t->table);
    for (int i = 0; i < face_count; i++)
        if (t->faces[i])
            FT_Done_Face(t->faces[i]);
    if (t->library)
        FT_Done_FreeType(t->library);
    free(t);
}

// ---- Glyphs ----------------------------------------------------------------

static float clamp_size(float size_px)
{
    return size_px > 4.0f ? fminf(size_px, 400.0f) : 4.0f;
}

static FT_Face face_of(const text *t, text_style style)
{
    return t->faces[style.bold ? bold : regular];
}

static uint64_t key_of(text_style style, uint32_t character, unsigned quarter)
{
    uint64_t size = (uint64_t)lroundf(64.0f * clamp_size(style.size_px));
    return (uint64_t)1 << 63 | size << 32 | (uint64_t)style.bold << 31 | (uint64_t)quarter << 29 |
           character;
}

static void draw_mask(FT_GlyphSlot slot, glyph *g)
{
    const FT_Bitmap *bitmap = &slot->bitmap;
    size_t width = bitmap->width, height = bitmap->rows;
    if (!width || !height || !(g->mask = malloc(width * height)))
        return;
    g->left = slot->bitmap_left;
    g->top = slot->bitmap_top;
    g->width = (int)width;
    g->height = (int)height;
    for (size_t y = 0; y < height; y++)
        memcpy(g->mask + y * width, bitmap->buffer + (ptrdiff_t)y * bitmap->pitch, width);
}

static void make_glyph(FT_Face face, uint64_t key, glyph *g)
{
    uint32_t character = key & 0x1fffffff, quarter = key >> 29 & 3, size = key >> 32 & 0xffff;
    *g = (glyph) { .key = key, .index = FT_Get_Char_Index(face, character) };
    if (FT_Set_Char_Size(face, 0, (FT_F26Dot6)size, 72, 72) ||
        FT_Load_Glyph(face, g->index, FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP))
        return;
    g->advance = (float)face->glyph->linearHoriAdvance / 65536.0f;
    FT_Outline_Translate(&face->glyph->outline, (FT_Pos)(16 * quarter), 0);
    if (!FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL))
        draw_mask(face->glyph, g);
}

// Borrowed until the next call.
static const glyph *find_glyph(text *t, text_style style, uint32_t character, unsigned quarter)
{
    uint64_t key = key_of(style, character, quarter);
    if (t->used >= table_size / 2)
        forget_glyphs(t);
    size_t at = (size_t)(key * 0x9e3779b97f4a7c15u >> 40) % table_size;
    while (t->table[at].key && t->table[at].key != key)
        at = (at + 1) % table_size;
    if (!t->table[at].key) {
        make_glyph(face_of(t, style), key, &t->table[at]);
        t->used++;
    }
    return &t->table[at];
}

// px between two neighbours beyond their advance.
static float kerning(FT_Face face, text_style style, FT_UInt left, FT_UInt right)
{
    FT_Vector units;
    if (!left || !right || FT_Get_Kerning(face, left, right, FT_KERNING_UNSCALED, &units))
        return 0.0f;
    return (float)units.x * clamp_size(style.size_px) / (float)face->units_per_EM;
}

// ---- UTF-8 -----------------------------------------------------------------

// The next character of what is not empty; U+FFFD for a byte that is not part of one.
static uint32_t next_character(const char **utf8, const char *end)
{
    static const uint32_t smallest[] = { 0, 0, 0x80, 0x800, 0x10000 };
    const unsigned char *s = (const unsigned char *)*utf8;
    size_t size = *s < 0x80 ? 1 : *s >> 5 == 6 ? 2 : *s >> 4 == 14 ? 3 : *s >> 3 == 30 ? 4 : 0;
    *utf8 += 1;
    if (size < 2)
        return size ? *s : 0xfffd;
    uint32_t character = *s & (0x7fu >> size);
    if (size > (size_t)(end - (const char *)s))
        return 0xfffd;
    for (size_t i = 1; i < size; i++) {
        if (s[i] >> 6 != 2)
            return 0xfffd;
        character = character << 6 | (s[i] & 0x3f);
    }
    if (character < smallest[size] || character > 0x10ffff || character >> 11 == 0x1b)
        return 0xfffd;
    *utf8 += size - 1;
    return character;
}

static const char *end_of(const char *utf8, size_t length)
{
    return utf8 + strnlen(utf8, length);
}

// ---- Lines -----------------------------------------------------------------

typedef struct pen {
    text *t;
    text_style style;
    float x;
    FT_UInt last;
} pen;

// Move over a character; returns it as it is to be drawn from `*start`.
static const glyph *pen_step(pen *p, uint32_t character, float *start)
{
    if (character < 0x20 || (character >= 0x7f && character < 0xa0))
        return NULL;
    const glyph *plain = find_glyph(p->t, p->style, character, 0);
    float x = p->x + kerning(face_of(p->t, p->style), p->style, p->last, plain->index);
    p->x = x + plain->advance;
    p->last = plain->index;
    if (!start)
        return plain;
    float quarters = floorf(4.0f * x + 0.5f);
    *start = floorf(quarters / 4.0f);
    return find_glyph(p->t, p->style, character, (unsigned)(quarters - 4.0f * *start));
}

text_metrics text_line(text *t, text_style style)
{
    FT_Face face = face_of(t, style);
    float scale = clamp_size(style.size_px) / (float)face->units_per_EM;
    return (text_metrics) { .ascent = scale * (float)face->ascender,
                            .descent = -scale * (float)face->descender,
                            .line = scale * (float)face->height };
}

float text_width(text *t, text_style style, const char *utf8, size_t length)
{
    const char *end = end_of(utf8, length);
    pen p = { .t = t, .style = style };
    while (utf8 < end)
        pen_step(&p, next_character(&utf8, end), NULL);
    return p.x;
}

float text_draw(text *t, const canvas *c, float x, float y, text_style style, color over,
                const char *utf8, size_t length)
{
    const char *end = end_of(utf8, length);
    pen p = { .t = t, .style = style, .x = x };
    int base = (int)lroundf(y);
    while (utf8 < end) {
        float start;
        const glyph *g = pen_step(&p, next_character(&utf8, end), &start);
        if (g && g->mask)
            canvas_mask(c, (int)start + g->left, base - g->top, g->mask, g->width, g->height,
                        g->width, over);
    }
    return p.x;
}

size_t text_fit(text *t, text_style style, const char *utf8, float width)
{
    const char *at = utf8, *end = end_of(utf8, SIZE_MAX), *space = NULL;
    pen p = { .t = t, .style = style };
    while (at < end && *at != '\n') {
        const char *before = at;
        if (*at == ' ')
            space = at;
        pen_step(&p, next_character(&at, end), NULL);
        if (p.x > width && before > utf8 && *before != ' ')
            return (size_t)((space && space > utf8 ? space : before) - utf8);
    }
    return (size_t)(at - utf8);
}
