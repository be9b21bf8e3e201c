// The metallic-roughness surface of glTF 2.0 with KHR_materials_ior and _specular:
// a GGX lobe over a Lambert base, energy-conserving.
//
// Energy, with E the albedo of the lobe for F = 1 (from the DFG table), towards wo:
// - one bounce on the microfacets reflects     single = f0 dfg[0] + f90 dfg[1];
// - what it loses, 1 - E, bounces on.  The series of bounces sums to
//   single / (1 - F_mean (1 - E)); Fdez-Aguera 2019, eqs. 13-18, after Kulla & Conty 2017.
//   White metal reflects all.  The extra light leaves with Lambert's distribution;
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

// What the material says; all factors with their textures.
STRUCT(surface_material) {
    vec3 base_color;     // linear Rec. 709
    real metallic;       // 0..1
    real roughness;      // 0..1, perceptual
    real dielectric_f0;  // fresnel_f0_dielectric(ior); .04 for glTF's default of 1.5
    vec3 specular_color; // KHR_materials_specular; 1 by default
    real specular;       // KHR_materials_specular; 1 by default
};

// What lights need to know, seen from one direction.
STRUCT(surface) {
    vec3 lambert; // albedo of all that leaves with Lambert's distribution
    vec3 single;  // albedo of the lobe, first bounce
    vec3 f0;
    real f90;
    real a2; // alpha^2
};

static inline real surface_cosine(vec3 n, vec3 wo)
{
    return clamp(dot(n, wo), SURFACE_MIN_NOV, 1.0f);
}

// Dielectric and metal are mixed as glTF mixes them, weight by weight: linear in f0 and
// f90, so one lobe serves both.  `dfg` is the table at (surface_cosine(n, wo), roughness).
static inline surface surface_from_metallic_roughness(surface_material m, vec2 dfg)
{
    surface s;
    // KHR_materials_specular: dielectric_f0 and f90.
    vec3 f0 = min(m.dielectric_f0 * m.specular_color, 1.0f) * m.specular;
    s.f0 = mix(f0, m.base_color, m.metallic);
    s.f90 = mix(m.specular, 1.0f, m.metallic);
    real alpha = max(m.roughness * m.roughness, SURFACE_MIN_ALPHA);
    s.a2 = alpha * alpha;

    real lost = 1.0f - dfg[0] - dfg[1];
    vec3 bounced = fresnel_schlick_mean(s.f0, s.f90) * lost;
    s.single = s.f0 * dfg[0] + s.f90 * dfg[1];

    // The base under the dielectric's lobe, by the greatest of its channels, so that a
    // coloured lobe does not give the base the opposite colour (KHR_materials_specular).
    real f = max(max(f0[0], f0[1]), f0[2]);
    real mean = f * (20.0f / 21.0f) + m.specular * (1.0f / 21.0f);
    real albedo = (f * dfg[0] + m.specular * dfg[1]) / (1.0f - mean * lost);

    s.lambert = m.base_color * ((1.0f - m.metallic) * (1.0f - albedo)) +
                s.single * bounced / (1.0f - bounced);
    return s;
}

// BRDF times the cosine of wi, 1/sr: times the irradiance that a light without extent
// gives to a surface facing it, this is the radiance towards wo.
static inline vec3 surface_direct(surface s, vec3 n, vec3 wo, vec3 wi)
{
    real NoV = surface_cosine(n, wo);
    real NoL = clamp(dot(n, wi), 0.0f, 1.0f);
    vec3 h = wo + wi;
    vec3 t = cross(n, h);
    real across = dot(t, t);
    real along = NoL + NoV;
    // wo.h = |wo + wi| / 2 for unit wo and wi.
    real VoH = min(0.5f * sqrt(dot(h, h)), 1.0f);
    real dv = microfacet_d_half(across, along, s.a2) * microfacet_v(NoV, NoL, s.a2);
    return NoL * (diffuse_lambert(s.lambert) + dv * fresnel_schlick(s.f0, s.f90, VoH));
}

// Radiance towards wo under image light.  `irradiance` is divided by pi; `prefiltered` is
// the environment under the lobe around the reflected direction.
static inline vec3 surface_environment(surface s, vec3 irradiance, vec3 prefiltered)
{
    return s.lambert * irradiance + s.single * prefiltered;
}

#endif
