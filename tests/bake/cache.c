// The environment cache: hits, damage, folders that cannot be written, several processes.
#include "bake/cache.h"
#include "base/file.h"

#include "scene/scene.h"
#include "skies.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void sky(const double d[3], float rgb[3])
{
    rgb[0] = (float)(1.0 + d[0]), rgb[1] = (float)(1.0 + d[1]), rgb[2] = (float)(1.0 + d[2]);
}

static void other_sky(const double d[3], float rgb[3])
{
    sky(d, rgb);
    rgb[0] *= 1.001f;
}

typedef struct fixture {
    char root[64], folder[128];
    int warnings;
    ag_log log;
} fixture;

static void count_sentence(void *user, ag_log_level level, const char *sentence)
{
    (void)sentence;
    assert_int_equal(level, AG_LOG_WARNING);
    ++*(int *)user;
}

static void remove_all(const char *folder)
{
    DIR *dir = opendir(folder);
    if (!dir)
        return;
    for (struct dirent *d; (d = readdir(dir));)
        unlinkat(dirfd(dir), d->d_name, 0);
    closedir(dir);
    rmdir(folder);
}

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    snprintf(f->root, sizeof f->root, "/tmp/argand-test-XXXXXX");
    if (!mkdtemp(f->root))
        return -1;
    snprintf(f->folder, sizeof f->folder, "%s/environments", f->root);
    f->log = (ag_log) { count_sentence, &f->warnings, AG_LOG_WARNING };
    setenv("ARGAND_CACHE_DIR", f->root, 1);
    unsetenv("ARGAND_NO_CACHE");
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    remove_all(f->folder);
    remove_all(f->root);
    free(f);
    return 0;
}

// Bake a sky; was it found?
static bool bake(fixture *f, void (*radiance)(const double d[3], float rgb[3]), bake_environment *e)
{
    ag_image *image = sky_image(32, radiance);
    bool cached;
    assert_int_equal(bake_environment_make(&f->log, image, e, &cached), AG_OK);
    ag_image_destroy(image);
    return cached;
}

static bool bake_only(fixture *f, void (*radiance)(const double d[3], float rgb[3]))
{
    bake_environment e;
    bool cached = bake(f, radiance, &e);
    bake_environment_finish(&e);
    return cached;
}

// The one file in the folder.
static void only_entry(const fixture *f, char path[512])
{
    DIR *dir = opendir(f->folder);
    assert_non_null(dir);
    int count = 0;
    for (struct dirent *d; (d = readdir(dir));) {
        if (d->d_name[0] == '.')
            continue;
        snprintf(path, 512, "%s/%s", f->folder, d->d_name);
        count++;
    }
    closedir(dir);
    assert_int_equal(count, 1);
}

static void second_time_is_found(void **state)
{
    fixture *f = *state;
    bake_environment a, b;
    assert_false(bake(f, sky, &a));
    assert_true(bake(f, sky, &b));
    assert_int_equal(a.size, b.size);
    assert_int_equal(a.mip_count, b.mip_count);
    assert_int_equal(a.cube_bytes, b.cube_bytes);
    assert_memory_equal(a.cube, b.cube, a.cube_bytes);
    assert_memory_equal(a.sh, b.sh, sizeof a.sh);
    assert_false(bake_only(f, other_sky)); // the key is the content
    bake_environment_finish(&a);
    bake_environment_finish(&b);
    assert_int_equal(f->warnings, 0);
}

static bool refuse(void *user, const char *stage, double fraction)
{
    (void)fraction;
    ++*(int *)user;
    return strcmp(stage, "bake") != 0;
}

static void quiet(void *user, ag_log_level level, const char *sentence)
{
    (void)user, (void)level, (void)sentence;
}

// What surrounds a scene is prepared ahead: the renderer's own request finds it.
static void a_scene_is_baked_ahead(void **state)
{
    fixture *f = *state;
    ag_scene *scene;
    int asked = 0;
    ag_image *image = sky_image(64, sky);
    const ag_environment_desc desc = { .kind = AG_ENVIRONMENT_IMAGE, .image = image };
    assert_int_equal(ag_scene_create(&(ag_log) { .write = quiet }, &scene), AG_OK);
    assert_int_equal(ag_scene_set_environment(scene, &desc), AG_OK);
    assert_int_equal(ag_scene_bake(scene, &(ag_progress) { refuse, &asked }), AG_ERROR_CANCELLED);
    assert_int_equal(asked, 1);
    assert_int_equal(ag_scene_bake(scene, NULL), AG_OK);
    bake_environment found;
    bool cached = false;
    const ag_image *kept;
    assert_int_equal(scene_environment_open(scene, &kept), AG_OK);
    assert_int_equal(bake_environment_make(&f->log, kept, &found, &cached), AG_OK);
    assert_true(cached);
    bake_environment_finish(&found);
    scene_environment_close(scene, kept);
    const ag_environment_desc none = { .kind = AG_ENVIRONMENT_NONE };
    assert_int_equal(ag_scene_set_environment(scene, &none), AG_OK);
    assert_int_equal(ag_scene_bake(scene, NULL), AG_OK);
    ag_scene_destroy(scene);
    ag_image_destroy(image);
}

static void damage_is_noticed_and_mended(void **state)
{
    fixture *f = *state;
    assert_false(bake_only(f, sky));
    char path[512];
    only_entry(f, path);
    void *good;
    size_t size;
    assert_int_equal(file_read(NULL, path, 1 << 26, &good, &size), AG_OK);
    // One bit in the magic, the key, the sizes, the coefficients, the first and last texel.
    const size_t places[] = { 0, 9, 24, 32, 36, 41, 160, size - 1 };
    for (int i = 0; i < 8; i++) {
        unsigned char *bad = malloc(size);
        memcpy(bad, good, size);
        bad[places[i]] ^= 4;
        assert_int_equal(file_write(NULL, path, bad, size), AG_OK);
        free(bad);
        assert_false(bake_only(f, sky));
        assert_true(bake_only(f, sky)); // written anew
    }
    const size_t lengths[] = { 0, 7, 151, 152, size / 2, size - 1 };
    for (int i = 0; i < 6; i++) {
        assert_int_equal(file_write(NULL, path, good, lengths[i]), AG_OK);
        assert_false(bake_only(f, sky));
        assert_true(bake_only(f, sky));
    }
    free(good);
    assert_int_equal(f->warnings, 0);
}

static void unwanted_cache_is_not_touched(void **state)
{
    fixture *f = *state;
    setenv("ARGAND_NO_CACHE", "1", 1);
    assert_false(bake_only(f, sky));
    assert_false(bake_only(f, sky));
    assert_int_not_equal(access(f->folder, F_OK), 0);
    assert_int_equal(f->warnings, 0);
}

// Nowhere to write (a file where the folder should be, which stops root as well): the
// environment is there all the same, with a warning.
static void no_folder_is_a_warning(void **state)
{
    fixture *f = *state;
    assert_int_equal(file_write(NULL, f->folder, "", 0), AG_OK);
    assert_false(bake_only(f, sky));
    assert_int_equal(f->warnings, 1);
    unlink(f->folder);
}

static void processes_do_not_disturb_each_other(void **state)
{
    fixture *f = *state;
    pid_t children[4];
    for (int i = 0; i < 4; i++) {
        children[i] = fork();
        assert_true(children[i] >= 0);
        if (children[i] == 0) {
            bool sound = true;
            for (int k = 0; k < 4; k++) {
                ag_image *image = sky_image(32, k % 2 ? sky : other_sky);
                bake_environment e;
                sound &= bake_environment_make(&f->log, image, &e, NULL) == AG_OK;
                sound &= fabsf(texel(&e, 3, 2, 8, 8, 1) - 1.9f) < 0.2f;
                bake_environment_finish(&e);
                ag_image_destroy(image);
            }
            _exit(sound && f->warnings == 0 ? 0 : 1);
        }
    }
    for (int i = 0; i < 4; i++) {
        int status;
        assert_int_equal(waitpid(children[i], &status, 0), children[i]);
        assert_int_equal(status, 0);
    }
    assert_true(bake_only(f, sky));
    assert_true(bake_only(f, other_sky));
    DIR *dir = opendir(f->folder);
    int count = 0;
    for (struct dirent *d; (d = readdir(dir));)
        count += d->d_name[0] != '.';
    closedir(dir);
    assert_int_equal(count, 2); // no temporary file is left
}

static void make_entry(const fixture *f, const char *name, size_t bytes, time_t used)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    void *data = calloc(1, bytes);
    assert_int_equal(file_write(NULL, path, data, bytes), AG_OK);
    free(data);
    struct timespec times[2] = { { used, 0 }, { used, 0 } };
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static bool has(const fixture *f, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    return access(path, F_OK) == 0;
}

static void oldest_go_first(void **state)
{
    fixture *f = *state;
    assert_int_equal(mkdir(f->folder, 0700), 0);
    make_entry(f, "a.argand-environment", 1000, 3000);
    make_entry(f, "b.argand-environment", 1000, 1000);
    make_entry(f, "c.argand-environment", 1000, 2000);
    make_entry(f, "d.argand-environment.1-0.tmp", 1000, 1000); // left by a process that died
    make_entry(f, "e.argand-environment.2-0.tmp", 1000, time(NULL));
    make_entry(f, "not-ours", 5000, 1);
    bake_cache_trim(f->folder, 3000);
    assert_true(has(f, "a.argand-environment") && has(f, "b.argand-environment"));
    bake_cache_trim(f->folder, 2999);
    assert_true(has(f, "a.argand-environment") && has(f, "c.argand-environment"));
    assert_false(has(f, "b.argand-environment"));
    bake_cache_trim(f->folder, 1000);
    assert_true(has(f, "a.argand-environment"));
    assert_false(has(f, "c.argand-environment"));
    assert_false(has(f, "d.argand-environment.1-0.tmp"));
    assert_true(has(f, "e.argand-environment.2-0.tmp") && has(f, "not-ours"));
}

static void hash_sees_every_byte(void **state)
{
    (void)state;
    size_t size = 3000001;
    unsigned char *data = calloc(1, size);
    uint64_t whole = bake_cache_hash(data, size, 0);
    assert_true(whole != bake_cache_hash(data, size, 1));
    assert_true(whole != bake_cache_hash(data, size - 1, 0));
    for (size_t i = 0; i < size; i += 333333) {
        data[i] = 1;
        assert_true(whole != bake_cache_hash(data, size, 0));
        data[i] = 0;
    }
    assert_true(whole == bake_cache_hash(data, size, 0));
    free(data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(second_time_is_found, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_scene_is_baked_ahead, set_up, tear_down),
        cmocka_unit_test_setup_teardown(damage_is_noticed_and_mended, set_up, tear_down),
        cmocka_unit_test_setup_teardown(unwanted_cache_is_not_touched, set_up, tear_down),
        cmocka_unit_test_setup_teardown(no_folder_is_a_warning, set_up, tear_down),
        cmocka_unit_test_setup_teardown(processes_do_not_disturb_each_other, set_up, tear_down),
        cmocka_unit_test_setup_teardown(oldest_go_first, set_up, tear_down),
        cmocka_unit_test(hash_sees_every_byte),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
