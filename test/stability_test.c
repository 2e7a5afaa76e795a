/* motus_stability against theory: the stability function of each Runge-Kutta method, the recurrences of the two-step
 * methods off the axis, the limit on each card, and the error for methods that admit no velocities.
 */
#include "test/given.h"

#include <complex.h>
#include <stdbool.h>

typedef double complex point;
typedef point function(point z);

static double random_number(uint64_t *state) /* splitmix64, to (-1, 1) */
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

static void radii(const char *method, size_t count, const double *re, const double *im, double *radius)
{
    motus_error err = motus_default_error();
    must(motus_stability(method, count, re, im, radius, &err), &err, method);
}

static double radius_at(const char *method, double re, double im)
{
    double r = -1;
    radii(method, 1, &re, &im, &r);
    return r;
}

/* Runge-Kutta: |R(z)| ---------------------------------------------------------------------------------------------- */

static point euler(point z) { return 1 + z; }
static point second(point z) { return 1 + z + z * z / 2; }
static point third(point z) { return 1 + z + z * z / 2 + z * z * z / 6; }
static point fourth(point z) { return 1 + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24; }
static point pade1(point z) { return (1 + z / 2) / (1 - z / 2); }
static point pade2(point z) { return (1 + z / 2 + z * z / 12) / (1 - z / 2 + z * z / 12); }
static point pade3(point z)
{
    return (120 + 60 * z + 12 * z * z + z * z * z) / (120 - 60 * z + 12 * z * z - z * z * z);
}
static point pade4(point z)
{
    const point z2 = z * z;
    return (1680 + 840 * z + 180 * z2 + 20 * z2 * z + z2 * z2) / (1680 - 840 * z + 180 * z2 - 20 * z2 * z + z2 * z2);
}

static const struct {
    const char *method;
    function *r;
    int degree;
    bool implicit;
} textbook[] = {
    {"explicit-euler", euler, 1, false},
    {"midpoint", second, 2, false},
    {"heun", second, 2, false},
    {"ralston", second, 2, false},
    {"rk3", third, 3, false},
    {"rk4", fourth, 4, false},
    {"rk4-38", fourth, 4, false},
    {"implicit-midpoint", pade1, 1, true},
    {"newmark", pade1, 1, true}, /* with (1/4, 1/2) it is the trapezoidal rule */
    {"gauss4", pade2, 2, true},
    {"gauss6", pade3, 3, true},
    {"gauss8", pade4, 4, true},
};
enum { TEXTBOOK = sizeof textbook / sizeof *textbook };

/* The entries of R(A) are as large as sum |z|^k/k! times |z| at most, and rounded once per stage; the radius squared
 * is a difference of products of two. Implicit: relative to the solved matrix, whose inverse is as large as the
 * distance of the poles says. */
static double margin(size_t m, point z)
{
    double sum = 0, term = 1, size = cabs(z) + 1;
    for (int k = 0; k <= textbook[m].degree; k++, term *= cabs(z) / k) sum += term;
    if (textbook[m].implicit) sum = size * (1 + cabs(textbook[m].r(z))) * (1 + cabs(textbook[m].r(-z)));
    return 64 * ROUNDING * textbook[m].degree * sum * sum * size * size;
}

static void is_the_textbooks(void **state)
{
    (void)state;
    enum { MANY = 500 };
    for (size_t m = 0; m < TEXTBOOK; m++) {
        uint64_t random = 17 + m;
        double re[MANY], im[MANY], r[MANY];
        for (size_t k = 0; k < MANY; k++) {
            re[k] = 4 * random_number(&random);
            im[k] = 4 * random_number(&random);
        }
        radii(textbook[m].method, MANY, re, im, r);
        for (size_t k = 0; k < MANY; k++) {
            const point z = re[k] + I * im[k];
            const double expected = cabs(textbook[m].r(z)), off = fabs(r[k] * r[k] - expected * expected);
            if (!(off <= margin(m, z)))
                fail_msg("%s at %g%+gi: %.17g, expected %.17g: squares %.1e apart, margin %.1e", textbook[m].method,
                         re[k], im[k], r[k], expected, off, margin(m, z));
        }
    }
}

/* Where both rates are equal and λ is real, rounding splits the double eigenvalue like a root. */
static void on_the_real_axis(void **state)
{
    (void)state;
    for (size_t m = 0; m < TEXTBOOK; m++)
        for (double x = -3.75; x < 1.5; x += 0.25) {
            const double r = radius_at(textbook[m].method, x, 0), expected = cabs(textbook[m].r(x));
            if (!(fabs(r - expected) <= sqrt(margin(m, x))))
                fail_msg("%s at %g: %.17g, expected %.17g", textbook[m].method, x, r, expected);
        }
}

static void poles_are_infinite(void **state)
{
    (void)state;
    assert_true(isinf(radius_at("implicit-midpoint", 2, 0)));
    /* and do not affect other points */
    const double re[] = {-1, 2, 0.5, 2}, im[] = {1, 0, 0, 0.5};
    double r[4];
    radii("implicit-midpoint", 4, re, im, r);
    for (int k = 0; k < 4; k++)
        if (k != 1) assert_true(fabs(r[k] - cabs(pade1(re[k] + I * im[k]))) < 1e-7);
    assert_true(isinf(r[1]));
}

static void stable_on_the_left(void **state)
{
    (void)state;
    static const char *const all[] = {"implicit-midpoint", "gauss4", "gauss6", "gauss8", "newmark"};
    for (size_t m = 0; m < sizeof all / sizeof *all; m++)
        for (double size = 1e-3; size < 2e5; size *= 3)
            for (int k = 0; k <= 40; k++) {
                const double angle = M_PI * k / 80, re = k == 40 ? 0 : -size * cos(angle), im = size * sin(angle);
                const double left = radius_at(all[m], re, im), right = radius_at(all[m], -re, im);
                /* of a double eigenvalue: the root of some epsilon */
                const double rounding = 1e-7 * (1 + size * 1e-4);
                if (!(left <= 1 + rounding) || !(right >= 1 - rounding))
                    fail_msg("%s at ∓%g%+gi: %.17g, %.17g", all[m], -re, im, left, right);
            }
}

/* Two-step methods ------------------------------------------------------------------------------------------------- */

/* The larger root of μ² a + μ b + c, and how far apart the two are. */
static double larger_root(double a, double b, double c, double *gap)
{
    const point root = csqrt(b * b - 4 * a * c);
    *gap = cabs(root / a);
    return fmax(cabs((-b + root) / (2 * a)), cabs((-b - root) / (2 * a)));
}

/* x₊ - 2x + x₋ = σ (x₊ - x₋) - |z|² x, the velocity being the central difference: μ² (1 - σ) - (2 - |z|²) μ + (1 + σ)
 * = 0. */
static void verlet_is_its_recurrence(void **state)
{
    (void)state;
    static const char *const both[] = {"verlet", "verlet-literal"};
    for (int m = 0; m < 2; m++) {
        uint64_t random = 5;
        for (int k = 0; k < 400; k++) {
            double re = 3 * random_number(&random), im = 3 * random_number(&random);
            if (k % 4 == 0) re = -1; /* where the old position cancels */
            if (k % 4 == 1) re = 0;
            if (fabs(1 - re) < 0.01) continue;
            double gap;
            const double w = re * re + im * im, expected = larger_root(1 - re, w - 2, 1 + re, &gap),
                         r = radius_at(both[m], re, im);
            /* Rounded entries as large as `size` move a root by as much over the gap, or by the root of that. */
            const double size = (3 + w) / fabs(1 - re), rounding = 64 * ROUNDING * size * size;
            if (!(fabs(r - expected) <= fmin(rounding / gap, sqrt(rounding))))
                fail_msg("%s at %g%+gi: %.17g, expected %.17g", both[m], re, im, r, expected);
        }
        assert_true(isinf(radius_at(both[m], 1, 0.5))); /* 1 - σ = 0: the step has no unique solution */
    }
}

/* Beeman's positions are Verlet's, though its state has an acceleration. */
static void beeman_is_verlet_on_the_axis(void **state)
{
    (void)state;
    for (double w = 0.01; w < 6; w += 0.0503) {
        double gap;
        const double r = radius_at("beeman", 0, w), expected = larger_root(1, w * w - 2, 1, &gap),
                     rounding = 64 * ROUNDING * (3 + w * w) * (3 + w * w);
        if (!(fabs(r - expected) <= fmin(rounding / gap, sqrt(rounding))))
            fail_msg("beeman at %gi: %.17g, expected %.17g", w, r, expected);
    }
}

/* The card --------------------------------------------------------------------------------------------------------- */

/* Above the limit the radius grows from 1 like a root, below it is 1; a method that is never stable grows from the
 * smallest step on. */
static void agrees_with_the_card(void **state)
{
    (void)state;
    for (size_t m = 0; m < motus_method_count(); m++) {
        const motus_method *card = motus_method_at(m);
        if (!strcmp(card->family, "exact")) continue;
        const double limit = card->stability_limit;
        bool good = true;
        if (isinf(limit)) /* the acceleration, of size w², is rounded and added to a position of size 1 */
            for (double w = 0.01; w < 1e5; w *= 1.9)
                good = good && radius_at(card->name, 0, w) <= 1 + 8 * ROUNDING * (1 + w * w);
        else if (limit == 0) {

            /* the growth of a high order is lost in rounding at small steps, and may end at larger ones */
            bool some = false, all = true;
            for (double w = 0.02; w < (card->order > 8 ? 9 : 3); w *= 1.3) {
                const double r = radius_at(card->name, 0, w);
                some = some || r > 1 + 1e-10;
                all = all && r > 1 + 1e-10;
            }
            good = card->adaptive || card->order > 5 ? some : all;
        } else {
            double low = limit * 0.9999, high = limit * 1.0001;
            for (int k = 1; k <= 1000; k++)
                good = good && radius_at(card->name, 0, limit * 0.9999 * k / 1000) <= 1 + 1e-12;
            while (high - low > 1e-11) {
                const double middle = (low + high) / 2;
                if (radius_at(card->name, 0, middle) > 1 + 1e-12)
                    high = middle;
                else
                    low = middle;
            }
            /* the radius of a high order leaves 1 like a high power, and is seen only a little later */
            good = good && fabs(low - limit) < (card->adaptive ? 1e-3 : 1e-8);
            if (!good) fail_msg("%s: limit %.12g, the card has %.12g", card->name, low, limit);
        }
        if (!good) fail_msg("%s: the limit is not %g", card->name, limit);
        /* friction, if the card's forces have it; the Boris rotation has none either */
        assert_true(isnan(radius_at(card->name, -0.1, 0.3)) ==
                    (card->forces != MOTUS_FORCES_XVT || !strcmp(card->name, "boris")));
        assert_true(radius_at(card->name, 0, 0) <= 1 + 1e-15);
        assert_true(radius_at(card->name, 0, 0.7) == radius_at(card->name, 0, -0.7));
    }
}

/* Requests --------------------------------------------------------------------------------------------------------- */

/* A point's radius does not depend on the other points. */
static void many_are_as_one(void **state)
{
    (void)state;
    enum { MANY = 37 };
    static const char *const some[] = {"verlet", "rk4", "gauss6", "beeman"};
    for (size_t m = 0; m < 4; m++) {
        double re[MANY], im[MANY], r[MANY];
        uint64_t random = 3;
        for (size_t k = 0; k < MANY; k++) {
            re[k] = k % 3 ? random_number(&random) : 0;
            im[k] = 2 * random_number(&random);
        }
        radii(some[m], MANY, re, im, r);
        for (size_t k = 0; k < MANY; k++) {
            const double alone = radius_at(some[m], re[k], im[k]);
            assert_true(isnan(alone) ? isnan(r[k]) : fabs(alone - r[k]) <= 1e-13);
        }
    }
}

static void wrong_requests(void **state)
{
    (void)state;
    motus_error e = motus_default_error();
    const double re[] = {0, NAN}, im[] = {1, 1};
    double r[2] = {7, 7};
    assert_int_equal(motus_stability("exact", 1, re, im, r, &e), MOTUS_METHOD);
    assert_true(e.message[0] && e.hint[0]);
    assert_int_equal(motus_stability("verletto", 1, re, im, r, &e), MOTUS_METHOD);
    assert_non_null(strstr(e.hint, "verlet"));
    assert_int_equal(motus_stability("verlet", 2, re, im, r, &e), MOTUS_ARGUMENT);
    assert_non_null(strstr(e.message, "point 2"));
    const double far = 2 * MOTUS_STABILITY_FAR;
    assert_int_equal(motus_stability("verlet", 1, &far, im, r, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_stability(NULL, 1, re, im, r, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_stability("verlet", 1, NULL, im, r, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_stability("verlet", 1, re, im, NULL, NULL), MOTUS_ARGUMENT);
    assert_true(r[0] == 7 && r[1] == 7);
    assert_int_equal(motus_stability("verlet", 0, NULL, NULL, NULL, &e), MOTUS_OK);
    assert_true(radius_at("newmark(1/4, 0.6)", 0, 1) < 1 - 1e-3); /* gamma above 1/2 damps */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_the_textbooks),         cmocka_unit_test(on_the_real_axis),
        cmocka_unit_test(poles_are_infinite),       cmocka_unit_test(stable_on_the_left),
        cmocka_unit_test(verlet_is_its_recurrence), cmocka_unit_test(beeman_is_verlet_on_the_axis),
        cmocka_unit_test(agrees_with_the_card),     cmocka_unit_test(many_are_as_one),
        cmocka_unit_test(wrong_requests),
    };
    return cmocka_run_group_tests_name("stability", tests, NULL, NULL);
}
