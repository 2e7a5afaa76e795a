/* Ensembles: the public calls. See ensemble.h. */
#include "api/ensemble/ensemble.h"
#include "api/system/located.h"

#include "api/error/bars.h"
#include "api/request/choice.h"
#include "api/search/suggest.h"
#include "machine/parallel.h"
#include "machine/reduction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)REDUCE_MEAN == (int)MOTUS_REDUCE_MEAN && (int)REDUCE_TIME_OF_MAX == (int)MOTUS_REDUCE_TIME_OF_MAX,
               "the reductions are the same list");
_Static_assert(MOTUS_REDUCE_TOLERANCE - MOTUS_REDUCE_STEPS == TALLY_TOLERANCE, "and so is what is told of steps");

enum { ENSEMBLE_LANES_MAX = 64 };

int ensemble_report(void *context, double fraction)
{
    motus_ensemble *e = context;
    const double t = e->progress ? pace_now() : 0;
    if (!e->progress || t - e->reported < 0.01) return 0;
    e->reported = t;
    if (fraction > e->fraction) e->fraction = fraction; /* trajectories that lanes leave are begun anew */
    return e->progress(e->context, e->fraction);
}

static motus_status check(const motus_system *s, const motus_ensemble_def *d, motus_error *err)
{
    if (!d->record_count) return fail(err, MOTUS_ARGUMENT, "nothing is recorded");
    for (size_t r = 0; r < d->record_count; r++)
        if (d->records[r].column >= s->column_count || (unsigned)d->records[r].how > MOTUS_REDUCE_TOLERANCE)
            return fail(err, MOTUS_ARGUMENT, "record %zu names column %zu of %zu, or no reduction", r,
                        d->records[r].column, s->column_count);
    if ((unsigned)d->error > MOTUS_BARS_FULL)
        return fail(err, MOTUS_ARGUMENT, "there is no kind of bars %d", (int)d->error);
    if ((unsigned)d->switches > MOTUS_SWITCHES_USUAL)
        return fail(err, MOTUS_ARGUMENT, "there is no way to treat switches of number %d", (int)d->switches);
    if (d->every < 1)
        return fail(err, MOTUS_ARGUMENT, "observations are every 1, 2, … steps, not %lld", (long long)d->every);
    if (d->threads < 0 || d->threads > MOTUS_THREADS_MAX)
        return fail(err, MOTUS_ARGUMENT, "threads are 0 (as many as there are processors) to %d, not %d",
                    MOTUS_THREADS_MAX, d->threads);
    if (d->lanes < 0 || d->lanes > ENSEMBLE_LANES_MAX || (d->lanes & (d->lanes - 1)))
        return fail(err, MOTUS_ARGUMENT, "lanes are 0 (as many as suits) or a power of two up to %d, not %d",
                    ENSEMBLE_LANES_MAX, d->lanes);
    return MOTUS_OK;
}

static motus_status find_places(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    for (size_t k = 0; k < d->vary_count; k++) {
        bool twice = false;
        if (d->vary[k] && !strcmp(d->vary[k], "until")) {
            twice = e->until != SIZE_MAX;
            e->until = k;
        } else {
            size_t *place = &e->places[e->vary_count];
            motus_status status = ensemble_place(e->system, d->vary[k], place, err);
            if (status == MOTUS_OK && e->home)
                status = ensemble_place(e->home, d->vary[k], &e->home_places[e->vary_count], err);
            if (status != MOTUS_OK) return status;
            for (size_t i = 0; i < e->vary_count; i++) twice |= e->places[i] == *place;
            e->vary_count++;
        }
        if (twice) return fail(err, MOTUS_ARGUMENT, "%s varies twice", d->vary[k]);
    }
    if (e->until != SIZE_MAX && !isnan(d->until))
        return fail(err, MOTUS_ARGUMENT, "the end is %g, and varies: only one of them can hold", d->until);
    return MOTUS_OK;
}

/* Whether trajectories take different numbers of steps. */
static bool steps_differ(const motus_ensemble *e) { return e->until != SIZE_MAX || row_adaptive(&e->chosen); }

/* A recorded column as a source of lanes; false: lanes cannot record it. */
static bool source_of(const motus_system *s, const motus_record *r, lanes_source *out)
{
    motus_column c = motus_default_column();
    if (motus_column_at(s, r->column, &c) != MOTUS_OK) return false;
    *out = (lanes_source){.how = (int)r->how};
    switch (c.kind) {
    case MOTUS_COLUMN_TIME: out->kind = SOURCE_TIME; return true;
    case MOTUS_COLUMN_POSITION:
        out->kind = SOURCE_X;
        out->place = system_number(s, r->column - 1, false);
        return true;
    case MOTUS_COLUMN_VELOCITY:
    case MOTUS_COLUMN_FIRST_ORDER:
        out->kind = SOURCE_V;
        out->place = system_number(s, r->column - 1, true);
        return true;
    case MOTUS_COLUMN_QUANTITY:
    case MOTUS_COLUMN_INVARIANT:
        out->kind = SOURCE_DEFINITION;
        out->definition = system_definition(s, r->column, &out->place);
        return true;
    default: return false;
    }
}

/* What is recorded, as lanes see it: sources first, then what is told of steps. False: lanes cannot record it. */
static bool list_sources(const motus_ensemble *e, const motus_system *s, lanes_source *sources, lanes_tally *tallies,
                         lanes_def *def)
{
    for (size_t r = 0; r < e->record_count; r++) {
        const motus_record *record = &e->records[r];
        if (ensemble_tallies(record)) {
            tallies[def->tally_count++] = (lanes_tally){ensemble_tally(record), r};
            continue;
        }
        if (!source_of(s, record, &sources[def->source_count])) return false;
        sources[def->source_count++].result = r;
    }
    def->sources = sources;
    def->tallies = tallies;
    return true;
}

/* Makes lanes for a system of the ensemble where they can compute it; else *out stays NULL and e->note says why. */
static motus_status make_lanes(motus_ensemble *e, motus_system *s, const lanes_def *common, lanes **out,
                               motus_error *err)
{
    lanes_source *sources = arena_room(&s->arena, (e->record_count + 1) * sizeof *sources);
    lanes_tally *tallies = arena_room(&s->arena, (e->record_count + 1) * sizeof *tallies);
    if (!sources || !tallies) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    lanes_def def = *common;
    def.model = s->model;
    def.problem = &s->problem;
    if (!list_sources(e, s, sources, tallies, &def)) {
        snprintf(e->note, sizeof e->note, "the exact motion is recorded, one trajectory at a time");
        return MOTUS_OK;
    }
    for (size_t i = 0; s != e->system && i < def.source_count; i++) sources[i].how = REDUCE_FINAL;
    const char *why = lanes_refuse(&def);
    if (why) {
        snprintf(e->note, sizeof e->note, "%s", why);
        return MOTUS_OK;
    }
    motus_status status = lanes_create(&def, out, e->note, sizeof e->note, err);
    return status == MOTUS_TOOL ? MOTUS_OK : status;
}

/* The lanes of the companions, where errors are told. */
static motus_status join_half(motus_ensemble *e, const lanes_def *common, motus_error *err)
{
    const motus_system *s = e->system;
    const size_t state = s->positions + s->velocities;
    lanes_source *sources = arena_room(&e->system->arena, (state + 1) * sizeof *sources);
    if (!sources) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    motus_status status = ensemble_errors_half(e, err);
    lanes_def def = *common;
    def.chosen = &e->half_chosen;
    def.vary = e->half_vary;
    def.lanes = lanes_in_block(e->lanes);
    def.tallies = NULL;
    if (status == MOTUS_OK) status = make_lanes(e, e->half, &def, &e->half_lanes, err);
    if (status != MOTUS_OK || !e->half_lanes) return status;
    for (size_t k = 0; k < state; k++) source_of(s, &(motus_record){.column = k + 1}, &sources[k]);
    const differences_shape shape = ensemble_errors_shape(e);
    return lanes_join(e->lanes, e->half_lanes, &shape, sources, err);
}

void ensemble_end_lanes(motus_ensemble *e)
{
    ensemble_followed_destroy(e);
    lanes_destroy(e->lanes);
    lanes_destroy(e->half_lanes);
    e->lanes = e->half_lanes = NULL;
}

/* Lanes compute the trajectories that workers have left. */
static int report_lanes(void *context, double fraction)
{
    const motus_ensemble *e = context;
    const double before = (double)e->before / (double)e->count;
    return ensemble_report(context, before + fraction * (1 - before));
}

/* Whether what is recorded at the end has roundings of its own: of the end, or of the formula of a quantity. */
static bool rounds(const motus_ensemble *e)
{
    lanes_source source;
    if (e->until != SIZE_MAX || bars_end_rounding(e->timing.until, e->system, NULL) != 0) return true;
    for (size_t r = 0; r < e->record_count; r++)
        if (e->records[r].how == MOTUS_REDUCE_FINAL && !ensemble_tallies(&e->records[r]) &&
            source_of(e->system, &e->records[r], &source) && source.kind == SOURCE_DEFINITION)
            return true;
    return false;
}

/* Why errors are told one trajectory at a time, also where lanes compute what has none; NULL: lanes tell them. Of ends
 * that vary it is not known here how far from the start they are. */
static const char *told_singly(const motus_ensemble *e)
{
    const bool ends = e->until != SIZE_MAX;
    if (e->rules) return "events are followed one trajectory at a time where errors are told";
    if (e->error == MOTUS_BARS_FULL) return "trajectories have two companions: their errors are told one at a time";
    if (ends && !row_adaptive(&e->chosen))
        return "trajectories have their own ends: their errors are told one at a time";
    if (ends ? e->timing.t0 != 0 : run_starts_late(&e->timing))
        return "trajectories start late: their errors are told one at a time";
    for (size_t r = 0; r < e->record_count; r++)
        if (e->records[r].how == MOTUS_REDUCE_FINAL && !ensemble_tallies(&e->records[r]) &&
            system_jumps(e->system, e->records[r].column))
            return "a number that jumps is recorded: its errors are told one trajectory at a time";
    return NULL;
}

/* Chooses lanes where they can compute the ensemble; else e->lanes stays NULL and e->note says why. */
static motus_status try_lanes(motus_ensemble *e, const motus_ensemble_def *d, bool later, motus_error *err)
{
    const bool told = e->error != MOTUS_BARS_NONE, one = e->rules && e->system->allocator.allocate;
    const lanes_follower *follower = NULL;
    const char *const why = told ? told_singly(e) : NULL;
    if (why) {
        snprintf(e->note, sizeof e->note, "%s", why);
        return MOTUS_OK;
    }
    motus_status status = e->rules ? ensemble_followed_create(e, &follower, err) : MOTUS_OK;
    if (status != MOTUS_OK) return status;
    const lanes_def common = {.chosen = &e->chosen,
                              .vary = e->vary,
                              .places = e->places,
                              .place_count = e->vary_count,
                              .t0 = e->timing.t0,
                              .h = e->timing.h,
                              .last = e->timing.last,
                              .until = e->timing.until,
                              .whole = e->timing.whole,
                              .every = e->every,
                              .own_clock = steps_differ(e) || follower,
                              .lanes = d->lanes,
                              .threads = one ? 1 : e->threads, /* one thread alone calls the hooks */
                              .fast = d->fast != 0,
                              .follower = follower,
                              .later = later,
                              .allocator = &e->allocator,
                              .progress = e->progress ? report_lanes : NULL,
                              .rounding = told && rounds(e) ? ensemble_errors_rounding : NULL,
                              .context = e};
    status = make_lanes(e, e->system, &common, &e->lanes, err);
    if (!e->lanes) ensemble_followed_destroy(e);
    if (status != MOTUS_OK || !e->lanes || !told) return status;
    status = join_half(e, &common, err);
    if (!e->half_lanes) ensemble_end_lanes(e);
    return status;
}

/* Chooses one trajectory at a time, by the interpreter. */
static void choose_portable(motus_ensemble *e)
{
    e->machine = e->system->machine;
    if (e->system->allocator.allocate) e->threads = 1; /* only one thread at a time may call its hooks */
}

/* What lanes have refused they would refuse again. */
static void leave_lanes(motus_ensemble *e)
{
    ensemble_end_lanes(e);
    e->compiled_from = -1;
    choose_portable(e);
    snprintf(e->note, sizeof e->note, "whether the method admits a trajectory is examined one trajectory at a time");
}

motus_status ensemble_choose_single(motus_ensemble *e, const char *wanted, bool later, motus_error *err)
{
    motus_system *s = e->system;
    choose_portable(e);
    if (!s->model && s->callback.block && !e->rules)
        e->block = e->until == SIZE_MAX ? ensemble_block_size(s, &e->chosen) : 0;
    if (!s->model || (wanted && !strcmp(wanted, "interpreter"))) return MOTUS_OK;
    const char *why = "";
    compiled_state state = COMPILED_FAILED;
    e->chosen.varies = e->vary_count > 0;
    motus_status status =
        later ? choice_begin(s, &e->chosen, &state, &e->machine, &why, err)
              : choice_compile(s, &e->chosen, wanted && !strcmp(wanted, "compiled"), false, &e->machine, &why, err);
    if (status != MOTUS_OK) return status;
    if (later && state == COMPILED_WAIT) e->awaits = AWAITS_MACHINE;
    if (later ? state == COMPILED_FAILED : why != NULL) snprintf(e->note, sizeof e->note, "%s", why);
    return MOTUS_OK;
}

static motus_status make(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    motus_system *s = e->system;
    request q = request_of_ensemble(s, d);
    motus_status status = request_row(s, q.method, &e->chosen, &e->card, err);
    if (status == MOTUS_OK) status = system_rules(s, &e->rules, err);
    if (status == MOTUS_OK) status = ensemble_events_prepare(e, d, err);
    if (status == MOTUS_OK) status = find_places(e, d, err);
    if (status == MOTUS_OK && e->error != MOTUS_BARS_NONE) status = ensemble_errors_prepare(e, err);
    if (status == MOTUS_OK) status = request_choose(s, &q, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &q, err);
    const bool ends = e->until != SIZE_MAX; /* then each trajectory gets its own timing later */
    e->chosen = q.chosen;
    e->step = q.step;
    if (status == MOTUS_OK)
        status = run_timing(&e->chosen, e->step, ends ? s->start : q.until, s->start, &e->timing, err);
    if (status == MOTUS_OK && s->model)
        status =
            vary_create(s->model, e->places, e->vary_count, q.step_said == SAID_CALLER || q.step_said == SAID_SUGGESTED,
                        ends || q.until_said != SAID_MODEL, &e->vary, err);
    const char *wanted = d->machine;
    bool automatic = false, compiled = false;
    if (status == MOTUS_OK) status = choice_machine(wanted, &automatic, &compiled, err);
    if (status == MOTUS_OK && s->model && d->expected && automatic && !steps_differ(e) &&
        choice_worth(s, &e->chosen, e->card, (double)d->expected * (double)e->timing.total) < 1) {
        compiled = false;
        wanted = "interpreter";
    }
    /* with `fast` the bits depend on the machine */
    const bool later = automatic && !d->fast;
    if (e->rules && !(s->model && compiled))
        snprintf(e->note, sizeof e->note, "events are followed one trajectory at a time");
    if (status == MOTUS_OK && s->model && compiled) status = try_lanes(e, d, later, err);
    if (status != MOTUS_OK) return status;
    e->lane_threads = e->threads;
    if (!e->lanes) {
        status = ensemble_choose_single(e, wanted, later && compiled, err);
    } else if (lanes_awaited(e->lanes) || lanes_awaited(e->half_lanes)) {
        choose_portable(e);
        e->awaits = AWAITS_LANES;
    }
    e->compiled_from = !e->awaits && !strcmp(motus_ensemble_machine(e), "compiled") ? 0 : -1;
    return status;
}

/* The system whose steps end where a switch changes its side, by the rule of runs; NULL: the caller's own, and `why`
 * says why where switches could have been located. */
static motus_status locate(motus_system *s, const motus_ensemble_def *d, motus_system **out, const char **why,
                           motus_error *err)
{
    chosen c;
    const motus_method *card;
    *out = NULL;
    *why = "";
    const motus_switches asked = d->switches;
    const motus_status status = request_row(s, request_of_ensemble(s, d).method, &c, &card, err);
    if (status != MOTUS_OK) return status;
    if (asked == MOTUS_SWITCHES_RESOLVE) return fail(err, MOTUS_UNAVAILABLE, "an ensemble does not resolve switches");
    const motus_status found = located_for(s, &c, asked, out, why, err);
    const bool refused = asked == MOTUS_SWITCHES_LOCATE && !*out && s->model && located_kinks(s->model);
    if (found != MOTUS_OK || !refused || row_adaptive(&c)) return found;
    fail(err, MOTUS_UNAVAILABLE,
         "steps of one size in an ensemble do not locate switches beyond which the force may be "
         "undefined, and those of %s do not adapt",
         c.name);
    hint(err, "choose an adaptive method, dop853 or taylor, or leave `switches` of the definition out");
    return MOTUS_UNAVAILABLE;
}

motus_status motus_ensemble_create(motus_system *s, const motus_ensemble_def *given, motus_ensemble **out,
                                   motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_create needs a place for the ensemble");
    *out = NULL;
    if (!s || !given) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_create needs a system and a definition");
    motus_ensemble_def d;
    motus_status status = motus_struct_read(MOTUS_DEF_ENSEMBLE, given, &d, err);
    ensemble_goal *goal = NULL;
    if (status == MOTUS_OK) status = check(s, &d, err);
    if (status == MOTUS_OK) status = ensemble_accuracy_begin(s, &d, &goal, err);
    motus_system *own = s, *located = NULL;
    const char *why = "";
    if (status == MOTUS_OK) status = locate(s, &d, &located, &why, err);
    if (status != MOTUS_OK) {
        ensemble_accuracy_end(goal);
        return status;
    }
    if (located) s = located;
    motus_ensemble *e = take(&s->allocator, 1, sizeof *e);
    if (!e) {
        ensemble_accuracy_end(goal);
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    }
    *e = (motus_ensemble){.system = s,
                          .home = located ? own : NULL,
                          .not_located = why,
                          .goal = goal,
                          .allocator = s->allocator,
                          .every = d.every,
                          .given = d.vary_count,
                          .until = SIZE_MAX,
                          .step = d.step,
                          .record_count = d.record_count,
                          .error = d.error,
                          .tells_causes = d.causes != 0,
                          .threads = d.threads  ? d.threads
                                     : s->model ? parallel_processors()
                                                : 1,
                          .progress = d.progress,
                          .context = d.context};
    motus_system_hold(s, true);
    if (located) motus_system_hold(own, true);
    e->places = take(&s->allocator, d.vary_count + 1, sizeof *e->places);
    e->records = take(&s->allocator, d.record_count, sizeof *e->records);
    e->values = take(&s->allocator, d.vary_count + 1, sizeof *e->values);
    modes m = modes_enter();
    if (located) e->home_places = take(&s->allocator, d.vary_count + 1, sizeof *e->home_places);
    if (!e->places || !e->records || !e->values || (located && !e->home_places)) {
        status = fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    } else {
        memcpy(e->records, d.records, d.record_count * sizeof *e->records);
        status = make(e, &d, err);
    }
    modes_leave(m);
    if (status != MOTUS_OK) {
        motus_ensemble_destroy(e);
        return status;
    }
    *out = e;
    return MOTUS_OK;
}

motus_status ensemble_timing(const motus_ensemble *e, const places *p, size_t k, timing *t, motus_error *err)
{
    *t = e->timing;
    if (p->until && isnan(p->until[k])) return fail(err, MOTUS_ARGUMENT, "the end is not a number");
    return p->until ? run_timing(&e->chosen, e->step, p->until[k], e->system->start, t, err) : MOTUS_OK;
}

/* Checks all ends before anything is computed. */
static motus_status check_ends(const motus_ensemble *e, const places *p, size_t count, motus_error *err)
{
    for (size_t k = 0; p->until && k < count; k++) {
        timing t;
        motus_error why = motus_default_error();
        const motus_status status = ensemble_timing(e, p, k, &t, &why);
        if (status == MOTUS_OK) continue;
        fail(err, status, "until, value %zu of %zu: %s", k + 1, count, why.message);
        if (why.hint[0]) hint(err, "%s", why.hint);
        return status;
    }
    return MOTUS_OK;
}

/* Finds the arrays of values of a call, and that of the ends among them. */
static motus_status find_values(motus_ensemble *e, const double *const *values, places *p, motus_error *err)
{
    if (!e || (e->given && !values)) return fail(err, MOTUS_ARGUMENT, "an ensemble and values are needed");
    size_t places = 0;
    for (size_t k = 0; k < e->given; k++) {
        if (!values[k]) return fail(err, MOTUS_ARGUMENT, "the values of what varies, number %zu, are NULL", k);
        *(k == e->until ? &p->until : &e->values[places++]) = values[k];
    }
    p->values = e->values;
    return MOTUS_OK;
}

motus_status motus_ensemble_check(motus_ensemble *e, size_t count, const double *const *values, motus_error *err)
{
    places p = {0};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    motus_status status = find_values(e, values, &p, err);
    modes m = modes_enter();
    if (status == MOTUS_OK) status = check_ends(e, &p, count, err);
    modes_leave(m);
    return status;
}

motus_status motus_ensemble_pilots(motus_ensemble *e, size_t count, const double *const *values, motus_error *err)
{
    places p = {0};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    motus_status status = find_values(e, values, &p, err);
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    e->count = count;
    status = ensemble_witness_ask(e, &p, count, err);
    modes_leave(m);
    return status;
}

/* The trajectories from `first` on, by lanes. MOTUS_METHOD: as lanes_run. */
static motus_status in_lanes(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    const size_t records = e->record_count, count = e->vary_count + 2 * records;
    const double **values = take(&e->allocator, count + 1, sizeof *values);
    if (!values) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    double **results = (double **)(void *)(values + e->vary_count), **errors = results + records;
    for (size_t k = 0; k < e->vary_count; k++) values[k] = p->values[k] + first;
    for (size_t r = 0; r < records; r++) {
        results[r] = p->results[r] + first;
        errors[r] = p->errors ? p->errors[r] + first : NULL;
    }
    e->before = first;
    motus_status status = e->followed ? ensemble_followed_begin(e, p, first, err) : MOTUS_OK;
    if (status == MOTUS_OK)
        status = lanes_run(e->lanes, e->count - first, values, p->until ? p->until + first : NULL, results,
                           p->errors ? errors : NULL, p->stopped ? p->stopped + first : NULL, p->ends + first, err);
    give(&e->allocator, (void *)values);
    return status;
}

/* Lanes have no witness. */
static motus_status give_up_lanes(motus_ensemble *e, motus_error *err)
{
    ensemble_end_lanes(e);
    e->awaits = AWAITS_NOTHING;
    ensemble_workers_destroy(e);
    e->note[0] = 0;
    const motus_status status = ensemble_choose_single(e, NULL, true, err);
    const bool compiled = !e->awaits && !strcmp(motus_ensemble_machine(e), "compiled");
    e->compiled_from = compiled ? (int64_t)e->computed : -1;
    if (!e->note[0])
        snprintf(e->note, sizeof e->note,
                 "the force does within steps what they do not show: one trajectory at a time");
    return status;
}

static motus_status compute(motus_ensemble *e, const places *p, motus_error *err)
{
    size_t first = 0;
    motus_status status = ensemble_witness_first(e, p, err);
    if (status == MOTUS_OK && p->errors && e->looks && e->lanes) status = give_up_lanes(e, err);
    if (status != MOTUS_OK) return status;
    status = e->awaits ? ensemble_meanwhile(e, p, &first, err) : MOTUS_OK;
    if (status != MOTUS_OK || first == e->count) return status;
    if (e->lanes && !e->awaits) {
        status = in_lanes(e, p, first, err);
        if (status == MOTUS_OK) return ensemble_stopped_again(e, p, first, err);
        if (status != MOTUS_METHOD) return status;
        leave_lanes(e);
    }
    if (!e->block || p->errors) return ensemble_singly(e, p, first, err);
    status = ensemble_blocks(e, p, err);
    return status == MOTUS_OK ? ensemble_stopped_again(e, p, 0, err) : status;
}

motus_status ensemble_run_all(motus_ensemble *e, size_t count, const double *const *values, places p, motus_error *err)
{
    motus_status status = find_values(e, values, &p, err);
    if (status == MOTUS_OK && !p.results) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_run needs room for results");
    for (size_t r = 0; status == MOTUS_OK && r < e->record_count; r++)
        if (!p.results[r] || (p.errors && !p.errors[r]))
            status = fail(err, MOTUS_ARGUMENT, "the room for record %zu is NULL", r);
    if (status != MOTUS_OK || !count) return status;
    modes m = modes_enter();
    double began = pace_now();
    for (size_t r = 0; r < e->record_count; r++)
        p.observes |= e->records[r].how != MOTUS_REDUCE_FINAL && !ensemble_tallies(&e->records[r]);
    e->count = count;
    status = check_ends(e, &p, count, err);
    e->fraction = 0;
    if (status == MOTUS_OK) status = ensemble_events_begin(e, count, err);
    if (status == MOTUS_OK) status = ensemble_ended_begin(e, count, err);
    if (status == MOTUS_OK) status = ensemble_stopped_begin(e, count, &p, err);
    if (status == MOTUS_OK) status = compute(e, &p, err);
    ensemble_stopped_finish(e);
    e->computed += count;
    e->seconds += pace_now() - began;
    modes_leave(m);
    return status;
}

static motus_status run(motus_ensemble *e, size_t count, const double *const *values, const places *p, motus_error *err)
{
    return e && e->goal ? ensemble_accuracy_run(e, count, values, p, err) : ensemble_run_all(e, count, values, *p, err);
}

motus_status motus_ensemble_run(motus_ensemble *e, size_t count, const double *const *values, double *const *results,
                                double *stopped, motus_error *err)
{
    const places p = {.results = results, .stopped = stopped};
    return motus_error_sound(err) ? run(e, count, values, &p, err) : MOTUS_ARGUMENT;
}

motus_status motus_ensemble_run_errors(motus_ensemble *e, size_t count, const double *const *values,
                                       double *const *results, double *const *errors, double *stopped, motus_error *err)
{
    const places p = {.results = results, .errors = errors, .stopped = stopped};
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!errors) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_run_errors needs room for errors");
    if (e && (e->goal ? !ensemble_accuracy_told(e->goal) : e->error == MOTUS_BARS_NONE)) {
        fail(err, MOTUS_ARGUMENT, "the ensemble tells no errors");
        hint(err, "give `error = MOTUS_BARS_CHEAP` of the definition");
        return MOTUS_ARGUMENT;
    }
    return run(e, count, values, &p, err);
}

void motus_ensemble_destroy(motus_ensemble *e)
{
    if (!e) return;
    motus_allocator a = e->allocator;
    ensemble_accuracy_end(e->goal);
    ensemble_later_end(e);
    motus_system_hold(e->system, false);
    if (e->home) motus_system_hold(e->home, false);
    ensemble_end_lanes(e);
    ensemble_workers_destroy(e);
    ensemble_events_end(e);
    ensemble_stopped_end(e);
    ensemble_ended_end(e);
    motus_system_destroy(e->half);
    give(&a, e->places);
    give(&a, e->home_places);
    give(&a, e->records);
    give(&a, (void *)e->values);
    give(&a, e->compared_columns);
    give(&a, e->compared_record);
    give(&a, e->how);
    give(&a, e);
}

int64_t motus_ensemble_steps(const motus_ensemble *e) { return !e || steps_differ(e) ? 0 : e->timing.total; }
double motus_ensemble_step_work(motus_ensemble *e)
{
    weight w;
    if (!e || choice_weigh(e->system, &w, NULL) != MOTUS_OK) return NAN;
    return choice_step(&e->system->problem, &w, &e->chosen, e->card);
}
const char *motus_ensemble_method(const motus_ensemble *e) { return e ? e->chosen.name : ""; }
double motus_ensemble_tolerance(const motus_ensemble *e, int *absolute)
{
    const chosen *c = e ? &e->chosen : NULL;
    if (absolute) *absolute = c && c->absolute > 0;
    return c ? tally_tolerance(c) : NAN;
}
const char *motus_ensemble_machine(const motus_ensemble *e)
{
    return !e ? "" : e->lanes && e->awaits != AWAITS_LANES ? "compiled" : e->machine.name;
}
const char *motus_ensemble_note(const motus_ensemble *e) { return e ? e->note : ""; }
int motus_ensemble_lanes(const motus_ensemble *e)
{
    return e && e->lanes && e->awaits != AWAITS_LANES ? lanes_in_block(e->lanes) : 1;
}
motus_switches motus_ensemble_switches(const motus_ensemble *e)
{
    if (!e || !e->system->model) return MOTUS_SWITCHES_USUAL;
    if (system_located(e->system)) return MOTUS_SWITCHES_LOCATE;
    return located_kinks(e->system->model) ? MOTUS_SWITCHES_STEP : MOTUS_SWITCHES_USUAL;
}

const char *motus_ensemble_not_located(const motus_ensemble *e) { return e ? e->not_located : ""; }

int64_t motus_ensemble_compiled_from(const motus_ensemble *e) { return e ? e->compiled_from : -1; }
int motus_ensemble_threads(const motus_ensemble *e) { return e ? e->threads : 1; }
double motus_ensemble_seconds(const motus_ensemble *e) { return e ? e->seconds : 0; }
