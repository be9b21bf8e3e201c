// Which pipeline draws what of a picture.
#ifndef AG_RENDER_VARIANTS_H
#define AG_RENDER_VARIANTS_H

#include "render/frame.h"

// What turns exposed light into the picture: see display.glsl.
uint32_t variants_tone(const ag_render_options *o);
// The part of it that shading does; the rest is left to whoever mixes.
uint32_t variants_tone_early(const picture *p);

// Of surfaces with a material of the scene: PIPELINE_SURFACE or PIPELINE_SHADE.
AG_CHECK ag_status variants_surface(ag_renderer *r, const picture *p, pipeline_kind kind,
                                    uint32_t material, VkPipeline *pipeline);

// Of what is there beside the surfaces: PIPELINE_BODY or _BACKGROUND.
AG_CHECK ag_status variants_beside(ag_renderer *r, const picture *p, pipeline_kind kind,
                                   VkPipeline *pipeline);

// Of a pass over pictures.
AG_CHECK ag_status variants_pass(ag_renderer *r, pipeline_kind kind, VkFormat format, uint32_t tone,
                                 VkPipeline *pipeline);

#endif
