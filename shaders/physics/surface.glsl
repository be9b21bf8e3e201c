// What a surface sends back: the metallic-roughness material of glTF 2.0 with KHR_materials_ior,
// _specular and _anisotropy, by default a GGX lobe over a Lambert base, energy-conserving; and
// the other choices of `model`.
//
// Energy, with E the albedo of the lobe for F = 1 (from the DFG table), towards wo:
// - one bounce on the microfacets reflects     single = f0 dfg[0] + f90 dfg[1];
// - what it loses, 1 - E, bounces on: the series of Fdez-Aguera 2019, eqs. 13-18, after Kulla
//   & Conty 2017.  They let E of it leave after every bounce and reflect the mean of F; here
//   sqrt(E) leaves after each but the first, facets are met more aslant, and the extra light
//   leaves with a distribution that is linear in its direction, each channel with its own: ours,
//   fits to random walks (tests/physics/many_bounces.c).  White metal reflects all;
// - the base receives what the lobe leaves: 1 - (albedo of the whole lobe), as Cycles and
//   other path tracers do.  It depends on wo alone: the sum is not reciprocal, its parts are.
// The furnace closes exactly, as far as the table does.
#ifndef AG_PHYSICS_SURFACE_GLSL
#define AG_PHYSICS_SURFACE_GLSL

#include "physics/diffuse.glsl"
#include "physics/fresnel.glsl"
#include "physics/microfacet.glsl"

// A light without extent shows in a mirror as nothing or as infinity: lobes under light
// sources stay this wide.  Image light knows no such limit.
static const real SURFACE_MIN_ALPHA = 0.002f;

// Cosine of the eye direction, kept from the horizon, where V has its pole.
static const real SURFACE_MIN_NOV = 0.0001f;

// `model`: one of each group, 0 = the default.  The shader knows it when it is compiled, and
// drops what is not asked for.
#define SURFACE_DIFFUSE           0x3u
#define SURFACE_LAMBERT           0x0u
#define SURFACE_OREN_NAYAR        0x1u
#define SURFACE_EON               0x2u
#define SURFACE_DISTRIBUTION      0xcu
#define SURFACE_GGX               0x0u
#define SURFACE_ANISOTROPIC       0x4u
#define SURFACE_BLINN             0x8u
#define SURFACE_SHADOWING         0x10u
#define SURFACE_SMITH             0x0u
#define SURFACE_SCHLICK_GGX       0x10u
#define SURFACE_FRESNEL           0x60u
#define SURFACE_SCHLICK           0x0u
#define SURFACE_CONDUCTOR         0x20u
#define SURFACE_F82               0x40u
#define SURFACE_LAYERING          0x180u
#define SURFACE_LAYERED_BY_ALBEDO 0x0u
#define SURFACE_LAYERED_BY_F      0x80u
#define SURFACE_LAYERED_AS_GLTF   0x100u
#define SURFACE_BLENDED           0x180u
#define SURFACE_SINGLE_BOUNCE     0x200u
#define SURFACE_MODELS            0x400

// What the material says; all factors with their textures.  The fields after `model` are read
// only where it asks for them.
STRUCT(surface_material) {
    vec3 base_color;     // linear Rec. 709
    real metallic;       // 0..1
    real roughness;      // 0..1, perceptual
    real dielectric_f0;  // fresnel_f0_dielectric(ior); .04 for glTF's default of 1.5
    vec3 specular_color; // KHR_materials_specular; 1 by default
    real specular;       // KHR_materials_specular; 1 by default
    uint model;
    real diffuse_roughness; // of EON; sigma of Oren-Nayar, rad
    real shininess;         // Blinn's exponent
    real anisotropy;        // KHR_materials_anisotropy, strength
    vec3 tangent;           // unit, across the normal, the rougher direction
    vec3 conductor_n;
    vec3 conductor_k;
    vec3 f82_tint;
    real reflectiveness; // of SURFACE_BLENDED
};

// What lights need to know, seen from one direction.
STRUCT(surface) {
    vec3 lambert; // albedo of the base, if it leaves with Lambert's distribution
    vec3 single;  // albedo of the lobe, first bounce
    vec3 bounced; // the same, all others
    vec3 upwards; // how their light leans
    vec3 forwards;
    vec3 f0;
    real f90;
    real a2; // alpha^2; anisotropic: along the tangent
    uint model;
    real a2_across;
    vec3 tangent;
    real schlick_k; // of SURFACE_SCHLICK_GGX, under lights
    real shininess;
    vec3 base; // colour of a base that is not in `lambert`
    real base_weight;
    vec3 base_albedo; // of the sky's light, weight and Fresnel included
    real diffuse_roughness;
    real under_f0; // of SURFACE_LAYERED_AS_GLTF
    real under_f90;
    vec3 dip; // of SURFACE_F82
    real conductor; // weight of the conductor; f0 and f90 are without it
    vec3 conductor_n;
    vec3 conductor_k;
};

static inline real surface_cosine(vec3 n, vec3 wo)
{
    return clamp(dot(n, wo), SURFACE_MIN_NOV, 1.0f);
}

// ---- Fresnel -----------------------------------------------------------------

// Beyond Schlick's.
static inline vec3 surface_fresnel_more(surface s, real c)
{
    if ((s.model & SURFACE_FRESNEL) == SURFACE_F82)
        return -fresnel_dip(c) * s.dip;
    return s.conductor * fresnel_conductor_rgb(c, s.conductor_n, s.conductor_k);
}

static inline vec3 surface_fresnel(surface s, real c)
{
    vec3 f = fresnel_schlick(s.f0, s.f90, c);
    if ((s.model & SURFACE_FRESNEL) != SURFACE_SCHLICK)
        f = f + surface_fresnel_more(s, c);
    return f;
}

// A lobe with Fresnel, from its integrals: `plain` with the factor 1 - w, `grazing` with w =
// (1 - v.h)^5.  Schlick's form is linear in them; the others are taken at the cosine whose w is
// the mean one, grazing / (plain + grazing).
static inline vec3 surface_lobe(surface s, real plain, real grazing)
{
    vec3 f = s.f0 * plain + vec3(s.f90, s.f90, s.f90) * grazing;
    if ((s.model & SURFACE_FRESNEL) != SURFACE_SCHLICK) {
        real all = plain + grazing;
        real w = clamp(grazing / max(all, 1e-30f), 0.0f, 1.0f);
        f = f + all * surface_fresnel_more(s, 1.0f - pow(max(w, 1e-12f), 0.2f));
    }
    return f;
}

// The mean of (1 - v.h)^5 after the first bounce: light that was caught is low and meets facets
// aslant, least so what leaves upwards; over the hemisphere it is 1/21.  A fit to random walks.
static inline real surface_aslant(real f0, real NoV, real alpha)
{
    real smooth_by = 1.0f - alpha;
    real s3 = smooth_by * smooth_by * smooth_by;
    return (0.1f + smooth_by * (0.24f + 0.58f * s3)) * (1.0f - 0.55f * NoV * (1.0f + f0));
}

// Of facets at `grazing`, the mean of (1 - v.h)^5.
static inline vec3 surface_fresnel_again(surface s, vec3 grazing)
{
    vec3 f = s.f0 + grazing * (vec3(s.f90, s.f90, s.f90) - s.f0);
    if ((s.model & SURFACE_FRESNEL) == SURFACE_F82)
        f = f - s.dip / 126.0f;
    if ((s.model & SURFACE_FRESNEL) == SURFACE_CONDUCTOR)
        f = f + s.conductor * fresnel_conductor_mean(s.conductor_n, s.conductor_k);
    return f;
}

// ---- Base --------------------------------------------------------------------

// Whether the base depends on the light's direction otherwise than Lambert's.
static inline bool surface_has_base(uint model)
{
    uint layering = model & SURFACE_LAYERING;
    return (model & SURFACE_DIFFUSE) != SURFACE_LAMBERT ||
           ((model & SURFACE_DISTRIBUTION) != SURFACE_BLINN &&
            (layering == SURFACE_LAYERED_BY_F || layering == SURFACE_LAYERED_AS_GLTF));
}

// What passes the boundary whose half vector is at VoH.
static inline vec3 surface_passed(surface s, real VoH)
{
    vec3 one = vec3(1.0f, 1.0f, 1.0f);
    uint layering = s.model & SURFACE_LAYERING;
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        return one;
    if (layering == SURFACE_LAYERED_BY_F)
        return one - surface_fresnel(s, VoH);
    if (layering == SURFACE_LAYERED_AS_GLTF)
        return one - fresnel_schlick(vec3(s.under_f0, s.under_f0, s.under_f0), s.under_f90, VoH);
    return one;
}

// The BRDF of further bounces times pi, of their albedo: 1 on average over the hemisphere.  Linear
// in the light's direction, and so right for lights of extent by their mean direction.
static inline vec3 surface_bounced_shape(surface s, real NoV, real NoL, real LoV)
{
    return 1.0f + (NoL - 2.0f / 3.0f) * s.upwards - (LoV - NoL * NoV) * s.forwards;
}

// The BRDF of all that is not the first bounce of the lobe, 1/sr.
static inline vec3 surface_base(surface s, real NoV, real NoL, real LoV, real VoH)
{
    vec3 f = diffuse_lambert(s.lambert + surface_bounced_shape(s, NoV, NoL, LoV) * s.bounced);
    if (surface_has_base(s.model)) {
        uint diffuse = s.model & SURFACE_DIFFUSE;
        vec3 base = diffuse_lambert(s.base);
        if (diffuse == SURFACE_OREN_NAYAR)
            base = diffuse_oren_nayar(s.base, s.diffuse_roughness, NoL, NoV, LoV);
        else if (diffuse == SURFACE_EON)
            base = diffuse_eon(s.base, s.diffuse_roughness, NoL, NoV, LoV);
        f = f + s.base_weight * surface_passed(s, VoH) * base;
    }
    return f;
}

static inline vec3 surface_base_albedo(surface s, real NoV)
{
    uint diffuse = s.model & SURFACE_DIFFUSE;
    vec3 albedo = s.base;
    if (diffuse == SURFACE_OREN_NAYAR)
        albedo = s.base * diffuse_oren_nayar_albedo(s.diffuse_roughness, NoV);
    else if (diffuse == SURFACE_EON)
        albedo = diffuse_eon_albedo(s.base, s.diffuse_roughness, NoV);
    return s.base_weight * surface_passed(s, NoV) * albedo;
}

// ---- From material to surface ------------------------------------------------

static inline surface surface_choose_fresnel(surface s, surface_material m, vec3 f0)
{
    s.dip = vec3(0.0f, 0.0f, 0.0f);
    s.conductor = 0.0f;
    if ((m.model & SURFACE_FRESNEL) == SURFACE_F82)
        s.dip = m.metallic * fresnel_f82(m.base_color, m.f82_tint);
    if ((m.model & SURFACE_FRESNEL) == SURFACE_CONDUCTOR) {
        s.conductor = m.metallic;
        s.f0 = f0 * (1.0f - m.metallic);
        s.f90 = m.specular * (1.0f - m.metallic);
    }
    s.conductor_n = m.conductor_n;
    s.conductor_k = m.conductor_k;
    return s;
}

static inline surface surface_choose_distribution(surface s, surface_material m)
{
    if ((m.model & SURFACE_DISTRIBUTION) == SURFACE_ANISOTROPIC) {
        real alpha = max(m.roughness * m.roughness, SURFACE_MIN_ALPHA);
        vec2 alphas = microfacet_alphas(alpha, m.anisotropy);
        s.a2 = alphas[0] * alphas[0];
        s.a2_across = alphas[1] * alphas[1];
    }
    if ((m.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN) {
        real alpha = microfacet_blinn_alpha(m.shininess);
        s.a2 = alpha * alpha;
        s.f0 = m.specular * m.specular_color;
    }
    s.tangent = m.tangent;
    s.shininess = m.shininess;
    s.schlick_k = microfacet_schlick_k(m.roughness);
    return s;
}

// The table is Smith's: its integrand's other shadowing, at the mirror direction.
static inline vec2 surface_choose_dfg(surface s, surface_material m, real NoV, vec2 dfg)
{
    if ((m.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        return vec2(0.0f, 0.0f);
    real k = 0.5f * m.roughness * m.roughness;
    if ((m.model & SURFACE_SHADOWING) == SURFACE_SCHLICK_GGX)
        return dfg * min(microfacet_v_schlick(NoV, NoV, k) / microfacet_v(NoV, NoV, s.a2),
                         1.0f / (dfg[0] + dfg[1]));
    return dfg;
}

// All bounces but the first, a share of the first; `lost` is 1 - E.
static inline real surface_bounced(real mean, real lost)
{
    real leaving = sqrt(max(1.0f - lost, 1e-4f));
    return mean * lost / (leaving * (1.0f - mean * (1.0f - leaving)));
}

// What of the base is seen, by the lobe's albedo: by the greatest of its channels, so that a
// coloured lobe does not give the base the opposite colour (KHR_materials_specular).
static inline real surface_left_by(vec3 f0, real f90, vec2 dfg, real lost, real NoV, real alpha)
{
    real f = max(max(f0[0], f0[1]), f0[2]);
    real mean = mix(f, f90, surface_aslant(f, NoV, alpha));
    return 1.0f - (f * dfg[0] + f90 * dfg[1]) * (1.0f + surface_bounced(mean, lost));
}

// The first moments of the light that leaves after further bounces, upwards and forwards: the
// smoother the surface and the greater the share of Fresnel's rise in what its facets reflect,
// `grazed`, the more goes on low and forwards; the rest is round and a little upright.  Fits to
// random walks, held where the distribution would be negative.
static inline vec2 surface_lean(real alpha, real NoV, real grazed)
{
    real smooth_by = 1.0f - alpha;
    real s3 = smooth_by * smooth_by * smooth_by;
    real up = max(1.75f * sqrt(NoV) - 0.78f - 2.8f * (s3 + grazed), -2.0f);
    real most = min(1.0f - max(2.0f / 3.0f * up, 0.5f * up), 1.2f);
    return vec2(up, min(2.1f * s3 + 2.5f * smooth_by * grazed, most));
}

static inline surface surface_bounce(surface s, real lost, real NoV, real alpha)
{
    vec3 grazing = vec3(surface_aslant(s.f0[0], NoV, alpha), surface_aslant(s.f0[1], NoV, alpha),
                        surface_aslant(s.f0[2], NoV, alpha));
    vec3 mean = surface_fresnel_again(s, grazing);
    s.bounced = s.single * vec3(surface_bounced(mean[0], lost), surface_bounced(mean[1], lost),
                                surface_bounced(mean[2], lost));
    vec3 grazed = grazing * (vec3(s.f90, s.f90, s.f90) - s.f0) / max(mean, 1e-6f);
    vec2 r = surface_lean(alpha, NoV, grazed[0]);
    vec2 g = surface_lean(alpha, NoV, grazed[1]);
    vec2 b = surface_lean(alpha, NoV, grazed[2]);
    s.upwards = vec3(r[0], g[0], b[0]);
    s.forwards = vec3(r[1], g[1], b[1]);
    return s;
}

// The base where it is not part of `lambert`.
static inline surface surface_put_base(surface s, surface_material m, vec3 f0, real NoV,
                                       real weight)
{
    s.base = m.base_color;
    s.base_weight = weight;
    s.diffuse_roughness = m.diffuse_roughness;
    s.under_f0 = max(max(f0[0], f0[1]), f0[2]);
    s.under_f90 = m.specular;
    s.base_albedo = vec3(0.0f, 0.0f, 0.0f);
    if (surface_has_base(m.model))
        s.base_albedo = surface_base_albedo(s, NoV);
    return s;
}

static inline surface surface_blend(surface s, real reflectiveness)
{
    s.f0 = reflectiveness * s.f0;
    s.f90 = reflectiveness * s.f90;
    s.dip = reflectiveness * s.dip;
    s.conductor = reflectiveness * s.conductor;
    s.single = reflectiveness * s.single;
    s.bounced = reflectiveness * s.bounced;
    return s;
}

// Dielectric and metal are mixed as glTF mixes them, weight by weight: linear in f0 and
// f90, so one lobe serves both.  `dfg` is the table at (NoV, roughness), NoV being
// surface_cosine(n, wo); of an anisotropic lobe it is surface_sky() of surface_light.glsl.
static inline surface surface_from_metallic_roughness(surface_material m, real NoV, vec2 dfg)
{
    surface s;
    s.model = m.model;
    // KHR_materials_specular: dielectric_f0 and f90.
    vec3 f0 = min(m.dielectric_f0 * m.specular_color, 1.0f) * m.specular;
    s.f0 = mix(f0, m.base_color, m.metallic);
    s.f90 = mix(m.specular, 1.0f, m.metallic);
    real alpha = max(m.roughness * m.roughness, SURFACE_MIN_ALPHA);
    s.a2 = alpha * alpha;
    s.a2_across = s.a2;
    s = surface_choose_fresnel(s, m, f0);
    s = surface_choose_distribution(s, m);
    dfg = surface_choose_dfg(s, m, NoV, dfg);

    real lost = max(1.0f - dfg[0] - dfg[1], 0.0f); // the table may have a little too much
    if ((m.model & SURFACE_SINGLE_BOUNCE) != 0u ||
        (m.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        lost = 0.0f;
    s.single = surface_lobe(s, dfg[0], dfg[1]);
    s = surface_bounce(s, lost, NoV, alpha);

    uint layering = m.model & SURFACE_LAYERING;
    real weight = 1.0f - m.metallic;
    if (layering == SURFACE_LAYERED_BY_ALBEDO)
        weight = weight * surface_left_by(f0, m.specular, dfg, lost, NoV, alpha);
    if (layering == SURFACE_BLENDED) {
        weight = 1.0f - m.reflectiveness;
        s = surface_blend(s, m.reflectiveness);
    }
    s = surface_put_base(s, m, f0, NoV, weight);
    s.lambert = surface_has_base(m.model) ? vec3(0.0f, 0.0f, 0.0f) : m.base_color * weight;
    return s;
}

// ---- Light -------------------------------------------------------------------

// The lobe without Fresnel, of the half vector h = wo + wi as it comes: D V.
static inline real surface_dv(surface s, vec3 n, vec3 wo, vec3 wi, vec3 h, real NoV, real NoL)
{
    vec3 t = cross(n, h);
    real d = microfacet_d_half(dot(t, t), NoL + NoV, s.a2);
    real v = microfacet_v(NoV, NoL, s.a2);
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_ANISOTROPIC) {
        vec3 b = cross(n, s.tangent);
        vec3 local_v = vec3(dot(s.tangent, wo), dot(b, wo), NoV);
        vec3 local_l = vec3(dot(s.tangent, wi), dot(b, wi), NoL);
        real ax = sqrt(s.a2);
        real ay = sqrt(s.a2_across);
        d = microfacet_d_anisotropic(local_v + local_l, ax, ay);
        v = microfacet_v_anisotropic(local_v, local_l, ax, ay);
    }
    if ((s.model & SURFACE_SHADOWING) == SURFACE_SCHLICK_GGX)
        v = microfacet_v_schlick(NoV, NoL, s.schlick_k);
    return d * v;
}

// BRDF times the cosine of wi, 1/sr, taken apart.
STRUCT(surface_parts) {
    vec3 base;
    vec3 lobe;
};

static inline surface_parts surface_direct_parts(surface s, vec3 n, vec3 wo, vec3 wi)
{
    surface_parts f;
    real NoV = surface_cosine(n, wo);
    real NoL = clamp(dot(n, wi), 0.0f, 1.0f);
    vec3 h = wo + wi;
    // wo.h = |wo + wi| / 2 for unit wo and wi.
    real VoH = min(0.5f * sqrt(dot(h, h)), 1.0f);
    f.base = NoL * surface_base(s, NoV, NoL, dot(wo, wi), VoH);
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        f.lobe = s.f0 * microfacet_blinn(0.5f * dot(n, h) / max(VoH, 1e-6f), s.shininess);
    else
        f.lobe = NoL * surface_dv(s, n, wo, wi, h, NoV, NoL) * surface_fresnel(s, VoH);
    return f;
}

// Times the irradiance that a light without extent gives to a surface facing it, this is the
// radiance towards wo.
static inline vec3 surface_direct(surface s, vec3 n, vec3 wo, vec3 wi)
{
    surface_parts f = surface_direct_parts(s, n, wo, wi);
    return f.base + f.lobe;
}

// What it reflects of diffuse light from everywhere.
static inline vec3 surface_albedo(surface s)
{
    vec3 albedo = s.lambert + s.bounced;
    return surface_has_base(s.model) ? albedo + s.base_albedo : albedo;
}

// Radiance towards wo under image light.  `irradiance` is divided by pi; `prefiltered` is
// the environment under the lobe around the reflected direction.
static inline vec3 surface_environment(surface s, vec3 irradiance, vec3 prefiltered)
{
    return surface_albedo(s) * irradiance + s.single * prefiltered;
}

#endif
