/* See team.h. */
#include "cli/words/team.h"

#include "base/error.h"

motus_status team_failed(motus_error *err) { return fail(err, MOTUS_CANCELLED, "%s", ""); }

bool team_tells(const team *t, motus_status status, const motus_error *err)
{
    if (!t) return status != MOTUS_OK;
    const bool speaks = status && err->message[0];
    return t->largest(t->context, speaks ? t->size - t->rank : 0) == t->size - t->rank && speaks;
}
