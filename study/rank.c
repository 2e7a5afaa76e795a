/* Work against precision: motus_rank.
 *
 * Each method gets a ladder of runs (ladder.h), whose errors are measured against one reference (truth.h). An accuracy
 * is judged only if the reference's error is below a tenth of it, and a run meets it if its error and the reference's
 * together do not exceed it; so a statement about a run is as sure as the error of the reference.
 *
 * Invariants: the result is one allocation. Evaluations, steps and tolerances are the same on every machine; seconds
 * alone are not, and decide nothing but which method is the fastest.
 */
#include "ladder.h"
#include "base/decimal.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { ACCURACIES_MAX = 40, REPEATS = 3, REMARKS_MAX = 2048 };
#define LEAST 1e-15 /* of relative accuracies */
#define CLEAR 10    /* least factor from the reference's error to an accuracy that is judged */
/* The bound on the work (study_work) of one run: 1.1e6 evaluations of one oscillator; less if that is above FACTOR
 * times what the best method so far needs for the finest accuracy, but at least WORK_LEAST. */
#define WORK 2e7
#define WORK_LEAST 3.6e6
#define FACTOR 100.0
#define TRUTH_SHARE 0.1 /* of the progress */

typedef struct row_text {
    char method[MOTUS_NAME_MAX], note[MOTUS_TEXT_MAX];
} row_text;

typedef struct result {
    motus_ranking seen; /* first, since it is the handle the user holds */
    motus_allocator allocator;
    char reference[SOLUTION_TEXT_MAX], remarks[REMARKS_MAX], machine[MOTUS_NAME_MAX];
    double accuracies[ACCURACIES_MAX];
    size_t fewest[ACCURACIES_MAX], fastest[ACCURACIES_MAX];
    motus_rank_row *rows;
    motus_rank_point *points; /* rows × accuracies */
    const motus_rank_row **row_list;
    const motus_rank_point **point_list;
    row_text *texts;
} result;

typedef struct rank {
    study s;
    motus_study_def def;
    truth truth;
    double accuracies[ACCURACIES_MAX];
    size_t asked, judged;
    const char **methods;
    size_t count;
    size_t *turn; /* the order in which methods are taken */
    double *y;
    ladder *ladder;
    double most;   /* most evaluations of a run */
    double fewest; /* the fewest with which a method so far has reached the finest accuracy; INFINITY: none has */
    result *out;
} rank;

/* Accuracies ------------------------------------------------------------------------------------------------------- */

static motus_status refuse_accuracy(double a, motus_error *err)
{
    char text[DECIMAL_MAX];
    fail(err, MOTUS_ARGUMENT, "methods cannot be compared at the accuracy %s", decimal(a, text));
    hint(err, "an accuracy is a positive number; a relative one is at least 1e-15 and below 1");
    return MOTUS_ARGUMENT;
}

/* Divides an accuracy by ten, `times` times, to the number that one would write. */
static double tenth(double a, int times)
{
    int power = 0;
    double digits = a;
    while (digits < 1e14) digits *= 10, power--;
    while (digits >= 1e15) digits /= 10, power++;
    return decimal_scaled(floor(digits + 0.5), power - times);
}

static motus_status read_accuracies(rank *r, motus_error *err)
{
    const motus_study_def *d = &r->def;
    const double coarse = isnan(d->coarsest) ? d->finest : d->coarsest, fine = isnan(d->finest) ? coarse : d->finest;
    const double first = fmax(coarse, fine), last = fmin(coarse, fine);
    if (isnan(first)) {
        fail(err, MOTUS_ARGUMENT, "no accuracy is given");
        hint(err, "give `coarsest = 1e-3` and `finest = 1e-12` of the definition");
        return MOTUS_ARGUMENT;
    }
    const double ends[] = {first, last};
    for (int i = 0; i < 2; i++)
        if (!(ends[i] > 0) || isinf(ends[i]) || (!d->absolute && (ends[i] < LEAST || ends[i] >= 1)))
            return refuse_accuracy(ends[i], err);
    for (int k = 0;; k++) {
        const double a = tenth(first, k);
        const bool ends_here = a <= last * (1 + 1e-9);
        if (r->asked == ACCURACIES_MAX) {
            fail(err, MOTUS_ARGUMENT, "there are more than %d accuracies from %g to %g", ACCURACIES_MAX, first, last);
            hint(err, "give a shorter range");
            return MOTUS_ARGUMENT;
        }
        r->accuracies[r->asked++] = ends_here ? last : a;
        if (ends_here) return MOTUS_OK;
    }
}

static motus_status read_def(rank *r, const motus_study_def *given, motus_error *err)
{
    motus_status status = study_read(given, &r->def, err);
    if (status != MOTUS_OK) return status;
    if (!isnan(r->def.step) || r->def.evaluations > 0) {
        fail(err, MOTUS_ARGUMENT, "%s and accuracies are given",
             r->def.evaluations > 0 ? "a number of evaluations" : "a step");
        hint(err, "leave it out: the study finds for each method the step, or the tolerance, for each accuracy");
        return MOTUS_ARGUMENT;
    }
    if (r->def.repeats < 0) {
        fail(err, MOTUS_ARGUMENT, "a run cannot be timed %d times", r->def.repeats);
        hint(err, "0 times a run three times, a positive number so many times; the shortest time counts");
        return MOTUS_ARGUMENT;
    }
    return read_accuracies(r, err);
}

/* The result ------------------------------------------------------------------------------------------------------- */

static motus_status make_result(rank *r)
{
    const size_t all = r->count * r->asked, head = study_aligned(sizeof(result));
    const size_t rows = study_aligned(r->count * sizeof(motus_rank_row)),
                 texts = study_aligned(r->count * sizeof(row_text));
    const size_t points = study_aligned(all * sizeof(motus_rank_point)),
                 row_list = study_aligned(r->count * sizeof(void *));
    char *block = take(r->s.allocator, head + rows + points + texts + row_list + all * sizeof(void *), 1);
    if (!block) return fail(r->s.err, MOTUS_MEMORY, "out of memory for the ranking of %zu methods", r->count);
    result *o = r->out = (result *)(void *)block;
    o->allocator = *r->s.allocator;
    o->rows = (motus_rank_row *)(void *)(block + head);
    o->points = (motus_rank_point *)(void *)(block + head + rows);
    o->texts = (row_text *)(void *)(block + head + rows + points);
    o->row_list = (const motus_rank_row **)(void *)(block + head + rows + points + texts);
    o->point_list = (const motus_rank_point **)(void *)(block + head + rows + points + texts + row_list);
    memcpy(o->accuracies, r->accuracies, sizeof o->accuracies);
    o->seen = (motus_ranking){.accuracy_count = r->asked,
                              .accuracies = o->accuracies,
                              .absolute = r->def.absolute != 0,
                              .row_count = r->count,
                              .rows = o->row_list,
                              .fewest = o->fewest,
                              .fastest = o->fastest,
                              .reference = o->reference,
                              .machine = o->machine,
                              .remarks = o->remarks};
    for (size_t i = 0; i < all; i++) {
        o->points[i] =
            (motus_rank_point){.accuracy = r->accuracies[i % r->asked], .setting = NAN, .error = NAN, .seconds = NAN};
        o->point_list[i] = &o->points[i];
    }
    for (size_t k = 0; k < r->count; k++) {
        o->rows[k] = (motus_rank_row){
            .method = o->texts[k].method, .points = o->point_list + k * r->asked, .note = o->texts[k].note};
        o->row_list[k] = &o->rows[k];
        snprintf(o->texts[k].method, sizeof o->texts[k].method, "%s", r->methods[k]);
    }
    return MOTUS_OK;
}

/* One method ------------------------------------------------------------------------------------------------------- */

static motus_status row_failed(rank *r, size_t k, motus_status status, const motus_error *e)
{
    if (study_fatal(status)) return study_tell(&r->s, status, e);
    r->out->rows[k].status = status;
    snprintf(r->out->texts[k].note, MOTUS_TEXT_MAX, "%s", e->message);
    return MOTUS_OK;
}

/* Finds the time of a point, or takes that of an equal point before it. */
static motus_status time_point(rank *r, const ladder_point *p, motus_rank_point *points, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (points[k].setting == points[i].setting) {
            points[i].seconds = points[k].seconds;
            return MOTUS_OK;
        }
    return ladder_time(r->ladder, p, &points[i].seconds);
}

static motus_status climb(rank *r, size_t k)
{
    study *s = &r->s;
    ladder *l = r->ladder;
    motus_rank_point *points = r->out->points + k * r->asked;
    const double base = s->base, span = s->span / (double)r->judged;
    size_t i = 0;
    for (; i < r->judged; i++) {
        const ladder_point *p;
        study_part(s, base + span * (double)i, span);
        motus_status status = ladder_reach(l, r->accuracies[i], &p);
        if (status == MOTUS_OK && !p) break;
        if (status == MOTUS_OK) {
            points[i].setting = l->card->adaptive ? p->setting : ladder_step(l, p);
            points[i].error = p->error;
            points[i].steps = p->steps;
            points[i].evaluations = p->evaluations;
            status = time_point(r, p, points, i);
        }
        if (status != MOTUS_OK) return status;
    }
    if (i == r->judged) {
        r->fewest = fmin(r->fewest, (double)points[i - 1].evaluations);
        return MOTUS_OK;
    }
    snprintf(r->out->texts[k].note, MOTUS_TEXT_MAX, "%s", l->why);
    if (i == 0) r->out->rows[k].status = l->failed != MOTUS_OK && ladder_failed(l) ? l->failed : MOTUS_ACCURACY;
    return MOTUS_OK;
}

static motus_status make_row(rank *r, size_t k)
{
    study *s = &r->s;
    motus_rank_row *row = &r->out->rows[k];
    const motus_method *card;
    motus_error e = motus_default_error();
    motus_status status = motus_method_find(r->methods[k], &card, &e);
    if (status == MOTUS_OK) {
        row->order = card->order;
        row->adaptive = card->adaptive;
        status = motus_method_admits(s->system, r->methods[k], &e);
    }
    if (status != MOTUS_OK) return row_failed(r, k, status, &e);
    *r->ladder = (ladder){.s = s,
                          .t = &r->truth,
                          .method = r->methods[k],
                          .card = card,
                          .absolute = r->def.absolute != 0,
                          .y = r->y,
                          .repeats = r->def.repeats ? r->def.repeats : REPEATS,
                          .most = fmin(r->most, fmax(r->most * (WORK_LEAST / WORK), FACTOR * r->fewest))};
    return climb(r, k);
}

/* All methods ------------------------------------------------------------------------------------------------------ */

static void find_cheapest(rank *r)
{
    for (size_t i = 0; i < r->judged; i++) {
        size_t *fewest = &r->out->fewest[i], *fastest = &r->out->fastest[i];
        *fewest = *fastest = r->count;
        for (size_t k = 0; k < r->count; k++) {
            const motus_rank_point *p = &r->out->points[k * r->asked + i];
            const motus_rank_point *few = &r->out->points[*fewest % r->count * r->asked + i],
                                   *fast = &r->out->points[*fastest % r->count * r->asked + i];
            if (isnan(p->error)) continue;
            if (*fewest == r->count || p->evaluations < few->evaluations) *fewest = k;
            if (*fastest == r->count || p->seconds < fast->seconds) *fastest = k;
        }
    }
    for (size_t i = r->judged; i < r->asked; i++) r->out->fewest[i] = r->out->fastest[i] = r->count;
}

static void say(char *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(char *text, const char *format, ...)
{
    const size_t length = strlen(text);
    va_list arguments;
    if (length + 2 > REMARKS_MAX) return;
    if (length) memcpy(text + length, "\n", 2);
    va_start(arguments, format);
    const int n = vsnprintf(text + strlen(text), REMARKS_MAX - strlen(text), format, arguments);
    va_end(arguments);
    if (n < 0 || (size_t)n + length + 1 >= REMARKS_MAX) text[length] = 0;
}

static void remark(rank *r)
{
    char *text = r->out->remarks, first[DECIMAL_MAX], why[MOTUS_TEXT_MAX / 2];
    const motus_method *series = NULL;
    if (r->judged < r->asked)
        say(text,
            "Accuracies from %s on are left out: the error of the reference is %.1e%s, and only what is at least ten "
            "times larger can be told from it.",
            decimal(r->accuracies[r->judged], first), r->out->seen.reference_error,
            r->def.absolute ? "" : " of the motion's size");
    for (size_t k = 0; k < r->count; k++) {
        const motus_method *card = NULL;
        if (motus_method_find(r->methods[k], &card, NULL) == MOTUS_OK && card->series &&
            r->out->rows[k].status == MOTUS_OK)
            series = card;
    }
    if (series) say(text, "%s: an evaluation is one coefficient of the acceleration's series.", series->name);
    const double order = solution_allows(&r->s, &r->truth.found, why, sizeof why);
    if (order > 0)
        say(text,
            "The force is not smooth along the motion: %s. No method of fixed step has more than order %.3g here.", why,
            order);
}

/* Puts methods of high order first, since the work that they need bounds the work that others may spend. */
static void take_turns(rank *r)
{
    for (size_t k = 0; k < r->count; k++) {
        const motus_method *card, *other;
        size_t at = k;
        const int order = motus_method_find(r->methods[k], &card, NULL) == MOTUS_OK ? card->order : 0;
        for (; at > 0; at--) {
            const bool found = motus_method_find(r->methods[r->turn[at - 1]], &other, NULL) == MOTUS_OK;
            if ((found ? other->order : 0) >= order) break;
            r->turn[at] = r->turn[at - 1];
        }
        r->turn[at] = k;
    }
}

static motus_status find_truth(rank *r)
{
    study *s = &r->s;
    study_part(s, 0, TRUTH_SHARE);
    motus_status status = truth_find(s, &r->truth);
    if (status != MOTUS_OK) return status;
    const double error = r->def.absolute ? r->truth.absolute : r->truth.relative;
    if (!r->truth.found.known) return solution_missing(s, &r->truth.found, s->until);
    while (r->judged < r->asked && error * CLEAR <= r->accuracies[r->judged]) r->judged++;
    if (r->judged == 0) {
        fail(s->err, MOTUS_ACCURACY, "no accuracy can be judged: the error of the reference is %.1e%s", error,
             r->def.absolute ? "" : " of the motion's size");
        hint(s->err, "ask for accuracies that are at least ten times larger, or let the motion end earlier");
        return MOTUS_ACCURACY;
    }
    snprintf(r->out->reference, sizeof r->out->reference, "%s", r->truth.found.text);
    r->out->seen.reference_error = error;
    r->out->seen.judged = r->judged;
    return MOTUS_OK;
}

/* Refuses an unknown machine before anything is computed. */
static motus_status find_machine(rank *r)
{
    study *s = &r->s;
    motus_run *run = NULL;
    s->machine = r->def.machine ? r->def.machine : "interpreter";
    const motus_status status =
        study_run(s, STUDY_SIMPLEST, fabs(s->until - s->from) / TRUTH_TIMES, NAN, s->until, NULL, &run, s->err);
    if (status == MOTUS_OK) snprintf(r->out->machine, sizeof r->out->machine, "%s", motus_run_now(run).machine);
    motus_run_destroy(run);
    return status;
}

static motus_status rank_all(rank *r)
{
    study *s = &r->s;
    motus_status status = find_machine(r);
    r->most = WORK / study_work(s, motus_method_at(0), 0, 1);
    r->fewest = INFINITY;
    take_turns(r);
    const char *machine = s->machine;
    s->machine = "interpreter"; /* the reference's runs are short */
    if (status == MOTUS_OK) status = find_truth(r);
    s->machine = machine;
    for (size_t k = 0; k < r->count && status == MOTUS_OK; k++) {
        const double share = (1 - TRUTH_SHARE) / (double)r->count;
        study_part(s, TRUTH_SHARE + share * (double)k, share);
        status = make_row(r, r->turn[k]);
    }
    if (status != MOTUS_OK) return status;
    find_cheapest(r);
    remark(r);
    return MOTUS_OK;
}

motus_status motus_rank(motus_system *system, const motus_study_def *given, motus_ranking **ranking, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!system || !ranking) return fail(err, MOTUS_ARGUMENT, "motus_rank needs a system and a place for its result");
    *ranking = NULL;
    rank r = {.asked = 0};
    motus_settings settings;
    const modes host = modes_enter();
    motus_status status = read_def(&r, given, err);
    if (status == MOTUS_OK) status = study_settings(system, &r.def, &settings, err);
    if (status == MOTUS_OK) status = study_open(&r.s, system, &r.def, &settings, 0, err);
    if (status == MOTUS_OK) status = study_methods(&r.s, &r.def, true, &r.methods, &r.count);
    if (status == MOTUS_OK) status = make_result(&r);
    if (status == MOTUS_OK) {
        r.y = take(r.s.allocator, r.s.numbers, sizeof *r.y);
        r.ladder = take(r.s.allocator, 1, sizeof *r.ladder);
        r.turn = take(r.s.allocator, r.count, sizeof *r.turn);
        if (!r.y || !r.ladder || !r.turn)
            status = fail(err, MOTUS_MEMORY, "out of memory for a state of %zu numbers", r.s.numbers);
    }
    if (status == MOTUS_OK) status = rank_all(&r);
    if (r.s.allocator) {
        truth_free(&r.s, &r.truth);
        give(r.s.allocator, r.y);
        give(r.s.allocator, r.ladder);
        give(r.s.allocator, r.turn);
        give(r.s.allocator, (void *)r.methods);
        if (status == MOTUS_OK)
            *ranking = &r.out->seen;
        else
            give(r.s.allocator, r.out);
        study_close(&r.s);
    }
    modes_leave(host);
    return status;
}

void motus_ranking_destroy(motus_ranking *r)
{
    if (r) study_drop(r, ((result *)(void *)r)->allocator);
}
