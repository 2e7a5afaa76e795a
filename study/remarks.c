/* The remarks under a comparison: each is written only if the measured numbers and the methods' rows confirm it; the
 * names of models and methods decide nothing.
 *
 * Invariant: the text is complete sentences, one a line; a sentence that does not fit is left out.
 */
#include "remarks.h"
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define LINE_MAX_BYTES 900
#define NAMES_SHOWN 6
#define CLOSE 1e-6    /* relative: a measured amount that is nearer to the predicted one confirms it */
#define FAR 100.0     /* times the rounding: a larger amount is not rounding */
#define RETURNED 1e-7 /* of the motion's size: a run back has returned if it ends nearer to the start */

typedef struct sheet {
    char *text;
    size_t size, length;
} sheet;
/* Returns whether a sentence applies to row k. */
typedef bool member(const remarks_view *, size_t k, size_t invariant);

static void say(sheet *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(sheet *s, const char *format, ...)
{
    char line[LINE_MAX_BYTES];
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (n < 0 || (size_t)n >= sizeof line || s->length + (size_t)n + 2 > s->size) return;
    if (s->length) s->text[s->length++] = '\n';
    memcpy(s->text + s->length, line, (size_t)n + 1);
    s->length += (size_t)n;
}

static size_t names(const remarks_view *v, member *is, size_t invariant, char *out, size_t size)
{
    size_t count = 0, shown = 0, length = 0;
    for (size_t k = 0; k < v->count; k++) count += is(v, k, invariant);
    size_t show = count <= NAMES_SHOWN + 1 ? count : NAMES_SHOWN;
    out[0] = 0;
    for (size_t k = 0; k < v->count && shown < show; k++) {
        if (!is(v, k, invariant)) continue;
        const char *link = shown == 0 ? "" : shown + 1 == count ? " and " : ", ";
        int n = snprintf(out + length, size - length, "%s%.*s", link, 40, v->rows[k].method);
        length += n > 0 && (size_t)n < size - length ? (size_t)n : 0;
        shown++;
    }
    if (count > show) snprintf(out + length, size - length, " and %zu others", count - show);
    return count;
}

static bool ran(const remarks_view *v, size_t k) { return v->rows[k].status == MOTUS_OK; }

/* Returns the largest error among the positions, velocities and first-order variables that there are. */
static double largest_error(const motus_compare_row *r)
{
    return fmax(fmax(r->error_max_x, r->error_max_v), r->error_max_s);
}

/* Returns how much rounding may change a position or velocity of row k over the run. */
static double rounding(const remarks_view *v, size_t k)
{
    return 4 * DBL_EPSILON * v->s->magnitude * (8 + sqrt((double)v->rows[k].evaluations)) + 4 * v->reference->error;
}

/* Constant acceleration ------------------------------------------------------------------------------------------ */

static bool misses_by(const remarks_view *v, size_t k, double sign)
{
    const remarks_fact *f = &v->facts[k];
    return ran(v, k) && f->card->order == 1 && fabs(f->expected) > FAR * rounding(v, k) &&
           fabs(f->miss - sign * f->expected) <= CLOSE * fabs(f->expected) + rounding(v, k);
}

static bool lags(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return misses_by(v, k, -1);
}

static bool leads(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return misses_by(v, k, 1);
}

static bool on_the_parabola(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return ran(v, k) && v->facts[k].card->order >= 2 && largest_error(&v->rows[k]) <= rounding(v, k);
}

static void constant_acceleration(const remarks_view *v, sheet *out)
{
    char behind[LINE_MAX_BYTES / 2], ahead[LINE_MAX_BYTES / 2];
    if (isnan(v->acceleration) || v->acceleration == 0 || !v->reference->known) return;
    motus_column axis = motus_default_column();
    motus_column_at(v->s->system, 1 + v->axis, &axis);
    size_t n = names(v, lags, 0, behind, sizeof behind), m = names(v, leads, 0, ahead, sizeof ahead);
    size_t k = 0;
    while (k < v->count && !lags(v, k, 0) && !leads(v, k, 0)) k++;
    double most = k < v->count ? fabs(v->facts[k].expected) : 0, length = fabs(v->s->until - v->s->from);
    double plain = 0.5 * fabs(v->acceleration) * (k < v->count ? v->rows[k].step : 0) * length;
    const char *formula = fabs(plain - most) <= 1e-3 * most ? "½ |a| h t" : "½ |a| Σ h²";
    if (n && m)
        say(out,
            "The acceleration is constant (%.6g in %.60s): %s fall%s behind the exact motion, %s run%s ahead of it, by "
            "equal and opposite amounts, %s = %.6g at the end. The first kind moves each step with the velocity at its "
            "beginning, the second with the velocity at its end; the mean of both is exact.",
            v->acceleration, axis.name, behind, n == 1 ? "s" : "", ahead, m == 1 ? "s" : "", formula, most);
    else if (n || m)
        say(out,
            "The acceleration is constant (%.6g in %.60s): %s miss%s the exact motion by %s = %.6g at the end, since "
            "each step is made with the velocity at its %s.",
            v->acceleration, axis.name, n ? behind : ahead, n + m == 1 ? "es" : "", formula, most,
            n ? "beginning" : "end");
    n = names(v, on_the_parabola, 0, behind, sizeof behind);
    double largest = 0;
    for (k = 0; k < v->count; k++)
        if (on_the_parabola(v, k, 0)) largest = fmax(largest, v->rows[k].error_max_x);
    if (n)
        say(out,
            "Exact to round-off: %s (largest error %.2g). The motion is a parabola in t, and a method of second or "
            "higher order integrates a polynomial of second degree without error, at any step.",
            behind, largest);
}

/* Invariants ----------------------------------------------------------------------------------------------------- */

static const motus_drift *drift(const remarks_view *v, size_t k, size_t i) { return v->rows[k].invariants[i]; }

static bool runs_away(const remarks_view *v, size_t k, size_t i)
{
    const motus_drift *d = ran(v, k) ? drift(v, k, i) : NULL;
    return d && d->trending && v->facts[k].card->stability_limit == 0 && v->rate > 0 &&
           fabs(d->final - d->initial) > FAR * v->facts[k].roundoff[i] && fabs(d->final) > fabs(d->initial);
}

static bool drifts(const remarks_view *v, size_t k, size_t i)
{
    const motus_drift *d = ran(v, k) ? drift(v, k, i) : NULL;
    return d && d->trending && !runs_away(v, k, i);
}

static bool stays(const remarks_view *v, size_t k, size_t i)
{
    const motus_drift *d = ran(v, k) ? drift(v, k, i) : NULL;
    return d && !d->trending && v->facts[k].geometry == MOTUS_GEOMETRY_SYMPLECTIC &&
           d->max_drift > v->facts[k].roundoff[i];
}

static bool conserves(const remarks_view *v, size_t k, size_t i)
{
    const motus_drift *d = ran(v, k) ? drift(v, k, i) : NULL;
    return d && d->max_drift <= v->facts[k].roundoff[i];
}

static double largest_drift(const remarks_view *v, member *is, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < v->count; k++)
        if (is(v, k, i)) most = fmax(most, drift(v, k, i)->max_drift);
    return most;
}

static void invariant(const remarks_view *v, size_t i, sheet *out)
{
    char list[LINE_MAX_BYTES / 2];
    const char *name = v->rows[0].invariants[i]->name;
    size_t n = names(v, runs_away, i, list, sizeof list), worst = v->count;
    for (size_t k = 0; k < v->count; k++)
        if (runs_away(v, k, i) && (worst == v->count || drift(v, k, i)->max_drift > drift(v, worst, i)->max_drift))
            worst = k;
    if (n)
        say(out,
            "%.80s: with %s it grows without bound (%s%sfrom %.6g to %.6g here): %s stability limit is 0, so "
            "each step enlarges an oscillation, however short the step.",
            name, list, n == 1 ? "" : v->rows[worst].method, n == 1 ? "" : " ", drift(v, worst, i)->initial,
            drift(v, worst, i)->final, n == 1 ? "its" : "their");
    n = names(v, stays, i, list, sizeof list);
    /* Only an energy has a modified energy. */
    if (n && !v->analysis.time_dependent)
        say(out,
            "%.80s: with %s it oscillates by at most %.3g and shows no trend, since a symplectic method nearly "
            "conserves a modified energy%s.",
            name, list, largest_drift(v, stays, i),
            v->analysis.sampled_gradient ? "; that the force is a gradient holds as far as sampled" : "");
    n = names(v, drifts, i, list, sizeof list);
    if (n)
        say(out, "%.80s: with %s it has a trend that its oscillation does not explain; the largest change is %.3g.",
            name, list, largest_drift(v, drifts, i));
    n = names(v, conserves, i, list, sizeof list);
    if (n) say(out, "%.80s: %s conserve%s it to round-off.", name, list, n == 1 ? "s" : "");
}

/* The way back --------------------------------------------------------------------------------------------------- */

static bool returns(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return ran(v, k) && v->facts[k].card->reversible && v->rows[k].reversal <= RETURNED;
}

static bool strays(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return ran(v, k) && v->facts[k].card->reversible && v->rows[k].reversal > RETURNED &&
           isfinite(v->rows[k].reversal) && v->reference->known && !v->reference->uneven &&
           v->reference->jump.order < 0;
}

static bool loses_the_way(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return ran(v, k) && !v->facts[k].card->reversible && v->rows[k].reversal > RETURNED;
}

static double worst_reversal(const remarks_view *v, member *is)
{
    double most = 0;
    for (size_t k = 0; k < v->count; k++)
        if (is(v, k, 0)) most = fmax(most, v->rows[k].reversal);
    return most;
}

static void way_back(const remarks_view *v, sheet *out)
{
    char there[LINE_MAX_BYTES / 3], lost[LINE_MAX_BYTES / 3];
    size_t n = names(v, returns, 0, there, sizeof there), m = names(v, loses_the_way, 0, lost, sizeof lost);
    if (n && m)
        say(out,
            "Run backward from the end, %s return%s to the start within %.2g of the motion's size, being reversible; "
            "%s %s not, and miss%s it by up to %.2g.",
            there, n == 1 ? "s" : "", worst_reversal(v, returns), lost, m == 1 ? "is" : "are", m == 1 ? "es" : "",
            worst_reversal(v, loses_the_way));
    n = names(v, strays, 0, there, sizeof there);
    if (n)
        say(out,
            "%s %s reversible, yet miss%s the start by %.2g of the motion's size: the motion is so sensitive that it "
            "enlarges rounding errors.",
            there, n == 1 ? "is" : "are", n == 1 ? "es" : "", worst_reversal(v, strays));
}

/* Steps that are too long, references that are not accurate enough ---------------------------------------------- */

static void too_long(const remarks_view *v, sheet *out)
{
    for (size_t k = 0; k < v->count; k++) {
        const motus_compare_row *r = &v->rows[k];
        const motus_method *card = v->facts[k].card;
        if (!card || !(card->stability_limit > 0) || !(r->step * v->rate > card->stability_limit)) continue;
        bool lost = r->status == MOTUS_DIVERGED ||
                    !(fmax(r->error_max_x, r->error_max_s) <= FAR * fmax(v->s->magnitude, DBL_MIN));
        if (lost)
            say(out,
                "%s: the step %.6g is beyond its stability limit: the fastest rate of the motion is about %.4g, times "
                "the step %.3g, and the method is stable up to %.4g.",
                r->method, r->step, v->rate, r->step * v->rate, card->stability_limit);
    }
}

static bool as_good_as_the_reference(const remarks_view *v, size_t k, size_t unused)
{
    (void)unused;
    return ran(v, k) && largest_error(&v->rows[k]) <= 3 * v->reference->error;
}

static void reference(const remarks_view *v, sheet *out)
{
    char list[LINE_MAX_BYTES / 2];
    if (!v->reference->known) {
        say(out, "Errors are not shown, since no exact motion is known and there is no reference solution: %s.",
            solution_lacks(v->reference));
        return;
    }
    char why[LINE_MAX_BYTES / 2];
    const double order = solution_allows(v->s, v->reference, why, sizeof why);
    if (order > 0)
        say(out, "The force is not smooth along the motion: %s. No method of fixed step has more than order %.3g here.",
            why, order);
    size_t n = v->reference->exact ? 0 : names(v, as_good_as_the_reference, 0, list, sizeof list);
    if (n)
        say(out, "The reference has an error of %.2g itself: the error%s shown for %s may be the reference's.",
            v->reference->error, n == 1 ? "" : "s", list);
}

void remarks_write(const remarks_view *v, char *text, size_t size)
{
    sheet out = {text, size, 0};
    text[0] = 0;
    constant_acceleration(v, &out);
    for (size_t i = 0; v->count && i < v->rows[0].invariant_count; i++) invariant(v, i, &out);
    way_back(v, &out);
    too_long(v, &out);
    reference(v, &out);
}
