/* The compiled machine where there is no compiler: in a browser. It stands in for machine/compiled.c (and all that it needs) in the page's module;
 * whoever asks for machine code is told, and the interpreter serves.
 */
#include "machine/compiled.h"

const machine machine_compiled = {.name = "compiled"};

motus_status compiled_create(model *m, const problem *interpreted, compiled **out, problem *problem, motus_error *err)
{
    (void)m, (void)err;
    *out = NULL;
    *problem = *interpreted;
    return MOTUS_OK;
}

const char *compiled_prepare(compiled *c, const chosen *chosen, bool kept)
{
    (void)c, (void)chosen, (void)kept;
    return "there is no compiler here";
}

void compiled_close(compiled *c) { (void)c; }
