// Are two pictures of 8 bits alike?
//
//   pictures_near A B LIMIT: the mean difference of their codes is at most LIMIT.
#include <argand/argand.h>

#include <stdio.h>
#include <stdlib.h>

static ag_image *load(const char *path)
{
    ag_image *image;
    if (ag_image_load(NULL, path, &image) != AG_OK)
        exit(1);
    return image;
}

static double mean_difference(const ag_image *a, const ag_image *b)
{
    const uint8_t *pa = ag_image_pixels(a), *pb = ag_image_pixels(b);
    size_t count = (size_t)ag_image_width(a) * ag_image_height(a) * 4;
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += abs(pa[i] - pb[i]);
    return sum / (double)count;
}

int main(int argc, char **argv)
{
    if (argc != 4)
        return 2;
    ag_image *a = load(argv[1]), *b = load(argv[2]);
    double mean = 1e9;
    if (ag_image_width(a) == ag_image_width(b) && ag_image_height(a) == ag_image_height(b))
        mean = mean_difference(a, b);
    printf("%s: %.3f\n", argv[1], mean);
    ag_image_destroy(a);
    ag_image_destroy(b);
    return mean <= strtod(argv[3], NULL) ? 0 : 1;
}
