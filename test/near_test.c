/* "Did you mean": edits counted in halves, look-alike characters, and when a suggestion is plausible. */
#include "base/near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { FAR = 20 };

static void both_ways(const char *a, const char *b, int halves)
{
    assert_int_equal(near_distance(a, b, FAR), halves);
    assert_int_equal(near_distance(b, a, FAR), halves);
}

static void test_edits(void **state)
{
    (void)state;
    both_ways("verlet", "verlet", 0);
    both_ways("verlet", "verlett", 2); /* one more */
    both_ways("verlet", "verlat", 2);  /* another */
    both_ways("verlet", "velret", 2);  /* two neighbours swapped */
    both_ways("", "abc", 6);
    both_ways("kitten", "sitting", 6);
    both_ways("verlet", "Verlet", 1);   /* letter case, */
    both_ways("\u00B5", "\u03BC", 1);   /* a look-alike: micro and mu, */
    both_ways("\u03A9", "\u03C9", 1);   /* a Greek capital: half an edit */
    both_ways("\u00E4b", "\u00E4c", 2); /* a character is one letter, not two bytes */
    both_ways("a\xFF", "a\xFE", 2);     /* and a byte that is not UTF-8 is one, too */
    assert_true(near_distance("abcdefgh", "a", 4) > 4);
    char longer[200]; /* only the first 64 characters count */
    memset(longer, 'x', sizeof longer);
    longer[199] = 0;
    assert_int_equal(near_distance(longer, longer + 100, FAR), 0);
}

static void test_likely(void **state)
{
    (void)state;
    assert_true(near_likely("theta", "thetta"));
    assert_true(near_likely("omega", "Omega"));
    assert_false(near_likely("k", "m"));
    assert_false(near_likely("energy", "theta"));
    int least = 7;
    assert_true(near_nearer("theta", "thetaa", &least));
    assert_int_equal(least, 2);
    assert_false(near_nearer("theta", "thetab", &least)); /* no nearer */
    assert_true(near_nearer("theta", "Theta", &least));
    assert_int_equal(least, 1);
    assert_false(near_nearer("theta", "energy", &least));
}

static void test_look_alike(void **state)
{
    (void)state;
    char out[64] = "";
    assert_true(near_look_alike("\u00B5", "\u03BC", out, sizeof out));
    assert_string_equal(out, "U+00B5 against U+03BC");
    assert_false(near_look_alike("mu", "mu", out, sizeof out));
    assert_false(near_look_alike("mu", "mv", out, sizeof out));
    assert_false(near_look_alike("mu", "muu", out, sizeof out));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_edits), cmocka_unit_test(test_likely),
                                       cmocka_unit_test(test_look_alike)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
