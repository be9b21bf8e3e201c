// Materials, textures, samplers, images and extensions.
#include "gltf_kit.h"

#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Behind the triangle's 36 bytes stand three PNG files of 1x1: red, green, blue.
typedef struct textured {
    uint8_t bytes[4096];
    size_t offsets[4], size; // of the files; the end
} textured;

static textured make_textured(const kit *k)
{
    textured t = { .offsets = { 36 } };
    memcpy(t.bytes, kit_triangle, 36);
    for (int i = 0; i < 3; i++) {
        uint8_t pixel[4] = { 0, 0, 0, 255 };
        pixel[i] = 255;
        ag_image_desc desc = { 1, 1, AG_FORMAT_RGBA8, pixel };
        ag_image *image;
        assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
        assert_int_equal(ag_image_save(NULL, image, kit_path(k, "pixel.png"), NULL), AG_OK);
        ag_image_destroy(image);
        FILE *file = fopen(kit_path(k, "pixel.png"), "rb");
        size_t read = fread(t.bytes + t.offsets[i], 1, sizeof t.bytes - t.offsets[i], file);
        fclose(file);
        t.offsets[i + 1] = t.offsets[i] + read;
    }
    t.size = t.offsets[3];
    return t;
}

// Textures 0, 1, 2 are red, green and blue.
static const char *textured_json(const textured *t, const char *material, const char *more)
{
    const size_t *o = t->offsets;
    return kit_json(
        "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
        "'buffers':[{'byteLength':%zu}],'bufferViews':[{'buffer':0,'byteLength':36},"
        "{'buffer':0,'byteOffset':%zu,'byteLength':%zu},"
        "{'buffer':0,'byteOffset':%zu,'byteLength':%zu},"
        "{'buffer':0,'byteOffset':%zu,'byteLength':%zu}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
        "'images':[{'bufferView':1,'mimeType':'image/png'},{'bufferView':2},{'bufferView':3}],"
        "'textures':[{'source':0},{'source':1},{'source':2,'sampler':0}],"
        "'samplers':[{'wrapS':33071,'wrapT':33648,'magFilter':9728,'minFilter':9985}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}],"
        "'materials':[{%s}]%s}",
        t->size, o[0], o[1] - o[0], o[1], o[2] - o[1], o[2], o[3] - o[2], material, more);
}

static const ag_material_desc *load(kit *k, const char *material, unsigned warnings)
{
    textured t = make_textured(k);
    kit_loads(k, textured_json(&t, material, ""), t.bytes, t.size, warnings);
    assert_int_equal(k->scene->instances[0].material, 1);
    return &k->scene->materials[1];
}

// The channel (0 red, 1 green, 2 blue) of the image that a use shows; -1 = none.
static int color_of(const kit *k, const ag_texture_use *use)
{
    if (!use->texture.id)
        return -1;
    const ag_image *image = k->scene->textures[use->texture.id - 1].image;
    const uint8_t *pixel = ag_image_pixels(image);
    return pixel[0] ? 0 : pixel[1] ? 1 : 2;
}

static void defaults(void **state)
{
    kit *k = *state;
    const ag_material_desc *m = load(k, "", 0);
    for (int i = 0; i < 4; i++)
        kit_near(m->base_color[i], 1, 0);
    kit_near(m->metallic, 1, 0);
    kit_near(m->roughness, 1, 0);
    kit_near(m->emissive[0] + m->emissive[1] + m->emissive[2], 0, 0);
    kit_near(m->normal_scale, 1, 0);
    kit_near(m->occlusion_strength, 1, 0);
    kit_near(m->ior, 1.5, 0);
    kit_near(m->specular, 1, 0);
    kit_near(m->specular_color[1], 1, 0);
    assert_int_equal(m->alpha_mode, AG_ALPHA_OPAQUE);
    kit_near(m->alpha_cutoff, 0.5, 0);
    assert_false(m->double_sided || m->unlit);
    assert_int_equal(color_of(k, &m->base_color_texture), -1);
    assert_int_equal(k->scene->images_count, 0); // none in use: none decoded
}

static void core(void **state)
{
    kit *k = *state;
    const ag_material_desc *m = load(
        k,
        "'pbrMetallicRoughness':{'baseColorFactor':[0.1,0.2,0.3,0.4],'metallicFactor':0.5,"
        "'roughnessFactor':0.25,'baseColorTexture':{'index':0},"
        "'metallicRoughnessTexture':{'index':1,'texCoord':1}},"
        "'normalTexture':{'index':2,'scale':-2},'occlusionTexture':{'index':1,'strength':0.75},"
        "'emissiveTexture':{'index':0},'emissiveFactor':[0.5,0.25,1],"
        "'alphaMode':'MASK','alphaCutoff':0.125,'doubleSided':true",
        0);
    for (int i = 0; i < 4; i++)
        kit_near(m->base_color[i], 0.1 * (i + 1), 1e-7);
    kit_near(m->metallic, 0.5, 0);
    kit_near(m->roughness, 0.25, 0);
    kit_near(m->normal_scale, -2, 0);
    kit_near(m->occlusion_strength, 0.75, 0);
    kit_near(m->emissive[1], 0.25, 0);
    kit_near(m->alpha_cutoff, 0.125, 0);
    assert_int_equal(m->alpha_mode, AG_ALPHA_MASK);
    assert_true(m->double_sided);
    assert_false(m->unlit);
    assert_int_equal(color_of(k, &m->base_color_texture), 0);
    assert_int_equal(color_of(k, &m->metallic_roughness_texture), 1);
    assert_int_equal(m->metallic_roughness_texture.uv_set, 1);
    assert_int_equal(color_of(k, &m->normal_texture), 2);
    assert_int_equal(color_of(k, &m->occlusion_texture), 1);
    assert_int_equal(color_of(k, &m->emissive_texture), 0);
    assert_int_equal(color_of(k, &m->specular_texture), -1);
    assert_int_equal(k->scene->images_count, 3);
    assert_int_equal(load(k, "'alphaMode':'BLEND'", 0)->alpha_mode, AG_ALPHA_BLEND);
}

static void extensions(void **state)
{
    kit *k = *state;
    const ag_material_desc *m =
        load(k,
             "'emissiveFactor':[0.5,1,0.25],'extensions':{'KHR_materials_unlit':{},"
             "'KHR_materials_emissive_strength':{'emissiveStrength':8},"
             "'KHR_materials_ior':{'ior':1.25},'KHR_materials_specular':{'specularFactor':0.5,"
             "'specularColorFactor':[1,2,3],'specularTexture':{'index':1},"
             "'specularColorTexture':{'index':2}}}",
             0);
    assert_true(m->unlit);
    kit_near(m->emissive[0], 4, 0);
    kit_near(m->emissive[1], 8, 0);
    kit_near(m->ior, 1.25, 0);
    kit_near(m->specular, 0.5, 0);
    kit_near(m->specular_color[2], 3, 0);
    assert_int_equal(color_of(k, &m->specular_texture), 1);
    assert_int_equal(color_of(k, &m->specular_color_texture), 2);
    kit_near(load(k, "'extensions':{'KHR_materials_ior':{'ior':0}}", 0)->ior, 0, 0);
}

static void anisotropy(void **state)
{
    kit *k = *state;
    const ag_material_desc *m =
        load(k,
             "'extensions':{'KHR_materials_anisotropy':{'anisotropyStrength':0.5,"
             "'anisotropyRotation':1.25}}",
             0);
    kit_near(m->anisotropy, 0.5, 0);
    kit_near(m->anisotropy_rotation_rad, 1.25, 0);
    m = load(k,
             "'extensions':{'KHR_materials_anisotropy':{'anisotropyStrength':3,"
             "'anisotropyTexture':{'index':0}}}",
             2);
    kit_near(m->anisotropy, 1, 0);
    assert_non_null(strstr(k->said, "anisotropyTexture is not supported"));
}

static void texture_transform(void **state)
{
    kit *k = *state;
    const ag_texture_use *use =
        &load(k,
              "'emissiveTexture':{'index':0,'texCoord':0,'extensions':{'KHR_texture_transform':"
              "{'offset':[0.5,-1],'rotation':1.5,'scale':[2,-3],'texCoord':1}}}",
              0)
             ->emissive_texture;
    kit_near(use->offset[0], 0.5, 0);
    kit_near(use->offset[1], -1, 0);
    kit_near(use->rotation_rad, 1.5, 0);
    kit_near(use->scale[0], 2, 0);
    kit_near(use->scale[1], -3, 0);
    assert_int_equal(use->uv_set, 1);
}

static void third_uv_set(void **state)
{
    kit *k = *state;
    const ag_material_desc *m = load(
        k, "'emissiveTexture':{'index':0,'texCoord':2},'occlusionTexture':{'index':1,'texCoord':3}",
        1);
    assert_non_null(strstr(k->said, "materials[0].occlusionTexture: texCoord 3 is not supported"));
    assert_int_equal(color_of(k, &m->emissive_texture), -1);
}

static void out_of_range(void **state)
{
    kit *k = *state;
    const ag_material_desc *m =
        load(k, "'pbrMetallicRoughness':{'metallicFactor':3,'roughnessFactor':-1}", 1);
    assert_non_null(strstr(k->said, "pbrMetallicRoughness.metallicFactor: 3 is taken as 1"));
    kit_near(m->metallic, 1, 0);
    kit_near(m->roughness, 0, 0);
}

static void samplers(void **state)
{
    kit *k = *state;
    load(k, "'normalTexture':{'index':2},'emissiveTexture':{'index':0}", 0);
    const ag_texture_desc *plain = &k->scene->textures[0].desc, *chosen;
    assert_int_equal(plain->wrap_u, AG_WRAP_REPEAT);
    assert_int_equal(plain->wrap_v, AG_WRAP_REPEAT);
    assert_int_equal(plain->mag, AG_FILTER_LINEAR);
    assert_int_equal(plain->min, AG_FILTER_LINEAR);
    assert_int_equal(plain->mip, AG_FILTER_LINEAR);
    assert_false(plain->no_mips);
    chosen = &k->scene->textures[1].desc;
    assert_int_equal(chosen->wrap_u, AG_WRAP_CLAMP);
    assert_int_equal(chosen->wrap_v, AG_WRAP_MIRROR);
    assert_int_equal(chosen->mag, AG_FILTER_NEAREST);
    assert_int_equal(chosen->min, AG_FILTER_LINEAR); // 9985: linear, nearest level
    assert_int_equal(chosen->mip, AG_FILTER_NEAREST);
}

static void minification_filters(void **state)
{
    static const struct {
        int filter;
        ag_filter min, mip;
        bool no_mips;
    } cases[] = {
        { 9728, AG_FILTER_NEAREST, AG_FILTER_LINEAR, true },
        { 9729, AG_FILTER_LINEAR, AG_FILTER_LINEAR, true },
        { 9984, AG_FILTER_NEAREST, AG_FILTER_NEAREST, false },
        { 9985, AG_FILTER_LINEAR, AG_FILTER_NEAREST, false },
        { 9986, AG_FILTER_NEAREST, AG_FILTER_LINEAR, false },
        { 9987, AG_FILTER_LINEAR, AG_FILTER_LINEAR, false },
    };
    kit *k = *state;
    textured t = make_textured(k);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char json[16384];
        snprintf(json, sizeof json, "%s", textured_json(&t, "'normalTexture':{'index':2}", ""));
        char number[8];
        snprintf(number, sizeof number, "%d", cases[i].filter);
        memcpy(strstr(json, "9985"), number, 4);
        kit_loads(k, json, t.bytes, t.size, 0);
        const ag_texture_desc *desc = &k->scene->textures[0].desc;
        assert_int_equal(desc->min, cases[i].min);
        assert_int_equal(desc->no_mips, cases[i].no_mips);
        if (!desc->no_mips)
            assert_int_equal(desc->mip, cases[i].mip);
    }
}

// EXT_texture_webp's source goes before the plain one; one image is decoded for all uses.
static void image_sources(void **state)
{
    kit *k = *state;
    textured t = make_textured(k);
    char json[16384];
    snprintf(json, sizeof json, "%s",
             textured_json(&t, "'normalTexture':{'index':0},'emissiveTexture':{'index':1}", ""));
    const char *from = "{\"source\":0},{\"source\":1},";
    char *place = strstr(json, from);
    assert_non_null(place);
    const char *tail = kit_json("%s", place + strlen(from));
    strcpy(place, kit_json("{'source':0,'extensions':{'EXT_texture_webp':{'source':2}}},"
                           "{'source':2},%s",
                           tail));
    kit_loads(k, json, t.bytes, t.size, 0);
    const ag_material_desc *m = &k->scene->materials[1];
    assert_int_equal(color_of(k, &m->normal_texture), 2);
    assert_int_equal(color_of(k, &m->emissive_texture), 2);
    assert_int_equal(k->scene->images_count, 1);
    assert_int_equal(k->scene->textures_count, 2);
    // Two images of one buffer view are one.
    snprintf(json, sizeof json, "%s",
             textured_json(&t, "'normalTexture':{'index':0},'emissiveTexture':{'index':1}", ""));
    *strstr(strstr(json, "\"images\""), "View\":2") = 'v'; // images[1] has none now
    assert_int_equal(kit_load_glb(k, json, t.bytes, t.size), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "images[1]: has neither a uri nor a bufferView"));
    char *view = strstr(strstr(json, "\"images\""), "view\":2");
    memcpy(view, "View\":1", 7);
    kit_loads(k, json, t.bytes, t.size, 0);
    assert_int_equal(k->scene->images_count, 1);
    assert_int_equal(k->scene->textures_count, 2);
    assert_int_equal(color_of(k, &k->scene->materials[1].emissive_texture), 0);
}

// Without images there are factors, and nothing shines that a texture would have to limit; what is
// wrong with an image is not found.
static void images_left_out(void **state)
{
    kit *k = *state;
    textured t = make_textured(k);
    const char *json = textured_json(&t,
                                     "'normalTexture':{'index':1},'emissiveTexture':{'index':0},"
                                     "'emissiveFactor':[1,1,1],'pbrMetallicRoughness':"
                                     "{'baseColorFactor':[0.5,1,1,1],'metallicFactor':0.25}",
                                     "");
    memset(t.bytes + t.offsets[1], 0, 8);
    assert_int_equal(kit_load_glb(k, json, t.bytes, t.size), AG_ERROR_UNSUPPORTED);
    assert_int_equal(
        kit_load_path(k, kit_path(k, "model.glb"), &(ag_load_options) { .skip_images = true }),
        AG_OK);
    const ag_material_desc *m = &k->scene->materials[1];
    assert_int_equal(k->scene->images_count + k->scene->textures_count, 0);
    assert_int_equal(m->normal_texture.texture.id + m->emissive_texture.texture.id, 0);
    kit_near(m->base_color[0], 0.5, 1e-7);
    kit_near(m->metallic, 0.25, 1e-7);
    kit_near(m->emissive[0], 0, 0);
}

static void broken_images(void **state)
{
    kit *k = *state;
    textured t = make_textured(k);
    const char *json = textured_json(&t, "'normalTexture':{'index':1}", "");
    memset(t.bytes + t.offsets[1], 0, 8);
    assert_true(kit_load_glb(k, json, t.bytes, t.size) != AG_OK);
    assert_int_equal(k->errors, 1);
    assert_non_null(strstr(k->said, "model.glb: images[1]"));
    t = make_textured(k);
    kit_loads(k, json, t.bytes, t.size, 0);
    kit_fails(k, AG_ERROR_FORMAT, "materials[0].normalTexture.index: 3 is not one of the 3",
              textured_json(&t, "'normalTexture':{'index':3}", ""), t.bytes, t.size);
    kit_fails(k, AG_ERROR_FORMAT, "materials[0].normalTexture.index: is missing",
              textured_json(&t, "'normalTexture':{}", ""), t.bytes, t.size);
    kit_fails(k, AG_ERROR_FORMAT, "materials[0].alphaMode: \"GLASS\" is not",
              textured_json(&t, "'alphaMode':'GLASS'", ""), t.bytes, t.size);
}

static void declared_extensions(void **state)
{
    kit *k = *state;
    kit_loads(k,
              kit_document(36, "", "", "",
                           ",'extensionsUsed':['KHR_texture_transform','EXT_wondrous',"
                           "'EXT_wondrous'],'extensionsRequired':['KHR_texture_transform']"),
              kit_triangle, 36, 1);
    assert_non_null(strstr(k->said, "EXT_wondrous is not supported"));
    ag_extension_info info;
    assert_true(ag_scene_extension(k->scene, 0, &info));
    assert_string_equal(info.name, "KHR_texture_transform");
    assert_true(info.required && info.supported);
    assert_true(ag_scene_extension(k->scene, 1, &info));
    assert_string_equal(info.name, "EXT_wondrous");
    assert_false(info.required || info.supported);
    assert_false(ag_scene_extension(k->scene, 2, &info));
    kit_fails(k, AG_ERROR_UNSUPPORTED, "requires the extension EXT_wondrous",
              kit_document(36, "", "", "",
                           ",'extensionsUsed':['EXT_wondrous'],"
                           "'extensionsRequired':['EXT_wondrous']"),
              kit_triangle, 36);
    kit_fails(k, AG_ERROR_FORMAT, "extensionsUsed[0]: is not a string",
              kit_document(36, "", "", "", ",'extensionsUsed':[7]"), kit_triangle, 36);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults),
        cmocka_unit_test(core),
        cmocka_unit_test(extensions),
        cmocka_unit_test(anisotropy),
        cmocka_unit_test(texture_transform),
        cmocka_unit_test(third_uv_set),
        cmocka_unit_test(out_of_range),
        cmocka_unit_test(samplers),
        cmocka_unit_test(minification_filters),
        cmocka_unit_test(image_sources),
        cmocka_unit_test(images_left_out),
        cmocka_unit_test(broken_images),
        cmocka_unit_test(declared_extensions),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
