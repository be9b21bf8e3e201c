// The options of `argand reference`: their table, and what must not stand together.
#include "reference_options.h"

#include "commands.h"
#include "text.h"

#include <stdio.h>
#include <string.h>

static const choice estimators[] = {
    { "both", AG_ESTIMATOR_BOTH },
    { "lights", AG_ESTIMATOR_LIGHTS },
    { "surface", AG_ESTIMATOR_SURFACE },
    { NULL, 0 },
};

static const choice parts[] = {
    { "seen", AG_PART_SEEN },       { "lights", AG_PART_LIGHTS },
    { "diffuse", AG_PART_DIFFUSE }, { "specular", AG_PART_SPECULAR },
    { "emitted", AG_PART_EMITTED }, { NULL, 0 },
};

static const choice aovs[] = {
    { "albedo", 1 << AG_AOV_ALBEDO },     { "normal", 1 << AG_AOV_NORMAL },
    { "depth", 1 << AG_AOV_DEPTH },       { "direct", 1 << AG_AOV_DIRECT },
    { "indirect", 1 << AG_AOV_INDIRECT }, { NULL, 0 },
};

static const choice *find_word(const choice *words, const char *word, size_t length)
{
    for (; words->word; words++)
        if (strlen(words->word) == length && strncmp(words->word, word, length) == 0)
            return words;
    return NULL;
}

// Words with commas between, whose numbers are or-ed.
static bool read_words(const char *value, const choice *words, uint32_t *bits)
{
    *bits = 0;
    for (;;) {
        size_t length = strcspn(value, ",");
        const choice *found = find_word(words, value, length);
        if (!found)
            return false;
        *bits |= (uint32_t)found->value;
        if (!value[length])
            return true;
        value += length + 1;
    }
}

static const char *read_parts(const char *value, void *field)
{
    return read_words(value, parts, field)
               ? NULL
               : "is not a list of seen, lights, diffuse, specular and emitted";
}

static const char *read_aovs(const char *value, void *field)
{
    return read_words(value, aovs, field)
               ? NULL
               : "is not a list of albedo, normal, depth, direct and indirect";
}

#define FIELD(member) offsetof(reference_request, member)

const option reference_options[] = {
    { "--output", "-o", "FILE", "picture.png", "where the picture goes: .png .jpg .webp .exr .hdr",
      FIELD(shot.output), value_text, NULL, 0 },
    { "--spp", NULL, "N", "256", "samples a pixel (64)", FIELD(spp), value_samples, NULL, 0 },
    { "--time", NULL, "SECONDS", "60", "end after as much tracing", FIELD(seconds), value_seconds,
      NULL, 0 },
    { "--noise", NULL, "X", "0.01", "end where the estimated relative error is below X",
      FIELD(noise), value_noise, NULL, 0 },
    { "--max-bounces", NULL, "N", "0", "after the first surface; 0 is direct light only",
      FIELD(max_bounces), value_whole, NULL, FIELD(bounces_given) },
    { "--seed", NULL, "N", "1", "another seed, other noise (0)", FIELD(seed), value_whole, NULL,
      0 },
    { "--aov", NULL, "NAME,...", "albedo,normal",
      "layers of an .exr: albedo, normal, depth, direct, indirect", FIELD(aovs), read_aovs, NULL,
      0 },
    { "--parts", NULL, "NAME,...", "lights,diffuse",
      "of the light: seen, lights, diffuse, specular, emitted (all)", FIELD(parts), read_parts,
      NULL, 0 },
    { "--unshadowed", NULL, NULL, "", "nothing stands before a light", FIELD(unshadowed), NULL,
      NULL, 0 },
    { "--clamp", NULL, "X", "10", "most that a path may add by one light (no limit)", FIELD(clamp),
      value_factor, NULL, 0 },
    { "--estimator", NULL, "both|lights|surface", "both", "where light is looked for (both)",
      FIELD(estimator), NULL, estimators, 0 },
    { 0 },
};

static bool sound(const reference_request *r)
{
    if (!r->aovs || text_ends(r->shot.output, ".exr"))
        return true;
    fprintf(stderr, "argand: --aov: '%s' cannot hold layers, OpenEXR can; name it -o picture.exr\n",
            r->shot.output);
    return false;
}

bool reference_request_parse(reference_request *r, int argc, char **argv, bool *help)
{
    *r = (reference_request) { .shot = shot_request_default() };
    option_set set = {
        .command = &command_reference,
        .fields = r,
        .operands = &r->shot.input,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return false;
    *help = set.help;
    return set.help || (shot_request_settle(&r->shot, "reference", true) && sound(r));
}
