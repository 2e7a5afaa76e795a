/* No bars of error, and so no accuracy: replaces api/bars.c and api/goal.c in the page's module, where size counts. */
#include "api/bars.h"
#include "api/choice.h"
#include "api/goal.h"

motus_status bars_prepare(motus_run *r, const motus_run_def *def, motus_error *err)
{
    (void)r;
    return def->error ? fail(err, MOTUS_UNAVAILABLE, "there are no bars of error here") : MOTUS_OK;
}

motus_status bars_room(motus_run *r, int64_t *steps, motus_error *err)
{
    (void)r, (void)err;
    *steps = INT64_MAX;
    return MOTUS_OK;
}

void bars_leg(motus_run *r) { (void)r; }
void bars_give_up(motus_run *r, const char *format, ...) { (void)r, (void)format; }
motus_status bars_compile(motus_run *r, motus_error *err) { return (void)r, (void)err, MOTUS_OK; }
void bars_move(motus_run *r) { (void)r; }
void bars_destroy(motus_run *r) { (void)r; }

motus_status goal_reach(motus_system *s, motus_run_def *def, run_hint *hint, struct goal **goal, motus_error *err)
{
    (void)s, (void)hint, (void)goal;
    if (!(def->accuracy > 0) && !choice_is_auto(def->method)) return MOTUS_OK;
    return fail(err, MOTUS_UNAVAILABLE, "no method is chosen here by an accuracy");
}

bool goal_arrive(motus_run *r, int64_t n) { return (void)r, (void)n, false; }
motus_status goal_judge(const motus_run *r, motus_error *err) { return (void)r, (void)err, MOTUS_OK; }
void goal_statistics(const motus_run *r, motus_statistics *out) { (void)r, (void)out; }
void goal_destroy(const motus_system *s, struct goal *g) { (void)s, (void)g; }
