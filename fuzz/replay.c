// Run a fuzz target once on every file of the folders or files named: what libFuzzer's own
// main does with files, for compilers without it.
#include "base/file.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static unsigned replay_file(const char *path)
{
    void *data;
    size_t size;
    if (file_read(NULL, path, (size_t)1 << 30, &data, &size))
        exit(1);
    // an exact copy, so that a sanitizer sees what is read beyond it
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        exit(1);
    memcpy(copy, data, size);
    free(data);
    printf("%s\n", path);
    fflush(stdout);
    if (LLVMFuzzerTestOneInput(copy, size) != 0)
        exit(1);
    free(copy);
    return 1;
}

static unsigned replay(const char *path)
{
    DIR *folder = opendir(path);
    if (!folder)
        return replay_file(path);
    unsigned count = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.')
            count += replay_file(name);
    }
    closedir(folder);
    return count;
}

int main(int argc, char **argv)
{
    unsigned count = 0;
    for (int i = 1; i < argc; i++)
        count += replay(argv[i]);
    printf("%u files\n", count);
    return count ? 0 : 1; // nothing replayed is no success
}
