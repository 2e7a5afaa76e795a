/* gnuplot as a child process: it reads a script, and its picture is written to a file. */
#ifndef CLI_DRAW_GNUPLOT_H
#define CLI_DRAW_GNUPLOT_H

#include "cli/files/file.h"

typedef struct gnuplot {
    FILE *script;     /* write the script here */
    FILE *complaints; /* gnuplot's standard error */
} gnuplot;

/* TOOL, with the command that installs it, if there is no gnuplot. */
motus_status gnuplot_check(motus_error *);
motus_status gnuplot_open(gnuplot *, motus_error *);
/* Runs the script; the picture goes to the file. TOOL, with gnuplot's first message, if it failed. */
motus_status gnuplot_draw(gnuplot *, file_out *picture, motus_error *);
void gnuplot_close(gnuplot *);

#endif
