/* The items of --record:
 *
 *     final   NAME   final(NAME)   min(NAME)   max(NAME)   mean(NAME)   time_of_min(NAME)   time_of_max(NAME)
 *     count(EVENT)   time(EVENT)   at(EVENT, EXPRESSION)   and so on: see load.h
 *     steps   rejected   h_min   h_max   evaluations   reached   tolerance   ended
 *
 * Invariant: a name stands for all its numbers, as in --columns of motus run. If the model has a column with the name
 * `steps`, that column is recorded.
 */
#include "base/near.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *word;
    motus_reduction how;
} reductions[] = {
    {"final", MOTUS_REDUCE_FINAL},
    {"min", MOTUS_REDUCE_MIN},
    {"max", MOTUS_REDUCE_MAX},
    {"mean", MOTUS_REDUCE_MEAN},
    {"time_of_min", MOTUS_REDUCE_TIME_OF_MIN},
    {"time_of_max", MOTUS_REDUCE_TIME_OF_MAX},
};
enum { REDUCTIONS = sizeof reductions / sizeof *reductions };

/* Numbers of the trajectory itself, with the words of `motus run --json`. */
static const char *const of_trajectory[] = {"steps",       "rejected", "h_min",    "h_max",
                                            "evaluations", "reached",  "tolerance"};
enum { OF_TRAJECTORY = sizeof of_trajectory / sizeof *of_trajectory };
_Static_assert(MOTUS_REDUCE_STEPS + OF_TRAJECTORY == MOTUS_REDUCE_TOLERANCE + 1, "a word for each");

static motus_status add(sweep_records *r, motus_reduction how, size_t first, size_t count, motus_error *err)
{
    motus_record *items =
        count < SIZE_MAX / sizeof *items - r->count ? realloc(r->items, (r->count + count + 1) * sizeof *items) : NULL;
    if (!items) return complain_memory(err);
    r->items = items;
    for (size_t k = 0; k < count; k++) items[r->count++] = (motus_record){how, first + k};
    return MOTUS_OK;
}

static motus_status unknown(const load *m, const char *item, const char *word, size_t length, motus_error *err)
{
    size_t first, count;
    char given[MOTUS_NAME_MAX] = "";
    const char *near = NULL;
    int best = 8;
    memcpy(given, word, length < sizeof given ? length : sizeof given - 1);
    for (size_t i = 0; i < REDUCTIONS; i++) {
        const int d = near_distance(reductions[i].word, given, best);
        if (d < best) near = reductions[i].word, best = d;
    }
    if (length < sizeof given && motus_column_find(m->system, given, &first, &count, NULL) == MOTUS_OK) {
        fail(err, MOTUS_ARGUMENT, "--record %s: %s is recorded at the end of the run, not at a time", item, given);
        hint(err, "write %s, or one of its values on the way: min(%s), max(%s), mean(%s)", given, given, given, given);
        return MOTUS_ARGUMENT;
    }
    fail(err, MOTUS_ARGUMENT, "--record %s: there is no %s(…) to record", item, given);
    if (near)
        hint(err, "did you mean %s(...)?", near);
    else
        hint(err, "record final, min, max, mean, time_of_min or time_of_max");
    return MOTUS_ARGUMENT;
}

static size_t of_trajectory_find(const char *item)
{
    size_t k = 0;
    while (k < OF_TRAJECTORY && strcmp(of_trajectory[k], item) != 0) k++;
    return k;
}

static motus_status one(sweep_records *r, const load *m, char *item, motus_error *err)
{
    size_t length = strlen(item), first, count;
    if (strcmp(item, "final") == 0) return add(r, MOTUS_REDUCE_FINAL, 1, m->positions + m->velocities, err);
    size_t named;
    const char *const added = defined_name(&m->defined, item, &named);
    if (added) {
        char column[MOTUS_NAME_MAX];
        snprintf(column, sizeof column, "%.*s", (int)named, added);
        const motus_status found = motus_column_find(m->system, column, &first, &count, err);
        return found ? found : add(r, MOTUS_REDUCE_FINAL, first, count, err);
    }
    motus_reduction how = MOTUS_REDUCE_FINAL;
    char *name = item, *open = strchr(item, '(');
    if (open && item[length - 1] == ')') {
        size_t i = 0, word = (size_t)(open - item);
        while (word > 0 && item[word - 1] == ' ') word--;
        while (i < REDUCTIONS && !(strlen(reductions[i].word) == word && strncmp(reductions[i].word, item, word) == 0))
            i++;
        if (i == REDUCTIONS) return unknown(m, item, item, word, err);
        how = reductions[i].how;
        name = open + 1 + strspn(open + 1, " ");
        item[--length] = 0;
        while (item + length > name && item[length - 1] == ' ') item[--length] = 0;
    }
    const bool plain = how == MOTUS_REDUCE_FINAL && name == item, ended = plain && strcmp(item, "ended") == 0;
    const size_t what = plain ? of_trajectory_find(item) : OF_TRAJECTORY;
    motus_error none = motus_default_error();
    if ((ended || what < OF_TRAJECTORY) && motus_column_find(m->system, name, &first, &count, &none) != MOTUS_OK) {
        r->ended = r->ended || ended;
        return ended ? MOTUS_OK : add(r, MOTUS_REDUCE_STEPS + what, 0, 1, err);
    }
    motus_status status = motus_column_find(m->system, name, &first, &count, err);
    return status ? status : add(r, how, first, count, err);
}

motus_status sweep_records_read(sweep_records *r, const load *m, const char *list, motus_error *err)
{
    *r = (sweep_records){0};
    options_list items;
    motus_status status = words_part(list ? list : "final", "--record", &items, err);
    if (status) return status;
    for (size_t i = 0; !status && i < items.count; i++)
        status = one(r, m, items.text + (items.items[i] - items.text), err);
    words_free(&items);
    /* SWEEP_REACHED and SWEEP_TOLERANCE, after the others */
    if (!status) status = add(r, MOTUS_REDUCE_ACCURACY, 0, 1, err);
    if (!status) status = add(r, MOTUS_REDUCE_TOLERANCE, 0, 1, err);
    if (!status) r->count -= SWEEP_JUDGED;
    return status;
}

void sweep_record_name(const load *m, const motus_record *r, char out[SWEEP_NAME])
{
    motus_column c = motus_default_column();
    if (r->how >= MOTUS_REDUCE_STEPS) {
        snprintf(out, SWEEP_NAME, "%s", of_trajectory[r->how - MOTUS_REDUCE_STEPS]);
        return;
    }
    motus_column_at(m->system, r->column, &c);
    const char *word = "";
    for (size_t i = 1; i < REDUCTIONS; i++)
        if (reductions[i].how == r->how) word = reductions[i].word;
    const char *rest = "", *const asked = defined_label(&m->defined, c.name, &rest);
    if (asked)
        snprintf(out, SWEEP_NAME, "%s%s", asked, rest);
    else
        snprintf(out, SWEEP_NAME, *word ? "%s(%s)" : "%s%s", word, c.name);
}

bool sweep_record_errs(const motus_record *r) { return r->how < MOTUS_REDUCE_STEPS && r->column > 0; }

/* ---- rows ---- */

size_t sweep_kept(const sweep *s)
{
    const bool behind = !isnan(s->accuracy) || s->records.count == 0; /* an ensemble has at least one */
    return s->records.count + (behind ? SWEEP_JUDGED : 0);
}

int sweep_event_number(const sweep *s, const char *name)
{
    const char *its;
    if (!name[0]) return 0;
    for (int k = 0; (its = motus_ensemble_kind(s->ensemble, (size_t)k)) != NULL; k++)
        if (strcmp(its, name) == 0) return k + 1;
    return -1;
}

bool sweep_row_lost(const sweep *s, const sweep_rows *rows, size_t i)
{
    for (size_t r = 0; r < s->records.count; r++)
        if (sweep_record_errs(&s->records.items[r]) && isinf(rows->errors[r][i])) return true;
    return false;
}

void sweep_row_numbers(const sweep *s, const sweep_rows *rows, size_t from, size_t count, double *out, size_t next_row,
                       size_t next_column)
{
    const double *stopped = rows->stopped + from;
    for (size_t k = 0; k < s->grid.count; k++, out += next_column)
        for (size_t i = 0; i < count; i++) out[i * next_row] = rows->values[k][from + i];
    for (size_t r = 0; r < s->records.count; r++, out += next_column)
        for (size_t i = 0; i < count; i++) out[i * next_row] = isnan(stopped[i]) ? rows->results[r][from + i] : NAN;
    for (size_t r = 0; s->errors && r < s->records.count; r++) {
        if (!sweep_record_errs(&s->records.items[r])) continue;
        for (size_t i = 0; i < count; i++) out[i * next_row] = isnan(stopped[i]) ? rows->errors[r][from + i] : NAN;
        out += next_column;
    }
    if (s->errors) {
        for (size_t i = 0; i < count; i++) {
            out[i * next_row] = isnan(stopped[i]) ? !sweep_row_lost(s, rows, from + i) : NAN;
        }
        out += next_column;
    }
    if (s->records.ended) {
        for (size_t i = 0; i < count; i++)
            out[i * next_row] = sweep_event_number(s, motus_ensemble_ended(s->ensemble, from + i));
        out += next_column;
    }
    for (size_t i = 0; i < count; i++) out[i * next_row] = stopped[i];
    out += next_column;
    for (size_t i = 0; i < count; i++) out[i * next_row] = motus_ensemble_stopped_by(s->ensemble, from + i);
}
