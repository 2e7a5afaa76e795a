/* The table of limits in the manual has the numbers of the code, all of them, and no row besides. */
#include "cli/files/file.h"
#include "cli/model/share.h"
#include "core/solver.h"
#include "lang/model/model.h"
#include "lang/model/switches.h"
#include "lang/read/verify.h"
#include "lang/tree/parse_parts.h"
#include "machine/compiler.h"
#include "machine/compose.h"

#include "test/given.h"

/* A limit that only one file knows is named by that file and what it says there. */
typedef struct limit {
    const char *what;
    double most;
    const char *file, *says;
} limit;

static const limit limits[] = {
    {"bytes of a model, and of each `--set`", SOURCE_BYTES_MAX, NULL, NULL},
    {"bytes of a name", MOTUS_NAME_MAX - 1, NULL, NULL},
    {"statements", SOURCE_STATEMENTS_MAX, NULL, NULL},
    {"brackets within one another", SOURCE_NESTING_MAX, NULL, NULL},
    {"brackets, powers and `not` within one another", DEPTH_MAX, NULL, NULL},
    {"brackets and definitions within one another", MODEL_DEPTH_MAX, NULL, NULL},
    {"definitions, functions or initial values each of which uses the next", MODEL_CHAIN_MAX, NULL, NULL},
    {"boundary lines each of which uses the next", MODEL_CHAIN_MAX, "lang/lower/lower_index.c",
     "l->chain > MODEL_CHAIN_MAX"},
    {"parameters each of which uses the next, between an expression and what `diff` differentiates it by",
     MODEL_CHAIN_MAX, "lang/lower/lower_diff.c", "d->chain == MODEL_CHAIN_MAX"},
    {"families of quantities each of which uses the next", 4 * MAX_LEVELS, "lang/lower/lower_name.c",
     "inner.chain > MAX_LEVELS * 4"},
    {"arguments of a function", MODEL_ARGUMENTS_MAX, NULL, NULL},
    {"components of a vector", MODEL_COMPONENTS_MAX, NULL, NULL},
    {"numbers of a matrix", MODEL_COMPONENTS_MAX, "lang/lower/lower.c", "columns > MODEL_COMPONENTS_MAX"},
    {"indices of a family, or of one sum", MAX_DIMS, NULL, NULL},
    {"indices that run within one another", MAX_LEVELS, NULL, NULL},
    {"an index, or its bound", 1e9, "lang/model/evaluate.c", "fabs(v) > 1e9"},
    {"different bounds and shifts of indices", INT16_MAX, "lang/model/evaluate.c", "m->int_count == INT16_MAX"},
    {"events, families counted once", RULES_MOST, NULL, NULL},
    {"functions that events watch, cells of families counted", RULE_FUNCTIONS_MOST, NULL, NULL},
    {"comparisons, `and`, `or` and `not` in the condition of an event", RULE_FORMULA_MOST, NULL, NULL},
    {"numbers and vectors that events keep", MODEL_KEEPS_MAX, NULL, NULL},
    {"variables, components counted", UINT16_MAX / 8, "lang/read/layout.c", "parts > UINT16_MAX / 8"},
    {"variables, lists and quantities together, components counted; a variable counts up to eight times", UINT16_MAX,
     "lang/model/model_storage.c", "need > UINT16_MAX"},
    {"numbers of a state, boundary cells included", MODEL_NUMBERS_MAX, NULL, NULL},
    {"numbers of a list or a family of parameters", MODEL_LIST_MAX, NULL, NULL},
    {"operations of all expressions together", GRAPH_NODES_MAX, NULL, NULL},
    {"operations of equations, exact lines and invariants, for invariants to be checked", VERIFY_NODES_MAX, NULL, NULL},
    {"terms of families and sums in one evaluation, for invariants to be checked", VERIFY_TERMS_MAX, NULL, NULL},
    {"calls of functions by functions", MODEL_CALLS_MAX, NULL, NULL},
    {"steps to read the expressions, those of a quantity or a function at each of its uses", MODEL_LOWERED_MAX, NULL,
     NULL},
    {"terms of all sums in one evaluation", MODEL_TERMS_MAX, NULL, NULL},
    {"terms of all sums in constants", MODEL_CONSTANT_TERMS_MAX, NULL, NULL},
    {"bytes of one equation when it is printed", GRAPH_TEXT_MAX, NULL, NULL},
    {"steps of a run", 1e15, "api/motion/run_timing.c", "#define STEPS_MAX 1e15"},
    {"threads", MOTUS_THREADS_MAX, NULL, NULL},
    {"numbers of a state whose Jacobian matrix is asked for", MOTUS_JACOBIAN_MAX, NULL, NULL},
    {"bytes of the matrix of an implicit method", SOLVER_BAND_BYTES_MAX, NULL, NULL},
    {"pieces of one step that is located at its switches", 20000, "api/motion/locate_piece.c", "PIECES_MAX = 20000"},
    {"switches of a model that are located, cells counted", SWITCHES_MAX, NULL, NULL},
    {"controlled steps to tell whether a run has passed a singularity", 50000, "api/calls/singular.c",
     "PIECES_MAX = 50000"},
    {"operations of a model that is computed in lanes", OPERATIONS_MAX, NULL, NULL},
    {"seconds a compiler may take", COMPILER_SECONDS_MAX, NULL, NULL},
    {"bytes of memory a compiler may take", COMPILER_MEMORY_MAX, NULL, NULL},
    {"bytes of a restart state", FILE_STATE_MAX, NULL, NULL},
    {"values of a file of `--vary NAME=@FILE`", FILE_VALUES_MAX, NULL, NULL},
    {"bytes of a line of such a file", FILE_LINE_MAX, NULL, NULL},
    {"bytes of the model in an address", SHARE_TEXT_MAX, NULL, NULL},
};
enum { LIMITS = sizeof limits / sizeof *limits };

static char *text_of(const char *file)
{
    char path[1024];
    given_path(path, sizeof path, ".", file);
    return given_file(path);
}

static void the_manual_has_every_limit(void **state)
{
    (void)state;
    char *manual = text_of("doc/manual.md");
    const char *begin = strstr(manual, "<!-- limits -->"), *end = strstr(manual, "<!-- /limits -->");
    assert_true(begin && end && begin < end);
    size_t rows = 0;
    for (const char *c = begin; c < end; c++) rows += c[0] == '\n' && c[1] == '|';
    for (int i = 0; i < LIMITS; i++) {
        char row[300];
        snprintf(row, sizeof row, "\n| %s | %.0f |\n", limits[i].what, limits[i].most);
        const char *at = strstr(begin, row);
        if (!at || at > end) fail_msg("the manual has no row%s", row);
    }
    assert_int_equal(rows, LIMITS + 2); /* the head has two lines */
    free(manual);
}

static void the_code_has_them_where_it_says(void **state)
{
    (void)state;
    for (int i = 0; i < LIMITS; i++) {
        if (!limits[i].file) continue;
        char *source = text_of(limits[i].file);
        if (!strstr(source, limits[i].says)) fail_msg("%s does not say: %s", limits[i].file, limits[i].says);
        free(source);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_manual_has_every_limit),
                                       cmocka_unit_test(the_code_has_them_where_it_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
