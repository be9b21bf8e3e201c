// Paths of light, followed from the eye, a bundle at a time: each step is taken for all of them
// before the next, so that its code and what it reads stay near the processor.
//
// At each surface light is looked for in directions that are drawn by the lights, and in one
// drawn by the surface, along which the path goes on; where both may find the same light each is
// weighted by the power heuristic (Veach & Guibas 1995, eq. 6, exponent 2).
#include "trace/path.h"

#include "physics/color.glsl"
#include "trace/bsdf.h"
#include "trace/eye.h"
#include "trace/sampler.h"

// Pictures hold no more: interop/scene.glsl.
static const float BRIGHTEST = 60000;

// Surfaces before Russian roulette.
enum { CERTAIN = 3 };

// Emitters that give a place less than this share of what the sky gives are looked for less often,
// down to one time in sixteen.
static const float FAINT = 0.125f, SELDOM = 0.0625f;

// Light that arrives if nothing stands in its way.
typedef struct pending {
    vec3 direction, light;
    float distance;
    uint32_t dice;
} pending;

enum { PENDING = 3 }; // by the sky, a light and an emitter

typedef struct path {
    const path_scene *scene;
    sampler dice;
    vec3 throughput;
    vec3 part_share;    // of the environment's light, by the part of the first surface that is
                        // asked for
    vec3 sky_share;     // the same, if the environment is met next
    uint32_t scattered; // how many surfaces have sent on the light that is added now
    path_result *result;
    hit hit;
    bsdf bsdf; // of the surface that it stands on
    lit_place lit;
    float lights;   // lights_weight() of the place
    float emitters; // how often they are looked for there
    pending pending[PENDING];
    uint32_t pending_count;
    vec3 direction; // it goes on in, and its density
    float density;
} path;

static bool wants(const path *p, uint32_t parts)
{
    return (p->scene->picture.parts & parts) != 0;
}

static vec3 exposed(const path_scene *s, vec3 light)
{
    return white_balanced(light, s->exposure.red, s->exposure.green, s->exposure.blue);
}

static void add(path *p, vec3 light)
{
    light = exposed(p->scene, light);
    float most = max(light[0], max(light[1], light[2])), limit = p->scene->options.clamp;
    if (!isfinite(light[0] + light[1] + light[2])) // of light beyond what floats hold
        return;
    if (limit > 0 && most > limit)
        light = light * (limit / most);
    if (p->scattered < 2)
        p->result->direct += light;
    else
        p->result->indirect += light;
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

// Light that the place sends on if `direction` is open.
static void await(path *p, vec3 direction, float distance, vec3 light)
{
    if (p->scene->options.unshadowed)
        add(p, light);
    else
        p->pending[p->pending_count++] =
            (pending) { direction, light, distance, sampler_roll(&p->dice) };
}

static void settle(path *p)
{
    for (uint32_t i = 0; i < p->pending_count; i++) {
        const ray r = { .origin = p->lit.position,
                        .direction = p->pending[i].direction,
                        .far = p->pending[i].distance,
                        .dice = p->pending[i].dice };
        p->result->rays++;
        if (!world_blocked(&p->scene->world, &r))
            add(p, p->pending[i].light);
    }
    p->pending_count = 0;
}

// ---- Light from directions that lights chose -----------------------------------------

// The parts of a surface that the environment is asked to light; on the first surface, else all.
static vec3 sky_part(const path *p, const surface_parts *f)
{
    vec3 none = { 0, 0, 0, 0 };
    if (p->scattered > 1)
        return (f->base + f->lobe) * p->part_share;
    return (wants(p, AG_PART_DIFFUSE) ? f->base : none) +
           (wants(p, AG_PART_SPECULAR) ? f->lobe : none);
}

static float greatest(vec3 v)
{
    return max(v[0], max(v[1], v[2]));
}

static void light_by_sky(path *p, const sky_look *sky)
{
    if (!(sky->density > 0) || dot(sky->direction, p->lit.normal) <= 0)
        return;
    scattered s = bsdf_evaluate_sky(&p->bsdf, sky->direction);
    vec3 f = sky_part(p, &s.f);
    float weight = weight_of_light(p, sky->density, s.density) / sky->density;
    if (greatest(f) > 0)
        await(p, sky->direction, INFINITY, p->throughput * f * sky->radiance * weight);
}

static void light_by_lights(path *p)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    light_found found;
    if (!lights_sample(&p->scene->lights, &p->lit, p->lights, pick, u, &found))
        return;
    scattered s = bsdf_evaluate(&p->bsdf, found.direction);
    float weight = found.density > 0 ? weight_of_light(p, found.density, s.density) : 1;
    vec3 f = (s.f.base + s.f.lobe) * weight;
    if (greatest(f) > 0)
        await(p, found.direction, found.distance, p->throughput * f * found.radiance);
}

static void light_by_emitters(path *p)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    emitter_found found;
    if (pick >= p->emitters ||
        !emitters_sample(&p->scene->emitters, p->lit.position, pick / p->emitters, u, &found))
        return;
    found.density *= p->emitters;
    scattered s = bsdf_evaluate(&p->bsdf, found.direction);
    vec3 f = s.f.base + s.f.lobe;
    if (!(greatest(f) > 0))
        return;
    const world *w = &p->scene->world;
    const hit *on = &found.at;
    vec3 light = place_emission(w, on, -found.direction) *
                 world_opacity(on->instance, on->triangle, on->u, on->v);
    float weight = p->scene->options.unshadowed ? 1 : weight_of_light(p, found.density, s.density);
    if (greatest(light) > 0 && weight > 0)
        await(p, found.direction, found.distance * 0.99999f,
              p->throughput * f * light * (weight / found.density));
}

static bool wants_sky(const path_scene *s)
{
    return s->sky.image && (s->picture.parts & (AG_PART_DIFFUSE | AG_PART_SPECULAR));
}

static bool wants_emitters(const path *p)
{
    return p->scene->emitters.count && wants(p, AG_PART_EMITTED);
}

// ---- Light on the way --------------------------------------------------------------

static void meet_body(void *context, vec3 radiance, float density)
{
    path *p = context;
    add(p, p->throughput * radiance * weight_of_surface(p, p->density, density));
}

static void add_sky(path *p, const sky_look *sky)
{
    float weight = weight_of_surface(p, p->density, sky->density);
    if (weight > 0)
        add(p, p->throughput * p->sky_share * sky->radiance * weight);
}

static void add_emission(path *p, vec3 light)
{
    if (!p->scene->options.unshadowed && wants(p, AG_PART_EMITTED) && greatest(light) > 0) {
        float density = p->emitters * emitters_density(&p->scene->emitters, &p->hit, p->direction);
        add(p, p->throughput * light * weight_of_surface(p, p->density, density));
    }
}

// ---- Steps: from a place ---------------------------------------------------------------
//
// Each says whether the path goes on.

static float emitters_at(const path *p, vec3 position)
{
    float sky = wants_sky(p->scene) ? sky_irradiance(&p->scene->sky) : 0;
    float found = emitters_irradiance(&p->scene->emitters, position);
    return found < FAINT * sky ? max(found / (FAINT * sky), SELDOM) : 1;
}

static void stand_on(path *p, const place *at)
{
    p->bsdf = bsdf_at(&p->scene->albedo, at, -p->direction);
    if (p->scattered == 0)
        p->result->albedo = surface_albedo(p->bsdf.s) + p->bsdf.s.single;
    p->lit = (lit_place) { at->origin, at->normal };
    p->lights = wants(p, AG_PART_LIGHTS) ? lights_weight(&p->scene->lights, &p->lit) : 0;
    p->emitters = wants_emitters(p) ? emitters_at(p, at->origin) : 0;
    p->scattered++;
}

static bool ask_lights(path *p)
{
    const trace_lights *lights = &p->scene->lights;
    if (p->lights > 0)
        light_by_lights(p);
    if (lights->ambient_present && wants(p, AG_PART_LIGHTS))
        add(p, p->throughput * surface_albedo(p->bsdf.s) * lights_ambient(lights, p->lit.normal));
    if (wants_emitters(p))
        light_by_emitters(p);
    return true;
}

static bool settle_lights(path *p)
{
    settle(p);
    return true;
}

static bool survives(path *p)
{
    float dice = sampler_number(&p->dice);
    if (p->scattered < CERTAIN)
        return true;
    // By the root: what a dark surface has left may yet find a lamp in a mirror.
    float chance = min(sqrtf(greatest(p->throughput)), 0.95f);
    if (dice >= chance)
        return false;
    p->throughput = p->throughput / chance;
    return true;
}

static vec3 share_of(vec3 part, vec3 all)
{
    vec3 share = { 0, 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        share[i] = all[i] > 0 ? part[i] / all[i] : 0;
    return share;
}

// A direction to go on in.
static bool scatter(path *p)
{
    float pick = sampler_number(&p->dice);
    vec2 u = sampler_pair(&p->dice);
    if (!bsdf_sample(&p->bsdf, pick, u, &p->direction))
        return false;
    scattered s = bsdf_evaluate(&p->bsdf, p->direction);
    if (!(s.density > 0))
        return false;
    vec3 f = s.f.base + s.f.lobe;
    if (p->scattered == 1)
        p->part_share = share_of(sky_part(p, &s.f), f);
    p->sky_share = p->part_share;
    if (bsdf_minds_sky(&p->bsdf)) {
        surface_parts under = bsdf_evaluate_sky(&p->bsdf, p->direction).f;
        p->sky_share = share_of(
            p->scattered == 1 ? sky_part(p, &under) : (under.base + under.lobe) * p->part_share, f);
    }
    p->throughput = p->throughput * f / s.density;
    p->density = s.density;
    return greatest(p->throughput) > 0 && survives(p);
}

static bool is_last(const path *p)
{
    const ag_reference_options *o = &p->scene->options;
    return o->direct_only || (o->max_bounces && p->scattered > o->max_bounces);
}

// The next surface, and the light that is met before.
static bool meet_surface(path *p)
{
    const ray r = { .origin = p->lit.position,
                    .direction = p->direction,
                    .far = INFINITY,
                    .dice = sampler_roll(&p->dice) };
    bool met = false;
    if (!p->scene->options.unshadowed) {
        met = world_closest(&p->scene->world, &r, &p->hit);
        p->result->rays++;
    }
    if (p->lights > 0)
        lights_along(&p->scene->lights, &p->lit, p->lights, p->direction,
                     met ? p->hit.distance : INFINITY, meet_body, p);
    return met;
}

static bool arrive(path *p)
{
    const world *w = &p->scene->world;
    bool last = is_last(p);
    if (last && !p->hit.instance->material->unlit) { // what it is made of does not matter
        add_emission(p, place_emission(w, &p->hit, -p->direction));
        return false;
    }
    place at = place_at(w, &p->hit, -p->direction);
    if (at.unlit) { // it shines by itself, whatever lights it
        if (wants(p, AG_PART_EMITTED))
            add(p, p->throughput * at.base_color);
        return false;
    }
    add_emission(p, at.emission);
    stand_on(p, &at);
    return true;
}

// ---- From the eye --------------------------------------------------------------------

static vec3 loaded(const float v[3])
{
    return vec3(v[0], v[1], v[2]);
}

// What shines into the eye itself.
static void add_seen(const path_scene *s, path_result *result, vec3 light)
{
    result->alpha = 1;
    if (s->picture.parts & AG_PART_SEEN)
        result->direct += min(exposed(s, light), BRIGHTEST);
}

static bool see_body(const path_scene *s, const ray *r, const hit *met, path_result *result)
{
    vec3 radiance;
    bool suns = !met && s->picture.background == AG_BACKGROUND_ENVIRONMENT;
    if (!lights_seen(&s->lights, r->origin, r->direction, r->near, met ? met->distance : r->far,
                     suns, &radiance))
        return false;
    add_seen(s, result, radiance);
    return true;
}

// True where the path begins at the first surface.
static bool see_surface(path *p)
{
    const path_scene *s = p->scene;
    place at = place_at(&s->world, &p->hit, -p->direction);
    p->result->depth = dot(at.position - loaded(s->view.eye), loaded(s->view.forward));
    p->result->normal = at.unlit ? at.face : at.normal;
    add_seen(s, p->result, at.unlit ? at.base_color : at.emission);
    if (!at.unlit)
        stand_on(p, &at);
    return !at.unlit;
}

// ---- Bundles -------------------------------------------------------------------------

typedef struct bundle {
    const path_scene *scene;
    path paths[PATH_BUNDLE];
    path *live[PATH_BUNDLE];
    size_t count; // of those that live
} bundle;

// What is not set here is set before it is read: a path is large.
static void begin(path *p, const path_scene *s, const ray *r, sampler dice, const hit *met,
                  path_result *result)
{
    p->scene = s;
    p->direction = r->direction;
    p->dice = dice;
    p->throughput = p->part_share = p->sky_share = vec3(1, 1, 1);
    p->scattered = p->pending_count = 0;
    p->hit = *met;
    p->result = result;
}

// What a lane's ray meets first; `met` is NULL where that is no surface, and it shows the sky.
static void see(bundle *b, const ray *r, sampler dice, const hit *met, const vec3 *sky,
                path_result *result)
{
    const path_scene *s = b->scene;
    *result = (path_result) { .rays = 1 };
    if (s->lights.bodies && see_body(s, r, met, result))
        return;
    if (met) {
        path *p = b->live[b->count] = &b->paths[b->count];
        begin(p, s, r, dice, met, result);
        b->count++;
    } else if (s->picture.background == AG_BACKGROUND_ENVIRONMENT) {
        add_seen(s, result, *sky);
    }
}

static void start_packet(bundle *b, const eye_samples *samples, unsigned count,
                         path_result *results)
{
    const path_scene *s = b->scene;
    ray_packet rays;
    hit hits[WORLD_PACKET];
    vec3 sky[WORLD_PACKET];
    eye_rays(&s->view, samples, &rays);
    unsigned met = world_closest_packet(&s->world, &rays, count, hits);
    if (met + 1 < 1u << count && s->picture.background == AG_BACKGROUND_ENVIRONMENT)
        sky_behind(&s->sky, &rays, sky);
    for (unsigned i = 0; i < count; i++) {
        const ray r = world_ray(&rays, i);
        see(b, &r, (sampler) { samples->index[i], samples->seed[i], 1 },
            met >> i & 1 ? &hits[i] : NULL, &sky[i], &results[i]);
    }
}

// Samples of neighbours go much the same way: they are traced together.
static void start(bundle *b, const path_scene *s, const path_work *work, size_t pixels,
                  path_result *results)
{
    eye_samples samples = { 0 };
    unsigned lane = 0;
    size_t done = 0;
    b->scene = s;
    b->count = 0;
    for (size_t i = 0; i < pixels; i++) {
        uint32_t seed = sampler_mix(sampler_mix(s->options.seed, work[i].x), work[i].y);
        for (uint32_t k = 0; k < work[i].count; k++) {
            samples.x[lane] = work[i].x;
            samples.y[lane] = work[i].y;
            samples.index[lane] = work[i].from + k;
            samples.seed[lane] = seed;
            if (++lane == WORLD_PACKET) {
                start_packet(b, &samples, lane, &results[done]);
                done += lane;
                lane = 0;
            }
        }
    }
    if (lane)
        start_packet(b, &samples, lane, &results[done]);
}

// Take a step with all that live; those that end with it are left out from there.
static void step(bundle *b, bool (*take)(path *))
{
    size_t count = 0;
    for (size_t i = 0; i < b->count; i++)
        if (take(b->live[i]))
            b->live[count++] = b->live[i];
    b->count = count;
}

static void expect_places(const bundle *b)
{
    const hit *hits[PATH_BUNDLE];
    for (size_t i = 0; i < b->count; i++)
        hits[i] = &b->live[i]->hit;
    place_expect(hits, b->count);
}

static void ask_sky(bundle *b)
{
    vec2 u[PATH_BUNDLE];
    sky_look looks[PATH_BUNDLE];
    if (!wants_sky(b->scene))
        return;
    for (size_t i = 0; i < b->count; i++)
        u[i] = sampler_pair(&b->live[i]->dice);
    if (b->scene->options.estimator == AG_ESTIMATOR_SURFACE)
        return;
    sky_sample(&b->scene->sky, b->count, u, looks);
    for (size_t i = 0; i < b->count; i++)
        light_by_sky(b->live[i], &looks[i]);
}

// To the next surfaces; what meets none sees the sky.
static void go_on(bundle *b)
{
    path *out[PATH_BUNDLE];
    sky_look looks[PATH_BUNDLE];
    size_t met = 0, missed = 0;
    for (size_t i = 0; i < b->count; i++) {
        path *p = b->live[i];
        if (meet_surface(p))
            b->live[met++] = p;
        else
            out[missed++] = p;
    }
    b->count = met;
    expect_places(b);
    if (!wants_sky(b->scene))
        return;
    for (size_t i = 0; i < missed; i++)
        looks[i].direction = out[i]->direction;
    sky_at(&b->scene->sky, missed, looks);
    for (size_t i = 0; i < missed; i++)
        add_sky(out[i], &looks[i]);
}

void path_follow(const path_scene *s, const path_work *work, size_t pixels, path_result *results)
{
    bundle b;
    start(&b, s, work, pixels, results);
    expect_places(&b);
    step(&b, see_surface);
    while (b.count) {
        ask_sky(&b);
        step(&b, ask_lights);
        step(&b, settle_lights);
        step(&b, scatter);
        go_on(&b);
        step(&b, arrive);
    }
}
