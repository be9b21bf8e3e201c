// The place where a picture or a scene goes, looked at before any work is done.
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

#include "console.h"

typedef enum output_verdict {
    OUTPUT_FINE,
    OUTPUT_UNKNOWN_KIND, // its name has no ending that Argand writes
    OUTPUT_NO_PLACE,     // the folder is missing or not writable
} output_verdict;

// Judge `path`; says on `console` what is wrong.  `*format` is what the renderer should
// make for it.
output_verdict output_check(console *console, const char *path, ag_format *format);

// The same for a scene, which needs a name in .glb.
output_verdict output_check_scene(console *console, const char *path);

// Write the picture.  An interrupt meanwhile waits until the file is whole.
ag_status output_save(console *console, const ag_image *image, const ag_image_save_options *options,
                      const char *path);
ag_status output_save_layers(console *console, const ag_image_layer *layers, size_t count,
                             const ag_image_save_options *options, const char *path);

// Write the scene, likewise.
ag_status output_save_scene(console *console, const ag_scene *scene, const char *path);

// Whether a page can go into `folder`, which may have to be made; says what is wrong.
bool output_check_folder(console *console, const char *folder);

// Write `folder`/index.html, whole or not at all, making the folder where it is not there.
ag_status output_write_page(console *console, const char *folder, const char *page, size_t size);

#endif
