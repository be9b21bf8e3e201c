// What is told of a picture's exposure.
#include "exposure_report.h"

#include <stdio.h>

void report_exposure(json *j, float exposure)
{
    json_real(j, "exposure", (double)exposure);
    json_real(j, "ev100", (double)ag_ev100_from_exposure(exposure));
}

const char *exposure_words(const eye_request *e, float exposure, char words[32])
{
    *words = 0;
    if (e->exposure.automatic || e->camera_given)
        snprintf(words, 32, ", EV100 %.2f", (double)ag_ev100_from_exposure(exposure));
    return words;
}
