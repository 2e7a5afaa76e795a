/* The interpreter: binds the code of a program to memory and runs it.
 *
 * Invariant: the bits of a run depend on the program and the numbers alone, not on the width of a block, the
 * instruction set, or the use of blocks, so these are free to be chosen by size and processor.
 */
#include "lang/tape/tape_isa.h"

enum {
    /* all blocks together take most of a 32 KiB L1 cache, which also holds parts of the state */
    BLOCK_BYTES = 24 << 10,
    WIDEST = 1024,
    /* doubles between blocks: those a power of two apart would map to the same cache sets */
    PAD = 8,
    FEW_LANES = 1 /* with at most this many lanes, a call of a kernel costs more than it saves */
};

struct tape {
    arena *arena;
    const program *program;
    tape_choice choice;
    const tape_machine *machine;
    code *with_blocks, *scalar; /* `scalar` is made when it is first needed */
    code *memory_for;           /* the code for which memory of registers was taken */
    binding binding;
    frame frame;
};

/* Machines --------------------------------------------------------------------------------------------------------- */

#if defined __x86_64__ && !defined ONE_ISA
static bool runs_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

static bool runs_avx2(void) { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

const tape_machine *tape_machine_at(int k)
{
    __builtin_cpu_init();
    if (runs_avx512() && k-- == 0) return &tape_run_avx512;
    if (runs_avx2() && k-- == 0) return &tape_run_avx2;
    return k == 0 ? &tape_run_base : NULL;
}
#else
const tape_machine *tape_machine_at(int k) { return k == 0 ? &tape_run_base : NULL; }
#endif

static const tape_machine *machine_named(const char *name)
{
    const tape_machine *m = NULL;
    for (int k = 0; name && (m = tape_machine_at(k)); k++) {
        const char *p = m->name, *q = name;
        while (*p && *p == *q) p++, q++;
        if (*p == *q) return m;
    }
    return tape_machine_at(0);
}

/* Creating --------------------------------------------------------------------------------------------------------- */

tape *tape_create_as(arena *a, const program *program, const tape_choice *choice)
{
    tape *t = arena_take(a, sizeof *t);
    if (a->failed) return NULL;
    *t = (tape){.arena = a, .program = program, .choice = *choice, .machine = machine_named(choice->machine)};
    t->with_blocks = tape_code_create(a, program, choice->blocks != 0);
    return t->with_blocks ? t : NULL;
}

tape *tape_create(arena *a, const program *program) { return tape_create_as(a, program, &(tape_choice){.blocks = -1}); }

tape *tape_of(arena *a, graph *g, const output *outputs, size_t count)
{
    arena once;
    arena_init(&once, &a->allocator);
    const program *p = a->failed ? NULL : program_create_in(&once, g, outputs, count);
    tape *t = p ? tape_create(a, p) : NULL;
    const code *c = t ? t->with_blocks : NULL;
    if (t)
        t->program =
            c->blocks + c->pointers ? program_create_in(a, g, outputs, count) : NULL; /* tape_bind may need it */
    if (once.failed) a->failed = true;
    arena_release(&once);
    return t && !a->failed ? t : NULL;
}

/* Binding ---------------------------------------------------------------------------------------------------------- */

static void bind_site(site *s, const binding *b)
{
    const array *m = &b->arrays[s->ref.array];
    s->terms = s->wraps = 0;
    s->offset = (int64_t)m->base;
    s->lane_step = 0;
    for (int d = 0; d < s->ref.dims; d++) {
        const subscript *at = &s->ref.at[d];
        int64_t fixed = at->literal + (at->slot >= 0 ? b->ints[at->slot] : 0), step = m->over->stride[d];
        if (at->modulus >= 0) {
            int64_t modulus = b->ints[at->modulus] > 0 ? b->ints[at->modulus] : 1;
            s->wrap[s->wraps].level = at->level;
            s->wrap[s->wraps].add = fixed;
            s->wrap[s->wraps].modulus = modulus;
            s->wrap[s->wraps++].step = step;
            fixed = 1; /* 1 + (base mod modulus) */
        } else if (at->level >= 0) {
            s->level[s->terms] = at->level;
            s->step[s->terms++] = step;
        }
        s->offset += (fixed - m->over->first[d]) * step;
        if (s->lanes >= 0 && at->level == s->lanes) s->lane_step += step;
    }
}

/* Returns the lanes of the widest loop, as far as bounds are known before a run. */
static int64_t most_lanes(const code *c, const binding *b)
{
    int64_t most = 0;
    for (uint32_t k = 0; k < c->loop_count; k++) {
        const loop *l = &c->loops[k];
        if (l->kind == LOOP_SERIAL) continue;
        if (l->range.first.level >= 0 || l->range.last.level >= 0) return INT64_MAX;
        int64_t lanes =
            graph_subscript(&l->range.last, NULL, b->ints) - graph_subscript(&l->range.first, NULL, b->ints) + 1;
        if (lanes > most) most = lanes;
    }
    return most;
}

static bool take_registers(tape *t, const code *c)
{
    size_t width = t->choice.width ? t->choice.width : WIDEST;
    if (!t->choice.width && c->blocks) {
        width = BLOCK_BYTES / sizeof(double) / c->blocks / PAD * PAD;
        width = width < PAD ? PAD : width > WIDEST ? WIDEST : width;
    }
    size_t stride = width + PAD;
    frame *f = &t->frame;
    f->width = width;
    f->scalars = arena_room(t->arena, c->scalars * sizeof *f->scalars);
    f->pointers = arena_room(t->arena, (size_t)(c->blocks + c->pointers + 1) * sizeof *f->pointers);
    double *blocks = c->blocks ? arena_room(t->arena, c->blocks * stride * sizeof *blocks) : NULL;
    if (!f->scalars || !f->pointers || (c->blocks && !blocks)) return false;
    for (uint32_t k = 0; k < c->blocks; k++) f->pointers[k] = blocks + k * stride;
    return true;
}

bool tape_bind(tape *t, const binding *b)
{
    t->binding = *b;
    code *c = t->with_blocks;
    if (t->choice.blocks < 0 && c->blocks + c->pointers && most_lanes(c, b) <= FEW_LANES) {
        if (!t->scalar) t->scalar = tape_code_create(t->arena, t->program, false);
        c = t->scalar;
    }
    if (!c || (t->memory_for != c && !take_registers(t, c))) return false;
    t->memory_for = c;
    for (uint32_t k = 0; k < c->site_count; k++) bind_site(&c->sites[k], b);
    frame *f = &t->frame;
    f->code = c;
    f->binding = &t->binding;
    f->base = NULL;
    t->machine->execute(f, c->instructions);
    return true;
}

void tape_run(tape *t, double time, double *const base[SPACES])
{
    frame *f = &t->frame;
    f->base = base;
    f->t = time;
    t->machine->execute(f, f->code->instructions + f->code->bind_count);
}
