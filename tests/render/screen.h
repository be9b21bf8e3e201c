// What a display shows: the XWD file that Xvfb keeps up to date (tests/with_display.sh).
#ifndef TESTS_RENDER_SCREEN_H
#define TESTS_RENDER_SCREEN_H

#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct screen {
    const uint8_t *file;
    size_t size;
} screen;

static inline bool screen_open(screen *s)
{
    const char *path = getenv("ARGAND_TEST_SCREEN");
    int file = path ? open(path, O_RDONLY) : -1;
    struct stat info;
    void *mapped = MAP_FAILED;
    if (file >= 0 && fstat(file, &info) == 0)
        mapped = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_SHARED, file, 0);
    if (file >= 0)
        close(file);
    if (mapped == MAP_FAILED)
        return false;
    *s = (screen) { mapped, (size_t)info.st_size };
    return true;
}

static inline void screen_close(screen *s)
{
    munmap((void *)(uintptr_t)s->file, s->size);
}

// A number of the head, big-endian.
static inline uint32_t screen_word(const screen *s, int index)
{
    const uint8_t *b = s->file + 4 * index;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static inline void screen_pixel(const screen *s, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    enum { HEAD_SIZE = 0, LINE_SIZE = 12, COLORS = 19, COLOR_SIZE = 12 };
    size_t at = screen_word(s, HEAD_SIZE) + (size_t)COLOR_SIZE * screen_word(s, COLORS) +
                (size_t)y * screen_word(s, LINE_SIZE) + 4ul * x;
    for (int c = 0; c < 3; c++)
        rgb[c] = s->file[at + 2 - (size_t)c]; // blue first
}

#endif
