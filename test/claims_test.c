/* What the reference solution claims about itself, for 700 random models: smooth ones, some with kinks and jumps, with
 * late short kicks, with singularities. The truth is a run of 113 bits by another method: extrapolated midpoint steps
 * (Gragg) that end at every switch, which this file finds by itself from the tree of the force.
 *
 * A claim that is below a tenth of the true error fails the test. CLAIMS=n tries n models, of which 2000 take four
 * minutes; CLAIM=k prints model k alone.
 */
#include "test/given.h"

#include "test/quad.h"

#include <stdbool.h>

/* Numbers ------------------------------------------------------------------------------------------------------- */

static uint64_t seed;
static double uniform(void) /* in [0, 1): splitmix64 */
{
    uint64_t z = seed += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
static int below(int n) { return (int)(uniform() * n); }
static double between(double a, double b) { return round(1000 * (a + (b - a) * uniform())) / 1000; }

static quad absolute(quad x) { return x < 0 ? -x : x; }

/* 1/k!, and what a column of the extrapolation weighs the one before with: products are faster than divisions. Filled
 * at the start. For |x| < 0.01 what follows the term x^TERMS/TERMS! is below the last of 113 bits. */
enum { COLUMNS = 9, TERMS = 13 };
static quad over[TERMS + 1], weight[COLUMNS][COLUMNS];

static void fill(void)
{
    over[0] = 1;
    for (int k = 1; k <= TERMS; k++) over[k] = over[k - 1] / k;
    for (int k = 1; k < COLUMNS; k++)
        for (int j = 0; j < k; j++) weight[k][j] = 1 / ((quad)((k + 1) * (k + 1)) / ((j + 1) * (j + 1)) - 1);
}

static quad exponential(quad x)
{
    int halvings = 0;
    for (; absolute(x) > Q(0.01) && halvings < 40; halvings++) x *= Q(0.5);
    quad sum = 0; /* exp(x) - 1 */
    for (int k = TERMS; k > 0; k--) sum = (sum + over[k]) * x;
    while (halvings-- > 0) sum = sum * (sum + 2);
    return sum + 1;
}

static quad sine(quad x)
{
    const quad turn = Q(6.283185307179586476925286766559005768394338798750), third = 1 / Q(3.0);
    x -= turn * (quad)round((double)(x / turn));
    int thirds = 0;
    for (; absolute(x) > Q(0.01); thirds++) x *= third;
    const quad square = -x * x;
    quad sum = over[TERMS];
    for (int k = TERMS - 2; k > 0; k -= 2) sum = sum * square + over[k];
    sum *= x;
    while (thirds-- > 0) sum = sum * (3 - 4 * sum * sum);
    return sum;
}

/* Forces -------------------------------------------------------------------------------------------------------- */

enum { NODES = 256, SWITCHES = 16, VARIABLES = 2, CELLS = 2 };
typedef enum op { NUMBER, TIME, PLACE, SPEED, ADD, MUL, DIV, SIN, EXP, ABS, SIGN, MAX, GREATER, IF, MOD } op;
typedef struct node {
    op op;
    int a, b, c;
    double value; /* NUMBER; PLACE, SPEED: of which variable; switches: their number */
} node;

typedef struct model {
    node nodes[NODES];
    int count, force[VARIABLES], variables, switches;
    double x[VARIABLES], v[VARIABLES], until, step;
    double kick[4], width[4]; /* smooth kicks: their times and widths */
    const char *index;        /* of a family of CELLS cells with the same force: as it is called there; NULL: none */
    double cell_x, cell_v;    /* where its first cell starts; the others as x and v say */
    int kicks;
    int kind;
} model;

static int add(model *m, op op, int a, int b, int c, double value)
{
    assert_true(m->count < NODES && m->switches <= SWITCHES);
    m->nodes[m->count] = (node){op, a, b, c, value};
    return m->count++;
}
static int number(model *m, double value) { return add(m, NUMBER, 0, 0, 0, value); }
static int two(model *m, op op, int a, int b) { return add(m, op, a, b, 0, 0); }
static int flip(model *m, op op, int a, int b, int c) { return add(m, op, a, b, c, m->switches++); }

static size_t print(const model *m, int n, char *out, size_t size)
{
    const node *p = &m->nodes[n];
    char a[2048] = "", b[2048] = "", c[2048] = "";
    if (p->op >= ADD) print(m, p->a, a, sizeof a);
    if (p->op == ADD || p->op == MUL || p->op == DIV || p->op == MAX || p->op == GREATER || p->op == IF || p->op == MOD)
        print(m, p->b, b, sizeof b);
    if (p->op == IF) print(m, p->c, c, sizeof c);
    const char *name = p->value > 0 ? "y" : "x", *index = m->index ? m->index : "";
    switch (p->op) {
    case NUMBER: return (size_t)snprintf(out, size, "(%.17g)", p->value);
    case TIME: return (size_t)snprintf(out, size, "t");
    case PLACE: return (size_t)snprintf(out, size, "%s%s", name, index);
    case SPEED: return (size_t)snprintf(out, size, "%s%s'", name, index);
    case ADD: return (size_t)snprintf(out, size, "(%s + %s)", a, b);
    case MUL: return (size_t)snprintf(out, size, "%s*%s", a, b);
    case DIV: return (size_t)snprintf(out, size, "(%s)/(%s)", a, b);
    case SIN: return (size_t)snprintf(out, size, "sin(%s)", a);
    case EXP: return (size_t)snprintf(out, size, "exp(%s)", a);
    case ABS: return (size_t)snprintf(out, size, "abs(%s)", a);
    case SIGN: return (size_t)snprintf(out, size, "sign(%s)", a);
    case MAX: return (size_t)snprintf(out, size, "max(%s, %s)", a, b);
    case GREATER: return (size_t)snprintf(out, size, "%s > %s", a, b);
    case IF: return (size_t)snprintf(out, size, "if(%s, %s, %s)", a, b, c);
    case MOD: return (size_t)snprintf(out, size, "mod(%s, %s)", a, b);
    }
    return 0;
}

typedef struct point {
    quad t, x[VARIABLES], v[VARIABLES];
} point;

/* The value of a node; sides: 1 or -1 (MOD: the quotient's integer part) of every switch; arguments: theirs, which are
 * positive on side 1. */
static void evaluate(const model *m, const point *at, const quad *sides, quad *arguments, quad *values)
{
    for (int n = 0; n < m->count; n++) {
        const node *p = &m->nodes[n];
        const quad a = p->op >= ADD ? values[p->a] : 0, b = p->op >= ADD ? values[p->b] : 0;
        const int s = (int)p->value;
        quad u = a;
        switch (p->op) {
        case NUMBER: values[n] = p->value; break;
        case TIME: values[n] = at->t; break;
        case PLACE: values[n] = at->x[s]; break;
        case SPEED: values[n] = at->v[s]; break;
        case ADD: values[n] = a + b; break;
        case MUL: values[n] = a * b; break;
        case DIV: values[n] = a / b; break;
        case SIN: values[n] = sine(a); break;
        case EXP: values[n] = exponential(a); break;
        case ABS: values[n] = sides[s] * a; break;
        case SIGN: values[n] = sides[s]; break;
        case MAX:
            u = a - b;
            values[n] = sides[s] > 0 ? a : b;
            break;
        case GREATER:
            u = a - b;
            values[n] = sides[s];
            break;
        case IF: values[n] = a > 0 ? b : values[p->c]; break;
        case MOD:
            u = a / b;
            values[n] = a - b * sides[s];
            break;
        }
        if (p->op >= ABS && p->op != IF) arguments[s] = u;
    }
}

static void force(const model *m, const point *at, const quad *sides, quad *a)
{
    quad values[NODES], arguments[SWITCHES];
    evaluate(m, at, sides, arguments, values);
    for (int k = 0; k < m->variables; k++) a[k] = values[m->force[k]];
}

static const node *switch_at(const model *m, int s)
{
    for (int n = 0; n < m->count; n++)
        if (m->nodes[n].op >= ABS && m->nodes[n].op != IF && (int)m->nodes[n].value == s) return &m->nodes[n];
    return NULL;
}

/* Models -------------------------------------------------------------------------------------------------------- */

static int place(model *m) { return add(m, PLACE, 0, 0, 0, below(m->variables)); }

/* A threshold: half of them at simple fractions, where steps like to end. */
static double threshold(double size)
{
    return below(2) ? size * (1 + below(7)) / 8 : between(0.05 * size, 0.95 * size);
}

static int smooth_term(model *m)
{
    const int w = number(m, between(0.3, 3)), c = number(m, between(-1, 1));
    switch (below(5)) {
    case 0: return two(m, MUL, c, two(m, SIN, two(m, MUL, w, add(m, TIME, 0, 0, 0, 0)), 0));
    case 1: return two(m, MUL, c, two(m, SIN, two(m, MUL, w, place(m)), 0));
    case 2: return two(m, MUL, number(m, between(-0.5, -0.05)), add(m, SPEED, 0, 0, 0, below(m->variables)));
    case 3: {
        const int x = place(m);
        return two(m, MUL, number(m, between(-0.5, 0)), two(m, MUL, x, two(m, MUL, x, x)));
    }
    default: {
        const int x = place(m);
        return two(m, MUL, c, two(m, EXP, two(m, MUL, number(m, -1), two(m, MUL, x, x)), 0));
    }
    }
}

static int kinked_term(model *m)
{
    const int c = number(m, between(-1, 1)), x = place(m);
    const int off = two(m, ADD, x, number(m, below(3) ? between(-0.8, 0.8) : 0)), t = add(m, TIME, 0, 0, 0, 0);
    switch (below(7)) {
    case 0: return two(m, MUL, c, flip(m, ABS, off, 0, 0));
    case 1: return two(m, MUL, c, two(m, MUL, flip(m, ABS, off, 0, 0), off));
    case 2: return two(m, MUL, c, flip(m, SIGN, off, 0, 0));
    case 3: return two(m, MUL, c, flip(m, MAX, off, number(m, 0), 0));
    case 4: {
        const int condition = flip(m, GREATER, t, number(m, threshold(m->until)), 0);
        return add(m, IF, condition, c, number(m, 0), 0);
    }
    case 5: return two(m, MUL, c, flip(m, MOD, t, number(m, between(0.4, 2)), 0));
    default: {
        const int condition = flip(m, GREATER, x, number(m, between(-0.5, 0.9)), 0), force = smooth_term(m);
        return add(m, IF, condition, force, c, 0);
    }
    }
}

static int kick_term(model *m)
{
    const double at = threshold(m->until), width = pow(10, -1 - 3 * uniform());
    const int t = add(m, TIME, 0, 0, 0, 0), size = number(m, between(1, 3) / width);
    if (below(2)) { /* on at `at`, off after `width` */
        const int off = flip(m, GREATER, t, number(m, at + width), 0);
        const int inner = add(m, IF, off, number(m, 0), size, 0);
        const int on = flip(m, GREATER, t, number(m, at), 0);
        return add(m, IF, on, inner, number(m, 0), 0);
    }
    const int u = two(m, DIV, two(m, ADD, t, number(m, -at)), number(m, width));
    m->kick[m->kicks] = at;
    m->width[m->kicks++] = width;
    return two(m, MUL, size, two(m, EXP, two(m, MUL, number(m, -1), two(m, MUL, u, u)), 0));
}

/* -k x/|x|^3 in the plane, or -k/x² on a line: an encounter, or a fall into the centre. */
static void singular_force(model *m)
{
    const int x = add(m, PLACE, 0, 0, 0, 0), y = add(m, PLACE, 0, 0, 0, 1), k = number(m, -between(0.5, 2));
    if (m->variables == 1) {
        const int xx = two(m, MUL, x, x);
        m->force[0] = two(m, DIV, below(3) ? k : number(m, 0.5), xx);
        return;
    }
    const int rr = two(m, ADD, two(m, MUL, x, x), two(m, MUL, y, y));
    const int rrr = two(m, MUL, rr, rr); /* a force as 1/r³ */
    m->force[0] = two(m, DIV, two(m, MUL, k, x), rrr);
    m->force[1] = two(m, DIV, two(m, MUL, k, y), rrr);
}

static const char *const kinds[] = {"smooth", "kinked", "late kicks", "singular"};
enum { SMOOTH, KINKED, KICKED, SINGULAR, KINDS };

static void make(model *m, int k)
{
    seed = 1000003u * (uint64_t)k + 17;
    uniform();
    memset(m, 0, sizeof *m);
    const double which = uniform();
    m->kind = which < 0.5 ? SMOOTH : which < 0.75 ? KINKED : which < 0.9 ? KICKED : SINGULAR;
    m->variables = 1 + (below(4) == 0);
    m->until = below(2) ? 4 + below(9) : between(3, 12);
    m->step = below(2) ? m->until / (16 << below(4)) : between(0.02, 0.3);
    for (int i = 0; i < m->variables; i++) {
        m->x[i] = between(0.3, 1.2);
        m->v[i] = below(3) ? between(-1, 1) : 0;
    }
    if (m->variables == 1 && below(4) == 0) m->index = below(2) ? "[i]" : "[j]"; /* of a sum with one term */
    m->cell_x = between(-0.5, 0.2);
    m->cell_v = between(-1, 1);
    if (m->kind == SINGULAR) {
        m->until = between(1, 4);
        singular_force(m);
        return;
    }
    for (int i = 0; i < m->variables; i++) {
        int sum = two(m, MUL, number(m, -between(0.5, 4)), add(m, PLACE, 0, 0, 0, i));
        for (int terms = below(3); terms-- > 0;) sum = two(m, ADD, sum, smooth_term(m));
        if (m->kind == KINKED)
            for (int terms = 1 + below(2); terms-- > 0;) sum = two(m, ADD, sum, kinked_term(m));
        if (m->kind == KICKED && i == 0) sum = two(m, ADD, sum, kick_term(m));
        m->force[i] = sum;
    }
}

static void text_of(const model *m, char *out, size_t size)
{
    size_t n = 0;
    static const char *const names[] = {"x", "y"};
    if (m->index) {
        char f[4096];
        print(m, m->force[0], f, sizeof f);
        n = (size_t)snprintf(out, size, strcmp(m->index, "[j]") ? "x[i]'' = %s" : "x[i]'' = sum(j = 1..2, j == i: %s)",
                             f);
        n += (size_t)snprintf(out + n, size - n, " for i = 1..2\nx[1](0) = %.17g\nx[1]'(0) = %.17g\n", m->cell_x,
                              m->cell_v);
        n += (size_t)snprintf(out + n, size - n, "x[2](0) = %.17g\nx[2]'(0) = %.17g\n", m->x[0], m->v[0]);
    }
    for (int i = 0; i < m->variables && !m->index; i++) {
        char f[4096];
        print(m, m->force[i], f, sizeof f);
        n += (size_t)snprintf(out + n, size - n, "%s'' = %s\n%s(0) = %.17g\n%s'(0) = %.17g\n", names[i], f, names[i],
                              m->x[i], names[i], m->v[i]);
    }
    snprintf(out + n, size - n, "until %.17g\nstep %.17g\n", m->until, m->step);
}

/* Truth --------------------------------------------------------------------------------------------------------- */

/* One extrapolated step, of as many columns as the error `enough` needs: false where it is not finite. *error: of the
 * result. */
static bool gragg(const model *m, const point *from, quad h, const quad *sides, quad enough, point *to, quad *error)
{
    point table[COLUMNS];
    *error = 2 * enough + 1;
    for (int k = 0; k<COLUMNS && * error> enough; k++) {
        const int n = 2 * (k + 1);
        const quad d = h / n;
        point before = *from, now = *from;
        quad a[VARIABLES];
        force(m, from, sides, a);
        for (int i = 0; i < m->variables; i++) now.x[i] += d * from->v[i], now.v[i] += d * a[i];
        for (int s = 1; s < n; s++) {
            now.t = from->t + d * s;
            force(m, &now, sides, a);
            for (int i = 0; i < m->variables; i++) {
                const quad x = before.x[i] + 2 * d * now.v[i], v = before.v[i] + 2 * d * a[i];
                before.x[i] = now.x[i], before.v[i] = now.v[i];
                now.x[i] = x, now.v[i] = v;
            }
        }
        now.t = from->t + h;
        force(m, &now, sides, a); /* the smoothing step */
        for (int i = 0; i < m->variables; i++) {
            const quad x = now.x[i], v = now.v[i];
            now.x[i] = (x + before.x[i] + d * v) / 2;
            now.v[i] = (v + before.v[i] + d * a[i]) / 2;
        }
        table[k] = now;
        for (int j = k; j-- > 0;) {
            for (int i = 0; i < m->variables; i++) {
                table[j].x[i] = table[j + 1].x[i] + weight[k][j] * (table[j + 1].x[i] - table[j].x[i]);
                table[j].v[i] = table[j + 1].v[i] + weight[k][j] * (table[j + 1].v[i] - table[j].v[i]);
            }
        }
        for (int i = 0; i < m->variables && k > 0; i++) {
            const quad e = absolute(table[0].x[i] - table[1].x[i]) + absolute(table[0].v[i] - table[1].v[i]);
            if (!(e - e == 0)) return false;
            *error = i == 0 || e > *error ? e : *error;
        }
    }
    *to = table[0];
    return true;
}

static quad gap(const model *m, int s, const quad *sides, const quad *arguments)
{
    if (switch_at(m, s)->op != MOD) return sides[s] * arguments[s];
    const quad up = sides[s] + 1 - arguments[s], down = arguments[s] - sides[s];
    return up < down ? up : down;
}

/* The first switch whose argument has left its side, or -1. */
static int left(const model *m, const point *at, const quad *sides, quad *worst)
{
    quad values[NODES], arguments[SWITCHES];
    int found = -1;
    *worst = 0;
    evaluate(m, at, sides, arguments, values);
    for (int s = 0; s < m->switches; s++) {
        const quad g = gap(m, s, sides, arguments);
        if (g < *worst) *worst = g, found = s;
    }
    return found;
}

static void start_sides(const model *m, const point *at, quad *sides)
{
    quad values[NODES], arguments[SWITCHES], a[VARIABLES];
    for (int s = 0; s < m->switches; s++) sides[s] = 1;
    for (int pass = 0; pass < 3; pass++) {
        force(m, at, sides, a);
        point later = *at;
        const quad way = Q(1e-12);
        later.t += way;
        for (int i = 0; i < m->variables; i++) {
            later.x[i] += way * (at->v[i] + way / 2 * a[i]);
            later.v[i] += way * a[i];
        }
        evaluate(m, &later, sides, arguments, values);
        for (int s = 0; s < m->switches; s++)
            sides[s] = switch_at(m, s)->op == MOD ? (quad)floor((double)arguments[s]) : arguments[s] > 0 ? 1 : -1;
    }
}

/* To time `end`. False: it cannot be reached. */
static bool go(const model *m, point *at, quad *sides, quad end, quad *size)
{
    const quad tolerance = Q(1e-25), grows = tolerance * Q(1e-4);
    quad h = *size;
    for (int steps = 0; at->t < end; steps++) {
        if (steps > 20000 || !(h > Q(1e-13))) return false;
        quad most = h;
        if (m->switches && most > Q(0.02)) most = Q(0.02);
        for (int k = 0; k < m->kicks; k++) {
            const quad c = m->kick[k], w = m->width[k], begins = c - 12 * w;
            if (at->t < begins && at->t + most > begins) most = begins - at->t > Q(1e-12) ? begins - at->t : w;
            if (at->t >= begins && at->t < c + 12 * w && most > w) most = w;
        }
        if (at->t + most > end) most = end - at->t;
        point to;
        quad error, worst;
        if (!gragg(m, at, most, sides, grows / 2, &to, &error) || error > tolerance) {
            h = most / 2;
            continue;
        }
        if (error < grows && h <= most) h = 2 * most;
        if (left(m, &to, sides, &worst) >= 0) { /* shorten the step until it ends just beyond the switch */
            quad low = 0, high = most;
            for (int turn = 0; turn < 200 && high - low > Q(1e-29); turn++) {
                const quad middle = (low + high) / 2;
                gragg(m, at, middle, sides, grows / 2, &to, &error);
                if (left(m, &to, sides, &worst) >= 0)
                    high = middle;
                else
                    low = middle;
            }
            gragg(m, at, high, sides, grows / 2, &to, &error);
            const int s = left(m, &to, sides, &worst);
            if (s < 0) return false;
            if (high < Q(1e-25) && steps > 2000) return false; /* it slides */
            if (switch_at(m, s)->op == MOD) {
                quad values[NODES], arguments[SWITCHES];
                evaluate(m, &to, sides, arguments, values);
                sides[s] += arguments[s] > sides[s] + Q(0.5) ? 1 : -1;
            } else {
                sides[s] = -sides[s];
            }
        }
        const bool last = at->t + most >= end && to.t >= end - Q(1e-30);
        *at = to;
        if (last) at->t = end;
    }
    *size = h;
    return true;
}

/* Claims -------------------------------------------------------------------------------------------------------- */

enum { TIMES = 16 };
typedef enum outcome { TOO_SMALL, SMALL, CLOSE, LARGE, TOO_LARGE, SILENT, NO_TRUTH, FALSE_CLAIM, OUTCOMES } outcome;
static const char *const outcomes[] = {"< 0.1", "0.1 to 1",     "1 to 10",  "10 to 100",
                                       "> 100", "none claimed", "no truth", "claimed without truth"};

/* The largest error of the reference r (NULL: there is none) for the variables, or for this cell of a family. False:
 * there is no truth. */
static bool compare(const model *m, int cell, motus_reference *r, double *error)
{
    point at = {.t = 0};
    for (int i = 0; i < m->variables; i++) at.x[i] = m->x[i], at.v[i] = m->v[i];
    if (m->index && cell == 0) at.x[0] = m->cell_x, at.v[0] = m->cell_v;
    const quad first = Q(0.1);
    quad sides[SWITCHES], size = first;
    start_sides(m, &at, sides);
    for (int k = 1; k <= TIMES; k++) {
        const double t = m->until * k / TIMES;
        if (!go(m, &at, sides, t, &size)) return false;
        double x[VARIABLES * CELLS], v[VARIABLES * CELLS];
        motus_error err = motus_default_error();
        if (r) must(motus_reference_at(r, &t, 1, x, v, &err), &err, "a state of the reference");
        for (int i = 0; i < m->variables && r; i++) {
            const int at_x = m->index ? cell : i;
            *error = fmax(*error, (double)absolute(at.x[i] - x[at_x]));
            *error = fmax(*error, (double)absolute(at.v[i] - v[at_x]));
        }
    }
    return true;
}

static outcome judge(const model *m, bool told)
{
    char text[16384];
    text_of(m, text, sizeof text);
    if (told) printf("%s", text);
    motus_system *s = given_text(text);
    motus_study_def def = motus_default_study();
    motus_error err = motus_default_error();
    motus_reference *r;
    const motus_status status = motus_reference_create(s, &def, &r, &err);
    if (status != MOTUS_OK && status != MOTUS_DIVERGED) fail_msg("%s\n%s", text, err.message);
    double error = 0;
    bool truth = true;
    const int cells = m->index ? CELLS : 1;
    for (int cell = 0; cell < cells && truth; cell++) truth = compare(m, cell, status == MOTUS_OK ? r : NULL, &error);
    const double claim = status == MOTUS_OK ? motus_reference_error(r) : NAN;
    if (told)
        printf("%s: claimed %.3g, true %.3g, truth %d\n", status == MOTUS_OK ? motus_reference_name(r) : err.message,
               claim, error, truth);
    if (status == MOTUS_OK) motus_reference_destroy(r);
    motus_system_destroy(s);
    if (!truth) return status != MOTUS_OK ? NO_TRUTH : m->kind == SINGULAR ? FALSE_CLAIM : NO_TRUTH;
    if (status != MOTUS_OK) return SILENT;
    const double ratio = claim / error;
    return error == 0        ? CLOSE
           : !(ratio >= 0.1) ? TOO_SMALL
           : ratio < 1       ? SMALL
           : ratio < 10      ? CLOSE
           : ratio < 100     ? LARGE
                             : TOO_LARGE;
}

static void claims(void **state)
{
    (void)state;
    const char *all = getenv("CLAIMS"), *one = getenv("CLAIM");
    const int first = one ? atoi(one) : 0, count = one ? 1 : all ? atoi(all) : 700;
    int counts[KINDS][OUTCOMES] = {0}, sums[KINDS] = {0};
    for (int k = first; k < first + count; k++) {
        model m;
        make(&m, k);
        const outcome o = judge(&m, one);
        counts[m.kind][o]++;
        sums[m.kind]++;
        if (o == TOO_SMALL || o == FALSE_CLAIM || getenv("CLAIMS_ALL"))
            printf("model %d (%s): %s\n", k, kinds[m.kind], outcomes[o]);
    }
    printf("claimed error by true error\n%12s", "");
    for (int o = 0; o < OUTCOMES; o++) printf("  %s", outcomes[o]);
    for (int kind = 0; kind < KINDS; kind++) {
        printf("\n%12s", kinds[kind]);
        for (int o = 0; o < OUTCOMES; o++) printf("  %*d", (int)strlen(outcomes[o]), counts[kind][o]);
    }
    printf("\n");
    for (int kind = 0; kind < KINDS; kind++) {
        assert_int_equal(counts[kind][TOO_SMALL], 0);
        assert_int_equal(counts[kind][FALSE_CLAIM], 0);
    }
    if (one) return;
    assert_true(20 * counts[SMOOTH][TOO_LARGE] <= sums[SMOOTH]);
}

int main(void)
{
    fill();
    const struct CMUnitTest tests[] = {cmocka_unit_test(claims)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
