// Rays from the eye, a packet at a time: loops over its lanes without branches or calls, which
// compilers make wide.
#include "trace/eye.h"

#include "bake/wide.h"
#include "trace/elementary.h"
#include "trace/sampler.h"

#define LANES for (int i = 0; i < WORLD_PACKET; i++)

typedef float lanes[WORLD_PACKET];

// As sampling_gaussian().
WIDE_INLINE void draw(const eye_samples *s, lanes x, lanes y)
{
    const float deviation = 0.47f, within = 0.993859f; // 1 - exp(-1.5^2 / (2 deviation^2))
    LANES
    {
        sampler dice = { s->index[i], s->seed[i], 0 };
        uint32_t seed, at = sampler_place(&dice, &seed);
        float u = sampler_first(at, seed);
        float v = sampler_second(at, seed);
        float r = deviation * sqrtf(-2 * elementary_log(1 - within * u));
        x[i] = r * elementary_cos(v);
        y[i] = r * elementary_sin(v);
    }
}

WIDE_INLINE void aim_body(const view *v, const eye_samples *s, ray_packet *r)
{
    lanes x, y;
    draw(s, x, y);
    float across = 2 * v->half_x / (float)v->width, down = 2 * v->half_y / (float)v->height;
    LANES
    {
        x[i] = ((float)s->x[i] + 0.5f + x[i]) * across - v->half_x;
        y[i] = v->half_y - ((float)s->y[i] + 0.5f + y[i]) * down;
    }
    for (int k = 0; k < 3; k++)
        LANES
        {
            float off = x[i] * v->right[k] + y[i] * v->up[k];
            r->origin[k][i] = v->orthographic ? v->eye[k] + off : v->eye[k];
            r->direction[k][i] = v->orthographic ? v->forward[k] : v->forward[k] + off;
        }
    LANES
    {
        float along = v->orthographic ? 1 : 1 / sqrtf(1 + x[i] * x[i] + y[i] * y[i]);
        for (int k = 0; k < 3; k++)
            r->direction[k][i] *= along;
        r->near[i] = max(v->near_m, 0.0f) / along;
        r->far[i] = v->far_m / along;
        const sampler dice = { s->index[i], s->seed[i], 1 };
        r->dice[i] = sampler_roll(&dice);
    }
}

WIDE_DISPATCH(aim, (const view *v, const eye_samples *s, ray_packet *r), (v, s, r))

void eye_rays(const view *v, const eye_samples *samples, ray_packet *rays)
{
    aim(v, samples, rays);
}
