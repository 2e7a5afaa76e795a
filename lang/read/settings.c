/* Reads the settings of a model: method, step, tolerance, accuracy, until, every. */
#include "lang/read/read_steps.h"

#include "lang/lower/resolve.h"

#include <math.h>

/* Sets the method. An unknown method is an error on its line. */
static bool set_method(model *m, const statement *s, read_method known)
{
    motus_error why = {.size = sizeof why};
    const motus_status status = known(s->text, &why);
    if (status == MOTUS_OK) {
        m->method = s->text;
        return true;
    }
    source_complain(&m->source, status, &s->at, "%s", why.message);
    if (why.hint[0]) source_hint(&m->source, "%s", why.hint);
    source_repair(&m->source, why.word, "%s", why.instead);
    return false;
}

bool settings_all(model *m, read_method known)
{
    bool seen[STATEMENT_EVERY + 1] = {false};
    m->step = m->until = m->every_time = m->tolerance = m->accuracy = NAN;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        if (s->kind < STATEMENT_METHOD) continue;
        if (seen[s->kind]) {
            source_complain(&m->source, MOTUS_NAME, &s->at, "%s is set twice", s->name);
            return false;
        }
        seen[s->kind] = true;
        if (seen[STATEMENT_TOLERANCE] && seen[STATEMENT_ACCURACY]) {
            source_complain(&m->source, MOTUS_ARGUMENT, &s->at, "both a tolerance and an accuracy are set");
            source_hint(&m->source, "keep one: `accuracy` is the error of the answer, `tolerance` that of one step");
            return false;
        }
        if (s->kind == STATEMENT_METHOD) {
            if (!set_method(m, s, known)) return false;
            continue;
        }
        double v;
        if (!resolve_constant(m, s->value, s->name, &v)) return false;
        const bool error = s->kind == STATEMENT_TOLERANCE || s->kind == STATEMENT_ACCURACY;
        const bool positive = s->kind == STATEMENT_STEP || s->kind == STATEMENT_EVERY || error;
        if (positive && !(v > 0)) {
            source_complain(&m->source, MOTUS_ARGUMENT, &s->value->at, "%s is positive, not %g", s->name, v);
            if (s->kind == STATEMENT_STEP)
                source_hint(&m->source, "a run goes backward when `until` lies before the start");
            return false;
        }
        switch (s->kind) {
        case STATEMENT_STEP: m->step = v; break;
        case STATEMENT_TOLERANCE:
            m->tolerance = v;
            m->absolute = s->absolute;
            break;
        case STATEMENT_ACCURACY:
            m->accuracy = v;
            m->absolute = s->absolute;
            break;
        case STATEMENT_UNTIL: m->until = v; break;
        case STATEMENT_EVERY:
            if (!s->steps) {
                m->every_time = v;
            } else if (v != floor(v) || v > 9e15) {
                source_complain(&m->source, MOTUS_ARGUMENT, &s->value->at, "every %g steps: the number must be whole",
                                v);
                return false;
            } else {
                m->every_steps = (int64_t)v;
            }
            break;
        default: break;
        }
    }
    return true;
}
