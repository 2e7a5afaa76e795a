/* The public calls that need no run: definitions, systems from texts and callbacks, their contents, the catalogue,
 * and every status.
 *
 * Runs are in run_test.c, restart states in restart_test.c, memory in alloc_test.c.
 */
#include "api/system/system.h"
#include "test/given.h"

static const char spring[] = "k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nmethod verlet\nstep 0.1\nuntil 1\n";

/* Words ------------------------------------------------------------------------------------------------------------ */

static void statuses_have_words(void **state)
{
    (void)state;
    for (int i = 0; i < MOTUS_STATUS_COUNT; i++) {
        assert_true(strlen(motus_status_word(i)) > 1);
        assert_true(strlen(motus_status_text(i)) > 3);
        assert_true(i == 0 ? motus_status_exit(i) == 0 : motus_status_exit(i) == 1 || motus_status_exit(i) == 2);
        for (int j = 0; j < i; j++) assert_string_not_equal(motus_status_word(i), motus_status_word(j));
    }
    assert_string_equal(motus_status_word(MOTUS_DIVERGED), "diverged");
    assert_int_equal(motus_status_exit(MOTUS_SYNTAX), 2);
    assert_non_null(motus_status_text((motus_status)999));
    assert_non_null(motus_status_word((motus_status)-1));
    assert_string_equal(motus_version(), MOTUS_VERSION);
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", MOTUS_VERSION_MAJOR, MOTUS_VERSION_MINOR, MOTUS_VERSION_PATCH);
    assert_string_equal(motus_version(), version);
}

/* Definitions ------------------------------------------------------------------------------------------------------ */

static void defaults_are_what_the_manual_says(void **state)
{
    (void)state;
    motus_error e = motus_default_error();
    assert_int_equal(e.size, sizeof e);
    assert_int_equal(e.status, MOTUS_OK);
    assert_true(isnan(e.time));
    motus_text_def t = motus_default_text();
    assert_int_equal(t.size, sizeof t);
    assert_true(t.length == SIZE_MAX && !t.text && !t.set_count && !t.allocator.allocate);
    motus_callback_def c = motus_default_callback();
    assert_int_equal(c.size, sizeof c);
    assert_true(c.depends_on_velocity == 1 && c.depends_on_time == 1 && c.linear_in_velocity == 0);
    motus_run_def r = motus_default_run();
    assert_int_equal(r.size, sizeof r);
    assert_true(isnan(r.step) && isnan(r.until) && isnan(r.start) && !r.method && !r.x && !r.v && !r.progress);
    motus_study_def s = motus_default_study();
    assert_int_equal(s.size, sizeof s);
    assert_true(isnan(s.step) && isnan(s.until) && s.evaluations == 0 && !s.methods && s.tolerance == 0);
}

/* A caller built with an older header has a smaller struct, one built with a newer header a larger one: the library
 * writes no byte beyond it, and sets members that it does not know to zero. */
static void defaults_fill_what_there_is(void **state)
{
    (void)state;
    for (int kind = MOTUS_DEF_ERROR; kind <= MOTUS_DEF_STATEMENT; kind++)
        for (uint32_t size = 4; size <= sizeof(motus_error) + 32; size++) {
            _Alignas(16) unsigned char room[sizeof(motus_error) + 64];
            memset(room, 0xA5, sizeof room);
            motus_default((motus_def_kind)kind, room, size);
            uint32_t said;
            memcpy(&said, room, sizeof said);
            assert_int_equal(said, size);
            for (size_t i = size; i < sizeof room; i++) assert_int_equal(room[i], 0xA5);
            if (size > sizeof(motus_error)) assert_int_equal(room[size - 1], 0);
        }
}

/* A kind that only a newer library knows: the struct is set to zero, so that its size of 0 is refused. */
static void defaults_of_an_unknown_kind_are_zero(void **state)
{
    (void)state;
    unsigned char room[40];
    memset(room, 0xA5, sizeof room);
    motus_default((motus_def_kind)1000, room, 32);
    for (size_t i = 0; i < sizeof room; i++) assert_int_equal(room[i], i < 32 ? 0 : 0xA5);
}

/* Sizes ------------------------------------------------------------------------------------------------------------ */

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    (void)v;
    a[0] = -x[0];
    return 0;
}

/* A made-up history: 16 bytes in the first version, 24 in the second, 40 today. */
static void sizes_of_versions_fit(void **state)
{
    (void)state;
    static const uint32_t history[] = {16, 24, 40};
    static const struct {
        uint32_t size;
        int beyond;
        defaults_fit fit;
    } cases[] = {{0, 0, SIZE_MISSING},    {3, 0, SIZE_UNKNOWN},       {15, 0, SIZE_UNKNOWN},
                 {16, 0, SIZE_FITS},      {17, 0, SIZE_UNKNOWN},      {24, 0, SIZE_FITS},
                 {32, 0, SIZE_UNKNOWN},   {40, 0, SIZE_FITS},         {40, 1, SIZE_FITS},
                 {41, 0, SIZE_FITS},      {48, 0, SIZE_FITS},         {48, 1, SIZE_ASKS_MORE},
                 {64, 1, SIZE_ASKS_MORE}, {0x10000, 0, SIZE_UNKNOWN}, {0xA5A5A5A5, 0, SIZE_UNKNOWN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        _Alignas(16) unsigned char room[64];
        memset(room, 0xA5, 40);
        memset(room + 40, 0, 24);
        memcpy(room, &cases[i].size, sizeof cases[i].size);
        room[47] = (unsigned char)cases[i].beyond;
        if (defaults_judge(history, 3, room) != cases[i].fit)
            fail_msg("a size of %u, case %zu: %d", cases[i].size, i, (int)defaults_judge(history, 3, room));
    }
}

/* A call with a definition of each kind, made by `make` and then damaged or enlarged. */
typedef struct enlarged {
    motus_error error;
    motus_text_def text;
    motus_callback_def call;
    motus_run_def run;
    motus_study_def study;
    motus_ensemble_def ensemble;
} enlarged;

static motus_status create_by(motus_def_kind kind, const void *def, motus_system *s, motus_error *err)
{
    motus_system *system = NULL;
    motus_run *run = NULL;
    motus_comparison *comparison = NULL;
    motus_convergence *convergence = NULL;
    motus_reference *reference = NULL;
    motus_ensemble *ensemble = NULL;
    motus_status status = MOTUS_OK, others[2] = {MOTUS_OK, MOTUS_OK};
    switch (kind) {
    case MOTUS_DEF_TEXT: status = motus_system_from_text(def, &system, err); break;
    case MOTUS_DEF_CALLBACK: status = motus_system_from_callback(def, &system, err); break;
    case MOTUS_DEF_RUN: status = motus_run_create(s, def, &run, err); break;
    case MOTUS_DEF_ENSEMBLE: status = motus_ensemble_create(s, def, &ensemble, err); break;
    default:
        others[0] = motus_converge(s, def, &convergence, err);
        others[1] = motus_reference_create(s, def, &reference, err);
        status = motus_compare(s, def, &comparison, err);
        assert_true(others[0] == status && others[1] == status);
    }
    assert_true((status != MOTUS_OK) == (!system && !run && !comparison && !ensemble));
    motus_convergence_destroy(convergence);
    motus_comparison_destroy(comparison);
    motus_reference_destroy(reference);
    motus_ensemble_destroy(ensemble);
    motus_run_destroy(run);
    motus_system_destroy(system);
    return status;
}

static void definitions_of_every_size(void **state)
{
    (void)state;
    static const double x[1] = {1}, v[1] = {0};
    static const char *const methods[] = {"verlet"};
    static const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    motus_text_def text = motus_default_text();
    motus_callback_def call = motus_default_callback();
    motus_run_def run = motus_default_run();
    motus_study_def study = motus_default_study();
    motus_ensemble_def ensemble = motus_default_ensemble();
    text.text = spring;
    call.positions = 1, call.x = x, call.v = v, call.acceleration = pull;
    study.methods = methods, study.method_count = 1;
    ensemble.records = &record, ensemble.record_count = 1, ensemble.machine = "interpreter";
    const struct {
        motus_def_kind kind;
        const void *def;
        uint32_t size;
        const char *maker;
    } all[] = {{MOTUS_DEF_TEXT, &text, sizeof text, "motus_default_text()"},
               {MOTUS_DEF_CALLBACK, &call, sizeof call, "motus_default_callback()"},
               {MOTUS_DEF_RUN, &run, sizeof run, "motus_default_run()"},
               {MOTUS_DEF_STUDY, &study, sizeof study, "motus_default_study()"},
               {MOTUS_DEF_ENSEMBLE, &ensemble, sizeof ensemble, "motus_default_ensemble()"}};
    motus_system *s = given_text(spring);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const uint32_t now = all[k].size,
                       sizes[] = {0, 1, 4, 8, now / 2, now - 8, now - 1, now, now + 1, now + 64, 1u << 20};
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
            for (int asks = 0; asks < 2; asks++) {
                _Alignas(16) unsigned char room[sizeof(enlarged)] = {0};
                memcpy(room, all[k].def, all[k].size);
                memcpy(room, &sizes[i], sizeof sizes[i]);
                room[all[k].size + 60] = (unsigned char)asks;
                motus_error err = motus_default_error();
                const bool newer = sizes[i] > all[k].size && sizes[i] <= all[k].size + 64,
                           more = newer && asks && sizes[i] > all[k].size + 60;
                const motus_status status = create_by(all[k].kind, room, s, &err),
                                   due = (sizes[i] == all[k].size || newer) && !more ? MOTUS_OK : MOTUS_ARGUMENT;
                if (status != due || (due != MOTUS_OK && !strstr(err.hint, all[k].maker)) ||
                    (more && !strstr(err.message, MOTUS_VERSION)))
                    fail_msg("%s, %u bytes: %s (%s)", all[k].maker, sizes[i], err.message, err.hint);
            }
    }
    /* NULL is a definition too, if every member has a default. */
    assert_int_equal(create_by(MOTUS_DEF_RUN, NULL, s, NULL), MOTUS_OK);
    motus_system_destroy(s);
}

/* A struct that a call fills has a known size as well, and no byte beyond it is written. */
static void filled_structs_of_every_size(void **state)
{
    (void)state;
    static const uint32_t known[] = {[MOTUS_DEF_VARIABLE] = sizeof(motus_variable),
                                     [MOTUS_DEF_COLUMN] = sizeof(motus_column),
                                     [MOTUS_DEF_PARAMETER] = sizeof(motus_parameter),
                                     [MOTUS_DEF_INITIAL] = sizeof(motus_initial),
                                     [MOTUS_DEF_SETTINGS] = sizeof(motus_settings),
                                     [MOTUS_DEF_ANALYSIS] = sizeof(motus_analysis),
                                     [MOTUS_DEF_STATEMENT] = sizeof(motus_statement),
                                     [MOTUS_DEF_RUN_STATISTICS] = sizeof(motus_run_statistics),
                                     [MOTUS_DEF_ENSEMBLE_STATISTICS] = sizeof(motus_ensemble_statistics)};
    motus_system *s = given_text(spring);
    motus_run *run = given_run(s, "verlet", 0.1, 1);
    motus_ensemble_def def = motus_default_ensemble();
    motus_ensemble *ensemble = NULL;
    def.record_count = 1, def.records = &(motus_record){MOTUS_REDUCE_FINAL, 1}, def.step = 0.1, def.until = 1;
    assert_int_equal(motus_ensemble_create(s, &def, &ensemble, NULL), MOTUS_OK);
    for (size_t kind = 0; kind < sizeof known / sizeof *known; kind++) {
        if (!known[kind]) continue;
        const uint32_t now = known[kind], sizes[] = {0, 8, now - 4, now, now + 32};
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            union {
                motus_variable v;
                motus_column c;
                motus_parameter p;
                motus_initial i;
                motus_settings s;
                motus_analysis a;
                motus_statement t;
                motus_run_statistics r;
                motus_ensemble_statistics e;
                unsigned char bytes[1024];
            } u;
            memset(&u, 0xA5, sizeof u);
            motus_default((motus_def_kind)kind, &u, sizes[i] > now ? sizes[i] : now);
            memcpy(&u, &sizes[i], sizeof sizes[i]);
            unsigned char before[sizeof u];
            memcpy(before, &u, sizeof u);
            const motus_status status = kind == MOTUS_DEF_VARIABLE    ? motus_variable_at(s, 0, &u.v)
                                        : kind == MOTUS_DEF_COLUMN    ? motus_column_at(s, 0, &u.c)
                                        : kind == MOTUS_DEF_PARAMETER ? motus_parameter_at(s, 0, &u.p)
                                        : kind == MOTUS_DEF_INITIAL   ? motus_initial_at(s, 0, &u.i)
                                        : kind == MOTUS_DEF_SETTINGS  ? motus_settings_of(s, &u.s)
                                        : kind == MOTUS_DEF_ANALYSIS  ? motus_analysis_of(s, &u.a)
                                        : kind == MOTUS_DEF_STATEMENT ? motus_statement_at(s, 0, &u.t)
                                        : kind == MOTUS_DEF_RUN_STATISTICS
                                            ? motus_run_statistics_of(run, &u.r)
                                            : motus_ensemble_statistics_of(ensemble, &u.e);
            assert_int_equal(status, sizes[i] >= now ? MOTUS_OK : MOTUS_ARGUMENT);
            if (status != MOTUS_OK)
                assert_memory_equal(&u, before, sizeof u);
            else
                assert_int_equal(memcmp(&u, before, sizes[i]) != 0, 1);
            assert_memory_equal(u.bytes, &sizes[i], sizeof(uint32_t));
            assert_memory_equal(u.bytes + now, before + now, sizeof u - now);
        }
    }
    assert_int_equal(motus_settings_of(s, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_analysis_of(s, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_statistics_of(run, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_statistics_of(ensemble, NULL), MOTUS_ARGUMENT);
    assert_string_equal(motus_run_now(NULL).method, "");
    motus_ensemble_destroy(ensemble);
    motus_run_destroy(run);
    motus_system_destroy(s);
}

static void refuses_list(motus_status status, motus_error *err, const char *name)
{
    assert_int_equal(status, MOTUS_ARGUMENT);
    if (!strstr(err->message, name) || !strstr(err->message, "NULL")) fail_msg("%s: %s", name, err->message);
    *err = motus_default_error();
}

/* A count above 0 whose array is NULL is an error, as is a text of an array that is NULL. */
static void counts_need_arrays(void **state)
{
    (void)state;
    static const char *const nothing[] = {NULL, NULL};
    motus_error err = motus_default_error();
    motus_system *s = NULL, *held = given_text(spring);
    for (int given = 0; given < 2; given++) {
        const char *const *const texts = given ? nothing : NULL;
        motus_text_def t = motus_default_text();
        t.text = spring;
        t.set = texts, t.set_count = 1;
        refuses_list(motus_system_from_text(&t, &s, &err), &err, "set");
        t.set_count = 0, t.when = texts, t.when_count = 2;
        refuses_list(motus_system_from_text(&t, &s, &err), &err, "when");
        t.when_count = 0, t.define = texts, t.define_count = 1;
        refuses_list(motus_system_from_text(&t, &s, &err), &err, "define");
        const motus_record record = {MOTUS_REDUCE_FINAL, 1};
        motus_ensemble *e = NULL;
        motus_ensemble_def d = motus_default_ensemble();
        d.records = &record, d.record_count = 1, d.vary = texts, d.vary_count = 1;
        refuses_list(motus_ensemble_create(held, &d, &e, &err), &err, "vary");
        d.vary_count = 0, d.events = 1, d.event_column_count = 1;
        refuses_list(motus_ensemble_create(held, &d, &e, &err), &err, "event_columns");
        d.event_column_count = 0, d.records = NULL;
        refuses_list(motus_ensemble_create(held, &d, &e, &err), &err, "records");
    }
    motus_callback_def c = motus_default_callback();
    c.event_count = 1;
    refuses_list(motus_system_from_callback(&c, &s, &err), &err, "events");
    motus_study_def study = motus_default_study();
    motus_comparison *comparison = NULL;
    study.method_count = 2, study.methods = nothing;
    refuses_list(motus_compare(held, &study, &comparison, &err), &err, "methods");
    motus_system_destroy(held);
}

/* Every call that takes an error checks its size first. */
static void errors_of_every_size(void **state)
{
    (void)state;
    motus_system *s = given_text(spring), *system = NULL;
    motus_run *r = given_run(s, NULL, NAN, NAN), *run = NULL;
    motus_text_def text = motus_default_text();
    motus_callback_def call = motus_default_callback();
    const double one = 1, *values[1] = {&one};
    double out[4], *results[1] = {out};
    const size_t column_one = 1;
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    const char *kept, *methods[] = {"verlet"}, *const names[] = {"x"};
    size_t length, count;
    const motus_method *m;
    const motus_trace_entry *const *entries;
    motus_ensemble_def flock = motus_default_ensemble();
    motus_ensemble *e = NULL, *ensemble = NULL;
    motus_study_def study = motus_default_study();
    motus_comparison *comparison = NULL;
    motus_convergence *convergence = NULL;
    motus_reference *known = NULL, *reference = NULL;
    motus_column c = motus_default_column();
    text.text = spring;
    call.positions = 1, call.x = &one, call.v = &one, call.acceleration = pull;
    flock.records = &record, flock.record_count = 1, flock.machine = "interpreter";
    study.methods = methods, study.method_count = 1;
    must(motus_ensemble_create(s, &flock, &e, NULL), &(motus_error){0}, "ensemble");
    must(motus_reference_create(s, &study, &known, NULL), &(motus_error){0}, "reference");
    must(motus_run_save(r, &kept, &length, NULL), &(motus_error){0}, "save");
    char *saved = strdup(kept);
    const uint32_t sizes[] = {
        0, 12, sizeof(motus_error) - 1, 0xA5A5A5A5, sizeof(motus_error) + 16, sizeof(motus_error) + 8};
    struct {
        motus_error error;
        unsigned char beyond[16];
    } u;
    motus_error *err = &u.error;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const bool sound = i == 5;
#define REFUSES(call)                                                                                                \
    do {                                                                                                             \
        memset(&u, 0, sizeof u);                                                                                     \
        u.error.size = sizes[i];                                                                                     \
        u.beyond[15] = 1;                                                                                            \
        const bool refused =                                                                                         \
            (call) == MOTUS_ARGUMENT && err->status == MOTUS_ARGUMENT && strstr(err->hint, "motus_default_error()"); \
        if (refused == sound || u.error.size != sizes[i])                                                            \
            fail_msg("%s, an error of %u bytes: %s (%s)", #call, sizes[i], err->message, err->hint);                 \
    } while (0)
        REFUSES(motus_system_from_text(&text, &system, err));
        motus_system_destroy(system);
        REFUSES(motus_system_from_callback(&call, &system, err));
        motus_system_destroy(system);
        system = NULL;
        REFUSES(motus_column_find(s, "x", &length, &count, err));
        REFUSES(motus_columns_named(s, 1, names, &count, err));
        REFUSES(motus_run_value(r, "x", out, err));
        REFUSES(motus_column_of(s, &c, &count, err));
        REFUSES(motus_method_find("rk4", &m, err));
        REFUSES(motus_method_admits(s, "rk4", err));
        REFUSES(motus_stability("rk4", 1, &one, &one, out, err));
        REFUSES(motus_run_create(s, NULL, &run, err));
        motus_run_destroy(run);
        run = NULL;
        REFUSES(motus_run_state(r, out, out, err));
        REFUSES(motus_run_values(r, &column_one, 1, out, err));
        REFUSES(motus_run_jacobian(r, out, out, err));
        REFUSES(motus_run_save(r, &kept, &length, err));
        REFUSES(motus_run_set_state(r, NAN, NULL, NULL, err));
        REFUSES(motus_run_trace(r, &entries, &count, err));
        REFUSES(motus_run_restore(r, saved, strlen(saved), err));
        REFUSES(motus_run_step(r, 1, err));
        REFUSES(motus_run_sample(r, (const double[]){0.5}, 1, &column_one, 1, out, err));
        REFUSES(motus_run_finish(r, err));
        REFUSES(motus_run_restore(r, saved, strlen(saved), err));
        REFUSES(motus_compiled_text(s, NULL, err) ? MOTUS_OK : MOTUS_ARGUMENT);
        REFUSES(motus_ensemble_create(s, &flock, &ensemble, err));
        motus_ensemble_destroy(ensemble);
        ensemble = NULL;
        REFUSES(motus_ensemble_run(e, 1, values, results, NULL, err));
        REFUSES(motus_compare(s, &study, &comparison, err));
        motus_comparison_destroy(comparison);
        comparison = NULL;
        REFUSES(motus_converge(s, &study, &convergence, err));
        motus_convergence_destroy(convergence);
        convergence = NULL;
        REFUSES(motus_reference_create(s, &study, &reference, err));
        motus_reference_destroy(reference);
        reference = NULL;
        REFUSES(motus_reference_at(known, &one, 1, out, NULL, err));
#undef REFUSES
    }
    free(saved);
    motus_reference_destroy(known);
    motus_ensemble_destroy(e);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Errors ----------------------------------------------------------------------------------------------------------- */

static motus_status read_text(const char *text, motus_error *err)
{
    motus_text_def def = motus_default_text();
    motus_system *s = (motus_system *)&def;
    *err = motus_default_error();
    def.text = text;
    def.file = "given.motus";
    motus_status status = motus_system_from_text(&def, &s, err);
    if (status != MOTUS_OK) assert_null(s);
    motus_system_destroy(s);
    return status;
}

static void every_status_of_a_text_is_reached(void **state)
{
    (void)state;
    static const struct {
        motus_status status;
        const char *text;
        int line;
    } cases[] = {
        {MOTUS_SYNTAX, "x'' = -x +\nx(0) = 1\nx'(0) = 0", 2},
        {MOTUS_SYNTAX, "x'' = (-x", 1},
        {MOTUS_NAME, "x'' = -y\nx(0) = 1\nx'(0) = 0", 1},
        {MOTUS_NAME, "x'' = -x\nx(0) = 1", 1},
        {MOTUS_SHAPE, "x'' = (1, 2)\nx(0) = 1\nx'(0) = 0", 1},
        {MOTUS_LIMIT,
         "x[i]'' = -x[i] for i = 1..1000000000\nx[i](0) = 1 for i = 1..1000000000\nx[i]'(0) = 0 for i = 1..1000000000",
         0},
        {MOTUS_ARGUMENT, "x'' = -x\nx(0) = 1\nx'(0) = 0\nwhen x = 0: stop after 0", 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        motus_error err;
        motus_status status = read_text(cases[i].text, &err);
        if (status != cases[i].status)
            fail_msg("%s: %s instead of %s: %s", cases[i].text, motus_status_word(status),
                     motus_status_word(cases[i].status), err.message);
        assert_int_equal(err.status, status);
        assert_true(strlen(err.message) > 5 && !strchr(err.message, '\n'));
        assert_true(err.line > 0 && err.column > 0);
        if (cases[i].line) assert_int_equal(err.line, cases[i].line);
        assert_string_equal(err.file, "given.motus");
        assert_non_null(strchr(err.caret, '^'));
        assert_true(strlen(err.source) > 0 && isnan(err.time) && !err.variable[0]);
    }
}

static void errors_in_one_line(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    assert_string_equal(motus_error_line(NULL).text, "");
    assert_string_equal(motus_error_line(&err).text, "");
    assert_int_equal(read_text("x'' = -w x\nx(0) = 1\nx'(0) = 0", &err), MOTUS_NAME);
    char due[2048];
    snprintf(due, sizeof due, "given.motus:1:8: %s; hint: %s", err.message, err.hint);
    assert_true(strlen(err.hint) > 3);
    assert_string_equal(motus_error_line(&err).text, due);
    err.file[0] = err.hint[0] = 0;
    snprintf(due, sizeof due, "line 1, column 8: %s", err.message);
    assert_string_equal(motus_error_line(&err).text, due);
    err.line = 0;
    assert_string_equal(motus_error_line(&err).text, err.message);
    /* The longest texts fit. */
    memset(err.file, 'f', sizeof err.file - 1), memset(err.message, 'm', sizeof err.message - 1);
    memset(err.hint, 'h', sizeof err.hint - 1);
    err.file[sizeof err.file - 1] = err.message[sizeof err.message - 1] = err.hint[sizeof err.hint - 1] = 0;
    err.line = err.column = 2147483647;
    const motus_line line = motus_error_line(&err);
    assert_int_equal(strlen(line.text), 3 * 511 + strlen(":2147483647:2147483647: ; hint: "));
    /* An error that nobody made says what makes it. */
    err.size = 3;
    assert_non_null(strstr(motus_error_line(&err).text, "motus_default_error()"));
}

/* Columns by name: one call for several, and one for a value. */
static void columns_by_name(void **state)
{
    (void)state;
    motus_system *s = given_text("r'' = -r\nr(0) = (1, 2)\nr'(0) = (3, 4)\nnorm = |r|^2\nstep 0.1\nuntil 1\n");
    motus_run *r = given_run(s, NULL, NAN, NAN);
    motus_error err = motus_default_error();
    static const char *const names[] = {"norm", "r'.y", "t"}, *const none[] = {"norm", NULL};
    size_t columns[3] = {0};
    double out[3] = {0};
    must(motus_columns_named(s, 3, names, columns, &err), &err, "columns");
    must(motus_run_values(r, columns, 3, out, &err), &err, "values");
    assert_true(out[0] == 5 && out[1] == 4 && out[2] == 0);
    must(motus_run_value(r, "r.y", out, &err), &err, "value");
    assert_true(out[0] == 2);
    must(motus_columns_named(s, 0, NULL, NULL, &err), &err, "no columns");
    assert_int_equal(motus_run_value(r, "r", out, &err), MOTUS_SHAPE);
    assert_string_equal(err.message, "r stands for 2 columns, and one is needed");
    assert_string_equal(err.hint, "name one of them, as r.x");
    assert_int_equal(motus_run_value(r, "nrom", out, &err), MOTUS_NAME);
    assert_string_equal(err.hint, "did you mean norm?");
    assert_int_equal(motus_run_value(r, NULL, out, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_value(r, "norm", NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_value(NULL, "norm", out, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_columns_named(s, 2, none, columns, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_columns_named(NULL, 1, names, columns, &err), MOTUS_ARGUMENT);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void errors_name_the_place(void **state)
{
    (void)state;
    motus_error err;
    assert_int_equal(read_text("k = 2\nx'' = -kk x   # stiff\nx(0) = 1\nx'(0) = 0", &err), MOTUS_NAME);
    assert_int_equal(err.line, 2);
    assert_int_equal(err.column, 8);
    assert_string_equal(err.source, "x'' = -kk x   # stiff");
    assert_int_equal(strspn(err.caret, " "), 7);
    assert_non_null(strstr(err.message, "kk"));
}

static void refusals(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    motus_run *r = NULL;
    size_t first, count;
    assert_int_equal(motus_system_from_text(NULL, &s, &err), MOTUS_ARGUMENT);
    motus_text_def text = motus_default_text();
    assert_int_equal(motus_system_from_text(&text, &s, &err), MOTUS_ARGUMENT);
    text.text = spring;
    assert_int_equal(motus_system_from_text(&text, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_create(NULL, NULL, &r, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_step(NULL, 1, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_finish(NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_state(NULL, NULL, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_values(NULL, NULL, 0, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_sample(NULL, NULL, 0, NULL, 0, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_save(NULL, NULL, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_restore(NULL, NULL, 0, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_column_find(NULL, "x", &first, &count, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_method_find(NULL, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_method_admits(NULL, "verlet", &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_compare(NULL, NULL, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_converge(NULL, NULL, NULL, &err), MOTUS_ARGUMENT);
    /* A NULL handle gives no numbers, and nothing happens. */
    motus_system_destroy(NULL);
    motus_run_destroy(NULL);
    motus_comparison_destroy(NULL);
    motus_convergence_destroy(NULL);
    assert_true(motus_positions(NULL) == 0 && motus_velocities(NULL) == 0 && motus_column_count(NULL) == 0);
    assert_true(motus_run_steps(NULL) == 0 && isnan(motus_run_time(NULL)) && !motus_run_done(NULL));
    /* A NULL error is allowed. */
    assert_int_equal(motus_system_from_text(NULL, &s, NULL), MOTUS_ARGUMENT);
    text.text = "x'' = ";
    assert_int_equal(motus_system_from_text(&text, &s, NULL), MOTUS_SYNTAX);
}

static void text_with_a_length_and_settings(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_text_def def = motus_default_text();
    motus_system *s = NULL;
    char text[] = "k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nstep 0.5\nuntil 1\n)))";
    const char *set[] = {"k=4", "x(0) = 3", "x'(0)=k"}, *wrong[] = {"q=1"}, *mangled[] = {"k="};
    def.text = text;
    def.length = strlen(text) - 3;
    def.set = set;
    def.set_count = 3;
    must(motus_system_from_text(&def, &s, &err), &err, "text");
    memset(text, '?', sizeof text); /* the text was copied */
    motus_run *r = given_run(s, NULL, NAN, NAN);
    assert_true(value(s, r, "x") == 3 && value(s, r, "x'") == 4);
    motus_run_destroy(r);
    motus_system_destroy(s);
    def.text = "k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\n";
    def.length = SIZE_MAX;
    def.set_count = 1;
    def.set = wrong;
    assert_int_equal(motus_system_from_text(&def, &s, &err), MOTUS_NAME);
    assert_non_null(strstr(err.message, "q"));
    def.set = mangled;
    assert_int_not_equal(motus_system_from_text(&def, &s, &err), MOTUS_OK);
}

/* The contents of a system --------------------------------------------------------------------------------------- */

static const char rich[] = "N = 4\nk = 2\nm = [1, 2, 3, 4]\n"
                           "x[i]'' = k (x[i+1] - 2 x[i] + x[i-1])/m[i]   for i = 1..N\n"
                           "x[0] = 0\nx[N+1] = 0.1 sin(t)\n"
                           "x[i](0) = 0.1 i   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\n"
                           "r'' = -r - 0.1 r'\nr(0) = (1, 0)\nr'(0) = (0, 1)\n"
                           "w'' = -w\nw(0) = (1, 2, 3, 4, 5)\nw'(0) = (0, 0, 0, 0, 0)\n"
                           "s' = |r'|^2 - s\ns(0) = 0.5\n"
                           "speed = |r'|\nstretch = x[2] - x[1]\n"
                           "invariant w2 = (w[1]^2 + w'[1]^2, w[2]^2 + w'[2]^2)\n"
                           "method rk4\nstep 0.01\nuntil 1\nevery 0.1\n";

static void variables(void **state)
{
    (void)state;
    motus_system *s = given_text(rich);
    assert_int_equal(motus_variable_count(s), 4);
    assert_int_equal(motus_positions(s), 4 + 2 + 5);
    assert_int_equal(motus_velocities(s), 4 + 2 + 5 + 1);
    motus_variable v = motus_default_variable();
    assert_int_equal(motus_variable_at(s, 0, &v), MOTUS_OK);
    assert_string_equal(v.name, "x");
    assert_true(v.order == 2 && v.components == 0 && v.dimensions == 1 && v.first[0] == 1 && v.last[0] == 4 &&
                v.count == 4);
    assert_int_equal(motus_variable_at(s, 2, &v), MOTUS_OK);
    assert_true(!strcmp(v.name, "w") && v.components == 5 && v.dimensions == 0 && v.count == 5);
    assert_int_equal(motus_variable_at(s, 3, &v), MOTUS_OK);
    assert_true(!strcmp(v.name, "s") && v.order == 1);
    assert_int_equal(motus_variable_at(s, 4, &v), MOTUS_ARGUMENT);
    size_t numbers = 0;
    assert_int_equal(motus_quantity_count(s), 2);
    assert_string_equal(motus_quantity_name(s, 1, &numbers), "stretch");
    assert_int_equal(numbers, 1);
    assert_int_equal(motus_invariant_count(s), 1);
    assert_string_equal(motus_invariant_name(s, 0, &numbers), "w2");
    assert_int_equal(numbers, 2);
    assert_null(motus_invariant_name(s, 1, NULL));
    assert_false(motus_has_exact(s));
    motus_system_destroy(s);
}

static void columns_are_found_by_their_own_names(void **state)
{
    (void)state;
    static const char *const expected[] = {"t",     "x[1]",  "x[2]", "x[3]",  "x[4]",    "r.x",   "r.y",
                                           "w[1]",  "w[2]",  "w[3]", "w[4]",  "w[5]",    "x[1]'", "x[2]'",
                                           "x[3]'", "x[4]'", "r'.x", "r'.y",  "w'[1]",   "w'[2]", "w'[3]",
                                           "w'[4]", "w'[5]", "s",    "speed", "stretch", NULL,    NULL};
    motus_system *s = given_text(rich);
    assert_int_equal(motus_column_count(s), sizeof expected / sizeof *expected);
    for (size_t k = 0; k < motus_column_count(s); k++) {
        motus_column c = motus_default_column();
        size_t first = 99, count = 99;
        motus_error err = motus_default_error();
        assert_int_equal(motus_column_at(s, k, &c), MOTUS_OK);
        if (expected[k]) assert_string_equal(c.name, expected[k]);
        must(motus_column_find(s, c.name, &first, &count, &err), &err, c.name);
        assert_int_equal(first, k);
        assert_int_equal(count, 1);
    }
    motus_column c = motus_default_column();
    assert_int_equal(motus_column_at(s, motus_column_count(s), &c), MOTUS_ARGUMENT);
    assert_int_equal(motus_column_at(s, 14, &c), MOTUS_OK);
    assert_true(c.kind == MOTUS_COLUMN_VELOCITY && c.variable == 0 && c.is_velocity);
    assert_int_equal(motus_column_at(s, 23, &c), MOTUS_OK);
    assert_int_equal(c.kind, MOTUS_COLUMN_FIRST_ORDER);
    motus_system_destroy(s);
}

static void columns_of_whole_variables(void **state)
{
    (void)state;
    motus_system *s = given_text(rich);
    static const struct {
        const char *name;
        size_t first, count;
    } cases[] = {{"x", 1, 4},   {"x'", 12, 4},  {"r", 5, 2},     {"r'", 16, 2}, {"w", 7, 5},
                 {"w'", 18, 5}, {"x[3]", 3, 1}, {"w[5]", 11, 1}, {"w2", 26, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t first = 0, count = 0;
        motus_error err = motus_default_error();
        must(motus_column_find(s, cases[i].name, &first, &count, &err), &err, cases[i].name);
        assert_int_equal(first, cases[i].first);
        assert_int_equal(count, cases[i].count);
    }
    static const char *const none[] = {
        "",        "q",    "x[0]",   "x[5]",   "x[",      "x[1", "x[1]]",  "x''",     "x.x", "r.z",
        "r.",      "r.q",  "w[6]",   "w[0]",   "exact x", "t'",  "speed'", "speed.x", "s'",  "x[99999999999999999999]",
        "x[1][1]", "t[1]", "stretc", "r[1]'.x"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        size_t first = 0, count = 0;
        motus_error err = motus_default_error();
        if (motus_column_find(s, none[i], &first, &count, &err) != MOTUS_NAME)
            fail_msg("a column %s was found: %zu, %zu", none[i], first, count);
        assert_true(err.message[0] != 0);
        if (!strcmp(none[i], "stretc")) assert_non_null(strstr(err.hint, "stretch"));
    }
    char *loud = malloc(100000);
    assert_non_null(loud);
    memset(loud, 'x', 99999);
    loud[99999] = 0;
    size_t first, count;
    assert_int_equal(motus_column_find(s, loud, &first, &count, NULL), MOTUS_NAME);
    free(loud);
    motus_system_destroy(s);
}

/* A family of vectors with a gap, a quantity over a plane of indices, an exact motion. */
static const char gapped[] =
    "r[i]'' = -r[i]   for i = 2..3\nr[7]'' = -r[7]\nr[i](0) = (i, 0)   for i = 2..3\nr[7](0) = (7, 0)\n"
    "r[i]'(0) = (0, 0)   for i = 2..3\nr[7]'(0) = (0, 0)\ns' = -s\ns(0) = 1\n"
    "exact r[i] = r[i](0) cos(t)   for i = 2..3\nexact r[7] = r[7](0) cos(t)\nexact s = exp(-t)\n"
    "u[i, j] = i r[2].x + j   for i = 0..1, j = -1..1\ninvariant e = |r[2]|^2 + |r[2]'|^2\n";

/* The description of a column leads back to its number, and cells and components alone give its name. */
static void columns_by_cell_and_component(void **state)
{
    (void)state;
    static const char *const texts[] = {rich, gapped, spring};
    motus_error err = motus_default_error();
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = given_text(texts[i]);
        for (size_t k = 0; k < motus_column_count(s); k++) {
            motus_column c = motus_default_column(), bare = motus_default_column();
            size_t back = SIZE_MAX;
            assert_int_equal(motus_column_at(s, k, &c), MOTUS_OK);
            bare.kind = c.kind, bare.variable = c.variable, bare.is_velocity = c.is_velocity,
            bare.component = c.component;
            memcpy(bare.cell, c.cell, sizeof bare.cell);
            must(motus_column_of(s, &bare, &back, &err), &err, c.name);
            assert_int_equal(back, k);
        }
        motus_system_destroy(s);
    }
    motus_system *s = given_text(gapped);
    static const struct {
        motus_column_kind kind;
        size_t variable;
        int64_t cell[2];
        int component, is_velocity;
        const char *name;
    } cases[] = {{MOTUS_COLUMN_TIME, 0, {0}, 0, 0, "t"},
                 {MOTUS_COLUMN_POSITION, 0, {7}, 1, 0, "r[7].y"},
                 {MOTUS_COLUMN_VELOCITY, 0, {3}, 0, 0, "r[3]'.x"},
                 {MOTUS_COLUMN_FIRST_ORDER, 1, {0}, 0, 0, "s"},
                 {MOTUS_COLUMN_QUANTITY, 0, {1, -1}, 0, 0, "u[1,-1]"},
                 {MOTUS_COLUMN_INVARIANT, 0, {0}, 0, 0, "e"},
                 {MOTUS_COLUMN_EXACT, 0, {2}, 1, 0, "exact r[2].y"},
                 {MOTUS_COLUMN_EXACT, 0, {7}, 0, 1, "exact r[7]'.x"},
                 {MOTUS_COLUMN_EXACT, 1, {0}, 0, 0, "exact s"},
                 {MOTUS_COLUMN_POSITION, 0, {4}, 0, 0, NULL},
                 {MOTUS_COLUMN_POSITION, 0, {8}, 0, 0, NULL},
                 {MOTUS_COLUMN_POSITION, 0, {7}, 2, 0, NULL},
                 {MOTUS_COLUMN_POSITION, 0, {7}, -1, 0, NULL},
                 {MOTUS_COLUMN_POSITION, 1, {0}, 0, 0, NULL},
                 {MOTUS_COLUMN_FIRST_ORDER, 1, {0}, 1, 0, NULL},
                 {MOTUS_COLUMN_QUANTITY, 1, {0}, 0, 0, NULL},
                 {MOTUS_COLUMN_QUANTITY, 0, {2, 0}, 0, 0, NULL},
                 {MOTUS_COLUMN_EXACT, 1, {0}, 0, 1, NULL},
                 {(motus_column_kind)99, 0, {0}, 0, 0, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        motus_column c = motus_default_column(), found = motus_default_column();
        size_t k = 77;
        c.kind = cases[i].kind, c.variable = cases[i].variable, c.component = cases[i].component,
        c.is_velocity = cases[i].is_velocity;
        memcpy(c.cell, cases[i].cell, sizeof cases[i].cell);
        const motus_status status = motus_column_of(s, &c, &k, &err);
        if (status != (cases[i].name ? MOTUS_OK : MOTUS_NAME)) fail_msg("case %zu: %s", i, err.message);
        if (status != MOTUS_OK) {
            assert_true(k == 77 && strlen(err.message) > 10);
            continue;
        }
        assert_int_equal(motus_column_at(s, k, &found), MOTUS_OK);
        assert_string_equal(found.name, cases[i].name);
        assert_true(found.dimensions ==
                    (cases[i].variable == 0 && found.kind != MOTUS_COLUMN_TIME && found.kind != MOTUS_COLUMN_INVARIANT
                         ? (found.kind == MOTUS_COLUMN_QUANTITY ? 2 : 1)
                         : 0));
    }
    motus_column c = motus_default_column();
    size_t k;
    assert_int_equal(motus_column_of(NULL, &c, &k, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_column_of(s, NULL, &k, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_column_of(s, &c, NULL, &err), MOTUS_ARGUMENT);
    c.size = 3;
    assert_int_equal(motus_column_of(s, &c, &k, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.hint, "motus_default_column()"));
    motus_system_destroy(s);
}

static void values_of_columns(void **state)
{
    (void)state;
    motus_system *s = given_text(rich);
    motus_run *r = given_run(s, NULL, NAN, NAN);
    motus_error err = motus_default_error();
    size_t all = motus_column_count(s), columns[64];
    double out[64], x[11], v[12];
    for (size_t k = 0; k < all; k++) columns[k] = all - 1 - k; /* in any order */
    take_steps(r, 7);
    must(motus_run_values(r, columns, all, out, &err), &err, "values");
    must(motus_run_state(r, x, v, &err), &err, "state");
    assert_true(out[all - 1] == motus_run_time(r));
    for (size_t k = 0; k < 11; k++) assert_true(out[all - 2 - k] == x[k]);
    for (size_t k = 0; k < 12; k++) assert_true(out[all - 13 - k] == v[k]);
    near(value(s, r, "speed"), hypot(v[4], v[5]), 4 * ROUNDING, "speed");
    assert_true(value(s, r, "stretch") == x[1] - x[0]);
    columns[0] = all;
    assert_int_equal(motus_run_values(r, columns, 1, out, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_values(r, NULL, 0, NULL, &err), MOTUS_OK);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void exact_columns(void **state)
{
    (void)state;
    motus_system *s =
        given_text("x'' = -4 x\nx(0) = 1\nx'(0) = 0\nexact x = cos(2 t)\nmethod verlet\nstep 0.1\nuntil 1\n");
    assert_true(motus_has_exact(s));
    motus_run *r = given_run(s, NULL, NAN, NAN);
    finish(r);
    near(value(s, r, "exact x"), cos(2), 4 * ROUNDING, "exact x");
    near(value(s, r, "exact x'"), -2 * sin(2), 8 * ROUNDING, "exact x'");
    motus_column c = motus_default_column();
    assert_int_equal(motus_column_at(s, 4, &c), MOTUS_OK);
    assert_true(c.kind == MOTUS_COLUMN_EXACT && c.is_velocity && !strcmp(c.name, "exact x'"));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void settings_and_analysis(void **state)
{
    (void)state;
    motus_system *s = given_text(rich);
    motus_settings set = motus_default_settings();
    motus_analysis a = motus_default_analysis();
    motus_settings_of(s, &set);
    assert_string_equal(set.method, "rk4");
    assert_true(set.step == 0.01 && set.until == 1 && set.from == 0 && set.every_time == 0.1 && set.every_steps == 0);
    motus_analysis_of(s, &a);
    assert_true(a.velocity_dependent && a.time_dependent && !a.constant && !a.gyroscopic && !a.exact_recognised);
    assert_true(strlen(motus_explain(s)) > 20);
    assert_ptr_equal(motus_explain(s), motus_explain(s));
    motus_system_destroy(s);
    s = given_text("x'' = x^3 - x\nx(0) = 1\nx'(0) = 0\nevery 5 steps\n");
    motus_settings_of(s, &set);
    assert_true(isnan(set.step) && isnan(set.until) && !set.method && isnan(set.every_time) && set.every_steps == 5);
    motus_analysis_of(s, &a);
    assert_true(!a.velocity_dependent && !a.time_dependent && !a.affine && a.gradient && a.smooth);
    assert_non_null(strstr(motus_equation_text(s, 0), "x'' ="));
    assert_null(motus_equation_text(s, 1));
    motus_system_destroy(s);
    s = given_text("g = (0, -9.81)\nr'' = g\nr(0) = (0, 0)\nr'(0) = (1, 2)\n");
    motus_analysis_of(s, &a);
    assert_true(a.constant && a.affine && a.exact_recognised && motus_has_exact(s));
    motus_system_destroy(s);
    s = given_text("r'' = cross(r', (0, 0, 2))\nr(0) = (0, 0, 0)\nr'(0) = (1, 2, 3)\n");
    motus_analysis_of(s, &a);
    assert_true(a.velocity_dependent && a.linear_in_velocity && a.gyroscopic);
    motus_system_destroy(s);
    s = given_text("x'' = -abs(x) - x'^2\nx(0) = 0\nx'(0) = 1\n");
    motus_analysis_of(s, &a);
    assert_true(a.velocity_dependent && !a.linear_in_velocity && !a.smooth && !a.gyroscopic);
    motus_system_destroy(s);
}

/* The catalogue ---------------------------------------------------------------------------------------------------- */

static void methods_are_found(void **state)
{
    (void)state;
    const motus_method *m = NULL;
    motus_error err = motus_default_error();
    assert_true(motus_method_count() >= 30);
    assert_null(motus_method_at(motus_method_count()));
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *card = motus_method_at(k);
        must(motus_method_find(card->name, &m, &err), &err, card->name);
        assert_ptr_equal(m, card);
        assert_true(card->formula[0] && card->use[0] && card->family[0] && card->title && card->title[0]);
        for (size_t i = 0; i < k; i++) assert_string_not_equal(motus_method_at(i)->title, card->title);
        char alias[128];
        for (const char *p = card->aliases; *p; p += strspn(p, " ")) {
            size_t n = strcspn(p, " ");
            snprintf(alias, sizeof alias, "%.*s", (int)n, p);
            must(motus_method_find(alias, &m, &err), &err, alias);
            assert_ptr_equal(m, card);
            p += n;
        }
    }
    must(motus_method_find("RK4", &m, &err), &err, "RK4");
    assert_string_equal(m->name, "rk4");
    must(motus_method_find("newmark(1/6, 1/2)", &m, &err), &err, "newmark");
    assert_int_equal(m->order, 2);
    static const char *const wrong[] = {
        "", "verlot", "newmark(1/6", "newmark(a, b)", "newmark(1/0, 1)", "rk4(2)", "newmark(1/6, 1/2) x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(motus_method_find(wrong[i], &m, &err), MOTUS_METHOD);
        assert_null(m);
    }
    assert_int_equal(motus_method_find("verlot", NULL, &err), MOTUS_METHOD);
    assert_non_null(strstr(err.hint, "verlet"));
}

static void arguments_have_a_range(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    static const char *const wrong[] = {"newmark(-1, 7)", "newmark(1/4, -1/2)", "newmark(2, 1/2)", "newmark(1/4)"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(motus_method_find(wrong[i], NULL, &err), MOTUS_METHOD);
        assert_non_null(strstr(err.message, "between 0 and 1"));
    }
    assert_int_equal(motus_method_find("newmark(-0, 1)", NULL, &err), MOTUS_OK);
}

static void hints_name_members(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *wrong = NULL;
    const char *const set[] = {" until = 3"};
    motus_text_def def = motus_default_text();
    def.text = "x'' = -x\nx(0) = 1\nx'(0) = 0\n";
    def.set = set;
    def.set_count = 1;
    assert_int_equal(motus_system_from_text(&def, &wrong, &err), MOTUS_ARGUMENT);
    assert_string_equal(err.hint, "give `until = 3` of the definition");
    assert_string_equal(err.file, "motus_text_def.set");
    assert_int_equal(err.column, 2);
}

/* `when` of the definition, copied as the text is. */
static void events_beside_the_text(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    char first[] = "x = 1/2 falling as half: record", second[] = "when every 1/4: record";
    const char *const when[] = {first, second};
    motus_text_def def = motus_default_text();
    def.text = "x'' = 0\nx(0) = 1\nx'(0) = -1\nstep 1/8\nuntil 1\nwhen x = 1/4: record";
    def.when = when;
    def.when_count = 2;
    assert_int_equal(motus_system_from_text(&def, &s, &err), MOTUS_OK);
    memset(first, 'x', sizeof first - 1);
    memset(second, 'x', sizeof second - 1);
    motus_run_def run = motus_default_run();
    motus_run *r = NULL;
    run.method = "verlet";
    assert_int_equal(motus_run_create(s, &run, &r, &err), MOTUS_OK);
    assert_int_equal(motus_run_finish(r, &err), MOTUS_OK);
    static const char *const names[] = {"event3", "half", "event3", "event1", "event3", "event3"};
    static const double times[] = {0.25, 0.5, 0.5, 0.75, 0.75, 1};
    assert_int_equal(motus_run_events(r), sizeof times / sizeof *times);
    for (int64_t k = 0; k < motus_run_events(r); k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        assert_string_equal(row.name, names[k]);
        assert_true(row.time == times[k]);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    const char *const wrong[] = {"x = 0: record", "x = 1 rising: recrd"};
    def.when = wrong;
    assert_int_not_equal(motus_system_from_text(&def, &s, &err), MOTUS_OK);
    assert_string_equal(err.file, "motus_text_def.when");
    assert_int_equal(err.line, 1);
    assert_string_equal(err.source, wrong[1]);
}

static void methods_are_refused_with_a_reason(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("x'' = -x - x'\nx(0) = 1\nx'(0) = 0\n");
    assert_int_equal(motus_method_admits(s, "verlet", &err), MOTUS_OK);
    assert_int_equal(motus_method_admits(s, "leapfrog", &err), MOTUS_OK);
    assert_int_equal(motus_method_admits(s, "kahan-li8", &err), MOTUS_OK);
    assert_int_equal(motus_method_admits(s, "pefrl", &err), MOTUS_METHOD);
    assert_non_null(strstr(err.message, "velocity"));
    assert_true(strlen(err.hint) > 5);
    assert_int_equal(motus_method_admits(s, "boris", &err), MOTUS_METHOD);
    assert_int_equal(motus_method_admits(s, "exact", &err), MOTUS_METHOD);
    assert_int_equal(motus_method_admits(s, "nonsense", &err), MOTUS_METHOD);
    assert_int_equal(motus_method_admits(s, NULL, &err), MOTUS_ARGUMENT);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "pefrl";
    def.step = 0.1;
    def.until = 1;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_METHOD);
    assert_null(r);
    motus_system_destroy(s);
}

/* What a method preserves is said of the method on the system, and an energy only where there is one. */
static void what_is_preserved(void **state)
{
    (void)state;
    static const struct {
        const char *text, *method;
        motus_geometry geometry;
        int energy;
    } known[] = {
        {"x'' = -x^3\nx(0) = 1\nx'(0) = 0\n", "verlet", MOTUS_GEOMETRY_SYMPLECTIC, 1},
        {"x'' = -x^3\nx(0) = 1\nx'(0) = 0\n", "rk4", MOTUS_GEOMETRY_NONE, 1},
        {"x'' = -x^3 + cos(t)\nx(0) = 1\nx'(0) = 0\n", "kahan-li8", MOTUS_GEOMETRY_SYMPLECTIC, 0},
        {"x'' = -x^3 - x'\nx(0) = 1\nx'(0) = 0\n", "kahan-li8", MOTUS_GEOMETRY_NONE, 0},
        {"x'' = -x^3 - x'\nx(0) = 1\nx'(0) = 0\n", "gauss4", MOTUS_GEOMETRY_NONE, 0},
        {"x'' = -y\ny'' = x\nx(0) = 1\nx'(0) = 0\ny(0) = 1\ny'(0) = 0\n", "leapfrog", MOTUS_GEOMETRY_VOLUME, 0},
        {"x'' = -y\ny'' = x\nx(0) = 1\nx'(0) = 0\ny(0) = 1\ny'(0) = 0\n", "verlet", MOTUS_GEOMETRY_NONE, 0},
        /* masses 1, 3 and 2: the acceleration is no gradient, the force is */
        {"x'' = 3 (y - x)^3\ny'' = (x - y)^3 + 2 (z - y)\nz'' = 3 (y - z)\nx(0) = 1\nx'(0) = 0\ny(0) = 1\ny'(0) = 0\n"
         "z(0) = 0\nz'(0) = 0\n",
         "velocity-verlet", MOTUS_GEOMETRY_SYMPLECTIC, 1},
        {"r'' = r + cross(r', (0, 0, 1 + r.x))\nr(0) = (1, 0, 0)\nr'(0) = (0, 1, 0)\n", "boris", MOTUS_GEOMETRY_VOLUME,
         0},
        {"r'' = r + cross(r', (0, 0, 1 + r.x))\nr(0) = (1, 0, 0)\nr'(0) = (0, 1, 0)\n", "gauss4", MOTUS_GEOMETRY_NONE,
         0},
        {"x'' = -x\ns' = x'^2\nx(0) = 1\nx'(0) = 0\ns(0) = 0\n", "pefrl", MOTUS_GEOMETRY_VOLUME, 0}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        motus_system *s = given_text(known[i].text);
        motus_geometry geometry = MOTUS_GEOMETRY_NONE;
        assert_int_equal(motus_method_geometry(s, known[i].method, &geometry, NULL), MOTUS_OK);
        if (geometry != known[i].geometry) fail_msg("%s by %s: %d", known[i].text, known[i].method, geometry);
        if ((strstr(motus_explain(s), "an energy exists") != NULL) != known[i].energy)
            fail_msg("energy: %s", known[i].text);
        motus_system_destroy(s);
    }
    motus_system *damped = given_text("x'' = -x - x'\nx(0) = 1\nx'(0) = 0\n");
    motus_geometry geometry;
    motus_error err = motus_default_error();
    assert_int_equal(motus_method_geometry(damped, "pefrl", &geometry, &err), MOTUS_METHOD);
    assert_null(strstr(err.hint, "symplectic"));
    assert_int_equal(motus_method_geometry(damped, "verlet", NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_method_geometry(NULL, "verlet", &geometry, &err), MOTUS_ARGUMENT);
    motus_system_destroy(damped);
}

/* A first-order variable that reads the velocity, and that nothing reads, leaves the splitting methods admitted but
 * those whose order needs kicks without a velocity; one that acts back does not. */
static void variables_that_follow(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\ns' = x'^2\nx(0) = 1\nx'(0) = 0\ns(0) = 0\n"),
                 *back = given_text("x'' = -x\ns' = x'^2 - s\nx(0) = 1\nx'(0) = 0\ns(0) = 0\n");
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (strcmp(m->family, "splitting") || !strcmp(m->name, "boris")) continue;
        const int nystrom = !strncmp(m->name, "blanes-moan6", 12), any = m->forces == MOTUS_FORCES_XVT;
        assert_int_equal(motus_method_admits(s, m->name, NULL), nystrom ? MOTUS_METHOD : MOTUS_OK);
        assert_int_equal(motus_method_admits(back, m->name, NULL), any ? MOTUS_OK : MOTUS_METHOD);
    }
    assert_non_null(strstr(motus_explain(s), "integrals along the motion"));
    assert_null(strstr(motus_explain(back), "integrals along the motion"));
    motus_system_destroy(s);
    motus_system_destroy(back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statuses_have_words),
        cmocka_unit_test(defaults_are_what_the_manual_says),
        cmocka_unit_test(defaults_fill_what_there_is),
        cmocka_unit_test(defaults_of_an_unknown_kind_are_zero),
        cmocka_unit_test(sizes_of_versions_fit),
        cmocka_unit_test(definitions_of_every_size),
        cmocka_unit_test(filled_structs_of_every_size),
        cmocka_unit_test(counts_need_arrays),
        cmocka_unit_test(errors_of_every_size),
        cmocka_unit_test(every_status_of_a_text_is_reached),
        cmocka_unit_test(errors_in_one_line),
        cmocka_unit_test(columns_by_name),
        cmocka_unit_test(errors_name_the_place),
        cmocka_unit_test(refusals),
        cmocka_unit_test(text_with_a_length_and_settings),
        cmocka_unit_test(variables),
        cmocka_unit_test(columns_are_found_by_their_own_names),
        cmocka_unit_test(columns_of_whole_variables),
        cmocka_unit_test(columns_by_cell_and_component),
        cmocka_unit_test(values_of_columns),
        cmocka_unit_test(exact_columns),
        cmocka_unit_test(settings_and_analysis),
        cmocka_unit_test(methods_are_found),
        cmocka_unit_test(arguments_have_a_range),
        cmocka_unit_test(hints_name_members),
        cmocka_unit_test(events_beside_the_text),
        cmocka_unit_test(methods_are_refused_with_a_reason),
        cmocka_unit_test(variables_that_follow),
        cmocka_unit_test(what_is_preserved),
    };
    return cmocka_run_group_tests_name("the public calls", tests, NULL, NULL);
}
