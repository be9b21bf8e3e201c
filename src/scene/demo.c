// The list of built-in scenes.
#include "scene/demo.h"

#include "base/log.h"

#include <argand/renderer.h>

#include <stdio.h>
#include <string.h>

static const struct demo {
    const char *name, *about;
    void (*build)(stage *s);
} demos[] = {
    { "spheres", "metals and plastics from smooth to rough in the studio", demo_spheres },
    { "grid", "49 spheres, metallic by roughness, under 4 point lights", demo_grid },
    { "materials", "metals, dielectrics, a normal map, emission, cut-outs and glass panes",
      demo_materials },
    { "furnace", "white spheres in a white world, where they should vanish", demo_furnace },
    { "lights", "a point, a spot and a directional light on a floor", demo_lights },
    { "million", "98 spheres of together one million triangles", demo_million },
    { "nodes", "10,000 boxes", demo_nodes },
    { "specular", "the text on specular lighting: textured shapes, 30 spheres, 7 point lights",
      demo_specular },
    { "sphere-lights", "the text on sphere lights: the same under lamps with a size",
      demo_sphere_lights },
    { "sun", "the text on distant sphere lights: balls under a sun of the real one's size",
      demo_sun },
    { "sun-large", "the same under a sun of 21 times that radius", demo_sun_large },
    { "ambient-oren-nayar", "the text on ambient lighting: Oren-Nayar and constant light",
      demo_ambient_oren_nayar },
    { "ambient-hemispheric", "the same text: Lambert and light from sky and ground",
      demo_ambient_hemispheric },
    { "ambient-sh-blinn", "the same text: Blinn, four lights and spherical harmonics",
      demo_ambient_sh_blinn },
    { "metals", "every metal by name, in the order of ag_metal", demo_metals },
    { "terrace", "a grey card, a table and a person, without light: for light in real units",
      demo_terrace },
};
enum { DEMOS = sizeof demos / sizeof *demos };

// Of the texts that some of them come from.
static const struct look {
    const char *demo;
    ag_tonemap tonemap;
    ag_transfer transfer;
} looks[] = {
    { "grid", AG_TONEMAP_REINHARD, AG_TRANSFER_GAMMA_22 },
    { "specular", AG_TONEMAP_ACES_NARKOWICZ, AG_TRANSFER_SRGB },
    { "sphere-lights", AG_TONEMAP_ACES_NARKOWICZ, AG_TRANSFER_SRGB },
    { "sun", AG_TONEMAP_ACES_NARKOWICZ, AG_TRANSFER_SRGB },
    { "sun-large", AG_TONEMAP_ACES_NARKOWICZ, AG_TRANSFER_SRGB },
    { "metals", AG_TONEMAP_ACES_NARKOWICZ, AG_TRANSFER_SRGB },
    { "ambient-oren-nayar", AG_TONEMAP_NONE, AG_TRANSFER_SRGB },
    { "ambient-hemispheric", AG_TONEMAP_NONE, AG_TRANSFER_SRGB },
    { "ambient-sh-blinn", AG_TONEMAP_NONE, AG_TRANSFER_SRGB },
};
enum { LOOKS = sizeof looks / sizeof *looks };

bool ag_scene_demo(size_t index, const char **name, const char **about)
{
    if (index >= DEMOS)
        return false;
    *name = demos[index].name;
    *about = demos[index].about;
    return true;
}

bool ag_demo_look(const char *name, ag_render_options *options)
{
    for (size_t i = 0; i < LOOKS; i++)
        if (strcmp(name, looks[i].demo) == 0) {
            options->tonemap = looks[i].tonemap;
            options->transfer = looks[i].transfer;
            return true;
        }
    return false;
}

static ag_status unknown(const ag_scene *scene, const char *name)
{
    char list[256] = "";
    for (size_t i = 0; i < DEMOS; i++) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", demos[i].name);
    }
    return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                    "There is no built-in scene \"%s\"; there are: %s.", name, list);
}

ag_status ag_scene_load_demo(ag_scene *scene, const char *name, ag_look look)
{
    for (size_t i = 0; i < DEMOS; i++) {
        if (strcmp(name, demos[i].name) != 0)
            continue;
        scene_mark mark = scene_mark_now(scene);
        stage s = { .scene = scene, .look = look };
        demos[i].build(&s);
        if (s.status != AG_OK)
            scene_rollback(scene, mark);
        return s.status;
    }
    return unknown(scene, name);
}
