// Surfaces in a white furnace: under a sky of radiance 1 each returns its albedo.
#include "stage.h"

#include "scene/scene.h"
#include "trace/bsdf.h"

// ---- Patches of a plane, all seen from one direction -------------------------------------

// Each is PIXELS wide and high in the picture; the filter reaches 1.5 px beyond a pixel's middle.
enum { PIXELS = 6, COLUMNS = 24, EDGE = 1 };

static ag_camera_desc camera_over(int rows, float NoV)
{
    float slope = sqrtf(1 - NoV * NoV), x = COLUMNS / 2.0f, z = -(float)rows / NoV / 2;
    return (ag_camera_desc) {
        .position = { x, 200 * NoV, z + 200 * slope },
        .target = { x, 0, z },
        .height_m = (float)rows,
    };
}

// Of the patches, aslant to the eye; the bitangents are cross(normal, tangent).
static const float tangent[4] = { 0.92106099f, 0, 0.38941834f, 1 };

static void lay(ag_scene *scene, size_t index, float NoV, const ag_material_desc *material)
{
    float x = (float)(index % COLUMNS), z = -(float)(index / COLUMNS) / NoV;
    float positions[4][3], normals[4][3], tangents[4][4];
    static const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < 4; i++) {
        const float at[3] = { x + (i == 1 || i == 2), 0, z - (i >= 2 ? 1 / NoV : 0) };
        memcpy(positions[i], at, sizeof at);
        memcpy(normals[i], (float[3]) { 0, 1, 0 }, sizeof normals[i]);
        memcpy(tangents[i], tangent, sizeof tangent);
    }
    const ag_mesh_desc desc = { .positions = &positions[0][0],
                                .normals = &normals[0][0],
                                .tangents = &tangents[0][0],
                                .vertex_count = 4,
                                .indices = indices,
                                .index_count = 6 };
    ag_mesh patch;
    OK(ag_scene_add_mesh(scene, &desc, &patch));
    stage_show(scene, patch, material, NULL);
}

static estimate seen(const ag_image *image, size_t index, int channel)
{
    uint32_t left = (uint32_t)(index % COLUMNS) * PIXELS;
    uint32_t bottom = ag_image_height(image) - (uint32_t)(index / COLUMNS) * PIXELS;
    return stage_estimate_in(image, channel, left + EDGE, bottom - PIXELS + EDGE,
                             left + PIXELS - EDGE, bottom - EDGE);
}

typedef struct pictures {
    ag_image *light, *albedo;
} pictures;

static pictures trace_patches(const ag_scene *scene, size_t count, float NoV, uint32_t samples)
{
    uint32_t rows = (uint32_t)((count + COLUMNS - 1) / COLUMNS);
    const ag_camera_desc camera = camera_over((int)rows, NoV);
    const ag_render_options picture = stage_linear(COLUMNS * PIXELS, rows * PIXELS);
    const ag_reference_options options = { .seed = 9, .keep_aovs = true };
    ag_reference *reference = stage_traced(scene, &camera, &picture, &options, samples);
    pictures p;
    OK(ag_reference_picture(reference, &p.light));
    OK(ag_reference_aov(reference, AG_AOV_ALBEDO, &p.albedo));
    ag_reference_destroy(reference);
    return p;
}

static void drop(pictures p)
{
    ag_image_destroy(p.light);
    ag_image_destroy(p.albedo);
}

// ---- All models ----------------------------------------------------------------------------

enum { MODELS = 3 * 3 * 2 * 3 * 4 * 2 };

static ag_material_desc model(unsigned i)
{
    static const float roughness[] = { 0.05f, 0.15f, 0.4f, 0.7f, 1 };
    static const float metallic[] = { 0, 1, 0.5f };
    ag_material_desc m = ag_material_default();
    unsigned choice = i;
    m.diffuse = (ag_diffuse)(choice % 3), choice /= 3;
    unsigned lobe = choice % 3;
    choice /= 3;
    m.shadowing = (ag_shadowing)(choice % 2), choice /= 2;
    m.fresnel = (ag_fresnel)(choice % 3), choice /= 3;
    m.layering = (ag_layering)(choice % 4), choice /= 4;
    m.single_bounce = choice % 2;
    m.distribution = lobe == 2 ? AG_DISTRIBUTION_BLINN : AG_DISTRIBUTION_GGX;
    m.anisotropy = lobe == 1 ? 0.6f : 0;
    m.anisotropy_rotation_rad = 0.7f;
    m.shininess = 30;
    m.diffuse_roughness = 0.8f;
    m.reflectiveness = 0.4f;
    // Spread over the models by numbers that share no factor with theirs.
    m.roughness = roughness[i * 7 % 5];
    m.metallic = metallic[i * 11 % 7 % 3];
    memcpy(m.base_color, (float[4]) { 1, 0.7f, 0.4f, 1 }, sizeof m.base_color);
    for (int c = 0; c < 3; c++) {
        m.conductor_n[c] = 0.2f + 0.5f * (float)c;
        m.conductor_k[c] = 3 - 0.5f * (float)c;
        m.f82_tint[c] = 0.7f;
    }
    return m;
}

// The material as paths have it, on a patch.
static place place_of(const ag_material_desc *d)
{
    float c = cosf(d->anisotropy_rotation_rad), s = sinf(d->anisotropy_rotation_rad);
    float x = tangent[0], z = tangent[2];
    return (place) {
        .normal = { 0, 1, 0 },
        .material = {
            .base_color = { d->base_color[0], d->base_color[1], d->base_color[2] },
            .metallic = d->metallic,
            .roughness = d->roughness,
            .dielectric_f0 = 0.04f,
            .specular_color = { 1, 1, 1 },
            .specular = 1,
            .model = material_model(d),
            .diffuse_roughness = d->diffuse_roughness,
            .shininess = d->shininess,
            .anisotropy = d->anisotropy,
            .tangent = { c * x + s * z, 0, c * z - s * x },
            .conductor_n = { d->conductor_n[0], d->conductor_n[1], d->conductor_n[2] },
            .conductor_k = { d->conductor_k[0], d->conductor_k[1], d->conductor_k[2] },
            .f82_tint = { d->f82_tint[0], d->f82_tint[1], d->f82_tint[2] },
            .reflectiveness = d->reflectiveness,
        },
    };
}

enum { NODES = 64 };

// The lobe by half vectors of evenly spread GGX slopes, the base by directions even in the squared
// sine.  BRDF times cosine is the shader's; the sum over directions is not.
static vec3 integrated(const surface *s, vec3 x, vec3 wo)
{
    vec3 n = { 0, 1, 0 }, y = cross(n, x), sum = { 0, 0, 0 };
    bool round = (s->model & SURFACE_DISTRIBUTION) != SURFACE_ANISOTROPIC;
    float ax = sqrtf(s->a2), ay = round ? ax : sqrtf(s->a2_across);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            float u = ((float)i + 0.5f) / NODES, phi = 2 * PI * ((float)k + 0.5f) / NODES;
            float r = sqrtf(u), z = sqrtf(1 - u), c = cosf(phi), t = sinf(phi);
            vec3 wi = r * c * x + r * t * y + z * n;
            sum += surface_direct_parts(*s, n, wo, wi).base * (PI / z);
            vec3 h = ax * r * c * x + ay * r * t * y + z * n;
            float size = sqrtf(dot(h, h)), cosine = z / size, VoH = dot(wo, h) / size;
            wi = (2 * VoH / size) * h - wo;
            if (!(VoH > 0 && wi[1] > 0))
                continue;
            // 1/sr of h: the slopes' density over cosine^3; 4 VoH of it for wi.
            float density = z * z * z * z / (PI * ax * ay * cosine * cosine * cosine);
            sum += surface_direct_parts(*s, n, wo, wi).lobe * (4 * VoH / density);
        }
    return sum / (NODES * NODES);
}

// The energy-conserving ones, whose albedo is that of the table.
static bool has_table(const ag_material_desc *m)
{
    return m->layering == AG_LAYERING_ALBEDO && m->distribution == AG_DISTRIBUTION_GGX &&
           m->shadowing == AG_SHADOWING_SMITH && m->fresnel == AG_FRESNEL_SCHLICK;
}

static void assert_models(float NoV)
{
    ag_scene *scene = stage_dark();
    albedo_table *table = malloc(sizeof *table);
    const vec3 wo = { 0, NoV, sqrtf(1 - NoV * NoV) };
    double off[2] = { 0, 0 };
    albedo_init(table);
    stage_surround(scene, 1);
    for (unsigned i = 0; i < MODELS; i++) {
        const ag_material_desc m = model(i);
        lay(scene, i, NoV, &m);
    }
    pictures p = trace_patches(scene, MODELS, NoV, 32);
    for (unsigned i = 0; i < MODELS; i++) {
        const ag_material_desc m = model(i);
        const place at = place_of(&m);
        bsdf b = bsdf_at(table, &at, wo);
        // Karis 2013, eq. 4: what Schlick's shadowing is under image light.
        b.s.schlick_k = m.roughness * m.roughness / 2;
        vec3 wanted = integrated(&b.s, at.material.tangent, wo);
        for (int c = 0; c < 3; c += 2) {
            estimate e = seen(p.light, i, c);
            char what[80];
            snprintf(what, sizeof what, "model %#x, roughness %g, metallic %g, NoV %g", b.s.model,
                     (double)m.roughness, (double)m.metallic, (double)NoV);
            off[c / 2] += (e.mean - (double)wanted[c]) / MODELS;
            e.error *= 1.5; // one in so many is farther off than four
            assert_agrees(what, e, (double)wanted[c], 0.004);
            // Schlick's shadowing is too weak at grazing angles with the sky's k.
            double most = m.shadowing == AG_SHADOWING_SMITH ? 1.005 : 1.17;
            if (m.layering == AG_LAYERING_ALBEDO && m.distribution == AG_DISTRIBUTION_GGX)
                assert_true(e.mean <= most + 4 * e.error);
            if (has_table(&m))
                assert_agrees(what, e, seen(p.albedo, i, c).mean, 0.01);
        }
    }
    assert_agrees("all models", ((estimate) { off[0], 0 }), 0, 0.001);
    assert_agrees("all models", ((estimate) { off[1], 0 }), 0, 0.001);
    drop(p);
    free(table);
    ag_scene_destroy(scene);
}

static void models_return_their_albedo(void **state)
{
    (void)state;
    assert_models(0.9f);
    assert_models(0.5f);
    assert_models(0.15f);
}

// ---- White ones --------------------------------------------------------------------------------

// Smooth to rough: metal, brushed metal, gloss over Lambert's base and over EON's.
static ag_material_desc white(unsigned i)
{
    static const float roughness[] = { 0.05f, 0.1f, 0.2f, 0.3f, 0.5f, 0.7f, 0.85f, 1 };
    ag_material_desc m = ag_material_default();
    m.roughness = roughness[i % 8];
    m.metallic = i < 16;
    m.anisotropy = i / 8 == 1 ? 0.7f : 0;
    m.anisotropy_rotation_rad = 0.3f;
    m.diffuse = i / 8 == 3 ? AG_DIFFUSE_EON : AG_DIFFUSE_LAMBERT;
    m.diffuse_roughness = 1;
    return m;
}

static void white_is_not_seen(void **state)
{
    (void)state;
    static const float views[] = { 0.98f, 0.5f, 0.2f, 0.06f };
    for (int k = 0; k < 4; k++) {
        ag_scene *scene = stage_dark();
        stage_surround(scene, 1);
        for (unsigned i = 0; i < 32; i++) {
            const ag_material_desc m = white(i);
            lay(scene, i, views[k], &m);
        }
        pictures p = trace_patches(scene, 32, views[k], 256);
        for (unsigned i = 0; i < 32; i++) {
            estimate e = seen(p.light, i, 1);
            char what[60];
            snprintf(what, sizeof what, "white surface %u, NoV %g", i, (double)views[k]);
            assert_agrees(what, e, 1, 0.01);
        }
        drop(p);
        ag_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_return_their_albedo),
        cmocka_unit_test(white_is_not_seen),
    };
    return cmocka_run_group_tests_name("furnace", tests, NULL, NULL);
}
