// The shaders of shaders/passes/, compiled into the library.
#ifndef AG_RENDER_SHADERS_H
#define AG_RENDER_SHADERS_H

#include "gpu/pipeline.h"

gpu_shader shader_surface_vert(void);
gpu_shader shader_surface_frag(void);
gpu_shader shader_cutout_frag(void);
gpu_shader shader_body_vert(void);
gpu_shader shader_body_frag(void);
gpu_shader shader_fullscreen_vert(void);
gpu_shader shader_background_frag(void);
gpu_shader shader_accumulate_frag(void);
gpu_shader shader_resolve_frag(void);
gpu_shader shader_layer_vert(void);
gpu_shader shader_layer_frag(void);
gpu_shader shader_shade_comp(void);
gpu_shader shader_meter_comp(void);

#endif
