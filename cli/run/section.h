/* The points of --section in a plane. */
#ifndef CLI_RUN_SECTION_H
#define CLI_RUN_SECTION_H

#include "cli/files/file.h"
#include "cli/model/load.h"

/* Chooses the plane before the run: that of --plot-of; else, of a model of one number its motion, of two numbers that
 * of the one that the section does not name, each against its velocity. */
motus_status section_plane(const load *, const options *, size_t columns[2], motus_error *);
/* Draws the points of a run at its end. Fails where there are none. */
motus_status section_draw(const load *, const options *, motus_run *, const size_t columns[2], file_out *,
                          motus_error *);

#endif
