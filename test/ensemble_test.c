/* Ensembles: the same bits one trajectory at a time, in lanes of every width, on every number of threads, by either
 * compiler; and the bits of a run of the model with these values.
 *
 * Each model of models/ varies a number that others are computed from. A method costs a compiler run for every width,
 * so `make test` takes a few rows for each model, which together have every family; with MOTUS_ALL_ROWS set, all
 * rows.
 */
#include "test/ensemble_given.h"
#include "test/share.h"

#include <stdbool.h>

/* set: a setting as motus_system_set takes it; NULL: name=… */
typedef struct varied {
    const char *name, *set;
    double from, by;
} varied;

typedef struct given_case {
    const char *model;
    varied vary[VARY_MAX];
    const char *methods; /* in the short test */
    /* Equations of a family are solved one trajectory at a time; if the varied number decides initial values, all
     * trajectories are computed so. */
    enum { IN_LANES, SOLVES_ALONE, ALONE } how;
} given_case;

static const given_case cases[] = {
    {"arenstorf", {{"mu", NULL, 0.0122, 1e-5}, {"y'(0)", NULL, -2, -1e-3}}, "rk4 gauss4 gauss8", IN_LANES},
    {"chain", {{"beta", NULL, 0.5, 0.01}, {"x[3]'(0)", NULL, 0.1, 0.01}}, "velocity-verlet newmark", SOLVES_ALONE},
    {"chain", {{"A", NULL, 0.5, 0.01}}, "verlet", ALONE},
    {"charged-particle",
     {{"q", NULL, 1, 0.01}, {"E.y", "E=(0.5, %s, 0)", 0.1, 0.01}, {"r'.x(0)", "r'(0)=(%s, 0, 0.25)", 1, 0.1}},
     "boris gauss8 kahan-li8",
     IN_LANES},
    {"comet", {{"e", NULL, 0.9, 0.01}, {"a", NULL, 17, 0.1}}, "kahan-li8 velocity-verlet", IN_LANES},
    {"crossed-fields",
     {{"B", NULL, 0.5, 0.05}, {"E.y", "E=(0, %s)", 0.5, 0.1}, {"r'.x(0)", "r'(0)=(%s, 0)", -2, 0.1}},
     "boris exact",
     IN_LANES},
    {"damped-cubic", {{"x(0)", NULL, 9, 0.1}, {"x'(0)", NULL, -1, 0.1}}, "verlet gauss4 kahan-li8", IN_LANES},
    {"damped-spring",
     {{"gamma", NULL, 0.05, 0.01}, {"omega0", NULL, 1.5, 0.1}, {"F", NULL, 0, 0.3}},
     "verlet newmark forest-ruth",
     IN_LANES},
    {"double-pendulum",
     {{"l1", NULL, 0.5, 0.1}, {"m2", NULL, 1, -0.01}, {"θ1(0)", NULL, 1, 0.05}},
     "rk4 verlet gauss6 kahan-li6",
     IN_LANES},
    {"driven-oscillator", {{"F", NULL, 0.01, 0.01}, {"x(0)", NULL, 0, 0.01}}, "verlet beeman kahan-li8", IN_LANES},
    {"driven-oscillator", {{"F", NULL, 0.01, 0.01}}, "velocity-verlet verlet-literal", IN_LANES},
    {"duffing",
     {{"d", NULL, 0.1, 0.01}, {"omega", NULL, 1, 0.05}, {"x'(0)", NULL, 0, 0.1}},
     "explicit-euler verlet-literal gauss4 leapfrog",
     IN_LANES},
    {"henon-heiles", {{"y(0)", NULL, -0.3, 0.01}, {"x'(0)", NULL, 0.3, 0.01}}, "pefrl", IN_LANES},
    {"kepler", {{"e", NULL, 0.1, 0.02}, {"mu", NULL, 0.9, 0.02}}, "kahan-li8 gauss4", IN_LANES},
    {"outer-solar-system",
     {{"G", NULL, 2.9e-4, 1e-6},
      {"m[2]", "m=[1.00000597682, %s, 0.000285583733151, 0.0000437273164546, 0.0000517759138449, 1/1.3e8]", 9e-4, 1e-5},
      {"r[3].x(0)", "r[3](0)=(%s, -3.0458353, -1.6483708)", 9, 0.1}},
     "leapfrog",
     SOLVES_ALONE},
    {"pendulum", {{"omega0", NULL, 0.5, 0.1}, {"theta(0)", NULL, 2, 0.1}}, "blanes-moan6", IN_LANES},
    {"penning-trap", {{"wc", NULL, 9, 0.1}, {"wz", NULL, 1.5, 0.05}}, "boris verlet-literal", IN_LANES},
    {"projectile-drag",
     {{"k", NULL, 0.01, 0.01}, {"g", NULL, 9, 0.1}, {"r'.y(0)", "r'(0)=(30, %s)", 40, 1}},
     "rk4 verlet suzuki4",
     IN_LANES},
    {"projectile", {{"g.y", "g=(0, %s)", -9, -0.1}, {"m", NULL, 1, 0.5}}, "symplectic-euler-adjoint exact", IN_LANES},
    {"resonance", {{"F", NULL, 0.01, 0.01}, {"k", NULL, 1, 0.1}}, "verlet exact", IN_LANES},
    {"spring", {{"k", NULL, 1, 0.1}, {"m", NULL, 1, 0.01}, {"x'(0)", NULL, 0, 0.1}}, "velocity-verlet exact", IN_LANES},
    {"three-body-figure-eight",
     {{"r[1].x(0)", "r[1](0)=(%s, -0.24308753)", 0.9, 0.001},
      {"r[2]'.y(0)", "r[2]'(0)=(0.466203685, %s)", 0.43, 0.001}},
     "verlet",
     SOLVES_ALONE},
    {"three-body-figure-eight", {{"vx[2]", "vx=[0.466203685, %s, -0.93240737]", 0.46, 0.001}}, "kahan-li6", ALONE},
    {"thrown-ball", {{"g.y", "g=(0, %s)", -9, -0.1}, {"r'.y(0)", "r'(0)=(6, %s)", 10, 1}}, "explicit-euler", IN_LANES},
    {"thrown-ball-air",
     {{"m", NULL, 0.3, 0.05}, {"c", NULL, 0, 0.001}, {"r'.y(0)", "r'(0)=(6, %s)", 10, 1}},
     "explicit-euler midpoint",
     IN_LANES},
    {"ueda", {{"k", NULL, 0.05, 0.01}, {"B", NULL, 7, 0.1}, {"x'(0)", NULL, 4, 0.1}}, "rk4 gauss8", IN_LANES},
    {"van-der-pol",
     {{"mu", NULL, 4, 0.1}, {"fed(0)", NULL, 0, 1}, {"x(0)", NULL, 2, 0.01}},
     "rk4 verlet implicit-midpoint",
     IN_LANES},
};
enum { CASES = sizeof cases / sizeof *cases };

/* All of the language, with a varied number in each place. */
static const char rich[] = "N = 4\nm = [1, 2, 3]\nq = 0.3\nB = (0, 0, q)\nw[i] = 1 + q i/10 for i = 1..N\n"
                           "u[i]'' = w[i] (u[i+1] - 2 u[i] + u[i-1]) + 0.1 sum(j = 1..N, j != i: (u[j] - u[i])/(1 + "
                           "|u[j] - u[i]|^3)) for i = 1..N\n"
                           "u[0] = q sin(3 t)\nu[N+1] = q\nu[i](0) = sin(i) for i = 1..N\nu[i]'(0) = 0 for i = 1..N\n"
                           "r'' = -m[2] r/|r|^3 + (t, B.z, sum(k = 1..3: m[k] sum(j = k..3: exp(-j))))\nr(0) = (1, 2, "
                           "q)\nr'(0) = (q, 0.3, 0)\n"
                           "s' = -s r.x/(1 + |r|^2) + floor(10 t) q + if(s > q, 1, sqrt(s + 9))\ns(0) = 1 - q\n"
                           "push = r''.x + u[1]''\nfar[i] = u[i]^2 + u[i-1]^2 + u[i+1] q for i = 1..N\npair[i] = "
                           "(u[i], q u[i]') for i = 1..N\nedge = u[0] + u[N+1]\n"
                           "p'' = -q p\np(0) = q\np'(0) = 1\ninvariant e = p'^2/2 + q p^2/2\nstep 0.01\nuntil 1\n";

/* The text of a model file, or the text above. */
static char *text_of(const char *model)
{
    char path[1024], name[128];
    if (model == rich) return strdup(rich);
    snprintf(name, sizeof name, "%s.motus", model);
    given_path(path, sizeof path, "models", name);
    return given_file(path);
}

static motus_system *read_with(const char *text, const char *const *set, size_t count)
{
    return given_text_with(text, set, count, count ? set[0] : text);
}

enum { SHAPES = 12, SAME_ENDS = 8, COUNTS = 3, MANY = 37 };
static const size_t counts[COUNTS] = {MANY, 1, 2}; /* that fill no block */

/* What is computed, without the machine. */
typedef struct task {
    const given_case *c;
    char *text;
    motus_system *s;
    const char *method, *names[VARY_MAX];
    size_t vary_count, record_count;
    motus_record records[RECORDS_MAX];
    double values[VARY_MAX][COUNT_MAX];
    const double *value_list[VARY_MAX];
    double step, until;
    int64_t every, steps;
    bool ends; /* every trajectory has its own end, which is the last value that varies */
    /* one at a time, by the method that is `plain_by`: the same for every compiler and width */
    outcome plain[SHAPES][COUNTS];
    bool known[SHAPES];
    const char *plain_by;
} task;

/* Every column, once with its final value and once with another reduction. */
static void record_all(task *t)
{
    motus_column c = motus_default_column();
    for (size_t k = 0; motus_column_at(t->s, k, &c) == MOTUS_OK; k++) {
        if (c.kind == MOTUS_COLUMN_EXACT || t->record_count + 2 > RECORDS_MAX) continue;
        t->records[t->record_count++] = (motus_record){MOTUS_REDUCE_FINAL, k};
        t->records[t->record_count++] = (motus_record){(motus_reduction)(MOTUS_REDUCE_MIN + k % 5), k};
    }
}

static void open_task(task *t, const given_case *c)
{
    *t = (task){.c = c, .text = text_of(c->model)};
    t->s = read_with(t->text, NULL, 0);
    record_all(t);
    for (size_t k = 0; k < VARY_MAX && c->vary[k].name; k++) {
        t->names[k] = c->vary[k].name;
        t->value_list[k] = t->values[k];
        for (size_t i = 0; i < COUNT_MAX; i++) /* not sorted, so that exchanged lanes are found */
            t->values[k][i] = c->vary[k].from + c->vary[k].by * (double)((i * (5 + 6 * k) + k) % 23) / 3;
        t->vary_count++;
    }
    motus_settings set = motus_default_settings();
    motus_settings_of(t->s, &set);
    t->step = set.step;
}

static void forget_plain(task *t)
{
    for (int k = 0; k < SHAPES; k++)
        for (int c = 0; t->known[k] && c < COUNTS; c++) forget(&t->plain[k][c]);
    memset(t->known, 0, sizeof t->known);
}

static void close_task(task *t)
{
    forget_plain(t);
    motus_system_destroy(t->s);
    free(t->text);
}

/* An end for every trajectory: at its start, before it, a part of a step behind it, and up to 700 steps later, some
 * whole. */
static void ends(task *t, double start)
{
    double *until = t->values[t->vary_count];
    for (size_t i = 0; i < COUNT_MAX; i++) {
        const double far = (double)((i * 43) % 71 * 10) / (i % 3 ? 1 : 7), steps = i % 5 ? far : floor(far);
        const bool whole = !strcmp(t->method, "verlet-literal");
        const double way = t->step * (whole ? floor(steps) : i == 7 ? 0.3 : steps);
        until[i] = start + (i % 11 == 4 ? -way : way);
        if (i == 20) until[i] = nextafter(start, INFINITY); /* no step leads there */
    }
    t->names[t->vary_count] = "until";
    t->value_list[t->vary_count] = until;
}

/* Ends that the step divides and does not, observations at every distance; ends beyond several chunks of what is
 * computed ahead; and ends that differ. */
static void shape(task *t, int k)
{
    static const int64_t every[] = {1, 7, 1000, 60};
    motus_settings own = motus_default_settings();
    motus_settings_of(t->s, &own);
    t->ends = k >= SAME_ENDS;
    if (t->ends) {
        t->every = every[k - SAME_ENDS];
        t->until = NAN;
        t->steps = 0;
        ends(t, own.from);
        return;
    }
    static const struct {
        double steps;
        int64_t every;
    } shapes[] = {{40, 1}, {30.4, 3}, {0.3, 2}, {29.5, 7}, {1060, 7}, {36, 1000}, {530.25, 530}, {1, 1}};
    motus_settings set = motus_default_settings();
    motus_settings_of(t->s, &set);
    t->steps = (int64_t)ceil(shapes[k].steps);
    if (!strcmp(t->method, "verlet-literal")) /* takes equal steps only */
        t->steps = t->steps > 1 ? t->steps - 1 : 1;
    /* An end one ulp beyond n steps is still n full steps, and its time is `until`. */
    t->until = nextafter(
        set.from + t->step * (strcmp(t->method, "verlet-literal") ? shapes[k].steps : (double)t->steps), INFINITY);
    t->every = shapes[k].every;
}

static motus_ensemble *make(const task *t, const char *machine, int lanes, int threads)
{
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = t->names;
    def.vary_count = t->vary_count + t->ends;
    def.records = t->records;
    def.record_count = t->record_count;
    def.method = t->method;
    def.step = t->step;
    def.until = t->until;
    def.every = t->every;
    def.machine = machine;
    def.lanes = lanes;
    def.threads = threads;
    return given_ensemble(t->s, &def, t->method);
}

/* The oracle: a run ------------------------------------------------------------------------------------------------ */

static void observe(const task *t, motus_run *r, double *kept, double *when, int64_t observations)
{
    motus_error err = motus_default_error();
    for (size_t i = 0; i < t->record_count; i++) {
        const motus_record *one = &t->records[i];
        double now;
        must(motus_run_values(r, &one->column, 1, &now, &err), &err, "observe");
        bool better =
            observations == 0 || isnan(now) ||
            (one->how == MOTUS_REDUCE_MIN || one->how == MOTUS_REDUCE_TIME_OF_MIN ? now < kept[i] : now > kept[i]);
        if (one->how == MOTUS_REDUCE_MEAN)
            kept[i] = observations ? kept[i] + now : now;
        else if (one->how == MOTUS_REDUCE_FINAL || better)
            kept[i] = now;
        if (better && !isnan(now)) when[i] = motus_run_time(r);
    }
}

/* Compares trajectory i of the ensemble with a run of the model with its values. */
static void as_a_run(const task *t, const outcome *o, size_t i)
{
    char set[VARY_MAX][256], number[40];
    const char *list[VARY_MAX] = {set[0], set[1], set[2], set[3], set[4]};
    for (size_t k = 0; k < t->vary_count; k++) {
        const char *format = t->c->vary[k].set;
        snprintf(number, sizeof number, "%.17g", t->values[k][i]);
        if (format)
            snprintf(set[k], sizeof set[k], "%.*s%s%s", (int)(strstr(format, "%s") - format), format, number,
                     strstr(format, "%s") + 2);
        else
            snprintf(set[k], sizeof set[k], "%s=%s", t->names[k], number);
    }
    motus_system *s = read_with(t->text, list, t->vary_count);
    const double until = t->ends ? t->values[t->vary_count][i] : t->until;
    motus_run *r = given_run(s, t->method, t->step, until);
    double *kept = calloc(2 * t->record_count, sizeof *kept), *when = kept + t->record_count;
    int64_t observations = 0;
    motus_error err = motus_default_error();
    motus_status status = MOTUS_OK;
    while (status == MOTUS_OK) {
        if (motus_run_done(r) || motus_run_steps(r) % t->every == 0) observe(t, r, kept, when, observations++);
        if (motus_run_done(r)) break;
        status = motus_run_step(r, 1, &err);
    }
    /* Where a run diverges, the trajectory stopped at that time and has no results. */
    if (status != MOTUS_OK && (status != MOTUS_DIVERGED || err.time != o->stopped[i]))
        fail_msg("%s by %s, trajectory %zu: stopped at %.17g; a run says %s", t->c->model, t->method, i, o->stopped[i],
                 err.message);
    if (status == MOTUS_OK) assert_true(isnan(o->stopped[i]));
    for (size_t k = 0; status != MOTUS_OK && k < t->record_count; k++) assert_true(isnan(o->at[k][i]));
    for (size_t k = 0; status == MOTUS_OK && k < t->record_count; k++) {
        const motus_reduction how = t->records[k].how;
        double expected = how == MOTUS_REDUCE_MEAN ? kept[k] / (double)observations
                          : how == MOTUS_REDUCE_TIME_OF_MIN || how == MOTUS_REDUCE_TIME_OF_MAX ? when[k]
                                                                                               : kept[k];
        /* The sign of a zero that is a minimum or maximum is not specified. */
        if (!same_number(expected, o->at[k][i]) &&
            !(expected == 0 && o->at[k][i] == 0 && (how == MOTUS_REDUCE_MIN || how == MOTUS_REDUCE_MAX)))
            fail_msg(
                "%s by %s, until %g, every %lld: trajectory %zu, record %zu (%d of column %zu) is %a; a run says %a",
                t->c->model, t->method, until, (long long)t->every, i, k, (int)how, t->records[k].column, o->at[k][i],
                expected);
    }
    free(kept);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The same bits ---------------------------------------------------------------------------------------------------- */

/* Requires lanes wherever there are any, since a fallback would agree with itself. Matrices of families and the exact
 * motion have no lanes. */
static bool goes_alone(const task *t)
{
    const motus_method *m;
    motus_analysis a = motus_default_analysis();
    assert_int_equal(motus_method_find(t->method, &m, NULL), MOTUS_OK);
    assert_int_equal(motus_analysis_of(t->s, &a), MOTUS_OK);
    const bool solves = !strcmp(m->family, "implicit") || (a.velocity_dependent && strncmp(m->name, "verlet", 6) == 0);
    return t->c->how == ALONE || !strcmp(m->family, "exact") || (t->ends && !strcmp(m->name, "boris")) ||
           (solves && t->c->how == SOLVES_ALONE);
}

/* One case: one trajectory at a time, some of them compared with runs. */
static const outcome *one_by_one(task *t, int k, const char *what)
{
    if (t->plain_by != t->method) forget_plain(t);
    t->plain_by = t->method;
    if (t->known[k]) return t->plain[k];
    motus_ensemble *plain = make(t, "interpreter", 0, 1);
    assert_int_equal(motus_ensemble_now(plain).steps, t->steps);
    assert_string_equal(motus_ensemble_now(plain).machine, "interpreter");
    for (int c = 0; c < COUNTS; c++) t->plain[k][c] = go(plain, counts[c], t->record_count, t->value_list, what);
    for (size_t i = 0; i < counts[0]; i += 18) as_a_run(t, &t->plain[k][0], i);
    motus_ensemble_destroy(plain);
    t->known[k] = true;
    return t->plain[k];
}

/* The same case, compiled. */
static void compare(task *t, int k, int lanes, int threads)
{
    char what[200];
    shape(t, k);
    snprintf(what, sizeof what, "%s by %s, shape %d, %d lanes, %d threads, %s", t->c->model, t->method, k, lanes,
             threads, getenv("CC") ? getenv("CC") : "cc");
    const outcome *plain = one_by_one(t, k, what);
    motus_ensemble *fast = make(t, "compiled", lanes, threads);
    assert_string_equal(motus_ensemble_now(fast).machine, "compiled");
    const bool alone = motus_ensemble_now(fast).note[0] != 0;
    if (alone != goes_alone(t)) fail_msg("%s: %s", what, motus_ensemble_now(fast).note);
    if (lanes && !alone) assert_int_equal(motus_ensemble_now(fast).lanes, lanes);
    for (int c = 0; c < COUNTS; c++) {
        outcome b = go(fast, counts[c], t->record_count, t->value_list, what);
        same_outcome(&plain[c], &b, what);
        forget(&b);
    }
    motus_ensemble_destroy(fast);
}

/* Sets CC; false: that compiler is not installed. */
static bool use_compiler(const char *cc)
{
    char command[64];
    snprintf(command, sizeof command, "command -v %s >/dev/null", cc);
    if (system(command)) {
        print_message("there is no %s: left out\n", cc);
        return false;
    }
    setenv("CC", cc, 1);
    return true;
}

static bool all_rows(void) { return getenv("MOTUS_ALL_ROWS") != NULL; }

static bool wanted(const char *list, const char *method)
{
    const char *at = strstr(list, method);
    size_t n = strlen(method);
    while (at && ((at > list && at[-1] != ' ') || (at[n] && at[n] != ' '))) at = strstr(at + 1, method);
    return at != NULL;
}

static void every_model(void **state)
{
    (void)state;
    static const char *const compilers[] = {"gcc", "clang"};
    static const int widths[] = {0, 1, 2, 4, 8, 16, 32};
    enum { WIDTHS = sizeof widths / sizeof *widths };
    int pairs = 0, tried = 0;
    for (size_t c = 0; c < CASES; c++) {
#ifdef SANITIZED
        if (c % 4 && !all_rows()) /* the sanitizers check the library's part, which is the same for all */
            continue;
#endif
        task t;
        open_task(&t, &cases[c]);
        for (size_t k = 0; k < motus_method_count(); k++) {
            t.method = motus_method_at(k)->name;
            if (motus_method_admits(t.s, t.method, NULL) != MOTUS_OK ||
                (!all_rows() && !wanted(t.c->methods, t.method)))
                continue;
            pairs++;
            if (!share_takes(&tried)) continue;
            for (int cc = 0; cc < 2; cc++) {
                if ((!all_rows() && cc != pairs % 2) || !use_compiler(compilers[cc])) continue;
                for (int w = 0; w < WIDTHS; w++) /* One trajectory at a time is one lane. */
                    if (all_rows() ? w == 0 || !goes_alone(&t) : w == (pairs / 2) % (WIDTHS - 2))
                        for (int f = 0; f < SHAPES; f++) compare(&t, f, widths[w], 1 + f % 2);
            }
        }
        close_task(&t);
    }
    unsetenv("CC");
    print_message("%d pairs of model and method\n", pairs);
#ifndef SANITIZED
    assert_true(pairs >= 26);
#endif
}

static const given_case everything = {
    rich, {{"q", NULL, 0.1, 0.05}, {"m[2]", "m=[1, %s, 3]", 1, 0.1}}, "rk4", IN_LANES};

/* A small model and one with all of the language, in lanes of every width, by both compilers. */
static void every_width(void **state)
{
    (void)state;
    static const char *const compilers[] = {"gcc", "clang"};
    static const struct {
        const given_case *c;
        const char *method;
    } pairs[] = {{&cases[7], "verlet"}, {&everything, "rk4"}};
    int tried = 0;
    for (int p = 0; p < 2; p++) {
        task t;
        open_task(&t, pairs[p].c);
        t.method = pairs[p].method;
        for (int cc = 0; cc < 2; cc++) {
            if (!use_compiler(compilers[cc])) continue;
            for (int lanes = 0; lanes <= 64; lanes = lanes ? 2 * lanes : 1) {
#ifdef SANITIZED
                if (lanes % 8) continue;
#endif
                /* A compiler's time grows with the lanes, so the large model is tested in a few widths. */
                if (!all_rows() && (p == 1 ? lanes != (cc ? 1 : 0) && lanes != (cc ? 8 : 2)
                                           : cc && lanes != 0 && lanes != 4 && lanes != 32))
                    continue;
                if (!share_takes(&tried)) continue;
                for (int f = 0; f < SHAPES; f += 1 + (lanes > 2)) compare(&t, f, lanes, 1 + f / 2 % 2);
            }
        }
        close_task(&t);
    }
    unsetenv("CC");
}

/* Backward, from a start that is not 0, to an end that is not t0 + n h. */
static void elsewhere_in_time(void **state)
{
    (void)state;
    static const char text[] = "q = 1\nx'' = -x + q cos(t)\nx(2) = q\nx'(2) = 0\npush = x'' + t\nstep 0.1\nuntil 1\n";
    motus_system *s = given_text(text);
    static const char *const names[] = {"q", "x'(2)"};
    const double q[3] = {1, 1.5, -0.25}, v[3] = {0, 1, 2}, *const values[] = {q, v};
    const motus_record records[] = {{MOTUS_REDUCE_FINAL, column(s, "x")},
                                    {MOTUS_REDUCE_TIME_OF_MAX, column(s, "x")},
                                    {MOTUS_REDUCE_FINAL, column(s, "push")},
                                    {MOTUS_REDUCE_MIN, 0},
                                    {MOTUS_REDUCE_FINAL, 0}};
    for (int k = 0; k < 3; k++) {
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = names;
        def.vary_count = 2;
        def.records = records;
        def.record_count = 5;
        def.method = k == 1 ? "rk4" : "leapfrog";
        def.until = k == 2 ? 2 : 1.3 - 0.25 * k; /* k == 2: no step at all */
        def.every = 2;
        def.machine = "interpreter";
        motus_ensemble *a = given_ensemble(s, &def, "backward");
        def.machine = "compiled";
        motus_ensemble *b = given_ensemble(s, &def, "backward");
        outcome p = go(a, 3, 5, values, "backward"), o = go(b, 3, 5, values, "backward");
        same_outcome(&p, &o, "backward");
        for (int i = 0; i < 3; i++) {
            assert_true(o.at[4][i] == def.until && o.at[3][i] == def.until);
            char set[2][64];
            const char *list[2] = {set[0], set[1]};
            snprintf(set[0], sizeof set[0], "q=%.17g", q[i]);
            snprintf(set[1], sizeof set[1], "x'(2)=%.17g", v[i]);
            motus_system *one = read_with(text, list, 2);
            motus_run *r = given_run(one, def.method, NAN, def.until);
            finish(r);
            assert_true(same_number(value(one, r, "x"), o.at[0][i]) && same_number(value(one, r, "push"), o.at[2][i]));
            motus_run_destroy(r);
            motus_system_destroy(one);
        }
        forget(&p);
        forget(&o);
        motus_ensemble_destroy(a);
        motus_ensemble_destroy(b);
    }
    motus_system_destroy(s);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(elsewhere_in_time), cmocka_unit_test(every_width),
                                       cmocka_unit_test(every_model)};
    int failed = cmocka_run_group_tests_name("ensembles", tests, NULL, NULL);
    close_cache();
    return failed;
}
