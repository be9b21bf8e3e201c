// FLIP (Andersson et al. 2020), one square of a picture at a time, so that it stays in the cache.
#include "image/flip.h"

#include "image/hdr_flip.h"

#include <math.h>
#include <string.h>

// CIE XYZ over that of white (D65), and back: of grey all three are equal.
static const float xyz_from_rgb[3][3] = { { 0.4338953888f, 0.3762423726f, 0.1898622385f },
                                          { 0.2126368217f, 0.7151829818f, 0.0721801965f },
                                          { 0.0177524232f, 0.1094656287f, 0.8727819482f } };
static const float rgb_from_xyz[3][3] = { { 3.0803419883f, -1.5373989695f, -0.5429430188f },
                                          { -0.9211783962f, 1.8759299837f, 0.0452484125f },
                                          { 0.0528812929f, -0.2040112061f, 1.1511299132f } };

typedef struct triple {
    float v[3];
} triple;

static triple transform(const float m[3][3], triple in)
{
    triple out;
    for (int i = 0; i < 3; i++)
        out.v[i] = m[i][0] * in.v[0] + m[i][1] * in.v[1] + m[i][2] * in.v[2];
    return out;
}

static float lab_curve(float t)
{
    const float d = 6.0f / 29;
    return t > d * d * d ? cbrtf(t) : t / (3 * d * d) + 4.0f / 29;
}

// CIE L*a*b* with Hunt's effect: colours in the dark differ less.
static triple hunt_lab(triple rgb)
{
    triple xyz = transform(xyz_from_rgb, rgb);
    float x = lab_curve(xyz.v[0]), y = lab_curve(xyz.v[1]), z = lab_curve(xyz.v[2]);
    float lightness = 116 * y - 16;
    return (triple) {
        { lightness, 5 * lightness * (x - y), 2 * lightness * (y - z) } // 500, 200 x 0.01
    };
}

// HyAB to the power q_c = 0.7.
static float color_distance(triple a, triple b)
{
    float da = a.v[1] - b.v[1], db = a.v[2] - b.v[2];
    return powf(fabsf(a.v[0] - b.v[0]) + sqrtf(da * da + db * db), 0.7f);
}

// ---- The viewer ------------------------------------------------------------

static void normalize(flip_kernel *k)
{
    float sum = 0;
    for (int i = 0; i <= 2 * k->radius; i++)
        sum += k->weight[i];
    for (int i = 0; i <= 2 * k->radius; i++)
        k->weight[i] /= sum;
}

// A filter of unit sum, cut at `radius` px or where its weights have become nothing.
static void gauss_init(flip_kernel *k, double deviation, int radius)
{
    int visible = (int)ceil(6 * deviation);
    k->radius = visible < radius ? visible : radius;
    for (int i = -k->radius; i <= k->radius; i++)
        k->weight[i + k->radius] = (float)exp(-i * i / (2 * deviation * deviation));
    normalize(k);
}

// The part that this Gaussian has in a sum of two.
static void scale(flip_kernel *k, double part)
{
    for (int i = 0; i <= 2 * k->radius; i++)
        k->weight[i] *= (float)sqrt(part); // it is applied twice
}

// The sum of a Gaussian's samples in the square, before it is normalized.
static double gauss_sum(double a, double b, double ppd, int radius)
{
    double sum = 0, pi = 3.14159265358979323846;
    for (int i = -radius; i <= radius; i++)
        sum += exp(-pi * pi * i * i / (ppd * ppd * b));
    return a * sqrt(pi / b) * sum * sum;
}

// The paper's sums of a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees; the standard deviations
// are sqrt(b / 2) / pi.
static void sensitivity_init(flip_viewer *v, double ppd)
{
    const double pixels = ppd / 3.14159265358979323846;
    int r = v->border = (int)ceil(3 * sqrt(0.04 / 2) * pixels);
    gauss_init(&v->luminance, sqrt(0.0047 / 2) * pixels, r);
    gauss_init(&v->red_green, sqrt(0.0053 / 2) * pixels, r);
    gauss_init(&v->blue_yellow[0], sqrt(0.04 / 2) * pixels, r);
    gauss_init(&v->blue_yellow[1], sqrt(0.025 / 2) * pixels, r);
    double wide = gauss_sum(34.1, 0.04, ppd, r), narrow = gauss_sum(13.5, 0.025, ppd, r);
    scale(&v->blue_yellow[0], wide / (wide + narrow));
    scale(&v->blue_yellow[1], narrow / (wide + narrow));
}

// What is above 0 sums to 1, what is below to -1.
static void balance(flip_kernel *k)
{
    float above = 0, below = 0;
    for (int i = 0; i <= 2 * k->radius; i++)
        *(k->weight[i] > 0 ? &above : &below) += k->weight[i];
    for (int i = 0; i <= 2 * k->radius; i++)
        k->weight[i] /= k->weight[i] > 0 ? above : -below;
}

// First and second derivatives of a Gaussian as wide as the eye's detector, 0.082 degrees.
static void detectors_init(flip_viewer *v, double ppd)
{
    double deviation = 0.5 * 0.082 * ppd;
    int radius = (int)ceil(3 * deviation);
    gauss_init(&v->smooth, deviation, radius);
    v->edge.radius = v->point.radius = radius;
    for (int i = -radius; i <= radius; i++) {
        double t = i / deviation, g = exp(-t * t / 2);
        v->edge.weight[i + radius] = (float)(-t * g);
        v->point.weight[i + radius] = (float)((t * t - 1) * g);
    }
    balance(&v->edge);
    balance(&v->point);
}

void flip_viewer_init(flip_viewer *v, float pixels_per_degree)
{
    sensitivity_init(v, (double)pixels_per_degree);
    detectors_init(v, (double)pixels_per_degree);
    triple green = { { 0, 1, 0 } }, blue = { { 0, 0, 1 } };
    v->color_max = color_distance(hunt_lab(green), hunt_lab(blue));
}

// ---- A square ----------------------------------------------------------------

enum { TILE_PIXELS = FLIP_TILE * FLIP_TILE };

// Planes in scratch memory.  `side`: of the square with its border.
typedef struct work {
    const flip_viewer *viewer;
    int side;
    float *linear[2]; // 3 planes: reference, test
    float *opponent;  // 3 planes
    float *rows;      // filtered along x: FLIP_TILE wide, `side` high
    float *columns;   // filtered along y as well
    float *seen[2];   // L, a, b, edges, points
} work;

size_t flip_scratch_size(const flip_viewer *v)
{
    size_t side = FLIP_TILE + 2 * (size_t)v->border;
    return 9 * side * side + FLIP_TILE * side + (1 + 10) * TILE_PIXELS;
}

static work work_in(const flip_viewer *v, float *scratch)
{
    work w = { .viewer = v, .side = FLIP_TILE + 2 * v->border };
    size_t plane = (size_t)w.side * (size_t)w.side;
    w.linear[0] = scratch;
    w.linear[1] = w.linear[0] + 3 * plane;
    w.opponent = w.linear[1] + 3 * plane;
    w.rows = w.opponent + 3 * plane;
    w.columns = w.rows + FLIP_TILE * w.side;
    w.seen[0] = w.columns + TILE_PIXELS;
    w.seen[1] = w.seen[0] + 5 * TILE_PIXELS;
    return w;
}

static int64_t clamp_index(int64_t i, uint32_t count)
{
    return i < 0 ? 0 : i < count ? i : (int64_t)count - 1;
}

static void load(const work *w, const picture *p, uint32_t x, uint32_t y, float *linear)
{
    uint32_t width = p->image->width, height = p->image->height;
    int border = w->viewer->border, plane = w->side * w->side;
    for (int j = 0; j < w->side; j++) {
        int64_t row = clamp_index((int64_t)y + j - border, height) * width;
        for (int i = 0; i < w->side; i++, linear++) {
            float rgb[3];
            picture_linear(p, (size_t)(row + clamp_index((int64_t)x + i - border, width)), rgb);
            for (int c = 0; c < 3; c++)
                linear[c * plane] = rgb[c];
        }
    }
}

static triple shown(const float *linear, int plane, const float *exposure)
{
    triple rgb = { { linear[0], linear[plane], linear[2 * plane] } };
    for (int c = 0; c < 3 && exposure; c++)
        rgb.v[c] = hdr_tone(rgb.v[c] * *exposure);
    return rgb;
}

// Luminance, red against green, blue against yellow: YCxCz without its factors, which the way
// back would take out again.
static void oppose(const work *w, const float *linear, const float *exposure)
{
    int plane = w->side * w->side;
    for (int i = 0; i < plane; i++) {
        triple xyz = transform(xyz_from_rgb, shown(linear + i, plane, exposure));
        w->opponent[i] = xyz.v[1];
        w->opponent[i + plane] = xyz.v[0] - xyz.v[1];
        w->opponent[i + 2 * plane] = xyz.v[1] - xyz.v[2];
    }
}

typedef float lanes __attribute__((vector_size(32), aligned(4), may_alias));

// A row of FLIP_TILE: out[i] = sum over k of weight[k] in[i + (k - radius) step].
static inline __attribute__((always_inline)) void filter_body(const flip_kernel *k, const float *in,
                                                              ptrdiff_t step, float *out)
{
    in -= k->radius * step;
    for (int i = 0; i < FLIP_TILE; i += 32) {
        lanes sum[4] = { 0 };
        for (int j = 0; j <= 2 * k->radius; j++) {
            const lanes *from = (const lanes *)(const void *)(in + i + j * step);
            for (int l = 0; l < 4; l++)
                sum[l] += k->weight[j] * from[l];
        }
        memcpy(out + i, sum, sizeof sum);
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) static void filter_avx2(const flip_kernel *k, const float *in,
                                                            ptrdiff_t step, float *out)
{
    filter_body(k, in, step, out);
}

static bool has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
static bool has_avx2(void)
{
    return false;
}
#define filter_avx2 filter_body
#endif

static void filter(const flip_kernel *k, const float *in, ptrdiff_t step, float *out)
{
    if (has_avx2())
        filter_avx2(k, in, step, out);
    else
        filter_body(k, in, step, out);
}

// Along x of plane `channel`, for all rows that `down` will look at.
static void filter_x(const work *w, int channel, const flip_kernel *along, int down_radius)
{
    int border = w->viewer->border;
    const float *in = w->opponent + (ptrdiff_t)channel * w->side * w->side + border;
    for (int y = border - down_radius; y < border + FLIP_TILE + down_radius; y++)
        filter(along, in + y * w->side, 1, w->rows + y * FLIP_TILE);
}

static void filter_y(const work *w, const flip_kernel *down, float *out)
{
    const float *in = w->rows + w->viewer->border * FLIP_TILE;
    for (int y = 0; y < FLIP_TILE; y++)
        filter(down, in + y * FLIP_TILE, FLIP_TILE, out + y * FLIP_TILE);
}

static void filter_xy(const work *w, int channel, const flip_kernel *k, float *out)
{
    filter_x(w, channel, k, k->radius);
    filter_y(w, k, out);
}

// What the eye's contrast sensitivity leaves of the colours, in L*a*b*.
static void see_colors(const work *w, float *seen)
{
    const flip_viewer *v = w->viewer;
    float *y = seen, *xy = y + TILE_PIXELS, *yz = xy + TILE_PIXELS;
    filter_xy(w, 0, &v->luminance, y);
    filter_xy(w, 1, &v->red_green, xy);
    filter_xy(w, 2, &v->blue_yellow[0], yz);
    filter_xy(w, 2, &v->blue_yellow[1], w->columns);
    for (int i = 0; i < TILE_PIXELS; i++) {
        triple xyz = { { y[i] + xy[i], y[i], y[i] - yz[i] - w->columns[i] } };
        triple rgb = transform(rgb_from_xyz, xyz);
        for (int c = 0; c < 3; c++)
            rgb.v[c] = rgb.v[c] > 0 ? rgb.v[c] < 1 ? rgb.v[c] : 1 : 0;
        triple lab = hunt_lab(rgb);
        y[i] = lab.v[0];
        xy[i] = lab.v[1];
        yz[i] = lab.v[2];
    }
}

// How strongly one detector answers: the length of its answers along x and y.
static void see_features(const work *w, const flip_kernel *detector, float *out)
{
    const flip_kernel *smooth = &w->viewer->smooth;
    filter_x(w, 0, detector, smooth->radius);
    filter_y(w, smooth, out);
    filter_x(w, 0, smooth, detector->radius);
    filter_y(w, detector, w->columns);
    for (int i = 0; i < TILE_PIXELS; i++)
        out[i] = sqrtf(out[i] * out[i] + w->columns[i] * w->columns[i]);
}

static void see(const work *w, int which, const float *exposure)
{
    oppose(w, w->linear[which], exposure);
    see_colors(w, w->seen[which]);
    see_features(w, &w->viewer->edge, w->seen[which] + 3 * TILE_PIXELS);
    see_features(w, &w->viewer->point, w->seen[which] + 4 * TILE_PIXELS);
}

// Two fifths of the range of differences (p_c) take 95 % of that of errors (p_t).
static float color_error(const flip_viewer *v, triple a, triple b)
{
    float distance = color_distance(a, b), bend = 0.4f * v->color_max;
    float error = distance < bend ? 0.95f * distance / bend
                                  : 0.95f + 0.05f * (distance - bend) / (v->color_max - bend);
    return error < 1 ? error : 1;
}

// The colours' error, the greater the more features differ; q_f = 0.5.
static float pixel_error(const work *w, int i)
{
    const float *a = w->seen[0] + i, *b = w->seen[1] + i;
    enum { P = TILE_PIXELS };
    float color = color_error(w->viewer, (triple) { { a[0], a[P], a[2 * P] } },
                              (triple) { { b[0], b[P], b[2 * P] } });
    float edges = fabsf(a[3 * P] - b[3 * P]), points = fabsf(a[4 * P] - b[4 * P]);
    float feature = sqrtf(fmaxf(edges, points) * 0.70710678f);
    return powf(color, 1 - fminf(feature, 1));
}

void flip_tile(const flip_viewer *v, const picture *reference, const picture *test, uint32_t x,
               uint32_t y, const float *exposures, int exposure_count, float *scratch,
               float *errors)
{
    work w = work_in(v, scratch);
    load(&w, reference, x, y, w.linear[0]);
    load(&w, test, x, y, w.linear[1]);
    memset(errors, 0, TILE_PIXELS * sizeof *errors);
    for (int e = 0; e < exposure_count || e == 0; e++) {
        const float *exposure = exposure_count ? &exposures[e] : NULL;
        see(&w, 0, exposure);
        see(&w, 1, exposure);
        for (int i = 0; i < TILE_PIXELS; i++)
            errors[i] = fmaxf(errors[i], pixel_error(&w, i));
    }
}
