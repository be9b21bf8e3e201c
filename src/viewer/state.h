// The viewer's state, which only the window's thread touches, and what moves it.
//
// The painter, the tracer, the loader, the saver and the picker work beside it.  All but the
// loader read the scene; it is changed only while none of them is at work (viewer_can_edit).
#ifndef VIEWER_STATE_H
#define VIEWER_STATE_H

#include "hud.h"
#include "navigation.h"
#include "painter.h"
#include "screen.h"
#include "tracer.h"
#include "viewer.h"
#include "worker.h"

enum { INPUT_MAX = 4096 };

// What is being loaded, and what the file looked like when it was.
typedef struct loading {
    worker *worker;
    crew *crew;
    char input[INPUT_MAX], next[INPUT_MAX]; // next: asked for while another was loading
    bool may_draft, draft;                  // draft: what takes long is left out
    bool keeps_view, next_keeps_view;
    bool ready;       // `document` waits until it may be shown
    ag_status failed; // the last time
    viewer_document document;
    const viewer_setup *setup;
} loading;

typedef struct watching {
    int64_t changed_ns, size; // of the file that is shown
    bool gone, differs;       // since the last look
    double next;              // s, when to look again; 0: there is no file
} watching;

typedef struct eye {
    bool automatic;
    ag_metering metering;
    float target_ev100, ev100; // of automatic exposure; NAN: not yet metered
    float exposure;            // what pictures have
    double stepped;            // s
} eye;

typedef enum drag {
    DRAG_NONE = 0,
    DRAG_TURN,
    DRAG_PAN,
    DRAG_LOOK,
    DRAG_SPLIT,
    DRAG_LIGHT,
} drag;

typedef struct pointing {
    drag drag;
    screen_button button; // that is held
    double from[2];       // px, where the pointer was last
    double press[2];      // px, where a button went down
    bool moved;           // since then
} pointing;

typedef struct truth {
    bool wanted, stale; // stale: what is traced is no longer what is seen
    double split;       // where the line is, 0 to 1 of the width
    ag_image *picture;  // traced; NULL: none yet
    ag_image *beside;   // the real-time picture; NULL: to be made
    uint64_t version;
    uint32_t samples;
    float noise, flip; // flip below 0: not known
    bool beside_wanted;
} truth;

// What is picked.
typedef struct selection {
    enum { PICK_NOTHING = 0, PICK_LIGHT, PICK_MATERIAL } kind;
    size_t index;   // of the light or the material
    float place[3]; // m, where it was picked
    float radius;   // m, to frame it
    bool hovers;    // only lies under the pointer
} selection;

typedef enum look_use {
    LOOK_NONE = 0,
    LOOK_HOVER, // what the pointer rests on
    LOOK_PRESS, // what a button goes down on
    LOOK_CLICK,
} look_use;

// What lies under the pointer is found beside: among millions of triangles it takes a while.
typedef struct looking {
    worker *worker;
    look_use wanted, at_work;
    double at[2];          // px, where it is wanted
    const ag_scene *scene; // read while the worker works
    ag_camera_desc camera;
    uint32_t width, height; // px
    float place[2], reach;  // px
    selection found;
} looking;

// What is to become of it, as soon as nobody reads the scene.
typedef struct change {
    bool wanted;
    double strength, size; // steps: intensity or roughness, radius or metalness
    float move[3];         // m
} change;

typedef struct message {
    char text[4 * HUD_TEXT_MAX];
    bool alarm;
    double until; // s
} message;

typedef struct viewer {
    const viewer_setup *setup;
    viewer_report *report;
    screen *screen;
    hud *hud;
    crew *crew;
    painter *painter;
    tracer *tracer;
    loading loading;
    watching watching;
    viewer_document document; // shown; scene NULL: none yet
    char document_input[INPUT_MAX];
    bool drafted; // it lacks what takes long
    bool edited;  // since it was read
    navigation navigation;
    eye eye;
    pointing pointing;
    truth truth;
    selection picked, hovered;
    looking looking;
    change change; // of what is picked
    message message;
    hud_state shown;
    ag_image *white; // a pixel
    ag_image *ring;  // the mark of a light
    double now;      // s, since the window was asked for

    bool quits;
    bool picture_stale; // the scene must be drawn again
    bool layers_stale;  // only what lies over it
    bool meters;        // with the next picture
    bool first;         // nothing of the document has been shown
    double moved;       // s, when the view last changed
    bool rough;         // the picture has less than full resolution
    double ms_per_mpx;  // what drawing takes
    double stepped;     // s, of the navigation
    double *frame_ms;   // of the frames that were asked for
    uint32_t frame_count;
    uint32_t camera;               // of the file, the next one
    paint_order ordered;           // last
    ag_camera_desc ordered_camera; // of the last picture
    double painted;                // s, when it came
    uint32_t orders;               // that are done
    uint32_t asked;                // how many were, when the first unanswered input came
    bool asks, answers;            // there is one; the order at work has it
    uint32_t losses;               // of the device, one after the other
    bool moving;                   // the navigation moves by itself
    double rests_at;               // s, when to look what the pointer is on; 0: no need
    bool hidden;                   // the window has no area
    bool shoots;                   // the next sharp picture is saved
    worker *saver;
    ag_image *saved;
    float saved_ev100;
    char save_path[INPUT_MAX];
    ag_status failed; // why it ends
} viewer;

// ---- viewer.c ------------------------------------------------------------------

// Say something over the picture, and to the log.
__attribute__((format(printf, 3, 4))) void viewer_say(viewer *v, bool alarm, const char *format,
                                                      ...);

// Say something to the log alone.
__attribute__((format(printf, 2, 3))) void viewer_tell(const viewer *v, const char *format, ...);

// What is seen will be another picture: the camera, the scene or the look has changed.
void viewer_redraw(viewer *v);

// Whether nobody reads the scene.  If not, those who may be stopped are.
bool viewer_can_edit(viewer *v);

// ---- document.c ----------------------------------------------------------------

void document_load(viewer *v, const char *input, bool keeps_view);
void document_collect(viewer *v); // take over what was loaded
void document_watch(viewer *v);   // reload a file that has changed

// ---- actions.c -----------------------------------------------------------------

void actions_do(viewer *v, action a);
void actions_collect(viewer *v);                 // what was saved beside
void actions_keep(viewer *v, ag_image *picture); // takes what the painter brought back
void actions_describe(const viewer *v, hud_state *s);

// ---- pointer.c -----------------------------------------------------------------

void pointer_event(viewer *v, const screen_event *event);
void pointer_found(viewer *v, look_use use, selection what); // that was looked for
void pointer_step(viewer *v); // of flying, and what the pointer rests on

// ---- picture.c -----------------------------------------------------------------

void picture_collect(viewer *v);
void picture_begin(viewer *v);        // when the painter is idle and something is stale
void picture_follow_truth(viewer *v); // keep the tracer at work
double picture_next(const viewer *v); // s to wait for the next event; below 0: without end

// ---- picking.c -----------------------------------------------------------------

// Find what lies at a place, in px; pointer_found is told.  Until then events wait, unless the
// pointer only rests there.
void picking_look(viewer *v, look_use use, const double at[2]);
void picking_collect(viewer *v);
bool picking_holds(const viewer *v); // events wait
void picking_pick(viewer *v, selection what);
void picking_next_light(viewer *v);
void picking_strengthen(viewer *v, double steps); // intensity, roughness
void picking_enlarge(viewer *v, double steps);    // radius, metalness
void picking_drag(viewer *v, const double from[2], const double to[2]);
void picking_step(viewer *v); // makes the changes
void picking_describe(const viewer *v, hud_state *shown);

// The marks of what is picked, one layer at most.
uint32_t picking_marks(const viewer *v, const ag_show_options *show, ag_layer *layers);

#endif
