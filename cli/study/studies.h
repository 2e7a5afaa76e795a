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

/* Draws the figure of a comparison: the motion by each method, over the exact motion (overlay.c). */
motus_status overlay_draw(const load *, const motus_comparison *, const options *, file_out *, stop_progress *,
                          motus_error *);

/* Does motus compare --accuracies (rank.c). */
motus_status rank_verb(const options *, motus_error *);

#endif
