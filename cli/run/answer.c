/* What the errors of a finished run rest on, in words. */
#include "cli/run/summary.h"

#include "cli/words/text.h"

#include <math.h>

#define LN_10 2.302585092994046
#define FAR_APART 1e7 /* the growth of errors in close encounters, or in chaos */

/* Prints from what time on no digit is known to be significant. */
static void print_end(const summary *s, FILE *out)
{
    const motus_estimate *e = &s->estimate;
    char t[DECIMAL_MAX], rate[DECIMAL_MAX], gain[DECIMAL_MAX];
    decimal_time(e->significant_until, motus_run_time(s->run) - s->start, t);
    fprintf(out, "no digit is known to be significant after %s = %s", s->model->time, t);
    if (isfinite(e->rate)) {
        text_brief(e->rate, 2, rate);
        text_brief(LN_10 / e->rate, 2, gain);
        fprintf(out, " (errors grow as e^{%s %s}; a tenth of the error moves that time on by %s)", rate, s->model->time,
                gain);
    }
    putc('\n', out);
}

/* Prints whether the run has reached its accuracy. */
static void print_accuracy(const motus_run_statistics *run, FILE *out)
{
    char wanted[DECIMAL_MAX], reached[DECIMAL_MAX];
    const char *const unit = run->absolute ? "" : " of the motion's size";
    if (isnan(run->accuracy)) return;
    text_brief(run->accuracy, 3, wanted);
    text_brief(run->reached, 2, reached);
    if (isfinite(run->reached))
        fprintf(out, "accuracy %s%s %s: the largest error at the ends of steps is %s%s\n", wanted, unit,
                run->reached <= run->accuracy ? "holds" : "is not reached", reached, unit);
}

void answer_choice(const summary *s, FILE *out)
{
    const char *why = motus_run_now(s->run).choice;
    if (!why[0]) return;
    fputs("auto: ", out);
    text_put(out, why);
    putc('\n', out);
}

void answer_print(const summary *s, FILE *out)
{
    const motus_estimate *e = &s->estimate;
    char step[DECIMAL_MAX], work[DECIMAL_MAX], growth[DECIMAL_MAX], looked[DECIMAL_MAX];
    putc('\n', out);
    if (e->reason[0]) {
        fputs("error: not known, because ", out);
        text_put(out, e->reason);
        putc('\n', out);
        return;
    }
    const motus_run_statistics run = motus_run_now(s->run);
    const bool adaptive = isnan(run.step);
    text_brief(adaptive ? run.tolerance : run.step, 6, step);
    text_brief(e->work, 2, work);
    print_accuracy(&run, out);
    if (!isnan(e->significant_until))
        print_end(s, out);
    else
        fprintf(out, "± is the error of %s %s: how far the exact motion of the equation may be\n",
                adaptive ? "tolerance" : "h =", step);
    fprintf(out, "finding the errors took %s × the work of the run", isnan(e->work) ? "0" : work);
    if (e->kinked)
        fprintf(out, "; steps cross kinks of the force, so the errors are rough%s",
                adaptive || s->options->switches ? "" : ": --switches locate gives sharp ones");
    if (isnan(e->significant_until) && e->growth > FAR_APART && s->options->error == NULL) {
        text_brief(e->growth, 1, growth);
        fprintf(out, "; errors have grown %s times: --error full is safer", growth);
    }
    if (e->looked < 1) {
        const double percent = 100 * e->looked;
        text_brief(percent < 10 ? percent : floor(percent), 2, looked);
        fprintf(out, "; the force within a step was examined in %s %% of the steps", looked);
    }
    putc('\n', out);
}
