/* The lanes of an ensemble: what they have to compute, or why they cannot. See ensemble.h. */
#include "api/error/bars.h"
#include "api/ensemble/ensemble.h"
#include "machine/reduction.h"

#include <stdio.h>

_Static_assert((int)REDUCE_MEAN == (int)MOTUS_REDUCE_MEAN && (int)REDUCE_TIME_OF_MAX == (int)MOTUS_REDUCE_TIME_OF_MAX,
               "the reductions are the same list");

/* Makes a recorded column a source of lanes. False: lanes cannot record it. */
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

/* Lists what is recorded: sources, and tallies of steps. False: lanes cannot record it. */
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

/* Makes lanes for a system of the ensemble if they can compute it; else *out stays NULL, and e->note says why. */
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

/* Makes the lanes of companions. */
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

void ensemble_lanes_end(motus_ensemble *e)
{
    ensemble_followed_destroy(e);
    lanes_destroy(e->lanes);
    lanes_destroy(e->half_lanes);
    e->lanes = e->half_lanes = NULL;
}

/* Reports progress of the trajectories that workers have left to lanes. */
static int report_lanes(void *context, double fraction)
{
    const motus_ensemble *e = context;
    const double before = (double)e->before / (double)e->count;
    return ensemble_report(context, before + fraction * (1 - before));
}

static void note_left(void *context, size_t trajectory, int how)
{
    const motus_ensemble *e = context;
    e->outcomes[e->before + trajectory].left = (unsigned char)how;
}

/* Returns whether a number that is recorded at the end has roundings of its own: of the end, or of a quantity's
 * formula. */
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

/* Returns why errors are found one trajectory at a time although lanes could compute the trajectories; NULL: lanes find
 * them. How far from the start ends lie that vary is not known here. */
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

motus_status ensemble_lanes_make(motus_ensemble *e, const motus_ensemble_def *d, bool later, motus_error *err)
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
                              .own_clock = ensemble_steps_differ(e) || follower,
                              .lanes = d->lanes,
                              .threads = one ? 1 : e->threads, /* one thread alone calls the hooks */
                              .fast = d->fast != 0,
                              .follower = follower,
                              .later = later,
                              .allocator = &e->allocator,
                              .progress = e->progress ? report_lanes : NULL,
                              .left = note_left,
                              .rounding = told && rounds(e) ? ensemble_errors_rounding : NULL,
                              .context = e};
    status = make_lanes(e, e->system, &common, &e->lanes, err);
    if (!e->lanes) ensemble_followed_destroy(e);
    if (status != MOTUS_OK || !e->lanes || !told) return status;
    status = join_half(e, &common, err);
    if (!e->half_lanes) ensemble_lanes_end(e);
    return status;
}

motus_status ensemble_lanes_run(motus_ensemble *e, const places *p, size_t first, motus_error *err)
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
                           p->errors ? errors : NULL, p->stopped ? p->stopped + first : NULL, err);
    give(&e->allocator, (void *)values);
    return status;
}
