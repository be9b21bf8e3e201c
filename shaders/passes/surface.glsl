// Surfaces: what the material says of the place `here`, and the light that it sends to the eye.
// LISTED: the place comes from a list, not from a rasteriser, and brings its derivatives along.
#include "physics/display.glsl"
#include "physics/environment.glsl"
#include "physics/sh.glsl"
#include "physics/specular_aa.glsl"
#include "physics/surface.glsl"
#include "passes/frame.glsl"

// gpu_surface_constants
layout(constant_id = 0) const uint TEXTURES = 0u;
layout(constant_id = 1) const uint GENERAL_UV = 0u;
layout(constant_id = 2) const uint ALPHA_MODE = 0u;
layout(constant_id = 3) const uint UNLIT = 0u;
layout(constant_id = 4) const uint ENVIRONMENT = 1u;
layout(constant_id = 6) const uint TONE = 0u;
layout(constant_id = 12) const uint MODEL = 0u;

layout(scalar, set = 1, binding = 0) uniform Material { gpu_material material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
layout(set = 1, binding = 2) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 3) uniform sampler2D normal_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;
layout(set = 1, binding = 6) uniform sampler2D specular_texture;
layout(set = 1, binding = 7) uniform sampler2D specular_color_texture;

// A place that is shaded, as a pixel sees it.
struct place {
    vec3 position; // world space
    vec3 normal;   // not normalised
    vec4 tangent;  // not normalised; w = handedness
    vec4 uvs;
    vec4 color;
    bool front; // its front is seen
    vec2 pixel; // from the upper left corner of what is drawn
#ifdef LISTED // change to the next pixel
    vec3 normal_dx, normal_dy;
    vec4 uvs_dx, uvs_dy;
#endif
};
place here; // given by who includes this

#include "passes/lights.glsl"

// Of texture t; `one` is 1, or 0 for differences of coordinates.
vec2 uv_of(uint t, vec4 uvs, float one)
{
    if (GENERAL_UV == 0u)
        return uvs.xy;
    vec3 uv = vec3((material.uv1 >> t & 1u) != 0u ? uvs.zw : uvs.xy, one);
    return vec2(dot(material.uv_u[t], uv), dot(material.uv_v[t], uv));
}

bool has(int t)
{
    return (TEXTURES >> t & 1u) != 0u;
}

#ifdef LISTED
#define SAMPLE_AT(map, t, uvs)                                                                   \
    textureGrad(map, uv_of(uint(t), uvs, 1.0), uv_of(uint(t), here.uvs_dx, 0.0),                 \
                uv_of(uint(t), here.uvs_dy, 0.0))
#else
#define SAMPLE_AT(map, t, uvs) texture(map, uv_of(uint(t), uvs, 1.0))
#endif
#define SAMPLE(map, t, otherwise) (has(t) ? SAMPLE_AT(map, t, here.uvs) : (otherwise))

// A normal map's x and y, from the directions of its own uv to those of the tangents, which
// follow the mesh's uv: a transform of the texture turns the one against the other.
vec2 turned(vec2 m)
{
    if (GENERAL_UV == 0u)
        return m;
    vec2 u = material.uv_u[GPU_TEXTURE_NORMAL].xy, v = material.uv_v[GPU_TEXTURE_NORMAL].xy;
    float uu = dot(u, u), vv = dot(v, v);
    if (min(uu, vv) == 0.0) // a transform that flattens the texture has no directions
        return m;
    u *= inversesqrt(uu);
    v *= inversesqrt(vv);
    return vec2(m.x * u.x - m.y * v.x, m.y * v.y - m.x * u.y);
}

vec3 shading_normal(vec3 n, vec4 uvs)
{
    if (has(GPU_TEXTURE_NORMAL)) {
        vec2 xy = SAMPLE_AT(normal_texture, GPU_TEXTURE_NORMAL, uvs).xy * 2.0 - 1.0;
        vec3 m = vec3(turned(xy) * material.normal_scale, sqrt(max(1.0 - dot(xy, xy), 0.0)));
        // As MikkTSpace bakes: the interpolated vectors are not normalised first.
        vec3 bitangent = here.tangent.w * cross(n, here.tangent.xyz);
        n = m.x * here.tangent.xyz + m.y * bitangent + m.z * n;
    }
    n = normalize(n);
    return here.front ? n : -n;
}

// How the normal changes to the next pixel.
vec3 normal_change_x(vec3 n)
{
#ifdef LISTED
    return shading_normal(here.normal + here.normal_dx, here.uvs + here.uvs_dx) - n;
#else
    return dFdx(n);
#endif
}

vec3 normal_change_y(vec3 n)
{
#ifdef LISTED
    return shading_normal(here.normal + here.normal_dy, here.uvs + here.uvs_dy) - n;
#else
    return dFdy(n);
#endif
}

const bool ANISOTROPIC = (MODEL & SURFACE_DISTRIBUTION) == SURFACE_ANISOTROPIC;

// The rougher direction of an anisotropic surface, across n.
vec3 tangent_here(vec3 n)
{
    if (!ANISOTROPIC)
        return vec3(0.0);
    vec3 bitangent = here.tangent.w * cross(here.normal, here.tangent.xyz);
    vec3 t = material.anisotropy_direction.x * here.tangent.xyz +
             material.anisotropy_direction.y * bitangent;
    t -= dot(t, n) * n;
    if (dot(t, t) < 1e-12)
        t = cross(n, abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    return normalize(t);
}

surface_material material_here(vec3 base_color, vec3 n)
{
    vec4 white = vec4(1.0);
    vec4 metallic_roughness =
        SAMPLE(metallic_roughness_texture, GPU_TEXTURE_METALLIC_ROUGHNESS, white);
    surface_material m;
    m.base_color = base_color;
    m.metallic = material.metallic * metallic_roughness.b;
    m.roughness = material.roughness * metallic_roughness.g;
    m.dielectric_f0 = material.dielectric_f0;
    m.specular_color = material.specular_color *
                       SAMPLE(specular_color_texture, GPU_TEXTURE_SPECULAR_COLOR, white).rgb;
    m.specular = material.specular * SAMPLE(specular_texture, GPU_TEXTURE_SPECULAR, white).a;
    m.model = MODEL;
    m.diffuse_roughness = material.diffuse_roughness;
    m.shininess = material.shininess;
    m.anisotropy = material.anisotropy;
    m.tangent = tangent_here(n);
    m.conductor_n = material.conductor_n;
    m.conductor_k = material.conductor_k;
    m.f82_tint = material.f82_tint;
    m.reflectiveness = material.reflectiveness;
    return m;
}

float occlusion_here()
{
    float r = SAMPLE(occlusion_texture, GPU_TEXTURE_OCCLUSION, vec4(1.0)).r;
    return 1.0 + material.occlusion_strength * (r - 1.0);
}

vec3 lit_by_environment(surface s, vec3 n, vec3 wo, float roughness, float ao)
{
    vec3 bent = n;
    if (ANISOTROPIC)
        bent = environment_bent_normal(n, wo, s.tangent, material.anisotropy, roughness);
    vec3 r = reflect(-wo, bent);
    float NoV = surface_cosine(n, wo);
    float open = ao;
    if (has(GPU_TEXTURE_OCCLUSION))
        open = environment_specular_occlusion(NoV, ao, roughness * roughness);
    if (has(GPU_TEXTURE_NORMAL))
        open *= environment_horizon_occlusion(
            r, here.front ? normalize(here.normal) : -normalize(here.normal));
    vec3 lobe = environment_dominant(n, r, roughness * roughness);
    vec3 prefiltered = textureLod(environment_cube, environment_from_world(lobe),
                                  environment_mip(roughness, frame.environment_mips))
                           .rgb;
    vec3 irradiance = ENVIRONMENT == GPU_ENVIRONMENT_HARMONICS
                          ? sh_irradiance(frame.sh, environment_from_world(n))
                          : textureLod(irradiance_cube, environment_from_world(n), 0.0).rgb;
    return surface_environment(s, (frame.environment_base * ao) * irradiance,
                               (frame.environment_lobe * open) * prefiltered);
}

vec3 radiance_to_eye(vec3 base_color)
{
    vec3 n = shading_normal(here.normal, here.uvs);
    vec3 wo = frame.orthographic != 0.0 ? -frame.ray_center : normalize(frame.eye - here.position);
    surface_material m = material_here(base_color, n);
    float NoV = surface_cosine(n, wo);
    vec2 dfg = ANISOTROPIC ? surface_sky(m, n, wo)
                           : textureLod(dfg_table, vec2(NoV, m.roughness), 0.0).rg;
    surface s = surface_from_metallic_roughness(m, NoV, dfg);
    // Only lights without extent sparkle.  Image light is filtered already, and wider lobes
    // would bring light to silhouettes that is not there: 2.5 times the error on spheres.
    vec3 turn_x = frame.footprint * normal_change_x(n),
         turn_y = frame.footprint * normal_change_y(n);
    s.a2 = specular_aa_alpha2(s.a2, turn_x, turn_y);
    s.a2_across = specular_aa_alpha2(s.a2_across, turn_x, turn_y);

    vec3 light = frame.seen * material.emissive *
                 SAMPLE(emissive_texture, GPU_TEXTURE_EMISSIVE, vec4(1.0)).rgb;
    float ao = occlusion_here();
    if (ENVIRONMENT != GPU_ENVIRONMENT_NONE)
        light += lit_by_environment(s, n, wo, m.roughness, ao);
    if (AMBIENT != 0u)
        light += surface_albedo(s) * (ao * ambient_here(n));
    light += lit_by_lights(s, n, wo, dfg);
    return light;
}

vec4 base_here()
{
    return material.base_color * here.color *
           SAMPLE(base_color_texture, GPU_TEXTURE_BASE_COLOR, vec4(1.0));
}

// What is drawn, premultiplied.
vec4 color_here(vec4 base)
{
    vec3 color = UNLIT != 0u ? frame.seen * base.rgb : radiance_to_eye(base.rgb);
    color = exposed(color);
    if (TONE != GPU_TONE_LINEAR)
        color = display(TONE, color);
    float alpha = ALPHA_MODE == GPU_ALPHA_BLEND ? base.a : 1.0;
    return vec4(min(color, 60000.0) * alpha, alpha);
}
