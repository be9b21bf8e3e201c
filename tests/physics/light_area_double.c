// Lights with an outline in double: what rounding costs the float text.
#define real double
#include "physics/light_disk.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_tube.glsl"

#include "light_area.h"

static vec3 to_vec3(const double a[3])
{
    return vec3(a[0], a[1], a[2]);
}

void light_area_double(const area_case *c, double result[2])
{
    vec3 o = to_vec3(c->centre), x = to_vec3(c->x), y = to_vec3(c->y), v = to_vec3(c->v);
    vec2 sum = vec2(0, 0);
    if (c->kind == AREA_QUAD)
        sum = light_quad_ggx(o - x - y, o + x - y, o + x + y, o - x + y, v, c->ax, c->ay);
    else if (c->kind == AREA_DISK)
        sum = light_disk_ggx(o, x, y, v, c->ax, c->ay);
    else
        sum = light_tube_ggx(o, x, c->radius, v, c->ax, c->ay);
    result[0] = sum[0];
    result[1] = sum[1];
}
