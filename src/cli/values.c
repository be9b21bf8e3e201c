// Values of options, read strictly.
#include "values.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PIXELS_MOST = 268435456; // 2^28, what ag_image_create allows

static float radians(double degrees)
{
    return (float)(degrees * 3.14159265358979323846 / 180);
}

// A decimal number that fills `length` characters and that a float can hold.  strtod also
// takes blanks, hexadecimal, "inf" and "nan": none of these is meant here.
static bool read_number(const char *text, size_t length, double *number)
{
    char copy[64];
    if (length == 0 || length >= sizeof copy || strspn(text, "0123456789+-.eE") < length)
        return false;
    memcpy(copy, text, length);
    copy[length] = 0;
    char *end;
    *number = strtod(copy, &end);
    return *end == 0 && end != copy && fabs(*number) <= (double)FLT_MAX;
}

static const char *read_alone(const char *value, double *number)
{
    return read_number(value, strlen(value), number) ? NULL : "is not a number";
}

const char *value_text(const char *value, void *field)
{
    *(const char **)field = value;
    return *value ? NULL : "is empty";
}

static bool read_digits(const char *text, size_t length, uint32_t *out)
{
    if (length == 0 || length > 9 || strspn(text, "0123456789") < length)
        return false;
    *out = (uint32_t)strtoul(text, NULL, 10);
    return true;
}

bool value_index(const char *value, uint32_t *index)
{
    return read_digits(value, strlen(value), index);
}

const char *value_whole(const char *value, void *field)
{
    return value_index(value, field) ? NULL : "is not a whole number, 0 to 999999999";
}

const char *value_samples(const char *value, void *field)
{
    uint32_t samples;
    if (!value_index(value, &samples) || samples < 1 || samples > 1 << 24)
        return "is not a whole number, 1 to 16777216";
    *(uint32_t *)field = samples;
    return NULL;
}

const char *value_size(const char *value, void *field)
{
    picture_size size;
    const char *x = strpbrk(value, "xX");
    if (!x || !read_digits(value, (size_t)(x - value), &size.width) ||
        !value_index(x + 1, &size.height))
        return "is not WxH";
    if (size.width == 0 || size.height == 0)
        return "has no pixels";
    if ((double)size.width * size.height > PIXELS_MOST)
        return "has more than 268435456 pixels, as many as 16384x16384";
    *(picture_size *)field = size;
    return NULL;
}

const char *value_degrees(const char *value, void *field)
{
    double degrees;
    const char *complaint = read_alone(value, &degrees);
    if (!complaint)
        *(float *)field = radians(fmod(degrees, 360));
    return complaint;
}

const char *value_fov_degrees(const char *value, void *field)
{
    double degrees;
    const char *complaint = read_alone(value, &degrees);
    if (complaint)
        return complaint;
    if (degrees < 0.01 || degrees > 179)
        return "is not between 0.01 and 179 degrees";
    *(float *)field = radians(degrees);
    return NULL;
}

const char *value_factor(const char *value, void *field)
{
    double factor;
    const char *complaint = read_alone(value, &factor);
    if (complaint)
        return complaint;
    if (factor < 1e-30 || factor > 1e30)
        return "is not a factor above 0 (1e-30 to 1e30)";
    *(float *)field = (float)factor;
    return NULL;
}

const char *value_ev100(const char *value, void *field)
{
    double ev;
    const char *complaint = read_alone(value, &ev);
    if (complaint)
        return complaint;
    if (ev < -32 || ev > 32)
        return "is not between -32 and 32";
    *(float *)field = (float)ev;
    return NULL;
}

const char *value_share(const char *value, void *field)
{
    double share;
    const char *complaint = read_alone(value, &share);
    if (complaint)
        return complaint;
    if (!(share >= 0 && share <= 1))
        return "is not a share of 0 to 1";
    *(float *)field = (float)share;
    return NULL;
}

const char *value_seconds(const char *value, void *field)
{
    double seconds;
    const char *complaint = read_alone(value, &seconds);
    if (complaint)
        return complaint;
    if (seconds < 1e-3 || seconds > 1e7)
        return "is not between 0.001 and 1e7 seconds";
    *(float *)field = (float)seconds;
    return NULL;
}

const char *value_noise(const char *value, void *field)
{
    double noise;
    const char *complaint = read_alone(value, &noise);
    if (complaint)
        return complaint;
    if (noise < 1e-5 || noise >= 1)
        return "is no relative error: at least 0.00001 and below 1 (0.01 is 1 %)";
    *(float *)field = (float)noise;
    return NULL;
}

const char *value_at_least_0(const char *value, void *field)
{
    double number;
    const char *complaint = read_alone(value, &number);
    if (complaint)
        return complaint;
    if (number < 0)
        return "is below 0";
    *(float *)field = (float)number;
    return NULL;
}

const char *value_cone_degrees(const char *value, void *field)
{
    double degrees;
    const char *complaint = read_alone(value, &degrees);
    if (complaint)
        return complaint;
    if (degrees < 0 || degrees > 90)
        return "is not between 0 and 90 degrees";
    *(float *)field = radians(degrees);
    return NULL;
}

const char *value_sun_degrees(const char *value, void *field)
{
    double degrees;
    const char *complaint = read_alone(value, &degrees);
    if (complaint)
        return complaint;
    if (degrees < 1e-6 || degrees > 89.99)
        return "is not between 0.000001 and 89.99 degrees";
    *(float *)field = radians(degrees);
    return NULL;
}

size_t value_numbers(const char *value, double *numbers, size_t most)
{
    for (size_t count = 0; count < most; count++) {
        size_t length = strcspn(value, ",");
        if (!read_number(value, length, &numbers[count]))
            return 0;
        if (!value[length])
            return count + 1;
        value += length + 1;
    }
    return 0;
}

const char *value_vector(const char *value, void *field)
{
    double v[3];
    if (value_numbers(value, v, 3) != 3)
        return "is not three numbers X,Y,Z";
    for (int i = 0; i < 3; i++)
        ((float *)field)[i] = (float)v[i];
    return NULL;
}

static bool all_zero(const float v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

const char *value_direction(const char *value, void *field)
{
    const char *complaint = value_vector(value, field);
    return !complaint && all_zero(field) ? "has no direction" : complaint;
}

const char *value_weights(const char *value, void *field)
{
    const float *v = field;
    if (value_vector(value, field))
        return "is not three weights R,G,B";
    return v[0] < 0 || v[1] < 0 || v[2] < 0 ? "has a weight below 0" : NULL;
}

const char *value_color_weights(const char *value, void *field)
{
    const char *complaint = value_weights(value, field);
    return !complaint && all_zero(field) ? "is black; intensity=0 makes a light dark" : complaint;
}

const char *value_terms(const char *value, void *field)
{
    double v[27];
    size_t count = value_numbers(value, v, 27), channels = count % 12 && count != 27 ? 1 : 3;
    if (count != 4 && count != 9 && count != 12 && count != 27)
        return "is not 4, 9, 12 or 27 numbers";
    for (size_t i = 0; i < count / channels; i++)
        for (size_t c = 0; c < 3; c++)
            ((float(*)[3])field)[i][c] = (float)v[channels == 3 ? 3 * i + c : i];
    return NULL;
}

// Three numbers with commas between, "auto" -> NAN.
static bool read_three(const char *value, double three[3])
{
    for (int i = 0; i < 3; i++) {
        size_t length = strcspn(value, ",");
        if ((value[length] == ',') != (i < 2))
            return false;
        if (length == 4 && memcmp(value, "auto", 4) == 0)
            three[i] = (double)NAN;
        else if (!read_number(value, length, &three[i]))
            return false;
        value += length + 1;
    }
    return true;
}

const char *value_orbit(const char *value, void *field)
{
    double v[3];
    if (!read_three(value, v))
        return "is not THETA,PHI,RADIUS, three numbers or auto";
    if (v[1] < 0 || v[1] > 180)
        return "has a PHI outside 0 (above) to 180 (below) degrees";
    if (v[2] < 0)
        return "has a RADIUS below 0 metres";
    float *out = field;
    out[0] = radians(fmod(v[0], 360));
    out[1] = radians(v[1]);
    out[2] = (float)v[2];
    return NULL;
}

const char *value_target(const char *value, void *field)
{
    double v[3];
    if (!read_three(value, v))
        return "is not X,Y,Z in metres, three numbers or auto";
    for (int i = 0; i < 3; i++)
        ((float *)field)[i] = (float)v[i];
    return NULL;
}

bool value_color(const char *value, float color[3])
{
    value += *value == '#'; // a shell may have eaten it
    if (strlen(value) != 6 || strspn(value, "0123456789abcdefABCDEF") != 6)
        return false;
    unsigned long rgb = strtoul(value, NULL, 16);
    for (int i = 0; i < 3; i++)
        color[i] = (float)(rgb >> (16 - 8 * i) & 0xff) / 255.0f;
    return true;
}
