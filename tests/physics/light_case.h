// The lights that are sampled, in float and in double.
#ifndef TESTS_PHYSICS_LIGHT_CASE_H
#define TESTS_PHYSICS_LIGHT_CASE_H

#include "physics/light_sampling.glsl"

enum { LIGHT_SPHERE, LIGHT_SUN, LIGHT_RECT, LIGHT_DISK, LIGHT_TUBE, LIGHT_TRIANGLE };

typedef struct light_case {
    int kind;
    double c[3];       // from the place: the centre; of a triangle, a corner; of a sun, unit
    double x[3], y[3]; // half axes; of a triangle, its edges from there
    double radius;     // of a sun, an angle
} light_case;

// In double; hit: negative if missed.
double light_density_double(const light_case *c, const double wi[3]);
double light_hit_double(const light_case *c, const double wi[3]);

static inline vec3 light_vec3(const double a[3])
{
    return vec3((real)a[0], (real)a[1], (real)a[2]);
}

static inline light_sample light_case_sample(const light_case *l, vec2 u)
{
    vec3 c = light_vec3(l->c), x = light_vec3(l->x), y = light_vec3(l->y);
    real r = (real)l->radius;
    switch (l->kind) {
    case LIGHT_SPHERE: return light_sample_sphere(c, r, u);
    case LIGHT_SUN: return light_sample_sun(c, sin(r), cos(r), u);
    case LIGHT_RECT: return light_sample_rect(c, x, y, u);
    case LIGHT_DISK: return light_sample_disk(c, x, y, u);
    case LIGHT_TUBE: return light_sample_tube(c, x, r, u);
    default: return light_sample_triangle(c, c + x, c + y, u);
    }
}

static inline real light_case_density(const light_case *l, vec3 wi)
{
    vec3 c = light_vec3(l->c), x = light_vec3(l->x), y = light_vec3(l->y);
    real r = (real)l->radius;
    switch (l->kind) {
    case LIGHT_SPHERE: return light_density_sphere(c, r);
    case LIGHT_SUN: return light_density_sun(cos(r), sin(r));
    case LIGHT_RECT: return light_density_rect(c, x, y);
    case LIGHT_DISK: return light_density_disk(c, x, y, wi);
    case LIGHT_TUBE: return light_density_tube(c, x, r, wi);
    default: return light_density_triangle(c, c + x, c + y, wi);
    }
}

// Suns are hit at the distance 1, triangles as the rectangle about them.
static inline real light_case_hit(const light_case *l, vec3 wi)
{
    vec3 c = light_vec3(l->c), x = light_vec3(l->x), y = light_vec3(l->y);
    real r = (real)l->radius;
    switch (l->kind) {
    case LIGHT_SPHERE: return light_hit_sphere(c, r, wi);
    case LIGHT_SUN: return light_hit_sphere(c, sin(r), wi);
    case LIGHT_RECT: return light_hit_rect(c, x, y, wi);
    case LIGHT_DISK: return light_hit_disk(c, x, y, wi);
    case LIGHT_TUBE: return light_hit_tube(c, x, r, wi);
    default: return light_hit_rect(c + 0.5f * (x + y), 0.5f * x, 0.5f * y, wi);
    }
}

#endif
