// Tangents against what geometry says: dP/du of surfaces with a formula, means worked out by
// hand, and that neither the order of triangles nor broken input matters.
#include "helpers.h"

#include "scene/fan.h"

enum { SIDE = 48, POINTS = (SIDE + 1) * (SIDE + 1), CORNERS = SIDE * SIDE * 6 };

typedef struct surface_point {
    double position[3], normal[3], along_u[3]; // along_u: dP/du, any length
} surface_point;

typedef surface_point surface(double u, double v);

typedef struct grid {
    float positions[POINTS * 3], normals[POINTS * 3], uvs[POINTS * 2];
    float along_u[POINTS * 3];
    uint32_t indices[CORNERS];
} grid;

static void unit_to(const double v[3], float out[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] / length);
}

// v runs downwards, the corners counter-clockwise as seen against the normal.
static grid *make_grid(surface *at)
{
    grid *g = malloc(sizeof *g);
    for (int y = 0; y <= SIDE; y++) {
        for (int x = 0; x <= SIDE; x++) {
            int i = y * (SIDE + 1) + x;
            double u = (double)x / SIDE, v = (double)y / SIDE;
            surface_point p = at(u, v);
            for (int c = 0; c < 3; c++)
                g->positions[3 * i + c] = (float)p.position[c];
            unit_to(p.normal, g->normals + 3 * i);
            unit_to(p.along_u, g->along_u + 3 * i);
            g->uvs[2 * i] = (float)u;
            g->uvs[2 * i + 1] = (float)v;
        }
    }
    uint32_t *out = g->indices;
    for (uint32_t y = 0; y < SIDE; y++) {
        for (uint32_t x = 0; x < SIDE; x++, out += 6) {
            uint32_t a = y * (SIDE + 1) + x, b = a + SIDE + 1;
            const uint32_t cell[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(out, cell, sizeof cell);
        }
    }
    return g;
}

static const scene_mesh *add(ag_scene *scene, const float *positions, const float *normals,
                             const float *uvs, uint32_t vertices, const uint32_t *indices,
                             uint32_t corners)
{
    ag_mesh_desc desc = { .positions = positions,
                          .normals = normals,
                          .uvs = { uvs },
                          .vertex_count = vertices,
                          .indices = indices,
                          .index_count = corners };
    ag_mesh mesh;
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    return &scene->meshes[mesh.id - 1];
}

// Always: unit, perpendicular to the normal, a handedness.
static void check_frames(const scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const scene_vertex *v = &mesh->vertices[i];
        assert_true(fabs(dot3(v->tangent, v->tangent) - 1.0) < 1e-5);
        assert_true(fabs(dot3(v->tangent, v->normal)) < 1e-5);
        assert_true(v->tangent[3] == 1.0f || v->tangent[3] == -1.0f);
    }
    for (uint32_t i = 0; i < mesh->index_count; i++)
        assert_true(mesh->indices[i] < mesh->vertex_count);
}

// ---- Surfaces with a formula -----------------------------------------------

static surface_point sheared_plane(double u, double v)
{
    return (surface_point) { { 2 * u + v, 0.5 * u - v, 0 }, { 0, 0, 1 }, { 2, 0.5, 0 } };
}

static surface_point cylinder(double u, double v)
{
    double s = sin(4 * u), c = cos(4 * u);
    return (surface_point) { { s, -3 * v, c }, { s, 0, c }, { c, 0, -s } };
}

static surface_point sphere(double u, double v) // without its poles
{
    double s = sin(6 * u), c = cos(6 * u), t = 0.3 + 2.5 * v;
    return (surface_point) { { sin(t) * s, cos(t), sin(t) * c },
                             { sin(t) * s, cos(t), sin(t) * c },
                             { c, 0, -s } };
}

static surface_point torus(double u, double v)
{
    double s = sin(6 * u), c = cos(6 * u), a = cos(6 * v), b = -sin(6 * v);
    return (surface_point) { { (3 + a) * s, b, (3 + a) * c }, { a * s, b, a * c }, { c, 0, -s } };
}

static void check_surface(surface *at, double tolerance)
{
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    grid *g = make_grid(at);
    const scene_mesh *mesh =
        add(scene, g->positions, g->normals, g->uvs, POINTS, g->indices, CORNERS);
    check_frames(mesh);
    assert_int_equal(mesh->vertex_count, POINTS); // nothing to split
    for (int i = 0; i < POINTS; i++) {
        const scene_vertex *v = &mesh->vertices[i];
        assert_true(dot3(v->tangent, g->along_u + 3 * i) > 1.0 - tolerance);
        assert_true(v->tangent[3] == 1.0f);
    }
    free(g);
    ag_scene_destroy(scene);
}

static void test_surfaces(void **state)
{
    (void)state;
    check_surface(sheared_plane, 1e-6);
    check_surface(cylinder, 1e-3); // the last column sees only one side
    check_surface(sphere, 3e-3);
    check_surface(torus, 3e-3);
}

// The bitangent w n x t must run against v (glTF's v runs down): on a plane it is up.
static void test_mirrored_halves_are_split(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    // Two squares side by side that share the uvs u = |x|, v = 1 - y, and the edge x = 0.
    const float positions[18] = { -1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0 };
    const float normals[18] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    const float uvs[12] = { 1, 1, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0 };
    const uint32_t indices[12] = { 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4 };
    const scene_mesh *mesh = add(scene, positions, normals, uvs, 6, indices, 12);
    check_frames(mesh);
    assert_int_equal(mesh->vertex_count, 8); // the two on the edge twice
    for (int i = 0; i < 12; i++) {
        const scene_vertex *v = &mesh->vertices[mesh->indices[i]];
        float side = i < 6 ? -1.0f : 1.0f;
        assert_memory_equal(v->position, positions + 3 * indices[i], sizeof v->position);
        assert_near(v->tangent[0], side, 1e-6);
        assert_true(v->tangent[3] == side);
    }
    ag_scene_destroy(scene);
}

// ---- By hand ---------------------------------------------------------------

static const float flat_normals[30] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1,
                                        0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };

// At the origin two triangles meet: 90 degrees with dP/du = (1, 0), 45 degrees with
// dP/du = (1, 1) / sqrt 2, since there u = x and -v = y - x.
static void test_angles_weigh(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 1, 0 };
    const float uvs[8] = { 0, 0, 1, 0, 0, -1, -1, -2 };
    const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    const scene_mesh *mesh = add(scene, positions, flat_normals, uvs, 4, indices, 6);
    assert_int_equal(mesh->vertex_count, 4);
    double pi = acos(-1.0), x = pi / 2 + pi / 4 * sqrt(0.5), y = pi / 4 * sqrt(0.5);
    assert_near(mesh->vertices[0].tangent[0], x / hypot(x, y), 1e-6);
    assert_near(mesh->vertices[0].tangent[1], y / hypot(x, y), 1e-6);
    assert_near(mesh->vertices[1].tangent[0], 1, 1e-6);
    assert_near(mesh->vertices[3].tangent[1], sqrt(0.5), 1e-6);
    ag_scene_destroy(scene);
}

// The same fan, but apart: the triangles share the origin and no edge, so each keeps its own.
static void test_triangles_without_a_common_edge_stay_apart(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[15] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.5f, 1, 0, -1, 1, 0 };
    const float uvs[10] = { 0, 0, 1, 0, 0, -1, -0.5f, -1.5f, -1, -2 };
    const uint32_t indices[6] = { 0, 1, 2, 0, 3, 4 };
    const scene_mesh *mesh = add(scene, positions, flat_normals, uvs, 5, indices, 6);
    assert_int_equal(mesh->vertex_count, 6);
    assert_near(mesh->vertices[mesh->indices[0]].tangent[1], 0, 1e-6);
    assert_near(mesh->vertices[mesh->indices[3]].tangent[1], sqrt(0.5), 1e-6);
    ag_scene_destroy(scene);
}

// Nor do triangles on one side of an edge join: both run along it from the origin to (1, 0).
static void test_triangles_on_one_side_stay_apart(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5f, 1, 0 };
    const float uvs[8] = { 0, 0, 1, -1, 0, -1, 0, -2 };
    const uint32_t indices[6] = { 0, 1, 2, 0, 1, 3 };
    const scene_mesh *mesh = add(scene, positions, flat_normals, uvs, 4, indices, 6);
    assert_int_equal(mesh->vertex_count, 6);
    // S + T = (1, 0); T = (0, 1) and (0.25, 0.5).
    const float *first = mesh->vertices[mesh->indices[0]].tangent;
    const float *second = mesh->vertices[mesh->indices[3]].tangent;
    assert_near(first[1] / first[0], -1, 1e-6);
    assert_near(second[1] / second[0], -0.5 / 0.75, 1e-6);
    ag_scene_destroy(scene);
}

// A triangle whose uvs lie on a line joins the two beside it, as MikkTSpace has it: all three
// get the mean of the outer two, which are 90 degrees each.
static void test_a_triangle_without_uv_area_links_its_neighbours(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[15] = { 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0 };
    // u, -v: first (x, y); then on the line through A = (1, 0) to B = (2, 0); last such that
    // B = (2, 0), C = (0, 1), hence dP/du = (0, 1).
    const float uvs[10] = { 0, 0, 0, 1, 1, 0, 2, 0, 0, -1 };
    const uint32_t indices[9] = { 0, 1, 2, 0, 2, 3, 0, 3, 4 };
    const scene_mesh *mesh = add(scene, positions, flat_normals, uvs, 5, indices, 9);
    check_frames(mesh);
    assert_int_equal(mesh->vertex_count, 5);
    assert_near(mesh->vertices[0].tangent[0], sqrt(0.5), 1e-6);
    assert_near(mesh->vertices[0].tangent[1], sqrt(0.5), 1e-6);
    ag_scene_destroy(scene);
}

// Without indices and shared vertices the result is the same as with them.
static void test_soup_equals_indexed(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    grid *g = make_grid(torus);
    float *soup = malloc(CORNERS * 8 * sizeof *soup);
    float *positions = soup, *normals = soup + CORNERS * 3, *uvs = soup + CORNERS * 6;
    for (int i = 0; i < CORNERS; i++) {
        memcpy(positions + 3 * i, g->positions + 3 * g->indices[i], 12);
        memcpy(normals + 3 * i, g->normals + 3 * g->indices[i], 12);
        memcpy(uvs + 2 * i, g->uvs + 2 * g->indices[i], 8);
    }
    add(scene, g->positions, g->normals, g->uvs, POINTS, g->indices, CORNERS);
    add(scene, positions, normals, uvs, CORNERS, NULL, CORNERS);
    const scene_mesh *a = &scene->meshes[0], *b = &scene->meshes[1];
    for (int i = 0; i < CORNERS; i++) {
        const float *one = a->vertices[a->indices[i]].tangent;
        assert_memory_equal(one, b->vertices[b->indices[i]].tangent, 16);
    }
    free(soup);
    free(g);
    ag_scene_destroy(scene);
}

// ---- Order -----------------------------------------------------------------

// A surface whose uvs fold back, collapse and tear at random places.
static grid *make_wild_grid(void)
{
    grid *g = make_grid(torus);
    uint32_t seed = 7;
    for (int i = 0; i < POINTS; i++) {
        float dice = noise(&seed);
        if (dice < 0.2f)
            g->uvs[2 * i] = 1.0f - g->uvs[2 * i];
        if (dice > 0.7f)
            g->uvs[2 * i] = g->uvs[2 * i + 1] = 0.25f;
    }
    return g;
}

static void test_the_order_of_triangles_does_not_matter(void **state)
{
    (void)state;
    enum { FACES = CORNERS / 3 };
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    grid *g = make_wild_grid();
    uint32_t *order = malloc(FACES * sizeof *order), *turned = malloc(CORNERS * sizeof *turned);
    uint32_t seed = 3;
    for (uint32_t i = 0; i < FACES; i++) {
        uint32_t j = (uint32_t)(noise(&seed) * (float)(i + 1));
        order[i] = order[j < i ? j : i];
        order[j < i ? j : i] = i;
    }
    for (uint32_t i = 0; i < FACES; i++) // triangle i comes from order[i], its corners turned
        for (uint32_t c = 0; c < 3; c++)
            turned[3 * i + c] = g->indices[3 * order[i] + (c + i) % 3];
    add(scene, g->positions, g->normals, g->uvs, POINTS, g->indices, CORNERS);
    add(scene, g->positions, g->normals, g->uvs, POINTS, turned, CORNERS);
    const scene_mesh *a = &scene->meshes[0], *b = &scene->meshes[1];
    check_frames(a);
    assert_true(a->vertex_count > POINTS); // there was something to split
    for (uint32_t i = 0; i < FACES; i++) {
        for (uint32_t c = 0; c < 3; c++) {
            const float *one = a->vertices[a->indices[3 * order[i] + (c + i) % 3]].tangent;
            const float *other = b->vertices[b->indices[3 * i + c]].tangent;
            assert_true(dot3(one, other) > 1.0 - 1e-5);
            assert_true(one[3] == other[3]);
        }
    }
    free(order);
    free(turned);
    free(g);
    ag_scene_destroy(scene);
}

// ---- Broken input ----------------------------------------------------------

static float wild(uint32_t *seed)
{
    const float values[] = { 0, -0.0f, 1, 1e-30f, -1e-38f, 1e30f, -3e38f, 0.5f, 1.0f / 3, 2 };
    return values[(int)(noise(seed) * 10)];
}

static void test_any_numbers_give_frames(void **state)
{
    (void)state;
    enum { VERTICES = 40, INDICES = 300 };
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    uint32_t seed = 11;
    for (int round = 0; round < 200; round++) {
        float positions[VERTICES * 3], normals[VERTICES * 3], uvs[VERTICES * 2];
        uint32_t indices[INDICES];
        for (int i = 0; i < VERTICES * 3; i++) {
            positions[i] = wild(&seed);
            normals[i] = wild(&seed);
        }
        for (int i = 0; i < VERTICES * 2; i++)
            uvs[i] = wild(&seed);
        for (int i = 0; i < INDICES; i++)
            indices[i] = (uint32_t)(noise(&seed) * VERTICES);
        check_frames(
            add(scene, positions, round & 1 ? normals : NULL, uvs, VERTICES, indices, INDICES));
        scene_rollback(scene, (scene_mark) { .materials = 1 });
    }
    ag_scene_destroy(scene);
}

static void test_all_uvs_equal(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    grid *g = make_grid(sphere);
    memset(g->uvs, 0, sizeof g->uvs);
    const scene_mesh *mesh =
        add(scene, g->positions, g->normals, g->uvs, POINTS, g->indices, CORNERS);
    check_frames(mesh);
    assert_int_equal(mesh->vertex_count, POINTS);
    free(g);
    ag_scene_destroy(scene);
}

// A vertex with very many triangles, alike and apart; a quadratic method would take minutes.
static void test_crowded_vertex(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    float *data = malloc((COUNT + 1) * 8 * sizeof *data);
    float *positions = data, *normals = data + (COUNT + 1) * 3, *uvs = data + (COUNT + 1) * 6;
    uint32_t *indices = malloc(COUNT * 3 * sizeof *indices), seed = 5;
    for (uint32_t i = 0; i <= COUNT; i++) {
        for (int c = 0; c < 3; c++) {
            positions[3 * i + (uint32_t)c] = noise(&seed);
            normals[3 * i + (uint32_t)c] = i == 0 ? 0.5f : noise(&seed);
        }
        uvs[2 * i] = noise(&seed);
        uvs[2 * i + 1] = noise(&seed);
    }
    for (int pass = 0; pass < 3; pass++) {
        for (uint32_t i = 0; i < COUNT; i++) {
            indices[3 * i] = 0;
            indices[3 * i + 1] = pass == 0 ? 1 : 1 + i;
            indices[3 * i + 2] = pass == 0   ? 2
                                 : pass == 1 ? 1 + (i + 1) % COUNT
                                             : 1 + (i * 7919 + 1) % COUNT;
        }
        check_frames(add(scene, positions, normals, uvs, COUNT + 1, indices, COUNT * 3));
    }
    free(data);
    free(indices);
    ag_scene_destroy(scene);
}

static void test_no_uvs_and_no_wish(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    grid *g = make_wild_grid();
    check_frames(add(scene, g->positions, g->normals, NULL, POINTS, g->indices, CORNERS));
    ag_mesh_desc desc = { .positions = g->positions,
                          .normals = g->normals,
                          .uvs = { g->uvs },
                          .vertex_count = POINTS,
                          .indices = g->indices,
                          .index_count = CORNERS,
                          .skip_tangents = true };
    ag_mesh mesh;
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    check_frames(&scene->meshes[1]);
    assert_int_equal(scene->meshes[1].vertex_count, POINTS);
    free(g);
    ag_scene_destroy(scene);
}

static void test_second_uv_set(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    const float first[6] = { 0, 0, 1, 0, 0, -1 }, second[6] = { 0, 0, 0, 1, 1, 0 };
    ag_mesh_desc desc = { .positions = positions,
                          .normals = flat_normals,
                          .uvs = { first, second },
                          .vertex_count = 3,
                          .tangent_uv_set = 1 };
    ag_mesh mesh;
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    const float *t = scene->meshes[0].vertices[0].tangent; // u = y, -v = -x: up, right-handed
    assert_near(t[1], 1, 1e-6);
    assert_true(t[3] == 1.0f);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surfaces),
        cmocka_unit_test(test_mirrored_halves_are_split),
        cmocka_unit_test(test_angles_weigh),
        cmocka_unit_test(test_triangles_without_a_common_edge_stay_apart),
        cmocka_unit_test(test_triangles_on_one_side_stay_apart),
        cmocka_unit_test(test_a_triangle_without_uv_area_links_its_neighbours),
        cmocka_unit_test(test_soup_equals_indexed),
        cmocka_unit_test(test_the_order_of_triangles_does_not_matter),
        cmocka_unit_test(test_any_numbers_give_frames),
        cmocka_unit_test(test_all_uvs_equal),
        cmocka_unit_test(test_crowded_vertex),
        cmocka_unit_test(test_no_uvs_and_no_wish),
        cmocka_unit_test(test_second_uv_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
