// What is told of a picture's exposure.
#ifndef CLI_EXPOSURE_REPORT_H
#define CLI_EXPOSURE_REPORT_H

#include "eye_options.h"
#include "json.h"

// Into a report: the factor and its EV100.
void report_exposure(json *j, float exposure);

// What a line about a picture says of it, "" where there is nothing new in it: the caller lends
// 32 bytes.
const char *exposure_words(const eye_request *eye, float exposure, char words[32]);

#endif
