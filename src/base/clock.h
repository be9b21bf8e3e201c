// Wall time.
#ifndef AG_BASE_CLOCK_H
#define AG_BASE_CLOCK_H

// Milliseconds since some fixed moment, monotonic.
double clock_ms(void);

#endif
