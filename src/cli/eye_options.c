// How bright a picture is to be and what is white in it, as the command line says it.
#include "eye_options.h"

#include "shot_options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- Values --------------------------------------------------------------------

static const char *read_exposure(const char *value, void *field)
{
    exposure_choice *exposure = field;
    *exposure = (exposure_choice) { .automatic = strcmp(value, "auto") == 0 };
    return exposure->automatic ? NULL : value_factor(value, &exposure->factor);
}

static const char *read_aperture(const char *value, void *field)
{
    double number;
    if (value_numbers(value, &number, 1) != 1 || number < 0.1 || number > 1000)
        return "is not an f-number, 0.1 to 1000";
    *(float *)field = (float)number;
    return NULL;
}

// Seconds, or 1/125.
static const char *read_shutter(const char *value, void *field)
{
    double seconds;
    bool part = strncmp(value, "1/", 2) == 0;
    if (value_numbers(value + (part ? 2 : 0), &seconds, 1) != 1)
        return "is not seconds, nor 1/N of one";
    seconds = part ? 1 / seconds : seconds;
    if (!(seconds >= 1e-6 && seconds <= 1e6))
        return "is not between 0.000001 and 1000000 seconds";
    *(float *)field = (float)seconds;
    return NULL;
}

static const char *read_iso(const char *value, void *field)
{
    double number;
    if (value_numbers(value, &number, 1) != 1 || number < 1 || number > 1e7)
        return "is not an ISO speed, 1 to 10000000";
    *(float *)field = (float)number;
    return NULL;
}

static const char *read_metering(const char *value, void *field)
{
    ag_metering *m = field;
    double at[2] = { 0.5, 0.5 };
    if (strcmp(value, "average") == 0)
        m->meter = AG_METER_AVERAGE;
    else if (strcmp(value, "center") == 0)
        m->meter = AG_METER_CENTER;
    else if (strncmp(value, "spot", 4) == 0 && (!value[4] || value[4] == '='))
        m->meter = AG_METER_SPOT;
    else
        return "is not average, center, spot or spot=X,Y";
    if (value[0] == 's' && value[4] && value_numbers(value + 5, at, 2) != 2)
        return "has no place X,Y";
    if (!(at[0] >= 0 && at[0] <= 1 && at[1] >= 0 && at[1] <= 1))
        return "is outside the picture: X from 0, left, to 1, Y from 0, above, to 1";
    m->spot_x = (float)(at[0] - 0.5);
    m->spot_y = (float)(at[1] - 0.5);
    return NULL;
}

static const char *read_limits(const char *value, void *field)
{
    ag_metering *m = field;
    double limits[2];
    if (value_numbers(value, limits, 2) != 2)
        return "is not two EV100, MIN,MAX";
    if (!(limits[0] >= -32 && limits[0] <= limits[1] && limits[1] <= 32))
        return "is not from a lesser to a greater EV100 within -32 to 32";
    if (limits[0] == 0 && limits[1] == 0)
        return "leaves nothing to meter; say --ev100 0";
    m->min_ev100 = (float)limits[0];
    m->max_ev100 = (float)limits[1];
    return NULL;
}

static const char *read_white_balance(const char *value, void *field)
{
    double v[2] = { 0, 0 };
    size_t count = value_numbers(value, v, 2);
    if (count == 0)
        return "is not KELVIN or KELVIN,TINT";
    if (!(v[0] >= 1667 && v[0] <= 25000))
        return "is not between 1667 and 25000 kelvin";
    if (!(v[1] >= -150 && v[1] <= 150))
        return "has a tint outside -150 to 150";
    ((float *)field)[0] = (float)v[0];
    ((float *)field)[1] = (float)v[1];
    return NULL;
}

#define FIELD(member) offsetof(shot_request, eye.member)

const option eye_options[] = {
    { "--exposure", NULL, "auto|FACTOR", "auto",
      "as the light asks for, or a factor on it (the scene's own, else 1)", FIELD(exposure),
      read_exposure, NULL, FIELD(exposure_given) },
    { "--ev100", NULL, "EV", "0", "or as a camera counts it: the factor 1 / (1.2 * 2^EV)",
      FIELD(ev100), value_ev100, NULL, FIELD(ev100_given) },
    { "--aperture", NULL, "F", "16", "or a camera's settings: its f-number", FIELD(aperture),
      read_aperture, NULL, FIELD(camera_given) },
    { "--shutter", NULL, "SECONDS|1/N", "1/125", "how long it is open", FIELD(shutter_s),
      read_shutter, NULL, FIELD(camera_given) },
    { "--iso", NULL, "S", "100", "its sensitivity (100)", FIELD(iso), read_iso, NULL,
      FIELD(camera_given) },
    { "--ev-compensation", NULL, "EV", "1", "so many stops brighter than all that (0)",
      FIELD(metering.compensation_ev), value_ev100, NULL, 0 },
    { "--metering", NULL, "average|center|spot[=X,Y]", "spot=0.5,0.5",
      "what --exposure auto looks at; 0,0 is the upper left (center)", FIELD(metering),
      read_metering, NULL, FIELD(metering_given) },
    { "--exposure-limits", NULL, "MIN,MAX", "2,16", "the EV100 that it keeps to (-10,21.75)",
      FIELD(metering), read_limits, NULL, FIELD(metering_given) },
    { "--white-balance", NULL, "KELVIN[,TINT]", "3200",
      "of the light that is to be white; a tint above 0: greener than that", FIELD(white_balance),
      read_white_balance, NULL, 0 },
    { 0 },
};

// ---- What must not stand together ----------------------------------------------

static bool refuse(const char *sentence)
{
    fprintf(stderr, "argand: %s\n", sentence);
    return false;
}

bool eye_settle(eye_request *e)
{
    if (e->exposure_given + e->ev100_given + e->camera_given > 1)
        return refuse("--exposure, --ev100 and a camera's --aperture, --shutter and --iso say the "
                      "same in three ways; give one of them.");
    if (e->camera_given && !(e->aperture > 0 && e->shutter_s > 0))
        return refuse("--aperture, --shutter and --iso go together; only --iso may be left out.");
    if (e->metering_given && !e->exposure.automatic)
        return refuse("--metering and --exposure-limits say how to meter; add --exposure auto.");
    if (e->camera_given)
        e->ev100 = ag_ev100_from_camera(e->aperture, e->shutter_s, e->iso > 0 ? e->iso : 100);
    if (e->camera_given || e->ev100_given)
        e->exposure.factor = ag_exposure_from_ev100(e->ev100);
    return true;
}
