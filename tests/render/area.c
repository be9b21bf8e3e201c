// Lights with extent, their bodies, ambient light and many lights as the pixels have them,
// against sums over the lights' surfaces, mirrors and each other.
#include "stage.h"

static const float PI_F = 3.14159265f;

static const ag_render_options linear = {
    .width = 64, .height = 64, .format = AG_FORMAT_RGBA32F, .background = AG_BACKGROUND_TRANSPARENT
};

static void add(ag_scene *scene, ag_light_desc desc)
{
    ag_light light;
    OK(ag_scene_add_light(scene, &desc, &light));
}

// The wall z = 0, facing +Z.
static ag_scene *wall(const ag_material_desc *material)
{
    ag_scene *scene = stage_dark();
    stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), material);
    return scene;
}

static ag_renderer *renderer; // of all tests: pipelines take long to compile

static ag_image *draw_from(ag_device *device, const ag_scene *scene, const ag_camera_desc *camera)
{
    ag_image *image;
    if (!renderer)
        OK(ag_renderer_create(device, &renderer));
    OK(ag_renderer_render(renderer, scene, camera, &linear, &image, NULL));
    return image;
}

static ag_image *draw(ag_device *device, const ag_scene *scene)
{
    const ag_camera_desc camera = stage_flat_camera();
    return draw_from(device, scene, &camera);
}

static int close_all(void **state)
{
    ag_renderer_destroy(renderer);
    return kit_close(state);
}

// Where the flat camera sees the wall.
static float at(uint32_t pixel)
{
    return ((float)pixel + 0.5f) / 32 - 1;
}

static uint32_t pixel_of(float x)
{
    return (uint32_t)((x + 1) * 32);
}

// ---- Irradiance ----------------------------------------------------------------

// A point of the light's surface and its normal times area, for (s, t) in the unit square.
typedef struct patch {
    double p[3], n[3];
} patch;

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

// The frame of a flat light or of a tube's axis.
static void axes(const ag_light_desc *d, double x[3], double y[3], double z[3])
{
    double up[3] = { 0, 1, 0 };
    for (int i = 0; i < 3; i++)
        z[i] = (double)d->direction[i];
    unit(z);
    if (fabs(z[1]) > 0.99)
        up[0] = 1, up[1] = 0;
    cross(z, up, x);
    unit(x);
    cross(x, z, y);
}

static patch sphere_patch(const double center[3], double radius, double s, double t)
{
    double z = 1 - 2 * t, r = sqrt(fmax(0, 1 - z * z)), turn = 2 * (double)PI_F * s;
    patch p = { .n = { r * cos(turn), r * sin(turn), z } };
    for (int i = 0; i < 3; i++) {
        p.p[i] = center[i] + radius * p.n[i];
        p.n[i] *= 4 * (double)PI_F * radius * radius;
    }
    return p;
}

static patch flat_patch(const ag_light_desc *d, double s, double t)
{
    double x[3], y[3], z[3], a = (s - .5) * (double)d->width_m, b = (t - .5) * (double)d->height_m;
    double area = (double)(d->width_m * d->height_m), r = (double)d->radius_m;
    axes(d, x, y, z);
    if (d->kind == AG_LIGHT_DISK) {
        a = r * sqrt(t) * cos(2 * (double)PI_F * s);
        b = r * sqrt(t) * sin(2 * (double)PI_F * s);
        area = (double)PI_F * r * r;
    }
    patch p;
    for (int i = 0; i < 3; i++) {
        p.p[i] = (double)d->position[i] + a * x[i] + b * y[i];
        p.n[i] = area * z[i];
    }
    return p;
}

// The cylinder of a tube; its ends are a sphere that is cut in two.
static patch tube_patch(const ag_light_desc *d, bool ends, double s, double t)
{
    double x[3], y[3], z[3], center[3], half = (double)d->length_m / 2, r = (double)d->radius_m;
    axes(d, x, y, z);
    for (int i = 0; i < 3; i++)
        center[i] = (double)d->position[i];
    if (ends) {
        patch p = sphere_patch(center, r, s, t);
        double side = p.n[0] * z[0] + p.n[1] * z[1] + p.n[2] * z[2];
        for (int i = 0; i < 3; i++)
            p.p[i] += side > 0 ? half * z[i] : -half * z[i];
        return p;
    }
    double turn = 2 * (double)PI_F * s;
    patch p;
    for (int i = 0; i < 3; i++) {
        p.n[i] = cos(turn) * x[i] + sin(turn) * y[i];
        p.p[i] = center[i] + r * p.n[i] + (2 * t - 1) * half * z[i];
        p.n[i] *= 2 * (double)PI_F * r * 2 * half;
    }
    return p;
}

static patch patch_of(const ag_light_desc *d, bool ends, double s, double t)
{
    const double center[3] = { (double)d->position[0], (double)d->position[1],
                               (double)d->position[2] };
    switch (d->kind) {
    case AG_LIGHT_SPHERE: return sphere_patch(center, (double)d->radius_m, s, t);
    case AG_LIGHT_TUBE: return tube_patch(d, ends, s, t);
    default: return flat_patch(d, s, t);
    }
}

// Irradiance over the radiance at the wall's point (x, y, 0), what is behind the wall left out.
static double irradiance(const ag_light_desc *d, double x, double y)
{
    const int steps = 250;
    double sum = 0;
    for (int ends = 0; ends < (d->kind == AG_LIGHT_TUBE ? 2 : 1); ends++)
        for (int j = 0; j < steps; j++)
            for (int i = 0; i < steps; i++) {
                patch p = patch_of(d, ends, (i + .5) / steps, (j + .5) / steps);
                double to[3] = { p.p[0] - x, p.p[1] - y, p.p[2] };
                double d2 = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
                double facing = -(to[0] * p.n[0] + to[1] * p.n[1] + to[2] * p.n[2]);
                if (facing > 0 && to[2] > 0)
                    sum += facing * to[2] / (d2 * d2);
            }
    return sum / (steps * steps);
}

// Whether the wall's point is inside a light, or so near that the sum above is rough.
static bool is_inside(const ag_light_desc *d, float x, float y)
{
    double to[3] = { (double)d->position[0] - (double)x, (double)d->position[1] - (double)y,
                     (double)d->position[2] };
    double ax[3], ay[3], az[3] = { 0 }, along = 0, d2 = 0;
    if (d->kind == AG_LIGHT_TUBE)
        axes(d, ax, ay, az);
    for (int i = 0; i < 3; i++)
        along -= to[i] * az[i];
    along = fmax(fmin(along, (double)d->length_m / 2), (double)d->length_m / -2);
    for (int i = 0; i < 3; i++)
        d2 += (to[i] + along * az[i]) * (to[i] + along * az[i]);
    bool hollow = d->kind == AG_LIGHT_SPHERE || d->kind == AG_LIGHT_TUBE;
    return hollow && sqrt(d2) < 1.1 * (double)d->radius_m;
}

static float radiance(const ag_light_desc *d)
{
    bool sphere = d->kind == AG_LIGHT_SPHERE;
    return sphere ? d->intensity / (PI_F * d->radius_m * d->radius_m) : d->intensity;
}

static const ag_light_desc shapes[] = {
    { .kind = AG_LIGHT_SPHERE, .position = { 0.3f, 0, 1 }, .radius_m = 0.5f, .intensity = 2 },
    { .kind = AG_LIGHT_SPHERE, .position = { 0.5f, 0, 0.2f }, .radius_m = 0.6f, .intensity = 2 },
    { .kind = AG_LIGHT_RECT,
      .position = { 0, 0.3f, 1 },
      .direction = { 0.3f, 0.2f, -1 },
      .width_m = 1.5f,
      .height_m = 0.6f,
      .intensity = 3 },
    { .kind = AG_LIGHT_RECT, // upright on the wall and through it
      .position = { 1, 0, 0.1f },
      .direction = { -1, 0, 0 },
      .width_m = 1,
      .height_m = 2,
      .intensity = 3 },
    { .kind = AG_LIGHT_DISK,
      .position = { 0, 0.3f, 1 },
      .direction = { 0.4f, 0.2f, -1 },
      .radius_m = 0.7f,
      .intensity = 3 },
    { .kind = AG_LIGHT_DISK,
      .position = { 1, 0, 0.1f },
      .direction = { -1, 0.1f, 0 },
      .radius_m = 0.7f,
      .intensity = 3 },
    { .kind = AG_LIGHT_TUBE,
      .position = { 0, 0.2f, 0.8f },
      .direction = { 1, 0, 0.3f },
      .radius_m = 0.1f,
      .length_m = 1.6f,
      .intensity = 3 },
    { .kind = AG_LIGHT_TUBE,
      .position = { -0.9f, 0.2f, 0.2f },
      .direction = { 0.3f, 0, 1 },
      .radius_m = 0.2f,
      .length_m = 1.5f,
      .intensity = 3 },
};

static void a_matte_wall_has_the_light_s_irradiance(void **state)
{
    const ag_material_desc matte = stage_matte(1);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        ag_scene *scene = wall(&matte);
        ag_light_desc light = shapes[i];
        light.hidden = true;
        add(scene, light);
        ag_image *image = draw(*state, scene);
        for (uint32_t y = 4; y < 64; y += 20)
            for (uint32_t x = 4; x < 64; x += 11) {
                if (is_inside(&light, at(x), -at(y)))
                    continue;
                double e = irradiance(&light, (double)at(x), -(double)at(y));
                float wanted = (float)e * radiance(&light) / PI_F;
                assert_close(stage_float(image, x, y)[1], wanted, 4e-3f * wanted + 2e-3f);
            }
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

static float lit_center(ag_device *device, const ag_material_desc *material, ag_light_desc light)
{
    ag_scene *scene = wall(material);
    light.hidden = true;
    add(scene, light);
    ag_image *image = draw(device, scene);
    float value = stage_float(image, 40, 28)[1];
    ag_image_destroy(image);
    ag_scene_destroy(scene);
    return value;
}

// As it shrinks at constant intensity, down to a millionth of its distance.
static void a_small_sphere_is_a_point(void **state)
{
    ag_material_desc glossy = ag_material_default();
    glossy.roughness = 0.4f;
    const ag_material_desc materials[2] = { stage_matte(0.5f), glossy };
    for (int m = 0; m < 2; m++) {
        ag_light_desc light = { .position = { -0.4f, 0.2f, 1 }, .intensity = 5 };
        float point = lit_center(*state, &materials[m], light);
        light.kind = AG_LIGHT_SPHERE;
        for (float radius = 1e-2f; radius > 0.9e-6f; radius *= 0.1f) {
            light.radius_m = radius;
            assert_close(lit_center(*state, &materials[m], light), point, 2e-3f * point);
        }
        light.radius_m = 0;
        assert_close(lit_center(*state, &materials[m], light), point, 2e-3f * point);
    }
}

// So is what faces the place, or lies across it, of radiance times area as much intensity.
static void small_shapes_are_points(void **state)
{
    ag_material_desc glossy = ag_material_default();
    glossy.roughness = 0.4f;
    const float at_40 = 40.5f / 32 - 1, at_28 = 1 - 28.5f / 32;
    ag_light_desc light = { .position = { -0.4f, 0.2f, 1 }, .intensity = 5 };
    float point = lit_center(*state, &glossy, light);
    const float to[3] = { at_40 + 0.4f, at_28 - 0.2f, -1 };
    for (float size = 1e-3f; size > 0.9e-6f; size *= 0.1f) {
        light.radius_m = light.width_m = size;
        light.height_m = light.length_m = 3 * size;
        const ag_light_kind kinds[3] = { AG_LIGHT_RECT, AG_LIGHT_DISK, AG_LIGHT_TUBE };
        const float areas[3] = { 3 * size * size, PI_F * size * size, (6 + PI_F) * size * size };
        for (int i = 0; i < 3; i++) {
            light.kind = kinds[i];
            light.intensity = 5 / areas[i];
            memcpy(light.direction, to, sizeof to);
            if (light.kind == AG_LIGHT_TUBE)
                memcpy(light.direction, (float[3]) { 1, 0, to[0] }, sizeof to);
            assert_close(lit_center(*state, &glossy, light), point, 4e-3f * point);
        }
    }
}

// A sun shrinks to a directional light.
static void a_small_sun_is_a_direction(void **state)
{
    ag_material_desc glossy = ag_material_default();
    glossy.roughness = 0.4f;
    ag_light_desc light = { .kind = AG_LIGHT_DIRECTIONAL,
                            .direction = { 0.2f, -0.1f, -1 },
                            .intensity = 5 };
    float directional = lit_center(*state, &glossy, light);
    light.kind = AG_LIGHT_SUN;
    for (float angle = 1e-2f; angle > 0.9e-6f; angle *= 0.1f) {
        light.angular_radius_rad = angle;
        assert_close(lit_center(*state, &glossy, light), directional, 2e-3f * directional);
    }
}

// ---- Mirrors and bodies ----------------------------------------------------------

// What stands over the wall, of half the extents x and y as the wall sees it.
typedef struct outline {
    ag_light_desc light;
    float x, y;
} outline;

static const outline outlines[] = {
    { { .kind = AG_LIGHT_SPHERE, .position = { 0, 0, 2 }, .radius_m = 0.5f, .intensity = 1 },
      0.5f,
      0.5f },
    { { .kind = AG_LIGHT_DISK, .position = { 0, 0, 2 }, .radius_m = 0.5f, .intensity = 2 },
      0.5f,
      0.5f },
    { { .kind = AG_LIGHT_RECT,
        .position = { 0, 0, 2 },
        .width_m = 1.2f,
        .height_m = 0.6f,
        .intensity = 2 },
      0.6f,
      0.3f },
    { { .kind = AG_LIGHT_TUBE,
        .position = { 0, 0, 2 },
        .radius_m = 0.2f,
        .length_m = 1,
        .intensity = 2 },
      0.7f,
      0.2f },
};

// A perfect mirror shows the light as bright as it is, and nothing beside it.
static void a_mirror_shows_the_light(void **state)
{
    ag_material_desc mirror = ag_material_default();
    mirror.roughness = 0;
    for (size_t i = 0; i < sizeof outlines / sizeof *outlines; i++) {
        const outline *o = &outlines[i];
        ag_scene *scene = wall(&mirror);
        ag_light_desc light = o->light;
        light.hidden = true;
        add(scene, light);
        ag_image *image = draw(*state, scene);
        float wanted = radiance(&light);
        const uint32_t half = 32;
        assert_close(stage_float(image, half, half)[0], wanted, 0.01f * wanted);
        assert_close(stage_float(image, pixel_of(0.9f * o->x), half)[0], wanted, 0.02f * wanted);
        assert_close(stage_float(image, half, pixel_of(-0.9f * o->y))[0], wanted, 0.02f * wanted);
        assert_close(stage_float(image, pixel_of(1.15f * o->x), half)[0], 0, 0.02f * wanted);
        assert_close(stage_float(image, half, pixel_of(1.2f * o->y))[0], 0, 0.02f * wanted);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

static float sum_of(const ag_image *image)
{
    float sum = 0;
    for (uint32_t y = 0; y < 64; y++)
        for (uint32_t x = 0; x < 64; x++)
            sum += stage_float(image, x, y)[0] * stage_float(image, x, y)[3]; // it is straight
    return sum;
}

// Seen itself, it has that radiance too, over the area that it has.
static void a_light_is_seen(void **state)
{
    ag_camera_desc camera = stage_flat_camera();
    const float areas[4] = { PI_F * 0.25f, PI_F * 0.25f, 0.72f, PI_F * 0.04f + 0.4f };
    for (int i = 0; i < 4; i++) {
        ag_scene *scene = stage_dark();
        ag_light_desc light = outlines[i].light;
        if (light.kind != AG_LIGHT_TUBE)
            light.direction[2] = 1; // towards the eye
        add(scene, light);
        ag_image *image = draw_from(*state, scene, &camera);
        assert_close(stage_float(image, 32, 32)[0], radiance(&light), 1e-3f * radiance(&light));
        float pixels = sum_of(image) / radiance(&light);
        assert_close(pixels / 1024, areas[i], 0.02f * areas[i]);
        ag_image_destroy(image);
        ag_scene_destroy(scene);

        scene = stage_dark(); // from behind, or hidden: nothing
        light.direction[2] = -light.direction[2];
        light.hidden = light.kind == AG_LIGHT_SPHERE || light.kind == AG_LIGHT_TUBE;
        add(scene, light);
        image = draw_from(*state, scene, &camera);
        assert_close(sum_of(image), 0, 1e-6f);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

// A sun stands in the sky behind everything, as large as it is.
static void a_sun_is_seen(void **state)
{
    ag_scene *scene = stage_dark();
    const float angle = 0.2f, fov = 1;
    add(scene, (ag_light_desc) { .kind = AG_LIGHT_SUN,
                                 .direction = { 0, 0, 1 },
                                 .angular_radius_rad = angle,
                                 .intensity = 3 });
    stage_show(scene, stage_quad(scene, -9, -9, 0, 9, 0, NULL),
               &(ag_material_desc) { .base_color = { 0, 0, 0, 1 }, .unlit = true });
    const ag_camera_desc camera = { .position = { 0, 0, 3 }, .fov_y_rad = fov };
    ag_render_options options = linear;
    options.background = AG_BACKGROUND_ENVIRONMENT;
    ag_image *image = stage_render(*state, scene, &camera, &options);
    float wanted = 3 / (PI_F * sinf(angle) * sinf(angle));
    assert_close(stage_float(image, 34, 32)[0], wanted, 1e-3f * wanted);
    assert_close(stage_float(image, 29, 32)[0], 0, 1e-6f);
    float radius = 32 * tanf(angle) / tanf(fov / 2); // px
    assert_close(sum_of(image) / wanted, PI_F / 2 * radius * radius, 8);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// ---- Ambient light -----------------------------------------------------------------

static void ambient_light_is_a_sum(void **state)
{
    const ag_material_desc matte = stage_matte(0.5f);
    ag_scene *scene = wall(&matte);
    add(scene, (ag_light_desc) { .kind = AG_LIGHT_AMBIENT, .intensity = 2 });
    // The wall faces +Z, 60 degrees off the axis: three quarters of above, one of below.
    add(scene, (ag_light_desc) { .kind = AG_LIGHT_HEMISPHERIC,
                                 .direction = { 0, sqrtf(3), 1 },
                                 .color = { 1, 1, 1 },
                                 .ground_color = { 0.2f, 0.2f, 0.2f },
                                 .intensity = 4 });
    ag_light_desc harmonics = { .kind = AG_LIGHT_HARMONICS, .intensity = 3 };
    for (int i = 0; i < 9; i++) // 1 + z + 2 (3z^2 - 1) here; the rest is 0 for n = z
        harmonics.harmonics[i][1] = i == 6 ? 2 : 1;
    add(scene, harmonics);
    ag_image *image = draw(*state, scene);
    float wanted = 0.5f * (2 + 4 * (0.75f + 0.25f * 0.2f) + 3 * (1 + 1 + 2 * 2));
    assert_close(stage_float(image, 20, 20)[1], wanted, 1e-3f * wanted);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// ---- Many lights -------------------------------------------------------------------

static unsigned dice = 1;

static float roll(float low, float high)
{
    dice = dice * 1664525u + 1013904223u;
    return low + (high - low) * (float)(dice >> 8) / 16777216.0f;
}

enum { MANY = 260, FEW = 13 };

static ag_light_desc any_light(int i)
{
    const ag_light_kind kinds[] = { AG_LIGHT_POINT, AG_LIGHT_SPHERE, AG_LIGHT_SPOT, AG_LIGHT_RECT };
    return (ag_light_desc) {
        .kind = kinds[i % 4],
        .position = { roll(-4, 4), roll(-4, 4), roll(0.2f, 2) },
        .direction = { roll(-1, 1), roll(-1, 1), -1 },
        .color = { roll(0, 1), roll(0, 1), roll(0, 1) },
        .intensity = roll(0.2f, 1),
        .range_m = i % 11 == 6 ? 0 : roll(0.5f, 2.5f),
        .radius_m = roll(0.02f, 0.2f),
        .width_m = 0.3f,
        .height_m = 0.2f,
        .hidden = true,
    };
}

// The picture of lights `first` to `last` of the many.
static ag_image *draw_lights(ag_device *device, const ag_camera_desc *camera, int first, int last)
{
    ag_material_desc glossy = ag_material_default();
    glossy.roughness = 0.5f;
    ag_scene *scene = wall(&glossy);
    dice = 1;
    for (int i = 0; i < last; i++) {
        ag_light_desc light = any_light(i);
        if (i >= first)
            add(scene, light);
    }
    ag_image *image = draw_from(device, scene, camera);
    ag_scene_destroy(scene);
    return image;
}

// Sorted into clusters they give what they give a few at a time, when every pixel looks at all.
static void many_lights_add_up(void **state)
{
    const ag_camera_desc cameras[] = {
        stage_flat_camera(),
        { .position = { 1, 1, 0.6f }, .target = { -3, -2, 0 }, .up = { 0, 0, 1 }, .fov_y_rad = 2 },
    };
    for (int c = 0; c < 2; c++) {
        float *sum = calloc(64 * 64, sizeof *sum);
        for (int first = 0; first < MANY; first += FEW) {
            ag_image *image = draw_lights(*state, &cameras[c], first, first + FEW);
            for (uint32_t i = 0; i < 64 * 64; i++)
                sum[i] += stage_float(image, i % 64, i / 64)[1];
            ag_image_destroy(image);
        }
        ag_image *image = draw_lights(*state, &cameras[c], 0, MANY);
        for (uint32_t i = 0; i < 64 * 64; i++) {
            float got = stage_float(image, i % 64, i / 64)[1];
            assert_close(got, sum[i], 2e-3f * sum[i] + 1e-4f);
        }
        ag_image_destroy(image);
        free(sum);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matte_wall_has_the_light_s_irradiance),
        cmocka_unit_test(a_small_sphere_is_a_point),
        cmocka_unit_test(small_shapes_are_points),
        cmocka_unit_test(a_small_sun_is_a_direction),
        cmocka_unit_test(a_mirror_shows_the_light),
        cmocka_unit_test(a_light_is_seen),
        cmocka_unit_test(a_sun_is_seen),
        cmocka_unit_test(ambient_light_is_a_sum),
        cmocka_unit_test(many_lights_add_up),
    };
    return cmocka_run_group_tests(tests, kit_open, close_all);
}
