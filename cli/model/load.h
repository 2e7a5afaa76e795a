/* The model that a command names: its text, and its system. */
#ifndef CLI_MODEL_LOAD_H
#define CLI_MODEL_LOAD_H

#include "cli/model/defined.h"
#include "cli/words/options.h"

#define LOAD_SECTION "section" /* the name of the event of --section */

typedef struct load {
    char *text;
    motus_system *system;
    size_t positions, velocities;  /* columns: t, then these, then quantities, invariants, exact */
    size_t quantities, invariants; /* their numbers, not their names */
    double step, until;            /* by settle.c: of the options, or suggested; NaN: the model's */
    int suggested;                 /* which of them: SETTLE_STEP | SETTLE_UNTIL */
    defined defined;               /* quantities that --record adds */
    char title[MOTUS_NAME_MAX];    /* file name without folder and ending, safe to show */
} load;

/* Reads the model of the options with their --set; call load_free() also after a failure. */
motus_status load_model(load *, const options *, motus_error *);
void load_free(load *);

/* Makes an error at one byte of a text; `path` as a command names it, - is standard input. Returns MOTUS_SYNTAX. */
motus_status load_complain(const char *text, const char *at, const char *path, const char *what, motus_error *);

/* motus_quantity_name or motus_invariant_name. */
typedef const char *load_naming(const motus_system *, size_t k, size_t *numbers);
/* First column of the quantities and of the invariants. */
size_t load_quantity_column(const load *);
size_t load_invariant_column(const load *);
/* The end, once it is settled. NaN: none. */
double load_until(const load *);

#endif
