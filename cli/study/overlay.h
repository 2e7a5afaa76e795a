/* The figure of a comparison: the motion by each method, over the exact one. */
#ifndef CLI_STUDY_OVERLAY_H
#define CLI_STUDY_OVERLAY_H

#include "cli/model/load.h"
#include "cli/draw/plot.h"
#include "cli/files/stop.h"

motus_status overlay_draw(const load *, const motus_comparison *, const options *, file_out *, stop_progress *,
                          motus_error *);

#endif
