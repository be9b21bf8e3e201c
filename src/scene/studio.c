// The studio: a dim neutral room, darker below, with soft boxes: a large key to the left, a wide
// fill to the right, a bank overhead, and a narrow rim light on either side, placed so that the
// automatic view sees none of them behind the scene.
#include "scene/environment.h"

typedef struct soft_box {
    vec3 centre;         // direction of its middle, any length
    float width, height; // half extents on the plane at distance 1
    float edge;          // width of the soft edge there
    vec3 radiance;       // in the middle; it falls to 70 % at the rim
} soft_box;

static const soft_box boxes[] = {
    // key: left, in front, above
    { { -0.58f, 0.52f, 0.63f }, 0.52f, 0.44f, 0.10f, { 3.6f, 3.5f, 3.3f } },
    // fill: right, in front
    { { 0.86f, 0.22f, 0.46f }, 0.24f, 0.62f, 0.10f, { 1.30f, 1.35f, 1.45f } },
    // bank: overhead, a little behind
    { { 0.10f, 0.94f, -0.33f }, 0.60f, 0.22f, 0.10f, { 1.5f, 1.5f, 1.5f } },
    // rim: behind, to the right
    { { 0.72f, 0.28f, -0.64f }, 0.12f, 0.55f, 0.05f, { 5.0f, 5.2f, 5.5f } },
    // rim: behind, to the left
    { { -0.96f, 0.24f, -0.16f }, 0.09f, 0.48f, 0.04f, { 3.6f, 3.5f, 3.3f } },
};
enum { BOXES = sizeof boxes / sizeof *boxes };

// A box with its frame, ready to be looked at.
typedef struct placed_box {
    vec3 out, right, up;
    float depth_min; // cosine of the cone that holds it
} placed_box;

typedef struct room {
    placed_box placed[BOXES];
} room;

static room furnish(void)
{
    room r;
    for (int i = 0; i < BOXES; i++) {
        const soft_box *box = &boxes[i];
        placed_box *p = &r.placed[i];
        p->out = vec3_unit(box->centre);
        p->right = vec3_unit((vec3) { p->out.z, 0.0f, -p->out.x });
        p->up = vec3_cross(p->out, p->right);
        p->depth_min = 1.0f / sqrtf(1.0f + box->width * box->width + box->height * box->height);
    }
    return r;
}

static float smooth(float low, float high, float x)
{
    float t = fminf(fmaxf((x - low) / (high - low), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

// How brightly a box shines along `d`: by the signed distance to a rectangle with round corners
// on the plane that touches the unit sphere at the box's middle.
static float box_brightness(const soft_box *box, const placed_box *placed, vec3 d)
{
    float depth = vec3_dot(d, placed->out);
    if (depth < placed->depth_min)
        return 0.0f;
    float x = fabsf(vec3_dot(d, placed->right)) / depth, y = fabsf(vec3_dot(d, placed->up)) / depth;
    float s = x / box->width, t = y / box->height;
    x += box->edge - box->width;
    y += box->edge - box->height;
    float a = fmaxf(x, 0.0f), b = fmaxf(y, 0.0f);
    float outside = sqrtf(a * a + b * b) + fminf(fmaxf(x, y), 0.0f);
    return (1.0f - smooth(0.0f, box->edge, outside)) * (1.0f - 0.15f * (s * s + t * t));
}

// Walls: a dark floor, a soft horizon, a wall that fades towards the ceiling.
static float wall(float height)
{
    float floor = mix(0.035f, 0.11f, smooth(-1.0f, 0.0f, height));
    float upper = mix(0.26f, 0.13f, smooth(0.0f, 0.9f, height));
    return mix(floor, upper, smooth(-0.14f, 0.10f, height));
}

static vec3 look(const void *context, vec3 d)
{
    const room *r = context;
    float grey = wall(d.y);
    vec3 out = { grey, grey, grey };
    for (int i = 0; i < BOXES; i++) {
        float brightness = box_brightness(&boxes[i], &r->placed[i], d);
        if (brightness > 0.0f)
            out = vec3_add(out, vec3_scale(boxes[i].radiance, brightness));
    }
    return out;
}

ag_status studio_create(const ag_log *log, ag_image **image)
{
    room r = furnish();
    return environment_paint(log, look, &r, image);
}
