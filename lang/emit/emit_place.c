/* C text, and the places of numbers in memory as C text.
 *
 * Invariant: what depends on a size, a bound or a stride is a number of `q`; places of equal value share a number.
 */
#include "lang/emit/emit_parts.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Text ------------------------------------------------------------------------------------------------------------- */

void emit_add(emit_text *t, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int n = vsnprintf(NULL, 0, format, list);
    size_t need = t->length + (size_t)(n > 0 ? n : 0) + 1;
    if (need > t->room && !t->arena->failed) {
        size_t room = 2 * need + 1024;
        char *more = arena_grow(t->arena, t->bytes, t->length, room);
        if (more) {
            t->bytes = more;
            t->room = room;
        }
    }
    if (n > 0 && need <= t->room)
        t->length += (size_t)vsnprintf(t->bytes + t->length, t->room - t->length, format, again);
    va_end(again);
    va_end(list);
}

void emit_line(writer *w, const char *format, ...)
{
    char buffer[1200];
    va_list list;
    va_start(list, format);
    vsnprintf(buffer, sizeof buffer, format, list);
    va_end(list);
    SAY(w, "%*s%s\n", 4 * w->depth, "", buffer);
}

const char *emit_number(double v, char out[EMIT_NUMBER])
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    int exponent = (int)(bits >> 52 & 0x7FF);
    const char *sign = bits >> 63 ? "-" : "";
    if (exponent == 0x7FF)
        snprintf(out, EMIT_NUMBER, fraction ? "(0.0/0.0)" : "(%s1.0/0.0)", sign);
    else if (!exponent && !fraction)
        snprintf(out, EMIT_NUMBER, "%s0.0", sign);
    else
        snprintf(out, EMIT_NUMBER, "%s0x%d.%013" PRIx64 "p%+d", sign, exponent != 0, fraction,
                 exponent ? exponent - 1023 : -1022);
    return out;
}

/* Run-time integers ------------------------------------------------------------------------------------------------ */

static bool same_int(const emit_int *a, const emit_int *b)
{
    if (a->kind != b->kind) return false;
    if (a->kind == EMIT_SLOT) return a->slot == b->slot;
    if (a->kind == EMIT_STRIDE) return a->array == b->array && a->dim == b->dim;
    if (a->ref.array != b->ref.array) return false;
    for (int d = 0; d < a->ref.dims; d++) {
        const subscript *s = &a->ref.at[d], *t = &b->ref.at[d];
        if (s->slot != t->slot || s->literal != t->literal || s->modulus != t->modulus) return false;
    }
    return true;
}

static uint32_t integer(writer *w, const emit_int *want)
{
    emit *e = w->e;
    for (uint32_t k = 0; k < e->int_count; k++)
        if (same_int(&e->ints[k], want)) return k;
    if (!arena_more(e->text.arena, &e->ints, e->int_count, &e->int_room, sizeof *e->ints)) return 0;
    e->ints[e->int_count] = *want;
    return e->int_count++;
}

static uint32_t slot_integer(writer *w, int slot) { return integer(w, &(emit_int){.kind = EMIT_SLOT, .slot = slot}); }

int64_t emit_int_value(const emit_int *k, const array *arrays, const int64_t *ints)
{
    if (k->kind == EMIT_SLOT) return ints[k->slot];
    if (k->kind == EMIT_STRIDE) return arrays[k->array].over->stride[k->dim];
    const array *a = &arrays[k->ref.array];
    int64_t at = (int64_t)a->base;
    for (int d = 0; d < k->ref.dims; d++) {
        const subscript *s = &k->ref.at[d];
        int64_t fixed = s->modulus >= 0 ? 1 : s->literal + (s->slot >= 0 ? ints[s->slot] : 0);
        at += (fixed - a->over->first[d]) * a->over->stride[d];
    }
    return at;
}

static const char *space_name(space s)
{
    static const char *const names[SPACES] = {
        [SPACE_X] = "x",   [SPACE_V] = "v",      [SPACE_A] = "a",    [SPACE_DX] = "dx",
        [SPACE_DV] = "dv", [SPACE_POOL] = "own", [SPACE_OUT] = "out"};
    return names[s];
}

bool emit_varies(const writer *w, const array *a) { return w->e->varied && graph_marked(a, w->e->varied); }

/* Places ----------------------------------------------------------------------------------------------------------- */

static const char *variable(const writer *w, const subscript *s, char out[16])
{
    snprintf(out, 16, w->one_by_one && s->level == w->along ? "(j%d + l)" : "j%d", s->level);
    return out;
}

void emit_bound(writer *w, const subscript *s, char out[PLACE_MAX])
{
    char name[16];
    size_t n = 0;
    if (s->level >= 0) n += (size_t)snprintf(out + n, PLACE_MAX - n, "%s + ", variable(w, s, name));
    if (s->slot >= 0) n += (size_t)snprintf(out + n, PLACE_MAX - n, "q[%u] + ", slot_integer(w, s->slot));
    snprintf(out + n, PLACE_MAX - n, "%d", s->literal);
}

/* The last dimension has stride 1, which is left out so that the compiler knows it. */
void emit_element(writer *w, const reference *r, int dims, char out[PLACE_MAX])
{
    const emit_int offset = {.kind = EMIT_OFFSET, .ref = *r};
    const size_t size = PLACE_MAX;
    size_t n;
    if (w->e->literal && r->dims == 0)
        n = (size_t)snprintf(out, size, "%lld", (long long)emit_int_value(&offset, w->e->arrays, NULL));
    else
        n = (size_t)snprintf(out, size, "q[%u]", integer(w, &offset));
    for (int d = 0; d < dims && n < size; d++) {
        const subscript *s = &r->at[d];
        char base[PLACE_MAX], name[16];
        if (s->modulus >= 0) {
            emit_bound(w, s, base);
            w->e->wraps = true;
            n += (size_t)snprintf(out + n, size - n, " + wrapped(%s, q[%u])", base, slot_integer(w, s->modulus));
        } else if (s->level >= 0) {
            n += (size_t)snprintf(out + n, size - n, " + %s", variable(w, s, name));
        } else {
            continue;
        }
        if (d < r->dims - 1 && n < size)
            n += (size_t)snprintf(out + n, size - n, " * q[%u]",
                                  integer(w, &(emit_int){.kind = EMIT_STRIDE, .array = r->array, .dim = d}));
    }
}

void emit_address(writer *w, const reference *r, int dims, char out[PLACE_MAX])
{
    const array *a = &w->plan.g->arrays[r->array];
    char place[PLACE_MAX];
    emit_element(w, r, dims, place);
    if (a->space == SPACE_POOL && !emit_varies(w, a))
        snprintf(out, PLACE_MAX, "pool[%.300s]", place);
    else
        snprintf(out, PLACE_MAX, "AT(%s, %.300s)", space_name(a->space), place);
}

spread emit_spread(const writer *w, const reference *r)
{
    for (int d = 0; d < r->dims - 1; d++)
        if (r->at[d].level == w->along) return ANYWHERE;
    if (r->dims == 0 || r->at[r->dims - 1].level != w->along) return ANYWHERE;
    return r->at[r->dims - 1].modulus < 0 ? TOGETHER : AROUND;
}

void emit_around(writer *w, const reference *r, char out[3 * PLACE_MAX])
{
    const subscript *s = &r->at[r->dims - 1];
    char array[PLACE_MAX], from[PLACE_MAX];
    emit_address(w, r, r->dims - 1, array);
    emit_bound(w, s, from);
    w->e->wraps = true;
    snprintf(out, 3 * PLACE_MAX, "index_around(&%s, %s, q[%u])", array, from, slot_integer(w, s->modulus));
}
