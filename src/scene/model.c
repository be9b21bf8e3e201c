// A material's choices as the physics knows them.
#include "physics/surface.glsl"

#include "scene/scene.h"

static uint32_t fresnel_of(const ag_material_desc *d)
{
    if (d->metallic == 0)
        return SURFACE_SCHLICK;
    if (d->fresnel == AG_FRESNEL_CONDUCTOR)
        return SURFACE_CONDUCTOR;
    bool untinted = d->f82_tint[0] == 1 && d->f82_tint[1] == 1 && d->f82_tint[2] == 1;
    return d->fresnel == AG_FRESNEL_F82 && !untinted ? SURFACE_F82 : SURFACE_SCHLICK;
}

// Choices that change nothing are not made: variants are dear.
uint32_t material_model(const ag_material_desc *d)
{
    static const uint32_t diffuse[] = { SURFACE_LAMBERT, SURFACE_OREN_NAYAR, SURFACE_EON };
    static const uint32_t layering[] = { SURFACE_LAYERED_BY_ALBEDO, SURFACE_LAYERED_BY_F,
                                         SURFACE_LAYERED_AS_GLTF, SURFACE_BLENDED };
    uint32_t model = layering[d->layering];
    if (d->diffuse_roughness > 0)
        model |= diffuse[d->diffuse];
    if (d->distribution == AG_DISTRIBUTION_BLINN)
        return (model & ~SURFACE_LAYERING) | SURFACE_BLINN |
               (d->layering == AG_LAYERING_BLEND ? SURFACE_BLENDED : SURFACE_LAYERED_BY_ALBEDO);
    model |= d->anisotropy > 0 ? SURFACE_ANISOTROPIC : SURFACE_GGX;
    model |= d->shadowing == AG_SHADOWING_SCHLICK ? SURFACE_SCHLICK_GGX : SURFACE_SMITH;
    model |= d->single_bounce ? SURFACE_SINGLE_BOUNCE : 0;
    return model | fresnel_of(d);
}
