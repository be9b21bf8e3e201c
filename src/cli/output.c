// The place where a picture or a scene goes.
#include "output.h"

#include "text.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
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

// Says what is wrong where `path` cannot be made in its folder.
static bool has_place(console *c, const char *path)
{
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
    else
        return true;
    return false;
}

static output_verdict check_place(console *c, const char *path)
{
    struct stat st;
    if (!has_place(c, path))
        return OUTPUT_NO_PLACE;
    if (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))
        return OUTPUT_FINE;
    console_say(c, AG_LOG_ERROR, "%s: is a folder", path);
    return OUTPUT_NO_PLACE;
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
    return check_place(c, path);
}

output_verdict output_check_scene(console *c, const char *path)
{
    if (text_ends(path, ".glb"))
        return check_place(c, path);
    console_say(c, AG_LOG_ERROR, "%s: its name must end in .glb, which is what is written", path);
    return OUTPUT_UNKNOWN_KIND;
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

ag_status output_save(console *c, const ag_image *image, const ag_image_save_options *options,
                      const char *path)
{
    ag_log log = console_log(c);
    sigset_t before;
    hold_interrupts(&before);
    ag_status status = ag_image_save(&log, image, path, options);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

ag_status output_save_layers(console *c, const ag_image_layer *layers, size_t count,
                             const ag_image_save_options *options, const char *path)
{
    ag_log log = console_log(c);
    sigset_t before;
    hold_interrupts(&before);
    ag_status status = ag_image_save_layers(&log, layers, count, path, options);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

ag_status output_save_scene(console *c, const ag_scene *scene, const char *path)
{
    sigset_t before;
    console_stage(c, "write", 0);
    hold_interrupts(&before);
    ag_status status = ag_scene_save(scene, path);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

// ---- Pages -----------------------------------------------------------------------

// The path of the page in `folder`; false when that is too long.
static bool page_in(const char *folder, char *path, size_t capacity)
{
    size_t length = strlen(folder);
    while (length > 1 && folder[length - 1] == '/')
        length--;
    int used = snprintf(path, capacity, "%.*s/index.html", (int)length, folder);
    return used > 0 && (size_t)used < capacity;
}

bool output_check_folder(console *c, const char *folder)
{
    char path[4096];
    struct stat st;
    if (!page_in(folder, path, sizeof path)) {
        console_say(c, AG_LOG_ERROR, "The output's path is too long");
        return false;
    }
    if (stat(folder, &st) == 0 && !S_ISDIR(st.st_mode)) {
        console_say(c, AG_LOG_ERROR, "%s: is a file; the report needs a folder", folder);
        return false;
    }
    if (stat(folder, &st) == 0)
        return has_place(c, path);
    path[strlen(path) - strlen("/index.html")] = 0; // the folder without slashes behind it
    return has_place(c, path);
}

static bool write_all(int file, const char *data, size_t size)
{
    while (size) {
        ssize_t n = write(file, data, size);
        if (n < 0 && errno != EINTR)
            return false;
        data += n > 0 ? n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
    return true;
}

// Beside its place, then renamed.
static bool write_whole(const char *path, const char *data, size_t size)
{
    char beside[4096 + 32];
    snprintf(beside, sizeof beside, "%s.%ld.tmp", path, (long)getpid());
    int file = open(beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0)
        return false;
    bool written = write_all(file, data, size);
    if (close(file) == 0 && written && rename(beside, path) == 0)
        return true;
    int reason = errno;
    unlink(beside);
    errno = reason;
    return false;
}

ag_status output_write_page(console *c, const char *folder, const char *page, size_t size)
{
    char path[4096];
    sigset_t before;
    if (!page_in(folder, path, sizeof path))
        return AG_ERROR_FILE; // output_check_folder has said so
    hold_interrupts(&before);
    bool made = mkdir(folder, 0777) == 0;
    bool written = write_whole(path, page, size);
    if (!written) {
        console_say(c, AG_LOG_ERROR, "%s: cannot be written: %s", path, strerror(errno));
        if (made)
            rmdir(folder);
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return written ? AG_OK : AG_ERROR_FILE;
}
