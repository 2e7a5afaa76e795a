/* Nobody waits for a compiler: runs that begin in the interpreter and go on compiled have the interpreter's bits,
 * wherever they go over; and the compiler that works beside them, when it is slow, fails, hangs, is killed, is missing
 * or is not waited for. */
#include "api/error/bars.h"
#include "api/motion/later.h"
#include "test/later.h"

#include <pthread.h>

static const char pair[] = "x'' = -x/(x^2 + y^2)^1.5 + 0.1 y\ny'' = -y/(x^2 + y^2)^1.5 + 0.05 cos(1.3 t)\n"
                           "x(0) = 1\nx'(0) = 0.1\ny(0) = 0.3\ny'(0) = 0.9\nstep 0.05\nuntil 2\n",
                  friction[] =
                      "x'' = -x + 0.3 x' - x^2 x' + cos(2 t)\ns' = x x' - 0.1 s\nx(0) = 0.5\nx'(0) = 0.1\ns(0) = 1\n"
                      "step 0.05\nuntil 2\n",
                  chain[] =
                      "N = 40\nu[i]'' = u[i-1] - 2 u[i] + u[i+1] - 0.3 u[i]^3   for i = 1..N\nu[0] = 0.1 sin(t)\n"
                      "u[N+1] = 0\nu[i](0) = sin(i)   for i = 1..N\nu[i]'(0) = 0   for i = 1..N\nstep 0.05\nuntil 2\n",
                  magnet[] = "r'' = cross(r', (0, 0, 1.5)) - 0.1 r\nr(0) = (1, 0, 0.2)\nr'(0) = (0, 0.7, 0.1)\nstep "
                             "0.05\nuntil 2\n";

/* ---- the bits ---- */

enum { STEPS = 17, ROOM = 100 };

typedef struct end {
    double state[ROOM], between[ROOM], errors[ROOM];
    size_t count;
    motus_run_statistics done;
} end;

/* In portions, sampled within a step, with a shorter last step. at: where it goes over; 0: interpreted. longer: where
 * it takes the longer text; 0: nowhere. */
static end go_twice(motus_system *s, const char *method, int64_t at, int64_t longer)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    end e = {.count = motus_positions(s) + motus_velocities(s)};
    size_t columns[ROOM];
    for (size_t k = 0; k < e.count; k++) columns[k] = k + 1;
    def.method = method, def.machine = at ? "compiled" : "interpreter", def.until = 0.05 * (STEPS - 0.4);
    def.error = MOTUS_BARS_CHEAP;
    given_step(&def, 0.05);
    must(motus_run_create(s, &def, &r, &err), &err, method);
    if (at) must(later_at(r, at, longer, &err), &err, method);
    take_steps(r, 3);
    const double time = motus_run_time(r) + 0.02;
    must(motus_run_sample(r, &time, 1, columns, e.count, e.between, &err), &err, method);
    take_steps(r, 4);
    finish(r);
    must(motus_run_errors(r, columns, e.count, e.state, e.errors, &err), &err, method);
    must(motus_run_state(r, e.state, e.state + motus_positions(s), &err), &err, method);
    e.done = motus_run_now(r);
    assert_string_equal(e.done.machine, at ? "compiled" : "interpreter");
    assert_int_equal(r->chosen.written, longer != 0);
    motus_run_destroy(r);
    return e;
}

static end go(motus_system *s, const char *method, int64_t at) { return go_twice(s, method, at, 0); }

static void same(const end *a, const end *b, const char *method, int64_t at)
{
    const size_t bytes = a->count * sizeof(double);
    if (memcmp(a->state, b->state, bytes)) fail_msg("%s that goes over at %d ends elsewhere", method, (int)at);
    if (memcmp(a->between, b->between, bytes)) fail_msg("%s that goes over at %d passes elsewhere", method, (int)at);
    if (memcmp(a->errors, b->errors, bytes)) fail_msg("%s that goes over at %d has other errors", method, (int)at);
    assert_int_equal(b->done.compiled_from, at);
    assert_int_equal(a->done.compiled_from, -1);
    assert_int_equal(a->done.steps, b->done.steps);
    assert_int_equal(a->done.refused, b->done.refused);
    assert_int_equal(a->done.evaluations, b->done.evaluations);
    assert_int_equal(a->done.iterations, b->done.iterations);
    assert_true(a->done.shortest_step == b->done.shortest_step && a->done.longest_step == b->done.longest_step);
    assert_true(a->done.first_step == b->done.first_step && a->done.last_step == b->done.last_step);
}

/* One row of every family's text, on forces of every kind. */
static void at_every_step(void **unused)
{
    (void)unused;
    static const char *const texts[] = {pair, friction, chain, magnet};
    static const char *const rows[] = {"verlet",
                                       "velocity-verlet",
                                       "blanes-moan6",
                                       "kahan-li8",
                                       "rk4",
                                       "newmark",
                                       "gauss4",
                                       "boris",
                                       "dopri5",
                                       "dop853",
                                       "dep6",
                                       "fine5",
                                       "radau15",
                                       "taylor",
                                       "verlet-reversible",
                                       "beeman",
                                       "gragg",
                                       "gragg-stormer",
                                       "kahan-li8-reversible",
                                       "gauss8-reversible"};
    int pairs = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
            motus_system *s = given_text(texts[i]);
            const bool every = (i + k) % 3 == 0; /* a compiler's time for each */
            if (every && motus_method_admits(s, rows[k], NULL) == MOTUS_OK) {
                const end a = go(s, rows[k], 0);
                for (int64_t at = 1; at < a.done.steps - 1; at++) {
                    const end b = go(s, rows[k], at);
                    same(&a, &b, rows[k], at);
                }
                pairs++;
            }
            motus_system_destroy(s);
        }
    print_message("%d pairs of model and method\n", pairs);
    assert_true(pairs >= 12);
}

/* Steps with a loop over stages, then with all stages written out, and with the bounds of events. */
static void through_both_texts(void **unused)
{
    (void)unused;
    static const char events[] = "x'' = -x/(x^2 + y^2)^1.5 + 0.1 x y\ny'' = -y/(x^2 + y^2)^1.5\nx(0) = 1\nx'(0) = 0.1\n"
                                 "y(0) = 0.3\ny'(0) = 0.9\nwhen y = 0.5 rising: y' = 0.7 y'\nwhen x = 2: record\n"
                                 "step 0.05\nuntil 2\n";
    /* divisions, roots and products of them two at a time, some of them without a partner */
    static const char centres[] = "d = sqrt((x - 1)^2 + y^2)\ne = sqrt((x + 2)^2 + y^2/(1 + x^2))\n"
                                  "x'' = -(x - 1)/d^3 - 0.3 (x + 2)/e^3 + 1/(1 + sqrt(1 + y'^2/(1 + e)))\n"
                                  "y'' = -y/d^3 - 0.3 y/e^3 + x'/(2 + d)\nx(0) = 0.2\ny(0) = 0.6\nx'(0) = 0.3\n"
                                  "y'(0) = -0.8\nstep 0.05\nuntil 2\n";
    static const struct {
        const char *text, *method;
    } pairs[] = {{centres, "verner9"},           {pair, "dop853"},   {friction, "verner9"}, {magnet, "dop853"},
                 {pair, "kahan-li8-reversible"}, {events, "taylor"}, {events, "verner8"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        end ends[2];
        for (int both = 0; both < 2; both++) {
            motus_system *s = given_text(pairs[i].text);
            compile_and_count("");
            ends[both] = go_twice(s, pairs[i].method, 2 * both, 4 * both);
            const int compiled = calls(); /* the companion's too, whose numbers are others */
            assert_true(both ? compiled >= 2 : compiled == 0);
            motus_system_destroy(s);
        }
        same(&ends[0], &ends[1], pairs[i].method, 2);
    }
}

/* ---- compilers ---- */

/* So long that it repays a compiler. */
enum { LONG = 1500000 };
static motus_run *long_run(motus_system *s, const char *machine)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "rk4", def.machine = machine, def.step = 0.001, def.until = 0.001 * LONG;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    return r;
}

static void ends_alike(motus_system *s, motus_run *r, const char *what)
{
    static motus_run *known;
    static motus_system *own;
    if (!known) {
        own = given_text(pair);
        known = long_run(own, "interpreter");
        finish(known);
    }
    if (!s) {
        motus_run_destroy(known);
        motus_system_destroy(own);
        return;
    }
    finish(r);
    same_state(s, r, known, what);
    assert_int_equal(motus_run_now(r).evaluations, motus_run_now(known).evaluations);
}

static int64_t compiled_from(const motus_run *r)
{
    const motus_run_statistics done = motus_run_now(r);
    return done.compiled_from;
}

/* Goes on in small portions until the run is compiled. */
static void go_till_compiled(motus_run *r)
{
    while (compiled_from(r) < 0 && !motus_run_done(r)) {
        take_steps(r, 1);
        nanosleep(&(struct timespec){.tv_nsec = 200000}, NULL);
    }
    assert_true(compiled_from(r) > 0);
    assert_string_equal(motus_run_now(r).machine, "compiled");
    assert_string_equal(motus_run_now(r).note, "");
}

/* Goes on compiled, ends as a run that did not, and leaves nothing. */
static void ends_compiled(motus_system *s, motus_run *r, const char *what)
{
    go_till_compiled(r);
    ends_alike(s, r, what);
    motus_run_destroy(r);
    motus_system_destroy(s);
    nothing_is_left(what);
}

static void the_compiler_is_slow(void **unused)
{
    (void)unused;
    compile_by("sleep 0.2\nexec cc \"$@\"");
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto"), *twin = long_run(s, "auto");
    assert_string_equal(motus_run_now(r).machine, "interpreter");
    assert_int_equal(compiled_from(r), -1);
    go_till_compiled(r);
    go_till_compiled(twin);
    ends_alike(s, r, "slow");
    ends_alike(s, twin, "slow, twin");
    motus_run_destroy(r);
    motus_run_destroy(twin);
    nothing_is_left("slow");
    /* the next run finds the object */
    r = long_run(s, "auto");
    assert_int_equal(compiled_from(r), 0);
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = given_text(pair);
    r = long_run(s, "auto");
    assert_int_equal(compiled_from(r), 0);
    ends_alike(s, r, "found");
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Whoever waits for an object of one system shares one compiler, which ends when the last of them is gone. */
static void runs_share_a_compiler(void **unused)
{
    (void)unused;
    compile_and_count("sleep 0.2");
    motus_system *s = given_text(pair);
    motus_run *r[3];
    for (int i = 0; i < 3; i++) r[i] = long_run(s, "auto");
    motus_run_destroy(r[0]);
    go_till_compiled(r[1]);
    motus_run_destroy(r[1]);
    go_till_compiled(r[2]);
    motus_run_destroy(r[2]);
    assert_int_equal(calls(), 1);
    motus_system_destroy(s);
    nothing_is_left("shared");
}

static void fails(const char *script, const char *note)
{
    compile_by(script);
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    ends_alike(s, r, script);
    assert_string_equal(motus_run_now(r).machine, "interpreter");
    assert_int_equal(compiled_from(r), -1);
    if (!strstr(motus_run_now(r).note, note)) fail_msg("%s: the note is \"%s\"", script, motus_run_now(r).note);
    motus_run_destroy(r);
    nothing_is_left(script);
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    def.machine = "compiled", def.step = 0.1;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_TOOL);
    assert_non_null(strstr(err.message, note));
    motus_system_destroy(s);
    nothing_is_left(script);
}

static void the_compiler_fails(void **unused)
{
    (void)unused;
    fails("echo no licence\nexit 1", "no licence");
    fails("exit 3", "it stopped without a message");
    fails("exit 0", "");                                 /* and has written nothing */
    fails("kill -9 $$", "it stopped without a message"); /* twice, since it is started once more */
    fails("case \"$*\" in *model.c*) for o; do :; done; : > \"$o\";; *) echo cannot link; exit 1;; esac",
          "cannot link");
    setenv("CC", "/nosuch", 1);
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    assert_non_null(strstr(motus_run_now(r).note, "CC is \"/nosuch\""));
    ends_alike(s, r, "missing");
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A run that ends before the compiler does not wait for it, and kills it with all that it has started. */
static void the_compiler_hangs(void **unused)
{
    (void)unused;
    for (int ends = 0; ends < 2; ends++) {
        compile_for_ever();
        motus_system *s = given_text(pair);
        motus_run *r = long_run(s, "auto");
        const pid_t child = its_child();
        if (ends) ends_alike(s, r, "hangs");
        assert_string_equal(motus_run_now(r).machine, "interpreter");
        motus_run_destroy(r);
        assert_true(dead(child));
        nothing_is_left("hangs");
        motus_system_destroy(s);
    }
}

/* A run whose number of steps is not known considers a compiler on the way, and goes on beside it. */
static void steps_that_adapt_go_on(void **unused)
{
    (void)unused;
    compile_for_ever();
    motus_system *s = given_text("x'' = -sin(x) + 0.1 cos(t)\nx(0) = 1; x'(0) = 0");
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "dop853", def.tolerance = 1e-13, def.until = 100000, def.error = MOTUS_BARS_NONE;
    def.machine = "auto";
    must(motus_run_create(s, &def, &r, &err), &err, "adapts");
    alarm(120); /* it would wait for the compiler, which never ends */
    must(motus_run_step(r, 300000, &err), &err, "adapts");
    const pid_t child = its_child();
    finish(r);
    alarm(0);
    assert_string_equal(motus_run_now(r).machine, "interpreter");
    motus_run_destroy(r);
    assert_true(dead(child));
    nothing_is_left("adapts");
    motus_system_destroy(s);
}

/* The copy of a process leaves the compiler of the original alone, and starts its own. */
static void after_fork(void **unused)
{
    (void)unused;
    compile_by("sleep 0.2\nexec cc \"$@\"");
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    take_steps(r, 3);
    const pid_t copy = fork();
    if (copy == 0) {
        motus_error err = motus_default_error();
        bool ok = true;
        while (ok && compiled_from(r) < 0 && !motus_run_done(r)) {
            ok = motus_run_step(r, 1, &err) == MOTUS_OK;
            nanosleep(&(struct timespec){.tv_nsec = 200000}, NULL);
        }
        ok = ok && compiled_from(r) > 0;
        motus_run_destroy(r);
        motus_system_destroy(s);
        _exit(ok && waitpid(-1, NULL, WNOHANG) == -1 ? 0 : 1);
    }
    int status = 0;
    go_till_compiled(r);
    ends_alike(s, r, "original");
    assert_int_equal(waitpid(copy, &status, 0), copy);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    motus_run_destroy(r);
    motus_system_destroy(s);
    nothing_is_left("fork");
}

/* A copy that gives the run back leaves the original's compiler at work. */
static void fork_and_leave(void **unused)
{
    (void)unused;
    compile_by("sleep 0.2\nexec cc \"$@\"");
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    const pid_t copy = fork();
    if (copy == 0) {
        motus_run_destroy(r);
        motus_system_destroy(s);
        _exit(0);
    }
    assert_int_equal(waitpid(copy, NULL, 0), copy);
    go_till_compiled(r);
    motus_run_destroy(r);
    motus_system_destroy(s);
    nothing_is_left("fork");
}

/* Where the program has said that it waits for no child, the system gives none back. */
static void children_are_ignored(void **unused)
{
    (void)unused;
    compile_by("sleep 0.1\nexec cc \"$@\"");
    signal(SIGCHLD, SIG_IGN);
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    go_till_compiled(r);
    ends_alike(s, r, "ignored");
    motus_run_destroy(r);
    motus_system_destroy(s);
    fails("exit 1", "it stopped without a message");
    signal(SIGCHLD, SIG_DFL);
}

static void *begin_run(void *context)
{
    motus_system *s = context;
    return long_run(s, "auto");
}

/* Whoever dies, a program by Ctrl-C or a killed one, takes the compiler along, with all that it has started. */
static void the_process_dies(void **unused)
{
    (void)unused;
    static const int signals[] = {SIGINT, SIGKILL};
    char command[200];
    for (size_t k = 0; k < sizeof signals / sizeof *signals; k++) {
        compile_for_ever();
        const pid_t program = fork();
        if (program == 0) {
            motus_run *r = long_run(given_text(pair), "auto");
            while (motus_run_now(r).machine) pause();
        }
        const pid_t child = its_child();
        kill(program, signals[k]);
        assert_int_equal(waitpid(program, NULL, 0), program);
        assert_true(dead(child));
        snprintf(command, sizeof command, "rm -r %s/motus/build-*", given_cache); /* one that is an hour old would go */
        assert_int_equal(system(command), 0);
    }
    nothing_is_left("a process that dies");
}

/* The compiler outlives the thread that started it. */
static void the_thread_ends(void **unused)
{
    (void)unused;
    calls();
    compile_and_count("sleep 0.1");
    motus_system *s = given_text(pair);
    pthread_t thread;
    void *run = NULL;
    assert_int_equal(pthread_create(&thread, NULL, begin_run, s), 0);
    assert_int_equal(pthread_join(thread, &run), 0);
    ends_compiled(s, run, "thread");
    assert_int_equal(calls(), 1);
}

/* Nothing of a cache: the object is compiled for this run alone. */
static void without_a_cache(void **unused)
{
    (void)unused;
    compile_by("exec cc \"$@\"");
    setenv("SUDO_UID", "1", 1);
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "auto");
    ends_compiled(s, r, "no cache");
    unsetenv("SUDO_UID");
}

/* A run that is no longer than a compiler's work starts none, nor does the interpreter. */
static void these_start_none(void **unused)
{
    (void)unused;
    compile_and_count("");
    motus_system *s = given_text(pair);
    motus_run *r = long_run(s, "interpreter");
    ends_alike(s, r, "interpreter");
    motus_run_destroy(r);
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    must(motus_run_create(s, &def, &r, &err), &err, "short");
    finish(r);
    motus_run_destroy(r);
    r = long_run(s, NULL); /* nobody asks for one */
    ends_alike(s, r, "nobody asks");
    motus_run_destroy(r);
    setenv("MOTUS_COMPILER", "none", 1);
    r = long_run(s, "auto");
    ends_alike(s, r, "forbidden");
    assert_string_equal(motus_run_now(r).note, "MOTUS_COMPILER=none forbids a compiler");
    motus_run_destroy(r);
    unsetenv("MOTUS_COMPILER");
    assert_int_equal(calls(), 0);
    motus_system_destroy(s);
}

/* A companion goes on compiled too, by an object of its own system, and beside beeman of another method. */
static void companions(void **unused)
{
    (void)unused;
    static const char *const rows[] = {"beeman", "rk4"};
    for (int i = 0; i < 2; i++) {
        compile_by("sleep 0.1\nexec cc \"$@\"");
        motus_system *s = given_text(pair);
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        def.method = rows[i], def.step = 0.001, def.until = 1, def.error = MOTUS_BARS_CHEAP;
        must(motus_run_create(s, &def, &r, &err), &err, rows[i]);
        must(later_at(r, 5, 0, &err), &err, rows[i]);
        finish(r);
        assert_string_equal(motus_run_now(r).machine, "compiled");
        assert_string_equal(r->bars->half.machine.name, "compiled");
        motus_run_destroy(r);
        motus_system_destroy(s);
        nothing_is_left(rows[i]);
    }
}

/* Legs and restored states while the compiler works. */
static void legs_meanwhile(void **unused)
{
    (void)unused;
    compile_by("sleep 0.1\nexec cc \"$@\"");
    motus_system *s = given_text(pair);
    motus_run *r[2];
    motus_error err = motus_default_error();
    for (int i = 0; i < 2; i++) {
        r[i] = long_run(s, i ? "auto" : "interpreter");
        take_steps(r[i], 100);
        const char *text = NULL;
        size_t length = 0;
        must(motus_run_save(r[i], &text, &length, &err), &err, "save");
        char *kept = malloc(length + 1);
        memcpy(kept, text, length + 1);
        take_steps(r[i], 50);
        must(motus_run_restore(r[i], kept, length, &err), &err, "restore");
        free(kept);
        const double x[2] = {0.9, 0.2}, v[2] = {0.1, 1};
        take_steps(r[i], 7);
        must(motus_run_set_state(r[i], 0.5, x, v, &err), &err, "leg");
        if (i) go_till_compiled(r[i]);
        finish(r[i]);
    }
    same_state(s, r[0], r[1], "legs");
    assert_int_equal(motus_run_now(r[0]).evaluations, motus_run_now(r[1]).evaluations);
    motus_run_destroy(r[0]);
    motus_run_destroy(r[1]);
    motus_system_destroy(s);
    nothing_is_left("legs");
}

/* The object of a model serves the model with a section. */
static void a_section_compiles_nothing(void **unused)
{
    (void)unused;
    static const char *const rows[] = {"taylor", "dop853"}, *const section = "x = 0.2 rising: record";
    for (int i = 0; i < 2; i++) {
        motus_run_def def = motus_default_run();
        def.method = rows[i], def.until = 100, def.machine = "compiled";
        compile_and_count("");
        for (int with = 0; with < 2; with++) {
            motus_error err = motus_default_error();
            motus_text_def text = motus_default_text();
            motus_system *s = NULL;
            motus_run *r = NULL;
            text.text = pair, text.when = &section, text.when_count = with;
            must(motus_system_from_text(&text, &s, &err), &err, "system");
            must(motus_run_create(s, &def, &r, &err), &err, rows[i]);
            finish(r);
            assert_string_equal(motus_run_now(r).machine, "compiled");
            assert_true(!with || motus_run_events(r) > 0);
            assert_int_equal(calls(), !with);
            motus_run_destroy(r);
            motus_system_destroy(s);
            def.machine = "auto";
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_every_step),
        cmocka_unit_test(through_both_texts),
        cmocka_unit_test(a_section_compiles_nothing),
        cmocka_unit_test(the_compiler_is_slow),
        cmocka_unit_test(runs_share_a_compiler),
        cmocka_unit_test(the_compiler_fails),
        cmocka_unit_test(the_compiler_hangs),
        cmocka_unit_test(steps_that_adapt_go_on),
        cmocka_unit_test(after_fork),
        cmocka_unit_test(fork_and_leave),
        cmocka_unit_test(children_are_ignored),
        cmocka_unit_test(the_process_dies),
        cmocka_unit_test(the_thread_ends),
        cmocka_unit_test(without_a_cache),
        cmocka_unit_test(these_start_none),
        cmocka_unit_test(legs_meanwhile),
        cmocka_unit_test(companions),
    };
    open_cache();
    if (!mkdtemp(tools)) return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ends_alike(NULL, NULL, NULL);
    remove_tools();
    close_cache();
    return failed;
}
