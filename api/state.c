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
 *     bars 40                 the companion of the run, where its errors are told: api/bars_kept.c
 *     0x1.a36…
 *     …
 *     end 51b0…               hash of all the bytes before, so that a changed byte is found
 */
#include "api/goal.h"
#include "api/bars.h"

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

/* Where a number lies: a reference, and the array it refers to. */
static uint64_t mix_reference(uint64_t h, const model *m, const reference *r)
{
    static const extent none = {{0}, {0}, {0}}; /* leaves of derivatives lie nowhere */
    const array *a = &m->arrays[r->array];
    const extent *over = a->over ? a->over : &none;
    h = mix_number(mix_number(h, a->space), (int64_t)a->base);
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

/* The same text and settings give the same graph, so node numbers serve as the equations' names. */
static uint64_t fingerprint(const motus_system *s)
{
    uint64_t h = MIX_START;
    /* As 64 bits: in WebAssembly size_t is narrower, and the hash must be the same. */
    h = mix_number(mix_number(h, (int64_t)s->problem.nx), (int64_t)s->problem.nv);
    const model *m = s->model;
    if (!m) return h;
    node last = 0;
    for (size_t i = 0; i < m->accel_count; i++) last = m->accel[i].value > last ? m->accel[i].value : last;
    for (node n = 0; n <= last; n++) {
        const graph_node *g = graph_at(m->graph, n);
        const bool number = g->op == OP_CONST;
        const uint32_t parts[4] = {g->op, g->a, number ? 0 : g->b, number ? 0 : g->c};
        const double value = number ? g->value : 0;
        h = mix(mix(h, parts, sizeof parts), &value, sizeof value);
        if (g->op == OP_LOAD) h = mix_reference(h, m, &m->graph->references[g->a]);
        if (g->op == OP_SUM) h = mix_range(h, &m->graph->ranges[g->c]);
    }
    h = mix_outputs(h, m, m->accel, m->accel_count);
    h = mix_outputs(h, m, m->boundary, m->boundary_count);
    h = mix(h, m->ints, m->int_count * sizeof *m->ints);
    return mix(h, m->pool, m->pool_count * sizeof *m->pool);
}

/* Exact, with a decimal point in every locale, which printf's %a has not. */
static int write_hex(char *out, size_t size, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    int exponent = (int)(bits >> 52 & 0x7FF);
    const char *sign = bits >> 63 ? "-" : "";
    if (exponent == 0 && fraction == 0) return snprintf(out, size, "%s0x0p+0", sign);
    return snprintf(out, size, "%s0x%d.%013" PRIx64 "p%+d", sign, exponent != 0, fraction,
                    exponent ? exponent - 1023 : -1022);
}

static bool read_hex(const char **at, const char *end, double *v)
{
    const char *p = *at;
    bool minus = p < end && *p == '-';
    p += minus;
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

/* Makes room for the text of so many numbers. False: no memory. */
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

/* The text, of the stepper's carry and what is known of the errors; it is in r->saved. */
static motus_status write_state(motus_run *r, double *carry, size_t n, size_t *length, motus_error *err)
{
    const stepper_count now = stepper_save(r->stepper, carry);
    char start[NUMBER_ROOM], h[NUMBER_ROOM];
    double *numbers;
    size_t count, room;
    motus_status status = bars_keep(r, stepper_time_saved(r->stepper, now, carry), &numbers, &count, err);
    if (status != MOTUS_OK) return status;
    if (!make_room(r, n + count, &room)) {
        give(&r->allocator, numbers);
        return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    }
    write_hex(start, sizeof start, r->timing.t0);
    write_hex(h, sizeof h, r->timing.h);
    size_t at = (size_t)snprintf(r->saved, room,
                                 "motus-state 1\nsystem %016" PRIx64 "\nmethod %s\nstart %s\nstep %s\nat %" PRId64
                                 " %" PRId64 " %" PRId64 "\ncarry %zu\n",
                                 fingerprint(r->system), r->chosen.name, start, h, now.steps, now.evaluations,
                                 now.iterations, n);
    at = write_numbers(r, at, room, carry, n);
    if (count) at += (size_t)snprintf(r->saved + at, room - at, "bars %zu\n", count);
    at = write_numbers(r, at, room, numbers, count);
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
    const size_t n = stepper_carry(r->stepper);
    double *carry = take(&r->allocator, n + 1, sizeof *carry);
    if (!carry) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    modes m = modes_enter();
    const motus_status status = write_state(r, carry, n, length, err);
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

/* Whether the text ends in the hash of what comes before it; takes this last line off. */
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

/* What the state has of the errors; NULL: nothing. False: it is damaged, or there is no memory. */
static bool read_bars(motus_run *r, reader *in, double **numbers, int64_t *count)
{
    *numbers = NULL;
    *count = 0;
    if (in->at == in->end) return true;
    if (!word(in, "bars ") || !integer(in, count) || !word(in, "\n") || *count > in->end - in->at) return false;
    *numbers = take(&r->allocator, (size_t)*count + 1, sizeof **numbers);
    return *numbers && read_numbers(in, *numbers, *count) && in->at == in->end;
}

/* The run has been restored, and with it its errors, where the state has them. Takes the numbers over. */
static void resume_bars(motus_run *r, double *numbers, int64_t count)
{
    if (numbers && r->bars && bars_resume(r, numbers, (size_t)count)) return;
    give(&r->allocator, numbers);
    bars_give_up(r, "the run was restored from a state that does not tell its error up to there");
}

static motus_status restore(motus_run *r, const char *text, size_t length, motus_error *err)
{
    reader in = {text, text + length};
    char system[40], method[MOTUS_NAME_MAX + 8], expected[40];
    double start, h;
    int64_t steps, evaluations, iterations, n;
    if (!undamaged(&in) || !word(&in, "motus-state 1\nsystem ") || !line(&in, system, sizeof system) ||
        !word(&in, "method ") || !line(&in, method, sizeof method) || !word(&in, "start ") ||
        !read_hex(&in.at, in.end, &start) || !word(&in, "\nstep ") || !read_hex(&in.at, in.end, &h) ||
        !word(&in, "\nat ") || !integer(&in, &steps) || !word(&in, " ") || !integer(&in, &evaluations) ||
        !word(&in, " ") || !integer(&in, &iterations) || !word(&in, "\ncarry ") || !integer(&in, &n) ||
        !word(&in, "\n"))
        return unreadable(err);
    snprintf(expected, sizeof expected, "%016" PRIx64, fingerprint(r->system));
    if (strcmp(system, expected)) {
        fail(err, MOTUS_STATE, "the restart state belongs to another model, or to other parameters");
        hint(err, "give the model and `set` of the definition with which it was written");
        return MOTUS_STATE;
    }
    if (strcmp(method, r->chosen.name))
        return fail(err, MOTUS_STATE, "the restart state was written by method %s, and this run uses %s", method,
                    r->chosen.name);
    if (start != r->timing.t0 || h != r->timing.h)
        return fail(err, MOTUS_STATE, "the restart state has step %.17g from t = %.17g, and this run %.17g from %.17g",
                    h, start, r->timing.h, r->timing.t0);
    if ((size_t)n != stepper_carry(r->stepper)) return unreadable(err);
    double *carry = take(&r->allocator, (size_t)n + 1, sizeof *carry);
    if (!carry) return fail(err, MOTUS_MEMORY, "no memory for the restart state");
    double *numbers = NULL;
    int64_t count = 0;
    const bool ok = read_numbers(&in, carry, n) && read_bars(r, &in, &numbers, &count);
    motus_status status = MOTUS_OK;
    const stepper_count then = {.steps = steps, .evaluations = evaluations, .iterations = iterations};
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    const double t = stepper_time_saved(r->stepper, then, carry);
    if (!ok)
        status = unreadable(err);
    else if (row_adaptive(&r->chosen) ? (t - r->timing.until) * r->timing.h > 0 : steps > r->timing.whole)
        status = fail(err, MOTUS_STATE, "the restart state is at t = %s, beyond the end of this run, %s", decimal(t, a),
                      decimal(r->timing.until, b));
    else
        status = stepper_load(r->stepper, then, carry, err);
    give(&r->allocator, carry);
    if (status != MOTUS_OK) { /* the run has not changed */
        give(&r->allocator, numbers);
        return status;
    }
    resume_bars(r, numbers, count);
    return run_moved(r, err);
}

motus_status motus_run_restore(motus_run *r, const char *text, size_t length, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !text) return fail(err, MOTUS_ARGUMENT, "motus_run_restore needs a run and a text");
    if (r->observing) return run_refuse_move(err);
    if (run_refuse(r, "restored", err) != MOTUS_OK) return MOTUS_UNAVAILABLE;
    modes m = modes_enter(); /* before the numbers are read, so that no subnormal is flushed */
    motus_status status = restore(r, text, length, err);
    modes_leave(m);
    if (status == MOTUS_OK) goal_restored(r);
    return status;
}
