/* Bars of error of random motions by kind: how many errors are within their bars, how many bars are tight, and how many
 * are wrong by more than ten bars. The truth has 113 bits and shares no code with the library.
 *
 * Of every motion the numbers at three times and at the end are judged, and the times of its events. A bar is tight
 * where it is at most 10 times the error, or 4 ulp. A run that is refused, or ends with another status, is no answer.
 * Where an answer seems wrong the truth is found once more by other steps: motions whose two truths differ, and those
 * whose truth cannot be found, are dropped.
 *
 * MOTIONS=n tries n motions of each kind; KIND=word only those; MOTION=k motion k alone, with its text, its numbers and
 * their truth; HOW=auto, accuracy, 1e-12, tolerance, step runs them all so; WHAT=states, events judges these alone;
 * MISSED=1 tells all numbers beyond their bars. More motions find rare wrong answers that are known.
 */
#include "test/given.h"

#include "test/motion_kinds.h"
#include "test/motion_truth.h"

#include <time.h>

/* Motions that had wrong bars once, each for a reason of its own; they are judged besides. */
static const struct {
    int kind, motion;
} mended[] = {
    {MOTION_REST_KIND, 59},    /* sqrt(v^2) had no kink */
    {MOTION_BUMP_KIND, 251},   /* less than a step may lose is more than its error */
    {MOTION_PULSE_KIND, 20},   /* a number within a step that goes astray */
    {MOTION_PULSE_KIND, 98},   /* a push and a pull shift the motion and leave its velocity */
    {MOTION_FLIGHT_KIND, 222}, /* the witness looked at no step of an extrapolation */
    {MOTION_KINKED_KIND, 260}, /* steps of one size of run and companion had a jump at the same time */
    {MOTION_SEVERAL_KIND, 116},
    {MOTION_OFFSET_KIND, 40},
    {MOTION_FLIGHT_KIND, 217}, /* a difference passed 0 at the end of a step of a quarter of the run */
    {MOTION_VECTOR_KIND, 339}, /* what a step loses was taken for the whole error within it */
    {MOTION_OFFSET_KIND, 225}, /* between steps the state is that of another time, after 1e9 s */
    /* rounding of the state hides the time of an event, and moves what follows from it */
    {MOTION_THERMOSTAT_KIND, 49},
    {MOTION_THERMOSTAT_KIND, 96},
    /* run and companion made the same of the few roundings of a contact with a stiff floor */
    {MOTION_PENALTY_KIND, 11},
    {MOTION_PENALTY_KIND, 117},
    {MOTION_PENALTY_KIND, 305},
};

/* How a run is asked for ------------------------------------------------------------------------------------------ */

typedef struct request {
    const char *method;
    double accuracy, tolerance, step; /* NaN: none */
} request;

static request ask(const motion *m, const char *how)
{
    static const char *const adaptive[] = {"dop853",  "taylor", "radau15", "dopri5",
                                           "verner9", "gragg",  "tsit5",   "verner7"};
    static const char *const fixed[] = {"rk4",    "leapfrog", "kahan-li8", "gauss8",
                                        "verlet", "midpoint", "gauss4",    "rk4-38"};
    static const char *const hows[] = {"auto",     "auto",      "auto",      "auto", "accuracy",
                                       "accuracy", "tolerance", "tolerance", "step", "step"};
    request r = {"auto", NAN, NAN, NAN};
    const char *drawn = hows[motion_kinds_below(10)];
    if (!how) how = drawn;
    if (!strcmp(how, "accuracy")) r.accuracy = motion_kinds_below(2) ? 1e-6 : 1e-12;
    if (strtod(how, NULL) > 0) r.accuracy = strtod(how, NULL);
    if (!strcmp(how, "tolerance")) {
        r.method = adaptive[motion_kinds_below(8)];
        r.tolerance = pow(10, -4 - motion_kinds_below(9));
    }
    if (!strcmp(how, "step")) {
        r.method = fixed[motion_kinds_below(8)];
        char text[32];
        snprintf(text, sizeof text, "%.2g", motion_step_of(m, m->step / (1 << motion_kinds_below(4))));
        r.step = strtod(text, NULL);
    }
    return r;
}

static void print_request(const request *r)
{
    printf("motus run - --method %s", r->method);
    if (!isnan(r->accuracy)) printf(" --accuracy %g", r->accuracy);
    if (!isnan(r->tolerance)) printf(" --tolerance %g", r->tolerance);
    if (!isnan(r->step)) printf(" --step %g", r->step);
    printf("\n");
}

/* Counts ---------------------------------------------------------------------------------------------------------- */

typedef struct tally {
    long motions, refused, late, dropped, counted, within, tight, wrong, withheld, none, wrong_motions;
    double worst; /* error over bar */
    double truth_seconds, run_seconds;
} tally;

static double ulp_of(double value) { return nextafter(fabs(value), INFINITY) - fabs(value); }

/* One number of a run beside its truth. */
typedef struct answer {
    char name[64];
    double value, bar;
    quad truth, grain; /* what the truth leaves unknown */
} answer;
enum { ANSWERS = 4 * 2 * MOTION_VARIABLES + MOTION_TRUTH_EVENTS + 1, SAMPLES = 3 };

typedef struct answers {
    answer at[ANSWERS];
    int count;
} answers;

static double error_of(const answer *a)
{
    const quad error = motion_absolute((quad)a->value - a->truth);
    return error <= a->grain ? 0 : (double)error;
}
static double ratio_of(const answer *a)
{
    const double error = error_of(a);
    return error == 0 ? 0 : error / a->bar;
}

/* WHAT=states or events: only these are judged. */
static bool judged(const char *name)
{
    const char *const what = getenv("WHAT");
    return !what || (strstr(name, "event") != NULL) == !strcmp(what, "events");
}

static void give(answers *all, const char *name, double value, double bar, quad truth, quad grain)
{
    if (!judged(name)) return;
    answer *a = &all->at[all->count++];
    snprintf(a->name, sizeof a->name, "%s", name);
    a->value = value, a->bar = bar, a->truth = truth, a->grain = grain;
}

static void count(tally *t, const answer *a)
{
    const double error = error_of(a), ratio = ratio_of(a);
    if (isnan(a->bar)) {
        t->none++;
    } else if (isinf(a->bar)) {
        t->withheld++;
    } else {
        t->counted++;
        t->within += ratio <= 1;
        t->tight += a->bar <= 10 * error || a->bar <= 4 * ulp_of(a->value);
        t->wrong += ratio > 10;
        if (ratio > t->worst) t->worst = ratio;
    }
}

/* A run ----------------------------------------------------------------------------------------------------------- */

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
static double patience;
static int too_long(void *context, double fraction)
{
    (void)fraction;
    return seconds() - *(double *)context > patience;
}

/* A sum of three decimals is a double like any other; the truth is at that double. */
static double sample_time(const motion *m, int k, quad *since)
{
    const double t = (double)motion_time_of(m, m->until * (k + 1) / (SAMPLES + 1));
    const quad from = motion_time_of(m, 0), unit = motion_power_of_ten(m->frame.time);
    *since = motion_absolute((quad)t - from) / unit;
    return t;
}

enum { COLUMNS = 2 * MOTION_VARIABLES };
typedef struct columns {
    size_t at[COLUMNS], count;
    int number[COLUMNS]; /* in the state of the truth */
} columns;

static void find_columns(const motion *m, const motus_system *s, columns *c)
{
    c->count = 0;
    for (int i = 0; i < 2 * m->variables; i++) {
        const bool place = i < m->variables;
        if (!place && m->first_order[i - m->variables]) continue;
        c->number[c->count] = i;
        c->at[c->count++] = column(s, place ? m->place[i] : m->speed[i - m->variables]);
    }
}

static void give_state(const motion *m, const columns *c, const double *values, const double *bars, const quad *y,
                       const char *when, answers *all)
{
    const quad grain = Q(1e-21) * motion_power_of_ten(m->frame.length);
    char name[64];
    for (size_t n = 0; n < c->count; n++) {
        const int i = c->number[n];
        const bool place = i < m->variables;
        snprintf(name, sizeof name, "%s %s", place ? m->place[i] : m->speed[i - m->variables], when);
        if (place)
            give(all, name, values[n], bars[n], motion_place_of(m, i, y[i]), grain);
        else
            give(all, name, values[n], bars[n], motion_speed_of(m, y[i]), grain / motion_power_of_ten(m->frame.time));
    }
}

static void give_events(const motion *m, motus_run *r, const motion_truth *truth, answers *all)
{
    const int64_t rows = motus_run_events(r);
    const quad grain = Q(1e-21) * motion_power_of_ten(m->frame.time);
    char name[64];
    for (int64_t k = 0; k < rows && k < truth->events; k++) {
        motus_event_row row = motus_default_event_row();
        if (motus_run_event(r, k, &row) != MOTUS_OK) continue;
        snprintf(name, sizeof name, "time of event %d", (int)k + 1);
        give(all, name, row.time, row.error, motion_time_of(m, truth->event_time[k]), grain);
    }
    int accumulated = 0;
    double limit = 0, bar = 0;
    motus_run_ended(r, &accumulated, &limit, &bar);
    if (m->gathers != 0)
        give(all, "limit of events", accumulated ? limit : 0, accumulated ? bar : 0, motion_time_of(m, m->gathers),
             grain);
    else
        give(all, "number of events", (double)rows, 0, truth->events, 0);
}

static motus_status run_it(const motion *m, motus_system *s, const request *q, const motion_truth *truth, answers *all,
                           motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    double began = seconds(), values[COLUMNS], bars[COLUMNS];
    def.method = q->method, def.accuracy = q->accuracy, def.tolerance = q->tolerance, def.step = q->step;
    def.machine = "interpreter", def.error = MOTUS_BARS_CHEAP;
    def.progress = too_long, def.context = &began;
    motus_status status = motus_run_create(s, &def, &r, err);
    if (status != MOTUS_OK) return status;
    columns c;
    find_columns(m, s, &c);
    for (int k = 0; k < SAMPLES && status == MOTUS_OK; k++) {
        quad since;
        char when[32];
        const double t = sample_time(m, k, &since);
        status = motus_run_sample_errors(r, &t, 1, c.at, c.count, values, bars, err);
        snprintf(when, sizeof when, "at %.17g", t);
        if (status == MOTUS_OK) give_state(m, &c, values, bars, truth->y[k], when, all);
    }
    if (status == MOTUS_OK) status = motus_run_finish(r, err);
    if (status == MOTUS_OK) status = motus_run_errors(r, c.at, c.count, values, bars, err);
    if (status == MOTUS_OK && m->gathers == 0) give_state(m, &c, values, bars, truth->y[SAMPLES], "at the end", all);
    if (status == MOTUS_OK && m->event_count) give_events(m, r, truth, all);
    motus_run_destroy(r);
    return status;
}

static bool seems_wrong(const answers *all)
{
    for (int i = 0; i < all->count; i++)
        if (isfinite(all->at[i].bar) && ratio_of(&all->at[i]) > 1) return true;
    return false;
}

/* Whether truths by other steps are the same: to a thousandth of what a double shows. */
static bool agree(const motion *m, const motion_truth *a, const motion_truth *b)
{
    quad size = 0;
    for (int i = 0; i < 2 * m->variables; i++)
        for (int k = 0; k <= SAMPLES; k++)
            if (motion_absolute(a->y[k][i]) > size) size = motion_absolute(a->y[k][i]);
    for (int i = 0; i < 2 * m->variables; i++)
        for (int k = 0; k <= SAMPLES; k++)
            if (!(motion_absolute(a->y[k][i] - b->y[k][i]) <= Q(1e-19) * size)) return false;
    return a->events == b->events;
}

static void show(const answers *all)
{
    for (int i = 0; i < all->count; i++) {
        const answer *a = &all->at[i];
        char truth[64];
        motion_show(a->truth, truth, sizeof truth);
        printf("  %-32s %24.17g ± %-10.2g  truth %s  error/bar %.3g%s\n", a->name, a->value, a->bar, truth, ratio_of(a),
               isfinite(a->bar) && ratio_of(a) > 10 ? "  WRONG" : "");
    }
}

static void judge(int kind, uint64_t k, bool told, tally *t)
{
    static motion m;
    static motion_truth truth, other;
    static char text[MOTION_TEXT];
    static answers all;
    motion_kinds_make(&m, kind, k);
    const request q = ask(&m, getenv("HOW"));
    motion_text(&m, text, sizeof text);
    if (told) printf("# %s %d\n%s", motion_kinds_name(kind), (int)k, text), print_request(&q);
    quad at[SAMPLES + 1];
    for (int i = 0; i < SAMPLES; i++) sample_time(&m, i, &at[i]);
    at[SAMPLES] = m.until;
    t->motions++;
    const double began = seconds();
    const char *why = motion_truth_find(&m, at, SAMPLES + 1, false, &truth);
    const double found = seconds();
    t->truth_seconds += found - began;
    if (told)
        printf("truth in %.3g s: %s, %ld switches, %ld held\n", found - began, why ? why : "found", truth.switched,
               truth.held);
    if (why) {
        t->dropped++;
        if (getenv("DROPPED")) printf("%s %d: dropped, %s\n", motion_kinds_name(kind), (int)k, why);
        return;
    }
    motus_error err = motus_default_error();
    motus_system *s = given_text(text);
    all.count = 0;
    const motus_status status = run_it(&m, s, &q, &truth, &all, &err);
    motus_system_destroy(s);
    t->run_seconds += seconds() - found;
    if (told)
        printf("%s in %.3g s%s%s\n", motus_status_word(status), seconds() - found, status ? ": " : "",
               status ? err.message : "");
    if (status != MOTUS_OK) {
        t->refused++;
        t->late += status == MOTUS_CANCELLED;
        if (getenv("REFUSED"))
            printf("%s %d: %s: %s\n", motion_kinds_name(kind), (int)k, motus_status_word(status), err.message);
        return;
    }
    if (told || seems_wrong(&all)) {
        why = motion_truth_find(&m, at, SAMPLES + 1, true, &other);
        if (told) show(&all);
        if (told && why) printf("by other steps: %s\n", why);
        if (why || !agree(&m, &truth, &other)) {
            t->dropped++;
            if (told || getenv("DROPPED"))
                printf("%s %d: dropped, two truths differ\n", motion_kinds_name(kind), (int)k);
            return;
        }
    }
    const long wrong = t->wrong;
    for (int i = 0; i < all.count; i++) {
        count(t, &all.at[i]);
        if (!(isfinite(all.at[i].bar) && ratio_of(&all.at[i]) > (getenv("MISSED") ? 1 : 10))) continue;
        if (!told)
            printf("%s %d: %s %.17g ± %.2g, wrong by %.3g bars\n", motion_kinds_name(kind), (int)k, all.at[i].name,
                   all.at[i].value, all.at[i].bar, ratio_of(&all.at[i]));
    }
    t->wrong_motions += t->wrong > wrong;
    fflush(stdout);
}

static double percent(long part, long of) { return of ? 100.0 * (double)part / (double)of : 100; }

static void print_tally(const char *name, const tally *t)
{
    printf("%-14s %6ld %7ld %7ld %7ld %7ld %8.2f %8.2f %9.2g %6ld %6ld %5.0fs %5.0fs\n", name, t->motions, t->dropped,
           t->refused, t->withheld + t->none, t->counted, percent(t->within, t->counted), percent(t->tight, t->counted),
           t->worst, t->wrong, t->wrong_motions, t->truth_seconds, t->run_seconds);
    fflush(stdout);
}

static void print_heads(void)
{
    printf("%-14s %6s %7s %7s %7s %7s %8s %8s %9s %6s %6s %6s %6s\n", "kind", "tried", "dropped", "refused", "no bar",
           "numbers", "within %", "tight %", "worst", "wrong", "so", "truth", "run");
}

static void add(tally *to, const tally *t)
{
    to->motions += t->motions, to->refused += t->refused, to->late += t->late, to->dropped += t->dropped;
    to->counted += t->counted, to->within += t->within, to->tight += t->tight, to->wrong += t->wrong;
    to->withheld += t->withheld, to->none += t->none, to->wrong_motions += t->wrong_motions;
    to->truth_seconds += t->truth_seconds, to->run_seconds += t->run_seconds;
    to->worst = fmax(to->worst, t->worst);
}

static void bars_by_kind(void **state)
{
    (void)state;
    const char *each = getenv("MOTIONS"), *one = getenv("MOTION"), *kind = getenv("KIND"), *first = getenv("FIRST");
    const int from = one ? atoi(one) : first ? atoi(first) : 0, n = one ? 1 : each ? atoi(each) : 12;
    tally all = {0};
    patience = getenv("PATIENCE") ? atof(getenv("PATIENCE")) : 10;
    print_heads();
    for (int i = 0; i < MOTION_KIND_COUNT; i++) {
        if (kind && strcmp(kind, motion_kinds_name(i)) != 0) continue;
        tally t = {0};
        for (int k = from; k < from + n; k++) judge(i, (uint64_t)k, one, &t);
        print_tally(motion_kinds_name(i), &t);
        add(&all, &t);
    }
    print_tally("all", &all);
    assert_int_equal(all.wrong, 0);
}

static void bars_that_were_wrong(void **state)
{
    (void)state;
    tally t = {0};
    if (getenv("KIND")) skip();
    patience = 10;
    for (size_t i = 0; i < sizeof mended / sizeof *mended; i++)
        judge(mended[i].kind, (uint64_t)mended[i].motion, false, &t);
    print_tally("mended", &t);
    assert_int_equal(t.wrong, 0);
    assert_int_equal(t.refused + t.dropped, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bars_by_kind), cmocka_unit_test(bars_that_were_wrong)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
