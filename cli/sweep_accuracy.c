/* sweep --accuracy: one tolerance for all trajectories, such that the error of each is below what is wanted.
 *
 * A sweep begins with a tolerance, and where a trajectory does not keep to the accuracy begins anew with a smaller one.
 * Invariant: the next tolerance follows from the first trajectory, by its number, that does not; so it depends neither
 * on batches nor on threads. The file tells its tolerance, and --resume goes on from there.
 */
#define _XOPEN_SOURCE 700
#include "base/decimal.h"
#include "base/error.h"
#include "cli/complain.h"
#include "cli/file.h"
#include "cli/sweep.h"
#include "cli/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEAST 5e-15 /* below this a relative tolerance is rounding */
#define MARGIN 0.3  /* the next tolerance aims at this part of what is wanted, */
#define NEAREST 0.5 /*   is at most this part of the one before, */
#define FARTHEST 1e-6
#define WRECKED 1e-2 /*   and this part where no digit is significant */

/* Of two digits. */
static double rounded(double tolerance)
{
    char text[DECIMAL_MAX];
    snprintf(text, sizeof text, "%.1e", tolerance);
    return strtod(text, NULL);
}

/* The tolerance that the file of an interrupted sweep tells; NaN: there is none. */
static double tolerance_of_file(const options *o)
{
    char *path = malloc(strlen(o->output) + sizeof ".json"), line[4096];
    const size_t length = strlen(o->output);
    const bool npy = length > 4 && strcmp(o->output + length - 4, ".npy") == 0;
    double found = NAN;
    if (!path) return NAN;
    sprintf(path, npy ? "%s.json" : "%s", o->output);
    FILE *f = fopen(path, "r");
    const char *word = npy ? "\"tolerance\": " : ", tolerance ";
    for (int i = 0; f && isnan(found) && i < 64 && fgets(line, sizeof line, f); i++) {
        const char *at = npy || strncmp(line, "# motus ", 8) == 0 ? strstr(line, word) : NULL;
        if (at) found = strtod(at + strlen(word), NULL);
    }
    if (f) fclose(f);
    free(path);
    return found > 0 && isfinite(found) ? found : NAN;
}

motus_status sweep_accuracy_begin(sweep *s, motus_error *err)
{
    const options *o = s->options;
    s->tried = NAN;
    if (isnan(o->accuracy)) return MOTUS_OK;
    if (!isnan(s->step)) {
        fail(err, MOTUS_ARGUMENT,
             "--accuracy finds a tolerance for all trajectories, and the method's steps have one size");
        hint(err, "choose an adaptive method: --method dop853");
        return MOTUS_ARGUMENT;
    }
    if (!isnan(o->tolerance)) {
        fail(err, MOTUS_ARGUMENT, "--accuracy and --tolerance exclude each other");
        hint(err, "--accuracy bounds the error of the answer, --tolerance that of a step");
        return MOTUS_ARGUMENT;
    }
    if (!o->output || strcmp(o->output, "-") == 0) {
        fail(err, MOTUS_ARGUMENT,
             "--accuracy needs a file: its rows are written again where the tolerance has to be smaller");
        hint(err, "add -o FILE");
        return MOTUS_ARGUMENT;
    }
    const double file = o->resume ? tolerance_of_file(o) : NAN, first = rounded(o->accuracy / 10);
    s->tried = !isnan(file) ? file : o->absolute ? first : fmax(LEAST, first);
    return MOTUS_OK;
}

/* "trajectory 17 (F = 0.85)" */
static void name_of(const sweep *s, uint64_t number, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "trajectory %llu", (unsigned long long)number);
    double *room = malloc((s->grid.count + 1) * sizeof *room), **values = malloc((s->grid.count + 1) * sizeof *values);
    for (size_t k = 0; room && values && k < s->grid.count; k++) values[k] = room + k;
    if (room && values && s->grid.count) {
        grid_values(&s->grid, number, 1, values);
        for (size_t k = 0; k < s->grid.count && n < size; k++) {
            char text[DECIMAL_MAX];
            n += (size_t)snprintf(out + n, size - n, "%s%s = %s%s", k ? ", " : " (", s->grid.names[k],
                                  decimal(values[k][0], text), k + 1 == s->grid.count ? ")" : "");
        }
    }
    free(room);
    free(values);
}

static motus_status refuse(const sweep *s, uint64_t number, double reached, motus_error *err)
{
    char who[256], wanted[DECIMAL_MAX], bar[DECIMAL_MAX], tolerance[DECIMAL_MAX];
    name_of(s, number, who, sizeof who);
    decimal(s->options->accuracy, wanted);
    decimal(s->tolerance, tolerance);
    text_brief(reached, 2, bar);
    if (isnan(reached))
        fail(err, MOTUS_ACCURACY, "no accuracy can be promised: there is no companion of %s", who);
    else if (isinf(reached))
        fail(err, MOTUS_ACCURACY, "the accuracy %s cannot be reached: no digit of %s is significant at its end", wanted,
             who);
    else
        fail(err, MOTUS_ACCURACY, "the accuracy %s cannot be reached: %s has the error %s with the tolerance %s",
             wanted, who, bar, tolerance);
    hint(err, "allow a larger error, or leave this trajectory out");
    return MOTUS_ACCURACY;
}

motus_status sweep_accuracy_judge(sweep *s, uint64_t first, size_t count, const double *reached, const double *stopped,
                                  bool *again, motus_error *err)
{
    const double wanted = s->options->accuracy, least = s->options->absolute ? 0 : LEAST;
    size_t i = 0;
    *again = false;
    while (i < count && (!isnan(stopped[i]) || reached[i] <= wanted)) i++;
    if (i == count) return MOTUS_OK;
    double factor = fmax(FARTHEST, fmin(NEAREST, MARGIN * wanted / reached[i]));
    if (isinf(reached[i])) factor = WRECKED;
    const double next = fmax(least, rounded(s->tolerance * factor));
    if (isnan(reached[i]) || !(next < s->tolerance) || next < 1e-300) return refuse(s, first + i, reached[i], err);
    s->tried = next;
    *again = true;
    return MOTUS_OK;
}
