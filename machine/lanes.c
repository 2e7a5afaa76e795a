/* Lanes: which ensembles they admit, their text, their object. See lanes.h.
 *
 * Invariant: the text depends on the model, the row, which numbers vary and which are recorded, but not on how many
 * trajectories or threads there are.
 */
#include "machine/lanes_parts.h"

#include "lang/graph/expansion.h"
#include "machine/cache.h"
#include "machine/least.h"
#include "machine/solve_text.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* operations in one step of all groups; of an elementary function; of an observed quantity. Of an implicit row,
 * unknowns in one iteration of all groups, and those groups */
enum { STEPS_WRITTEN_MAX = 600, FUNCTION_WEIGHT = 40, OBSERVED_WEIGHT = 30 };
enum { UNKNOWNS_WRITTEN_MAX = 6, TURNS_WRITTEN_MAX = 4 };
enum { OBSERVED_MAX = 32, RECORDS_WRITTEN_MAX = 12, BLOCK_BYTES = 4 << 20 };

/* ---- the shape ---- */

/* Returns how many groups a block has. Several short chains of operations hide each other's latency; a long step has
 * independent operations of its own, and several of them would take the compiler too long. */
static int best_groups(const lanes_def *d, const work *plan)
{
    const graph *g = d->model->graph;
    const bool by_turns = plan->solves && plan->iterates;
    if (plan->expands) return 1;                              /* its sums are many, and independent of one another */
    if (plan->solves && !by_turns && !plan->linear) return 1; /* a step of several iterations is long */
    size_t operations = 4 * d->model->nv;
    /* values of time alone come from the table, except with own clocks */
    const unsigned counted = d->own_clock ? DEP_STATE | DEP_TIME : DEP_STATE;
    for (uint32_t k = 0; k < g->count; k++)
        operations += !(g->nodes[k].deps & counted) ? 0 : g->nodes[k].op >= OP_POW ? FUNCTION_WEIGHT : 1;
    for (size_t k = 0; k < d->source_count; k++)
        operations += d->sources[k].how == REDUCE_FINAL         ? 0
                      : d->sources[k].kind == SOURCE_DEFINITION ? OBSERVED_WEIGHT
                                                                : 4;
    const size_t step = (size_t)(plan->stages - plan->fsal) * operations;
    size_t groups = STEPS_WRITTEN_MAX / (step + 1);
    const size_t unknowns = (size_t)plan->solves * d->model->nv;
    if (by_turns && !plan->direct && unknowns > 0) { /* an iteration also judges every unknown */
        const size_t most = UNKNOWNS_WRITTEN_MAX / unknowns;
        groups = groups < most ? groups : most;
        groups = groups < TURNS_WRITTEN_MAX ? groups : TURNS_WRITTEN_MAX;
    }
    return groups < 1 ? 1 : groups > GROUPS_MAX ? GROUPS_MAX : (int)groups;
}

/* Returns why lanes cannot take the steps between events, or NULL. */
static const char *refuse_events(const lanes_def *d)
{
    const model *m = d->model;
    if (m->located)
        return "switches are located, one trajectory at a time; `switches = step` of the definition leads across them, "
               "in lanes";
    if (!row_watched(d->chosen) && !row_bounded_by_ends(d->chosen))
        return "events are followed one trajectory at a time by this method; in lanes by Taylor series, by explicit "
               "Runge-Kutta methods, and by explicit ones of one step size";
    if (m->rule_functions == 0) return "clocks without other events are followed one trajectory at a time";
    if (!compose_bounds_are_structure(m)) return "events of families are followed one trajectory at a time";
    if (!least_bounded(m)) return "events that depend on the time are followed one trajectory at a time";
    for (size_t k = 0; k < d->source_count; k++)
        if (d->sources[k].how != REDUCE_FINAL)
            return "what is recorded on the way of trajectories with events is recorded one trajectory at a time";
    for (size_t k = 0; k < d->tally_count; k++)
        if (d->tallies[k].which == TALLY_EVALUATIONS)
            return "the evaluations of trajectories with events are counted one trajectory at a time";
    return NULL;
}

const char *lanes_refuse(const lanes_def *d)
{
    const char *why = d->follower ? refuse_events(d) : NULL;
    if (why) return why;
    if (row_formula(d->chosen)) return "the exact motion is computed one trajectory at a time";
    if (!solve_text_admits(d->model, d->problem, d->chosen))
        return "this method solves equations of a family, or of many unknowns, one trajectory at a time";
    const bool steps = !d->own_clock && (d->whole > 0 || d->last != 0);
    if (d->chosen->row->gyroscopic && (!d->problem->traits.constant_jv || !steps))
        return "whether the velocity term does no work depends on the state: trajectories are computed one at a time";
    if ((d->model->pool_count + 8 * d->model->nv) * sizeof(double) * 8 > BLOCK_BYTES)
        return "the model is large: its trajectories are computed one at a time";
    if (d->model->graph->count > OPERATIONS_MAX)
        return "the equations are too long for a compiler: trajectories are computed one at a time";
    const work plan = stepper_plan(d->problem, d->chosen, NULL);
    if (plan.solves && (row_adaptive(d->chosen) || (d->chosen->row->gyroscopic && plan.stages > 2)))
        return "the matrix changes from step to step, or within one: trajectories are computed one at a time";
    for (size_t k = 0; k < d->tally_count; k++)
        if (d->tallies[k].which == TALLY_EVALUATIONS && !tally_evaluations(&plan, &(tally){0}))
            return "the evaluations of this method are counted one trajectory at a time";
    uint32_t count;
    const vary_active *active = vary_entries(d->vary, &count);
    for (uint32_t k = 0; k < count; k++)
        if (active[k].entry->table) return "the numbers of a table vary: trajectories are computed one at a time";
    for (uint32_t k = 0; k < count; k++)
        if (active[k].entry->map) return "initial values of a family vary: trajectories are computed one at a time";
    return NULL;
}

/* ---- the text ---- */

typedef struct observed {
    const model_definition *definition;
    size_t first;
} observed;

static size_t list_observed(const lanes_def *d, observed list[OBSERVED_MAX], size_t *outs)
{
    size_t count = 0;
    *outs = 0;
    for (size_t i = 0; i < d->source_count; i++) {
        const lanes_source *s = &d->sources[i];
        bool known = s->kind != SOURCE_DEFINITION;
        for (size_t k = 0; k < count; k++) known |= s->definition == list[k].definition;
        if (known) continue;
        if (count == OBSERVED_MAX) return SIZE_MAX;
        list[count++] = (observed){s->definition, *outs};
        *outs += s->definition->numbers;
    }
    return count;
}

/* Tells where a source is found. */
static lanes_record place_of(const lanes_source *s, const observed *quantities, size_t observed_count)
{
    static const int from[] = {
        [SOURCE_TIME] = LANES_TIME, [SOURCE_X] = LANES_X, [SOURCE_V] = LANES_V, [SOURCE_DEFINITION] = LANES_OUT};
    size_t first = 0;
    for (size_t k = 0; k < observed_count; k++)
        if (s->kind == SOURCE_DEFINITION && quantities[k].definition == s->definition) first = quantities[k].first;
    return (lanes_record){.how = s->how, .from = from[s->kind], .element = (whole)(first + s->place)};
}

#define CALL "(host->pool, host->q, host->u, host->bound, host->own, "

/* Writes the table of records. */
static void write_records(emit_text *t, const lanes_def *d, const observed *quantities, size_t observed_count)
{
    bool observing = false, velocity = false;
    emit_add(t, "static const lanes_record the_records[] = {");
    for (size_t i = 0; i < d->source_count; i++) {
        const lanes_source *s = &d->sources[i];
        const lanes_record place = place_of(s, quantities, observed_count);
        emit_add(t, "%s{%d, %d, %lld}", i ? ", " : "", place.how, place.from, (long long)place.element);
        observing |= s->how != REDUCE_FINAL;
        velocity |= s->how != REDUCE_FINAL && (s->kind == SOURCE_V || s->kind == SOURCE_DEFINITION);
    }
    if (!d->source_count) emit_add(t, "{0, 0, 0}");
    emit_add(t,
             "};\n#define RECORDS ((size_t)%zu)\n#define LOOKING %d\n#define SEES_VELOCITY %d\n#define "
             "WRITTEN_OUT_RECORDS%s\n",
             d->source_count, observing, velocity, d->source_count > RECORDS_WRITTEN_MAX ? "" : " WRITTEN_OUT");
}

/* Writes the functions that call all programs of one kind. */
static char *write_glue(lanes *l, const composed_program *along, size_t entries, const observed *quantities,
                        size_t observed_count)
{
    emit_text t = {.arena = l->def.model->arena};
    const bool bounded = l->def.model->boundary_count > 0;
    write_records(&t, &l->def, quantities, observed_count);
    emit_add(&t,
             "static inline void lanes_bind(const double *pool, const int64_t *q, double *u)\n{\n    "
             "compiled_force_bind(pool, q, u);\n%s",
             bounded ? "    compiled_boundary_bind(pool, q, u);\n" : "");
    for (const composed_program *p = along; p->name; p++) emit_add(&t, "    %s_bind(pool, q, u);\n", p->name);
    for (size_t k = 0; k < entries; k++) emit_add(&t, "    start_%zu_bind(pool, q, u);\n", k);
    for (size_t k = 0; k < observed_count; k++) emit_add(&t, "    quantity_%zu_bind(pool, q, u);\n", k);
    emit_add(&t, "}\nstatic inline void lanes_start(const lanes_job *job, const compiled_host *host, const real "
                 "*values)\n{\n    (void)host;\n");
    for (size_t k = 0; k <= entries; k++) {
        emit_add(&t, "    for (whole k = 0; k < job->value_count; k++) host->own[job->places[k]] = values[k];\n");
        if (k < entries)
            emit_add(
                &t,
                "    start_%zu_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n    start_%zu" CALL
                "(clock){0}, (const clock *)0, (real *)0, (real *)0, (real *)0, host->own);\n",
                k, k);
    }
    emit_add(&t,
             "}\n\nstatic inline void lanes_bind_lanes(const compiled_host *host)\n{\n"
             "    compiled_force_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n%s",
             bounded ? "    compiled_boundary_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n"
                     : "");
    for (const composed_program *p = along; p->name; p++)
        emit_add(&t, "    %s_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n", p->name);
    for (size_t k = 0; k < observed_count; k++)
        emit_add(&t, "    quantity_%zu_bind_lanes(host->pool, host->q, host->u, host->own, host->bound);\n", k);
    emit_add(&t,
             "}\n\nstatic inline void lanes_quantities(const compiled_host *host, clock t, real *x, real *v, real *a, "
             "real *out)\n{\n"
             "    (void)host, (void)t, (void)x, (void)v, (void)a, (void)out;\n");
    for (size_t k = 0; k < observed_count; k++)
        emit_add(&t, "    quantity_%zu" CALL "t, (const clock *)0, x, v, a, out + %zu);\n", k, quantities[k].first);
    emit_add(&t, "}\n\n");
    return l->def.model->arena->failed ? NULL : t.bytes;
}

enum { PROGRAM_NAME = 32 };

static bool write_text(lanes *l)
{
    const lanes_def *d = &l->def;
    model *m = d->model;
    uint32_t entries;
    const vary_active *active = vary_entries(d->vary, &entries);
    observed quantities[OBSERVED_MAX];
    const size_t observed_count = list_observed(d, quantities, &l->outs), count = 5 + entries + observed_count;
    composed_program *programs = arena_room(m->arena, count * sizeof *programs);
    char *names = arena_room(m->arena, count * PROGRAM_NAME);
    if (!programs || !names) return false;
    size_t n = 0;
    programs[n++] = (composed_program){.program = program_create(m->graph, m->accel, m->accel_count),
                                       .name = "compiled_force",
                                       .terms = !d->own_clock};
    composed_program along[4] = {{0}};
    size_t alongs = solve_text_programs(m, d->problem, d->chosen, along);
    if (l->plan.expands) {
        along[0] = (composed_program){.program = expansion_program(m->arena, m->graph, m->accel, m->accel_count),
                                      .name = "compiled_series",
                                      .series = true};
        if (m->driven)
            along[1] =
                (composed_program){.program = expansion_program(m->arena, m->graph, m->boundary, m->boundary_count),
                                   .name = "compiled_boundary_series",
                                   .series = true};
        alongs = m->driven ? 2 : 1;
    }
    if (d->follower) {
        size_t functions;
        const output *least = least_sizes(m, &functions);
        if (!least) return false;
        along[alongs++] = (composed_program){
            .program = program_create(m->graph, least, functions), .name = "compiled_least", .along = true};
    }
    for (size_t k = 0; k < alongs; k++) programs[n++] = along[k];
    if (m->boundary_count)
        programs[n++] = (composed_program){.program = program_create(m->graph, m->boundary, m->boundary_count),
                                           .name = "compiled_boundary"};
    for (uint32_t k = 0; k < entries; k++) {
        snprintf(names + n * PROGRAM_NAME, PROGRAM_NAME, "start_%u", k);
        programs[n] = (composed_program){.program = active[k].program, .name = names + n * PROGRAM_NAME};
        n++;
    }
    for (size_t k = 0; k < observed_count; k++) {
        const model_definition *definition = quantities[k].definition;
        for (size_t i = 0; i < definition->output_count; i++)
            l->needs_a |= (graph_deps(m->graph, definition->outputs[i].value) & DEP_A) != 0;
        snprintf(names + n * PROGRAM_NAME, PROGRAM_NAME, "quantity_%zu", k);
        programs[n] =
            (composed_program){.program = program_create(m->graph, definition->outputs, definition->output_count),
                               .name = names + n * PROGRAM_NAME};
        n++;
    }
    static const char *const last[] = {"machine/text/lanes_ways.h", "step/observe.h", "machine/text/reduce.h",
                                       "machine/text/lanes.h", NULL};
    l->e = (emit){.text = {.arena = m->arena},
                  .lanes = true,
                  .own_time = d->own_clock,
                  .varied = d->place_count ? vary_affected(d->vary) : NULL};
    const composition c = {.model = m,
                           .problem = d->problem,
                           .chosen = d->chosen,
                           .programs = programs,
                           .program_count = n,
                           .own_clock = d->own_clock,
                           .width = l->width,
                           .solves = l->plan.solves > 0,
                           .bounds = d->follower != NULL,
                           .groups = l->groups,
                           .glue = write_glue(l, along, entries, quantities, observed_count),
                           .last = last};
    if (m->arena->failed || !compose(&l->e, &c)) return false;
    return true;
}

int lanes_in_block(const lanes *l) { return l->block; }

/* ---- memory ---- */

/* Lists the places of the pool of which every lane has its own: those that depend on what varies, and all places of an
 * array that has one. False: no memory. */
static bool find_reads(lanes *l)
{
    const model *m = l->def.model;
    if (l->def.place_count == 0) return true;
    const uint8_t *affected = vary_affected(l->def.vary);
    uint8_t *marks = arena_room(m->arena, m->pool_count + 1);
    l->read = arena_room(m->arena, (m->pool_count + 1) * sizeof *l->read);
    if (!marks || !l->read) return false;
    memcpy(marks, affected, m->pool_count);
    for (uint32_t i = 0; i < m->array_count; i++) {
        const array *a = &m->arrays[i];
        if (a->space != SPACE_POOL || !graph_marked(a, affected)) continue;
        size_t last = a->base;
        for (int d = 0; d < a->dims; d++) last += (size_t)((a->over->last[d] - a->over->first[d]) * a->over->stride[d]);
        memset(marks + a->base, 1, last - a->base + 1);
    }
    for (size_t k = 0; k < m->pool_count; k++)
        if (marks[k]) l->read[l->reads++] = k;
    return true;
}

static bool prepare(lanes *l)
{
    const lanes_def *d = &l->def;
    model *m = d->model;
    arena *a = m->arena;
    l->q = arena_room(a, (l->e.int_count + 1) * sizeof *l->q);
    l->u = arena_room(a, (l->e.fixed + 1) * sizeof *l->u);
    l->places = arena_room(a, (d->place_count + 1) * sizeof *l->places);
    l->from_x = arena_room(a, (m->nx + 1) * sizeof *l->from_x);
    l->from_v = arena_room(a, (m->nv + 1) * sizeof *l->from_v);
    if (a->failed || !find_reads(l)) return false;
    for (uint32_t k = 0; k < l->e.int_count; k++) l->q[k] = emit_int_value(&l->e.ints[k], m->arrays, m->ints);
    l->bind(m->pool, l->q, l->u);
    for (size_t k = 0; k < d->place_count; k++) l->places[k] = (int64_t)d->places[k];
    const uint8_t *affected = vary_affected(d->vary);
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) {
        const model_state *s = &m->states[i];
        size_t numbers = s->hull * (size_t)(s->components ? s->components : 1);
        for (size_t k = 0; k < numbers; k++) {
            size_t first = m->arrays[s->start_array[0]].base + k,
                   second = s->order == 2 ? m->arrays[s->start_array[1]].base + k : first;
            if (s->order == 2) l->from_x[s->base + k] = affected[first] ? (int64_t)first : -1;
            l->from_v[s->base + k] = affected[second] ? (int64_t)second : -1;
        }
    }
    l->carried = stepper_carried(l->plan) * m->nv;
    l->own_size = lines(l, d->place_count ? m->pool_count : 0);
    l->bound_size = lines(l, l->e.fixed_lanes);
    l->carry_size = lines(l, l->carried);
    l->kept_size = lines(l, d->source_count * REDUCE_KEPT);
    l->clock_size = d->own_clock ? lines(l, LANES_CLOCKS) : 0;
    l->known_size = l->plan.carried ? lines(l, m->nv) + lines(l, 1) : 0;
    l->work_size = lines(l, stepper_arrays(l->plan) * m->nv);
    const size_t ends =
        l->plan.carried ? 0 : 2 * (m->nx + 2 * m->nv); /* of the latest step, where steps have one size */
    if (d->follower) l->watch_size = lines(l, m->nv) + lines(l, m->nx + m->nv) + lines(l, ends) + lines(l, 1);
    l->solve_size =
        (l->solving * (size_t)l->groups + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT / sizeof(double) + lines(l, 1);
    l->observed_size = lines(l, m->nx + m->nv + m->nv + l->outs);
    return true;
}

motus_status lanes_create(const lanes_def *d, lanes **out, char *note, size_t size, motus_error *err)
{
    model *m = d->model;
    observed quantities[OBSERVED_MAX];
    size_t outs;
    lanes *l = arena_take(m->arena, sizeof *l);
    if (m->arena->failed) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    *l = (lanes){.def = *d, .width = compose_width()};
    for (size_t r = 0; r < d->source_count; r++) l->on_the_way |= d->sources[r].how != REDUCE_FINAL;
    if (list_observed(d, quantities, &outs) == SIZE_MAX) {
        snprintf(note, size, "more than %d quantities are recorded", OBSERVED_MAX);
        return MOTUS_TOOL;
    }
    l->plan = stepper_plan(d->problem, d->chosen, NULL);
    coef *constants = arena_room(m->arena, (work_plan_size(&l->plan) + 1) * sizeof *constants);
    if (!constants) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    l->plan = stepper_plan(d->problem, d->chosen, constants);
    if (d->lanes && d->lanes < l->width) l->width = d->lanes;
    l->groups = d->lanes ? d->lanes / l->width : best_groups(d, &l->plan);
    l->block = l->width * l->groups;
    if (!write_text(l)) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    const int how = d->fast ? COMPILER_FAST : 0;
    l->awaited = true;
    if (!d->later)
        l->handle = cache_load(l->e.text.bytes, l->e.text.length, how, note, size);
    else if (cache_begin(l->e.text.bytes, l->e.text.length, how, d->allocator, &l->job, &l->handle, note, size) ==
             CACHE_WAIT)
        return *out = l, MOTUS_OK;
    motus_status status = lanes_ready(l, note, size, err);
    if (status == MOTUS_OK) *out = l;
    return status;
}

bool lanes_awaited(const lanes *l) { return l && l->awaited; }

bool lanes_look(lanes *l)
{
    if (l->job && cache_look(&l->job, &l->handle, l->why, sizeof l->why) == CACHE_WAIT) return false;
    return true;
}

motus_status lanes_ready(lanes *l, char *note, size_t size, motus_error *err)
{
    if (!l->handle) {
        if (l->why[0]) snprintf(note, size, "%s", l->why);
        return MOTUS_TOOL;
    }
    /* POSIX lets a void * hold the address of a function. */
    *(void **)&l->bind = dlsym(l->handle, "motus_lanes_bind");
    *(void **)&l->table = dlsym(l->handle, "motus_lanes_table");
    *(void **)&l->begin = dlsym(l->handle, "motus_lanes_begin");
    *(void **)&l->set = dlsym(l->handle, "motus_lanes_set");
    *(void **)&l->first = dlsym(l->handle, "motus_lanes_first");
    *(void **)&l->observe = dlsym(l->handle, "motus_lanes_observe");
    *(void **)&l->run = dlsym(l->handle, "motus_lanes_run");
    *(void **)&l->far = dlsym(l->handle, "motus_lanes_far");
    const size_t *solving = dlsym(l->handle, "motus_lanes_solving");
    if (!solving || !l->bind || !l->table || !l->begin || !l->set || !l->first || !l->observe || !l->run || !l->far) {
        snprintf(note, size, "the compiled object is not what was compiled");
        lanes_destroy(l);
        return MOTUS_TOOL;
    }
    l->solving = *solving;
    if (!prepare(l)) {
        lanes_destroy(l);
        return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    }
    l->awaited = false;
    return MOTUS_OK;
}

void lanes_destroy(lanes *l)
{
    if (!l) return;
    cache_stop(l->job);
    if (l->handle) dlclose(l->handle);
    l->job = NULL;
    l->handle = NULL;
}

motus_status lanes_join(lanes *l, lanes *half, const differences_shape *shape, const lanes_source *state,
                        motus_error *err)
{
    observed quantities[OBSERVED_MAX];
    size_t outs;
    const size_t observed_count = list_observed(&l->def, quantities, &outs), first = shape->count - l->def.source_count;
    l->half = half;
    l->shape = *shape;
    l->compared = arena_take(l->def.model->arena, shape->count * sizeof *l->compared);
    if (!l->compared) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    for (size_t k = 0; k < shape->count; k++) {
        const lanes_source *s = k >= first ? &l->def.sources[k - first] : k ? &state[k - 1] : NULL;
        l->compared[k] = s ? place_of(s, quantities, observed_count) : (lanes_record){.from = LANES_TIME};
    }
    return MOTUS_OK;
}
