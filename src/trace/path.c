// One path of light, followed from the eye.
//
// At each surface light is looked for in directions that are drawn by the lights, and in one
// drawn by the surface, along which the path goes on; where both may find the same light each is
// weighted by the power heuristic (Veach & Guibas 1995, eq. 6, exponent 2).
#include "trace/path.h"

#include "physics/color.glsl"
#include "trace/bsdf.h"
#include "trace/sampler.h"

// Pictures hold no more: interop/scene.glsl.
static const float BRIGHTEST = 60000;

// Surfaces before Russian roulette.
enum { CERTAIN = 3 };

typedef struct path {
    const path_scene *scene;
    sampler dice;
    vec3 throughput;
    vec3 sky_share; // of the environment's light, by the part of the first surface that is asked
                    // for
    uint32_t scattered; // how many surfaces have sent on the light that is added now
    path_result result;
} path;

static bool wants(const path *p, uint32_t parts)
{
    return (p->scene->picture.parts & parts) != 0;
}

static void add(path *p, vec3 light)
{
    light = light * p->scene->picture.exposure;
    float most = max(light[0], max(light[1], light[2])), limit = p->scene->options.clamp;
    if (!isfinite(most))
        return;
    if (limit > 0 && most > limit)
        light = light * (limit / most);
    if (p->scattered < 2)
        p->result.direct += light;
    else
        p->result.indirect += light;
}

// What shines into the eye itself.
static void add_seen(path *p, vec3 light)
{
    p->result.alpha = 1;
    if (wants(p, AG_PART_SEEN))
        p->result.direct += min(light * p->scene->picture.exposure, BRIGHTEST);
}

// ---- Weights -----------------------------------------------------------------------

static float heuristic(float a, float b)
{
    // By the quotient: squares overflow.
    if (a >= b)
        return 1 / (1 + b / a * (b / a));
    float q = a / b;
    return q * q / (1 + q * q);
}

// Of a direction that a light chose with density `a`, the surface with `b`.
static float weight_of_light(const path *p, float a, float b)
{
    switch (p->scene->options.estimator) {
    case AG_ESTIMATOR_LIGHTS: return 1;
    case AG_ESTIMATOR_SURFACE: return 0;
    default: return heuristic(a, b);
    }
}

// Of one that the surface chose with density `a`.
static float weight_of_surface(const path *p, float a, float b)
{
    switch (p->scene->options.estimator) {
    case AG_ESTIMATOR_LIGHTS: return 0;
    case AG_ESTIMATOR_SURFACE: return 1;
    default: return b > 0 ? heuristic(a, b) : 1;
    }
}

// ---- Rays --------------------------------------------------------------------------

static bool is_open(path *p, vec3 from, vec3 direction, float distance)
{
    if (p->scene->options.unshadowed)
        return true;
    const ray r = {
        .origin = from,
        .direction = direction,
        .far = distance,
        .dice = sampler_mix(p->dice.seed, sampler_mix(p->dice.index, p->dice.drawn)),
    };
    p->result.rays++;
    return !world_blocked(&p->scene->world, &r);
}

static bool find(path *p, vec3 from, vec3 direction, hit *h)
{
    const ray r = {
        .origin = from,
        .direction = direction,
        .far = INFINITY,
        .dice = sampler_mix(p->dice.seed, sampler_mix(p->dice.index, p->dice.drawn)),
    };
    p->result.rays++;
    return world_closest(&p->scene->world, &r, h);
}

// ---- Light from directions that lights chose -----------------------------------------

// The parts of a surface that the environment is asked to light; on the first surface, else all.
static vec3 sky_part(const path *p, const surface_parts *f)
{
    vec3 none = { 0, 0, 0, 0 };
    if (p->scattered > 1)
        return (f->base + f->lobe) * p->sky_share;
    return (wants(p, AG_PART_DIFFUSE) ? f->base : none) +
           (wants(p, AG_PART_SPECULAR) ? f->lobe : none);
}

static void light_by_sky(path *p, const bsdf *b, vec3 from)
{
    vec2 u = sampler_pair(&p->dice);
    if (p->scene->options.estimator == AG_ESTIMATOR_SURFACE)
        return;
    sky_look sky = sky_sample(&p->scene->sky, u);
    if (!(sky.density > 0) || dot(sky.direction, b->frame.n) <= 0)
        return;
    scattered s = bsdf_evaluate(b, sky.direction);
    vec3 f = sky_part(p, &s.f);
    if (max(f[0], max(f[1], f[2])) > 0 && is_open(p, from, sky.direction, INFINITY))
        add(p, p->throughput * f * sky.radiance *
                   (weight_of_light(p, sky.density, s.density) / sky.density));
}

static void light_by_lights(path *p, const bsdf *b, const lit_place *at, float total)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    light_found found;
    if (!lights_sample(&p->scene->lights, at, total, pick, u, &found))
        return;
    scattered s = bsdf_evaluate(b, found.direction);
    float weight = found.density > 0 ? weight_of_light(p, found.density, s.density) : 1;
    vec3 f = (s.f.base + s.f.lobe) * weight;
    if (max(f[0], max(f[1], f[2])) > 0 && is_open(p, at->position, found.direction, found.distance))
        add(p, p->throughput * f * found.radiance);
}

static void light_by_emitters(path *p, const bsdf *b, vec3 from)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    emitter_found found;
    if (!emitters_sample(&p->scene->emitters, from, pick, u, &found))
        return;
    scattered s = bsdf_evaluate(b, found.direction);
    vec3 f = s.f.base + s.f.lobe;
    if (!(max(f[0], max(f[1], f[2])) > 0))
        return;
    const world *w = &p->scene->world;
    const hit *on = &found.at;
    vec3 light = place_emission(w, on, -found.direction) *
                 world_opacity(w, on->instance, on->triangle, on->u, on->v);
    float weight = p->scene->options.unshadowed ? 1 : weight_of_light(p, found.density, s.density);
    if (max(light[0], max(light[1], light[2])) > 0 && weight > 0 &&
        is_open(p, from, found.direction, found.distance * 0.9999f))
        add(p, p->throughput * f * light * (weight / found.density));
}

static bool wants_sky(const path *p)
{
    return p->scene->sky.image && wants(p, AG_PART_DIFFUSE | AG_PART_SPECULAR);
}

static bool wants_emitters(const path *p)
{
    return p->scene->emitters.count && wants(p, AG_PART_EMITTED);
}

// ---- Light on the way --------------------------------------------------------------

// Bodies along a ray whose direction the surface drew with `density`.
typedef struct meeting {
    path *path;
    float density;
} meeting;

static void meet_body(void *context, vec3 radiance, float density)
{
    meeting *m = context;
    path *p = m->path;
    add(p, p->throughput * radiance * weight_of_surface(p, m->density, density));
}

static void add_sky(path *p, vec3 direction, float density)
{
    sky_look sky = sky_at(&p->scene->sky, direction);
    float weight = weight_of_surface(p, density, sky.density);
    if (weight > 0)
        add(p, p->throughput * p->sky_share * sky.radiance * weight);
}

static void add_emission(path *p, const hit *h, vec3 direction, float density)
{
    if (p->scene->options.unshadowed)
        return;
    vec3 light = place_emission(&p->scene->world, h, -direction);
    if (max(light[0], max(light[1], light[2])) > 0)
        add(p,
            p->throughput * light *
                weight_of_surface(p, density, emitters_density(&p->scene->emitters, h, direction)));
}

// ---- Surfaces ----------------------------------------------------------------------

// Light that lights send to a place, and it towards where the path came from.
static void light_place(path *p, const bsdf *b, const lit_place *at, float total)
{
    p->scattered++;
    if (wants_sky(p))
        light_by_sky(p, b, at->position);
    if (total > 0)
        light_by_lights(p, b, at, total);
    if (p->scene->lights.ambient_present && wants(p, AG_PART_LIGHTS))
        add(p,
            p->throughput * surface_albedo(b->s) * lights_ambient(&p->scene->lights, b->frame.n));
    if (wants_emitters(p))
        light_by_emitters(p, b, at->position);
}

// A direction to go on in; false where the path ends.
static bool scatter(path *p, const bsdf *b, vec3 *direction, float *density)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    if (!bsdf_sample(b, pick, u, direction))
        return false;
    scattered s = bsdf_evaluate(b, *direction);
    if (!(s.density > 0))
        return false;
    vec3 f = s.f.base + s.f.lobe;
    if (p->scattered == 1) {
        vec3 part = sky_part(p, &s.f);
        for (int i = 0; i < 3; i++)
            p->sky_share[i] = f[i] > 0 ? part[i] / f[i] : 0;
    }
    p->throughput = p->throughput * f / s.density;
    *density = s.density;
    return max(p->throughput[0], max(p->throughput[1], p->throughput[2])) > 0;
}

static bool survives(path *p)
{
    float dice = sampler_number(&p->dice);
    if (p->scattered < CERTAIN)
        return true;
    vec3 t = p->throughput;
    float chance = min(max(t[0], max(t[1], t[2])), 0.95f);
    if (dice >= chance)
        return false;
    p->throughput = t / chance;
    return true;
}

static bool is_last(const path *p)
{
    const ag_reference_options *o = &p->scene->options;
    return o->direct_only || (o->max_bounces && p->scattered > o->max_bounces);
}

// On from a surface in a direction drawn with `density`: the light that is met, and the next
// surface.  False: there is none, or it is not asked for.
static bool go_on(path *p, const lit_place *at, float total, vec3 direction, float density, hit *h)
{
    bool unshadowed = p->scene->options.unshadowed, met = false;
    if (!unshadowed)
        met = find(p, at->position, direction, h);
    if (total > 0) {
        meeting m = { p, density };
        lights_along(&p->scene->lights, at, total, direction, met ? h->distance : INFINITY,
                     meet_body, &m);
    }
    if (!met) {
        if (wants_sky(p))
            add_sky(p, direction, density);
        return false;
    }
    if (wants(p, AG_PART_EMITTED))
        add_emission(p, h, direction, density);
    return !is_last(p);
}

// From the first surface on.
static void walk(path *p, place at, vec3 wo)
{
    for (;;) {
        bsdf b = bsdf_at(&p->scene->albedo, &at, wo);
        if (p->scattered == 0)
            p->result.albedo = surface_albedo(b.s) + b.s.single;
        lit_place lit = { at.origin, at.normal };
        float total = wants(p, AG_PART_LIGHTS) ? lights_weight(&p->scene->lights, &lit) : 0;
        light_place(p, &b, &lit, total);
        vec3 direction;
        float density;
        hit h;
        if (!scatter(p, &b, &direction, &density) || !survives(p) ||
            !go_on(p, &lit, total, direction, density, &h))
            return;
        wo = -direction;
        at = place_at(&p->scene->world, &h, wo);
        if (at.unlit) { // it shines by itself, whatever lights it
            if (wants(p, AG_PART_EMITTED))
                add(p, p->throughput * at.base_color);
            return;
        }
    }
}

// ---- From the eye --------------------------------------------------------------------

static vec3 loaded(const float v[3])
{
    return vec3(v[0], v[1], v[2]);
}

// Through a place of the pixel that its filter drew: that of quality `best`.
static ray eye_ray(path *p, uint32_t x, uint32_t y)
{
    const view *v = &p->scene->view;
    vec2 at = sampling_gaussian(sampler_pair(&p->dice), 0.47f, 1.5f);
    float clip_x = 2 * ((float)x + 0.5f + at[0]) / (float)v->width - 1;
    float clip_y = 1 - 2 * ((float)y + 0.5f + at[1]) / (float)v->height;
    vec3 off = clip_x * v->half_x * loaded(v->right) + clip_y * v->half_y * loaded(v->up);
    vec3 forward = loaded(v->forward), eye = loaded(v->eye);
    ray r = { .origin = eye, .direction = forward, .from_eye = true };
    if (v->orthographic)
        r.origin = eye + off;
    else
        r.direction = normalize(forward + off);
    float along = dot(r.direction, forward);
    r.near = max(v->near_m, 0) / along;
    r.far = v->far_m / along;
    r.dice = sampler_mix(p->dice.seed, sampler_mix(p->dice.index, p->dice.drawn));
    return r;
}

static void see_background(path *p, vec3 direction)
{
    if (p->scene->picture.background == AG_BACKGROUND_ENVIRONMENT)
        add_seen(p, sky_at(&p->scene->sky, direction).radiance);
}

static bool see_body(path *p, const ray *r, float distance)
{
    vec3 radiance;
    bool suns = p->scene->picture.background == AG_BACKGROUND_ENVIRONMENT && isinf(distance);
    if (!lights_seen(&p->scene->lights, r->origin, r->direction, r->near, suns, &distance,
                     &radiance))
        return false;
    add_seen(p, radiance);
    return true;
}

path_result path_follow(const path_scene *s, uint32_t x, uint32_t y, uint32_t index)
{
    path p = {
        .scene = s,
        .dice = { index, sampler_mix(sampler_mix(s->options.seed, x), y), 0 },
        .throughput = vec3(1, 1, 1),
        .sky_share = vec3(1, 1, 1),
    };
    ray r = eye_ray(&p, x, y);
    hit h;
    p.result.rays++;
    bool met = world_closest(&s->world, &r, &h);
    if (see_body(&p, &r, met ? h.distance : INFINITY))
        return p.result;
    if (!met) {
        see_background(&p, r.direction);
        return p.result;
    }
    vec3 wo = -r.direction;
    place at = place_at(&s->world, &h, wo);
    p.result.depth = dot(at.position - loaded(s->view.eye), loaded(s->view.forward));
    p.result.normal = at.unlit ? at.face : at.normal;
    add_seen(&p, at.unlit ? at.base_color : place_emission(&s->world, &h, wo));
    if (!at.unlit)
        walk(&p, at, wo);
    return p.result;
}
