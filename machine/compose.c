/* Composing the C text of a compiled model. See compose.h.
 *
 * Invariant: the text has only what the model, the row and the problem's traits use, and writes out what takes a
 * compiler long only where a longer text is asked for, because a first run waits for the compiler. It includes no
 * system header, and what is known when it is written is a constant in it.
 */
#include "machine/compose.h"

#include "core/stepper_body.h"
#include "lang/base/operation.h"
#include "machine/solve_text.h"
#include "machine/texts.h"

#include <stdio.h>
#include <string.h>

enum {
    SERIES_APART = 7,       /* arrays of a row of Taylor series besides the series: step/taylor.h */
    SMALL_MAX = 16,         /* numbers of a state that may stay in registers */
    WRITTEN_OUT_MAX = 150,  /* operations of the force in all stages of a step, up to which they are written out */
    WRITTEN_LATER = 4000,   /* and up to which the longer text of adaptive steps has them written out */
    FORCE_INLINE_MAX = 150, /* operations: a longer force is compiled once, and called */
    FORCE_TURNS_MAX = 40    /* operations, for an implicit row: its text has the force several times, and one call more
                             * is nothing beside the calls that solve its equations */
};

static void add_text(emit_text *t, const char *which)
{
    for (const embedded_text *e = texts_table; e->name; e++)
        if (!strcmp(e->name, which)) {
            emit_add(t, "%s\n", e->text);
            return;
        }
    emit_add(t, "#error \"%s is not among the embedded texts\"\n", which);
}

bool compose_small(const model *m) { return !model_has_families(m) && m->nv <= SMALL_MAX; }

/* ---- what is known ---- */

static void add_numbers(emit_text *t, const char *name, const double *numbers, int count)
{
    char number[EMIT_NUMBER];
    emit_add(t, "static const double %s[] = {", name);
    for (int i = 0; i < count; i++) emit_add(t, "%s%s", i ? ", " : "", emit_number(numbers[i], number));
    emit_add(t, count ? "};\n" : "0};\n");
}

/* The times at which a step evaluates the force, each once: at[m], as a fraction of the step. Stage i is at moment[i];
 * `count` is the end of the step, the first moment of the next one. A table of what depends on time alone has a place
 * for each moment. */
typedef struct moments {
    int count, *moment;
    double *at;
} moments;

/* Finds the moments of a step. False: no memory. */
static bool find_moments(const work *w, arena *a, moments *m)
{
    const size_t room = (size_t)w->stages + 2;
    *m = (moments){0, arena_room(a, room * sizeof *m->moment), arena_room(a, room * sizeof *m->at)};
    if (!m->moment || !m->at) return false;
    memset(m->moment, 0, room * sizeof *m->moment);
    const int stages = w->stages - w->fsal;
    if (w->solves && w->iterates) /* the iteration begins with the acceleration at the start */
        m->at[m->count++] = 0;
    /* the start of the step comes first, if the force is evaluated there */
    for (int start = 1; start >= 0; start--)
        for (int i = 0; i < stages; i++) {
            if ((w->c[i] == 0) != start || (row_has(w->row, KICKS) && w->unit[i] == 0)) continue;
            int k = 0;
            while (k < m->count && m->at[k] != w->c[i]) k++;
            if (w->c[i] == 1 && m->count && m->at[0] == 0) k = -1;
            m->moment[i] = k;
            if (k == m->count) m->at[m->count++] = w->c[i];
        }
    for (int i = 0; i < stages; i++)
        if (m->moment[i] < 0) m->moment[i] = m->count;
    return true;
}

bool compose_bounds_are_structure(const model *m)
{
    bool single = !model_has_families(m);
    for (uint32_t i = 0; i < m->rule_count; i++) single &= m->rules[i].instances == 1;
    return single;
}

bool compose_watched(const model *m, const chosen *c)
{
    if (row_watched(c)) return m->rule_count || m->modes || compose_small(m);
    return row_bounded_by_ends(c) && m->rule_count && compose_small(m);
}

/* Adds the text that asks after every step whether an event may have happened in it, if rules may be followed. A small
 * model has it without rules too if steps adapt, so that the object which the cache has of it serves the model with a
 * section. */
static void add_watch(emit_text *t, const composition *c)
{
    const model *m = c->model;
    if (c->width) {
        emit_add(t, "#define WATCHED %d\n#define BOUNDS %zu\n", c->bounds, m->rule_functions);
        if (c->bounds) add_text(t, "step/swing.h"), add_text(t, "step/box.h");
        return;
    }
    if (!compose_watched(m, c->chosen)) {
        emit_add(t, "#define WATCHES(w) false\n#define watch_begin(w) ((void)0)\n#define watch_ends(w) false\n");
        return;
    }
    add_text(t, "step/swing.h");
    if (c->bounds) {
        emit_add(t, "#define BOUNDS %zu\n", compose_bounds_are_structure(m) ? m->rule_functions : 0);
        emit_add(t, "#define RULES %d\n", c->rules);
        add_text(t, "step/box.h");
        add_text(t, "machine/text/watched.h");
    }
    add_text(t, "step/observe.h");
    add_text(t, "step/watch.h");
}

/* Names the functions of families.def that a compiled model calls. */
static void add_family_names(emit_text *t, const char *name)
{
    static const char *const functions[] = {"place", "step", "accept", "observe", "sync", "carry", "swing"};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        emit_add(t, "#define family_%s %s_%s\n", functions[i], name, functions[i]);
}

static const char *const family_names[] = {
#define NAME_OF(NAME, name, shared, facts) [NAME] = #name,
    FAMILIES(NAME_OF)};

/* Says which arrays the row's workspace has. */
static void add_places(emit_text *t, work w)
{
    double any;
    w.stride = 0;
    stepper_best_body()->place(&w, &any);
    emit_add(t,
             "#define PLACED(w, name) PLACED_##name\n#define PLACED_x 1\n#define PLACED_v 1\n#define PLACED_a 1\n"
             "#define PLACED_ex %d\n#define PLACED_ev %d\n#define PLACED_old %d\n#define PLACED_next_x %d\n"
             "#define PLACED_delta %d\n#define PLACED_vs %d\n#define PLACED_ks %d\n",
             w.ex != NULL, w.ev != NULL, w.old != NULL, w.next_x != NULL, w.delta != NULL, w.vs != NULL, w.ks != NULL);
}

/* Adds the numbers of each variable, for error control. */
static void add_variables(emit_text *t, const work *w, bool structure)
{
    if (!structure || !w->variable) {
        emit_add(t, "#define FACT_variables w->variables\n#define FACT_variable w->variable\n");
        return;
    }
    emit_add(t,
             "#define FACT_variables %d\n#define FACT_variable fact_variable\nstatic const size_t fact_variable[] = {",
             w->variables);
    for (int g = 0; g <= w->variables; g++) emit_add(t, "%s%zu", g ? ", " : "", w->variable[g]);
    emit_add(t, "};\n");
}

/* The functions whose values are calls. */
static const struct {
    operation op;
    int operands;
    const char *name, *texts;
} functions[] = {
#define OP(...)
#define FUNCTION(id, arity, name, texts, value) {OP_##id, arity, #name, texts},
#include "lang/base/operations.def"
#undef OP
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

/* Counts the operations of a program; a call of an elementary function counts for those of its text. */
static size_t length_of(const program *p)
{
    enum { FUNCTION_LENGTH = 16 };
    uint64_t long_ones = 0;
    size_t length = 0;
    for (size_t i = 0; i < FUNCTIONS; i++) long_ones |= (uint64_t)(*functions[i].texts != 0) << functions[i].op;
    for (uint32_t i = 0; i < p->graph->count; i++)
        length += long_ones >> p->graph->nodes[i].op & 1 ? FUNCTION_LENGTH : 1;
    return length;
}

/* Adds the constants that ROW and FACT name, as the plan computes them. */
static bool add_facts(emit *e, const composition *c, bool structure)
{
    emit_text *t = &e->text;
    const row *r = c->chosen->row;
    work w = stepper_plan(c->problem, c->chosen, NULL);
    coef *memory = arena_room(t->arena, (work_plan_size(&w) + 1) * sizeof *memory);
    if (!memory) return false;
    w = stepper_plan(c->problem, c->chosen, memory);
    moments m;
    if (!find_moments(&w, t->arena, &m)) return false;
    const int stages = w.stages ? w.stages : 1, constants = (int)work_constants(&w);
#define ROW_IS(member) emit_add(t, "#define ROW_" #member " %d\n", r->member)
#define FACT_IS(member) emit_add(t, "#define FACT_" #member " %d\n", w.member)
    emit_add(
        t, "#define ROW(w, member) ROW_##member\n#define FACT(w, member) FACT_##member\n#define FACT_unit fact_unit\n");
    ROW_IS(compensated), ROW_IS(adaptive), ROW_IS(sizes), ROW_IS(orders), ROW_IS(density);
    FACT_IS(velocity), FACT_IS(linear), FACT_IS(constant), FACT_IS(affine), FACT_IS(carried), FACT_IS(known),
        FACT_IS(kept), FACT_IS(iterates), FACT_IS(fsal), FACT_IS(ending), FACT_IS(closing), FACT_IS(opening),
        FACT_IS(second), FACT_IS(fused), FACT_IS(waits), FACT_IS(solves), FACT_IS(solves_x), FACT_IS(means),
        FACT_IS(direct), FACT_IS(order), FACT_IS(linears), FACT_IS(squares), FACT_IS(summed), FACT_IS(expands);
    emit_add(t, "#define FACT_stages %d\n#define DRIFTS_FIRST %d\n", stages, row_has(r, KICKS) && w.unit[0] == 0);
    if (structure)
        emit_add(t, "#define FACT_nx %zu\n#define FACT_nv %zu\n", w.nx, w.nv);
    else
        emit_add(t, "#define FACT_nx w->nx\n#define FACT_nv w->nv\n");
    emit_add(t, "#define LIVE(w, k) (fact_unit[k] != 0)\n#define FACT_c fact_c\nstatic const int fact_moment[] = {%d",
             m.moment[0]);
    for (int i = 1; i < stages; i++) emit_add(t, ", %d", m.moment[i]);
    emit_add(t, "};\n");
    add_numbers(t, "fact_unit", w.unit, constants);
    add_numbers(t, "fact_c", w.c, w.stages);
    add_numbers(t, "fact_at", m.at, m.count);
    e->moments = m.count;
    if (w.expands && (structure || c->width))
        emit_add(t, "#define FACT_series %zu\n", w.series);
    else if (w.expands)
        emit_add(t, "#define FACT_series w->series\n");
    add_variables(t, &w, structure);
    emit_add(t, "#define CARRIED %zu\n#define CONSTANTS %d\n", stepper_carried(w), w.linears + w.squares);
    const bool small = compose_small(c->model);
    size_t arrays = stepper_arrays(w);
    if (w.expands && small && !c->width) {
        arrays = SERIES_APART;
        emit_add(t, "#define SERIES_PLACED 0\n");
    }
    emit_add(t, "#define MOMENTS %d\n#define ARRAYS %zu\n#define SMALL %d\n#define NUMBERS %zu\n\n", m.count, arrays,
             c->width || small, structure ? w.nv : 0);
    if (small && !c->width) {
        emit_add(t,
                 "#define FIRST(w) false\n#define BEGINS 0\n#define KNOWN(w) (%d && (w)->fresh)\n#define "
                 "CHECKS(w) false\n",
                 r->adaptive || compose_watched(c->model, c->chosen));
        add_places(t, w);
    }
    const bool many_solves = w.solves && !solve_text_single(&w);
    /* the text of an equation also has the derivatives of the force */
    const size_t length = w.solves ? c->model->graph->count : length_of(c->programs[0].program);
    const size_t all = (size_t)stages * length;
    const bool later = r->adaptive && !w.solves && !w.iterates && all > WRITTEN_OUT_MAX && all <= WRITTEN_LATER;
    e->longer = e->longer || (structure && stages > 1 && later);
    if (structure && !many_solves && (all <= WRITTEN_OUT_MAX || (c->written && later)))
        emit_add(t, "#define EACH_STAGE(i, count) WRITTEN_OUT for (int i = 0; i < (count); i++)\n");
    add_family_names(t, family_names[r->family]);
    return true;
}

/* ---- the family ---- */

/* Adds the row's family, the text that it shares with others, and Newton's method where an equation is solved. */
static void add_family(emit_text *t, const composition *c)
{
    static const struct {
        const char *text, *shared;
    } families[] = {
#define TEXT_OF(NAME, name, shared, facts) [NAME] = {"step/" #name ".h", shared},
        FAMILIES(TEXT_OF)};
    const row *r = c->chosen->row;
    if (r->adaptive) {
        add_text(t, "step/norm.h");
        add_text(t, "step/control.h");
    } else {
        emit_add(
            t, "#define control_first(w) STEP_OK\n#define control_begin(w) STEP_OK\n#define control_last_is_first(w) "
               "false\n#define control_known(w, known) "
               "((void)0)\n#define control_norm(w, x, v) (CLOCK(0))\n#define control_joint(high, low) (high)\n"
               "#define control_log2(x) (x)\n#define control_exp2(x) (x)\n#define control_spoil(w, where, share) "
               "((void)(where), (void)(share))\n"
               "typedef struct norm_correction { clock share, roundings, change; } norm_correction;\n"
               "#define control_corrections(w, r, ks, count) ((norm_correction){CLOCK(0), CLOCK(0), CLOCK(0)})\n"
               "#define control_size(w) (w)->h\n#define control_judge(w) EVERY\n#define control_judge_own(w) EVERY\n");
    }
    if (r->density)
        add_text(t, "step/density.h");
    else
        emit_add(t, "#define density_begin(w) STEP_OK\n#define density_judge(w) EVERY\n");
    const work plan = stepper_plan(c->problem, c->chosen, NULL);
    if (plan.solves || plan.iterates) add_text(t, "step/judge.h");
    if (plan.solves)
        add_text(t, "step/newton.h");
    else
        emit_add(t, "#define NEWTON_NOW (-1)\n#define newton_increment(w, g, s, x, u, stage) STEP_OK\n#define "
                    "solve_factor(w, where, s, ax, av, t, x, v) STEP_OK\n"
                    "#define solve_back(w, r) ((void)0)\n#define solve_apply(w, c, y, out) ((void)0)\n");
    if (*families[r->family].shared) add_text(t, families[r->family].shared);
    add_text(t, families[r->family].text);
    add_text(t, "step/plan.h");
}

/* ---- functions and operations ---- */

int compose_width(void)
{
#if defined __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma"))
        return 8;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return 4;
    return 2;
#elif defined __aarch64__
    return 2;
#else
    return 1;
#endif
}

/* Returns whether one of the first `count` functions is used and needs the text of this name. */
static bool needs(uint64_t used, size_t count, const char *text, size_t length)
{
    for (size_t i = 0; i < count; i++) {
        const char *at = used >> functions[i].op & 1 ? functions[i].texts : "";
        for (size_t word; *at; at += word + (at[word] == ' '))
            if ((word = strcspn(at, " ")) == length && memcmp(at, text, length) == 0) return true;
    }
    return false;
}

/* Adds the texts of the functions that a set of operations needs. */
static void add_functions(emit_text *t, uint64_t used)
{
    char name[64];
    add_text(t, "step/functions/core.h");
    add_text(t, "step/functions/plain.h");
    for (size_t i = 0; i < FUNCTIONS; i++) {
        const char *at = used >> functions[i].op & 1 ? functions[i].texts : "";
        for (size_t word; *at; at += word + (at[word] == ' ')) {
            word = strcspn(at, " ");
            snprintf(name, sizeof name, "step/functions/%.*s.h", (int)word, at);
            if (!needs(used, i, at, word)) add_text(t, name);
        }
    }
    add_text(t, "step/functions/end.h");
}

/* Adds the operations over doubles, such as op_7, and over vectors of doubles (`reals`), such as ops_7. */
static void add_operations(emit *e, int width)
{
    emit_text *t = &e->text;
    add_functions(t, e->used | (width == 1 ? e->used_lanes : 0));
    emit_add(t, "#define OF(f) motus_##f\n#define FUSE(a, b, c) fma(a, b, c)\n#define WHEN(condition, a, b) "
                "((condition) ? (a) : (b))\n");
    emit_operations(e, e->used, "double", "op");
    emit_add(t, "#undef OF\n#undef FUSE\n#undef WHEN\n\n");
    if (width == 1)
        emit_add(t, "typedef double reals;\n#define MANY(x) (x)\n#define LANE_OF(x, l) (x)\n#define OF_LANES(f) "
                    "motus_##f\n#define CHOOSE(m, a, b) ((m) ? (a) : (b))\n#define MANY_FUSED(a, b, c) fma(a, b, c)\n"
                    "#define OF(f) motus_##f\n#define FUSE(a, b, c) fma(a, b, c)\n#define WHEN(condition, a, b) "
                    "((condition) ? (a) : (b))\n");
    if (width > 1) {
        emit_add(t, "#define LANES %d\n", width);
        add_text(t, "step/functions/lanes.h");
        add_functions(t, e->used_lanes);
        emit_add(
            t,
            "typedef motus_reals_x%d reals;\n#define MANY(x) ((x) - (reals){0})\n#define LANE_OF(x, l) (x)[l]\n"
            "#define OF_LANES(f) motus_##f##_x%d\n#define CHOOSE(m, a, b) motus_select_x%d(m, MANY(a), MANY(b))\n"
            "#define MANY_FUSED(a, b, c) motus_fused_x%d(MANY(a), MANY(b), MANY(c))\n#define OF(f) motus_##f##_x%d\n"
            "#define FUSE(a, b, c) motus_fused_x%d(a, b, c)\n#define WHEN(condition, a, b) motus_select_x%d(condition, "
            "MANY(a), MANY(b))\n",
            width, width, width, width, width, width, width);
    }
    if (width) emit_operations(e, e->used_lanes, "reals", "ops");
    emit_add(t, "#undef OF\n#undef FUSE\n#undef WHEN\n\n");
}

/* ---- Taylor series ---- */

/* Defines the names by which recurrences call functions. A function whose text no operation of the model needs becomes
 * 0, since no recurrence that calls it is used. */
static void add_named(emit *e)
{
    const bool lanes = e->lanes || e->series_wide;
    const char *direct = lanes ? "#define series_of_%s OF_LANES(%s)\n" : "#define series_of_%s motus_%s\n";
    emit_add(&e->text, direct, "sqrt", "sqrt");
    for (size_t i = 0; i < FUNCTIONS; i++) {
        const char *name = functions[i].name, *texts = functions[i].texts, *last = strrchr(texts, ' ');
        last = last ? last + 1 : texts;
        if (*texts && !needs(lanes ? e->used_lanes : e->used, FUNCTIONS, last, strlen(last)))
            emit_add(&e->text, "#define series_of_%s(...) SERIES_NUMBER(0.0)\n", name);
        else if (lanes || !*texts || operation_is(functions[i].op, IN_PAIRS))
            emit_add(&e->text, direct, name, name);
        else /* compiled once, and called */
            emit_add(&e->text,
                     "__attribute__((noinline)) static double series_of_%s(double a%s) { return motus_%s(a%s); }\n",
                     name, functions[i].operands > 1 ? ", double b" : "", name, functions[i].operands > 1 ? ", b" : "");
    }
}

/* Lets real, FMA, PICK and SOME be those of vectors, for series along an index; all other texts have those of
 * doubles. */
static void add_vector_names(emit_text *t)
{
    static const char *const names[][2] = {{"real", "real reals"},
                                           {"FMA", "FMA(a, b, c) MANY_FUSED(a, b, c)"},
                                           {"PICK", "PICK(where, a, b) CHOOSE(where, a, b)"},
                                           {"SOME", "SOME(where) OF_LANES(any)(where)"}};
    for (int k = 0; k < 4; k++)
        emit_add(t, "#pragma push_macro(\"%s\")\n#undef %s\n#define %s\n", names[k][0], names[k][0], names[k][1]);
}

static void drop_vector_names(emit_text *t)
{
    emit_add(t, "#pragma pop_macro(\"real\")\n#pragma pop_macro(\"FMA\")\n#pragma pop_macro(\"PICK\")\n#pragma "
                "pop_macro(\"SOME\")\ntypedef __UINTPTR_TYPE__ uintptr_t;\n");
}

static void add_series(emit *e, int length)
{
    emit_text *t = &e->text;
    add_named(e);
    emit_add(t,
             "#define SERIES_OF(f) series_of_##f\n#define SERIES_FMA(a, b, c) %s(a, b, c)\n#define SERIES_PICK(where, "
             "a, b) %s(where, a, b)\n",
             e->series_wide ? "MANY_FUSED" : "FMA", e->series_wide ? "CHOOSE" : "PICK");
    if (e->series_wide) /* a call would not keep vectors in registers */
        emit_add(t, "#define SERIES_FUNCTION static inline __attribute__((always_inline))\n");
    else if (!e->lanes)
        emit_add(t, "#define SERIES_SELDOM __attribute__((noinline)) static\n");
    if (e->series_wide) add_vector_names(t);
    add_text(t, "step/reciprocals.h");
    add_text(t, "step/series.h");
    emit_add(t, "enum { length = %d };\n", length);
    emit_series_operations(e, e->lanes || e->series_wide ? "ops" : "op");
    if (e->series_wide) drop_vector_names(t);
}

/* ---- windows ---- */

/* Tells whether a window of the numbers can go ahead of the others: nothing is solved, a kick needs one acceleration,
 * and steps have one size. */
static bool by_number(const composition *c)
{
    const work plan = stepper_plan(c->problem, c->chosen, NULL);
    return row_has(c->chosen->row, BY_NUMBER) && !c->chosen->row->adaptive && !plan.solves && !plan.iterates &&
           !plan.means;
}

static void add_windows(emit *e)
{
    emit_text *t = &e->text;
    add_text(t, "machine/text/tiling.h");
    add_text(t, "machine/text/window.h");
    emit_add(t, "#define NUMBER double\n#define NUMBER_OF(x) (x)\n#define NUMBER_AT(array, k) (array)[k]\n#define "
                "window_number window_keep\n");
    add_text(t, "machine/text/window_put.h");
    if (!e->uses_vectors) return;
    emit_add(t, "#define NUMBER reals\n#define NUMBER_OF(x) MANY(x)\n#define NUMBER_AT(array, k) (*(reals_anywhere "
                "*)&(array)[k])\n"
                "#define window_number window_keep_many\n#undef FMA\n#define FMA(a, b, c) MANY_FUSED(a, b, c)\n");
    add_text(t, "machine/text/window_put.h");
    emit_add(t, "#undef FMA\n#define FMA(a, b, c) fma(a, b, c)\n");
}

/* Adds FITS(u), which tells whether the text is right for the numbers u. */
static void add_assumed(emit *e)
{
    char number[EMIT_NUMBER];
    emit_add(&e->text, "#define FITS(u) (true");
    for (uint32_t k = 0; k < e->assumed_count; k++)
        emit_add(&e->text, " && (u)[%u] == %s", e->assumed[k].place, emit_number(e->assumed[k].value, number));
    emit_add(&e->text, ")\n");
}

/* ---- the whole ---- */

bool compose(emit *e, const composition *c)
{
    emit_text *t = &e->text;
    const work plan = stepper_plan(c->problem, c->chosen, NULL);
    const bool by_turns = plan.solves && plan.iterates, structure = !model_has_families(c->model), lanes = c->width > 0,
               forced = !strcmp(c->programs[0].name, "compiled_force"),
               windowed = forced && c->locality && c->locality->divisible;
    const bool local = windowed && c->locality->local && !c->model->driven && by_number(c);
    e->literal = structure;
    e->uses_two = false;
    e->arrays = c->model->arrays;
    e->vectors = !lanes && compose_width() > 1;
    e->series_may_be_wide = !c->model->driven;
    const size_t inlined = !lanes && by_turns ? FORCE_TURNS_MAX : FORCE_INLINE_MAX;
    for (size_t i = 0; i < c->program_count; i++) {
        const bool called = (!i && forced) || (c->bounds && c->programs[i].along);
        e->separate = called && length_of(c->programs[i].program) > inlined;
        e->along = c->programs[i].along;
        e->windowed = !i && windowed;
        e->series = c->programs[i].series ? plan.expands + 1 : 0;
        e->two = !i && forced && structure && !lanes && c->written && c->chosen->row->adaptive;
        emit_program(e, c->programs[i].program, c->programs[i].name, c->programs[i].terms);
    }
    e->longer = e->longer || e->uses_two;
    if (lanes) e->used_lanes |= OPERATION_BIT(MIN) | OPERATION_BIT(MAX); /* reductions use them */
    e->series = plan.expands;
    const emit_text bodies = *t;
    const int own = e->uses_vectors ? compose_width() : e->terms ? 4 : 0, width = lanes ? c->width : own;
    *t = (emit_text){.arena = bodies.arena};
    emit_add(
        t, "/* A model of motion, compiled by motus: its acceleration, a method, and the loop that advances them. */\n"
           "typedef double coef;\ntypedef struct row row;\n");
    add_text(t, "machine/text/freestanding.h");
    if (!add_facts(e, c, structure)) return false;
    emit_add(t, "#define DRIVEN %d\n#define TERMS %u\n#define LANES_OF_TIME %d\n#define FORCED %d\n#define MODES %zu\n",
             c->model->driven, e->terms, width, forced, c->model->modes);
    emit_add(t, "#define AT(array, element) (array)[element]\n");
    add_assumed(e);
    if (lanes) {
        emit_add(t,
                 "#define OWN_CLOCK %d\n#define BOUNDED %d\n#define GROUPS %d\n#define WIDTH %d\n#define ITERATES %d\n"
                 "#define EVERY_GROUP(DO)",
                 c->own_clock, c->model->boundary_count > 0, c->groups, c->width, by_turns);
        for (int group = 0; group < c->groups; group++) emit_add(t, " DO(%d)", group);
        emit_add(t, "\n");
    }
    if (windowed)
        emit_add(t,
                 "#define ADVANCE_STEP __attribute__((noinline)) static\n#define WINDOWED 1\n#define LOCAL %d\n#define "
                 "FIRST_ORDER %d\n",
                 local, c->problem->traits.first_order);
    if (e->terms) emit_add(t, "#define accel_in compiled_accel_in\n#define accel_now compiled_accel_now\n");
    if (!lanes) add_text(t, "core/scalar.h");
    add_operations(e, width);
    if (lanes) add_text(t, "machine/text/lanes_scalar.h");
    add_text(t, "step/work.h");
    if (e->series) add_series(e, e->series + 1);
    add_text(t, "machine/text/host.h");
    if (e->uses_two) add_text(t, "machine/text/two.h");
    if (e->wraps)
        emit_add(t, "#define WRAPS\n/* The mathematical k mod n; it mostly is k. */\n"
                    "static inline int64_t wrapped(int64_t k, int64_t n) { return (uint64_t)k < (uint64_t)n ? k : (k "
                    "%% n + n) %% n; }\n");
    if (e->uses_vectors) {
        emit_add(t, "#define WIDTH %d\n", width);
        add_text(t, "machine/text/index_lanes.h");
    }
    if (windowed) add_windows(e);
    emit_add(t, "\n%s", bodies.bytes ? bodies.bytes : "");
    add_text(t, "machine/text/compiled.h");
    if (lanes) {
        add_text(t, "machine/text/lanes_job.h");
        if (c->solves && !solve_text_write(t, c)) return false;
        add_text(t, c->solves ? "machine/text/solve.h" : "machine/text/solve_none.h");
        emit_add(t, "%s", c->glue);
    }
    if (windowed) add_text(t, "machine/text/pass.h");
    add_family(t, c);
    if (!lanes || c->chosen->row->adaptive) add_text(t, "step/advance.h");
    add_watch(t, c);
    if (!lanes) add_text(t, "step/loop.h");
    if (local) add_text(t, "machine/text/tiled.h");
    for (const char *const *last = c->last; *last; last++) add_text(t, *last);
    return !t->arena->failed;
}
