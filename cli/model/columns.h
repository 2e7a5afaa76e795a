/* Columns of files as lists of the model: --set "A=@quake.csv:2". */
#ifndef CLI_MODEL_COLUMNS_H
#define CLI_MODEL_COLUMNS_H

#include "cli/files/column.h"
#include "cli/words/options.h"

typedef struct columns_list {
    char *text, *path; /* the setting with the numbers written out; the file */
    column of;
} columns_list;
typedef struct columns {
    columns_list *list;
    size_t count;
} columns;

/* Puts the numbers of files into the settings of --set, so that files, links and archives have them. Call
 * columns_free() also after a failure, when the options are needed no longer. */
motus_status columns_set(columns *, options *, motus_error *);
/* Says in the hint of an error in which line of a file a number stands that the error names. */
void columns_tell(const columns *, motus_error *);
void columns_free(columns *);

#endif
