// Small questions about strings.
#ifndef CLI_TEXT_H
#define CLI_TEXT_H

#include <stdbool.h>
#include <stddef.h>

// The candidate that `word` was most likely meant to be, or NULL when none is near.
const char *text_nearest(const char *word, const char *const *candidates, size_t count);

// Does `text` end in `ending`, letter case ignored?
bool text_ends(const char *text, const char *ending);

// `count` with commas between thousands: "15,452".  Static texts would be shared state:
// the caller lends 32 bytes.
const char *text_count(unsigned long long count, char buffer[32]);

#endif
