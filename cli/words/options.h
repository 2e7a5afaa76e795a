/* The command line, read once into one struct, and the table of options that it is read by. */
#ifndef CLI_WORDS_OPTIONS_H
#define CLI_WORDS_OPTIONS_H

#include "cli/words/team.h"
#include "motus.h"

#include <stdbool.h>
#include <stdio.h>

/* Verbs, as bits, so that an option can have several: VERB_RUN, VERB_SWEEP … */
enum {
#define VERB(bit, ...) VERB_NUMBER_##bit,
#include "cli/words/options.def"
    VERB_COUNT
};
enum {
#define VERB(bit, ...) VERB_##bit = 1 << VERB_NUMBER_##bit,
#include "cli/words/options.def"
    VERB_ALL = (1 << VERB_COUNT) - 1
};

typedef struct options_list {
    const char **items;
    size_t count;
    char *text; /* the memory of the items; NULL: they lie elsewhere */
} options_list;

/* What a value is, and its type in C; where none is given it is 0, and NaN where the type says so. */
typedef enum option_kind {
    FLAG,
    WORD,
    CHOICE,     /* one of option.choices */
    NUMBER,     /* NaN */
    POSITIVE,   /* likewise */
    LENGTH,     /* a number above 0 */
    TOLERANCE,  /* NaN; with options.absolute */
    ACCURACIES, /* coarsest NaN; likewise */
    COUNT,
    SEED,
    EVERY,
    STATES,
    NAMES, /* A,B,C */
    NAMED, /* P=…, repeated */
    TEXTS  /* repeated */
} option_kind;
#define TYPE_FLAG bool
#define TYPE_WORD const char *
#define TYPE_CHOICE const char *
#define TYPE_NUMBER double
#define TYPE_POSITIVE double
#define TYPE_LENGTH double
#define TYPE_TOLERANCE double
#define TYPE_ACCURACIES options_range
#define TYPE_COUNT int64_t
#define TYPE_SEED uint64_t
#define TYPE_EVERY options_period
#define TYPE_STATES options_period
#define TYPE_NAMES options_list
#define TYPE_NAMED options_list
#define TYPE_TEXTS options_list
typedef struct options_range {
    double coarsest, finest;
} options_range;
typedef struct options_period {
    double time; /* of the motion, or seconds; 0: it is counted in steps */
    int64_t steps;
} options_period;

/* Of what an option is a setting. An archive says those of the motion and of its rows; the others are those of the
 * command that reads it or goes on with it. */
enum {
    OF_MOTION = 1,   /* the numbers of the rows change: the fingerprint does, and the command in a file says it */
    OF_ROWS = 2,     /* which of the rows are computed: the command in a file says it */
    OF_FILES = 4,    /* what is written or printed, and where */
    OF_MACHINE = 8,  /* what computes: no number changes */
    OF_ANOTHER = 16, /* something else is done than to compute the motion */
    OF_WHATEVER = OF_FILES | OF_MACHINE | OF_ANOTHER
};

/* How a setting of the motion enters the fingerprint of a sweep; the others are part of files that exist. */
typedef enum option_print {
    PRINT_NAMED,    /* where it is given, with its name: so does every new one */
    PRINT_GIVEN,    /* where it is given */
    PRINT_ADAPTIVE, /* where the steps adapt */
    PRINT_ALWAYS,
    PRINT_ELSEWHERE /* with another option */
} option_print;

typedef struct option {
    option_kind kind;
    size_t place, size; /* in struct options */
    const char *name, *argument;
    unsigned verbs, setting;
    const char *help; /* code in backquotes */
    const char *brief;
    const char *choices; /* words for the value, with blanks between them */
    const char *more;    /* behind the help, in the manual alone */
    option_print print;
    bool late; /* in the fingerprint behind the others */
    char link; /* its key in a link to the lab; 0: a link has it not */
} option;

/* The numbers of the rows: OPTION_method … */
enum {
#define OPTION(kind, member, ...) OPTION_##member,
#define OPTION_AGAIN(kind, member, ...) OPTION_AGAIN_##member,
#include "cli/words/options.def"
    OPTION_COUNT
};

typedef struct options {
    unsigned verb;
    const char *operand; /* the model, or the method of `methods`; NULL: none */
    const char *text;    /* the model's, where it is not read from the operand; else NULL */
    options_list files;  /* the operands of `merge` */
#define OPTION(kind, member, ...) TYPE_##kind member;
#include "cli/words/options.def"
    const char *given[OPTION_COUNT]; /* the text of the value; NULL: the option is not given */
    bool absolute;                   /* tolerance or accuracies are in the units of the numbers */
    const team *team;                /* NULL: the program is alone */
    bool *answered; /* where a verb notes that its JSON object is written: a failure after that is no second one */
    int argc;
    char **argv; /* the command line, for the header of files */
} options;

/* argv from the program's name on; `first` is where the verb's own arguments begin. */
motus_status options_read(options *, unsigned verb, int argc, char **argv, int first, motus_error *);
void options_free(options *);
const option *options_row(size_t k); /* k < OPTION_COUNT */
/* The help of a row, or more, without its backquotes. Returns out. */
enum { OPTIONS_HELP = 320 };
const char *options_plain(const char *help, char out[OPTIONS_HELP]);
void options_hint(const option *, motus_error *); /* hints at the argument and the help of a row */
/* options_value.c: reads the value of the row k. */
motus_status options_value(options *, size_t k, const char *value, motus_error *);
/* Whether a row has a value, also one that was not given. */
bool options_has(const options *, const option *);
/* Options of these settings are as if they were not given; or they are those of others, which keep their lists. */
void options_forget(options *, unsigned settings);
void options_take(options *, const options *from, unsigned settings);
const char *options_verb(unsigned verb);
/* Whether there is an option --name, of any verb. */
bool options_known(const char *name, size_t length);
/* What --switches and --error ask for. */
motus_switches options_switches(const options *);
motus_bars options_bars(const options *);

/* The text of --help. */
void help_program(FILE *);
void help_verb(FILE *, unsigned verb);
/* The table of verbs and options, for programs, a row a line, with tabs between:
 *     verb, name, operands, what it does
 *     option, --name, -n, argument, verbs, of what it is a setting, words for its value, help, more; - for nothing */
void help_table(FILE *);

/* The verbs: run_verb, sweep_verb … */
#define VERB(bit, name, ...) motus_status name##_verb(const options *, motus_error *);
#include "cli/words/options.def"

#endif
