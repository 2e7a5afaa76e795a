/* The catalogue of methods, from the rows. */
#include "api/system/system.h"

size_t motus_method_count(void) { return row_count(); }
const motus_method *motus_method_at(size_t k) { return row_card(k); }

motus_status motus_method_find(const char *name, const motus_method **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    chosen c;
    const motus_method *card = NULL;
    if (!name) return fail(err, MOTUS_ARGUMENT, "motus_method_find needs a name");
    motus_status status = row_choose(name, &c, &card, err);
    if (out) *out = status == MOTUS_OK ? card : NULL;
    return status;
}

int motus_method_by_rates(const char *name)
{
    chosen c;
    return name && row_choose(name, &c, NULL, NULL) == MOTUS_OK && row_rates(&c);
}

motus_status motus_method_admits(const motus_system *given, const char *name, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    motus_system *s = (motus_system *)given;
    chosen c;
    const motus_method *card;
    if (!s || !name) return fail(err, MOTUS_ARGUMENT, "motus_method_admits needs a system and a name");
    motus_status status = row_choose(name, &c, &card, err);
    if (status != MOTUS_OK) return status;
    if (!symmetry_gyroscopic(s)) return fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
    return row_admits(&c, &s->problem.traits, err);
}

motus_status motus_method_geometry(const motus_system *given, const char *name, motus_geometry *out, motus_error *err)
{
    motus_system *s = (motus_system *)given;
    chosen c;
    if (motus_error_sound(err) && !out)
        return fail(err, MOTUS_ARGUMENT, "motus_method_geometry needs a place to write");
    motus_status status = motus_method_admits(s, name, err);
    if (status == MOTUS_OK) status = row_choose(name, &c, NULL, err);
    if (status == MOTUS_OK && !symmetry_gradient(s)) status = fail(err, MOTUS_MEMORY, "no memory to examine the force");
    if (status == MOTUS_OK) *out = row_geometry(&c, &s->problem.traits);
    return status;
}
