// The screen: one window of the desktop, and what the user does in it.
#include "screen.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// As GLFW's manual has it, without Vulkan's header.
int glfwCreateWindowSurface(void *instance, GLFWwindow *window, const void *allocator,
                            void *surface);

struct screen {
    GLFWwindow *window;
    screen_event *events; // [first, end) are still to be taken
    size_t first, end, capacity;
    bool damaged;
    int place[4]; // of the window before it filled the display: x, y, width, height
};

// ---- Events --------------------------------------------------------------------

// From GLFW's coordinates of the window to px.
static void to_px(const screen *s, double x, double y, double at[2])
{
    int width, height, px_width, px_height;
    glfwGetWindowSize(s->window, &width, &height);
    glfwGetFramebufferSize(s->window, &px_width, &px_height);
    at[0] = width > 0 ? x * px_width / width : x;
    at[1] = height > 0 ? y * px_height / height : y;
}

static unsigned modifiers_of(int mods)
{
    return (mods & GLFW_MOD_SHIFT ? KEY_SHIFT : 0u) | (mods & GLFW_MOD_CONTROL ? KEY_CTRL : 0u) |
           (mods & GLFW_MOD_ALT ? KEY_ALT : 0u);
}

static bool either(const screen *s, int left, int right)
{
    return glfwGetKey(s->window, left) == GLFW_PRESS || glfwGetKey(s->window, right) == GLFW_PRESS;
}

static unsigned modifiers_now(const screen *s)
{
    return (either(s, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) ? KEY_SHIFT : 0u) |
           (either(s, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) ? KEY_CTRL : 0u) |
           (either(s, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) ? KEY_ALT : 0u);
}

static bool reserve(screen *s)
{
    if (s->end < s->capacity)
        return true;
    size_t capacity = s->capacity ? 2 * s->capacity : 64;
    screen_event *events = realloc(s->events, capacity * sizeof *events);
    if (!events)
        return false;
    s->events = events;
    s->capacity = capacity;
    return true;
}

// All are kept, so that no button stays pressed; without memory the newest is lost.
static void push(screen *s, screen_event event)
{
    if (event.kind != SCREEN_MOTION && event.kind != SCREEN_BUTTON)
        screen_pointer(s, event.at);
    screen_event *last = s->end > s->first ? &s->events[s->end - 1] : NULL;
    if (last && event.kind == SCREEN_MOTION && last->kind == SCREEN_MOTION)
        *last = event; // the pointer is where it is: the way does not matter
    else if (reserve(s))
        s->events[s->end++] = event;
    else
        free(event.path);
}

static uint32_t named_key(int code)
{
    switch (code) {
    case GLFW_KEY_ESCAPE: return KEY_ESCAPE;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER: return KEY_ENTER;
    case GLFW_KEY_TAB: return KEY_TAB;
    case GLFW_KEY_HOME: return KEY_HOME;
    case GLFW_KEY_LEFT: return KEY_LEFT;
    case GLFW_KEY_RIGHT: return KEY_RIGHT;
    case GLFW_KEY_UP: return KEY_UP;
    case GLFW_KEY_DOWN: return KEY_DOWN;
    default: break;
    }
    return code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12 ? KEY_F1 + (uint32_t)(code - GLFW_KEY_F1)
                                                       : 0;
}

static uint32_t capital(uint32_t c)
{
    return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
}

// Keys with a name, and those that write nothing because Ctrl or Alt is held.
static void on_key(GLFWwindow *window, int code, int scancode, int how, int mods)
{
    screen *s = glfwGetWindowUserPointer(window);
    if (how == GLFW_RELEASE)
        return;
    uint32_t pressed = named_key(code);
    if (!pressed && mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) {
        const char *name = glfwGetKeyName(code, scancode);
        pressed = name && name[0] && !name[1] ? capital((unsigned char)name[0]) : 0;
    }
    if (pressed)
        push(s, (screen_event) { SCREEN_KEY, .key = pressed, .modifiers = modifiers_of(mods) });
}

static void on_character(GLFWwindow *window, unsigned character)
{
    screen *s = glfwGetWindowUserPointer(window);
    unsigned shift = modifiers_now(s) & KEY_SHIFT; // AltGr stands for an Alt that is none
    push(s, (screen_event) { SCREEN_KEY, .key = capital(character), .modifiers = shift });
}

static void on_button(GLFWwindow *window, int button, int how, int mods)
{
    screen *s = glfwGetWindowUserPointer(window);
    static const screen_button names[] = { [GLFW_MOUSE_BUTTON_LEFT] = SCREEN_LEFT,
                                           [GLFW_MOUSE_BUTTON_RIGHT] = SCREEN_RIGHT,
                                           [GLFW_MOUSE_BUTTON_MIDDLE] = SCREEN_MIDDLE };
    if (button > GLFW_MOUSE_BUTTON_MIDDLE)
        return;
    screen_event event = { SCREEN_BUTTON, .button = names[button], .modifiers = modifiers_of(mods),
                           .down = how == GLFW_PRESS };
    double x, y;
    glfwGetCursorPos(window, &x, &y);
    to_px(s, x, y, event.at);
    push(s, event);
}

static void on_motion(GLFWwindow *window, double x, double y)
{
    screen *s = glfwGetWindowUserPointer(window);
    screen_event event = { SCREEN_MOTION, .modifiers = modifiers_now(s) };
    to_px(s, x, y, event.at);
    push(s, event);
}

static void on_wheel(GLFWwindow *window, double x, double y)
{
    screen *s = glfwGetWindowUserPointer(window);
    // Some systems turn a wheel with Shift sideways.
    push(s,
         (screen_event) { SCREEN_WHEEL, .modifiers = modifiers_now(s), .steps = y != 0 ? y : x });
}

static void on_drop(GLFWwindow *window, int count, const char **paths)
{
    if (count > 0)
        push(glfwGetWindowUserPointer(window),
             (screen_event) { SCREEN_DROP, .path = strdup(paths[0]) });
}

static void on_damage(GLFWwindow *window)
{
    screen *s = glfwGetWindowUserPointer(window);
    s->damaged = true;
}

static void on_resize(GLFWwindow *window, int width, int height)
{
    (void)width;
    (void)height;
    on_damage(window);
}

bool screen_event_next(screen *s, screen_event *event)
{
    if (s->first == s->end)
        return false;
    *event = s->events[s->first++];
    if (s->first == s->end)
        s->first = s->end = 0;
    return true;
}

// ---- The window ----------------------------------------------------------------

static ag_status fail(const ag_log *log, const char *what)
{
    const char *why = NULL;
    glfwGetError(&why);
    char sentence[512];
    snprintf(sentence, sizeof sentence,
             "%s: %s; `argand render` and `argand reference` need no display", what,
             why ? why : "unknown reason");
    if (log->write)
        log->write(log->user, AG_LOG_ERROR, sentence);
    return AG_ERROR_DEVICE;
}

ag_status screen_create(const ag_log *log, const char *title, uint32_t width, uint32_t height,
                        screen **made)
{
    *made = NULL;
    if (!glfwInit())
        return fail(log, "no display");
    screen *s = calloc(1, sizeof *s);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    // Some window managers take the focus for a moment when a window fills the display.
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    if (s)
        s->window = glfwCreateWindow((int)width, (int)height, title, NULL, NULL);
    if (!s || !s->window) {
        ag_status status = fail(log, "no window could be opened");
        free(s);
        glfwTerminate();
        return status;
    }
    glfwSetWindowUserPointer(s->window, s);
    glfwSetKeyCallback(s->window, on_key);
    glfwSetCharCallback(s->window, on_character);
    glfwSetMouseButtonCallback(s->window, on_button);
    glfwSetCursorPosCallback(s->window, on_motion);
    glfwSetScrollCallback(s->window, on_wheel);
    glfwSetDropCallback(s->window, on_drop);
    glfwSetWindowRefreshCallback(s->window, on_damage);
    glfwSetFramebufferSizeCallback(s->window, on_resize);
    *made = s;
    return AG_OK;
}

void screen_destroy(screen *s)
{
    if (!s)
        return;
    screen_event event;
    while (screen_event_next(s, &event))
        free(event.path);
    glfwDestroyWindow(s->window);
    glfwTerminate();
    free(s->events);
    free(s);
}

void screen_wait(screen *s, double seconds)
{
    (void)s;
    if (seconds < 0)
        glfwWaitEvents();
    else if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void screen_wake(void)
{
    glfwPostEmptyEvent();
}

void screen_size(const screen *s, uint32_t *width, uint32_t *height)
{
    int w = 0, h = 0;
    if (!glfwGetWindowAttrib(s->window, GLFW_ICONIFIED))
        glfwGetFramebufferSize(s->window, &w, &h);
    *width = (uint32_t)w;
    *height = (uint32_t)h;
}

float screen_scale(const screen *s)
{
    float x, y;
    glfwGetWindowContentScale(s->window, &x, &y);
    return x > 0 ? x : 1;
}

bool screen_pointer(const screen *s, double at[2])
{
    double x, y;
    glfwGetCursorPos(s->window, &x, &y);
    to_px(s, x, y, at);
    return glfwGetWindowAttrib(s->window, GLFW_HOVERED);
}

bool screen_held(const screen *s, char letter)
{
    return glfwGetKey(s->window, letter) == GLFW_PRESS;
}

bool screen_closing(const screen *s)
{
    return glfwWindowShouldClose(s->window);
}

bool screen_damaged(screen *s)
{
    bool damaged = s->damaged;
    s->damaged = false;
    return damaged;
}

void screen_set_title(screen *s, const char *title)
{
    glfwSetWindowTitle(s->window, title);
}

// The display that most of the window's middle is on.
static GLFWmonitor *display_of(const screen *s)
{
    int x, y, width, height, count;
    glfwGetWindowPos(s->window, &x, &y);
    glfwGetWindowSize(s->window, &width, &height);
    GLFWmonitor **all = glfwGetMonitors(&count);
    for (int i = 0; i < count; i++) {
        const GLFWvidmode *mode = glfwGetVideoMode(all[i]);
        int left, top;
        glfwGetMonitorPos(all[i], &left, &top);
        int middle_x = x + width / 2 - left, middle_y = y + height / 2 - top;
        if (mode && middle_x >= 0 && middle_y >= 0 && middle_x < mode->width &&
            middle_y < mode->height)
            return all[i];
    }
    return glfwGetPrimaryMonitor();
}

void screen_toggle_full(screen *s)
{
    int *p = s->place;
    if (glfwGetWindowMonitor(s->window)) {
        glfwSetWindowMonitor(s->window, NULL, p[0], p[1], p[2], p[3], GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *display = display_of(s);
    const GLFWvidmode *mode = display ? glfwGetVideoMode(display) : NULL;
    if (!mode)
        return;
    glfwGetWindowPos(s->window, &p[0], &p[1]);
    glfwGetWindowSize(s->window, &p[2], &p[3]);
    glfwSetWindowMonitor(s->window, display, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void screen_hide(screen *s)
{
    glfwHideWindow(s->window);
}

int screen_surface(void *user, void *instance, void *surface)
{
    screen *s = user;
    return glfwCreateWindowSurface(instance, s->window, NULL, surface);
}

double screen_time(void)
{
    return glfwGetTime();
}
