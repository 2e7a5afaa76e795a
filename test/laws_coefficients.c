/* THE COEFFICIENTS OF THE ROWS and the error of each; the only file of the proofs that knows the layout of a row.
 *
 * Invariant: nothing about a row's digits is written here. core/methods.c is compiled twice with numbers of 113 bits:
 * as it is, and with every literal moved by half a unit in its last printed place; the difference of the two tables
 * is the uncertainty of the digits. A literal that is a binary fraction of at most 20 places (0.5, 24.0) is exact,
 * and so is what is computed from such (7/24).
 */
#define K(x) Q(x)
#include "test/laws_proof.h"

typedef quad coef;
#define methods_table plain_table
#define methods_count plain_count
#define methods_newmark_damped plain_newmark_damped
#include "core/methods.c"
#undef methods_table
#undef methods_count
#undef methods_newmark_damped
#undef K

/* sizeof "0.5" is 4: a digit, the point, one decimal, the end; a sign and a second digit make it longer. */
#define DECIMALS(size, x) ((int)(size)-3 - ((x) < 0) - ((x) >= 10 || (x) <= -10) - ((x) >= 100 || (x) <= -100))
#define TENTH(d, bit, power) (((d) & (bit)) ? power : Q(1.0))
#define TEN_TO_MINUS(d)                                                                          \
    (TENTH(d, 1, Q(1e-1)) * TENTH(d, 2, Q(1e-2)) * TENTH(d, 4, Q(1e-4)) * TENTH(d, 8, Q(1e-8)) * \
     TENTH(d, 16, Q(1e-16)) * TENTH(d, 32, Q(1e-32)))
#define EXACT_LITERAL(x) ((x)*1048576 == (quad)(long long)((x)*1048576))
#define HALF_UNIT(size, x) (EXACT_LITERAL(x) ? Q(0.0) : Q(0.5) * TEN_TO_MINUS(DECIMALS(size, x)))
#define K(x) (Q(x) + HALF_UNIT(sizeof #x, Q(x)))
#define methods_table moved_table
#define methods_count moved_count
#define methods_newmark_damped moved_newmark_damped
#include "core/methods.c"
#undef methods_table

/* The coefficients that a row stores, in the order of its members. */
static int stored(const row *m, quad *out)
{
    int n = 0;
    if (m->family == SPLITTING && m->composition.count) {
        for (int i = 0; i < (m->composition.count + 1) / 2; i++) out[n++] = m->composition.weight[i];
    } else if (m->family == SPLITTING) {
        for (int i = 0; i < m->splitting.stages; i++) out[n++] = m->splitting.kick[i];
        for (int i = 0; i < m->splitting.stages; i++) out[n++] = m->splitting.drift[i];
    } else if (m->family == RUNGE_KUTTA) {
        const int s = m->tableau.stages, entries = s * (s - 1) / 2;
        for (int i = 0; i < s; i++) out[n++] = m->tableau.c[i];
        for (int i = 0; m->tableau.a && i < entries; i++) out[n++] = m->tableau.a[i];
        for (int i = 0; i < s; i++) out[n++] = m->tableau.b[i];
        for (int i = 0; m->tableau.aa && i < entries; i++) out[n++] = m->tableau.aa[i];
        for (int i = 0; m->tableau.aa && i < s; i++) out[n++] = m->tableau.bb[i];
    }
    return n;
}

static bool fits(const row *m)
{
    const int splits = m->composition.count ? m->composition.count + 1 : m->splitting.stages;
    const int s = m->family == SPLITTING ? splits : m->tableau.stages;
    const int tables = m->tableau.aa ? 2 : 1, count = m->family == SPLITTING  ? 2 * s
                                                      : m->family == IMPLICIT ? s * (s + 2)
                                                                              : s + tables * (s * (s - 1) / 2 + s);
    return s <= SCHEME_STAGES_MAX && count <= COEFFICIENTS_MAX;
}

coefficients coefficients_of(method k)
{
    coefficients c = {0};
    quad moved[COEFFICIENTS_MAX];
    if (!fits(&plain_table[k])) {
        judge(false, plain_table[k].card.name, "coefficients", "too many: raise the limits in test/laws_proof.h");
        return c;
    }
    c.count = stored(&plain_table[k], c.value);
    stored(&moved_table[k], moved);
    for (int i = 0; i < c.count; i++) c.unit[i] = quad_abs(moved[i] - c.value[i]);
    return c;
}

quad coefficients_unit(method k)
{
    const coefficients c = coefficients_of(k);
    quad most = 0;
    for (int i = 0; i < c.count; i++)
        if (c.unit[i] > most) most = c.unit[i];
    return most;
}

quad coefficients_dense_unit(method k)
{
    const row *m = &plain_table[k], *n = &moved_table[k];
    const int columns = m->tableau.stages + !m->tableau.closing + m->tableau.dense.more,
              series = (m->tableau.dense.terms - 1) * columns,
              entries = m->tableau.dense.more * (m->tableau.stages + 1) +
                        m->tableau.dense.more * (m->tableau.dense.more - 1) / 2;
    quad most = 0;
    for (int i = 0; i < series; i++) {
        const quad unit = quad_abs(n->tableau.dense.series[i] - m->tableau.dense.series[i]);
        if (unit > most) most = unit;
    }
    for (int i = 0; i < entries; i++) {
        const quad unit = quad_abs(n->tableau.dense.a[i] - m->tableau.dense.a[i]);
        if (unit > most) most = unit;
    }
    return most;
}

/* Alternating kicks and drifts, as a row or a composition of leapfrog steps has them: drift[i] follows kick[i]. */
static int operators(const row *m, const quad *value, quad *kick, quad *drift)
{
    const int count = m->composition.count;
    if (!count) {
        for (int i = 0; i < m->splitting.stages; i++) {
            kick[i] = value[i];
            drift[i] = value[m->splitting.stages + i];
        }
        return m->splitting.stages;
    }
    kick[0] = drift[0] = 0;
    for (int i = 0; i < count; i++) {
        const quad weight = value[i < count - 1 - i ? i : count - 1 - i];
        drift[i] += weight / 2;
        kick[i + 1] = weight;
        drift[i + 1] = weight / 2;
    }
    return count + 1;
}

/* Every kick is a stage, and changes the positions through the drifts that follow it. The Boris rotation uses the
 * velocity at its middle. */
static void splitting_scheme(const row *m, const quad *value, scheme *out)
{
    quad kick[SCHEME_STAGES_MAX], drift[SCHEME_STAGES_MAX];
    const int n = operators(m, value, kick, drift);
    for (int i = 0; i < n; i++) {
        if (kick[i] != 0) {
            const int s = out->stages++;
            out->c[s] = out->end;
            out->bv[s] = kick[i];
            for (int j = 0; j < s; j++) {
                out->a[s][j] = out->b[j];
                out->av[s][j] = out->bv[j];
            }
            if (m->card.forces == MOTUS_FORCES_XVT) out->av[s][s] = kick[i] / 2;
        }
        out->end += drift[i];
        for (int j = 0; j < out->stages; j++) out->b[j] += out->bv[j] * drift[i];
    }
}

/* An explicit tableau is stored below the diagonal alone. */
static void whole_table(const row *m, const quad **value, quad (*a)[SCHEME_STAGES_MAX])
{
    const int s = m->tableau.stages;
    const bool explicit = m->family == RUNGE_KUTTA;
    for (int i = 0; i < s; i++)
        for (int j = 0; j < (explicit ? i : s); j++) a[i][j] = *(*value)++;
}

/* A Nyström method as it stands. */
static void nystrom_scheme(const row *m, const quad *value, scheme *out)
{
    const int s = out->stages = m->tableau.stages;
    out->end = 1;
    for (int i = 0; i < s; i++) out->c[i] = *value++;
    if (m->tableau.a) whole_table(m, &value, out->av);
    for (int i = 0; i < s; i++) out->bv[i] = *value++;
    whole_table(m, &value, out->a);
    for (int i = 0; i < s; i++) out->b[i] = *value++;
}

/* A Runge-Kutta method for x' = v, v' = a; the positions use the square of the tableau. */
static void tableau_scheme(const row *m, const quad *value, scheme *out)
{
    const int s = out->stages = m->tableau.stages;
    const quad *c = value;
    value += s;
    whole_table(m, &value, out->av);
    const quad *b = value;
    for (int i = 0; i < s; i++) {
        out->c[i] = c[i];
        out->bv[i] = b[i];
        out->end += b[i];
        for (int j = 0; j < s; j++) {
            for (int l = 0; l < s; l++) out->a[i][j] += out->av[i][l] * out->av[l][j];
            out->b[i] += b[j] * out->av[j][i];
        }
    }
}

void coefficients_scheme(method k, const quad *value, scheme *out)
{
    const row *m = &plain_table[k];
    *out = (scheme){0};
    if (m->family == SPLITTING)
        splitting_scheme(m, value, out);
    else if (m->tableau.aa)
        nystrom_scheme(m, value, out);
    else
        tableau_scheme(m, value, out);
}

/* Kicks that depend on v need all Nyström trees, others the special ones; tableaux are methods for s' = f(s). Of
 * compositions the order for forces with v follows from that of their step, by words. */
trees_kind coefficients_trees(method k)
{
    const row *m = &plain_table[k];
    if (m->tableau.aa) return m->tableau.a ? TREES_NYSTROM : TREES_SPECIAL;
    if (m->family != SPLITTING) return TREES_ROOTED;
    return m->card.forces == MOTUS_FORCES_XVT && !m->composition.count ? TREES_NYSTROM : TREES_SPECIAL;
}

bool coefficients_compose(method k) { return plain_table[k].composition.count > 0; }

bool coefficients_nystrom(method k) { return plain_table[k].tableau.aa != NULL; }

/* The estimates of dop853 are of order 5 and 3, though both together go with a higher power of the step. */
int coefficients_embedded(method k, int which, scheme *m)
{
    const row *r = &plain_table[k];
    const quad *error = which ? r->tableau.second : r->tableau.error, *error_x = r->tableau.error_x;
    if (!r->adaptive || r->family != RUNGE_KUTTA || !error) return 0;
    const int s = m->stages;
    if (r->tableau.ending) { /* one more stage, at the state to which the step leads */
        m->c[s] = 1;
        for (int j = 0; j < s; j++) m->a[s][j] = m->b[j], m->av[s][j] = m->bv[j];
        m->stages++;
    }
    for (int j = 0; j < m->stages; j++) {
        m->bv[j] -= error[j];
        if (error_x) m->b[j] -= error_x[j];
        for (int i = 0; !error_x && i < m->stages; i++) m->b[j] -= error[i] * m->av[i][j];
    }
    return r->tableau.second ? (which ? 3 : 5) : r->tableau.order;
}
