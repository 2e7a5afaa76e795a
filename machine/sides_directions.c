/* The direction of a vector, r'/|r'|: how it turns, comes to rest, is held in the disc, and leaves it. See
 * sides_parts.h. */
#include "machine/sides_parts.h"

#include <math.h>
#include <string.h>

/* A direction turns where the vector's component along its old unit vector falls to this part of its length: about 75
 * degrees. */
#define TURNS 0.25

static void put_held(double *side, const parts *p, double way)
{
    for (int i = 0; i < p->count; i++) side[p->of[i]] = way > 0 ? SWITCHES_HELD : SWITCHES_HELD_BACKWARD;
}

#define SHORT 0x1p-24 /* its square, as a part of positions, is a way below their rounding */
double sides_short_of(const sides *s, const parts *p, double t, double *x, double *v)
{
    double *side = x + s->switches->slot, was[GRAPH_COMPONENTS], far = 0, back = -INFINITY;
    if (!s->hold || s->switches->slides[switches_kind(s->switches, p->of[0])] != SLIDES_HELD) return 0;
    for (int i = 0; i < p->count; i++) was[i] = side[p->of[i]];
    put_held(side, p, s->way);
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p), sides_evaluate(s, s->grip, t, x, v, NULL, s->r);
    for (int i = 0; i < p->count; i++) side[p->of[i]] = was[i], back = fmax(back, s->way * s->r[p->of[i]]);
    for (size_t i = 0; i < s->problem->nx - s->problem->modes; i++) far = fmax(far, fabs(x[i]));
    const double slack = 1 - sides_along(p, s->p, s->p);
    return back < 0 && slack > 0 ? SHORT * sqrt(far * -back * slack) : 0;
}

double sides_direction_of(const sides *s, const parts *p, const double *side, const double *u, double least)
{
    if (sides_is_held(s, side, p->of[0])) return 1 - sides_along(p, s->p, s->p);
    const double q = sides_along(p, side, u);
    return q - copysign(TURNS, q) * sqrt(sides_along(p, u, u)) - (1 - TURNS) * least;
}

double sides_direction_rate_of(const sides *s, const parts *p, const double *side, const double *du)
{
    if (sides_is_held(s, side, p->of[0])) return -2 * sides_along(p, s->p, s->dp);
    const double length = sqrt(sides_along(p, s->u, s->u)), turns = copysign(TURNS, sides_along(p, side, s->u));
    return sides_along(p, side, du) - (length > 0 ? turns * sides_along(p, s->u, du) / length : 0);
}

double sides_direction_rounding_of(const sides *s, const parts *p, const double *side, const double *du)
{
    double sum = 0;
    for (int i = 0; i < p->count; i++) {
        const size_t k = p->of[i];
        sum += sides_is_held(s, side, k) ? 2 * fabs(s->p[k]) * (s->dp[k] + 1) : (1 + TURNS) * du[k] + 4 * fabs(s->u[k]);
    }
    return sum;
}

static void put_direction(double *side, const parts *p, const double *d, double length)
{
    for (int i = 0; i < p->count; i++) side[p->of[i]] = d[p->of[i]] / length;
}

/* Evaluates the accelerations to `a` and the rates of all arguments to `du`. */
static motus_status push_of(sides *s, double t, double *x, double *v, double *a, double *du, motus_error *err)
{
    const motus_status status = sides_accelerate(s, t, x, v, err);
    if (status != MOTUS_OK) return status;
    sides_evaluate(s, s->rate, t, x, v, s->a, du);
    if (a != s->a) memcpy(a, s->a, s->problem->nv * sizeof *a);
    return MOTUS_OK;
}

static const char no_disc[] =
    "the force along a direction drives its vector not straight back, and nothing is known to "
    "hold it,";

/* Moves the state to where the vector is 0, along the push of the force against it: half the difference of the
 * accelerations with the vector's own direction and the opposite one. Only friction whose push drives the vector
 * straight back, at one rate in every direction, can hold it. */
static motus_status move_to_rest(sides *s, const parts *p, double way, double t, double *x, double *v, double *first,
                                 double *drives, motus_error *err)
{
    enum { PASSES = 32 };            /* as in `hold` */
    const double nothing = 0x1p-480; /* the square of this does not underflow */
    double *side = x + s->switches->slot, least = INFINITY;
    motus_status status = MOTUS_OK;
    for (int pass = 0; pass < PASSES && status == MOTUS_OK; pass++) {
        sides_evaluate(s, s->argument, t, x, v, NULL, s->now);
        const double length = sqrt(sides_along(p, s->now, s->now));
        if (!(length > nothing && length < least)) break;
        least = length;
        put_direction(side, p, s->now, length);
        status = push_of(s, t, x, v, s->b, s->later, err);
        put_direction(side, p, s->now, -length);
        if (status == MOTUS_OK) status = push_of(s, t, x, v, s->a, s->du, err);
        if (status != MOTUS_OK) break;
        double back = 0, aside = 0;
        for (int i = 0; i < p->count; i++) s->later[p->of[i]] = (s->later[p->of[i]] - s->du[p->of[i]]) / 2;
        back = -sides_along(p, s->later, s->now) / length;
        for (int i = 0; i < p->count; i++) aside += fabs(s->later[p->of[i]] + back * s->now[p->of[i]] / length);
        if (pass == 0 && !(way * back > 0 && aside <= 0x1p-20 * fabs(back)))
            return sides_refuse(s, p->of[0], no_disc, t, err);
        if (pass == 0 && drives) *drives = way * back;
        for (size_t i = 0; i < s->problem->nv; i++) {
            const double by = length / back * (s->b[i] - s->a[i]) / 2;
            if (pass == 0 && first) first[i] = by;
            v[i] += by;
        }
    }
    for (size_t i = 0; i < s->problem->nv; i++)
        if (fabs(v[i]) <= nothing) v[i] = 0;
    return status;
}

motus_status sides_leave(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err)
{
    double *side = x + s->switches->slot;
    const size_t nv = s->problem->nv;
    put_held(side, p, way);
    motus_status status = push_of(s, t, x, v, s->b, s->later, err);
    sides_evaluate(s, s->hold, t, x, v, NULL, s->p);
    const double length = sqrt(sides_along(p, s->p, s->p));
    if (s->p[p->of[0]] != s->p[p->of[0]] || !(length > 0)) return sides_refuse(s, p->of[0], no_disc, t, err);
    if (length <= 1 + 0x1p-20) { /* it breaks loose where it has been held so far */
        double across = 0;
        sides_evaluate(s, s->hold_rate, t, x, v, s->b, s->dp);
        const double grows = sides_along(p, s->p, s->dp) / length, rate = sqrt(sides_along(p, s->dp, s->dp));
        for (int i = 0; i < p->count; i++) {
            const double part = s->dp[p->of[i]] - grows * s->p[p->of[i]] / length;
            across += part * part;
        }
        if (!(sqrt(across) <= 0x1p-20 * rate))
            return sides_refuse(s, p->of[0],
                                "the motion breaks loose along a direction that turns, which steps cannot follow,", t,
                                err);
    }
    memcpy(s->before, s->p, s->switches->count * sizeof *s->p);
    put_direction(side, p, s->p, length);
    for (int i = 0; i < p->count; i++) s->now[p->of[i]] = side[p->of[i]];
    if (status == MOTUS_OK) status = push_of(s, t, x, v, s->a, s->du, err); /* without friction, at 0 */
    if (status != MOTUS_OK) return status;
    sides_evaluate(s, s->rounding, t, x, v, NULL, s->bound);
    double bound = 0, back = 0;
    for (int i = 0; i < p->count; i++) {
        const size_t k = p->of[i];
        bound += 0x1p-53 * s->bound[k];
        back += s->now[k] * (s->du[k] - s->later[k]) / length;
    }
    const double ulp = nextafter(fabs(t), INFINITY) - fabs(t);
    const double speed = fmax(64 * bound, fmax(64 * ulp, 0x1p-70) * fabs(back));
    if (!(back != 0)) return sides_refuse(s, p->of[0], no_disc, t, err);
    for (size_t i = 0; i < nv; i++) v[i] -= speed / back * (s->b[i] - s->a[i]) / length;
    return MOTUS_OK;
}

/* Tells whether the vector is driven back along each component, as much as by that component alone: of two vectors that
 * one force holds, the second has no rate of its own. */
static bool drives_back(sides *s, const parts *p, double way, double t, double *x, double *v)
{
    double *side = x + s->switches->slot;
    sides_measure_hold(s, t, x, v);
    memcpy(s->was, side, s->switches->count * sizeof *side);
    for (size_t k = 0; k < s->switches->count; k++)
        if (switches_directs(sides_op_of(s, k)) && k != p->of[0]) side[k] = 0;
    sides_evaluate(s, s->grip, t, x, v, NULL, s->before);
    memcpy(side, s->was, s->switches->count * sizeof *side);
    bool back = true;
    for (int i = 0; i < p->count; i++)
        back = back && way * s->r[p->of[i]] < 0 && fabs(s->r[p->of[i]]) > 0x1p-20 * fabs(s->before[p->of[0]]);
    return back;
}

static const char two_forms[] = "the force has one direction in two forms, which nothing shows to be one,";

/* Measures how much the force along a direction drives its vector: alone, to `alone`, and with another vector held as
 * well, to r. */
static void measure_both(sides *s, const parts *p, const parts *other, double way, double t, double *x, double *v,
                         double *alone)
{
    double *side = x + s->switches->slot;
    put_held(side, p, way);
    for (int i = 0; i < other->count; i++) side[other->of[i]] = 0;
    sides_evaluate(s, s->grip, t, x, v, NULL, alone);
    put_held(side, other, way);
    sides_evaluate(s, s->grip, t, x, v, NULL, s->r);
}

/* Tells whether another vector may be this one in another form, which nothing has shown: with one of them held the
 * force no longer drives the other. is_short: looks only at vectors that are 0 too, of which the force no longer drives
 * a part. */
static bool is_twice(sides *s, const parts *p, bool is_short, double way, double t, double *x, double *v)
{
    double *side = x + s->switches->slot;
    bool twice = false;
    if (!s->hold) return false;
    sides_evaluate(s, s->argument, t, x, v, NULL, s->now);
    sides_evaluate(s, s->rounding, t, x, v, NULL, s->bound);
    memcpy(s->was, side, s->switches->count * sizeof *side);
    for (size_t k = 0; k < s->switches->count && !twice; k++) {
        const parts o = sides_parts_of(s, k);
        double bound = 0;
        if (!o.count || sides_silent(s, k) || k == p->of[0]) continue;
        for (int i = 0; i < o.count; i++) bound += 0x1p-53 * s->bound[o.of[i]];
        if (is_short && !(sides_along(&o, s->now, s->now) <= 0x1p20 * bound * bound))
            continue; /* rounding of the other form */
        for (int both = 0; both < 2 && !twice; both++) {
            const parts *one = both ? p : &o, *other = both ? &o : p;
            int lost = 0;
            measure_both(s, one, other, way, t, x, v, s->before);
            for (int i = 0; i < one->count && s->before[one->of[0]] != 0; i++)
                lost += !(fabs(s->r[one->of[i]]) > 0x1p-20 * fabs(s->before[one->of[0]]));
            twice = is_short ? lost > 0 : lost == one->count;
            memcpy(side, s->was, s->switches->count * sizeof *side);
        }
    }
    return twice;
}

/* Tells whether what holds `of` depends on the sides of `by`, for which is then not solved. */
static bool depends(sides *s, const parts *of, const parts *by, double t, double *x, double *v)
{
    double *side = x + s->switches->slot, was[GRAPH_COMPONENTS];
    bool differs = false;
    for (int i = 0; i < by->count; i++) was[i] = side[by->of[i]], side[by->of[i]] = 0;
    sides_evaluate(s, s->hold, t, x, v, NULL, s->before);
    for (int i = 0; i < by->count; i++) side[by->of[i]] = 1;
    sides_evaluate(s, s->hold, t, x, v, NULL, s->later);
    for (int i = 0; i < by->count; i++) side[by->of[i]] = was[i];
    for (int i = 0; i < of->count; i++) {
        const double before = s->before[of->of[i]], later = s->later[of->of[i]];
        differs = differs || (before != later && !(isnan(before) && isnan(later)));
    }
    return differs;
}

/* Tells whether what holds this vector, or another one that is held, depends on a side that is not known while both are
 * held. */
static bool is_coupled(sides *s, const parts *p, double t, double *x, double *v)
{
    const double *side = x + s->switches->slot;
    bool coupled = false;
    for (size_t k = 0; k < s->switches->count && !coupled; k++) {
        parts o = sides_parts_of(s, k);
        const bool held = sides_is_held(s, side, k);
        if (sides_silent(s, k) || k == p->of[0] || sides_solved(s, k, p->of[0]) || !(o.count || held)) continue;
        if (!o.count) o = (parts){.of = {k}, .count = 1};
        coupled = depends(s, p, &o, t, x, v) || (held && depends(s, &o, p, t, x, v));
    }
    return coupled;
}

motus_status sides_stand(sides *s, const parts *p, double way, double t, double *x, double *v, motus_error *err)
{
    double *side = x + s->switches->slot;
    if (!s->hold || s->switches->slides[switches_kind(s->switches, p->of[0])] != SLIDES_HELD)
        return sides_refuse(s, p->of[0], "the motion stops, and nothing is known to hold it,", t, err);
    put_held(side, p, way);
    sides_measure_hold(s, t, x, v);
    bool acts = false;
    for (int i = 0; i < p->count; i++) acts |= s->r[p->of[i]] != 0;
    if (!acts) { /* friction is switched off */
        for (int i = 0; i < p->count; i++) side[p->of[i]] = i == 0;
        motus_status status = push_of(s, t, x, v, s->a, s->du, err);
        const double pull = sqrt(sides_along(p, s->du, s->du));
        if (status == MOTUS_OK && pull > 0) put_direction(side, p, s->du, way * pull);
        if (!(pull > 0)) put_held(side, p, way);
        return status;
    }
    const motus_status status = move_to_rest(s, p, way, t, x, v, NULL, NULL, err);
    if (status != MOTUS_OK) return status;
    put_held(side, p, way);
    if (!drives_back(s, p, way, t, x, v)) return sides_refuse(s, p->of[0], no_disc, t, err);
    if (is_twice(s, p, true, way, t, x, v)) return sides_refuse(s, p->of[0], two_forms, t, err);
    if (is_coupled(s, p, t, x, v))
        return sides_refuse(s, p->of[0], "the motion stops together with others, more than are held at once,", t, err);
    sides_measure_hold(s, t, x, v);
    return sides_along(p, s->p, s->p) <= 1 ? MOTUS_OK : sides_leave(s, p, way, t, x, v, err);
}

/* Moves a short vector u on to rest, and the time with it; not *rests: it would rest after `until`. With the force
 * constant, F without friction and -c u/|u| by it, c|u| + F u falls by c^2 - F^2 per unit of time, as do quadratic
 * forms in u whose rates are linear in u: where the motion stops, how far it goes and when are known in closed form,
 * though no power of the time leads there. */
static motus_status come_to_rest(sides *s, const parts *p, double way, double until, double *t, double *x, double *v,
                                 bool *rests, motus_error *err)
{
    double *side = x + s->switches->slot, u[GRAPH_COMPONENTS], F[GRAPH_COMPONENTS], back = 0;
    const size_t nv = s->problem->nv, moving = s->problem->nx - s->problem->modes;
    sides_evaluate(s, s->argument, *t, x, v, NULL, s->now);
    const double length = sqrt(sides_along(p, s->now, s->now));
    for (int i = 0; i < p->count; i++) u[i] = s->now[p->of[i]];
    memset(s->push, 0, nv * sizeof *s->push);
    memcpy(s->v, v, nv * sizeof *v);
    motus_status status = move_to_rest(s, p, way, *t, x, v, s->push, &back, err);
    if (status != MOTUS_OK) return status;
    for (int i = 0; i < p->count; i++) side[p->of[i]] = u[i] / length;
    status = push_of(s, *t, x, v, s->a, s->du, err); /* without friction, at 0 */
    put_held(side, p, way);
    if (status == MOTUS_OK) status = push_of(s, *t, x, v, s->b, s->later, err);
    sides_measure_hold(s, *t, x, v);
    double pull = 0, with = 0;
    for (int i = 0; i < p->count; i++) F[i] = back * s->p[p->of[i]], pull += F[i] * F[i], with += F[i] * u[i];
    pull = sqrt(pull);
    if (status != MOTUS_OK || !(pull < back)) return status;
    const double ahead = pull > 0 ? with / pull : 0; /* the part of u along F */
    const double time = (back * length + with) / (back * back - pull * pull);
    if (!(time <= way * (until - *t))) { /* the run ends before */
        memcpy(v, s->v, nv * sizeof *v);
        for (int i = 0; i < p->count; i++) side[p->of[i]] = u[i] / length;
        *rests = false;
        return MOTUS_OK;
    }
    const double turned = (2 * back * length + with) / (4 * back * back - pull * pull);
    const double far =
        (back * length * ahead + pull * (ahead * ahead + length * length) / 2) / (2 * (back * back - pull * pull));
    /* the push for u has been found by its own direction, that along F by what holds the vector */
    const double of_u = turned, of_hold = pull > 0 ? (far - turned * ahead) / pull : 0;
    for (size_t i = 0; i < moving; i++) {
        const double friction = -of_u * s->push[i] - of_hold * (s->b[i] - s->a[i]);
        x[i] += way * (v[i] * time + friction) + s->b[i] * time * time / 2;
    }
    for (size_t i = 0; i < nv; i++) v[i] += way * s->b[i] * time;
    *t += way * time;
    return MOTUS_OK;
}

motus_status sides_choose_direction(sides *s, size_t k, bool left, double way, double until, double *t, double *x,
                                    double *v, motus_error *err)
{
    const parts p = sides_parts_of(s, k);
    double *side = x + s->switches->slot, bound = 0;
    sides_evaluate(s, s->argument, *t, x, v, NULL, s->now);
    const double length = sqrt(sides_along(&p, s->now, s->now));
    if (left && sides_is_held(s, side, k)) return sides_leave(s, &p, way, *t, x, v, err);
    sides_evaluate(s, s->rounding, *t, x, v, NULL, s->bound);
    for (int i = 0; i < p.count; i++) bound += 0x1p-53 * s->bound[p.of[i]];
    if (length <= bound) return sides_stand(s, &p, way, *t, x, v, err);
    put_direction(side, &p, s->now, length);
    if (is_twice(s, &p, false, way, *t, x, v)) return sides_refuse(s, k, two_forms, *t, err);
    if (!left) return MOTUS_OK;
    const double ulp = nextafter(fabs(*t), INFINITY) - fabs(*t), least = sides_short_of(s, &p, *t, x, v);
    motus_status status = MOTUS_OK;
    bool rests = true;
    if (length <= 1.25 * least) {
        status = come_to_rest(s, &p, way, until, t, x, v, &rests, err);
    } else { /* what is left of the motion is less than times can tell */
        status = push_of(s, *t, x, v, s->a, s->du, err);
        if (status != MOTUS_OK || !(length <= -0x1p13 * ulp * way * sides_along(&p, s->du, s->now) / length))
            return status;
    }
    return status == MOTUS_OK && rests ? sides_stand(s, &p, way, *t, x, v, err) : status;
}
