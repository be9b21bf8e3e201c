// The options that commands with pictures share: their tables, and what must not stand together.
#include "shot_options.h"

#include "text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const choice tonemaps[] = {
    { "none", AG_TONEMAP_NONE },
    { "reinhard", AG_TONEMAP_REINHARD },
    { "aces", AG_TONEMAP_ACES },
    { "aces-narkowicz", AG_TONEMAP_ACES_NARKOWICZ },
    { "neutral", AG_TONEMAP_NEUTRAL },
    { "agx", AG_TONEMAP_AGX },
    { NULL, 0 },
};

static const choice transfers[] = {
    { "srgb", AG_TRANSFER_SRGB },
    { "gamma2.2", AG_TRANSFER_GAMMA_22 },
    { NULL, 0 },
};

static const choice area_lights[] = {
    { "exact", AG_AREA_LIGHTS_EXACT },
    { "ltc", AG_AREA_LIGHTS_LTC },
    { "representative-point", AG_AREA_LIGHTS_REPRESENTATIVE_POINT },
    { NULL, 0 },
};

static const choice qualities[] = {
    { "fast", AG_QUALITY_FAST },
    { "default", AG_QUALITY_DEFAULT },
    { "best", AG_QUALITY_BEST },
    { NULL, 0 },
};

static const char *read_background(const char *value, void *field)
{
    background_choice *background = field;
    if (strcmp(value, "env") == 0)
        background->kind = AG_BACKGROUND_ENVIRONMENT;
    else if (strcmp(value, "transparent") == 0)
        background->kind = AG_BACKGROUND_TRANSPARENT;
    else if (value_color(value, background->color))
        background->kind = AG_BACKGROUND_COLOR;
    else
        return "is not env, transparent or a colour #rrggbb";
    return NULL;
}

static const char *read_environment(const char *value, void *field)
{
    environment_choice *environment = field;
    *environment = (environment_choice) { 0 };
    if (strcmp(value, "studio") == 0)
        environment->kind = AG_ENVIRONMENT_STUDIO;
    else if (strcmp(value, "sky") == 0)
        environment->kind = AG_ENVIRONMENT_SKY;
    else if (strcmp(value, "none") == 0)
        environment->kind = AG_ENVIRONMENT_NONE;
    else if (!strpbrk(value, "./") && access(value, F_OK) != 0)
        return "is neither studio, sky or none nor a file";
    else
        *environment = (environment_choice) { AG_ENVIRONMENT_IMAGE, value };
    return NULL;
}

#define FIELD(member) offsetof(shot_request, member)

const option shot_scene_options[] = {
    { "--env", NULL, "FILE|studio|sky|none", "studio",
      "what lights the scene: .hdr or .exr, or a procedural one (studio)", FIELD(environment),
      read_environment, NULL, FIELD(environment_given) },
    { "--env-rotation", NULL, "DEGREES", "90", "turn it about +Y, counter-clockwise from above",
      FIELD(environment_rotation_rad), value_degrees, NULL, FIELD(environment_given) },
    { "--env-intensity", NULL, "FACTOR", "1.5", "make it brighter or darker (1)",
      FIELD(environment_intensity), value_factor, NULL, FIELD(environment_given) },
    { "--light", NULL, "'KIND KEY=VALUE ...'", "sphere at=0,2,1 radius=0.1 intensity=100",
      "add a light, once for each; see below", FIELD(lights), lights_read, NULL, 0 },
    { "--correct", NULL, NULL, "", "a built-in scene in Argand's look, not that of its text",
      FIELD(correct), NULL, NULL, 0 },
    { "--quiet", "-q", NULL, "", "print errors only", FIELD(quiet), NULL, NULL, 0 },
    { "--verbose", "-v", NULL, "", "say what is chosen and done", FIELD(verbose), NULL, NULL, 0 },
    { 0 },
};

const option shot_options[] = {
    { "--size", NULL, "WxH", "1024x1024",
      "width and height in pixels (1024x1024; of view 1280x720)", FIELD(size), value_size, NULL,
      0 },
    { "--camera", NULL, "NAME|INDEX", "0", "a camera of the file; the first is 0", FIELD(camera),
      value_text, NULL, 0 },
    { "--orbit", NULL, "THETA,PHI,R", "35,70,auto",
      "degrees from +Z towards +X, degrees from +Y, metres; auto for any", FIELD(orbit),
      value_orbit, NULL, FIELD(orbit_given) },
    { "--target", NULL, "X,Y,Z", "0,1,0", "what the camera looks at, in metres; auto for any",
      FIELD(target), value_target, NULL, FIELD(target_given) },
    { "--fov", NULL, "DEGREES", "45", "vertical field of view (45)", FIELD(fov_rad),
      value_fov_degrees, NULL, 0 },
    { "--background", NULL, "env|transparent|#rrggbb", "#ffffff", "what is behind it all (env)",
      FIELD(background), read_background, NULL, 0 },
    { "--bloom", NULL, "SHARE", "0.2", "of the light, scattered as in the eye; 0.2 is an eye's (0)",
      FIELD(bloom), value_share, NULL, 0 },
    { "--tonemap", NULL, "CURVE", "neutral",
      "none, reinhard, aces, aces-narkowicz, neutral or agx (neutral)", FIELD(tonemap), NULL,
      tonemaps, FIELD(tonemap_given) },
    { "--transfer", NULL, "srgb|gamma2.2", "srgb", "how light is coded in 8 bits (srgb)",
      FIELD(transfer), NULL, transfers, FIELD(transfer_given) },
    { "--json", NULL, NULL, "", "print one JSON object: sizes, milliseconds, memory and more",
      FIELD(json), NULL, NULL, 0 },
    { 0 },
};

const option shot_device_options[] = {
    { "--area-lights", NULL, "METHOD", "ltc",
      "highlights: exact, ltc or representative-point (exact)", FIELD(area_lights), NULL,
      area_lights, 0 },
    { "--quality", NULL, "LEVEL", "best", "fast, default or best (default)", FIELD(quality), NULL,
      qualities, 0 },
    { "--device", NULL, "auto|cpu|INDEX|NAME", "cpu",
      "what computes; `argand devices` lists them (auto)", FIELD(device), value_text, NULL, 0 },
    { "--validate", NULL, NULL, "", "watch the use of Vulkan; a message fails the command",
      FIELD(validate), NULL, NULL, 0 },
    { 0 },
};

static bool refuse(const char *sentence)
{
    fprintf(stderr, "argand: %s\n", sentence);
    return false;
}

static bool known_demo(const char *name)
{
    const char *names[64], *about;
    size_t count = 0;
    while (count < 64 && ag_scene_demo(count, &names[count], &about)) {
        if (strcmp(names[count], name) == 0)
            return true;
        count++;
    }
    const char *near = text_nearest(name, names, count);
    fprintf(stderr, "argand: demo:%s: there is no such built-in scene; ", name);
    if (near)
        fprintf(stderr, "did you mean demo:%s?\n", near);
    else
        fputs("`argand demo` lists them.\n", stderr);
    return false;
}

static bool can_be_corrected(const char *input)
{
    ag_render_options unused;
    if (strncmp(input, "demo:", 5) == 0 && ag_demo_look(input + 5, &unused))
        return true;
    fprintf(stderr,
            "argand: %s: comes from no text whose look --correct could replace; leave it out.\n",
            input);
    return false;
}

// What each option alone cannot know.
static bool sound(const shot_request *r)
{
    if (r->camera && (r->orbit_given || r->target_given))
        return refuse("--camera takes a camera of the file; --orbit and --target place one: give "
                      "one or the other.");
    if (r->quiet && r->verbose)
        return refuse("--quiet and --verbose contradict each other; give one of them.");
    if (strncmp(r->input, "demo:", 5) == 0 && !known_demo(r->input + 5))
        return false;
    return !r->correct || can_be_corrected(r->input);
}

shot_request shot_request_default(void)
{
    return (shot_request) {
        .size = { 1024, 1024 },
        .orbit = { NAN, NAN, NAN },
        .target = { NAN, NAN, NAN },
        .environment_intensity = 1,
        .device = "auto",
    };
}

bool shot_request_settle(shot_request *r, const char *command, bool writes)
{
    if (!r->input || (writes && !r->output)) {
        fprintf(stderr,
                r->input ? "argand: %s: where should the picture go? Add: -o picture.png\n"
                         : "argand: %s: which file? Try: argand %s model.glb%s\n",
                command, command, writes ? " -o picture.png" : "");
        return false;
    }
    return eye_settle(&r->eye) && sound(r);
}

ag_log_level shot_log_level(const shot_request *r)
{
    return r->verbose ? AG_LOG_DEBUG : r->quiet ? AG_LOG_ERROR : AG_LOG_WARNING;
}
