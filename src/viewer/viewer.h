// The viewer: a window in which a scene is looked at, changed and compared with its ground truth.
#ifndef VIEWER_VIEWER_H
#define VIEWER_VIEWER_H

#include <argand/argand.h>

// What a file becomes.
typedef struct viewer_document {
    ag_scene *scene; // the viewer's, once it has it
    ag_camera_desc camera;
    ag_render_options look; // exposure 0: the scene's
    bool auto_exposure;
    ag_metering metering;
} viewer_document;

typedef struct viewer_setup {
    // Load what `input` names, a path or "demo:NAME".  Called on another thread, one call at a
    // time; sentences go to `log`, which outlives the document.  `draft`: leave out what takes
    // long.  On failure the document is empty.
    ag_status (*open)(void *user, const char *input, bool draft, const ag_log *log,
                      const ag_progress *progress, viewer_document *document);
    void *user;
    const char *input;
    const ag_log *log; // hears on the calling thread what all threads say
    ag_log_level level;
    const char *device; // as ag_device_desc.select
    bool validate;
    uint32_t width, height; // px, of the window
    uint32_t frames;        // draw so many as fast as they come; 0 -> as they are needed
    bool exits;             // after them
} viewer_setup;

typedef struct viewer_report {
    uint32_t frames;
    double first_pixels_ms, scene_shown_ms,
        median_frame_ms;    // the first two since the window was asked for
    uint32_t answer_frames; // the most from an input to the picture that has it, that one included
    uint32_t validation_messages;
} viewer_report;

// Open a window and stay until it is closed.  The main thread's.  AG_ERROR_DEVICE without a
// display or a device; of a file that cannot be read the user is told, and its error is returned
// when no scene was ever there.
ag_status viewer_run(const viewer_setup *setup, viewer_report *report);

#endif
