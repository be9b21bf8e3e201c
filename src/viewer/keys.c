// Keys: which does what.
#include "keys.h"

typedef struct binding {
    const char *shown, *about; // a section has no `shown`
    struct {
        uint32_t key;
        unsigned modifiers;
        action does;
    } keys[6];
} binding;

// What has no key is done with the mouse, or with keys that are held down.
static const binding table[] = {
    { NULL, "View", { { 0 } } },
    { "Left drag", "turn around the target", { { 0 } } },
    { "Middle drag", "move in the picture's plane (or Shift + left drag)", { { 0 } } },
    { "Wheel", "nearer and farther, to and from the pointer", { { 0 } } },
    { "Home", "show all of the scene", { { KEY_HOME, 0, ACTION_FRAME_ALL } } },
    { "F or .",
      "show what is picked, or is under the pointer",
      { { 'F', 0, ACTION_FRAME_PICKED }, { '.', 0, ACTION_FRAME_PICKED } } },
    { "1, 3, 7",
      "from the front, right, top; with Ctrl back, left, bottom",
      { { '1', 0, ACTION_FRONT },
        { '3', 0, ACTION_RIGHT },
        { '7', 0, ACTION_TOP },
        { '1', KEY_CTRL, ACTION_BACK },
        { '3', KEY_CTRL, ACTION_LEFT },
        { '7', KEY_CTRL, ACTION_BOTTOM } } },
    { "5", "perspective or orthographic", { { '5', 0, ACTION_ORTHOGRAPHIC } } },
    { "C or 0",
      "the next camera of the file",
      { { 'C', 0, ACTION_NEXT_CAMERA }, { '0', 0, ACTION_NEXT_CAMERA } } },
    { "Enter", "the view as it was at first", { { KEY_ENTER, 0, ACTION_FIRST_VIEW } } },

    { NULL, "Fly, while the right button is held", { { 0 } } },
    { "Mouse", "look about", { { 0 } } },
    { "W, A, S, D", "forward, left, back, right", { { 0 } } },
    { "E, Q", "up, down", { { 0 } } },
    { "Wheel", "faster, slower", { { 0 } } },

    { NULL, "Lights and materials", { { 0 } } },
    { "Click", "pick the light or the material under the pointer", { { 0 } } },
    { "L", "pick the next light", { { 'L', 0, ACTION_NEXT_LIGHT } } },
    { "Left drag", "move the light that is picked", { { 0 } } },
    { "Up, Down",
      "intensity of the light, roughness of the material (or Ctrl + wheel)",
      { { KEY_UP, 0, ACTION_STRONGER }, { KEY_DOWN, 0, ACTION_WEAKER } } },
    { "Right, Left",
      "radius of the light, metalness of the material (or Shift + wheel)",
      { { KEY_RIGHT, 0, ACTION_LARGER }, { KEY_LEFT, 0, ACTION_SMALLER } } },
    { "F5", "save the scene as .glb", { { KEY_F5, 0, ACTION_SAVE } } },

    { NULL, "Picture", { { 0 } } },
    { "+, -",
      "brighter, darker",
      { { '+', 0, ACTION_BRIGHTER }, { '=', 0, ACTION_BRIGHTER }, { '-', 0, ACTION_DARKER } } },
    { "X", "hold the exposure, or let it follow the light", { { 'X', 0, ACTION_LOCK_EXPOSURE } } },
    { "M", "meter the average, the centre, a spot", { { 'M', 0, ACTION_METERING } } },
    { "B", "bloom", { { 'B', 0, ACTION_BLOOM } } },
    { "T", "the next tone curve", { { 'T', 0, ACTION_TONE_CURVE } } },

    { NULL, "Ground truth", { { 0 } } },
    { "R", "trace the paths of light beside the picture", { { 'R', 0, ACTION_REFERENCE } } },
    { "[, ]",
      "move the line between them (or drag it)",
      { { '[', 0, ACTION_SPLIT_LEFT }, { ']', 0, ACTION_SPLIT_RIGHT } } },

    { NULL, "Window", { { 0 } } },
    { "? or H or F1",
      "this help",
      { { '?', 0, ACTION_HELP }, { 'H', 0, ACTION_HELP }, { KEY_F1, 0, ACTION_HELP } } },
    { "Tab", "times, counts, device", { { KEY_TAB, 0, ACTION_STATUS } } },
    { "F11", "full screen", { { KEY_F11, 0, ACTION_FULL_SCREEN } } },
    { "F12", "save the picture as .png", { { KEY_F12, 0, ACTION_SCREENSHOT } } },
    { "O", "read the file again", { { 'O', 0, ACTION_RELOAD } } },
    { "Esc",
      "close the help, let go of what is picked, or quit",
      { { KEY_ESCAPE, 0, ACTION_ESCAPE } } },
    { "Ctrl + Q", "quit", { { 'Q', KEY_CTRL, ACTION_QUIT } } },
};

enum {
    row_count = sizeof table / sizeof *table,
    key_count = sizeof table->keys / sizeof *table->keys,
};

static action find(uint32_t pressed, unsigned modifiers)
{
    for (size_t i = 0; i < row_count; i++)
        for (size_t k = 0; k < key_count && table[i].keys[k].does; k++)
            if (table[i].keys[k].key == pressed && table[i].keys[k].modifiers == modifiers)
                return table[i].keys[k].does;
    return ACTION_NONE;
}

action keys_action(uint32_t pressed, unsigned modifiers)
{
    action exact = find(pressed, modifiers);
    bool writes = pressed < KEY_ESCAPE;
    return exact || !writes ? exact : find(pressed, modifiers & ~(unsigned)KEY_SHIFT);
}

bool keys_at(size_t index, key_use *use)
{
    for (size_t i = 0; i < row_count; i++) {
        const binding *b = &table[i];
        for (size_t k = 0; k < key_count && b->keys[k].does; k++) {
            if (index-- > 0)
                continue;
            *use = (key_use) { b->keys[k].key, b->keys[k].modifiers, b->keys[k].does, b->shown,
                               b->about };
            return true;
        }
    }
    return false;
}

size_t keys_rows(panel_row *rows, size_t capacity)
{
    for (size_t i = 0; i < row_count && i < capacity; i++)
        rows[i] = table[i].shown ? (panel_row) { PANEL_KEY, table[i].shown, table[i].about, 0 }
                                 : (panel_row) { PANEL_SECTION, table[i].about, NULL, 0 };
    return row_count;
}
