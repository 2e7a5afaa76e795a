/* THE ORDER CONDITIONS OF SYMMETRIC COMPOSITIONS, for any symmetric step and hence for every force.
 *
 * A symmetric step of size h is exp(h Y1 + h³ Y3 + h⁵ Y5 + …) with operators Y1, the equation's own, Y3, Y5, … that
 * depend on the step and the force [HLW06, V.3.2; MQ02]. Steps of w[1] h, w[2] h, … have order p if the
 * product of their exponentials and exp(h Y1) agree up to the degree p, as series in letters that do not commute.
 *
 * Invariant: one condition for each word in the letters 1, 3, 5, …, whose degree is their sum. The letters are free, so
 * what holds for them holds for every force.
 */
#include "test/laws_proof.h"

typedef struct word {
    int letters, letter[TREES_ORDER_MAX];
} word;

/* The coefficient of a word in exp(w Y1 + w³ Y3 + …): w to its degree, divided by the factorial of its length. */
static quad coefficient(const word *u, int from, int to, quad w)
{
    quad c = 1;
    for (int l = from; l < to; l++) {
        c /= l - from + 1;
        for (int k = 0; k < u->letter[l]; k++) c *= w;
    }
    return c;
}

static condition condition_of(const word *u, int degree, const scheme *m)
{
    quad prefix[TREES_ORDER_MAX + 1] = {1}, exact = 1;
    for (int i = 0; i < m->stages; i++)
        for (int l = u->letters; l > 0; l--) /* the next factor takes the letters from `from` on */
            for (int from = 0; from < l; from++) prefix[l] += prefix[from] * coefficient(u, from, l, m->bv[i]);
    for (int l = 0; l < u->letters; l++) exact = u->letter[l] == 1 ? exact / (l + 1) : 0;
    return (condition){degree, prefix[u->letters], exact};
}

/* All words of this degree that begin with *u. out NULL: only counted. */
static int words(word *u, int degree, int left, const scheme *m, condition *out)
{
    int count = 0;
    if (left == 0) {
        if (out) *out = condition_of(u, degree, m);
        return 1;
    }
    for (int letter = 1; letter <= left; letter += 2) {
        u->letter[u->letters++] = letter;
        count += words(u, degree, left - letter, m, out ? out + count : NULL);
        u->letters--;
    }
    return count;
}

int words_count(int order)
{
    word u = {0};
    return words(&u, order, order, NULL, NULL);
}

int words_conditions(const scheme *m, int order, condition *out)
{
    int count = 0;
    for (int degree = 1; degree <= order; degree++) {
        word u = {0};
        count += words(&u, degree, degree, m, out + count);
    }
    return count;
}
