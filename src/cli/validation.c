// One scene in real time and by the reference, whole and in parts.
//
// A part is the light of one kind alone.  The reference makes it as the renderer approximates
// it: straight from where it shines to the eye by one surface, and nothing in between.  What
// the parts have not is the last of them: shadows, and light that surfaces pass on.
#include "validation.h"

#include "data_uri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUALITY_WHOLE = 92, QUALITY_PART = 85 };

typedef struct work {
    validation *v;
    shot *shot;
    ag_renderer *renderer;
    ag_camera_desc camera;
    ag_render_options look; // as the whole picture is shown
    uint32_t width, height; // px, of a part
    double mean;            // of the whole reference's light
    float (*direct)[4];     // sum of the reference's parts
    float (*lights[2])[4];  // sums of lights, real time and reference
    const ag_reference_goal *goal;
    ag_progress progress;
    double done, doing; // of the work: before this trace, and by it
} work;

// ---- Pictures ------------------------------------------------------------------

static ag_render_options linear_options(const work *w)
{
    ag_render_options o = w->look;
    o.format = AG_FORMAT_RGBA32F;
    if (o.background == AG_BACKGROUND_COLOR)
        o.background = AG_BACKGROUND_TRANSPARENT;
    return o;
}

static ag_status draw(work *w, const ag_render_options *options, ag_image **image)
{
    ag_render_stats stats;
    ag_status status =
        ag_renderer_render(w->renderer, w->shot->scene, &w->camera, options, image, &stats);
    if (options == &w->look)
        w->v->frame_ms = stats.frame_ms;
    return status;
}

static bool update(void *user, const char *stage, double fraction)
{
    const work *w = user;
    const ag_progress *p = &w->progress;
    return !p->update || p->update(p->user, stage, w->done + fraction * w->doing);
}

static ag_status trace(work *w, const ag_render_options *picture,
                       const ag_reference_options *options, const ag_reference_goal *goal,
                       ag_reference_state *state, ag_image **image)
{
    ag_reference *reference;
    ag_reference_goal told = *goal;
    told.progress = (ag_progress) { .update = update, .user = w };
    *image = NULL;
    ag_status status =
        ag_reference_create(w->shot->scene, &w->camera, picture, options, &reference);
    if (status)
        return status;
    status = ag_reference_trace(reference, &told);
    if (!status)
        status = ag_reference_picture(reference, image);
    *state = ag_reference_describe(reference);
    ag_reference_destroy(reference);
    w->done += w->doing;
    return status;
}

// The light of a part by the reference: as the renderer means it, or all that is.
static ag_status trace_part(work *w, const ag_render_options *picture, bool direct,
                            ag_image **image)
{
    const ag_reference_options options = { .direct_only = direct, .unshadowed = direct };
    ag_reference_goal goal = *w->goal;
    goal.seconds /= 8;
    ag_reference_state state;
    return trace(w, picture, &options, &goal, &state, image);
}

// ---- Causes --------------------------------------------------------------------

// Two pictures as they are shown.
static ag_status keep(const work *w, ag_image *const shown[2], int quality, picture_pair *pair)
{
    const ag_log *log = &w->shot->log;
    ag_status status = data_uri_from_image(log, shown[0], quality, &pair->real_time);
    return status ? status : data_uri_from_image(log, shown[1], quality, &pair->reference);
}

static void drop(ag_image *images[2])
{
    ag_image_destroy(images[0]);
    ag_image_destroy(images[1]);
}

// Measure two linear pictures and keep them.
static ag_status add_cause(work *w, const char *name, const char *about, const ag_image *real_time,
                           const ag_image *reference)
{
    if (linear_mean(real_time) == 0 && linear_mean(reference) == 0)
        return AG_OK; // the scene has no such light
    cause *c = &w->v->causes[w->v->cause_count++];
    const ag_log *log = &w->shot->log;
    ag_image *shown[2] = { NULL, NULL };
    *c = (cause) { .about = about, .apart = linear_apart(reference, real_time) };
    snprintf(c->name, sizeof c->name, "%s", name);
    c->apart.error /= w->mean;
    c->apart.bias /= w->mean;
    ag_difference difference;
    ag_status status = ag_image_display(log, real_time, &w->look, &shown[0]);
    if (!status)
        status = ag_image_display(log, reference, &w->look, &shown[1]);
    if (!status)
        status = ag_image_compare(log, shown[1], shown[0], NULL, &difference, NULL);
    if (!status) {
        c->flip = difference.flip;
        status = keep(w, shown, QUALITY_PART, &c->shown);
    }
    drop(shown);
    return status;
}

static ag_render_options part_options(const work *w, uint32_t parts, uint32_t light)
{
    ag_render_options o = linear_options(w);
    o.width = w->width;
    o.height = w->height;
    o.parts = parts;
    o.light.id = light;
    return o;
}

static ag_status make_part(work *w, uint32_t parts, uint32_t light, ag_image *made[2])
{
    const ag_render_options options = part_options(w, parts, light);
    made[0] = made[1] = NULL;
    ag_status status = draw(w, &options, &made[0]);
    return status ? status : trace_part(w, &options, true, &made[1]);
}

static ag_status add_part(work *w, const char *name, const char *about, uint32_t parts,
                          uint32_t light)
{
    ag_image *made[2];
    ag_status status = make_part(w, parts, light, made);
    if (!status) {
        linear_add(w->direct, made[1], 1);
        for (int i = 0; i < 2 && light; i++)
            linear_add(w->lights[i], made[i], 1);
        status = add_cause(w, name, about, made[0], made[1]);
    }
    drop(made);
    return status;
}

static ag_status image_of(const work *w, float (*pixels)[4], ag_image **image)
{
    const ag_image_desc desc = { w->width, w->height, AG_FORMAT_RGBA32F, pixels };
    return ag_image_create(&w->shot->log, &desc, image);
}

// All lights less those that have a part of their own.
static ag_status add_other_lights(work *w, const char *name, const char *about)
{
    ag_image *all[2], *others[2] = { NULL, NULL };
    ag_status status = make_part(w, AG_PART_LIGHTS, 0, all);
    for (int i = 0; i < 2 && !status; i++) {
        size_t count = (size_t)w->width * w->height;
        for (size_t k = 0; k < count; k++)
            for (int c = 0; c < 3; c++)
                w->lights[i][k][c] = -w->lights[i][k][c];
        linear_add(w->lights[i], all[i], 1);
        status = image_of(w, w->lights[i], &others[i]);
    }
    if (!status) {
        linear_add(w->direct, others[1], 1);
        status = add_cause(w, name, about, others[0], others[1]);
    }
    drop(all);
    drop(others);
    return status;
}

// How many pictures of lights there are.
static uint32_t light_parts(const work *w)
{
    uint32_t lights = ag_scene_summarize(w->shot->scene).lights;
    return lights < CAUSE_LIGHTS ? lights : CAUSE_LIGHTS;
}

static ag_status add_lights(work *w)
{
    static const char about[] =
        "Light on surfaces, straight from the source and with nothing in its way.";
    uint32_t lights = ag_scene_summarize(w->shot->scene).lights;
    uint32_t alone = lights > CAUSE_LIGHTS ? CAUSE_LIGHTS - 1 : lights;
    ag_status status = AG_OK;
    char name[64];
    for (uint32_t i = 0; i < alone && !status; i++) {
        ag_light_desc light;
        ag_scene_light(w->shot->scene, i, &light);
        snprintf(name, sizeof name, "Light %u, %s", i + 1, light_kind_word(light.kind));
        status = add_part(w, name, about, AG_PART_LIGHTS, i + 1);
    }
    snprintf(name, sizeof name, "The other %u lights", lights - alone);
    return status || lights == alone ? status : add_other_lights(w, name, about);
}

// What the parts have not.
static ag_status add_transport(work *w)
{
    const ag_render_options options = part_options(w, 0, 0);
    ag_image *direct = NULL, *whole = NULL;
    ag_status status = trace_part(w, &options, false, &whole);
    if (!status)
        status = image_of(w, w->direct, &direct);
    if (!status)
        status = add_cause(w, "Shadows and inter-reflection",
                           "What is in the way of light, and light that surfaces pass on to "
                           "others.  Both pictures are the reference's: without, and with.",
                           direct, whole);
    ag_image_destroy(direct);
    ag_image_destroy(whole);
    return status;
}

static ag_status add_causes(work *w)
{
    ag_status status = add_part(w, "Seen itself",
                                "Background, emission and bodies of lights, as they shine into "
                                "the eye.  They differ at edges.",
                                AG_PART_SEEN, 0);
    if (!status)
        status = add_lights(w);
    if (!status)
        status = add_part(w, "Environment, diffuse",
                          "The surroundings' light that the base of surfaces scatters, with "
                          "nothing in its way.",
                          AG_PART_DIFFUSE, 0);
    if (!status)
        status = add_part(w, "Environment, specular",
                          "The surroundings' light that surfaces mirror, with nothing in its way.",
                          AG_PART_SPECULAR, 0);
    if (!status)
        status = add_part(w, "Emissive surfaces",
                          "Light on surfaces straight from those that glow.  The renderer has "
                          "none of it.",
                          AG_PART_EMITTED, 0);
    return status ? status : add_transport(w);
}

// ---- The whole -----------------------------------------------------------------

static ag_status measure_light(work *w, const ag_image *real_time, const ag_image *reference)
{
    validation *v = w->v;
    w->mean = linear_mean(reference);
    w->mean = w->mean > 0 ? w->mean : 1; // a black picture: errors are what they are
    v->apart = linear_apart(reference, real_time);
    v->apart.error /= w->mean;
    v->apart.bias /= w->mean;
    return ag_image_compare(&w->shot->log, reference, real_time, NULL, &v->linear, NULL);
}

// The pictures as they are shown: what `argand render` would write, and the reference's light.
static ag_status measure_look(work *w, const ag_image *reference)
{
    validation *v = w->v;
    const ag_log *log = &w->shot->log;
    ag_image *shown[2] = { NULL, NULL }, *heat = NULL;
    ag_status status = draw(w, &w->look, &shown[0]);
    if (!status)
        status = ag_image_display(log, reference, &w->look, &shown[1]);
    if (!status)
        status = ag_image_compare(log, shown[1], shown[0], NULL, &v->coded, &heat);
    if (!status)
        status = keep(w, shown, QUALITY_WHOLE, &v->shown);
    if (!status)
        status = data_uri_from_image(log, heat, QUALITY_WHOLE, &v->heat);
    ag_image_destroy(heat);
    drop(shown);
    return status;
}

static ag_status make_whole(work *w)
{
    const ag_render_options linear = linear_options(w);
    const ag_reference_options everything = { 0 };
    ag_image *made[2] = { NULL, NULL };
    ag_status status = draw(w, &linear, &made[0]);
    if (!status)
        status = trace(w, &linear, &everything, w->goal, &w->v->state, &made[1]);
    if (!status)
        status = measure_light(w, made[0], made[1]);
    if (!status)
        status = measure_look(w, made[1]);
    drop(made);
    return status;
}

// How large a part is, and room for sums of parts.
static ag_status plan(work *w)
{
    uint32_t larger = w->look.width > w->look.height ? w->look.width : w->look.height;
    uint32_t shrink = (larger + CAUSE_SIZE - 1) / CAUSE_SIZE;
    w->width = w->look.width > shrink ? w->look.width / shrink : 1;
    w->height = w->look.height > shrink ? w->look.height / shrink : 1;
    size_t count = (size_t)w->width * w->height;
    w->direct = calloc(count, sizeof *w->direct);
    w->lights[0] = calloc(count, sizeof *w->direct);
    w->lights[1] = calloc(count, sizeof *w->direct);
    if (w->direct && w->lights[0] && w->lights[1])
        return AG_OK;
    console_say(w->shot->console, AG_LOG_ERROR, "There is no memory for %ux%u pixels", w->width,
                w->height);
    return AG_ERROR_MEMORY;
}

// A part without bounces costs about half as much as the whole of its size.
static double part_share(const work *w)
{
    double size = (double)w->width * w->height / ((double)w->look.width * w->look.height);
    return size * 0.5 / (1 + size * 0.5 * (light_parts(w) + 6));
}

ag_status validation_make(validation *v, shot *s, ag_renderer *renderer,
                          const ag_reference_goal *goal, ag_progress progress)
{
    *v = (validation) { .input = s->request->input };
    work w = { .v = v, .shot = s, .renderer = renderer, .goal = goal, .progress = progress };
    ag_status status = shot_compose(s, AG_FORMAT_RGBA8, &w.camera, &w.look);
    w.look.progress = (ag_progress) { 0 };
    v->width = w.look.width;
    v->height = w.look.height;
    if (!status)
        status = plan(&w);
    double part = status ? 0 : part_share(&w);
    w.doing = 1 - part * (light_parts(&w) + 6);
    if (!status)
        status = make_whole(&w);
    w.doing = part;
    if (!status)
        status = add_causes(&w);
    free(w.direct);
    free(w.lights[0]);
    free(w.lights[1]);
    return status;
}

static void free_pair(picture_pair *pair)
{
    free(pair->real_time);
    free(pair->reference);
}

void validation_finish(validation *v)
{
    free_pair(&v->shown);
    free(v->heat);
    for (size_t i = 0; i < v->cause_count; i++)
        free_pair(&v->causes[i].shown);
    *v = (validation) { 0 };
}
