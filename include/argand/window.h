// A window of an application, and the renderer's pictures shown in it: nothing is read back to
// the host on the way.
//
// Argand makes no windows: GLFW, SDL, Qt or the application does.  It must have opened the
// device with ag_device_desc.windows.
//
// Threads: a window belongs to its renderer's thread.
#ifndef ARGAND_WINDOW_H
#define ARGAND_WINDOW_H

#include <argand/base.h>
#include <argand/image.h>
#include <argand/renderer.h>
#include <argand/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ag_window ag_window;

typedef struct ag_window_desc {
    // Make a Vulkan surface of the window: `instance` is a VkInstance, `surface` a
    // VkSurfaceKHR *, the result a VkResult, so that this is one call of
    // glfwCreateWindowSurface, SDL_Vulkan_CreateSurface or vkCreateXlibSurfaceKHR.
    int (*create_surface)(void *user, void *instance, void *surface);
    void *user; // passed on; used during the call only
} ag_window_desc;

// Show pictures in a window.  The renderer outlives it, and it is destroyed before the window
// is closed.  AG_ERROR_ARGUMENT when the device was not opened for windows, AG_ERROR_DEVICE when
// no surface can be made or the device cannot show one.
AG_CHECK ag_status ag_window_create(ag_renderer *renderer, const ag_window_desc *desc,
                                    ag_window **window);
AG_API void ag_window_destroy(ag_window *window); // NULL is allowed

enum { AG_LAYERS_MAX = 16 };

// An image over the picture: text, say, or another picture to compare it with.
typedef struct ag_layer {
    const ag_image *image; // RGBA8, mixed as it is coded; NULL -> none
    float x, y;            // px of the window, its top left corner
    float width, height;   // px; 0 -> the image's own
    float clip[4];         // left, top, right, bottom in px, where it is seen; all 0 -> all of it
    // Layers of one number, not 0, in one place of the list hold one image: it is not brought to
    // the device again.
    uint64_t version;
} ag_layer;

typedef struct ag_show_options {
    uint32_t width, height; // px of the window now; 0 -> it is not seen, nothing is done
    float backdrop[3];      // sRGB-coded, where there is no picture
    const ag_layer *layers; // [layer_count], at most AG_LAYERS_MAX; the last one is on top
    uint32_t layer_count;
} ag_show_options;

// Make a picture as ag_renderer_render does, and show it; `options` has the picture's size, which
// is scaled to the window's, and `format` is not looked at.  `scene` NULL -> the last picture
// again, under these layers.  Where the picture is transparent it is seen over black.
// AG_ERROR_DEVICE when the device or the window was lost: destroy the window, the renderer and
// the device, and begin anew.  `stats` may be NULL.
AG_CHECK ag_status ag_window_show(ag_window *window, const ag_scene *scene,
                                  const ag_camera_desc *camera, const ag_render_options *options,
                                  const ag_show_options *show, ag_render_stats *stats);

// The picture that is shown, without the layers: what ag_renderer_render would give, in RGBA8,
// without drawing it again.  The image is the caller's.  AG_ERROR_ARGUMENT when there is none.
AG_CHECK ag_status ag_window_picture(ag_window *window, ag_image **picture);

#ifdef __cplusplus
}
#endif
#endif
