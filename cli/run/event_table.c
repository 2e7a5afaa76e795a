/* The events of a run in print. */
#include "cli/run/summary.h"

#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "tell/bar.h"

#include <math.h>
#include <string.h>

enum {
    FIRST = 10,  /* the first rows that are shown */
    LAST = 3,    /* the last rows that are shown */
    NUMBERS = 8, /* of the state that are shown */
    DIGITS = 10  /* of each number */
};

static int64_t left_out(const summary *s)
{
    const int64_t rows = motus_run_events(s->run);
    return rows > FIRST + LAST + 1 ? rows - FIRST - LAST : 0;
}

/* Returns how many numbers the state and the quantities have; modes are among the quantities. */
static size_t numbers_of(const summary *s) { return load_invariant_column(s->model) - 1; }

static size_t shown_of(const summary *s)
{
    const size_t numbers = numbers_of(s);
    return numbers < NUMBERS ? numbers : NUMBERS;
}

/* ---- the table ---- */

static bool any_touched(const summary *s)
{
    for (int64_t k = 0; k < motus_run_events(s->run); k++) {
        motus_event_row row = motus_default_event_row();
        if (motus_run_event(s->run, k, &row) == MOTUS_OK && row.touched) return true;
    }
    return false;
}

static void put_heading(const summary *s, table *t, bool touched)
{
    table_cell(t, "event");
    table_cell(t, s->model->time);
    table_cell(t, "count");
    if (touched) table_cell(t, "touched");
    for (size_t k = 0; k < shown_of(s); k++) {
        motus_column c = motus_default_column();
        table_cell(t, motus_column_at(s->model->system, 1 + k, &c) == MOTUS_OK ? c.name : "");
    }
}

static motus_status put_row(const summary *s, table *t, int64_t k, bool touched, motus_error *err)
{
    motus_event_row row = motus_default_event_row();
    size_t columns[NUMBERS];
    double values[NUMBERS];
    const size_t shown = shown_of(s);
    for (size_t i = 0; i < shown; i++) columns[i] = 1 + i;
    motus_status status = motus_run_event(s->run, k, &row);
    if (!status) status = motus_run_event_values(s->run, k, 0, columns, shown, values, err);
    if (status) return status;
    table_cell(t, row.instance);
    if (isnan(row.error))
        table_exact(t, row.time);
    else
        table_bar(t, row.time, row.error);
    table_integer(t, row.count);
    if (touched) table_cell(t, row.touched ? "touched" : "");
    for (size_t i = 0; i < shown; i++) table_number(t, values[i], DIGITS);
    return MOTUS_OK;
}

static void put_gap(const summary *s, table *t, bool touched)
{
    char text[64];
    snprintf(text, sizeof text, "… %lld more", (long long)left_out(s));
    table_cell(t, text);
    for (size_t k = 0; k < 2 + touched + shown_of(s); k++) table_cell(t, "");
}

table *event_table_make(const summary *s, motus_error *err, motus_status *status)
{
    const int64_t rows = motus_run_events(s->run), out = left_out(s);
    if (!rows) return NULL;
    const bool touched = any_touched(s);
    char align[4 + NUMBERS + 1] = "llrllllllllll";
    align[3 + touched + (int)shown_of(s)] = 0;
    table *t = table_create(align);
    if (!t) *status = complain_memory(err);
    put_heading(s, t, touched);
    for (int64_t k = 0; !*status && k < rows; k++) {
        if (out && k == FIRST) {
            put_gap(s, t, touched);
            k += out;
        }
        *status = put_row(s, t, k, touched, err);
    }
    return t;
}

void event_table_note(const summary *s, FILE *out)
{
    const size_t hidden = numbers_of(s) - shown_of(s);
    const int64_t known = motus_run_events_significant(s->run);
    motus_event_row row = motus_default_event_row();
    if (!s->options->events && (left_out(s) || hidden))
        fprintf(out, "  --events FILE writes all events%s\n", hidden ? " with all numbers" : "");
    if (!s->errors || known >= motus_run_events(s->run)) return;
    fprintf(out, "  no digit of an event is known to be significant");
    if (known > 0 && motus_run_event(s->run, known - 1, &row) == MOTUS_OK)
        fprintf(out, " after %s number %lld", row.instance, (long long)row.count);
    putc('\n', out);
}

/* ---- sentences ---- */

void event_table_unseen(const summary *s, FILE *out)
{
    char from[DECIMAL_MAX];
    const motus_run_statistics done = motus_run_now(s->run);
    if (!done.events_unseen) return;
    text_brief(done.events_unseen_from, 6, from);
    putc('\n', out);
    text_say(out,
             "events of %s that are far shorter than a step may have been missed in %lld step%s, from %s = %s on: "
             "no bound excludes them there, and smaller steps see more",
             done.events_unseen_of, (long long)done.events_unseen, done.events_unseen == 1 ? "" : "s", s->model->time,
             from);
}

void event_table_held(const summary *s, FILE *out)
{
    const motus_run_statistics done = motus_run_now(s->run);
    const long long more = (long long)done.events_held - 1;
    if (more < 0) return;
    fprintf(out, "\n%s", done.events_held_of);
    if (more > 0) fprintf(out, " and %lld other event%s", more, more == 1 ? "" : "s");
    fprintf(out, " never happened: %s\n",
            more > 0 ? "their conditions held from the start on" : "its condition held from the start on");
}

/* Writes "bounces accumulate", or "event1 accumulates" if the plural of the name does not add an s. */
static void put_accumulate(const char *name, FILE *out)
{
    const char last = name[0] ? name[strlen(name) - 1] : 0;
    const bool plural = last >= 'a' && last <= 'z' && !strchr("shxyz", last);
    fprintf(out, plural ? "%ss accumulate" : "%s accumulates", name);
}

void event_table_end(const summary *s, FILE *out)
{
    int accumulated = 0;
    double time = NAN, error = NAN;
    char text[BAR_MAX], now[DECIMAL_MAX];
    const char *const name = motus_run_ended(s->run, &accumulated, &time, &error);
    const char *const of = motus_run_accumulates(s->run);
    if (accumulated) {
        if (isnan(error))
            decimal(time, text);
        else
            bar_digits(time, error, text);
        put_accumulate(of, out);
        if (isinf(error))
            fprintf(out, "; no digit of their limit is known to be significant\n");
        else
            fprintf(out, " at %s = %s\n", s->model->time, text);
    }
    /* a run that accumulation has ended stands at the last event that could be told apart from the limit */
    const double gone = motus_run_time(s->run) - s->start;
    const bool there = accumulated && strcmp(name, of) == 0 && !(fabs(gone) > fabs(time - s->start) + error);
    decimal(motus_run_time(s->run), now);
    if (there)
        fprintf(out, "the run ends there, before %s = %s: `when %s accumulates: …` says how it goes on\n",
                s->model->time, decimal(s->model->set.until, text), of);
    if (name[0] && !there) fprintf(out, "%s ended the run at %s = %s\n", name, s->model->time, now);
}
