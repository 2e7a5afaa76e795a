/* Stands in for api/later.c in the page's module, which has no compiler: every run stays with the interpreter. */
#include "api/choice.h"
#include "api/later.h"

motus_status later_choose(motus_run *r, const char *wanted, double steps, motus_error *err)
{
    bool automatic, compiled;
    (void)steps;
    r->machine = r->system->machine;
    r->note = "";
    r->compiled_from = -1;
    return choice_machine(wanted, &automatic, &compiled, err);
}

int64_t later_room(const motus_run *r) { return (void)r, INT64_MAX; }
motus_status later_look(motus_run *r, motus_error *err) { return (void)r, (void)err, MOTUS_OK; }
void later_hurry(motus_run *r) { (void)r; }
void later_end(motus_run *r) { (void)r; }
const char *motus_run_note(const motus_run *r) { return r ? r->note : ""; }
