/* The command line, read once into one struct, and the table of options, by which it is read. */
#ifndef CLI_WORDS_OPTIONS_H
#define CLI_WORDS_OPTIONS_H

#include "cli/words/team.h"
#include "motus.h"

#include <stdbool.h>
#include <stdio.h>

/* Verbs are bits, since an option can have several: VERB_RUN, VERB_SWEEP … */
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
    char *text; /* the memory of the items; NULL: the list does not own it */
} options_list;

/* The kinds of values; TYPE_… are their types in C. A value that is not given is 0, or NaN if its kind says so. */
typedef enum option_kind {
    FLAG,
    WORD,
    CHOICE,     /* one of option.choices */
    NUMBER,     /* NaN if not given */
    POSITIVE,   /* a number above 0; NaN if not given */
    LENGTH,     /* a number above 0; 0 if not given */
    TOLERANCE,  /* as POSITIVE; sets options.absolute too */
    ACCURACIES, /* two numbers as POSITIVE; sets options.absolute too */
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
    double time; /* of the motion, or seconds; 0: the period is counted in steps */
    int64_t steps;
} options_period;

/* What an option sets. An archive decides OF_MOTION and OF_ROWS; the command that reads or continues it decides the
 * others. */
enum {
    OF_MOTION = 1,   /* the numbers of the rows: part of the fingerprint, and of the command in a file */
    OF_ROWS = 2,     /* which rows are computed: part of the command in a file */
    OF_FILES = 4,    /* what is written or printed, and where */
    OF_MACHINE = 8,  /* what computes; no number changes */
    OF_ANOTHER = 16, /* the command does something other than compute the motion */
    OF_WHATEVER = OF_FILES | OF_MACHINE | OF_ANOTHER
};

/* How a setting of the motion enters the fingerprint of a sweep. New options are PRINT_NAMED; the other kinds remain
 * because files with such fingerprints exist. */
typedef enum option_print {
    PRINT_NAMED,    /* with its name, if it has a value */
    PRINT_GIVEN,    /* if it has a value */
    PRINT_ADAPTIVE, /* if the steps are adaptive */
    PRINT_ALWAYS,
    PRINT_ELSEWHERE /* not as an option: other code mixes it in */
} option_print;

/* What an option needs with these verbs: one of the options, whose names are separated by blanks. */
typedef struct option_needs {
    unsigned verbs;
    const char *options;
} option_needs;

enum { OPTION_NEEDS = 2 };

typedef struct option {
    option_kind kind;
    size_t place, size; /* of its member in struct options */
    const char *name, *argument;
    unsigned verbs, setting;
    const char *help; /* with code in backquotes */
    const char *brief;
    const char *choices; /* words for the value, separated by blanks */
    const char *more;    /* follows the help in the manual, and nowhere else */
    option_needs needs[OPTION_NEEDS];
    const char *excludes; /* names of options, separated by blanks */
    option_print print;
    bool late; /* comes after the other options in the fingerprint */
    char link; /* its key in a link to the lab; 0: links do not have it */
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
    const char *text;    /* of the model; NULL: read it from the operand */
    options_list files;  /* the operands of `merge` */
#define OPTION(kind, member, ...) TYPE_##kind member;
#include "cli/words/options.def"
    const char *given[OPTION_COUNT]; /* the text of the value; NULL: the option is not given */
    bool absolute;                   /* tolerance or accuracies are in the units of the numbers */
    const team *team;                /* NULL: the program is alone */
    bool *answered;                  /* set by a verb that has written its JSON object; an error then writes none */
    int argc;
    char **argv; /* the command line, for the header of files */
} options;

/* Reads argv, which begins with the program's name, from the verb's first argument on. */
motus_status options_read(options *, unsigned verb, int argc, char **argv, int first, motus_error *);
/* Fails if options do not go together (options_check.c). The command in a file has been checked, and lacks those that
 * say where its results go. */
motus_status options_check(const options *, motus_error *);
void options_free(options *);
const option *options_row(size_t k); /* k < OPTION_COUNT */
/* Copies a text of a row without its backquotes. Returns out. */
enum { OPTIONS_HELP = 320 };
const char *options_plain(const char *help, char out[OPTIONS_HELP]);
void options_hint(const option *, motus_error *); /* makes the argument and the help of a row the hint */
/* Reads the value of row k (options_value.c). */
motus_status options_value(options *, size_t k, const char *value, motus_error *);
/* Returns whether an option has a value, given or settled. */
bool options_has(const options *, const option *);
/* Makes the options with these settings as if they were not given. */
void options_forget(options *, unsigned settings);
/* Copies the options with these settings; their lists still belong to `from`. */
void options_take(options *, const options *from, unsigned settings);
const char *options_verb(unsigned verb);
/* Returns whether a verb has an option --name. */
bool options_known(const char *name, size_t length);
motus_switches options_switches(const options *);
motus_bars options_bars(const options *);

/* Print the text of --help. */
void help_program(FILE *);
void help_verb(FILE *, unsigned verb);
/* Prints the table of verbs and options for programs: lines with tabs between the cells, and - for an empty cell.
 *     verb, name, operands, what it does
 *     option, --name, -n, argument, verbs, setting, choices, help, more */
void help_table(FILE *);

/* The verbs: run_verb, sweep_verb … */
#define VERB(bit, name, ...) motus_status name##_verb(const options *, motus_error *);
#include "cli/words/options.def"

#endif
