// What a picture's file says of how the picture was made.
#ifndef CLI_NOTES_H
#define CLI_NOTES_H

#include "eye_options.h"

typedef struct notes {
    char software[32];
    ag_image_note list[6];
} notes;

// Notes of a picture that was made with this linear factor: EV100, the luminance that became 1 as
// OpenEXR has it, and the camera's settings where they were given.  The options refer to `notes`.
ag_image_save_options notes_of_picture(notes *notes, const eye_request *eye, float exposure);

// Of a picture of something else.
ag_image_save_options notes_of_map(notes *notes);

#endif
