// ARGAND_materials, both ways: how a surface reflects where glTF has no choice
// (docs/gltf.md).
#include "scene/gltf_write.h"

#include <string.h>

#define FIELD(name) offsetof(ag_material_desc, name)

typedef struct choice {
    const char *key;
    size_t offset;        // of an enumeration
    const char *words[6]; // of its values, the first being the default; ends with NULL
} choice;

static const choice choices[] = {
    { "diffuse", FIELD(diffuse), { "lambert", "orenNayar", "eon" } },
    { "distribution", FIELD(distribution), { "ggx", "blinn" } },
    { "shadowing", FIELD(shadowing), { "smith", "schlick" } },
    { "fresnel", FIELD(fresnel), { "schlick", "conductor", "f82" } },
    { "layering", FIELD(layering), { "albedo", "fresnel", "gltf", "blend" } },
};

typedef struct number {
    const char *key;
    size_t offset, count;
    float min, max;
} number;

static const number numbers[] = {
    { "diffuseRoughness", FIELD(diffuse_roughness), 1, 0.0f, 1.5707963f },
    { "shininess", FIELD(shininess), 1, 0.0f, 1e6f },
    { "conductorN", FIELD(conductor_n), 3, 1e-3f, 1e3f },
    { "conductorK", FIELD(conductor_k), 3, 0.0f, 1e3f },
    { "f82Tint", FIELD(f82_tint), 3, 0.0f, 1.0f },
    { "reflectiveness", FIELD(reflectiveness), 1, 0.0f, 1.0f },
};

enum {
    CHOICES = sizeof choices / sizeof *choices,
    NUMBERS = sizeof numbers / sizeof *numbers,
};

// ---- Reading -----------------------------------------------------------------------------

static ag_status read_choice(const gltf_at *at, const choice *c, unsigned *value)
{
    gltf_at word_at = gltf_member(at, c->key);
    const char *word = c->words[0];
    ag_status status = gltf_string(at, c->key, &word);
    if (status)
        return status;
    for (*value = 0; c->words[*value]; ++*value)
        if (strcmp(c->words[*value], word) == 0)
            return AG_OK;
    return gltf_fail(&word_at, AG_ERROR_FORMAT, "\"%.20s\" is not known; the default is \"%s\"",
                     word, c->words[0]);
}

ag_status gltf_material_read_argand(const gltf_at *material, ag_material_desc *desc)
{
    gltf_at at;
    ag_status status = gltf_extension(material, "ARGAND_materials", &at);
    for (size_t i = 0; i < CHOICES && !status; i++) {
        unsigned value = 0;
        status = read_choice(&at, &choices[i], &value);
        memcpy((char *)desc + choices[i].offset, &value, sizeof value);
    }
    for (size_t i = 0; i < NUMBERS && !status; i++)
        status = gltf_floats_in(&at, numbers[i].key, numbers[i].count, numbers[i].min,
                                numbers[i].max, (float *)((char *)desc + numbers[i].offset));
    return status ? status : gltf_bool(&at, "singleBounce", &desc->single_bounce);
}

// ---- Writing -----------------------------------------------------------------------------

static void put_number(gltf_writer *w, json_t *object, const number *n,
                       const ag_material_desc *desc, const ag_material_desc *assumed)
{
    const float *value = (const float *)((const char *)desc + n->offset);
    const float *unless = (const float *)((const char *)assumed + n->offset);
    if (n->count == 1)
        gltf_put_float_unless(w, object, n->key, *value, *unless);
    else
        gltf_put_floats_unless(w, object, n->key, value, n->count, unless);
}

void gltf_material_write_argand(gltf_writer *w, json_t *material, const ag_material_desc *desc)
{
    const ag_material_desc assumed = ag_material_default();
    json_t *made = json_object();
    for (size_t i = 0; i < CHOICES; i++) {
        unsigned value;
        memcpy(&value, (const char *)desc + choices[i].offset, sizeof value);
        if (value)
            gltf_put_word(w, made, choices[i].key, choices[i].words[value]);
    }
    for (size_t i = 0; i < NUMBERS; i++)
        put_number(w, made, &numbers[i], desc, &assumed);
    if (desc->single_bounce)
        gltf_put_true(w, made, "singleBounce");
    gltf_put_extension_unless_empty(w, material, "ARGAND_materials", made);
}
