// The place where a picture goes.
#include "output.h"

#include "text.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool known_ending(const char *path, ag_format *format)
{
    static const struct {
        const char *ending;
        ag_format format;
    } kinds[] = {
        { ".png", AG_FORMAT_RGBA8 },  { ".jpg", AG_FORMAT_RGBA8 },   { ".jpeg", AG_FORMAT_RGBA8 },
        { ".webp", AG_FORMAT_RGBA8 }, { ".exr", AG_FORMAT_RGBA32F }, { ".hdr", AG_FORMAT_RGBA32F },
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (text_ends(path, kinds[i].ending)) {
            *format = kinds[i].format;
            return true;
        }
    return false;
}

// The folder that `path` lies in; false when the name is too long for any file.
static bool folder_of(const char *path, char *folder, size_t capacity)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) : 0;
    if (slash == path)
        length = 1; // the root
    if (length >= capacity)
        return false;
    memcpy(folder, path, length);
    folder[length] = 0;
    if (!slash)
        memcpy(folder, ".", 2);
    return true;
}

output_verdict output_check(console *c, const char *path, ag_format *format)
{
    if (!known_ending(path, format)) {
        console_say(c, AG_LOG_ERROR,
                    "%s: its name must end in .png, .jpg, .webp, .exr or .hdr, which says what "
                    "to write",
                    path);
        return OUTPUT_UNKNOWN_KIND;
    }
    char folder[4096];
    struct stat st;
    if (!folder_of(path, folder, sizeof folder))
        console_say(c, AG_LOG_ERROR, "The output's path is too long");
    else if (stat(folder, &st) != 0 && errno == ENOENT)
        console_say(c, AG_LOG_ERROR,
                    "%s: the folder '%s' does not exist; make it first: mkdir -p '%s'", path,
                    folder, folder);
    else if (access(folder, W_OK | X_OK) != 0)
        console_say(c, AG_LOG_ERROR, "%s: cannot be written into '%s': %s", path, folder,
                    strerror(errno));
    else if (stat(path, &st) == 0 && S_ISDIR(st.st_mode))
        console_say(c, AG_LOG_ERROR, "%s: is a folder", path);
    else
        return OUTPUT_FINE;
    return OUTPUT_NO_PLACE;
}

static void hold_interrupts(sigset_t *before)
{
    sigset_t interrupts;
    sigemptyset(&interrupts);
    sigaddset(&interrupts, SIGINT);
    sigaddset(&interrupts, SIGTERM);
    sigaddset(&interrupts, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &interrupts, before);
}

ag_status output_save(console *c, const ag_image *image, const char *path)
{
    ag_log log = console_log(c);
    sigset_t before;
    hold_interrupts(&before);
    ag_status status = ag_image_save(&log, image, path, NULL);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

ag_status output_save_layers(console *c, const ag_image_layer *layers, size_t count,
                             const char *path)
{
    ag_log log = console_log(c);
    sigset_t before;
    hold_interrupts(&before);
    ag_status status = ag_image_save_layers(&log, layers, count, path);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}
