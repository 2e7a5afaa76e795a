/* motus: Newton's second law, x'' = a(x, x', t), integrated.
 *
 * This header is the library's manual, in the order in which one uses it:
 *
 *     1. status and errors      every fallible call returns a motus_status; a motus_error adds sentence and place
 *     2. systems                what moves: the text of an equation (a model), or a C callback
 *     3. what a system holds    variables, columns, settings, analysis
 *     4. methods                the catalogue, from the rows the code runs
 *     5. runs                   one integration: create, step, look, save, destroy
 *     6. ensembles              one model, many trajectories: parameters or initial values vary, numbers are recorded
 *     7. studies                every method side by side; observed order and its certificate; the truth
 *     8. defaults               the functions that make every struct with a size
 *
 *     motus_text_def def = motus_default_text();
 *     def.text = "x'' = -x   x(0) = 1 ...";
 *     motus_system *s;  motus_run *r;
 *     if (motus_system_from_text(&def, &s, &err)) puts(err.message);
 *
 * Structs may grow at their end in later versions, and a program compiled against this header keeps working, because
 * neither side relies on the size of the other's structs:
 *   - A struct of yours, which a call reads or fills, begins with `size` and is made by motus_default_…(). A
 *     definition, motus_…_def, is then edited. A size that no version had is refused with MOTUS_ARGUMENT. A larger one,
 *     of a newer header, is taken as long as what this library does not know is zero, as motus_default_…() leaves it:
 *     zero means "as before".
 *   - A struct of the library's is handed out by a pointer to const, and several as an array of such pointers:
 *     rows[k]->step. Read its members through the pointer; copying it whole, or its sizeof, would rely on how large it
 *     is today.
 *   - motus_allocator and motus_record are final: the first lies inside definitions, and of the second you make arrays.
 * Enumerations may get further values at their end.
 * Names. A status is MOTUS_ and one word, MOTUS_DIVERGED. Every other enumerator has the word of its enumeration in
 * between, MOTUS_EVENT_KICK, so none can ever be a status. All macros begin with MOTUS_.
 * Errors. Beside what stands with a call, every call that returns a status may return MOTUS_ARGUMENT (a pointer that
 * must not be NULL is, or a struct has no sound size: the motus_error is looked at first) and, where it takes memory,
 * MOTUS_MEMORY. What a failed call would have created is NULL; other places for results may have been written in part.
 * Shapes. nx is motus_positions(), nv is motus_velocities(). An array of positions has nx numbers, one of velocities or
 * accelerations nv: the velocities of all positions, then the companions. A table has its rows one behind the other.
 * Units. Whatever units the equation is in, for times, steps and values alike; angles in radians. `seconds` are a
 * clock's.
 * Lifetimes. A handle lives from …_create / …_from… to …_destroy (destroying NULL does nothing). Runs, ensembles and
 * references need their system: destroy them first. Strings and structs returned by pointer belong to the handle they
 * came from, or are static.
 * Threads. There are no globals. Different handles may be used from different threads at once. One system may serve
 * several runs on one thread; each thread wants its own system: motus_system_clone. One handle is used by one thread at
 * a time.
 * Floating point. Results are the same bits on every machine. Calls save the rounding and flush modes, work in round to
 * nearest with subnormals, and restore the modes. The library prints nothing and never exits.
 */
#ifndef MOTUS_H
#define MOTUS_H

#include <stddef.h>
#include <stdint.h>

#define MOTUS_VERSION_MAJOR 0
#define MOTUS_VERSION_MINOR 1
#define MOTUS_VERSION_PATCH 0
#define MOTUS_VERSION "0.1.0"

#ifdef MOTUS_BUILDING
#define MOTUS_API __attribute__((visibility("default")))
#else
#define MOTUS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library that is loaded (MOTUS_VERSION is the header's). */
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
    X(UNAVAILABLE, "unavailable", "not available in this version", 2)

#define MOTUS_STATUS_ENUMERATOR(name, word, text, exit) MOTUS_##name,
typedef enum motus_status {
    MOTUS_STATUS_MAP(MOTUS_STATUS_ENUMERATOR)
        MOTUS_STATUS_COUNT /* how many this header knows; a newer library may have more */
} motus_status;
#undef MOTUS_STATUS_ENUMERATOR

MOTUS_API const char *motus_status_word(motus_status); /* "diverged"; static */
MOTUS_API const char *motus_status_text(motus_status); /* the sentence; static */
MOTUS_API int motus_status_exit(motus_status);         /* 0, 1 or 2 */

#define MOTUS_TEXT_MAX 512
#define MOTUS_NAME_MAX 64

/* What went wrong, where, and what to do. Filled only when a call returns other than MOTUS_OK. Wherever a call takes
 * one it may be NULL. */
typedef struct motus_error {
    uint32_t size; /* by motus_default_error() */
    motus_status status;
    int line, column;              /* 1-based, in characters, for errors in a text; 0 where there is no place */
    int returned;                  /* CALLBACK: what the callback returned, never 0; 0 elsewhere */
    double time;                   /* DIVERGED, SOLVE, CALLBACK: when; NaN elsewhere */
    char variable[MOTUS_NAME_MAX]; /* DIVERGED, SOLVE: which, "r[3].y"; else "" */
    char message[MOTUS_TEXT_MAX];  /* one sentence, UTF-8, without a newline, safe to print on a terminal */
    char hint[MOTUS_TEXT_MAX];     /* what would be right, or "" */
    char source[MOTUS_TEXT_MAX];   /* the line of the text, control characters replaced, or "" */
    char caret[MOTUS_TEXT_MAX];    /* blanks and carets that go under `source`, or "" */
    char file[MOTUS_TEXT_MAX];     /* the name given in the definition, or "" */
} motus_error;

/* Memory. Both may be NULL: malloc and free. `allocate` returns at least `bytes` bytes, aligned for any type, or
 * NULL when there are none; `release` (NULL: nothing is given back) gets what `allocate` returned, and never NULL. */
typedef struct motus_allocator {
    void *(*allocate)(void *context, size_t bytes);
    void (*release)(void *context, void *block);
    void *context;
} motus_allocator;

/* 2. Systems ----------------------------------------------------------------------------------------------------- */

typedef struct motus_system motus_system;

/* A system from the text of a model. Everything is copied. */
typedef struct motus_text_def {
    uint32_t size;          /* by motus_default_text() */
    const char *text;       /* UTF-8; need not end with 0 if length is given */
    size_t length;          /* bytes; SIZE_MAX: up to the terminating 0 */
    const char *file;       /* for messages; NULL: none */
    const char *const *set; /* set_count strings "name=expression": replaces a parameter or initial value, */
    size_t set_count;       /*   "F=0.2", "x(0)=1", "r'(0)=(1, 2)", "m=[1, 2]" */
    motus_allocator allocator;
} motus_text_def;

/* A system from C. State: x (positions) of length `positions`, and v of length `positions + companions`: first the
 * velocities, then the first-order companions s. The callback writes a, of v's length: x'' first, then s'.
 *
 * A callback returns 0 when it has done its work. Other than 0 stops whoever called it with MOTUS_CALLBACK, and the
 * error holds the value and the time:
 *     below 0   failure. A run, an ensemble, a study ends.
 *     above 0   it cannot be evaluated here: the argument lies outside what it is defined for. A run with a fixed step
 *               stops at its last whole step and may go on from there, by another call or by another run that starts at
 *               the last state that was looked at; of an ensemble this trajectory alone stops, as one that leaves the
 *               finite numbers; a method that chooses its own step takes a smaller one.
 * Either way the run is where it was before the step. (Where a method evaluates the force at the end of a step only
 * when that end is looked at or the next step begins, velocity-verlet say, it is this that fails.) */
typedef struct motus_callback_def {
    uint32_t size; /* by motus_default_callback() */
    size_t positions, companions;
    const double *x, *v; /* initial values, positions and positions + companions of them, copied; finite */
    double start;        /* initial time */
    /* NULL, or positions + companions names as in a model, each its own: "theta", whose velocity is then "theta'".
     * Copied. Without them the positions are x and the companions s, counted from 1: x[1], x[2] …; a single one is
     * plain x, or s. */
    const char *const *names;
    int (*acceleration)(void *context, double t, const double *x, const double *v, double *a);
    /* Optional: directional derivative da = (da/dx) dx + (da/dv) dv; NULL: difference quotients where one is needed.
     * dx has the length of x, dv and da that of v. */
    int (*derivative)(void *context, double t, const double *x, const double *v, const double *dx, const double *dv,
                      double *da);
    int (*exact)(void *context, double t, double *x, double *v); /* optional: the exact motion */
    /* Optional: `quantities` numbers worth looking at, and `invariants` numbers that should be kept; each function
     * fills all of its own. 1 by default. The names are copied; without them they are one quantity, "quantity", or
     * one invariant, "invariant", whose numbers count from 1 where there are several. */
    int (*quantity)(void *context, double t, const double *x, const double *v, double *values);
    int (*invariant)(void *context, double t, const double *x, const double *v, double *values);
    size_t quantities, invariants;
    const char *const *quantity_names, *const *invariant_names;
    int depends_on_velocity, depends_on_time; /* what `acceleration` reads; both 1 by default: safe */
    int linear_in_velocity;                   /* 1 lets implicit velocity terms be solved in one step */
    void *context;                            /* the first argument of all of these */
    motus_allocator allocator;
    /* Optional: the acceleration of `count` trajectories of an ensemble at once, the first of which is number
     * `first`: number k of trajectory first + j is x[k * count + j], and v and a alike. So it may be written as
     * loops over j that a compiler makes vectors of, and trajectories may differ in numbers of the context's that
     * are found by first + j. An ensemble calls it in place of `acceleration` (which may be NULL then: a run is
     * trajectory 0 alone) and takes difference quotients in place of `derivative`, which knows of one trajectory
     * only. What it computes for a trajectory must depend neither on the others nor on `count`: methods that solve
     * an equation, and a trajectory that is lost, are computed with smaller counts, down to 1. Other than 0 speaks
     * for all `count`; above 0 they are asked again in smaller blocks, to find the one that is meant. */
    int (*block)(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a);
} motus_callback_def;

/* The text is read and understood as a whole. MOTUS_SYNTAX, MOTUS_NAME, MOTUS_SHAPE, MOTUS_LIMIT, MOTUS_ARGUMENT (a
 * value that makes no sense, an exact line that is not true) and MOTUS_UNAVAILABLE, each with its place in the text. */
MOTUS_API motus_status motus_system_from_text(const motus_text_def *, motus_system **, motus_error *);
/* MOTUS_ARGUMENT: no acceleration, nothing that moves, initial values missing or not finite. MOTUS_NAME: a name that
 * is none, or stands for two things. MOTUS_LIMIT: too many numbers. No callback is called yet. */
MOTUS_API motus_status motus_system_from_callback(const motus_callback_def *, motus_system **, motus_error *);
MOTUS_API void motus_system_destroy(motus_system *);
/* The hooks that the system was created with; whoever computes on its behalf takes memory through them. */
MOTUS_API const motus_allocator *motus_system_allocator(const motus_system *);

/* Sets numbers of a system without reading its text again, for sliders and searches: those of a parameter, "F", or
 * of an initial value as motus_initial calls it, "x'(0)" (of a callback, initial values alone). values: `count`
 * numbers, which are all of it, in the order of motus_parameter_values or motus_initial_values. What is computed
 * from them follows; what was set itself stays as it was set. Runs created afterwards have the bits of a system that
 * was read with these numbers in `set` of its motus_text_def. After a failure the numbers are what they were.
 * MOTUS_NAME: no such parameter or initial value. MOTUS_SHAPE: `count` is not how many there are. MOTUS_ARGUMENT: a
 * number is not finite, or one that follows would not be; an exact line would no longer be true; the parameter
 * decides a size, the step or the like (motus_parameter.decides); or a run, an ensemble or a reference still uses
 * the system. */
MOTUS_API motus_status motus_system_set(motus_system *, const char *name, const double *values, size_t count,
                                        motus_error *);
/* The same system once more, numbers that were set included, for another thread: afterwards the two share nothing
 * but the callbacks, their context and the allocator, which must then bear being called from both threads. Fails as
 * the call did that made the system. */
MOTUS_API motus_status motus_system_clone(const motus_system *, motus_system **, motus_error *);

/* 3. What a system holds ----------------------------------------------------------------------------------------- */

MOTUS_API size_t motus_positions(const motus_system *);  /* nx: length of x as seen here, without boundary cells */
MOTUS_API size_t motus_velocities(const motus_system *); /* nv: length of v: velocities, then companions */

/* A variable of the model: a state with its family indices and components. */
typedef struct motus_variable {
    uint32_t size; /* by motus_default_variable() */
    const char *name;
    int order;                 /* 2: x'' = …   1: s' = … */
    int components;            /* 0: scalar, else the length of the vector */
    int dimensions;            /* number of family indices, 0 … 4 */
    int64_t first[4], last[4]; /* the index ranges that have equations (their hull) */
    size_t count;              /* numbers in all: cells × components */
} motus_variable;
MOTUS_API size_t motus_variable_count(const motus_system *);
/* Variable k, in the order of the model. MOTUS_ARGUMENT past the last; so with all calls …_at. */
MOTUS_API motus_status motus_variable_at(const motus_system *, size_t k, motus_variable *);

/* Columns: every number that can be looked at along a run, in one numbering: t; positions; velocities; companions;
 * quantities; invariants; exact. Names: "t", "x", "x'", "r.x", "r'.y", "x[3]'", "w[2]" (component 2 of a vector longer
 * than 3), "r[3].x", "energy", "exact x". */
typedef enum motus_column_kind {
    MOTUS_COLUMN_TIME,
    MOTUS_COLUMN_POSITION,
    MOTUS_COLUMN_VELOCITY,
    MOTUS_COLUMN_COMPANION,
    MOTUS_COLUMN_QUANTITY,
    MOTUS_COLUMN_INVARIANT,
    MOTUS_COLUMN_EXACT
} motus_column_kind;
typedef struct motus_column {
    uint32_t size; /* by motus_default_column() */
    motus_column_kind kind;
    size_t variable; /* index of the variable, quantity or invariant it belongs to; of the time 0 */
    int is_velocity; /* 1: of a velocity, exact or not */
    int component;   /* of a vector, from 0; of a number 0 */
    int dimensions;  /* number of family indices, 0 … 4, */
    int64_t cell[4]; /*   and these, as the language counts them */
    char name[MOTUS_NAME_MAX + 64];
} motus_column;
MOTUS_API size_t motus_column_count(const motus_system *);
MOTUS_API motus_status motus_column_at(const motus_system *, size_t k, motus_column *);
/* The inverse: the column *k that has this kind, variable, component and cell (and is_velocity, which only exact
 * columns ask for); the other members are not read. MOTUS_NAME where there is none. */
MOTUS_API motus_status motus_column_of(const motus_system *, const motus_column *, size_t *k, motus_error *);
/* Columns [*first, *first + *count) that a name stands for: "x" of a vector or family is all of its numbers.
 * MOTUS_NAME with a "did you mean" where there is none. */
MOTUS_API motus_status motus_column_find(const motus_system *, const char *name, size_t *first, size_t *count,
                                         motus_error *);

/* Quantities and invariants in the order of the model, or of the definition. *numbers (NULL is allowed): how many
 * numbers, that is columns, each has. NULL past the last. */
MOTUS_API size_t motus_quantity_count(const motus_system *);
MOTUS_API const char *motus_quantity_name(const motus_system *, size_t k, size_t *numbers);
MOTUS_API size_t motus_invariant_count(const motus_system *);
MOTUS_API const char *motus_invariant_name(const motus_system *, size_t k, size_t *numbers);
MOTUS_API int motus_has_exact(const motus_system *); /* by an exact line or callback, or recognised */

/* What may be set: parameters, in the order of the model, and initial values: by `set` in motus_text_def, or later by
 * motus_system_set. */
typedef struct motus_parameter {
    uint32_t size; /* by motus_default_parameter() */
    const char *name;
    const char *text;          /* what stands behind its =, in the model or in `set`: `length` bytes, not ended */
    size_t length;             /*   with 0; what motus_system_set gave it does not stand there */
    int components;            /* 0: numbers, else the length of the vector */
    int list;                  /* 1: a list, or a family */
    int dimensions;            /* of a list: number of indices, 1 … 4, */
    int64_t first[4], last[4]; /*   and their ranges */
    size_t count;              /* numbers in all: cells × components */
    /* NULL: numbers alone follow from it. "a size or an index", "step", "until", "the start" …: it decides that (and
     * maybe more), so neither motus_system_set nor an ensemble can change it. "unknown": no memory to find out. */
    const char *decides;
} motus_parameter;
MOTUS_API size_t motus_parameter_count(const motus_system *);
MOTUS_API motus_status motus_parameter_at(const motus_system *, size_t k, motus_parameter *);
/* Its present numbers, motus_parameter.count of them, cell by cell, component by component. */
MOTUS_API motus_status motus_parameter_values(const motus_system *, size_t k, double *out);

typedef struct motus_initial {
    uint32_t size;   /* by motus_default_initial() */
    size_t variable; /* for motus_variable_at: its components, its indices */
    int is_velocity;
    size_t count;                   /* numbers in all */
    char name[MOTUS_NAME_MAX + 64]; /* "x(0)", "r'(0)", as `set` and motus_system_set take it */
} motus_initial;
MOTUS_API size_t motus_initial_count(const motus_system *);
MOTUS_API motus_status motus_initial_at(const motus_system *, size_t k, motus_initial *);
/* The present numbers, motus_initial.count of them, cell by cell, component by component. */
MOTUS_API motus_status motus_initial_values(const motus_system *, size_t k, double *out);

/* What the model's settings say. NaN, 0 or NULL where it says nothing. */
typedef struct motus_settings {
    uint32_t size;      /* by motus_default_settings() */
    const char *method; /* "verlet", "newmark(0.25, 0.5)" */
    double step, from, until;
    double every_time;   /* every T */
    int64_t every_steps; /* every n steps */
} motus_settings;
MOTUS_API motus_status motus_settings_of(const motus_system *, motus_settings *);

/* What the program understood by reading the equations. Of a callback it is what the definition says. */
typedef struct motus_analysis {
    uint32_t size; /* by motus_default_analysis() */
    int velocity_dependent, linear_in_velocity, time_dependent, affine, constant;
    int gyroscopic;       /* a = E(x,t) + v × B(x,t): the velocity term does no work */
    int gradient;         /* 1 shown, 0 not shown */
    int smooth;           /* 1: no abs, min, max, floor, mod, sign, if */
    int exact_recognised; /* exact motion known without an exact line */
} motus_analysis;
MOTUS_API motus_status motus_analysis_of(const motus_system *, motus_analysis *);
/* The same in plain words, one sentence a line, with the coefficients of the velocity; owned by the system. ""
 * without memory. */
MOTUS_API const char *motus_explain(motus_system *);
/* Equation k of the normal form, as text in the language: "x'' = x^3 - x + F cos(t)". NULL past the last,
 * without memory, and of a callback. Owned by the system, until the next call of this function. */
MOTUS_API const char *motus_equation_text(motus_system *, size_t k);

/* The statements of the model, in the order of its text; of a callback there are none. */
typedef enum motus_statement_kind {
    MOTUS_STATEMENT_MOTION,    /* x'' = … */
    MOTUS_STATEMENT_COMPANION, /* s' = … */
    MOTUS_STATEMENT_PARAMETER,
    MOTUS_STATEMENT_QUANTITY,
    MOTUS_STATEMENT_START,    /* x(0) = …, x'(0) = … */
    MOTUS_STATEMENT_BOUNDARY, /* x[0] = … */
    MOTUS_STATEMENT_EXACT,
    MOTUS_STATEMENT_INVARIANT,
    MOTUS_STATEMENT_SETTING /* method, step, from, until, every */
} motus_statement_kind;
typedef struct motus_statement {
    uint32_t size; /* by motus_default_statement() */
    motus_statement_kind kind;
    const char *name; /* what it is about: "x", "energy"; of a setting its word: "step" */
    int line;         /* of the model's text, 1-based, where it begins; 0: added by `set` */
    int is_set;       /* `set` gave its value */
} motus_statement;
MOTUS_API size_t motus_statement_count(const motus_system *);
MOTUS_API motus_status motus_statement_at(const motus_system *, size_t k, motus_statement *);
/* Statement k as it was understood, typeset: one presentation MathML element, <math xmlns="…"
 * display="block">…</math>, in UTF-8. It is well-formed XML, and so can be put into a page, whatever the text of the
 * model is; what is too long for a page ends in an ellipsis. Two elements have a class for a style sheet: "cases", a
 * table whose cells begin at the left, and "for", the indices of a family behind its equation. Owned by the system,
 * until the next call of this function; NULL past the last, or without memory. */
MOTUS_API const char *motus_statement_mathml(motus_system *, size_t k);

/* 4. Methods ----------------------------------------------------------------------------------------------------- */

typedef enum motus_forces { MOTUS_FORCES_X, MOTUS_FORCES_XT, MOTUS_FORCES_XVT } motus_forces;
typedef struct motus_method {
    const char *name, *aliases; /* aliases: blank-separated, "" if none */
    const char *title;          /* as a text or a legend has it: "velocity Verlet" */
    const char *family;         /* "splitting", "runge-kutta", "two-step", "implicit", "exact" */
    int order, stages;
    int evaluations;     /* of the acceleration, per step in the long run; 0: depends on the solve */
    motus_forces forces; /* what the force may depend on */
    int symplectic, reversible;
    double stability_limit;    /* of h ω for x'' = -ω² x: largest stable; INFINITY; 0 if never */
    const char *cite;          /* key in doc/references.bib, with the place */
    const char *formula, *use; /* for the card */
} motus_method;
MOTUS_API size_t motus_method_count(void);
MOTUS_API const motus_method *motus_method_at(size_t k);
/* By name or alias, in any case of letters, with its arguments if it has any: "newmark(1/6, 1/2)". *found may be
 * NULL. MOTUS_METHOD and "did you mean" where unknown. */
MOTUS_API motus_status motus_method_find(const char *name, const motus_method **found, motus_error *);
/* MOTUS_OK, or MOTUS_METHOD with the reason in message and the nearest method that fits in hint. */
MOTUS_API motus_status motus_method_admits(const motus_system *, const char *method, motus_error *);

/* The stability region. radius[k], of `count`: by how much one step multiplies a motion in the long run (the
 * spectral radius) at the point z = h λ = re[k] + i im[k] on the equation whose rates are λ and its conjugate, x'' =
 * 2 Re λ x' - |λ|² x: an oscillator without friction is the imaginary axis, friction the left half plane. Stable
 * where the radius is not above 1, but for rounding: some 1e-15 (1 + |z|) to the power of the stages, and the root
 * of that where two rates meet. For Runge-Kutta it is |R(z)|. The plane off the axis does not exist for a method
 * that takes no force with velocities: NaN there. INFINITY where a step has no finite or no single answer.
 * MOTUS_METHOD: no such method, or one that takes no steps. MOTUS_ARGUMENT: |z| is above MOTUS_STABILITY_FAR, or
 * NaN. */
#define MOTUS_STABILITY_FAR 1e6
MOTUS_API motus_status motus_stability(const char *method, size_t count, const double *re, const double *im,
                                       double *radius, motus_error *);

/* 5. Runs -------------------------------------------------------------------------------------------------------- */

typedef struct motus_run motus_run;

typedef struct motus_run_def {
    uint32_t size;       /* by motus_default_run() */
    const char *method;  /* NULL: the model's, or "verlet" */
    double step;         /* > 0, NaN: the model's. The sign is taken from the direction of `until` */
    double until;        /* NaN: the model's. Before the start: the run goes backward */
    double start;        /* NaN: the model's; with x and v (copied), another initial state at this time */
    const double *x, *v; /* nx and nv finite numbers; NULL: the model's */
    /* Called now and then (not more often than every 10 ms or so of work), with the part of the way that is done, 0
     * … 1; a value other than 0 cancels. */
    int (*progress)(void *context, double fraction);
    void *context; /* of `progress` and of `observer` */
    /* NULL, or called after every step, the shortened last one included, by motus_run_step, motus_run_finish and
     * motus_run_sample; not at the start, where the run can be looked at before its first step. It may look (state,
     * values, jacobian, statistics, save), and may not step, restore, set or destroy the run. Other than 0 stops the
     * run after this step: MOTUS_CANCELLED. The bits are the same; a large system is no longer advanced several
     * steps at a time. */
    int (*observer)(void *context, motus_run *);
    /* "interpreter"; "compiled": the equations and the method as machine code, made by the system's C compiler and
     * kept in $XDG_CACHE_HOME/motus; NULL or "auto": compiled where the run is long enough to repay it and a
     * compiler is there. A system from C calls its callback whatever is said here. The bits are the same. */
    const char *machine;
    /* How many threads the compiled machine may use for one large system, 1 … MOTUS_THREADS_MAX; 0: one. Small
     * systems run on one whatever is said here. The bits are the same. */
    int threads;
} motus_run_def;
#define MOTUS_THREADS_MAX 1024

/* The definition may be NULL: all as the model says. MOTUS_METHOD: unknown, does not fit the force, or cannot take
 * the shorter last step. MOTUS_ARGUMENT: no step, no end, or numbers that are none. MOTUS_LIMIT: more than 1e15
 * steps, or equations too large to solve. MOTUS_TOOL: "compiled" was asked for and cannot be had. MOTUS_CALLBACK,
 * MOTUS_SOLVE, MOTUS_DIVERGED: at the start. */
MOTUS_API motus_status motus_run_create(motus_system *, const motus_run_def *, motus_run **, motus_error *);
MOTUS_API void motus_run_destroy(motus_run *);

/* n >= 0 whole steps, or fewer if `until` comes first; the last step is shortened to end exactly at `until`.
 * MOTUS_DIVERGED: a number is no longer finite. MOTUS_SOLVE: an implicit equation could not be solved.
 * MOTUS_CALLBACK: a callback returned other than 0. MOTUS_CANCELLED: `progress` did. The run is then at its last
 * whole step, and may be looked at, saved, and asked to go on. */
MOTUS_API motus_status motus_run_step(motus_run *, int64_t n, motus_error *);
/* On to `until`. Fails as motus_run_step does. */
MOTUS_API motus_status motus_run_finish(motus_run *, motus_error *);
MOTUS_API int motus_run_done(const motus_run *); /* 1: it is at `until` */

MOTUS_API double motus_run_time(const motus_run *);
MOTUS_API double motus_run_step_size(const motus_run *); /* > 0 */
MOTUS_API int64_t motus_run_steps(const motus_run *);    /* taken so far */
/* up to `until`, the last short one included; of steps that adapt: at their first size */
MOTUS_API int64_t motus_run_steps_total(const motus_run *);
/* of step 0, 1 …; `until` from the last one on. NaN where steps adapt */
MOTUS_API double motus_run_time_of(const motus_run *, int64_t step);
MOTUS_API double motus_run_last_step(const motus_run *);    /* size of the shortened last step, 0 if none is needed */
MOTUS_API int64_t motus_run_evaluations(const motus_run *); /* of the acceleration; looking is not counted */
MOTUS_API int64_t motus_run_iterations(const motus_run *);  /* of Newton's method, in all */
MOTUS_API const char *motus_run_method(const motus_run *);
MOTUS_API const char *motus_run_machine(const motus_run *); /* "interpreter", "compiled", "callback" */
/* All that a run has done so far, in one struct. */
typedef struct motus_statistics {
    uint32_t size;                /* by motus_default_statistics() */
    int legs;                     /* 1, and one more for every motus_run_set_state */
    const char *method, *machine; /* as motus_run_method and motus_run_machine say */
    int64_t steps;                /* taken, in all legs, shortened last ones included */
    /* tried, and taken back by a method that chooses its own step; 0 of a fixed step */
    int64_t refused;
    int64_t evaluations;          /* of the acceleration, for both; looking is not counted */
    int64_t iterations;           /* of Newton's method, for both */
    double first_step, last_step; /* sizes of the first and of the latest step taken, > 0; NaN before the first */
} motus_statistics;
MOTUS_API motus_status motus_run_statistics(const motus_run *, motus_statistics *);
/* Why "auto" took the interpreter where it would have compiled, or "". */
MOTUS_API const char *motus_run_note(const motus_run *);
/* The C text that the compiled machine compiles for a method (NULL: the model's) of this model; owned by the system.
 * NULL with an error if there is none: MOTUS_ARGUMENT of a callback, MOTUS_METHOD. */
MOTUS_API const char *motus_compiled_text(motus_system *, const char *method, motus_error *);
/* Removes the compiled objects kept between runs; how many, or -1 where they cannot be reached. */
MOTUS_API int motus_cache_clear(void);

/* The state now; x gets nx numbers, v nv; either may be NULL. v is at the same time as x. The run is not changed,
 * nor are its counts. MOTUS_SOLVE, MOTUS_DIVERGED, MOTUS_CALLBACK: what the method still has to compute for it
 * cannot be had. */
MOTUS_API motus_status motus_run_state(motus_run *, double *x, double *v, motus_error *);
/* `count` columns (numbers from motus_column_find) at the present state, into as many numbers. MOTUS_ARGUMENT: no
 * such column. MOTUS_CALLBACK: that for quantities, invariants or the exact motion returned other than 0. And as
 * motus_run_state. */
MOTUS_API motus_status motus_run_values(motus_run *, const size_t *columns, size_t count, double *out, motus_error *);
/* The linearised equations at the present state: row i is the acceleration (or rate) of number i of nv, its columns
 * are derivatives by the positions (da_dx: nv rows of nx numbers) and by the velocities and companions (da_dv: nv
 * rows of nv); either may be NULL. Exact where the system has derivatives, else difference quotients: half of the
 * digits, nearly all where the dependence is linear. MOTUS_LIMIT for nv above MOTUS_JACOBIAN_MAX. And as
 * motus_run_state. */
#define MOTUS_JACOBIAN_MAX 256
MOTUS_API motus_status motus_run_jacobian(motus_run *, double *da_dx, double *da_dv, motus_error *);
/* Columns at given times, in the direction of the run, none beyond `until`: steps as needed, and between steps reads
 * the quintic Hermite polynomial through (x, v, a) at both ends (local error h^6, never fed back). out: time_count
 * rows of `count` numbers. MOTUS_ARGUMENT: a time lies beyond the end, or behind the step that the run is in. And as
 * motus_run_step, motus_run_values. */
MOTUS_API motus_status motus_run_sample(motus_run *, const double *times, size_t time_count, const size_t *columns,
                                        size_t count, double *out, motus_error *);

/* An exact restart state: text of `length` bytes, hexadecimal numbers, owned by the run until it is saved again. A
 * run created from the same system (the same numbers set in the same way), method, step and start, and restored from
 * it, goes on to the same bits as one never interrupted, up to its own `until`. MOTUS_STATE: it is damaged, or of
 * another system, method, step or start, or lies beyond the end; the run is then where it was. */
MOTUS_API motus_status motus_run_save(motus_run *, const char **text, size_t *length, motus_error *);
MOTUS_API motus_status motus_run_restore(motus_run *, const char *text, size_t length, motus_error *);

/* Goes on from another state, a new leg: as a run that was created at time t (NaN: the present one) with x, nx
 * finite numbers, and v, nv of them (copied; NULL: as they are now), by the same method, step, end and machine.
 * motus_run_steps, motus_run_steps_total and motus_run_last_step are of this leg, and its times are t + n step, in
 * the direction of `until` from t; motus_statistics are of all legs. A restart state that is saved from now on is of
 * a run that starts at t. After a failure the run is where it was. MOTUS_ARGUMENT: a number is not finite, or a step
 * is lost beside t. MOTUS_METHOD: the last step would be shorter, which the method cannot take. MOTUS_LIMIT: too
 * many steps. And as motus_run_state, where the present state is asked for. */
MOTUS_API motus_status motus_run_set_state(motus_run *, double t, const double *x, const double *v, motus_error *);

/* One step opened up: what the method does inside it, in the order in which it does it; for pictures, and to see why
 * a method errs. It is the step that motus_run_step(r, 1) would take, to the same bits, told as the method stands on
 * paper: from a state (x, v) to a state (x, v). */
typedef enum motus_event {
    /* The state at `time`, and the acceleration there. */
    MOTUS_EVENT_START,
    /* v += coefficient step a, a = a(x, time): splitting. boris: a at the mean of the velocities before and after. */
    MOTUS_EVENT_KICK,
    /* x += coefficient step v; `time` is where that leads. */
    MOTUS_EVENT_DRIFT,
    /* a = a(x, v, time) at the stage's own x and v, coefficient steps after the start. Runge-Kutta and implicit:
     *     v = v₀ + step Σ row[j] a[j],  x = x₀ + step Σ row[j] v[j] = x₀ + coefficient step v₀ + step² Σ row_x[j] a[j];
     *     the end:   v₀ + step Σ weight a,   x₀ + step Σ weight v = x₀ + step v₀ + step² Σ weight_x a
     * (newmark has the forms with row_x and weight_x only). */
    MOTUS_EVENT_STAGE,
    /* The stages that follow solve their equations: `iterations` of Newton's method. */
    MOTUS_EVENT_SOLVE,
    /* The first step of a recurrence, which has no step before: x = x₀ + step v₀ + step²/2 a, a that of START. */
    MOTUS_EVENT_TAYLOR,
    /* x = 2 x₀ - before_x + step² a, a that of START; beeman: x = x₀ + step v₀ + step²/6 (4 a - before_a),
     * v = v₀ + step/6 (2 a₁ + 5 a - before_a) with a₁ of the end, and before_a = a in the first step. */
    MOTUS_EVENT_STEP,
    /* The state after the step, that of motus_run_state, and the acceleration there. */
    MOTUS_EVENT_END
} motus_event;
typedef struct motus_trace_entry {
    motus_event kind;
    int stage, stages;         /* which, from 1, of how many; START, SOLVE, END: 0 of as many */
    int64_t iterations;        /* of Newton's method, in this step up to here */
    double time, step;         /* step: negative backward; the last one may be shorter */
    double coefficient;        /* of a kick, a drift; the node of a stage: in units of the step */
    double weight, weight_x;   /* of a stage */
    const double *row, *row_x; /* of a stage: `stages` numbers each; else NULL */
    /* nx and nv numbers after the event, as in motus_run_state; of a stage its own. TAYLOR and STEP of verlet and
     * verlet-literal: v is (x - x₀)/step, to which half a kick by the acceleration of the end is still to come. */
    const double *x, *v;
    const double *a;                   /* nv numbers. NULL: the event has none, or at START and END none can be had */
    const double *before_x, *before_a; /* of a recurrence: those of the step before; else NULL */
} motus_trace_entry;
/* *entries gets *count pointers, the run's until it is traced again or destroyed. At the end of the run there is
 * nothing left to take: *count is 0. Fails as motus_run_step does; and where the step could be taken but the state
 * after it cannot be had, as motus_run_state does then. Calls no progress hook. */
MOTUS_API motus_status motus_run_trace(motus_run *, const motus_trace_entry *const **entries, size_t *count,
                                       motus_error *);

/* 6. Ensembles --------------------------------------------------------------------------------------------------- */

/* Many trajectories of one model, by one method, from the start to one end, in which some parameters or initial
 * values differ. What is wanted of each is recorded on the way; trajectories are not kept. Each has the bits that a
 * run of the model with these values has (`set` in motus_text_def), whatever the machine, the number of lanes or of
 * threads. */
typedef struct motus_ensemble motus_ensemble;

typedef enum motus_reduction {
    /* The value at the end. */
    MOTUS_REDUCE_FINAL,
    /* Over the looks: the start, every `every` steps, and the end. */
    MOTUS_REDUCE_MIN,
    MOTUS_REDUCE_MAX,
    MOTUS_REDUCE_MEAN,
    /* The time of the first look with that value. */
    MOTUS_REDUCE_TIME_OF_MIN,
    MOTUS_REDUCE_TIME_OF_MAX
} motus_reduction;
/* column: from motus_column_find or motus_column_of */
typedef struct motus_record {
    motus_reduction how;
    size_t column;
} motus_record;

typedef struct motus_ensemble_def {
    uint32_t size; /* by motus_default_ensemble() */
    /* What differs: a parameter "F", a component of one "g.x", an initial value "x(0)", "x'(0)", "r.x(0)",
     * "x[3](0)", or the end, "until", where the definition has none. Values that are computed from these follow. What
     * decides sizes, the step or the end cannot differ. */
    const char *const *vary;
    size_t vary_count;
    const motus_record *records; /* at least one */
    size_t record_count;
    const char *method;  /* NULL: the model's, or "verlet" */
    double step, until;  /* NaN: the model's */
    int64_t every;       /* steps between two looks, for all records but the one of the end; 1 by default */
    const char *machine; /* as in motus_run_def */
    /* 0: as many as there are processors; of a system from C, 1: with more, its callbacks are called from several
     * threads at once, and must be able to be. Outside lanes, a system with an allocator of its own is served by one
     * thread, which alone calls it. */
    int threads;
    int lanes; /* trajectories side by side in one thread: 1, 2, 4, …; 0: as many as suit */
    int fast;  /* 1: the compiler may fuse and reorder; last bits may differ between machines */
    int (*progress)(void *context, double fraction); /* of a motus_ensemble_run; as in motus_run_def */
    void *context;
    uint64_t expected; /* trajectories to come in all: "auto" compiles not for a few; 0: many */
} motus_ensemble_def;

/* MOTUS_NAME, MOTUS_SHAPE: what should vary is not there, or is several numbers. MOTUS_ARGUMENT: it decides what
 * must be the same for all, or a number of the definition is out of its range. MOTUS_METHOD, MOTUS_LIMIT, MOTUS_TOOL
 * as motus_run_create. */
MOTUS_API motus_status motus_ensemble_create(motus_system *, const motus_ensemble_def *, motus_ensemble **,
                                             motus_error *);
/* Computes `count` trajectories. values[k]: `count` values of vary[k]; NULL only where vary_count is 0. results[k]:
 * room for `count` numbers of records[k]. stopped: NULL or room for `count` numbers: NaN, or the time at which a
 * trajectory left the finite numbers, its implicit equation could not be solved, or its callback could not be
 * evaluated (above 0); its results are then NaN, and the others are not harmed. MOTUS_CALLBACK: a callback failed
 * (below 0). MOTUS_CANCELLED. MOTUS_ARGUMENT, MOTUS_LIMIT, MOTUS_METHOD: an end that varies is none for a run, and
 * nothing has been computed. */
MOTUS_API motus_status motus_ensemble_run(motus_ensemble *, size_t count, const double *const *values,
                                          double *const *results, double *stopped, motus_error *);
MOTUS_API void motus_ensemble_destroy(motus_ensemble *);

MOTUS_API int64_t motus_ensemble_steps(const motus_ensemble *); /* of each trajectory; 0 where they differ */
MOTUS_API const char *motus_ensemble_method(const motus_ensemble *);
MOTUS_API const char *motus_ensemble_machine(const motus_ensemble *);
MOTUS_API const char *motus_ensemble_note(const motus_ensemble *); /* why not another machine, or "" */
MOTUS_API int motus_ensemble_lanes(const motus_ensemble *);
MOTUS_API int motus_ensemble_threads(const motus_ensemble *);
/* Spent in the integration alone by all runs so far, without reading models or compiling. */
MOTUS_API double motus_ensemble_seconds(const motus_ensemble *);

/* 7. Studies ----------------------------------------------------------------------------------------------------- */

typedef struct motus_study_def {
    uint32_t size;              /* by motus_default_study() */
    const char *const *methods; /* method_count names; NULL: every admitted method */
    size_t method_count;
    double step, until;  /* NaN: the model's */
    int64_t evaluations; /* compare: > 0: equal work; each method's step is chosen to spend this many */
    int (*progress)(void *context, double fraction); /* as in motus_run_def, of the whole study */
    void *context;
} motus_study_def;

typedef struct motus_drift { /* of one invariant (largest of its numbers) */
    const char *name;
    double initial, final, max_drift;
    double trend; /* slope of a straight line through the drift, times the length of the run */
    int trending; /* 1: the trend is above 4 standard errors, and above round-off */
} motus_drift;

typedef struct motus_compare_row {
    const char *method;
    int order;
    motus_status status; /* other than OK: the run failed; note says how */
    double step;
    int64_t steps, evaluations;
    double seconds;
    double error_max_x, error_max_v, error_final_x, error_final_v; /* norm: largest component; NaN where unknown */
    size_t invariant_count;
    const motus_drift *const *invariants; /* invariant_count, in the order of motus_invariant_name */
    double reversal;                      /* distance from the start after going there and back */
    const char *note;
} motus_compare_row;

typedef struct motus_comparison {
    size_t row_count;
    const motus_compare_row *const *rows; /* row_count, in the order of the methods */
    const char *reference;                /* "exact", or "gauss6 at step 0.00125" */
    double reference_error;               /* estimated error of the reference itself; 0 for exact */
    const char *remarks;                  /* why the numbers are as they are, one sentence a line; "": no more to say */
} motus_comparison;
/* The definition may be NULL: all as the model says; so with motus_converge and motus_reference_create. A method
 * that fails has a row that says so. MOTUS_ARGUMENT: no end, no step, or numbers that are none. MOTUS_CANCELLED:
 * `progress` returned other than 0. MOTUS_CALLBACK: a callback failed where the system itself is looked at. */
MOTUS_API motus_status motus_compare(motus_system *, const motus_study_def *, motus_comparison **, motus_error *);
MOTUS_API void motus_comparison_destroy(motus_comparison *);

typedef struct motus_point {
    double step, error;
    int used;            /* in the fit */
    int64_t evaluations; /* of the acceleration over the whole motion; of a run that failed: until then */
} motus_point;
typedef struct motus_converge_row {
    const char *method;
    int declared;
    double observed, standard_error; /* NaN where there is no slope */
    int exact_here;                  /* the method is exact on this model: errors are round-off at every step */
    int passed;                      /* the certificate */
    motus_status status;
    size_t point_count;
    const motus_point *const *points; /* point_count, from the largest step to the smallest */
    const char *certificate;          /* "observed 2.00, declared 2" */
} motus_converge_row;
typedef struct motus_convergence {
    size_t row_count;
    const motus_converge_row *const *rows; /* row_count, in the order of the methods */
    const char *reference;
    double reference_error;
    int passed; /* every row */
} motus_convergence;
/* As motus_compare; and MOTUS_DIVERGED where no method followed the motion to the end, so that errors cannot be
 * measured. */
MOTUS_API motus_status motus_converge(motus_system *, const motus_study_def *, motus_convergence **, motus_error *);
MOTUS_API void motus_convergence_destroy(motus_convergence *);

/* The truth by itself: what compare and converge judge by, at any times, so that one may draw |x - truth| of several
 * methods. Of the definition, `until`, `step` (a hint: a motus_compare at this step has the same reference; NaN
 * where the model has none: its own choice), `progress` and `context` are read, the latter two during this call
 * only. MOTUS_DIVERGED where no method followed the motion to the end. */
typedef struct motus_reference motus_reference;
MOTUS_API motus_status motus_reference_create(motus_system *, const motus_study_def *, motus_reference **,
                                              motus_error *);
/* At `count` times between the start and `until`: x gets count rows of nx numbers, v count rows of nv; either may be
 * NULL. Any order will do; in the direction of the motion it is fastest. MOTUS_ARGUMENT: a time outside. */
MOTUS_API motus_status motus_reference_at(motus_reference *, const double *times, size_t count, double *x, double *v,
                                          motus_error *);
/* Estimated, of the largest component; 0 for the exact motion. */
MOTUS_API double motus_reference_error(const motus_reference *);
MOTUS_API const char *motus_reference_name(const motus_reference *); /* "exact", or "gauss6 at step 0.00125" */
MOTUS_API void motus_reference_destroy(motus_reference *);

/* 8. Defaults ---------------------------------------------------------------------------------------------------- */

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
    MOTUS_DEF_STATISTICS
} motus_def_kind;
/* Fills the `size` bytes of a struct; the functions below do so with the size that this header knows. What is beyond
 * the library's own size is zero, and so is all of a struct that it does not know. */
MOTUS_API void motus_default(motus_def_kind, void *made, uint32_t size);

#define MOTUS_DEFAULT_FUNCTION(name, KIND, type)                       \
    static inline type motus_default_##name(void)                      \
    {                                                                  \
        type made;                                                     \
        motus_default(MOTUS_DEF_##KIND, &made, (uint32_t)sizeof made); \
        return made;                                                   \
    }
MOTUS_DEFAULT_FUNCTION(error, ERROR, motus_error)
MOTUS_DEFAULT_FUNCTION(text, TEXT, motus_text_def)
MOTUS_DEFAULT_FUNCTION(callback, CALLBACK, motus_callback_def)
MOTUS_DEFAULT_FUNCTION(run, RUN, motus_run_def)
MOTUS_DEFAULT_FUNCTION(study, STUDY, motus_study_def)
MOTUS_DEFAULT_FUNCTION(ensemble, ENSEMBLE, motus_ensemble_def)
MOTUS_DEFAULT_FUNCTION(variable, VARIABLE, motus_variable)
MOTUS_DEFAULT_FUNCTION(column, COLUMN, motus_column)
MOTUS_DEFAULT_FUNCTION(parameter, PARAMETER, motus_parameter)
MOTUS_DEFAULT_FUNCTION(initial, INITIAL, motus_initial)
MOTUS_DEFAULT_FUNCTION(settings, SETTINGS, motus_settings)
MOTUS_DEFAULT_FUNCTION(analysis, ANALYSIS, motus_analysis)
MOTUS_DEFAULT_FUNCTION(statement, STATEMENT, motus_statement)
MOTUS_DEFAULT_FUNCTION(statistics, STATISTICS, motus_statistics)
#undef MOTUS_DEFAULT_FUNCTION

#ifdef __cplusplus
}
#endif
#endif
