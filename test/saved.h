/* What tests of restart states share: to save and restore, and to damage what was saved.
 */
#ifndef TEST_SAVED_H
#define TEST_SAVED_H

#include "test/given.h"

typedef struct kept {
    char *text;
    size_t length;
} kept;

UNUSED static kept save(motus_run *r)
{
    const char *text = NULL;
    motus_error err = motus_default_error();
    kept k = {NULL, 0};
    must(motus_run_save(r, &text, &k.length, &err), &err, "save");
    assert_int_equal(strlen(text), k.length);
    k.text = malloc(k.length + 1);
    assert_non_null(k.text);
    memcpy(k.text, text, k.length + 1);
    return k;
}

UNUSED static motus_status restore(motus_run *r, kept k, motus_error *err)
{
    *err = motus_default_error();
    return motus_run_restore(r, k.text, k.length, err);
}

UNUSED static void same_counts(motus_run *a, motus_run *b)
{
    assert_int_equal(motus_run_steps(a), motus_run_steps(b));
    assert_int_equal(motus_run_now(a).evaluations, motus_run_now(b).evaluations);
    assert_int_equal(motus_run_now(a).iterations, motus_run_now(b).iterations);
    assert_true(motus_run_time(a) == motus_run_time(b));
}

/* Every byte changed, in every bit and to some that matter to a reader of numbers; every length; every byte removed
 * or doubled. */
UNUSED static void no_damage_passes(motus_run *q, kept k)
{
    motus_error err;
    char *copy = malloc(k.length + 2);
    assert_non_null(copy);
    kept bad = {copy, k.length};
    for (size_t i = 0; i < k.length; i++) {
        static const char others[] = "0 9af-+.px\n\377";
        for (size_t j = 0; j < 8 + sizeof others; j++) {
            memcpy(copy, k.text, k.length + 1);
            copy[i] = j < 8 ? (char)(copy[i] ^ (1 << j)) : others[j - 8];
            if (copy[i] == k.text[i]) continue;
            if (restore(q, bad, &err) != MOTUS_STATE) fail_msg("byte %zu as %d was accepted", i, copy[i]);
        }
    }
    for (size_t n = 0; n < k.length; n++) {
        memcpy(copy, k.text, n);
        bad.length = n;
        assert_int_equal(restore(q, bad, &err), MOTUS_STATE);
        memcpy(copy + n, k.text + n + 1, k.length - n); /* one removed */
        bad.length = k.length - 1;
        assert_int_equal(restore(q, bad, &err), MOTUS_STATE);
        memcpy(copy, k.text, n + 1); /* one twice */
        memcpy(copy + n + 1, k.text + n, k.length - n);
        bad.length = k.length + 1;
        assert_int_equal(restore(q, bad, &err), MOTUS_STATE);
    }
    free(copy);
}

/* FNV-1a, as in the last line: with a valid checksum, damage must not crash either. */
UNUSED static void seal(char *text, size_t length)
{
    enum { CLOSING = 21 };
    uint64_t h = 14695981039346656037u;
    for (size_t i = 0; i < length - CLOSING; i++) h = (h ^ (unsigned char)text[i]) * 1099511628211u;
    char closing[CLOSING + 1];
    snprintf(closing, sizeof closing, "end %016llx\n", (unsigned long long)h);
    memcpy(text + length - CLOSING, closing, CLOSING);
}

/* Every byte changed to some, and sealed. What is accepted may be another state, but must do no harm. Returns how many
 * were refused. */
UNUSED static int refuse_forgeries(motus_run *r, kept k)
{
    motus_error err;
    char *copy = malloc(k.length + 1);
    assert_non_null(copy);
    int refused = 0;
    for (size_t i = 0; i + 21 < k.length; i++) {
        static const char others[] = "0 19af-+.px\n";
        for (size_t j = 0; j < sizeof others; j++) {
            memcpy(copy, k.text, k.length + 1);
            copy[i] = others[j];
            seal(copy, k.length);
            refused += restore(r, (kept){copy, k.length}, &err) != MOTUS_OK;
        }
    }
    free(copy);
    return refused;
}

#endif
