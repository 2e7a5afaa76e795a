/* The command line, read once into one struct. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "cli/team.h"
#include "motus.h"

#include <stdbool.h>
#include <stdio.h>

/* Verbs, as bits, so that an option can have several. */
enum {
    VERB_RUN = 1,
    VERB_COMPARE = 2,
    VERB_CONVERGE = 4,
    VERB_CHECK = 8,
    VERB_METHODS = 16,
    VERB_CACHE = 32,
    VERB_SWEEP = 64,
    VERB_LAB = 128,
    VERB_MERGE = 256,
    VERB_ARCHIVE = 512
};

typedef struct options_list {
    const char **items;
    size_t count;
} options_list;

typedef struct options {
    unsigned verb;
    const char *operand; /* the model, or the method of `methods`; NULL: none */
    const char *text;    /* the model's, where it is not read from the operand; else NULL */
    options_list files;  /* the operands of `merge` */
    const char *method, *error, *switches, *output, *columns, *events, *section, *plot, *plot_of, *save_state;
    const char *restart, *machine, *shard, *verify;
    double step, until;                   /* NaN: the model's */
    double tolerance, accuracy;           /* NaN: the model's */
    double coarsest, finest;              /* accuracies to compare at; NaN: not given */
    bool absolute;                        /* tolerance or accuracies are in the units of the numbers */
    double shortest_step, longest_step;   /* 0: not given */
    int64_t most_steps;                   /* likewise */
    const char *step_typed, *until_typed; /* as given; NULL: the model's */
    double every_time;                    /* 0: not given */
    int64_t every_steps;                  /* 0: not given */
    double keep_seconds;                  /* between two states of a run; 0: not given */
    int64_t keep_steps;                   /* likewise */
    int64_t evaluations, threads;         /* 0: not given */
    int64_t skip, most_points;            /* of the section; 0: not given */
    options_list set, when, methods;
    options_list vary, random; /* "P=…" as given */
    const char *record;
    int64_t count, lanes; /* 0: not given */
    uint64_t seed;
    bool seeded; /* a seed was given */
    bool zip, fast, resume, force, plan, partial, compress;
    char *methods_text; /* the items of `methods` point into it */
    bool errors, json, quiet, help, markdown, points, emit_c, clear, share, no_open;
    const team *team; /* NULL: the program is alone */
    bool *answered;   /* where a verb notes that its JSON object is written: a failure after that is no second one */
    int argc;
    char **argv; /* the command line, for the header of files */
} options;

/* argv from the program's name on; `first` is where the verb's own arguments begin. */
motus_status options_read(options *, unsigned verb, int argc, char **argv, int first, motus_error *);
void options_free(options *);
const char *options_verb(unsigned verb);
/* Whether there is an option --name, of any verb. */
bool options_known(const char *name, size_t length);
/* What --switches asks for. */
motus_switches options_switches(const options *);
/* The lines of --help for the options of a verb. */
void options_help(FILE *, unsigned verb);
/* Splits "x,r.x,u[1,2]" at the commas outside brackets. The items point into *copy; the caller frees both. */
motus_status options_split(const char *text, const char *option, char **copy, options_list *, motus_error *);

#endif
