// A surface seen from one direction, as a path needs it: what it sends there of a direction's
// light, and directions drawn by that.
#ifndef AG_TRACE_BSDF_H
#define AG_TRACE_BSDF_H

#include "physics/sampling.glsl"
#include "physics/surface_light.glsl"
#include "trace/albedo.h"
#include "trace/place.h"

typedef struct bsdf {
    surface s;
    surface_frame frame; // x along the tangent of an anisotropic lobe
    vec3 wo;
    float lobe_share; // of the directions that are drawn from the lobe
    float sky_k;      // of Schlick's shadowing under image light: Karis 2013, eq. 4
} bsdf;

// BRDF times cosine, 1/sr, and the density of the direction, 1/sr.
typedef struct scattered {
    surface_parts f;
    float density;
} scattered;

static inline bsdf bsdf_at(const albedo_table *table, const place *p, vec3 wo)
{
    bsdf b = { .wo = wo };
    uint32_t distribution = p->material.model & SURFACE_DISTRIBUTION;
    float NoV = surface_cosine(p->normal, wo);
    vec2 dfg = distribution == SURFACE_ANISOTROPIC ? surface_sky(p->material, p->normal, wo)
                                                   : albedo_read(table, NoV, p->material.roughness);
    b.s = surface_from_metallic_roughness(p->material, NoV, dfg);
    b.frame = surface_frame_from(b.s, p->normal, wo);
    b.sky_k = 0.5f * p->material.roughness * p->material.roughness;
    vec3 base = surface_albedo(b.s), lobe = b.s.single;
    float of_lobe = lobe[0] + lobe[1] + lobe[2], of_base = base[0] + base[1] + base[2];
    if (distribution == SURFACE_BLINN)
        of_lobe = b.s.f0[0] + b.s.f0[1] + b.s.f0[2];
    b.lobe_share = of_lobe > 0 ? of_lobe / (of_lobe + of_base) : 0;
    return b;
}

static inline scattered bsdf_evaluate(const bsdf *b, vec3 wi)
{
    float NoL = dot(b->frame.n, wi), of_lobe;
    scattered r = { .density = 0 };
    if (!(NoL > 0))
        return r;
    r.f = surface_direct_parts(b->s, b->frame.n, b->wo, wi);
    vec3 local = surface_frame_in(b->frame, wi);
    if ((b->s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        of_lobe = sampling_blinn_density(b->frame.v, local, b->s.shininess);
    else
        of_lobe = sampling_ggx_density(b->frame.v, local, b->frame.ax, b->frame.ay);
    r.density = mix(NoL * INV_PI, of_lobe, b->lobe_share);
    return r;
}

// Whether the sky's light is reflected otherwise than other light.
static inline bool bsdf_minds_sky(const bsdf *b)
{
    return (b->s.model & SURFACE_SHADOWING) == SURFACE_SCHLICK_GGX;
}

// bsdf_evaluate() of the sky's light.
static inline scattered bsdf_evaluate_sky(const bsdf *b, vec3 wi)
{
    if (!bsdf_minds_sky(b))
        return bsdf_evaluate(b, wi);
    bsdf under = *b;
    under.s.schlick_k = b->sky_k;
    return bsdf_evaluate(&under, wi);
}

// `pick` chooses lobe or base, `u` the direction; false: into the surface.
static inline bool bsdf_sample(const bsdf *b, float pick, vec2 u, vec3 *wi)
{
    const surface_frame *f = &b->frame;
    vec3 d;
    if (pick >= b->lobe_share)
        d = sampling_cosine(u);
    else if ((b->s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        d = sampling_blinn(f->v, b->s.shininess, u);
    else
        d = reflect(-f->v, sampling_ggx(f->v, f->ax, f->ay, u));
    *wi = normalize(d[0] * f->x + d[1] * f->y + d[2] * f->n);
    return dot(*wi, f->n) > 0;
}

#endif
