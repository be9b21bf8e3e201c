// The directional albedo of the GGX lobe, split by Fresnel: scale and bias of F0.
//
// The integral of D V F cos over the light's directions, with F = f0 (1 - w) + f90 w and
// w = (1 - v.h)^5, as a mean over visible normals: their density cancels D and leaves
// G2 / G1 (Heitz 2018, eq. 19).  Visible normals are uniform on a spherical cap (Dupuy &
// Benyoub 2023), smooth in its height and its angle: Gauss-Legendre in the one, equal
// steps in the other, which is even and periodic.
#include "bake/dfg.h"

#include "bake/wide.h"
#include "base/threads.h"
#include "image/half.h"

enum {
    HEIGHTS = 16,
    ANGLES = 16, // over half the circle
};

typedef struct quadrature {
    float node[HEIGHTS], weight[HEIGHTS]; // on [0, 1]
    f32x8 cosine[ANGLES / 8];
    uint16_t *table;
} quadrature;

// Gauss-Legendre nodes: the roots of the Legendre polynomial by Newton's method.
static void find_nodes(quadrature *q)
{
    for (int i = 0; i < HEIGHTS; i++) {
        double x = cos(3.14159265358979324 * (i + 0.75) / (HEIGHTS + 0.5)), slope = 1.0;
        for (int step = 0; step < 8; step++) {
            double p0 = 1.0, p1 = x;
            for (int n = 2; n <= HEIGHTS; n++) {
                double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
                p0 = p1;
                p1 = p2;
            }
            slope = HEIGHTS * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        // Smooth surfaces change just above the horizon: u = 1 - (1 - t)^2 has more nodes there.
        double left = 0.5 - 0.5 * x;
        q->node[i] = (float)(1.0 - left * left);
        q->weight[i] = (float)(2.0 * left / ((1.0 - x * x) * slope * slope));
    }
    for (int i = 0; i < ANGLES; i++)
        q->cosine[i / 8][i % 8] = cosf(3.14159265f * ((float)i + 0.5f) / ANGLES);
}

// The eye, and the surface as it is stretched for visible normals.
typedef struct view {
    float c, s; // cosine and sine of the eye's angle
    float alpha;
    float vx, vz; // the stretched eye direction, unit
} view;

// Unstretched half vectors, not normalised: sampling_visible_normal() of the physics at the
// heights u of the cap and the angles `cosine`.
typedef struct halves {
    f32x8 z, length2, along; // n.h, h.h, v.h
} halves;

WIDE_INLINE halves halves_at(const view *v, f32x8 u, f32x8 cosine)
{
    f32x8 height = (1.0f - u) * (1.0f + v->vz) - v->vz;
    f32x8 radius2 = wide_max(1.0f - height * height, (f32x8) { 0 });
    f32x8 x = v->alpha * (wide_sqrt(radius2) * cosine + v->vx), z = height + v->vz;
    f32x8 y2 = v->alpha * v->alpha * radius2 * (1.0f - cosine * cosine);
    return (halves) { z, x * x + y2 + z * z, v->s * x + v->c * z };
}

// Where the reflected directions sink below the horizon: Gauss wants smooth integrands.
WIDE_INLINE f32x8 find_horizon(const view *v, f32x8 cosine)
{
    f32x8 above = { 0 }, below = above + 1.0f;
    for (int i = 0; i < 10; i++) {
        f32x8 middle = 0.5f * (above + below);
        halves h = halves_at(v, middle, cosine);
        i32x8 is_above = 2.0f * h.along * h.z > v->c * h.length2;
        above = wide_select(is_above, middle, above);
        below = wide_select(is_above, below, middle);
    }
    return below;
}

// Adds the means of G2 / G1 over the heights, and its part weighted by w, for 8 angles.
WIDE_INLINE void add_angles(const quadrature *q, const view *v, f32x8 cosine, f32x8 *all,
                            f32x8 *grazing)
{
    f32x8 range = find_horizon(v, cosine);
    float a2 = v->alpha * v->alpha, c = v->c;
    float sv = sqrtf(c * c * (1.0f - a2) + a2);
    for (int i = 0; i < HEIGHTS; i++) {
        halves h = halves_at(v, range * q->node[i], cosine);
        f32x8 scale = 1.0f / wide_sqrt(h.length2);
        f32x8 VoH = wide_min(h.along * scale, (f32x8) { 0 } + 1.0f);
        f32x8 NoL = wide_max(2.0f * VoH * h.z * scale - c, (f32x8) { 0 });
        f32x8 sl = wide_sqrt(NoL * NoL * (1.0f - a2) + a2);
        f32x8 g = NoL * (c + sv) / (NoL * sv + c * sl) * (range * q->weight[i]);
        f32x8 w = 1.0f - VoH, w2 = w * w;
        *all += g;
        *grazing += g * (w2 * w2 * w);
    }
}

WIDE_INLINE float total(f32x8 v)
{
    float sum = 0.0f;
    for (int i = 0; i < 8; i++)
        sum += v[i];
    return sum;
}

WIDE_INLINE void fill_row_body(const quadrature *q, uint32_t row)
{
    float roughness = ((float)row + 0.5f) / BAKE_DFG_SIZE;
    for (uint32_t x = 0; x < BAKE_DFG_SIZE; x++) {
        view v = { .c = ((float)x + 0.5f) / BAKE_DFG_SIZE, .alpha = roughness * roughness };
        v.s = sqrtf(1.0f - v.c * v.c);
        float stretch = 1.0f / sqrtf(v.alpha * v.alpha * v.s * v.s + v.c * v.c);
        v.vx = v.alpha * v.s * stretch;
        v.vz = v.c * stretch;
        f32x8 all = { 0 }, grazing = { 0 };
        for (int k = 0; k < ANGLES / 8; k++)
            add_angles(q, &v, q->cosine[k], &all, &grazing);
        float f90 = total(grazing) / ANGLES, f0 = total(all) / ANGLES - f90;
        uint16_t *to = q->table + 2 * (row * BAKE_DFG_SIZE + x);
        to[0] = half_from_float(f0);
        to[1] = half_from_float(f90);
    }
}
WIDE_DISPATCH(fill_row, (const quadrature *q, uint32_t row), (q, row))

static void fill_row_task(void *context, size_t row)
{
    fill_row(context, (uint32_t)row);
}

void bake_dfg(uint16_t *table)
{
    quadrature q = { .table = table };
    find_nodes(&q);
    parallel_for(BAKE_DFG_SIZE, fill_row_task, &q);
}
