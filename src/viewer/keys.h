// Keys: which does what, in one table that the help, the manual and the tests read.
//
// Where f3d and Blender agree (1 3 5 7, F12) it follows both; else whichever has the key: Home,
// period, 0 and Ctrl for the opposite side are Blender's, the mouse, Enter, H, R and T f3d's.
#ifndef VIEWER_KEYS_H
#define VIEWER_KEYS_H

#include "panel.h"

typedef enum action {
    ACTION_NONE = 0,
    ACTION_FRAME_ALL,
    ACTION_FRAME_PICKED,
    ACTION_FIRST_VIEW, // as it was opened
    ACTION_NEXT_CAMERA,
    ACTION_FRONT, // in the order of navigation_side
    ACTION_BACK,
    ACTION_RIGHT,
    ACTION_LEFT,
    ACTION_TOP,
    ACTION_BOTTOM,
    ACTION_ORTHOGRAPHIC,
    ACTION_NEXT_LIGHT,
    ACTION_STRONGER, // a light's intensity, a material's roughness
    ACTION_WEAKER,
    ACTION_LARGER, // a light's radius, a material's metalness
    ACTION_SMALLER,
    ACTION_BRIGHTER, // exposure
    ACTION_DARKER,
    ACTION_LOCK_EXPOSURE,
    ACTION_METERING,
    ACTION_BLOOM,
    ACTION_TONE_CURVE,
    ACTION_REFERENCE,
    ACTION_SPLIT_LEFT, // where the split line goes
    ACTION_SPLIT_RIGHT,
    ACTION_HELP,
    ACTION_STATUS,
    ACTION_FULL_SCREEN,
    ACTION_SCREENSHOT,
    ACTION_SAVE,
    ACTION_RELOAD,
    ACTION_ESCAPE, // close the help; else let go of what is picked; else quit
    ACTION_QUIT,
    ACTION_COUNT,
} action;

// A key is the character that it writes, letters as capitals, or one of these.
typedef enum key {
    KEY_ESCAPE = 256,
    KEY_ENTER,
    KEY_TAB,
    KEY_HOME,
    KEY_LEFT,
    KEY_RIGHT,
    KEY_UP,
    KEY_DOWN,
    KEY_F1,
    KEY_F5 = KEY_F1 + 4,
    KEY_F11 = KEY_F1 + 10,
    KEY_F12,
} key;

enum { KEY_SHIFT = 1, KEY_CTRL = 2, KEY_ALT = 4 };

// What a key does, pressed with these modifiers and no others.  Shift counts only where it makes
// a difference in the table, or with keys that write nothing: characters may need it.
action keys_action(uint32_t pressed, unsigned modifiers);

typedef struct key_use {
    uint32_t key;
    unsigned modifiers;
    action does;
    const char *shown, *about; // as the help says it
} key_use;

// Use `index` (from 0) of any key; false past the last.
bool keys_at(size_t index, key_use *use);

// The table as rows for a panel, sections among them; static storage.  Returns their number, of
// which as many as `capacity` are written.
size_t keys_rows(panel_row *rows, size_t capacity);

#endif
