// Metals by name, from measured indices of refraction.
//
// Threads: all functions are pure; call them from anywhere.
#ifndef ARGAND_METAL_H
#define ARGAND_METAL_H

#include <argand/base.h>
#include <argand/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ag_metal {
    AG_METAL_ALUMINIUM = 0,
    AG_METAL_BRASS, // 70 % copper, 30 % zinc
    AG_METAL_CHROMIUM,
    AG_METAL_COBALT,
    AG_METAL_COPPER,
    AG_METAL_GOLD,
    AG_METAL_IRON,
    AG_METAL_NICKEL,
    AG_METAL_PALLADIUM,
    AG_METAL_PLATINUM,
    AG_METAL_SILVER,
    AG_METAL_TITANIUM,
    AG_METAL_TUNGSTEN,
} ag_metal;

// A clean, unoxidised metal of perceptual roughness [0, 1]: metallic 1, base_color its
// reflectance, AG_FRESNEL_F82 with its tint at 82 degrees; the rest as ag_material_default().
// Both are the exact Fresnel reflectance integrated from 380 to 780 nm under D65 with the CIE
// 1931 colour matching functions to linear Rec. 709, and clamped to [0, 1]; a perfect mirror is
// white.  A metal that is not listed is aluminium.
AG_API ag_material_desc ag_material_metal(ag_metal metal, float roughness);

// Name ("gold") and source of the measurement of metal `index`; false past the last.  The
// strings are static.
AG_API bool ag_metal_info(size_t index, const char **name, const char **source);

// The metal of that name, "aluminum" too; false, and `metal` as it was, if there is none.
AG_API bool ag_metal_by_name(const char *name, ag_metal *metal);

#ifdef __cplusplus
}
#endif
#endif
