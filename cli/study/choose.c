/* Which methods tables and figures show.
 *
 * Invariant: a figure shows at most CHOOSE_MOST, and a table those that the command asks for, or else as many. The
 * model's own method and the best of each family come first, then the second best of each, and so on.
 */
#include "cli/study/studies.h"

#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <math.h>
#include <string.h>

/* Returns whether two methods are of one family; those that choose their steps are another one. */
static bool related(const char *a, const char *b)
{
    const motus_method *one = NULL, *other = NULL;
    return motus_method_find(a, &one, NULL) == MOTUS_OK && motus_method_find(b, &other, NULL) == MOTUS_OK &&
           strcmp(one->family, other->family) == 0 && one->adaptive == other->adaptive;
}

static bool better(const choose_row *a, const choose_row *b)
{
    return a->merit != b->merit ? a->merit < b->merit : a->work < b->work;
}

/* Returns how many of the family of a row are shown. */
static size_t shown_of(const choose_row *rows, size_t count, size_t k)
{
    size_t shown = 0;
    for (size_t i = 0; i < count; i++) shown += rows[i].shown && related(rows[i].method, rows[k].method);
    return shown;
}

size_t choose_methods(choose_row *rows, size_t count, const studies *s, bool picture)
{
    motus_settings own = motus_default_settings();
    size_t shown = 0;
    const bool all = (s->options->all || s->options->methods.count > 0) && !(picture && count > CHOOSE_MOST);
    if (motus_settings_of(s->model.system, &own) != MOTUS_OK) own.method = "";
    for (size_t k = 0; k < count; k++) {
        const bool its = own.method && strcmp(rows[k].method, own.method) == 0;
        rows[k].shown = all || ((rows[k].must || its) && !(picture && shown >= CHOOSE_MOST));
        shown += rows[k].shown;
    }
    while (!all && shown < CHOOSE_MOST) {
        size_t best = count, had = 0;
        for (size_t k = 0; k < count; k++) {
            if (rows[k].shown || !isfinite(rows[k].merit)) continue;
            const size_t now = shown_of(rows, count, k);
            if (best < count && (now > had || (now == had && !better(&rows[k], &rows[best])))) continue;
            best = k;
            had = now;
        }
        if (best == count) break;
        rows[best].shown = true;
        shown++;
    }
    return shown;
}

double choose_merit(double error, double least, double work, double most, int order)
{
    const double scaled = error * pow(work / most, order);
    return isnan(scaled) ? INFINITY : fmax(least, scaled);
}

void choose_note(size_t drawn, size_t count, const studies *s)
{
    if (drawn < count && !s->options->quiet)
        complain_note("the figure shows %zu of %zu methods; --methods chooses others", drawn, count);
}

void choose_tell(size_t shown, size_t count, const char *measure)
{
    char line[256];
    if (shown == count) return;
    snprintf(line, sizeof line,
             "%zu of %zu methods: the model's own and the best of each family by %s; --all shows the others", shown,
             count, measure);
    putchar('\n');
    text_wrap(stdout, line, 2);
}
