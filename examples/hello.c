// Load a glTF file, render it, save the picture.
//
//   cc hello.c -o hello $(pkg-config --cflags --libs argand)
//   ./hello model.glb hello.png
#include <argand/argand.h>

#include <stdio.h>

// Every call that can fail says so by its status; why it failed has already gone to the
// log, which is standard error unless you give another one.
static ag_status make_picture(ag_renderer *renderer, const char *model, const char *picture)
{
    ag_image *image = NULL;
    ag_scene *scene = NULL;
    ag_status status = ag_scene_create(NULL, &scene);
    if (!status)
        status = model ? ag_scene_load(scene, model, NULL)
                       : ag_scene_load_demo(scene, "spheres", AG_LOOK_TEXT);

    // Zero means the default everywhere: 1024 pixels, four samples, Khronos PBR Neutral.
    ag_render_options options = { .width = 800, .height = 600 };
    // No camera: the scene is framed automatically.  No statistics wanted either.
    if (!status)
        status = ag_renderer_render(renderer, scene, NULL, &options, &image, NULL);
    if (!status)
        status = ag_image_save(NULL, image, picture, NULL);

    ag_image_destroy(image); // NULL is allowed, so one road out is enough
    ag_scene_destroy(scene);
    return status;
}

int main(int argc, char **argv)
{
    const char *model = argc > 1 ? argv[1] : NULL; // without one, a built-in scene
    const char *picture = argc > 2 ? argv[2] : "hello.png";

    ag_device *device = NULL; // the best GPU, else the processor
    ag_renderer *renderer = NULL;
    ag_status status = ag_device_create(NULL, &device);
    if (!status)
        status = ag_renderer_create(device, &renderer);
    if (!status)
        status = make_picture(renderer, model, picture);
    if (!status)
        printf("%s, by %s\n", picture, ag_device_describe(device)->name);

    ag_renderer_destroy(renderer); // children first
    ag_device_destroy(device);
    return status ? 1 : 0;
}
