// Turn around a model in a window that the application has made, here by GLFW.
//
//   cc window.c -o window $(pkg-config --cflags --libs argand glfw3) -lm
//   ./window model.glb
#include <argand/argand.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <stdint.h>

// As GLFW's manual has it, but for Vulkan's types: so its header is not needed.
int glfwCreateWindowSurface(void *instance, GLFWwindow *window, const void *allocator,
                            void *surface);

static int create_surface(void *user, void *instance, void *surface)
{
    return glfwCreateWindowSurface(instance, user, NULL, surface);
}

// One turn in ten seconds, until the window is closed.
static ag_status turn(GLFWwindow *glfw, ag_window *window, const ag_scene *scene)
{
    ag_status status = AG_OK;
    while (!status && !glfwWindowShouldClose(glfw)) {
        int width, height; // px
        glfwGetFramebufferSize(glfw, &width, &height);
        ag_render_options picture = { .width = (uint32_t)width, .height = (uint32_t)height };
        ag_show_options show = { .width = (uint32_t)width, .height = (uint32_t)height };
        ag_orbit orbit = ag_orbit_auto();
        orbit.theta_rad = (float)(glfwGetTime() * 6.2831853 / 10);
        float aspect = height > 0 ? (float)width / (float)height : 1;
        ag_camera_desc camera = ag_scene_frame(scene, &orbit, aspect);
        status = ag_window_show(window, scene, &camera, &picture, &show, NULL);
        glfwPollEvents();
    }
    return status;
}

int main(int argc, char **argv)
{
    if (!glfwInit())
        return 1;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API); // Argand brings Vulkan
    GLFWwindow *glfw = glfwCreateWindow(800, 600, "Argand", NULL, NULL);

    ag_device *device = NULL;
    ag_renderer *renderer = NULL;
    ag_window *window = NULL;
    ag_scene *scene = NULL;
    const ag_device_desc for_windows = { .windows = true };
    const ag_window_desc shown_in = { .create_surface = create_surface, .user = glfw };
    ag_status status = glfw ? ag_device_create(&for_windows, &device) : AG_ERROR_DEVICE;
    if (!status)
        status = ag_renderer_create(device, &renderer);
    if (!status)
        status = ag_window_create(renderer, &shown_in, &window);
    if (!status)
        status = ag_scene_create(NULL, &scene);
    if (!status)
        status = argc > 1 ? ag_scene_load(scene, argv[1], NULL)
                          : ag_scene_load_demo(scene, "spheres", AG_LOOK_TEXT);
    if (!status)
        status = turn(glfw, window, scene);

    ag_scene_destroy(scene);
    ag_window_destroy(window); // before what it was made of
    ag_renderer_destroy(renderer);
    ag_device_destroy(device);
    glfwTerminate();
    return status ? 1 : 0;
}
