// The shaders of shaders/passes/, compiled into the library.
#include "render/shaders.h"

static const uint32_t surface_vert[] =
#include "surface.vert.inc"
    ;
static const uint32_t surface_frag[] =
#include "surface.frag.inc"
    ;
static const uint32_t cutout_frag[] =
#include "cutout.frag.inc"
    ;
static const uint32_t body_vert[] =
#include "body.vert.inc"
    ;
static const uint32_t body_frag[] =
#include "body.frag.inc"
    ;
static const uint32_t fullscreen_vert[] =
#include "fullscreen.vert.inc"
    ;
static const uint32_t background_frag[] =
#include "background.frag.inc"
    ;
static const uint32_t accumulate_frag[] =
#include "accumulate.frag.inc"
    ;
static const uint32_t resolve_frag[] =
#include "resolve.frag.inc"
    ;
static const uint32_t layer_vert[] =
#include "layer.vert.inc"
    ;
static const uint32_t layer_frag[] =
#include "layer.frag.inc"
    ;
static const uint32_t shade_comp[] =
#include "shade.comp.inc"
    ;
static const uint32_t meter_comp[] =
#include "meter.comp.inc"
    ;

gpu_shader shader_surface_vert(void)
{
    return (gpu_shader) { surface_vert, sizeof surface_vert };
}

gpu_shader shader_surface_frag(void)
{
    return (gpu_shader) { surface_frag, sizeof surface_frag };
}

gpu_shader shader_cutout_frag(void)
{
    return (gpu_shader) { cutout_frag, sizeof cutout_frag };
}

gpu_shader shader_body_vert(void)
{
    return (gpu_shader) { body_vert, sizeof body_vert };
}

gpu_shader shader_body_frag(void)
{
    return (gpu_shader) { body_frag, sizeof body_frag };
}

gpu_shader shader_fullscreen_vert(void)
{
    return (gpu_shader) { fullscreen_vert, sizeof fullscreen_vert };
}

gpu_shader shader_background_frag(void)
{
    return (gpu_shader) { background_frag, sizeof background_frag };
}

gpu_shader shader_accumulate_frag(void)
{
    return (gpu_shader) { accumulate_frag, sizeof accumulate_frag };
}

gpu_shader shader_resolve_frag(void)
{
    return (gpu_shader) { resolve_frag, sizeof resolve_frag };
}

gpu_shader shader_layer_vert(void)
{
    return (gpu_shader) { layer_vert, sizeof layer_vert };
}

gpu_shader shader_layer_frag(void)
{
    return (gpu_shader) { layer_frag, sizeof layer_frag };
}

gpu_shader shader_shade_comp(void)
{
    return (gpu_shader) { shade_comp, sizeof shade_comp };
}

gpu_shader shader_meter_comp(void)
{
    return (gpu_shader) { meter_comp, sizeof meter_comp };
}
