// What a picture's file says of how the picture was made.
#include "notes.h"

#include <stdio.h>

static void add(ag_image_save_options *options, notes *n, const char *key, float number)
{
    n->list[options->note_count++] = (ag_image_note) { .key = key, .number = (double)number };
}

ag_image_save_options notes_of_map(notes *n)
{
    snprintf(n->software, sizeof n->software, "Argand %s", ag_version());
    n->list[0] = (ag_image_note) { .key = "Software", .text = n->software };
    return (ag_image_save_options) { .notes = n->list, .note_count = 1 };
}

// The names are those of OpenEXR's standard attributes, where it has one.
ag_image_save_options notes_of_picture(notes *n, const eye_request *eye, float exposure)
{
    ag_image_save_options options = notes_of_map(n);
    add(&options, n, "ev100", ag_ev100_from_exposure(exposure));
    add(&options, n, "whiteLuminance", 1 / exposure);
    if (eye->camera_given) {
        add(&options, n, "aperture", eye->aperture);
        add(&options, n, "expTime", eye->shutter_s);
        add(&options, n, "isoSpeed", eye->iso > 0 ? eye->iso : 100);
    }
    return options;
}
