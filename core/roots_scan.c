/* The places of one step, in order. */
#include "core/roots_scan.h"

#include <math.h>

double roots_scan_noise(const roots_scan *s, double tau)
{
    const double near = s->steep * tau;
    return near < s->noise ? near : s->noise; /* steep is infinite where the step does not stand */
}

static int sign(double p) { return p > 0 ? 1 : p < 0 ? -1 : 0; }

static int certain(const roots_scan *s, double tau, double p)
{
    return fabs(p) > roots_scan_noise(s, tau) ? sign(p) : 0;
}

static int certain_slope(const roots_scan *s, double slope) { return fabs(slope) > s->doubt ? sign(slope) : 0; }

/* Inserts a root by its tau, since places become known where they end, and extrema later still. False: there is no
 * room. */
static bool put(roots_scan *s, roots_root root)
{
    roots_found *found = s->found;
    size_t place = found->count;
    const bool full = found->count == s->most;
    while (place > 0 && s->out[place - 1].tau > root.tau) place--;
    if (full) {
        found->reach = place < found->count ? s->out[found->count - 1].from : root.from;
        if (place == s->most) return false;
        found->count--;
    }
    for (size_t i = found->count; i > place; i--) s->out[i] = s->out[i - 1];
    s->out[place] = root;
    found->count++;
    return !full;
}

static bool put_place(roots_scan *s, double tau, double value, double to, roots_kind kind, bool open)
{
    roots_root root = {tau, s->from, to, 0, value, kind, s->side, false, open};
    if (root.from > tau) root.from = tau;
    if (root.to < tau) root.to = tau;
    root.error = tau - root.from > root.to - tau ? tau - root.from : root.to - tau;
    return put(s, root);
}

/* Adds an extremum when p has gone back by more than the noise; where p is flat, rounding turns it often. */
static bool turn(roots_scan *s, double tau, double p)
{
    const double back = (p - s->top) * (s->way ? -s->way : 1), noise = roots_scan_noise(s, s->top_tau);
    if (s->way && back <= 0) s->top = p, s->top_tau = tau;
    if (fabs(back) <= noise || (s->way && back <= 0)) return true;
    const roots_root near = {s->top_tau, s->top_tau, s->top_tau, 0, s->top, ROOTS_NEAR, sign(s->top), false, false};
    const bool tell = s->way && s->top_tau > 0 && fabs(s->top) > noise && fabs(s->top) <= s->slack;
    s->way = p > s->top ? 1 : -1;
    s->top = p, s->top_tau = tau;
    return !tell || put(s, near);
}

static void look_lower(roots_scan *s, double tau, double p, bool turns)
{
    if (s->side * p >= s->low) return;
    s->low = s->side * p, s->low_tau = tau, s->low_turns = turns;
}

/* Ends the open place at `to`, where g has the sign `side`. p: the value at the end of this piece. */
static bool leave(roots_scan *s, double to, double p, int side)
{
    bool room = true;
    const double middle = s->from + (to - s->from) / 2;
    s->inside = false;
    if (s->side == 0) {
        s->found->after = side;
        s->found->leaves = to;
    } else if (side != s->side)
        room = put_place(s, s->zeros == 1 ? s->zero : middle, 0, to, side > 0 ? ROOTS_RISING : ROOTS_FALLING, false);
    else if (s->low < s->entry && s->low < side * p)
        room = put_place(s, s->low_turns ? s->low_tau : middle, s->side * s->low, to, ROOTS_TOUCH, false);
    s->side = side;
    return room;
}

static void enter(roots_scan *s, double from, double entry)
{
    s->inside = true;
    s->from = from;
    s->entry = entry;
    s->zeros = 0;
    s->low = INFINITY;
}

bool roots_scan_start(roots_scan *s, int before, double slope, double value)
{
    const int way = certain_slope(s, slope);
    const int side = before ? certain(s, 0, value) : 0;
    s->tau = s->top_tau = 0;
    s->value = s->top = value;
    s->way = 0;
    s->side = before;
    s->inside = false;
    if (before == 0) {
        s->found->after = s->side = way;
        s->found->leaves = way ? 0 : 1;
        if (!way) enter(s, 0, 0);
    } else if (side == -before) {
        s->from = 0;
        if (!put_place(s, 0, value, 0, side > 0 ? ROOTS_RISING : ROOTS_FALLING, false)) return false;
        s->side = side;
    } else if (side == 0) {
        enter(s, 0, way == before ? before * value : INFINITY);
        look_lower(s, 0, value, false);
        if (sign(value) == -before) s->zeros = 1, s->zero = 0;
    }
    return true;
}

/* Where p leaves or enters the noise: by the least slope, if that is near the slope, else by solving. */
typedef struct border {
    const roots_cell *cell;
    double x0, p0, x1, p1, least;
} border;

static double solve(const border *b, double level)
{
    return roots_cell_tau(b->cell, roots_cell_solve(b->cell, b->x0, b->p0, b->x1, b->p1, level));
}

static bool cross(roots_scan *s, const border *b, double tau1, int side)
{
    const double noise = roots_scan_noise(s, tau1), x = roots_cell_solve(b->cell, b->x0, b->p0, b->x1, b->p1, 0);
    const double zero = roots_cell_tau(b->cell, x);
    double to;
    if (b->least > 0) {
        const double wide = noise / b->least;
        s->from = roots_cell_tau(b->cell, x - wide > b->x0 ? x - wide : b->x0);
        to = roots_cell_tau(b->cell, x + wide < b->x1 ? x + wide : b->x1);
    } else {
        s->from = solve(b, s->side * noise);
        to = solve(b, side * noise);
    }
    const bool room = put_place(s, zero, 0, to, side > 0 ? ROOTS_RISING : ROOTS_FALLING, false);
    if (room) s->out[s->found->count - 1].single = b->least > s->doubt * b->cell->half;
    s->side = side;
    return room;
}

bool roots_scan_piece(roots_scan *s, const roots_cell *cell, double x0, double x1, double p1, double least, bool turns)
{
    const double tau1 = roots_cell_tau(cell, x1), p0 = s->value;
    const border b = {cell, x0, p0, x1, p1, least};
    const int side = certain(s, tau1, p1);
    bool room = turn(s, tau1, p1);
    if (!s->inside && side == -s->side)
        room = room && cross(s, &b, tau1, side);
    else if (s->inside || side == 0) {
        if (!s->inside) enter(s, solve(&b, s->side * roots_scan_noise(s, tau1)), s->side * p0);
        if ((p0 < 0) != (p1 < 0)) {
            s->zeros++;
            s->zero = solve(&b, 0);
        }
        look_lower(s, tau1, p1, turns);
        if (side) room = room && leave(s, solve(&b, side * roots_scan_noise(s, tau1)), p1, side);
    }
    s->tau = tau1;
    s->value = p1;
    return room;
}

bool roots_scan_end(roots_scan *s, double slope)
{
    const int way = certain_slope(s, slope);
    const double zero = s->zeros > 0 ? s->zero : 1;
    s->found->last = s->side;
    if (!s->inside || s->side == 0) return true;
    if (way == s->side) return put_place(s, s->low_tau, s->side * s->low, 1, ROOTS_TOUCH, true);
    return put_place(s, zero, 0, 1, way > 0 ? ROOTS_RISING : way < 0 ? ROOTS_FALLING : ROOTS_TOUCH, true);
}
