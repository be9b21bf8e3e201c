// The environment as a rough mirror reflects it, by filtered importance sampling: few
// directions, each standing for the solid angle around it through the mip level whose
// texels are as large.  Krivanek & Colbert 2008; Karis 2013.
#include "bake/prefilter.h"

#include "base/threads.h"
#include "physics/environment.glsl"
#include "physics/microfacet.glsl"

// Where there are few texels there may be many samples, and the wide lobes that are kept
// in such levels need them.
enum { SAMPLES_MAX = 256 };

static int sample_count(uint32_t size)
{
    return size > 64 ? 32 : size > 32 ? 64 : SAMPLES_MAX;
}

typedef struct lobe_sample {
    float x, y, z; // direction about +Z
    float weight;  // all of them sum to 1
    const cube_level *level;
} lobe_sample;

typedef struct lobe {
    lobe_sample samples[SAMPLES_MAX];
    int count;
    uint32_t size;
    float *texels;
} lobe;

// The level whose texels have the solid angle, 1 / `density` sr, that a sample stands for;
// a little finer, since a bilinear tap is wider than a texel (least error, by trial).
static const cube_level *level_for(const cube *environment, float density)
{
    float texel = 4.0f * PI / 6.0f; // of a face of one texel, sr
    float edge = sqrtf(texel * density);
    float level = log2f((float)environment->levels[0].size / edge);
    int i = (int)(level + 0.25f);
    int last = (int)environment->level_count - 1;
    return &environment->levels[i < 0 ? 0 : i > last ? last : i];
}

// The half vectors lie on a Vogel spiral over the disk that the distribution's inverse maps
// to the hemisphere: as even as points get, and the same for all texels.
static void make_samples(lobe *l, const cube *environment, float alpha)
{
    float a2 = alpha * alpha, sum = 0.0f;
    float golden = PI * (3.0f - sqrtf(5.0f));
    for (int i = 0; i < l->count; i++) {
        // Normals beyond 45 degrees reflect the light below the horizon: u ends there.
        float u = ((float)i + 0.5f) / ((float)l->count * (1.0f + a2));
        float cos2 = (1.0f - u) / (1.0f + (a2 - 1.0f) * u); // Walter et al. 2007, eq. 35
        float c = sqrtf(cos2), s = sqrtf(1.0f - cos2), phi = (float)i * golden;
        float density = microfacet_d(c, a2) * 0.25f * (1.0f + a2) * (float)l->count;
        lobe_sample *p = &l->samples[i];
        *p = (lobe_sample) {
            .x = 2.0f * s * c * cosf(phi),
            .y = 2.0f * s * c * sinf(phi),
            .z = 2.0f * cos2 - 1.0f,
            .level = level_for(environment, density),
        };
        p->weight = p->z;
        sum += p->z;
    }
    for (int i = 0; i < l->count; i++)
        l->samples[i].weight /= sum;
}

WIDE_INLINE void fill_row_body(const lobe *l, uint32_t face, uint32_t y)
{
    float t = cube_coordinate(l->size, y);
    vec3 centre = environment_cube_direction(face, 0.0f, t);
    vec3 along = environment_cube_direction(face, 1.0f, t) - centre;
    // Tangents from an axis that the face's normals never meet.
    float up_y = face / 2 == 1 ? 0.0f : 1.0f, up_z = 1.0f - up_y;
    f32x8 ramp = { 0, 1, 2, 3, 4, 5, 6, 7 };
    for (uint32_t x = 0; x < l->size; x += 8) {
        f32x8 a = (2.0f * (ramp + (float)x) + 1.0f) / (float)l->size - 1.0f;
        f32x8 nx = centre[0] + along[0] * a, ny = centre[1] + along[1] * a;
        f32x8 nz = centre[2] + along[2] * a;
        f32x8 scale = 1.0f / wide_sqrt(nx * nx + ny * ny + nz * nz);
        nx *= scale, ny *= scale, nz *= scale;
        f32x8 tx = up_y * nz - up_z * ny, ty = up_z * nx, tz = -up_y * nx; // up x n
        scale = 1.0f / wide_sqrt(tx * tx + ty * ty + tz * tz);
        tx *= scale, ty *= scale, tz *= scale;
        f32x8 bx = ny * tz - nz * ty, by = nz * tx - nx * tz, bz = nx * ty - ny * tx;

        f32x4 sum[8] = { { 0 } };
        for (int i = 0; i < l->count; i++) {
            const lobe_sample *p = &l->samples[i];
            cube_hit hit =
                cube_find(p->level->size, tx * p->x + bx * p->y + nx * p->z,
                          ty * p->x + by * p->y + ny * p->z, tz * p->x + bz * p->y + nz * p->z);
            for (int k = 0; k < 8; k++)
                sum[k] += cube_fetch(p->level, &hit, k) * p->weight;
        }
        memcpy(l->texels + 4 * ((size_t)(face * l->size + y) * l->size + x), sum, sizeof sum);
    }
}
WIDE_DISPATCH(fill_row, (const lobe *l, uint32_t face, uint32_t y), (l, face, y))

static void fill_row_task(void *context, size_t index)
{
    const lobe *l = context;
    fill_row(l, (uint32_t)index / l->size, (uint32_t)index % l->size);
}

void prefilter(const cube *environment, float roughness, uint32_t size, float *texels)
{
    lobe l = { .size = size, .texels = texels, .count = sample_count(size) };
    make_samples(&l, environment, roughness * roughness);
    parallel_for(6 * (size_t)size, fill_row_task, &l);
}
