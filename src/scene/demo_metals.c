// Every metal by name, in rows from the upper left, in the order of ag_metal.
#include "scene/demo.h"

#include <argand/metal.h>

static const float pi = 3.14159265359f;

// As the text on specular lighting has its three: Schlick's curve from the reflectance at normal
// incidence, single bounces.
static ag_material paint(stage *s, ag_metal metal)
{
    ag_material_desc desc = ag_material_metal(metal, 0.25f);
    if (s->look == AG_LOOK_TEXT) {
        desc.fresnel = AG_FRESNEL_SCHLICK;
        desc.layering = AG_LAYERING_BLEND;
        desc.reflectiveness = 1.0f;
        desc.single_bounce = true;
    }
    return stage_material(s, desc);
}

void demo_metals(stage *s)
{
    enum { COLUMNS = 5 };
    size_t count = 0;
    const char *name, *source;
    while (ag_metal_info(count, &name, &source))
        count++;
    ag_mesh ball = stage_sphere(s, 0.45f, 96, 60);
    for (size_t i = 0; i < count; i++) {
        size_t row = i / COLUMNS, left = count - row * COLUMNS;
        float across = left < COLUMNS ? (float)left : COLUMNS;
        vec3 at = { (float)(i % COLUMNS) - 0.5f * (across - 1.0f), -(float)row, 0 };
        stage_show(s, ball, paint(s, (ag_metal)i), at);
    }
    stage_environment(s, AG_ENVIRONMENT_STUDIO);
    stage_camera(s, 0.0f, 0.5f * pi, 0.45f);
}
