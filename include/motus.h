/* motus: Newton's second law, x'' = a(x, x', t), integrated.
 *
 * This header is the library's manual, in the order in which one uses it:
 *
 *     1. status and errors      every fallible call returns a motus_status; a motus_error adds sentence and place
 *     2. systems                the equations: from a text (a model), or from a C callback
 *     3. what a system holds    variables, columns, numbers that may be set, settings, analysis
 *     4. methods                the catalogue, from the rows that the code runs
 *     5. runs                   one integration: create, step, observe, errors, events, save, trace
 *     6. ensembles              one model, many trajectories: parameters or initial values vary, numbers are recorded
 *     7. studies                every method side by side; observed order and its certificate; the reference solution
 *     8. texts for an editor    the statements of a model, typeset; the words of a text
 *
 * Index: what one wants, and what does it.
 *
 *     read a model from text                    motus_system_from_text
 *     give the force as a C function            motus_system_from_callback
 *     print an error in one line                motus_error_line
 *     change a parameter or an initial value    motus_system_set
 *     compute in a second thread                motus_system_clone
 *     find numbers by their names               motus_columns_named, motus_column_find
 *     list what a system holds                  motus_variable_at, motus_column_at, motus_parameter_at
 *     choose a step and an end                  motus_suggest
 *     list methods; ask whether one is admitted motus_method_at, motus_method_admits
 *     integrate                                 motus_run_create, motus_run_finish, motus_run_step
 *     read the state, or numbers by name        motus_run_state, motus_run_value, motus_run_values
 *     read numbers at any times (dense output)  motus_run_sample
 *     know how far numbers may be off           motus_run_errors, motus_run_sample_errors
 *     read the table of events                  motus_run_event, motus_run_event_values
 *     count steps and evaluations               motus_run_now
 *     stop, and go on later to the same bits    motus_run_save, motus_run_restore
 *     go on from another state                  motus_run_set_state
 *     look into a step; linearise the equations motus_run_trace, motus_run_jacobian
 *     integrate many trajectories, on threads   motus_ensemble_create, motus_ensemble_run
 *     compare methods; rank them by their work  motus_compare, motus_rank
 *     measure the order of a method             motus_converge
 *     have a reference solution                 motus_reference_create, motus_reference_at
 *     typeset a model; colour its text          motus_statement_mathml, motus_text_words
 *     give the library memory of your own       motus_allocator
 *
 * Three programs. Compile them with cc bounce.c $(pkg-config --cflags --libs motus).
 *
 * bounce.c: a C callback with an event. A ball falls, loses half of its speed at each bounce, and stops at the third.
 *
 *     #include <motus.h>
 *     #include <stdio.h>
 *
 *     static int fall(void *g, double t, const double *x, const double *v, double *a)
 *     {
 *         (void)t, (void)x, (void)v;
 *         a[0] = -*(double *)g;
 *         return 0;
 *     }
 *     static int height(void *g, double t, const double *x, const double *v, double *values)
 *     {
 *         (void)g, (void)t, (void)v;
 *         values[0] = x[0];
 *         return 0;
 *     }
 *     static int bounce(void *g, size_t event, double t, double *x, double *v)
 *     {
 *         (void)g, (void)event, (void)t;
 *         x[0] = 0, v[0] = -0.5 * v[0];
 *         return 0;
 *     }
 *
 *     int main(void)
 *     {
 *         double g = 9.81, x = 1, v = 0;
 *         motus_event_def hit = {.name = "bounce", .direction = -1, .assigns = 1, .stop = 3};
 *         motus_callback_def def = motus_default_callback();
 *         def.positions = 1, def.x = &x, def.v = &v;
 *         def.acceleration = fall, def.context = &g;
 *         def.depends_on_velocity = def.depends_on_time = 0;
 *         def.events = &hit, def.event_count = 1, def.event_functions = height, def.event_action = bounce;
 *         motus_run_def how = motus_default_run();
 *         how.method = "dopri5", how.tolerance = 1e-9, how.until = 10;
 *
 *         motus_error err = motus_default_error();
 *         motus_event_row row = motus_default_event_row();
 *         motus_system *system = NULL;
 *         motus_run *run = NULL;
 *         if (motus_system_from_callback(&def, &system, &err) || motus_run_create(system, &how, &run, &err) ||
 *             motus_run_finish(run, &err))
 *             puts(motus_error_line(&err).text);
 *         for (int64_t k = 0; motus_run_event(run, k, &row) == MOTUS_OK; k++)
 *             printf("%s %d at t = %.10g\n", row.name, (int)row.count, row.time);
 *         motus_run_destroy(run);
 *         motus_system_destroy(system);
 *         return motus_status_exit(err.status);
 *     }
 *
 * bounce.c prints
 *
 *     bounce 1 at t = 0.451523641
 *     bounce 2 at t = 0.903047282
 *     bounce 3 at t = 1.128809102
 *
 * swings.c: an ensemble on four threads. A pendulum swings from a thousand angles.
 *
 *     #include <motus.h>
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         motus_text_def def = motus_default_text();
 *         def.text = "phi'' = -sin(phi); phi(0) = 1; phi'(0) = 0; step 0.01; until 20";
 *         const char *vary[] = {"phi(0)"}, *observe[] = {"phi", "phi'"};
 *         double start[1000], last[1000], fastest[1000], stopped[1000];
 *         const double *values[] = {start};
 *         double *results[] = {last, fastest};
 *         for (int k = 0; k < 1000; k++) start[k] = 0.003 * k;
 *
 *         motus_error err = motus_default_error();
 *         motus_system *system = NULL;
 *         motus_ensemble *ensemble = NULL;
 *         size_t column[2];
 *         if (motus_system_from_text(&def, &system, &err) || motus_columns_named(system, 2, observe, column, &err))
 *             return puts(motus_error_line(&err).text), motus_status_exit(err.status);
 *         const motus_record records[] = {{MOTUS_REDUCE_FINAL, column[0]}, {MOTUS_REDUCE_MAX, column[1]}};
 *         motus_ensemble_def how = motus_default_ensemble();
 *         how.vary = vary, how.vary_count = 1;
 *         how.records = records, how.record_count = 2;
 *         how.method = "verlet", how.threads = 4;
 *         if (motus_ensemble_create(system, &how, &ensemble, &err) ||
 *             motus_ensemble_run(ensemble, 1000, values, results, stopped, &err))
 *             puts(motus_error_line(&err).text);
 *         else
 *             for (int k = 333; k < 1000; k += 333)
 *                 printf("from %.3f to %.6f, at most %.6f fast\n", start[k], last[k], fastest[k]);
 *         motus_ensemble_destroy(ensemble);
 *         motus_system_destroy(system);
 *         return motus_status_exit(err.status);
 *     }
 *
 * swings.c prints
 *
 *     from 0.999 to 0.995029, at most 0.957959 fast
 *     from 1.998 to -1.653642, at most 1.681842 fast
 *     from 2.997 to 0.180228, at most 1.994741 fast
 *
 * ellipse.c: a text, with bars of error and dense output at times between the steps.
 *
 *     #include <motus.h>
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         motus_text_def def = motus_default_text();
 *         def.file = "ellipse";
 *         def.text = "mu = 1\n"
 *                    "r'' = -mu r/|r|^3\n"
 *                    "r(0) = (1, 0)\n"
 *                    "r'(0) = (0, 1.2)\n"
 *                    "invariant energy = |r'|^2/2 - mu/|r|\n";
 *         const char *names[] = {"r.x", "r.y"};
 *         const double times[] = {2.5, 5, 7.5, 10};
 *         double at[4][2], bars[4][2], energy;
 *         size_t columns[2];
 *         motus_run_def how = motus_default_run();
 *         how.method = "dop853", how.tolerance = 1e-10, how.until = 10, how.error = MOTUS_BARS_CHEAP;
 *
 *         motus_error err = motus_default_error();
 *         motus_system *system = NULL;
 *         motus_run *run = NULL;
 *         if (motus_system_from_text(&def, &system, &err) || motus_columns_named(system, 2, names, columns, &err) ||
 *             motus_run_create(system, &how, &run, &err) ||
 *             motus_run_sample_errors(run, times, 4, columns, 2, at[0], bars[0], &err) ||
 *             motus_run_value(run, "energy", &energy, &err)) {
 *             puts(motus_error_line(&err).text);
 *         } else {
 *             for (int k = 0; k < 4; k++)
 *                 printf("t = %4.1f: x = %.10f ± %.0e, y = %.10f ± %.0e\n", times[k], at[k][0], bars[k][0], at[k][1],
 *                        bars[k][1]);
 *             printf("energy = %.10f\n", energy);
 *         }
 *         motus_run_destroy(run);
 *         motus_system_destroy(system);
 *         return motus_status_exit(err.status);
 *     }
 *
 * ellipse.c prints
 *
 *     t =  2.5: x = -0.6346272983 ± 9e-11, y = 1.5978174660 ± 3e-11
 *     t =  5.0: x = -2.0956623454 ± 2e-10, y = 1.0898051511 ± 2e-10
 *     t =  7.5: x = -2.5714277282 ± 6e-10, y = -0.0015585239 ± 4e-10
 *     t = 10.0: x = -2.0930907236 ± 1e-09, y = -1.0922925247 ± 6e-10
 *     energy = -0.2800000000
 *
 * Rules of all calls.
 *
 * Sizes. Later versions may add members at the end of a struct. A program compiled against this header keeps working,
 * because neither side relies on the size of the other's structs:
 *   - A struct that a call reads or fills is yours. It begins with `size`; make it with motus_default_…(), and then
 *     edit it if it is a definition, motus_…_def. The call refuses a size that no version had with MOTUS_ARGUMENT. It
 *     takes a larger size, of a newer header, as long as the members that it does not know are zero, as
 *     motus_default_…() leaves them: zero means "as before".
 *   - A struct that the library returns is the library's: you get a pointer to const, or an array of such pointers,
 *     rows[k]->step. Read its members through the pointer. Do not copy it and do not use its sizeof, which would rely
 *     on its present size.
 *   - motus_allocator, which lies inside definitions, and motus_record, of which you make arrays, will not change.
 * Later versions may add values at the end of an enumeration.
 * Names. A status is MOTUS_ and one word, MOTUS_DIVERGED. Every other enumerator has the word of its enumeration in
 * between, MOTUS_TRACE_KICK, so that it cannot be taken for a status. All macros begin with MOTUS_.
 * Errors. Every call that returns a status may return MOTUS_ARGUMENT, because a pointer is NULL that must not be, or
 * because a struct has no valid size (the call checks the motus_error first); and every call that takes memory may
 * return MOTUS_MEMORY. The comment of a call names every other status that it returns. A call that fails to create an
 * object sets its pointer to NULL; other results may have been written in part.
 * Shapes. nx is motus_positions(), nv is motus_velocities(). An array of positions has nx numbers. An array of
 * velocities or accelerations has nv: the velocities of all positions, then the first-order variables. A table is
 * stored row by row.
 * Units. The equations' own, the same for times, steps and values; angles are in radians. `seconds` are elapsed
 * seconds of computing.
 * Lifetimes. A handle lives from …_create / …_from… to …_destroy (destroying NULL does nothing). Runs, ensembles and
 * references use their system. You may destroy it before them: its handle is yours no longer, and the system itself
 * goes with the last of them; until then they need its callbacks, their context and its allocator. Strings and structs
 * returned by pointer, and the strings in structs that a call fills, belong to the handle that they came from and live
 * as long as it, unless the comment says how long; or they are static. What you give to a call is copied, callbacks and
 * their context excepted.
 * Threads. There are no globals. Different threads may use different handles at once; only one thread may use a handle
 * at a time. A run, an ensemble and a reference use their system's handle too, so each thread needs a system of its
 * own: motus_system_clone.
 * Floating point. Results are the same bits on every machine. A call saves the rounding and flush modes, computes in
 * round to nearest with subnormals, and restores the modes. The library prints nothing and never exits.
 */
#ifndef MOTUS_H
#define MOTUS_H

#include <stddef.h>
#include <stdint.h>

#define MOTUS_VERSION_MAJOR 0
#define MOTUS_VERSION_MINOR 2
#define MOTUS_VERSION_PATCH 0
#define MOTUS_VERSION "0.2.0"

#ifdef MOTUS_BUILDING
#define MOTUS_API __attribute__((visibility("default")))
#else
#define MOTUS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the version of the library that is loaded (MOTUS_VERSION is the header's). */
MOTUS_API const char *motus_version(void);

/* 1. Status and errors ------------------------------------------------------------------------------------------- */

/* Each status: its name, its word (the `kind` in JSON), its sentence, and the exit status of the program. */
#define MOTUS_STATUS_MAP(X)                                                    \
    X(OK, "ok", "done", 0)                                                     \
    X(MEMORY, "memory", "out of memory", 1)                                    \
    X(DIVERGED, "diverged", "the motion left the finite numbers", 1)           \
    X(SOLVE, "solve", "an implicit equation could not be solved", 1)           \
    X(CALLBACK, "callback", "the acceleration callback reported a failure", 1) \
    X(CANCELLED, "cancelled", "cancelled", 1)                                  \
    X(FILE, "file", "a file could not be read or written", 1)                  \
    X(ORDER, "order", "the observed order is below the declared one", 1)       \
    X(TOOL, "tool", "an outside program is missing or failed", 1)              \
    X(ARGUMENT, "argument", "an argument is out of its range", 2)              \
    X(SYNTAX, "syntax", "the text cannot be read as a model", 2)               \
    X(NAME, "name", "a name is unknown, missing or defined twice", 2)          \
    X(SHAPE, "shape", "scalars, vectors or lists do not fit together", 2)      \
    X(LIMIT, "limit", "a bound of the language or the library is exceeded", 2) \
    X(METHOD, "method", "the method does not admit this model", 2)             \
    X(STATE, "state", "the restart state does not fit this run", 2)            \
    X(UNAVAILABLE, "unavailable", "not available in this version", 2)          \
    X(SINGULAR, "singular", "the run passes a singularity of the force", 1)    \
    X(UNRESOLVED, "unresolved", "the step does not resolve the force", 1)      \
    X(ACCURACY, "accuracy", "the accuracy was not reached", 1)                 \
    X(STEPS, "steps", "the run has taken the most steps that it may", 1)       \
    X(EVENTS, "events", "too many events in one instant", 1)

#define MOTUS_STATUS_ENUMERATOR(name, word, text, exit) MOTUS_##name,
typedef enum motus_status {
    MOTUS_STATUS_MAP(MOTUS_STATUS_ENUMERATOR)
        MOTUS_STATUS_COUNT /* how many this header knows; a newer library may have more */
} motus_status;
#undef MOTUS_STATUS_ENUMERATOR

/* Return the word of a status, "diverged"; its sentence; and the exit status of the program, 0, 1 or 2. */
MOTUS_API const char *motus_status_word(motus_status);
MOTUS_API const char *motus_status_text(motus_status);
MOTUS_API int motus_status_exit(motus_status);

/* The sizes of texts and of names in structs, in bytes, the final 0 included. */
#define MOTUS_TEXT_MAX 512
#define MOTUS_NAME_MAX 64

/* Why a run fails, or comes no further: its name, and its word (the `cause` in JSON, `stopped_by` of a sweep). */
#define MOTUS_CAUSE_MAP(X)                                                                                     \
    X(NONE, "")                       /* not known: time, variable and step are all that can be said */        \
    X(SINGULAR, "singular")           /* the force has no finite value at a time that the motion approaches */ \
    X(STIFF, "stiff")                 /* stability, not accuracy, bounds the steps */                          \
    X(DISCONTINUOUS, "discontinuous") /* the force jumps; no step ends there, or no motion goes on */          \
    X(EVENTS, "events")               /* events without end in one instant or in a short time */               \
    X(SOLVER, "newton")               /* the iteration for an implicit equation does not converge */           \
    X(ROUNDING, "rounding")           /* the tolerance asks for less than rounding leaves */                   \
    X(INFINITE, "infinite")           /* a number leaves the finite numbers, or the force is not defined there */

#define MOTUS_CAUSE_ENUMERATOR(name, word) MOTUS_CAUSE_##name,
typedef enum motus_cause { MOTUS_CAUSE_MAP(MOTUS_CAUSE_ENUMERATOR) MOTUS_CAUSE_COUNT } motus_cause;
#undef MOTUS_CAUSE_ENUMERATOR

MOTUS_API const char *motus_cause_word(motus_cause); /* returns "singular" */

/* Structs with a size: see Sizes above. MOTUS_DEFAULT_FUNCTION behind a struct declares what makes it,
 * motus_default_run() for motus_run_def. */
typedef enum motus_def_kind {
    MOTUS_DEF_ERROR,
    MOTUS_DEF_TEXT,
    MOTUS_DEF_CALLBACK,
    MOTUS_DEF_RUN,
    MOTUS_DEF_STUDY,
    MOTUS_DEF_ENSEMBLE,
    MOTUS_DEF_VARIABLE,
    MOTUS_DEF_COLUMN,
    MOTUS_DEF_PARAMETER,
    MOTUS_DEF_INITIAL,
    MOTUS_DEF_SETTINGS,
    MOTUS_DEF_ANALYSIS,
    MOTUS_DEF_STATEMENT,
    MOTUS_DEF_RUN_STATISTICS,
    MOTUS_DEF_ESTIMATE,
    MOTUS_DEF_EVENT_ROW,
    MOTUS_DEF_SWITCH,
    MOTUS_DEF_ENSEMBLE_STATISTICS
} motus_def_kind;
/* Fills in the first `size` bytes of a struct with its defaults. Bytes beyond the library's own size become zero, and
 * so does a struct that the library does not know. */
MOTUS_API void motus_default(motus_def_kind, void *made, uint32_t size);

#define MOTUS_DEFAULT_FUNCTION(name, KIND, type)                       \
    static inline type motus_default_##name(void)                      \
    {                                                                  \
        type made;                                                     \
        motus_default(MOTUS_DEF_##KIND, &made, (uint32_t)sizeof made); \
        return made;                                                   \
    }
/* What went wrong, where, and what to do. A call fills it only when it returns other than MOTUS_OK. Every call accepts
 * NULL in its place. */
typedef struct motus_error {
    uint32_t size; /* by motus_default_error() */
    motus_status status;
    int line, column; /* of an error in a text: its place, both from 1, column in characters; else 0 */
    /* CALLBACK: what the callback returned, or 0 if it reads the velocity although its definition says that it does
     * not. Every other status: 0. */
    int returned;
    /* DIVERGED, SOLVE, CALLBACK, STEPS, EVENTS, SINGULAR, UNRESOLVED: the time of the failure; else NaN */
    double time;
    /* DIVERGED, SOLVE, and wherever `cause` is known: the number that failed, "r[3].y"; EVENTS: the event; else "" */
    char variable[MOTUS_NAME_MAX];
    char message[MOTUS_TEXT_MAX]; /* one sentence, UTF-8, without a newline, safe to print on a terminal */
    char hint[MOTUS_TEXT_MAX];    /* what to do, or "" */
    char source[MOTUS_TEXT_MAX];  /* the line of the text, control characters replaced, or "" */
    char caret[MOTUS_TEXT_MAX];   /* blanks and carets to print under `source`, or "" */
    char file[MOTUS_TEXT_MAX];    /* `file` of the definition, or "" */
    /* For an editor, where a text is wrong: the wrong word, which stands at line and column, or ""; and what to write
     * in its place, or "". Without a word, `instead` is a line to add. */
    char word[MOTUS_NAME_MAX], instead[MOTUS_TEXT_MAX];
    /* MOTUS_CAUSE_SINGULAR: the time at which the motion is singular, and the power p with which `variable` goes there,
     * as |t - singular|^p; p is below 0 where it grows beyond all bounds. Both have errors. They are those of the run's
     * own motion: with steps of one size, the errors do not contain how far the run was off before. NaN: not known. */
    double singular, singular_error, exponent, exponent_error;
    /* a member of the definition to change, and its value, "until = 0.99", "method = radau15"; or "" */
    char attempt[MOTUS_NAME_MAX];
    motus_cause cause; /* why a run failed, as far as the evidence suffices */
    int verified;      /* 1: trial steps from shortly before the failure, with this value, have led beyond it */
} motus_error;
MOTUS_DEFAULT_FUNCTION(error, ERROR, motus_error)

/* Returns an error in one line, safe to print: "spring.motus:2:7: there is no name w; hint: …". It does not change, and
 * needs no room of yours: puts(motus_error_line(&err).text). "": there is no error. */
typedef struct motus_line {
    char text[4 * MOTUS_TEXT_MAX]; /* file, place, message and hint fit in whole */
} motus_line;
MOTUS_API motus_line motus_error_line(const motus_error *);

/* Memory. Without an `allocate` the library uses malloc and free. `allocate` returns at least `bytes` bytes, aligned
 * for any type, or NULL when there is no memory. `release` gets what `allocate` returned, and never NULL; where it is
 * NULL itself, the library gives nothing back. */
typedef struct motus_allocator {
    void *(*allocate)(void *context, size_t bytes);
    void (*release)(void *context, void *block);
    void *context;
} motus_allocator;

/* 2. Systems ----------------------------------------------------------------------------------------------------- */

typedef struct motus_system motus_system;

/* Defines a system by the text of a model. */
typedef struct motus_text_def {
    uint32_t size;          /* by motus_default_text() */
    const char *text;       /* UTF-8; need not end with 0 if length is given */
    size_t length;          /* bytes; SIZE_MAX: up to the terminating 0 */
    const char *file;       /* a name for messages; NULL: none */
    const char *const *set; /* set_count strings "name=expression" that replace a parameter or an initial value: */
    size_t set_count;       /*   "F=0.2", "x(0)=1", "r'(0)=(1, 2)", "m=[1, 2]" */
    motus_allocator allocator;
    /* 0: the text is complete. Above 0: it is being written, as in an editor. Then a variable without any line
     * x'(0) = … starts at rest (`supposed` in motus_initial), and motus_suggest chooses from the motion, of which it
     * computes up to so many numbers, accelerations times their length: 1e5 suffice for a few bodies. */
    size_t draft;
    /* when_count events that are added to those of the text, each what stands behind `when`: "x = 0 rising: record" */
    const char *const *when;
    size_t when_count;
    /* define_count quantities or parameters that are added to those of the text, each "name = expression" */
    const char *const *define;
    size_t define_count;
} motus_text_def;
MOTUS_DEFAULT_FUNCTION(text, TEXT, motus_text_def)

/* An event of a callback: something that is to happen where a function of the time and the state passes 0, or at equal
 * times. */
typedef struct motus_event_def {
    const char *name; /* unique; NULL: event1, event2 … by its number. Copied */
    int direction;    /* 1: the function rises, -1: it falls, along the run; 0: both, and where it touches 0 */
    double every;     /* 0; or > 0: it happens at start + every, start + 2 every …, and its function is not read */
    int assigns;      /* 1: `event_action` changes the state; 0: it is not called */
    int silent;       /* 1: the events of this kind have no row in the table (motus_run_event) */
    int64_t stop;     /* the run ends at event number `stop` of this kind; 0: it goes on */
} motus_event_def;

/* Defines a system by C functions. The state is x, `positions` numbers, and v, `positions + first_order` numbers: the
 * velocities of all positions, then the first-order variables s. The callback writes a, as long as v: x'' first, then
 * s'.
 *
 * A callback returns 0 on success. Any other value stops the call that needed it with MOTUS_CALLBACK, and the
 * motus_error holds the value and the time:
 *     below 0   The callback failed. The run, the ensemble or the study ends.
 *     above 0   The callback is not defined at these arguments. A run stops; a smaller step may lead around the place.
 *               An ensemble stops this trajectory alone, as one that leaves the finite numbers.
 * In both cases the run stands at its last good step, and motus_run_state gives the state there. Some methods, such as
 * velocity-verlet and verlet, form the velocity with the acceleration at the end of a step. With them a step is good
 * only if the callback is defined at its end. To find out, a call that takes steps evaluates the acceleration once more
 * at its end; the next step reuses the value. */
typedef struct motus_callback_def {
    uint32_t size;                 /* by motus_default_callback() */
    size_t positions, first_order; /* how many positions, and how many first-order variables s' = f */
    /* initial values, `positions` and `positions + first_order` numbers, copied; finite */
    const double *x, *v;
    double start; /* initial time */
    /* NULL, or `positions + first_order` names as in a model, all different: "theta", whose velocity is then
     * "theta'". Copied. Without names the positions are x[1], x[2] …, a single one x; first-order variables are s[1],
     * s[2] …, or s. */
    const char *const *names;
    int (*acceleration)(void *context, double t, const double *x, const double *v, double *a);
    /* Optional: the directional derivative da = (da/dx) dx + (da/dv) dv. NULL: the library takes difference quotients
     * where it needs one. dx is as long as x, dv and da as long as v. */
    int (*derivative)(void *context, double t, const double *x, const double *v, const double *dx, const double *dv,
                      double *da);
    int (*exact)(void *context, double t, double *x, double *v); /* optional: the exact motion */
    /* Optional: `quantities` numbers to observe, and `invariants` numbers that the motion should conserve; each
     * function fills in all of its numbers; 1 by default. The names are copied. Without names the numbers are one
     * quantity, "quantity", or one invariant, "invariant", with indices from 1 where there are several. */
    int (*quantity)(void *context, double t, const double *x, const double *v, double *values);
    int (*invariant)(void *context, double t, const double *x, const double *v, double *values);
    size_t quantities, invariants;
    const char *const *quantity_names, *const *invariant_names;
    /* Whether `acceleration` (or `block`) reads v and t; 1 by default, which is safe. Where depends_on_velocity is 0,
     * its v holds NaN instead of velocities and first-order variables: if it reads them all the same, the acceleration
     * is NaN, and the call that needed it fails with MOTUS_CALLBACK. */
    int depends_on_velocity, depends_on_time;
    int linear_in_velocity; /* 1: one linear solve suffices for implicit velocity terms */
    void *context;          /* the first argument of all callbacks */
    motus_allocator allocator;
    /* Optional: the acceleration of a block of `count` trajectories of an ensemble, trajectories `first` to `first +
     * count - 1`: number k of trajectory first + j is x[k * count + j], and likewise for v and a. Write it as loops
     * over j, which a compiler can vectorise. Trajectories may differ in numbers of the context that you index by
     * first + j. An ensemble calls it instead of `acceleration` (which may then be NULL: a run is trajectory 0 alone)
     * and takes difference quotients instead of `derivative`, which serves one trajectory only. What it computes for a
     * trajectory must depend neither on the others nor on `count`, because methods that solve an equation, and
     * trajectories that stop, are computed in smaller blocks, down to 1. A value other than 0 holds for the whole
     * block; after a value above 0 the ensemble calls it again with smaller blocks, to find the trajectory that
     * stops. */
    int (*block)(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a);
    /* Optional: events, copied. `event_functions` fills in `event_count` numbers, the function of each; smooth ones
     * wherever the motion leads. `event_action` changes x and v where `event` happens; it sees the state on arrival. A
     * value other than 0 of either fails the call with MOTUS_CALLBACK. */
    const motus_event_def *events;
    size_t event_count;
    int (*event_functions)(void *context, double t, const double *x, const double *v, double *values);
    int (*event_action)(void *context, size_t event, double t, double *x, double *v);
} motus_callback_def;
MOTUS_DEFAULT_FUNCTION(callback, CALLBACK, motus_callback_def)

/* Creates a system from a text. MOTUS_SYNTAX, MOTUS_NAME, MOTUS_SHAPE, MOTUS_LIMIT, MOTUS_ARGUMENT (a value out of its
 * range, an exact line that does not obey the equation, or an invariant that changes along the motion) and
 * MOTUS_UNAVAILABLE, each with its place in the text. */
MOTUS_API motus_status motus_system_from_text(const motus_text_def *, motus_system **, motus_error *);
/* Creates a system from C functions. MOTUS_ARGUMENT: there is no acceleration, neither positions nor first-order
 * variables, or an initial value is missing or not finite. MOTUS_NAME: a name is not a name of the language, or is used
 * twice. MOTUS_LIMIT: too many numbers. It calls no callback. */
MOTUS_API motus_status motus_system_from_callback(const motus_callback_def *, motus_system **, motus_error *);
MOTUS_API void motus_system_destroy(motus_system *);
/* Returns the hooks that the system was created with. All that computes with the system takes its memory by them. */
MOTUS_API const motus_allocator *motus_system_allocator(const motus_system *);

/* Copies a system for another thread, numbers that were set included. The two share only the callbacks, their context
 * and the allocator, which must be safe to call from both threads. It fails with MOTUS_MEMORY alone. */
MOTUS_API motus_status motus_system_clone(const motus_system *, motus_system **, motus_error *);

/* 3. What a system holds ----------------------------------------------------------------------------------------- */

MOTUS_API size_t motus_positions(const motus_system *);  /* nx: length of x, without boundary cells */
MOTUS_API size_t motus_velocities(const motus_system *); /* nv: length of v: velocities, then first-order variables */

/* A variable of the model: a state with its family indices and components. */
typedef struct motus_variable {
    uint32_t size; /* by motus_default_variable() */
    const char *name;
    int order;                 /* 2: x'' = …   1: s' = … */
    int components;            /* 0: scalar, else the length of the vector */
    int dimensions;            /* number of family indices, 0 … 4 */
    int64_t first[4], last[4]; /* the smallest index ranges that hold all equations */
    size_t count;              /* numbers in all: cells × components */
} motus_variable;
MOTUS_DEFAULT_FUNCTION(variable, VARIABLE, motus_variable)
MOTUS_API size_t motus_variable_count(const motus_system *);
/* Fills in variable k, in the order of the model. MOTUS_ARGUMENT: k is past the last; so with all calls …_at. */
MOTUS_API motus_status motus_variable_at(const motus_system *, size_t k, motus_variable *);

/* Columns: every number that can be observed along a run, in one numbering: t; positions; velocities; first-order
 * variables; quantities; invariants; exact motion. Names: "t", "x", "x'", "r.x", "r'.y", "x[3]'", "w[2]" (component 2
 * of a vector longer than 3), "r[3].x", "energy", "exact x". */
typedef enum motus_column_kind {
    MOTUS_COLUMN_TIME,
    MOTUS_COLUMN_POSITION,
    MOTUS_COLUMN_VELOCITY,
    MOTUS_COLUMN_FIRST_ORDER,
    MOTUS_COLUMN_QUANTITY,
    MOTUS_COLUMN_INVARIANT,
    MOTUS_COLUMN_EXACT
} motus_column_kind;
typedef struct motus_column {
    uint32_t size; /* by motus_default_column() */
    motus_column_kind kind;
    size_t variable; /* index of its variable, quantity or invariant; of the time 0 */
    int is_velocity; /* 1: a velocity, exact or not */
    int component;   /* of a vector, from 0; of a scalar 0 */
    int dimensions;  /* number of family indices, 0 … 4, */
    int64_t cell[4]; /*   and these, as the language counts them */
    char name[MOTUS_NAME_MAX + 64];
} motus_column;
MOTUS_DEFAULT_FUNCTION(column, COLUMN, motus_column)
MOTUS_API size_t motus_column_count(const motus_system *);
MOTUS_API motus_status motus_column_at(const motus_system *, size_t k, motus_column *);
/* Finds the number *k of the column with this kind, variable, component and cell (and, of exact columns, is_velocity);
 * it reads no other member. MOTUS_NAME: there is no such column. */
MOTUS_API motus_status motus_column_of(const motus_system *, const motus_column *, size_t *k, motus_error *);
/* Finds the columns that a name stands for, *count from *first on: "x" of a vector or family is all of its numbers.
 * MOTUS_NAME: no column has the name; the hint names the nearest one. */
MOTUS_API motus_status motus_column_find(const motus_system *, const char *name, size_t *first, size_t *count,
                                         motus_error *);
/* Finds the columns of `count` names, each of one number: columns[k] is that of names[k]. MOTUS_NAME: as from
 * motus_column_find. MOTUS_SHAPE: a name stands for several numbers; the hint names the first of them. */
MOTUS_API motus_status motus_columns_named(const motus_system *, size_t count, const char *const *names,
                                           size_t *columns, motus_error *);

/* Return the names of quantities and invariants, in the order of the model or of the definition; NULL past the last.
 * *numbers (may be NULL): how many numbers, that is columns, it has. */
MOTUS_API size_t motus_quantity_count(const motus_system *);
MOTUS_API const char *motus_quantity_name(const motus_system *, size_t k, size_t *numbers);
MOTUS_API size_t motus_invariant_count(const motus_system *);
MOTUS_API const char *motus_invariant_name(const motus_system *, size_t k, size_t *numbers);
MOTUS_API int motus_has_exact(const motus_system *); /* 1: the exact motion is known */

/* The numbers that may be set, by `set` in motus_text_def or later by motus_system_set: parameters, in the order of
 * the model, and initial values. A callback has no parameters. */
typedef struct motus_parameter {
    uint32_t size; /* by motus_default_parameter() */
    const char *name;
    const char *text;          /* its right side, in the model or in `set`: `length` bytes without a final 0; */
    size_t length;             /*   motus_system_set does not change it */
    int components;            /* 0: scalar, else the length of the vector */
    int list;                  /* 1: a list, or a family */
    int dimensions;            /* of a list: number of indices, 1 … 4, */
    int64_t first[4], last[4]; /*   and their ranges */
    size_t count;              /* numbers in all: cells × components */
    /* What the parameter decides besides numbers, "a size or an index", "step", "until", "the start" …; then neither
     * motus_system_set nor an ensemble can change it. NULL: nothing. "unknown": there was no memory to find out. */
    const char *decides;
} motus_parameter;
MOTUS_DEFAULT_FUNCTION(parameter, PARAMETER, motus_parameter)
MOTUS_API size_t motus_parameter_count(const motus_system *);
MOTUS_API motus_status motus_parameter_at(const motus_system *, size_t k, motus_parameter *);
/* Writes the present numbers of parameter k to out, `count` of them, cell by cell, component by component.
 * MOTUS_ARGUMENT: k is past the last. */
MOTUS_API motus_status motus_parameter_values(const motus_system *, size_t k, double *out);

typedef struct motus_initial {
    uint32_t size;   /* by motus_default_initial() */
    size_t variable; /* its variable: motus_variable_at gives components and indices */
    int is_velocity;
    int supposed;                   /* 1: the text has no line for it, and its numbers are 0: `draft` */
    size_t count;                   /* numbers in all */
    char name[MOTUS_NAME_MAX + 64]; /* "x(0)", "r'(0)", as `set` and motus_system_set take it */
} motus_initial;
MOTUS_DEFAULT_FUNCTION(initial, INITIAL, motus_initial)
MOTUS_API size_t motus_initial_count(const motus_system *);
MOTUS_API motus_status motus_initial_at(const motus_system *, size_t k, motus_initial *);
/* Writes the present numbers of initial value k to out, `count` of them, cell by cell, component by component.
 * MOTUS_ARGUMENT: k is past the last. */
MOTUS_API motus_status motus_initial_values(const motus_system *, size_t k, double *out);

/* Sets numbers of a system without reading its text again, for sliders and searches: those of a parameter, "F", or of
 * an initial value by its name in motus_initial, "x'(0)" (of a callback, initial values alone). values: all of its
 * `count` numbers, in the order of motus_parameter_values or motus_initial_values. The call computes again what depends
 * on them, except what was set itself. Runs created afterwards have the bits of a system that was read with these
 * numbers in `set` of its motus_text_def. After a failure all numbers are unchanged. MOTUS_NAME: there is no such
 * parameter or initial value. MOTUS_SHAPE: `count` is not the number of its numbers. MOTUS_ARGUMENT: a number is not
 * finite, or a number that depends on it would not be; an exact line would no longer obey the equation, or an invariant
 * would change along the motion; the parameter decides a size, the step or the like (motus_parameter.decides); or a
 * run, an ensemble or a reference still uses the system. */
MOTUS_API motus_status motus_system_set(motus_system *, const char *name, const double *values, size_t count,
                                        motus_error *);

/* Who says a setting. */
typedef enum motus_said {
    MOTUS_SAID_NOBODY, /* it is NaN, or NULL */
    MOTUS_SAID_CALLER, /* the definition of a run or an ensemble */
    MOTUS_SAID_MODEL,
    MOTUS_SAID_ASIDE, /* the model says it of its own method or error, and the definition asks for another one */
    MOTUS_SAID_DEFAULT,
    MOTUS_SAID_SUGGESTED /* motus_suggest */
} motus_said;

/* The settings of a model (motus_settings_of), or those that a definition leads to (motus_run_settings), and who says
 * each of them. NaN, 0 or NULL: nobody does. */
typedef struct motus_settings {
    uint32_t size;      /* by motus_default_settings() */
    const char *method; /* "verlet", "newmark(0.25, 0.5)", "auto" */
    double step, from, until;
    double tolerance;    /* of an adaptive method */
    double accuracy;     /* of the answer */
    double every_time;   /* `every` of the model, as a time, */
    int64_t every_steps; /*   or as a number of steps */
    /* motus_suggest fills these in where it had to find a number: the fastest rate of the motion, in radians per time,
     * 0 if the force is constant; and the longest period, or the scale of time where nothing oscillates. Else 0. */
    double rate, period;
    /* motus_suggest fills these in for a system with `draft`: why it chose this step and this end, "60 to a swing",
     * "three swings". Else "". */
    char step_why[MOTUS_NAME_MAX], until_why[MOTUS_NAME_MAX];
    int absolute;  /* 1: the tolerance or the accuracy is absolute */
    int automatic; /* 1: a run chooses its method ("auto"), where its definition names none and gives no step */
    motus_said method_said, step_said, from_said, until_said, tolerance_said, accuracy_said;
} motus_settings;
MOTUS_DEFAULT_FUNCTION(settings, SETTINGS, motus_settings)
MOTUS_API motus_status motus_settings_of(const motus_system *, motus_settings *);
/* Suggests step, until and method: fills in those that are NaN or NULL, and takes the others, and `from`, as they are.
 * Calls that create runs, ensembles and studies of a model do so themselves where neither the definition nor the model
 * gives a number. For a callback only this call does, since it evaluates the acceleration. MOTUS_METHOD: as from
 * motus_method_admits. MOTUS_CALLBACK: a callback returned other than 0 at the start.
 *
 * The method is verlet. The step is at most 1/80 of the period of the fastest rate, 2 pi/rate, and at most 1/100 of the
 * way to the end. Rates are the sizes of the eigenvalues of the equations linearised along the motion, which a short
 * run with steps that adapt follows; and at the start also the rate at which the force changes with t, and how fast the
 * state changes, min(|x'|/|x|, |x''|/|x'|). The end comes after 10 of the longest periods that the equations have at
 * the start (where these say nothing, as at an inflection of the potential, along the motion), or, where nothing
 * oscillates, after 10 times the scale of time, 1/rate. Under a constant force it comes after
 * 2 max(|x'|/|x''|, sqrt(|x|/|x''|)), without a force after 10 |x|/|x'|, or at 10. Both numbers are rounded to 1, 2 or
 * 5 times a power of ten. There are at most 1e6 steps, fewer in large systems, so the end may come earlier. Where the
 * end is given, the step grows instead, up to half of the method's stability limit; beyond that there are more steps.
 *
 * For a system with `draft` the call follows the motion itself, by an embedded pair of orders 3 and 2, and chooses by
 * what happens as long as it follows. The numbers have two digits, the end of a fall three; there are at most 10000
 * steps. What a motion does decides:
 *     It swings:    The step is 1/60 of the shortest swing, from a turning point to the next but one, and less where
 *                   the motion changes faster in between. The end comes after three of the longest swings, means of
 *                   those that differ.
 *     It falls:     The end is where the number with the largest force is at 0.
 *     It becomes infinite or singular, or has no force any more: The end is before.
 *     It settles:   The end is when every number is within a hundredth of its range of where it stays.
 *     It runs away: The end is when it has grown 20 times.
 *     Else the rates at the start choose, "for a start": 60 steps in the period of the fastest; the end after 3 of the
 *                   longest periods, or 5 scales of time where nothing oscillates. */
MOTUS_API motus_status motus_suggest(motus_system *, motus_settings *, motus_error *);

/* What the library knows of the equations, from the text of a model or the definition of a callback. 1: yes; 0: no, or
 * not known. */
typedef struct motus_analysis {
    uint32_t size; /* by motus_default_analysis() */
    int velocity_dependent, linear_in_velocity, time_dependent, affine, constant;
    int gyroscopic;       /* a = E(x, t) + v × B(x, t): the velocity term does no work */
    int gradient;         /* the force is the gradient of a potential, near every state */
    int smooth;           /* 1: no abs, min, max, floor, mod, sign, if */
    int exact_recognised; /* the exact motion is known without an exact line */
    /* 1: `gyroscopic` or `gradient` is not proved by the formulas, but held at random states of many sizes */
    int sampled_gyroscopic, sampled_gradient;
    int energy; /* an energy is proved to exist: a gradient without time, whose potential has one value everywhere */
} motus_analysis;
MOTUS_DEFAULT_FUNCTION(analysis, ANALYSIS, motus_analysis)
MOTUS_API motus_status motus_analysis_of(const motus_system *, motus_analysis *);
/* Says in words what motus_analysis tells, one sentence a line, with the coefficients of the velocity. Owned by the
 * system. "": there was no memory. */
MOTUS_API const char *motus_explain(motus_system *);
/* Says in words what the events of a model are, one sentence a line: what each waits for and does, the parameters that
 * they assign, and which conditions already hold at the start, where they are no events. Owned by the system, until the
 * next call of this function. "": there are none, or there was no memory. */
MOTUS_API const char *motus_explain_events(motus_system *);
/* A place where the force changes its formula: each abs, sign, min, max, floor, mod, cbrt and comparison of time or
 * state in the equations of motion, with the surface on which it does. */
typedef enum motus_sliding {
    MOTUS_SLIDING_UNKNOWN, /* the surface cannot be located */
    MOTUS_SLIDING_NEVER,   /* motions pass: the operation does not jump, or does not move what it depends on */
    MOTUS_SLIDING_HELD,    /* where the force drives a motion back from both sides, it is held on the surface */
    MOTUS_SLIDING_ENDS     /* there a run ends with MOTUS_SOLVE */
} motus_sliding;
typedef struct motus_switch {
    uint32_t size;           /* by motus_default_switch() */
    const char *operation;   /* "sign(V - x')"; all three texts are the system's, until the next call */
    const char *surface;     /* "V - x' = 0", "t/2 = a whole number" */
    size_t count;            /* switches: 1, of a family the cells of its indices' ranges; 0: not known */
    int located;             /* 1: adaptive methods end their steps on it, unless they are told otherwise */
    const char *not_located; /* why they do not: a sentence without full stop; "": they do */
    motus_sliding sliding;   /* of runs that locate it */
} motus_switch;
MOTUS_DEFAULT_FUNCTION(switch, SWITCH, motus_switch)
/* Fills in switch k, in the order in which the equations are evaluated. MOTUS_ARGUMENT: k is past the last; a callback
 * has none. MOTUS_MEMORY: there was no memory. Where a model has more switches than can be located, the last one is the
 * first that is too many. */
MOTUS_API motus_status motus_switch_at(motus_system *, size_t k, motus_switch *);
/* Writes equation k in normal form, as text in the language: "x'' = x^3 - x + F cos(t)". Owned by the system, until the
 * next call of this function. NULL: k is past the last, the system is from a callback, or there was no memory. */
MOTUS_API const char *motus_equation_text(motus_system *, size_t k);

/* 4. Methods ----------------------------------------------------------------------------------------------------- */

typedef enum motus_forces { MOTUS_FORCES_X, MOTUS_FORCES_XT, MOTUS_FORCES_XVT } motus_forces;
typedef struct motus_method {
    const char *name, *aliases; /* aliases: blank-separated, "" if none */
    const char *title;          /* for a text or a legend: "velocity Verlet" */
    const char *family; /* "splitting", "runge-kutta", "two-step", "implicit", "extrapolation", "taylor", "exact" */
    /* order: 0: the method is exact. Where any_order is 1, the order follows the tolerance, and this is the order at
     * coarse tolerances. */
    int order, stages;
    /* Evaluations of the acceleration per step in a long run; 0: they depend on the iterations. Of a method that
     * chooses its order, those in a step of this order. Splitting methods need more where first-order variables read
     * the velocity, or the velocity enters nonlinearly. */
    int evaluations;
    motus_forces forces;        /* what the force may depend on */
    int symplectic, reversible; /* symplectic: where the force is a gradient; motus_method_geometry tells of a system */
    double stability_limit;     /* the largest stable h ω for x'' = -ω² x; INFINITY: all are; 0: none is */
    const char *cite;           /* key in doc/references.bib, with the place */
    const char *formula, *use;  /* the formula of a step, and when to use the method */
    int adaptive;               /* 1: it chooses its steps by a tolerance; 0: steps have one size */
    /* Of the states between steps (motus_run_sample), for every force that the method admits: in one step the
     * interpolation adds an error of the power dense_order + 1 of the step, at least. Of "extrapolation" the order
     * follows that of the step, up to 14. */
    int dense_order;
    int any_order; /* 1: the order follows the tolerance, so the error has no one power of the step */
    int series;    /* 1: a step is a Taylor series, and an evaluation one coefficient of the acceleration's */
} motus_method;
MOTUS_API size_t motus_method_count(void);
MOTUS_API const motus_method *motus_method_at(size_t k); /* NULL: k is past the last */
/* Finds a method by name or alias, in any letter case, with its arguments if it has any: "newmark(1/6, 1/2)". `found`
 * may be NULL. MOTUS_METHOD: there is no such method, and the hint names the nearest one; or the arguments are
 * wrong. */
MOTUS_API motus_status motus_method_find(const char *name, const motus_method **found, motus_error *);
/* Returns 1 if a step of the method multiplies every motion of a linear force by a function of h λ alone, where λ is
 * its rate, so that motus_stability tells its stability for any force. 0: it does not, or there is no such method. */
MOTUS_API int motus_method_by_rates(const char *method);
/* Returns MOTUS_OK if the method can integrate the system. MOTUS_METHOD: it cannot, for the reason in `message`, and
 * `hint` names the nearest method that can; or there is no such method. */
MOTUS_API motus_status motus_method_admits(const motus_system *, const char *method, motus_error *);

/* What every step of a method preserves of a system's motion. motus_method speaks of the forces that suit the method
 * best; `reversible` there holds for every force that the method admits. */
typedef enum motus_geometry {
    MOTUS_GEOMETRY_NONE,   /* or not known: a callback's force may be a gradient */
    MOTUS_GEOMETRY_VOLUME, /* the volume of phase space: a splitting method, and a force without friction */
    /* The symplectic structure, and so the volume: the force is a gradient. Where it does not depend on time either, an
     * energy exists, and its error stays bounded for very long times. */
    MOTUS_GEOMETRY_SYMPLECTIC
} motus_geometry;
/* Finds what a method preserves of this system's motion. MOTUS_METHOD: as from motus_method_admits. */
MOTUS_API motus_status motus_method_geometry(const motus_system *, const char *method, motus_geometry *, motus_error *);

/* Computes the stability region. radius[k], for each of `count` points z = h λ = re[k] + i im[k], is the spectral
 * radius of one step, the factor by which a step multiplies a motion in the long run, on the equation with the
 * eigenvalues λ and its conjugate, x'' = 2 Re λ x' - |λ|² x: the imaginary axis is an oscillator without friction, the
 * left half plane one with friction. The method is stable where the radius is at most 1, up to rounding: some 1e-15 (1
 * + |z|) to the power of the stages, and the square root of that where the two eigenvalues coincide. For Runge-Kutta it
 * is |R(z)|. NaN off the imaginary axis for a method that does not admit forces of the velocity. INFINITY where a step
 * has no finite or no unique result. MOTUS_METHOD: there is no such method, or it takes no steps. MOTUS_ARGUMENT: |z|
 * is above MOTUS_STABILITY_FAR, or NaN. */
#define MOTUS_STABILITY_FAR 1e6
MOTUS_API motus_status motus_stability(const char *method, size_t count, const double *re, const double *im,
                                       double *radius, motus_error *);

/* 5. Runs -------------------------------------------------------------------------------------------------------- */

typedef struct motus_run motus_run;

/* What a run does where the force changes its formula: where the argument of an abs, sign, min, max, floor, mod, cbrt
 * or of a comparison passes the value that decides. */
typedef enum motus_switches {
    MOTUS_SWITCHES_STEP, /* it steps across, and loses the order of its method there */
    /* Every step ends where a switch changes its side, located to the rounding of the time, and the method keeps its
     * order. A method whose steps have one size then goes on to the time at which the step would have ended, so the
     * times after steps are those of other runs but for their rounding. Such a run cannot be traced.
     *
     * Where a sign(s) drives s back to 0 from both sides, as dry friction does that sticks, s stays 0, and the sign has
     * the value in [-1, 1] that keeps it, until that leaves the interval. Where swings become ever shorter and come to
     * an end, as under -2 sign(x) - sign(x'), both stay 0. A comparison that drives its own operands back is held
     * between its branches, where the force is affine in it. MOTUS_SOLVE: another switch would have to be held, or two
     * of families, or more than 8, that depend on one another; or the force drives the motion away to both sides, so
     * that it is not unique. MOTUS_EVENTS: switches follow one another ever faster, and nothing holds the motion there.
     */
    MOTUS_SWITCHES_LOCATE,
    /* As MOTUS_SWITCHES_LOCATE, with steps so short that no switch changes its side and changes back within one,
     * however narrow its window. Where the force has an operation that may change from one regime to another and back,
     * as exp(-z²) does at its peak, steps are halved until it cannot, and until two halves give the same as one. The
     * interpreter runs it, by a method whose steps have one size. Such a run tells no errors, and cannot be sampled,
     * saved or restored; an ensemble refuses it. MOTUS_SOLVE: the force changes too fast, or something would have to
     * be held at 0. Reference solutions are runs of this kind. */
    MOTUS_SWITCHES_RESOLVE,
    /* The default: LOCATE by methods that adapt steps, else STEP. STEP too where there are over 64 switches, where
     * they cannot be located, and where the force may be undefined beyond one, as max(0, x)^1.5 is, unless "auto" gets
     * its accuracy with LOCATE: not_located of motus_run_statistics says why. Ensembles choose so, without trials. */
    MOTUS_SWITCHES_USUAL
} motus_switches;

/* Whether a run has bars of error, which tell how far its numbers are from the exact motion, that of the equations and
 * the numbers as they are written. The bits of the run do not depend on it, with one exception: where its steps adapt,
 * and a step leads over a change of the force that the step does not show, the run with bars takes shorter steps in its
 * place. motus_run_errors says what bars cost. */
typedef enum motus_bars {
    MOTUS_BARS_NONE,
    /* Bars by a companion: a run of about half the step, or of two halves of every step that adapts, with every decimal
     * rounded to the other side. Where steps adapt and the force is not smooth, the companion takes steps of its own,
     * by a smaller tolerance. */
    MOTUS_BARS_CHEAP,
    /* Bars by a second companion too, which takes the run's steps and begins an ulp away: for motions that pass close
     * encounters. */
    MOTUS_BARS_FULL
} motus_bars;

typedef struct motus_run_def {
    uint32_t size; /* by motus_default_run() */
    /* NULL: the model's; where neither names one "verlet" if a step is given, else "auto". "auto": the run chooses,
     * among methods that suit the force, the one that needs the fewest operations for the accuracy or the tolerance. It
     * counts them in pilot runs over the first part of the motion, and never looks at a clock, so it chooses alike on
     * every machine. `choice` of motus_run_statistics says why. */
    const char *method;
    /* Of a method with steps of one size: > 0; NaN: the model's, or motus_suggest's. Its direction follows from
     * `until`. Of an adaptive method, and with an accuracy: NaN. */
    double step;
    /* How far the answer may be from the exact motion: of every number, at the ends of its steps, relative to the
     * largest number so far of its kind (positions, velocities, first-order variables), or in their own units where
     * `absolute` is 1. 1e-15 <= accuracy < 1 where it is relative. NaN: the model's; where nobody gives an accuracy, a
     * tolerance or a step, and the method is "auto", 1e-9; else none is asked for. Between steps motus_run_sample adds
     * the error of interpolation, which is not bounded: motus_run_sample_errors tells it.
     *
     * The call that creates the run then finds the tolerance, or the step of a method with steps of one size, by trial
     * runs to the end with a companion each (motus_run_errors): until the bars keep to the accuracy. Where none does,
     * the run has the best that was found, and the call that takes it to its end returns MOTUS_ACCURACY. */
    double accuracy;
    /* Of an adaptive method: what one step may be off, by its own estimate; NaN: the model's, or 1e-9. Relative to the
     * size of the variable, which is the largest number of the family or vector at both ends of the step and on the way
     * between them; positions and velocities have sizes of their own. Of other methods: NaN. The error of the answer is
     * the sum of these errors, as the motion has carried them on. */
    double tolerance;
    double shortest_step, longest_step; /* of an adaptive method: the limits of its steps, 0: none */
    double until;        /* the end; NaN: the model's, or motus_suggest's. Before the start: the run goes backward */
    double start;        /* NaN: the model's */
    const double *x, *v; /* the initial state: nx and nv finite numbers, copied; NULL: the model's */
    /* NULL, or called from time to time, at most about every 10 ms, with the fraction of the run that is done, 0 … 1.
     * A value other than 0 cancels the call that steps: MOTUS_CANCELLED. The call that creates a run with an accuracy
     * counts its search by itself, from 0 to less than 1. */
    int (*progress)(void *context, double fraction);
    void *context; /* of `progress` and of `observer` */
    /* NULL, or called by motus_run_step, motus_run_finish and motus_run_sample after every step, the shorter last one
     * included; not at the start. It may observe the run (state, values, errors, jacobian, statistics, save), and must
     * not step, restore, set or destroy it. A value other than 0 stops the run after this step: MOTUS_CANCELLED. The
     * bits are the same; but a large system no longer takes several steps in one pass over memory. */
    int (*observer)(void *context, motus_run *);
    /* NULL or "interpreter"; "compiled": the equations and the method as machine code, which the C compiler of this
     * computer makes and the library keeps in $XDG_CACHE_HOME/motus; "auto": if the run is long enough to repay a
     * compiler, it begins in the interpreter while the compiler works, as a process of its own, and goes on compiled at
     * the end of a step. "compiled" waits for the compiler. The library starts no compiler for NULL, and none in a
     * process whose environment has MOTUS_COMPILER=none. A system from C calls its callback in any case. The bits are
     * the same. */
    const char *machine;
    /* The most threads that the compiled machine may use for one large system, 1 … MOTUS_THREADS_MAX; 0: one. A small
     * system uses one thread in any case. The bits are the same. */
    int threads;
    motus_switches switches;
    int absolute; /* 1: the tolerance, or the accuracy, is in the units of the numbers themselves; 0: relative */
    motus_bars error;
    /* Of an adaptive method: how many steps a leg may take (motus_run_steps), so that a run that needs more returns
     * MOTUS_STEPS after the last of them; 0: as many as it needs. Those that a restart state has taken count, so that
     * an interrupted run ends where a whole one does. Pilot and companion runs have no limit; a trial run for an
     * accuracy has this one, and where it does not come to its end it does not serve. */
    int64_t most_steps;
} motus_run_def;
MOTUS_DEFAULT_FUNCTION(run, RUN, motus_run_def)
#define MOTUS_THREADS_MAX 1024

/* Creates a run. The definition may be NULL: then everything is the model's. MOTUS_METHOD: there is no such method, it
 * does not admit the force or the start, or it cannot take the shorter last step. MOTUS_ARGUMENT: a callback has no
 * step or no end, a number is not finite or out of its range, or there is no such machine. MOTUS_LIMIT: more than 1e15
 * steps, more than 2^26 events by a clock, or implicit equations too large to solve. MOTUS_TOOL: "compiled" is asked
 * for and not available. MOTUS_CALLBACK: the callback `exact` returned other than 0, where the method is exact; or one
 * returned other than 0 in a pilot or trial run. With an accuracy or "auto" the call integrates, may fail as
 * motus_run_finish does, and calls `progress`; else it does not evaluate the acceleration of a callback. */
MOTUS_API motus_status motus_run_create(motus_system *, const motus_run_def *, motus_run **, motus_error *);
MOTUS_API void motus_run_destroy(motus_run *);
/* Tells what a run of this definition is asked for, without making it: every setting, and who says it. The definition
 * comes first, then the model, then a default; a step or an end that is still missing is that of motus_suggest, which
 * takes time. step: NaN where steps adapt or an accuracy decides them; tolerance: NaN where steps have one size or an
 * accuracy decides it. A callback may lack a step or an end. Fails as motus_run_create does where that does not
 * integrate; the settings are then what is asked for. */
MOTUS_API motus_status motus_run_settings(motus_system *, const motus_run_def *, motus_settings *, motus_error *);

/* Takes n >= 0 steps, or fewer if `until` comes first; the last step is shorter where it must end at `until`.
 * MOTUS_ACCURACY: the run is at its end, and its accuracy was not reached; err->message says what was. MOTUS_DIVERGED:
 * a number is no longer finite. MOTUS_SOLVE: an implicit equation could not be solved. MOTUS_STEPS: the run is not at
 * its end after `most_steps` steps, or its force jumps and its steps have shrunk so far that they will not lead there,
 * as with friction that sticks. MOTUS_CALLBACK: a callback returned other than 0. MOTUS_CANCELLED: `progress` or
 * `observer` returned other than 0. MOTUS_LIMIT: the table of events is full, at 2^26 rows. MOTUS_ARGUMENT: n < 0,
 * or an observer called it. After a failure the run stands at its last good step, cancelled among the events of a step
 * at the latest of them, and you may observe it, save it and step again. */
MOTUS_API motus_status motus_run_step(motus_run *, int64_t n, motus_error *);
/* Takes all steps up to `until`. Fails as motus_run_step does. */
MOTUS_API motus_status motus_run_finish(motus_run *, motus_error *);
MOTUS_API int motus_run_done(const motus_run *); /* 1: the run is at `until`, or an event has ended it */
MOTUS_API double motus_run_time(const motus_run *);
MOTUS_API int64_t motus_run_steps(const motus_run *); /* how many it has taken, in the present leg */
/* Returns the time after `step` steps of the leg, `until` from the last one on. NaN: steps adapt. */
MOTUS_API double motus_run_time_of(const motus_run *, int64_t step);

/* ---- the state ---- */

/* Writes the present state: nx numbers to x, nv to v, at the same time; either may be NULL. Observing changes neither
 * the run nor its counts. MOTUS_SOLVE, MOTUS_DIVERGED, MOTUS_CALLBACK: the method needs one more evaluation for the
 * state, and it failed. */
MOTUS_API motus_status motus_run_state(motus_run *, double *x, double *v, motus_error *);
/* Writes the values of `count` columns (numbers from motus_column_find) at the present state to out. MOTUS_ARGUMENT:
 * there is no such column. MOTUS_CALLBACK: the callback for quantities, invariants or the exact motion returned other
 * than 0. Fails besides as motus_run_state does. */
MOTUS_API motus_status motus_run_values(motus_run *, const size_t *columns, size_t count, double *out, motus_error *);
/* Writes the present value of the column with a name, "energy". In a loop find the columns once: motus_columns_named.
 * Fails as that and motus_run_values do. */
MOTUS_API motus_status motus_run_value(motus_run *, const char *name, double *out, motus_error *);
/* Tells why a quantity or invariant has no finite value at the present state. MOTUS_DIVERGED: err->message says it, "t
 * goes beyond 5, the last point of the table A", and err->hint what helps, where that is known. MOTUS_OK: the value is
 * finite, or the reason is not known. Fails besides as motus_run_values does. */
MOTUS_API motus_status motus_run_undefined(motus_run *, size_t column, motus_error *);
/* Writes columns at given times, which follow the direction of the run and end at or before `until`. It takes steps as
 * needed; between steps it evaluates the method's dense output, of the order motus_method.dense_order. That is a
 * polynomial of the stages (bs32, dopri5, tsit5, verner6 to verner9, dop853, dep6; gauss10 to gauss16, radau15), the
 * exact motion, or the polynomial through the ends of the step: Hermite's quintic (cubic of first-order variables),
 * which is of order 3, 4 without first-order variables, and for methods of higher order is corrected by accelerations
 * within the step. The accelerations that it needs are evaluated once for all times within a step: none for most
 * methods, at most 9 for the pairs, 18 for methods of order 8, 28 for dep12, 30 for gragg-stormer, 60 for gragg; no
 * count has them, and the run does not change. out: time_count rows of `count` numbers. MOTUS_ARGUMENT: a time lies
 * beyond the end, or before the run's last step. MOTUS_CALLBACK: an acceleration within the step cannot be evaluated.
 * Fails besides as motus_run_step and motus_run_values do. */
MOTUS_API motus_status motus_run_sample(motus_run *, const double *times, size_t time_count, const size_t *columns,
                                        size_t count, double *out, motus_error *);

/* Writes the Jacobian matrices at the present state. Row i belongs to the acceleration or rate of number i of nv; da_dx
 * has nv rows of nx derivatives with respect to the positions, da_dv nv rows of nv with respect to the velocities and
 * first-order variables; either may be NULL. Exact where the system has derivatives; otherwise difference quotients,
 * with half of the digits, or nearly all where the dependence is linear. MOTUS_LIMIT: nv is above MOTUS_JACOBIAN_MAX.
 * MOTUS_CALLBACK: a callback returned other than 0. Fails besides as motus_run_state does. */
#define MOTUS_JACOBIAN_MAX 256
MOTUS_API motus_status motus_run_jacobian(motus_run *, double *da_dx, double *da_dv, motus_error *);

/* ---- errors ---- */

/* Writes the values of `count` columns at the present state, as motus_run_values does (values may be NULL), and the bar
 * of each: |value - exact motion| is below it in about 99 of 100 numbers, and at least a tenth of it in more than 90. A
 * bar covers truncation, round-off, the rounding of decimals in a model's text, and what the motion makes of all that.
 * It does not cover numbers that are not well known, an equation that is not the true one, or numbers that were rounded
 * before they came here: those of a callback, of `x` and `v` in the definition, of motus_system_set.
 *
 * Every column has a bar by its own difference between the run and its companion. 0: the number is exactly 0, and the
 * companion's was too, at all times that were compared. INFINITY: no digit is known to be significant, since the two
 * have been further apart than a tenth of the motion's size, or a quarter where errors grow slowly
 * (motus_estimate.significant_until). NaN: there is no bar, as motus_estimate.reason says; the value is there.
 *
 * The companion goes on when the run does. It costs twice the run's evaluations, and one step more for every time at
 * which it is compared: about 256 times; of a run of less than 4096 steps every 16 steps, of less than 512 steps 32
 * times; and the times of these calls. The bars depend a little on these times. The second companion of MOTUS_BARS_FULL
 * costs as much as the run.
 *
 * MOTUS_ARGUMENT: the definition of the run asks for no bars, or there is no such column. Fails besides as
 * motus_run_values does, and with MOTUS_CANCELLED. What fails in a companion is no failure, but a reason. */
MOTUS_API motus_status motus_run_errors(motus_run *, const size_t *columns, size_t count, double *values,
                                        double *errors, motus_error *);
/* Writes columns at given times, as motus_run_sample does, with bars, which cover the error of the interpolation too.
 * Both tables have time_count rows of `count` numbers. Fails as motus_run_sample and motus_run_errors do. */
MOTUS_API motus_status motus_run_sample_errors(motus_run *, const double *times, size_t time_count,
                                               const size_t *columns, size_t count, double *values, double *errors,
                                               motus_error *);
/* What the bars of a run rest on. */
typedef struct motus_estimate {
    uint32_t size; /* by motus_default_estimate() */
    int kinked;    /* 1: steps lead across kinks of the force; bars are rough */
    /* The largest distance so far of the run from its companion, in units of the largest number of its kind: positions,
     * velocities, first-order variables; and by how much it has grown since the first 1/32 of the run. */
    double distance, growth;
    /* From this time on no digit is known to be significant, of any number, since all are judged together; NaN: up to
     * the present time digits are. */
    double significant_until;
    double rate;        /* the distance grows like e^(rate t); NaN: not as an exponential, or not known */
    double work;        /* evaluations by companions, in units of the run's; NaN: there are none yet */
    double seconds;     /* elapsed in companions, reading and compiling included */
    const char *reason; /* why there is no bar, one sentence; "": there is */
    /* The part of the steps that a witness examined, to see whether the force does more between the times at which the
     * method evaluates it than the step shows. 1: all steps, or the force can do nothing there. NaN: none was examined,
     * as with a callback. */
    double looked;
} motus_estimate;
MOTUS_DEFAULT_FUNCTION(estimate, ESTIMATE, motus_estimate)
/* Fills in what the bars at the present state rest on. Fails as motus_run_errors does. */
MOTUS_API motus_status motus_run_estimate(motus_run *, motus_estimate *, motus_error *);

/* ---- events ---- */

/* A row of the table of events, what a model's `when` statements, or the events of a callback, have found and done so
 * far: one for every event of a kind that records. Every root of every event function is found, in order; a root where
 * the run starts is no event. Time and state of an event are those of a step of the method that ends on it. A run with
 * more than 100 actions in one instant fails with MOTUS_EVENTS. */
typedef struct motus_event_row {
    uint32_t size;                 /* by motus_default_event_row() */
    int touched;                   /* 1: the function touched 0 and went back */
    const char *name;              /* "bounce"; owned by the system */
    int64_t count;                 /* events of this kind so far, this one included */
    double time, error;            /* error: how far the time may be off; NaN: not known */
    int64_t changed;               /* 1: an action changed the state */
    char instance[MOTUS_NAME_MAX]; /* with its indices, "contact[1,2]" */
} motus_event_row;
MOTUS_DEFAULT_FUNCTION(event_row, EVENT_ROW, motus_event_row)
MOTUS_API int64_t motus_run_events(const motus_run *); /* how many rows the table has */
/* Fills in row k, from 0. MOTUS_ARGUMENT: there is none. */
MOTUS_API motus_status motus_run_event(motus_run *, int64_t k, motus_event_row *);
/* Writes the values of `count` columns at row k: on arrival, or with `after` = 1 as the action left them.
 * MOTUS_ARGUMENT: there is no such row or column. Fails besides as motus_run_values does. */
MOTUS_API motus_status motus_run_event_values(motus_run *, int64_t k, int after, const size_t *columns, size_t count,
                                              double *out, motus_error *);
/* Writes these values, and how far each may be from that at the event of the exact motion, which is at another time.
 * NaN: not known. INFINITY: no digit is significant. Fails besides as motus_run_errors does. */
MOTUS_API motus_status motus_run_event_errors(motus_run *, int64_t k, int after, const size_t *columns, size_t count,
                                              double *values, double *errors, motus_error *);
/* Returns how many rows have a significant digit. In the next one, run and companion have different events, or times
 * that are farther apart than a quarter of the time from the event before. A run without bars returns all rows. */
MOTUS_API int64_t motus_run_events_significant(motus_run *);
/* Keeps from now on, with keep = 1, what every action of an event changes, also of events without a row; with 0 it
 * keeps nothing. Each call forgets the actions that were kept before. */
MOTUS_API void motus_run_keep_jumps(motus_run *, int keep);
MOTUS_API int64_t motus_run_jumps(const motus_run *); /* how many actions are kept */
/* Writes the time of action k, from 0, and values of columns before it or, with `after` = 1, as it left them. *moves
 * (may be NULL): 1: the motion or an event depends on what it changed, so that it ended a step. MOTUS_ARGUMENT: there
 * is no such action or column. Fails besides as motus_run_values does. */
MOTUS_API motus_status motus_run_jump(motus_run *, int64_t k, int after, const size_t *columns, size_t count,
                                      double *time, int *moves, double *out, motus_error *);
/* Returns the name of the kind of event that ended the run before `until`; "" where none did. *accumulated (may be
 * NULL): 1 where events accumulate; then *time is the limit of their times, which is known to *error. *error is NaN
 * where no companion has told it, and INFINITY where no digit is significant; of a run without bars it says how far
 * rounding lets the limit of its own events be known. */
MOTUS_API const char *motus_run_ended(motus_run *, int *accumulated, double *time, double *error);
/* Returns the name of the kind whose events accumulate, whether or not that ended the run; "": none do. */
MOTUS_API const char *motus_run_accumulates(const motus_run *);

/* ---- statistics ---- */

/* What a run is, and all that it has done so far. */
typedef struct motus_run_statistics {
    uint32_t size; /* by motus_default_run_statistics() */
    int legs;      /* 1, and one more for every motus_run_set_state */
    const char *method;
    const char *machine; /* "interpreter", "compiled", "callback" */
    const char *choice;  /* why the method was chosen, one sentence, where it was "auto"; else "" */
    const char *note;    /* why "auto" uses the interpreter although the run is long enough to compile, or "" */
    /* Why steps that adapt do not end at the switches of the force (motus_switches); "": they do, there are none, or
     * they are not to. */
    const char *not_located;
    /* Where an event that assigns breaks a step of the method, one sentence: a step of a symplectic method that ends
     * where the state decides is not symplectic, and a run by reversible steps that adapt is not reversible across
     * such an event. "": no event does. */
    const char *cut;
    double step;                  /* of a method with steps of one size, > 0; NaN: steps adapt */
    double shorter_last;          /* the size of the shorter last step of the present leg; 0: there is none */
    int64_t steps_total;          /* of the present leg up to `until`, the shorter last one included; 0: steps adapt */
    int64_t steps;                /* taken in all legs, shorter last ones included */
    int64_t refused;              /* steps that error control refused; 0: steps have one size */
    int64_t evaluations;          /* of the acceleration by taken and refused steps; observing counts none */
    int64_t iterations;           /* in which implicit equations are solved, by both */
    double first_step, last_step; /* sizes of the first and of the latest step taken, > 0; NaN before the first */
    double tolerance;             /* of an adaptive method; NaN: steps have one size */
    /* The accuracy that was asked for, NaN: none; and what the trial run with the run's tolerance or step reached, in
     * the unit of the accuracy: the largest bar of its numbers. Where that trial was far off and not taken to its end,
     * `reached` is the largest bar of the run at its end, and INFINITY before. */
    double accuracy, reached;
    /* The smallest and the largest step of the present leg, without the one that ended at `until`; NaN before them. */
    double shortest_step, longest_step;
    int64_t switches; /* how many the run has passed; -1: it cannot locate them, or was not asked to */
    /* Of a run that resolves switches: the lowest derivative of the acceleration along the motion that jumped at one of
     * them, or became infinite; 0: the acceleration itself; -1: none. */
    int64_t jump;
    double jump_time; /* of the first such jump; NaN: there was none */
    /* By how much velocities may be off because times are rounded: the sum of the jumps, and of fast changes that were
     * resolved, times the rounding of their times. */
    double jump_rounding;
    /* The power of the time with which the acceleration departs there from a smooth one: the number of the derivative
     * that jumps, or less where one is infinite, as 1/3 of cbrt; NaN: there was none. */
    double jump_power;
    int absolute;          /* 1: the tolerance and the accuracy are absolute */
    int trials;            /* runs to the end that found the tolerance or the step for the accuracy */
    int64_t compiled_from; /* steps that the interpreter took before the run went on compiled; 0: none; -1: all */
    /* Steps in which an event may have been missed that is shorter than what the points of dense output tell: no bound
     * could exclude it there, as of functions that a callback computes. */
    int64_t events_unseen;
    double events_unseen_from;    /* when the first of these steps began; NaN: there is none */
    const char *events_unseen_of; /* the kind of event that may have been missed there; "" */
    /* Kinds of events that have not happened because their condition has held from the start on; and the first one. */
    int64_t events_held;
    const char *events_held_of; /* "" */
} motus_run_statistics;
MOTUS_DEFAULT_FUNCTION(run_statistics, RUN_STATISTICS, motus_run_statistics)
/* Fills them in. MOTUS_ARGUMENT: the run is NULL, or the struct has no valid size. */
MOTUS_API motus_status motus_run_statistics_of(const motus_run *, motus_run_statistics *);
/* Returns them, to ask for one: motus_run_now(run).evaluations. Of NULL they are the defaults. */
static inline motus_run_statistics motus_run_now(const motus_run *run)
{
    motus_run_statistics now = motus_default_run_statistics();
    motus_run_statistics_of(run, &now);
    return now;
}

/* ---- restart states and legs ---- */

/* Save and restore an exact restart state: a text of `length` bytes with hexadecimal numbers, which the run owns until
 * it is saved again. Create a run from the same system (the same numbers set in the same way) with the same method,
 * step and start, and restore it from the text: it continues to the bits of a run that was never interrupted, up to an
 * `until` of its own. An adaptive method sizes the last steps before `until` to land there, so a run that was saved at
 * an earlier end continues from that end by other steps than one run to the later end. The text contains the table of
 * events so far, and with fixed steps at the end of the run the state before the last step. Where both runs have bars
 * of error, the text contains the errors so far, for which the companion is compared once more, and the bars of the
 * second run cover the errors from the very start; a second companion (MOTUS_BARS_FULL) goes on where steps adapt, or
 * the run has not ended in a shorter step. Saving fails as motus_run_errors does. MOTUS_UNAVAILABLE: the run was
 * cancelled within a step of fixed size, among its events; one step more leads to its end. MOTUS_STATE: the text is
 * damaged, belongs to another system, method, step or start, or is beyond the end. MOTUS_ARGUMENT: an observer called
 * motus_run_restore. After a failure the run is unchanged. */
MOTUS_API motus_status motus_run_save(motus_run *, const char **text, size_t *length, motus_error *);
MOTUS_API motus_status motus_run_restore(motus_run *, const char *text, size_t length, motus_error *);

/* Begins a new leg at another state: the run continues like a run created at time t (NaN: the present time) with x, nx
 * finite numbers, and v, nv finite numbers (copied; NULL: as they are now). It keeps its method, step, end and machine.
 * motus_run_steps counts in this leg; its times are t + n step, in the direction of `until` from t. A restart state
 * saved from now on belongs to a run that starts at t. After a failure the run is unchanged. MOTUS_ARGUMENT: a number
 * is not finite, a step is too small to change t, or an observer called it. MOTUS_METHOD: the last step would be
 * shorter, and the method takes equal steps only; or the method does not admit the start. MOTUS_LIMIT: too many steps.
 * Fails besides as motus_run_state does, since the call reads the present state. */
MOTUS_API motus_status motus_run_set_state(motus_run *, double t, const double *x, const double *v, motus_error *);

/* ---- singularities, and the trace of a step ---- */

/* Finds out whether a run of this definition passes a singularity of the force that its step does not resolve: the
 * state after it is finite, but not the motion. MOTUS_SINGULAR: it does, in a step that begins at err->time.
 * MOTUS_UNRESOLVED: a step comes near to one, or to a narrow peak of the force, and leads elsewhere than smaller ones.
 * MOTUS_OK: neither was found; also for a callback, whose poles are not known. The call takes the run's steps by the
 * interpreter, so that runs themselves cost no more. It ends after MOTUS_SINGULAR_WORK operations, which count all
 * cells and all terms of sums, and where a step fails. It calls no hook of the definition. Fails besides as
 * motus_run_create does. */
#define MOTUS_SINGULAR_WORK 2e7
MOTUS_API motus_status motus_run_singular(motus_system *, const motus_run_def *, motus_error *);

/* An entry of the trace of one step: the kicks, drifts and stages of the method in their order, for figures and to see
 * where its error comes from. The step has the bits of motus_run_step(r, 1), and is written as the method's formula,
 * from a state (x, v) to a state (x, v). */
typedef enum motus_trace_kind {
    /* The state at `time`, and the acceleration there. */
    MOTUS_TRACE_START,
    /* v += coefficient step a, a = a(x, time): splitting. Where the force depends on the velocity: a at the mean of the
     * velocities before and after; the rates of first-order variables that only follow the motion, from there or a mean
     * of two. */
    MOTUS_TRACE_KICK,
    /* x += coefficient step v; `time` is the time after it. */
    MOTUS_TRACE_DRIFT,
    /* a = a(x, v, time) at the stage's own x and v, coefficient steps after the start. Runge-Kutta and implicit:
     *     v = v₀ + step Σ row[j] a[j],  x = x₀ + step Σ row[j] v[j] = x₀ + coefficient step v₀ + step² Σ row_x[j] a[j];
     *     the end:   v₀ + step Σ weight a,   x₀ + step Σ weight v = x₀ + step v₀ + step² Σ weight_x a
     * (newmark has the forms with row_x and weight_x only). */
    MOTUS_TRACE_STAGE,
    /* The following stages solve an implicit equation, in `iterations`: Newton's, or insertions. */
    MOTUS_TRACE_SOLVE,
    /* The first step of a recurrence, from Taylor's formula: x = x₀ + step v₀ + step²/2 a, with the a of START. */
    MOTUS_TRACE_TAYLOR,
    /* A step of a recurrence, with the a of START: x = 2 x₀ - before_x + step² a. Of beeman: x = x₀ + step v₀ + step²/6
     * (4 a - before_a), v = v₀ + step/6 (2 a₁ + 5 a - before_a) with the a₁ of END, and before_a = a in the first
     * step. */
    MOTUS_TRACE_STEP,
    /* The state after the step, that of motus_run_state, and the acceleration there. */
    MOTUS_TRACE_END,
    /* Of an adaptive method, after START: a step of another size that was tried and refused, by its `error`; x and v:
     * where it would have led. Of more than MOTUS_REFUSED_MAX the first ones and the last. */
    MOTUS_TRACE_REFUSED
} motus_trace_kind;
#define MOTUS_REFUSED_MAX 8
typedef struct motus_trace_entry {
    motus_trace_kind kind;
    int stage, stages;         /* the stage, from 1, and how many there are; START, SOLVE, END: stage 0 */
    int64_t iterations;        /* of the implicit equation, in this step so far */
    double time, step;         /* step: negative in a run that goes backward; the last one may be shorter */
    double coefficient;        /* of a kick or a drift, in units of the step; of a stage its abscissa */
    double weight, weight_x;   /* of a stage */
    const double *row, *row_x; /* of a stage: `stages` numbers each; else NULL */
    /* nx and nv numbers after the entry, as in motus_run_state; of a stage those of the stage. TAYLOR and STEP of
     * verlet and verlet-literal: v is (x - x₀)/step, which lacks half a kick by the acceleration at the end. */
    const double *x, *v;
    const double *a; /* nv numbers. NULL: the entry has none, or at START and END it cannot be evaluated */
    const double *before_x, *before_a; /* of a recurrence: x and a one step before START; else NULL */
    /* Of REFUSED, and of END where steps adapt: the estimated error of the step in units of what the tolerance allows,
     * at most 1 where the step is accepted; infinite or NaN: it has no finite result. Else NaN. */
    double error;
} motus_trace_entry;
/* Takes one step and sets *entries to *count pointers, which the run owns until it is traced again or destroyed. At the
 * end of the run there is no step to take, and *count is 0. It does not call `progress` or `observer`.
 * MOTUS_UNAVAILABLE: the system has events. Fails besides as motus_run_step and motus_run_state do. */
MOTUS_API motus_status motus_run_trace(motus_run *, const motus_trace_entry *const **entries, size_t *count,
                                       motus_error *);

/* ---- the compiled machine ---- */

/* Returns the C text that the compiled machine compiles for a run of this definition (NULL: everything is the model's),
 * of which it reads the method and the tolerance, from which the order of Taylor series follows. Owned by the system.
 * NULL: an error. MOTUS_ARGUMENT: the system is from a callback, or the method does not take this step or tolerance.
 * MOTUS_METHOD: there is no such method, or it does not admit the model. MOTUS_MEMORY. */
MOTUS_API const char *motus_run_text(motus_system *, const motus_run_def *, motus_error *);
/* Returns motus_run_text of a definition with this method alone (NULL: the model's). */
MOTUS_API const char *motus_compiled_text(motus_system *, const char *method, motus_error *);
/* Removes the compiled objects that the library keeps on disk. Returns how many, or -1: it cannot read the folder. */
MOTUS_API int motus_cache_clear(void);

/* 6. Ensembles --------------------------------------------------------------------------------------------------- */

/* Many trajectories of one model by one method, all from the start to the same end, which differ in some parameters or
 * initial values. The ensemble records numbers along each trajectory and does not keep the trajectories. Each has the
 * bits of a run of the model with these values (`set` in motus_text_def), whatever the machine and the number of lanes
 * and threads. */
typedef struct motus_ensemble motus_ensemble;

typedef enum motus_reduction {
    /* The value at the end. */
    MOTUS_REDUCE_FINAL,
    /* Over the observations: at the start, every `every` steps, and at the end. */
    MOTUS_REDUCE_MIN,
    MOTUS_REDUCE_MAX,
    MOTUS_REDUCE_MEAN,
    /* The time of the first observation with the minimum, or the maximum. */
    MOTUS_REDUCE_TIME_OF_MIN,
    MOTUS_REDUCE_TIME_OF_MAX,
    /* Of the trajectory itself, as in motus_run_statistics; the column is 0: steps taken and refused, the shortest and
     * the longest step, evaluations of the acceleration. */
    MOTUS_REDUCE_STEPS,
    MOTUS_REDUCE_REFUSED,
    MOTUS_REDUCE_SHORTEST_STEP,
    MOTUS_REDUCE_LONGEST_STEP,
    MOTUS_REDUCE_EVALUATIONS,
    /* A bound on the bars that any number of the state had along the trajectory, which is what `accuracy` of
     * motus_run_def bounds: relative to the motion's size, or absolute where the tolerance is. INFINITY: of some no
     * digit was significant. NaN: there are no bars, or motus_ensemble_run tells none. */
    MOTUS_REDUCE_ACCURACY,
    MOTUS_REDUCE_TOLERANCE /* as in motus_run_statistics; with an accuracy every trajectory has its own */
} motus_reduction;
/* A number that is recorded of every trajectory. */
typedef struct motus_record {
    motus_reduction how;
    size_t column; /* from motus_column_find or motus_column_of */
} motus_record;

typedef struct motus_ensemble_def {
    uint32_t size; /* by motus_default_ensemble() */
    /* The numbers that differ: a parameter "F", a component of one "g.x", an initial value "x(0)", "x'(0)", "r.x(0)",
     * "x[3](0)", or the end, "until", where the definition has none. Values that depend on them are computed for each
     * trajectory. A number that decides a size, the step or the end cannot differ. */
    const char *const *vary;
    size_t vary_count;
    const motus_record *records; /* at least one */
    size_t record_count;
    const char *method; /* NULL: the model's, or "verlet", with an accuracy "dop853" */
    double step, until; /* NaN: the model's, or motus_suggest's, the same for all trajectories */
    /* As in motus_run_def, of every trajectory; NaN: the model's, or none. The method is an adaptive one. Every
     * trajectory then has a tolerance of its own (MOTUS_REDUCE_TOLERANCE): the first is the same for all, and those
     * whose bars do not keep to the accuracy are computed again with smaller ones, as they would be alone. What
     * the model says of its own method is left aside, unless it sets an accuracy too. */
    double accuracy;
    double tolerance, shortest_step, longest_step; /* as in motus_run_def; every trajectory has its own steps */
    int64_t every; /* steps between two observations, for all records but MOTUS_REDUCE_FINAL; 1 by default */
    /* As in motus_run_def. With "auto" the interpreter computes trajectories while the compiler works, and the compiled
     * machine all that follow. With `fast` the ensemble waits for the compiler, because the bits depend on it. */
    const char *machine;
    /* How many threads; 0: as many as there are processors, and one for a system from C. With more threads its
     * callbacks must be safe to call from several threads at once. A system with an allocator of its own uses one
     * thread where it does not run in lanes, so that one thread alone calls the allocator. */
    int threads;
    int lanes; /* trajectories that one thread advances at once, in the lanes of a vector: 1, 2, 4, …; 0: the fastest */
    int fast; /* 1: the compiler may fuse and reorder; last bits may differ between machines */
    int (*progress)(void *context, double fraction); /* of one motus_ensemble_run; as in motus_run_def */
    void *context;
    uint64_t expected;  /* how many trajectories will follow in all: "auto" does not compile for few; 0: many */
    int absolute;       /* as in motus_run_def */
    motus_bars error;   /* of motus_ensemble_run_errors */
    int64_t most_steps; /* as in motus_run_def, of each trajectory; one that needs more stops there */
    /* 1: the tables of events are kept, with the values of these columns: motus_ensemble_event */
    int64_t events;
    const size_t *event_columns;
    size_t event_column_count;
    /* As in motus_run_def; lanes compute trajectories that lead across switches, while those whose switches are located
     * are computed one at a time. */
    motus_switches switches;
    /* 1: motus_ensemble_stopped_by tells why trajectories stop. Each that does costs a run of its own, with samples and
     * trial steps, which takes some milliseconds. */
    int causes;
} motus_ensemble_def;
MOTUS_DEFAULT_FUNCTION(ensemble, ENSEMBLE, motus_ensemble_def)

/* Creates an ensemble. MOTUS_NAME: a name in `vary` is neither a parameter nor an initial value. MOTUS_SHAPE: it stands
 * for several numbers. MOTUS_ARGUMENT: it decides what must be equal for all trajectories, or a member of the
 * definition is out of its range. MOTUS_UNAVAILABLE: switches are to be resolved. MOTUS_METHOD, MOTUS_LIMIT,
 * MOTUS_TOOL: as from motus_run_create. */
MOTUS_API motus_status motus_ensemble_create(motus_system *, const motus_ensemble_def *, motus_ensemble **,
                                             motus_error *);
MOTUS_API void motus_ensemble_destroy(motus_ensemble *);
/* Tells what an ensemble of this definition is asked for, as motus_run_settings does; `records` may be empty. A step
 * that is suggested is the shortest that one of `trajectories` trajectories needs, those at the ends of what varies,
 * say, with values as in motus_ensemble_run; 0 trajectories: that of the system as it is. Trajectories that have no
 * step, since they stop at once, do not count. Where the ends vary they are not read, and the model's is left aside.
 * MOTUS_NAME: as motus_ensemble_create. */
MOTUS_API motus_status motus_ensemble_settings(motus_system *, const motus_ensemble_def *, size_t trajectories,
                                               const double *const *values, motus_settings *, motus_error *);
/* Returns whether motus_ensemble_run would take these values: MOTUS_OK, or what that returns before it computes. */
MOTUS_API motus_status motus_ensemble_check(motus_ensemble *, size_t count, const double *const *values, motus_error *);
/* Decides, where errors are told, whether the force does more within the steps of the trajectories than steps show: it
 * leads these `count` trajectories, those at the ends of what varies, say, with a witness, mostly in some milliseconds.
 * Where the witness objects, all trajectories are computed one at a time, with a witness each: slower, and their errors
 * hold. Without this call the first call of motus_ensemble_run_errors decides, by its first, middle and last
 * trajectories. If you compute one ensemble in several pieces, call it first, with equal values for each piece.
 * MOTUS_ARGUMENT, MOTUS_CANCELLED, MOTUS_MEMORY: as from motus_ensemble_run. */
MOTUS_API motus_status motus_ensemble_pilots(motus_ensemble *, size_t count, const double *const *values,
                                             motus_error *);

/* Computes `count` trajectories. values[k]: `count` values of vary[k]; NULL only where vary_count is 0. results[k]:
 * room for `count` numbers of records[k]. stopped: NULL, or room for `count` numbers: NaN, or the time at which a
 * trajectory left the finite numbers, could not solve its implicit equation, got a value above 0 from its callback, had
 * taken `most_steps` steps, had events without end, or crawled, as a run with its values does; its results are then
 * NaN, and the other trajectories go on. MOTUS_CALLBACK: a callback returned a value below 0. MOTUS_CANCELLED:
 * `progress` returned other than 0. MOTUS_METHOD: with the values of a trajectory the method does not admit the model,
 * or does not reach the end in equal steps. MOTUS_ARGUMENT, MOTUS_LIMIT: an end is not finite, or too many steps away.
 * MOTUS_ACCURACY: all are computed, and some do not reach the accuracy; their results are the best that was found,
 * MOTUS_REDUCE_ACCURACY tells which and how far off they are, and err->message names the first. A trajectory that stops
 * with the first tolerance has nothing to reach. */
MOTUS_API motus_status motus_ensemble_run(motus_ensemble *, size_t count, const double *const *values,
                                          double *const *results, double *stopped, motus_error *);
/* Computes as motus_ensemble_run does, with errors: errors[k], room for `count` numbers, gets the bars of results[k],
 * as motus_run_errors tells them of a run; NaN where a trajectory stopped. Every trajectory has a companion of its own,
 * and its bars are those of a run with its values (given by motus_system_set) that is asked at its end and at the
 * observations. The bar of a minimum, a maximum or a mean is that of the exact motion's over the same times, and
 * follows from its own difference between trajectory and companion; where such a record is, the companion is compared
 * at every observation: with one after every step it takes three times the evaluations of the trajectory instead of
 * twice. Numbers of steps have the bar 0. The results are those of motus_ensemble_run, unless a witness objects
 * (motus_ensemble_pilots). MOTUS_ARGUMENT: the definition asks for no errors. */
MOTUS_API motus_status motus_ensemble_run_errors(motus_ensemble *, size_t count, const double *const *values,
                                                 double *const *results, double *const *errors, double *stopped,
                                                 motus_error *);
/* Returns why a trajectory, from 0, of the last motus_ensemble_run stopped before its end, where the definition asks
 * for `causes`: the `cause` of a run with its values. MOTUS_CAUSE_NONE: it did not stop, or the cause is not known. */
MOTUS_API motus_cause motus_ensemble_stopped_by(const motus_ensemble *, size_t trajectory);
/* Returns the name of the kind of event that ended a trajectory of the last motus_ensemble_run before its end, or whose
 * events accumulate, as motus_run_ended tells it of a run with its values. "": no event did, the trajectory stopped, or
 * there is no such trajectory. */
MOTUS_API const char *motus_ensemble_ended(const motus_ensemble *, size_t trajectory);
/* Returns the name of kind k, from 0, of the system's events, in their order. NULL: k is past the last. */
MOTUS_API const char *motus_ensemble_kind(const motus_ensemble *, size_t k);
/* Returns how many rows the table of events of a trajectory has, of the last motus_ensemble_run that ended well, where
 * the definition asks for `events`: those up to its end, or up to the time where it stopped. */
MOTUS_API int64_t motus_ensemble_events(const motus_ensemble *, size_t trajectory);
/* Fills in row k of that table, which is that of a run with the values of the trajectory; `error` is known where
 * motus_ensemble_run_errors was called. `values` and `after` (each may be NULL) get those of `event_columns` on
 * arrival, and as the action left them. MOTUS_ARGUMENT: there is no such row. */
MOTUS_API motus_status motus_ensemble_event(const motus_ensemble *, size_t trajectory, int64_t k, motus_event_row *,
                                            double *values, double *after);

/* What an ensemble is, and what its trajectories so far have taken. Machine, lanes and threads are those of the next
 * trajectories. `note` lives until the ensemble's next call. */
typedef struct motus_ensemble_statistics {
    uint32_t size; /* by motus_default_ensemble_statistics() */
    int absolute;  /* 1: tolerance and accuracy are absolute */
    const char *method;
    const char *machine;
    const char *note;        /* why it uses no faster machine, or "" */
    const char *not_located; /* why steps lead across switches where the definition leaves it to the library, or "" */
    int64_t steps;           /* of each trajectory; 0 where they differ */
    double tolerance;        /* of an adaptive method, with an accuracy the first one; NaN: steps have one size */
    double accuracy;         /* what every trajectory is to keep to; NaN: none is asked for */
    /* How many trajectories of all calls of motus_ensemble_run so far the interpreter computed before the ensemble
     * went on compiled; 0: none; -1: all of them. */
    int64_t compiled_from;
    double seconds; /* elapsed in the integration by all these calls, without reading models and compiling */
    int lanes, threads;
    /* LOCATE: steps end where a switch of the force changes its side. STEP: they lead across. USUAL: the force has no
     * switches, or none that the library can see, since it comes from C. */
    motus_switches switches;
    int unused;
} motus_ensemble_statistics;
MOTUS_DEFAULT_FUNCTION(ensemble_statistics, ENSEMBLE_STATISTICS, motus_ensemble_statistics)
/* Fills them in. MOTUS_ARGUMENT: the ensemble is NULL, or the struct has no valid size. */
MOTUS_API motus_status motus_ensemble_statistics_of(const motus_ensemble *, motus_ensemble_statistics *);
/* Returns them, to ask for one: motus_ensemble_now(ensemble).lanes. Of NULL they are the defaults. */
static inline motus_ensemble_statistics motus_ensemble_now(const motus_ensemble *ensemble)
{
    motus_ensemble_statistics now = motus_default_ensemble_statistics();
    motus_ensemble_statistics_of(ensemble, &now);
    return now;
}

/* Counts the operations of a step, of the equations and of the method, in units of a multiplication: they are not
 * timed, and so equal on every machine. NaN: there is no memory to count them. */
MOTUS_API double motus_ensemble_step_work(motus_ensemble *);
/* Finds by how many powers of ten an error grows up to the end because steps are too long, where the motion of one of
 * the trajectories swings or decays: from the spectral radius of the steps (motus_stability) at the rates along it. The
 * settings give method, step and end. More than 1: such a run is not the motion. 0: not known, or steps adapt. */
MOTUS_API motus_status motus_step_growth(motus_system *, size_t count, const char *const *names, size_t trajectories,
                                         const double *const *values, const motus_settings *, double *powers,
                                         motus_error *);

/* 7. Studies ----------------------------------------------------------------------------------------------------- */

/* What a study compares, for all calls below; each says which members it reads. */
typedef struct motus_study_def {
    uint32_t size;              /* by motus_default_study() */
    const char *const *methods; /* method_count names; NULL: every admitted method */
    size_t method_count;
    double step, until;  /* NaN: the model's, or motus_suggest's */
    int64_t evaluations; /* compare: > 0: each method's step is chosen so that it takes this many evaluations */
    int (*progress)(void *context, double fraction); /* as in motus_run_def, of the whole study */
    void *context;
    /* motus_reference_create: >= 0: an error that need not be improved, in units of how far the variable moves. The
     * reference is found sooner, and motus_reference_error tells its error in any case. 0: as small as possible. */
    double tolerance;
    /* motus_rank: the accuracies from `coarsest` to `finest` in steps of a factor ten, and `finest`; in any order. */
    double coarsest, finest;
    const char *machine; /* of all runs, as in motus_run_def; motus_rank: of those that are timed */
    int absolute;        /* 1: these accuracies are in the units of the numbers themselves; 0: relative */
    int repeats;         /* motus_rank: how often each run is timed, at least; 0: three times */
} motus_study_def;
MOTUS_DEFAULT_FUNCTION(study, STUDY, motus_study_def)

typedef struct motus_drift { /* the error of one invariant along a run (of its numbers the largest) */
    const char *name;
    double initial, final, max_drift;
    double trend; /* slope of the straight line fitted to the error, times the length of the run */
    int trending; /* 1: the trend is above 4 of its standard errors, and above round-off */
} motus_drift;

typedef struct motus_compare_row {
    const char *method;
    int order;
    motus_status status; /* other than OK: the run failed, as `note` says */
    double step;
    int64_t steps, evaluations;
    double seconds;
    /* the largest error of positions and of velocities, along the run and at its end; NaN: there are none, or
     * unknown */
    double error_max_x, error_max_v, error_final_x, error_final_v;
    size_t invariant_count;
    const motus_drift *const *invariants; /* invariant_count, in the order of motus_invariant_name */
    double reversal;                      /* distance from the start after a run to the end and back */
    const char *note;
    double error_max_s, error_final_s; /* of first-order variables; NaN: there are none, or not known */
} motus_compare_row;

typedef struct motus_comparison {
    size_t row_count;
    const motus_compare_row *const *rows; /* row_count, in the order of the methods */
    const char *reference;                /* "exact", or "gauss6 at step 0.00125" */
    double reference_error;               /* estimated error of the reference itself; 0 for exact */
    const char *remarks;                  /* explanations of the numbers, one sentence a line, or "" */
} motus_comparison;
/* Integrates the model by each method and compares the results. The definition may be NULL: then everything is the
 * model's; the same holds for motus_converge and motus_reference_create. The row of a method that fails says so.
 * MOTUS_ARGUMENT: a callback has no end or no step, or a number is out of its range. MOTUS_METHOD: there is no such
 * method, or none admits the model. MOTUS_LIMIT: too many steps. MOTUS_CANCELLED: `progress` returned other than 0.
 * MOTUS_CALLBACK: a callback returned other than 0 at the initial state, or reads the velocity undeclared. */
MOTUS_API motus_status motus_compare(motus_system *, const motus_study_def *, motus_comparison **, motus_error *);
MOTUS_API void motus_comparison_destroy(motus_comparison *);

typedef struct motus_rank_point {
    double accuracy; /* that was asked for */
    double setting;  /* the tolerance of an adaptive method, else the step, that the method needs for it */
    double error;    /* with it; NaN: the accuracy was not reached, as the row's `note` says */
    int64_t steps, evaluations;
    double seconds; /* of the run, its creation left out; the smallest of several */
} motus_rank_point;
typedef struct motus_rank_row {
    const char *method;
    int order, adaptive;
    /* ACCURACY: no accuracy was reached; else of a method that does not admit the model, or that fails */
    motus_status status;
    const motus_rank_point *const *points; /* one for each accuracy */
    const char *note;                      /* why an accuracy was not reached, or "" */
} motus_rank_row;
typedef struct motus_ranking {
    /* Those that were asked for, from coarse to fine. Errors are judged for the first `judged` of them: the error of
     * the reference is above a tenth of the others. */
    size_t accuracy_count, judged;
    const double *accuracies;
    int absolute;
    size_t row_count;
    const motus_rank_row *const *rows; /* row_count, in the order of the methods */
    /* For each accuracy: the row with the fewest evaluations, and that with the least time; row_count: no method
     * reached it. */
    const size_t *fewest, *fastest;
    const char *reference;  /* "exact", or "dep12 with tolerance 1e-15, judged by radau15" */
    double reference_error; /* in the unit of the accuracies */
    const char *machine;    /* on which runs were timed */
    const char *remarks;    /* explanations of the numbers, one sentence a line, or "" */
} motus_ranking;
/* Ranks methods by work against precision: what each, adaptive ones included, needs for each accuracy of the
 * definition. The error of a run is what `accuracy` of motus_run_def bounds: of every number, relative to the largest
 * number so far of its kind or absolute; measured against a reference at the ends of up to 32 steps spread over the
 * run, with the error of the reference added. Tolerances and steps are searched until an error is at most the accuracy,
 * and near it. Evaluations are equal on every machine; those of a Taylor series are coefficients.
 *
 * Fails as motus_compare does. MOTUS_ARGUMENT: an accuracy is not positive, or beyond the limits of motus_run_def, or
 * the definition has a step or evaluations. MOTUS_DIVERGED: there is no reference solution. MOTUS_ACCURACY: the
 * reference is too inaccurate for all accuracies. MOTUS_TOOL: as from motus_run_create. */
MOTUS_API motus_status motus_rank(motus_system *, const motus_study_def *, motus_ranking **, motus_error *);
MOTUS_API void motus_ranking_destroy(motus_ranking *);

typedef struct motus_point {
    double step, error;  /* of an adaptive method: the mean step */
    int used;            /* 1: the fit uses the point */
    int64_t evaluations; /* of the acceleration up to the end, or up to a failure */
    /* Of an adaptive method: the tolerance, and the largest error between the ends of steps; NaN besides. */
    double tolerance, error_between;
} motus_point;
typedef struct motus_converge_row {
    const char *method;
    int declared;
    double observed, standard_error; /* of the slope; NaN: it cannot be fitted */
    int exact_here;                  /* 1: the method is exact on this model, errors are round-off at every step */
    /* 1: the observed order is not below the declared one, or exact_here; of an adaptive method the other two orders
     * are not below theirs either */
    int passed;
    motus_status status; /* MOTUS_ORDER: the observed order is below the declared one; else of the run that failed */
    size_t point_count;
    const motus_point *const *points; /* point_count, from the largest step to the smallest */
    const char *certificate;          /* "observed 2.00, declared 2" */
    /* Of an adaptive method. The error falls with the power `power` of the tolerance (due: at least power_due), and
     * between the ends of steps with the order `between` of the mean step (due: between_due, the smaller of the order
     * and dense_order + 1); both with the standard errors of the fits, NaN where there is none. */
    int adaptive, between_due;
    double power, power_error, power_due, between, between_error;
    /* 1: too few errors lie between the coarsest steps and round-off for the order, or for one of the three statements
     * of an adaptive method, or they are no power, or the force is not smooth and leaves only a lower order, which they
     * keep: so the row has neither passed nor failed. */
    int uncertain;
} motus_converge_row;
typedef struct motus_convergence {
    size_t row_count;
    const motus_converge_row *const *rows; /* row_count, in the order of the methods */
    const char *reference;
    double reference_error;
    int passed; /* 1: every row passed, those that are uncertain left out */
} motus_convergence;
/* Fits the observed order of each method to its errors at several steps. Fails as motus_compare does; and with
 * MOTUS_DIVERGED: no method of high order reached the end, so that there is no reference solution. */
MOTUS_API motus_status motus_converge(motus_system *, const motus_study_def *, motus_convergence **, motus_error *);
MOTUS_API void motus_convergence_destroy(motus_convergence *);

/* A reference solution, from which motus_compare and motus_converge take errors, at any times: to draw the error of
 * several methods. The call reads `until`, `step`, `tolerance`, `progress` and `context` of the definition. With a
 * `step` and no tolerance it is the reference of a motus_compare at this step; NaN: the model's step, or without one
 * the call chooses. It calls `progress` only until it returns. Fails as motus_compare does; and with MOTUS_DIVERGED: no
 * method of high order reached the end. */
typedef struct motus_reference motus_reference;
MOTUS_API motus_status motus_reference_create(motus_system *, const motus_study_def *, motus_reference **,
                                              motus_error *);
/* Writes the reference solution at `count` times between the start and `until`, in any order; it is fastest in the
 * direction of the motion. x gets `count` rows of nx numbers, v `count` rows of nv; either may be NULL. MOTUS_ARGUMENT:
 * a time is outside. MOTUS_DIVERGED, MOTUS_SOLVE, MOTUS_CALLBACK: as from motus_run_step. */
MOTUS_API motus_status motus_reference_at(motus_reference *, const double *times, size_t count, double *x, double *v,
                                          motus_error *);
/* Returns the estimated error of its largest component; 0 for the exact motion. */
MOTUS_API double motus_reference_error(const motus_reference *);
MOTUS_API const char *motus_reference_name(const motus_reference *); /* "exact", or "gauss6 at step 0.00125" */
MOTUS_API void motus_reference_destroy(motus_reference *);

/* 8. Texts for an editor ------------------------------------------------------------------------------------------- */

/* A statement of a model, in the order of its text. A callback has none. */
typedef enum motus_statement_kind {
    MOTUS_STATEMENT_MOTION,      /* x'' = … */
    MOTUS_STATEMENT_FIRST_ORDER, /* s' = … */
    MOTUS_STATEMENT_PARAMETER,
    MOTUS_STATEMENT_QUANTITY,
    MOTUS_STATEMENT_START,    /* x(0) = …, x'(0) = … */
    MOTUS_STATEMENT_BOUNDARY, /* x[0] = … */
    MOTUS_STATEMENT_EXACT,
    MOTUS_STATEMENT_INVARIANT,
    MOTUS_STATEMENT_SETTING,  /* method, step, from, until, every */
    MOTUS_STATEMENT_FUNCTION, /* V(q) = … */
    MOTUS_STATEMENT_EVENT     /* when … */
} motus_statement_kind;
typedef struct motus_statement {
    uint32_t size; /* by motus_default_statement() */
    motus_statement_kind kind;
    const char *name; /* the name that it defines: "x", "energy"; of a setting its word: "step" */
    int line;         /* the line of the model's text where it begins, from 1; 0: `set` added it */
    int is_set;       /* `set` gave its value */
} motus_statement;
MOTUS_DEFAULT_FUNCTION(statement, STATEMENT, motus_statement)
MOTUS_API size_t motus_statement_count(const motus_system *);
MOTUS_API motus_status motus_statement_at(const motus_system *, size_t k, motus_statement *);
/* Typesets statement k as the parser read it: one presentation MathML element, <math xmlns="…"
 * display="block">…</math>, in UTF-8. Whatever the text of the model, the element is well-formed XML and safe in a
 * page; where a statement is too long for a page, an ellipsis stands for the rest. Two elements have a class for a
 * style sheet: "cases", a table whose cells are left-aligned, and "for", the indices of a family behind its equation.
 * Owned by the system, until the next call of this function. NULL: k is past the last, or there was no memory. */
MOTUS_API const char *motus_statement_mathml(motus_system *, size_t k);

/* A word of a text, for an editor that colours it: as the lexer that reads models finds it, also where the text is no
 * model. A name is known where it is a word of the language, or where the text defines it: on the left of = or before
 * primes, as an index or an argument. */
typedef enum motus_word_kind {
    MOTUS_WORD_KNOWN,
    MOTUS_WORD_UNKNOWN,
    MOTUS_WORD_NUMBER,
    MOTUS_WORD_COMMENT,
    MOTUS_WORD_SETTING,  /* method, step … and what follows `method` */
    MOTUS_WORD_FUNCTION, /* of the language: sin */
    MOTUS_WORD_OPERATOR, /* signs, brackets, primes; for, and, or, not */
    MOTUS_WORD_WRONG     /* what is no word of any kind */
} motus_word_kind;
typedef struct motus_word {
    size_t from, length; /* bytes of the text */
    motus_word_kind kind;
    int defines; /* 1: the text defines this name here */
} motus_word;
/* Writes the first `room` words of `length` bytes of text, and returns how many it wrote. It takes no memory, and its
 * time grows as the number of names times that of definitions. */
MOTUS_API size_t motus_text_words(const char *text, size_t length, motus_word *words, size_t room);
/* Returns word k of the language, in a fixed order, and its kind: SETTING begins a statement, FUNCTION has a bracket,
 * KNOWN is t or pi, OPERATOR a word like for. NULL: k is past the last. */
MOTUS_API const char *motus_language_word(size_t k, motus_word_kind *);

#undef MOTUS_DEFAULT_FUNCTION

#ifdef __cplusplus
}
#endif
#endif
