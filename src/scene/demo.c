// The list of built-in scenes.
#include "scene/demo.h"

#include "base/log.h"

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
};
enum { DEMOS = sizeof demos / sizeof *demos };

bool ag_scene_demo(size_t index, const char **name, const char **about)
{
    if (index >= DEMOS)
        return false;
    *name = demos[index].name;
    *about = demos[index].about;
    return true;
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

ag_status ag_scene_load_demo(ag_scene *scene, const char *name)
{
    for (size_t i = 0; i < DEMOS; i++) {
        if (strcmp(name, demos[i].name) != 0)
            continue;
        scene_mark mark = scene_mark_now(scene);
        stage s = { .scene = scene };
        demos[i].build(&s);
        if (s.status != AG_OK)
            scene_rollback(scene, mark);
        return s.status;
    }
    return unknown(scene, name);
}
