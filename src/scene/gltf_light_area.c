// EXT_lights_area, a draft: rectangles and disks (docs/ARGAND_lights.md says in which state).
#include "scene/gltf.h"

#include <float.h>
#include <math.h>

ag_status gltf_light_read_area(const gltf_at *light, ag_light_desc *desc)
{
    static const gltf_light_kind kinds[] = { { "rect", AG_LIGHT_RECT },
                                             { "disk", AG_LIGHT_DISK },
                                             { 0 } };
    gltf_at rect;
    float size = 1.0f, aspect = 1.0f;
    ag_status status = gltf_light_read_kind(light, kinds, &desc->kind);
    if (!status)
        status = gltf_float_in(light, "size", 0.0f, FLT_MAX, &size);
    if (!status)
        status = gltf_object(light, "rect", &rect);
    if (!status)
        status = gltf_float_in(&rect, "aspect", 0.0f, FLT_MAX, &aspect);
    if (desc->kind == AG_LIGHT_DISK) {
        desc->radius_m = 0.5f * size;
    } else {
        desc->width_m = fminf(size * aspect, FLT_MAX);
        desc->height_m = size;
    }
    return status;
}
