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
    char grow[2 * DECIMAL_MAX + MOTUS_TEXT_MAX] = "";
    text_brief(e->rate, 2, rate);
    text_brief(LN_10 / e->rate, 2, gain);
    if (isfinite(e->rate))
        snprintf(grow, sizeof grow, " (errors grow as e^{%s %s}; a tenth of the error moves that time on by %s)", rate,
                 s->model->time, gain);
    text_say(out, "no digit is known to be significant after %s = %s%s", s->model->time, t, grow);
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
        text_say(out, "accuracy %s%s %s: the largest error at the ends of steps is %s%s", wanted, unit,
                 run->reached <= run->accuracy ? "holds" : "is not reached", reached, unit);
}

void answer_choice(const summary *s, FILE *out)
{
    const char *why = motus_run_now(s->run).choice;
    if (why[0]) text_say(out, "auto: %s", why);
}

void answer_print(const summary *s, FILE *out)
{
    const motus_estimate *e = &s->estimate;
    char step[DECIMAL_MAX], work[DECIMAL_MAX], growth[DECIMAL_MAX], looked[DECIMAL_MAX];
    char rough[128] = "", grown[DECIMAL_MAX + 64] = "", seen[DECIMAL_MAX + 64] = "";
    putc('\n', out);
    if (e->reason[0]) {
        text_say(out, "error: not known, because %s", e->reason);
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
        text_say(out, "± is the error of %s %s: how far the exact motion of the equation may be",
                 adaptive ? "tolerance" : "h =", step);
    if (e->kinked)
        snprintf(rough, sizeof rough, "; steps cross kinks of the force, so the errors are rough%s",
                 adaptive || s->options->switches ? "" : ": --switches locate gives sharp ones");
    if (isnan(e->significant_until) && e->growth > FAR_APART && s->options->error == NULL) {
        text_brief(e->growth, 1, growth);
        snprintf(grown, sizeof grown, "; errors have grown %s times: --error full is safer", growth);
    }
    if (e->looked < 1) {
        const double percent = 100 * e->looked;
        text_brief(percent < 10 ? percent : floor(percent), 2, looked);
        snprintf(seen, sizeof seen, "; the force within a step was examined in %s %% of the steps", looked);
    }
    text_say(out, "finding the errors took %s × the work of the run%s%s%s", isnan(e->work) ? "0" : work, rough, grown,
             seen);
}
