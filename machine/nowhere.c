/* The compiled machine in a browser, where there is no compiler: replaces machine/compiled.c in the page's module.
 * Every request to compile fails, and the caller uses the interpreter.
 */
#include "machine/beside.h"
#include "machine/compiled.h"

bool compiled_anywhere(void) { return false; }

motus_status compiled_create(model *m, const problem *interpreted, compiled **out, motus_error *err)
{
    (void)m, (void)interpreted, (void)err;
    *out = NULL;
    return MOTUS_OK;
}

motus_status compiled_machine(compiled *c, const chosen *chosen, machine *out, motus_error *err)
{
    (void)c, (void)chosen, (void)out;
    return fail(err, MOTUS_TOOL, "there is no compiler here");
}

const char *compiled_prepare(compiled *c, const chosen *chosen, bool kept)
{
    (void)c, (void)chosen, (void)kept;
    return "there is no compiler here";
}

bool compiled_longer(compiled *c, const chosen *chosen)
{
    (void)c, (void)chosen;
    return false;
}

compiled_state compiled_begin(compiled *c, const chosen *chosen, const char **why)
{
    (void)c, (void)chosen;
    *why = "there is no compiler here";
    return COMPILED_FAILED;
}

compiled_state compiled_look(compiled *c, const chosen *chosen, const char **why)
{
    return compiled_begin(c, chosen, why);
}

void compiled_nap(void) {}
void beside_rest(beside *b) { (void)b; }
void compiled_leave(compiled *c, const chosen *chosen) { (void)c, (void)chosen; }
bool compiled_rules(void *ctx, ruled_number number, double t, double *const base[SPACES])
{
    (void)ctx, (void)number, (void)t, (void)base;
    return false;
}
void compiled_rebind(compiled *c) { (void)c; }
void compiled_close(compiled *c) { (void)c; }
