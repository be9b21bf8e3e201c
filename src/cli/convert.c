// argand convert: a scene with its lights and surroundings as a file.
#include "commands.h"
#include "output.h"
#include "shot.h"
#include "text.h"

#include <stdio.h>

static const option options[] = {
    { "--output", "-o", "FILE", "scene.glb", "where the scene goes: .glb",
      offsetof(shot_request, output), value_text, NULL, 0 },
    { 0 },
};

static void print_report(const shot_request *request, const ag_scene *scene)
{
    ag_scene_summary s = ag_scene_summarize(scene);
    char triangles[32], textures[32], lights[32];
    if (!request->quiet)
        printf("%s: %s triangles, %s textures, %s lights\n", request->output,
               text_count(s.triangles, triangles), text_count(s.textures, textures),
               text_count(s.lights, lights));
}

static ag_status convert(const shot_request *request, console *c)
{
    shot s;
    ag_status status = shot_open(&s, request, c);
    if (!status)
        status = output_save_scene(c, s.scene, request->output);
    console_clear(c);
    if (!status)
        print_report(request, s.scene);
    shot_finish(&s);
    return status;
}

// False after one sentence; `*help` says that help was asked for instead.
static bool parse(shot_request *request, int argc, char **argv, bool *help)
{
    *request = shot_request_default();
    option_set set = {
        .command = &command_convert,
        .fields = request,
        .operands = &request->input,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return false;
    *help = set.help;
    if (set.help)
        return true;
    if (request->input && request->output)
        return shot_request_settle(request, "convert", true);
    fputs(request->input ? "argand: convert: where should the scene go? Add: -o scene.glb\n"
                         : "argand: convert: which file? Try: argand convert model.gltf -o "
                           "scene.glb\n",
          stderr);
    return false;
}

static exit_code run(int argc, char **argv)
{
    shot_request request;
    bool help;
    if (!parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_convert);
        return EXIT_DONE;
    }
    console c;
    console_init(&c, shot_log_level(&request), false);
    if (!request.quiet)
        console_allow_bar(&c);
    output_verdict verdict = output_check_scene(&c, request.output);
    ag_status status = verdict == OUTPUT_FINE ? convert(&request, &c) : AG_OK;
    console_finish(&c);
    if (verdict == OUTPUT_UNKNOWN_KIND)
        return EXIT_USAGE;
    return verdict == OUTPUT_FINE && !status ? EXIT_DONE : EXIT_FAILED;
}

const command command_convert = {
    .name = "convert",
    .operands = "FILE|demo:NAME -o SCENE",
    .about = "write a scene with lights and surroundings of its own as one .glb",
    .lesson = "What is seen is kept: meshes in their pose, materials, textures as PNG, lights,\n"
              "cameras, environment and exposure.  What glTF has no word for stands in extensions\n"
              "of Argand's own, which other programs leave out.  The file appears whole or not\n"
              "at all.\n",
    .options = { options, shot_scene_options },
    .more = lights_lesson,
    .examples = "  argand convert chair/chair.gltf -o chair.glb\n"
                "      A model and its files as one file.\n"
                "  argand convert chair.glb -o lit.glb --env workshop.hdr \\\n"
                "      --light 'sphere at=1,2,1 radius=0.2 intensity=20'\n"
                "      With a lamp, and the light of a photographed place, inside the file.\n"
                "  argand convert demo:sphere-lights -o lights.glb\n"
                "      A built-in scene, to look into.\n",
    .run = run,
};
