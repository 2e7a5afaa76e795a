/* Random motions as trees: what they are at a point, and how the language writes them. */
#include "test/motion.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Numbers ------------------------------------------------------------------------------------------------------- */

static bool rounded;
void motion_round_numbers(bool on) { rounded = on; }

quad motion_decimal(double value)
{
    char digits[32];
    snprintf(digits, sizeof digits, "%.3f", value);
    return rounded ? (quad)value : motion_read(digits);
}

quad motion_absolute(quad x) { return x < 0 ? -x : x; }

/* 1/k!. For |x| < 0.01 what follows the term x^TERMS/TERMS! is below the last of 113 bits. */
enum { TERMS = 13 };
static quad over[TERMS + 1];

static void fill(void)
{
    if (over[0] == 1) return;
    over[0] = 1;
    for (int k = 1; k <= TERMS; k++) over[k] = over[k - 1] / k;
}

quad motion_pi(void) { return Q(3.141592653589793238462643383279502884197169399375); }

static quad exponential(quad x)
{
    if (x < -11000) return 0;
    int halvings = 0;
    for (; motion_absolute(x) > Q(0.01) && halvings < 40; halvings++) x *= Q(0.5);
    quad sum = 0; /* exp(x) - 1 */
    for (int k = TERMS; k > 0; k--) sum = (sum + over[k]) * x;
    while (halvings-- > 0) sum = sum * (sum + 2);
    return sum + 1;
}

static quad sine(quad x)
{
    const quad turn = 2 * motion_pi(), third = 1 / Q(3.0);
    x -= turn * (quad)round((double)(x / turn));
    int thirds = 0;
    for (; motion_absolute(x) > Q(0.01); thirds++) x *= third;
    const quad square = -x * x;
    quad sum = over[TERMS];
    for (int k = TERMS - 2; k > 0; k -= 2) sum = sum * square + over[k];
    sum *= x;
    while (thirds-- > 0) sum = sum * (3 - 4 * sum * sum);
    return sum;
}

quad motion_root(quad x)
{
    if (!(x > 0)) return 0;
    quad scale = 1; /* a double holds the root of what is left */
    for (; x < Q(1e-200); x *= Q(1e40)) scale *= Q(1e-20);
    quad r = sqrt((double)x);
    for (int k = 0; k < 3; k++) r = (r + x / r) / 2;
    return r * scale;
}

static quad cube_root(quad x)
{
    if (x == 0) return 0;
    quad scale = 1; /* a double holds the root of what is left */
    for (; motion_absolute(x) < Q(1e-200); x *= Q(1e60)) scale *= Q(1e-20);
    quad r = cbrt((double)x);
    for (int k = 0; k < 3; k++) r -= (r - x / (r * r)) / 3;
    return r * scale;
}

quad motion_power_of_ten(int n)
{
    quad p = 1;
    for (int k = abs(n); k > 0; k--) p *= 10; /* exact up to 10^48 */
    return n < 0 ? 1 / p : p;
}

quad motion_read(const char *text)
{
    quad mantissa = 0;
    int exponent = 0;
    bool minus = false, point = false;
    for (const char *p = text; *p; p++) {
        if (*p == '-') {
            minus = true;
        } else if (*p == '.') {
            point = true;
        } else if (*p == 'e') {
            exponent += atoi(p + 1);
            break;
        } else if (*p >= '0' && *p <= '9') {
            mantissa = 10 * mantissa + (*p - '0');
            exponent -= point;
        }
    }
    const quad p = motion_power_of_ten(exponent < 0 ? -exponent : exponent);
    const quad value = exponent < 0 ? mantissa / p : mantissa * p;
    return minus ? -value : value;
}

void motion_show(quad x, char *out, size_t size)
{
    enum { DIGITS = 26 };
    if (x == 0 || x - x != 0) {
        snprintf(out, size, x == 0 ? "0" : "none");
        return;
    }
    quad u = motion_absolute(x);
    int exponent = 0;
    for (; u >= 10; exponent++) u /= 10;
    for (; u < 1; exponent--) u *= 10;
    quad half = Q(0.5);
    for (int k = 1; k < DIGITS; k++) half /= 10;
    u += half;
    if (u >= 10) u /= 10, exponent++;
    char digits[DIGITS + 1];
    for (int k = 0; k < DIGITS; k++) {
        const int d = (int)u;
        digits[k] = (char)('0' + d);
        u = 10 * (u - d);
    }
    digits[DIGITS] = 0;
    snprintf(out, size, "%s%c.%se%d", x < 0 ? "-" : "", digits[0], digits + 1, exponent);
}

/* Building ------------------------------------------------------------------------------------------------------ */

static motion_node *next(motion *m, motion_op op, int a, int b, int c)
{
    assert(m->count < MOTION_NODES);
    motion_node *n = &m->nodes[m->count++];
    *n = (motion_node){.op = op, .a = a, .b = b, .c = c};
    return n;
}

int motion_add(motion *m, motion_op op, int a, int b, int c)
{
    next(m, op, a, b, c);
    return m->count - 1;
}

int motion_switch(motion *m, motion_op op, int a, int b, int c)
{
    assert(m->switches < MOTION_SWITCHES);
    next(m, op, a, b, c)->which = m->switches++;
    return m->count - 1;
}

int motion_again(motion *m, int node, int form)
{
    const motion_node n = m->nodes[node];
    next(m, n.op, n.a, n.b, form)->which = n.which;
    return m->count - 1;
}

int motion_written(motion *m, const char *text, quad value)
{
    motion_node *n = next(m, MOTION_NUMBER_OP, 0, 0, 0);
    snprintf(n->text, sizeof n->text, "%s", text);
    n->value = value;
    return m->count - 1;
}

static void shortest(double value, char *out, size_t size)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, size, "%.*g", digits, value);
        if (strtod(out, NULL) == value) return;
    }
}

int motion_number(motion *m, double value)
{
    char text[MOTION_NUMBER];
    shortest(value, text, sizeof text);
    return motion_written(m, text, motion_read(text));
}

int motion_variable(motion *m, motion_op op, int which)
{
    next(m, op, 0, 0, 0)->which = which;
    return m->count - 1;
}

void motion_layer_at(motion *m, int u, double reach, bool below)
{
    assert(m->layer_count < MOTION_LAYERS);
    m->layers[m->layer_count++] = (motion_layer){u, reach, below};
}

void motion_names(motion *m, const char *const *places)
{
    for (int i = 0; i < m->variables; i++) {
        snprintf(m->place[i], MOTION_NAME, "%s", places[i]);
        const char *dot = strchr(places[i], '.');
        if (dot)
            snprintf(m->speed[i], MOTION_NAME, "%.*s'%s", (int)(dot - places[i]), places[i], dot);
        else
            snprintf(m->speed[i], MOTION_NAME, "%s'", places[i]);
    }
}

bool motion_is_switch(motion_op op) { return op >= MOTION_ABS; }

const motion_node *motion_switch_at(const motion *m, int s)
{
    for (int n = 0; n < m->count; n++)
        if (motion_is_switch(m->nodes[n].op) && m->nodes[n].which == s) return &m->nodes[n];
    return NULL;
}

/* Values -------------------------------------------------------------------------------------------------------- */

static quad time_in(const motion *m, quad t)
{
    const motion_frame *f = &m->frame;
    const quad way = f->backward ? -t : t;
    return f->absolute ? motion_time_of(m, t) : way;
}

void motion_values(const motion *m, const motion_point *at, const quad *sides, quad *arguments, quad *values)
{
    fill();
    for (int n = 0; n < m->count; n++) {
        const motion_node *p = &m->nodes[n];
        const bool deep = p->op >= MOTION_ADD;
        const quad a = deep ? values[p->a] : 0, b = deep ? values[p->b] : 0;
        const int s = p->which;
        quad u = a;
        switch (p->op) {
        case MOTION_NUMBER_OP: values[n] = rounded ? (quad)(double)p->value : p->value; break;
        case MOTION_TIME: values[n] = time_in(m, at->t); break;
        case MOTION_PLACE: values[n] = at->y[s]; break;
        case MOTION_SPEED: values[n] = m->frame.backward ? -at->y[m->variables + s] : at->y[m->variables + s]; break;
        case MOTION_MODE: values[n] = at->mode[s]; break;
        case MOTION_ADD: values[n] = a + b; break;
        case MOTION_SUB: values[n] = a - b; break;
        case MOTION_MUL: values[n] = a * b; break;
        case MOTION_DIV: values[n] = a / b; break;
        case MOTION_SIN: values[n] = sine(a); break;
        case MOTION_EXP: values[n] = exponential(a); break;
        case MOTION_SQRT: values[n] = motion_root(a); break;
        case MOTION_CBRT: values[n] = cube_root(a); break;
        case MOTION_IF:
            values[n] = a >= 1 ? b : a <= -1 ? values[p->c] : ((1 + a) * b + (1 - a) * values[p->c]) / 2;
            break;
        case MOTION_ABS: values[n] = sides[s] * a; break;
        case MOTION_SIGN: values[n] = sides[s]; break;
        case MOTION_MAX:
            u = a - b;
            values[n] = sides[s] > 0 ? a : b;
            break;
        case MOTION_SIDE:
        case MOTION_GREATER:
        case MOTION_CROSS:
            u = a - b;
            values[n] = sides[s];
            break;
        case MOTION_MOD:
            u = a / b;
            values[n] = a - b * sides[s];
            break;
        }
        if (motion_is_switch(p->op)) arguments[s] = u;
    }
}

void motion_rates(const motion *m, const motion_point *at, const quad *sides, const quad *a, const quad *values,
                  quad *along, quad *rates)
{
    const motion_frame *f = &m->frame;
    for (int n = 0; n < m->count; n++) {
        const motion_node *p = &m->nodes[n];
        const bool deep = p->op >= MOTION_ADD;
        const quad da = deep ? along[p->a] : 0, db = deep ? along[p->b] : 0, x = deep ? values[p->a] : 0,
                   y = deep ? values[p->b] : 0;
        const int s = p->which;
        quad u = da;
        switch (p->op) {
        case MOTION_NUMBER_OP:
        case MOTION_MODE: along[n] = 0; break;
        case MOTION_TIME: along[n] = f->backward ? -1 : 1; break;
        case MOTION_PLACE: along[n] = m->first_order[s] ? a[s] : at->y[m->variables + s]; break;
        case MOTION_SPEED: along[n] = f->backward ? -a[s] : a[s]; break;
        case MOTION_ADD: along[n] = da + db; break;
        case MOTION_SUB: along[n] = da - db; break;
        case MOTION_MUL: along[n] = da * y + db * x; break;
        case MOTION_DIV: along[n] = (da - values[n] * db) / y; break;
        case MOTION_SIN: along[n] = da * sine(x + motion_pi() / 2); break;
        case MOTION_EXP: along[n] = da * values[n]; break;
        case MOTION_SQRT: along[n] = values[n] > 0 ? da / (2 * values[n]) : 0; break;
        case MOTION_CBRT: along[n] = values[n] != 0 ? da / (3 * values[n] * values[n]) : 0; break;
        case MOTION_IF:
            along[n] = x >= 1 ? db : x <= -1 ? along[p->c] : ((1 + x) * db + (1 - x) * along[p->c]) / 2;
            break;
        case MOTION_ABS: along[n] = sides[s] * da; break;
        case MOTION_SIGN: along[n] = 0; break;
        case MOTION_MAX:
            u = da - db;
            along[n] = sides[s] > 0 ? da : db;
            break;
        case MOTION_SIDE:
        case MOTION_GREATER:
        case MOTION_CROSS:
            u = da - db;
            along[n] = 0;
            break;
        case MOTION_MOD:
            u = (da - x / y * db) / y;
            along[n] = da - db * sides[s];
            break;
        }
        if (motion_is_switch(p->op)) rates[s] = u;
    }
}

/* The text ------------------------------------------------------------------------------------------------------ */

/* The scaled units are the parameters L and T; the start of the time is t0 where it is not 0. */
static void leaf(const motion *m, const motion_node *p, char *out, size_t size)
{
    const motion_frame *f = &m->frame;
    const char *name = p->op == MOTION_PLACE ? m->place[p->which] : p->op == MOTION_SPEED ? m->speed[p->which] : "t";
    if (p->op == MOTION_MODE) {
        snprintf(out, size, "m%d", p->which + 1);
    } else if (p->op == MOTION_NUMBER_OP) {
        snprintf(out, size, p->text[0] == '-' ? "(%s)" : "%s", p->text);
    } else if (p->op == MOTION_PLACE) {
        char shifted[MOTION_NUMBER];
        if (f->origin != 0)
            snprintf(shifted, sizeof shifted, "(%s %c %.15g)", name, f->origin < 0 ? '+' : '-', fabs(f->origin));
        else
            snprintf(shifted, sizeof shifted, "%s", name);
        snprintf(out, size, f->scaled ? "(%s/L)" : "%s", shifted);
    } else if (p->op == MOTION_SPEED) {
        snprintf(out, size, f->scaled ? "(%s T/L)" : "%s", name);
    } else {
        const char *t = f->start != 0 && !f->absolute ? "(t - t0)" : "t";
        snprintf(out, size, f->scaled ? "(%s/T)" : "%s", t);
    }
}

static const char *const sign_forms[] = {"sign(%s - %s)",         "(-sign(%2$s - %1$s))",
                                         "if(%s > %s, 1, -1)",    "(1 - 2 (%s < %s))",
                                         "sign(2*(%s - %s))",     "((%1$s - %2$s)/abs(%1$s - %2$s))",
                                         "if(%2$s > %1$s, -1, 1)"};
static const char *const abs_forms[] = {"abs(%s)", "|%s|", "max(%1$s, -(%1$s))", "((%1$s)*sign(%1$s))", "sqrt((%s)^2)"};

void motion_print(const motion *m, int n, char *out, size_t size)
{
    const motion_node *p = &m->nodes[n];
    if (p->op < MOTION_ADD) {
        leaf(m, p, out, size);
        return;
    }
    char a[2048] = "", b[2048] = "", c[2048] = "";
    const bool one = p->op == MOTION_SIN || p->op == MOTION_EXP || p->op == MOTION_SQRT || p->op == MOTION_CBRT ||
                     p->op == MOTION_ABS || p->op == MOTION_SIGN;
    motion_print(m, p->a, a, sizeof a);
    if (!one) motion_print(m, p->b, b, sizeof b);
    if (p->op == MOTION_IF) motion_print(m, p->c, c, sizeof c);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    switch (p->op) {
    case MOTION_ADD: snprintf(out, size, "(%s + %s)", a, b); break;
    case MOTION_SUB: snprintf(out, size, "(%s - %s)", a, b); break;
    case MOTION_MUL: snprintf(out, size, "%s*%s", a, b); break;
    case MOTION_DIV: snprintf(out, size, "(%s)/(%s)", a, b); break;
    case MOTION_SIN: snprintf(out, size, "sin(%s)", a); break;
    case MOTION_EXP: snprintf(out, size, "exp(%s)", a); break;
    case MOTION_SQRT: snprintf(out, size, "sqrt(%s)", a); break;
    case MOTION_CBRT: snprintf(out, size, "cbrt(%s)", a); break;
    case MOTION_IF: snprintf(out, size, "if(%s, %s, %s)", a, b, c); break;
    case MOTION_ABS: snprintf(out, size, abs_forms[p->c], a); break;
    case MOTION_SIGN: snprintf(out, size, "sign(%s)", a); break;
    case MOTION_SIDE: snprintf(out, size, sign_forms[p->c], a, b); break;
    case MOTION_MAX: snprintf(out, size, "max(%s, %s)", a, b); break;
    case MOTION_GREATER: snprintf(out, size, "%s > %s", a, b); break;
    case MOTION_MOD: snprintf(out, size, "mod(%s, %s)", a, b); break;
    case MOTION_CROSS: snprintf(out, size, "%s = %s", a, b); break;
    default: break;
    }
#pragma GCC diagnostic pop
}

/* A number of at most three decimals, in units of 10^power. */
static void written(double value, int power, char *out, size_t size)
{
    char digits[32];
    snprintf(digits, sizeof digits, "%.3f", value);
    snprintf(out, size, power ? "%se%d" : "%s", digits, power);
}

static void append(char *out, size_t size, const char *line)
{
    const size_t n = strlen(out);
    snprintf(out + n, size - n, "%s\n", line);
}

/* Of one variable, or of all components of a vector, which lie together. */
static void start_of(const motion *m, int first, int count, bool speed, char *out, size_t size)
{
    const motion_frame *f = &m->frame;
    const char *dot = strchr(m->place[first], '.');
    const int length = dot ? (int)(dot - m->place[first]) : (int)strlen(m->place[first]);
    char line[512];
    int n = snprintf(line, sizeof line, "%.*s%s(%s) = %s", length, m->place[first], speed ? "'" : "",
                     f->start != 0 ? "t0" : "0", dot ? "(" : "");
    for (int i = first; i < first + count; i++) {
        char number[MOTION_NUMBER];
        if (speed)
            written(m->v[i], f->length - f->time, number, sizeof number);
        else
            written(f->origin + m->x[i], f->length, number, sizeof number);
        n += snprintf(line + n, sizeof line - (size_t)n, "%s%s", number, i + 1 < first + count ? ", " : dot ? ")" : "");
    }
    append(out, size, line);
}

static void starts(const motion *m, char *out, size_t size)
{
    for (int i = 0, count; i < m->variables; i += count) {
        count = strchr(m->place[i], '.') ? m->variables - i : 1;
        start_of(m, i, count, false, out, size);
        if (!m->first_order[i]) start_of(m, i, count, true, out, size);
    }
}

static void whens(const motion *m, char *out, size_t size)
{
    for (int k = 0; k < m->event_count; k++) {
        const motion_event *e = &m->events[k];
        char line[8192], occasion[2048], value[2048];
        motion_print(m, e->cross, occasion, sizeof occasion);
        motion_print(m, e->becomes, value, sizeof value);
        int n = snprintf(line, sizeof line, "when %s%s: ", occasion,
                         e->direction > 0   ? " rising"
                         : e->direction < 0 ? " falling"
                                            : "");
        if (e->changes == MOTION_SPEED)
            n += snprintf(line + n, sizeof line - (size_t)n, "%s = %s%s, ", m->speed[e->which],
                          m->frame.scaled ? "L/T " : "", value);
        if (e->changes == MOTION_PLACE)
            n += snprintf(line + n, sizeof line - (size_t)n, "%s = %s%s, ", m->place[e->which],
                          m->frame.scaled ? "L " : "", value);
        if (e->changes == MOTION_MODE)
            n += snprintf(line + n, sizeof line - (size_t)n, "m%d = %s, ", e->which + 1, value);
        snprintf(line + n, sizeof line - (size_t)n, "record");
        append(out, size, line);
    }
}

void motion_text(const motion *m, char *out, size_t size)
{
    const motion_frame *f = &m->frame;
    char line[8192];
    out[0] = 0;
    if (f->start != 0) snprintf(line, sizeof line, "t0 = %.15g", f->start), append(out, size, line);
    if (f->scaled) snprintf(line, sizeof line, "L = 1e%d; T = 1e%d", f->length, f->time), append(out, size, line);
    for (int k = 0; k < m->modes; k++)
        snprintf(line, sizeof line, "m%d = %.15g", k + 1, m->mode[k]), append(out, size, line);
    if (m->equations[0]) {
        append(out, size, m->equations);
    } else {
        for (int i = 0; i < m->variables; i++) {
            char force[7000];
            motion_print(m, m->force[i], force, sizeof force);
            const char *unit = !f->scaled ? "" : m->first_order[i] ? "L/T*" : "L/T^2*";
            snprintf(line, sizeof line, "%s%s = %s(%s)", m->place[i], m->first_order[i] ? "'" : "''", unit, force);
            append(out, size, line);
        }
    }
    starts(m, out, size);
    if (!strstr(m->equations, "when ")) whens(m, out, size);
    char end[MOTION_NUMBER], decimals[32];
    snprintf(decimals, sizeof decimals, "%.3f", (double)m->until);
    if (f->until[0])
        snprintf(end, sizeof end, "%s", f->until);
    else if (f->summed && f->start != 0)
        snprintf(end, sizeof end, "t0 %c %s", f->backward ? '-' : '+', decimals);
    else
        written(f->start + (f->backward ? -1 : 1) * strtod(decimals, NULL), f->time, end, sizeof end);
    snprintf(line, sizeof line, "until %s", end);
    append(out, size, line);
}

quad motion_time_of(const motion *m, quad t)
{
    const motion_frame *f = &m->frame;
    char start[MOTION_NUMBER];
    snprintf(start, sizeof start, "%.15g", f->start);
    return motion_read(start) + (f->backward ? -t : t) * motion_power_of_ten(f->time);
}

quad motion_place_of(const motion *m, int variable, quad x)
{
    (void)variable;
    char origin[MOTION_NUMBER];
    snprintf(origin, sizeof origin, "%.15g", m->frame.origin);
    return motion_read(origin) + x * motion_power_of_ten(m->frame.length);
}

quad motion_speed_of(const motion *m, quad v)
{
    const quad unit = motion_power_of_ten(m->frame.length) / motion_power_of_ten(m->frame.time);
    return m->frame.backward ? -v * unit : v * unit;
}

double motion_step_of(const motion *m, double step) { return step * pow(10, m->frame.time); }
