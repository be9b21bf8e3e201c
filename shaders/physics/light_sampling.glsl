// Directions towards lights of extent, with their density; and which light a direction hits.
//
// The place that is lit is at the origin of any orthonormal frame; wi are unit vectors that leave
// it.  Lights are given as light_sphere.glsl, _polygon, _disk and _tube have them, but shine to all
// sides here: the caller asks for the side.  u in [0, 1)^2; lengths in one unit; densities are per
// solid angle, 1/sr, and 0 says that there is nothing to sample.  Derivations: docs/physics.md.
#ifndef AG_PHYSICS_LIGHT_SAMPLING_GLSL
#define AG_PHYSICS_LIGHT_SAMPLING_GLSL

#include "physics/lang.glsl"

STRUCT(light_sample) {
    vec3 direction; // unit
    real distance;  // to the surface of the light
    real density;   // 0: not a sample
};

static const real LIGHT_FAR = 1e30f;
static const real LIGHT_LEAST = 1e-30f;

static inline light_sample light_sample_none(void)
{
    light_sample s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.distance = LIGHT_FAR;
    s.density = 0.0f;
    return s;
}

static inline light_sample light_sample_at(vec3 to, real density)
{
    light_sample s;
    s.distance = sqrt(max(dot(to, to), LIGHT_LEAST));
    s.direction = to / s.distance;
    s.density = density;
    return s;
}

// Two unit vectors across a third and each other.  Duff et al. 2017.
STRUCT(light_across) {
    vec3 x;
    vec3 y;
};

static inline light_across light_across_from(vec3 n)
{
    real up = n[2] < 0.0f ? -1.0f : 1.0f;
    real a = -1.0f / (up + n[2]);
    real b = n[0] * n[1] * a;
    light_across t;
    t.x = vec3(1.0f + up * n[0] * n[0] * a, up * b, -up * n[0]);
    t.y = vec3(b, up + n[1] * n[1] * a, -n[1]);
    return t;
}

// ---- caps ---------------------------------------------------------------------------------------

// 1 - cos, with the digits of the sine.
static inline real light_cap_height(real sin_s, real cos_s)
{
    return sin_s * sin_s / (1.0f + cos_s);
}

// Uniform over the cap about `axis`.
static inline vec3 light_cap_direction(vec3 axis, real height, vec2 u)
{
    real drop = u[0] * height; // 1 - cos
    real s = sqrt(max(drop * (2.0f - drop), 0.0f));
    real phi = 2.0f * PI * u[1];
    light_across t = light_across_from(axis);
    return normalize(s * cos(phi) * t.x + s * sin(phi) * t.y + (1.0f - drop) * axis);
}

static inline real light_cap_density(real height)
{
    return 0.5f * INV_PI / max(height, LIGHT_LEAST);
}

// 1 - cos of the sphere's cone; 2, all directions, inside.
static inline real light_sphere_height(vec3 center, real radius)
{
    real d2 = dot(center, center);
    real s2 = radius * radius / max(d2, LIGHT_LEAST);
    return s2 < 1.0f ? s2 / (1.0f + sqrt(1.0f - s2)) : 2.0f;
}

// The first crossing of the sphere (`way` = -1) or the second (1) along the line; of one that
// passes the sphere, the point nearest to it.
static inline real light_sphere_crossing(vec3 center, real radius, vec3 wi, real way)
{
    real along = dot(center, wi);
    vec3 off = center - along * wi;
    return along + way * sqrt(max(radius * radius - dot(off, off), 0.0f));
}

// The sphere's cone; inside the sphere, all directions.
static inline light_sample light_sample_sphere(vec3 center, real radius, vec2 u)
{
    real d2 = dot(center, center);
    real height = light_sphere_height(center, radius);
    vec3 axis = d2 > 0.0f ? center / sqrt(d2) : vec3(0.0f, 0.0f, 1.0f);
    light_sample s;
    s.direction = light_cap_direction(axis, height, u);
    s.distance = light_sphere_crossing(center, radius, s.direction, height < 2.0f ? -1.0f : 1.0f);
    s.density = light_cap_density(height);
    return s;
}

static inline real light_density_sphere(vec3 center, real radius)
{
    return light_cap_density(light_sphere_height(center, radius));
}

// `axis_to_sun` unit; sine and cosine of the angular radius.
static inline light_sample light_sample_sun(vec3 axis_to_sun, real sin_radius, real cos_radius,
                                            vec2 u)
{
    real height = light_cap_height(sin_radius, cos_radius);
    light_sample s;
    s.direction = light_cap_direction(axis_to_sun, height, u);
    s.distance = LIGHT_FAR;
    s.density = light_cap_density(height);
    return s;
}

static inline real light_density_sun(real cos_radius, real sin_radius)
{
    return light_cap_density(light_cap_height(sin_radius, cos_radius));
}

// The distance of that crossing, negative where there is none.
static inline real light_hit_crossing(vec3 center, real radius, vec3 wi, real way)
{
    vec3 off = center - dot(center, wi) * wi;
    bool hit = dot(off, off) <= radius * radius;
    return hit ? light_sphere_crossing(center, radius, wi, way) : -1.0f;
}

// The distance along wi, negative where it misses; from inside, to the way out.
static inline real light_hit_sphere(vec3 center, real radius, vec3 wi)
{
    bool inside = dot(center, center) <= radius * radius;
    return light_hit_crossing(center, radius, wi, inside ? 1.0f : -1.0f);
}

// ---- flat lights --------------------------------------------------------------------------------

// A rectangle in a frame along its sides: it spans low to high, high >= |low|, in the plane z =
// height >= 0.
STRUCT(light_panel) {
    vec3 x;
    vec3 y;
    vec3 z;
    vec2 low;
    vec2 high;
    real height;
};

static inline light_panel light_panel_from(vec3 c, vec3 half_x, vec3 half_y)
{
    light_panel p;
    real size_x = sqrt(dot(half_x, half_x));
    real size_y = sqrt(dot(half_y, half_y));
    p.x = half_x / max(size_x, LIGHT_LEAST);
    p.y = half_y / max(size_y, LIGHT_LEAST);
    p.z = cross(p.x, p.y);
    p.x = dot(c, p.x) < 0.0f ? -p.x : p.x;
    p.y = dot(c, p.y) < 0.0f ? -p.y : p.y;
    p.z = dot(c, p.z) < 0.0f ? -p.z : p.z;
    p.low = vec2(dot(c, p.x) - size_x, dot(c, p.y) - size_y);
    p.high = vec2(dot(c, p.x) + size_x, dot(c, p.y) + size_y);
    p.height = dot(c, p.z);
    return p;
}

// Van Oosterom & Strackee 1983, eq. 8: the solid angle of a triangle; `volume` = |a . (b x c)|.
static inline real light_triangle_angle(vec3 a, vec3 b, vec3 c, real volume)
{
    real na = sqrt(dot(a, a));
    real nb = sqrt(dot(b, b));
    real nc = sqrt(dot(c, c));
    return 2.0f * atan2(volume, na * nb * nc + dot(a, b) * nc + dot(b, c) * na + dot(c, a) * nb);
}

// The solid angle of the panel's part up to x.
static inline real light_panel_angle(light_panel p, real x)
{
    vec3 a = vec3(p.low[0], p.low[1], p.height);
    vec3 b = vec3(x, p.low[1], p.height);
    vec3 c = vec3(x, p.high[1], p.height);
    vec3 d = vec3(p.low[0], p.high[1], p.height);
    real volume = p.height * (x - p.low[0]) * (p.high[1] - p.low[1]);
    return light_triangle_angle(a, b, c, volume) + light_triangle_angle(a, c, d, volume);
}

// The solid angle between the edge y of a panel endless in x, its axis and what is beyond x.
static inline real light_panel_beyond(real x, real y, real z)
{
    real r = sqrt(x * x + y * y + z * z);
    return atan2(y * z * (r - x), z * z * r + x * y * y);
}

// sin b(high) - sin b(low), b = elevation of (d, y) over y = 0.
static inline real light_rise(real low, real high, real d2)
{
    return high / sqrt(d2 + high * high) - low / sqrt(d2 + low * low);
}

// 1 - sin b.
static inline real light_drop(real y, real d2)
{
    real r = sqrt(d2 + y * y);
    return y > 0.0f ? d2 / (r * (r + y)) : 1.0f - y / r;
}

// Of the elevations from low to high, that whose sine is at v between theirs, as y.
static inline real light_raise(real low, real high, real d2, real v)
{
    real drop = mix(light_drop(low, d2), light_drop(high, d2), v);
    real y = sqrt(d2) * (1.0f - drop) / sqrt(max(drop * (2.0f - drop), LIGHT_LEAST));
    return clamp(y, low, high);
}

// The x up to which the panel has a given solid angle.
static inline real light_panel_x(light_panel p, real angle)
{
    real z = p.height;
    real a = atan2(z, p.low[1]);
    real b = atan2(z, p.high[1]);
    real e = 0.5f * (light_panel_beyond(p.low[0], p.high[1], z) -
                     light_panel_beyond(p.low[0], p.low[1], z) - angle);
    real q = sin(e) * sin(a - b - e) * sin(a - e) * sin(b + e);
    real x = 0.5f * z * sin(a - b - 2.0f * e) / sqrt(max(q, LIGHT_LEAST));
    return clamp(x, p.low[0], p.high[0]);
}

// A step of Newton's: what is left of small solid angles' digits.
static inline real light_panel_polish(light_panel p, real x, real angle)
{
    real d2 = x * x + p.height * p.height;
    real slope = light_rise(p.low[1], p.high[1], d2) * p.height / d2;
    x = x - (light_panel_angle(p, x) - angle) / max(slope, LIGHT_LEAST);
    return clamp(x, p.low[0], p.high[0]);
}

// Uniform over its solid angle, as Urena, Fajardo & King 2013.  `x`, `y` = half sides.
static inline light_sample light_sample_rect(vec3 c, vec3 x, vec3 y, vec2 u)
{
    light_panel p = light_panel_from(c, x, y);
    real angle = light_panel_angle(p, p.high[0]);
    if (!(p.height > 0.0f && angle > LIGHT_LEAST))
        return light_sample_none();
    real px = light_panel_x(p, u[0] * angle);
    if (angle < 0.01f)
        px = light_panel_polish(p, px, u[0] * angle);
    real py = light_raise(p.low[1], p.high[1], px * px + p.height * p.height, u[1]);
    return light_sample_at(px * p.x + py * p.y + p.height * p.z, 1.0f / angle);
}

// Of directions that hit.
static inline real light_density_rect(vec3 c, vec3 x, vec3 y)
{
    light_panel p = light_panel_from(c, x, y);
    real angle = light_panel_angle(p, p.high[0]);
    return p.height > 0.0f && angle > LIGHT_LEAST ? 1.0f / angle : 0.0f;
}

// Where wi crosses the plane of a flat light, in its half axes.
STRUCT(light_crossing) {
    real distance; // negative: it does not
    real x;
    real y;
};

static inline light_crossing light_plane_crossing(vec3 c, vec3 x, vec3 y, vec3 wi)
{
    vec3 n = cross(x, y);
    real towards = dot(n, wi);
    real t = towards > 0.0f || towards < 0.0f ? dot(n, c) / towards : -1.0f;
    vec3 at = t * wi - c;
    light_crossing k;
    k.distance = t;
    k.x = dot(at, x) / max(dot(x, x), LIGHT_LEAST);
    k.y = dot(at, y) / max(dot(y, y), LIGHT_LEAST);
    return k;
}

// Both sides; the distance along wi, negative where it misses.
static inline real light_hit_rect(vec3 c, vec3 x, vec3 y, vec3 wi)
{
    light_crossing k = light_plane_crossing(c, x, y, wi);
    bool inside = k.x * k.x <= 1.0f && k.y * k.y <= 1.0f;
    return inside ? k.distance : -1.0f;
}

static inline real light_hit_disk(vec3 c, vec3 x, vec3 y, vec3 wi)
{
    light_crossing k = light_plane_crossing(c, x, y, wi);
    return k.x * k.x + k.y * k.y <= 1.0f ? k.distance : -1.0f;
}

// ---- disks --------------------------------------------------------------------------------------

// An ellipse in the plane z = height >= 0, x from the place's foot towards its centre: at x = low +
// e size, e in [0, 2], its chord is along y.  The planes through the place and the chords turn by
// `turn` about y: of their angle the density is a semicircle, which is that of a small disk's
// chords, and in each the sine of the elevation over y = 0 is uniform.
STRUCT(light_oval) {
    vec3 x;
    vec3 y;
    vec3 z;
    real height;
    real low;
    real size;
    real slope; // of the chords' middles
    real chord; // half the longest
    real turn;
};

static inline real light_oval_turn(light_oval o, real x)
{
    return atan2(o.height * (x - o.low), o.height * o.height + o.low * x);
}

static inline light_oval light_oval_from(vec3 c, vec3 half_x, vec3 half_y)
{
    light_oval o;
    vec3 n = cross(half_x, half_y);
    o.z = n / max(sqrt(dot(n, n)), LIGHT_LEAST);
    o.z = dot(c, o.z) < 0.0f ? -o.z : o.z;
    o.height = dot(c, o.z);
    vec3 off = c - o.height * o.z;
    bool aside = dot(off, off) > 1e-4f * dot(c, c);
    off = aside ? off - dot(off, o.z) * o.z : half_x;
    o.x = off / max(sqrt(dot(off, off)), LIGHT_LEAST);
    o.y = cross(o.z, o.x);
    vec2 along = vec2(dot(half_x, o.x), dot(half_y, o.x));
    vec2 across = vec2(dot(half_x, o.y), dot(half_y, o.y));
    o.size = sqrt(max(along[0] * along[0] + along[1] * along[1], LIGHT_LEAST));
    o.slope = (along[0] * across[0] + along[1] * across[1]) / o.size;
    real area = along[0] * across[1] - along[1] * across[0];
    o.chord = max(area, -area) / o.size;
    o.low = dot(c, o.x) - o.size;
    o.turn = light_oval_turn(o, o.low + 2.0f * o.size);
    return o;
}

// A chord; its ends' y times `way`, which puts its middle above 0.
STRUCT(light_chord) {
    real x;
    real low;
    real high;
    real way;
    real density;
};

// `turn` = of its plane from that of e = 0.
static inline light_chord light_oval_chord(light_oval o, real e, real turn)
{
    real share = 2.0f * turn / o.turn;
    real reach = o.chord * sqrt(e * (2.0f - e));
    real middle = o.slope * (e - 1.0f);
    light_chord c;
    c.x = o.low + e * o.size;
    c.way = middle < 0.0f ? -1.0f : 1.0f;
    c.low = c.way * middle - reach;
    c.high = c.way * middle + reach;
    real rise = light_rise(c.low, c.high, c.x * c.x + o.height * o.height);
    c.density = 4.0f * INV_PI * sqrt(max(share * (2.0f - share), 0.0f)) /
                max(o.turn * rise, LIGHT_LEAST);
    return c;
}

// Where chords still have a length.
static inline real light_oval_place(real e)
{
    return clamp(e, 1e-6f, 2.0f - 1e-6f);
}

// An ellipse; `x`, `y` = its half axes.
static inline light_sample light_sample_disk(vec3 c, vec3 x, vec3 y, vec2 u)
{
    light_oval o = light_oval_from(c, x, y);
    if (!(o.height > 0.0f && o.turn > LIGHT_LEAST))
        return light_sample_none();
    real phi = 2.0f * PI * u[1];
    real across = sqrt(u[0]) * sin(phi);
    real reach = sqrt(max(1.0f - u[0] + across * across, LIGHT_LEAST));
    real turn = 0.5f * o.turn * (1.0f + sqrt(u[0]) * cos(phi));
    real step = sin(turn) * (o.height * o.height + o.low * o.low) /
                max(o.height * cos(turn) - o.low * sin(turn), LIGHT_LEAST);
    light_chord k = light_oval_chord(o, light_oval_place(step / o.size), turn);
    real v = clamp(0.5f + 0.5f * across / reach, 0.0f, 1.0f);
    real at = k.way * light_raise(k.low, k.high, k.x * k.x + o.height * o.height, v);
    return light_sample_at(k.x * o.x + at * o.y + o.height * o.z, k.density);
}

// Of a direction that hits.
static inline real light_density_disk(vec3 c, vec3 x, vec3 y, vec3 wi)
{
    light_oval o = light_oval_from(c, x, y);
    real towards = dot(o.z, wi);
    if (!(o.height > 0.0f && towards > 0.0f && o.turn > LIGHT_LEAST))
        return 0.0f;
    real e = light_oval_place((dot(o.x, wi) * o.height / towards - o.low) / o.size);
    return light_oval_chord(o, e, light_oval_turn(o, o.low + e * o.size)).density;
}

// ---- tubes --------------------------------------------------------------------------------------

// Planes through the place and along the tube's axis cut it in stadiums: circles of radius `w`
// about (apart, low) and (apart, high), and what is between.  Their angle about that line has the
// density of the width of the tube's silhouette; the sine of the elevation along it is uniform.
STRUCT(light_tube_view) {
    vec3 along; // the axis, turned so that its middle is not below the place
    vec3 out_way;
    vec3 side;
    real apart; // of the axis from the place
    real low; // its ends
    real high;
    real turn;     // planes up to this angle to both sides cut it
    real straight; // half, as the silhouette has it
    real radius;
    bool inside;
    bool end_on; // only a round end is seen, about `end`
    vec3 end;
};

static inline light_tube_view light_tube_view_from(vec3 c, vec3 axis, real radius)
{
    light_tube_view t;
    real size = sqrt(dot(axis, axis));
    t.along = size > 0.0f ? axis / size : vec3(0.0f, 0.0f, 1.0f);
    t.along = dot(c, t.along) < 0.0f ? -t.along : t.along;
    real middle = dot(c, t.along);
    vec3 off = c - middle * t.along;
    real out2 = dot(off, off);
    t.apart = sqrt(out2);
    t.out_way = t.apart > 0.0f ? off / t.apart : light_across_from(t.along).x;
    t.side = cross(t.along, t.out_way);
    t.low = middle - size;
    t.high = middle + size;
    real touch2 = out2 - radius * radius;
    t.turn = atan2(radius, sqrt(max(touch2, 0.0f)));
    t.straight = size * t.apart / max(sqrt(dot(c, c)), LIGHT_LEAST);
    t.radius = radius;
    t.inside = touch2 + max(t.low, 0.0f) * max(t.low, 0.0f) <= 0.0f;
    t.end_on = touch2 <= 0.0f;
    t.end = c - size * t.along;
    return t;
}

// A plane's stadium, seen from the place: the tangents' sines and cosines, the sine's extent.
STRUCT(light_stadium) {
    real apart;
    real w;
    vec2 low; // sine, cosine
    vec2 high;
    real extent;
    real density;
};

// At `x` of the greatest angle; one_less = 1 - x^2.
static inline light_stadium light_stadium_at(light_tube_view t, real x, real one_less)
{
    light_stadium s;
    real psi = t.turn * x;
    real rim = t.turn * one_less / (1.0f + max(x, -x)); // the rest to the greatest angle
    s.apart = t.apart * cos(psi);
    s.w = t.apart * sqrt(max(sin(rim) * sin(2.0f * t.turn - rim), 0.0f));
    real touch2 = max(t.apart * t.apart - t.radius * t.radius, 0.0f);
    real low2 = max(s.apart * s.apart + t.low * t.low, LIGHT_LEAST);
    real high2 = max(s.apart * s.apart + t.high * t.high, LIGHT_LEAST);
    real low_t = sqrt(touch2 + t.low * t.low); // along the tangents
    real high_t = sqrt(touch2 + t.high * t.high);
    s.low = vec2(t.low * low_t - s.apart * s.w, s.apart * low_t + t.low * s.w) / low2;
    s.high = vec2(t.high * high_t + s.apart * s.w, s.apart * high_t - t.high * s.w) / high2;
    // The same sines less each other, by the angles to the middle's direction.
    real middle = 0.5f * (t.low + t.high);
    real size = 0.5f * (t.high - t.low);
    real to = sqrt(max(s.apart * s.apart + middle * middle, LIGHT_LEAST));
    real to_low = s.apart * s.apart + middle * t.low;
    real to_high = s.apart * s.apart + middle * t.high;
    real sin_low = (s.apart * size * low_t + to_low * s.w) / (to * low2);
    real cos_low = (to_low * low_t - s.apart * size * s.w) / (to * low2);
    real sin_high = (s.apart * size * high_t + to_high * s.w) / (to * high2);
    real cos_high = (to_high * high_t - s.apart * size * s.w) / (to * high2);
    real tilt = (sin_low - sin_high) / max(cos_low + cos_high, LIGHT_LEAST);
    s.extent = max((sin_low + sin_high) * (s.apart + middle * tilt) / to, LIGHT_LEAST);
    real width = t.straight + t.radius * sqrt(max(one_less, 0.0f));
    s.density = width / ((2.0f * t.straight + 0.5f * PI * t.radius) * t.turn * s.extent);
    return s;
}

// Where a ray of the plane enters the stadium.
static inline real light_stadium_distance(light_tube_view t, light_stadium s, real sine,
                                          real cosine)
{
    real wall = (s.apart - s.w) / max(cosine, LIGHT_LEAST);
    real z = wall * sine;
    real end = z > t.high ? t.high : t.low;
    real off = s.apart * sine - end * cosine;
    real cap = s.apart * cosine + end * sine - sqrt(max(s.w * s.w - off * off, 0.0f));
    return z >= t.low && z <= t.high ? wall : cap;
}

static inline light_sample light_tube_view_sample(light_tube_view t, vec2 u)
{
    // A point of the silhouette: x across it, v between its ends there.
    real straight = t.straight / (t.straight + 0.25f * PI * t.radius);
    bool rounded = u[0] >= straight;
    real part = (rounded ? u[0] - straight : u[0]) / (rounded ? 1.0f - straight : straight);
    real phi = 2.0f * PI * u[1];
    real across = sqrt(part) * sin(phi);
    real x = rounded ? sqrt(part) * cos(phi) : 2.0f * part - 1.0f;
    real one_less = rounded ? 1.0f - part + across * across : 4.0f * part * (1.0f - part);
    one_less = max(one_less, LIGHT_LEAST);
    real v = rounded ? clamp(0.5f + 0.5f * across / sqrt(one_less), 0.0f, 1.0f) : u[1];
    light_stadium s = light_stadium_at(t, x, one_less);
    // 1 - |sine| from the end of its side.
    bool up = s.low[0] + v * s.extent > 0.0f;
    real drop = up ? s.high[1] * s.high[1] / (1.0f + s.high[0]) + (1.0f - v) * s.extent
                   : s.low[1] * s.low[1] / (1.0f - s.low[0]) + v * s.extent;
    real sine = up ? 1.0f - drop : drop - 1.0f;
    real cosine = sqrt(max(drop * (2.0f - drop), 0.0f));
    real psi = t.turn * x;
    vec3 flat_way = cos(psi) * t.out_way + sin(psi) * t.side;
    light_sample at;
    at.direction = normalize(sine * t.along + cosine * flat_way);
    at.distance = light_stadium_distance(t, s, sine, cosine);
    at.density = s.density;
    return at;
}

// As light_hit_tube.
static inline real light_tube_view_hit(light_tube_view t, vec3 wi)
{
    real way = t.inside ? 1.0f : -1.0f;
    real turned = dot(wi, t.along);
    vec3 flat_way = wi - turned * t.along;
    real a = max(dot(flat_way, flat_way), LIGHT_LEAST);
    vec3 off = t.apart * t.out_way;
    real along = dot(flat_way, off) / a; // nearest to the axis
    off = off - along * flat_way;
    real reach2 = t.radius * t.radius - dot(off, off);
    if (reach2 < 0.0f)
        return -1.0f;
    real wall = along + way * sqrt(reach2 / a);
    real z = wall * turned;
    if (z >= t.low && z <= t.high)
        return wall;
    vec3 end = t.end + (z > t.high ? t.high - t.low : 0.0f) * t.along;
    return light_hit_crossing(end, t.radius, wi, way);
}

// A cylinder of half length |axis| between two half spheres; inside, all directions.
static inline light_sample light_sample_tube(vec3 c, vec3 axis, real radius, vec2 u)
{
    light_tube_view t = light_tube_view_from(c, axis, radius);
    if (t.end_on && !t.inside)
        return light_sample_sphere(t.end, radius, u);
    light_sample s;
    if (t.inside) {
        s.direction = light_cap_direction(vec3(0.0f, 0.0f, 1.0f), 2.0f, u);
        s.distance = light_tube_view_hit(t, s.direction);
        s.density = light_cap_density(2.0f);
    } else {
        s = light_tube_view_sample(t, u);
    }
    return s;
}

// 0 of directions that miss.
static inline real light_density_tube(vec3 c, vec3 axis, real radius, vec3 wi)
{
    light_tube_view t = light_tube_view_from(c, axis, radius);
    if (t.inside)
        return light_cap_density(2.0f);
    if (t.end_on)
        return light_hit_sphere(t.end, radius, wi) < 0.0f ? 0.0f
                                                          : light_density_sphere(t.end, radius);
    real x = atan2(dot(wi, t.side), dot(wi, t.out_way)) / t.turn;
    if (x * x >= 1.0f)
        return 0.0f;
    light_stadium s = light_stadium_at(t, x, (1.0f - x) * (1.0f + x));
    real sine = dot(wi, t.along);
    return sine >= s.low[0] && sine <= s.high[0] ? s.density : 0.0f;
}

// The distance along wi, negative where it misses; from inside, to the way out.
static inline real light_hit_tube(vec3 c, vec3 axis, real radius, vec3 wi)
{
    return light_tube_view_hit(light_tube_view_from(c, axis, radius), wi);
}

// ---- triangles ----------------------------------------------------------------------------------

// Of samples uniform over an area; `towards` = twice the area times the cosine.
static inline real light_area_density(real distance, real towards)
{
    real size = max(max(towards, -towards), LIGHT_LEAST);
    return min(2.0f * distance * distance / size, LIGHT_FAR);
}

// Uniform over the area.
static inline light_sample light_sample_triangle(vec3 a, vec3 b, vec3 c, vec2 u)
{
    real r = sqrt(u[0]);
    vec3 to = (1.0f - r) * a + r * (1.0f - u[1]) * b + r * u[1] * c;
    light_sample s = light_sample_at(to, 0.0f);
    real towards = dot(cross(b - a, c - a), s.direction);
    s.density = light_area_density(s.distance, towards);
    return s;
}

// Of a direction that hits.
static inline real light_density_triangle(vec3 a, vec3 b, vec3 c, vec3 wi)
{
    vec3 n = cross(b - a, c - a);
    real towards = dot(n, wi);
    return light_area_density(dot(n, a) / max(max(towards, -towards), LIGHT_LEAST), towards);
}

#endif
