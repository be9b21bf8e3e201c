// The materials of a scene on the device: a descriptor set each.
#ifndef AG_RENDER_MATERIALS_H
#define AG_RENDER_MATERIALS_H

#include "render/bindings.h"
#include "render/textures.h"

#include "interop/scene.glsl"

typedef struct materials {
    gpu_buffer uniforms; // gpu_material, one a material of the scene
    VkDescriptorPool pool;
    VkDescriptorSet *sets;
    gpu_surface_constants *constants; // materials_classify()
} materials;

AG_CHECK ag_status materials_create(gpu_device *device, const bindings *b, const ag_scene *scene,
                                    textures *t, materials *m);
void materials_destroy(gpu_device *device, materials *m); // zero is allowed

// What the shader has to do for each material of a scene; `constants` has room for one
// each, and what depends on the frame is left zero.
//
// Every variant costs a CPU device tens of milliseconds of compilation, so materials
// share them: within one alpha mode all textured ones do what any of them needs (an
// absent texture is one that changes nothing), and the untextured ones are another variant.
void materials_classify(const ag_scene *scene, gpu_surface_constants *constants);

#endif
