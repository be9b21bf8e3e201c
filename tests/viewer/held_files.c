// Files that come late: whoever opens a .png waits as long as the file $ARGAND_TEST_HOLD is there.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

int open(const char *path, int flags, ...);

int open(const char *path, int flags, ...)
{
    const char *hold = getenv("ARGAND_TEST_HOLD"), *end = strrchr(path, '.');
    while (hold && end && strcmp(end, ".png") == 0 && !(flags & O_CREAT) && access(hold, F_OK) == 0)
        usleep(10000);
    va_list rest;
    va_start(rest, flags);
    mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    int (*next)(const char *, int, ...) = (int (*)(const char *, int, ...))dlsym(RTLD_NEXT, "open");
    return next(path, flags, mode);
}
