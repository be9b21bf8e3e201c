// Where things that can be made again are kept between runs.
#include "base/cache.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Make a folder and those above it; true when it is there and can be written.
static bool make_folders(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        bool made = mkdir(path, 0700) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made)
            return false;
    }
    return (mkdir(path, 0700) == 0 || errno == EEXIST) && access(path, W_OK | X_OK) == 0;
}

// In /tmp the name is everybody's to take: the folder must be ours alone.
static bool is_ours(const char *path)
{
    struct stat st;
    return lstat(path, &st) == 0 && S_ISDIR(st.st_mode) && st.st_uid == getuid() &&
           !(st.st_mode & 022);
}

// `root`/`below`/`part`, made.
static bool try(char path[CACHE_PATH_MAX], const char *root, const char *below, const char *part)
{
    int length = snprintf(path, CACHE_PATH_MAX, "%s%s/%s", root, below, part);
    return length > 0 && length < CACHE_PATH_MAX && make_folders(path);
}

bool cache_wanted(void)
{
    const char *none = getenv("ARGAND_NO_CACHE");
    return !none || !*none || strcmp(none, "0") == 0;
}

bool cache_directory(const char *part, char path[CACHE_PATH_MAX])
{
    const char *own = getenv("ARGAND_CACHE_DIR");
    const char *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    if (!cache_wanted())
        return false;
    if (own && *own)
        return try(path, own, "", part);
    if (xdg && *xdg == '/' && try(path, xdg, "/argand", part))
        return true;
    if (home && *home == '/' && try(path, home, "/.cache/argand", part))
        return true;
    char root[64];
    snprintf(root, sizeof root, "/tmp/argand-%ld", (long)getuid());
    if (mkdir(root, 0700) != 0 && !is_ours(root))
        return false;
    return try(path, root, "", part);
}
