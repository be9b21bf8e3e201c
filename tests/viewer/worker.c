// Workers: jobs are done once, and who was stopped says nothing more, whatever log it has.
#include "viewer/worker.h"

#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static void wake(void)
{
}

static ag_status say_at_the_end(void *context, worker *self)
{
    const ag_log *log = context;
    while (!worker_is_stopped(self))
        sched_yield();
    log->write(log->user, AG_LOG_ERROR, "I was stopped");
    return AG_ERROR_CANCELLED;
}

static ag_status say(void *context, worker *self)
{
    (void)self;
    const ag_log *log = context;
    log->write(log->user, AG_LOG_WARNING, "I was not");
    return AG_OK;
}

static void test_who_is_stopped_is_silent(void **state)
{
    (void)state;
    crew *c = crew_create(wake);
    worker *one = worker_create(c), *other = worker_create(c);
    ag_log log = crew_log(c, AG_LOG_INFO);
    ag_status status;
    worker_start(one, say_at_the_end, &log);
    worker_start(other, say, &log);
    worker_wait(other);
    assert_true(worker_ends(other, 0));
    assert_false(worker_ends(one, 0.01));
    worker_stop(one);
    assert_true(worker_ends(one, 60));
    worker_wait(one);
    assert_true(worker_is_busy(one));
    assert_true(worker_collect(one, &status) && status == AG_ERROR_CANCELLED);
    assert_false(worker_is_busy(one) || worker_collect(one, &status));
    assert_true(worker_collect(other, &status) && status == AG_OK);

    ag_log_level level;
    char sentence[CREW_SENTENCE_MAX];
    assert_true(crew_hear(c, &level, sentence));
    assert_string_equal(sentence, "I was not");
    assert_int_equal(level, AG_LOG_WARNING);
    assert_false(crew_hear(c, &level, sentence));
    worker_destroy(one);
    worker_destroy(other);
    crew_destroy(c);
}

static void test_the_last_sentences_are_kept(void **state)
{
    (void)state;
    crew *c = crew_create(wake);
    ag_log log = crew_log(c, AG_LOG_INFO);
    char said[16], heard[CREW_SENTENCE_MAX];
    for (int i = 0; i < 100; i++) {
        snprintf(said, sizeof said, "%d", i);
        log.write(log.user, AG_LOG_INFO, said); // of no worker: the window's thread
    }
    ag_log_level level;
    int count = 0;
    while (crew_hear(c, &level, heard))
        count++;
    assert_true(count > 0 && count < 100);
    assert_string_equal(heard, "99");
    crew_destroy(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_who_is_stopped_is_silent),
        cmocka_unit_test(test_the_last_sentences_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
