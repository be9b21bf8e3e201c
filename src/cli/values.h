// Values of options, read strictly: the whole text must be the value, and NaN, infinity and
// what a float cannot hold are refused.  Each is an option_reader (options.h).
#ifndef CLI_VALUES_H
#define CLI_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct picture_size {
    uint32_t width, height; // px
} picture_size;

// A text taken as it is, not empty; `field` is a const char *, borrowed from argv.
const char *value_text(const char *value, void *field);

// WxH; a picture_size of at most 2^28 pixels.
const char *value_size(const char *value, void *field);

// Whole numbers; `field` is a uint32_t.
const char *value_whole(const char *value, void *field);   // 0 to 999999999
const char *value_samples(const char *value, void *field); // 1 to 2^24

// Finite numbers; `field` is a float.
const char *value_degrees(const char *value, void *field);     // any; radians in the field
const char *value_fov_degrees(const char *value, void *field); // (0, 180); radians
const char *value_factor(const char *value, void *field);      // above 0
const char *value_ev100(const char *value, void *field);       // [-32, 32]
const char *value_seconds(const char *value, void *field);     // 0.001 to 1e7
const char *value_share(const char *value, void *field);       // 0 to 1
const char *value_noise(const char *value, void *field);       // 1e-5 to 1, without it
const char *value_at_least_0(const char *value, void *field);
const char *value_cone_degrees(const char *value, void *field); // [0, 90]; radians
const char *value_sun_degrees(const char *value, void *field);  // (0, 90); radians

// Numbers with commas between; `field` is float[3].
const char *value_vector(const char *value, void *field);        // any
const char *value_direction(const char *value, void *field);     // not 0,0,0
const char *value_weights(const char *value, void *field);       // none below 0
const char *value_color_weights(const char *value, void *field); // nor all of them 0

// 4 or 9 numbers, or three times as many; `field` is float[9][3], a single number in all three.
const char *value_terms(const char *value, void *field);

// Three numbers, "auto" for any; `field` is float[3] with NAN where automatic.
const char *value_orbit(const char *value, void *field);  // degrees, degrees, metres; radians
const char *value_target(const char *value, void *field); // metres

// #rrggbb; `field` is float[3], sRGB-coded in [0, 1].
bool value_color(const char *value, float color[3]);

// How many numbers there are with commas between; 0 for anything else or more than `most`.
size_t value_numbers(const char *value, double *numbers, size_t most);

// An index: digits only, below 2^31; false for anything else.
bool value_index(const char *value, uint32_t *index);

#endif
