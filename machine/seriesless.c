/* Stands in for lang/graph/expansion.c and lang/tape/tape_series.c: the page has no method of Taylor series yet, and
 * its module is small without them. No series can be made, so no other call ever follows. */
#include "lang/graph/expansion.h"
#include "lang/tape/tape_code.h"
#include "lang/tape/tape_series.h"

program *expansion_program(arena *a, graph *g, const output *outputs, size_t count)
{
    return (void)a, (void)g, (void)outputs, (void)count, NULL;
}

tape_series *tape_series_create(arena *a, const program *p, int length) { return (void)a, (void)p, (void)length, NULL; }
void tape_series_bind(tape_series *s, const binding *b) { (void)s, (void)b; }
size_t tape_series_numbers(const tape_series *s) { return (void)s, 0; }
void tape_series_run(tape_series *s, const series_pass *p) { (void)s, (void)p; }
void tape_series_isa_base(tape_series *, const series_pass *);
void tape_series_isa_base(tape_series *s, const series_pass *p) { (void)s, (void)p; }
