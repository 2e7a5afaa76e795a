/* Restart states: everything that the next step needs, as text with hexadecimal numbers, exact to the bit.
 *
 *     motus-state 1
 *     system 9f3c…            hash of equations, parameters and boundary lines
 *     method verlet
 *     start 0x0p+0
 *     step 0x1.0624dd2f1a9fcp-10
 *     at 50000 50001 0        steps, evaluations, iterations
 *     carry 2
 *     -0x1.a35…
 *     …
 *     events 90               of a system with events: core/events_state.c; numbers may be nan or inf
 *     0x1.8…
 *     …
 *     bars 40                 the companion of the run, if it has bars: api/error/bars_kept.c
 *     0x1.a36…
 *     …
 *     end 51b0…               hash of all the bytes before, so that a changed byte is found
 */
#include "api/search/goal.h"
#include "api/error/bars.h"
#include "api/motion/run_events.h"
#include "api/system/columns.h"

#include "base/decimal.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_ROOM = 32, HEAD_ROOM = 512, EXPONENT_MAX = 1100 };

#define MIX_START UINT64_C(0xCBF29CE484222325)
static uint64_t mix(uint64_t h, const void *bytes, size_t n) /* FNV-1a */
{
    const unsigned char *p = bytes;
    for (size_t i = 0; i < n; i++) h = (h ^ p[i]) * 0x100000001B3u;
    return h;
}

static uint64_t mix_number(uint64_t h, int64_t n) { return mix(h, &n, sizeof n); }

static uint64_t mix_subscript(uint64_t h, const subscript *s)
{
    return mix_number(mix_number(mix_number(mix_number(h, s->level), s->slot), s->modulus), s->literal);
}

static uint64_t mix_range(uint64_t h, const range *r) { return mix_subscript(mix_subscript(h, &r->first), &r->last); }

static uint64_t mix_array(uint64_t h, const array *a) { return mix_number(mix_number(h, a->space), (int64_t)a->base); }

/* Hashes where a number lies: a reference, and its array. */
static uint64_t mix_reference(uint64_t h, const model *m, const reference *r)
{
    static const extent none = {{0}, {0}, {0}}; /* leaves of derivatives have no place */
    const array *a = &m->arrays[r->array];
    const extent *over = a->over ? a->over : &none;
    h = mix_array(h, a);
    for (int d = 0; d < r->dims; d++) {
        h = mix_number(mix_number(mix_number(h, over->first[d]), over->last[d]), over->stride[d]);
        h = mix_subscript(h, &r->at[d]);
    }
    return h;
}

static uint64_t mix_outputs(uint64_t h, const model *m, const output *o, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        h = mix_reference(mix_number(h, o[i].value), m, &o[i].to);
        for (int k = 0; k < o[i].loops; k++) h = mix_range(h, &o[i].loop[k]);
    }
    return h;
}

static node last_of(const output *o, size_t count, node last)
{
    for (size_t i = 0; i < count; i++) last = o[i].value > last ? o[i].value : last;
    return last;
}

static uint64_t mix_nodes(uint64_t h, const model *m, node from, node last)
{
    for (node n = from; n <= last; n++) {
        const graph_node *g = graph_at(m->graph, n);
        const bool number = g->op == OP_CONST;
        const uint32_t parts[4] = {g->op, g->a, number ? 0 : g->b, number ? 0 : g->c};
        const double value = number ? g->value : 0;
        h = mix(mix(h, parts, sizeof parts), &value, sizeof value);
        if (g->op == OP_LOAD) h = mix_reference(h, m, &m->graph->references[g->a]);
        if (g->op == OP_TABLE) h = mix_array(h, &m->arrays[g->a]);
        if (g->op == OP_SUM) h = mix_range(h, &m->graph->ranges[g->c]);
    }
    return h;
}

/* Hashes what rules of models and of callbacks have in common. */
static uint64_t mix_rules(uint64_t h, const rules *r)
{
    h = mix_number(h, (int64_t)r->count);
    for (size_t k = 0; k < r->count; k++) {
        const rule *one = &r->rule[k];
        const int64_t parts[] = {one->kind,       one->direction, (int64_t)one->leaves, (int64_t)one->instances,
                                 one->records,    one->assigns,   one->keeps,           one->stop,
                                 (int64_t)one->of};
        h = mix(mix(h, one->name, strlen(one->name) + 1), parts, sizeof parts);
        h = mix(h, &one->period, sizeof one->period);
        for (int i = 0; i < one->words; i++) h = mix_number(h, one->formula[i]);
        for (size_t i = 0; one->compares && i < one->leaves; i++) h = mix_number(h, one->compares[i]);
    }
    return h;
}

/* Hashes the formulas of a model's rules; nodes before `from` are already hashed. */
static uint64_t mix_events(uint64_t h, const model *m, node from)
{
    node last = 0;
    for (uint32_t i = 0; i < m->rule_count; i++) {
        const model_rule *r = &m->rules[i];
        last = last_of(r->leaf, r->leaves, last);
        for (size_t k = 0; k < r->assignments; k++) last = last_of(&r->assignment[k].value, 1, last);
    }
    h = mix_nodes(h, m, from, last);
    for (uint32_t i = 0; i < m->rule_count; i++) {
        const model_rule *r = &m->rules[i];
        h = mix_outputs(h, m, r->leaf, r->leaves);
        for (int k = 0; k < r->loops; k++) h = mix_range(h, &r->loop[k]);
        for (size_t k = 0; k < r->assignments; k++)
            h = mix_reference(mix_outputs(h, m, &r->assignment[k].value, 1), m, &r->assignment[k].to);
    }
    return h;
}

/* Hashes a system. Equal texts and settings give equal graphs, so node numbers serve as the equations' names. */
static uint64_t fingerprint(const motus_system *s, const rules *r)
{
    uint64_t h = MIX_START;
    /* Sizes count as 64 bits, since in WebAssembly size_t has fewer. */
    h = mix_number(mix_number(h, (int64_t)s->problem.nx), (int64_t)s->problem.nv);
    const model *m = s->model;
    if (r) h = mix_rules(h, r);
    if (!m) return h;
    const node last = last_of(m->accel, m->accel_count, 0);
    h = mix_nodes(h, m, 0, last);
    if (r) h = mix_events(h, m, last + 1);
    h = mix_outputs(h, m, m->accel, m->accel_count);
    h = mix_outputs(h, m, m->boundary, m->boundary_count);
    h = mix(h, m->ints, m->int_count * sizeof *m->ints);
    return mix(h, m->pool, m->pool_count * sizeof *m->pool);
}

/* Writes a number exactly, with a decimal point in every locale, which printf's %a has not. */
static int write_hex(char *out, size_t size, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    int exponent = (int)(bits >> 52 & 0x7FF);
    const char *sign = bits >> 63 ? "-" : "";
    if (!isfinite(v)) return snprintf(out, size, "%s", isnan(v) ? "nan" : v > 0 ? "inf" : "-inf");
    if (exponent == 0 && fraction == 0) return snprintf(out, size, "%s0x0p+0", sign);
    return snprintf(out, size, "%s0x%d.%013" PRIx64 "p%+d", sign, exponent != 0, fraction,
                    exponent ? exponent - 1023 : -1022);
}

/* Reads a number that write_hex wrote. False: it is none. */
static bool read_hex(const char **at, const char *end, double *v)
{
    const char *p = *at;
    bool minus = p < end && *p == '-';
    p += minus;
    if (end - p >= 3 && (!memcmp(p, "inf", 3) || (!minus && !memcmp(p, "nan", 3)))) {
        *v = *p == 'n' ? (double)NAN : minus ? -INFINITY : INFINITY;
        *at = p + 3;
        return true;
    }
    if (end - p < 6 || memcmp(p, "0x", 2) || (p[2] != '0' && p[2] != '1')) return false;
    uint64_t bits = (uint64_t)(p[2] - '0'), digits = 0;
    int shift = 0;
    p += 3;
    if (p < end && *p == '.')
        for (p++; p < end && digits < 13 && *p != 'p'; p++, digits++) {
            int d = *p >= '0' && *p <= '9' ? *p - '0' : *p >= 'a' && *p <= 'f' ? *p - 'a' + 10 : -1;
            if (d < 0) return false;
            bits = bits << 4 | (uint64_t)d;
            shift += 4;
        }
    if (p >= end || *p++ != 'p' || p >= end || (*p != '+' && *p != '-')) return false;
    bool below = *p++ == '-';
    uint64_t exponent_size;
    const size_t places = decimal_read_whole(p, (size_t)(end - p), &exponent_size);
    if (!places || exponent_size > EXPONENT_MAX) return false;
    p += places;
    const int exponent = (int)exponent_size;
    *v = ldexp((double)bits, (below ? -exponent : exponent) - shift);
    if (minus) *v = -*v;
    *at = p;
    return isfinite(*v);
}

/* Makes room for the text of `numbers` numbers. False: no memory. */
static bool make_room(motus_run *r, size_t numbers, size_t *room)
{
    *room = HEAD_ROOM + numbers * NUMBER_ROOM;
    if (*room <= r->saved_room) return true;
    char *more = take(&r->allocator, 1, *room);
    if (!more) return false;
    give(&r->allocator, r->saved);
    r->saved = more;
    r->saved_room = *room;
    return true;
}

static size_t write_numbers(motus_run *r, size_t at, size_t room, const double *numbers, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        at += (size_t)write_hex(r->saved + at, room - at, numbers[k]);
        r->saved[at++] = '\n';
    }
    return at;
}

static size_t write_block(motus_run *r, size_t at, size_t room, const char *name, const double *numbers, size_t n)
{
    if (n) at += (size_t)snprintf(r->saved + at, room - at, "%s %zu\n", name, n);
    return write_numbers(r, at, room, numbers, n);
}

/* Writes the text to r->saved: the stepper's carry, events, and the bars. `carry` has room for the numbers of events as
 * well. */
static motus_status write_state(motus_run *r, double *carry, size_t n, size_t events, size_t *length, motus_error *err)
{
    const stepper_count now =
        r->events ? events_save_stepper(r->events, r->stepper, carry) : stepper_save(r->stepper, carry);
    const double t = r->events ? events_saved_time(r->events, r->stepper) : stepper_time_saved(r->stepper, now, carry);
    char start[NUMBER_ROOM], h[NUMBER_ROOM];
    double *numbers = NULL;
    size_t count = 0, room;
    if (r->events) events_save(r->events, r->stepper, carry + n);
    motus_status status = r->bars ? bars_land(r, err) : MOTUS_OK;
    if (status == MOTUS_OK) status = bars_keep(r, t, &numbers, &count, err);
    if (status != MOTUS_OK) return status;
    if (!make_room(r, n + events + count, &room)) {
        give(&r->allocator, numbers);
        return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    }
    write_hex(start, sizeof start, r->timing.t0);
    write_hex(h, sizeof h, r->timing.h);
    size_t at = (size_t)snprintf(r->saved, room,
                                 "motus-state 1\nsystem %016" PRIx64 "\nmethod %s\nstart %s\nstep %s\nat %" PRId64
                                 " %" PRId64 " %" PRId64 "\ncarry %zu\n",
                                 fingerprint(r->system, r->rules), r->chosen.name, start, h, now.steps, now.evaluations,
                                 now.iterations, n);
    at = write_numbers(r, at, room, carry, n);
    at = write_block(r, at, room, "events", carry + n, events);
    at = write_block(r, at, room, "bars", numbers, count);
    at += (size_t)snprintf(r->saved + at, room - at, "end %016" PRIx64 "\n", mix(MIX_START, r->saved, at));
    give(&r->allocator, numbers);
    *length = at;
    return MOTUS_OK;
}

motus_status motus_run_save(motus_run *r, const char **text, size_t *length, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !text || !length)
        return fail(err, MOTUS_ARGUMENT, "motus_run_save needs a run and places for the text and its length");
    if (run_refuse(r, "saved", err) != MOTUS_OK) return MOTUS_UNAVAILABLE;
    if (r->events && events_partway(r->events)) {
        fail(err, MOTUS_UNAVAILABLE, "the run was cancelled within a step, and cannot be saved there");
        hint(err, "take one step more, then save it");
        return MOTUS_UNAVAILABLE;
    }
    const size_t n = stepper_carry(r->stepper);
    const size_t events = r->events ? events_save(r->events, r->stepper, NULL) : 0;
    double *carry = take(&r->allocator, n + events + 1, sizeof *carry);
    if (!carry) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    modes m = modes_enter();
    const motus_status status = write_state(r, carry, n, events, length, err);
    modes_leave(m);
    give(&r->allocator, carry);
    if (status == MOTUS_OK) *text = r->saved;
    return status;
}

/* ---- reading ---- */

typedef struct reader {
    const char *at, *end;
} reader;

static bool word(reader *r, const char *expected)
{
    size_t n = strlen(expected);
    if ((size_t)(r->end - r->at) < n || memcmp(r->at, expected, n)) return false;
    r->at += n;
    return true;
}

static bool line(reader *r, char *out, size_t size)
{
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    if (!stop || (size_t)(stop - r->at) >= size) return false;
    memcpy(out, r->at, (size_t)(stop - r->at));
    out[stop - r->at] = 0;
    r->at = stop + 1;
    return true;
}

static bool integer(reader *r, int64_t *v)
{
    uint64_t n;
    const size_t length = decimal_read_whole(r->at, (size_t)(r->end - r->at), &n);
    if (!length || n > INT64_MAX) return false;
    *v = (int64_t)n;
    r->at += length;
    return true;
}

/* Checks that the text ends in the hash of what comes before, and takes this last line off. */
static bool undamaged(reader *r)
{
    enum { CLOSING = 4 + 16 + 1 };
    char closing[CLOSING + 1];
    if (r->end - r->at < CLOSING) return false;
    r->end -= CLOSING;
    snprintf(closing, sizeof closing, "end %016" PRIx64 "\n", mix(MIX_START, r->at, (size_t)(r->end - r->at)));
    return !memcmp(r->end, closing, CLOSING);
}

static motus_status unreadable(motus_error *err)
{
    fail(err, MOTUS_STATE, "the text is not a restart state, or it is damaged");
    hint(err, "take the text as it was saved, unchanged");
    return MOTUS_STATE;
}

static bool read_numbers(reader *in, double *out, int64_t n)
{
    bool ok = true;
    for (int64_t k = 0; k < n && ok; k++) ok = read_hex(&in->at, in->end, &out[k]) && word(in, "\n");
    return ok;
}

/* Reads the numbers after a name; NULL: the text goes on with another name. False: it is damaged, or there is no
 * memory. */
static bool read_block(motus_run *r, reader *in, const char *name, double **numbers, int64_t *count)
{
    *numbers = NULL;
    *count = 0;
    if (!word(in, name)) return true;
    if (!integer(in, count) || !word(in, "\n") || *count > in->end - in->at) return false;
    *numbers = take(&r->allocator, (size_t)*count + 1, sizeof **numbers);
    return *numbers && read_numbers(in, *numbers, *count);
}

/* Restores the bars of a run from the numbers of the state, and owns the numbers from then on. */
static void resume_bars(motus_run *r, double *numbers, int64_t count)
{
    if (numbers && r->bars && bars_resume(r, numbers, (size_t)count)) return;
    give(&r->allocator, numbers);
    bars_give_up(r, "the run was restored from a state without its error");
}

/* The contents of a restart state. */
typedef struct found {
    char system[40], method[MOTUS_NAME_MAX + 8];
    double start, h;
    stepper_count then;
    int64_t carried;               /* how many numbers of the stepper */
    double *carry, *events, *bars; /* from the hooks; events, bars: NULL if the state has none */
    int64_t events_count, bars_count;
} found;

static bool read_head(reader *in, found *f)
{
    return word(in, "motus-state 1\nsystem ") && line(in, f->system, sizeof f->system) && word(in, "method ") &&
           line(in, f->method, sizeof f->method) && word(in, "start ") && read_hex(&in->at, in->end, &f->start) &&
           word(in, "\nstep ") && read_hex(&in->at, in->end, &f->h) && word(in, "\nat ") &&
           integer(in, &f->then.steps) && word(in, " ") && integer(in, &f->then.evaluations) && word(in, " ") &&
           integer(in, &f->then.iterations) && word(in, "\ncarry ") && integer(in, &f->carried) && word(in, "\n");
}

/* Checks that the state is one of this run. */
static motus_status fits(const motus_run *r, const found *f, motus_error *err)
{
    char expected[40];
    snprintf(expected, sizeof expected, "%016" PRIx64, fingerprint(r->system, r->rules));
    if (strcmp(f->system, expected)) {
        fail(err, MOTUS_STATE, "the restart state belongs to another model, or to other parameters");
        hint(err, "give the model, `set` and `switches` of the definition with which it was written");
        return MOTUS_STATE;
    }
    if (strcmp(f->method, r->chosen.name))
        return fail(err, MOTUS_STATE, "the restart state was written by method %s, and this run uses %s", f->method,
                    r->chosen.name);
    if (f->start != r->timing.t0 || f->h != r->timing.h)
        return fail(err, MOTUS_STATE, "the restart state has step %.17g from t = %.17g, and this run %.17g from %.17g",
                    f->h, f->start, r->timing.h, r->timing.t0);
    return (size_t)f->carried == stepper_carry(r->stepper) ? MOTUS_OK : unreadable(err);
}

/* Reads the numbers of the state. */
static motus_status read_found(motus_run *r, reader *in, found *f, motus_error *err)
{
    f->carry = take(&r->allocator, (size_t)f->carried + 1, sizeof *f->carry);
    if (!f->carry) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    const bool ok = read_numbers(in, f->carry, f->carried) &&
                    read_block(r, in, "events ", &f->events, &f->events_count) &&
                    read_block(r, in, "bars ", &f->bars, &f->bars_count) && in->at == in->end;
    return ok && !f->events == !r->events ? MOTUS_OK : unreadable(err);
}

/* Gives the stepper the state. A failure changes nothing. */
static motus_status load(motus_run *r, const found *f, motus_error *err)
{
    if (r->events) return run_events_load(r, f->then, f->carry, f->events, (size_t)f->events_count, err);
    const double t = stepper_time_saved(r->stepper, f->then, f->carry);
    const bool adaptive = row_adaptive(&r->chosen);
    motus_status status = MOTUS_OK;
    if (adaptive ? (t - r->timing.until) * r->timing.h > 0 : f->then.steps > r->timing.whole)
        status = run_refuse_beyond(r, t, err);
    return status == MOTUS_OK ? stepper_load(r->stepper, f->then, f->carry, err) : status;
}

static motus_status restore(motus_run *r, const char *text, size_t length, motus_error *err)
{
    reader in = {text, text + length};
    found f = {0};
    if (!undamaged(&in) || !read_head(&in, &f)) return unreadable(err);
    motus_status status = fits(r, &f, err);
    if (status == MOTUS_OK) status = read_found(r, &in, &f, err);
    if (status == MOTUS_OK) status = load(r, &f, err);
    give(&r->allocator, f.carry);
    give(&r->allocator, f.events);
    if (status != MOTUS_OK) { /* the run has not changed */
        give(&r->allocator, f.bars);
        return status;
    }
    resume_bars(r, f.bars, f.bars_count);
    return run_moved(r, err);
}

motus_status motus_run_restore(motus_run *r, const char *text, size_t length, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !text) return fail(err, MOTUS_ARGUMENT, "motus_run_restore needs a run and a text");
    if (r->observing) return run_refuse_move(err);
    if (run_refuse(r, "restored", err) != MOTUS_OK) return MOTUS_UNAVAILABLE;
    modes m = modes_enter(); /* so that no subnormal number is flushed when it is read */
    motus_status status = restore(r, text, length, err);
    modes_leave(m);
    if (status == MOTUS_OK)
        goal_restored(r);
    else
        column_names_error(r->system, err);
    return status;
}
