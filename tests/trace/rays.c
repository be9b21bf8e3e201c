// What rays meet, against a search through all triangles in double precision: Moller & Trumbore
// 1997.
#include "stage.h"

#include "scene/scene.h"
#include "trace/world.h"

enum { RAYS = 4000, CHECKS = 4 };

typedef double point[3];

static double dot_of(const point a, const point b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross_of(const point a, const point b, point out)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void minus(const point a, const point b, point out)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static float noise(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) * 0x1p-24f;
}

// ---- All triangles ---------------------------------------------------------------------

typedef struct found {
    bool met, doubtful; // doubtful: another rounding might see another thing
    size_t instance, triangle;
    double distance, u, v;
    point normal; // to the side of the front
} found;

static void placed(const float w[16], const float p[3], point out)
{
    for (int r = 0; r < 3; r++)
        out[r] = (double)w[r] * (double)p[0] + (double)w[4 + r] * (double)p[1] +
                 (double)w[8 + r] * (double)p[2] + (double)w[12 + r];
}

static bool is_mirrored(const float w[16])
{
    point x, y, z, n;
    for (int r = 0; r < 3; r++) {
        x[r] = (double)w[r];
        y[r] = (double)w[4 + r];
        z[r] = (double)w[8 + r];
    }
    cross_of(y, z, n);
    return dot_of(x, n) < 0;
}

// The checks of the mask: texels of one alpha each, repeated.
static bool is_cut_out(const scene_mesh *mesh, const uint32_t at[3], double u, double v,
                       bool *doubtful)
{
    int sum = 0;
    for (int c = 0; c < 2; c++) {
        double x = (1 - u - v) * (double)mesh->vertices[at[0]].uv[0][c] +
                   u * (double)mesh->vertices[at[1]].uv[0][c] +
                   v * (double)mesh->vertices[at[2]].uv[0][c];
        x = (x - floor(x)) * CHECKS;
        *doubtful |= fabs(x - round(x)) < 1e-3;
        sum += (int)x;
    }
    return sum % 2 == 0;
}

static void meet_triangle(const ag_scene *scene, size_t i, size_t t, const ray *r, found *f)
{
    const scene_instance *instance = &scene->instances[i];
    const scene_mesh *mesh = &scene->meshes[instance->mesh];
    const ag_material_desc *m = &scene->materials[instance->material];
    const uint32_t *at = mesh->indices + 3 * t;
    point a, b, c, o, d, e1, e2, n, p, q, s;
    placed(instance->world, mesh->vertices[at[0]].position, a);
    placed(instance->world, mesh->vertices[at[1]].position, b);
    placed(instance->world, mesh->vertices[at[2]].position, c);
    for (int k = 0; k < 3; k++) {
        o[k] = (double)r->origin[k];
        d[k] = (double)r->direction[k];
    }
    minus(b, a, e1);
    minus(c, a, e2);
    cross_of(e1, e2, n);
    cross_of(d, e2, p);
    double det = dot_of(e1, p), size = sqrt(dot_of(n, n));
    if (fabs(det) < 1e-12 * size)
        return;
    minus(o, a, s);
    cross_of(s, e1, q);
    double u = dot_of(s, p) / det, v = dot_of(d, q) / det, distance = dot_of(e2, q) / det;
    double inside = fmin(fmin(u, v), 1 - u - v);
    if (inside < -1e-4 || distance < (double)r->near || distance > (double)r->far)
        return;
    bool doubtful = inside < 1e-4 || fabs(det) < 1e-3 * size;
    if (is_mirrored(instance->world))
        for (int k = 0; k < 3; k++)
            n[k] = -n[k];
    if (r->from_eye && !m->double_sided && dot_of(n, d) > 0)
        return;
    if (m->alpha_mode == AG_ALPHA_MASK && is_cut_out(mesh, at, u, v, &doubtful) && !doubtful)
        return;
    if (f->met && distance >= f->distance)
        return;
    *f = (found) { true, doubtful || f->doubtful, i, t, distance, u, v, { n[0], n[1], n[2] } };
}

static found searched(const ag_scene *scene, const ray *r)
{
    found f = { .met = false };
    for (size_t i = 0; i < scene->instances_count; i++)
        for (size_t t = 0; t < scene->meshes[scene->instances[i].mesh].index_count / 3; t++)
            meet_triangle(scene, i, t, r, &f);
    return f;
}

// ---- Scenes ------------------------------------------------------------------------------

static ag_mesh soup(ag_scene *scene, uint32_t *seed)
{
    enum { CORNERS = 3 * 40 };
    float positions[CORNERS][3], uvs[CORNERS][2];
    for (int i = 0; i < CORNERS; i++) {
        for (int c = 0; c < 3; c++)
            positions[i][c] = noise(seed) * 2 - 1;
        for (int c = 0; c < 2; c++)
            uvs[i][c] = noise(seed) * 3 - 1;
    }
    const ag_mesh_desc desc = { .positions = &positions[0][0],
                                .uvs = { &uvs[0][0] },
                                .vertex_count = CORNERS,
                                .skip_tangents = true };
    ag_mesh mesh;
    OK(ag_scene_add_mesh(scene, &desc, &mesh));
    return mesh;
}

static ag_texture checks(ag_scene *scene)
{
    uint8_t pixels[CHECKS * CHECKS][4] = { { 0 } };
    for (int i = 0; i < CHECKS * CHECKS; i++)
        pixels[i][3] = (i + i / CHECKS) % 2 ? 255 : 0;
    const ag_image_desc image_desc = { CHECKS, CHECKS, AG_FORMAT_RGBA8, pixels };
    ag_image *image;
    ag_texture texture;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image, .mag = AG_FILTER_NEAREST };
    OK(ag_scene_add_texture(scene, &desc, &texture));
    ag_image_destroy(image);
    return texture;
}

static const float worlds[][16] = {
    { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },                   // as it is
    { 0, 0.5f, 0, 0, -0.5f, 0, 0, 0, 0, 0, 0.5f, 0, 1.5f, 0, 0, 1 },      // turned, smaller
    { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.5f, 0.5f, 0, 1 },           // mirrored
    { 0.2f, 0, 0.1f, 0, 0, 2, 0, 0, 0, 0.3f, 1, 0, 0, -1, 1.5f, 1 },      // stretched, sheared
    { 0.2f, 0, 0.1f, 0, 0, -2, 0, 0, 0, 0.3f, 1, 0, 0.5f, -1, -1.5f, 1 }, // and mirrored
};

// One mesh of each kind of material that is shown once, and one that is shown with all.
static ag_scene *everything(void)
{
    ag_scene *scene = stage_dark();
    uint32_t seed = 7;
    ag_material_desc m[4];
    for (int i = 0; i < 4; i++) {
        m[i] = stage_matte(1);
        m[i].double_sided = i & 1;
        m[i].alpha_mode = i & 2 ? AG_ALPHA_MASK : AG_ALPHA_OPAQUE;
        m[i].alpha_cutoff = 0.5f;
        if (i & 2)
            m[i].base_color_texture.texture = checks(scene);
    }
    ag_mesh shared = soup(scene, &seed);
    for (int i = 0; i < 4; i++) {
        stage_show(scene, soup(scene, &seed), &m[i], worlds[i + 1]);
        stage_show(scene, shared, &m[i], worlds[4 - i]);
    }
    stage_show(scene, soup(scene, &seed), &m[0], worlds[2]);
    stage_show(scene, stage_ball(scene, 6, 0.5f, false, false), &m[0], NULL);
    return scene;
}

static ray random_ray(uint32_t *seed)
{
    vec3 from = { 0, 0, 0 }, to = { 0, 0, 0 };
    for (int c = 0; c < 3; c++) {
        from[c] = noise(seed) * 6 - 3;
        to[c] = noise(seed) * 3 - 1.5f;
    }
    ray r = { .origin = from, .direction = normalize(to - from), .far = INFINITY };
    r.from_eye = noise(seed) < 0.5f;
    if (noise(seed) < 0.3f)
        r.near = noise(seed) * 2;
    if (noise(seed) < 0.3f)
        r.far = r.near + noise(seed) * 4;
    return r;
}

// ---- Tests ---------------------------------------------------------------------------------

static void assert_same(const world *w, const found *f, const hit *h)
{
    assert_true(fabs((double)h->distance - f->distance) <= 1e-5 * (1 + f->distance));
    if (h->instance != &w->instances[f->instance] || h->triangle != f->triangle)
        return; // two at one distance
    assert_true(fabs((double)h->u - f->u) < 1e-3 && fabs((double)h->v - f->v) < 1e-3);
    const point n = { (double)h->normal[0], (double)h->normal[1], (double)h->normal[2] };
    double cosine = dot_of(n, f->normal) / sqrt(dot_of(n, n) * dot_of(f->normal, f->normal));
    assert_true(cosine > 0.9999);
}

static void the_nearest_is_found(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    world w;
    uint32_t seed = 3, met = 0, doubtful = 0;
    OK(world_create(scene, NULL, &w));
    for (int i = 0; i < RAYS; i++) {
        const ray r = random_ray(&seed);
        found f = searched(scene, &r);
        hit h;
        bool is_met = world_closest(&w, &r, &h);
        if (f.doubtful) {
            doubtful++;
            continue;
        }
        if (is_met != f.met)
            print_error("ray %d: %d at %g\n", i, f.met, f.distance);
        assert_int_equal(is_met, f.met);
        if (is_met) {
            met++;
            assert_same(&w, &f, &h);
        }
    }
    assert_true(met > RAYS / 3 && met < RAYS * 9 / 10 && doubtful < RAYS / 20);
    world_destroy(&w);
    ag_scene_destroy(scene);
}

static void what_is_in_the_way_is_found(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    world w;
    uint32_t seed = 4, blocked = 0;
    OK(world_create(scene, NULL, &w));
    for (int i = 0; i < RAYS; i++) {
        ray r = random_ray(&seed);
        r.from_eye = false; // shadows do not know sides
        found f = searched(scene, &r);
        if (f.doubtful)
            continue;
        assert_int_equal(world_blocked(&w, &r), f.met);
        blocked += f.met;
    }
    assert_true(blocked > RAYS / 3 && blocked < RAYS * 9 / 10);
    world_destroy(&w);
    ag_scene_destroy(scene);
}

// Glass of alpha .3 is there for three rays of ten, for the same ones whenever they are asked.
static void glass_is_partly_there(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    ag_material_desc glass = stage_matte(1);
    glass.alpha_mode = AG_ALPHA_BLEND;
    glass.base_color[3] = 0.3f;
    stage_show(scene, stage_floor(scene, 0, 1), &glass, NULL);
    world w;
    uint32_t seed = 5, met = 0;
    OK(world_create(scene, NULL, &w));
    for (uint32_t i = 0; i < RAYS; i++) {
        ray r = { .origin = { noise(&seed) - 0.5f, 1, 0.2f },
                  .direction = { 0, -1, 0 },
                  .far = INFINITY,
                  .dice = i };
        hit h;
        bool there = world_closest(&w, &r, &h);
        assert_int_equal(world_closest(&w, &r, &h), there);
        assert_int_equal(world_blocked(&w, &r), there);
        met += there;
    }
    double error = sqrt(0.3 * 0.7 / RAYS);
    assert_agrees("glass", ((estimate) { (double)met / RAYS, error }), 0.3, 0);
    world_destroy(&w);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_is_found),
        cmocka_unit_test(what_is_in_the_way_is_found),
        cmocka_unit_test(glass_is_partly_there),
    };
    return cmocka_run_group_tests_name("rays", tests, NULL, NULL);
}
