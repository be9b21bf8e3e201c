// The representative point: spheres, suns and tubes as Karis 2013 does them, to be compared with.
//
// The light is taken for a point, that of it which is nearest to the mirror ray, and the peak of
// the lobe lowered to what it would be for an alpha that holds the light's radius.  Corrected where
// it is often printed otherwise: alpha is roughness^2 in all terms, the ray is a ray and leaves the
// surface, the light keeps its irradiance, and sinks below the horizon gradually.
//
// Frame, v and the results (x, y) as in light_sphere.glsl; alpha in (0, 1].
#ifndef AG_PHYSICS_LIGHT_REPRESENTATIVE_GLSL
#define AG_PHYSICS_LIGHT_REPRESENTATIVE_GLSL

#include "physics/fresnel.glsl"
#include "physics/lang.glsl"
#include "physics/light_sphere.glsl"
#include "physics/microfacet.glsl"

// From the point p towards the mirror ray, by `reach` at most.  No distance to the light is formed:
// p may be a direction, `reach` the sine of the light's angle.
static inline vec3 light_representative_pull(vec3 p, real reach, vec3 mirror)
{
    vec3 to_ray = max(dot(p, mirror), 0.0f) * mirror - p;
    return p + to_ray * min(reach / sqrt(max(dot(to_ray, to_ray), LIGHT_TINY)), 1.0f);
}

// D V cos, and times (1 - v.h)^5, for light from p, of any length; 0 below the horizon.
static inline vec2 light_representative_lobe(vec3 p, vec3 v, real alpha)
{
    vec3 l = vec3(p[0], p[1], max(p[2], 0.0f)); // gradually
    l = l / sqrt(max(dot(l, l), LIGHT_TINY));
    vec3 h = v + l;
    real a2 = alpha * alpha;
    real lobe = microfacet_d_half(h[0] * h[0] + h[1] * h[1], h[2], a2) *
                microfacet_v(v[2], l[2], a2) * l[2];
    return vec2(lobe, lobe * pow5(1.0f - min(0.5f * sqrt(dot(h, h)), 1.0f)));
}

static inline vec2 light_representative_cap(light_cap cap, vec3 v, real alpha)
{
    vec3 mirror = vec3(-v[0], -v[1], v[2]);
    vec3 p = light_representative_pull(cap.axis, cap.sin_s, mirror);
    real spread = alpha / min(alpha + 0.5f * cap.sin_s, 1.0f);
    return spread * spread * light_representative_lobe(p, v, alpha);
}

// A capsule, times its radiance.  First the point of its axis nearest to the mirror ray's line,
// then that of the sphere around it; its solid angle is that of its outline from the side, and
// along the axis the lobe widens in one direction only.
static inline vec2 light_representative_tube(vec3 centre, vec3 half_axis, real radius, vec3 v,
                                             real alpha)
{
    vec3 mirror = vec3(-v[0], -v[1], v[2]);
    real along = dot(mirror, half_axis);
    real length2 = dot(half_axis, half_axis);
    real t = (dot(mirror, centre) * along - dot(centre, half_axis)) /
             max(length2 - along * along, max(1e-6f * length2, LIGHT_TINY));
    vec3 on_axis = centre + clamp(t, -1.0f, 1.0f) * half_axis;
    vec3 p = light_representative_pull(on_axis, radius, mirror);
    real d2 = max(dot(on_axis, on_axis), max(radius * radius, LIGHT_TINY));
    real d = sqrt(d2);
    vec3 side = cross(half_axis, on_axis) / d;
    real reach = sqrt(dot(side, side));
    real spread = alpha / min(alpha + 0.5f * radius / d, 1.0f);
    spread = spread * spread * alpha / min(alpha + 0.5f * reach / d, 1.0f);
    real solid_angle = radius * (PI * radius + 4.0f * reach) / d2;
    return solid_angle * spread * light_representative_lobe(p, v, alpha);
}

#endif
