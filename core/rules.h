/* Rules: what is to happen at which instants of a motion. The engine of events (core/events.h) shares this with the
 * models and callbacks that supply rules.
 *
 * A rule watches functions g of the time and the state. It has `leaves` functions for each of its instances: a family
 * of rules (`for i = 1..N`) has an instance for each of its cells, numbered as the cells of an array over the hull of
 * its indices; a cell that has no rule has NaN for its functions. The function of leaf l and instance i is number
 * first + l * instances + i.
 *
 * RULE_ROOT, `when a = b`: one leaf, a - b. It happens where the function passes 0, in one direction or in both, and
 * where it touches 0 (both directions only).
 * RULE_CONDITION, `when x > 1 and y < 2`: a leaf for each comparison: a - b for a > b, a >= b, a == b and a != b,
 * b - a for a < b and a <= b; `compares` says what it asks of the leaf. It happens where the formula becomes true. A
 * leaf == on its way through 0 holds for that instant, so `x == 0 and y > 0` happens there.
 * RULE_CLOCK, `when every T`: no leaves and one instance; it happens at start + T, start + 2 T and so on.
 * RULE_ACCUMULATES, `when NAME accumulates`: no leaves; it happens where the events of rule `of` accumulate. It has one
 * instance, or those of rule `of`, each for one of them.
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

/* What a comparison asks of its leaf g; they differ where g stays 0, as it may for modes. */
typedef enum rule_comparison { RULE_ABOVE /* g > 0 */, RULE_AT_LEAST /* g >= 0 */, RULE_AT, RULE_OFF } rule_comparison;

enum {
    RULE_AND = -1, /* in the formula of a condition, in postfix order, beside numbers of leaves >= 0 */
    RULE_OR = -2,
    RULE_NOT = -3,
    RULE_FORMULA_MOST = 128,      /* words of a formula */
    RULES_MOST = 4096,            /* rules of a model */
    RULE_ARGUMENTS_MOST = 8,      /* of operations that are no polynomials, of one function */
    RULE_FUNCTIONS_MOST = 1 << 20 /* functions of all rules, instances counted */
};

typedef struct rule {
    const char *name; /* as NAME, or event1, event2, … */
    rule_kind kind;
    int direction; /* of RULE_ROOT: 1 rising, -1 falling, 0 both */
    size_t first;  /* number of its first function */
    size_t leaves, instances;
    const int16_t *formula; /* of RULE_CONDITION, `words` of them */
    int words;
    const uint8_t *compares; /* of RULE_CONDITION: rule_comparison of every leaf */
    double period;           /* of RULE_CLOCK: positive */
    size_t of;               /* of RULE_ACCUMULATES: number of a rule */
    bool records;            /* it has a row in the table of events */
    bool assigns;            /* act changes numbers on which the motion or a rule depends: it ends the step */
    bool keeps;              /* act changes only numbers that observers alone read: it ends no step */
    bool smooth;             /* its functions are known to have neither jumps nor kinks */
    const char *jump;        /* an operation of its functions that may jump, as text: "floor(x)"; NULL: there is none */
    int64_t stop;            /* the run ends at this event of the rule: 1 `stop`, N `stop after N`, 0 never */
    /* Of RULE_ROOT, falling: a switch of the force changes its side, which no table tells. It assigns; it is not an
     * event of the model, and so many of them at once as there are switches are no error. */
    bool internal;
} rule;

typedef enum rule_number { RULE_VALUE, RULE_RATE, RULE_ROUNDING, RULE_NUMBERS } rule_number;

typedef struct rules {
    void *ctx;
    const rule *rule;
    size_t count;
    size_t functions;   /* of all rules */
    const size_t *kept; /* places in x that `keeps` rules change */
    size_t kept_count;
    const size_t *rounded; /* places in x of modes that rounding of their assignments can change */
    size_t rounded_count;
    /* The functions at a state, whose driven boundary cells are refreshed: `functions` numbers. Other than 0: the
     * caller's own function failed. */
    int (*values)(void *ctx, double t, double *x, double *v, double *out);
    /* Their rates along the motion, dg/dt + (dg/dx) v + (dg/dv) a; a: the acceleration at the state. */
    int (*rates)(void *ctx, double t, double *x, double *v, double *a, double *out);
    bool rates_without_a; /* they do not read it, and it need not be computed */
    /* A bound on how far rounding may have carried each of these values, those of t and the state counted as half a
     * unit in the last place each. NULL: no formula is known. */
    void (*rounding)(void *ctx, double t, double *x, double *v, double *out);
    /* What these three give of one function alone, with the same bits, in a time that the number of functions hardly
     * enters; NULL: only all together are known. */
    double (*alone)(void *ctx, rule_number, size_t function, double t, double *x, double *v, double *a);
    /* Of each function a number that its size nowhere falls below, at any time and at all states whose numbers are no
     * farther from x and v than dx and dv; not positive, or no number: none is known; infinite of a cell
     * without a rule. NULL: of none. */
    void (*least)(void *ctx, double *x, double *v, double *dx, double *dv, double *out);
    void (*least_rates)(void *ctx, double *x, double *v, double *dx, double *dv,
                        double *out); /* the same of the rates */
    /* Whether a function may have roots that the points of a step miss, being no polynomial of low degree; NULL: each
     * may. */
    bool (*may_be_narrow)(void *ctx, size_t function);
    /* Arguments of the operations of a function that are no polynomials. Where these are regular while the arguments go
     * through ranges, argument k from low[k] to high[k], the function has no feature that is narrow beside points which
     * resolve the arguments. Argument k of function f is out[k * functions + f]; of a function that has fewer it is no
     * number. `arguments` is their largest number of a function, 0: none is known. */
    size_t arguments;
    void (*arguments_at)(void *ctx, double t, double *x, double *v, double *out);
    bool (*regular)(void *ctx, size_t function, const double *low, const double *high);
    /* Whether a function, or with `rate` its rate, is nowhere 0 at all times from t[0] to t[1], at all such states with
     * accelerations of at most these sizes. It takes more than `least`, and tells of functions of the time and of any
     * operation. NULL: it is known of none. */
    bool (*apart)(void *ctx, size_t function, bool rate, const double t[2], const double *x, const double *v,
                  const double *dx, const double *dv, const double *most);
    /* What the rule does to x and v, as if at once. Other than 0: a value was not finite, and `which` of `in_v` says
     * where; or, with `which` unchanged, the caller's own function returned it. */
    int (*act)(void *ctx, size_t rule, size_t instance, double t, double *x, double *v, bool *in_v, size_t *which);
    /* Where there are internal rules. What one does: the side on which the motion goes on along `way`, 1 forward or -1
     * backward; and the sides of a state that did not come by motion, as at the start and after another rule acted.
     * A turn may lead on to where the motion comes to rest, within a time that no method resolves: then t grows, but
     * not beyond `until`. */
    motus_status (*turn)(void *ctx, size_t rule, size_t instance, double way, double until, double *t, double *x,
                         double *v, motus_error *);
    motus_status (*settle)(void *ctx, double way, double t, double *x, double *v, motus_error *);
    /* Internal rules of these functions, `count` of them, follow one another ever faster, and the state is where they
     * accumulate, but for rounding: how the motion goes on, which may change by that. MOTUS_EVENTS: that is not known.
     * NULL: it never is. */
    motus_status (*gather)(void *ctx, const size_t *functions, size_t count, double way, double t, double *x, double *v,
                           motus_error *);
    /* Text of an instance for messages and tables: "bounce", "contact[1,2]". */
    void (*name)(void *ctx, size_t rule, size_t instance, char *out, size_t size);
} rules;

/* Whether the condition of an instance holds where all functions of the rules have these signs. */
bool rules_hold(const rule *, size_t instance, const int8_t *sign);

#endif
