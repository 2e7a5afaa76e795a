/* Writes a plan as instructions.
 *
 * Invariant: instructions stand in the order in which they run, and loops are nested by position. Registers are
 * virtual, each made by one instruction, until tape_registers.c numbers them at the end.
 */
#include "lang/tape/tape_code.h"

#include <string.h>

/* Which fields of an instruction are registers. */
enum { R = 1, A = 2, B = 4, C = 8 };

typedef struct writer {
    plan plan;
    LIST(virtual_register) registers;
    LIST(instruction) text;
    LIST(uint8_t) fields;
    LIST(site) sites;
    LIST(loop) loops;
    LIST(total) totals;
    LIST(double) constants;
    uint32_t region; /* the region being written */
    uint32_t bind_count;
} writer;

/* Registers -------------------------------------------------------------------------------------------------------- */

static uint32_t fresh(writer *w, register_kind kind)
{
    if (!ROOM(&w->plan, w->registers)) return 0;
    w->registers.at[w->registers.count] = (virtual_register){.kind = (uint8_t)kind,
                                                             .first = w->text.count,
                                                             .last = w->text.count,
                                                             .made = {w->region, NONE},
                                                             .memory = NONE};
    return w->registers.count++;
}

/* Notes that the next instruction reads a register. If it was written before a loop and is read inside, it lives until
 * the end of the loop. */
static void reads(writer *w, uint32_t reg)
{
    if (w->plan.failed) return;
    virtual_register *v = &w->registers.at[reg];
    v->last = w->text.count;
    for (uint32_t up = w->region; up != v->made.region; up = w->plan.regions.at[up].parent) v->made.until = up;
    if (v->memory != NONE) reads(w, v->memory);
}

static bool is_block(const writer *w, uint32_t reg)
{
    return !w->plan.failed && w->registers.at[reg].kind != SCALAR_REGISTER;
}

static void put(writer *w, uint16_t code, uint16_t kernel, instruction fields, int registers)
{
    if (!ROOM(&w->plan, w->text) || !ROOM(&w->plan, w->fields)) return;
    fields.code = code;
    fields.kernel = kernel;
    if (registers & A) reads(w, fields.a);
    if (registers & B) reads(w, fields.b);
    if (registers & C) reads(w, fields.c);
    w->fields.at[w->fields.count++] = (uint8_t)registers;
    w->text.at[w->text.count++] = fields;
}

/* Writes r = op(a, b, c), in lanes if an operand has lanes. */
static void operate(writer *w, operation op, uint32_t r, const uint32_t operand[3])
{
    int arity = operation_at(op)->arity, mask = 0;
    for (int k = 0; k < arity; k++) mask |= is_block(w, operand[k]) << k;
    put(w, mask ? CODE_BLOCK : (uint16_t)op, mask ? (uint16_t)(op * 8 + mask) : 0,
        (instruction){.r = r, .a = operand[0], .b = operand[1], .c = operand[2]},
        R | A | (arity > 1 ? B : 0) | (arity > 2 ? C : 0));
}

static uint32_t operand(writer *w, node n)
{
    if (w->plan.failed) return 0;
    uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region);
    return w->plan.items.at[plan_find(&w->plan, n, home)].reg;
}

/* Returns a register with a scalar in every lane, for an instruction that reads lanes. */
static uint32_t in_lanes(writer *w, uint32_t reg)
{
    if (is_block(w, reg)) return reg;
    uint32_t r = fresh(w, BLOCK_REGISTER);
    put(w, CODE_FILL, 0, (instruction){.r = r, .a = reg}, R | A);
    return r;
}

/* Memory ----------------------------------------------------------------------------------------------------------- */

static uint32_t site_at(writer *w, const reference *ref, bool lanes)
{
    const plan_region *r = &w->plan.regions.at[w->region];
    if (!ROOM(&w->plan, w->sites)) return 0;
    w->sites.at[w->sites.count] = (site){.ref = *ref,
                                         .lanes = lanes ? w->plan.regions.at[r->wide_at].level : -1,
                                         .space = (uint8_t)w->plan.g->arrays[ref->array].space};
    return w->sites.count++;
}

/* Returns whether lanes are contiguous for all sizes: they run along the last index alone. */
static bool contiguous(const reference *ref, int level)
{
    for (int d = 0; d < ref->dims - 1; d++)
        if (ref->at[d].level == level) return false;
    return ref->dims && ref->at[ref->dims - 1].level == level && ref->at[ref->dims - 1].modulus < 0;
}

/* Returns whether a place depends on no index and no modulus. */
static bool fixed(const reference *ref)
{
    for (int d = 0; d < ref->dims; d++)
        if (ref->at[d].level >= 0 || ref->at[d].modulus >= 0) return false;
    return true;
}

static uint32_t load(writer *w, node n, bool lanes)
{
    const reference *ref = &w->plan.g->references[w->plan.g->nodes[n].a];
    uint32_t s = site_at(w, ref, lanes);
    if (!lanes) {
        bool pool = w->plan.g->arrays[ref->array].space == SPACE_POOL;
        uint32_t r = fresh(w, SCALAR_REGISTER);
        put(w, fixed(ref) && !pool ? CODE_FETCH_FIXED : CODE_FETCH, 0, (instruction){.r = r, .a = s}, R);
        return r;
    }
    uint32_t r = fresh(w, POINTER_REGISTER), memory = NONE;
    if (!contiguous(ref, w->plan.regions.at[w->plan.regions.at[w->region].wide_at].level))
        memory = fresh(w, BLOCK_REGISTER);
    put(w, CODE_VIEW, 0, (instruction){.r = r, .a = s, .b = memory}, memory == NONE ? R : R | B);
    if (!w->plan.failed) w->registers.at[r].memory = memory;
    return r;
}

static bool can_target(const writer *w, const plan_item *item)
{
    if (item->outputs == NONE || item->region != w->region) return false;
    uint32_t wide = w->plan.regions.at[w->region].wide_at;
    return contiguous(&w->plan.program->outputs[item->outputs].to, w->plan.regions.at[wide].level);
}

static void write_outputs(writer *w, uint32_t first, uint32_t (*value)(writer *, node))
{
    for (uint32_t k = first; k != NONE; k = w->plan.next_output[k]) {
        const output *o = &w->plan.program->outputs[k];
        bool lanes = w->plan.regions.at[w->region].wide;
        uint32_t reg = value(w, o->value);
        put(w,
            lanes           ? CODE_WRITE
            : fixed(&o->to) ? CODE_PUT_FIXED
                            : CODE_PUT,
            0, (instruction){.a = reg, .b = site_at(w, &o->to, lanes)}, A);
    }
}

/* Values ----------------------------------------------------------------------------------------------------------- */

static uint32_t constant(writer *w, double value)
{
    uint32_t r = fresh(w, SCALAR_REGISTER);
    if (!ROOM(&w->plan, w->constants)) return r;
    w->constants.at[w->constants.count] = value;
    put(w, CODE_CONST, 0, (instruction){.r = r, .a = w->constants.count++}, R);
    return r;
}

static uint32_t simple(writer *w, uint16_t code, register_kind kind, uint32_t a)
{
    uint32_t r = fresh(w, kind);
    put(w, code, 0, (instruction){.r = r, .a = a}, R);
    return r;
}

static void write_item(writer *w, uint32_t k)
{
    plan_item *item = &w->plan.items.at[k];
    const graph_node *n = &w->plan.g->nodes[item->n];
    bool lanes = plan_is_block(&w->plan, item->n, item->region);
    uint32_t outputs = item->outputs;
    switch (n->op) {
    case OP_CONST: item->reg = constant(w, n->value); break;
    case OP_TIME: item->reg = simple(w, CODE_TIME, SCALAR_REGISTER, 0); break;
    case OP_PARAM: item->reg = simple(w, CODE_PARAM, SCALAR_REGISTER, n->a); break;
    case OP_TABLE: item->reg = simple(w, CODE_TABLE, SCALAR_REGISTER, n->a); break;
    case OP_INDEX:
        item->reg =
            lanes ? simple(w, CODE_IOTA, BLOCK_REGISTER, n->level) : simple(w, CODE_INDEX, SCALAR_REGISTER, n->level);
        break;
    case OP_LOAD: item->reg = load(w, item->n, lanes); break;
    case OP_SUM: break; /* its loop has made it */
    default: {
        int arity = operation_at(n->op)->arity;
        uint32_t from[3] = {operand(w, n->a), arity > 1 ? operand(w, n->b) : 0, arity > 2 ? operand(w, n->c) : 0};
        bool target = lanes && can_target(w, item);
        item->reg = fresh(w, !lanes ? SCALAR_REGISTER : target ? POINTER_REGISTER : BLOCK_REGISTER);
        if (target) {
            const output *o = &w->plan.program->outputs[outputs];
            put(w, CODE_TARGET, 0, (instruction){.r = item->reg, .a = site_at(w, &o->to, true)}, R);
            outputs = w->plan.next_output[outputs];
        }
        operate(w, n->op, item->reg, from);
    }
    }
    write_outputs(w, outputs, operand);
}

/* Sums ------------------------------------------------------------------------------------------------------------- */

/* Writes the update of a total by the term of a pass, or by lanes of terms. */
static void write_update(writer *w, const plan_item *update)
{
    const plan_item *item = &w->plan.items.at[plan_updates(&w->plan, update)];
    const uint32_t number = w->plan.sums.at[item->sum].total;
    const graph_node *sum = &w->plan.g->nodes[item->n], *how = &w->plan.g->nodes[sum->a];
    bool fused = how->op != OP_ADD;
    uint32_t p = operand(w, fused ? how->a : how->b), q = fused ? operand(w, how->b) : 0;
    uint32_t condition = sum->b ? operand(w, sum->b) : NONE;
    if (w->plan.failed) return;
    if (w->plan.regions.at[w->region].wide) {
        instruction i = {.r = number,
                         .a = in_lanes(w, p),
                         .b = fused ? in_lanes(w, q) : NONE,
                         .c = condition == NONE ? NONE : in_lanes(w, condition)};
        put(w, CODE_TERMS, how->op, i, A | (fused ? B : 0) | (condition == NONE ? 0 : C));
        return;
    }
    total t = w->totals.at[number];
    uint32_t from[3] = {fused ? p : t.current, fused ? q : p, fused ? t.current : 0};
    uint32_t r = t.current;
    if (condition != NONE) r = fresh(w, t.block || is_block(w, condition) ? BLOCK_REGISTER : SCALAR_REGISTER);
    operate(w, how->op, r, from);
    if (condition != NONE) operate(w, OP_SELECT, t.current, (uint32_t[]){condition, r, t.current});
}

static void new_total(writer *w, plan_item *item, bool terms)
{
    bool block = plan_is_block(&w->plan, item->n, item->region);
    register_kind kind = block ? BLOCK_REGISTER : SCALAR_REGISTER;
    plan_sum *sum = &w->plan.sums.at[item->sum];
    uint32_t inside = sum->inside;
    total t = {.block = block, .current = NONE};
    item->reg = t.part[0] = fresh(w, kind);
    uint32_t made[PARTS + 1] = {t.part[0]}, count = 1;
    w->region = inside; /* the partial sums belong to the loop */
    for (int k = 1; k < PARTS; k++) made[count++] = t.part[k] = fresh(w, kind);
    if (!terms) made[count++] = t.current = fresh(w, block ? POINTER_REGISTER : SCALAR_REGISTER);
    w->region = item->region;
    if (w->plan.failed || !ROOM(&w->plan, w->totals)) return;
    for (uint32_t k = 0; k < count; k++) w->registers.at[made[k]].made.until = inside;
    sum->total = w->totals.count;
    w->totals.at[w->totals.count++] = t;
}

static void write_region(writer *, uint32_t);

static void write_loop(writer *w, uint32_t region)
{
    plan_region *r = &w->plan.regions.at[region];
    loop l = {.kind = !r->wide ? LOOP_SERIAL
                      : r->sum ? LOOP_TERMS
                               : LOOP_CELLS,
              .level = (uint8_t)r->level,
              .range = r->range,
              .first_total = w->totals.count};
    for (uint32_t k = r->sums; k != NONE; k = w->plan.sums.at[w->plan.items.at[k].sum].next)
        new_total(w, &w->plan.items.at[k], l.kind == LOOP_TERMS);
    if (w->plan.failed || !ROOM(&w->plan, w->loops)) return;
    uint32_t number = w->loops.count++, around = w->region;
    l.total_count = w->totals.count - l.first_total;
    l.body = w->text.count + 1;
    r->begin = w->text.count;
    put(w, CODE_LOOP, 0, (instruction){.a = number}, 0);
    write_region(w, region);
    w->region = around;
    r->end = l.end = w->text.count;
    put(w, CODE_NEXT, 0, (instruction){.a = number}, 0);
    w->loops.at[number] = l;
}

/* Writes a region and the loops in it, at most MAX_LEVELS deep. */
static void write_region(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    w->region = region;
    write_outputs(w, r->outputs, operand);
    for (uint32_t k = 0; k < r->item_count && !w->plan.failed; k++) {
        uint32_t item = w->plan.order[r->items + k];
        const plan_item *i = &w->plan.items.at[item];
        const uint32_t inside = plan_inside(&w->plan, i);
        if (inside != NONE && i->reg == NONE) write_loop(w, inside);
        if (plan_updates(&w->plan, i) != NONE)
            write_update(w, i);
        else
            write_item(w, item);
    }
    for (uint32_t k = r->first_child; k != NONE && !w->plan.failed; k = w->plan.regions.at[k].next)
        if (!w->plan.regions.at[k].sum && region != AT_BIND) write_loop(w, k);
}

/* The end ---------------------------------------------------------------------------------------------------------- */

static uint32_t numbered(const writer *w, const uint32_t counts[REGISTER_KINDS], uint32_t reg)
{
    const virtual_register *v = &w->registers.at[reg];
    switch (v->kind) {
    case SCALAR_REGISTER: return v->given.number;
    case BLOCK_REGISTER: return v->given.number | BLOCK_BIT;
    default: return (counts[BLOCK_REGISTER] + v->given.number) | BLOCK_BIT;
    }
}

static void number_all(writer *w, const uint32_t counts[REGISTER_KINDS])
{
    for (uint32_t k = 0; k < w->text.count; k++) {
        instruction *i = &w->text.at[k];
        int fields = w->fields.at[k];
        if (fields & R) i->r = numbered(w, counts, i->r);
        if (fields & A) i->a = numbered(w, counts, i->a);
        if (fields & B) i->b = numbered(w, counts, i->b);
        if (fields & C) i->c = numbered(w, counts, i->c);
    }
    for (uint32_t k = 0; k < w->totals.count; k++) {
        total *t = &w->totals.at[k];
        for (int j = 0; j < PARTS; j++) t->part[j] = numbered(w, counts, t->part[j]);
        if (t->current != NONE) t->current = numbered(w, counts, t->current);
    }
}

static bool assign(writer *w, uint32_t counts[REGISTER_KINDS])
{
    for (uint32_t k = 0; k < w->registers.count; k++) {
        virtual_register *v = &w->registers.at[k];
        if (v->made.until == AT_RUN)
            v->last = w->text.count + 1; /* written at bind and read by every evaluation */
        else if (v->made.until != NONE && w->plan.regions.at[v->made.until].end > v->last)
            v->last = w->plan.regions.at[v->made.until].end;
    }
    return tape_registers_assign(w->plan.hooks, w->registers.at, w->registers.count, w->text.count, counts);
}

static void take_wraps(code *c, arena *a)
{
    for (uint32_t k = 0; k < c->site_count && !a->failed; k++) {
        site *s = &c->sites[k];
        bool modular = false;
        for (int d = 0; d < s->ref.dims; d++) modular |= s->ref.at[d].modulus >= 0;
        if (modular) s->wrap = arena_take(a, MAX_DIMS * sizeof *s->wrap);
    }
}

static code *finish(writer *w, arena *a)
{
    uint32_t counts[REGISTER_KINDS];
    if (w->plan.failed || !assign(w, counts)) return a->failed = true, NULL;
    number_all(w, counts);
    give(w->plan.hooks, w->registers.at);
    give(w->plan.hooks, w->fields.at);
    w->registers.at = NULL;
    w->fields.at = NULL;
    code *c = arena_take(a, sizeof *c);
    *c = (code){.count = w->text.count,
                .bind_count = w->bind_count,
                .site_count = w->sites.count,
                .loop_count = w->loops.count,
                .total_count = w->totals.count,
                .scalars = counts[SCALAR_REGISTER] + 1,
                .blocks = counts[BLOCK_REGISTER],
                .pointers = counts[POINTER_REGISTER],
                .instructions = KEPT(&w->plan, a, w->text),
                .sites = KEPT(&w->plan, a, w->sites),
                .loops = KEPT(&w->plan, a, w->loops),
                .totals = KEPT(&w->plan, a, w->totals),
                .constants = KEPT(&w->plan, a, w->constants)};
    w->text.at = NULL;
    w->sites.at = NULL;
    w->loops.at = NULL;
    w->totals.at = NULL;
    w->constants.at = NULL;
    take_wraps(c, a);
    return a->failed ? NULL : c;
}

static size_t items_of(const plan *p, operation op)
{
    size_t count = 0;
    for (uint32_t k = 0; k < p->items.count; k++) count += p->g->nodes[p->items.at[k].n].op == op;
    return count;
}

code *tape_code_create(arena *a, const program *program, bool with_blocks)
{
    writer w = {.region = AT_BIND};
    code *c = NULL;
    if (plan_create(&w.plan, a, program, with_blocks)) {
        const size_t most = (size_t)w.plan.items.count + program->count + 2; /* without loops */
        RESERVE(&w.plan, w.registers, w.plan.items.count + 1);
        RESERVE(&w.plan, w.text, most);
        RESERVE(&w.plan, w.fields, most);
        RESERVE(&w.plan, w.sites, items_of(&w.plan, OP_LOAD) + program->count);
        RESERVE(&w.plan, w.constants, items_of(&w.plan, OP_CONST));
        write_region(&w, AT_BIND);
        put(&w, CODE_END, 0, (instruction){0}, 0);
        w.bind_count = w.text.count;
        write_region(&w, AT_RUN);
        put(&w, CODE_END, 0, (instruction){0}, 0);
        plan_release_items(&w.plan);
        c = finish(&w, a);
    }
    give(w.plan.hooks, w.registers.at);
    give(w.plan.hooks, w.text.at);
    give(w.plan.hooks, w.fields.at);
    give(w.plan.hooks, w.sites.at);
    give(w.plan.hooks, w.loops.at);
    give(w.plan.hooks, w.totals.at);
    give(w.plan.hooks, w.constants.at);
    plan_release(&w.plan);
    return c;
}
