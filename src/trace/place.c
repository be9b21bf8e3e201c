// A place on a surface that a ray has found.
#include "trace/place.h"

#include "physics/fresnel.glsl"

// The corners of a hit's triangle and their weights.
typedef struct corners {
    const scene_vertex *at[3];
    float weight[3];
    vec3 position[3], normal[3]; // world space
} corners;

static const uint32_t *indices_of(const hit *h)
{
    return h->instance->mesh->indices + 3 * (size_t)h->triangle;
}

static corners corners_of(const hit *h)
{
    corners c = { .weight = { 1 - h->u - h->v, h->u, h->v } };
    const uint32_t *index = indices_of(h);
    for (int i = 0; i < 3; i++) {
        c.at[i] = &h->instance->mesh->vertices[index[i]];
        c.position[i] = world_point(h->instance, c.at[i]->position);
        c.normal[i] = world_normal(h->instance, c.at[i]->normal);
    }
    return c;
}

void place_expect(const hit *const *hits, size_t count)
{
    for (size_t i = 0; i < count; i++)
        __builtin_prefetch(indices_of(hits[i]));
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            const scene_vertex *v = &hits[i]->instance->mesh->vertices[indices_of(hits[i])[c]];
            __builtin_prefetch(v);
            __builtin_prefetch((const char *)(v + 1) - 1);
        }
    for (size_t i = 0; i < count; i++) {
        vec2 uv[2];
        world_uv(hits[i]->instance, hits[i]->triangle, hits[i]->u, hits[i]->v, uv);
        texture_set_expect(hits[i]->instance->textures, uv);
    }
}

static vec3 weighted(const corners *c, const vec3 value[3])
{
    return c->weight[0] * value[0] + c->weight[1] * value[1] + c->weight[2] * value[2];
}

static vec4 color_of(const corners *c)
{
    vec4 sum = { 0, 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        const uint16_t *v = c->at[i]->color;
        sum += (c->weight[i] / 65535) * vec4((float)v[0], (float)v[1], (float)v[2], (float)v[3]);
    }
    return sum;
}

static vec4 tangent_of(const world_instance *instance, const corners *c)
{
    vec3 sum = { 0, 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        sum += c->weight[i] * world_direction(instance, c->at[i]->tangent);
    return vec4(sum[0], sum[1], sum[2], instance->flip * c->at[0]->tangent[3]);
}

// The textures of a hit, as they are read one after the other.
typedef struct reading {
    const world *world;
    const texture_set *set;
    vec2 uv[2];
    texture_place place; // of the last one; where all are alike, of all
    bool found;
} reading;

static reading reading_at(const world *w, const hit *h)
{
    reading r = { .world = w, .set = h->instance->textures };
    world_uv(h->instance, h->triangle, h->u, h->v, r.uv);
    return r;
}

static void seek(reading *r, const texture_use *use)
{
    if (!use->pixels || (r->found && r->set->alike))
        return;
    r->place = texture_find(use, r->uv);
    r->found = true;
}

static vec4 read_plain(reading *r, const texture_use *use)
{
    seek(r, use);
    return texture_read(use, &r->place);
}

static vec4 read_color(reading *r, const texture_use *use)
{
    seek(r, use);
    return texture_read_color(use, &r->place, r->world->decode);
}

// Where the smooth surface is that the normals tell of, so that its shadows are not those of its
// facets: Hanika 2021, "Hacking the Shadow Terminator", listing 4.1.
static vec3 bulged(const corners *c, vec3 position, float side)
{
    vec3 moved = { 0, 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        vec3 n = side * c->normal[i];
        float below = min(dot(position - c->position[i], n), 0);
        moved = moved - (c->weight[i] * below) * n;
    }
    return position + moved;
}

// A normal map's x and y, from the directions of its own uv to those of the tangents: as in
// shaders/passes/surface.glsl.
static vec2 turned(const texture_use *use, vec2 m)
{
    vec2 u = { use->u[0], use->u[1] }, v = { use->v[0], use->v[1] };
    float uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1];
    if (!(min(uu, vv) > 0))
        return m;
    u = u / sqrtf(uu);
    v = v / sqrtf(vv);
    return vec2(m[0] * u[0] - m[1] * v[0], m[1] * v[1] - m[0] * u[1]);
}

static vec3 mapped(const hit *h, reading *r, vec4 tangent, vec3 n)
{
    const texture_use *map = &h->instance->textures->normal;
    vec4 texel = read_plain(r, map);
    vec2 xy = vec2(2 * texel[0] - 1, 2 * texel[1] - 1);
    float z = sqrtf(max(1 - xy[0] * xy[0] - xy[1] * xy[1], 0));
    vec2 m = turned(map, xy) * h->instance->material->normal_scale;
    vec3 t = vec3(tangent[0], tangent[1], tangent[2]);
    vec3 made = m[0] * t + m[1] * (tangent[3] * cross(n, t)) + z * n;
    float length2 = dot(made, made);
    return length2 > 1e-12f ? made / sqrtf(length2) : n;
}

// A normal turned towards the face until the mirror direction of wo is above it: without this
// bumps seen from aslant are black.  The least turn in the plane of the two, by bisection.
static vec3 lifted(vec3 n, vec3 face, vec3 wo)
{
    float up = dot(wo, face), least = min(0.9f * up, 0.01f);
    float low = 0, high = 1;
    if (dot(wo, n) > 1e-4f && 2 * dot(wo, n) * dot(n, face) - up >= least)
        return n;
    for (int i = 0; i < 12; i++) {
        float middle = 0.5f * (low + high);
        vec3 m = normalize(mix(n, face, middle));
        if (dot(wo, m) > 1e-4f && 2 * dot(wo, m) * dot(m, face) - up >= least)
            high = middle;
        else
            low = middle;
    }
    return normalize(mix(n, face, high));
}

// The rougher direction of an anisotropic surface, across n.
static vec3 brushed(const ag_material_desc *m, vec4 tangent, vec3 interpolated, vec3 n)
{
    vec3 t = vec3(tangent[0], tangent[1], tangent[2]);
    vec3 b = tangent[3] * cross(interpolated, t);
    t = cosf(m->anisotropy_rotation_rad) * t + sinf(m->anisotropy_rotation_rad) * b;
    t = t - dot(t, n) * n;
    if (dot(t, t) < 1e-12f)
        t = cross(n, fabsf(n[0]) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0));
    return normalize(t);
}

static surface_material material_of(const hit *h, reading *r)
{
    const ag_material_desc *d = h->instance->material;
    const texture_set *t = h->instance->textures;
    vec4 metallic_roughness = read_plain(r, &t->metallic_roughness);
    vec4 tint = read_color(r, &t->specular_color);
    vec3 rgb = vec3(tint[0], tint[1], tint[2]);
    return (surface_material) {
        .metallic = d->metallic * metallic_roughness[2],
        .roughness = d->roughness * metallic_roughness[1],
        .dielectric_f0 = fresnel_f0_dielectric(d->ior),
        .specular_color =
            vec3(d->specular_color[0], d->specular_color[1], d->specular_color[2]) * rgb,
        .specular = d->specular * read_plain(r, &t->specular)[3],
        .model = h->instance->model,
        .diffuse_roughness = d->diffuse_roughness,
        .shininess = d->shininess,
        .anisotropy = d->anisotropy,
        .conductor_n = vec3(d->conductor_n[0], d->conductor_n[1], d->conductor_n[2]),
        .conductor_k = vec3(d->conductor_k[0], d->conductor_k[1], d->conductor_k[2]),
        .f82_tint = vec3(d->f82_tint[0], d->f82_tint[1], d->f82_tint[2]),
        .reflectiveness = d->reflectiveness,
    };
}

static vec3 emission_at(const world_instance *i, reading *r)
{
    const float *e = i->material->emissive;
    vec4 texel = read_color(r, &i->textures->emissive);
    return vec3(e[0] * texel[0], e[1] * texel[1], e[2] * texel[2]);
}

static bool shines(const ag_material_desc *d, bool front)
{
    const float *e = d->emissive;
    return (front || d->double_sided) && !d->unlit && (e[0] > 0 || e[1] > 0 || e[2] > 0);
}

static float reach(vec3 p)
{
    return max(fabsf(p[0]), max(fabsf(p[1]), fabsf(p[2])));
}

place place_at(const world *w, const hit *h, vec3 wo)
{
    const ag_material_desc *d = h->instance->material;
    corners c = corners_of(h);
    place p = { .position = weighted(&c, c.position), .unlit = d->unlit };
    bool front = dot(h->normal, wo) > 0;
    float side = front ? 1 : -1;
    p.face = normalize(h->normal / max(reach(h->normal), 1e-37f)) * side;
    reading r = reading_at(w, h);
    vec4 base = vec4(d->base_color[0], d->base_color[1], d->base_color[2], 1) *
                read_color(&r, &h->instance->textures->base_color);
    if (h->instance->mesh->has_colors)
        base *= color_of(&c);
    p.base_color = vec3(base[0], base[1], base[2]);
    if (d->unlit)
        return p;
    vec3 smooth = weighted(&c, c.normal);
    // Just so far that the triangle itself is not met again.
    float nudge = 1e-6f * (reach(p.position) + reach(h->instance->at) + h->distance);
    p.origin = bulged(&c, p.position, side) + nudge * p.face;
    p.material = material_of(h, &r);
    p.material.base_color = p.base_color;
    vec4 tangent = { 0, 0, 0, 0 };
    bool maps = h->instance->textures->normal.pixels != NULL;
    bool anisotropic = (p.material.model & SURFACE_DISTRIBUTION) == SURFACE_ANISOTROPIC;
    if (maps || anisotropic)
        tangent = tangent_of(h->instance, &c);
    vec3 n = maps ? mapped(h, &r, tangent, smooth) : smooth;
    float length2 = dot(n, n);
    n = length2 > 1e-12f ? n * (side / sqrtf(length2)) : p.face;
    p.normal = lifted(n, p.face, wo);
    if (anisotropic)
        p.material.tangent = brushed(d, tangent, smooth, p.normal);
    if (shines(d, front))
        p.emission = emission_at(h->instance, &r);
    return p;
}

vec3 place_emission(const world *w, const hit *h, vec3 wo)
{
    if (!shines(h->instance->material, dot(h->normal, wo) > 0))
        return vec3(0, 0, 0);
    reading r = reading_at(w, h);
    return emission_at(h->instance, &r);
}
