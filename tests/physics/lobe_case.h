// The lobes that are sampled, in float and in double.
#ifndef TESTS_PHYSICS_LOBE_CASE_H
#define TESTS_PHYSICS_LOBE_CASE_H

#include "physics/sampling.glsl"

enum { LOBE_GGX, LOBE_BLINN, LOBE_EON, LOBE_COSINE };

typedef struct lobe_case {
    int kind;
    double wo[3];
    double ax, ay;    // GGX; of the others, how wide the half vectors are
    double parameter; // Blinn's shininess, EON's roughness
} lobe_case;

// In double.
double lobe_density_double(const lobe_case *c, const double wi[3]);

static inline vec3 lobe_vec3(const double a[3])
{
    return vec3((real)a[0], (real)a[1], (real)a[2]);
}

static inline real lobe_density(const lobe_case *c, vec3 wi)
{
    vec3 wo = lobe_vec3(c->wo);
    switch (c->kind) {
    case LOBE_GGX: return sampling_ggx_density(wo, wi, (real)c->ax, (real)c->ay);
    case LOBE_BLINN: return sampling_blinn_density(wo, wi, (real)c->parameter);
    case LOBE_EON: return sampling_eon_density(wo, wi, (real)c->parameter);
    default: return INV_PI * max(wi[2], 0.0f);
    }
}

static inline vec3 lobe_sample(const lobe_case *c, vec2 u)
{
    vec3 wo = lobe_vec3(c->wo);
    switch (c->kind) {
    case LOBE_GGX: return reflect(-wo, sampling_ggx(wo, (real)c->ax, (real)c->ay, u));
    case LOBE_BLINN: return sampling_blinn(wo, (real)c->parameter, u);
    case LOBE_EON: return sampling_eon(wo, (real)c->parameter, u);
    default: return sampling_cosine(u);
    }
}

#endif
