/* Brackets, bars and braces of a typeset statement. */
#include "lang/typeset/typeset_parts.h"

/* Returns whether an expression is higher than a line. One with more than `budget` nodes counts as high. */
static bool tall(const tree *t, int *budget)
{
    for (;; t = t->item[0]) {
        if (t->kind == TREE_DIVIDE || t->kind == TREE_SUM || typeset_calls(t, CALL_IF) || typeset_calls(t, CALL_DIFF) ||
            --*budget < 0)
            return true;
        if (t->count == 0 || t->kind == TREE_NAME || t->kind == TREE_COMPONENT) return false;
        for (uint32_t i = 1; i < t->count && t->kind != TREE_POWER; i++)
            if (tall(t->item[i], budget)) return true;
        if (t->kind == TREE_APPLY) return false;
    }
}

/* Fences stretch only around high expressions, because fonts draw more space around stretchy ones. */
static const char *const open_fence[][2] = {
    {"<mrow><mo stretchy=\"false\">(</mo>", "<mrow><mo>(</mo>"},
    {"<mrow><mo stretchy=\"false\">[</mo>", "<mrow><mo>[</mo>"},
    {"<mrow><mo form=\"prefix\" stretchy=\"false\">|</mo>", "<mrow><mo form=\"prefix\">|</mo>"},
    {"<mrow><mo stretchy=\"false\">⌊</mo>", "<mrow><mo>⌊</mo>"}};
static const char *const close_fence[][2] = {
    {"<mo stretchy=\"false\">)</mo></mrow>", "<mo>)</mo></mrow>"},
    {"<mo stretchy=\"false\">]</mo></mrow>", "<mo>]</mo></mrow>"},
    {"<mo form=\"postfix\" stretchy=\"false\">|</mo></mrow>", "<mo form=\"postfix\">|</mo></mrow>"},
    {"<mo stretchy=\"false\">⌋</mo></mrow>", "<mo>⌋</mo></mrow>"}};

/* Fences the items of a tree, or a tree itself. */
static void fenced(typesetter *p, fence f, tree *const *item, uint32_t count, const tree *itself, place at)
{
    int budget = 256;
    bool stretch = false, cut = count > TYPESET_ITEMS_MAX;
    for (uint32_t i = 0; i < count && !stretch && !(at & PLACE_SMALL); i++)
        stretch = tall(item ? item[i] : itself, &budget);
    typeset_tag(p, open_fence[f][stretch]);
    for (uint32_t i = 0; i < count; i++) {
        if (i) typeset_sign(p, "<mo>,</mo>");
        if (cut && i == TYPESET_ITEMS_MAX - 2) {
            typeset_sign(p, "<mi>…</mi><mo>,</mo>");
            i = count - 1;
        }
        typeset_then(p, item ? item[i] : itself, place_inside(at));
    }
    typeset_tag(p, close_fence[f][stretch]);
}

/* The word `hold` of a table stands after its arguments. */
void typeset_items(typesetter *p, fence f, const tree *t, place at)
{
    fenced(p, f, t->item, t->count + (t->kind == TREE_CALL ? t->primes : 0u), NULL, at);
}
void typeset_arguments(typesetter *p, const tree *t, place at)
{
    fenced(p, FENCE_ROUND, t->item + 1, t->count - 1, NULL, at);
}
void typeset_itself(typesetter *p, fence f, const tree *t, place at) { fenced(p, f, NULL, 1, t, at); }

/* Writes if(c, a, if(d, b, e)) as one brace with three rows. */
void typeset_cases(typesetter *p, const tree *t, place at)
{
    typeset_tag(p, "<mrow><mo form=\"prefix\">{</mo><mtable class=\"cases\" columnalign=\"left\">");
    for (int rows = 0;; t = t->item[2]) {
        typeset_tag(p, "<mtr><mtd>");
        typeset_then(p, t->item[1], place_inside(at));
        typeset_tag(p, "</mtd><mtd><mtext>if&#xA0;</mtext>");
        typeset_then(p, t->item[0], place_inside(at));
        typeset_tag(p, "</mtd></mtr>");
        if (++rows == TYPESET_ITEMS_MAX || !typeset_calls(t->item[2], CALL_IF)) break;
    }
    typeset_tag(p, "<mtr><mtd>");
    typeset_then(p, t->item[2], place_inside(at));
    typeset_tag(p, "</mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>");
}
