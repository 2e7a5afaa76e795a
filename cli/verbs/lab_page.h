/* The page of the lab as `make lab` builds it, and the place in it for the model that it opens with. */
#ifndef CLI_VERBS_LAB_PAGE_H
#define CLI_VERBS_LAB_PAGE_H

#include "cli/files/file.h"

typedef struct lab_page {
    char *path, *text;
    size_t length, place; /* bytes; the start is inserted before byte `place` */
} lab_page;

/* Reads the page named by $MOTUS_LAB_PAGE, else that beside the program, else the installed one. `program` is argv[0].
 * Call lab_page_free() also after a failure. */
motus_status lab_page_read(lab_page *, const char *program, motus_error *);
void lab_page_free(lab_page *);
/* Writes the page with a start: a fragment (cli/model/share.h) without its #, or "". */
motus_status lab_page_write(const lab_page *, const char *start, file_out *, motus_error *);

#endif
