// What the tests of the scene share.
#ifndef TESTS_SCENE_HELPERS_H
#define TESTS_SCENE_HELPERS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <argand/argand.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

// A log that keeps the last sentence.
typedef struct sentences {
    unsigned count;
    char last[1024];
} sentences;

static inline void keep_sentence(void *user, ag_log_level level, const char *sentence)
{
    (void)level;
    sentences *s = user;
    s->count++;
    snprintf(s->last, sizeof s->last, "%s", sentence);
}

static inline ag_scene *make_scene(sentences *s)
{
    ag_log log = { .write = keep_sentence, .user = s, .level = AG_LOG_WARNING };
    ag_scene *scene = NULL;
    assert_int_equal(ag_scene_create(&log, &scene), AG_OK);
    return scene;
}

#define assert_near(value, wanted, tolerance)                                                      \
    assert_true(fabs((double)(value) - (double)(wanted)) <= (double)(tolerance))

// Repeatable noise in [0, 1).
static inline float noise(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static inline double dot3(const float a[3], const float b[3])
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

#endif
