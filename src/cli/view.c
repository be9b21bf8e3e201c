// argand view: the scene in a window.
#include "commands.h"
#include "shot.h"
#include "viewer/viewer.h"

#include <stdio.h>
#include <string.h>

typedef struct view_request {
    shot_request shot;
    uint32_t frames;
    bool exits;
} view_request;

typedef struct view {
    const view_request *request;
    console said;  // on the main thread
    console hears; // what loading says, on its way to the viewer
} view;

#define FIELD(member) offsetof(view_request, member)

static const option view_options[] = {
    { "--frames", NULL, "N", "100", "draw N pictures as fast as they come, and say how long they took",
      FIELD(frames), value_count, NULL, 0 },
    { "--exit", NULL, NULL, "", "close the window after --frames", FIELD(exits), NULL, NULL, 0 },
    { 0 },
};

// Called by the viewer, for the file that was named or another one.
static ag_status open_document(void *user, const char *input, bool draft, const ag_log *log,
                               const ag_progress *progress, viewer_document *document)
{
    view *v = user;
    shot_request request = v->request->shot;
    request.input = input;
    request.draft = draft;
    if (strcmp(input, v->request->shot.input) != 0)
        request.camera = NULL; // that of another file
    console_relay(&v->hears, log, progress);
    shot s;
    ag_status status = shot_open(&s, &request, &v->hears);
    if (!status)
        status = shot_compose(&s, AG_FORMAT_RGBA8, &document->camera, &document->look);
    if (!status) {
        document->scene = s.scene;
        s.scene = NULL;
    }
    shot_finish(&s);
    return status;
}

static void print_report(const view *v, const viewer_report *report)
{
    if (v->request->shot.json)
        printf("{\"frames\": %u, \"median_frame_ms\": %.2f, \"first_pixels_ms\": %.1f, "
               "\"scene_shown_ms\": %.1f}\n",
               report->frames, report->median_frame_ms, report->first_pixels_ms,
               report->scene_shown_ms);
    else if (v->request->frames && !v->request->shot.quiet)
        printf("%u frames, %.1f ms each (%.1f a second); first pixels after %.0f ms, the scene "
               "after %.0f ms\n",
               report->frames, report->median_frame_ms, 1e3 / report->median_frame_ms,
               report->first_pixels_ms, report->scene_shown_ms);
}

static exit_code run(int argc, char **argv)
{
    const option *const tables[] = { view_options, shot_options, shot_device_options, NULL };
    (void)tables;
    (void)argc;
    (void)argv;
    return EXIT_FAILED;
}
