/* Composing the C text of a compiled model. See compose.h.
 *
 * Invariant: only what the model, the row and the problem's traits use is in the text, since a compiler's time is what a first run waits for; no
 * system header is read, and what is known when the text is written stands there as a constant, so that nothing else is translated.
 */
#include "run/compose.h"

#include "core/stepper_body.h"
#include "lang/base/operation.h"
#include "run/texts.h"

#include <string.h>

enum {
    SMALL_MAX = 16,                  /* numbers: what registers, or at least the fastest loads, may hold */
    WRITTEN_OUT_MAX = 200,           /* operations in all stages of a step, up to which they are written out */
    FORCE_INLINE_MAX = 150           /* operations: a longer force is compiled once, and called */
};

static void add_text(emit_text *t, const char *which)
{
    for (const embedded_text *e = texts_table; e->name; e++)
        if (!strcmp(e->name, which))
            emit_add(t, "%s\n", e->text);
}

/* Scalar models have as many numbers in every run; families do not. */
static bool sizes_are_structure(const model *m)
{
    for (uint32_t i = 0; i < m->state_count; i++)
        if (m->states[i].dims > 0)
            return false;
    return true;
}

/* ---- what is known ---- */

static void add_numbers(emit_text *t, const char *name, const double *numbers, int count)
{
    char number[EMIT_NUMBER];
    emit_add(t, "static const double %s[] = {", name);
    for (int i = 0; i < count; i++)
        emit_add(t, "%s%s", i ? ", " : "", emit_number(numbers[i], number));
    emit_add(t, "};\n");
}

/* The constants that ROW and FACT lead to: the same that work_plan finds. */
static void add_facts(emit_text *t, const composition *c, bool structure)
{
    static const char *const families[] = {[SPLITTING] = "SPLITTING", [RUNGE_KUTTA] = "RUNGE_KUTTA", [TWO_STEP] = "TWO_STEP", [IMPLICIT] = "IMPLICIT",
                                           [EXACT] = "EXACT"};
    static const char *const recurrences[] = {[VERLET] = "VERLET", [VERLET_LITERAL] = "VERLET_LITERAL", [BEEMAN] = "BEEMAN"};
    const row *r = c->chosen->row;
    const work w = stepper_plan(c->problem, c->chosen, 0, 1);
    const int stages = w.stages ? w.stages : 1;
    emit_add(t, "#define ROW(w, member) ROW_##member\n#define ROW_family %s\n#define ROW_two_step %s\n#define ROW_compensated %d\n#define ROW_gyroscopic %d\n"
                "#define ROW_newmark %d\n",
             families[r->family], recurrences[r->two_step], r->compensated, r->gyroscopic, r->newmark);
    emit_add(t, "#define FACT(w, member) FACT_##member\n#define FACT_velocity %d\n#define FACT_linear %d\n#define FACT_constant %d\n", w.velocity, w.linear, w.constant);
    if (structure)
        emit_add(t, "#define FACT_nx %zu\n#define FACT_nv %zu\n", w.nx, w.nv);
    else
        emit_add(t, "#define FACT_nx w->nx\n#define FACT_nv w->nv\n");
    emit_add(t, "#define FACT_stages %d\n#define FACT_known %d\n#define FACT_merged %d\n#define FACT_kicks 0x%xu\n#define FACT_drifts 0x%xu\n"
                "#define FACT_weights 0x%xu\n", stages, w.known, w.merged, w.kicks, w.drifts, w.weights);
    emit_add(t, "#define FACT_terms fact_terms\n#define FACT_moment fact_moment\n#define FACT_c fact_c\n#define FACT_at fact_at\n");
    emit_add(t, "static const unsigned fact_terms[] = {0x%xu, 0x%xu, 0x%xu, 0x%xu};\n", w.terms[0], w.terms[1], w.terms[2], w.terms[3]);
    emit_add(t, "static const int fact_moment[] = {%d", w.moment[0]);
    for (int i = 1; i < stages; i++)
        emit_add(t, ", %d", w.moment[i]);
    emit_add(t, "};\n");
    add_numbers(t, "fact_c", w.c, stages);
    add_numbers(t, "fact_at", w.at, w.moments ? w.moments : 1);
    double *list[CARRY_MAX];
    emit_add(t, "#define CARRIED %d\n", work_carry(&w, list));
    emit_add(t, "#define MOMENTS %d\n#define ARRAYS %zu\n#define SMALL %d\n#define NUMBERS %zu\n\n", w.moments,
             stepper_arrays(w), c->width || (structure && w.nv <= SMALL_MAX),
             structure ? w.nv : 0);
    if (structure && (size_t)stages * c->model->graph->count <= WRITTEN_OUT_MAX)
        emit_add(t, "#define EACH_STAGE(i, count) WRITTEN_OUT for (int i = 0; i < (count); i++)\n");
}

/* ---- the family ---- */

/* The family's text, and for the others what lets the loop's text compile without them. */
static void add_family(emit_text *t, const composition *c)
{
    static const struct { family family; const char *text, *without; } families[] = {
        {SPLITTING, "step/splitting.h", "#define splitting_step(w) STEP_OK\n#define splitting_sync(w, v) ((void)0)\n#define splitting_look(w) STEP_OK\n"},
        {RUNGE_KUTTA, "step/runge_kutta.h", "#define runge_kutta_step(w) STEP_OK\n"},
        {TWO_STEP, "step/two_step.h", "#define verlet_step(w) STEP_OK\n#define beeman_step(w) STEP_OK\n#define literal_step(w) STEP_OK\n"
                                      "#define verlet_look(w) STEP_OK\n#define beeman_look(w) STEP_OK\n#define literal_look(w) STEP_OK\n"
                                      "#define verlet_sync(w, v) ((void)0)\n#define beeman_sync(w, v) ((void)0)\n#define literal_sync(w, v) ((void)0)\n"},
        {IMPLICIT, "step/implicit.h", "#define implicit_step(w) STEP_OK\n"}};
    const row *r = c->chosen->row;
    if (r->family == IMPLICIT || r->gyroscopic || (r->family == TWO_STEP && r->two_step != BEEMAN && c->problem->traits.velocity))
        add_text(t, "step/newton.h");
    else
        emit_add(t, "#define increment(w, g, s, u, t) STEP_OK\n#define solve_factor(w, s, ax, av, t, x, v) STEP_OK\n#define solve_back(w, r) ((void)0)\n"
                    "#define solve_apply(w, c, y, out) ((void)0)\n");
    if (r->family == IMPLICIT)
        add_text(t, "step/runge_kutta.h");             /* its stages are summed the same way */
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        if (families[i].family == r->family)
            add_text(t, families[i].text);
        else if (!(r->family == IMPLICIT && families[i].family == RUNGE_KUTTA))
            emit_add(t, "%s", families[i].without);
}

/* ---- functions and operations ---- */

int compose_width(void)
{
#if defined __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma"))
        return 8;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return 4;
    return 2;
#elif defined __aarch64__
    return 2;
#else
    return 1;
#endif
}

/* The texts of the functions that a set of operations needs. */
static void add_functions(emit_text *t, uint64_t used)
{
#define ANY_OF(a, b, c, d) (OPERATION_BIT(a) | OPERATION_BIT(b) | OPERATION_BIT(c) | OPERATION_BIT(d))
    static const uint64_t hyperbolic = ANY_OF(SINH, SINH, COSH, TANH), circular = ANY_OF(SIN, SIN, COS, TAN),
                          inverse = ANY_OF(ASIN, ACOS, ATAN, ATAN2), root = ANY_OF(CBRT, CBRT, HYPOT, HYPOT), power = OPERATION_BIT(POW),
                          error = OPERATION_BIT(ERF), logarithm = OPERATION_BIT(LOG) | power,
                          exponential = OPERATION_BIT(EXP) | power | hyperbolic | error,
                          plain = ANY_OF(SQRT, ABS, FLOOR, MOD) | ANY_OF(MIN, MIN, MAX, SIGN);
    const struct { uint64_t needed_by; const char *text; } texts[] = {
        {~(uint64_t)0, "step/functions_core.h"}, {plain, "step/functions_plain.h"}, {exponential, "step/functions_exponential.h"},
        {logarithm, "step/functions_logarithm.h"}, {power, "step/functions_power.h"}, {hyperbolic, "step/functions_hyperbolic.h"},
        {circular, "step/functions_circular.h"}, {inverse, "step/functions_inverse.h"}, {root, "step/functions_root.h"},
        {error, "step/functions_error.h"}, {~(uint64_t)0, "step/functions_end.h"}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (used & texts[i].needed_by)
            add_text(t, texts[i].text);
#undef ANY_OF
}

/* Operations over doubles, op_7, and over vectors of them, ops_7, which are called reals. */
static void add_operations(emit *e, int width)
{
    emit_text *t = &e->text;
    add_functions(t, e->used | (width == 1 ? e->used_lanes : 0));
    emit_add(t, "#define OF(f) motus_##f\n#define FUSE(a, b, c) fma(a, b, c)\n#define WHEN(condition, a, b) ((condition) ? (a) : (b))\n");
    emit_operations(e, e->used, "double", "op");
    emit_add(t, "#undef OF\n#undef FUSE\n#undef WHEN\n\n");
    if (width == 1)
        emit_add(t, "typedef double reals;\n#define MANY(x) (x)\n#define LANE_OF(x, l) (x)\n#define OF_LANES(f) motus_##f\n#define CHOOSE(m, a, b) ((m) ? (a) : (b))\n#define MANY_FUSED(a, b, c) fma(a, b, c)\n"
                    "#define OF(f) motus_##f\n#define FUSE(a, b, c) fma(a, b, c)\n#define WHEN(condition, a, b) ((condition) ? (a) : (b))\n");
    if (width > 1) {
        emit_add(t, "#define LANES %d\n", width);
        add_text(t, "step/functions_lanes.h");
        add_functions(t, e->used_lanes);
        emit_add(t, "typedef motus_reals_x%d reals;\n#define MANY(x) ((x) - (reals){0})\n#define LANE_OF(x, l) (x)[l]\n"
                    "#define OF_LANES(f) motus_##f##_x%d\n#define CHOOSE(m, a, b) motus_select_x%d(m, MANY(a), MANY(b))\n"
                    "#define MANY_FUSED(a, b, c) motus_fused_x%d(MANY(a), MANY(b), MANY(c))\n#define OF(f) motus_##f##_x%d\n"
                    "#define FUSE(a, b, c) motus_fused_x%d(a, b, c)\n#define WHEN(condition, a, b) motus_select_x%d(condition, MANY(a), MANY(b))\n",
                 width, width, width, width, width, width, width);
    }
    if (width)
        emit_operations(e, e->used_lanes, "reals", "ops");
    emit_add(t, "#undef OF\n#undef FUSE\n#undef WHEN\n\n");
}

/* ---- windows ---- */

/* Whether every text of the row moves numbers one by one, so that a window of them can go ahead of the others. */
static bool by_number(const row *r, const traits *t)
{
    return (r->family == SPLITTING && !r->gyroscopic) || r->family == RUNGE_KUTTA || (r->family == TWO_STEP && !t->velocity);
}

static void add_windows(emit *e)
{
    emit_text *t = &e->text;
    add_text(t, "step/tiling.h");
    add_text(t, "step/window.h");
    emit_add(t, "#define NUMBER double\n#define NUMBER_OF(x) (x)\n#define NUMBER_AT(array, k) (array)[k]\n#define window_number window_keep\n");
    add_text(t, "step/window_put.h");
    if (!e->uses_vectors)
        return;
    emit_add(t, "#define NUMBER reals\n#define NUMBER_OF(x) MANY(x)\n#define NUMBER_AT(array, k) (*(reals_anywhere *)&(array)[k])\n"
                "#define window_number window_keep_many\n#undef FMA\n#define FMA(a, b, c) MANY_FUSED(a, b, c)\n");
    add_text(t, "step/window_put.h");
    emit_add(t, "#undef FMA\n#define FMA(a, b, c) fma(a, b, c)\n");
}

/* ---- the whole ---- */

bool compose(emit *e, const composition *c)
{
    emit_text *t = &e->text;
    const bool structure = sizes_are_structure(c->model), lanes = c->width > 0, windowed = c->locality && c->locality->divisible;
    const bool local = windowed && c->locality->local && !c->model->driven && by_number(c->chosen->row, &c->problem->traits);
    e->literal = structure;
    e->arrays = c->model->arrays;
    e->vectors = !lanes && compose_width() > 1;
    for (size_t i = 0; i < c->program_count; i++) {
        e->separate = !i && c->model->graph->count > FORCE_INLINE_MAX;
        e->windowed = !i && windowed;
        emit_program(e, c->programs[i].program, c->programs[i].name, c->programs[i].terms);
    }
    if (lanes)
        e->used_lanes |= OPERATION_BIT(MIN) | OPERATION_BIT(MAX);          /* what is recorded wants them */
    const emit_text bodies = *t;
    const int own = e->uses_vectors ? compose_width() : e->terms ? 4 : 0, width = lanes ? c->width : own;
    *t = (emit_text){.arena = bodies.arena};
    emit_add(t, "/* A model of motion, compiled by motus: its acceleration, a method, and the loop that advances them. */\n"
                "typedef double coef;\ntypedef struct row row;\n#define ROW_CARD\n");
    add_text(t, "step/freestanding.h");
    add_text(t, "step/row.h");
    add_facts(t, c, structure);
    emit_add(t, "#define DRIVEN %d\n#define TERMS %u\n#define LANES_OF_TIME %d\n", c->model->driven, e->terms, width);
    emit_add(t, "#define AT(array, element) (array)[element]\n");
    if (lanes) {
        emit_add(t, "#define BOUNDED %d\n#define GROUPS %d\n#define WIDTH %d\n#define EVERY_GROUP(DO)", c->model->boundary_count > 0, c->groups, c->width);
        for (int group = 0; group < c->groups; group++)
            emit_add(t, " DO(%d)", group);
        emit_add(t, "\n");
    }
    if (windowed)
        emit_add(t, "#define ADVANCE_STEP __attribute__((noinline)) static\n#define WINDOWED 1\n#define LOCAL %d\n#define COMPANIONS %d\n", local, c->problem->traits.companions);
    if (e->terms)
        emit_add(t, "#define accel_in compiled_accel_in\n#define accel_now compiled_accel_now\n");
    if (!lanes)
        add_text(t, "step/scalar.h");
    add_operations(e, width);
    if (lanes)
        add_text(t, "step/lanes_scalar.h");
    add_text(t, "step/work.h");
    add_text(t, "step/host.h");
    if (e->wraps)
        emit_add(t, "#define WRAPS\n/* The mathematical k mod n; it mostly is k. */\n"
                    "static inline int64_t wrapped(int64_t k, int64_t n) { return (uint64_t)k < (uint64_t)n ? k : (k %% n + n) %% n; }\n");
    if (e->uses_vectors) {
        emit_add(t, "#define WIDTH %d\n", width);
        add_text(t, "step/index_lanes.h");
    }
    if (windowed)
        add_windows(e);
    emit_add(t, "\n%s", bodies.bytes ? bodies.bytes : "");
    add_text(t, "step/compiled.h");
    if (lanes) {
        add_text(t, "step/lanes_job.h");
        emit_add(t, "%s", c->glue);
    }
    if (windowed)
        add_text(t, "step/pass.h");
    add_family(t, c);
    add_text(t, "step/advance.h");
    if (!lanes)
        add_text(t, "step/loop.h");
    if (local)
        add_text(t, "step/tiled.h");
    for (const char *const *last = c->last; *last; last++)
        add_text(t, *last);
    return !t->arena->failed;
}
