// Every function of the physics as a table of cases: itself shared text, so that float C,
// double C and the GPU can be asked the same questions.
#ifndef TESTS_PHYSICS_CASES_GLSL
#define TESTS_PHYSICS_CASES_GLSL

#include "physics/ambient.glsl"
#include "physics/color.glsl"
#include "physics/diffuse.glsl"
#include "physics/environment.glsl"
#include "physics/exposure.glsl"
#include "physics/fresnel.glsl"
#include "physics/light_ltc.glsl"
#include "physics/light_punctual.glsl"
#include "physics/light_representative.glsl"
#include "physics/light_sampling.glsl"
#include "physics/microfacet.glsl"
#include "physics/sampling.glsl"
#include "physics/sh.glsl"
#include "physics/specular_aa.glsl"
#include "physics/surface.glsl"
#include "physics/tonemap.glsl"
#include "physics/white_balance.glsl"

#define CASE_COUNT 63u

// A vector's components told apart.
static inline real case_mark(vec3 v)
{
    return dot(v, vec3(1.0f, 0.5f, 0.25f));
}

// A unit direction of the upper hemisphere, 3 degrees or more above the horizon.
static inline vec3 case_direction(real a, real b)
{
    real z = 0.05f + 0.94f * a;
    real r = sqrt(1.0f - z * z);
    real phi = 6.28f * b;
    return vec3(r * cos(phi), r * sin(phi), z);
}

static inline surface case_surface(vec4 u)
{
    surface_material m;
    m.base_color = vec3(u[0], u[1], u[2]);
    m.metallic = u[3];
    m.roughness = 0.2f + 0.8f * u[0];
    m.dielectric_f0 = 0.02f + 0.1f * u[1];
    m.specular_color = vec3(u[3], u[2], u[1]);
    m.specular = u[2];
    m.model = 0u;
    return surface_from_metallic_roughness(m, 0.5f, vec2(0.3f + 0.5f * u[1], 0.2f * u[3]));
}

static inline real case_white_balance(real kelvin, real tint, vec3 color)
{
    rgb_matrix m = white_balance(kelvin, tint);
    return case_mark(white_balanced(color, m.red, m.green, m.blue));
}

static inline ambient_light case_ambient(vec4 u)
{
    vec3 color = vec3(u[0], u[1], u[2]);
    ambient_light a = ambient_from_hemispheric(color, 0.5f * color, case_direction(u[2], u[3]));
    a.cxy = 0.1f * color;
    a.cyz = 0.2f * color;
    a.czz = 0.3f * color;
    a.cxz = 0.4f * color;
    a.cxxyy = 0.5f * color;
    return a;
}

// A light of each shape by linearly transformed cosines (0, 1, 2) or its representative point (3).
static inline real case_area_light(uint shape, vec4 u, vec3 v)
{
    vec3 to = 0.5f * case_direction(u[3], u[2]) + vec3(-v[0], -v[1], v[2]); // near the mirror ray
    vec3 x = vec3(0.3f, 0.1f * u[0], 0.2f);
    vec3 y = vec3(-0.1f, 0.4f, 0.1f * u[1]);
    vec4 m = light_ltc_matrix(vec4(0.4f + 0.6f * u[0], -0.5f * u[1], u[2], 0.4f + u[3]), 0.5f);
    light_cap cap = light_cap_sphere(2.0f * to, 0.2f + 1.5f * u[1]);
    vec2 result = vec2(0.0f, 0.0f);
    if (shape == 0u)
        result = light_ltc_cap(cap, v, m, vec2(0.6f, 0.2f));
    else if (shape == 1u)
        result = light_ltc_disk(to, y, x, v, m, vec2(0.6f, 0.2f));
    else if (shape == 2u)
        result = light_ltc_tube(to, x, 0.1f, v, m, vec2(0.6f, 0.2f));
    else
        result = light_representative_cap(cap, v, 0.2f + 0.8f * u[0]);
    return result[0] + 2.0f * result[1];
}

// A sample of a light of each shape: its direction (`what` = 0), distance (1) and
// the inverse of its density (2).
static inline real case_light_sample(uint shape, uint what, vec4 u)
{
    vec3 to = 1.5f * case_direction(0.6f + 0.4f * u[3], u[2]);
    vec3 x = vec3(0.5f, 0.1f, 0.2f);
    vec3 y = vec3(-0.1f, 0.5f, 0.0f);
    vec2 at = vec2(0.1f + 0.8f * u[0], 0.1f + 0.8f * u[1]);
    light_sample s = light_sample_sphere(to, 0.5f, at);
    if (shape == 1u)
        s = light_sample_rect(to, x, y, at);
    else if (shape == 2u)
        s = light_sample_disk(to, x, y, at);
    else if (shape == 3u)
        s = light_sample_tube(to, x, 0.2f, at);
    else if (shape == 4u)
        s = light_sample_triangle(to, to + x, to + y, at);
    else if (shape == 5u)
        s = light_sample_sun(to / 1.5f, 0.6f, 0.8f, at);
    if (what == 2u)
        return 1.0f / max(s.density, 0.1f);
    return what == 0u ? case_mark(s.direction) : s.distance;
}

// `id` below CASE_COUNT; the components of u lie in [0, 1).
static inline real physics_case(uint id, vec4 u)
{
    vec3 up = vec3(0.0f, 0.0f, 1.0f);
    vec3 color = vec3(u[0], u[1], u[2]);
    vec3 bright = color * (8.0f * u[3]);
    vec3 wo = case_direction(u[0], u[1]);
    vec3 wi = case_direction(u[2], u[3]);
    vec2 uv = vec2(u[0], u[1]);
    real alpha = 0.05f + 0.9f * u[3];
    vec3 sh[9];
    switch (id) {
    case 0u: return case_mark(fresnel_schlick(color, 0.5f + 0.5f * u[0], u[3]));
    case 1u: return case_mark(fresnel_schlick_mean(color, u[3]));
    case 2u: return fresnel_f0_dielectric(1.0f + 2.0f * u[0]);
    case 3u: return fresnel_f0_conductor(0.1f + 2.0f * u[0], 0.5f + 4.0f * u[1]);
    case 4u: return fresnel_dielectric(u[0], 1.1f + u[1]);
    case 5u: return fresnel_dielectric(0.7f + 0.3f * u[0], 0.8f + 0.1f * u[1]);
    case 6u: return fresnel_conductor(u[2], 0.1f + 2.0f * u[0], 0.5f + 4.0f * u[1]);
    case 7u: return microfacet_d(0.95f * u[0], alpha * alpha);
    case 8u: return microfacet_d_half(0.01f * u[0], 1.0f + u[1], alpha * alpha);
    case 9u: return microfacet_v(0.01f + 0.99f * u[0], 0.01f + 0.99f * u[1], alpha * alpha);
    case 10u: return microfacet_g1(0.01f + 0.99f * u[0], alpha * alpha);
    case 11u: return case_mark(diffuse_lambert(color));
    case 12u: return surface_cosine(wo, wi);
    case 13u: return case_mark(case_surface(u).lambert + case_surface(u).bounced);
    case 14u: return case_mark(case_surface(u).single);
    case 15u: return case_mark(case_surface(u).f0) + case_surface(u).f90 + case_surface(u).a2;
    case 16u: return case_mark(surface_direct(case_surface(u), up, wo, wi));
    case 17u: return case_mark(surface_environment(case_surface(u), color, bright));
    case 18u: return specular_aa_alpha2(u[0], 0.3f * wo, 0.2f * wi);
    case 19u: return specular_aa_alpha2(0.01f * u[0], 0.03f * wo, 0.02f * wi);
    case 20u: return light_point(0.1f + 20.0f * u[0], 0.0f);
    case 21u: return light_point(0.1f + 20.0f * u[0], 0.01f + 0.1f * u[1]);
    case 22u: return light_spot(u[0], light_spot_cone(0.6f + 0.4f * u[1], 0.5f * u[2]));
    case 23u: return sh_basis(to_uint(u[0] * 16.0f) % 9u, wo);
    case 24u:
        for (uint i = 0u; i < 9u; i++)
            sh[i] = color * (1.0f - 0.1f * to_real(i));
        return case_mark(sh_irradiance(sh, wo));
    case 25u: return environment_uv(wo)[0];
    case 26u: return environment_uv(wo)[1];
    case 27u: return case_mark(environment_direction(uv));
    case 28u:
        return case_mark(environment_cube_direction(to_uint(u[0] * 8.0f) % 6u, 2.0f * u[1] - 1.0f,
                                                    2.0f * u[2] - 1.0f));
    case 29u: return environment_mip(u[0], 6.0f);
    case 30u: return environment_roughness(4.9f * u[0], 6.0f);
    case 31u: return case_mark(environment_dominant(up, wo, u[2]));
    case 32u: return environment_specular_occlusion(0.01f + 0.99f * u[0], u[1], u[2]);
    case 33u: return environment_horizon_occlusion(wi, -wo);
    case 34u: return color_luminance(color);
    case 35u: return case_mark(color_srgb_encode(color));
    case 36u: return case_mark(color_srgb_decode(color));
    case 37u: return exposure_from_ev100(20.0f * u[0] - 5.0f);
    case 38u: return case_mark(sampling_cosine(uv));
    case 39u: return case_mark(sampling_visible_normal(wo, alpha, vec2(u[2], u[3])));
    case 40u: return sampling_visible_normal_density(wo, wi, alpha);
    case 41u: return sampling_hammersley(to_uint(u[0] * 4096.0f), 4096u)[0];
    case 42u: return sampling_van_der_corput(to_uint(u[0] * 65536.0f));
    case 43u: return case_mark(tonemap(to_uint(u[3] * 8.0f) % 6u, 4.0f * color));
    case 44u: return case_mark(ambient_hemispheric(color, bright, wo, wi));
    case 45u: return case_mark(ambient_at(case_ambient(u), wo));
    case 46u: return case_area_light(0u, u, wo);
    case 47u: return case_area_light(1u, u, wo);
    case 48u: return case_area_light(2u, u, wo);
    case 49u: return case_area_light(3u, u, wo);
    case 50u: return case_mark(sampling_ggx(wo, alpha, 0.5f * alpha, vec2(u[2], 0.9f * u[3])));
    case 51u: return sampling_ggx_density(wo, wi, alpha, 0.5f * alpha);
    case 52u: return case_mark(sampling_blinn(wo, 1.0f + 50.0f * u[3], vec2(u[2], u[3])));
    case 53u: return sampling_blinn_density(wo, wi, 1.0f + 50.0f * alpha);
    case 54u: return case_mark(sampling_eon(wo, alpha, vec2(0.2f + 0.7f * u[2], u[3])));
    case 55u: return sampling_eon_density(wo, wi, alpha);
    case 56u: return case_light_sample(0u, 0u, u) + case_light_sample(0u, 1u, u);
    case 57u: return case_light_sample(1u, 0u, u) + case_light_sample(1u, 2u, u);
    case 58u: return case_light_sample(2u, 1u, u) + case_light_sample(2u, 2u, u);
    case 59u: return case_light_sample(3u, 1u, u) + case_light_sample(3u, 2u, u);
    case 60u: return case_light_sample(4u, 1u, u) + case_light_sample(4u, 2u, u);
    case 61u: return case_light_sample(5u, 0u, u);
    case 62u: return case_white_balance(2000.0f + 20000.0f * u[3], 60.0f * alpha - 30.0f, color);
    }
    return 0.0f;
}

#endif
