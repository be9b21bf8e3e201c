// Meshes: what is refused, what is mended, what is packed.
#include "helpers.h"

static const float square[12] = { 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0 };
static const uint32_t square_indices[6] = { 0, 1, 2, 0, 2, 3 };

static const scene_mesh *add(ag_scene *scene, const ag_mesh_desc *desc)
{
    ag_mesh mesh;
    assert_int_equal(ag_scene_add_mesh(scene, desc, &mesh), AG_OK);
    assert_int_equal(mesh.id, scene->meshes_count);
    return &scene->meshes[mesh.id - 1];
}

static void refuse(ag_scene *scene, sentences *s, ag_mesh_desc desc, ag_status status,
                   const char *part)
{
    ag_mesh mesh = { 5 };
    uint64_t revision = scene->revision;
    unsigned said = s->count;
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), status);
    assert_int_equal(mesh.id, 0);
    assert_int_equal(scene->meshes_count, 0);
    assert_int_equal(scene->revision, revision);
    assert_int_equal(s->count, said + 1);
    assert_non_null(strstr(s->last, part));
}

static void test_refusals(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const ag_mesh_desc sound = {
        .positions = square, .vertex_count = 4, .indices = square_indices, .index_count = 6
    };
    const uint32_t beyond[3] = { 0, 1, 4 };
    float infinite[12], nan[12];
    memcpy(infinite, square, sizeof square);
    memcpy(nan, square, sizeof square);
    infinite[4] = INFINITY;
    nan[9] = NAN;
    ag_mesh_desc d = { 0 };
    refuse(scene, &s, d, AG_ERROR_ARGUMENT, "no triangles");
    d = sound;
    d.index_count = 0;
    refuse(scene, &s, d, AG_ERROR_ARGUMENT, "no triangles");
    d = sound;
    d.index_count = 5;
    refuse(scene, &s, d, AG_ERROR_ARGUMENT, "multiple of 3");
    d = sound;
    d.indices = NULL;
    refuse(scene, &s, d, AG_ERROR_ARGUMENT, "only 4 vertices");
    d = sound;
    d.tangent_uv_set = 2;
    refuse(scene, &s, d, AG_ERROR_ARGUMENT, "uv set 2");
    d = sound;
    d.indices = beyond;
    d.index_count = 3;
    refuse(scene, &s, d, AG_ERROR_FORMAT, "vertex 4");
    d = sound;
    d.positions = infinite;
    refuse(scene, &s, d, AG_ERROR_FORMAT, "vertex 1");
    d.positions = nan;
    refuse(scene, &s, d, AG_ERROR_FORMAT, "vertex 3");
    ag_scene_destroy(scene);
}

static void test_flat_normals(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    // Two sides of a roof that share an edge; given tangents must be ignored then.
    const float roof[12] = { 0, 1, 0, 0, 1, -1, -1, 0, 0, 1, 0, 0 };
    const uint32_t sides[6] = { 0, 1, 2, 1, 0, 3 };
    const float tangents[16] = { 9, 9, 9, 9 };
    const float uvs[8] = { 1, 2, 3, 4, 5, 6, 7, 8 };
    ag_mesh_desc d = { .positions = roof,
                       .tangents = tangents,
                       .uvs = { NULL, uvs },
                       .vertex_count = 4,
                       .indices = sides,
                       .index_count = 6 };
    const scene_mesh *mesh = add(scene, &d);
    assert_int_equal(mesh->vertex_count, 6);
    assert_int_equal(mesh->index_count, 6);
    const double h = sqrt(0.5);
    for (unsigned i = 0; i < 6; i++) {
        const scene_vertex *v = &mesh->vertices[mesh->indices[i]];
        assert_memory_equal(v->position, roof + 3 * sides[i], sizeof v->position);
        assert_memory_equal(v->uv[1], uvs + 2 * sides[i], sizeof v->uv[1]);
        assert_near(v->normal[0], i < 3 ? -h : h, 1e-6);
        assert_near(v->normal[1], h, 1e-6);
        assert_near(v->normal[2], 0, 1e-6);
        assert_near(dot3(v->tangent, v->normal), 0, 1e-6);
        assert_near(dot3(v->tangent, v->tangent), 1, 1e-6);
    }
    ag_scene_destroy(scene);
}

static void test_flat_normals_of_every_size(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float sizes[] = { 1e-30f, 1e-12f, 1.0f, 1e12f, 1e37f };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const float size = sizes[i];
        const float positions[9] = { 0, 0, 0, 0, size, 0, 0, 0, size };
        ag_mesh_desc d = { .positions = positions, .vertex_count = 3 };
        const scene_mesh *mesh = add(scene, &d);
        assert_near(mesh->vertices[0].normal[0], 1, 1e-6);
    }
    // No area at all: some unit normal.
    const float line[9] = { 0, 0, 0, 1, 0, 0, 2, 0, 0 };
    ag_mesh_desc d = { .positions = line, .vertex_count = 3 };
    const scene_mesh *mesh = add(scene, &d);
    assert_near(dot3(mesh->vertices[1].normal, mesh->vertices[1].normal), 1, 1e-6);
    ag_scene_destroy(scene);
}

static void test_normals_are_mended(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float normals[15] = { 0, 0, 0, 0, 0, 4, NAN, 0, 1, 1, 0, 0, 0, 0, 0 };
    float positions[15] = { 0 };
    memcpy(positions, square, sizeof square);
    ag_mesh_desc d = { .positions = positions,
                       .normals = normals,
                       .vertex_count = 5, // the last one belongs to no triangle
                       .indices = square_indices,
                       .index_count = 6 };
    const scene_mesh *mesh = add(scene, &d);
    const float z[3] = { 0, 0, 1 }, x[3] = { 1, 0, 0 };
    assert_int_equal(mesh->vertex_count, 5);
    for (int i = 0; i < 3; i++) // from the triangles, from a long normal, from the triangles
        assert_near(dot3(mesh->vertices[i].normal, z), 1, 1e-6);
    assert_near(dot3(mesh->vertices[3].normal, x), 1, 1e-6);
    assert_near(dot3(mesh->vertices[4].normal, mesh->vertices[4].normal), 1, 1e-6);
    ag_scene_destroy(scene);
}

static void test_given_tangents_are_kept(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float normals[9] = { 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    const float tangents[12] = { 0, 3, 0, -0.9f, 1, 0, 0, 1, NAN, 0, 0, 0 };
    ag_mesh_desc d = {
        .positions = square, .normals = normals, .tangents = tangents, .vertex_count = 3
    };
    const scene_mesh *mesh = add(scene, &d);
    const float first[4] = { 0, 1, 0, -1 }, second[4] = { 1, 0, 0, 1 };
    assert_memory_equal(mesh->vertices[0].tangent, first, sizeof first);
    assert_memory_equal(mesh->vertices[1].tangent, second, sizeof second);
    const scene_vertex *mended = &mesh->vertices[2];
    assert_near(dot3(mended->tangent, mended->normal), 0, 1e-6);
    assert_near(dot3(mended->tangent, mended->tangent), 1, 1e-6);
    assert_true(mended->tangent[3] == 1.0f);
    ag_scene_destroy(scene);
}

static void test_colors_and_uvs(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float normals[9] = { 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    const float colors[12] = { 1, 1, 1, 1, 0.5f, 0, 2, -1, NAN, 1, 1, 0.25f };
    const float white[12] = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 };
    const float uvs[6] = { 0.25f, -3, NAN, 1, INFINITY, 2 };
    ag_mesh_desc d = { .positions = square,
                       .normals = normals,
                       .uvs = { uvs, NULL },
                       .colors = colors,
                       .vertex_count = 3 };
    const scene_mesh *mesh = add(scene, &d);
    assert_true(mesh->has_colors);
    const uint16_t half[4] = { 32768, 0, 65535, 0 }, last[4] = { 65535, 65535, 65535, 16384 };
    assert_memory_equal(mesh->vertices[1].color, half, sizeof half);
    assert_memory_equal(mesh->vertices[2].color, last, sizeof last);
    assert_true(mesh->vertices[0].uv[0][0] == 0.25f && mesh->vertices[0].uv[0][1] == -3.0f);
    assert_true(mesh->vertices[1].uv[0][0] == 0.0f && mesh->vertices[2].uv[0][0] == 0.0f);
    assert_true(mesh->vertices[0].uv[1][0] == 0.0f);
    d.colors = white;
    assert_false(add(scene, &d)->has_colors);
    d.colors = NULL;
    mesh = add(scene, &d);
    assert_false(mesh->has_colors);
    assert_int_equal(mesh->vertices[0].color[3], 65535);
    ag_scene_destroy(scene);
}

static void test_bounds_are_of_what_is_drawn(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, -2, 99, 99, 99 };
    const uint32_t indices[3] = { 0, 1, 2 };
    const float normals[12] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    ag_mesh_desc d = { .positions = positions,
                       .normals = normals,
                       .vertex_count = 4,
                       .indices = indices,
                       .index_count = 3 };
    const scene_mesh *mesh = add(scene, &d);
    const float min[3] = { 0, 0, -2 }, max[3] = { 1, 1, 0 };
    assert_memory_equal(mesh->min, min, sizeof min);
    assert_memory_equal(mesh->max, max, sizeof max);
    ag_scene_destroy(scene);
}

// More vertices than one task packs, so that chunks meet.
static void test_large_mesh(void **state)
{
    (void)state;
    enum { COUNT = 300000 };
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    float *positions = calloc(COUNT * 3, sizeof *positions);
    for (int i = 0; i < COUNT; i++) {
        positions[3 * i] = (float)i;
        positions[3 * i + 1] = (float)(i % 3);
    }
    ag_mesh_desc d = { .positions = positions, .vertex_count = COUNT };
    const scene_mesh *mesh = add(scene, &d);
    assert_int_equal(mesh->vertex_count, COUNT);
    for (int i = 0; i < COUNT; i++) {
        assert_true(mesh->vertices[i].position[0] == (float)i);
        assert_true(fabsf(mesh->vertices[i].normal[2]) > 0.99f || mesh->vertices[i].normal[1] > 0);
        assert_int_equal(mesh->indices[i], i);
    }
    free(positions);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_flat_normals),
        cmocka_unit_test(test_flat_normals_of_every_size),
        cmocka_unit_test(test_normals_are_mended),
        cmocka_unit_test(test_given_tangents_are_kept),
        cmocka_unit_test(test_colors_and_uvs),
        cmocka_unit_test(test_bounds_are_of_what_is_drawn),
        cmocka_unit_test(test_large_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
