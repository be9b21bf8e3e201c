// A canvas: pixels that shapes are laid over.
#include "canvas.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static uint8_t byte(float value)
{
    return (uint8_t)(value + 0.5f);
}

// Straight alpha over straight alpha (Porter & Duff 1984, "over").
static void mix(uint8_t *pixel, color over, float cover)
{
    float front = (float)over.a * cover / 255.0f;
    float back = (float)pixel[3] / 255.0f * (1.0f - front);
    float alpha = front + back;
    if (front <= 0.0f)
        return;
    const uint8_t channels[3] = { over.r, over.g, over.b };
    for (int i = 0; i < 3; i++)
        pixel[i] = byte(((float)channels[i] * front + (float)pixel[i] * back) / alpha);
    pixel[3] = byte(255.0f * alpha);
}

static float clamp_unit(float x)
{
    return x > 0.0f ? fminf(x, 1.0f) : 0.0f;
}

// How much of the pixel around a point lies in the shape: from the distance to its edge.
static float coverage(const box *shape, float radius, float x, float y)
{
    float half_x = 0.5f * shape->width, half_y = 0.5f * shape->height;
    float dx = fabsf(x - shape->x - half_x) - half_x + radius;
    float dy = fabsf(y - shape->y - half_y) - half_y + radius;
    if (radius > 0.0f && dx > 0.0f && dy > 0.0f)
        return clamp_unit(0.5f + radius - sqrtf(dx * dx + dy * dy));
    return clamp_unit(0.5f + radius - dx) * clamp_unit(0.5f + radius - dy);
}

static uint32_t inside(float at, uint32_t end)
{
    return at > 0.0f ? (uint32_t)fminf(at, (float)end) : 0;
}

// Pixels that are all covered as much; neighbours are mostly equal, and mixed once.
static void fill_span(uint8_t *pixel, uint32_t count, float cover, color over)
{
    uint32_t before = 0, mixed = 0, now;
    for (uint32_t i = 0; i < count; i++, pixel += 4) {
        memcpy(&now, pixel, 4);
        if (i == 0 || now != before) {
            mix(pixel, over, cover);
            memcpy(&mixed, pixel, 4);
        } else {
            memcpy(pixel, &mixed, 4);
        }
        before = now;
    }
}

void canvas_fill(const canvas *c, box shape, float radius, color over)
{
    if (!(shape.width > 0.0f && shape.height > 0.0f))
        return;
    radius = fminf(radius, 0.5f * fminf(shape.width, shape.height));
    uint32_t left = inside(shape.x - 1.0f, c->width), top = inside(shape.y - 1.0f, c->height);
    uint32_t right = inside(shape.x + shape.width + 2.0f, c->width);
    uint32_t bottom = inside(shape.y + shape.height + 2.0f, c->height);
    for (uint32_t y = top; y < bottom; y++) {
        uint8_t *row = c->pixels + 4 * (size_t)y * c->width;
        float at = (float)y + 0.5f;
        bool round = at < shape.y + radius || at > shape.y + shape.height - radius;
        float side = (round ? radius : 0.0f) + 1.0f;
        uint32_t from = inside(shape.x + side, c->width);
        uint32_t to = inside(shape.x + shape.width - side, c->width);
        for (uint32_t x = left; x < right; x++) {
            if (x == from && to > from) {
                float cover = coverage(&shape, radius, (float)x + 0.5f, at);
                fill_span(row + 4 * (size_t)x, to - from, cover, over);
                x = to;
            }
            if (x < right)
                mix(row + 4 * (size_t)x, over, coverage(&shape, radius, (float)x + 0.5f, at));
        }
    }
}

void canvas_mask(const canvas *c, int x, int y, const uint8_t *mask, int width, int height,
                 ptrdiff_t stride, color over)
{
    for (int j = 0; j < height; j++) {
        int64_t row = (int64_t)y + j;
        if (row < 0 || row >= (int64_t)c->height)
            continue;
        for (int i = 0; i < width; i++) {
            int64_t column = (int64_t)x + i;
            uint8_t cover = mask[j * stride + i];
            if (cover && column >= 0 && column < (int64_t)c->width)
                mix(c->pixels + 4 * ((size_t)row * c->width + (size_t)column), over,
                    (float)cover / 255.0f);
        }
    }
}
