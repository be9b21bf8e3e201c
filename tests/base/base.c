// The ground floor: files, threads, hashes, arrays, logs, the cache folder.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/array.h"
#include "base/cache.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/threads.h"

#include <dirent.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/argand-base-XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

typedef struct heard {
    int count;
    ag_log_level level;
    char text[1024];
} heard;

static void hear(void *user, ag_log_level level, const char *sentence)
{
    heard *h = user;
    h->count++;
    h->level = level;
    snprintf(h->text, sizeof h->text, "%s", sentence);
}

static int entries(const char *path)
{
    int count = 0;
    DIR *dir = opendir(path);
    while (readdir(dir))
        count++;
    closedir(dir);
    return count - 2;
}

static void files_appear_whole_or_not_at_all(void **state)
{
    (void)state;
    char path[128];
    heard h = { 0 };
    const ag_log log = { .write = hear, .user = &h };
    snprintf(path, sizeof path, "%s/a", folder);
    assert_int_equal(file_write(&log, path, "first", 5), AG_OK);
    file_writer *writer;
    assert_int_equal(file_writer_open(&log, path, &writer), AG_OK);
    assert_int_equal(file_writer_put(writer, "sec", 3), AG_OK);
    void *data;
    size_t size;
    assert_int_equal(file_read(&log, path, 100, &data, &size), AG_OK); // still the old one
    assert_int_equal(size, 5);
    assert_string_equal(data, "first");
    free(data);
    file_writer_abandon(writer);
    assert_int_equal(entries(folder), 1);
    assert_int_equal(file_write(&log, path, "second", 6), AG_OK);
    assert_int_equal(file_read(&log, path, 100, &data, &size), AG_OK);
    assert_string_equal(data, "second");
    free(data);
    assert_int_equal(entries(folder), 1);
    assert_int_equal(h.count, 0);
}

static void links_stay_links(void **state)
{
    (void)state;
    char link[128], through[160], target[128];
    struct stat st;
    void *data;
    size_t size;
    snprintf(link, sizeof link, "%s/link", folder);
    snprintf(through, sizeof through, "%s/through", folder);
    snprintf(target, sizeof target, "%s/not-there-yet", folder);
    assert_int_equal(symlink("not-there-yet", link), 0); // beside the link
    assert_int_equal(symlink(link, through), 0);
    assert_int_equal(file_write(NULL, through, "new", 3), AG_OK);
    assert_int_equal(lstat(through, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(file_read(NULL, target, 100, &data, &size), AG_OK);
    assert_string_equal(data, "new");
    free(data);
}

static void files_that_cannot_be_read_are_told(void **state)
{
    (void)state;
    char path[128];
    heard h = { 0 };
    const ag_log log = { .write = hear, .user = &h };
    void *data = &h;
    size_t size;
    assert_int_equal(file_read(&log, "/no/such/file", 100, &data, &size), AG_ERROR_FILE);
    assert_null(data);
    assert_non_null(strstr(h.text, "/no/such/file"));
    assert_int_equal(file_read(&log, folder, 100, &data, &size), AG_ERROR_FILE);
    assert_int_equal(file_read(&log, "/dev/zero", 100, &data, &size), AG_ERROR_FILE);
    snprintf(path, sizeof path, "%s/long", folder);
    assert_int_equal(file_write(&log, path, "0123456789", 10), AG_OK);
    assert_int_equal(file_read(&log, path, 9, &data, &size), AG_ERROR_FILE);
    file_writer *writer;
    assert_int_equal(file_writer_open(&log, "/no/such/folder/x", &writer), AG_ERROR_FILE);
    assert_null(writer);
    assert_int_equal(h.count, 5);
}

typedef struct counters {
    atomic_int calls[5000];
} counters;

static void count_call(void *context, size_t index)
{
    counters *c = context;
    atomic_fetch_add(&c->calls[index], 1);
}

static void every_task_runs_once(void **state)
{
    (void)state;
    static counters c;
    parallel_for(0, count_call, &c);
    parallel_for(1, count_call, &c);
    parallel_for(5000, count_call, &c);
    assert_int_equal(c.calls[0], 2);
    for (int i = 1; i < 5000; i++)
        assert_int_equal(c.calls[i], 1);
    assert_true(threads_available() >= 1);
}

// Any bit of the input moves about half of the bits of the hash.
static void hashes_spread(void **state)
{
    (void)state;
    unsigned char bytes[37] = { 1, 2, 3 };
    uint64_t before = hash_bytes(bytes, sizeof bytes, 0);
    int fewest = 64, sum = 0;
    for (int bit = 0; bit < 37 * 8; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        int moved = __builtin_popcountll(before ^ hash_bytes(bytes, sizeof bytes, 0));
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        fewest = moved < fewest ? moved : fewest;
        sum += moved;
    }
    assert_true(fewest >= 12);
    assert_in_range(sum, 30 * 37 * 8, 34 * 37 * 8);
    assert_int_not_equal(before, hash_bytes(bytes, sizeof bytes, 1));
    assert_int_not_equal(before, hash_bytes(bytes, sizeof bytes - 1, 0)); // a zero less
}

static void arrays_grow_or_stay(void **state)
{
    (void)state;
    int *items = NULL;
    size_t capacity = 0;
    for (int i = 0; i < 1000; i++) {
        assert_true(array_reserve(&items, &capacity, (size_t)i + 1, sizeof *items));
        items[i] = i;
    }
    for (int i = 0; i < 1000; i++)
        assert_int_equal(items[i], i);
    int *before = items;
    assert_false(array_reserve(&items, &capacity, SIZE_MAX / 2, sizeof *items));
    assert_ptr_equal(items, before);
    free(items);
}

static void sentences_wait_for_the_caller(void **state)
{
    (void)state;
    heard h = { 0 };
    const ag_log log = { .write = hear, .user = &h };
    log_buffer buffer = { 0 };
    ag_log inner = log_to_buffer(&buffer);
    log_write(&inner, AG_LOG_WARNING, "a warning");
    assert_int_equal(log_fail(&inner, AG_ERROR_FORMAT, "an error %d", 7), AG_ERROR_FORMAT);
    log_write(&inner, AG_LOG_WARNING, "another warning");
    assert_int_equal(h.count, 0);
    log_flush(&log, &buffer);
    log_flush(&log, &buffer);
    assert_int_equal(h.count, 1);
    assert_string_equal(h.text, "an error 7");
    log_write(&log, AG_LOG_INFO, "not wanted");
    assert_int_equal(h.count, 1);
}

static void the_cache_is_where_it_is_told(void **state)
{
    (void)state;
    char path[CACHE_PATH_MAX], wanted[CACHE_PATH_MAX];
    struct stat st;
    snprintf(wanted, sizeof wanted, "%s/own/deep", folder);
    setenv("ARGAND_CACHE_DIR", wanted, 1);
    unsetenv("ARGAND_NO_CACHE");
    assert_true(cache_directory("part", path));
    strcat(wanted, "/part");
    assert_string_equal(path, wanted);
    assert_int_equal(stat(path, &st), 0);
    setenv("ARGAND_NO_CACHE", "1", 1);
    assert_false(cache_directory("part", path));
    unsetenv("ARGAND_NO_CACHE");
    unsetenv("ARGAND_CACHE_DIR");
    setenv("XDG_CACHE_HOME", folder, 1);
    assert_true(cache_directory("part", path));
    snprintf(wanted, sizeof wanted, "%s/argand/part", folder);
    assert_string_equal(path, wanted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_appear_whole_or_not_at_all),
        cmocka_unit_test(links_stay_links),
        cmocka_unit_test(files_that_cannot_be_read_are_told),
        cmocka_unit_test(every_task_runs_once),
        cmocka_unit_test(hashes_spread),
        cmocka_unit_test(arrays_grow_or_stay),
        cmocka_unit_test(sentences_wait_for_the_caller),
        cmocka_unit_test(the_cache_is_where_it_is_told),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
