// The studio: a neutral grey room, darker below, with soft boxes: a large key to the left
// front, a wide fill to the right, a narrow rim light behind and a strip overhead.
#include "scene/environment.h"

typedef struct soft_box {
    vec3 centre;         // unit direction
    float width, height; // half extents on the plane at distance 1
    float edge;          // width of the soft edge there
    vec3 radiance;
} soft_box;

static float smooth(float low, float high, float x)
{
    float t = fminf(fmaxf((x - low) / (high - low), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

// How much of a box is seen along `d`: signed distance to a rectangle with round corners on
// the plane that touches the unit sphere at the box's centre.
static float box_coverage(const soft_box *box, vec3 d)
{
    float depth = vec3_dot(d, box->centre);
    if (depth <= 0.0f)
        return 0.0f;
    float length = hypotf(box->centre.x, box->centre.z);
    vec3 right = { -box->centre.z / length, 0.0f, box->centre.x / length };
    vec3 up = vec3_cross(right, box->centre);
    float x = fabsf(vec3_dot(d, right)) / depth - box->width + box->edge;
    float y = fabsf(vec3_dot(d, up)) / depth - box->height + box->edge;
    float outside = hypotf(fmaxf(x, 0.0f), fmaxf(y, 0.0f)) + fminf(fmaxf(x, y), 0.0f);
    return 1.0f - smooth(0.0f, box->edge, outside);
}

// Walls: a floor of half the wall's brightness, a soft horizon, a lighter ceiling.
static float wall(float height)
{
    float floor = mix(0.10f, 0.17f, smooth(-1.0f, -0.05f, height));
    float upper = mix(0.30f, 0.42f, smooth(0.0f, 1.0f, height));
    return mix(floor, upper, smooth(-0.12f, 0.10f, height));
}

static vec3 studio(vec3 d)
{
    // The centres are unit to 1e-4.
    static const soft_box boxes[] = {
        // key: left, in front, above
        { { -0.5213f, 0.5744f, 0.6311f }, 0.55f, 0.42f, 0.10f, { 5.2f, 5.1f, 4.9f } },
        // fill: right, in front
        { { 0.8816f, 0.2756f, 0.3835f }, 0.32f, 0.60f, 0.12f, { 1.9f, 1.95f, 2.05f } },
        // rim: behind, to the right
        { { 0.5240f, 0.3090f, -0.7937f }, 0.14f, 0.55f, 0.06f, { 6.0f, 6.1f, 6.3f } },
        // back: behind, to the left
        { { -0.7679f, 0.2079f, -0.6059f }, 0.10f, 0.45f, 0.05f, { 3.6f, 3.5f, 3.4f } },
    };
    float grey = wall(d.y);
    vec3 out = { grey, grey, grey };
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++)
        out = vec3_add(out, vec3_scale(boxes[i].radiance, box_coverage(&boxes[i], d)));
    return out;
}

ag_status studio_create(const ag_log *log, ag_image **image)
{
    return environment_paint(log, studio, image);
}
