// A picture as a text that a page can hold.
#ifndef CLI_DATA_URI_H
#define CLI_DATA_URI_H

#include <argand/argand.h>

// "data:image/webp;base64,..." of an RGBA8 image; `quality` 1 to 100.  The caller's to free().
ag_status data_uri_from_image(const ag_log *log, const ag_image *image, int quality, char **uri);

#endif
