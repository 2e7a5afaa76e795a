/* See rules.h. */
#include "core/rules.h"

/* Tells whether a comparison holds where its leaf has this sign; 0: the leaf stays 0. */
static bool compares(uint8_t what, int sign)
{
    switch ((rule_comparison)what) {
    case RULE_ABOVE: return sign > 0;
    case RULE_AT_LEAST: return sign >= 0;
    case RULE_AT: return sign == 0;
    case RULE_OFF: return sign != 0;
    }
    return false;
}

bool rules_hold(const rule *r, size_t instance, const int8_t *sign)
{
    bool stack[RULE_FORMULA_MOST];
    int top = 0;
    for (int k = 0; k < r->words; k++) {
        const int16_t word = r->formula[k];
        if (word >= 0) {
            const size_t f = r->first + (size_t)word * r->instances + instance;
            stack[top++] = compares(r->compares[word], sign[f]);
        } else if (word == RULE_NOT) {
            stack[top - 1] = !stack[top - 1];
        } else {
            top--;
            stack[top - 1] = word == RULE_AND ? stack[top - 1] && stack[top] : stack[top - 1] || stack[top];
        }
    }
    return top > 0 && stack[top - 1];
}
