// The ambient lights of a scene as one polynomial in the normal.
#include "physics/ambient.glsl"

#include "scene/scene.h"

static void put_hemispheric(const ag_light_desc *d, float terms[9][3])
{
    const float *u = d->color, *g = d->ground_color, *axis = d->direction;
    ambient_light a = ambient_from_hemispheric(vec3(u[0], u[1], u[2]), vec3(g[0], g[1], g[2]),
                                               vec3(axis[0], axis[1], axis[2]));
    for (int c = 0; c < 3; c++) {
        terms[0][c] = a.c0[c];
        terms[1][c] = a.cx[c];
        terms[2][c] = a.cy[c];
        terms[3][c] = a.cz[c];
    }
}

static void add(const ag_light_desc *d, float sum[9][3])
{
    float terms[9][3] = { { 1, 1, 1 } };
    if (d->kind == AG_LIGHT_HARMONICS)
        memcpy(terms, d->harmonics, sizeof terms);
    if (d->kind == AG_LIGHT_HEMISPHERIC)
        put_hemispheric(d, terms);
    for (int i = 0; i < 9; i++)
        for (int c = 0; c < 3; c++) {
            float color = d->kind == AG_LIGHT_HEMISPHERIC ? 1.0f : d->color[c];
            sum[i][c] += terms[i][c] * color * d->intensity;
        }
}

bool scene_ambient(const ag_scene *scene, ag_light only, float sum[9][3])
{
    bool present = false;
    memset(sum, 0, sizeof(float[9][3]));
    for (size_t i = 0; i < scene->lights_count; i++) {
        if (!light_is_ambient(scene->lights[i].kind))
            continue;
        present = true;
        if (!only.id || only.id == i + 1)
            add(&scene->lights[i], sum);
    }
    return present;
}
