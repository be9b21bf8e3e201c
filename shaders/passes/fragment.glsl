// Surfaces, shaded as they are drawn.  CUTOUT: with holes where alpha is below the cutoff.
#include "passes/surface.glsl"

layout(constant_id = 7) const uint SAMPLES = 4u;

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uvs;
layout(location = 4) in vec4 in_color;

layout(location = 0) out vec4 out_color; // premultiplied

#ifdef CUTOUT
// The step at the cutoff is made one pixel wide and covers as many of the pixel's samples,
// so that multisampling smooths it.
void cover(float alpha)
{
    float share = clamp((alpha - material.alpha_cutoff) / max(fwidth(alpha), 1e-4) + 0.5, 0.0, 1.0);
    uint covered = uint(share * float(SAMPLES) + 0.5);
    if (covered == 0u)
        discard;
    gl_SampleMask[0] = int((1u << covered) - 1u);
}
#endif

void main()
{
    here = place(in_position, in_normal, in_tangent, in_uvs, in_color, gl_FrontFacing,
                 gl_FragCoord.xy);
    vec4 base = base_here();
#ifdef CUTOUT
    cover(base.a);
#endif
    out_color = color_here(base);
}
