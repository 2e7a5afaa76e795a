/* What the studies share: they load a model, study it, and show the result. */
#ifndef CLI_STUDY_STUDIES_H
#define CLI_STUDY_STUDIES_H

#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/model/load.h"
#include "cli/model/settle.h"
#include "cli/words/options.h"

typedef struct studies {
    const options *options;
    load model;
    motus_study_def def; /* as studies_begin fills it */
    stop_progress progress;
} studies;

/* Loads the model and fills the definition; `steps` says whether the study needs a step. Progress is shown under the
 * name `what` until stop_progress_end(). */
motus_status studies_begin(studies *, const char *what, bool steps, const options *, motus_study_def *, motus_error *);

/* Prints the first line of the tables: the model and the reference. */
void studies_title(const studies *, const char *reference, double error);

/* Prints a note on a method, and above the first one an empty line. */
void studies_note(const char *method, const char *note, bool *first);

typedef struct studies_ways {
    motus_status (*draw)(studies *, const void *result, file_out *, motus_error *);
    void (*tell)(json *, const void *result); /* writes the keys of the result, after those of the model */
    motus_status (*tables)(const studies *, const void *result, motus_error *);
} studies_ways;

/* Draws the picture, and then prints JSON or tables, so that nothing is printed if the picture fails. The picture gets
 * its name last. */
motus_status studies_show(studies *, const studies_ways *, const void *result, motus_error *);

/* choose.c: which methods tables and figures show. */
enum { CHOOSE_MOST = 12 };
typedef struct choose_row {
    const char *method;
    double merit; /* the smaller the better; not finite: the method is shown only if all are */
    double work;  /* of equal ones the smaller is better */
    bool must, shown;
} choose_row;
/* Sets `shown`; returns how many are: in a table all of them with --all, or where --methods names them; in a picture at
 * most CHOOSE_MOST. */
size_t choose_methods(choose_row *, size_t count, const studies *, bool picture);
/* Prints a note how many methods a picture shows, unless it shows all. */
void choose_note(size_t drawn, size_t count, const studies *);
/* Returns what the error would be with the work `most`, by the order, but at least `least`: round-off has no order. */
double choose_merit(double error, double least, double work, double most, int order);
/* Prints below a table how many methods are shown, unless all are. */
void choose_tell(size_t shown, size_t count, const char *measure);

/* Draws the figure of a comparison, of the `shown` methods: the motion by each, over the exact
 * motion, and below it the errors (overlay.c). */
motus_status overlay_draw(const studies *, const motus_comparison *, const choose_row *shown, file_out *,
                          stop_progress *, motus_error *);

/* Does motus compare --accuracies (rank.c). */
motus_status rank_verb(const options *, motus_error *);

#endif
