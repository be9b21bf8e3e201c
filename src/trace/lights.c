// The lights of a scene that are not its environment.
#include "trace/lights.h"

#include "base/log.h"
#include "physics/ambient.glsl"
#include "physics/light_punctual.glsl"
#include "physics/light_sampling.glsl"

#include <stdlib.h>

static vec3 loaded(const float v[3])
{
    return vec3(v[0], v[1], v[2]);
}

static float greatest(vec3 c)
{
    return max(c[0], max(c[1], c[2]));
}

static float length_of(vec3 v)
{
    return sqrtf(dot(v, v));
}

// ---- One light -----------------------------------------------------------------

static float candela(const trace_light *l)
{
    float most = greatest(l->intensity), x = length_of(l->x), y = length_of(l->y), r = l->radius;
    switch (l->kind) {
    case AG_LIGHT_RECT: return most * 4 * x * y;
    case AG_LIGHT_DISK: return most * PI * x * y;
    case AG_LIGHT_TUBE: return most * (4 * x * r + PI * r * r);
    default: return most;
    }
}

static trace_light light_from(const ag_light_desc *d)
{
    float x[3], y[3], spread = light_spread(d);
    light_axes(d, x, y);
    trace_light l = {
        .kind = d->kind,
        .seen = !d->hidden && spread > 0,
        .position = loaded(d->position),
        .direction = loaded(d->direction),
        .x = loaded(x),
        .y = loaded(y),
        .intensity = loaded(d->color) * d->intensity,
        .cone = light_spot_cone(cosf(d->cone_inner_rad), cosf(d->cone_outer_rad)),
        .radius = d->kind == AG_LIGHT_SUN ? sinf(d->angular_radius_rad) : d->radius_m,
        .cosine = cosf(d->angular_radius_rad),
        .inverse_range2 = d->range_m > 0 ? 1 / (d->range_m * d->range_m) : 0,
    };
    if (spread > 0)
        l.radiance = l.intensity / spread;
    // A sphere without a radius that floats can square is a point.
    if (d->kind == AG_LIGHT_SPHERE && !(d->radius_m > 1e-12f)) {
        l.kind = AG_LIGHT_POINT;
        l.radiance = vec3(0, 0, 0);
        l.seen = false;
    }
    l.power = min(candela(&l), 1e30f); // of many together: finite
    return l;
}

ag_status lights_init(const ag_scene *scene, ag_light only, trace_lights *l)
{
    *l = (trace_lights) { 0 };
    l->all = aligned_alloc(_Alignof(trace_light), (scene->lights_count + 1) * sizeof *l->all);
    if (!l->all)
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for %zu lights",
                        scene->lights_count);
    for (size_t i = 0; i < scene->lights_count; i++) {
        const ag_light_desc *d = &scene->lights[i];
        if (light_is_ambient(d->kind))
            continue;
        trace_light light = light_from(d);
        if (only.id && only.id != i + 1) { // dark, but its body is there
            light.intensity = light.radiance = vec3(0, 0, 0);
            light.power = 0;
        }
        if (!(light.power > 0) && !light.seen)
            continue;
        l->bodies |= light_spread(d) > 0;
        l->all[l->count++] = light;
    }
    l->ambient_present = scene_ambient(scene, only, l->ambient);
    return AG_OK;
}

void lights_finish(trace_lights *l)
{
    free(l->all);
    *l = (trace_lights) { 0 };
}

vec3 lights_ambient(const trace_lights *l, vec3 normal)
{
    const float(*a)[3] = l->ambient;
    return ambient_at((ambient_light) { loaded(a[0]), loaded(a[1]), loaded(a[2]), loaded(a[3]),
                                        loaded(a[4]), loaded(a[5]), loaded(a[6]), loaded(a[7]),
                                        loaded(a[8]) },
                      normal);
}

// ---- Choosing one ----------------------------------------------------------------

// About the irradiance that a light gives to a place; above 0 wherever it may give any.
static float weight_at(const trace_light *l, const lit_place *p)
{
    if (l->kind == AG_LIGHT_DIRECTIONAL)
        return dot(l->direction, p->normal) < 0 ? l->power : 0;
    if (l->kind == AG_LIGHT_SUN)
        return -dot(l->direction, p->normal) > -l->radius ? l->power : 0;
    vec3 to = l->position - p->position;
    float distance2 = dot(to, to), reach = l->radius;
    if (l->kind == AG_LIGHT_RECT || l->kind == AG_LIGHT_DISK) {
        reach = sqrtf(dot(l->x, l->x) + dot(l->y, l->y));
        if (dot(to, l->direction) >= 0)
            return 0; // behind it
    }
    if (l->kind == AG_LIGHT_TUBE)
        reach += length_of(l->x);
    if (dot(to, p->normal) < -reach)
        return 0; // below the horizon
    return l->power * light_window(distance2, l->inverse_range2) /
           max(distance2, max(reach * reach, LIGHT_MIN_DISTANCE2));
}

float lights_weight(const trace_lights *l, const lit_place *p)
{
    float total = 0;
    for (size_t i = 0; i < l->count; i++)
        total += weight_at(&l->all[i], p);
    return total;
}

// ---- Drawing a direction ---------------------------------------------------------

static float window_at(const trace_light *l, vec3 to)
{
    return light_window(dot(to, to), l->inverse_range2);
}

static light_sample sample_of(const trace_light *l, vec3 to, vec2 u)
{
    switch (l->kind) {
    case AG_LIGHT_SUN: return light_sample_sun(-l->direction, l->radius, l->cosine, u);
    case AG_LIGHT_SPHERE: return light_sample_sphere(to, l->radius, u);
    case AG_LIGHT_DISK: return light_sample_disk(to, l->x, l->y, u);
    case AG_LIGHT_RECT: return light_sample_rect(to, l->x, l->y, u);
    default: return light_sample_tube(to, l->x, l->radius, u);
    }
}

// Flat lights shine to the side that they face.
static bool shines_along(const trace_light *l, vec3 direction)
{
    bool flat = l->kind == AG_LIGHT_DISK || l->kind == AG_LIGHT_RECT;
    return !flat || dot(direction, l->direction) < 0;
}

static bool sample_body(const trace_light *l, vec3 to, float chance, vec2 u, light_found *found)
{
    light_sample s = sample_of(l, to, u);
    if (!(s.density > 0) || !isfinite(s.density) || !shines_along(l, s.direction))
        return false;
    float window = l->kind == AG_LIGHT_SUN ? 1 : window_at(l, to);
    *found = (light_found) {
        .direction = s.direction,
        .distance = l->kind == AG_LIGHT_SUN ? INFINITY : s.distance,
        .radiance = l->radiance * (window / (chance * s.density)),
        .density = chance * s.density,
    };
    return true;
}

static bool sample_punctual(const trace_light *l, vec3 to, float chance, light_found *found)
{
    *found = (light_found) { .direction = -l->direction, .distance = INFINITY };
    float falloff = 1;
    if (l->kind != AG_LIGHT_DIRECTIONAL) {
        float distance2 = dot(to, to);
        found->distance = sqrtf(distance2);
        found->direction = to / max(found->distance, 1e-10f);
        falloff = light_point(distance2, l->inverse_range2);
        if (l->kind == AG_LIGHT_SPOT)
            falloff *= light_spot(-dot(l->direction, found->direction), l->cone);
    }
    found->radiance = l->intensity * (falloff / chance);
    return falloff > 0;
}

static bool has_body(const trace_light *l)
{
    return greatest(l->radiance) > 0;
}

bool lights_sample(const trace_lights *l, const lit_place *p, float total, float pick, vec2 u,
                   light_found *found)
{
    float left = pick * total, weight = 0;
    const trace_light *chosen = NULL;
    for (size_t i = 0; i < l->count; i++) {
        float w = weight_at(&l->all[i], p);
        if (w > 0) {
            chosen = &l->all[i];
            weight = w;
            if (left < w)
                break;
            left -= w;
        }
    }
    if (!chosen)
        return false;
    vec3 to = chosen->position - p->position;
    float chance = weight / total;
    return has_body(chosen) ? sample_body(chosen, to, chance, u, found)
                            : sample_punctual(chosen, to, chance, found);
}

// ---- Meeting one -----------------------------------------------------------------

// m to the body, and the density of the direction; negative: missed.
static float meet(const trace_light *l, vec3 to, vec3 d, float *density)
{
    float c;
    switch (l->kind) {
    case AG_LIGHT_SUN:
        c = -dot(d, l->direction);
        *density = light_density_sun(l->cosine, l->radius);
        return c > 0 && length_of(cross(d, l->direction)) <= l->radius ? INFINITY : -1;
    case AG_LIGHT_SPHERE:
        *density = light_density_sphere(to, l->radius);
        return light_hit_sphere(to, l->radius, d);
    case AG_LIGHT_DISK:
        *density = light_density_disk(to, l->x, l->y, d);
        return light_hit_disk(to, l->x, l->y, d);
    case AG_LIGHT_RECT:
        *density = light_density_rect(to, l->x, l->y);
        return light_hit_rect(to, l->x, l->y, d);
    case AG_LIGHT_TUBE:
        *density = light_density_tube(to, l->x, l->radius, d);
        return light_hit_tube(to, l->x, l->radius, d);
    default: return -1;
    }
}

void lights_along(const trace_lights *l, const lit_place *p, float total, vec3 direction,
                  float distance, lights_met *met, void *context)
{
    for (size_t i = 0; l->bodies && i < l->count; i++) {
        const trace_light *light = &l->all[i];
        if (!has_body(light) || !shines_along(light, direction))
            continue;
        vec3 to = light->position - p->position;
        float density, at = meet(light, to, direction, &density);
        if (at < 0 || (at >= distance && !isinf(distance)))
            continue;
        float window = light->kind == AG_LIGHT_SUN ? 1 : window_at(light, to);
        float chance = total > 0 ? weight_at(light, p) / total : 0;
        met(context, light->radiance * window, chance * density);
    }
}

bool lights_seen(const trace_lights *l, vec3 eye, vec3 direction, float near, float far, bool suns,
                 vec3 *radiance)
{
    bool found = false, sun = false;
    for (size_t i = 0; l->bodies && i < l->count; i++) {
        const trace_light *light = &l->all[i];
        if (!light->seen || !shines_along(light, direction))
            continue;
        float density, at = meet(light, light->position - eye, direction, &density);
        bool is_sun = light->kind == AG_LIGHT_SUN;
        if (is_sun ? !suns || found || sun || at < 0 : at < near || at > far)
            continue;
        sun |= is_sun;
        found |= !is_sun;
        far = is_sun ? far : at;
        *radiance = light->radiance;
    }
    return found || sun;
}
