/* Expressions: operators, calls and sums. Chains of operators may be long and lean left, so a loop walks them; the rest
 * recurses, as deep as the parser allows. */
#include "lang/lower/lower_ghost.h"
#include "lang/lower/lower_parts.h"

#include "lang/model/evaluate.h"
#include "lang/model/kept.h"
#include "lang/model/symbols.h"

#include <math.h>
#include <string.h>

static bool equal_shapes(lowering *l, const tree *t, const tree *a, const value *va, const tree *b, const value *vb,
                         const char *sign)
{
    char x[80], y[80], p[40], q[40];
    if (va->count == vb->count) return true;
    COMPLAIN(l, &t->at, "%s %s %s does not fit: %s and %s", quote(l, &a->at, x), sign, quote(l, &b->at, y),
             shape_name(va, p), shape_name(vb, q));
    if (!va->count || !vb->count)
        HINT(l, "a number does not become a vector: write a vector (…, …), or take the length |%s| or a component",
             va->count ? x : y);
    return false;
}

static value lower_sum_of_two(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb)
{
    bool add = t->kind == TREE_ADD;
    if (!equal_shapes(l, t, a, &va, b, &vb, add ? "+" : "-")) return wrong(l);
    value v = vector(l, va.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        v.item[k] = binary(l, add ? OP_ADD : OP_SUB, va.item[k], vb.item[k]);
    return v;
}

/* Multiplies a matrix by a matrix, a vector (a column) or a number, or a number by a matrix [18]. */
static value lower_matrix_product(lowering *l, const tree *t, value a, value b)
{
    if (b.count == 0 || (a.count == 0 && !a.rows)) { /* a number and a matrix */
        const value *number = b.count == 0 ? &b : &a, *matrix = b.count == 0 ? &a : &b;
        value v = vector(l, matrix->rows * matrix->count);
        for (int k = 0; k < v.count; k++) v.item[k] = binary(l, OP_MUL, number->item[0], matrix->item[k]);
        v.count = matrix->count;
        v.rows = matrix->rows;
        return v;
    }
    const int inner = b.rows ? b.rows : b.count, columns = b.rows ? b.count : 1;
    if (!a.rows || a.count != inner) {
        if (a.rows)
            COMPLAIN(l, &t->at, "a matrix of %d by %d takes a vector of length %d, not %d", a.rows, a.count, a.count,
                     inner);
        else
            COMPLAIN(l, &t->at, "a vector stands behind its matrix, not before it");
        return wrong(l);
    }
    value v = vector(l, a.rows * columns), products = vector(l, inner);
    for (int i = 0; i < a.rows; i++)
        for (int j = 0; j < columns; j++) {
            for (int k = 0; k < inner; k++)
                products.item[k] = binary(l, OP_MUL, a.item[i * inner + k], b.item[k * columns + j]);
            v.item[i * columns + j] = graph_total(l->model->graph, products.item, (size_t)inner);
        }
    v.count = b.rows ? columns : a.rows > 1 ? a.rows : 0;
    v.rows = b.rows ? a.rows : 0;
    return v;
}

static node dot(lowering *l, value a, value b)
{
    value products = vector(l, a.count);
    for (int k = 0; k < products.count; k++) products.item[k] = binary(l, OP_MUL, a.item[k], b.item[k]);
    return graph_total(l->model->graph, products.item, (size_t)products.count);
}

/* Returns a[i] b[j] - a[j] b[i]. Two statements make the products, since C leaves the order of arguments open. */
static node area(lowering *l, const node *a, const node *b, int i, int j)
{
    node minus = binary(l, OP_MUL, a[j], b[i]), plus = binary(l, OP_MUL, a[i], b[j]);
    return binary(l, OP_SUB, plus, minus);
}

/* Multiplies two vectors as `dot` and `cross` do, which t calls or has as a sign. */
static value lower_vectors(lowering *l, const tree *t, value v, value w)
{
    const bool is_cross = t->operation == CALL_CROSS;
    char shape[40], other[40];
    if (v.count == 0 || v.count != w.count || (is_cross && v.count > 3)) {
        COMPLAIN(l, &t->at, "%s takes two vectors of %s, not %s and %s", is_cross ? "cross" : "dot",
                 is_cross ? "length 3 (or 2)" : "equal length", shape_name(&v, shape), shape_name(&w, other));
        return wrong(l);
    }
    if (!is_cross) return scalar(l, dot(l, v, w));
    const node *a = v.item, *b = w.item;
    if (v.count == 2) return scalar(l, area(l, a, b, 0, 1));
    value r = vector(l, 3);
    for (int k = 0; k < 3; k++) r.item[k] = area(l, a, b, (k + 1) % 3, (k + 2) % 3);
    return r;
}

static value lower_product(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb)
{
    char x[80], y[80];
    if (va.rows || vb.rows) return lower_matrix_product(l, t, va, vb);
    if (t->operation && va.joined && !a->bracketed && (va.count || vb.count)) { /* a × b × c, a · b × c */
        COMPLAIN(l, &t->at, "which two vectors are multiplied first?");
        HINT(l, "write brackets: (%s) …, or cross(…, …)", quote(l, &a->at, x));
        return wrong(l);
    }
    if (va.count && vb.count && t->operation) {
        value v = lower_vectors(l, t, va, vb);
        v.joined = true;
        return v;
    }
    if (va.count && vb.count) {
        COMPLAIN(l, &t->at, "two vectors have no plain product");
        HINT(l, "write dot(%s, %s), cross(%s, %s) or |v|^2", quote(l, &a->at, x), quote(l, &b->at, y), x, y);
        return wrong(l);
    }
    if (t->blank_product) {
        const tree *name = a->kind == TREE_MULTIPLY || a->kind == TREE_DIVIDE ? a->item[1] : a;
        symbol s = symbols_find(l->model, name->name);
        if (s.state && !lower_find_index(l, name->name) && !lower_find_argument(l, name->name) &&
            !(graph_deps(l->model->graph, vb.item[0]) & (DEP_TIME | DEP_STATE | DEP_LEVELS | DEP_D))) {
            quote(l, &name->at, x);
            quote(l, &b->at, y);
            source_complain(&l->model->source, MOTUS_SYNTAX, &(span){t->at.text, name->at.from, b->at.to},
                            "%s %s: a product or an initial value?", x, y);
            HINT(l, "write %s*%s for the product, %s%s for the initial value", x, y, x, y);
            return wrong(l);
        }
    }
    value v = vector(l, va.count ? va.count : vb.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        v.item[k] = binary(l, OP_MUL, va.item[va.count ? k : 0], vb.item[vb.count ? k : 0]);
    return v;
}

static value lower_quotient(lowering *l, const tree *t, value va, const tree *b, value vb)
{
    char x[80];
    if (vb.rows) {
        COMPLAIN(l, &t->at, "nothing can be divided by a matrix");
        HINT(l, "multiply by its inverse, a matrix of its own: W = [[…], […]], then W x");
        return wrong(l);
    }
    if (vb.count) {
        COMPLAIN(l, &t->at, "nothing can be divided by a vector");
        HINT(l, "divide by its length |%s|, or by a component", quote(l, &b->at, x));
        return wrong(l);
    }
    if (!va.count) return scalar(l, lower_ratio(l, va.item[0], vb.item[0]));
    /* v/s is v*(1/s), so it divides once */
    node once = binary(l, OP_DIV, graph_const(l->model->graph, 1), vb.item[0]);
    value v = vector(l, va.rows ? va.rows * va.count : va.count);
    for (int k = 0; k < v.count; k++) v.item[k] = binary(l, OP_MUL, va.item[k], once);
    v.count = va.count;
    v.rows = va.rows;
    return v;
}

/* Returns whether an exponent is a literal whole number with |n| <= 64; the power then becomes products. */
static bool literal_exponent(const tree *t, int *n)
{
    int sign = 1;
    if (t->kind == TREE_NEGATE) {
        sign = -1;
        t = t->item[0];
    }
    if (t->kind != TREE_NUMBER || t->number != floor(t->number) || t->number > 64) return false;
    *n = sign * (int)t->number;
    return true;
}

/* Returns |v|^n from d = dot(v, v): d^(n/2), times sqrt(d) if n is odd. */
static node norm_power(lowering *l, value of, int n)
{
    graph *g = l->model->graph;
    node d = dot(l, of, of);
    int m = n < 0 ? -n : n;
    node p = m >= 2 ? graph_power(g, d, m / 2) : 0;
    if (m % 2) {
        node root = graph_op(g, OP_SQRT, d, 0, 0);
        p = m >= 2 ? binary(l, OP_MUL, p, root) : root;
    }
    if (m == 0) return graph_const(g, 1);
    return n < 0 ? binary(l, OP_DIV, graph_const(g, 1), p) : p;
}

static value lower_power(lowering *l, const tree *t)
{
    const tree *base = t->item[0], *exponent = t->item[1];
    char x[80];
    int n;
    bool literal = literal_exponent(exponent, &n);
    if (literal && base->kind == TREE_NORM) {
        value of = lower_expression(l, base->item[0]);
        if (failed(l)) return wrong(l);
        if (of.count) return scalar(l, norm_power(l, of, n));
    }
    value b = lower_numbers(l, base);
    if (failed(l)) return wrong(l);
    if (b.count) {
        COMPLAIN(l, &t->at, "a vector has no powers");
        char y[80];
        if (exponent->kind != TREE_NUMBER)
            HINT(l, "the product of two vectors is cross(%s, %s)", quote(l, &base->at, x), quote(l, &exponent->at, y));
        HINT(l, "write |%s|^2, which is dot(%s, %s)", quote(l, &base->at, x), x, x);
        return wrong(l);
    }
    if (literal) return scalar(l, graph_power(l->model->graph, b.item[0], n));
    node e = lower_scalar(l, exponent, "an exponent");
    return failed(l) ? wrong(l) : scalar(l, binary(l, OP_POW, b.item[0], e));
}

/* Makes a condition of the value of a tree, or complains. */
static bool want_condition(lowering *l, value *v, const tree *t)
{
    char x[80];
    lower_as_condition(l, v);
    if (failed(l) || v->boolean) return !failed(l);
    COMPLAIN(l, &t->at, "a condition is expected here");
    HINT(l, "write a comparison, %s > 0 or %s != 0", quote(l, &t->at, x), x);
    return false;
}

/* Lowers if(c, a, b), a number or a vector; between conditions it is a condition: c and a or not c and b. */
static value lower_choice(lowering *l, const tree *t, value v[3])
{
    graph *g = l->model->graph;
    if (!want_condition(l, &v[0], t->item[0])) return wrong(l);
    const node c = v[0].item[0];
    if (v[1].boolean && v[2].boolean) {
        const node a = binary(l, OP_AND, c, v[1].item[0]);
        const node b = binary(l, OP_AND, graph_op(g, OP_NOT, c, 0, 0), v[2].item[0]);
        return condition(l, binary(l, OP_OR, a, b));
    }
    for (int k = 1; k < 3; k++) lower_as_number(l, &v[k]);
    if (!equal_shapes(l, t, t->item[1], &v[1], t->item[2], &v[2], "or")) return wrong(l);
    value r = vector(l, v[1].count);
    for (int k = 0; k < (r.count ? r.count : 1); k++) r.item[k] = graph_op(g, OP_SELECT, c, v[1].item[k], v[2].item[k]);
    return r;
}

/* Compares numbers. A condition counts as 1 or 0, and what is compared is which of the conditions hold, so that where
 * they change is where their own sides are equal: lit == 1 is lit. */
static node compare(lowering *l, operation op, const value *a, const value *b)
{
    graph *g = l->model->graph;
    if (!a->boolean && !b->boolean) return binary(l, op, a->item[0], b->item[0]);
    const node c = a->boolean ? a->item[0] : b->item[0];
    node is[2]; /* where the condition is false, and where it is true */
    for (int k = 0; k < 2; k++) {
        const value number = scalar(l, graph_const(g, k));
        is[k] = compare(l, op, a->boolean ? &number : a, a->boolean ? b : &number);
    }
    if (is[0] == is[1]) return is[0];
    if (graph_at(g, is[0])->op == OP_CONST && graph_at(g, is[1])->op == OP_CONST)
        return is[0] == 0 ? c : graph_op(g, OP_NOT, c, 0, 0);
    const node yes = binary(l, OP_AND, c, is[1]), no = binary(l, OP_AND, graph_op(g, OP_NOT, c, 0, 0), is[0]);
    return binary(l, OP_OR, yes, no);
}

static value lower_comparison(lowering *l, const tree *t)
{
    value side[2];
    char shape[40];
    for (int k = 0; k < 2; k++) {
        side[k] = lower_expression(l, t->item[k]);
        lower_as_decided(l, &side[k]);
        if (!failed(l) && side[k].count)
            COMPLAIN(l, &t->item[k]->at, "a side of a comparison is a number, but this is %s",
                     shape_name(&side[k], shape));
        if (failed(l)) return wrong(l);
    }
    return condition(l, compare(l, (operation)t->operation, &side[0], &side[1]));
}

static value lower_call(lowering *l, const tree *t)
{
    value v[3] = {{0}};
    uint32_t n = t->count;
    char shape[40], x[80];
    if (t->operation == CALL_DIFF) return lower_diff(l, t);
    if (t->operation == CALL_INTERP || t->operation == CALL_SPLINE) return lower_table(l, t);
    for (uint32_t i = 0; i < n && i < 3; i++) {
        v[i] = lower_expression(l, t->item[i]);
        if (failed(l)) return wrong(l);
    }
    if (t->operation == CALL_IF) return lower_choice(l, t, v);
    for (uint32_t i = 0; i < n && i < 3; i++) lower_as_number(l, &v[i]);
    if (t->operation == CALL_DOT || t->operation == CALL_CROSS) return lower_vectors(l, t, v[0], v[1]);
    if (t->operation == OP_MIN || t->operation == OP_MAX) {
        node r = lower_scalar(l, t->item[0], "an argument");
        for (uint32_t i = 1; i < n && !failed(l); i++)
            r = binary(l, (operation)t->operation, r, lower_scalar(l, t->item[i], "an argument"));
        return scalar(l, r);
    }
    for (uint32_t i = 0; i < n; i++)
        if (v[i].count) {
            COMPLAIN(l, &t->item[i]->at, "%s takes numbers, but this is %s", t->name, shape_name(&v[i], shape));
            HINT(l, "its length is |%s|, a component %s.x", quote(l, &t->item[i]->at, x), x);
            return wrong(l);
        }
    if (t->operation == OP_SIGN) return scalar(l, lower_sign(l, v[0].item[0]));
    return scalar(l, graph_op(l->model->graph, (operation)t->operation, v[0].item[0], n > 1 ? v[1].item[0] : 0, 0));
}

/* The parts of their ranges to which indices of a sum are restricted. */
typedef struct sum_part {
    bool cut[MAX_DIMS];
    int64_t low[MAX_DIMS], high[MAX_DIMS];
} sum_part;

/* The levels of a sum whose indices are known to `inner`, from `first` on. */
typedef struct sum_levels {
    int first, count;
    range ranges[MAX_DIMS];
    uint32_t index[MAX_DIMS]; /* by level: which index of the sum it is; an index with a single value has no level */
} sum_levels;

static value lower_sum_part(lowering *l, const tree *t, const sum_part *part);

/* Lowers a sum over ghost cells and others: the sum of the parts before and after a cut. */
static value lower_sum_cut(const lowering *inner, const tree *t, const sum_part *whole, const sum_levels *s,
                           const model_cut *cut, lowering *l)
{
    const range *of = &s->ranges[cut->level - s->first];
    const uint32_t k = s->index[cut->level - s->first];
    if (of->first.level >= 0 || of->last.level >= 0) {
        COMPLAIN(l, &t->loops[k].at, "the index %s reaches cells that several lines give", t->loops[k].name);
        HINT(l, "its range cannot depend on another index then: write the sum without these cells");
        return wrong(l);
    }
    sum_part before = *whole, after = *whole;
    before.cut[k] = after.cut[k] = true;
    before.low[k] = inner->low[cut->level];
    before.high[k] = cut->at - 1;
    after.low[k] = cut->at;
    after.high[k] = inner->high[cut->level];
    const value a = lower_sum_part(l, t, &before), b = failed(l) ? wrong(l) : lower_sum_part(l, t, &after);
    if (failed(l)) return wrong(l);
    value v = vector(l, a.count);
    for (int i = 0; i < (v.count ? v.count : 1); i++) v.item[i] = binary(l, OP_ADD, a.item[i], b.item[i]);
    return v;
}

/* Makes the indices of a sum known to `inner`. */
static bool open_sum(lowering *l, const tree *t, const sum_part *part, lowering *inner, sum_levels *s)
{
    if (l->levels + (int)t->loop_count > MAX_LEVELS) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "sums and families are nested more than %d deep",
                        MAX_LEVELS);
        return false;
    }
    for (uint32_t k = 0; k < t->loop_count; k++) {
        const subscript none = {.level = -1, .slot = -1, .modulus = -1};
        int64_t low, high;
        range *r = &s->ranges[s->count];
        if (!lower_range(inner, &t->loops[k], r, &low, &high)) return false;
        if (part->cut[k]) {
            *r = (range){none, none};
            r->first.literal = (int32_t)(low = part->low[k]);
            r->last.literal = (int32_t)(high = part->high[k]);
        }
        if (!lower_add_index(inner, &t->loops[k], inner->levels, low, high)) return false;
        inner->terms *= high >= low ? (double)(high - low + 1) : 1;
        if (part->cut[k] && low == high) {
            index_name *n = &inner->names[inner->name_count - 1];
            n->at = r->first;
            n->number = graph_const(l->model->graph, (double)low);
        } else {
            s->index[s->count++] = k;
            inner->levels++;
        }
    }
    if (inner->terms > MODEL_TERMS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at,
                        "%.3g terms are more than the %.0e that an evaluation may take", inner->terms, MODEL_TERMS_MAX);
        return false;
    }
    if (l->place == PLACE_CONSTANT && (l->model->constant_terms += inner->terms) > MODEL_CONSTANT_TERMS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at,
                        "the sums in constants have more than %.0e terms together", MODEL_CONSTANT_TERMS_MAX);
        return false;
    }
    if (l->place != PLACE_CONSTANT) l->model->terms = fmax(l->model->terms, inner->terms);
    return true;
}

/* Returns the sum of a body over its levels, which have been opened. */
static node lower_sum_over(lowering *l, const sum_levels *s, bool masked, node mask, node n)
{
    graph *g = l->model->graph;
    if (s->count == 0) return masked ? graph_op(g, OP_SELECT, mask, n, 0) : n;
    for (int i = s->count - 1; i >= 0; i--)
        n = graph_sum(g, s->first + i, &s->ranges[i], i == s->count - 1 ? mask : 0, n);
    return evaluate_sum(l->model, n);
}

/* Lowers sum(j = a..b, condition, …: body) [12]: each index is a loop; the innermost contains the conditions and the
 * body. */
static value lower_sum(lowering *l, const tree *t) { return lower_sum_part(l, t, &(sum_part){{false}, {0}, {0}}); }

static value lower_sum_part(lowering *l, const tree *t, const sum_part *part)
{
    lowering inner = *l;
    sum_levels s = {.first = l->levels};
    if (!open_sum(l, t, part, &inner, &s)) return wrong(l);
    node mask = 0;
    bool masked = false, never = false; /* never: a condition is the constant false, so the sum is empty */
    model_cut cut;
    for (uint32_t i = 0; i + 1 < t->count; i++) {
        value c = lower_expression(&inner, t->item[i]);
        if (lower_cut(l->model, s.first, s.count, &cut)) return lower_sum_cut(&inner, t, part, &s, &cut, l);
        if (!want_condition(l, &c, t->item[i])) return wrong(l);
        mask = masked ? binary(l, OP_AND, mask, c.item[0]) : c.item[0];
        masked = true;
        never |= mask == 0;
    }
    value body = lower_numbers(&inner, t->item[t->count - 1]);
    if (lower_cut(l->model, s.first, s.count, &cut)) return lower_sum_cut(&inner, t, part, &s, &cut, l);
    if (failed(l)) return wrong(l);
    value v = vector(l, body.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        v.item[k] = never ? 0 : lower_sum_over(l, &s, masked, mask, body.item[k]);
    return v;
}

static value lower_truth(lowering *l, const tree *t)
{
    value v = lower_expression(l, t);
    return want_condition(l, &v, t) ? v : wrong(l);
}

static value lower_vector(lowering *l, const tree *t)
{
    if (t->count > MODEL_COMPONENTS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "a vector has at most %d components",
                        MODEL_COMPONENTS_MAX);
        return wrong(l);
    }
    value v = vector(l, (int)t->count);
    for (uint32_t i = 0; i < t->count && !failed(l); i++) v.item[i] = lower_scalar(l, t->item[i], "a component");
    return v;
}

/* Lowers an operator, whose left operand has been lowered. */
static value lower_right(lowering *l, const tree *t, value left)
{
    const tree *a = t->item[0], *b = t->item[1];
    if (t->kind == TREE_AND || t->kind == TREE_OR) {
        if (!want_condition(l, &left, a)) return wrong(l);
        value right = lower_truth(l, b);
        return failed(l) ? wrong(l)
                         : condition(l, binary(l, t->kind == TREE_AND ? OP_AND : OP_OR, left.item[0], right.item[0]));
    }
    const bool factor = t->kind == TREE_MULTIPLY || t->kind == TREE_DIVIDE;
    if (!factor && !lower_no_matrix(l, &left, a)) return wrong(l);
    value right = factor ? lower_factor(l, b) : lower_expression(l, b);
    lower_as_number(l, &left);
    lower_as_number(l, &right);
    if (failed(l)) return wrong(l);
    if (t->kind == TREE_ADD || t->kind == TREE_SUBTRACT) return lower_sum_of_two(l, t, a, left, b, right);
    const bool derived = left.derived || right.derived;
    if (derived) lower_tidy(l, true);
    value v = t->kind == TREE_MULTIPLY ? lower_product(l, t, a, left, b, right) : lower_quotient(l, t, left, b, right);
    v.derived = derived;
    v.joined |= left.joined && !a->bracketed;
    lower_tidy(l, false);
    return v;
}

static bool operator_kind(tree_kind kind)
{
    return kind == TREE_ADD || kind == TREE_SUBTRACT || kind == TREE_MULTIPLY || kind == TREE_DIVIDE ||
           kind == TREE_AND || kind == TREE_OR;
}

/* Lowers a op b op c …: collects the operators down the left side, then lowers them from the innermost outward. */
static value lower_chain(lowering *l, const tree *t)
{
    size_t depth = 0;
    const tree *leaf = t;
    for (; operator_kind(leaf->kind); leaf = leaf->item[0]) depth++;
    const tree **chain = take(&l->model->arena->allocator, depth, sizeof *chain);
    if (!chain) return l->model->arena->failed = true, wrong(l);
    size_t n = depth;
    for (const tree *c = t; n > 0; c = c->item[0]) chain[--n] = c;
    value v = lower_factor(l, leaf);
    for (size_t i = 0; i < depth && !failed(l); i++) v = lower_right(l, chain[i], v);
    give(&l->model->arena->allocator, chain);
    return v;
}

value lower_tree(lowering *l, const tree *t)
{
    if (failed(l)) {
        if (l->model->graph->too_large)
            source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "the model's expressions are too large");
        return wrong(l);
    }
    if (++l->model->lowered > MODEL_LOWERED_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at,
                        "quantities and functions use one another too often: more than %u steps to read the model",
                        MODEL_LOWERED_MAX);
        return wrong(l);
    }
    graph *g = l->model->graph;
    value v;
    switch (t->kind) {
    case TREE_NUMBER: return lower_number(l, t);
    case TREE_NAME: return lower_name(l, t);
    case TREE_APPLY: {
        model_function *function = symbols_find(l->model, t->item[0]->name).function;
        return function                 ? lower_function(l, t, function)
               : kept_call(l->model, t) ? lower_kept(l, t)
                                        : lower_initial(l, t);
    }
    case TREE_CALL: return lower_call(l, t);
    case TREE_NEGATE:
        v = lower_factor(l, t->item[0]);
        lower_as_number(l, &v);
        if (failed(l)) return wrong(l);
        value r = vector(l, v.rows ? v.rows * v.count : v.count);
        r.derived = v.derived;
        lower_tidy(l, v.derived);
        for (int k = 0; k < (r.count ? r.count : 1); k++) r.item[k] = graph_op(g, OP_NEG, v.item[k], 0, 0);
        lower_tidy(l, false);
        r.count = v.count;
        r.rows = v.rows;
        return r;
    case TREE_POWER: return lower_power(l, t);
    case TREE_COMPARE: return lower_comparison(l, t);
    case TREE_NOT:
        v = lower_truth(l, t->item[0]);
        return failed(l) ? wrong(l) : condition(l, graph_op(g, OP_NOT, v.item[0], 0, 0));
    case TREE_VECTOR: return lower_vector(l, t);
    case TREE_LIST: {
        char text[80];
        if (t->count > 0 && t->item[0]->kind == TREE_LIST) return lower_matrix(l, t);
        COMPLAIN(l, &t->at, "a list can only be the whole value of a parameter");
        quote(l, &t->at, text);
        HINT(l, "a vector is written (%.*s); a list is a line of its own, m = [1, 2], and then m[1] is an entry",
             (int)strlen(text) - 2, text + 1);
        return wrong(l);
    }
    case TREE_COMPONENT: return lower_component(l, lower_expression(l, t->item[0]), t->item[1], t);
    case TREE_NORM:
        v = lower_numbers(l, t->item[0]);
        if (failed(l)) return wrong(l);
        return scalar(l, v.count ? graph_op(g, OP_SQRT, dot(l, v, v), 0, 0) : graph_op(g, OP_ABS, v.item[0], 0, 0));
    case TREE_SUM: return lower_sum(l, t);
    default: return lower_chain(l, t);
    }
}
