// Bodies of lights on a ray.
#include "scene/pick.h"

#include "physics/light_sampling.glsl"

static vec3 loaded(const float v[3])
{
    return vec3(v[0], v[1], v[2]);
}

float pick_body(const ag_light_desc *l, const float origin[3], const float direction[3])
{
    float half_x[3], half_y[3];
    light_axes(l, half_x, half_y);
    vec3 to = loaded(l->position) - loaded(origin), along = loaded(direction);
    vec3 x = loaded(half_x), y = loaded(half_y);
    bool shines = dot(along, loaded(l->direction)) < 0;
    if (l->hidden)
        return -1;
    switch (l->kind) {
    case AG_LIGHT_SUN:
        return -dot(along, loaded(l->direction)) >= cosf(l->angular_radius_rad) ? INFINITY : -1;
    case AG_LIGHT_SPHERE: return l->radius_m > 0 ? light_hit_sphere(to, l->radius_m, along) : -1;
    case AG_LIGHT_DISK: return shines ? light_hit_disk(to, x, y, along) : -1;
    case AG_LIGHT_RECT: return shines ? light_hit_rect(to, x, y, along) : -1;
    case AG_LIGHT_TUBE: return light_hit_tube(to, x, l->radius_m, along);
    default: return -1;
    }
}
