/* Finds the columns that a name stands for: "x", "r'.y", "x[3]'", "exact x". */
#include "api/system/columns.h"

#include "base/near.h"

#include <stdio.h>
#include <string.h>

typedef struct column_name { /* the parts of a name: [exact] base [indices] primes component */
    bool exact;
    char base[MOTUS_NAME_MAX];
    int dims;
    int64_t index[MAX_DIMS];
    int primes;
    int component; /* 1-based, 0: none */
} column_name;

/* Reads an index; one above INT32_MAX becomes one that no cell has. */
static const char *read_index(const char *p, int64_t *value)
{
    const bool minus = *p == '-';
    uint64_t n;
    const size_t length = decimal_read_whole(p + minus, SIZE_MAX, &n);
    *value = n > INT32_MAX ? (int64_t)INT32_MAX + 1 : (int64_t)n;
    *value = minus ? -*value : *value;
    return length ? p + minus + length : NULL;
}

static bool take_name(const char *p, column_name *n)
{
    *n = (column_name){0};
    if (!strncmp(p, "exact ", 6)) {
        n->exact = true;
        p += 6;
    }
    size_t length = strcspn(p, "[.'");
    if (length == 0 || length >= sizeof n->base) return false;
    memcpy(n->base, p, length);
    p += length;
    if (*p == '[') {
        do {
            if (n->dims == MAX_DIMS || !(p = read_index(p + 1, &n->index[n->dims]))) return false;
            n->dims++;
        } while (*p == ',');
        if (*p++ != ']') return false;
    }
    while (*p == '\'' && n->primes < 3) {
        n->primes++;
        p++;
    }
    if (*p == '.') {
        n->component = p[1] == 'x' ? 1 : p[1] == 'y' ? 2 : p[1] == 'z' ? 3 : -1;
        p += p[1] ? 2 : 1;
    } else if (*p == '[') {
        int64_t k;
        if (!(p = read_index(p + 1, &k)) || *p++ != ']' || k < 1 || k > INT32_MAX) return false;
        n->component = (int)k;
    }
    return *p == 0 && n->component >= 0;
}

static const char *range_name(const motus_system *s, const column_range *g)
{
    switch (g->kind) {
    case MOTUS_COLUMN_TIME: return columns_time(s);
    case MOTUS_COLUMN_QUANTITY:
    case MOTUS_COLUMN_INVARIANT: return s->definitions[g->item].name;
    default: return s->states[g->item].name;
    }
}

static uint32_t slot_of(const motus_system *s, const char *name)
{
    uint32_t h = 2166136261u;
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 16777619u;
    return h & (s->range_slots - 1);
}

bool column_names_enter(motus_system *s)
{
    s->range_slots = 4;
    while (s->range_slots < s->range_count + s->range_count / 4) s->range_slots *= 2;
    s->range_of = arena_room(&s->arena, s->range_slots * sizeof *s->range_of);
    for (size_t i = 0; s->range_of && i < s->range_count; i++) {
        uint32_t k = slot_of(s, range_name(s, &s->ranges[i]));
        while (s->range_of[k]) k = (k + 1) & (s->range_slots - 1);
        s->range_of[k] = (uint32_t)i + 1;
    }
    return s->range_of != NULL;
}

static motus_status no_column(const motus_system *s, const char *name, const char *base, motus_error *err)
{
    fail(err, MOTUS_NAME, "there is no column %s", name);
    const char *best = NULL;
    int least = 7;
    for (size_t i = 0; i < s->range_count; i++) {
        const char *other = range_name(s, &s->ranges[i]);
        if (near_nearer(base, other, &least)) best = other;
    }
    motus_column c = motus_default_column();
    if (best && strcmp(best, base))
        hint(err, "did you mean %s?", best);
    else if (s->column_count > 1 && motus_column_at(s, 1, &c) == MOTUS_OK)
        hint(err, "the columns are %s, %s … as a trajectory file names them", columns_time(s), c.name);
    return MOTUS_NAME;
}

/* Finds the columns of a range that the name stands for. False: there are none. */
static bool select_columns(const motus_system *s, const column_range *g, column_name n, size_t *first, size_t *count)
{
    *first = g->first;
    *count = g->count;
    if (g->kind == MOTUS_COLUMN_TIME) return !n.dims && !n.component;
    const model_state shape = columns_shape(s, g);
    const size_t parts = columns_parts(shape.components);
    size_t cell = 0;
    if (shape.dims == 0 && n.dims == 1 && !n.component && !n.primes) { /* w[2]: a component of a vector */
        n.component = n.index[0] > 0 && n.index[0] < INT32_MAX ? (int)n.index[0] : INT32_MAX;
        n.dims = 0;
    }
    if (n.dims && (n.dims != shape.dims || !columns_find_cell(&shape, n.index, &cell))) return false;
    if (n.component > shape.components || (n.component && shape.dims && !n.dims)) return false;
    if (n.dims) {
        *first += cell * parts;
        *count = parts;
    }
    if (n.component) {
        *first += (size_t)n.component - 1;
        *count = 1;
    }
    return true;
}

motus_status motus_column_find(const motus_system *s, const char *name, size_t *first, size_t *count, motus_error *err)
{
    column_name n;
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !name || !first || !count)
        return fail(err, MOTUS_ARGUMENT, "motus_column_find needs a system, a name and two places for the answer");
    if (!take_name(name, &n)) {
        fail(err, MOTUS_NAME, "%s is not the name of a column", name);
        hint(err, "names are x, x', r.y, r'.y, x[3], x[3]', r[3].x, energy, exact x");
        return MOTUS_NAME;
    }
    for (uint32_t k = slot_of(s, n.base); s->range_of[k]; k = (k + 1) & (s->range_slots - 1)) {
        const column_range *g = &s->ranges[s->range_of[k] - 1];
        size_t from, number;
        if (strcmp(range_name(s, g), n.base) || n.exact != (g->kind == MOTUS_COLUMN_EXACT) ||
            n.primes != (g->prime ? 1 : 0))
            continue;
        if (!select_columns(s, g, n, &from, &number)) break;
        *first = from;
        *count = number;
        return MOTUS_OK;
    }
    return no_column(s, name, n.base, err);
}

motus_status motus_columns_named(const motus_system *s, size_t count, const char *const *names, size_t *columns,
                                 motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || (count && (!names || !columns)))
        return fail(err, MOTUS_ARGUMENT, "motus_columns_named needs a system, names and a place for the columns");
    for (size_t k = 0; k < count; k++) {
        size_t numbers = 1;
        const motus_status status = motus_column_find(s, names[k], &columns[k], &numbers, err);
        if (status != MOTUS_OK) return status;
        if (numbers == 1) continue;
        motus_column first = motus_default_column();
        motus_column_at(s, columns[k], &first);
        fail(err, MOTUS_SHAPE, "%s stands for %zu columns, and one is needed", names[k], numbers);
        hint(err, "name one of them, as %s", first.name);
        return MOTUS_SHAPE;
    }
    return MOTUS_OK;
}

/* Returns whether "t = " or "t nears" within a sentence is the time: a word before it says so. */
static bool says_time(const char *sentence, const char *at)
{
    static const char *const words[] = {"at ",  "near ",   "from ",   "until ",    "after ", "between ",
                                        "and ", "change ", "start, ", "instant, ", "as "};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t n = strlen(words[i]);
        if ((size_t)(at - sentence) >= n && !strncmp(at - n, words[i], n))
            return !strncmp(at, "t = ", 4) || !strncmp(at, "t nears ", 8);
    }
    return false;
}

void column_names_time(const motus_system *s, char *sentence, size_t size)
{
    const char *const name = columns_time(s);
    char text[MOTUS_TEXT_MAX];
    size_t n = 0;
    if (!strcmp(name, "t")) return;
    for (const char *c = sentence; *c && n + 1 < sizeof text && n < sizeof text; c++)
        if (says_time(sentence, c))
            n += (size_t)snprintf(text + n, sizeof text - n, "%s", name);
        else
            text[n++] = *c;
    text[n < sizeof text ? n : sizeof text - 1] = 0;
    snprintf(sentence, size, "%s", text);
}
