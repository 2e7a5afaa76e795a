/* See team.h. */
#include "cli/team.h"

#include "base/error.h"

motus_status team_agree(const team *t, motus_status status, motus_error *err)
{
    if (!t || t->size == 1) return status;
    const bool failed = t->largest(t->context, status != MOTUS_OK);
    return status || !failed ? status : fail(err, MOTUS_CANCELLED, "%s", "");
}

bool team_tells(const team *t, motus_status status, const motus_error *err)
{
    if (!t) return status != MOTUS_OK;
    const bool speaks = status && err->message[0];
    return t->largest(t->context, speaks ? t->size - t->rank : 0) == t->size - t->rank && speaks;
}
