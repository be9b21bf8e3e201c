// What every light gives to a white lambertian floor: E / pi, by closed forms and by quadratures
// in double precision over each body's own surface.
#include "stage.h"

typedef struct point {
    double x, y, z;
} point;

static point sum(point a, double t, point b)
{
    return (point) { a.x + t * b.x, a.y + t * b.y, a.z + t * b.z };
}

static double dot3(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point cross3(point a, point b)
{
    return (point) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static point unit(point a)
{
    double size = sqrt(dot3(a, a));
    return (point) { a.x / size, a.y / size, a.z / size };
}

static point from(const float v[3])
{
    return (point) { (double)v[0], (double)v[1], (double)v[2] };
}

static point across(point a)
{
    point other = fabs(a.x) < 0.7 ? (point) { 1, 0, 0 } : (point) { 0, 1, 0 };
    return unit(cross3(a, other));
}

// ---- Truths: irradiance of the origin, facing up ---------------------------------------

enum { NODES = 500 };

// What the patch `area` at p, facing n, sends per unit of radiance.
static double sent(point p, point n, double area)
{
    double r2 = dot3(p, p), facing = -dot3(p, n);
    return p.y > 0 && facing > 0 ? area * p.y * facing / (r2 * r2) : 0;
}

static double of_rectangle(point c, point x, point y, point n)
{
    double total = 0, area = 4 * sqrt(dot3(x, x) * dot3(y, y)) / NODES / NODES;
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            double s = (2 * i + 1.0) / NODES - 1, t = (2 * k + 1.0) / NODES - 1;
            total += sent(sum(sum(c, s, x), t, y), n, area);
        }
    return total;
}

static double of_disk(point c, double radius, point n)
{
    double total = 0, area = pi * radius * radius / NODES / NODES;
    point x = across(n), y = cross3(n, x);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            double r = radius * sqrt((i + 0.5) / NODES), phi = 2 * pi * (k + 0.5) / NODES;
            total += sent(sum(sum(c, r * cos(phi), x), r * sin(phi), y), n, area);
        }
    return total;
}

// Convex, so that what faces the place is seen by it.
static double of_tube(point c, point axis, double length, double radius)
{
    double total = 0, ball = 4 * pi * radius * radius / NODES / NODES,
           wall = 2 * pi * radius * length / NODES / NODES;
    point x = across(axis), y = cross3(axis, x);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            double z = (2 * i + 1.0) / NODES - 1, phi = 2 * pi * (k + 0.5) / NODES;
            double r = sqrt(1 - z * z);
            point out = sum(sum((point) { 0 }, cos(phi), x), sin(phi), y);
            point n = sum(sum((point) { 0 }, r, out), z, axis);
            point end = sum(c, z > 0 ? length / 2 : -length / 2, axis);
            total += sent(sum(end, radius, n), n, ball);
            total += sent(sum(sum(c, z * length / 2, axis), radius, out), out, wall);
        }
    return total;
}

// The directions about `to`, within an angle.
static double of_cap(point to, double radius)
{
    double total = 0, size = 2 * pi * (1 - cos(radius)) / NODES / NODES;
    point x = across(to), y = cross3(to, x);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            double c = 1 - (1 - cos(radius)) * (i + 0.5) / NODES, s = sqrt(1 - c * c);
            double phi = 2 * pi * (k + 0.5) / NODES;
            point d = sum(sum(sum((point) { 0 }, c, to), s * cos(phi), x), s * sin(phi), y);
            total += d.y > 0 ? d.y * size : 0;
        }
    return total;
}

// Lambert 1760: the form factor of a polygon, here a triangle above the horizon.
static double of_triangle(point a, point b, point c)
{
    const point p[4] = { unit(a), unit(b), unit(c), unit(a) };
    double total = 0;
    for (int i = 0; i < 3; i++) {
        point n = cross3(p[i], p[i + 1]);
        double sine = sqrt(dot3(n, n));
        total += atan2(sine, dot3(p[i], p[i + 1])) * n.y / sine;
    }
    return fabs(total) / 2;
}

// ---- Pictures --------------------------------------------------------------------------

static ag_scene *lit_floor(void)
{
    ag_scene *scene = stage_dark();
    const ag_material_desc white = stage_matte(1);
    stage_show(scene, stage_floor(scene, 0, 0.01f), &white, NULL);
    return scene;
}

// Takes the scene.
static void assert_irradiance(const char *what, ag_scene *scene, uint32_t samples, double wanted)
{
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(32, 32);
    ag_image *image =
        stage_trace(scene, &camera, &picture, &(ag_reference_options) { .seed = 5 }, samples);
    estimate e = stage_estimate(image, 0);
    e.mean *= pi;
    e.error *= pi;
    assert_agrees(what, e, wanted, 1e-5 * wanted);
    assert_agrees(what, ((estimate) { e.mean, 0 }), wanted, 0.005 * wanted);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void assert_light(const char *what, const ag_light_desc *light, double wanted)
{
    ag_scene *scene = lit_floor();
    stage_light(scene, light);
    assert_irradiance(what, scene, 64, wanted);
}

// ---- Without extent ----------------------------------------------------------------------

static void points_and_spots(void **state)
{
    (void)state;
    ag_light_desc l = { .kind = AG_LIGHT_POINT, .position = { 1, 2, -0.5f }, .intensity = 3 };
    double d2 = 5.25, E = 3 * 2 / (d2 * sqrt(d2));
    assert_light("point", &l, E);
    l.range_m = 4;
    assert_light("point in its range", &l, E * (1 - d2 * d2 / 256));
    l.range_m = 0;
    l.kind = AG_LIGHT_SPOT;
    l.direction[1] = -1;
    l.cone_inner_rad = 0.2f;
    l.cone_outer_rad = 0.9f;
    double share = (2 / sqrt(d2) - cos((double)l.cone_outer_rad)) /
                   (cos((double)l.cone_inner_rad) - cos((double)l.cone_outer_rad));
    assert_light("spot", &l, E * share * share);
    l = (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL, .direction = { 3, -4, 0 }, .intensity = 2 };
    assert_light("directional", &l, 1.6);
}

// ---- Bodies --------------------------------------------------------------------------------

static void spheres(void **state)
{
    (void)state;
    ag_light_desc l = {
        .kind = AG_LIGHT_SPHERE, .position = { 1, 2, -0.5f }, .radius_m = 1, .intensity = 3
    };
    assert_light("whole sphere", &l, 3 * 2 / (5.25 * sqrt(5.25)));
    const float places[][4] = { { 1, 0.1f, 0.3f, 0.6f },
                                { -1, -0.3f, 0, 0.7f },
                                { 0, 1, 0.2f, 1 } };
    for (int i = 0; i < 3; i++) {
        memcpy(l.position, places[i], sizeof l.position);
        l.radius_m = places[i][3];
        point c = from(l.position);
        double r = (double)l.radius_m, angle = asin(r / sqrt(dot3(c, c)));
        assert_light("sphere", &l, 3 / (pi * r * r) * of_cap(unit(c), angle));
    }
    // Within: the hemisphere towards its centre, of irradiance pi L.
    l.position[1] = 0.3f;
    l.position[2] = 0;
    assert_light("within a sphere", &l, 3);
}

static void suns(void **state)
{
    (void)state;
    const float cases[][4] = { { 0.3f, -1, 0.2f, 0.00465f },
                               { 0.3f, -1, 0.2f, 0.8f },
                               { 1, -0.1f, 0.2f, 0.3f },
                               { -1, 0.2f, 0.1f, 0.5f } };
    for (int i = 0; i < 4; i++) {
        ag_light_desc l = { .kind = AG_LIGHT_SUN, .intensity = 2 };
        memcpy(l.direction, cases[i], sizeof l.direction);
        l.angular_radius_rad = cases[i][3];
        double radius = (double)l.angular_radius_rad, s = sin(radius);
        point to = sum((point) { 0 }, -1, unit(from(l.direction)));
        assert_light("sun", &l, 2 / (pi * s * s) * of_cap(to, radius));
    }
}

static void flat_lights(void **state)
{
    (void)state;
    // Position, direction; the last two are cut by the horizon.
    const float cases[][6] = { { 0.5f, 2, -0.5f, 0, -1, 0 },
                               { 0.2f, 0.5f, 0.1f, 0.3f, -1, 0.5f },
                               { 1.5f, 0.3f, 0.3f, -1, 0.1f, 0 },
                               { -1, -0.2f, 0.5f, 1, 0.2f, -0.5f } };
    for (int i = 0; i < 4; i++) {
        ag_light_desc l = { .kind = AG_LIGHT_RECT,
                            .up = { 1, 2, 3 },
                            .width_m = 1,
                            .height_m = 1.6f,
                            .radius_m = 0.8f,
                            .intensity = 3 };
        memcpy(l.position, cases[i], sizeof l.position);
        memcpy(l.direction, cases[i] + 3, sizeof l.direction);
        point n = unit(from(l.direction)), up = from(l.up);
        point y = unit(sum(up, -dot3(up, n), n)), x = cross3(n, y);
        point none = { 0, 0, 0 };
        double E = of_rectangle(from(l.position), sum(none, 0.5, x), sum(none, 0.8, y), n);
        assert_light("rectangle", &l, 3 * E);
        l.kind = AG_LIGHT_DISK;
        assert_light("disk", &l, 3 * of_disk(from(l.position), (double)l.radius_m, n));
    }
}

static void tubes(void **state)
{
    (void)state;
    const float cases[][8] = { { 0.5f, 2, -0.5f, 1, 0, 0, 2, 0.3f },
                               { 0.2f, 0.6f, 0.1f, 0.3f, 0.1f, 1, 3, 0.05f },
                               { 1, 0.3f, 0.3f, 0.2f, 1, 0, 1.5f, 0.4f },
                               { -1, 0.1f, 0.5f, 1, 0.2f, 0.5f, 1, 0.3f } };
    for (int i = 0; i < 4; i++) {
        ag_light_desc l = { .kind = AG_LIGHT_TUBE, .intensity = 3 };
        memcpy(l.position, cases[i], sizeof l.position);
        memcpy(l.direction, cases[i] + 3, sizeof l.direction);
        l.length_m = cases[i][6];
        l.radius_m = cases[i][7];
        assert_light("tube", &l,
                     3 * of_tube(from(l.position), unit(from(l.direction)), (double)l.length_m,
                                 (double)l.radius_m));
    }
}

// ---- Surfaces that shine -----------------------------------------------------------------

// A triangle as it is, mirrored and stretched, mirrored by its diagonal: alone, and as one of two
// of its kind, whose other is below the floor.
static void triangles_that_shine(void **state)
{
    (void)state;
    const float corners[3][3] = { { -0.7f, 0, 0.2f }, { 0.8f, 0.3f, 0 }, { 0.1f, 0.4f, 0.9f } };
    const float worlds[4][16] = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0, 1 },
                                  { -2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0.7f, 0, 1 },
                                  { 0, 0, 1, 0, 0, 1, 0, 0, 3, 0, 0, 0, -1, 1, 0.3f, 1 },
                                  { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -9, 0, 1 } };
    ag_material_desc glowing = stage_matte(0);
    stage_glow(&glowing, 2);
    for (int i = 0; i < 6; i++) {
        const float *w = worlds[i % 3];
        ag_scene *scene = lit_floor();
        ag_mesh mesh;
        const ag_mesh_desc desc = { .positions = &corners[0][0], .vertex_count = 3 };
        OK(ag_scene_add_mesh(scene, &desc, &mesh));
        stage_show(scene, mesh, &glowing, w);
        if (i >= 3)
            stage_show(scene, mesh, &glowing, worlds[3]);
        point p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = from(w + 12);
            for (int c = 0; c < 3; c++)
                p[k] = sum(p[k], (double)corners[k][c], from(w + 4 * c));
        }
        bool mirrored = i % 3 > 0; // of a negative determinant: the other side is the front
        point n = cross3(sum(p[1], -1, p[0]), sum(p[2], -1, p[0]));
        bool faces = (dot3(n, p[0]) < 0) != mirrored;
        assert_true(faces);
        assert_irradiance("triangle", scene, 64, 2 * of_triangle(p[0], p[1], p[2]));
    }
}

// The same, but turned away.
static void backs_are_dark(void **state)
{
    (void)state;
    ag_material_desc glowing = stage_matte(0);
    stage_glow(&glowing, 2);
    ag_scene *scene = lit_floor();
    stage_show(scene, stage_floor(scene, 1, 0.5f), &glowing,
               (float[16]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1 });
    assert_irradiance("back", scene, 16, 0);
    scene = lit_floor();
    glowing.double_sided = true;
    stage_show(scene,
               stage_quad(scene, (float[3]) { -0.5f, 1, 0.5f }, (float[3]) { 1, 0, 0 },
                          (float[3]) { 0, 0, -1 }),
               &glowing, (float[16]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1 });
    const point none = { 0, 0, 0 };
    assert_irradiance("both sides", scene, 64,
                      2 * of_rectangle((point) { -1, 1, 0 }, sum(none, 0.5, (point) { 1, 0, 0 }),
                                       sum(none, 0.5, (point) { 0, 0, 1 }), (point) { 0, -1, 0 }));
}

static void a_ball_that_shines(void **state)
{
    (void)state;
    ag_scene *scene = lit_floor();
    ag_material_desc glowing = stage_matte(0);
    stage_glow(&glowing, 2);
    stage_show(scene, stage_ball(scene, 48, 0.7f, false, false), &glowing,
               (float[16]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.5f, 0.1f, 0.2f, 1 });
    // The facets' ball is smaller by the mean of cos x cos y over their half angles.
    double shrunk = 0.7 * (1 - pow(pi / 96, 2) / 3);
    assert_irradiance("ball", scene, 400,
                      2 * of_tube((point) { -1.5, 0.1, 0.2 }, (point) { 0, 0, 1 }, 0, shrunk));
}

// ---- From all sides ------------------------------------------------------------------------

static void skies(void **state)
{
    (void)state;
    ag_scene *scene = lit_floor();
    stage_surround(scene, 3);
    assert_irradiance("sky", scene, 64, 3 * pi);
    ag_light_desc l = { .kind = AG_LIGHT_AMBIENT, .intensity = 2 };
    assert_light("ambient", &l, 2 * pi);
    l.kind = AG_LIGHT_HEMISPHERIC;
    memcpy(l.direction, (float[3]) { 0.6f, 0.8f, 0 }, sizeof l.direction);
    memcpy(l.ground_color, (float[3]) { 0.25f, 0.25f, 0.25f }, sizeof l.ground_color);
    // A share (1 + cos) / 2 of what a plane sees is on the side of the axis.
    assert_light("hemispheric", &l, 2 * pi * (0.9 + 0.1 * 0.25));
    l = (ag_light_desc) { .kind = AG_LIGHT_HARMONICS, .intensity = 2 };
    l.harmonics[0][0] = l.harmonics[0][1] = l.harmonics[0][2] = 0.5f;
    l.harmonics[2][0] = l.harmonics[2][1] = l.harmonics[2][2] = 0.25f;
    assert_light("harmonics", &l, 2 * pi * 0.75);
}

// A picture of noise with one bright pixel, bilinear, turned; it lights a wall that faces +X.
enum { WIDE = 16, HIGH = 8 };

static double sky_of(const float (*pixels)[4], double u, double v)
{
    double x = u * WIDE - 0.5, y = v * HIGH - 0.5, total = 0;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            double column = floor(x) + i, row = floor(y) + k;
            double weight = (1 - fabs(x - column)) * (1 - fabs(y - row));
            row = fmin(fmax(row, 0), HIGH - 1);
            total += weight * (double)pixels[(int)row * WIDE + ((int)column + WIDE) % WIDE][0];
        }
    return total;
}

static void pictures_of_skies(void **state)
{
    (void)state;
    float pixels[WIDE * HIGH][4];
    uint32_t seed = 1;
    for (int i = 0; i < WIDE * HIGH; i++) {
        seed = seed * 1664525u + 1013904223u;
        float light = (float)(seed >> 8) * 0x1p-24f;
        light = i == 3 * WIDE + 11 ? 300 : light * light;
        memcpy(pixels[i], (float[4]) { light, light, light, 1 }, sizeof *pixels);
    }
    const double turn = 1.1;
    double E = 0;
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < 2 * NODES; k++) {
            double theta = pi * (i + 0.5) / NODES, phi = pi * (k + 0.5) / NODES;
            // The picture's middle is +X, and its right half +Z before the turn.
            double u = fmod(phi / (2 * pi) + 0.5, 1), x = sin(theta) * cos(phi - turn);
            E += fmax(x, 0) * sin(theta) * pi / NODES * pi / NODES *
                 sky_of((const float(*)[4])pixels, u, theta / pi);
        }
    ag_scene *scene = stage_dark();
    const ag_material_desc white = stage_matte(1);
    const float corner[3] = { 0, -0.01f, 0.01f }, u[3] = { 0, 0, -0.02f }, v[3] = { 0, 0.02f, 0 };
    stage_show(scene, stage_quad(scene, corner, u, v), &white, NULL);
    stage_surround_image(scene, WIDE, HIGH, (const float(*)[4])pixels, (float)turn);
    assert_irradiance("picture", scene, 64, E);
}

// ---- Half hidden ---------------------------------------------------------------------------

// Something black above x < 0: its edge and the origin are in the plane x = 0.
static void assert_half(const char *what, ag_scene *scene, double whole)
{
    const ag_material_desc black = stage_matte(0);
    ag_mesh wall = stage_quad(scene, (float[3]) { -40, 0.1f, 40 }, (float[3]) { 40, 0, 0 },
                              (float[3]) { 0, 0, -80 });
    stage_show(scene, wall, &black, NULL);
    assert_irradiance(what, scene, 64, whole / 2);
}

static void what_hides_half_takes_half(void **state)
{
    (void)state;
    const ag_light_desc lights[] = {
        { .kind = AG_LIGHT_SPHERE, .position = { 0, 2, 1 }, .radius_m = 0.5f, .intensity = 1 },
        { .kind = AG_LIGHT_SUN,
          .direction = { 0, -1, 0.3f },
          .angular_radius_rad = 0.3f,
          .intensity = 1 },
        { .kind = AG_LIGHT_DISK,
          .position = { 0, 2, 1 },
          .direction = { 0, -1, 0 },
          .radius_m = 0.5f,
          .intensity = 1 },
        { .kind = AG_LIGHT_RECT,
          .position = { 0, 2, 1 },
          .direction = { 0, -1, 0 },
          .up = { 0, 0, 1 },
          .width_m = 1,
          .height_m = 2,
          .intensity = 1 },
        { .kind = AG_LIGHT_TUBE,
          .position = { 0, 2, 1 },
          .length_m = 1,
          .radius_m = 0.2f,
          .intensity = 1 },
    };
    const point down = { 0, -1, 0 }, at = { 0, 2, 1 }, x = { 0.5, 0, 0 }, z = { 0, 0, 1 };
    const double whole[] = { 2 / (5 * sqrt(5)), 1 / sqrt(1.09), of_disk(at, 0.5, down),
                             of_rectangle(at, x, z, down),
                             of_tube(at, (point) { 1, 0, 0 }, 1, (double)0.2f) };
    for (int i = 0; i < 5; i++) {
        ag_scene *scene = lit_floor();
        stage_light(scene, &lights[i]);
        assert_half("half a light", scene, whole[i]);
    }
    ag_scene *scene = lit_floor();
    stage_surround(scene, 1);
    assert_half("half a sky", scene, pi);
    scene = lit_floor();
    ag_material_desc glowing = stage_matte(0);
    stage_glow(&glowing, 1);
    stage_show(scene,
               stage_quad(scene, (float[3]) { -0.5f, 2, 0 }, (float[3]) { 1, 0, 0 },
                          (float[3]) { 0, 0, 2 }),
               &glowing, NULL);
    assert_half("half a surface", scene, whole[3]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_and_spots),
        cmocka_unit_test(spheres),
        cmocka_unit_test(suns),
        cmocka_unit_test(flat_lights),
        cmocka_unit_test(tubes),
        cmocka_unit_test(triangles_that_shine),
        cmocka_unit_test(backs_are_dark),
        cmocka_unit_test(a_ball_that_shines),
        cmocka_unit_test(skies),
        cmocka_unit_test(pictures_of_skies),
        cmocka_unit_test(what_hides_half_takes_half),
    };
    return cmocka_run_group_tests_name("irradiance", tests, NULL, NULL);
}
