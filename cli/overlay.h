/* The figure of a comparison: the motion by each method, over the exact one. */
#ifndef CLI_OVERLAY_H
#define CLI_OVERLAY_H

#include "cli/load.h"
#include "cli/plot.h"
#include "cli/stop.h"

motus_status overlay_draw(const load *, const motus_comparison *, const options *, file_out *, stop_progress *,
                          motus_error *);

#endif
