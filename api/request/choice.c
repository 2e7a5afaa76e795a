/* See choice.h. */
#include "api/request/choice.h"

#include "core/stepper_body.h"

#include <string.h>

#define CALLBACK 30.0 /* operations of a callback, for each number; what it does is not known */

motus_status choice_machine(const char *wanted, bool *automatic, bool *compiled, motus_error *err)
{
    *automatic = wanted && !strcmp(wanted, "auto");
    *compiled = *automatic || (wanted && !strcmp(wanted, "compiled"));
    if (*compiled || !wanted || !strcmp(wanted, "interpreter")) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "there is no machine called %s", wanted);
    hint(err, "the machines are auto, interpreter and compiled");
    return MOTUS_ARGUMENT;
}

motus_status choice_compile(motus_system *s, const chosen *chosen, bool must, bool kept, machine *out, const char **why,
                            motus_error *err)
{
    *why = NULL;
    if (!s->compiled) {
        motus_status status = compiled_create(s->model, &s->problem, &s->compiled, err);
        if (status != MOTUS_OK) return status;
    }
    *why = compiled_prepare(s->compiled, chosen, kept);
    if (*why && s->arena.failed) return fail(err, MOTUS_MEMORY, "no memory for the compiled model");
    if (!*why) return compiled_machine(s->compiled, chosen, out, err);
    if (!must) return MOTUS_OK;
    fail(err, MOTUS_TOOL, "the model could not be compiled: %s", *why);
    hint(err, "the interpreter needs no compiler: give `machine = interpreter` of the definition");
    return MOTUS_TOOL;
}

static motus_status answer(motus_system *s, const chosen *chosen, compiled_state state, machine *out, motus_error *err)
{
    if (state == COMPILED_READY) return compiled_machine(s->compiled, chosen, out, err);
    return s->arena.failed ? fail(err, MOTUS_MEMORY, "no memory for the compiled model") : MOTUS_OK;
}

motus_status choice_begin(motus_system *s, const chosen *chosen, compiled_state *state, machine *out, const char **why,
                          motus_error *err)
{
    *state = COMPILED_FAILED;
    if (!s->compiled) {
        motus_status status = compiled_create(s->model, &s->problem, &s->compiled, err);
        if (status != MOTUS_OK) return status;
    }
    *state = compiled_begin(s->compiled, chosen, why);
    return answer(s, chosen, *state, out, err);
}

motus_status choice_look(motus_system *s, const chosen *chosen, compiled_state *state, machine *out, const char **why,
                         motus_error *err)
{
    *state = compiled_look(s->compiled, chosen, why);
    if (*state != COMPILED_WAIT) compiled_leave(s->compiled, chosen);
    return answer(s, chosen, *state, out, err);
}

void choice_leave(motus_system *s, const chosen *chosen) { compiled_leave(s->compiled, chosen); }

motus_status choice_weigh(motus_system *s, weight *out, motus_error *err)
{
    if (!s->model) {
        *out = (weight){.values = CALLBACK * (double)(s->problem.nx + s->problem.nv)};
        return MOTUS_OK;
    }
    if (!s->weighed) {
        const program *p = program_create(s->model->graph, s->model->accel, s->model->accel_count);
        s->weighed = p && weigh(&s->arena, p, s->model->ints, &s->weight);
    }
    *out = s->weight;
    return s->weighed ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory to count the operations of the equations");
}

/* Counts half of the stages for each stage, since a stage sums about that many. */
double choice_evaluation(const problem *p, const weight *w, const motus_method *card)
{
    return w->values + (1 + card->stages / 2.0) * (double)(p->traits.velocity ? p->nx + p->nv : p->nv);
}

/* Counts half of the terms of a Taylor series, n (n + 1)/2 for each product to order n, because the terms of a sum do
 * not wait for each other as the stages of a Runge-Kutta step do. */
double choice_expansion(const problem *p, const weight *w, double order)
{
    const double numbers = (double)(p->nx + p->nv);
    return 0.5 * (w->products * order * (order + 1) / 2 + (w->sums + 6 * numbers) * order);
}

static double evaluations(const motus_method *card) { return card->evaluations ? card->evaluations : 4 * card->stages; }

double choice_step(const problem *p, const weight *w, const chosen *chosen, const motus_method *card)
{
    const int order = stepper_plan(p, chosen, NULL).expands;
    return order ? choice_expansion(p, w, order) : evaluations(card) * choice_evaluation(p, w, card);
}

/* Below this much work for the interpreter, compiling (some 0.1 s when the cache is cold) does not pay. */
#define WORTH_COMPILING 1e8
/* A compiler's time grows with the text: this much work for each operation in it. */
#define WORTH_AN_OPERATION 1e6

double choice_worth(const motus_system *s, const chosen *chosen, const motus_method *card, double steps)
{
    const int orders = stepper_plan(&s->problem, chosen, NULL).expands; /* of a Taylor series: an evaluation each */

    const double nodes = (double)s->model->graph->count;
    const double operations = steps * (orders ? orders : evaluations(card)) * (nodes + 4 * (double)s->problem.nv);
    return operations / (WORTH_COMPILING + WORTH_AN_OPERATION * nodes);
}
