// argand info: what is in a file.
#include "commands.h"
#include "console.h"
#include "json.h"
#include "lights.h"
#include "text.h"
#include "values.h"

#include <stdio.h>
#include <string.h>

typedef struct info_request {
    const char *input;
    bool json;
} info_request;

static const option options[] = {
    { "--json", NULL, NULL, "", "print one JSON object", offsetof(info_request, json), NULL, NULL,
      0 },
    { 0 },
};

static ag_status load(const char *input, const ag_log *log, ag_scene **scene)
{
    ag_status status = ag_scene_create(log, scene);
    if (status)
        return status;
    if (strncmp(input, "demo:", 5) == 0)
        return ag_scene_load_demo(*scene, input + 5, AG_LOOK_TEXT);
    return ag_scene_load(*scene, input, NULL);
}

static void line(const char *what, unsigned long long count)
{
    char digits[32];
    printf("  %-11s %s\n", what, text_count(count, digits));
}

static void print_cameras(const ag_scene *scene)
{
    ag_camera_desc camera;
    for (size_t i = 0; ag_scene_camera(scene, i, &camera); i++)
        printf("  camera %zu: %s, %s\n", i, camera.name ? camera.name : "without a name",
               camera.height_m > 0 ? "orthographic" : "perspective");
}

static void print_sizes(const ag_light_desc *l)
{
    const struct {
        const char *name;
        float metres;
    } sizes[] = { { "radius", l->radius_m },
                  { "width", l->width_m },
                  { "height", l->height_m },
                  { "length", l->length_m } };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        if (sizes[i].metres > 0)
            printf(", %s %g m", sizes[i].name, (double)sizes[i].metres);
}

static void print_lights(const ag_scene *scene)
{
    ag_light_desc l;
    for (size_t i = 0; ag_scene_light(scene, i, &l); i++) {
        printf("  light %zu: %s, %g %s", i, light_kind_word(l.kind), (double)l.intensity,
               light_unit(l.kind));
        print_sizes(&l);
        puts(l.hidden ? ", hidden" : "");
    }
    if (ag_scene_exposure(scene) != 1)
        printf("  exposure    %g\n", (double)ag_scene_exposure(scene));
}

static void print_extensions(const ag_scene *scene)
{
    ag_extension_info e;
    for (size_t i = 0; ag_scene_extension(scene, i, &e); i++)
        printf("  extension %s%s: %s\n", e.name, e.required ? " (required)" : "",
               e.supported ? "supported" : "not supported, ignored");
}

static void print_text(const char *input, const ag_scene *scene)
{
    ag_scene_summary s = ag_scene_summarize(scene);
    printf("%s\n", input);
    line("meshes", s.meshes);
    line("instances", s.instances);
    line("triangles", s.triangles);
    line("vertices", s.vertices);
    line("materials", s.materials);
    line("textures", s.textures);
    line("lights", s.lights);
    line("cameras", s.cameras);
    const float *a = s.bounds_min, *b = s.bounds_max;
    printf("  bounds      %g %g %g to %g %g %g m\n", (double)a[0], (double)a[1], (double)a[2],
           (double)b[0], (double)b[1], (double)b[2]);
    printf("  read in     %.1f ms, of which textures %.1f ms\n", s.load_ms + s.decode_ms,
           s.decode_ms);
    print_lights(scene);
    print_cameras(scene);
    print_extensions(scene);
}

static void json_point(json *j, const char *key, const float point[3])
{
    json_open(j, key, '[');
    for (int i = 0; i < 3; i++)
        json_real(j, NULL, (double)point[i]);
    json_close(j, ']');
}

static void json_counts(json *j, const ag_scene_summary *s)
{
    json_count(j, "meshes", s->meshes);
    json_count(j, "instances", s->instances);
    json_count(j, "triangles", s->triangles);
    json_count(j, "vertices", s->vertices);
    json_count(j, "materials", s->materials);
    json_count(j, "textures", s->textures);
    json_point(j, "bounds_min", s->bounds_min);
    json_point(j, "bounds_max", s->bounds_max);
    json_open(j, "ms", '{');
    json_real(j, "load", s->load_ms);
    json_real(j, "decode", s->decode_ms);
    json_close(j, '}');
}

static void json_cameras(json *j, const ag_scene *scene)
{
    ag_camera_desc camera;
    json_open(j, "cameras", '[');
    for (size_t i = 0; ag_scene_camera(scene, i, &camera); i++) {
        json_open(j, NULL, '{');
        json_text(j, "name", camera.name);
        json_text(j, "kind", camera.height_m > 0 ? "orthographic" : "perspective");
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void json_lights(json *j, const ag_scene *scene)
{
    ag_light_desc l;
    json_open(j, "lights", '[');
    for (size_t i = 0; ag_scene_light(scene, i, &l); i++) {
        json_open(j, NULL, '{');
        json_text(j, "kind", light_kind_word(l.kind));
        json_real(j, "intensity", (double)l.intensity);
        json_text(j, "unit", light_unit(l.kind));
        json_point(j, "color", l.color);
        json_point(j, "position", l.position);
        json_point(j, "direction", l.direction);
        json_real(j, "radius", (double)l.radius_m);
        json_real(j, "width", (double)l.width_m);
        json_real(j, "height", (double)l.height_m);
        json_real(j, "length", (double)l.length_m);
        json_bool(j, "hidden", l.hidden);
        json_close(j, '}');
    }
    json_close(j, ']');
    json_real(j, "exposure", (double)ag_scene_exposure(scene));
}

static void json_extensions(json *j, const ag_scene *scene)
{
    ag_extension_info e;
    json_open(j, "extensions", '[');
    for (size_t i = 0; ag_scene_extension(scene, i, &e); i++) {
        json_open(j, NULL, '{');
        json_text(j, "name", e.name);
        json_bool(j, "required", e.required);
        json_bool(j, "supported", e.supported);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void print_json(const char *input, const ag_scene *scene, const console *said)
{
    ag_scene_summary s = ag_scene_summarize(scene);
    json j = { .file = stdout };
    json_open(&j, NULL, '{');
    json_text(&j, "input", input);
    json_counts(&j, &s);
    json_lights(&j, scene);
    json_cameras(&j, scene);
    json_extensions(&j, scene);
    json_open(&j, "warnings", '[');
    for (size_t i = 0; i < said->kept_count; i++)
        json_text(&j, NULL, said->kept[i].text);
    json_close(&j, ']');
    json_close(&j, '}');
}

static exit_code show(const info_request *request)
{
    console loading, shown;
    console_init(&loading, AG_LOG_WARNING, true);
    console_init(&shown, AG_LOG_WARNING, false);
    ag_log log = console_log(&loading);
    ag_scene *scene = NULL;
    ag_status status = load(request->input, &log, &scene);
    if (!status && request->json)
        print_json(request->input, scene, &loading);
    else if (!status)
        print_text(request->input, scene);
    fflush(stdout);
    if (status || !request->json)
        console_replay(&loading, &shown); // what was skipped or mended, below the list
    ag_scene_destroy(scene);
    console_finish(&loading);
    console_finish(&shown);
    return status ? EXIT_FAILED : EXIT_DONE;
}

static exit_code run(int argc, char **argv)
{
    info_request request = { 0 };
    option_set set = {
        .command = &command_info,
        .fields = &request,
        .operands = &request.input,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return EXIT_USAGE;
    if (set.help) {
        help_command(&command_info);
        return EXIT_DONE;
    }
    if (!request.input) {
        fputs("argand: info: which file? Try: argand info model.glb\n", stderr);
        return EXIT_USAGE;
    }
    return show(&request);
}

const command command_info = {
    .name = "info",
    .operands = "FILE|demo:NAME",
    .about = "tell what is in a file: meshes, materials, lights, cameras, extensions",
    .lesson = "Triangles and vertices are counted as drawn, summed over the instances.  What the\n"
              "file has and Argand does not support is named.\n",
    .options = { options },
    .examples = "  argand info helmet.glb\n"
                "  argand info helmet.glb --json\n",
    .run = run,
};
