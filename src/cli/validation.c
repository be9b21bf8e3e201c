// One scene in real time and by the reference, whole and in parts.
//
// A part is the light of one kind alone.  The reference makes it as the renderer approximates
// it: straight from where it shines to the eye by one surface, and nothing in between.  What
// the parts have not is the last of them: shadows, and light that surfaces pass on.
#include "validation.h"

#include "data_uri.h"
#include "expose.h"

#include <stdio.h>
#include <stdlib.h>

enum { QUALITY_WHOLE = 92, QUALITY_PART = 85 };

typedef float (*sum)[4]; // [height][width], of a part

typedef struct work {
    validation *v;
    maker maker;
    uint32_t width, height; // px, of a part
    double mean;            // of the whole reference's light
    sum direct[2];          // of the reference's parts, half by half
    sum lights[3];          // of lights that have a part: in real time, and half by half
} work;

static const ag_log *log_of(const work *w)
{
    return &w->maker.shot->log;
}

// ---- Measuring -------------------------------------------------------------------

static linear_difference measure_light(const work *w, const ways *made)
{
    linear_difference d = linear_apart(made);
    d.error /= w->mean;
    d.bias /= w->mean;
    d.rms /= w->mean;
    return d;
}

// Two pictures as they are shown: compared, and kept.
static ag_status measure_look(const work *w, ag_image *const shown[2], int quality,
                              picture_pair *pair, ag_difference *difference, ag_image **heat)
{
    const ag_log *log = log_of(w);
    ag_status status = ag_image_compare(log, shown[1], shown[0], NULL, difference, heat);
    if (!status)
        status = data_uri_from_image(log, shown[0], quality, &pair->real_time);
    return status ? status : data_uri_from_image(log, shown[1], quality, &pair->reference);
}

static void drop(ag_image *images[2])
{
    ag_image_destroy(images[0]);
    ag_image_destroy(images[1]);
}

static ag_status add_cause(work *w, const char *name, const char *about, const ways *made)
{
    if (linear_mean(made->real_time.mean) == 0 && linear_mean(made->reference.mean) == 0)
        return AG_OK; // the scene has no such light
    cause *c = &w->v->causes[w->v->cause_count++];
    *c = (cause) { .about = about, .apart = measure_light(w, made) };
    snprintf(c->name, sizeof c->name, "%s", name);
    const ag_render_options *look = &w->maker.look;
    ag_difference difference = { 0 };
    ag_image *shown[2] = { NULL, NULL };
    ag_status status = ag_image_display(log_of(w), made->real_time.mean, look, &shown[0]);
    if (!status)
        status = ag_image_display(log_of(w), made->reference.mean, look, &shown[1]);
    if (!status)
        status = measure_look(w, shown, QUALITY_PART, &c->shown, &difference, NULL);
    c->flip = difference.flip;
    drop(shown);
    return status;
}

// ---- Parts -----------------------------------------------------------------------

static ag_render_options part_options(const work *w, uint32_t parts, uint32_t light)
{
    ag_render_options o = maker_linear(&w->maker);
    o.width = w->width;
    o.height = w->height;
    o.parts = parts;
    o.light.id = light;
    return o;
}

static ag_status make_part(work *w, uint32_t parts, uint32_t light, ways *made)
{
    const ag_render_options options = part_options(w, parts, light);
    *made = (ways) { 0 };
    ag_status status = maker_draw(&w->maker, &options, &made->real_time.mean, NULL);
    return status ? status
                  : maker_trace(&w->maker, &options, true, CAUSE_TIME, &made->reference, NULL);
}

static ag_status add_part(work *w, const char *name, const char *about, uint32_t parts,
                          uint32_t light)
{
    ways made;
    ag_status status = make_part(w, parts, light, &made);
    if (!status) {
        for (int i = 0; i < 2; i++)
            linear_add(w->direct[i], made.reference.half[i], 1);
        for (int i = 0; i < 3 && light; i++)
            linear_add(w->lights[i], i ? made.reference.half[i - 1] : made.real_time.mean, 1);
        status = add_cause(w, name, about, &made);
    }
    ways_finish(&made);
    return status;
}

static ag_status image_of(const work *w, sum pixels, ag_image **image)
{
    const ag_image_desc desc = { w->width, w->height, AG_FORMAT_RGBA32F, pixels };
    return ag_image_create(log_of(w), &desc, image);
}

static ag_status side_of(const work *w, sum const halves[2], side *s)
{
    ag_image *images[2] = { NULL, NULL };
    ag_status status = image_of(w, halves[0], &images[0]);
    if (!status)
        status = image_of(w, halves[1], &images[1]);
    if (!status)
        return side_from_halves(log_of(w), images, s);
    drop(images);
    return status;
}

// sum = image - sum
static void subtract_from(const work *w, sum s, const ag_image *image)
{
    size_t count = (size_t)w->width * w->height;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            s[i][c] = -s[i][c];
    linear_add(s, image, 1);
}

// All lights less those that have a part of their own.
static ag_status add_other_lights(work *w, const char *name, const char *about)
{
    ways all, others = { 0 };
    ag_status status = make_part(w, AG_PART_LIGHTS, 0, &all);
    for (int i = 0; i < 3 && !status; i++)
        subtract_from(w, w->lights[i], i ? all.reference.half[i - 1] : all.real_time.mean);
    if (!status)
        status = image_of(w, w->lights[0], &others.real_time.mean);
    if (!status)
        status = side_of(w, w->lights + 1, &others.reference);
    for (int i = 0; i < 2 && !status; i++)
        linear_add(w->direct[i], others.reference.half[i], 1);
    if (!status)
        status = add_cause(w, name, about, &others);
    ways_finish(&all);
    ways_finish(&others);
    return status;
}

// How many pictures of lights there are.
static uint32_t light_parts(const work *w)
{
    uint32_t lights = ag_scene_summarize(w->maker.shot->scene).lights;
    return lights < CAUSE_LIGHTS ? lights : CAUSE_LIGHTS;
}

static ag_status add_lights(work *w)
{
    static const char about[] =
        "Light on surfaces, straight from the source and with nothing in its way.";
    const ag_scene *scene = w->maker.shot->scene;
    uint32_t lights = ag_scene_summarize(scene).lights;
    uint32_t alone = lights > CAUSE_LIGHTS ? CAUSE_LIGHTS - 1 : lights;
    ag_status status = AG_OK;
    char name[64];
    for (uint32_t i = 0; i < alone && !status; i++) {
        ag_light_desc light;
        ag_scene_light(scene, i, &light);
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
    ways made = { 0 };
    ag_status status = maker_trace(&w->maker, &options, false, CAUSE_TIME, &made.reference, NULL);
    if (!status)
        status = side_of(w, w->direct, &made.real_time);
    if (!status)
        status = add_cause(w, "Shadows and inter-reflection",
                           "What is in the way of light, and light that surfaces pass on to "
                           "others.  Both pictures are the reference's: without, and with.",
                           &made);
    ways_finish(&made);
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

// ---- The whole -------------------------------------------------------------------

static ag_status measure_whole(work *w, const ways *made)
{
    validation *v = w->v;
    w->mean = linear_mean(made->reference.mean);
    w->mean = w->mean > 0 ? w->mean : 1; // a black picture: errors are what they are
    v->apart = measure_light(w, made);
    return ag_image_compare(log_of(w), made->reference.mean, made->real_time.mean, NULL, &v->linear,
                            NULL);
}

// What `argand render` would write, and the reference's light shown as that is.
static ag_status show_whole(work *w, const ways *made)
{
    validation *v = w->v;
    ag_render_options coded = w->maker.look;
    coded.progress = (ag_progress) { 0 };
    ag_image *shown[2] = { NULL, NULL }, *heat = NULL;
    ag_status status = maker_draw(&w->maker, &coded, &shown[0], &v->frame_ms);
    if (!status)
        status = ag_image_display(log_of(w), made->reference.mean, &coded, &shown[1]);
    if (!status)
        status = measure_look(w, shown, QUALITY_WHOLE, &v->shown, &v->coded, &heat);
    if (!status)
        status = data_uri_from_image(log_of(w), heat, QUALITY_WHOLE, &v->heat);
    ag_image_destroy(heat);
    drop(shown);
    return status;
}

static ag_status make_whole(work *w)
{
    const ag_render_options linear = maker_linear(&w->maker);
    ways made = { 0 };
    ag_status status = maker_draw(&w->maker, &linear, &made.real_time.mean, NULL);
    if (!status)
        status = maker_trace(&w->maker, &linear, false, 1, &made.reference, &w->v->state);
    if (!status)
        status = measure_whole(w, &made);
    if (!status)
        status = show_whole(w, &made);
    ways_finish(&made);
    return status;
}

// How large a part is, and room for sums of parts.
static ag_status plan(work *w)
{
    const ag_render_options *look = &w->maker.look;
    uint32_t larger = look->width > look->height ? look->width : look->height;
    uint32_t shrink = (larger + CAUSE_SIZE - 1) / CAUSE_SIZE;
    w->width = look->width > shrink ? look->width / shrink : 1;
    w->height = look->height > shrink ? look->height / shrink : 1;
    size_t count = (size_t)w->width * w->height;
    sum all = calloc(5 * count, sizeof *all);
    if (!all) {
        console_say(w->maker.shot->console, AG_LOG_ERROR, "There is no memory for %ux%u pixels",
                    w->width, w->height);
        return AG_ERROR_MEMORY;
    }
    for (size_t i = 0; i < 2; i++)
        w->direct[i] = all + i * count;
    for (size_t i = 0; i < 3; i++)
        w->lights[i] = all + (2 + i) * count;
    return AG_OK;
}

// A part without bounces costs about half as much as the whole of its size.
static double part_share(const work *w)
{
    const ag_render_options *look = &w->maker.look;
    double size = (double)w->width * w->height / ((double)look->width * look->height);
    return size * 0.5 / (1 + size * 0.5 * (light_parts(w) + 6));
}

ag_status validation_make(validation *v, shot *s, ag_renderer *renderer,
                          const ag_reference_goal *goal, ag_progress progress)
{
    *v = (validation) { .input = s->request->input };
    work w = { .v = v, .maker = { .shot = s, .renderer = renderer, .goal = *goal } };
    maker *m = &w.maker;
    ag_status status = shot_compose(s, AG_FORMAT_RGBA8, &m->camera, &m->look);
    if (!status)
        status = expose(s, renderer, &m->camera, NULL, &m->look);
    if (!status)
        status = plan(&w);
    if (status)
        return status;
    m->look.progress = progress;
    v->exposure = m->look.exposure;
    v->width = m->look.width;
    v->height = m->look.height;
    double part = part_share(&w);
    m->doing = 1 - part * (light_parts(&w) + 6);
    status = make_whole(&w);
    m->doing = part;
    if (!status)
        status = add_causes(&w);
    free(w.direct[0]); // all of them
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
