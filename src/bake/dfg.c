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
        q->node[i] = (float)(0.5 + 0.5 * x);
        q->weight[i] = (float)(1.0 / ((1.0 - x * x) * slope * slope));
    }
    for (int i = 0; i < ANGLES; i++)
        q->cosine[i / 8][i % 8] = cosf(3.14159265f * ((float)i + 0.5f) / ANGLES);
}

// Adds G2 / G1 of the visible normals at height z of the cap, and its part weighted by w.
WIDE_INLINE void add_ring(float c, float alpha, float z, f32x8 cosine, f32x8 *all, f32x8 *grazing)
{
    float a2 = alpha * alpha, s = sqrtf(1.0f - c * c);
    float stretch = 1.0f / sqrtf(a2 * s * s + c * c);
    float vx = alpha * s * stretch, vz = c * stretch;
    float height = (1.0f - z) * (1.0f + vz) - vz;
    float radius = sqrtf(fmaxf(1.0f - height * height, 0.0f));
    // sampling_visible_normal() of the physics, unstretched and normalised.
    f32x8 hx = alpha * (radius * cosine + vx), hz = (f32x8) { 0 } + (height + vz);
    f32x8 hy2 = a2 * radius * radius * (1.0f - cosine * cosine);
    f32x8 scale = 1.0f / wide_sqrt(hx * hx + hy2 + hz * hz);
    f32x8 VoH = wide_min((s * hx + c * hz) * scale, (f32x8) { 0 } + 1.0f);
    f32x8 NoL = wide_max(2.0f * VoH * hz * scale - c, (f32x8) { 0 });
    f32x8 sl = wide_sqrt(NoL * NoL * (1.0f - a2) + a2);
    float sv = sqrtf(c * c * (1.0f - a2) + a2);
    f32x8 g = NoL * (c + sv) / (NoL * sv + c * sl);
    f32x8 w = 1.0f - VoH, w2 = w * w;
    *all += g;
    *grazing += g * (w2 * w2 * w);
}

static float total(f32x8 v)
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
        float c = ((float)x + 0.5f) / BAKE_DFG_SIZE;
        f32x8 all = { 0 }, grazing = { 0 };
        for (int i = 0; i < HEIGHTS; i++) {
            f32x8 ring_all = { 0 }, ring_grazing = { 0 };
            for (int k = 0; k < ANGLES / 8; k++)
                add_ring(c, roughness * roughness, q->node[i], q->cosine[k], &ring_all,
                         &ring_grazing);
            all += ring_all * q->weight[i];
            grazing += ring_grazing * q->weight[i];
        }
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
