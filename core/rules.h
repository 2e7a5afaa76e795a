/* Rules: what is to happen at which instants of a motion. The engine of events (core/events.h) shares this with the
 * models and callbacks that supply rules.
 *
 * A rule watches functions g of the time and the state. It has `leaves` functions for each of its instances: a family
 * of rules (`for i = 1..N`) has an instance for each of its cells, numbered as the cells of an array over the hull of
 * its indices; a cell without a rule has NaN for its functions. The function of leaf l and instance i is number
 * first + l * instances + i.
 *
 * RULE_ROOT, `when a = b`: one leaf, a - b. It happens where the function passes 0, in one direction or in both, and,
 * for both directions, where it touches 0.
 * RULE_CONDITION, `when x > 1 and y < 2`: a leaf for each comparison: a - b for a > b, a >= b, a == b and a != b,
 * b - a for a < b and a <= b; `compares` says what the comparison asks of its leaf. It happens where the formula
 * becomes true. A comparison == holds in the instant in which its leaf passes 0, so `x == 0 and y > 0` happens there.
 * RULE_CLOCK, `when every T`: no leaves and one instance; it happens at start + T, start + 2 T and so on.
 * RULE_ACCUMULATES, `when NAME accumulates`: no leaves; it happens where the events of rule `of` accumulate. It has one
 * instance, or an instance for each instance of rule `of`.
 *
 * Modes and what events keep are numbers of the state: positions without velocity and acceleration, which rules alone
 * change (lang/model/model.h).
 */
#ifndef CORE_RULES_H
#define CORE_RULES_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum rule_kind { RULE_ROOT, RULE_CONDITION, RULE_CLOCK, RULE_ACCUMULATES } rule_kind;

/* What a comparison asks of its leaf g. ABOVE and AT_LEAST differ where g stays 0, as it may for modes. */
typedef enum rule_comparison { RULE_ABOVE /* g > 0 */, RULE_AT_LEAST /* g >= 0 */, RULE_AT, RULE_OFF } rule_comparison;

enum {
    RULE_AND = -1, /* words < 0 in the formula of a condition, which is in postfix order; words >= 0 are leaves */
    RULE_OR = -2,
    RULE_NOT = -3,
    RULE_FORMULA_MOST = 128,      /* words of a formula */
    RULES_MOST = 4096,            /* rules of a model */
    RULE_ARGUMENTS_MOST = 8,      /* arguments of operations that are not polynomials, in one function */
    RULE_FUNCTIONS_MOST = 1 << 20 /* functions of all instances of all rules */
};

typedef struct rule {
    const char *name; /* as NAME, or event1, event2, … */
    rule_kind kind;
    int direction; /* of RULE_ROOT: 1 rising, -1 falling, 0 both */
    size_t first;  /* number of its first function */
    size_t leaves, instances;
    const int16_t *formula; /* of RULE_CONDITION: `words` words */
    int words;
    const uint8_t *compares; /* of RULE_CONDITION: the rule_comparison of every leaf */
    double period;           /* of RULE_CLOCK: positive */
    size_t of;               /* of RULE_ACCUMULATES: number of a rule */
    bool records;            /* its events are rows in the table of events */
    bool assigns;            /* `act` changes numbers on which the motion or a rule depends: it ends the step */
    bool keeps;              /* `act` changes only numbers that observers alone read: it ends no step */
    bool timed;              /* its functions depend on the time alone */
    bool smooth;             /* its functions are known to have neither jumps nor kinks */
    const char *jump;        /* an operation of its functions that may jump, as text: "floor(x)"; NULL: there is none */
    int64_t stop;            /* the run ends at this event of the rule: 1 `stop`, N `stop after N`, 0 never */
    /* A switch of the force, which turns where the function of this falling RULE_ROOT passes 0. It assigns, and is not
     * an event of the model: no table has it, and all switches may turn in one instant. */
    bool internal;
} rule;

typedef enum rule_number { RULE_VALUE, RULE_RATE, RULE_ROUNDING, RULE_NUMBERS } rule_number;

typedef struct rules {
    void *ctx;
    const rule *rule;
    size_t count;
    size_t functions;   /* of all rules */
    const size_t *kept; /* places in x that rules with `keeps` change */
    size_t kept_count;
    const size_t *rounded; /* places in x of modes that rounding of their assignments can change */
    size_t rounded_count;
    /* Evaluates all functions at a state, whose driven boundary cells are refreshed first. Nonzero: the caller's own
     * function failed. */
    int (*values)(void *ctx, double t, double *x, double *v, double *out);
    /* Evaluates the rates of all functions along the motion, dg/dt + (dg/dx) v + (dg/dv) a, where a is the acceleration
     * at the state. */
    int (*rates)(void *ctx, double t, double *x, double *v, double *a, double *out);
    bool rates_without_a; /* `rates` does not read a, which need not be computed */
    /* Fails where a function has no value at a state although it should, as outside of a table: with the sentence, and
     * `last`, the latest time at which it had one. NULL: every function may lack a value. */
    motus_status (*undefined)(void *ctx, size_t function, double last, double t, const double *x, const double *v,
                              motus_error *);
    /* Bounds the rounding error of each function's value, if t and each number of the state are off by half a unit in
     * the last place. NULL: no formula is known. */
    void (*rounding)(void *ctx, double t, double *x, double *v, double *out);
    /* Evaluates the value, the rate or the rounding bound of one function, with the bits of `values`, `rates` and
     * `rounding`, in a time that hardly depends on the number of functions. NULL: only all together are known. */
    double (*alone)(void *ctx, rule_number, size_t function, double t, double *x, double *v, double *a);
    /* Writes for each function a lower bound on its size, at any time, over the box of all states that differ from x
     * and v by at most dx and dv. Not positive, or NaN: no bound is known; infinite: a cell without a rule. NULL: no
     * bounds are known. */
    void (*least)(void *ctx, double *x, double *v, double *dx, double *dv, double *out);
    /* Writes for the rate of each function a lower bound on its size over the box. */
    void (*least_rates)(void *ctx, double *x, double *v, double *dx, double *dv, double *out);
    /* Tells whether a function may have roots that the points of a step miss, because it is not a polynomial of low
     * degree. NULL: every function may. */
    bool (*may_be_narrow)(void *ctx, size_t function);
    /* The largest number of arguments that a function has for its operations that are not polynomials; 0: unknown. */
    size_t arguments;
    /* Writes argument k of function f to out[k * functions + f]; NaN where the function has fewer arguments. */
    void (*arguments_at)(void *ctx, double t, double *x, double *v, double *out);
    /* Tells whether these operations are regular while argument k goes through the range from low[k] to high[k]. Then
     * the function has no feature that is narrow beside points which resolve its arguments. */
    bool (*regular)(void *ctx, size_t function, const double *low, const double *high);
    /* Tells whether a function, or with `rate` its rate, is nowhere 0 at all times from t[0] to t[1], over the box of
     * x, v, dx and dv with accelerations of at most the sizes `most`. It takes longer than `least`, and knows functions
     * of the time and all operations. NULL: nothing is known. */
    bool (*apart)(void *ctx, size_t function, bool rate, const double t[2], const double *x, const double *v,
                  const double *dx, const double *dv, const double *most);
    /* Does to x and v what the rule says, all assignments as if at once. Nonzero: a value was not finite, number *which
     * of v or x; or, with *which unchanged, the caller's own function returned it. */
    int (*act)(void *ctx, size_t rule, size_t instance, double t, double *x, double *v, bool *in_v, size_t *which);
    /* Turns the switch of an internal rule to the side on which the motion goes on along `way`, 1 forward or -1
     * backward. Where the motion comes to rest within a time that no method resolves, it leads on to there: then t
     * grows, but not beyond `until`. */
    motus_status (*turn)(void *ctx, size_t rule, size_t instance, double way, double until, double *t, double *x,
                         double *v, motus_error *);
    /* Sets the sides of all switches at a state that did not come by motion, as at the start and after an action. NULL:
     * there are no internal rules. */
    motus_status (*settle)(void *ctx, double way, double t, double *x, double *v, motus_error *);
    /* Switches of the force that change at times which are known beforehand, and have no functions. `next` returns the
     * first such time after t along `way`, infinite if there is none. `pass` gives them their sides for the motion from
     * t on, with what follows from that, and tells how many it has changed. NULL: there are none. */
    double (*next)(void *ctx, double way, double t, double *x);
    motus_status (*pass)(void *ctx, double way, double t, double *x, double *v, int64_t *passed, motus_error *);
    /* Decides how the motion goes on where `count` switches, of these functions, turn ever faster and the state is,
     * but for rounding, where their turns accumulate; it may move the state by that rounding. MOTUS_EVENTS: it cannot
     * decide. NULL: it never can. */
    motus_status (*gather)(void *ctx, const size_t *functions, size_t count, double way, double t, double *x, double *v,
                           motus_error *);
    /* Writes the name of an instance for messages and tables: "bounce", "contact[1,2]". */
    void (*name)(void *ctx, size_t rule, size_t instance, char *out, size_t size);
} rules;

/* Tells whether the condition of an instance holds where all functions of the rules have these signs. */
bool rules_hold(const rule *, size_t instance, const int8_t *sign);

#endif
