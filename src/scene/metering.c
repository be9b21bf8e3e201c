// What a meter makes of a picture.
#include "scene/metering.h"

#include "base/log.h"
#include "image/image.h"
#include "physics/color.glsl"

enum { SIZE = 160 }; // px, the longer side

// ---- What is asked -----------------------------------------------------------------

static bool is_sound(const ag_metering *m)
{
    return (unsigned)m->meter <= AG_METER_SPOT && fabsf(m->spot_x) <= 0.5f &&
           fabsf(m->spot_y) <= 0.5f && m->spot_radius > 0 && m->spot_radius <= 1 && m->low >= 0 &&
           m->low < m->high && m->high <= 1 && m->min_ev100 <= m->max_ev100 &&
           isfinite(m->min_ev100) && isfinite(m->max_ev100) && isfinite(m->compensation_ev);
}

ag_status metering_check(const ag_log *log, const ag_metering *asked, ag_metering *m)
{
    *m = asked ? *asked : (ag_metering) { 0 };
    if (m->spot_radius == 0)
        m->spot_radius = 0.05f;
    if (m->low == 0 && m->high == 0) {
        m->low = 0.1f;
        m->high = 0.9f;
    }
    if (m->min_ev100 == 0 && m->max_ev100 == 0) {
        m->min_ev100 = METER_FIRST_EV100;
        m->max_ev100 = METER_LAST_EV100;
    }
    return is_sound(m) ? AG_OK
                       : log_fail(log, AG_ERROR_ARGUMENT,
                                  "a metering has a number that is out of its range");
}

static uint32_t shrunk(uint32_t size, uint32_t longer)
{
    uint32_t small = (uint32_t)(((uint64_t)size * SIZE + longer / 2) / longer);
    return size && !small ? 1 : small;
}

ag_render_options metering_picture(const ag_render_options *options)
{
    ag_render_options o = options ? *options : (ag_render_options) { 0 };
    if (!o.width && !o.height)
        o.width = o.height = SIZE;
    uint32_t longer = o.width > o.height ? o.width : o.height;
    o.width = shrunk(o.width, longer);
    o.height = shrunk(o.height, longer);
    o.format = AG_FORMAT_RGBA32F;
    o.exposure = 1.0f / 16; // half floats have 2^-13 to 2^19 nit then
    o.white_balance_k = o.bloom = 0;
    if (o.background == AG_BACKGROUND_COLOR)
        o.background = AG_BACKGROUND_TRANSPARENT;
    o.progress = (ag_progress) { 0 };
    return o;
}

meter_pattern metering_pattern(const ag_metering *m, uint32_t width, uint32_t height)
{
    bool spot = m->meter == AG_METER_SPOT;
    float shorter = (float)(width < height ? width : height);
    return (meter_pattern) { .meter = (uint32_t)m->meter,
                             .x = (0.5f + (spot ? m->spot_x : 0)) * (float)width,
                             .y = (0.5f + (spot ? m->spot_y : 0)) * (float)height,
                             .radius = m->spot_radius * shorter,
                             .shorter = shorter };
}

// ---- What comes of it --------------------------------------------------------------

float metering_ev100(const ag_metering *m, const uint64_t bins[METER_BINS])
{
    double total = 0, before = 0, light = 0, counted = 0;
    for (uint32_t i = 0; i < METER_BINS; i++)
        total += (double)bins[i];
    for (uint32_t i = 0; i < METER_BINS; i++) {
        double after = before + (double)bins[i];
        double from = fmax(before, (double)m->low * total),
               to = fmin(after, (double)m->high * total);
        if (to > from) {
            light += (to - from) * (double)meter_luminance(i);
            counted += to - from;
        }
        before = after;
    }
    float ev = light > 0 ? exposure_metered_ev100((float)(light / counted)) : m->min_ev100;
    return clamp(ev, m->min_ev100, m->max_ev100) - m->compensation_ev;
}

static void count(const float c[4], float scale, float weight, uint64_t bins[METER_BINS])
{
    meter_share s = meter_shares(color_luminance(vec3(c[0], c[1], c[2])) * scale,
                                 weight * clamp(c[3], 0.0f, 1.0f));
    bins[s.bin] += s.here;
    if (s.next)
        bins[s.bin + 1] += s.next;
}

static void count_all(const ag_image *image, float exposure, const meter_pattern *p,
                      uint64_t bins[METER_BINS])
{
    const float *pixels = image->pixels;
    for (uint32_t y = 0; y < image->height; y++)
        for (uint32_t x = 0; x < image->width; x++, pixels += 4)
            count(pixels, 1 / exposure, meter_weight(*p, (float)x + 0.5f, (float)y + 0.5f), bins);
}

ag_status ag_image_meter(const ag_log *log, const ag_image *linear, float exposure,
                         const ag_metering *metering, float *ev100)
{
    ag_metering m;
    uint64_t bins[METER_BINS] = { 0 };
    *ev100 = 0;
    if (linear->format != AG_FORMAT_RGBA32F || !(exposure > 0))
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "only a picture of floats can be metered, of an exposure above 0");
    ag_status status = metering_check(log, metering, &m);
    if (status)
        return status;
    const meter_pattern pattern = metering_pattern(&m, linear->width, linear->height);
    count_all(linear, exposure, &pattern, bins);
    *ev100 = metering_ev100(&m, bins);
    return AG_OK;
}
