/* The model that a command names: its text, and its system. */
#ifndef CLI_MODEL_LOAD_H
#define CLI_MODEL_LOAD_H

#include "cli/words/options.h"

/* Quantities that --record adds to a model, for its events: count(bounce), time(bounce, last), at(bounce, 3, x'). Each
 * has a name that the model's text does not contain; results show the item of --record in its place. */
typedef struct defined {
    char **line; /* "recorded1 = count(bounce)" */
    size_t count;
} defined;

/* Finds the quantities for a list of --record, which may be NULL. Call defined_free() also after a failure. */
motus_status defined_find(defined *, const char *list, const char *text, motus_error *);
void defined_free(defined *);
/* Returns the name of the quantity for an item, with its length in *length; NULL: the item is not such a quantity. */
const char *defined_name(const defined *, const char *item, size_t *length);
/* Returns the item for a column that is such a quantity, or a component of one; *rest follows the name in the column.
 * NULL: the column is none of them. */
const char *defined_label(const defined *, const char *column, const char **rest);

#define LOAD_SECTION "section" /* the name of the event of --section */

typedef struct load {
    char *text;
    motus_system *system;
    size_t positions, velocities;  /* columns: the time, then these, then quantities, invariants, the exact motion */
    size_t quantities, invariants; /* how many numbers they have */
    motus_settings set;            /* set by settle.c: what the command asks of the model, and who says it */
    defined defined;               /* quantities that --record adds */
    char time[2 * MOTUS_NAME_MAX]; /* the name of the time, column 0 */
    char title[MOTUS_NAME_MAX];    /* the file's name without folder and ending, safe to print */
} load;

/* Reads the model of the options, with their --set, --when and --record. Call load_free() also after a failure. */
motus_status load_model(load *, const options *, motus_error *);
void load_free(load *);

/* Makes an error at one byte of the text of a file; "-" is standard input. Returns MOTUS_SYNTAX. */
motus_status load_complain(const char *text, const char *at, const char *path, const char *what, motus_error *);

/* motus_quantity_name or motus_invariant_name. */
typedef const char *load_naming(const motus_system *, size_t k, size_t *numbers);
/* Return the first column of the quantities, and of the invariants. */
size_t load_quantity_column(const load *);
size_t load_invariant_column(const load *);

/* Returns whether an item of --set names a component (components.c): "r.x(0)=5", "r'.y(0)=1", "r[3].x(0)=2",
 * "g.x=9.81". The text of a model gives a vector as a whole, so the library's `set` does not accept components. */
bool components_are(const char *item);
/* Sets the items that name components, in a system that was read with the other items. */
motus_status components_set(motus_system *, const options_list *set, motus_error *);

/* Returns the comment on the line of the model's text that gives a column its value, for example its unit: "k = 2
 * # N/m" (comments.c). For a state, it is the line of its initial value. The column is named as in archives: "k",
 * "x'", "r.x(0)", "max(energy)", "x[3].error". The caller frees the comment. NULL: there is none, or no memory. */
char *comments_find(const char *model, const char *column);
/* Returns the comment on a line that begins with a word, "until" or "step"; as above. */
char *comments_setting(const char *model, const char *word);

/* units.c: units in comments. */
enum { UNIT_MAX = 48 };
/* Reads the unit that a comment begins with, or that ends it, "in kg". *alone: no words follow it. */
bool units_read(const char *comment, char out[UNIT_MAX], bool *alone);
/* Writes the unit of a column or parameter of the model, of the `time` that of its step or end; "": it has none. */
void units_of(const char *model, const char *name, bool time, char out[UNIT_MAX]);
/* Writes the name with its unit, "x (m)". */
void units_label(const char *model, const char *name, bool time, char *out, size_t size);

#endif
