// Lights of the command line: a kind, then key=value, each key once.
#include "lights.h"

#include "options.h"
#include "values.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { KIND_COUNT = AG_LIGHT_HARMONICS + 1, WORD_MOST = 512 };
static const char blanks[] = " \t\n";

#define BIT(kind) (1u << AG_LIGHT_##kind)
#define ALL (BIT(HARMONICS) * 2 - 1)
#define PLACED (BIT(POINT) | BIT(SPOT) | BIT(SPHERE) | BIT(DISK) | BIT(RECT) | BIT(TUBE))
#define AIMED (BIT(SPOT) | BIT(DISK) | BIT(RECT))
#define TURNED (AIMED | BIT(DIRECTIONAL) | BIT(SUN) | BIT(TUBE) | BIT(HEMISPHERIC))
#define SEEN (BIT(SUN) | BIT(SPHERE) | BIT(DISK) | BIT(RECT) | BIT(TUBE))

typedef struct reading {
    ag_light_desc light; // first, so that offsets into it are offsets into this
    float to[3];         // NAN = not given
    unsigned seen;       // bit i: keys[i] was given
    light_list *list;
} reading;

// A key, which kinds take it and which cannot do without.
typedef struct key {
    const char *name;
    unsigned kinds, needed;
    size_t offset;       // in a reading
    option_reader *read; // NULL -> a switch
} key;

#define FIELD(member) offsetof(ag_light_desc, member)
static const key keys[] = {
    { "at", PLACED, 0, FIELD(position), value_vector },
    { "direction", TURNED, 0, FIELD(direction), value_direction },
    { "to", AIMED, 0, offsetof(reading, to), value_vector },
    { "up", BIT(RECT), 0, FIELD(up), value_direction },
    { "radius", BIT(SPHERE) | BIT(DISK) | BIT(TUBE), BIT(SPHERE) | BIT(DISK) | BIT(TUBE),
      FIELD(radius_m), value_at_least_0 },
    { "width", BIT(RECT), BIT(RECT), FIELD(width_m), value_at_least_0 },
    { "height", BIT(RECT), BIT(RECT), FIELD(height_m), value_at_least_0 },
    { "length", BIT(TUBE), BIT(TUBE), FIELD(length_m), value_at_least_0 },
    { "inner", BIT(SPOT), 0, FIELD(cone_inner_rad), value_cone_degrees },
    { "outer", BIT(SPOT), 0, FIELD(cone_outer_rad), value_cone_degrees },
    { "angle", BIT(SUN), 0, FIELD(angular_radius_rad), value_sun_degrees },
    { "range", PLACED, 0, FIELD(range_m), value_at_least_0 },
    { "ground", BIT(HEMISPHERIC), 0, FIELD(ground_color), value_weights },
    { "terms", BIT(HARMONICS), BIT(HARMONICS), FIELD(harmonics), value_terms },
    { "color", ALL, 0, FIELD(color), value_color_weights },
    { "intensity", ALL, 0, FIELD(intensity), value_at_least_0 },
    { "hidden", SEEN, 0, FIELD(hidden), NULL },
};
enum { KEY_COUNT = sizeof keys / sizeof *keys };

static const char *const words[KIND_COUNT] = { "point",   "spot",        "directional", "sun",
                                               "sphere",  "disk",        "rect",        "tube",
                                               "ambient", "hemispheric", "harmonics" };

const char *light_kind_word(ag_light_kind kind)
{
    return (unsigned)kind < KIND_COUNT ? words[kind] : "unknown";
}

const char *light_unit(ag_light_kind kind)
{
    switch (kind) {
    case AG_LIGHT_POINT:
    case AG_LIGHT_SPOT:
    case AG_LIGHT_SPHERE: return "cd";
    case AG_LIGHT_DIRECTIONAL:
    case AG_LIGHT_SUN: return "lux";
    default: return "nit";
    }
}

// ---- What is wrong ---------------------------------------------------------------

__attribute__((format(printf, 2, 3))) static const char *complain(const reading *r,
                                                                  const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(r->list->complaint, sizeof r->list->complaint, format, args);
    va_end(args);
    return r->list->complaint;
}

// Append ", word", or " and word" to the last of them.
static void append(char *all, size_t size, const char *word, bool last)
{
    size_t used = strlen(all);
    snprintf(all + used, size - used, "%s%s", !used ? "" : last ? " and " : ", ", word);
}

static const char *unknown_kind(const reading *r, const char *word)
{
    char all[200] = "";
    for (int i = 0; i < KIND_COUNT; i++)
        append(all, sizeof all, words[i], i == KIND_COUNT - 1);
    return complain(r, "begins with '%.40s', which is no kind of light: there are %s", word, all);
}

static const char *unknown_key(const reading *r, const char *name)
{
    char all[200] = "";
    for (int i = 0; i < KEY_COUNT; i++)
        if (keys[i].kinds >> r->light.kind & 1)
            append(all, sizeof all, keys[i].name, false);
    return complain(r, "has '%.40s', which a light of kind %s does not take: it takes %s", name,
                    words[r->light.kind], all);
}

// ---- Reading -----------------------------------------------------------------------

static const char *read_kind(reading *r, const char *word)
{
    for (int i = 0; i < KIND_COUNT; i++)
        if (strcmp(words[i], word) == 0) {
            r->light.kind = (ag_light_kind)i;
            return NULL;
        }
    return unknown_kind(r, word);
}

static const char *apply(reading *r, int index, const char *value)
{
    const key *k = &keys[index];
    char *field = (char *)r + k->offset;
    if (r->seen >> index & 1)
        return complain(r, "says '%s' twice", k->name);
    r->seen |= 1u << index;
    if (!k->read) {
        *(bool *)field = true;
        return value ? complain(r, "gives '%s' a value; it takes none", k->name) : NULL;
    }
    if (!value || !*value)
        return complain(r, "gives '%s' no value", k->name);
    const char *wrong = k->read(value, field);
    return wrong ? complain(r, "has %s=%.80s, which %s", k->name, value, wrong) : NULL;
}

static const char *read_key(reading *r, char *word)
{
    char *equals = strchr(word, '=');
    if (equals)
        *equals = 0;
    for (int i = 0; i < KEY_COUNT; i++)
        if (keys[i].kinds >> r->light.kind & 1 && strcmp(keys[i].name, word) == 0)
            return apply(r, i, equals ? equals + 1 : NULL);
    return unknown_key(r, word);
}

static bool is_zero(const float v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static const char *aim(reading *r)
{
    float *direction = r->light.direction;
    if (isnan(r->to[0]))
        return NULL;
    if (!is_zero(direction))
        return complain(r, "has both to= and direction=; give one of them");
    for (int i = 0; i < 3; i++) // halves: the difference stays finite
        direction[i] = 0.5f * r->to[i] - 0.5f * r->light.position[i];
    return is_zero(direction) ? complain(r, "shines to where it stands") : NULL;
}

// What each key alone cannot know.
static double degrees(float rad)
{
    return (double)rad * 57.29577951308232;
}

static const char *finish(reading *r)
{
    const ag_light_desc *light = &r->light;
    for (int i = 0; i < KEY_COUNT; i++)
        if (keys[i].needed >> light->kind & 1 && !(r->seen >> i & 1))
            return complain(r, "lacks %s=, which a light of kind %s needs", keys[i].name,
                            words[light->kind]);
    if (light->kind == AG_LIGHT_SPOT && !(light->cone_inner_rad < light->cone_outer_rad))
        return complain(r, "has an inner angle of %g degrees that is not below the outer one of %g",
                        degrees(light->cone_inner_rad), degrees(light->cone_outer_rad));
    return aim(r);
}

const char *lights_read(const char *value, void *field)
{
    light_list *list = field;
    reading r = {
        .light = { .cone_outer_rad = 0.785398163f, .intensity = 1 },
        .to = { NAN, NAN, NAN },
        .list = list,
    };
    if (list->count == LIGHTS_MOST)
        return complain(&r, "is one too many: at most %d are taken", LIGHTS_MOST);
    const char *wrong = NULL, *at = value + strspn(value, blanks);
    if (!*at)
        return "is empty";
    for (bool first = true; *at && !wrong; first = false) {
        char word[WORD_MOST];
        size_t length = strcspn(at, blanks);
        if (length >= sizeof word)
            return complain(&r, "has a word of %zu letters", length);
        memcpy(word, at, length);
        word[length] = 0;
        wrong = first ? read_kind(&r, word) : read_key(&r, word);
        at += length;
        at += strspn(at, blanks);
    }
    if (!wrong)
        wrong = finish(&r);
    if (!wrong)
        list->lights[list->count++] = r.light;
    return wrong;
}

const char lights_lesson[] =
    "lights: --light takes a kind and its keys, as 'sphere at=0,2,1 radius=0.1 intensity=100'.\n"
    "  point        cd   at range\n"
    "  spot         cd   at direction|to inner outer range\n"
    "  directional  lux  direction\n"
    "  sun          lux  direction angle hidden\n"
    "  sphere       cd   at radius range hidden\n"
    "  disk         nit  at direction|to radius range hidden\n"
    "  rect         nit  at direction|to up width height range hidden\n"
    "  tube         nit  at direction length radius range hidden\n"
    "  ambient      nit\n"
    "  hemispheric  nit  direction ground\n"
    "  harmonics    nit  terms\n"
    "All take color=R,G,B, linear weights (1,1,1), and intensity=I (1) in the unit above.\n"
    "at=X,Y,Z and to=X,Y,Z are places in metres; radius, width, height, length and range are\n"
    "metres (range: unbounded).  direction=X,Y,Z is the way the light travels (0,0,-1), along a\n"
    "tube (1,0,0), or to where a hemisphere has its colour (0,1,0); ground=R,G,B is the other\n"
    "half's (black).  A rectangle's height follows up=X,Y,Z (0,1,0).  Angles are degrees from\n"
    "the axis: inner (0) and outer (45) of a spot, angle of a sun (0.266).  terms=T,... are the\n"
    "light's parts 1, x, y, z and, if you like, xy, yz, 3z^2-1, xz, x^2-y^2 along a normal; or\n"
    "three times as many: red, green, blue of each.  hidden: it lights, but is not seen.\n";
