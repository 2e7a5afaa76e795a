/* Bars of error of quantities that jump, have a pole or an infinite slope where x is c, with c so many bars of x from
 * where the motion ends: inside of the bar they may be told as not known, INFINITY, and nowhere may one be wrong by
 * more than ten bars. Far from c every error is known.
 */
#include "test/given.h"
#include "test/share.h"

#include <stdbool.h>

enum { FAR = 1000 }; /* bars of x from c, where an error has to be known */

static long double side(long double u, long double v) { return (void)v, (long double)((u > 0) - (u < 0)); }
static long double root(long double u, long double v) { return (void)v, sqrtl(fmaxl(0, u)); }
static long double pole(long double u, long double v) { return (void)v, 1 / u; }
static long double square(long double u, long double v) { return (void)v, 1 / (u * u); }
static long double logarithm(long double u, long double v) { return (void)v, logl(fabsl(u)); }
static long double cube_root(long double u, long double v) { return (void)v, cbrtl(u); }
static long double power(long double u, long double v) { return (void)v, powl(fabsl(u), 0.25L); }
static long double rate(long double u, long double v) { return v / u; }
static long double turn(long double u, long double v) { return (void)v, atanl(1 / u); }
static long double tangent(long double u, long double v) { return (void)v, tanl(4 * atanl(1) / 2 + u); }
static long double angle(long double u, long double v) { return (void)v, acosl(fminl(1, fmaxl(-1, 1 - u))); }
static long double smooth(long double u, long double v) { return (void)v, sinl(u) / u; }
static long double both(long double u, long double v) { return (void)v, (u + 3e-7L) / u; }
static long double nearly(long double u, long double v) { return (void)v, (3e-7L + u * cosl(u)) / sinl(u); }
static long double rational(long double u, long double v) { return (void)v, 2 + u; }
static long double shut(long double u, long double v) { return (void)v, expl(-1 / (u * u)); }
static long double kink(long double u, long double v) { return (void)v, fabsl(u); }

static const struct sharp {
    const char *text;
    long double (*truth)(long double u, long double v);
    bool bounded; /* its error is known inside of the bar, too */
} sharps[] = {{"|x - c|/(x - c)", side, false},
              {"(x - c)/|x - c|", side, false},
              {"if(x > c, 1, -1)", side, false},
              {"sqrt(max(0, x - c))", root, true},
              {"1/(x - c)", pole, false},
              {"1/(x - c)^2", square, false},
              {"log(|x - c|)", logarithm, false},
              {"cbrt(x - c)", cube_root, true},
              {"|x - c|^0.25", power, true},
              {"x'/(x - c)", rate, false},
              {"atan(1/(x - c))", turn, false},
              {"tan(pi/2 + x - c)", tangent, false},
              {"acos(min(1, max(-1, 1 - (x - c))))", angle, true},
              {"sin(x - c)/(x - c)", smooth, true},
              {"((x - c)^2 + 2 (x - c))/(x - c)", rational, true},
              {"(x - c + 3e-7)/(x - c)", both, false},
              {"(3e-7 + (x - c) cos(x - c))/sin(x - c)", nearly, false},
              {"exp(-1/(x - c)^2)", shut, true},
              {"|x - c|", kink, true}};
enum { SHARPS = sizeof sharps / sizeof *sharps };

static motus_run *finished(const char *text, motus_system **s, const char *method, double step, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(text);
    def.method = method, def.step = step, def.machine = "interpreter", def.until = until;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(*s, &def, &r, &err), &err, text);
    must(motus_run_finish(r, &err), &err, text);
    return r;
}

static double error_of(motus_run *r, size_t column, double *value)
{
    motus_error err = motus_default_error();
    double error;
    must(motus_run_errors(r, &column, 1, value, &error, &err), &err, "a quantity");
    return error;
}

static const char motion[] = "x'' = -x\nx(0) = 1\nx'(0) = 0\n";

static void judge(const char *method, double step, double until, double bars, double bar, double c)
{
    char text[2048];
    int n = snprintf(text, sizeof text, "%sc = %.17g\n", motion, c);
    for (int k = 0; k < SHARPS; k++) n += snprintf(text + n, sizeof text - (size_t)n, "q%d = %s\n", k, sharps[k].text);
    motus_system *s;
    motus_run *r = finished(text, &s, method, step, until);
    const long double u = cosl(until) - c, v = -sinl(until);
    size_t column = 0, numbers = 0;
    motus_error err = motus_default_error();
    must(motus_column_find(s, "q0", &column, &numbers, &err), &err, "q0");
    for (int k = 0; k < SHARPS; k++) {
        double value;
        const double error = error_of(r, column + (size_t)k, &value);
        const long double truth = sharps[k].truth(u, v), off = fabsl(value - truth);
        if (!(off <= 10 * error)) /* both may be infinite */
            fail_msg("%s: %s at %g bars (%g) from c is %g ± %g, right %Lg", method, sharps[k].text, bars, bar, value,
                     error, truth);
        if (isinf(error) && (sharps[k].bounded || fabs(bars) >= FAR))
            fail_msg("%s: %s at %g bars (%g) from c is not known", method, sharps[k].text, bars, bar);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void near_a_sharp_place(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double step;
    } runs[] = {{"verlet", 0.05}, {"verlet", 0.003}, {"rk4", 0.05}, {"gauss4", 0.1}, {"dop853", NAN}};
    static const double bars[] = {0.003, 0.02, 0.1, 0.3, 0.7, 0.9, 1.1, 1.5, 3, 10, 100, 1000, 1e5};
    static const double ends[] = {2, 3, 7, 10, 31};
    for (size_t m = 0; m < sizeof runs / sizeof *runs; m++)
        for (size_t e = 0; e < sizeof ends / sizeof *ends; e++) {
            motus_system *s;
            motus_run *r = finished(motion, &s, runs[m].method, runs[m].step, ends[e]);
            double x;
            const double bar = error_of(r, 1, &x);
            motus_run_destroy(r);
            motus_system_destroy(s);
            for (size_t k = 0; k < sizeof bars / sizeof *bars; k++)
                for (int way = -1; way <= 1; way += 2)
                    if (bars[k] * bar < 0.1)
                        judge(runs[m].method, runs[m].step, ends[e], way * bars[k], bar,
                              (double)cosl(ends[e]) + way * bars[k] * bar);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(near_a_sharp_place)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
