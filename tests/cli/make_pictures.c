// Writes the pictures that compare.sh compares into a folder.
//
//   make_pictures FOLDER
#include <argand/argand.h>
#include <stdint.h>
#include <stdio.h>

enum { WIDTH = 24, HEIGHT = 16 };

static int save(const char *folder, const char *name, uint32_t width, uint32_t height,
                ag_format format, const void *pixels)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    ag_image_desc desc = { width, height, format, pixels };
    ag_image *image;
    int failed = ag_image_create(NULL, &desc, &image) || ag_image_save(NULL, image, path, NULL);
    ag_image_destroy(image);
    return failed;
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    static uint8_t black[WIDTH * HEIGHT][4], grey[WIDTH * HEIGHT][4];
    static float light[WIDTH * HEIGHT][4];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int c = 0; c < 4; c++) {
            black[i][c] = c == 3 ? 255 : 0;
            grey[i][c] = c == 3 || i == 9 * WIDTH + 5 ? 255 : 51;
            light[i][c] = c == 3 ? 1 : (float)i;
        }
    return save(argv[1], "black.png", WIDTH, HEIGHT, AG_FORMAT_RGBA8, black) ||
           save(argv[1], "grey.png", WIDTH, HEIGHT, AG_FORMAT_RGBA8, grey) ||
           save(argv[1], "small.png", 8, 8, AG_FORMAT_RGBA8, black) ||
           save(argv[1], "light.exr", WIDTH, HEIGHT, AG_FORMAT_RGBA32F, light);
}
