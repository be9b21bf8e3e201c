// Metals: measured spectra, and the colour that they make.
#include <argand/metal.h>

#include "physics/fresnel.glsl"

#include <string.h>

// The wavelengths of Johnson & Christy's tables in the visible range, nm.  The metals of others
// are interpolated between the wavelengths of their sources.
enum { WAVELENGTHS = 14 };
static const float wavelengths[WAVELENGTHS] = { 381.5f, 397.4f, 413.3f, 430.5f, 450.9f,
                                                471.4f, 495.9f, 520.9f, 548.6f, 582.1f,
                                                616.8f, 659.5f, 704.5f, 756.0f };

typedef struct metal_spectrum {
    const char *name, *source;
    float n[WAVELENGTHS], k[WAVELENGTHS]; // index of refraction, extinction coefficient
} metal_spectrum;

// docs/physics.md, "Metals", has the sources in full.
static const metal_spectrum metals[] = {
    [AG_METAL_ALUMINIUM] = { "aluminium",
                             "Rakic 1995",
                             { 0.441f, 0.481f, 0.521f, 0.572f, 0.636f, 0.709f, 0.798f, 0.892f,
                               1.009f, 1.169f, 1.35f, 1.624f, 1.958f, 2.427f },
                             { 4.605f, 4.803f, 5.001f, 5.215f, 5.465f, 5.712f, 6, 6.291f, 6.611f,
                               6.988f, 7.371f, 7.8f, 8.175f, 8.435f } },
    [AG_METAL_BRASS] = { "brass",
                         "Querry 1985, 70 % copper",
                         { 1.485f, 1.452f, 1.387f, 1.274f, 1.085f, 0.888f, 0.71f, 0.599f, 0.53f,
                           0.466f, 0.45f, 0.445f, 0.447f, 0.458f },
                         { 1.817f, 1.807f, 1.791f, 1.785f, 1.834f, 1.969f, 2.207f, 2.473f, 2.751f,
                           3.08f, 3.406f, 3.774f, 4.142f, 4.548f } },
    [AG_METAL_CHROMIUM] = { "chromium",
                            "Johnson & Christy 1974",
                            { 1.92f, 2, 2.08f, 2.19f, 2.33f, 2.51f, 2.75f, 2.94f, 3.18f, 3.22f,
                              3.17f, 3.09f, 3.05f, 3.08f },
                            { 2.74f, 2.83f, 2.93f, 3.04f, 3.14f, 3.24f, 3.3f, 3.33f, 3.33f, 3.3f,
                              3.3f, 3.34f, 3.39f, 3.42f } },
    [AG_METAL_COBALT] = { "cobalt",
                          "Johnson & Christy 1974",
                          { 1.53f, 1.57f, 1.61f, 1.67f, 1.74f, 1.81f, 1.88f, 1.97f, 2.05f, 2.13f,
                            2.19f, 2.25f, 2.31f, 2.4f },
                          { 2.82f, 2.93f, 3.05f, 3.17f, 3.28f, 3.41f, 3.55f, 3.68f, 3.82f, 3.96f,
                            4.11f, 4.27f, 4.45f, 4.64f } },
    [AG_METAL_COPPER] = { "copper",
                          "Johnson & Christy 1972",
                          { 1.33f, 1.32f, 1.28f, 1.25f, 1.24f, 1.25f, 1.22f, 1.18f, 1.02f, 0.7f,
                            0.3f, 0.22f, 0.21f, 0.24f },
                          { 2.045f, 2.116f, 2.207f, 2.305f, 2.397f, 2.483f, 2.564f, 2.608f, 2.577f,
                            2.704f, 3.205f, 3.747f, 4.205f, 4.665f } },
    [AG_METAL_GOLD] = { "gold",
                        "Johnson & Christy 1972",
                        { 1.46f, 1.47f, 1.46f, 1.45f, 1.38f, 1.31f, 1.04f, 0.62f, 0.43f, 0.29f,
                          0.21f, 0.14f, 0.13f, 0.14f },
                        { 1.933f, 1.952f, 1.958f, 1.948f, 1.914f, 1.849f, 1.833f, 2.081f, 2.455f,
                          2.863f, 3.272f, 3.697f, 4.103f, 4.542f } },
    [AG_METAL_IRON] = { "iron",
                        "Johnson & Christy 1974",
                        { 2.12f, 2.24f, 2.35f, 2.48f, 2.59f, 2.67f, 2.74f, 2.86f, 2.95f, 2.94f,
                          2.88f, 2.92f, 2.86f, 2.87f },
                        { 2.5f, 2.58f, 2.65f, 2.71f, 2.77f, 2.82f, 2.88f, 2.91f, 2.93f, 2.99f,
                          3.05f, 3.1f, 3.19f, 3.28f } },
    [AG_METAL_NICKEL] = { "nickel",
                          "Johnson & Christy 1974",
                          { 1.72f, 1.72f, 1.7f, 1.71f, 1.73f, 1.78f, 1.82f, 1.85f, 1.92f, 1.96f,
                            1.99f, 1.99f, 2.06f, 2.13f },
                          { 2.48f, 2.57f, 2.69f, 2.82f, 2.95f, 3.09f, 3.25f, 3.42f, 3.61f, 3.8f,
                            4.02f, 4.26f, 4.5f, 4.73f } },
    [AG_METAL_PALLADIUM] = { "palladium",
                             "Johnson & Christy 1974",
                             { 1.26f, 1.3f, 1.33f, 1.37f, 1.41f, 1.46f, 1.52f, 1.57f, 1.64f, 1.68f,
                               1.75f, 1.8f, 1.86f, 1.95f },
                             { 2.83f, 2.93f, 3.03f, 3.14f, 3.26f, 3.39f, 3.54f, 3.68f, 3.84f, 4.02f,
                               4.21f, 4.42f, 4.65f, 4.89f } },
    [AG_METAL_PLATINUM] = { "platinum",
                            "Rakic et al. 1998",
                            { 1.682f, 1.722f, 1.761f, 1.801f, 1.847f, 1.894f, 1.95f, 2.01f, 2.081f,
                              2.172f, 2.274f, 2.406f, 2.55f, 2.717f },
                            { 2.738f, 2.832f, 2.925f, 3.024f, 3.142f, 3.26f, 3.402f, 3.547f, 3.707f,
                              3.898f, 4.089f, 4.314f, 4.537f, 4.774f } },
    [AG_METAL_SILVER] = { "silver",
                          "Johnson & Christy 1972",
                          { 0.05f, 0.05f, 0.05f, 0.04f, 0.04f, 0.05f, 0.05f, 0.05f, 0.06f, 0.05f,
                            0.06f, 0.05f, 0.04f, 0.03f },
                          { 1.864f, 2.07f, 2.275f, 2.462f, 2.657f, 2.869f, 3.093f, 3.324f, 3.586f,
                            3.858f, 4.152f, 4.483f, 4.838f, 5.242f } },
    [AG_METAL_TITANIUM] = { "titanium",
                            "Johnson & Christy 1974",
                            { 1.99f, 2.08f, 2.14f, 2.21f, 2.27f, 2.32f, 2.36f, 2.44f, 2.54f, 2.6f,
                              2.67f, 2.76f, 2.86f, 3 },
                            { 2.93f, 2.95f, 2.98f, 3.01f, 3.04f, 3.1f, 3.19f, 3.3f, 3.43f, 3.58f,
                              3.72f, 3.84f, 3.96f, 4.01f } },
    [AG_METAL_TUNGSTEN] = { "tungsten",
                            "Weaver et al. 1975",
                            { 3.459f, 3.418f, 3.375f, 3.335f, 3.315f, 3.336f, 3.391f, 3.463f,
                              3.521f, 3.537f, 3.59f, 3.705f, 3.877f, 3.853f },
                            { 2.534f, 2.428f, 2.419f, 2.452f, 2.52f, 2.597f, 2.671f, 2.708f, 2.739f,
                              2.816f, 2.89f, 2.942f, 2.872f, 2.781f } },
};
enum { METALS = sizeof metals / sizeof metals[0] };

// Relative power of CIE standard illuminant D65 at 380, 390 ... 780 nm.
static const float d65[] = {
    49.9755f, 54.6482f, 82.7549f, 91.486f,  93.4318f, 86.6823f, 104.865f, 117.008f, 117.812f,
    114.861f, 115.923f, 108.811f, 109.354f, 107.802f, 104.79f,  107.689f, 104.405f, 104.046f,
    100,      96.3342f, 95.788f,  88.6856f, 90.0062f, 89.5991f, 87.6987f, 83.2886f, 83.6992f,
    80.0268f, 80.2146f, 82.2778f, 78.2842f, 69.7213f, 71.6091f, 74.349f,  61.604f,  69.8856f,
    75.087f,  63.5927f, 46.4182f, 66.8054f, 63.3828f,
};

static float lobe(float nm, float height, float middle, float below, float above)
{
    float t = (nm - middle) * (nm < middle ? below : above);
    return height * expf(-0.5f * t * t);
}

// The CIE 1931 2 degree colour matching functions.  Wyman, Sloan & Shirley 2013, eq. 4.
static vec3 matching(float nm)
{
    return vec3(
        lobe(nm, 1.056f, 599.8f, 0.0264f, 0.0323f) + lobe(nm, 0.362f, 442.0f, 0.0624f, 0.0374f) -
            lobe(nm, 0.065f, 501.1f, 0.0490f, 0.0382f),
        lobe(nm, 0.821f, 568.8f, 0.0213f, 0.0247f) + lobe(nm, 0.286f, 530.9f, 0.0613f, 0.0322f),
        lobe(nm, 1.217f, 437.0f, 0.0845f, 0.0278f) + lobe(nm, 0.681f, 459.0f, 0.0385f, 0.0725f));
}

// IEC 61966-2-1.
static vec3 rgb_from_xyz(vec3 c)
{
    return vec3(3.2404542f * c[0] - 1.5371385f * c[1] - 0.4985314f * c[2],
                -0.9692660f * c[0] + 1.8760108f * c[1] + 0.0415560f * c[2],
                0.0556434f * c[0] - 0.2040259f * c[1] + 1.0572252f * c[2]);
}

static float at_wavelength(const float values[WAVELENGTHS], float nm)
{
    int i = 0;
    while (i < WAVELENGTHS - 2 && nm > wavelengths[i + 1])
        i++;
    float t = (nm - wavelengths[i]) / (wavelengths[i + 1] - wavelengths[i]);
    return mix(values[i], values[i + 1], clamp(t, 0, 1));
}

// Linear Rec. 709 of what the metal reflects of D65, the cosine of incidence being c.
static vec3 reflectance(const metal_spectrum *metal, float c)
{
    enum { STEPS = 80 };
    vec3 sum = vec3(0, 0, 0), white = vec3(0, 0, 0);
    for (int i = 0; i <= STEPS; i++) {
        float nm = 380 + 5 * (float)i;
        float power = i % 2 ? 0.5f * (d65[i / 2] + d65[i / 2 + 1]) : d65[i / 2];
        vec3 weight = power * rgb_from_xyz(matching(nm));
        white += weight;
        sum +=
            weight * fresnel_conductor(c, at_wavelength(metal->n, nm), at_wavelength(metal->k, nm));
    }
    return sum / white;
}

ag_material_desc ag_material_metal(ag_metal metal, float roughness)
{
    const metal_spectrum *spectrum = &metals[(unsigned)metal < METALS ? metal : 0];
    ag_material_desc desc = ag_material_default();
    vec3 f0 = clamp(reflectance(spectrum, 1), 0, 1);
    vec3 tint = clamp(reflectance(spectrum, 1.0f / 7) / fresnel_schlick(f0, 1, 1.0f / 7), 0, 1);
    for (int i = 0; i < 3; i++) {
        desc.base_color[i] = f0[i];
        desc.f82_tint[i] = tint[i];
    }
    desc.fresnel = AG_FRESNEL_F82;
    desc.roughness = roughness;
    return desc;
}

bool ag_metal_info(size_t index, const char **name, const char **source)
{
    if (index >= METALS)
        return false;
    *name = metals[index].name;
    *source = metals[index].source;
    return true;
}

bool ag_metal_by_name(const char *name, ag_metal *metal)
{
    for (size_t i = 0; i < METALS; i++)
        if (strcmp(name, metals[i].name) == 0) {
            *metal = (ag_metal)i;
            return true;
        }
    if (strcmp(name, "aluminum") != 0)
        return false;
    *metal = AG_METAL_ALUMINIUM;
    return true;
}
