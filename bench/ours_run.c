/* One system through the public library: created (and compiled) outside the clock, stepped inside it. */
#include "bench/bench.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>

struct ours {
    motus_system *system;
    motus_run *run;
    char *text;
};

char *read_text(const char *file)
{
    FILE *f = fopen(file, "r");
    char *text = f ? malloc(1 << 16) : NULL;
    if (text) text[fread(text, 1, (1 << 16) - 1, f)] = 0;
    if (f) fclose(f);
    return text;
}

ours *ours_open(const char *file, const char *const *set, const char *method, double step, int64_t steps,
                const char *machine, int threads)
{
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_run_def def = motus_default_run();
    ours *o = calloc(1, sizeof *o);
    if (!o || !(o->text = read_text(file))) {
        report_note("%s cannot be read", file);
        ours_close(o);
        return NULL;
    }
    text.text = o->text;
    text.set = set;
    for (text.set_count = 0; set && set[text.set_count];) text.set_count++;
    def.method = method;
    def.step = step;
    def.until = (double)steps * step;
    def.machine = machine;
    def.threads = threads;
    if (motus_system_from_text(&text, &o->system, &error) || motus_run_create(o->system, &def, &o->run, &error)) {
        report_note("%s", error.message);
        ours_close(o);
        return NULL;
    }
    return o;
}

double ours_step(ours *o, int64_t steps)
{
    motus_error error = motus_default_error();
    double start = now();
    motus_status status = motus_run_step(o->run, steps, &error);
    double took = now() - start;
    if (status) report_note("%s", error.message);
    return status ? NAN : took;
}

bool ours_state(ours *o, double *x, double *v) { return motus_run_state(o->run, x, v, NULL) == MOTUS_OK; }

void ours_close(ours *o)
{
    if (!o) return;
    motus_run_destroy(o->run);
    motus_system_destroy(o->system);
    free(o->text);
    free(o);
}
