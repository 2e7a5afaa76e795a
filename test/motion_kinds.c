/* The kinds of random motions: terms of forces, and one function a kind that puts them together. */
#include "test/motion_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Numbers ------------------------------------------------------------------------------------------------------- */

static uint64_t seed;
double motion_kinds_uniform(void) /* splitmix64 */
{
    uint64_t z = seed += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
int motion_kinds_below(int n) { return (int)(motion_kinds_uniform() * n); }
double motion_kinds_between(double a, double b) { return round(1000 * (a + (b - a) * motion_kinds_uniform())) / 1000; }

static double uniform(void) { return motion_kinds_uniform(); }
static int below(int n) { return motion_kinds_below(n); }
static double between(double a, double b) { return motion_kinds_between(a, b); }

/* A form of a sign: seldom (a - b)/|a - b|, which is 0/0 where it starts at 0. */
static int form(void)
{
    const int drawn = below(16);
    return drawn == 15 ? 5 : drawn % 6 == 5 ? 6 : drawn % 6;
}

/* Trees --------------------------------------------------------------------------------------------------------- */

static int two(motion *m, motion_op op, int a, int b) { return motion_add(m, op, a, b, 0); }
static int number(motion *m, double value) { return motion_number(m, value); }
static int flip(motion *m, motion_op op, int a, int b) { return motion_switch(m, op, a, b, 0); }
static int x_of(motion *m, int i) { return motion_variable(m, MOTION_PLACE, i); }
static int v_of(motion *m, int i) { return motion_variable(m, MOTION_SPEED, i); }
static int now(motion *m) { return motion_variable(m, MOTION_TIME, 0); }
static int plus(motion *m, int a, int b) { return two(m, MOTION_ADD, a, b); }
static int minus(motion *m, int a, int b) { return two(m, MOTION_SUB, a, b); }
static int times(motion *m, int a, int b) { return two(m, MOTION_MUL, a, b); }
static int scaled(motion *m, double c, int a) { return times(m, number(m, c), a); }
static int sine(motion *m, int a) { return two(m, MOTION_SIN, a, 0); }

static void until(motion *m, double end)
{
    m->until = motion_decimal(end);
    m->step = end / 200;
}

static void begin(motion *m, int variables)
{
    static const char *const names[] = {"x", "y", "z", "u", "w", "s"};
    m->variables = variables;
    motion_names(m, names);
    for (int i = 0; i < variables; i++) {
        m->x[i] = between(0.3, 1.2);
        m->v[i] = below(3) ? between(-1, 1) : 0;
    }
}

/* Terms --------------------------------------------------------------------------------------------------------- */

static int place(motion *m) { return x_of(m, below(m->variables)); }

/* A threshold: half of them at simple fractions, where steps like to end. */
static double threshold(double size)
{
    return below(2) ? size * (1 + below(7)) / 8 : between(0.05 * size, 0.95 * size);
}

static int smooth_term(motion *m)
{
    const int w = number(m, between(0.3, 3)), c = number(m, between(-1, 1));
    switch (below(5)) {
    case 0: return times(m, c, sine(m, times(m, w, now(m))));
    case 1: return times(m, c, sine(m, times(m, w, place(m))));
    case 2: return times(m, number(m, between(-0.5, -0.05)), v_of(m, below(m->variables)));
    case 3: {
        const int x = place(m);
        return times(m, number(m, between(-0.5, 0)), times(m, x, times(m, x, x)));
    }
    default: {
        const int x = place(m);
        return times(m, c, two(m, MOTION_EXP, times(m, number(m, -1), times(m, x, x)), 0));
    }
    }
}

static int kinked_term(motion *m)
{
    const int c = number(m, between(-1, 1)), x = place(m);
    const int off = plus(m, x, number(m, below(3) ? between(-0.8, 0.8) : 0)), t = now(m);
    switch (below(7)) {
    case 0: return times(m, c, flip(m, MOTION_ABS, off, 0));
    case 1: return times(m, c, times(m, flip(m, MOTION_ABS, off, 0), off));
    case 2: return times(m, c, flip(m, MOTION_SIGN, off, 0));
    case 3: return times(m, c, flip(m, MOTION_MAX, off, number(m, 0)));
    case 4: {
        const int condition = flip(m, MOTION_GREATER, t, number(m, threshold((double)m->until)));
        return motion_add(m, MOTION_IF, condition, c, number(m, 0));
    }
    case 5: return times(m, c, flip(m, MOTION_MOD, t, number(m, between(0.4, 2))));
    default: {
        const int condition = flip(m, MOTION_GREATER, x, number(m, between(-0.5, 0.9))), force = smooth_term(m);
        return motion_add(m, MOTION_IF, condition, force, c);
    }
    }
}

static int kick_term(motion *m)
{
    const double at = threshold((double)m->until), width = pow(10, -1 - 3 * uniform());
    const int t = now(m), size = number(m, between(1, 3) / width);
    if (below(2)) { /* on at `at`, off after `width` */
        const int off = flip(m, MOTION_GREATER, t, number(m, at + width));
        const int inner = motion_add(m, MOTION_IF, off, number(m, 0), size);
        const int on = flip(m, MOTION_GREATER, t, number(m, at));
        return motion_add(m, MOTION_IF, on, inner, number(m, 0));
    }
    const int u = two(m, MOTION_DIV, plus(m, t, number(m, -at)), number(m, width));
    motion_layer_at(m, u, 12, false);
    return times(m, size, two(m, MOTION_EXP, times(m, number(m, -1), times(m, u, u)), 0));
}

/* c sin(w t), of frequency up to 3. */
static int drive(motion *m, double size) { return scaled(m, size, sine(m, scaled(m, between(0.3, 3), now(m)))); }

/* A width of the form 1e-4, 3e-4, or of three decimals. */
static int width_of(motion *m, double least, double *width)
{
    const double w = least * pow(1 / least, uniform());
    char text[MOTION_NUMBER];
    snprintf(text, sizeof text, "%.1e", w);
    *width = strtod(text, NULL);
    return motion_written(m, text, motion_read(text));
}

/* A Gaussian at c of a variable or the time: a hill's push, or its slope. */
static int gaussian(motion *m, int of, double c, double least, double size)
{
    double width;
    const int w = width_of(m, least, &width), u = two(m, MOTION_DIV, minus(m, of, number(m, c)), w);
    motion_layer_at(m, u, 9, false);
    const int peak = two(m, MOTION_EXP, times(m, number(m, -1), times(m, u, u)), 0);
    if (below(2)) return scaled(m, size, peak);
    return scaled(m, size, times(m, u, peak)); /* the force of a potential well, but for its width */
}

/* exp(-(x - c)/w) keeps x above c. */
static int soft_wall(motion *m, int of, double c, double least)
{
    double width;
    const int w = width_of(m, least, &width), u = two(m, MOTION_DIV, minus(m, of, number(m, c)), w);
    motion_layer_at(m, u, 70, true);
    return two(m, MOTION_EXP, times(m, number(m, -1), u), 0);
}

/* Kinds --------------------------------------------------------------------------------------------------------- */

static void smooth(motion *m)
{
    begin(m, 1);
    until(m, between(3, 12));
    int sum = scaled(m, -between(0.5, 4), x_of(m, 0));
    for (int terms = 1 + below(2); terms-- > 0;) sum = plus(m, sum, smooth_term(m));
    m->force[0] = sum;
}

static void coupled(motion *m)
{
    begin(m, 2 + below(2));
    until(m, between(3, 12));
    for (int i = 0; i < m->variables; i++) {
        int sum = scaled(m, -between(0.5, 4), x_of(m, i));
        for (int j = 0; j < m->variables; j++) {
            if (j == i) continue;
            const int d = minus(m, x_of(m, j), x_of(m, i));
            sum = plus(m, sum, scaled(m, between(-0.4, 0.6), below(2) ? d : sine(m, d)));
        }
        if (below(2)) sum = plus(m, sum, smooth_term(m));
        m->force[i] = sum;
    }
}

static int dot(motion *m, motion_op op)
{
    int sum = -1;
    for (int i = 0; i < m->variables; i++) {
        const int c = motion_variable(m, op, i);
        const int square = times(m, c, c);
        sum = sum < 0 ? square : plus(m, sum, square);
    }
    return sum;
}

static const char *const components[] = {"r.x", "r.y", "r.z"};

static void vector(motion *m)
{
    begin(m, 2 + below(2));
    motion_names(m, components);
    until(m, between(2, 10));
    for (int i = 0; i < m->variables; i++) m->x[i] = between(-0.4, 0.4), m->v[i] = between(-0.3, 0.3);
    m->x[0] = between(0.8, 1.2);
    m->v[1] = between(0.8, 1.2);
    const int k = number(m, between(0.8, 1.6)), c = number(m, between(0.05, 0.4));
    const char *K = m->nodes[k].text, *C = m->nodes[c].text;
    const int kind = below(3);
    int factor;
    if (kind == 0) {
        const int rr = dot(m, MOTION_PLACE), r = two(m, MOTION_SQRT, rr, 0);
        factor = two(m, MOTION_DIV, k, times(m, r, rr));
        snprintf(m->equations, sizeof m->equations,
                 below(2) ? "r'' = -%s r/|r|^3" : "r'' = -%s r/(r.x^2 + r.y^2%s)^1.5", K,
                 m->variables == 3 ? " + r.z^2" : "");
    } else if (kind == 1) {
        factor = plus(m, k, times(m, c, dot(m, MOTION_PLACE)));
        snprintf(m->equations, sizeof m->equations, "r'' = -%s r - %s |r|^2 r", K, C);
    } else {
        factor = k;
        snprintf(m->equations, sizeof m->equations, "r'' = -%s r - %s |r'| r'", K, C);
    }
    const int drag = kind == 2 ? times(m, c, two(m, MOTION_SQRT, dot(m, MOTION_SPEED), 0)) : -1;
    for (int i = 0; i < m->variables; i++) {
        m->force[i] = scaled(m, -1, times(m, factor, x_of(m, i)));
        if (drag >= 0) m->force[i] = minus(m, m->force[i], times(m, drag, v_of(m, i)));
    }
}

static void family(motion *m)
{
    static const char *const cells[] = {"x[1]", "x[2]", "x[3]", "x[4]"};
    begin(m, 3 + below(2));
    motion_names(m, cells);
    until(m, between(2, 8));
    for (int i = 0; i < m->variables; i++) m->x[i] = between(-1, 1);
    const int k = number(m, between(0.5, 3)), c = number(m, between(0.1, 1)), d = number(m, between(0, 0.5));
    for (int i = 0; i < m->variables; i++) {
        const int x = x_of(m, i);
        int sum = minus(m, scaled(m, -1, times(m, k, x)), times(m, d, times(m, x, times(m, x, x))));
        for (int j = 0; j < m->variables; j++)
            if (j != i) sum = plus(m, sum, times(m, c, sine(m, minus(m, x_of(m, j), x))));
        m->force[i] = sum;
    }
    snprintf(m->equations, sizeof m->equations,
             "x[i]'' = -%s x[i] - %s x[i]^3 + sum(j = 1..%d: %s sin(x[j] - x[i])) for i = 1..%d", m->nodes[k].text,
             m->nodes[d].text, m->variables, m->nodes[c].text, m->variables);
}

/* A root of what the motion carries through 0, where its slope is infinite. */
static int root_of(motion *m, int u)
{
    if (below(3)) return two(m, MOTION_CBRT, u, 0);
    const int size = flip(m, MOTION_ABS, u, 0), power = below(2) ? MOTION_SQRT : MOTION_CBRT;
    return times(m, flip(m, MOTION_SIGN, u, 0), two(m, (motion_op)power, size, 0));
}

static void root(motion *m)
{
    begin(m, below(3) ? 1 : 2);
    until(m, between(3, 12));
    for (int i = 0; i < m->variables; i++) {
        const double size = pow(10, below(3) - 1), at = below(2) ? 0 : between(-0.3, 0.3);
        const int u =
            m->variables > 1 && below(2) ? minus(m, x_of(m, i), x_of(m, 1 - i)) : minus(m, x_of(m, i), number(m, at));
        int sum = scaled(m, -between(0.3, 3), root_of(m, u));
        if (below(3) == 0) sum = plus(m, sum, scaled(m, -between(0.05, 0.3), v_of(m, i)));
        if (below(3) == 0) sum = plus(m, sum, drive(m, between(0.1, 1)));
        if (below(3) == 0) sum = plus(m, sum, scaled(m, -between(0.1, 1), x_of(m, i)));
        m->force[i] = sum;
        m->x[i] = round(1000 * size * m->x[i]) / 1000, m->v[i] = round(1000 * size * m->v[i]) / 1000;
    }
}

/* A block on a belt or on the ground, at a spring. */
static void belt(motion *m)
{
    begin(m, 1);
    until(m, between(4, 15));
    const int belt = number(m, below(2) ? 0 : between(-0.5, 0.5));
    int sum = scaled(m, -between(0.2, 4), x_of(m, 0));
    if (below(2)) sum = plus(m, sum, drive(m, between(0.1, 1.5)));
    if (below(3) == 0) sum = plus(m, sum, scaled(m, -between(0.05, 0.3), v_of(m, 0)));
    const int side = motion_switch(m, MOTION_SIDE, v_of(m, 0), belt, form());
    m->force[0] = minus(m, sum, scaled(m, between(0.1, 1.2), side));
}

static void kinked(motion *m)
{
    begin(m, 1);
    until(m, between(3, 12));
    int sum = scaled(m, -between(0.5, 4), x_of(m, 0));
    if (below(2)) sum = plus(m, sum, smooth_term(m));
    m->force[0] = plus(m, sum, kinked_term(m));
}

static void several(motion *m)
{
    begin(m, 1 + below(2));
    until(m, between(3, 12));
    for (int i = 0; i < m->variables; i++) {
        int sum = scaled(m, -between(0.5, 4), x_of(m, i));
        for (int n = 2 + below(3); n-- > 0;) sum = plus(m, sum, kinked_term(m));
        m->force[i] = sum;
    }
}

static void close_by(motion *m)
{
    begin(m, 2);
    motion_names(m, components);
    until(m, between(1, 5));
    m->x[0] = between(0.6, 1.2), m->x[1] = between(-0.05, 0.05);
    m->v[0] = between(-0.5, 0), m->v[1] = between(0.02, 0.3);
    const int k = number(m, between(0.5, 2)), rr = dot(m, MOTION_PLACE);
    if (below(2)) {
        const int r = two(m, MOTION_SQRT, rr, 0), factor = two(m, MOTION_DIV, k, times(m, r, rr));
        for (int i = 0; i < 2; i++) m->force[i] = scaled(m, -1, times(m, factor, x_of(m, i)));
        snprintf(m->equations, sizeof m->equations, "r'' = -%s r/|r|^3", m->nodes[k].text);
    } else {
        const int e = number(m, between(0.005, 0.1)), soft = plus(m, rr, times(m, e, e));
        const int factor = two(m, MOTION_DIV, k, times(m, soft, two(m, MOTION_SQRT, soft, 0)));
        for (int i = 0; i < 2; i++) m->force[i] = scaled(m, -1, times(m, factor, x_of(m, i)));
        snprintf(m->equations, sizeof m->equations, "r'' = -%s r/(|r|^2 + %s^2)^1.5", m->nodes[k].text,
                 m->nodes[e].text);
    }
}

static void stiff(motion *m)
{
    begin(m, 1);
    until(m, between(1, 3));
    const int x = x_of(m, 0), v = v_of(m, 0);
    if (below(2)) { /* drawn fast to a slow curve */
        const double rate = between(20, 300);
        const int curve = sine(m, scaled(m, between(0.3, 2), now(m)));
        const int pull = scaled(m, -rate * between(1, 5), minus(m, x, curve));
        m->force[0] = plus(m, pull, scaled(m, -rate, v));
    } else { /* van der Pol's oscillator */
        const int damp = times(m, minus(m, number(m, 1), times(m, x, x)), v);
        m->force[0] = minus(m, scaled(m, between(5, 60), damp), x);
        m->x[0] = between(0.5, 2);
    }
}

static void chaos(motion *m)
{
    begin(m, 1);
    const int x = x_of(m, 0), t = now(m), v = v_of(m, 0);
    const int f = number(m, between(0.25, 1.6)), w = number(m, between(0.6, 1.2));
    const int push = times(m, f, sine(m, times(m, w, t)));
    switch (below(3)) {
    case 0:
        until(m, between(20, 60));
        m->force[0] =
            plus(m, minus(m, scaled(m, -between(0.05, 0.3), v), minus(m, times(m, x, times(m, x, x)), x)), push);
        break;
    case 1:
        until(m, between(20, 60));
        m->force[0] = plus(m, minus(m, scaled(m, -between(0.05, 0.3), v), sine(m, x)), push);
        break;
    default: { /* Hénon and Heiles */
        begin(m, 2);
        until(m, between(20, 80));
        m->x[0] = between(-0.1, 0.1), m->x[1] = between(-0.2, 0.3);
        m->v[0] = between(0.2, 0.42), m->v[1] = between(-0.1, 0.1);
        const int p = x_of(m, 0), q = x_of(m, 1);
        m->force[0] = minus(m, scaled(m, -1, p), scaled(m, 2, times(m, p, q)));
        m->force[1] = plus(m, minus(m, scaled(m, -1, q), times(m, p, p)), times(m, q, q));
    }
    }
}

static void lasting(motion *m)
{
    begin(m, 1);
    until(m, between(100, 400));
    const int x = x_of(m, 0);
    int sum = scaled(m, -between(0.3, 2), below(2) ? x : sine(m, x));
    if (below(2)) sum = plus(m, sum, scaled(m, -between(0.01, 0.3), times(m, x, times(m, x, x))));
    if (below(3) == 0) sum = plus(m, sum, scaled(m, -between(0.001, 0.01), v_of(m, 0)));
    m->force[0] = sum;
    m->step = 0.05;
}

static void backward(motion *m)
{
    m->frame.backward = true;
    switch (below(3)) {
    case 0: smooth(m); break;
    case 1: coupled(m); break;
    default: /* kinks of a continuous force, which the motion passes alike both ways */
        begin(m, 1);
        until(m, between(3, 10));
        const int off = minus(m, x_of(m, 0), number(m, between(-0.6, 0.6)));
        const int kink =
            below(2) ? motion_switch(m, MOTION_ABS, off, 0, below(5)) : flip(m, MOTION_MAX, off, number(m, 0));
        m->force[0] = plus(m, plus(m, scaled(m, -between(0.5, 4), x_of(m, 0)), scaled(m, between(-0.4, 0.4), kink)),
                           drive(m, between(0, 1)));
        break;
    }
}

static void any(motion *m)
{
    switch (below(6)) {
    case 0: smooth(m); break;
    case 1: coupled(m); break;
    case 2: kinked(m); break;
    case 3: belt(m); break;
    default: smooth(m); break;
    }
}

static void offset(motion *m)
{
    const int which = below(3);
    if (which != 0) {
        const double size = pow(10, 5 + below(5));
        m->frame.start = below(2) ? size : round(1000 * (size + between(0, 1000))) / 1000;
        m->frame.summed = below(2);
        m->frame.absolute = below(2);
        /* the sum of start and end has three decimals, which a double of 1e9 shows */
    }
    if (which != 1) m->frame.origin = (below(2) ? 1 : -1) * pow(10, below(7)) * (1 + below(9));
    if (m->frame.absolute)
        smooth(m); /* switches of the time would not be met */
    else
        any(m);
}

static void scale(motion *m)
{
    m->frame.scaled = true;
    m->frame.length = below(61) - 30;
    m->frame.time = below(2) ? 0 : below(19) - 9;
    any(m);
}

/* A number as a difference of literals: (1000.7 - 1000.6). */
static int difference(motion *m, double value)
{
    char text[MOTION_NUMBER], a[24], b[24];
    const double base = round(pow(10, 1 + 5 * uniform())) + between(0, 1);
    snprintf(a, sizeof a, "%.3f", base + value);
    snprintf(b, sizeof b, "%.3f", base);
    snprintf(text, sizeof text, "(%s - %s)", a, b);
    return motion_written(m, text, motion_read(a) - motion_read(b));
}

static void cancel(motion *m)
{
    begin(m, 1);
    until(m, between(3, 12));
    int sum = times(m, difference(m, -between(0.5, 4)), x_of(m, 0));
    if (below(2)) sum = plus(m, sum, times(m, difference(m, -between(0.05, 0.5)), v_of(m, 0)));
    if (below(2))
        sum = plus(m, sum,
                   times(m, difference(m, between(-1, 1)), sine(m, times(m, difference(m, between(0.3, 3)), now(m)))));
    m->force[0] = sum;
}

/* Numbers that pass through 0 where the run ends. */
static void vanish(motion *m)
{
    begin(m, 1);
    const int w = 1 + below(4), quarter = 1 + below(12);
    m->force[0] = scaled(m, -w * w, x_of(m, 0));
    if (below(2)) { /* undamped cos or sin: one of both ends at 0 */
        const bool from_rest = below(2);
        m->x[0] = from_rest ? between(0.3, 2) : 0, m->v[0] = from_rest ? 0 : between(0.3, 2);
    }
    m->until = quarter * motion_pi() / (2 * w);
    m->step = (double)m->until / 200;
    snprintf(m->frame.until, sizeof m->frame.until, w == 1 ? "%d pi/2" : "%d pi/%d", quarter, 2 * w);
}

static void bump(motion *m)
{
    begin(m, 1);
    until(m, between(4, 12));
    const double size = below(2) ? between(0.1, 0.6) : between(-1, 1);
    int sum = scaled(m, -between(0.5, 3), x_of(m, 0));
    sum = plus(m, sum, gaussian(m, x_of(m, 0), between(-0.7, 0.8), 1e-4, size));
    if (below(4) == 0) sum = plus(m, sum, scaled(m, -between(0.01, 0.2), v_of(m, 0)));
    m->force[0] = sum;
}

static void pulse(motion *m)
{
    begin(m, 1);
    until(m, between(4, 12));
    int sum = scaled(m, -between(0.5, 3), below(2) ? x_of(m, 0) : sine(m, x_of(m, 0)));
    for (int n = 1 + below(2); n-- > 0;) {
        const double at = threshold((double)m->until);
        sum = plus(m, sum, gaussian(m, now(m), round(1000 * at) / 1000, 1e-5, between(0.5, 5)));
    }
    m->force[0] = sum;
}

static void wall(motion *m)
{
    begin(m, 1);
    until(m, between(3, 10));
    m->x[0] = between(0, 0.9);
    const double c = between(-0.7, -0.1);
    const int sum = scaled(m, -between(0.5, 2), x_of(m, 0));
    m->force[0] = plus(m, sum, soft_wall(m, x_of(m, 0), c, 1e-5));
}

static void flight(motion *m)
{
    begin(m, 1);
    m->x[0] = 0, m->v[0] = between(0.5, 1.5);
    const double at = between(3, 30);
    until(m, round(1000 * at / m->v[0] * (1.3 + uniform())) / 1000);
    m->step = 0.05;
    switch (below(4)) {
    case 0: m->force[0] = gaussian(m, x_of(m, 0), at, 1e-2, between(-0.3, 1)); break;
    case 1: m->force[0] = gaussian(m, now(m), at, 1e-3, between(-1, 1)); break;
    case 2: { /* the wall comes from the left */
        m->v[0] = -m->v[0];
        m->force[0] = soft_wall(m, x_of(m, 0), -at, 1e-3);
        break;
    }
    default: {
        const int first = gaussian(m, x_of(m, 0), at, 0.1, between(-0.2, 0.2));
        m->force[0] = plus(m, first, gaussian(m, x_of(m, 0), at / 2, 0.1, between(-0.2, 0.2)));
    }
    }
}

/* What starts at a kink: at rest, or with an argument that is 0. */
static void at_rest(motion *m)
{
    begin(m, 1);
    until(m, between(2, 12));
    m->x[0] = below(2) ? 0 : between(-0.8, 0.8), m->v[0] = 0;
    const int x = x_of(m, 0), v = v_of(m, 0), t = now(m);
    int push;
    switch (below(4)) { /* forces that grow from 0 as t, t^2, t^3 */
    case 0: push = drive(m, between(0.3, 1.5)); break;
    case 1: push = scaled(m, between(0.1, 0.6), two(m, MOTION_DIV, t, plus(m, number(m, 1), times(m, t, t)))); break;
    case 2:
        push = scaled(m, between(0.1, 0.6), two(m, MOTION_DIV, times(m, t, t), plus(m, number(m, 1), times(m, t, t))));
        break;
    default: {
        const int s = sine(m, scaled(m, between(0.5, 2), t));
        push = scaled(m, between(0.3, 1.5), times(m, s, times(m, s, s)));
    }
    }
    if (below(3) == 0) push = scaled(m, -1, push);
    int sum = push;
    if (below(2))
        sum = minus(m, sum, scaled(m, between(0.5, 2), m->x[0] != 0 ? minus(m, x, number(m, m->x[0])) : sine(m, x)));
    const double c = between(0.1, 1);
    switch (below(5)) {
    case 0: /* air */
    case 1: sum = minus(m, sum, scaled(m, c, times(m, motion_switch(m, MOTION_ABS, v, 0, below(5)), v))); break;
    case 2: sum = minus(m, sum, scaled(m, c, motion_switch(m, MOTION_SIDE, v, number(m, 0), form()))); break;
    case 3:
        sum = minus(m, sum, scaled(m, c, motion_switch(m, MOTION_ABS, minus(m, x, number(m, m->x[0])), 0, below(5))));
        break;
    default: {
        const int over = flip(m, MOTION_MAX, minus(m, x, number(m, m->x[0])), number(m, 0));
        sum = minus(m, sum, scaled(m, between(1, 20), over));
    }
    }
    m->force[0] = sum;
}

/* One switch in two forms. */
static void twice(motion *m)
{
    begin(m, 1);
    until(m, between(3, 12));
    const int x = x_of(m, 0), v = v_of(m, 0);
    int sum = scaled(m, -between(0.5, 4), x);
    if (below(2)) sum = plus(m, sum, drive(m, between(0.2, 1)));
    if (below(2)) { /* |u| in two forms */
        const int of = below(2) ? minus(m, x, number(m, between(-0.6, 0.6))) : v;
        const int first = below(5), one = motion_switch(m, MOTION_ABS, of, 0, first);
        const int other = motion_again(m, one, (first + 1 + below(4)) % 5);
        sum = minus(m, sum, scaled(m, between(0.05, 0.4), times(m, one, v)));
        sum = minus(m, sum, scaled(m, between(0.05, 0.4), other));
    } else {
        const int of = below(3) ? v : x, first = form();
        const int at = number(m, below(2) ? 0 : between(-0.3, 0.3));
        const int one = motion_switch(m, MOTION_SIDE, of, at, first), other = motion_again(m, one,
                                                                                           first == 1 ? 0
                                                                                           : below(3) ? 1
                                                                                                      : form());
        sum = minus(m, sum, scaled(m, between(0.1, 0.6), one));
        sum = minus(m, sum, scaled(m, between(0.1, 0.6), other));
    }
    m->force[0] = sum;
}

/* Two or three blocks on one another, the lowest on ice, at the ground or at a spring; the forces of friction are
 * written on each block, in forms of their own. */
static void blocks(motion *m)
{
    static const char *const names[] = {"x1", "x2", "x3"};
    begin(m, 2 + below(2));
    motion_names(m, names);
    until(m, between(2, 8));
    const int n = m->variables;
    int sums[3], mass[3];
    for (int i = 0; i < n; i++) {
        m->x[i] = below(2) ? 0 : between(-1, 1);
        m->v[i] = below(2) ? 0 : between(-1.5, 1.5);
        mass[i] = number(m, below(2) ? 1 + below(3) : between(0.5, 3));
        sums[i] = number(m, 0);
        if (i == 0 || below(2)) sums[i] = below(2) ? drive(m, between(0.3, 2)) : number(m, between(-1, 1));
        if (below(3) == 0) sums[i] = minus(m, sums[i], scaled(m, between(0.5, 3), x_of(m, i)));
    }
    for (int i = 0; i + 1 < n; i++) {
        const int mu = number(m, between(0.2, 1.5)), upper_form = form();
        const int upper = motion_switch(m, MOTION_SIDE, v_of(m, i), v_of(m, i + 1), upper_form);
        const int lower = motion_again(m, upper, below(2) ? 1 : form());
        sums[i] = minus(m, sums[i], times(m, mu, upper));
        sums[i + 1] = plus(m, sums[i + 1], times(m, mu, lower));
    }
    if (below(3) == 0) {
        const int ground = motion_switch(m, MOTION_SIDE, v_of(m, n - 1), number(m, 0), form());
        sums[n - 1] = minus(m, sums[n - 1], scaled(m, between(0.2, 1), ground));
    }
    for (int i = 0; i < n; i++) m->force[i] = two(m, MOTION_DIV, sums[i], mass[i]);
}

static void plane(motion *m)
{
    begin(m, 2);
    motion_names(m, components);
    until(m, between(1, 5));
    for (int i = 0; i < 2; i++) m->x[i] = below(2) ? 0 : between(-1, 1), m->v[i] = between(-2, 2);
    if (m->v[0] == 0 && m->v[1] == 0) m->v[0] = 1;
    const int mu = number(m, between(0.2, 4));
    m->slides = m->nodes[mu].value;
    const char *friction[] = {"r'/|r'|", "r'/sqrt(r'.x^2 + r'.y^2)"};
    char tilt[128] = "", spring[128] = "", drag[128] = "";
    int tilts[2] = {-1, -1}, k = -1, d = -1;
    if (below(2)) {
        for (int i = 0; i < 2; i++) tilts[i] = number(m, between(-1, 1));
        snprintf(tilt, sizeof tilt, "(%s, %s)", m->nodes[tilts[0]].text, m->nodes[tilts[1]].text);
    }
    if (below(2)) {
        k = number(m, between(0.2, 4));
        snprintf(spring, sizeof spring, " - %s r", m->nodes[k].text);
    }
    if (below(3) == 0) {
        d = number(m, between(0.05, 0.5));
        snprintf(drag, sizeof drag, " - %s r'", m->nodes[d].text);
    }
    for (int i = 0; i < 2; i++) {
        int sum = tilts[i] >= 0 ? tilts[i] : number(m, 0);
        if (k >= 0) sum = minus(m, sum, times(m, k, x_of(m, i)));
        if (d >= 0) sum = minus(m, sum, times(m, d, v_of(m, i)));
        m->force[i] = sum;
    }
    snprintf(m->equations, sizeof m->equations, "r'' = %s%s%s - %s %s", tilt, spring, drag, m->nodes[mu].text,
             friction[below(2)]);
}

/* Contact at any height ----------------------------------------------------------------------------------------- */

static double level_of(void)
{
    static const double levels[] = {0, -1, 0.1, 1, 2, 100, -3.7, 5, 0.3, 1000};
    return below(2) ? levels[below(10)] : between(-5, 5);
}

/* A ball that falls onto a floor and keeps e of its speed. fall: when it hits; hit: how fast. */
static void ball(motion *m, double *level, double *g, double *height)
{
    begin(m, 1);
    snprintf(m->place[0], MOTION_NAME, "y");
    snprintf(m->speed[0], MOTION_NAME, "y'");
    *level = level_of(), *g = between(5, 10), *height = between(0.5, 2);
    m->x[0] = round(1000 * (*level + *height)) / 1000;
    m->v[0] = below(2) ? 0 : between(-1, 1);
}

static void floor_at(motion *m, double level, int e)
{
    const int cross = motion_switch(m, MOTION_CROSS, x_of(m, 0), number(m, level), 0);
    const int after = scaled(m, -1, times(m, e, v_of(m, 0)));
    m->events[m->event_count++] = (motion_event){cross, -1, MOTION_SPEED, 0, after};
}

static void bounce(motion *m)
{
    double level, g, height;
    ball(m, &level, &g, &height);
    const double e = below(4) ? between(0.5, 0.95) : 1, hit = sqrt(m->v[0] * m->v[0] + 2 * g * height);
    const double fall = (m->v[0] + hit) / g, last = e < 1 ? fall + 2 * hit / g * e / (1 - e) : 1e9;
    const bool drags = below(3) == 0;
    /* some bounces, well before they accumulate */
    until(m, fmin((drags ? 0.5 : 0.9) * last, fall + between(0.5, 5)));
    int sum = number(m, -g);
    if (drags) sum = minus(m, sum, scaled(m, between(0.05, 0.3), v_of(m, 0)));
    m->force[0] = sum;
    floor_at(m, level, number(m, e));
}

/* The same to the end, where the bounces accumulate. */
static void gather(motion *m)
{
    double level, g, height;
    ball(m, &level, &g, &height);
    const int e = number(m, between(0.3, 0.9)), gravity = number(m, -g), floor = number(m, level);
    const quad G = -m->nodes[gravity].value, E = m->nodes[e].value, v = motion_decimal(m->v[0]);
    const quad hit = motion_root(v * v + 2 * G * (motion_decimal(m->x[0]) - m->nodes[floor].value));
    m->gathers = (v + hit) / G + 2 * hit / G * E / (1 - E);
    until(m, 0.7 * (double)m->gathers);
    snprintf(m->frame.until, sizeof m->frame.until, "%.3f", 2 * (double)m->gathers);
    m->force[0] = gravity;
    floor_at(m, level, e);
}

/* A heater is switched on and off between two temperatures; the mode and a variable of first order. */
static void thermostat(motion *m)
{
    static const char *const names[] = {"T", "x"};
    begin(m, 1 + below(2));
    motion_names(m, names);
    m->first_order[0] = true;
    until(m, between(5, 15));
    m->x[0] = between(19, 21);
    m->modes = 1, m->mode[0] = below(2);
    const int on = motion_variable(m, MOTION_MODE, 0), T = x_of(m, 0);
    const double loss = between(0.1, 0.4), outside = between(5, 10);
    const int heat = scaled(m, loss * (21 - outside) + between(0.5, 3), on);
    m->force[0] = minus(m, heat, scaled(m, loss, minus(m, T, number(m, outside))));
    if (m->variables > 1) /* what swings with it */
        m->force[1] =
            minus(m, scaled(m, between(0.1, 1), minus(m, T, number(m, 20))), scaled(m, between(0.5, 3), x_of(m, 1)));
    const double top = between(21.1, 22), bottom = between(18, 18.9);
    const int hot = motion_switch(m, MOTION_CROSS, T, number(m, top), 0),
              cold = motion_switch(m, MOTION_CROSS, T, number(m, bottom), 0);
    m->events[m->event_count++] = (motion_event){hot, 1, MOTION_MODE, 0, number(m, 0)};
    m->events[m->event_count++] = (motion_event){cold, -1, MOTION_MODE, 0, number(m, 1)};
}

/* Two to four balls, each with springs to the others in half of them, which bounce on one floor. */
static void balls(motion *m)
{
    static const char *const cells[] = {"y[1]", "y[2]", "y[3]", "y[4]"};
    begin(m, 2 + below(3));
    motion_names(m, cells);
    const double g = between(5, 10);
    double first = 1e9;
    const int level = number(m, level_of()), e = number(m, between(0.6, 0.95)), gravity = number(m, -g);
    const int c = number(m, below(2) ? 0 : between(0.1, 1)), d = number(m, below(2) ? 0 : between(0.05, 0.3));
    for (int i = 0; i < m->variables; i++) {
        const double height = between(0.5, 2), v = below(2) ? 0 : between(-1, 1);
        m->x[i] = round(1000 * ((double)m->nodes[level].value + height)) / 1000;
        m->v[i] = v;
        const double hit = sqrt(v * v + 2 * g * height), rest = (double)m->nodes[e].value;
        first = fmin(first, (v + hit) / g + 2 * hit / g * rest / (1 - rest));
    }
    /* some bounces each, well before those of one accumulate */
    until(m, fmin(0.4 * first, between(1, 5)));
    for (int i = 0; i < m->variables; i++) {
        int sum = minus(m, gravity, times(m, d, v_of(m, i)));
        for (int j = 0; j < m->variables; j++)
            if (j != i) sum = plus(m, sum, times(m, c, minus(m, x_of(m, j), x_of(m, i))));
        m->force[i] = sum;
        const int cross = motion_switch(m, MOTION_CROSS, x_of(m, i), level, 0);
        const int after = scaled(m, -1, times(m, e, v_of(m, i)));
        m->events[m->event_count++] = (motion_event){cross, -1, MOTION_SPEED, i, after};
    }
    snprintf(m->equations, sizeof m->equations,
             "y[i]'' = %s - %s y[i]' + sum(j = 1..%d: %s (y[j] - y[i])) for i = 1..%d\n"
             "when y[i] = %s falling: y[i]' = -%s y[i]', record for i = 1..%d",
             m->nodes[gravity].text, m->nodes[d].text, m->variables, m->nodes[c].text, m->variables,
             m->nodes[level].text, m->nodes[e].text, m->variables);
}

/* Two to four cells that charge and fire, each fed by the others. */
static void fire(motion *m)
{
    static const char *const cells[] = {"u[1]", "u[2]", "u[3]", "u[4]"};
    begin(m, 2 + below(3));
    motion_names(m, cells);
    until(m, between(3, 10));
    const int drive = number(m, between(1.2, 2)), k = number(m, between(0.2, 0.9)), c = number(m, between(0, 0.2));
    const int top = number(m, 1), rest = number(m, below(2) ? 0 : between(-0.3, 0.3));
    for (int i = 0; i < m->variables; i++) m->first_order[i] = true, m->x[i] = between(0, 0.9), m->v[i] = 0;
    for (int i = 0; i < m->variables; i++) {
        int sum = minus(m, drive, times(m, k, x_of(m, i)));
        for (int j = 0; j < m->variables; j++)
            if (j != i) sum = plus(m, sum, times(m, c, sine(m, minus(m, x_of(m, j), x_of(m, i)))));
        m->force[i] = sum;
        const int cross = motion_switch(m, MOTION_CROSS, x_of(m, i), top, 0);
        m->events[m->event_count++] = (motion_event){cross, 1, MOTION_PLACE, i, rest};
    }
    snprintf(m->equations, sizeof m->equations,
             "u[i]' = %s - %s u[i] + sum(j = 1..%d: %s sin(u[j] - u[i])) for i = 1..%d\n"
             "when u[i] = 1 rising: u[i] = %s, record for i = 1..%d",
             m->nodes[drive].text, m->nodes[k].text, m->variables, m->nodes[c].text, m->variables, m->nodes[rest].text,
             m->variables);
}

static void penalty(motion *m)
{
    begin(m, 1);
    snprintf(m->place[0], MOTION_NAME, "y");
    snprintf(m->speed[0], MOTION_NAME, "y'");
    const double level = level_of(), g = between(5, 10), k = round(pow(10, 2 + 4 * uniform()));
    m->x[0] = round(1000 * (level + between(0.2, 1.5))) / 1000;
    m->v[0] = below(2) ? 0 : between(-1, 1);
    until(m, between(1, 4));
    const int y = x_of(m, 0), v = v_of(m, 0);
    int press;
    if (below(2)) {
        press = scaled(m, k, flip(m, MOTION_MAX, minus(m, number(m, level), y), number(m, 0)));
    } else { /* a spring with damping, which also holds back */
        const int inside = flip(m, MOTION_GREATER, number(m, level), y);
        const int spring = minus(m, scaled(m, k, minus(m, number(m, level), y)), scaled(m, between(0, 5), v));
        press = motion_add(m, MOTION_IF, inside, spring, number(m, 0));
    }
    m->force[0] = minus(m, press, number(m, g));
    m->step = 1e-3;
}

/* ------------------------------------------------------------------------------------------------------------------ */

#define NAME(name, word, make) word,
#define MAKE(name, word, make) make,
static const char *const names[] = {MOTION_KINDS(NAME)};
static void (*const makers[])(motion *) = {MOTION_KINDS(MAKE)};
#undef NAME
#undef MAKE

const char *motion_kinds_name(int kind) { return names[kind]; }

void motion_kinds_make(motion *m, int kind, uint64_t k)
{
    seed = 1000003u * k + 7919u * (uint64_t)kind + 99;
    uniform();
    memset(m, 0, sizeof *m);
    m->kind = kind;
    makers[kind](m);
}

/* Of reference solutions ---------------------------------------------------------------------------------------- */

/* -k x/|x|^3 in the plane, or -k/x² on a line: an encounter, or a fall into the centre. */
static void singular_force(motion *m)
{
    const int x = x_of(m, 0), y = x_of(m, 1), k = number(m, -between(0.5, 2));
    if (m->variables == 1) {
        const int xx = times(m, x, x);
        m->force[0] = two(m, MOTION_DIV, below(3) ? k : number(m, 0.5), xx);
        return;
    }
    const int rr = plus(m, times(m, x, x), times(m, y, y));
    const int rrr = times(m, rr, rr); /* a force as 1/r³ */
    m->force[0] = two(m, MOTION_DIV, times(m, k, x), rrr);
    m->force[1] = two(m, MOTION_DIV, times(m, k, y), rrr);
}

void motion_kinds_claim(motion *m, int k)
{
    static const char *const places[] = {"x", "y"};
    seed = 1000003u * (uint64_t)k + 17;
    uniform();
    memset(m, 0, sizeof *m);
    const double which = uniform();
    m->kind = which < 0.5    ? MOTION_CLAIM_SMOOTH
              : which < 0.75 ? MOTION_CLAIM_KINKED
              : which < 0.9  ? MOTION_CLAIM_KICKED
                             : MOTION_CLAIM_SINGULAR;
    m->variables = 1 + (below(4) == 0);
    motion_names(m, places);
    const double end = below(2) ? 4 + below(9) : between(3, 12);
    until(m, end);
    m->step = below(2) ? end / (16 << below(4)) : between(0.02, 0.3);
    for (int i = 0; i < m->variables; i++) {
        m->x[i] = between(0.3, 1.2);
        m->v[i] = below(3) ? between(-1, 1) : 0;
    }
    if (m->variables == 1 && below(4) == 0) m->index = below(2) ? "[i]" : "[j]"; /* of a sum with one term */
    m->cell_x = between(-0.5, 0.2);
    m->cell_v = between(-1, 1);
    if (m->index) {
        snprintf(m->place[0], MOTION_NAME, "x%s", m->index);
        snprintf(m->speed[0], MOTION_NAME, "x%s'", m->index);
    }
    if (m->kind == MOTION_CLAIM_SINGULAR) {
        const double step = m->step;
        until(m, between(1, 4));
        m->step = step;
        singular_force(m);
        return;
    }
    for (int i = 0; i < m->variables; i++) {
        int sum = scaled(m, -between(0.5, 4), x_of(m, i));
        for (int terms = below(3); terms-- > 0;) sum = plus(m, sum, smooth_term(m));
        if (m->kind == MOTION_CLAIM_KINKED)
            for (int terms = 1 + below(2); terms-- > 0;) sum = plus(m, sum, kinked_term(m));
        if (m->kind == MOTION_CLAIM_KICKED && i == 0) sum = plus(m, sum, kick_term(m));
        m->force[i] = sum;
    }
}
