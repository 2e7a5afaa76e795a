/* The model that a command names: its text, and its system. */
#ifndef CLI_MODEL_LOAD_H
#define CLI_MODEL_LOAD_H

#include "cli/words/options.h"

/* Quantities that --record adds to a model: what its events keep, count(bounce), time(bounce, last), at(bounce, 3, x').
 * Each has a name that the model's text does not contain, and is told by what was asked for. */
typedef struct defined {
    char **line; /* "recorded1 = count(bounce)" */
    size_t count;
} defined;

/* Those of a list of --record, NULL: none. Call defined_free() also after a failure. */
motus_status defined_find(defined *, const char *list, const char *text, motus_error *);
void defined_free(defined *);
/* The name of the quantity for an item, of `length` bytes in *length; NULL: it is none. */
const char *defined_name(const defined *, const char *item, size_t *length);
/* What was asked for, where `column` is such a quantity or a component of it; *rest: what follows the name in it. */
const char *defined_label(const defined *, const char *column, const char **rest);

#define LOAD_SECTION "section" /* the name of the event of --section */

typedef struct load {
    char *text;
    motus_system *system;
    size_t positions, velocities;  /* columns: t, then these, then quantities, invariants, exact */
    size_t quantities, invariants; /* their numbers, not their names */
    motus_settings set;            /* by settle.c: what the command asks of the model, and who says it */
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

/* components.c: whether an item of --set names a component, "r.x(0)=5", "r'.y(0)=1", "r[3].x(0)=2", "g.x=9.81". The
 * text of a model gives a vector as a whole, so the library's `set` does not take one. */
bool components_are(const char *item);
/* Sets those items that name one, in a system that was read with the others. */
motus_status components_set(motus_system *, const options_list *set, motus_error *);

/* comments.c: what the comments of a model say of its numbers, their units for one: "k = 2   # N/m". The comment
 * behind the line of the model's text that gives a column its value: of a parameter or a quantity its own, of a state
 * that of its initial value; to be freed. The column as archives name it: "k", "x'", "r.x(0)", "max(energy)",
 * "x[3].error". NULL: there is none, or no memory. */
char *comments_find(const char *model, const char *column);

#endif
