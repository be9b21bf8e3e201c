// The file that is shown: loaded beside, watched, loaded again.
#include "state.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { DRAFT_BYTES = 8 << 20 }; // files from this size on show something before all is there
static const double watch_s = 0.5;

static bool is_file(const char *input)
{
    return input[0] && strncmp(input, "demo:", 5) != 0;
}

static bool look_at(const char *path, int64_t *changed_ns, int64_t *size)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return false;
    *changed_ns = (int64_t)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec;
    *size = info.st_size;
    return true;
}

// What lies in a folder and those in it, as far as it is worth looking.
static int64_t folder_size(const char *path, int depth)
{
    enum { LOOKS = 1000 };
    int64_t sum = 0, changed_ns, size;
    DIR *folder = opendir(path);
    const struct dirent *entry;
    for (int i = 0; folder && i < LOOKS && (entry = readdir(folder)); i++) {
        char inside[INPUT_MAX];
        if (entry->d_name[0] == '.' ||
            snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name) >= INPUT_MAX)
            continue;
        if (look_at(inside, &changed_ns, &size))
            sum += size;
        if (depth > 0)
            sum += folder_size(inside, depth - 1); // nothing where it is no folder
    }
    if (folder)
        closedir(folder);
    return sum;
}

// A .gltf file has its textures beside it.
static bool is_large(const char *input)
{
    const char *end = strrchr(input, '.'), *slash = strrchr(input, '/');
    int64_t changed_ns, size;
    if (!end || strcmp(end, ".gltf") != 0)
        return look_at(input, &changed_ns, &size) && size >= DRAFT_BYTES;
    char folder[INPUT_MAX];
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - input) : 1, slash ? input : ".");
    return folder_size(folder, 1) >= DRAFT_BYTES;
}

static void watch(viewer *v, const char *input)
{
    loading *l = &v->loading;
    if (input != l->input)
        snprintf(l->input, sizeof l->input, "%s", input);
    v->watching = (watching) { .next = is_file(l->input) ? v->now + watch_s : 0 };
    watching *w = &v->watching;
    w->gone = !look_at(l->input, &w->changed_ns, &w->size);
}

// ---- Loading -----------------------------------------------------------------

static ag_status load_job(void *context, worker *self)
{
    loading *l = context;
    l->draft = l->may_draft && is_large(l->input);
    const ag_log log = crew_log(l->crew, l->setup->level);
    const ag_progress progress = worker_progress(self);
    return l->setup->open(l->setup->user, l->input, l->draft, &log, &progress, &l->document);
}

static void begin(viewer *v)
{
    loading *l = &v->loading;
    worker_start(l->worker, load_job, l);
    v->layers_stale = true;
}

void document_load(viewer *v, const char *input, bool keeps_view)
{
    loading *l = &v->loading;
    if (worker_is_busy(l->worker)) {
        l->next_keeps_view = keeps_view && strcmp(input, l->input) == 0 && l->keeps_view;
        snprintf(l->next, sizeof l->next, "%s", input);
        worker_stop(l->worker);
        return;
    }
    ag_scene_destroy(l->document.scene); // loaded, and never shown
    l->document = (viewer_document) { 0 };
    l->ready = false;
    l->failed = AG_OK;
    l->keeps_view = keeps_view;
    watch(v, input);
    l->may_draft = !keeps_view && !v->watching.gone;
    begin(v);
}

// ---- Showing -----------------------------------------------------------------

static void set_title(viewer *v)
{
    char title[HUD_TEXT_MAX + 16];
    const char *input = v->loading.input, *name = strrchr(input, '/');
    snprintf(v->shown.file, sizeof v->shown.file, "%.255s", name ? name + 1 : input);
    snprintf(title, sizeof title, "%s - argand", v->shown.file);
    screen_set_title(v->screen, title);
}

// A document that comes a second time keeps what the user has made of its view.
static void set_view(viewer *v, const viewer_document *d)
{
    navigation_measure(&v->navigation, &v->shown.scene);
    navigation_take(&v->navigation, &d->camera);
    v->camera = 0;
    v->eye.automatic = d->auto_exposure;
    v->eye.metering = d->metering;
    v->eye.ev100 = v->eye.target_ev100 = NAN;
    v->eye.exposure = d->look.exposure > 0 ? d->look.exposure : ag_scene_exposure(d->scene);
}

// What was made of a draft is made of the whole scene, too.
static ag_status edit_again(const ag_scene *draft, ag_scene *whole)
{
    ag_status status = AG_OK;
    ag_light_desc light;
    ag_material_desc edited, material;
    for (size_t i = 0; !status && ag_scene_light(draft, i, &light); i++)
        status = ag_scene_set_light(whole, (ag_light) { (uint32_t)i + 1 }, &light);
    for (size_t i = 0; !status && ag_scene_material(draft, i, &edited); i++) {
        if (!ag_scene_material(whole, i, &material))
            break;
        material.roughness = edited.roughness;
        material.metallic = edited.metallic;
        status = ag_scene_set_material(whole, (ag_material) { (uint32_t)i + 1 }, &material);
    }
    return status;
}

// The rest of a draft comes, and has the same lights and materials.
static bool completes(const viewer *v)
{
    if (!v->drafted || v->loading.draft || !v->loading.keeps_view)
        return false;
    ag_scene_summary draft = v->shown.scene, whole = ag_scene_summarize(v->loading.document.scene);
    return draft.lights == whole.lights && draft.materials == whole.materials;
}

// What the user has picked and changed.
static void take_over_edits(viewer *v)
{
    ag_status status = AG_OK;
    bool same = completes(v);
    if (v->edited && same)
        status = edit_again(v->document.scene, v->loading.document.scene);
    if (v->edited && v->drafted && v->loading.keeps_view && (!same || status))
        viewer_say(v, true, "%s is another file now; what was changed is lost", v->shown.file);
    v->edited &= same;
    if (same)
        return;
    v->picked = v->hovered = (selection) { 0 };
    v->change = (change) { 0 };
}

static void swap(viewer *v)
{
    loading *l = &v->loading;
    ag_render_options look = v->document.look;
    bool keeps = l->keeps_view && v->document.scene;
    tracer_forget(v->tracer);
    if (v->message.alarm)
        v->message.until = 0; // what was wrong is replaced
    take_over_edits(v);
    ag_scene_destroy(v->document.scene);
    v->document = l->document;
    memcpy(v->document_input, l->input, sizeof l->input);
    l->document = (viewer_document) { 0 };
    l->ready = false;
    if (keeps)
        v->document.look = look;
    v->shown.scene = ag_scene_summarize(v->document.scene);
    if (!keeps)
        set_view(v, &v->document);
    v->drafted = l->draft;
    v->first = true;
    set_title(v);
    viewer_redraw(v);
    if (l->draft) { // all of it, from where the user has gone meanwhile
        l->may_draft = false;
        l->keeps_view = true;
        begin(v);
    }
}

void document_collect(viewer *v)
{
    loading *l = &v->loading;
    ag_status status;
    if (worker_collect(l->worker, &status)) {
        l->ready = !status;
        l->failed = status;
        if (status && v->setup->exits && !v->document.scene) {
            v->failed = status; // nobody will ever see a frame
            v->quits = true;
        }
        v->layers_stale = true;
        if (l->next[0]) {
            char next[INPUT_MAX];
            memcpy(next, l->next, sizeof next);
            l->next[0] = 0;
            document_load(v, next, l->next_keeps_view);
        } else if (status && v->document.scene && strcmp(l->input, v->document_input) != 0) {
            watch(v, v->document_input); // that stays
            if (v->drafted)
                document_load(v, v->document_input, true); // all of it, as was begun
        }
    }
    if (l->ready && viewer_can_edit(v))
        swap(v);
}

// ---- Watching ----------------------------------------------------------------

// A file that is being written changes more than once: it is read when it has been the same twice.
void document_watch(viewer *v)
{
    watching *w = &v->watching;
    if (w->next <= 0 || v->now < w->next)
        return;
    w->next = v->now + watch_s;
    if (worker_is_busy(v->loading.worker))
        return;
    int64_t changed_ns, size;
    if (!look_at(v->loading.input, &changed_ns, &size)) {
        if (!w->gone)
            viewer_say(v, true, "%s is gone; what was loaded stays", v->loading.input);
        w->gone = true;
        return;
    }
    bool other = changed_ns != w->changed_ns || size != w->size;
    w->changed_ns = changed_ns;
    w->size = size;
    if (!other && (w->differs || w->gone))
        document_load(v, v->loading.input, true);
    else
        w->differs = other;
}
